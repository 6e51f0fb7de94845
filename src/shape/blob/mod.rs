//! Blob: the set of points where the fields of its components add up to 1 or more.
//!
//! A component's field is `strength`·(1 − d²)², with d the distance from the middle of a bar, in a space
//! where the bar has radius 1; it is 0 for d > 1. A sphere is a bar of length 0. Negative strengths subtract
//! from the field.
//!
//! **Source:** POV-Ray 3.7 manual, 3.4.5.1.1; G. Wyvill, C. McPheeters, B. Wyvill, "Data structure for soft
//! objects", The Visual Computer 2 (1986).

mod along;

use smallvec::SmallVec;

use super::local::{Crossings, Height, Local, LocalRay};
use super::tree::Tree;
use super::{Bounds, Paint, U};
use crate::math::singular::singular_values;
use crate::math::{Matrix, Vector};
use along::Line;

/// A bar along z from −`half` to `half` with all points nearer to it than 1, under a linear map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Component {
    pub strength: f64,
    /// The middle of the bar.
    pub centre: Vector,
    /// Half the length of the bar, at least 0.
    pub half: f64,
    pub blob_from_unit: Matrix,
    pub unit_from_blob: Matrix,
}

/// The points where the fields of the components add up to 1 or more.
#[derive(Debug, Clone, PartialEq)]
pub struct Blob {
    /// In the order of the tree.
    components: Vec<Component>,
    /// For each component, the maximum distance from its middle at which the surface may be dominated by it;
    /// 0 if it dominates nowhere.
    widths: Vec<f64>,
    /// Upper bounds on the ratio of an error in a component's space to one in the blob's.
    stretches: Vec<f64>,
    tree: Tree,
    reach: f64,
    /// For each component, an index into a list owned by the caller; or empty.
    paints: Vec<u32>,
}

/// A point in a component's space.
struct Seen {
    /// Vector from the nearest point of the bar.
    from_bar: Vector,
    /// 1 − d²; where positive, the field is the strength times its square.
    inner: f64,
}

impl Component {
    /// Returns the maximum of `along`·P over the component, for a radius of `width`.
    fn greatest(&self, along: Vector, width: f64) -> f64 {
        let along_unit = self.blob_from_unit.transpose() * along;
        self.centre.dot(along) + self.half * along_unit.z.abs() + width * along_unit.length()
    }

    fn bounds(&self) -> Bounds {
        let axes = [Vector::X, Vector::Y, Vector::Z];
        let high = axes.map(|axis| self.greatest(axis, 1.0));
        let low = axes.map(|axis| -self.greatest(-axis, 1.0));
        let slack = Vector::splat(16.0 * U) * (self.centre.abs() + 1.0);
        Bounds { low: Vector::from_array(low) - slack, high: Vector::from_array(high) + slack }
    }

    /// Maximum distance from the origin, for a radius of `width`.
    fn reach(&self, width: f64) -> f64 {
        let axis = self.blob_from_unit.z_axis * self.half;
        let end = (self.centre + axis).length().max((self.centre - axis).length());
        end + width * singular_values(self.blob_from_unit)[0]
    }

    fn seen(&self, unit: Vector) -> Seen {
        let over = unit.z - unit.z.clamp(-self.half, self.half);
        let from_bar = Vector::new(unit.x, unit.y, over);
        Seen { from_bar, inner: 1.0 - from_bar.length_squared() }
    }

    /// The greatest [`Self::error`] within the component.
    fn greatest_error(&self, off: f64) -> f64 {
        let square = 2.0 * off + off * off + 4.0 * U;
        self.strength.abs() * (2.0 * square + square * square + 4.0 * U)
    }

    /// Error of the field for a point that is off by `off` in the component's space.
    fn error(&self, Seen { from_bar, inner }: &Seen, off: f64) -> f64 {
        let square = 2.0 * from_bar.length() * off + off * off + 4.0 * U;
        self.strength.abs()
            * (2.0 * inner.abs() * square + square * square + 4.0 * U * inner * inner)
    }
}

impl Blob {
    /// Builds a blob of about size 1 from components whose strengths are relative to the threshold. `None` if
    /// the field reaches 1 nowhere.
    pub fn new(components: Vec<Component>) -> Option<Self> {
        Self::painted(components, &[])
    }

    /// Builds a blob whose components have these paints.
    pub fn painted(mut components: Vec<Component>, paints: &[u32]) -> Option<Self> {
        let painted = components.iter().zip(paints);
        let paints: Vec<u32> =
            painted.filter(|(one, _)| one.strength != 0.0).map(|(_, paint)| *paint).collect();
        components.retain(|component| component.strength != 0.0);
        if components.is_empty() {
            return None;
        }
        let (tree, components, bounds, order) = sorted(&components);
        let paints = match paints.is_empty() {
            true => paints,
            false => order.iter().map(|&i| paints[i as usize]).collect(),
        };
        let (widths, _) = widths(&tree, &components, &bounds);
        let parts = || components.iter().zip(&widths).filter(|(_, width)| **width > 0.0);
        let reach = parts().map(|(component, &width)| component.reach(width)).fold(0.0, f64::max);
        parts().next()?;
        let stretch = |component: &Component| singular_values(component.unit_from_blob)[0];
        let stretches = components.iter().map(stretch).collect();
        let reach = reach * (1.0 + 64.0 * U);
        Some(Self { components, widths, stretches, tree, reach, paints })
    }

