//! Body: a solid or a sheet in a space of its own, where its equation is simple.
//!
//! **In:** a [`LocalRay`], a local point. **Out:** all crossings of the whole line, in order; the
//! height over a part of the surface. **Invariant:** closed bodies are entered and left in turn; what
//! rounding cannot tell from a miss is missed on both sides.

use smallvec::SmallVec;

use super::algebraic::Algebraic;
use super::bicubic_patch::BicubicPatch;
use super::blob::Blob;
use super::cone::Cone;
use super::cylinder::Cylinder;
use super::disc::Disc;
use super::height_field::HeightField;
use super::isosurface::Isosurface;
use super::julia_fractal::JuliaFractal;
use super::lathe::Lathe;
use super::mesh::Mesh;
use super::ovus::Ovus;
use super::parametric::Parametric;
use super::polygon::Polygon;
use super::prism::Prism;
use super::sor::Sor;
use super::sphere_sweep::SphereSweep;
use super::superellipsoid::Superellipsoid;
use super::text::Text;
use super::torus::Torus;
use super::{Crossing, Placed, Ray, U};
use crate::math::Vector;

/// What every body answers, in its own space.
pub trait Local {
    /// Adds the crossings of the line with all of the surface, in order.
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings);

    /// Adds, in order, those crossings that may lie between two places; at least the first that is seen and
    /// certainly behind the former, where there are more. May add others.
    fn first_crossings(&self, ray: &LocalRay, _between: (f64, f64), found: &mut Crossings) {
        self.crossings(ray, found);
    }

    /// The part of the surface by which the line enters at `s`, or leaves, where that can be told at once.
    fn part_at(&self, _ray: &LocalRay, _s: f64, _leaving: bool) -> Option<u32> {
        None
    }

    /// The height over one part of the surface, near it.
    fn height(&self, part: u32, point: Vector) -> Height;

    /// The least and the greatest `along`·P over what is seen of the body; infinite where that has no end.
    fn extent(&self, along: Vector) -> (f64, f64);

    /// The same without the room for rounding that it may have.
    fn nearest_extent(&self, along: Vector) -> (f64, f64) {
        self.extent(along)
    }

    /// The radius of a ball around the local origin that holds the body; ∞ where none does.
    fn reach(&self) -> f64;

    /// Whether a point lies inside. A sheet has no inside.
    fn contains(&self, point: Vector) -> bool;

    /// Whether a point lies inside beyond all doubt: `false` where rounding may hide it, or where nobody asks.
    fn certainly_contains(&self, _point: Vector) -> bool {
        false
    }

    /// What distinguishes it from others of its kind, for people to read; each after a blank.
    fn numbers(&self) -> String;

    /// Its crossings are found by steps that come nearer and nearer: what [`LocalRay::tolerance`] ends.
    fn is_iterated(&self) -> bool {
        false
    }

    /// What it takes to find where a line crosses it, in equations of a sphere. Of pictures of one body
    /// (2026-11-22), what they take longer than one of a sphere, for each line that is tried: half of it to
    /// twice as much.
    fn price(&self) -> u64;

    /// It has no inside: a ray goes through and is neither in it before nor after.
    fn is_sheet(&self) -> bool {
        false
    }

    /// The normal by which a part is lit at a point, of any length and on either side; `None` where it is
    /// the surface's own.
    fn shading_normal(&self, _part: u32, _point: Vector) -> Option<Vector> {
        None
    }
}

/// A local point's height over a part of a surface, which is where the height is 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Height {
    /// Negative inside.
    pub value: f64,
    /// The height's gradient: outward, of any length but 0.
    pub gradient: Vector,
    /// How far rounding may have moved `value`, if the point is exact.
    pub error: f64,
}

/// A ray's line as a body sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalRay<'a> {
    /// The point of the line that is nearest to the local origin; s is 0 here.
    pub nearest: Vector,
    /// Of length 1.
    pub direction: Vector,
    /// The line that was meant lies within `blur + turn · |s|` of this one at s.
    pub blur: f64,
    /// See `blur`.
    pub turn: f64,
    /// A crossing need be found no better than this, of which [`Met::error`] tells; 0 asks for all that
    /// the arithmetic can tell.
    pub tolerance: f64,
    /// `None` of a line that nothing in the world is.
    pub in_world: Option<InWorld<'a>>,
}

/// The ray itself, and the body where it stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InWorld<'a> {
    pub ray: &'a Ray,
    pub placed: &'a Placed,
}

