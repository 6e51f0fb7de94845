//! Composes lists of transforms into affine maps in extended precision.
//!
//! **In:** steps as written. **Out:** one map; its numbers are rounded to `f64` only where they are used.
//! **Invariant:** dyadic numbers and multiples of 90° are exact; elsewhere each step adds at most
//! [`Affine::STEP_ROUNDING`] to the map's own bound, so that the error of 100,000 rotations stays six digits
//! below the resolution of an `f64`.

mod stretch;

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use super::Fault;
use crate::diagnostic::Code;
use crate::math::double::{Double, DoubleVector, power_of_two_near, sin_cos_degrees};
use crate::math::singular::singular_values;
use crate::math::transform::Step;
use crate::math::{Matrix, Vector};
use crate::scene::TransformId;

/// Maps with a larger condition number are reported: they lose more than half of the 53 bits of an `f64`.
pub const NEAR_SINGULAR: f64 = (1u64 << 26) as f64;

/// `p ↦ linear · p + offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Affine {
    /// The rows of the linear part.
    rows: [DoubleVector; 3],
    offset: DoubleVector,
    /// Bound on the rounding error of the linear part, relative to its size.
    rounding: f64,
    /// The linear part is the identity, as in most maps.
    pub is_translation: bool,
}

/// The inverse of the linear part before division: row i over `determinant`.
#[derive(Debug, Clone, Copy)]
pub struct Cofactors {
    pub rows: [DoubleVector; 3],
    pub determinant: Double,
}

impl Affine {
    pub const IDENTITY: Self = Self {
        rows: [
            DoubleVector::new(Double::ONE, Double::ZERO, Double::ZERO),
            DoubleVector::new(Double::ZERO, Double::ONE, Double::ZERO),
            DoubleVector::new(Double::ZERO, Double::ZERO, Double::ONE),
        ],
        offset: DoubleVector::ZERO,
        rounding: 0.0,
        is_translation: true,
    };

    fn new(rows: [DoubleVector; 3], offset: DoubleVector, rounding: f64) -> Self {
        Self { rows, offset, rounding, is_translation: rows == Self::IDENTITY.rows }
    }

    /// Returns the map that takes x, y and z to these columns, and the origin to `offset`.
    pub fn from_columns([x, y, z]: [DoubleVector; 3], offset: DoubleVector) -> Self {
        let [x, y, z] = [x, y, z].map(DoubleVector::components);
        let row = |i: usize| DoubleVector::new(x[i], y[i], z[i]);
        Self::new([row(0), row(1), row(2)], offset, Self::STEP_ROUNDING)
    }

    /// 2⁻⁹⁶: a rotation rounds a dozen times by 2⁻¹⁰² each.
    pub const STEP_ROUNDING: f64 = 1.0 / (1u128 << 96) as f64;

    /// Returns this map followed by one step, or, if `undone`, by the step's inverse. `part` returns the map
    /// of another list.
    ///
    /// Fails with `zero-scale` if the step flattens space, and with `not-a-number` if a number is not finite.
    fn then(
        mut self,
        step: &Step,
        undone: bool,
        part: impl FnOnce(TransformId, bool) -> Result<Self, Fault>,
    ) -> Result<Self, Fault> {
        match step {
            Step::Translate(by) => {
                let by = DoubleVector::from(*by);
                self.offset = self.offset + if undone { -by } else { by };
            }
            Step::Scale(by) => {
                for axis in 0..3 {
                    let factor = Double::from(by[axis]);
                    self.scale_row(axis, if undone { Double::ONE / factor } else { factor });
                }
                self = Self::new(self.rows, self.offset, self.rounding);
            }
            Step::Rotate(degrees) => {
                let turns = [(1, 2, degrees.x), (2, 0, degrees.y), (0, 1, degrees.z)];
                match undone {
                    false => turns.into_iter().for_each(|(a, b, by)| self.turn(a, b, by)),
                    true => turns.into_iter().rev().for_each(|(a, b, by)| self.turn(a, b, -by)),
                }
                self = Self::new(self.rows, self.offset, self.rounding);
            }
            Step::Matrix([x, y, z, offset]) => {
                let [x, y, z, offset] = [x, y, z, offset].map(|v| DoubleVector::from(*v));
                let matrix = Self::from_columns([x, y, z], offset);
                self = if undone { matrix.checked()? } else { matrix }.after(&self);
            }
            Step::Transform(id) => self = part(*id, undone)?.after(&self),
            Step::InverseOf(id) => self = part(*id, !undone)?.after(&self),
        }
        Ok(self)
    }

