//! Placed: a body where it stands in the world. Many may share one body.

use std::sync::Arc;

use super::algebraic::HalfSpace;
use super::body::{Body, Crossings, Height, Local, Met, Seen};
use super::{Bounds, Crossing, Plane, Ray, Rounding, SurfacePoint, U};
use crate::math::placement::{ExactPlacement, Placement};
use crate::math::{UnitVector, Vector, Vector3};

#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// Stored once, however often it is placed.
    pub body: Arc<Body>,
    pub placement: Placement,
    /// How near its crossings must be found, of its own size: [`super::body::LocalRay::tolerance`].
    pub root_tolerance: f64,
    /// The placement again, of bodies whose edges or flat ends others may share.
    pub exact: Option<Box<ExactPlacement>>,
}

impl Body {
    /// Whether it has ends, faces or edges that others may share: where it stands is kept exactly.
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
    /// All crossings of the whole line, in order; `t` is negative behind the ray's start.
    pub fn crossings(&self, ray: &Ray) -> Crossings {
        self.found(ray, self.edges_moved(), |seen, found| self.body.crossings(&seen.line, found))
    }

    /// The same of a part of a solid, whose line is blurred by as much as its centre was rounded: nothing is between
    /// two parts that share a face, however far off they stand.
    pub fn crossings_of_part(&self, ray: &Ray) -> Crossings {
        self.found(ray, self.moved(), |seen, found| self.body.crossings(&seen.line, found))
    }

    /// How far it stands from where it was meant, as its centre was rounded.
    fn moved(&self) -> f64 {
        let Placement { centre, local_from_world, .. } = self.placement;
        U * (local_from_world.abs() * centre.abs()).length()
    }

    /// The same, of sheets alone: their edges are others', too, and nothing may show between.
    fn edges_moved(&self) -> f64 {
        if self.exact.is_none() && self.body.is_sheet() { self.moved() } else { 0.0 }
    }

    /// In order, those ahead of the ray's start and not beyond `limit`, at least the first that is seen.
    #[inline(never)]
    pub fn first_crossings(&self, ray: &Ray, limit: f64) -> Crossings {
        self.found(ray, self.edges_moved(), |seen, found| {
            let between = (seen.place(0.0, -1.0), seen.place(limit, 1.0));
            self.body.first_crossings(&seen.line, between, found);
        })
    }

    /// A crossing of what stands alone, its error as if the line were blurred by as much as the centre was rounded:
    /// of faces that two share the first is seen, however far off they stand. But whether the line meets the body, and
    /// ahead, is not told so: a ray that starts on a surface keeps off it by less.
    ///
    /// With f the ray's start as seen from the centre C, the error is in proportion to the line's blur, of at least
    /// 6u·‖|L|·|f|‖, and to what a body of size 1 rounds by, of at least 2u; where it only touches, less than so.
    pub fn shared(&self, ray: &Ray, met: &Met) -> Crossing {
        let Placement { centre, local_from_world, .. } = self.placement;
        let sizes = local_from_world.abs();
        let blur = 6.0 * (sizes * (ray.origin - centre).abs()).length() + 2.0;
        let more = 1.0 + (sizes * centre.abs()).length() / blur;
        // Sizes and places may be beyond what squares can tell.
        let more = if more.is_finite() { more } else { 1.0 };
        Crossing { t: met.t, error: met.error * more }
    }

    #[inline(always)]
    fn found(&self, ray: &Ray, moved: f64, find: impl Fn(&Seen, &mut Crossings)) -> Crossings {
        let mut found = Crossings::new();
        let seen = Seen::new(self, ray, moved);
        let miss = seen.line.nearest.length();
        if miss > self.body.reach() * (1.0 + 8.0 * U) + seen.line.blur {
            return found;
        }
        find(&seen, &mut found);
        for met in &mut found {
            *met = seen.met(*met);
        }
        found
    }

    /// The part of the surface that the ray crosses at `t`.
    fn part_at(&self, ray: &Ray, t: f64, leaving: bool) -> u32 {
        let seen = Seen::new(self, ray, 0.0);
        let found = || self.crossing_at(ray, t, leaving).map_or(0, |met| met.part);
        self.body.part_at(&seen.line, seen.place(t, 0.0), leaving).unwrap_or_else(found)
    }

