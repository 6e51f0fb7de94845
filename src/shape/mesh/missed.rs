//! Which of four lines certainly miss a mesh of few faces.
//!
//! **Invariant:** what is certain here is certain for [`View::pierces`](super::pierce::View::pierces), with room to
//! spare.

use super::super::slab::MEANT;
use super::super::{Placed, U};
use super::{FEW, Mesh};
use crate::math::wide::*;

/// Four lines in the local space of a placed body; see [`super::super::local::LocalRay`].
pub(in super::super) struct WideLines<S: Simd> {
    pub nearest: WideVector<S>,
    pub direction: WideVector<S>,
    pub blur: Wide<S>,
    pub turn: Wide<S>,
    /// Distance of each from the local origin.
    pub miss: Wide<S>,
}

impl<S: Simd> WideLines<S> {
    /// Returns bounds of what corners are off in a [`View`](super::pierce::View), for rays in world space.
    #[inline(always)]
    fn doubts(&self, simd: S, placed: &Placed, origin: WideVector<S>, size: f64) -> Wide<S> {
        let reach = all(simd, size) + self.miss;
        let own = self.blur + self.turn * reach + all(simd, 16.0 * U) * reach;
        let Some(exact) = placed.exact.as_deref() else { return own + own };
        let centre = placed.placement.centre.abs();
        // No less than the distance from the centre, and than any coordinate.
        let far = origin.abs().element_sum() + all(simd, centre.element_sum());
        let rounded = all(simd, exact.condition * size) + all(simd, exact.norm) * far;
        let meant = all(simd, 1.75 * MEANT * exact.norm) * far;
        let off = own + all(simd, 16.0 * U) * rounded + meant;
        off + off
    }
}

impl Mesh {
    /// Returns which of four lines may pierce a face; all of them, if it has many.
    ///
    /// With a and b the ways from a point of the line to two corners, the line with direction d passes their edge on
    /// the side that the sign of d·(a × b) tells. No way is longer than `far`. In a view along d's dominant axis,
    /// which is at least 1/√3 of it, the same turn is that product over the component of d; its rounding and that of
    /// the product are less than 64u·far², and the doubts add 4·(far + doubt) times theirs.
    #[inline(always)]
    pub(in super::super) fn may_be_pierced<S: Simd>(
        &self,
        simd: S,
        placed: &Placed,
        lines: &WideLines<S>,
        origin: WideVector<S>,
    ) -> Mask<S> {
        if self.faces.len() > FEW {
            return Mask::splat(simd, true);
        }
        let doubt = lines.doubts(simd, placed, origin, self.reach);
        // No sum of three coordinates is greater.
        let far = all(simd, 1.75) * (all(simd, self.reach) + lines.miss);
        let off = all(simd, 64.0 * U) * far * far
            + all(simd, 4.0) * doubt * (far + doubt)
            + all(simd, 64.0 * f64::MIN_POSITIVE);
        let mut may_be_pierced = Mask::splat(simd, false);
        for face in &self.faces {
            let [a, b, c] = self.corners_of(face);
            let a = WideVector::splat(simd, a) - lines.nearest;
            let b = WideVector::splat(simd, b) - lines.nearest;
            let c = WideVector::splat(simd, c) - lines.nearest;
            let ab = turn(lines.direction, a, b);
            let bc = turn(lines.direction, b, c);
            let ca = turn(lines.direction, c, a);
            let left = ab.simd_gt(off) | bc.simd_gt(off) | ca.simd_gt(off);
            let right = ab.simd_lt(-off) | bc.simd_lt(-off) | ca.simd_lt(-off);
            may_be_pierced |= !(left & right);
        }
        may_be_pierced
    }
}

/// Returns d·(a × b).
#[inline(always)]
fn turn<S: Simd>(d: WideVector<S>, a: WideVector<S>, b: WideVector<S>) -> Wide<S> {
    let ([a, b, c], [x, y, z]) = (a.0, b.0);
    d.dot(WideVector([b * z - c * y, c * x - a * z, a * y - b * x]))
}
