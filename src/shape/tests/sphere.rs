//! Spheres against exact arithmetic, from within and from afar.

use super::*;

#[test]
fn a_sphere_is_hit_where_exact_arithmetic_hits_it_at_any_size_and_distance() {
    let mut random = Random(1);
    for _ in 0..tries() {
        let radius = random.size(-150.0, 150.0);
        let far = random.size(-1.0, 9.0);
        let centre = random.direction().get() * (radius * random.size(-8.0, 3.0));
        let ray = ray_at(&mut random, centre, radius, far);
        let sphere = Sphere { centre, radius };
        let (share, roots) = exact::sphere(centre, radius, &ray);
        match (sphere.chord(&ray), roots) {
            (Some(chord), Some([enter, leave])) => {
                assert_within(chord.enter, enter, (sphere, ray, share));
                assert_within(chord.leave, leave, (sphere, ray, share));
                assert!(chord.enter.t <= chord.leave.t);
                // And the claim is not idle.
                let blur = 30.0 * EPS * (far + 1.0);
                let fair = blur * (1.0 + (1.0 / share.sqrt()).min(1.0 / blur.sqrt()));
                let claimed = chord.leave.error.max(chord.enter.error) / radius;
                assert!(claimed <= 4.0 * fair.max(blur), "{claimed:e} {far:e} {share:e} {ray:?}");
            }
            (None, None) => {}
            (found, _) => assert!(
                share.abs() <= 16.0 * EPS * (far + 2.0),
                "{found:?}, h²/r² = {share:e}, {far:e} radii away"
            ),
        }
    }
}

#[test]
fn the_ground_of_a_planet_is_met_as_exactly_as_what_stands_on_it() {
    let mut random = Random(14);
    for _ in 0..tries() {
        let radius = random.size(4.5, 13.0);
        let up = [random.direction().get(), Vector::Y, -Vector::X][random.below(3)];
        let sphere = Sphere { centre: up * -radius, radius };
        let height = [1.0, -1.0][random.below(2)] * random.size(-9.0, 0.0);
        let origin = up * height + up.cross(random.direction().get());
        let direction = random.direction().get();
        let ray = Ray { origin, direction };
        let (_, roots) = exact::sphere(sphere.centre, radius, &ray);
        let (Some(chord), Some([enter, leave])) = (sphere.chord(&ray), roots) else { continue };
        let (crossing, exact) =
            if enter.0 > 0.0 { (chord.enter, enter) } else { (chord.leave, leave) };
        assert_within(crossing, exact, (sphere, ray));
        if crossing.t < 0.01 * radius && direction.dot(up).abs() > 0.1 {
            assert!(
                crossing.error <= 2000.0 * EPS * (crossing.t.abs() + 1.0),
                "{crossing:?} {ray:?}"
            );
        }
        let surface = sphere.surface(&ray, crossing.t);
        let above = exact::above_sphere(sphere.centre, radius, surface.point);
        assert!(above.abs() <= surface.error, "{above:e}: {sphere:?} {ray:?} {surface:?}");
        if surface.point.length() < 10.0 {
            assert!(surface.error < 1e3 * EPS, "{surface:?} {sphere:?} {ray:?}");
        }
        assert_leaves_for_good(&mut random, &surface, false, |ray| sphere.chord(ray), sphere);
    }
}