    fn scale_row(&mut self, axis: usize, factor: Double) {
        self.rows[axis] = self.rows[axis] * factor;
        let mut offset = self.offset.components();
        offset[axis] = offset[axis] * factor;
        self.offset = DoubleVector::new(offset[0], offset[1], offset[2]);
        self.rounding += Self::STEP_ROUNDING;
    }

    /// Rotates axis `a` toward axis `b`.
    fn turn(&mut self, a: usize, b: usize, degrees: f64) {
        if degrees == 0.0 {
            return;
        }
        let (sine, cosine) = sin_cos_degrees(degrees);
        let (row_a, row_b) = (self.rows[a], self.rows[b]);
        self.rows[a] = row_a * cosine - row_b * sine;
        self.rows[b] = row_a * sine + row_b * cosine;
        let mut offset = self.offset.components();
        let (offset_a, offset_b) = (offset[a], offset[b]);
        offset[a] = offset_a * cosine - offset_b * sine;
        offset[b] = offset_a * sine + offset_b * cosine;
        self.offset = DoubleVector::new(offset[0], offset[1], offset[2]);
        self.rounding += Self::STEP_ROUNDING;
    }

    /// Returns the map that applies `inner`, then this one.
    pub fn after(&self, inner: &Self) -> Self {
        if inner.moves_nothing() {
            return *self;
        }
        if self.moves_nothing() {
            return *inner;
        }
        let rounding = self.rounding + inner.rounding;
        let offset = self.point(inner.offset);
        // Most maps only translate: then nothing is rounded, and little is computed.
        if inner.is_translation {
            return Self { offset, rounding, ..*self };
        }
        if self.is_translation {
            return Self { offset, rounding, ..*inner };
        }
        let columns = inner.columns();
        let row = |row: DoubleVector| {
            DoubleVector::new(row.dot(columns[0]), row.dot(columns[1]), row.dot(columns[2]))
        };
        Self::new(self.rows.map(row), offset, rounding + Self::STEP_ROUNDING)
    }

    /// Returns whether this is exactly the identity, as most maps are.
    pub fn moves_nothing(&self) -> bool {
        self.rounding == 0.0 && self.is_identity()
    }

    pub fn is_identity(&self) -> bool {
        self.is_translation && self.offset == DoubleVector::ZERO
    }

    pub fn is_finite(&self) -> bool {
        let is_linear = self.is_translation || self.rows.iter().all(|row| row.is_finite());
        is_linear && self.offset.is_finite()
    }

    pub fn point(&self, p: DoubleVector) -> DoubleVector {
        match self.moves_nothing() {
            true => p,
            false => self.direction(p) + self.offset,
        }
    }

    pub fn direction(&self, d: DoubleVector) -> DoubleVector {
        if self.is_translation {
            return d;
        }
        DoubleVector::new(self.rows[0].dot(d), self.rows[1].dot(d), self.rows[2].dot(d))
    }

    pub fn rows(&self) -> [DoubleVector; 3] {
        self.rows
    }

    pub fn offset(&self) -> DoubleVector {
        self.offset
    }

    fn columns(&self) -> [DoubleVector; 3] {
        let [x, y, z] = self.rows;
        [
            DoubleVector::new(x.x, y.x, z.x),
            DoubleVector::new(x.y, y.y, z.y),
            DoubleVector::new(x.z, y.z, z.z),
        ]
    }

    /// Returns the relative difference below which two numbers are equal up to rounding.
    pub fn bound(&self) -> f64 {
        16.0 * (self.rounding + Self::STEP_ROUNDING)
    }

    /// Returns a unit vector that has gone through the map with each component that may be rounding set to 0.
    /// A vector that is turned and turned back is exactly axis-aligned again.
    pub fn without_rounding(&self, unit: DoubleVector) -> DoubleVector {
        unit.map(|c| if c.abs().round() <= 16.0 * self.rounding { Double::ZERO } else { c })
    }

    /// The largest number of the linear part, as a power of two.
    fn size(&self) -> f64 {
        power_of_two_near(self.rows.iter().map(|row| row.largest()).fold(0.0, f64::max))
    }

