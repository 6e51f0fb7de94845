//! Finds gaps between the parts of an operation: along the axes, and across the parts' own faces.
//!
//! **In:** the bounds of some parts. **Out:** two of them that do not overlap. **Invariant:** reported only
//! where the extents of the parts prove it along one direction; parts without a common point may lack one for
//! other reasons.

use std::collections::BTreeMap;

use super::super::Lowering;
use super::Known;
use crate::geometry::reach::{Reach, slanted_faces};
use crate::math::{UnitVector, Vector};
use crate::shape::Shape;

/// Relative thickness below which a part is empty: it may all be rounding.
pub(super) const THIN: f64 = 64.0 * f64::EPSILON;
/// The most slanted directions that are tried: those across a face of the most parts.
const MOST_DIRECTIONS: usize = 32;

/// Two parts that do not overlap.
pub(super) struct Gap {
    pub touching: bool,
    pub parts: [usize; 2],
}

impl Lowering<'_, '_> {
    /// Returns two parts that are apart, or else two that only touch; `None` where all parts overlap along
    /// each direction that is tried.
    pub(super) fn gap(&self, parts: &[Known]) -> Option<Gap> {
        let straight = gap_along_axes(parts).filter(|gap| !gap.touching);
        straight.or_else(|| {
            let across = self.directions(parts).into_iter();
            let gaps = across.filter_map(|direction| self.gap_across(parts, direction));
            gap_along_axes(parts).into_iter().chain(gaps).min_by_key(|gap| gap.touching)
        })
    }

    fn gap_across(&self, parts: &[Known], direction: Vector) -> Option<Gap> {
        let reaches = parts.iter().map(|part| self.reach(part, direction));
        between(&reaches.collect::<Vec<_>>())
    }

    fn reach(&self, part: &Known, direction: Vector) -> Reach {
        let bounds = Reach::of_bounds(&part.inside, direction);
        let Some((object, turned)) = part.object else { return bounds };
        let object = &self.world.objects[object as usize];
        match object.shape {
            Shape::Plane(i) => {
                let plane = self.world.planes[i as usize];
                let plane = if turned { plane.complement() } else { plane };
                Reach::of_half_space(&plane, direction)
            }
            shape if object.inverse == turned => Reach::of_shape(&self.world, shape, direction),
            _ => bounds,
        }
    }

    /// Returns the directions across the parts' slanted faces, and from the only sphere of two parts to the
    /// other's centre.
    fn directions(&self, parts: &[Known]) -> Vec<Vector> {
        // For each direction, keyed by its numbers: how many parts have it, and which is the first.
        let mut known: BTreeMap<[u64; 3], (usize, usize)> = BTreeMap::new();
        let mut all = Vec::new();
        let shapes = parts.iter().filter_map(|part| {
            let (object, _) = part.object?;
            Some(self.world.objects[object as usize].shape)
        });
        for face in shapes.clone().flat_map(|shape| slanted_faces(&self.world, shape)) {
            // Only one of two opposite directions; zero has no sign.
            let leads = face.to_array().into_iter().find(|share| *share != 0.0);
            let face = if leads < Some(0.0) { -face } else { face } + Vector::ZERO;
            let entry = known.entry(face.to_array().map(f64::to_bits)).or_insert((0, all.len()));
            entry.0 += 1;
            if entry.0 == 1 {
                all.push(face);
            }
        }
        let mut order: Vec<(usize, usize)> = known.into_values().collect();
        order.sort_by_key(|&(count, first)| (std::cmp::Reverse(count), first));
        let faces = order.into_iter().take(MOST_DIRECTIONS).map(|(_, first)| all[first]);
        let is_ball = |shape| matches!(shape, Shape::Sphere(_));
        let middle = |part: &Known| part.inside.low * 0.5 + part.inside.high * 0.5;
        let line = match parts {
            [a, b] if shapes.clone().any(is_ball) => {
                Some(middle(b) - middle(a)).filter(|way| way.is_finite())
            }
            _ => None,
        };
        let line = line.and_then(UnitVector::from_direction).map(UnitVector::get);
        faces.chain(line).collect()
    }
}

/// As [`Lowering::gap`], by boxes along the axes alone.
pub(super) fn gap_along_axes(parts: &[Known]) -> Option<Gap> {
    let along = |axis: usize| {
        let reaches = parts.iter().map(|part| Reach {
            low: part.inside.low[axis],
            high: part.inside.high[axis],
            size: part.size(axis),
        });
        between(&reaches.collect::<Vec<_>>())
    };
    (0..3).filter_map(along).min_by_key(|gap| gap.touching)
}

/// Returns the gap between the part that begins last and the one that ends first, if they do not overlap or
/// only touch. A part that is thin itself may lie in a face.
fn between(reaches: &[Reach]) -> Option<Gap> {
    let (low, high) = (|part: usize| reaches[part].low, |part: usize| reaches[part].high);
    let last = (0..reaches.len()).max_by(|&a, &b| low(a).total_cmp(&low(b)))?;
    let first = (0..reaches.len()).min_by(|&a, &b| high(a).total_cmp(&high(b)))?;
    let overlap = high(first) - low(last);
    let thin = THIN * reaches[first].size.max(reaches[last].size);
    let is_thick = |reach: &Reach| reach.high - reach.low > thin;
    let is_gap = overlap < 0.0 || overlap <= thin && reaches.iter().all(is_thick);
    is_gap.then_some(Gap { touching: overlap >= -thin, parts: [first, last] })
}
