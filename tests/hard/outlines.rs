//! Prisms and lathes whose outlines are met where they hardly tell: along a wall, where pieces join, beside their points.

use std::ops::Range;

use super::held::rendered;

const PIXELS: (u32, u32) = (41, 31);

/// The camera is at `from`, looks along `way`, and sees from −2 to 2 across.
fn seen(from: &str, way: &str, things: &str) -> Vec<[i32; 3]> {
    let text = format!(
        "#declare From = {from}; #declare Way = {way};
        #declare Up = vnormalize(vcross(vcross(Way, y + 0.001*z), Way));
        camera {{ orthographic location From direction Way right vcross(Up, Way)*4.1 up Up*3.1 }}
        background {{ rgb <0, 0, 0.3> }} light_source {{ <3000, 5000, 8000>, rgb 1 parallel point_at 0 shadowless }}
        #default {{ pigment {{ rgb <1, 1, 0.2> }} finish {{ ambient 0.3 diffuse 0.7 }} }} {things}"
    );
    look(&text)
}

fn look(text: &str) -> Vec<[i32; 3]> {
    let film = rendered(text, PIXELS);
    let thousandths = |c: f64| (c * 1e3).round() as i32;
    film.radiances().map(|c| [c.red, c.green, c.blue].map(thousandths)).collect()
}

/// How many pixels of two pictures are not the same.
fn differing(one: &[[i32; 3]], other: &[[i32; 3]]) -> usize {
    let differ = |(a, b): &(&[i32; 3], &[i32; 3])| (0..3).any(|i| (a[i] - b[i]).abs() > 2);
    one.iter().zip(other).filter(differ).count()
}

/// What is behind has no red.
fn lit(picture: &[[i32; 3]]) -> Vec<bool> {
    picture.iter().map(|[red, ..]| *red > 0).collect()
}

#[test]
fn rays_along_a_wall_of_what_narrows_see_the_pyramid_that_its_planes_make() {
    let prism = "prism { linear_spline conic_sweep 0, 1, 5,
        <-1, -0.3>, <0.5, -0.3>, <0.5, 0.3>, <-1, 0.3>, <-1, -0.3>";
    let planes = "intersection { plane { <-1, -1, 0>, 0 } plane { <1, -0.5, 0>, 0 }
        plane { <0, -0.3, 1>, 0 } plane { <0, -0.3, -1>, 0 } plane { y, 1 }";
    for turn in [0, 30, 77] {
        for operation in ["difference", "intersection", "merge"] {
            let of = |solid: &str| {
                let from = format!("vrotate(<4.01, -3.99, 0.013>, {turn}*z)");
                let way = format!("vrotate(<-1, 1, 0>, {turn}*z)");
                let whole = format!("box {{ -0.9, 0.9 }} {solid} }} rotate {turn}*z");
                seen(&from, &way, &format!("{operation} {{ {whole} }}"))
            };
            let (one, other) = (of(prism), of(planes));
            assert!(lit(&other).contains(&true), "{operation}");
            assert_eq!(differing(&one, &other), 0, "{operation} {turn}");
        }
    }
}

/// Those along the axis are so to the wall's line through 0, where the outline passes.
#[test]
fn a_wall_that_narrows_is_lit_alike_from_near_and_far() {
    let prism =
        "prism { quadratic_spline conic_sweep 0.25, 1, 7, <-0.7, 0.3>, <-0.3, -0.5>, <0, 0>,
        <-1, -0.7>, <-0.7, 0>, <-0.7, 0.3>, <-0.3, -0.5> rotate 90*z }";
    let [near, far] = [4, 1000].map(|far| {
        let camera = format!("camera {{ orthographic location {far}*x direction -x right -4.1*z up 3.1*y }}");
        look(&format!(
            "{camera} light_source {{ <3000, 5000, 8000>, rgb 1 parallel point_at 0 shadowless }} {prism}"
        ))
    });
    assert_eq!(differing(&near, &far), 0);
}

