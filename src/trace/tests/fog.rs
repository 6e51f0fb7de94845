//! How far rays go through fog, on scenes of POV-Ray: every length is what POV-Ray 3.7 shows for the same text.

use super::centre;
use crate::math::elementary::log;
use crate::road::{Options, Road};
use crate::scene::Dialect;
use crate::source::NoFiles;

/// How much fog of the distance 10 a ray passes that ends at a white surface.
fn fogged(text: &str) -> f64 {
    let clear = "pigment { rgbt <0, 0, 0, 1> } finish { ambient 0 }";
    let text = format!(
        "#version 3.7; global_settings {{ assumed_gamma 1 max_trace_level 20 }}
         #default {{ finish {{ ambient 1 diffuse 0 }} }} fog {{ distance 10 rgb <0, 1, 0> }}
         camera {{ orthographic location -10*z direction z right 0.01*x up 0.01*y }}
         {}",
        text.replace("CLEAR", clear)
    );
    let mut road = Road::new(&NoFiles, Options::new(Dialect::Pov));
    let (world, _) = road.compile("a.pov", text.clone().into_bytes());
    assert!(!road.diagnostics.has_errors(), "{text}");
    -10.0 * log(centre(&world).red)
}

fn assert_fogged(cases: &[(&str, f64)], end: &str) {
    for (text, length) in cases {
        let ours = fogged(&format!("{text} {end}"));
        assert!((ours - length).abs() < 0.01, "{text}: {ours}, not {length}");
    }
}

#[test]
fn a_ray_passes_no_fog_in_a_solid_that_is_not_hollow() {
    let cases = [
        ("", 30.0),
        ("sphere { 0, 2 CLEAR }", 26.0),
        ("sphere { 0, 2 CLEAR hollow }", 30.0),
        ("sphere { 0, 2 CLEAR interior { ior 1 } }", 26.0),
        ("sphere { 0, 2 CLEAR } sphere { 0, 1 CLEAR hollow }", 26.0),
        ("sphere { 0, 2 CLEAR hollow } sphere { 0, 1 CLEAR }", 28.0),
        ("sphere { 0, 2 CLEAR } sphere { z, 2 CLEAR }", 25.0),
        ("sphere { 0, 2 CLEAR } sphere { z, 2 CLEAR hollow }", 26.0),
        ("union { sphere { 0, 2 hollow } sphere { 6*z, 2 } CLEAR }", 22.0),
        ("difference { sphere { 0, 2 } sphere { 0, 1 } CLEAR }", 28.0),
        ("intersection { sphere { 0, 2 } sphere { 0, 2.2 hollow } CLEAR }", 30.0),
        // What is entered and never left.
        ("triangle { <-1, -1, 0>, <1, -1, 0>, <0, 1, 0> CLEAR }", 10.0),
        ("disc { 0, z, 1 CLEAR }", 10.0),
        ("cylinder { -2*z, 2*z, 2 open CLEAR }", 30.0),
        ("sphere { 0, 2 clipped_by { plane { z, 0 } } CLEAR }", 8.0),
        ("sphere { 0, 2 clipped_by { plane { -z, 0 } } CLEAR }", 12.0),
    ];
    assert_fogged(&cases, "plane { -z, -20 pigment { rgb 1 } hollow }");
}

#[test]
fn a_camera_in_a_solid_sees_fog_only_behind_it() {
    let cases = [
        ("sphere { -10*z, 2 CLEAR }", 28.0),
        ("sphere { -10*z, 2 CLEAR hollow }", 30.0),
        ("sphere { -10*z, 2 CLEAR hollow } sphere { -10*z, 3 CLEAR }", 27.0),
        ("sphere { -10*z, 2 no_image CLEAR }", 0.0),
        ("plane { z, -5 CLEAR }", 25.0),
        ("plane { z, -5 inverse CLEAR }", 5.0),
        // It contains only what is within its bounds.
        ("sphere { 0, 2 inverse CLEAR }", 26.0),
        ("box { -2, 2 inverse CLEAR }", 26.0),
        ("difference { plane { -z, 100 } sphere { 0, 2 } CLEAR }", 4.0),
    ];
    assert_fogged(&cases, "plane { -z, -20 pigment { rgb 1 } hollow }");
}

#[test]
fn mirrored_rays_pass_fog_too() {
    let cases = [
        ("", 50.0),
        ("sphere { 0, 2 CLEAR }", 42.0),
        ("sphere { -10*z, 2 CLEAR }", 44.0),
        ("sphere { 5*z, 2 CLEAR }", 46.0),
    ];
    let mirror = "plane { -z, -5 pigment { rgb 0 } finish { ambient 0 reflection 1 } }";
    assert_fogged(&cases, &format!("{mirror} plane {{ z, -30 pigment {{ rgb 1 }} }}"));
}

#[test]
fn light_passes_fog_only_if_media_attenuate_it() {
    let lit = "plane { -z, 9.99 hollow pigment { rgb 1 } finish { ambient 0 diffuse 1 } }";
    // The camera is a hundredth off the surface.
    let light = |items: &str| format!("light_source {{ <0, 0, -50> rgb 1 {items} }}");
    for (items, object, length) in [
        ("", "", 0.01),
        ("media_attenuation on", "", 40.02),
        ("media_attenuation on media_interaction off", "", 0.01),
        ("media_attenuation on shadowless", "", 0.01),
        ("media_attenuation on parallel point_at 0", "", 40.02),
        ("media_attenuation on", "sphere { -20*z, 2 CLEAR }", 36.02),
        ("media_attenuation on", "sphere { -20*z, 2 CLEAR hollow }", 40.02),
        ("media_attenuation on", "sphere { -20*z, 2 CLEAR no_shadow }", 40.02),
        ("media_attenuation on", "sphere { -50*z, 2 CLEAR }", 38.02),
    ] {
        assert_fogged(&[(&format!("{} {object}", light(items)), length)], lit);
    }
}
