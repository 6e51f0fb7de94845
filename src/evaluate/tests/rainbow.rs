//! Rainbows as they are read.

use super::{VERSION, assert_alike, world};

fn rainbow(items: &str) -> String {
    let colors = "color_map { [0 rgb <1, 0, 0>] [1 rgbt <0, 0, 1, 0.5>] }";
    format!("rainbow {{ direction <1, -2, 3> angle 42 width 5 {colors} {items} }}")
}

#[test]
fn rainbows_that_mean_the_same_are_the_same() {
    assert_alike(&rainbow("direction <2, -4, 6>"), &rainbow(""));
    assert_alike(&rainbow("distance 1e7 jitter 0 up y"), &rainbow(""));
    // What counts of `up` is at right angles to the axis.
    assert_alike(&rainbow("up 7*y"), &rainbow(""));
    assert_alike(&rainbow("angle 10 width 3"), &rainbow("width 3 angle 10"));
    assert_alike(
        &rainbow("arc_angle 90 falloff_angle 90"),
        &rainbow("falloff_angle 90 arc_angle 90"),
    );
    assert_alike(
        &format!("#declare R = {} rainbow {{ R width 7 }}", rainbow("")),
        &rainbow("width 7"),
    );
    assert_alike(
        &format!("#declare R = {} rainbow {{ R }} rainbow {{ R }}", rainbow("")),
        &rainbow("").repeat(2),
    );
}

#[test]
fn a_rainbow_that_no_ray_sees_is_left_out() {
    let shown = |items: &str| {
        let (world, said) = world(&format!("{VERSION} {}", rainbow(items)));
        assert_eq!(said, "", "{items}");
        world.rainbows.len()
    };
    for (items, count) in [
        ("", 1),
        ("distance 0", 0),
        ("angle 95 width 5", 0),
        ("angle 92 width 5", 1),
        ("angle 95 width 5 jitter 1", 1),
        ("angle -3 width 5", 0),
        ("angle -3 width -5", 0),
        ("angle -2 width 5", 1),
        ("distance -3", 1),
    ] {
        assert_eq!(shown(items), count, "{items}");
    }
}
