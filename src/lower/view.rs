//! Lints a camera that sees nothing, or only a tiny part of the scene.
//!
//! **In:** the World. **Out:** a lint, when every object lies outside the view, or the angle is so small that
//! no object fits it. **Invariant:** reported only when boxes around the objects prove it; an unbounded
//! object is always in view.

use super::Lowering;
use crate::diagnostic::{Code, Diagnostic};
use crate::geometry::bounds;
use crate::math::{Matrix, Vector};
use crate::scene::CameraItemKind;
use crate::shape::Bounds;
use crate::world::{Camera, CameraKind};

/// Where the objects outside the view are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outside {
    Behind,
    Beside,
}

/// Relative distance by which a corner has to be outside: 2⁻³⁰, far more than the accumulated rounding.
pub(super) const CLEARLY: f64 = 1.0 / (1u64 << 30) as f64;

/// Angles in degrees that may be meant in radians: from a degree or two up to about π radians.
const LIKE_RADIANS: std::ops::Range<f64> = 0.2..3.2;
/// An object larger than this many pictures is too large for the view.
const TOO_LARGE: f64 = 4.0;

impl Lowering<'_, '_> {
    /// Lints an angle that may be meant in radians, if every bounded object in view is far larger than the
    /// picture. Returns whether it was reported.
    pub(super) fn lint_angle(&mut self) -> bool {
        if !self.world.camera.kind.is_flat() {
            return false;
        }
        let items = self.scene.cameras.last().map_or(&[][..], |camera| &camera.items);
        let angle = items.iter().rev().find_map(|item| match item.kind {
            CameraItemKind::Angle(degrees) => Some((degrees, item.site)),
            _ => None,
        });
        let Some((degrees, site)) = angle else { return false };
        if !LIKE_RADIANS.contains(&degrees) || degrees.fract() == 0.0 {
            return false;
        }
        let (world, view) = (&self.world, View::of(&self.world.camera));
        let is_told = |told: &Diagnostic| {
            told.code == Code::SuspiciousUnit
                && told.primary().is_some_and(|label| site.span.contains(label.span))
        };
        if self.reporter.diagnostics.iter().any(is_told) {
            return true;
        }
        let fits = world
            .solids()
            .filter_map(|i| bounds(world, i))
            .any(|bounds| view.outside(&bounds).is_none() && view.pictures(&bounds) <= TOO_LARGE);
        if fits {
            return false;
        }
        let (written, meant) = (shown(degrees), degrees.to_degrees());
        let diagnostic = Diagnostic::new(
            Code::SuspiciousUnit,
            "this angle looks like radians, and is taken as degrees",
        )
        .at(
            site.span,
            format!("{written} degrees: the view of a telescope, which nothing here fits"),
        )
        .help(format!("write degrees, or `degrees({written})`, which is {meant:.1}"))
        .traced(site, self.reporter.expansions);
        self.reporter.diagnostics.push(diagnostic);
        true
    }

    pub(super) fn lint_view(&mut self) {
        let (world, view) = (&self.world, View::of(&self.world.camera));
        let mut all: Option<(Bounds, Outside)> = None;
        for solid in world.solids() {
            let Some(bounds) = bounds(world, solid).filter(|_| !self.is_inverse(solid)) else {
                return;
            };
            let Some(outside) = view.outside(&bounds) else { return };
            all = Some(match all {
                Some((others, side)) if side == outside => (others.union(&bounds), side),
                Some((others, _)) => (others.union(&bounds), Outside::Beside),
                None => (bounds, outside),
            });
        }
        let Some((bounds, outside)) = all else { return };
        let Vector { x, y, z } = (bounds.low + (bounds.high - bounds.low) * 0.5).map(shown);
        let label = match outside {
            Outside::Behind => "all of the scene is behind it",
            Outside::Beside => "all of the scene is beside what it sees",
        };
        let mut diagnostic =
            Diagnostic::new(Code::NothingInView, "the camera sees none of the objects");
        if let Some(site) = self.origins.camera {
            diagnostic = diagnostic.at(site.span, label).traced(site, self.reporter.expansions);
        }
        diagnostic = diagnostic
            .help(format!("the objects are about <{x}, {y}, {z}>: let it `look_at` that place"));
        self.reporter.diagnostics.push(diagnostic);
    }
}

/// The share of a half width by which rounding of positions becomes visible.
const SHOWS: f64 = 1e-3;
/// The smallest visible share of a picture's width.
const SEEN: f64 = 1e-3;

impl Lowering<'_, '_> {
    /// Lints objects in view that are so far away for their size that positions there are not known to a
    /// thousandth of it.
    pub(super) fn lint_far(&mut self) {
        if !self.reporter.diagnostics.tells(Code::FarAway) {
            return;
        }
        let (world, view) = (&self.world, View::of(&self.world.camera));
        let mut far = world.solids().filter(|&solid| !self.is_inverse(solid)).filter_map(|solid| {
            let bounds = bounds(world, solid)?;
            let half = (bounds.high - bounds.low).max_element() * 0.5;
            let middle = bounds.low + (bounds.high - bounds.low) * 0.5;
            let distance = (middle - world.camera.location).abs().max_element();
            let rounding = distance * f64::EPSILON / half;
            let is_seen = || view.outside(&bounds).is_none() && view.pictures(&bounds) > SEEN;
            (rounding > SHOWS && rounding.is_finite() && is_seen()).then_some((
                solid,
                distance / half,
                rounding,
            ))
        });
        let Some((solid, halves, rounding)) = far.next() else { return };
        let Some(&site) = self.origins.objects.get(solid as usize) else { return };
        let diagnostic = Diagnostic::new(
            Code::FarAway,
            format!("this is {:e} half widths from the camera, too far to be exact", shown(halves)),
        )
        .at(
            site.span,
            format!("places there are rounded by {} % of a half width", shown(100.0 * rounding)),
        )
        .help(
            "come nearer, by as much as the `angle` becomes wider: nobody can tell the difference",
        )
        .traced(site, self.reporter.expansions);
        self.reporter.diagnostics.push(diagnostic);
    }
}

