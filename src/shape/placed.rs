//! Bodies placed in world space. Several can share one body.

mod together;

use std::sync::Arc;

use super::algebraic::HalfSpace;
use super::body::Body;
use super::local::{Crossings, Height, Local, Met};
use super::seen::Seen;
use super::{Bounds, Paint, Plane, Ray, Rounding, SurfacePoint, U};
use crate::math::placement::{ExactPlacement, Placement};
use crate::math::{AbsDot, UnitVector, Vector};

/// A body, and where it is placed.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// Stored once, however often it is placed.
    pub body: Arc<Body>,
    pub placement: Placement,
    /// Tolerance of crossings, relative to the size of the body; see `LocalRay::tolerance`.
    pub root_tolerance: f64,
    /// The placement in exact form, for bodies whose edges or flat ends may coincide with those of others.
    pub exact: Option<Box<ExactPlacement>>,
}

impl Body {
    /// Returns whether it has ends, faces or edges that may coincide with those of others, so that an exact
    /// placement is kept.
    pub fn keeps_exact_place(&self) -> bool {
        match self {
            Self::Cone(_)
            | Self::Cylinder(_)
            | Self::HeightField(_)
            | Self::Isosurface(_)
            | Self::Lathe(_)
            | Self::Mesh(_)
            | Self::Prism(_)
            | Self::Sor(_) => true,
            Self::Text(_) => !self.is_sheet(),
            Self::Algebraic(_)
            | Self::BicubicPatch(_)
            | Self::Blob(_)
            | Self::Disc(_)
            | Self::JuliaFractal(_)
            | Self::Ovus(_)
            | Self::Parametric(_)
            | Self::Polygon(_)
            | Self::SphereSweep(_)
            | Self::Superellipsoid(_)
            | Self::Torus(_) => false,
        }
    }
}

impl Placed {
    /// Returns all crossings of the entire line, in order; `t` is negative behind the ray's start.
    pub fn crossings(&self, ray: &Ray) -> Crossings {
        self.found(ray, self.edges_moved(), |seen, found| self.body.crossings(&seen.line, found))
    }

    /// Returns [`Self::crossings`] for a part of a CSG solid: the line's blur includes the rounding of the
    /// centre, so that no gap appears between parts that share a face, however far they are from the origin.
    pub fn crossings_of_part(&self, ray: &Ray) -> Crossings {
        self.found(ray, self.moved(), |seen, found| self.body.crossings(&seen.line, found))
    }

    /// Bound, in local space, on how far rounding of the centre moved the body.
    fn moved(&self) -> f64 {
        let Placement { centre, local_from_world, .. } = self.placement;
        U * (local_from_world.abs() * centre.abs()).length()
    }

    /// [`Self::moved`] for sheets, 0 for other bodies: sheets share edges, and no gap may appear between
    /// them.
    fn edges_moved(&self) -> f64 {
        if self.exact.is_none() && self.body.is_sheet() { self.moved() } else { 0.0 }
    }

    /// Returns, in order, the crossings ahead of the ray's start and not beyond `limit`, at least up to the
    /// first visible one.
    #[inline(never)]
    pub fn first_crossings(&self, ray: &Ray, limit: f64) -> Crossings {
        self.found(ray, self.edges_moved(), |seen, found| {
            let between = (seen.place(0.0, -1.0), seen.place(limit, 1.0));
            self.body.first_crossings(&seen.line, between, found);
        })
    }

    /// Returns whether `accepts` any crossing ahead of the ray's start and not beyond `limit`.
    #[inline(never)]
    pub fn crosses(&self, ray: &Ray, limit: f64, accepts: impl Fn(&Met) -> bool) -> bool {
        let seen = Seen::new(self, ray, self.edges_moved());
        if self.is_out_of_reach(&seen) {
            return false;
        }
        let between = (seen.place(0.0, -1.0), seen.place(limit, 1.0));
        let accepts = |met: &Met| accepts(&self.shared(ray, &seen.met(*met)));
        self.body.crosses(&seen.line, between, &accepts)
    }

