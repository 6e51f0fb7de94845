//! `repeat`: copies of one slice of a pattern, side by side.

use super::Warping;
use crate::math::Vector;
use crate::math::finite::single;
use crate::pattern::parameter::parameters;
use crate::pattern::settled;

parameters! {
    /// The slice from 0 to `width` along an axis, repeated in both directions. The n-th copy shows what is n
    /// times `offset` away from there; every other copy is mirrored along the axes of `flip`: along that of
    /// `width` within the slice, along others at 0.
    ///
    /// **Source:** POV-Ray manual, section "Repeat Warp"; that the width and its multiples are in single
    /// precision as in POV-Ray 3.7 (measured).
    pub struct Repeat {
        after width: Vector = Vector::X, "the width of the slice, along one axis";
        "offset" offset: Vector = Vector::ZERO, "the offset of each copy from the one before";
        "flip" flip: Vector = Vector::ZERO, "the axes along which every other copy is mirrored";
    }
}

impl Warping for Repeat {
    /// Keeps the first component of the width that is not 0; POV-Ray 3.7 rejects another, or none.
    fn canonical(self) -> Self {
        let mut width = Vector::ZERO;
        if let Some(axis) = (0..3).find(|&axis| self.width[axis] != 0.0) {
            width[axis] = single(self.width[axis]);
        }
        Self { width, ..self }
    }

    #[inline]
    fn moved(&self, mut point: Vector, error: Vector) -> (Vector, Vector) {
        let Some(axis) = (0..3).find(|&axis| self.width[axis] != 0.0) else {
            return (point, error);
        };
        let width = self.width[axis];
        let place = point[axis] / width;
        let count = settled(place, error[axis] / width.abs()).floor();
        point[axis] -= single(count * width);
        // Every number beyond 2⁵³ is even.
        if 0.5 * count != (0.5 * count).floor() {
            for other in 0..3 {
                if self.flip[other] != 0.0 {
                    point[other] = if other == axis { width - point[other] } else { -point[other] };
                }
            }
        }
        (point + self.offset * count, error)
    }
}
