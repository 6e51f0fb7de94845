//! A ray followed through the scene: an explicit chain of surfaces, folded back from the last to
//! the first.
//!
//! **In:** a ray. **Out:** the radiance that comes back along it. **Invariant:** nothing grows on
//! the call stack; colours are folded, never accumulated into a throughput, so a clamp at each
//! surface is possible and every kernel rounds alike. What is inlined into a kernel is said outright
//! where it is written, so a kernel is the same machine code whichever others stand beside it.

use super::{Walk, pigment, reflection, shade, sky};
use crate::color::Rgb;
use crate::geometry::{self, Geometry};
use crate::plan::Plan;
use crate::shape::Ray;
use crate::world::{Material, World};

/// A World to be traced: nothing in it is without weight, so nothing is asked twice.
pub(super) struct Tracer<'a> {
    pub world: &'a World,
    pub geometry: &'a Geometry,
    pub max_trace_level: u32,
    pub adc_bailout: f64,
}

/// A surface on a path, waiting for what its mirrored ray sees.
#[derive(Debug)]
pub(super) struct Link {
    /// Everything but reflection.
    local: Rgb,
    reflectance: Rgb,
    exponent: f64,
    /// The seed's clamp applies.
    seed: bool,
}

impl<'a> Tracer<'a> {
    pub fn new(world: &'a World, geometry: &'a Geometry, plan: &Plan) -> Self {
        Self {
            world,
            geometry,
            max_trace_level: plan.max_trace_level,
            adc_bailout: plan.adc_bailout,
        }
    }

    /// The radiance seen along `ray`.
    ///
    /// The weight that `adc_bailout` cuts at is the product of each reflection's largest component
    /// at any angle, as in POV-Ray; a seed finish neither lowers it nor is cut by it.
    #[inline(never)]
    pub fn radiance<const SHADOWS: bool, const SECONDARY: bool>(
        &self,
        walk: &mut Walk,
        ray: Ray,
    ) -> Rgb {
        let mut ray = ray;
        let mut weight = 1.0;
        walk.chain.clear();
        let mut seen = loop {
            let Some(hit) = self.geometry.nearest(&ray) else {
                break sky::seen(self.world.sky.as_ref(), self.world.background, ray.direction);
            };
            let surface = geometry::surface(self.world, &ray, &hit);
            let object = &self.world.objects[hit.object as usize];
            let Material { pigment, finish } = &self.world.materials[object.material as usize];
            let normal = if hit.leaving { -surface.normal } else { surface.normal };
            let color = pigment::on_surface(pigment, self.world, object, &surface);
            let origin = surface.spawn(normal);
            let to_viewer = -ray.direction;
            let place =
                shade::Place { finish, color, point: surface.point, origin, normal, to_viewer };
            let local = shade::local::<SHADOWS>(self, walk, &place);
            let clamped = |c: Rgb| if finish.seed { c.at_most_one() } else { c };
            if !SECONDARY {
                break clamped(local);
            }
            let Some(reflection) = &finish.reflection else { break clamped(local) };
            let last = walk.chain.len() + 1 >= self.max_trace_level as usize;
            if !finish.seed {
                weight *= reflection.minimum.largest().max(reflection.maximum.largest());
            }
            let cut = !finish.seed && weight < self.adc_bailout;
            let reflectance = reflection::reflectance(reflection, color, normal.dot(to_viewer));
            if last || cut || reflectance.is_black() {
                break clamped(local);
            }
            walk.counters.reflection += 1;
            walk.chain.push(Link {
                local,
                reflectance,
                exponent: reflection.exponent,
                seed: finish.seed,
            });
            ray = Ray { origin, direction: reflection::mirrored(ray.direction, normal) };
        };
        for link in walk.chain.iter().rev() {
            let seen_here = reflection::adapted(seen, link.exponent);
            seen = link.local + reflection::passed_on(link.reflectance, seen_here);
            if link.seed {
                seen = seen.at_most_one();
            }
        }
        seen
    }
}
