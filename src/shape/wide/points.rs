//! What flat parts of a body, and ellipsoids, are like where four rays cross them.
//!
//! **Out:** of each ray what [`Placed::surface_of_part`] or [`Ellipsoid::surface`] finds of it alone, to the bit; where
//! that takes more, it says so.

use super::super::{Ellipsoid, Placed, U};
use super::{WidePoints, larger};
use crate::math::Matrix;
use crate::math::placement::Placement;
use crate::math::wide::*;

/// The planes of flat parts of one body; see [`crate::shape::local::Facet`].
pub(crate) struct WideFacets<S: Simd> {
    pub corner: WideVector<S>,
    pub normal: WideVector<S>,
    pub turn: Wide<S>,
}

/// The height of points over a plane, in the body's own space.
struct WideHeight<S: Simd> {
    value: Wide<S>,
    error: Wide<S>,
}

impl<S: Simd> WideFacets<S> {
    #[inline(always)]
    fn height(&self, simd: S, local: WideVector<S>) -> WideHeight<S> {
        let off = local - self.corner;
        let error = (self.turn + all(simd, 4.0 * U)) * length(off) + all(simd, U) * length(local);
        WideHeight { value: self.normal.dot(off), error }
    }

    /// Returns the points where each of four rays crosses its part of a body.
    #[inline(always)]
    pub fn surface(&self, simd: S, placed: &Placed, ray: &WideRay<S>, t: Wide<S>) -> WidePoints<S> {
        let Placement { centre, local_from_world, world_from_local } = placed.placement;
        let [sizes, out] = [local_from_world.abs(), local_from_world.transpose()];
        let centre = WideVector::splat(simd, centre);
        let gradient = times(simd, &out, self.normal);
        let gradient_squared = gradient.length_squared();
        let mut point = ray.origin + ray.direction * t;
        for _ in 0..2 {
            let height = self.height(simd, times(simd, &local_from_world, point - centre));
            let step = gradient * (height.value / gradient_squared);
            let [x, y, z] = step.0;
            let is_finite = x.is_finite() & y.is_finite() & z.is_finite();
            point = (point - step).or(is_finite, point);
        }
        let from_centre = point - centre;
        let height = self.height(simd, times(simd, &local_from_world, from_centre));
        let steepness = gradient_squared.sqrt();
        let direction = gradient / steepness;
        let reciprocal = all(simd, 1.0) / length(direction);
        let has_direction = reciprocal.is_finite() & reciprocal.simd_gt(all(simd, 0.0));
        let normal = direction * reciprocal;
        let slopes = times(simd, &sizes, from_centre.abs());
        let local_steepness = length(times(simd, &world_from_local.transpose(), gradient));
        let left = height.value.abs();
        let mut error =
            (left + height.error + all(simd, U * 24.0) * length(slopes) * local_steepness)
                / steepness
                + all(simd, 2.0 * U) * normal.abs().dot(point.abs());
        if let Some(corners) = placed.farthest_corner() {
            let WideVector([x, y, z]) = WideVector::splat(simd, corners) + from_centre.abs();
            let far = larger(larger(x, y), z);
            error += all(simd, 6.0 * U) * normal.abs().element_sum() * far;
        }
        let is_off = (all(simd, 2.0) * (left / steepness)).simd_gt(error);
        let is_settled = Mask::splat(simd, placed.root_tolerance != 0.0);
        WidePoints { point, normal, error, unsure: !has_direction | is_off & !is_settled }
    }
}

impl Ellipsoid {
    /// Returns the points where each of four rays crosses it.
    #[inline(always)]
    pub(crate) fn surface_of_four<S: Simd>(
        &self,
        simd: S,
        ray: &WideRay<S>,
        t: Wide<S>,
    ) -> WidePoints<S> {
        let local_from_world = self.placement.local_from_world;
        let [sizes, out] = [local_from_world.abs(), local_from_world.transpose()];
        let centre = WideVector::splat(simd, self.placement.centre);
        let one = all(simd, 1.0);
        let rough = ray.origin + ray.direction * t;
        let [mut point, mut gradient] = [rough; 2];
        let (mut rest, mut unsure) = (one, Mask::splat(simd, false));
        for step in 0..2 {
            if step == 1 {
                point = rough - gradient * (rest / gradient.length_squared());
            }
            let local = times(simd, &local_from_world, point - centre);
            let distance = length(local);
            let reciprocal = one / distance;
            unsure |= !(reciprocal.is_finite() & reciprocal.simd_gt(all(simd, 0.0)));
            (rest, gradient) = (distance - one, times(simd, &out, local * reciprocal));
        }
        let steepness = length(gradient);
        let normal = gradient / steepness;
        let reach = length(times(simd, &sizes, (point - centre).abs()));
        let rounding = all(simd, U) * (all(simd, 24.0) * reach + all(simd, 12.0));
        let error = (rest.abs() + rounding) / steepness
            + all(simd, 2.0 * U) * normal.abs().dot(point.abs());
        WidePoints { point, normal, error, unsure }
    }
}

/// Returns the lengths of vectors.
#[inline(always)]
pub(super) fn length<S: Simd>(vector: WideVector<S>) -> Wide<S> {
    vector.length_squared().sqrt()
}

/// Returns the product of a matrix and a vector.
#[inline(always)]
pub(in super::super) fn times<S: Simd>(
    simd: S,
    matrix: &Matrix,
    vector: WideVector<S>,
) -> WideVector<S> {
    let WideVector([x, y, z]) = vector;
    WideVector::splat(simd, matrix.x_axis) * x
        + WideVector::splat(simd, matrix.y_axis) * y
        + WideVector::splat(simd, matrix.z_axis) * z
}
