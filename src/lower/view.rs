//! Whether the camera sees anything at all.
//!
//! **In:** the World. **Out:** a lint, when every object lies outside of the view. **Invariant:** told only
//! when boxes around the objects prove it; what reaches everywhere is always in view.

use super::Lowering;
use crate::diagnostic::{Code, Diagnostic};
use crate::geometry::bounds;
use crate::math::{Matrix, Vector};
use crate::shape::Bounds;
use crate::world::{Camera, CameraKind};

/// Where objects are that are not in view.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outside {
    Behind,
    Beside,
}

/// How far outside a corner has to be, relative to its place: 2⁻³⁰, far more than was rounded on the way.
const CLEARLY: f64 = 1.0 / (1u64 << 30) as f64;

impl Lowering<'_, '_> {
    pub(super) fn lint_view(&mut self) {
        let (world, view) = (&self.world, View::of(&self.world.camera));
        let mut all: Option<(Bounds, Outside)> = None;
        for (i, object) in world.objects.iter().enumerate() {
            let Some(bounds) = bounds(world, i as u32).filter(|_| !object.inverse) else { return };
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

/// What the camera sees, in coordinates of its own: right and up in widths and heights of the screen,
/// forward in its distance.
struct View {
    kind: CameraKind,
    location: Vector,
    view_from_world: Matrix,
}

impl View {
    fn of(camera: &Camera) -> Self {
        let &Camera { kind, location, forward, right, up } = camera;
        Self { kind, location, view_from_world: Matrix::from_cols(right, up, forward).inverse() }
    }

    /// Where a box is, if surely no part of it is in view.
    fn outside(&self, &Bounds { low, high }: &Bounds) -> Option<Outside> {
        let corners: [Vector; 8] = std::array::from_fn(|i| {
            let side = |bit: usize, low: f64, high: f64| if i >> bit & 1 == 0 { low } else { high };
            let corner =
                Vector::new(side(0, low.x, high.x), side(1, low.y, high.y), side(2, low.z, high.z));
            self.view_from_world * (corner - self.location)
        });
        // Numbers too large to tell are not beyond anything.
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

/// A coordinate with three digits: it says about where.
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
