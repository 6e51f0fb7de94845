//! Numbers as they are written, and sizes that are none: rows 17, 52, 53, 54, 55 and 56.

use lucarne::diagnostic::{Code, Severity};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::NoFiles;
use lucarne::world::World;

use super::held::compiled;
use super::scene::ten;
use super::wide::{Wide, WideMap, WideVector};
use crate::dice::Dice;

/// What is said of a text that comes after a camera, a light and a sphere: severity, code and
/// message of each.
fn said(text: &str) -> (World, Vec<String>) {
    let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
    let scene = format!(
        "#default {{ pigment {{ rgb 1 }} }} camera {{ location 9*z look_at 0 }}
         light_source {{ 5, rgb 1 }} sphere {{ -9*y, 1 }} {text}"
    );
    let (world, _) = road.compile("hard.scene", scene.into_bytes());
    let line = |d: &lucarne::diagnostic::Diagnostic| {
        let severity = if d.severity == Severity::Error { "error" } else { "warning" };
        assert!(d.primary().is_some(), "{d:?} has no place");
        format!("{severity} {}: {}", d.code.name(), d.message)
    };
    // The scene has a camera before.
    let others = road.diagnostics.iter().filter(|d| d.code != Code::DuplicateCamera);
    let lines = others.map(line).collect();
    (world, lines)
}

/// Each text, and all that is said of it.
const SAID: &[(&str, &[&str])] = &[
    (
        "box { 0, 0 }",
        &["error zero-size: a box whose corners differ along less than two axes is nothing"],
    ),
    (
        "box { <1, 2, 3>, <1, 2, 3> }",
        &["error zero-size: a box whose corners differ along less than two axes is nothing"],
    ),
    ("box { 0, <1, 0, 1> }", &["warning degenerate-shape: this box is flat"]),
    (
        "box { 0, x }",
        &["error zero-size: a box whose corners differ along less than two axes is nothing"],
    ),
    ("box { <1, 1, 1>, <-1, -1, -1> }", &[]),
    ("sphere { 0, 0 }", &["error zero-size: a sphere of radius 0 is nothing"]),
    ("sphere { 0, -1 }", &["warning negative-size: the radius is -1; 1 is used"]),
    (
        "sphere { 0, 1e-200 scale 1e-200 }",
        &["error zero-size: this sphere is too small for a number"],
    ),
    (
        "plane { <0, 0, 0>, 1 }",
        &["error zero-vector: the normal is the zero vector, and points nowhere"],
    ),
    ("plane { 0, 1 }", &["error zero-vector: the normal is the zero vector, and points nowhere"]),
    (
        "sphere { 0, 1 scale 0 }",
        &["error zero-scale: a scale of zero flattens everything to nothing"],
    ),
    (
        "sphere { 0, 1 scale <1, 0, 1> }",
        &["error zero-scale: a scale of zero flattens everything to nothing"],
    ),
    (
        "box { 0, 1 scale <1, 0, 1> }",
        &["error zero-scale: a scale of zero flattens everything to nothing"],
    ),
    (
        "sphere { 0, 1 matrix <1,0,0, 1,0,0, 0,0,1, 0,0,0> }",
        &["error zero-scale: this transform flattens space"],
    ),
    (
        "sphere { 0, 1 matrix <1/0,0,0, 0,1,0, 0,0,1, 0,0,0> }",
        &["error division-by-zero: division by zero"],
    ),
    (
        "sphere { 0, 1 scale 1e200 scale 1e200 }",
        &["error not-a-number: a number of this solid's place is not finite"],
    ),
    ("sphere { 0, 1/0 }", &["error division-by-zero: division by zero"]),
    ("sphere { 0, 0/0 }", &["error division-by-zero: division by zero"]),
    ("sphere { 0, 1e400 }", &["error malformed-number: `1e400` is not a number"]),
    ("sphere { 0, log(0) }", &["error out-of-range: `log` takes a number above 0, not 0"]),
    (
        "sphere { 0, pow(-8, 1/3) }",
        &[
            "error out-of-range: `pow` of a negative number takes a whole exponent, and 0.3333333333333333 is not whole",
        ],
    ),
    (
        "sphere { 0, acos(1 + 1e-10) }",
        &["error out-of-range: `acos` takes a number from -1 to 1, not 1.0000000001"],
    ),
    (
        "sphere { 0, sqrt(-1) }",
        &["error out-of-range: `sqrt` takes a number of at least 0, not -1"],
    ),
    (
        "sphere { vnormalize(<0, 0, 0>), 1 }",
        &["error zero-vector: `vnormalize` takes a vector with a direction, not the zero vector"],
    ),
    (
        "camera { location x look_at x }",
        &["error degenerate-camera: this camera stands at the same point that it looks at"],
    ),
    (
        "camera { location 5*y look_at 0 sky y right y }",
        &["error degenerate-camera: this camera looks along both its `sky` and its `right`"],
    ),
    (
        "camera { right <0, 0, 0> }",
        &["error zero-vector: the picture's width is the zero vector, and points nowhere"],
    ),
    (
        "camera { up <0, 0, 0> }",
        &["error zero-vector: the picture's height is the zero vector, and points nowhere"],
    ),
    (
        "camera { right x up x }",
        &["error degenerate-camera: `direction`, `right` and `up` of this camera lie in one plane"],
    ),
    ("camera { angle 0 }", &["error out-of-range: `angle` is 0, and must be more than 0"]),
    (
        "camera { angle 180 }",
        &["error out-of-range: `angle` is 180, and must be less than 180 for a perspective camera"],
    ),
    ("camera { angle -20 }", &["error out-of-range: `angle` is -20, and must be more than 0"]),
    ("camera { location 5*y look_at 0 }", &[]),
    (
        "light_source { direction <0, 0, 0> color rgb 1 }",
        &["error zero-vector: the direction to the light is the zero vector, and points nowhere"],
    ),
    (
        "sphere { 0, 1 pigment { gradient <0, 0, 0> color_map { [0 rgb 0] [1 rgb 1] } } }",
        &["error zero-vector: the gradient's direction is the zero vector, and points nowhere"],
    ),
];

