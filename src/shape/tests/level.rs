//! Rays that go nearly level through the end of a solid: where they cross its plane, in exact arithmetic.

use super::*;

/// A cylinder from z = −1 to 1, of a power of two's size, along an axis: of its ends no digit is lost.
fn bar(random: &mut Random) -> (Placed, Vector, f64) {
    let size = (random.number(-30.0, 30.0).round()).exp2();
    let axes = [Vector::X, Vector::Y, Vector::Z];
    let turn = random.below(3);
    let [x, y, z] = [0, 1, 2].map(|i| axes[(i + turn) % 3] * size);
    let world_from_local = Matrix::from_cols(x, y, z);
    let local_from_world = world_from_local.inverse();
    let far = size * [0.0, 1.0, 1e3][random.below(3)];
    let centre = random.point(far);
    let placement = Placement { centre, world_from_local, local_from_world };
    let body = std::sync::Arc::new(Body::Cylinder(Cylinder { open: false }));
    (placed::stand(body, placement), z / size, size)
}

#[test]
fn a_nearly_level_ray_crosses_an_end_where_exact_arithmetic_does_however_small_its_slope() {
    let mut random = Random(94);
    let (mut crossed, mut least) = (0, f64::INFINITY);
    for _ in 0..tries() {
        let (placed, up, size) = bar(&mut random);
        let centre = placed.placement.centre;
        let side = [1.0, -1.0][random.below(2)];
        let across =
            placed.placement.world_from_local * Vector::new(random.number(-0.5, 0.5), 0.0, side);
        let target = centre + across;
        let slope = random.size(-17.0, -4.0) * [1.0, -1.0][random.below(2)];
        let way = placed.placement.world_from_local * Vector::new(0.6, 0.8, slope);
        let direction = way.normalize_or(Vector::X);
        let origin = target - direction * (size * random.size(0.0, 9.0));
        let ray = Ray { origin, direction };
        let double = |v: Vector| Double::of(v.dot(up));
        let (start, speed) = (double(origin), double(direction));
        let greatest = origin.abs().max_element().max(centre.abs().max_element() + size);
        for met in placed.crossings(&ray).iter().filter(|met| met.part != 0) {
            let end = if met.leaving == (speed.0 > 0.0) { size } else { -size };
            let from_plane = Double::of(centre.dot(up)) + Double::of(end) - start;
            // What rounding takes for a ray in the plane is on one side of it.
            if from_plane.0.abs() <= 64.0 * EPS * greatest {
                continue;
            }
            let off = (from_plane / speed - Double::of(met.t)).abs().0;
            assert!(off <= met.error, "{off:e}: {met:?} {placed:?} {ray:?}");
            (crossed, least) = (crossed + 1, least.min(speed.0.abs()));
        }
    }
    assert!(crossed > tries() / 10 && least < 1e-9, "{crossed} {least:e}");
}