    /// Returns the cofactors; `None` when the map flattens space, that is, when its determinant is zero
    /// within the map's bound.
    pub fn cofactors(&self) -> Option<Cofactors> {
        // Scaled near 1 first, so that the determinant of a huge or tiny map is finite and not 0.
        let size = self.size();
        if size == 0.0 {
            return None;
        }
        let near_one = |v: DoubleVector| v.map(|c| c.times_power_of_two(1.0 / size));
        let [x, y, z] = self.columns().map(near_one);
        let determinant = x.dot(y.cross(z));
        // The size of the determinant without any cancellation.
        let [a, b, c] = [x, y, z].map(|v| v.round().abs());
        let uncancelled = a.x * (b.y * c.z + b.z * c.y)
            + a.y * (b.z * c.x + b.x * c.z)
            + a.z * (b.x * c.y + b.y * c.x);
        if determinant.abs().round() <= self.bound() * uncancelled {
            return None;
        }
        let rows = [y.cross(z), z.cross(x), x.cross(y)];
        Some(Cofactors { rows, determinant: determinant.times_power_of_two(size) })
    }

    /// Returns the condition number of the linear part: the largest factor by which it stretches a direction
    /// over the smallest. Infinite if the map flattens space.
    pub fn condition(&self) -> f64 {
        let size = self.size();
        let Some(Cofactors { determinant, .. }) = self.cofactors() else { return f64::INFINITY };
        let volume = determinant.times_power_of_two(1.0 / size).abs().round();
        let near_one = self.matrix(Double::from(1.0 / size));
        let [largest, middle, _] = singular_values(near_one);
        // The determinant holds the smallest factor to the last digit; the columns may not.
        largest / (volume / (largest * middle))
    }

    /// Returns the cofactors of the inverse, `None` for a translation; or why there is no inverse.
    fn checked_cofactors(&self) -> Result<Option<Cofactors>, Fault> {
        if !self.is_finite() {
            return Err(Fault::not_finite("this transform"));
        }
        if self.is_translation {
            return Ok(None);
        }
        let flat = || Fault::flat("this transform flattens space");
        self.cofactors().map(Some).ok_or_else(flat)
    }

    /// Returns the condition number, if it is at least [`NEAR_SINGULAR`].
    pub fn near_singular(&self) -> Option<f64> {
        if self.is_translation {
            return None;
        }
        // The largest factor, squared, times the middle one, over the volume: for most maps the sum of their
        // squares already shows that this is small.
        let size = self.size();
        let near_one = self.rows.map(|row| row.map(|c| c.times_power_of_two(1.0 / size)).round());
        let squares: f64 = near_one.into_iter().map(Vector::length_squared).sum();
        let volume = near_one[0].dot(near_one[1].cross(near_one[2])).abs();
        if squares * squares.sqrt() < 0.5 * NEAR_SINGULAR * volume {
            return None;
        }
        Some(self.condition()).filter(|&condition| condition >= NEAR_SINGULAR)
    }

    /// Returns the inverse, or the reason why there is none.
    pub fn checked(&self) -> Result<Self, Fault> {
        let Some(Cofactors { rows, determinant }) = self.checked_cofactors()? else {
            return Ok(Self { offset: -self.offset, ..*self });
        };
        let rows = rows.map(|row| row.map(|c| c / determinant));
        let linear = Self::new(rows, DoubleVector::ZERO, self.bound());
        Ok(Self { offset: -linear.direction(self.offset), ..linear })
    }

    /// Returns the factor by which lengths grow, if it is the same in all directions: when the rows are
    /// equally long and at right angles, within the map's bound (which is far below the resolution of `f64`).
    pub fn uniform_scale(&self) -> Option<Double> {
        if self.is_translation {
            return Some(Double::ONE);
        }
        // Scaled near 1 first, so that the square of a huge or tiny map is finite and not 0.
        let size = self.size();
        let [x, y, z] = self.rows.map(|row| row.map(|c| c.times_power_of_two(1.0 / size)));
        let squared = x.dot(x);
        let bound = self.bound() * squared.round();
        let small = |v: Double| v.abs().round() <= bound;
        let half = Double::from(0.5);
        let same = small((y.dot(y) - squared) * half) && small((z.dot(z) - squared) * half);
        let square = small(x.dot(y)) && small(y.dot(z)) && small(z.dot(x));
        (same && square && !squared.is_zero()).then(|| x.length().times_power_of_two(size))
    }

    /// Returns the linear part times `factor`, each number rounded once.
    pub fn matrix(&self, factor: Double) -> Matrix {
        let [x, y, z] = self.columns().map(|column| (column * factor).round());
        Matrix::from_cols(x, y, z)
    }
}

