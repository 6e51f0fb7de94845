//! Ellipsoids against exact arithmetic.

use super::*;

pub(super) fn random_ellipsoid(random: &mut Random) -> Ellipsoid {
    let size = random.size(-6.0, 6.0);
    let stretch = Vector::from_array([0; 3].map(|_| random.size(-2.0, 1.0)));
    let world_from_local = random.matrix() * Matrix::from_diagonal(stretch * size);
    let centre = random.direction().get() * (size * random.size(-8.0, 4.0));
    let local_from_world = world_from_local.inverse();
    Ellipsoid { placement: Placement { centre, world_from_local, local_from_world } }
}

#[test]
fn an_ellipsoid_is_hit_where_exact_arithmetic_hits_it() {
    let mut random = Random(6);
    let (mut hits, mut misses) = (0, 0);
    for _ in 0..tries() {
        let ellipsoid = random_ellipsoid(&mut random);
        let Placement { centre, world_from_local, .. } = ellipsoid.placement;
        let target = centre + world_from_local * (random.direction().get() * 1.05);
        let far = random.size(-1.0, 9.0);
        let size = world_from_local.x_axis.length();
        let origin = target + random.direction().get() * (size * far);
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        let (share, roots) = exact::ellipsoid(&ellipsoid.placement, &ray);
        match (ellipsoid.chord(&ray), roots) {
            (Some(chord), Some([enter, leave])) => {
                hits += 1;
                assert_within(chord.enter, enter, (ellipsoid, ray));
                assert_within(chord.leave, leave, (ellipsoid, ray));
            }
            (None, None) => misses += 1,
            _ => assert!(share.abs() < 1e5 * EPS * (far + 1.0), "{share:e} {far:e}"),
        }
    }
    assert!(hits > tries() / 5 && misses > tries() / 50, "{hits} hits, {misses} misses");
}
