//! Lints operations that certainly leave nothing: parts that do not overlap, a part that is subtracted
//! entirely, an object outside its clipping objects. Also lints parts that subtract nothing, such as those
//! that are only a surface.
//!
//! **In:** the parts of each operation, as they are placed. **Out:** lints. **Invariant:** reported where
//! boxes around the parts prove it, or corners around the first part that lie in a convex one; an operation
//! that a loop or a macro repeats is reported only if every repetition leaves nothing.

mod gap;

use std::f64::consts::PI;

use self::gap::{Gap, THIN, gap_along_axes};
use super::Lowering;
use super::csg::{Making, Open};
use crate::diagnostic::{Code, Diagnostic};
use crate::geometry::bounds_of_part;
use crate::math::Vector;
use crate::math::elementary::{cos, sin};
use crate::scene::Operation;
use crate::shape::local::Local;
use crate::shape::{Body, Bounds, Box_, Rounding, Shape};
use crate::source::{Site, Span};
use crate::world::Object;

/// The most parts of an operation for which pairs are compared along slanted axes too.
const MOST_SLANTED: usize = 64;
/// Corners of the polygon drawn around a circle.
const CORNERS: usize = 32;

/// Bounds and origin of one part of a CSG solid.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    /// The site of the keyword that made it.
    site: Site,
    /// Bounds of its inside, and of its outside.
    inside: Bounds,
    outside: Bounds,
    /// The index of its object, if it is a single one, and whether the part is that object's complement.
    object: Option<(u32, bool)>,
}

impl Known {
    fn nothing(site: Site) -> Self {
        Self { site, inside: Bounds::NOWHERE, outside: Bounds::EVERYWHERE, object: None }
    }

    /// Returns the complement if `turns`.
    fn turned(self, turns: bool) -> Self {
        let Self { site, inside, outside, object } = self;
        match turns {
            false => self,
            true => Self {
                site,
                inside: outside,
                outside: inside,
                object: object.map(|(object, turned)| (object, !turned)),
            },
        }
    }

    fn is_nothing(&self) -> bool {
        self.inside.is_empty()
    }

    /// Returns the largest distance from 0 of its bounds along an axis.
    fn size(&self, axis: usize) -> f64 {
        let ends = [self.inside.low[axis], self.inside.high[axis]].map(f64::abs);
        ends.into_iter().filter(|end| end.is_finite()).fold(0.0, f64::max)
    }
}

impl Lowering<'_, '_> {
    /// Records a part of the CSG solid under construction: the object placed last.
    pub(super) fn know_leaf(&mut self, inverse: bool, site: Site) {
        let object = self.world.objects.len() as u32 - 1;
        let around =
            |bounds: Option<Bounds>| [bounds.unwrap_or(Bounds::EVERYWHERE), Bounds::EVERYWHERE];
        let [inside, outside] = match self.world.objects[object as usize].shape {
            Shape::Plane(i) => {
                let plane = self.world.planes[i as usize];
                [plane, plane.complement()].map(|half| half.bounds(Rounding::Nearest))
            }
            Shape::Sphere(_) | Shape::Box(_) | Shape::Ellipsoid(_) | Shape::Placed(_) => {
                around(bounds_of_part(&self.world, object))
            }
        };
        let shape = Known { site, inside, outside, object: None };
        let known = Known { object: Some((object, false)), ..shape.turned(inverse) };
        self.note_known(known);
    }

    /// Likewise, for a part that is nowhere or everywhere.
    pub(super) fn know_nothing(&mut self, inverse: bool, site: Site) {
        self.note_known(Known::nothing(site).turned(inverse));
    }

    fn note_known(&mut self, known: Known) {
        self.building.iter_mut().for_each(|building| building.known.push(known));
    }