/// The maps of the Scene's transforms, each computed once: forward, and backward where it is inverted. The
/// inverse of a list inverts its steps from the last to the first, so that inverting an inverse loses
/// nothing.
pub struct Transforms<'s> {
    steps: &'s [Vec<Step>],
    /// The maps of lists and of their inverses. A single step is not kept: recomputing it is as fast.
    spent: FxHashMap<(TransformId, bool), Result<Affine, Fault>>,
    /// Condition numbers of at least [`NEAR_SINGULAR`].
    near_singular: BTreeMap<TransformId, f64>,
}

impl<'s> Transforms<'s> {
    pub fn new(steps: &'s [Vec<Step>]) -> Self {
        Self { steps, spent: FxHashMap::default(), near_singular: BTreeMap::new() }
    }

    /// Returns the map of a list of transforms.
    pub fn get(&mut self, id: TransformId) -> Result<Affine, Fault> {
        if let [Step::Translate(_) | Step::Scale(_) | Step::Rotate(_) | Step::Matrix(_)] =
            self.steps[id.index()][..]
        {
            let map = self.spend(id, false);
            self.note_condition(id, map.as_ref().ok());
            return map;
        }
        // Lists refer to lists: an explicit stack holds the unfinished ones.
        let mut open = vec![(id, false)];
        while let Some(&(id, undone)) = open.last() {
            if self.known(id, undone).is_some() {
                open.pop();
                continue;
            }
            let under_way = open.len();
            let parts = self.steps[id.index()].iter().filter_map(|step| match *step {
                Step::Transform(part) => Some((part, undone)),
                Step::InverseOf(part) => Some((part, !undone)),
                Step::Translate(_) | Step::Scale(_) | Step::Rotate(_) | Step::Matrix(_) => None,
            });
            open.extend(parts.filter(|&(part, undone)| self.known(part, undone).is_none()));
            if open.len() == under_way {
                let map = self.spend(id, undone);
                self.note_condition(id, map.as_ref().ok());
                self.spent.insert((id, undone), map);
            }
        }
        self.known(id, false).cloned().unwrap_or(Ok(Affine::IDENTITY))
    }

    fn known(&self, id: TransformId, undone: bool) -> Option<&Result<Affine, Fault>> {
        self.spent.get(&(id, undone))
    }

    /// Returns the map of a list whose parts are known.
    fn spend(&self, id: TransformId, undone: bool) -> Result<Affine, Fault> {
        let steps = &self.steps[id.index()];
        let part = |id, undone| self.known(id, undone).cloned().unwrap_or(Ok(Affine::IDENTITY));
        let map = if undone {
            steps.iter().rev().try_fold(Affine::IDENTITY, |map, step| map.then(step, true, part))?
        } else {
            steps.iter().try_fold(Affine::IDENTITY, |map, step| map.then(step, false, part))?
        };
        match steps.iter().all(is_rigid) && map.is_finite() {
            true => Ok(map),
            false => map.checked_cofactors().map(|_| map),
        }
    }

    /// Records a list that nearly flattens space, unless a list inside it already does.
    fn note_condition(&mut self, id: TransformId, map: Option<&Affine>) {
        let strained = |step: &Step| match step {
            Step::Transform(part) | Step::InverseOf(part) => self.near_singular.contains_key(part),
            Step::Translate(_) | Step::Scale(_) | Step::Rotate(_) | Step::Matrix(_) => false,
        };
        let steps = &self.steps[id.index()];
        if steps.iter().all(is_rigid) || steps.iter().any(strained) {
            return;
        }
        if let Some(condition) = map.and_then(Affine::near_singular) {
            self.near_singular.insert(id, condition);
        }
    }

    /// Returns the condition number of a computed transform, if it is at least [`NEAR_SINGULAR`].
    pub fn near_singular(&self, id: TransformId) -> Option<f64> {
        self.near_singular.get(&id).copied()
    }

    /// Returns the composition of all of `ids`, in order.
    pub fn product(&mut self, ids: &[TransformId]) -> Result<Affine, Fault> {
        ids.iter().try_fold(Affine::IDENTITY, |map, &id| Ok(self.get(id)?.after(&map)))
    }
}

/// Returns whether a step by itself keeps all lengths.
fn is_rigid(step: &Step) -> bool {
    matches!(step, Step::Translate(_) | Step::Rotate(_))
}

impl Fault {
    fn flat(message: &str) -> Self {
        Self::new(Code::ZeroScale, message)
            .label("no volume is left after this")
            .help("every factor must be other than 0; 1 leaves a direction as it is")
    }
}

/// Converts a vector of `f64` exactly.
pub fn exact(v: Vector) -> DoubleVector {
    DoubleVector::from(v)
}
