//! What may change about a scene, or about how it is traced, without changing its picture.
//!
//! That this holds to the last byte for all that a scene can hold is tested among the hard cases.

use lucarne::plan::{Antialias, Region};

use super::text::{Shot, apart};

/// A scene of all shapes, some of them mirrors and some of glass, every length of it multiplied by
/// `k`.
fn scene(k: f64) -> String {
    format!("{} {FADING} {CONTENTS}", camera(k, ""))
}

/// The camera with further `steps`, and the background.
fn camera(k: f64, steps: &str) -> String {
    format!(
        "#declare K = {k:e};
         camera {{ location <1, 3, 9>*K look_at <0, 1, 0>*K angle 45 {steps} }}
         background {{ rgb <0.1, 0.2, 0.3> }}
"
    )
}

/// Lights whose widths and distances no transform moves.
const FADING: &str = "light_source { <-3, 4, 3>*K, rgb <0.3, 0.3, 0.1> fade_distance 2*K fade_power 2 }
     light_source { <1, 6, 2>*K, rgb <0.3, 0.2, 0.3> cylinder radius K falloff 2*K point_at <1, 0, 1>*K }
";

/// The last six lines are solids.
const CONTENTS: &str = "light_source { <5, 8, 9>*K, rgb 0.8 }
     light_source { direction <-2, 3, 1> color rgb <0.2, 0.2, 0.4> }
     light_source { <-4, 6, 4>*K, rgb <0.4, 0.3, 0.2> spotlight radius 10 falloff 25 point_at <-1.5, 1, 0>*K }
     plane { y, 0 pigment { checker rgb 0.9 rgb 0.3 scale K } finish { reflection 0.3 } }
     sphere { <-1.5, 1, 0>*K, K pigment { rgb <0.9, 0.3, 0.2> } finish { phong 0.7 reflection 0.2 } }
     sphere { 0, K scale <1, 0.5, 1> rotate 30*z translate <0.2, 2.4, -1>*K pigment { rgb <0.3, 0.8, 0.4> } }
     box { -0.8*K, 0.8*K rotate <20, 30, 0> translate <1.6, 1.2, 0.3>*K pigment { rgb <0.2, 0.4, 0.9> } finish { specular 0.5 } }
     sphere { <0.1, 0.7, 2.5>*K, 0.6*K pigment { rgbf <1, 0.9, 0.8, 0.9> } interior { ior 1.5 } finish { reflection { 0, 1 fresnel } conserve_energy } }
     box { <-2.2, 0.2, 1.9>*K, <-1, 1.1, 2>*K pigment { rgbft <0.5, 0.8, 1, 0.4, 0.4> } }";

const SHOT: (u32, u32) = (64, 48);

fn shot() -> Shot {
    Shot::new(SHOT.0, SHOT.1)
}

#[test]
fn a_power_of_two_times_every_length_changes_no_bit() {
    let one = shot().unrounded(&scene(1.0));
    for power in [-200, -40, -1, 1, 7, 60, 200] {
        assert_eq!(shot().unrounded(&scene(2f64.powi(power))), one, "2^{power}");
    }
    // Planted: one length is left behind.
    let faulty = scene(2.0).replace("scale K }", "scale 1 }");
    assert_ne!(faulty, scene(2.0));
    assert_ne!(shot().unrounded(&faulty), one);
}

#[test]
fn a_power_of_ten_times_every_length_changes_no_pixel_by_much() {
    let one = shot().unrounded(&scene(1.0));
    for k in [1e-9, 1e-3, 1e6, 1e12] {
        assert!(apart(&shot().unrounded(&scene(k)), &one) < 1e-6, "{k}");
    }
    let faulty = scene(1e3).replace("translate <1.6", "translate <1.601");
    assert!(apart(&shot().unrounded(&faulty), &one) > 1e-6);
}

#[test]
fn threads_change_no_bit() {
    for antialias in [Antialias::Off, Antialias::Grid(2), Antialias::default()] {
        let with = |threads| Shot { antialias, threads, ..shot() }.of(&scene(1.0));
        let one = with(1);
        for threads in [2, 3, 7] {
            assert_eq!(with(threads), one, "{threads} threads");
        }
    }
    // Planted: other samples.
    let grid = |n| Shot { antialias: Antialias::Grid(n), ..shot() }.of(&scene(1.0));
    assert_ne!(grid(2), grid(3));
}

#[test]
fn a_region_is_a_crop() {
    for antialias in [Antialias::Off, Antialias::default()] {
        let shot = Shot { antialias, ..shot() };
        let whole = shot.of(&scene(1.0));
        let crop = |x: u32, y: u32, width: u32, height: u32| -> Vec<_> {
            (y..y + height)
                .flat_map(|row| (x..x + width).map(move |column| row * SHOT.0 + column))
                .map(|pixel| whole[pixel as usize])
                .collect()
        };
        let region = Region { x: 13, y: 9, width: 29, height: 31 };
        let part = shot.region(region).of(&scene(1.0));
        assert_eq!(part, crop(13, 9, 29, 31));
        // Planted: off by one.
        assert_ne!(part, crop(14, 9, 29, 31));
    }
}

#[test]
fn the_order_of_objects_does_not_matter() {
    let text = scene(1.0);
    let mut lines: Vec<&str> = text.lines().collect();
    let solids = lines.len() - 6..;
    lines[solids].reverse();
    assert_eq!(shot().unrounded(&lines.join("\n")), shot().unrounded(&text));
    // Planted: one is lost on the way.
    lines.pop();
    assert_ne!(shot().unrounded(&lines.join("\n")), shot().unrounded(&text));
}

#[test]
fn a_light_is_the_sum_of_its_parts() {
    let split = |share: f64| {
        let text = scene(1.0);
        let light = "light_source { <5, 8, 9>*K, rgb 0.8 }";
        assert!(text.contains(light));
        let part = |weight: f64| format!("light_source {{ <5, 8, 9>*K, rgb 0.8*{weight} }}");
        text.replace(light, &format!("{} {}", part(share), part(1.0 - share)))
    };
    let one = shot().unrounded(&scene(1.0));
    assert!(apart(&shot().unrounded(&split(0.3)), &one) < 1e-12);
    let faulty = split(0.3).replace("0.8*0.3", "0.8*0.30001");
    assert!(apart(&shot().unrounded(&faulty), &one) > 1e-12);
}

#[test]
fn what_nobody_sees_changes_nothing() {
    let hidden = "sphere { <0, 40, 200>, 1 no_shadow }";
    let text = format!("{}\n{hidden}", scene(1.0));
    let one = shot().unrounded(&scene(1.0));
    assert_eq!(shot().unrounded(&text), one);
    let faulty = text.replace("<0, 40, 200>", "<0, 1, 2>");
    assert_ne!(shot().unrounded(&faulty), one);
}

#[test]
fn a_scene_moved_together_with_its_camera_looks_the_same() {
    let one = shot().unrounded(&format!("{} {CONTENTS}", camera(1.0, "")));
    let moved = |camera_steps: &str, steps: &str| {
        shot().unrounded(&format!("{} union {{ {CONTENTS} {steps} }}", camera(1.0, camera_steps)))
    };
    for steps in ["rotate 50*y", "translate <10, -20, 30>", "scale 3 rotate <10, 20, 30>"] {
        assert!(apart(&moved(steps, steps), &one) < 1e-9, "{steps}");
        // Planted: the camera stays.
        assert!(apart(&moved("", steps), &one) > 1e-9, "{steps}");
    }
}