impl LocalRay<'_> {
    /// A line that is meant as it is.
    pub fn exact(nearest: Vector, direction: Vector) -> Self {
        Self { nearest, direction, blur: 0.0, turn: 0.0, tolerance: 0.0, in_world: None }
    }

    pub fn at(&self, s: f64) -> Vector {
        self.nearest + self.direction * s
    }

    /// From where on a crossing is certainly ahead of a ray of which `first_crossings` is told that it starts at
    /// `from`: `Seen::place` tells that as far before the start as that may be off.
    pub fn ahead_of(&self, from: f64) -> f64 {
        from + 4.0 * (self.blur + self.turn * self.nearest.length() + 8.0 * U * from.abs())
    }

    /// How far the meant line may be from this one at s.
    pub fn blur_at(&self, s: f64) -> f64 {
        self.blur + self.turn * s.abs()
    }
}

/// Where a line passes through a body's surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Met {
    /// Distance along the line: s for a body, t for a ray in the world.
    pub t: f64,
    /// The true crossing lies within this distance of `t`.
    pub error: f64,
    /// The line leaves the body; for a sheet, it goes the way that the surface faces.
    pub leaving: bool,
    /// Which part of the surface: what [`Local::height`] is asked about.
    pub part: u32,
}

impl Met {
    /// The part of what is not there to be seen, such as the ends of an open cylinder: the solid ends
    /// here, and a ray that meets nothing else goes on.
    pub const UNSEEN: u32 = u32::MAX;

    pub fn is_seen(&self) -> bool {
        self.part != Self::UNSEEN
    }

    pub fn crossing(&self) -> Crossing {
        Crossing { t: self.t, error: self.error }
    }

    /// The one farther along; where rounding may have swapped them, the bound says so.
    pub(super) fn later(self, other: Self) -> Self {
        let (late, early) = if other.t > self.t { (other, self) } else { (self, other) };
        Self { error: late.error.max(early.error - (late.t - early.t)), ..late }
    }

    /// The one less far along; likewise.
    pub(super) fn earlier(self, other: Self) -> Self {
        let (early, late) = if other.t < self.t { (other, self) } else { (self, other) };
        Self { error: early.error.max(late.error - (late.t - early.t)), ..early }
    }
}

/// Crossings in order. Most bodies have few, and need no allocation.
pub type Crossings = SmallVec<[Met; 6]>;

/// Where a line enters something solid, and where it leaves that.
pub(super) type Span = (Met, Met);

/// Adds where the line enters and leaves all of what it goes through, in any order: spans that overlap or
/// touch, as far as rounding tells, are one, and what is seen is told where as much ends there unseen.
pub(super) fn unite(spans: &mut [Span], found: &mut Crossings) {
    spans.sort_by(|a, b| a.0.t.total_cmp(&b.0.t));
    let Some((&(mut enter, mut leave), rest)) = spans.split_first() else { return };
    let is_there = |met: &Met, seen: &Met| {
        !met.is_seen() && seen.is_seen() && (met.t - seen.t).abs() <= met.error + seen.error
    };
    for &(next, end) in rest {
        if next.t - next.error > leave.t + leave.error {
            found.extend([enter, leave]);
            (enter, leave) = (next, end);
            continue;
        }
        // Rounding may have swapped them, and the bound says so.
        let (other, first) = if is_there(&enter, &next) { (enter, next) } else { (next, enter) };
        enter = Met { error: first.error.max(first.t - other.t + other.error), ..first };
        let ends_later = is_there(&leave, &end) || (end.t > leave.t && !is_there(&end, &leave));
        let (other, last) = if ends_later { (leave, end) } else { (end, leave) };
        leave = Met { error: last.error.max(other.t - last.t + other.error), ..last };
    }
    found.extend([enter, leave]);
}

