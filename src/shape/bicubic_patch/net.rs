//! Control nets of Bézier surfaces of degree 3 in both parameters: 16 points in four rows of four.
//!
//! **Invariant:** the surface, its parts and its derivatives each lie within the box of their own net.
//!
//! **Source:** G. Farin, *Curves and Surfaces for CAGD*, 5th ed. (2002), ch. 5 and 14.

use crate::math::Vector;

/// A control net: `u` runs along the rows, `v` from row to row, both from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Net(pub [Vector; 16]);

/// A point on the surface, and the derivatives there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub point: Vector,
    pub along_u: Vector,
    pub along_v: Vector,
}

/// A net relative to a line, restricted to the directions across it: x and y.
#[derive(Debug, Clone, Copy)]
pub(super) struct Across([[f64; 2]; 16]);

impl Across {
    /// Returns the point and the derivatives along u and v, bit-identical to [`Net::at`].
    pub fn at(&self, u: f64, v: f64) -> [[f64; 2]; 3] {
        let ((across, slope_u), (down, slope_v)) = (weights(u), weights(v));
        let mut all = [[0.0; 2]; 3];
        for (row, points) in self.0.chunks_exact(4).enumerate() {
            for axis in 0..2 {
                let weighed = |weights: [f64; 4]| {
                    points[0][axis] * weights[0]
                        + points[1][axis] * weights[1]
                        + points[2][axis] * weights[2]
                        + points[3][axis] * weights[3]
                };
                let point = weighed(across);
                all[0][axis] += point * down[row];
                all[1][axis] += weighed(slope_u) * down[row];
                all[2][axis] += point * slope_v[row];
            }
        }
        all
    }
}

/// Values of the four Bernstein polynomials, and their slopes.
fn weights(t: f64) -> ([f64; 4], [f64; 4]) {
    let r = 1.0 - t;
    let values = [r * r * r, 3.0 * r * r * t, 3.0 * r * t * t, t * t * t];
    let slopes = [-3.0 * r * r, 3.0 * r * (r - 2.0 * t), 3.0 * t * (2.0 * r - t), 3.0 * t * t];
    (values, slopes)
}

fn halves([a, b, c, d]: [Vector; 4]) -> ([Vector; 4], [Vector; 4]) {
    let half = |p: Vector, q: Vector| (p + q) * 0.5;
    let (ab, bc, cd) = (half(a, b), half(b, c), half(c, d));
    let (abc, bcd) = (half(ab, bc), half(bc, cd));
    let middle = half(abc, bcd);
    ([a, ab, abc, middle], [middle, bcd, cd, d])
}

impl Net {
    pub fn at(&self, u: f64, v: f64) -> Place {
        let ((across, slope_u), (down, slope_v)) = (weights(u), weights(v));
        let mut place = Place { point: Vector::ZERO, along_u: Vector::ZERO, along_v: Vector::ZERO };
        for (row, points) in self.0.chunks_exact(4).enumerate() {
            let weighed = |weights: [f64; 4]| {
                points[0] * weights[0]
                    + points[1] * weights[1]
                    + points[2] * weights[2]
                    + points[3] * weights[3]
            };
            let point = weighed(across);
            place.point += point * down[row];
            place.along_u += weighed(slope_u) * down[row];
            place.along_v += point * slope_v[row];
        }
        place
    }

    pub fn across(&self) -> Across {
        Across(self.0.map(|point| [point.x, point.y]))
    }

    pub fn map(&self, f: impl Fn(Vector) -> Vector) -> Self {
        let mut mapped = *self;
        mapped.0.iter_mut().for_each(|point| *point = f(*point));
        mapped
    }

    /// Keeps the part for the lower half of u, and returns the upper one.
    pub fn halve_along_u(&mut self) -> Self {
        self.halve(|line, i| 4 * line + i)
    }

    /// Like [`Self::halve_along_u`], along v.
    pub fn halve_along_v(&mut self) -> Self {
        self.halve(|line, i| 4 * i + line)
    }

    /// Halves each of four curves; the i-th point of each is `at(line, i)`.
    fn halve(&mut self, at: impl Fn(usize, usize) -> usize) -> Self {
        let mut high = *self;
        for line in 0..4 {
            let (first, second) = halves(std::array::from_fn(|i| self.0[at(line, i)]));
            for i in 0..4 {
                self.0[at(line, i)] = first[i];
                high.0[at(line, i)] = second[i];
            }
        }
        high
    }

    /// Returns the control points of the derivative along u.
    pub fn steps_along_u(&self) -> [Vector; 12] {
        std::array::from_fn(|i| {
            let at = 4 * (i / 3) + i % 3;
            (self.0[at + 1] - self.0[at]) * 3.0
        })
    }

    /// Returns the control points of the derivative along v.
    pub fn steps_along_v(&self) -> [Vector; 12] {
        std::array::from_fn(|i| (self.0[i + 4] - self.0[i]) * 3.0)
    }

    /// Returns the corners of its bounding box.
    pub fn bounds(&self) -> (Vector, Vector) {
        bounds(&self.0)
    }

    /// Returns the control points of an edge: u = 0, u = 1, v = 0, v = 1.
    pub fn edge(&self, edge: usize) -> [Vector; 4] {
        std::array::from_fn(|i| match edge {
            0 => self.0[4 * i],
            1 => self.0[4 * i + 3],
            2 => self.0[i],
            _ => self.0[12 + i],
        })
    }

    /// Returns an upper bound on `along`·P over the surface, too large by at most 2⁻¹² of its size.
    pub fn greatest(&self, along: Vector) -> f64 {
        /// More pieces than any surface needs, unless it is nearly flat across `along`.
        const MOST: usize = 4096;
        let value = |net: &Self| {
            let heights = net.0.map(|point| point.dot(along));
            let hull = heights.into_iter().fold(f64::NEG_INFINITY, f64::max);
            let corners = [0, 3, 12, 15].map(|i| heights[i]);
            (hull, corners.into_iter().fold(f64::NEG_INFINITY, f64::max))
        };
        let (low, high) = self.bounds();
        let enough = (high - low).length() * along.length() / 4096.0;
        let (hull, mut found) = value(self);
        let (mut pieces, mut greatest) = (vec![(*self, hull, 0)], f64::NEG_INFINITY);
        let mut count = 0;
        while let Some((mut net, hull, depth)) = pieces.pop() {
            count += 1;
            if hull <= found + enough || count > MOST {
                greatest = greatest.max(hull);
                continue;
            }
            let high = if depth % 2 == 0 { net.halve_along_u() } else { net.halve_along_v() };
            for half in [net, high] {
                let (hull, corner) = value(&half);
                found = found.max(corner);
                pieces.push((half, hull, depth + 1));
            }
        }
        greatest.max(found)
    }
}

pub(super) fn bounds(points: &[Vector]) -> (Vector, Vector) {
    let all = (Vector::INFINITY, Vector::NEG_INFINITY);
    points.iter().fold(all, |(low, high), point| (low.min(*point), high.max(*point)))
}
