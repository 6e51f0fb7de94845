//! The camera's words, held against POV-Ray 3.7.

use super::build::*;
use crate::diagnostic::Code;
use crate::math::Vector;
use crate::math::elementary::atan;
use crate::math::transform::Step;
use crate::scene::{Camera, CameraItem, CameraItemKind, CameraKind, Dialect};
use crate::world;
use CameraItemKind::*;

/// A camera of a dialect; steps become a transform each.
struct Words {
    build: Build,
    items: Vec<CameraItem>,
}

fn camera(dialect: Dialect, kind: CameraKind, words: &[Word]) -> Build {
    let mut all = Words { build: Build::new(), items: vec![] };
    for (n, word) in words.iter().enumerate() {
        let kind = match word {
            Word::Item(kind) => *kind,
            Word::Step(step) => Transform(all.build.transform(vec![*step])),
        };
        all.items.push(CameraItem { kind, site: site(700 + n) });
    }
    let Words { mut build, items } = all;
    build.0.dialect = dialect;
    build.0.cameras =
        vec![Camera { kind, meshes: None, items, is_in_order: false, site: site(600) }];
    build
}

enum Word {
    Item(CameraItemKind),
    Step(Step),
}

impl From<CameraItemKind> for Word {
    fn from(kind: CameraItemKind) -> Self {
        Word::Item(kind)
    }
}

impl From<Step> for Word {
    fn from(step: Step) -> Self {
        Word::Step(step)
    }
}

macro_rules! words {
    ($($word:expr),*) => { &[$(Word::from($word)),*] };
}

fn scene(words: &[Word]) -> world::Camera {
    camera(Dialect::Scene, CameraKind::Perspective, words).lower().0.camera
}

/// Where the ray through the screen's point (u, v) leaves the ball of radius 10 about the origin.
fn seen(camera: &world::Camera, u: f64, v: f64) -> Vector {
    let across = camera.right * u + camera.up * v;
    let (origin, direction) = match camera.kind {
        world::CameraKind::Perspective => (camera.location, camera.forward + across),
        world::CameraKind::Orthographic => (camera.location + across, camera.forward),
        other => panic!("no flat screen: {other:?}"),
    };
    let direction = direction.normalize();
    let b = origin.dot(direction);
    origin + direction * ((b * b - origin.length_squared() + 100.0).sqrt() - b)
}

/// POV-Ray's view through the corner pixels (top left, top right, bottom left) of an 8 × 6 picture
/// onto the inside of a ball that shows its own coordinates, in 16 bits: good to 0.0005.
fn assert_measured(kind: CameraKind, words: &[Word], corners: [Vector; 3]) {
    let camera = camera(Dialect::Pov, kind, words).lower().0.camera;
    let (u, v) = (7.0 / 16.0, 5.0 / 12.0);
    let ours = [seen(&camera, -u, v), seen(&camera, u, v), seen(&camera, -u, -v)];
    let close = ours.iter().zip(&corners).all(|(a, b)| a.distance(*b) < 0.002);
    assert!(close, "{ours:?} is not {corners:?}: {camera:?}");
}

fn location() -> CameraItemKind {
    Location(v(1.0, 2.0, -3.0))
}

fn look_at() -> CameraItemKind {
    LookAt(v(0.3, 0.2, 0.5))
}

fn direction() -> CameraItemKind {
    Direction(v(0.2, 0.1, 1.5))
}

fn up() -> CameraItemKind {
    Up(v(0.1, 1.1, 0.0))
}

fn right() -> CameraItemKind {
    Right(v(1.7, 0.1, 0.0))
}

fn left() -> CameraItemKind {
    Right(v(-1.7, 0.0, 0.0))
}

#[test]
fn perspective_words_in_any_order_show_what_pov_ray_shows() {
    let check = |words: &[Word], corners| assert_measured(CameraKind::Perspective, words, corners);
    check(
        words![location()],
        [v(-4.571, 5.990, 6.575), v(6.040, 5.609, 5.662), v(-5.404, -2.586, 8.007)],
    );
    check(
        words![look_at(), location(), Sky(v(0.3, 1.0, 0.2))],
        [v(-5.514, 2.746, 7.877), v(5.844, -0.726, 8.082), v(-7.870, -4.730, 3.961)],
    );
    check(
        words![Angle(50.0), location(), look_at(), direction(), right(), up()],
        [v(-6.151, -0.696, 7.854), v(3.356, -0.618, 9.400), v(-5.732, -6.222, 5.331)],
    );
}

#[test]
fn camera_transforms_come_last_as_pov_ray_has_it() {
    let check = |words: &[Word], corners| assert_measured(CameraKind::Perspective, words, corners);
    check(
        words![location(), left(), look_at(), rotate(20.0, 30.0, 10.0), translate(0.5, 0.2, 0.1)],
        [v(9.203, 0.349, 3.895), v(-3.371, -1.340, 9.319), v(8.405, -5.336, -0.940)],
    );
    check(
        words![rotate(20.0, 30.0, 10.0), location(), scale(1.0, 2.0, 1.0), look_at()],
        [v(-2.467, -3.133, 9.171), v(8.507, -0.773, 5.200), v(-2.926, -9.381, 1.851)],
    );
}

