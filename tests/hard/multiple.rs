//! Surfaces whose functions have several roots in one: the gradient is 0 all over them.

use super::held::rendered;

const CUBED_PLANE: &str = "polynomial { 3, xyz(3,0,0): 1, xyz(0,3,0): 1, xyz(0,0,3): 1, xyz(2,1,0): 3,
    xyz(2,0,1): 3, xyz(1,2,0): 3, xyz(0,2,1): 3, xyz(1,0,2): 3, xyz(0,1,2): 3, xyz(1,1,1): 6, xyz(2,0,0): -1.5,
    xyz(0,2,0): -1.5, xyz(0,0,2): -1.5, xyz(1,1,0): -3, xyz(1,0,1): -3, xyz(0,1,1): -3, xyz(1,0,0): 0.75,
    xyz(0,1,0): 0.75, xyz(0,0,1): 0.75, xyz(0,0,0): -0.125";

const CUBED_SPHERE: &str = "polynomial { 6, xyz(6,0,0): 1, xyz(0,6,0): 1, xyz(0,0,6): 1, xyz(4,2,0): 3,
    xyz(4,0,2): 3, xyz(2,4,0): 3, xyz(0,4,2): 3, xyz(2,0,4): 3, xyz(0,2,4): 3, xyz(2,2,2): 6, xyz(4,0,0): -3,
    xyz(0,4,0): -3, xyz(0,0,4): -3, xyz(2,2,0): -6, xyz(2,0,2): -6, xyz(0,2,2): -6, xyz(2,0,0): 3,
    xyz(0,2,0): 3, xyz(0,0,2): 3, xyz(0,0,0): -1";

/// How far a pixel is off at most from that of the same surface with simple roots: where it is, which is its red,
/// and how it is lit, which is its blue.
fn off(many: &str, one: &str) -> f64 {
    let seen = |solid: &str| {
        rendered(
            &format!(
                "camera {{ orthographic location <0, 0, 9> direction -z right 4*x up 3*y }}
                 global_settings {{ ambient_light rgb <1, 0, 0> }} background {{ rgb 0 }}
                 light_source {{ <1, 2, 3>*1e4 rgb <0, 0, 1> parallel point_at 0 }}
                 {solid} pigment {{ gradient z color_map {{ [0 rgb 0.25] [1 rgb 0.75] }} scale 16
                 translate -8*z }} finish {{ ambient 1 diffuse 1 }} }}"
            ),
            (40, 30),
        )
    };
    let (many, one) = (seen(many), seen(one));
    let apart = |(a, b): (lucarne::color::Rgb, lucarne::color::Rgb)| {
        (a.red - b.red).abs().max((a.blue - b.blue).abs())
    };
    many.radiances().zip(one.radiances()).map(apart).fold(0.0, f64::max)
}

#[test]
fn a_polynomial_cubed_is_where_it_is_without_and_lit_alike() {
    for (cubed, plain, most) in [
        (CUBED_PLANE, "plane { x + y + z, 0.5/sqrt(3)", 1e-4),
        ("cubic { <0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1,0,0,0>", "plane { z, 0", 1e-6),
        ("polynomial { 5, xyz(0,0,5): 1 translate z/3", "plane { z, 1/3", 1e-6),
        (CUBED_SPHERE, "sphere { 0, 1", 1e-2),
    ] {
        let off = off(cubed, plain);
        assert!(off <= most, "{cubed}: {off}");
    }
}

#[test]
fn an_isosurface_whose_gradient_is_0_all_over_is_lit_as_one_that_rises() {
    let iso = |function: &str| {
        format!("isosurface {{ function {{ {function} }} contained_by {{ box {{ -5, 5 }} }}")
    };
    let (ball, tilted) = ("(sqrt(x*x + y*y + z*z) - 1)", "(z + 0.5*x + 0.25*y - 0.5)");
    for (many, plain) in [
        (format!("pow({ball}, 3)"), ball),
        (format!("pow({tilted}, 3)"), tilted),
        (format!("pow({tilted}, 5)"), tilted),
        (format!("{tilted}*abs({tilted})"), tilted),
    ] {
        let off = off(&iso(&many), &iso(plain));
        assert!(off <= 1e-5, "{many}: {off}");
    }
}