/// Declares the closed set of bodies, each in a file of its own.
macro_rules! bodies {
    ($($kind:ident $word:literal)*) => {
        /// A kind of body, and its numbers.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Body {
            $($kind($kind),)*
        }

        impl Body {
            /// The words of all kinds.
            pub const WORDS: &[&str] = &[$($word),*];

            /// The language's word for it.
            pub fn word(&self) -> &'static str {
                match self {
                    $(Self::$kind(_) => $word,)*
                }
            }

        }

        impl Local for Body {
            fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
                match self {
                    $(Self::$kind(body) => body.crossings(ray, found),)*
                }
            }

            fn first_crossings(
                &self,
                ray: &LocalRay,
                between: (f64, f64),
                found: &mut Crossings,
            ) {
                match self {
                    $(Self::$kind(body) => body.first_crossings(ray, between, found),)*
                }
            }

            fn part_at(&self, ray: &LocalRay, s: f64, leaving: bool) -> Option<u32> {
                match self {
                    $(Self::$kind(body) => body.part_at(ray, s, leaving),)*
                }
            }

            fn height(&self, part: u32, point: Vector) -> Height {
                match self {
                    $(Self::$kind(body) => body.height(part, point),)*
                }
            }

            fn extent(&self, along: Vector) -> (f64, f64) {
                match self {
                    $(Self::$kind(body) => body.extent(along),)*
                }
            }

            fn nearest_extent(&self, along: Vector) -> (f64, f64) {
                match self {
                    $(Self::$kind(body) => body.nearest_extent(along),)*
                }
            }

            fn reach(&self) -> f64 {
                match self {
                    $(Self::$kind(body) => body.reach(),)*
                }
            }

            fn contains(&self, point: Vector) -> bool {
                match self {
                    $(Self::$kind(body) => body.contains(point),)*
                }
            }

            fn certainly_contains(&self, point: Vector) -> bool {
                match self {
                    $(Self::$kind(body) => body.certainly_contains(point),)*
                }
            }

            fn numbers(&self) -> String {
                match self {
                    $(Self::$kind(body) => body.numbers(),)*
                }
            }

            fn is_iterated(&self) -> bool {
                match self {
                    $(Self::$kind(body) => body.is_iterated(),)*
                }
            }

            fn price(&self) -> u64 {
                match self {
                    $(Self::$kind(body) => body.price(),)*
                }
            }

            fn is_sheet(&self) -> bool {
                match self {
                    $(Self::$kind(body) => body.is_sheet(),)*
                }
            }

            fn shading_normal(&self, part: u32, point: Vector) -> Option<Vector> {
                match self {
                    $(Self::$kind(body) => body.shading_normal(part, point),)*
                }
            }
        }
    };
}

bodies! {
    Algebraic "polynomial"
    BicubicPatch "bicubic_patch"
    Blob "blob"
    Cone "cone"
    Cylinder "cylinder"
    Disc "disc"
    HeightField "height_field"
    Isosurface "isosurface"
    JuliaFractal "julia_fractal"
    Lathe "lathe"
    Mesh "mesh"
    Ovus "ovus"
    Parametric "parametric"
    Polygon "polygon"
    Prism "prism"
    Sor "sor"
    SphereSweep "sphere_sweep"
    Superellipsoid "superellipsoid"
    Text "text"
    Torus "torus"
}

/// A ray as a placed body sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen<'a> {
    pub line: LocalRay<'a>,
    /// Where on the line the ray starts.
    start: f64,
    /// Local lengths over those of the ray.
    speed: f64,
    /// How far `start` may be off.
    start_error: f64,
}

impl<'a> Seen<'a> {
    /// The ray in local space, slid to its closest approach there. With |L| the matrix of absolute
    /// values, f the ray's start as seen from the centre, R = ‖|L|·|f|‖ and κ = ‖|L|·|D|‖ / |L·D|, the
    /// line is off by u·(6R + 6κ·|b|) where it is nearest, and by 6u·κ more for each length along it;
    /// the start by u·(6R + 6κ·(|b| + m)); every t by 6u·κ of it. (As of an ellipsoid.) Both by
    /// `moved` more: how far, in local space, the centre may be from where it was meant.
    pub fn new(placed: &'a Placed, ray: &'a Ray, moved: f64) -> Self {
        let Placed { placement, root_tolerance: tolerance, .. } = *placed;
        let matrix = placement.local_from_world;
        let sizes = matrix.abs();
        let from_centre = ray.origin - placement.centre;
        let origin = matrix * from_centre;
        let step = matrix * ray.direction;
        let speed = step.length();
        let direction = step / speed;
        let start = origin.dot(direction);
        let nearest = origin - direction * start;

        let reach = (sizes * from_centre.abs()).length();
        let turn = U * 6.0 * (sizes * ray.direction.abs()).length() / speed;
        let blur = U * 6.0 * reach + turn * start.abs() + moved;
        let start_error = blur + turn * nearest.length();
        let in_world = Some(InWorld { ray, placed });
        let line = LocalRay { nearest, direction, blur, turn, tolerance, in_world };
        Self { line, start, speed, start_error }
    }

    /// Where on the line the ray is at `t`, as nearly as rounding tells; a little before, or behind.
    pub fn place(&self, t: f64, way: f64) -> f64 {
        let along = t * self.speed;
        let off = self.start_error
            + along.abs() * (self.line.turn + 8.0 * U)
            + 8.0 * U * self.start.abs();
        self.start + along + way * off
    }

    /// A crossing of the line, as one of the ray.
    pub fn met(&self, local: Met) -> Met {
        let t = (local.t - self.start) / self.speed;
        let rounded = 2.0 * U * (local.t.abs() + self.start.abs());
        let error = (local.error + self.start_error + rounded) / self.speed
            + t.abs() * (self.line.turn + 4.0 * U);
        Met { t, error, ..local }
    }
}