    /// Widens the error of a crossing as if the line were blurred by the rounding of the centre: of two
    /// coincident faces, the first is then visible, however far they are from the origin. This applies only
    /// to a body outside CSG solids, and not to the decision whether the line crosses the body ahead of the
    /// start: a ray that starts on a surface is offset from it by less.
    ///
    /// With f the ray's start relative to the centre C, the error is proportional to the line's blur, at
    /// least 6u·‖|L|·|f|‖, plus the rounding of a body of size 1, at least 2u; less where the line is only
    /// tangent.
    pub fn shared(&self, ray: &Ray, met: &Met) -> Met {
        let Placement { centre, local_from_world, .. } = self.placement;
        let sizes = local_from_world.abs();
        let blur = 6.0 * (sizes * (ray.origin - centre).abs()).length() + 2.0;
        let more = 1.0 + (sizes * centre.abs()).length() / blur;
        // Sizes and places may be beyond what squares can tell.
        let more = if more.is_finite() { more } else { 1.0 };
        Met { error: met.error * more, ..*met }
    }

    #[inline(always)]
    fn found(&self, ray: &Ray, moved: f64, find: impl Fn(&Seen, &mut Crossings)) -> Crossings {
        // Returned in one place only: so it is made where the caller wants it, and never copied.
        let mut found = Crossings::new();
        let seen = Seen::new(self, ray, moved);
        if !self.is_out_of_reach(&seen) {
            find(&seen, &mut found);
            for met in &mut found {
                *met = seen.met(*met);
            }
        }
        found
    }

    /// Returns whether the line certainly misses the body; `false` where the numbers are beyond what squares can tell.
    #[inline(always)]
    fn is_out_of_reach(&self, seen: &Seen) -> bool {
        seen.miss > self.body.reach() * (1.0 + 8.0 * U) + seen.line.blur
    }

    /// Returns the part of the surface that the ray crosses at `t`.
    fn part_at(&self, ray: &Ray, t: f64, leaving: bool) -> u32 {
        let seen = Seen::new(self, ray, 0.0);
        let found = || self.crossing_at(ray, t, leaving).map_or(0, |met| met.part);
        self.body.part_at(&seen.line, seen.place(t, 0.0), leaving).unwrap_or_else(found)
    }

    /// Returns the crossing at `t`, or the nearest one. A crossing of a part of a CSG solid may be missing
    /// from the body's own crossings.
    pub fn crossing_at(&self, ray: &Ray, t: f64, leaving: bool) -> Option<Met> {
        let off = |met: &Met| (met.t - t).abs();
        let same = |met: &Met| met.leaving == leaving;
        let nearest =
            |all: Crossings| all.into_iter().filter(same).min_by(|a, b| off(a).total_cmp(&off(b)));
        let alone = nearest(self.crossings(ray));
        match alone {
            Some(met) if off(&met) <= met.error => alone,
            _ => nearest(alone.into_iter().chain(self.crossings_of_part(ray)).collect()),
        }
    }

    /// Returns the surface point where `ray` crosses at `t`. The height of the point at t is subtracted along
    /// the normal, which is the shortest path in world space. The error bound is the sum of the remaining
    /// height, the rounding of this sum, and the error of triangles as a continued ray sees them.
    pub fn surface(&self, ray: &Ray, t: f64, leaving: bool) -> SurfacePoint {
        self.surface_of_part(self.part_at(ray, t, leaving), ray, t, leaving)
    }