    /// The crossing at `t`, or the nearest to it. That of a part may be none of what stands alone.
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

    /// The point of the surface where `ray` crosses it at `t`: the height of what is at t is taken off
    /// along the normal, the shortest way in the world. The distance to the true surface is bounded
    /// by the height that is left, the rounding of that very sum, and what a ray that goes on sees triangles off by.
    #[inline(never)]
    pub fn surface(&self, ray: &Ray, t: f64, leaving: bool) -> SurfacePoint {
        let part = self.part_at(ray, t, leaving);
        let Placement { centre, local_from_world, .. } = self.placement;
        let out = local_from_world.transpose();
        let height = |point: Vector| {
            let local = self.body.height(part, local_from_world * (point - centre));
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

    /// The same where what is left of the height is more than rounding: the line is known less well than the surface
    /// bends. The shortest way in the world may pass a flattened body by; steps along the local normal lead there.
    /// `None` of what is farther from the line's crossing than that may be off.
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

    /// How far triangles may be off as a ray from there sees them.
    ///
    /// With a and b a corner's coordinates across the ray and m the one along the axis that the ray is nearest to, each
    /// rounded once on the way there, b − shear·m is off by u·(2|b| + 4|m|), and a likewise.
    fn seen_off(&self, normal: Vector, from: Vector) -> f64 {
        let reach = if let Body::Mesh(mesh) = &*self.body {
            mesh.reach()
        } else if let Body::HeightField(_) = *self.body {
            // Its corners; below them it has no end.
            1.0
        } else {
            return 0.0;
        };
        let Placement { centre, world_from_local, .. } = self.placement;
        let far = world_from_local.abs() * Vector::splat(reach) + (from - centre).abs();
        6.0 * U * normal.abs().element_sum() * far.max_element()
    }

    /// The unit normal by which the surface is lit at a point of it, on either side; `None` where it is the
    /// surface's own, as of most.
    #[inline(never)]
    pub fn shading_normal(&self, surface: &SurfacePoint) -> Option<Vector> {
        let local = self.placement.local_point(surface.point);
        let normal = self.body.shading_normal(surface.face, local)?;
        Some(UnitVector::from_direction(self.placement.world_normal(normal))?.get())
    }

    /// Whether the normal of a surface was turned outward there: that of a solid mesh whose corners turn the
    /// other way.
    pub fn is_turned(&self, surface: &SurfacePoint) -> bool {
        matches!(*self.body, Body::Mesh(_)) && surface.face % 2 == 1
    }

    /// Of a painted mesh, what a point of its surface is painted with, and how much of each.
    pub fn paint(&self, surface: &SurfacePoint) -> Option<[(u32, f64); 3]> {
        let Body::Mesh(mesh) = &*self.body else { return None };
        mesh.paint(surface.face, self.placement.local_point(surface.point))
    }

    /// How long the local gradient is of which this is the world's.
    fn steepness(&self, gradient: Vector) -> f64 {
        (self.placement.world_from_local.transpose() * gradient).length()
    }

    /// `None` where it has no end. Along each axis the body's extent along that row of
    /// `world_from_local`.
    pub fn bounds(&self, rounding: Rounding) -> Option<Bounds> {
        let rows = self.placement.world_from_local.transpose();
        let extent = |row: Vector| match rounding {
            Rounding::Nearest => self.body.nearest_extent(row),
            Rounding::Outward => self.body.extent(row),
        };
        self.around([rows.x_axis, rows.y_axis, rows.z_axis].map(extent), rounding)
    }

    /// As [`Self::bounds`], of what of a quadric lies on the inner sides of planes.
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

    /// The box that goes so far from the centre along each axis; `None` where that has no end.
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

    /// Whether a line that does not cross the surface lies inside, but for where it touches the surface: at the
    /// tip of a cone, say. The ray may start just there, so that its start tells nothing.
    pub fn holds(&self, ray: &Ray) -> bool {
        let certainly = |point| self.body.certainly_contains(self.placement.local_point(point));
        self.contains(ray.origin) || [1.0, -1.0].into_iter().any(|t| certainly(ray.at(t)))
    }
}
