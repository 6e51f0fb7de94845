//! Blob: where the fields of its components add up to 1 or more.
//!
//! A component's field is `strength`·(1 − d²)², d the distance from the middle of a bar in a space where the
//! bar is 1 thick all around; beyond it there is none. A ball is a bar without length. Negative strengths
//! dent what others make.
//!
//! **Source:** POV-Ray 3.7 manual, 3.4.5.1.1; G. Wyvill, C. McPheeters, B. Wyvill, "Data structure for soft
//! objects", The Visual Computer 2 (1986).

mod along;

use smallvec::SmallVec;

use super::body::{Crossings, Height, Local, LocalRay};
use super::tree::Tree;
use super::{Bounds, U};
use crate::math::singular::singular_values;
use crate::math::{Matrix, Vector};
use along::Line;

/// A bar along z from −`half` to `half`, and all that is nearer to it than 1, under a linear map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Component {
    pub strength: f64,
    /// The middle of the bar.
    pub centre: Vector,
    /// 0 or more.
    pub half: f64,
    pub blob_from_unit: Matrix,
    pub unit_from_blob: Matrix,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Blob {
    /// In the order of the tree.
    components: Vec<Component>,
    /// No part of the surface is farther from the middle of a component that could make it; 0 where none
    /// is made by it more than by any other.
    widths: Vec<f64>,
    /// How far an error in space may move a point in the component's own, at most.
    stretches: Vec<f64>,
    tree: Tree,
    reach: f64,
}

/// A point as a component sees it.
struct Seen {
    /// From the nearest point of the bar.
    from_bar: Vector,
    /// 1 − d²; the field is the strength times its square, where it is positive.
    inner: f64,
}

impl Component {
    /// The size of the component along a vector: the greatest `along`·P, for a thickness of `width`.
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

    /// How far from the origin it reaches, for a thickness of `width`.
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

    /// How far its field may be off where the point may be by `off` in its own space.
    fn error(&self, Seen { from_bar, inner }: &Seen, off: f64) -> f64 {
        let square = 2.0 * from_bar.length() * off + off * off + 4.0 * U;
        self.strength.abs()
            * (2.0 * inner.abs() * square + square * square + 4.0 * U * inner * inner)
    }
}

impl Blob {
    /// Components whose strengths are measured in thresholds, and which together are about as large as 1.
    /// `None` where they add up to 1 nowhere.
    pub fn new(mut components: Vec<Component>) -> Option<Self> {
        components.retain(|component| component.strength != 0.0);
        if components.is_empty() {
            return None;
        }
        let (tree, components, bounds) = sorted(&components);
        let (widths, _) = widths(&tree, &components, &bounds);
        let parts = || components.iter().zip(&widths).filter(|(_, width)| **width > 0.0);
        let reach = parts().map(|(component, &width)| component.reach(width)).fold(0.0, f64::max);
        parts().next()?;
        let stretch = |component: &Component| singular_values(component.unit_from_blob)[0];
        let stretches = components.iter().map(stretch).collect();
        let reach = reach * (1.0 + 64.0 * U);
        Some(Self { components, widths, stretches, tree, reach })
    }

    /// The components that may have a field at a point.
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

/// A tree over some components; these in its order, and their boxes.
fn sorted(components: &[Component]) -> (Tree, Vec<Component>, Vec<Bounds>) {
    let bounds: Vec<Bounds> = components.iter().map(Component::bounds).collect();
    let (tree, order) = Tree::build(&bounds);
    let components = order.iter().map(|&i| components[i as usize]).collect();
    let bounds = order.iter().map(|&i| bounds[i as usize]).collect();
    (tree, components, bounds)
}

/// Returns [`Blob::widths`], and how many nodes of the tree were looked at.
///
/// Where the surface is, some component has the greatest 1 − d². Its square, times the sum of all positive
/// strengths whose components meet this one, is 1 or more; so no surface is farther from the middle of that
/// component than the d that follows. More strengths than meet it only make the width greater.
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

    /// What is missing to 1.
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
    /// How many nodes of a tree are looked at for the widths of some components.
    pub(super) fn looks(components: &[Component]) -> usize {
        let (tree, components, bounds) = sorted(components);
        widths(&tree, &components, &bounds).1
    }

    /// What is missing to 1, in twice the digits.
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