    /// Returns [`Self::surface`] where it is known which part is crossed.
    #[inline(never)]
    pub fn surface_of_part(&self, part: u32, ray: &Ray, t: f64, leaving: bool) -> SurfacePoint {
        let Placement { centre, local_from_world, .. } = self.placement;
        let out = local_from_world.transpose();
        let facet = self.body.facet(part);
        let height = |point: Vector| {
            let point = local_from_world * (point - centre);
            let local = match &facet {
                Some(facet) => facet.height(point),
                None => self.body.height(part, point),
            };
            Height { gradient: out * local.gradient, ..local }
        };
        let mut point = ray.at(t);
        for _ in 0..2 {
            let Height { value, gradient, .. } = height(point);
            let step = gradient * (value / gradient.length_squared());
            if step.is_finite() {
                point -= step;
            }
        }
        let told = |point: Vector| {
            let Height { value, gradient, error } = height(point);
            let steepness = gradient.length();
            let normal = (gradient / steepness).normalize_or(-ray.direction);
            // What the map's rounding moves the height by.
            let slopes = local_from_world.abs() * (point - centre).abs();
            let local_steepness = self.steepness(gradient);
            let error = (value.abs() + error + U * 24.0 * slopes.length() * local_steepness)
                / steepness
                + 2.0 * U * normal.abs_dot(point)
                + self.seen_off(normal, point);
            (SurfacePoint { point, normal, error, face: part }, value.abs() / steepness)
        };
        let (surface, left) = told(point);
        // Where less is asked for, less is promised.
        if 2.0 * left > surface.error
            && self.root_tolerance == 0.0
            && let Some(settled) = self.settled(part, ray, t, leaving)
        {
            let (settled, left_then) = told(settled);
            return if left_then < left { settled } else { surface };
        }
        surface
    }

    /// Returns the surface point where the remaining height exceeds rounding, because the line's uncertainty
    /// exceeds the surface's radius of curvature. The shortest path in world space may miss a flattened body;
    /// steps along the local normal reach it. `None` where the result is farther from the line's crossing
    /// than the crossing's error allows.
    #[cold]
    #[inline(never)]
    fn settled(&self, part: u32, ray: &Ray, t: f64, leaving: bool) -> Option<Vector> {
        const STEPS: usize = 8;
        let mut point = ray.at(t);
        for _ in 0..STEPS {
            let Height { value, gradient, .. } =
                self.body.height(part, self.placement.local_point(point));
            let step = gradient * (value / gradient.length_squared());
            point -= self.placement.world_from_local * step;
        }
        let error = self.crossing_at(ray, t, leaving)?.error;
        let is_near = (point - ray.at(t)).length() <= 8.0 * error;
        (is_near && error.is_finite()).then_some(point)
    }

    /// Returns the error of triangles as seen by a ray that starts at `from`.
    ///
    /// With a and b a corner's coordinates across the ray, and m the coordinate along the ray's dominant
    /// axis, each rounded once on the way there, b − shear·m is off by u·(2|b| + 4|m|), and a likewise.
    fn seen_off(&self, normal: Vector, from: Vector) -> f64 {
        let Some(corners) = self.farthest_corner() else { return 0.0 };
        let far = corners + (from - self.placement.centre).abs();
        6.0 * U * normal.abs().element_sum() * far.max_element()
    }

    /// Returns how far along each axis the corners of triangles may be from the centre; `None` where there are none.
    pub(super) fn farthest_corner(&self) -> Option<Vector> {
        let reach = match &*self.body {
            Body::Mesh(mesh) => mesh.reach(),
            // Below its corners it has no end.
            Body::HeightField(_) => 1.0,
            _ => return None,
        };
        Some(self.placement.world_from_local.abs() * Vector::splat(reach))
    }

    /// Returns the unit shading normal at a surface point, on either side; `None` where it is the geometric
    /// normal, as for most bodies.
    #[inline(never)]
    pub fn shading_normal(&self, surface: &SurfacePoint) -> Option<Vector> {
        let local = self.placement.local_point(surface.point);
        let normal = self.body.shading_normal(surface.face, local)?;
        Some(UnitVector::from_direction(self.placement.world_normal(normal))?.get())
    }

    /// Returns whether the geometric normal was flipped to point outward: in a solid mesh, for a triangle
    /// with the opposite winding.
    pub fn is_turned(&self, surface: &SurfacePoint) -> bool {
        matches!(*self.body, Body::Mesh(_)) && surface.face % 2 == 1
    }

    /// Returns the paints of a painted mesh or blob at a surface point, each with its weight.
    pub fn paint(&self, surface: &SurfacePoint) -> Option<Paint> {
        let local = self.placement.local_point(surface.point);
        match &*self.body {
            Body::Mesh(mesh) => mesh.paint(surface.face, local).map(Paint::from),
            Body::Blob(blob) => blob.paint(local),
            _ => None,
        }
    }

