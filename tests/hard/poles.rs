//! Parametric surfaces where many u and v are one point, and where a ray only touches them.

use super::held::rendered;

/// A ball whose poles are on the y axis.
const BALL: &str =
    "parametric { function { cos(u)*cos(v) } function { sin(v) } function { sin(u)*cos(v) }
     <0, -pi/2>, <2*pi, pi/2> contained_by { sphere { 0, 1.1 } } }";

/// How many pixels differ from those of the ball as a sphere, which is seen from `camera`.
fn off(camera: &str) -> usize {
    let seen = |ball: &str| {
        rendered(
            &format!(
                "camera {{ {camera} }} background {{ rgb <1, 0, 0> }} light_source {{ <3, 5, -4>, rgb 1 }}
                 object {{ {ball} pigment {{ rgb <0, 1, 0> }} finish {{ ambient 0.2 diffuse 0.7 }} }}"
            ),
            (21, 21),
        )
    };
    let (ball, sphere) = (seen(BALL), seen("sphere { 0, 1 }"));
    let all = ball.radiances().zip(sphere.radiances());
    all.filter(|(a, b)| (a.red - b.red).abs() > 1e-6 || (a.green - b.green).abs() > 1e-6).count()
}

#[test]
fn a_parametric_ball_is_whole_at_its_poles() {
    for view in ["location 3*y direction -y up z", "location -3*y direction y up z"] {
        assert_eq!(off(&format!("orthographic {view} right 2.2*x up 2.2*z")), 0);
        // A pixel is a hundred-millionth wide.
        assert_eq!(off(&format!("orthographic {view} right 2e-7*x up 2e-7*z")), 0);
    }
    assert_eq!(off("location 0 direction y right x up z"), 0);
}

#[test]
fn a_camera_whose_rays_graze_a_parametric_ball_ends_and_sees_what_is_below_and_above() {
    // The middle row, or one pixel, only touches: it may be either.
    assert!(off("location <0, 1, -3> direction z right x up y") <= 1);
    assert!(off("orthographic location <0, 1, -3> direction z right 2e-5*x up 2e-5*y") <= 21);
    assert!(off("orthographic location <0, 1, -3> direction <0.2, 0, 1> right 2*x up 2*y") <= 21);
    assert!(off("orthographic location <0, 1, -3> direction x right 2*z up 2*y") <= 21);
}
