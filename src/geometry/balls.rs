//! Balls around solids, four tested together: which of a few solids a ray may meet.
//!
//! **Invariant:** no ball that a ray's crossing lies in is missed; what is met in vain costs time
//! only.

use crate::math::Vector;
use crate::math::wide::*;
use crate::shape::Ray;

pub(super) const LANES: usize = 4;

/// For the rounding of the test.
const SLACK: f64 = 1.0 + 32.0 * f64::EPSILON;

/// Four balls by coordinates, so that they are tested two to an instruction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Balls {
    centres: [[f64; LANES]; 3],
    reaches_squared: [f64; LANES],
    /// A bit for each that there is.
    present: u32,
}

/// A ball that holds a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ball {
    pub centre: Vector,
    /// The square of its radius; ∞ where squares of this size are not to be trusted.
    pub reach_squared: f64,
}

impl Ball {
    /// Is always met.
    pub const EVERYWHERE: Self = Self { centre: Vector::ZERO, reach_squared: f64::INFINITY };

    /// Around the centre with the square of a radius. A little is added for what [`Balls::met`]
    /// rounds, and all when a start 1e8 radii away has no square.
    pub fn new(centre: Vector, radius_squared: f64) -> Self {
        if radius_squared > f64::MAX / 1e20 {
            return Self::EVERYWHERE;
        }
        let reach_squared = radius_squared * (1.0 + 4.0 * f64::EPSILON) + f64::MIN_POSITIVE;
        Self { centre, reach_squared }
    }
}

impl Balls {
    /// Of up to four.
    pub fn new(balls: &[Ball]) -> Self {
        let mut all =
            Self { centres: [[0.0; LANES]; 3], reaches_squared: [0.0; LANES], present: 0 };
        for (lane, ball) in balls.iter().enumerate().take(LANES) {
            for axis in 0..3 {
                all.centres[axis][lane] = ball.centre[axis];
            }
            all.reaches_squared[lane] = ball.reach_squared;
            all.present |= 1 << lane;
        }
        all
    }

    /// A bit for each ball that the ray may meet.
    ///
    /// With f = S − C and b = min(f·D, 0), the ray is at nearest √(|f|² − b²) from the centre. That
    /// square is off by 5u·|f|² (the sums), 8u·|f|·|b| (f·D) and 9u·b² (the direction's length), u the
    /// roundoff: at most 6u·r² + 60u·b² where the ball is met.
    ///
    /// Not inlined: only in a small function of its own do two lanes go into each instruction.
    #[inline(never)]
    pub fn met(&self, ray: &Ray) -> u32 {
        self.met_from(ray, 0.0)
    }

    /// [`Self::met`], also behind the ray's start.
    #[inline(never)]
    pub fn met_by_line(&self, ray: &Ray) -> u32 {
        self.met_from(ray, f64::INFINITY)
    }

    /// Of rays that may meet the ball of a lane.
    #[inline(always)]
    pub fn met_by_four<S: Simd>(&self, simd: S, lane: usize, ray: &WideRay<S>) -> Mask<S> {
        self.met_by_four_from(simd, lane, ray, 0.0)
    }

    /// [`Self::met_by_four`], also behind the rays' starts.
    #[inline(always)]
    pub fn met_by_four_lines<S: Simd>(&self, simd: S, lane: usize, ray: &WideRay<S>) -> Mask<S> {
        self.met_by_four_from(simd, lane, ray, f64::INFINITY)
    }

    /// Of rays that start so far behind their starts.
    #[inline(always)]
    fn met_by_four_from<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        ray: &WideRay<S>,
        most: f64,
    ) -> Mask<S> {
        let [x, y, z] = &self.centres;
        let centre = WideVector::splat(simd, Vector::new(x[lane], y[lane], z[lane]));
        let start = ray.origin - centre;
        let along = start.dot(ray.direction);
        let toward = along.simd_lt(all(simd, most)).select(along, all(simd, most));
        let excess = start.length_squared() - toward * toward * all(simd, SLACK);
        let excess = excess - all(simd, self.reaches_squared[lane]);
        // What is no number is no miss.
        !excess.simd_gt(all(simd, 0.0))
    }

    /// Of a ray that starts so far behind its start.
    #[inline(always)]
    fn met_from(&self, ray: &Ray, most: f64) -> u32 {
        let [origin, direction] = [ray.origin, ray.direction].map(|v| v.to_array());
        let mut excess = [0.0; LANES];
        for (lane, excess) in excess.iter_mut().enumerate() {
            let [x, y, z] = [0, 1, 2].map(|axis: usize| origin[axis] - self.centres[axis][lane]);
            let along = x * direction[0] + y * direction[1] + z * direction[2];
            let toward = if along < most { along } else { most };
            *excess =
                (x * x + y * y + z * z) - toward * toward * SLACK - self.reaches_squared[lane];
        }
        // What is no number is no miss.
        let missed = (0..LANES).fold(0, |all, lane| all | u32::from(excess[lane] > 0.0) << lane);
        self.present & !missed
    }
}