/// The view in the camera's own coordinates: right and up in widths and heights of the screen, forward in its
/// distance.
struct View {
    kind: CameraKind,
    /// What is seen is a pyramid or a prism: no bent screen, which may show all directions, nor bent rays.
    is_pyramid: bool,
    location: Vector,
    view_from_world: Matrix,
}

impl View {
    fn of(camera: &Camera) -> Self {
        let &Camera { kind, location, forward, right, up, .. } = camera;
        let is_pyramid = kind.is_flat() && camera.focus.is_none() && camera.normal.is_none();
        let view_from_world = Matrix::from_cols(right, up, forward).inverse();
        Self { kind, is_pyramid, location, view_from_world }
    }

    /// Returns the corners of a box in the camera's coordinates.
    fn corners(&self, &Bounds { low, high }: &Bounds) -> [Vector; 8] {
        std::array::from_fn(|i| {
            let side = |bit: usize, low: f64, high: f64| if i >> bit & 1 == 0 { low } else { high };
            let corner =
                Vector::new(side(0, low.x, high.x), side(1, low.y, high.y), side(2, low.z, high.z));
            self.view_from_world * (corner - self.location)
        })
    }

    /// Returns the apparent size of a box in picture widths or heights; infinite if part of it lies beside or
    /// behind the camera.
    fn pictures(&self, bounds: &Bounds) -> f64 {
        if !self.is_pyramid {
            return f64::INFINITY;
        }
        let corners = self.corners(bounds).map(|at| match self.kind {
            CameraKind::Perspective if at.z <= 0.0 => None,
            CameraKind::Perspective => Some([at.x / at.z, at.y / at.z]),
            _ => Some([at.x, at.y]),
        });
        let wide = |axis: usize| {
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for corner in corners {
                let Some(corner) = corner else { return f64::INFINITY };
                (low, high) = (low.min(corner[axis]), high.max(corner[axis]));
            }
            high - low
        };
        wide(0).max(wide(1))
    }

    /// Returns where a box is, if certainly no part of it is in view.
    fn outside(&self, bounds: &Bounds) -> Option<Outside> {
        if !self.is_pyramid {
            return None;
        }
        let corners = self.corners(bounds);
        // Numbers too large to compare are not beyond anything.
        let all = |beyond: fn(Vector, f64) -> f64| {
            corners.iter().all(|&at| {
                let distance = if self.kind == CameraKind::Perspective { at.z } else { 1.0 };
                let size = at.abs().max_element() + distance.abs();
                beyond(at, 0.5 * distance) > CLEARLY * size
            })
        };
        if all(|at, _| -at.z) {
            return Some(Outside::Behind);
        }
        let beside = all(|at, half| at.x - half)
            || all(|at, half| -at.x - half)
            || all(|at, half| at.y - half)
            || all(|at, half| -at.y - half);
        beside.then_some(Outside::Beside)
    }
}

/// Rounds a coordinate to three significant digits for display.
fn shown(x: f64) -> f64 {
    format!("{x:.2e}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(kind: CameraKind, low: [f64; 3], high: [f64; 3]) -> Option<Outside> {
        let camera = Camera { kind, ..Camera::default() };
        View::of(&camera).outside(&Bounds { low: Vector::from(low), high: Vector::from(high) })
    }

    #[test]
    fn a_box_is_as_many_pictures_wide_as_its_nearest_side() {
        let pictures = |kind, low: [f64; 3], high: [f64; 3]| {
            let camera = Camera { kind, ..Camera::default() };
            let bounds = Bounds { low: Vector::from(low), high: Vector::from(high) };
            View::of(&camera).pictures(&bounds)
        };
        let (low, high) = ([-2.0, -1.0, -9.0], [2.0, 1.0, -0.5]);
        assert!((pictures(CameraKind::Perspective, low, high) - 6.0).abs() < 1e-12);
        assert!((pictures(CameraKind::Orthographic, low, high) - 3.0).abs() < 1e-12);
        let around = pictures(CameraKind::Perspective, low, [2.0, 1.0, 0.5]);
        assert_eq!(around, f64::INFINITY);
    }

    #[test]
    fn only_what_is_surely_outside_is_outside() {
        use CameraKind::{Orthographic, Perspective};
        use Outside::{Behind, Beside};
        // The camera looks along -z, and sees 4/3 by 1 at the distance 1.
        assert_eq!(seen(Perspective, [-1.0, -1.0, 0.1], [1.0, 1.0, 2.0]), Some(Behind));
        assert_eq!(seen(Perspective, [-1.0, -1.0, -0.1], [1.0, 1.0, 2.0]), None);
        assert_eq!(seen(Perspective, [0.7, -1.0, -1.0], [9.0, 1.0, -0.9]), Some(Beside));
        assert_eq!(seen(Perspective, [0.6, -1.0, -1.0], [9.0, 1.0, -0.9]), None);
        assert_eq!(seen(Orthographic, [0.7, -1.0, -9.0], [9.0, 1.0, -0.9]), Some(Beside));
        assert_eq!(seen(Perspective, [0.7, -1.0, -9.0], [9.0, 1.0, -0.9]), None);
        let touching = [-1.0, -1.0, 0.0];
        assert_eq!(seen(Perspective, touching, [1.0, 1.0, 2.0]), None);
    }
}