/// The outline turns along an axis just at a joint, where the rays of one column pass.
#[test]
fn what_a_ray_meets_at_a_joint_is_there_alone_and_in_a_whole() {
    let cubic = "prism { cubic_spline linear_sweep -0.7, 1, 9, <-0.5, 0>, <0.5, -0.7>, <0.3, 0>,
        <-0.5, 1>, <0.25, 0.7>, <-0.7, -0.5>, <-0.5, 0>, <0.5, -0.7>, <0.3, 0>";
    let camera = "camera { orthographic location <0, 4, 4> direction <0, -0.7071067811865475, -0.7071067811865475>
        right 4.1*x up <0, 2.192031021678297, -2.192031021678297> } #default { finish { emission 1 } }";
    let quadratic = "prism { quadratic_spline linear_sweep -0.5, 0.25, 5,
        <-0.35000000000000030, -0.6062177826491069>, <1, 0>, <-0.34999999999999980, 0.6062177826491071>,
        <-0.35000000000000030, -0.6062177826491069>, <1, 0>";
    let near = "camera { location 4*z direction -z right 1.025*x up 0.775*y } #default { finish { emission 1 } }";
    for (camera, prism, lost) in [(camera, cubic, (25, 5..15)), (near, quadratic, (30, 13..18))] {
        let red = "pigment { rgb x }";
        let alone = lit(&look(&format!("{camera} {prism} {red} }}")));
        let far = "sphere { <50, 60, 70>, 1 }";
        let whole = look(&format!("{camera} difference {{ {prism} }} {far} {red} }}"));
        assert_eq!(alone, lit(&whole), "{prism}");
        assert!(lost.1.into_iter().all(|y: usize| alone[y * 41 + lost.0]), "{prism}");
    }
}

#[test]
fn walls_that_two_share_are_whole_whatever_words_make_them_straight() {
    // From 0 to −1/2 and to 1/2 along z, from −1 to 1 along x.
    let corners = |side: f64| [(-1.0, 0.0), (1.0, 0.0), (1.0, side), (-1.0, side)];
    let written = |side: f64, shares: [f64; 2]| {
        let corners = corners(side);
        let mut text = String::new();
        for i in 0..4 {
            let ((a, b), (c, d)) = (corners[i], corners[(i + 1) % 4]);
            for share in [0.0, shares[0], shares[1], 1.0] {
                text += &format!(", <{}, {}>", a + share * (c - a), b + share * (d - b));
            }
        }
        format!("prism {{ bezier_spline -1, 1, 16 {text} }}")
    };
    for shares in [[1.0 / 3.0, 2.0 / 3.0], [0.0, 1.0], [0.25, 0.5], [0.0, 0.0]] {
        for turn in [0, 33] {
            let both = format!(
                "union {{ {} {} rotate {turn}*<1, 2, 3> }}",
                written(-0.5, shares),
                written(0.5, shares)
            );
            let whole = format!("box {{ <-1, -1, -0.5>, <1, 1, 0.5> rotate {turn}*<1, 2, 3> }}");
            let [both, whole] = [both, whole].map(|things| {
                let turned = |way: &str| format!("vrotate({way}, {turn}*<1, 2, 3>)");
                lit(&seen(&turned("-4*x"), &turned("x"), &things))
            });
            assert_eq!(both, whole, "{shares:?} {turn}");
        }
    }
}

/// Its first piece rises all the way, but its second point lies above its end.
#[test]
fn a_prism_is_whole_beside_control_points_that_lie_beyond_the_ends_of_a_piece() {
    let all = [(-1.0, -0.5), (-0.3, 0.5), (0.3, 0.0), (1.0, 0.3)];
    let at = |u: f64| {
        let shares =
            [(1.0 - u).powi(3), 3.0 * u * (1.0 - u).powi(2), 3.0 * u * u * (1.0 - u), u.powi(3)];
        let sum = |part: fn(&(f64, f64)) -> f64| {
            all.iter().zip(shares).map(|(p, s)| s * part(p)).sum::<f64>()
        };
        (sum(|p| p.0), sum(|p| p.1))
    };
    let written = |points: &[(f64, f64)]| {
        points.iter().map(|(x, z)| format!(", <{x}, {z}>")).collect::<String>()
    };
    let corners = [(1.0, 0.3), (1.0, 0.9), (-1.0, 0.9), (-1.0, -0.5)];
    let walls: Vec<_> =
        corners.windows(2).flat_map(|pair| [pair[0], pair[0], pair[1], pair[1]]).collect();
    let curved = format!("bezier_spline S 0.3, 1, 16 {} {}", written(&all), written(&walls));
    let steps: Vec<_> = (0..=256)
        .map(|i| at(f64::from(i) / 256.0))
        .chain([corners[1], corners[2], at(0.0)])
        .collect();
    let straight = format!("linear_spline S 0.3, 1, {} {}", steps.len(), written(&steps));
    for (sweep, camera) in [
        // From the tip each ray sees but one place of the outline.
        ("conic_sweep", "location 0 direction y"),
        ("linear_sweep", "orthographic location 4*y direction -y"),
    ] {
        let [curved, straight] = [&curved, &straight].map(|words| {
            let words = words.replace('S', sweep);
            lit(&look(&format!(
                "camera {{ {camera} right 2.03*x up -1.57*z }}
                prism {{ {words} pigment {{ rgb x }} finish {{ emission 1 }} }}"
            )))
        });
        assert!(straight.iter().filter(|lit| **lit).count() > 500);
        assert_eq!(curved, straight, "{sweep}");
    }
}

