//! Numbers side by side, four to an instruction, with the instructions that the processor has.
//!
//! What computes with numbers side by side is always inlined into what [`dispatch`] calls, and passes them to no
//! closure: only there are the instructions known.
//!
//! **Invariant:** each lane has the bits of the same operations on single numbers, whatever the instructions: nothing
//! is fused, and nothing is approximated but by [`elementary`].

pub(crate) mod elementary;

pub(crate) use fearless_simd::dispatch;
pub(crate) use fearless_simd::prelude::*;
use fearless_simd::{Level, f64x4, mask64x4, u64x4};

use super::Vector;
use super::ray::Ray;

/// Numbers of a [`Row`].
pub const ROW: usize = 16;
/// Numbers to an instruction.
pub const LANES: usize = 4;
/// Groups of a row.
pub const GROUPS: usize = ROW / LANES;

/// Numbers side by side.
pub type Row = [f64; ROW];
pub(crate) type Wide<S> = f64x4<S>;
pub(crate) type Mask<S> = mask64x4<S>;
pub(crate) type WideBits<S> = u64x4<S>;

/// The instructions that compute with numbers side by side. No bit of a picture depends on them.
#[derive(Debug, Clone, Copy)]
pub struct Instructions(Level);

impl Instructions {
    /// Returns the widest that the processor has.
    pub fn best() -> Self {
        Self(Level::new())
    }

    /// Returns the narrowest and the widest that the processor has.
    pub fn all() -> [Self; 2] {
        [Self(Level::baseline()), Self::best()]
    }

    /// Returns what [`dispatch`] takes.
    #[inline(always)]
    pub(crate) fn level(self) -> Level {
        self.0
    }
}

/// No result depends on them.
impl PartialEq for Instructions {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Vectors side by side, by coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rows(pub [Row; 3]);

impl Rows {
    pub const ZERO: Self = Self([[0.0; ROW]; 3]);

    /// Returns the vector of this number.
    #[inline(always)]
    pub fn at(&self, number: usize) -> Vector {
        let Self([x, y, z]) = self;
        Vector::new(x[number], y[number], z[number])
    }

    /// Replaces the vector of this number.
    #[inline(always)]
    pub fn set(&mut self, number: usize, vector: Vector) {
        let Self([x, y, z]) = self;
        (x[number], y[number], z[number]) = (vector.x, vector.y, vector.z);
    }
}

/// Up to [`ROW`] rays side by side.
#[derive(Debug)]
pub struct Rays {
    pub origins: Rows,
    pub directions: Rows,
    /// A bit for each ray that there is.
    pub mask: u32,
}

impl Rays {
    pub const NONE: Self = Self { origins: Rows::ZERO, directions: Rows::ZERO, mask: 0 };

    /// Returns the first rays of a list.
    #[inline(always)]
    pub fn new<'a>(list: impl Iterator<Item = &'a Ray>) -> Self {
        let mut rays = Self::NONE;
        list.enumerate().take(ROW).for_each(|(number, ray)| rays.set(number, ray));
        rays
    }

    /// Adds the ray of this number.
    #[inline(always)]
    pub fn set(&mut self, number: usize, ray: &Ray) {
        self.origins.set(number, ray.origin);
        self.directions.set(number, ray.direction);
        self.mask |= 1 << number;
    }

    /// Returns the ray of this number.
    #[inline(always)]
    pub fn at(&self, number: usize) -> Ray {
        Ray { origin: self.origins.at(number), direction: self.directions.at(number) }
    }

    #[inline(always)]
    pub(crate) fn four<S: Simd>(&self, simd: S, group: usize) -> WideRay<S> {
        let origin = WideVector::of(simd, &self.origins, group);
        WideRay { origin, direction: WideVector::of(simd, &self.directions, group) }
    }
}

/// Returns the same number in each lane.
#[inline(always)]
pub(crate) fn all<S: Simd>(simd: S, number: f64) -> Wide<S> {
    Wide::splat(simd, number)
}

/// Returns the numbers of a group of a row.
#[inline(always)]
pub(crate) fn four<S: Simd>(simd: S, row: &Row, group: usize) -> Wide<S> {
    Wide::from_slice(simd, &row[LANES * group..LANES * group + LANES])
}

/// Replaces the numbers of a group of a row.
#[inline(always)]
pub(crate) fn store<S: Simd>(numbers: Wide<S>, row: &mut Row, group: usize) {
    numbers.store_slice(&mut row[LANES * group..LANES * group + LANES]);
}