#[test]
fn rows_17_52_54_55_what_has_no_size_no_direction_or_no_number_is_told() {
    let mut faults = Vec::new();
    for (text, expected) in SAID {
        let (_, lines) = said(text);
        if lines != *expected {
            faults.push(format!("    (\n        {text:?},\n        &{lines:?},\n    ),"));
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn row_54_a_number_that_cannot_be_never_loses_an_object_in_silence() {
    let numbers = [
        "1/0",
        "0/0",
        "-1/0",
        "1e400",
        "-1e400",
        "log(0)",
        "ln(0)",
        "ln(-1)",
        "pow(-8, 1/3)",
        "acos(1 + 1e-10)",
        "asin(2)",
        "sqrt(-1)",
        "vlength(vnormalize(<0, 0, 0>))",
        "pow(0, 0)",
        "pow(0, -1)",
        "mod(1, 0)",
        "exp(1e9)",
        "1e308*10",
        "tan(1e400)",
        "atan2(0, 0)",
    ];
    let places = [
        "sphere { 0, # }",
        "sphere { #*x, 1 }",
        "plane { y, # }",
        "box { 0, # }",
        "sphere { 0, 1 scale # }",
        "sphere { 0, 1 translate # }",
        "sphere { 0, 1 rotate # }",
        "sphere { 0, 1 pigment { rgb # } }",
        "sphere { 0, 1 finish { phong # } }",
        "sphere { 0, 1 matrix <#,0,0, 0,1,0, 0,0,1, 0,0,0> }",
        "$declare A = #; sphere { 0, 1 + 0*A }",
        "sphere { 0, 1 } camera { location #*x }",
        "sphere { 0, 1 } camera { location -5*z look_at #*y }",
        "sphere { 0, 1 } camera { location -5*z angle # }",
        "sphere { 0, 1 } light_source { #*y, rgb 1 }",
        "sphere { 0, 1 } light_source { 9*y, rgb # }",
        "sphere { 0, 1 } light_source { 9*y, rgb 1 spotlight radius # falloff 30 }",
        "sphere { 0, 1 interior { ior # } pigment { rgbf 1 } }",
        "sphere { 0, 1 finish { reflection # } }",
        "sphere { 0, 1 pigment { checker rgb 0, rgb 1 scale # } }",
        "cylinder { 0, #*y, 1 }",
        "cone { 0, 1, y, # }",
        "torus { 1, # }",
        "disc { 0, y, # }",
        "triangle { 0, x, #*y }",
        "quadric { <1, 1, 1>, <0, #, 0>, <0, 0, 0>, -1 }",
        "superellipsoid { <1, #> }",
        "julia_fractal { <0, #, 0, 0> max_iteration 3 slice <0, 0, #, 1>, # }",
        "blob { threshold 0.5 sphere { 0, #, 1 } }",
        "lathe { linear_spline 3, <0, 0>, <1, #>, <0, 2> }",
        "prism { 0, #, 4, <0, 0>, <1, 0>, <0, 1>, <0, 0> }",
        "polygon { 4, <0, 0>, <1, 0>, <0, #>, <0, 0> }",
        "mesh { triangle { 0, x, #*y } triangle { 0, x, z } }",
    ];
    for number in numbers {
        for place in places {
            let (world, lines) = said(&place.replace('#', number).replace('$', "#"));
            let told = lines.iter().any(|line| line.starts_with("error"));
            assert!(told || world.objects.len() == 2, "{number} in {place}: {lines:?}");
            let finite = world.spheres.iter().all(|s| s.radius.is_finite() && s.centre.is_finite());
            assert!(finite, "{number} in {place}");
            assert!(told || !format!("{world:?}").contains("NaN"), "{number} in {place}");
        }
    }
    // In a function it is a value: what is nowhere by that is told.
    for number in ["1/0", "0/0", "1e400", "log(0)", "ln(-1)", "asin(2)", "sqrt(-1)", "exp(1e9)"] {
        for function in ["x + #", "#*x", "max(#, x)", "sin(#)", "x*x + y + # - 2"] {
            let written = function.replace('#', number);
            let (world, lines) = said(&format!(
                "isosurface {{ function {{ {written} }} contained_by {{ box {{ -1, 1 }} }} }}"
            ));
            let told = lines.iter().any(|line| {
                line.starts_with("error") || line.contains("there is nothing of this isosurface")
            });
            assert!(told || world.objects.len() == 2, "{written}: {lines:?}");
            // -1/0 is inside of everything, and the larger of x and no number is x.
            let may_be_seen = number == "log(0)" || function == "#*x" || function == "max(#, x)";
            assert!(told || may_be_seen, "{written}: {lines:?}");
        }
    }
}

#[test]
fn row_56_numbers_are_read_to_the_last_bit() {
    // `#for` runs as often as its steps come out in tenths.
    for (loops, times) in [
        ("#for (I, 0, 1, 0.1)", 11),
        ("#for (I, 0, 2, 0.1)", 21),
        ("#for (I, 1, 0, -0.1)", 11),
        ("#for (I, 0, 0.3, 0.1)", 4),
        ("#for (I, 1, 10)", 10),
        ("#for (I, 0, 0.7, 0.1)", 8),
    ] {
        let (world, _) = compiled(&format!("{loops} sphere {{ 0, 1 + I }} #end"));
        assert_eq!(world.spheres.len(), times, "{loops}");
    }
    // What is not zero is true.
    for (condition, count) in
        [("1e-11", 1), ("1e-320", 1), ("0", 0), ("0*1e-300", 0), ("-1e-30", 1)]
    {
        let (world, _) = compiled(&format!("#if ({condition}) sphere {{ 0, 1 }} #end"));
        assert_eq!(world.spheres.len(), count, "{condition}");
    }
    let radius = |number: &str| compiled(&format!("sphere {{ 0, {number} }}")).0.spheres[0].radius;
    assert_eq!(radius("1e-310"), 1e-310);
    // Decimals are rounded correctly: those half way between two numbers, and random ones.
    let mut dice = Dice(56);
    let mut numbers: Vec<String> = [
        "9007199254740993",
        "9007199254740993.0000001",
        "0.1",
        "5e-324",
        "2.2250738585072011e-308",
        "1.7976931348623157e308",
        "0.500000000000000166533453693773481063544750213623046875",
    ]
    .map(str::to_owned)
    .to_vec();
    for _ in 0..2000 {
        let digits: String = (0..1 + dice.below(25)).map(|_| dice.below(10).to_string()).collect();
        let exponent = dice.below(600) as i32 - 300;
        numbers.push(format!("{}.{digits}e{exponent}", 1 + dice.below(9)));
    }
    let text: String = numbers.iter().map(|n| format!("sphere {{ 0, {n} }}\n")).collect();
    let (world, _) = compiled(&text);
    for (number, sphere) in numbers.iter().zip(&world.spheres) {
        assert_eq!(sphere.radius, number.parse::<f64>().expect("a number"), "{number}");
    }
    assert_eq!(world.spheres.len(), numbers.len());
}

/// The entries of a matrix given by its columns.
fn wide(columns: [f64; 9]) -> WideMap {
    let row = |i: usize| WideVector::of([columns[i], columns[3 + i], columns[6 + i]]);
    WideMap { rows: [row(0), row(1), row(2)], offset: WideVector::of([0.0; 3]) }
}

/// The largest sum of a row's absolute entries.
fn norm(map: &WideMap) -> f64 {
    let sum = |row: &WideVector| row.0.iter().map(|c| c.abs().to_f64()).sum::<f64>();
    map.rows.iter().map(sum).fold(0.0, f64::max)
}

#[test]
fn row_53_an_inverse_undoes_to_within_the_condition_of_its_map() {
    let mut dice = Dice(53);
    let number = |dice: &mut Dice| dice.between(-1.0, 1.0);
    let mut text = String::new();
    for n in 0..1500 {
        let [a, b, c, d, e, f] = [0; 6].map(|_| number(&mut dice));
        let mut rows = [[a, b, c], [d, e, f], [0; 3].map(|_| number(&mut dice))];
        if n % 3 == 0 {
            // Nearly flat.
            let thin = ten(-1 - (n % 9));
            rows[2] = std::array::from_fn(|i| rows[0][i] + thin * rows[2][i]);
        }
        let size = dice.size(-9.0, 9.0);
        let numbers: Vec<String> =
            rows.iter().flatten().map(|c| format!("{:e}", c * size)).collect();
        text += &format!("sphere {{ 0, 1 matrix <{}, 0, 0, 0> }}\n", numbers.join(", "));
    }
    let (world, _) = compiled(&text);
    assert!(world.ellipsoids.len() > 1400);
    for ellipsoid in &world.ellipsoids {
        let placement = &ellipsoid.placement;
        let there = wide(placement.world_from_local.to_cols_array());
        let back = wide(placement.local_from_world.to_cols_array());
        let condition = norm(&there) * norm(&back);
        let mut product = there.after(&back);
        for (i, row) in product.rows.iter_mut().enumerate() {
            row.0[i] = &row.0[i] - &Wide::one();
        }
        let off = norm(&product);
        assert!(off <= 8.0 * f64::EPSILON * condition, "{off:e} {condition:e} {placement:?}");
    }
}

#[test]
fn a_text_may_be_followed_by_a_negative_thickness_without_a_comma() {
    let text = |letters: &str| format!("text {{ {letters}, 0 pigment {{ rgb 1 }} }}");
    let (meant, _) = compiled(&text("\"Pov\", -0.5"));
    for written in ["\"Pov\" -0.5", "\"Pov\" -1 + 0.5", "\"Pov\" -0.25*2"] {
        assert_eq!(compiled(&text(written)).0, meant, "{written}");
    }
    let (named, _) = compiled(&format!("#declare S = \"Pov\"; {}", text("S -0.5")));
    assert_eq!(named, meant);
}