/// What is not there to be seen faces no way.
#[test]
fn an_open_end_that_is_grazed_in_a_whole_is_nothing() {
    let prism =
        "prism { linear_spline conic_sweep -1, 1, 4, <0.5, -1>, <-0.5, 0>, <0.5, 0>, <0.5, -1> open
        matrix <1, 0, 0, 0.5, 1, 0, 0, 0, 1, 0, 0, 0> }";
    let camera = "camera { orthographic location -8*y direction y right 4.1*x up 3.1*z }";
    let picture = look(&format!(
        "{camera} intersection {{ {prism} box {{ -3, 3 }} pigment {{ rgb x }} finish {{ emission 1 }} }}"
    ));
    assert!(lit(&picture).contains(&true));
}

/// What of a row of pixels is seen, and where: no farther than 8 from the origin.
fn column(
    camera: &str,
    things: &str,
    size: (u32, u32),
    (x, ys): (u32, Range<u32>),
) -> Vec<[i32; 3]> {
    let film = rendered(
        &format!(
            "camera {{ {camera} }} #default {{ pigment {{ gradient <1, 0.7, -0.4> colour_map {{ [0 rgb x] [1 rgb x + y] }}
            scale 16 translate -8.3 }} finish {{ emission 1 }} }} {things}"
        ),
        size,
    );
    let thousandths = |c: f64| (c * 1e3).round() as i32;
    ys.map(|y| film.radiance(film.index(x, y)))
        .map(|c| [c.red, c.green, c.blue].map(thousandths))
        .collect()
}

/// A camera, things, the picture's size, and which pixels of a column are looked at.
type Row<'a> = (&'a str, &'a str, (u32, u32), (u32, Range<u32>));