    /// Combines the parts of an operation that ends into one, and records whether anything is left of it.
    pub(super) fn know_operation(&mut self, open: &Open) {
        let Open { making, inverse, site, known: first, .. } = *open;
        let Some(building) = &mut self.building else { return };
        // As its author sees them.
        let parts = building.known.drain(first..).map(|part| part.turned(inverse));
        let parts: Vec<Known> = parts.collect();
        if making == Making::Clip && !inverse {
            let told = self.clipped_away(&parts, site);
            self.note_emptied((site.span, true), told, site);
        }
        if let Making::Operation(operation @ (Operation::Intersection | Operation::Difference)) =
            making
        {
            let told = self.nothing_left(operation, &parts, site);
            self.note_emptied((site.span, false), told, site);
            let told = |code| self.reporter.diagnostics.tells(code);
            if operation == Operation::Difference && told(Code::TakesNothing) {
                self.note_idle(&parts);
            }
        }
        self.note_known(whole(making, &parts, inverse, site).turned(inverse));
    }

    /// Records a diagnostic about an operation or a clipped object; it is reported only if it holds for every
    /// one made there.
    fn note_emptied(&mut self, place: (Span, bool), told: Option<Diagnostic>, site: Site) {
        self.emptied
            .entry(place)
            .and_modify(|known| *known = known.take().filter(|_| told.is_some()))
            .or_insert(told.map(|told| (told, site)));
    }

    /// Returns a diagnostic if certainly nothing is left of an operation, unless a part is itself empty.
    fn nothing_left(
        &self,
        operation: Operation,
        parts: &[Known],
        site: Site,
    ) -> Option<Diagnostic> {
        if parts.len() < 2 || parts.iter().any(Known::is_nothing) {
            return None;
        }
        let word = operation.word().name();
        let told = |why: &str| {
            let message = format!("this `{word}` is empty: {why}");
            Diagnostic::new(Code::NothingLeft, message).at(site.span, "nothing is left of it")
        };
        if operation == Operation::Difference {
            // Each of the other parts is here what it leaves.
            let others = &parts[1..];
            let is_short = parts.len() <= MOST_SLANTED;
            let by_one = others.iter().find(|other| self.takes_all(&parts[0], other, is_short));
            if by_one.is_none() && self.gap(parts).is_none() {
                return None;
            }
            let told = told("what is taken away holds all of the first").help(
                "the first is kept, and the others are taken from it: are two of them swapped?",
            );
            return Some(match by_one {
                Some(other) if other.site.span != parts[0].site.span => told
                    .also(parts[0].site.span, "the first")
                    .also(other.site.span, "this holds all of it"),
                _ => told,
            });
        }
        let Gap { touching, parts: [a, b] } = self.gap(parts)?;
        let told = match touching {
            true => told("its parts only touch"),
            false => told("its parts do not meet"),
        };
        let told = told.help("let them overlap; a `union` is all of them together");
        let [a, b] = [a, b].map(|part| parts[part].site.span);
        Some(match a == b {
            true => told,
            false => told.also(a, "one of them").also(b, "another, beside it"),
        })
    }

    /// Records which parts of a difference take nothing away, and which take something.
    fn note_idle(&mut self, parts: &[Known]) {
        let [first, others @ ..] = parts else { return };
        let is_short = parts.len() <= MOST_SLANTED;
        for other in others.iter().filter(|_| !first.is_nothing()) {
            let site = other.site;
            let taken = other.turned(true);
            let apart = self.gap_of_two([*first, taken], is_short).is_some_and(|gap| !gap.touching);
            let hollow = self.sheet(other);
            let is_idle = (apart || hollow.is_some()) && !taken.is_nothing();
            let told = (is_idle && site.span != first.site.span).then(|| {
                let (message, help) = match hollow {
                    Some(help) => ("this is taken away, but has no inside", help),
                    None => (
                        "this is taken away where nothing is: it does not reach the first",
                        "move it to where it is to cut, or leave it out",
                    ),
                };
                Diagnostic::new(Code::TakesNothing, message)
                    .at(site.span, "takes nothing away")
                    .also(first.site.span, "of this")
                    .help(help)
            });
            self.idle
                .entry(site.span)
                .and_modify(|known| *known = known.take().filter(|_| told.is_some()))
                .or_insert(told.map(|told| (told, site)));
        }
    }