    /// Returns the body's own coordinates of its surface at a point; see `Form::Body`.
    pub fn uv(&self, surface: &SurfacePoint) -> Option<[f64; 2]> {
        let local = self.placement.local_point(surface.point);
        match &*self.body {
            Body::Mesh(mesh) => mesh.uv(surface.face, local),
            Body::BicubicPatch(patch) => Some(patch.uv(surface.face, local)),
            Body::Parametric(parametric) => Some(parametric.uv(surface.face, local)),
            _ => None,
        }
    }

    /// Length of the local gradient that corresponds to this gradient in world space.
    fn steepness(&self, gradient: Vector) -> f64 {
        (self.placement.world_from_local.transpose() * gradient).length()
    }

    /// Returns the centre and the radius of a ball that holds all crossings that rays find; `None` where it is
    /// unbounded, or the placement stretches it so much that rounding has more room.
    ///
    /// With M = `world_from_local`, ‖M‖² is at most the greatest sum of a row of |MᵀM|, and equal for a similarity.
    pub fn ball(&self) -> Option<(Vector, f64)> {
        const MOST_STRETCHED: f64 = 12.0;
        let Placement { centre, world_from_local, .. } = self.placement;
        let square = (world_from_local.transpose() * world_from_local).abs();
        let rows = square * Vector::ONE;
        let reach = self.body.reach() * rows.max_element().sqrt() * (1.0 + 64.0 * U)
            + 8.0 * U * centre.length();
        let is_known = reach.is_finite() && self.placement.condition() < MOST_STRETCHED;
        is_known.then_some((centre, reach))
    }

    /// Returns the bounds; `None` where it is unbounded. Along each axis, they are the body's extent along
    /// that row of `world_from_local`.
    pub fn bounds(&self, rounding: Rounding) -> Option<Bounds> {
        let rows = self.placement.world_from_local.transpose();
        let extent = |row: Vector| match rounding {
            Rounding::Nearest => self.body.nearest_extent(row),
            Rounding::Outward => self.body.extent(row),
        };
        self.around([rows.x_axis, rows.y_axis, rows.z_axis].map(extent), rounding)
    }

    /// Returns [`Self::bounds`] of the part of a quadric on the inner sides of `planes`.
    pub fn clipped_bounds(&self, planes: &[Plane], rounding: Rounding) -> Option<Bounds> {
        let Body::Algebraic(quadric) = &*self.body else { return None };
        let Placement { centre, world_from_local, .. } = self.placement;
        let rows = world_from_local.transpose();
        let local = |plane: &Plane| {
            let normal = plane.normal.get();
            let moved = normal.dot(centre);
            let size = plane.distance.abs() + normal.abs_dot(centre);
            HalfSpace { normal: rows * normal, offset: plane.distance - moved, size }
        };
        let spaces: Vec<HalfSpace> = planes.iter().map(local).collect();
        let extents = quadric.clipped(&spaces, [rows.x_axis, rows.y_axis, rows.z_axis]);
        self.around(extents, rounding)
    }

    /// Returns the box with these extents around the centre along each axis; `None` where it is unbounded.
    fn around(&self, extents: [(f64, f64); 3], rounding: Rounding) -> Option<Bounds> {
        let low = Vector::from_array(extents.map(|(low, _)| low));
        let high = Vector::from_array(extents.map(|(_, high)| high));
        let slack = high.abs().max(low.abs()) * (32.0 * U * self.placement.condition());
        let all = Bounds::around(self.placement.centre, [low, high], slack, rounding);
        (low.is_finite() && high.is_finite()).then_some(all)
    }

    pub fn contains(&self, point: Vector) -> bool {
        self.body.contains(self.placement.local_point(point))
    }

    /// Returns whether a line that does not cross the surface lies inside. The line may touch the surface, as
    /// at the tip of a cone; the ray may start at that point, so the start alone is inconclusive.
    pub fn holds(&self, ray: &Ray) -> bool {
        let certainly = |point| self.body.certainly_contains(self.placement.local_point(point));
        self.contains(ray.origin) || [1.0, -1.0].into_iter().any(|t| certainly(ray.at(t)))
    }
}
