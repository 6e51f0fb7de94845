//! Polyhedron: the box around what half-spaces share, proven by what they add up to.
//!
//! With y ≥ 0 and Σ yᵢ·Nᵢ = A, A·P = Σ yᵢ·(Nᵢ·P) ≤ Σ yᵢ·dᵢ for each P that is in all of them: of
//! all such y the one whose sum is least tells how far they go along A. It is looked for by the simplex
//! method, three half-spaces at a time; whatever it finds, the sum is a bound.
//!
//! **Invariant:** all that they share lies within the box, and what rounding may move each of them by; where
//! that has no end, there is no box.
//!
//! **Source:** V. Chvátal, *Linear Programming* (1983), ch. 7 (the revised simplex method); A. Neumaier,
//! O. Shcherbina, "Safe bounds in linear and mixed-integer linear programming", Mathematical Programming 99
//! (2004).

use crate::math::{AbsDot, Matrix, Vector};
use crate::shape::{Bounds, Box_, Plane, Rounding};

/// The roundoff.
const U: f64 = f64::EPSILON / 2.0;
/// So many roundings a kernel makes where it meets a face, of the size of its numbers.
const ROUNDINGS: f64 = 16.0;
/// So often one of the three is exchanged: more often than ever was seen to be needed.
const MOST_STEPS: usize = 256;
/// What is less in size is 0 of the shares of unit vectors.
const NO_SHARE: f64 = 1.0 / (1u64 << 40) as f64;

/// Where N·P ≤ d.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HalfSpace {
    /// Of length 1.
    normal: Vector,
    offset: f64,
    /// How large the numbers are that the offset is made of: of them it is rounded.
    size: f64,
    /// It stands for an axis, and bounds nothing.
    is_axis: bool,
}

impl HalfSpace {
    pub fn of_plane(plane: &Plane) -> Self {
        let (normal, offset) = (plane.normal.get(), plane.distance);
        Self { normal, offset, size: offset.abs(), is_axis: false }
    }

    /// The six that a box is made of.
    pub fn of_box(solid: &Box_) -> impl Iterator<Item = Self> {
        let (centre, widths) = (solid.centre, solid.half_widths);
        let faces = solid
            .normals
            .into_iter()
            .zip(widths)
            .flat_map(|(normal, width)| [(normal.get(), width), (-normal.get(), width)]);
        faces.map(move |(normal, width)| Self {
            normal,
            offset: normal.dot(centre) + width,
            size: normal.abs_dot(centre) + width,
            is_axis: false,
        })
    }

    /// Those that bounds are made of, as far as they have an end.
    fn of_bounds(bounds: &Bounds) -> impl Iterator<Item = Self> {
        let sides = [0, 1, 2].into_iter().flat_map(|axis| {
            let normal = Vector::AXES[axis];
            [(normal, bounds.high[axis]), (-normal, -bounds.low[axis])]
        });
        let side = |(normal, offset): (Vector, f64)| Self {
            normal,
            offset,
            size: offset.abs(),
            is_axis: false,
        };
        sides.filter(|(_, offset)| offset.is_finite()).map(side)
    }

    fn axis(normal: Vector) -> Self {
        Self { normal, offset: 0.0, size: 0.0, is_axis: true }
    }

    /// Whether it is no side of a box along the axes.
    fn is_slanted(&self) -> bool {
        self.normal.abs().max_element() != 1.0
    }
}

/// Of what lies in all of some half-spaces and in some bounds; `None` where nothing more is known of it than
/// these.
pub(super) fn bounds(faces: &[HalfSpace], within: &Bounds, rounding: Rounding) -> Option<Bounds> {
    if !faces.iter().any(HalfSpace::is_slanted) {
        return None;
    }
    let spaces: Vec<HalfSpace> =
        faces.iter().copied().chain(HalfSpace::of_bounds(within)).collect();
    let mut ends = [End::default(); 6];
    for (end, axis) in ends.iter_mut().zip(Vector::AXES.into_iter().flat_map(|axis| [axis, -axis]))
    {
        *end = end_along(&spaces, axis)?;
    }
    // All places are within `far` of the origin along each axis: far ≤ farthest + share·far.
    let greatest = |of: fn(&End) -> f64| ends.iter().map(of).fold(0.0, f64::max);
    let share = greatest(|end| end.share);
    let far = greatest(|end| end.place.abs() + end.rounded) / (1.0 - share);
    let place = |end: &End| match rounding {
        Rounding::Nearest => end.place,
        Rounding::Outward => end.place + (end.rounded + end.share * far) * (1.0 + 8.0 * U),
    };
    let high = Vector::from_array([0, 2, 4].map(|i| place(&ends[i])));
    let low = -Vector::from_array([1, 3, 5].map(|i| place(&ends[i])));
    (share < 0.5 && far.is_finite()).then_some(Bounds { low, high })
}