    /// Returns the paints of the components at a point, each with its share of the sum of all fields' sizes;
    /// `None` if they have none.
    ///
    /// **Source:** measured on POV-Ray 3.7, to 1/10,000.
    pub fn paint(&self, point: Vector) -> Option<Paint> {
        if self.paints.is_empty() {
            return None;
        }
        let mut paint = Paint::new();
        for i in self.around(point) {
            let component = &self.components[i];
            let seen = component.seen(component.unit_from_blob * (point - component.centre));
            let weight = component.strength.abs() * seen.inner.max(0.0) * seen.inner.max(0.0);
            match paint.iter_mut().find(|(known, _)| *known == self.paints[i]) {
                Some((_, share)) => *share += weight,
                None => paint.push((self.paints[i], weight)),
            }
        }
        let sum: f64 = paint.iter().map(|(_, weight)| weight).sum();
        paint.iter_mut().for_each(|(_, weight)| *weight /= sum);
        (sum > 0.0).then_some(paint)
    }

    /// Returns the components that may have a field at a point.
    fn around(&self, point: Vector) -> impl Iterator<Item = usize> {
        let mut near: SmallVec<[usize; 16]> = SmallVec::new();
        self.tree.touching(&Bounds { low: point, high: point }, |run| near.extend(run));
        near.into_iter()
    }

    fn greatest(&self, along: Vector) -> f64 {
        self.tree.greatest(along, |run| {
            let parts = run.filter(|&i| self.widths[i] > 0.0);
            let reach = parts.map(|i| self.components[i].greatest(along, self.widths[i]));
            reach.fold(f64::NEG_INFINITY, f64::max)
        })
    }
}

/// Builds a tree over the components; returns them, and their boxes, in its order, and their former indices.
fn sorted(components: &[Component]) -> (Tree, Vec<Component>, Vec<Bounds>, Vec<u32>) {
    let bounds: Vec<Bounds> = components.iter().map(Component::bounds).collect();
    let (tree, order) = Tree::build(&bounds);
    let components = order.iter().map(|&i| components[i as usize]).collect();
    let bounds = order.iter().map(|&i| bounds[i as usize]).collect();
    (tree, components, bounds, order)
}

/// Returns [`Blob::widths`], and the number of visited tree nodes.
///
/// At each point of the surface, some component has the largest 1 − d². Its square, times the sum of all
/// positive strengths whose components touch this one, is at least 1; this bounds d. Counting more strengths
/// only enlarges the bound.
fn widths(tree: &Tree, components: &[Component], bounds: &[Bounds]) -> (Vec<f64>, usize) {
    let strengths = tree.weights(|i| components[i].strength.max(0.0));
    let mut looks = 0;
    let width = |(component, bounds): (&Component, &Bounds)| {
        if component.strength < 0.0 {
            return 0.0;
        }
        let (most, seen) = tree.weight_touching(bounds, &strengths);
        looks += seen;
        // A NaN is no width either.
        (1.0 - 1.0 / most.sqrt()).max(0.0).sqrt()
    };
    let widths = components.iter().zip(bounds).map(width).collect();
    (widths, looks)
}

impl Local for Blob {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let mut line = Line::new(self, ray);
        line.crossings((f64::NEG_INFINITY, f64::INFINITY), false, found);
    }

    fn first_crossings(&self, ray: &LocalRay, between: (f64, f64), found: &mut Crossings) {
        let mut line = Line::new(self, ray);
        line.crossings(between, true, found);
    }

    fn part_at(&self, _: &LocalRay, _: f64, _: bool) -> Option<u32> {
        Some(0)
    }

    /// 1 less the field.
    fn height(&self, _: u32, point: Vector) -> Height {
        let mut height = Height { value: 1.0, gradient: Vector::ZERO, error: 2.0 * U };
        for i in self.around(point) {
            let component = &self.components[i];
            let from_centre = point - component.centre;
            let seen = component.seen(component.unit_from_blob * from_centre);
            if seen.inner <= 0.0 {
                continue;
            }
            let field = component.strength * seen.inner * seen.inner;
            height.value -= field;
            let slope = component.unit_from_blob.transpose() * seen.from_bar;
            height.gradient += slope * (4.0 * component.strength * seen.inner);
            let off = self.stretches[i] * 8.0 * U * (from_centre.length() + point.length());
            height.error += component.error(&seen, off) + U * (field.abs() + height.value.abs());
        }
        if height.gradient == Vector::ZERO {
            // Where parts of the surface meet in a point, it faces no way, or any.
            height.gradient = Vector::Y;
        }
        height
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        (-self.greatest(-along), self.greatest(along))
    }

    fn price(&self) -> u64 {
        40 + 7 * u64::from(self.components.len().max(1).ilog2())
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn numbers(&self) -> String {
        format!(" of {}", self.components.len())
    }

    fn contains(&self, point: Vector) -> bool {
        self.height(0, point).value < 0.0
    }

    fn is_iterated(&self) -> bool {
        true
    }
}

#[cfg(test)]
impl Blob {
    /// Returns the number of tree nodes visited to compute the widths.
    pub(super) fn looks(components: &[Component]) -> usize {
        let (tree, components, bounds, _) = sorted(components);
        widths(&tree, &components, &bounds).1
    }

    /// 1 less the field, in twice the precision.
    pub(super) fn exactly(&self, point: super::exact::Triple) -> super::exact::Double {
        use super::exact::{Double, local, minus, triple};
        let n = Double::of;
        self.components.iter().fold(n(1.0), |height, component| {
            let from_centre = minus(point, triple(component.centre));
            let [x, y, z] = local(&component.unit_from_blob, from_centre);
            let over = z.abs() - n(component.half);
            let over = if over.0 > 0.0 { over } else { n(0.0) };
            let inner = n(1.0) - (x * x + y * y + over * over);
            if inner.0 > 0.0 { height - n(component.strength) * inner * inner } else { height }
        })
    }
}