#[test]
fn looking_along_the_sky_keeps_right_as_pov_ray_does() {
    assert_measured(
        CameraKind::Perspective,
        words![Location(v(0.0, 3.0, 0.0)), LookAt(Vector::ZERO)],
        [v(-5.814, -6.991, 4.163), v(5.814, -6.991, 4.163), v(-5.814, -6.991, -4.163)],
    );
    assert_measured(
        CameraKind::Perspective,
        words![Location(v(0.0, 3.0, 0.0)), left(), LookAt(Vector::ZERO)],
        [v(-6.844, -6.202, -3.834), v(6.844, -6.202, -3.834), v(-6.844, -6.202, 3.834)],
    );
    // In a `.scene` the camera tilts down from −z: what was ahead is now up.
    let ours = scene(words![Location(v(0.0, 3.0, 0.0)), LookAt(Vector::ZERO)]);
    assert_eq!((ours.right, ours.up), (Vector::X * (4.0 / 3.0), -Vector::Z));
}

#[test]
fn orthographic_sizes_are_pov_rays() {
    let check = |words: &[Word], corners| assert_measured(CameraKind::Orthographic, words, corners);
    check(
        words![location()],
        [v(-1.666, 3.910, 9.052), v(3.667, 3.910, 8.442), v(-1.666, 0.090, 9.860)],
    );
    check(
        words![location(), direction(), look_at()],
        [v(-2.970, -3.111, 9.028), v(0.060, -3.055, 9.522), v(-2.790, -5.109, 8.131)],
    );
    check(
        words![location(), look_at(), up()],
        [v(-2.004, -3.743, 9.054), v(-0.855, -3.722, 9.242), v(-1.929, -4.580, 8.678)],
    );
    check(
        words![Angle(50.0), location(), look_at(), rotate(20.0, 30.0, 10.0), right()],
        [v(2.048, -5.876, 7.828), v(5.070, -5.470, 6.662), v(1.777, -7.249, 6.655)],
    );
}

#[test]
fn without_a_word_a_scene_looks_along_minus_z_and_pov_along_plus_z() {
    assert_eq!(scene(&[]), world::Camera::default());
    let pov = camera(Dialect::Pov, CameraKind::Perspective, &[]).lower().0.camera;
    assert_eq!((pov.forward, pov.right), (Vector::Z, Vector::X * 1.33));
    let mut none = camera(Dialect::Pov, CameraKind::Perspective, &[]);
    none.0.cameras.clear();
    assert_eq!(none.lower().0.camera, pov);
}

#[test]
fn the_angle_is_the_angle_between_the_left_and_the_right_edge() {
    for degrees in [1e-6, 30.0, 90.0, 150.0, 179.9] {
        let camera = scene(words![Angle(degrees)]);
        let half = camera.right.length() * 0.5 / camera.forward.length();
        assert!((2.0 * atan(half).to_degrees() - degrees).abs() < 1e-13 * 180.0, "{degrees}");
    }
    assert_eq!(scene(words![Right(Vector::X), Angle(90.0)]).forward, -Vector::Z * 0.5);
}

#[test]
fn shift_puts_the_optical_axis_on_the_middle_of_the_bottom_edge() {
    let straight = scene(words![Location(v(0.0, 0.0, 5.0)), LookAt(Vector::ZERO)]);
    let words = words![Location(v(0.0, 0.0, 5.0)), Shift { x: 0.0, y: 0.5 }, LookAt(Vector::ZERO)];
    let shifted = scene(words);
    let bottom = shifted.forward - shifted.up * 0.5;
    assert_eq!(bottom, straight.forward);
    let flat = camera(Dialect::Scene, CameraKind::Orthographic, words).lower().0.camera;
    assert_eq!(flat.location - flat.up * 0.5, straight.location);
    assert_eq!(flat.forward, straight.forward);
}

#[test]
fn looking_keeps_lengths_and_handedness() {
    for (right, side) in [(v(2.0, 0.0, 0.0), 1.0), (v(-2.0, 0.0, 0.0), -1.0)] {
        let camera = scene(words![
            Location(v(0.0, 0.0, 4.0)),
            Right(right),
            Up(v(0.0, 3.0, 0.0)),
            Direction(v(0.0, 0.0, -5.0)),
            LookAt(v(4.0, 0.0, 4.0))
        ]);
        assert_eq!(camera.forward, v(5.0, 0.0, 0.0));
        assert_eq!(camera.up, v(0.0, 3.0, 0.0));
        assert_eq!(camera.right, v(0.0, 0.0, 2.0 * side));
    }
}

#[test]
fn cameras_that_see_nothing_are_reported_where_it_is_written() {
    let check = |words: &[Word], place: usize| {
        let (_, _, diagnostics) = camera(Dialect::Scene, CameraKind::Perspective, words).lower();
        let found: Vec<_> = diagnostics
            .iter()
            .filter(|d| d.code == Code::DegenerateCamera)
            .map(|d| d.primary().map(|label| label.span))
            .collect();
        assert_eq!(found, [Some(site(place).span)]);
    };
    check(words![LookAt(Vector::ZERO)], 600);
    check(words![Sky(Vector::X), LookAt(Vector::X)], 701);
    check(words![location(), Right(Vector::ZERO)], 701);
    check(words![Up(Vector::ZERO)], 700);
    check(words![Direction(Vector::ZERO)], 700);
    for angle in [-10.0, 180.0, 200.0, f64::NAN] {
        check(words![location(), Angle(angle)], 701);
    }
    check(words![Right(Vector::Y)], 600);
    check(words![Direction(v(1.0, 3.0, 0.0))], 600);
}

#[test]
fn a_camera_flattened_by_a_transform_is_reported_there() {
    let words = words![location(), scale(0.0, 1.0, 1.0)];
    let (_, _, diagnostics) = camera(Dialect::Scene, CameraKind::Perspective, words).lower();
    let first = diagnostics.iter().next().expect("a message");
    assert_eq!(first.code, Code::ZeroScale);
    assert_eq!(first.primary().map(|label| label.span), Some(site(701).span));
}