#[test]
fn a_ray_in_a_wall_sees_what_one_a_little_beside_it_sees() {
    let rows: [Row; 7] = [
        // Through the tip, where two share a wall.
        (
            "orthographic location <3.118389338327481, -3.118389338327481, 1.0914362684146184>
             direction <-0.6863982230545802, 0.6863982230545802, -0.24023937806910306> right
             <1.09015640160275, 0, -3.1147325760078575> up <1.6196567465621277,
             1.8180646980159882, 0.5668798612967446>",
            "merge { prism { linear_spline conic_sweep -1, 1, 5 <-1, -0.5>, <1.5, -0.5>, <1, 0.5>,
             <-1, 0>, <-1, -0.5> } prism { bezier_spline conic_sweep 0.5, 1, 12 <-1, 0>, <-1.1375,
             0.012499999999999997>, <-1.2625, -0.1125>, <-1.25, -0.25>, <-1.25, -0.25>, <-1.1875,
             -0.3125>, <-1.0625, -0.4375>, <-1, -0.5>, <-1, -0.5>, <-1, -0.5>, <-1, 0>, <-1, 0> }
             }",
            (33, 25),
            (16, 12..13),
        ),
        // Where the wall ends, with another at a sharp angle.
        (
            "location <1.4494897427831783, -1.9494897427831783, 3.3989794855663567> direction
             <-2.4494897427831783, 2.4494897427831783, -4.898979485566357> right
             <2.9516097302997224, 0, -1.4758048651498612> up <0.45643546458763845,
             2.282177322938192, 0.9128709291752769>",
            "merge { prism { linear_spline linear_sweep -1, 0, 4 <-1, -1.5>, <0.5, -0.5>, <0,
             0.5>, <-1, -1.5> } prism { linear_spline linear_sweep -1, 0, 4 <0, 0.5>, <-2.5, 0.5>,
             <-1, -1.5>, <0, 0.5> } }",
            (33, 25),
            (16, 20..25),
        ),
        (
            "orthographic location <3, -3.5, -5.5> direction <-0.3333333333333333,
             0.6666666666666666, 0.6666666666666666> right <-3.6895121628746534, 0,
             -1.8447560814373267> up <0.9316949906249125, 2.3292374765622808, -1.863389981249825>",
            "union { difference { prism { bezier_spline linear_sweep -1, 0, 16 <-1, 0.5>, <-1.2,
             -0.175>, <-0.7, -0.925>, <0, -1>, <0, -1>, <0.125, -0.375>, <0.375, 0.875>, <0.5,
             1.5>, <0.5, 1.5>, <0.5, 1.5>, <-0.5, 1.5>, <-0.5, 1.5>, <-0.5, 1.5>, <-0.625, 1.25>,
             <-0.875, 0.75>, <-1, 0.5> } prism { linear_spline linear_sweep -1, 0, 4 <0.5, 1.5>,
             <0, 2>, <-0.5, 1.5>, <0.5, 1.5> } } prism { linear_spline linear_sweep 0, 1, 6 <-1.5,
             -1>, <-1, -1>, <1, -1.5>, <0.5, -0.5>, <0.5, 0.5>, <-1.5, -1> } }",
            (25, 19),
            (12, 12..16),
        ),
        // In an end.
        (
            "orthographic location <0.71650635094611, -0.7410254037844385, -6> direction
             <-5.3028761936245346e-17, -3.0616169978683824e-17, 1> right <-4.124999999999999,
             7.144709581221619, -3.093254551740081e-32> up <5.412658773652742, 3.125,
             3.827021247335479e-16>",
            "union { intersection { prism { bezier_spline linear_sweep -0.5, 0.5, 12 <-0.5, -1>,
             <-0.125, -1.125>, <0.625, -1.375>, <1, -1.5>, <1, -1.5>, <1, -1.5>, <0, 1>, <0, 1>,
             <0, 1>, <-0.125, 0.5>, <-0.375, -0.5>, <-0.5, -1> } prism { bezier_spline
             linear_sweep -1, 0, 16 <0, -1>, <0, -1>, <1, 0>, <1, 0>, <1, 0>, <1.05, 0.55>, <0.55,
             1.05>, <0, 1>, <0, 1>, <-0.1, 1.425>, <-0.6, 1.675>, <-1, 1.5>, <-1, 1.5>, <-0.75,
             0.875>, <-0.25, -0.375>, <0, -1> } } prism { bezier_spline linear_sweep -1, 0, 12
             <0.5, -0.5>, <0.375, -0.125>, <0.125, 0.625>, <0, 1>, <0, 1>, <0, 1>, <-1, 1>, <-1,
             1>, <-1, 1>, <-0.625, 0.625>, <0.125, -0.125>, <0.5, -0.5> } rotate <90, 90, 30>}",
            (33, 25),
            (18, 15..16),
        ),
        (
            "orthographic location <13.589796713911007, 0.16116251292672956, 3013.196938456699>
             direction <-1.7151946081735097, 0.24105488190974614, -2.4494897427831783> right
             <1.7222671243808099, 12.254567350676933, -5.358103097957115e-16> up
             <-7.5801608655880734, 1.0653221352281503, 5.412658773652742>",
            "merge { intersection { prism { linear_spline linear_sweep 0, 1, 5 <1, -1.5>, <0.5,
             0>, <1, 0.5>, <-1, 1>, <1, -1.5> } prism { linear_spline linear_sweep -0.5, 0.5, 4
             <0.5, -1>, <0.5, 1>, <0, 1>, <0.5, -1> } } prism { linear_spline linear_sweep -1, 0,
             4 <0.5, 0>, <1.25, -0.25>, <1, 0.5>, <0.5, 0> } rotate <90, 0, 37> scale 3 translate
             <0, 1, 3000> }",
            (33, 25),
            (16, 3..6),
        ),
        // Along the line through the wall's end.
        (
            "orthographic location <-2.666666666666667, 2.666666666666667, -1.3333333333333335>
             direction <0.6666666666666667, -0.6666666666666667, 0.33333333333333337> right
             <-1.3975424859373686, 0, 2.7950849718747373> up <1.4161763857498668,
             1.7702204821873333, 0.7080881928749334>",
            "prism { linear_spline conic_sweep 0.5, 2, 7 <0.5, 1>, <-1, -1>, <-0.5, 1>, <0.5, 0>,
             <1, 1>, <-1, -0.5>, <0.5, 1> open }",
            (25, 19),
            (13, 7..8),
        ),
        // The wall goes up, down and up again.
        (
            "orthographic location <0, 0, -4> direction <0, 0, 1> right <-3.125, 0, 0> up <0,
             2.375, 0>",
            "prism { bezier_spline linear_sweep -0.5, 0.5, 12 <0, 0.5>, <0, 0.5>, <-1, 0.5>, <-1,
             0.5>, <-1, 0.5>, <1, -1>, <0.5, -1>, <0, 0>, <0, 0>, <0, 0.5>, <0, -0.5>, <0, 0.5> }",
            (25, 19),
            (12, 6..13),
        ),
    ];
    for (camera, things, size, pixels) in rows {
        let here = column(camera, things, size, pixels.clone());
        // The way that all lines are off, whatever they lie in.
        let camera = format!("{camera} translate 1e-7*<1, pow(3, 1/3), pow(5, 1/3)>");
        let beside = column(&camera, things, size, pixels);
        assert!(lit(&beside).iter().all(|lit| *lit), "{things}");
        assert_eq!(differing(&here, &beside), 0, "{things} {here:?} {beside:?}");
    }
}