/// How far half-spaces go along an axis: no farther than `place + rounded + share·far`, if no coordinate is
/// above `far` in size.
#[derive(Debug, Clone, Copy, Default)]
struct End {
    place: f64,
    rounded: f64,
    share: f64,
}

fn end_along(spaces: &[HalfSpace], axis: Vector) -> Option<End> {
    // Of the axis itself there is one; first it is made of others, then of the best.
    let start = [0, 1, 2].map(|i| axis[i] + f64::from(axis[i] == 0.0));
    let mut basis =
        Basis { parts: [0, 1, 2].map(|i| HalfSpace::axis(Vector::AXES[i] * start[i])), axis };
    basis.improve(spaces, |space| f64::from(space.is_axis));
    basis.improve(spaces, |space| space.offset);
    basis.end()
}

/// Three half-spaces whose normals make an axis.
struct Basis {
    parts: [HalfSpace; 3],
    axis: Vector,
}

impl Basis {
    /// The inverse of the matrix of the normals, and how much of each makes the axis.
    fn shares(&self) -> (Matrix, Vector) {
        let [a, b, c] = self.parts.map(|part| part.normal);
        let normals = Matrix::from_cols(a, b, c);
        let inverse = normals.inverse();
        let rough = inverse * self.axis;
        (inverse, rough + inverse * (self.axis - normals * rough))
    }

    /// Exchanges parts for such of `spaces` as make the sum of the costs less, as long as there are any.
    fn improve(&mut self, spaces: &[HalfSpace], cost: impl Fn(&HalfSpace) -> f64) {
        for _ in 0..MOST_STEPS {
            let (inverse, shares) = self.shares();
            // The corner: what a half-space would have to cost there is what others make it for.
            let corner =
                inverse.transpose() * Vector::from_array(self.parts.map(|part| cost(&part)));
            let gain = |space: &HalfSpace| {
                let rounded = 8.0 * U * (space.normal.abs_dot(corner) + cost(space).abs());
                space.normal.dot(corner) - cost(space) - rounded
            };
            let gains = spaces.iter().map(|space| (gain(space), space));
            let best = gains.filter(|(gain, _)| *gain > 0.0).max_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, &best)) = best else { return };
            let made_of = inverse * best.normal;
            // What runs out first goes; an axis that counts for nothing at once, lest it count again.
            let lasts = |i: usize| {
                let spent = self.parts[i].is_axis && shares[i] <= NO_SHARE;
                match made_of[i] {
                    share if spent && share.abs() > NO_SHARE => Some(0.0),
                    share if share > NO_SHARE => Some(shares[i] / share),
                    _ => None,
                }
            };
            let first =
                (0..3).filter_map(|i| Some((lasts(i)?, i))).min_by(|a, b| a.0.total_cmp(&b.0));
            // There is no such place: any bound holds.
            let Some((_, first)) = first else { return };
            self.parts[first] = best;
        }
    }

    /// What the half-spaces add up to; `None` where they do not make the axis.
    fn end(&self) -> Option<End> {
        let (_, shares) = self.shares();
        let (mut end, mut left, mut sizes) = (End::default(), self.axis, Vector::ZERO);
        for (part, share) in self.parts.iter().zip(shares.max(Vector::ZERO).to_array()) {
            if part.is_axis {
                continue;
            }
            end.place += share * part.offset;
            end.rounded += share * (ROUNDINGS * U) * part.size;
            end.share += share * (2.0 * ROUNDINGS * U);
            left -= part.normal * share;
            sizes += part.normal.abs() * share;
        }
        end.share += left.abs().element_sum() + 8.0 * U * sizes.element_sum();
        (end.share < 0.5).then_some(end)
    }
}