    /// Returns the help for a part that is a surface alone; `None` if the part has an inside.
    fn sheet(&self, part: &Known) -> Option<&'static str> {
        let (object, _) = part.object?;
        let Shape::Placed(i) = self.world.objects[object as usize].shape else { return None };
        let body = &*self.world.placed[i as usize].body;
        body.is_sheet().then_some(match body {
            Body::Mesh(_) => "a closed mesh has an inside where `inside_vector` is said",
            _ => "only what encloses a volume can take away, such as a `box` or a `prism`",
        })
    }

    /// Returns whether nothing of `first` is left, where `rest` is the complement of another part.
    fn takes_all(&self, first: &Known, rest: &Known, is_short: bool) -> bool {
        self.gap_of_two([*first, *rest], is_short).is_some() || self.is_within(first, rest)
    }

    /// Returns the gap between two parts of an operation; a short operation is also searched across slanted
    /// faces.
    fn gap_of_two(&self, parts: [Known; 2], is_short: bool) -> Option<Gap> {
        if is_short { self.gap(&parts) } else { gap_along_axes(&parts) }
    }

    /// Returns whether `first` lies entirely inside a convex object, whose complement is `rest`.
    fn is_within(&self, first: &Known, rest: &Known) -> bool {
        let world = &self.world;
        let Some((index, turned)) = rest.object else { return false };
        let holder = &world.objects[index as usize];
        if !self.is_convex(holder, holder.inverse != turned) {
            return false;
        }
        if let (Some(Shape::Sphere(i)), Shape::Sphere(j)) = (self.shape(first), holder.shape) {
            let [inner, outer] = [i, j].map(|i| world.spheres[i as usize]);
            let reach = inner.centre.distance(outer.centre) + inner.radius;
            return reach <= outer.radius * (1.0 + THIN);
        }
        let corners = self.corners(first);
        let middle = corners.iter().fold(Vector::ZERO, |sum, corner| sum + *corner)
            / corners.len().max(1) as f64;
        let is_held = |corner: &Vector| {
            let inner = middle + (*corner - middle) * (1.0 - THIN);
            world.contains(holder, inner) == turned
        };
        !corners.is_empty() && corners.iter().all(is_held)
    }

    /// Returns whether the inside of an object, or its outside, is convex.
    fn is_convex(&self, object: &Object, inside: bool) -> bool {
        match object.shape {
            Shape::Plane(_) => true,
            Shape::Sphere(_) | Shape::Ellipsoid(_) | Shape::Box(_) => inside,
            Shape::Placed(i) => {
                let is_convex = match &*self.world.placed[i as usize].body {
                    Body::Cylinder(_) | Body::Ovus(_) => true,
                    Body::Cone(cone) => cone.cap >= 0.0,
                    Body::Algebraic(_)
                    | Body::BicubicPatch(_)
                    | Body::Blob(_)
                    | Body::Disc(_)
                    | Body::HeightField(_)
                    | Body::Isosurface(_)
                    | Body::JuliaFractal(_)
                    | Body::Lathe(_)
                    | Body::Mesh(_)
                    | Body::Parametric(_)
                    | Body::Polygon(_)
                    | Body::Prism(_)
                    | Body::Sor(_)
                    | Body::SphereSweep(_)
                    | Body::Superellipsoid(_)
                    | Body::Text(_)
                    | Body::Torus(_) => false,
                };
                inside && is_convex
            }
        }
    }

    /// Returns the shape of a part that is a single object.
    fn shape(&self, part: &Known) -> Option<Shape> {
        let (object, turned) = part.object?;
        let object = &self.world.objects[object as usize];
        (object.inverse == turned).then_some(object.shape)
    }

    /// Returns the corners of a polyhedron that contains a part; empty if the part is unbounded.
    fn corners(&self, part: &Known) -> Vec<Vector> {
        match self.shape(part) {
            Some(Shape::Box(i)) => return corners_of_box(&self.world.boxes[i as usize]),
            Some(Shape::Placed(i)) => {
                let placed = &self.world.placed[i as usize];
                let (base, cap) = match &*placed.body {
                    Body::Cylinder(_) => (1.0, 1.0),
                    Body::Cone(cone) => (1.0, cone.cap),
                    _ => return corners_of(&part.inside),
                };
                let local = [ring(base, -1.0), ring(cap, 1.0)].concat();
                let place = &placed.placement;
                let world = |corner: &Vector| place.centre + place.world_from_local * *corner;
                return local.iter().map(world).collect();
            }
            Some(Shape::Sphere(_) | Shape::Ellipsoid(_) | Shape::Plane(_)) | None => {}
        }
        corners_of(&part.inside)
    }

    /// Returns a diagnostic if certainly nothing is left of an object, the first of the parts, after
    /// clipping.
    fn clipped_away(&self, parts: &[Known], site: Site) -> Option<Diagnostic> {
        if parts.len() < 2 || parts.iter().any(Known::is_nothing) {
            return None;
        }
        // A part that lies in a face of its clip is kept.
        let Gap { parts: apart, .. } = self.gap(parts).filter(|gap| !gap.touching)?;
        let why = match apart.contains(&0) {
            true => "it does not reach into what clips it",
            false => "what clips it does not meet",
        };
        let told =
            Diagnostic::new(Code::NothingLeft, format!("this object is clipped away: {why}"))
                .at(site.span, "nothing is left of it")
                .help("`clipped_by` keeps what lies inside of its shapes");
        let clips = apart.into_iter().filter(|part| *part > 0).map(|part| parts[part].site.span);
        let clips = clips.filter(|clip| *clip != site.span);
        Some(clips.fold(told, |told, clip| told.also(clip, "it is clipped by this")))
    }

    pub(super) fn lint_emptied(&mut self) {
        let emptied = std::mem::take(&mut self.emptied).into_values();
        let idle = std::mem::take(&mut self.idle).into_values();
        for (told, site) in emptied.chain(idle).flatten() {
            self.reporter.diagnostics.push(told.traced(site, self.reporter.expansions));
        }
    }
}