#[test]
fn from_the_tip_nothing_shows_between_two_that_share_a_wall() {
    let prisms = [-1, 1].map(|side| {
        format!(
            "prism {{ conic_sweep linear_spline 0, 1, 5
            <{side}, -1>, <0, -1>, <0, 1>, <{side}, 1>, <{side}, -1> TURNED }}"
        )
    });
    for turned in
        ["", "rotate 30*y", "matrix <1, 0, 0.5, 0, 1, 0, 0, 0, 1, 0, 0, 0>", "scale <3, 2, 0.7>"]
    {
        let things = prisms.concat().replace("TURNED", turned);
        for whole in [format!("union {{ {things} }}"), format!("merge {{ {things} }}")] {
            let way = match turned.strip_prefix("rotate ") {
                Some(angle) => format!("rotate {angle}"),
                None => String::new(),
            };
            let camera = format!("location 0 direction y right 2.5*x up 0.6*z {way}");
            let middle = column(&camera, &whole, (25, 19), (12, 0..19));
            assert!(lit(&middle).iter().all(|lit| *lit), "{whole}");
        }
    }
}

/// Of a lathe with a gradient, what is seen where rays go right through a joint, and beside that.
#[test]
fn at_a_joint_of_a_lathe_a_pattern_goes_on() {
    let paint = "pigment { gradient <1, 0.7, 0.4> color_map { [0 rgb <1, 0, 0>] [1 rgb <1, 1, 0>] }
        scale 32 translate <-9.92, -8.64, -7.36> } finish { emission 1 }";
    let through_its_corner = "camera { location <-5.656854249492381, 0.5, -5.65685424949238>
            direction <5.656854249492381, 0, 5.65685424949238>
            right <-5.833630944789016, 0, 5.833630944789017> up <0, 6.25, 0> }
        difference { lathe { linear_spline 5 <2, -0.5>, <1, 0>, <0.5, 0>, <1, -0.5>, <2, -0.5> PAINT }
            lathe { linear_spline 4 <0, 0>, <1, 0>, <1, 0.5>, <0, 0.5> PAINT } }";
    let along_its_wall = "camera { orthographic
            location <-3.8417879795455105, 7.01716930964471, 4.296776967065718e-16>
            direction <0.4802234974431888, -0.8771461637055887, -5.370971208832148e-17>
            right <1.5466272758700406e-32, 2.525834023241416e-16, -4.125>
            up <-2.7410817615799647, -1.500698429509965, -9.189127640924194e-17> }
        lathe { linear_spline 5 <2, 1>, <0, 1>, <0.5, 1>, <0.5, -1>, <2, 1> PAINT rotate <61.3, 90, 90> }";
    let nearest_to_its_axis = "camera { location <3.0588908130484103, -3.2981543030055196, 2.401117487215944>
            direction <-3.0588908130484103, 3.2981543030055196, -2.401117487215944>
            right <2.857883832488648, 1.65, 0> up <-0.6002793718039859, 1.0397143707000325, 2.192865409263972> }
        lathe { linear_spline 5 <0, 0.5>, <1, 1>, <0.5, -1>, <1.5, -0.5>, <0, -0.5> PAINT
            rotate <61.3, 0, 30> }";
    for (text, x, y, most) in [
        (through_its_corner, 14, 14, 0.01),
        (through_its_corner, 18, 14, 0.01),
        (along_its_wall, 12, 12, 0.001),
        (nearest_to_its_axis, 26, 17, 0.001),
    ] {
        let film = rendered(&text.replace("PAINT", paint), (33, 25));
        let [here, before, behind] = [x, x - 1, x + 1].map(|x| film.radiance(film.index(x, y)));
        assert!(before.red > 0.5 && behind.red > 0.5, "{text}");
        let middle = 0.5 * (before.green + behind.green);
        assert!((here.green - middle).abs() < most, "{here:?} {before:?} {behind:?} {text}");
    }
}