/// Returns the bits of a group within those of a row.
#[inline(always)]
pub(crate) fn bits<S: Simd>(mask: Mask<S>, group: usize) -> u32 {
    (mask.to_bitmask() as u32) << (LANES * group)
}

/// Returns the lanes of a group whose bits are set in those of a row.
#[inline(always)]
pub(crate) fn mask<S: Simd>(simd: S, bits: u32, group: usize) -> Mask<S> {
    Mask::from_bitmask(simd, u64::from(lanes(bits, group)))
}

/// Returns whether a group has one of the bits of a row.
#[inline(always)]
pub(crate) fn has(bits: u32, group: usize) -> bool {
    lanes(bits, group) != 0
}

/// Returns the bits of a group.
#[inline(always)]
pub(crate) fn lanes(bits: u32, group: usize) -> u32 {
    bits >> (LANES * group) & ((1 << LANES) - 1)
}

/// Runs a statement, with the widest instructions, for the points of each group of a row that a mask has bits for. A
/// macro, as a closure would not be compiled for the instructions.
macro_rules! by_group {
    ($points:expr, $mask:expr, |$simd:ident, $four:ident, $lanes:ident, $group:ident| $run:expr) => {
        dispatch!(Instructions::best().level(), $simd => {
            for $group in 0..GROUPS {
                let $lanes = lanes($mask, $group);
                if $lanes != 0 {
                    let $four = WideVector::of($simd, $points, $group);
                    $run;
                }
            }
        })
    };
}

pub(crate) use by_group;

/// Returns the numbers of the bits of a row.
#[inline(always)]
pub(crate) fn numbers(bits: u32) -> Numbers {
    Numbers(bits)
}

/// The numbers of bits, from the lowest on.
pub(crate) struct Numbers(u32);

impl Iterator for Numbers {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let number = self.0.trailing_zeros() as usize % ROW;
        let is_there = self.0 != 0;
        self.0 &= self.0.wrapping_sub(1);
        is_there.then_some(number)
    }
}

/// Vectors of a group, by coordinate; the operations are those of [`Vector`].
#[derive(Clone, Copy)]
pub(crate) struct WideVector<S: Simd>(pub [Wide<S>; 3]);

impl<S: Simd> WideVector<S> {
    #[inline(always)]
    pub fn of(simd: S, Rows([x, y, z]): &Rows, group: usize) -> Self {
        Self([four(simd, x, group), four(simd, y, group), four(simd, z, group)])
    }

    #[inline(always)]
    pub fn splat(simd: S, vector: Vector) -> Self {
        Self([all(simd, vector.x), all(simd, vector.y), all(simd, vector.z)])
    }

    #[inline(always)]
    pub fn store(self, Rows([x, y, z]): &mut Rows, group: usize) {
        let Self([a, b, c]) = self;
        store(a, x, group);
        store(b, y, group);
        store(c, z, group);
    }

    #[inline(always)]
    pub fn dot(self, other: Self) -> Wide<S> {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        a * x + b * y + c * z
    }

    #[inline(always)]
    pub fn length_squared(self) -> Wide<S> {
        self.dot(self)
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        let Self([x, y, z]) = self;
        Self([x.abs(), y.abs(), z.abs()])
    }

    /// Returns its lanes where the mask is set, and others' where it is not.
    #[inline(always)]
    pub fn or(self, mask: Mask<S>, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([mask.select(a, x), mask.select(b, y), mask.select(c, z)])
    }

    #[inline(always)]
    pub fn element_sum(self) -> Wide<S> {
        let Self([x, y, z]) = self;
        x + y + z
    }
}

impl<S: Simd> std::ops::Neg for WideVector<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        let Self([x, y, z]) = self;
        Self([-x, -y, -z])
    }
}

impl<S: Simd> std::ops::Add for WideVector<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a + x, b + y, c + z])
    }
}

impl<S: Simd> std::ops::Sub for WideVector<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a - x, b - y, c - z])
    }
}

impl<S: Simd> std::ops::Mul<Wide<S>> for WideVector<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: Wide<S>) -> Self {
        let Self([x, y, z]) = self;
        Self([x * factor, y * factor, z * factor])
    }
}

impl<S: Simd> std::ops::Div<Wide<S>> for WideVector<S> {
    type Output = Self;

    #[inline(always)]
    fn div(self, divisor: Wide<S>) -> Self {
        let Self([x, y, z]) = self;
        Self([x / divisor, y / divisor, z / divisor])
    }
}

/// The rays of a group.
#[derive(Clone, Copy)]
pub(crate) struct WideRay<S: Simd> {
    pub origin: WideVector<S>,
    pub direction: WideVector<S>,
}
