//! Lights that shine through an object, on scenes of POV-Ray: every brightness is what POV-Ray 3.7 shows.

use super::centre;
use crate::road::{Options, Road};
use crate::scene::Dialect;
use crate::source::NoFiles;

/// How bright the ground is that a camera looks down on.
fn brightness(text: &str) -> f64 {
    let text = format!(
        "#version 3.7; global_settings {{ assumed_gamma 1 }}
         #default {{ pigment {{ rgb 1 }} finish {{ ambient 0 diffuse 1 }} }}
         camera {{ orthographic location <0.01, 0.5, 0.01> direction -y up 0.001*z right 0.001*x }}
         plane {{ y, 0 }} {text}"
    );
    let mut road = Road::new(&NoFiles, Options::new(Dialect::Pov));
    let (world, _) = road.compile("a.pov", text.clone().into_bytes());
    assert!(!road.diagnostics.has_errors(), "{text}");
    centre(&world).red
}

/// A light 10 above the ground; `items` stand before its object.
fn light(items: &str, object: &str) -> String {
    format!("light_source {{ 10*y rgb 1 {items} projected_through {{ {object} }} }}")
}

fn assert_bright(cases: &[(String, f64)]) {
    for (text, theirs) in cases {
        let ours = brightness(text);
        assert!((ours - theirs).abs() < 1e-4, "{text}: {ours}, not {theirs}");
    }
}

#[test]
fn it_shines_where_the_way_to_it_meets_its_object() {
    let ball = "sphere { 5*y, 1 }";
    let beside = "sphere { <3, 5, 0>, 1 }";
    let cases = [
        (light("", ball), 1.0),
        (light("", beside), 0.0),
        (light("shadowless", beside), 0.0),
        (light("spotlight point_at 0", ball), 1.0),
        (light("spotlight point_at 0", beside), 0.0),
        (light("parallel point_at 0", ball), 1.0),
        (light("parallel point_at 0", beside), 0.0),
        (light("parallel point_at 0", "sphere { 15*y, 1 }"), 0.0),
        // Beyond the light, and below the ground.
        (light("", "sphere { 15*y, 1 }"), 0.0),
        (light("", "sphere { -5*y, 1 }"), 0.0),
        // Around the light, the ground, and both.
        (light("", "sphere { 10*y, 1 }"), 1.0),
        (light("", "sphere { 0, 0.3 }"), 1.0),
        (light("", "sphere { 0, 30 }"), 0.0),
        (light("", "disc { 5*y, y, 1 }"), 1.0),
        (light("", "plane { y, 5 }"), 1.0),
        (light("", "sphere { 5*y, 1 inverse }"), 1.0),
        (light("", "sphere { 5*y, 1 pigment { rgbt 1 } hollow no_shadow }"), 1.0),
        (light("", "difference { sphere { 5*y, 1 } cylinder { 0, 9*y, 0.2 } }"), 0.0),
        (light("", "light_source { 5*y rgb 1 }"), 0.0),
        (light("fade_distance 2 fade_power 2", ball), 0.076_923),
    ];
    assert_bright(&cases);
}

#[test]
fn only_what_is_before_the_object_casts_a_shadow() {
    let ball = "sphere { 5*y, 1 }";
    let around = "sphere { 10*y, 1 }";
    let two = "union { sphere { 3*y, 0.5 } sphere { 7*y, 0.5 } }";
    let mut cases = Vec::new();
    for (object, heights) in [
        (ball, &[(1.0, 0.0), (3.0, 0.0), (4.5, 1.0), (5.5, 1.0), (8.0, 1.0), (12.0, 1.0)][..]),
        (around, &[(1.0, 0.0), (8.0, 0.0), (9.5, 1.0)]),
        (two, &[(1.0, 0.0), (3.0, 1.0), (5.0, 1.0), (7.0, 1.0), (9.0, 1.0)]),
    ] {
        for (height, bright) in heights {
            let sphere = format!("sphere {{ {height}*y, 0.05 no_image }}");
            cases.push((format!("{} {sphere}", light("", object)), *bright));
        }
    }
    // The object itself casts none, if it is in the scene, too.
    let own = format!("#declare S = {ball} object {{ S no_image }} {}", light("", "S"));
    cases.push((own, 1.0));
    cases.push((format!("{} sphere {{ 1*y, 0.05 no_image }}", light("shadowless", ball)), 1.0));
    let glass = "sphere { 8*y, 0.4 pigment { rgbf <1, 0.5, 0, 0.7> } no_image }";
    cases.push((format!("{} {glass}", light("", ball)), 1.0));
    assert_bright(&cases);
}

#[test]
fn transforms_behind_the_object_move_it_with_the_light() {
    let light = |items: &str| format!("light_source {{ <3, 10, 0> rgb 1 {items} }}");
    let through = |x: f64| format!("projected_through {{ sphere {{ <{x}, 5, 0>, 1 }} }}");
    let cases = [
        (light(&format!("{} translate -3*x", through(3.0))), 1.0),
        (light(&format!("translate -3*x {}", through(3.0))), 0.0),
        (light(&format!("translate -3*x {}", through(0.0))), 1.0),
        (format!("union {{ {} translate -3*x }}", light(&through(3.0))), 1.0),
    ];
    assert_bright(&cases);
}

#[test]
fn an_area_light_shines_by_each_of_its_nodes_through_the_object() {
    let area = "area_light 4*x, 4*z, 17, 17";
    let screen = |from: f64| format!("box {{ <{from}, 4, -9>, <9, 5, 9> }}");
    let mut cases = Vec::new();
    for (from, bright) in [(-1.0, 1.0), (-0.5, 0.8437), (0.0, 0.5312), (0.5, 0.2813), (1.2, 0.0)] {
        for items in [area, &format!("{area} adaptive 1"), &format!("{area} shadowless")] {
            cases.push((light(items, &screen(from)), bright));
        }
    }
    let half = "box { <-9, 4, -9>, <0, 5, 9> }";
    let occluder = "box { <0, 2, -9>, <9, 2.1, 9> no_image }";
    cases.push((format!("{} {occluder}", light(area, half)), 0.4688));
    let occluder = "box { <-0.5, 2, -9>, <9, 2.1, 9> no_image }";
    cases.push((format!("{} {occluder}", light(area, half)), 0.0));
    cases.push((format!("{} {occluder}", light(&format!("{area} shadowless"), half)), 0.4688));
    cases.push((light(&format!("{area} area_illumination"), "sphere { 5*y, 0.3 }"), 0.0808));
    assert_bright(&cases);
}
