//! Polynomial surfaces as they are written: of any size, anywhere, and many.

use super::*;
use crate::road::{Options, Road};
use crate::scene::Dialect;
use crate::shape::Rounding;
use crate::source::NoFiles;

fn world(text: &str) -> World {
    let mut road = Road::new(&NoFiles, Options::new(Dialect::Pov));
    let (world, _) = road.compile("quartics.pov", text.as_bytes().to_vec());
    assert!(!road.diagnostics.has_errors(), "{text}\n{:#?}", road.diagnostics);
    world
}

/// The torus about the y axis, without its last brace.
fn quartic(major: f64, minor: f64) -> String {
    let (sum, difference) = (major * major + minor * minor, major * major - minor * minor);
    let [out, up, all] = [-2.0 * sum, 2.0 * difference, difference * difference];
    format!(
        "quartic {{ <1, 0, 0, 0, 2, 0, 0, 2, 0, {out:e}, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, \
         {up:e}, 0, 0, 0, 0, 1, 0, {out:e}, 0, {all:e}>"
    )
}

#[test]
fn a_quartic_torus_of_any_size_ends_where_it_is_wherever_it_stands() {
    for size in [1e-6, 1.0, 1e6] {
        for place in [0.0, 1e5] {
            let body = quartic(size, 0.35 * size);
            let world = world(&format!("{body} translate {:e}*x }}", place * size));
            let bounds = world.placed[0].bounds(Rounding::Outward).expect("bounded");
            let middle = Vector::X * (place * size);
            let half = Vector::new(1.35, 0.35, 1.35) * size;
            let (below, above) = (middle - half - bounds.low, bounds.high - middle - half);
            assert!(below.min(above).cmpge(Vector::ZERO).all(), "{size} {place} {bounds:?}");
            let off = below.max(above).max_element();
            assert!(off <= 0.05 * size, "{size} {place} {bounds:?}");
        }
    }
}

/// A ray tries those only that it may meet, and finds what it finds where it tries all.
#[test]
fn a_field_of_quartic_tori_asks_few_of_them() {
    let tori = quartic(1.0, 0.35);
    let world = world(&format!(
        "#declare T = {tori} }} #for (I, -9, 9) #for (J, -9, 9)
         object {{ T scale 0.4 rotate <30*I, 20*J, 0> translate <I, J, 0> }} #end #end"
    ));
    let geometry = Geometry::build(&world).counting();
    let list = without_tree(&geometry);
    let mut random = Random(85);
    let (mut work, mut hits) = (Work::default(), 0);
    let rays = 300;
    for _ in 0..rays {
        let target = Vector::new(random.number(-9.0, 9.0), random.number(-9.0, 9.0), 0.0);
        let origin = Vector::new(0.0, 0.0, -30.0);
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        let hit = geometry.nearest_counted(&ray, &mut work).found();
        assert_eq!(hit, list.nearest(&ray), "{ray:?}");
        hits += usize::from(hit.is_some());
    }
    assert!(work.root_solves < 4 * rays && hits > 60, "{work:?}, {hits} hits");
}
