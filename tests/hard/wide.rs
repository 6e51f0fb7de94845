//! Numbers of 320 bits, vectors of them and affine maps: wide enough that the squares of lengths
//! 24 decades apart, added, still leave 150 bits to tell what touches from what does not. Sums and
//! products of numbers that are [`Wide::exactly`] so have as many bits as they need.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use dashu_float::FBig;
use dashu_float::round::mode::Zero;

/// Significant bits.
pub const BITS: usize = 320;

#[derive(Debug, Clone, PartialEq, PartialOrd)]
pub struct Wide(FBig<Zero, 2>);

impl Wide {
    /// Exactly `value`, which must be finite.
    pub fn of(value: f64) -> Self {
        let exact = FBig::<Zero, 2>::try_from(value).expect("a finite number");
        Self(exact.with_precision(BITS).value())
    }

    /// Exactly `value`, and so are all sums and products of such; they cannot be divided.
    pub fn exactly(value: f64) -> Self {
        let exact = FBig::<Zero, 2>::try_from(value).expect("a finite number");
        Self(exact.with_precision(0).value())
    }

    /// The same number of 320 bits, to be divided.
    pub fn rounded(&self) -> Self {
        Self(self.0.clone().with_precision(BITS).value())
    }

    pub fn zero() -> Self {
        Self::of(0.0)
    }

    pub fn one() -> Self {
        Self::of(1.0)
    }

    pub fn sqrt(&self) -> Self {
        if self.sign() == Ordering::Less { Self::zero() } else { Self(self.0.sqrt()) }
    }

    /// Of an angle in degrees.
    pub fn sin_cos(&self) -> (Self, Self) {
        let (sine, cosine) = self.0.sin_cos_unit(360);
        (Self(sine), Self(cosine))
    }

    pub fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }

    pub fn sign(&self) -> Ordering {
        self.0.partial_cmp(&FBig::<Zero, 2>::ZERO).expect("ordered")
    }

    pub fn is_positive(&self) -> bool {
        self.sign() == Ordering::Greater
    }

    pub fn is_negative(&self) -> bool {
        self.sign() == Ordering::Less
    }

    pub fn is_zero(&self) -> bool {
        self.sign() == Ordering::Equal
    }

    pub fn abs(&self) -> Self {
        if self.is_negative() { -self } else { self.clone() }
    }

    pub fn is_odd(&self) -> bool {
        let half = self * &Self::of(0.5);
        half.floor() != half
    }

    pub fn floor(&self) -> Self {
        Self(self.0.floor().with_precision(BITS).value())
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl $trait<&Wide> for &Wide {
            type Output = Wide;
            fn $method(self, other: &Wide) -> Wide {
                Wide($trait::$method(&self.0, &other.0))
            }
        }
        impl $trait<Wide> for Wide {
            type Output = Wide;
            fn $method(self, other: Wide) -> Wide {
                Wide($trait::$method(self.0, other.0))
            }
        }
        impl $trait<&Wide> for Wide {
            type Output = Wide;
            fn $method(self, other: &Wide) -> Wide {
                Wide($trait::$method(self.0, &other.0))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for &Wide {
    type Output = Wide;
    fn neg(self) -> Wide {
        Wide(-self.0.clone())
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct WideVector(pub [Wide; 3]);

impl WideVector {
    pub fn of(v: [f64; 3]) -> Self {
        Self(v.map(Wide::of))
    }

    pub fn exactly(v: [f64; 3]) -> Self {
        Self(v.map(Wide::exactly))
    }

    pub fn dot(&self, other: &Self) -> Wide {
        let [a, b] = [&self.0, &other.0];
        &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
    }

    pub fn square(&self) -> Wide {
        self.dot(self)
    }

    pub fn length(&self) -> Wide {
        self.square().sqrt()
    }

    pub fn cross(&self, other: &Self) -> Self {
        let [a, b] = [&self.0, &other.0];
        Self(std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            &a[j] * &b[k] - &a[k] * &b[j]
        }))
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| &self.0[i] + &other.0[i]))
    }

    pub fn minus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| &self.0[i] - &other.0[i]))
    }

    pub fn times(&self, factor: &Wide) -> Self {
        Self(std::array::from_fn(|i| &self.0[i] * factor))
    }

    /// Of length 1.
    pub fn unit(&self) -> Self {
        self.times(&(Wide::one() / self.length()))
    }

    /// The largest component's size.
    pub fn largest(&self) -> Wide {
        let [x, y, z] = self.0.each_ref().map(Wide::abs);
        let xy = if x > y { x } else { y };
        if xy > z { xy } else { z }
    }
}

/// `p ↦ rows · p + offset`.
#[derive(Debug, Clone)]
pub struct WideMap {
    pub rows: [WideVector; 3],
    pub offset: WideVector,
}

impl WideMap {
    pub fn identity() -> Self {
        let rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(WideVector::of);
        Self { rows, offset: WideVector::of([0.0; 3]) }
    }

    /// The normal, of any length, of what this map makes a surface with `normal` of: by its transpose.
    pub fn normal_before(&self, normal: &WideVector) -> WideVector {
        let [x, y, z] = [0, 1, 2].map(|i| self.rows[i].times(&normal.0[i]));
        x.plus(&y).plus(&z)
    }

    pub fn direction(&self, d: &WideVector) -> WideVector {
        WideVector(self.rows.each_ref().map(|row| row.dot(d)))
    }

    pub fn point(&self, p: &WideVector) -> WideVector {
        self.direction(p).plus(&self.offset)
    }

    fn columns(&self) -> [WideVector; 3] {
        std::array::from_fn(|i| WideVector(self.rows.each_ref().map(|row| row.0[i].clone())))
    }

    /// The map that first does `inner`, then this one.
    pub fn after(&self, inner: &Self) -> Self {
        let columns = inner.columns();
        let rows =
            self.rows.each_ref().map(|row| WideVector(columns.each_ref().map(|c| row.dot(c))));
        Self { rows, offset: self.point(&inner.offset) }
    }

    /// Turns about axis `axis`, right-handed.
    pub fn rotation(axis: usize, degrees: &Wide) -> Self {
        let (sine, cosine) = degrees.sin_cos();
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut map = Self::identity();
        map.rows[a].0[a] = cosine.clone();
        map.rows[a].0[b] = -&sine;
        map.rows[b].0[a] = sine;
        map.rows[b].0[b] = cosine;
        map
    }

    pub fn inverse(&self) -> Self {
        let [x, y, z] = self.columns();
        let over = Wide::one() / x.dot(&y.cross(&z));
        let rows = [y.cross(&z), z.cross(&x), x.cross(&y)].map(|row| row.times(&over));
        let linear = Self { rows, offset: WideVector::of([0.0; 3]) };
        let offset = linear.direction(&self.offset).times(&Wide::of(-1.0));
        Self { offset, ..linear }
    }
}