/// Returns what is known of the result of an operation, as its author sees it.
fn whole(making: Making, parts: &[Known], inverse: bool, site: Site) -> Known {
    if let ([only], false) = (parts, making == Making::Clip) {
        return *only;
    }
    let shared = |box_: fn(&Known) -> Bounds| {
        parts.iter().map(box_).fold(Bounds::EVERYWHERE, |all, one| all.intersection(&one))
    };
    let united = |box_: fn(&Known) -> Bounds| {
        parts.iter().map(box_).fold(Bounds::NOWHERE, |all, one| all.union(&one))
    };
    let (inside, outside) = match making {
        Making::Union | Making::Operation(Operation::Merge) => {
            (united(|part| part.inside), shared(|part| part.outside))
        }
        // The complement of a part that a difference subtracts is already taken.
        Making::Operation(Operation::Intersection | Operation::Difference) => {
            (shared(|part| part.inside), united(|part| part.outside))
        }
        Making::Clip if inverse => (Bounds::EVERYWHERE, Bounds::EVERYWHERE),
        Making::Clip => (shared(|part| part.inside), Bounds::EVERYWHERE),
    };
    Known { site, inside, outside, object: None }
}

fn corners_of(&Bounds { low, high }: &Bounds) -> Vec<Vector> {
    if !(low.is_finite() && high.is_finite()) {
        return Vec::new();
    }
    let side = |i: usize, axis: usize| if i >> axis & 1 == 0 { low[axis] } else { high[axis] };
    (0..8).map(|i| Vector::new(side(i, 0), side(i, 1), side(i, 2))).collect()
}

fn corners_of_box(solid: &Box_) -> Vec<Vector> {
    let halves = [0, 1, 2].map(|axis| solid.face(axis).centre - solid.centre);
    let way = |i: usize, axis: usize| if i >> axis & 1 == 0 { -halves[axis] } else { halves[axis] };
    (0..8).map(|i| solid.centre + way(i, 0) + way(i, 1) + way(i, 2)).collect()
}

/// Returns the corners of a polygon around a circle about the z axis.
fn ring(radius: f64, z: f64) -> Vec<Vector> {
    let reach = radius / cos(PI / CORNERS as f64);
    let corner = |i: usize| {
        let angle = 2.0 * PI * i as f64 / CORNERS as f64;
        Vector::new(reach * cos(angle), reach * sin(angle), z)
    };
    (0..CORNERS).map(corner).collect()
}
