//! Polygons against exact arithmetic, also at their edges and corners.

use super::placed::{
    assert_crossed_where_it_is, at_the_origin, blur, far_off, local_at, placed, ray_at_placed,
};
use super::*;
use crate::shape::exact::Triple;

/// A star of five points with a hole in the middle, and a square within it.
fn star() -> Polygon {
    let corner = |i: usize| {
        let (x, y) = [(0.0, 1.0), (0.5, -0.75), (-1.0, 0.25), (1.0, 0.25), (-0.5, -0.75)][i];
        [x, y]
    };
    let square = [[-0.125, -0.125], [0.125, -0.125], [0.125, 0.125], [-0.125, 0.125]];
    Polygon::new(&[(0..5).map(corner).collect(), square.to_vec()]).expect("a polygon")
}

/// Whether a point of the plane is inside, exactly; and its distance to the nearest edge.
fn within(polygon: &Polygon, [x, y, _]: Triple) -> (bool, f64) {
    let (mut odd, mut nearest) = (false, f64::INFINITY);
    for [from, to] in &polygon.edges {
        let [ax, bx] = [from.x, to.x].map(|a| Double::of(a) - x);
        let [ay, by] = [from.y, to.y].map(|a| Double::of(a) - y);
        let turn = ax * by - ay * bx;
        odd ^= (ay.0 <= 0.0) != (by.0 <= 0.0) && (turn.0 > 0.0) == (ay.0 <= 0.0);
        let (wx, wy) = (bx - ax, by - ay);
        let length2 = wx * wx + wy * wy;
        let share = -(ax * wx + ay * wy) / length2;
        let share = Double::of(share.0.clamp(0.0, 1.0));
        let (nx, ny) = (ax + wx * share, ay + wy * share);
        nearest = nearest.min((nx * nx + ny * ny).sqrt().0);
    }
    (odd, nearest)
}

#[test]
fn a_polygon_is_met_where_exact_arithmetic_is_inside_of_its_lines() {
    let mut random = Random(91);
    let (mut met, mut missed) = (0, 0);
    for _ in 0..tries() {
        let placed = placed(&mut random, Body::Polygon(star()));
        let ray = ray_at_placed(&mut random, &placed);
        met += assert_crossed_where_it_is(&mut random, &placed, &ray, |_, [_, _, z]| z);
        let found = placed.crossings(&ray);
        let (start, step) = (
            placed.placement.local_point(ray.origin),
            placed.placement.local_direction(ray.direction),
        );
        let t = -start.z / step.z;
        if !t.is_finite() {
            continue;
        }
        let Body::Polygon(polygon) = &*placed.body else { panic!() };
        let (inside, nearest) = within(polygon, local_at(&placed, &ray, t, 0.0));
        let off = 64.0 * blur(&placed, &ray) * step.length() / step.z.abs();
        if nearest > off {
            assert_eq!(found.len(), usize::from(inside), "{found:?} {placed:?} {ray:?}");
            missed += usize::from(!inside);
        }
    }
    assert!(met > tries() / 8 && missed > tries() / 8, "{met} {missed}");
}

#[test]
fn a_line_through_an_edge_or_a_corner_of_a_polygon_meets_it() {
    let mut random = Random(92);
    for _ in 0..tries() {
        let placed = at_the_origin(placed(&mut random, Body::Polygon(star())));
        let Body::Polygon(polygon) = &*placed.body else { panic!() };
        let [from, to] = polygon.edges[random.below(polygon.edges.len())];
        let share = [0.0, 0.5, random.number(0.0, 1.0)][random.below(3)];
        let target = placed.placement.world_point(from + (to - from) * share);
        let far = 3.0 * far_off(&mut random, &placed);
        let origin = placed.placement.world_point(random.direction().get() * far);
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        if placed.placement.local_direction(ray.direction).normalize().z.abs() > 1e-6 {
            assert_eq!(placed.crossings(&ray).len(), 1, "{placed:?} {ray:?}");
        }
    }
}
