//! Finds the first surface that is seen in each pixel.
//!
//! **In:** a World, by its Plan. **Out:** the [`FirstSurface`] of each pixel of the region. **Invariant:** each depends
//! on its pixel alone.
//!
//! Rays go through the centres of pixels, and of a lens that blurs through its middle. Of the surfaces' textures only
//! colours and normals are evaluated: no light is.

use super::camera::Lens;
use super::layered::Known;
use super::parts::Surface;
use super::texture::SurfaceInteraction;
use super::tiles::Crew;
use super::tracer::Tracer;
use super::{TraceOptions, Watch, geometry};
use crate::color::Rgb;
use crate::film::{Channel, FirstSurface, Surfaces};
use crate::geometry::{Hit, Work};
use crate::math::Vector;
use crate::math::wide::{ROW, Rays, numbers};
use crate::plan::{Frame, Plan};
use crate::shape::Ray;
use crate::texture::Surroundings;
use crate::world::{Origins, World};

/// Returns the first surfaces of the Plan's region, with these channels; `None` if there are none, or the watch stopped it.
pub fn first_surfaces(
    (world, origins): (&World, &Origins),
    plan: &Plan,
    channels: &[Channel],
    options: &TraceOptions,
    watch: &dyn Watch,
) -> Option<Surfaces> {
    let channels: Vec<Channel> =
        Channel::ALL.into_iter().filter(|channel| channels.contains(channel)).collect();
    if channels.is_empty() {
        return None;
    }
    let geometry = geometry(world, plan, options);
    let world = &*world.within_julia_iterations(plan.julia_iterations);
    let tracer = Tracer::new(world, &geometry, plan, watch);
    watch.built();
    let Frame { width, height, region } = plan.frame;
    let lens = Lens::new(&world.camera, width, height);
    let row = region.width as usize;
    let mut pixels = vec![FirstSurface::NOTHING; row * region.height as usize];
    Crew::new(options, watch).bands(&mut pixels, row.max(1), |line, pixels| {
        if !watch.should_stop() {
            let places = (region.x..).map(|x| (x, region.y + line as u32));
            tracer.see_row(&lens, origins, places, pixels);
        }
    });
    (!watch.should_stop()).then_some(Surfaces { channels, pixels })
}

impl Tracer<'_> {
    /// Finds the first surfaces of pixels at these places.
    fn see_row(
        &self,
        lens: &Lens,
        origins: &Origins,
        places: impl Iterator<Item = (u32, u32)>,
        pixels: &mut [FirstSurface],
    ) {
        let points = places.take(pixels.len()).map(|place| lens.point(place, (0, 0), 1));
        let rays = lens.rays(&points.collect::<Vec<_>>());
        // Where a point has several rays, which meet surfaces of their own, the first stands for all.
        let rays = rays.chunks(lens.rays_of_a_point()).zip(pixels);
        let mut seen: Vec<(Ray, &mut FirstSurface)> = rays
            .filter_map(|(rays, pixel)| Some((*rays.iter().flatten().next()?, pixel)))
            .collect();
        let [directly, _] = self.met();
        for seen in seen.chunks_mut(ROW) {
            let rays = Rays::new(seen.iter().map(|(ray, _)| ray));
            let mut hits = [Hit::NOTHING; ROW];
            directly.nearest_together(&rays, &mut hits, &mut Work::default());
            self.see_near(&mut hits);
            for number in numbers(rays.mask) {
                let (ray, pixel) = &mut seen[number];
                if let Some(hit) = hits[number].found() {
                    **pixel = self.first_surface(origins, ray, &hit);
                }
            }
        }
    }

    fn first_surface(&self, origins: &Origins, ray: &Ray, hit: &Hit) -> FirstSurface {
        let world = self.world;
        let coat = world.coat(&world.objects[hit.object as usize], hit.leaving);
        let point = crate::geometry::surface(world, ray, hit);
        let around = SurfaceInteraction::new(self, ray, hit, &point);
        let smooth = around.normal().unwrap_or(point.normal);
        let surface = Surface {
            around,
            adc_bailout: self.adc_bailout,
            untinted_layers: world.settings.untinted_layers,
            normal: smooth,
            to_viewer: -ray.direction,
            // Layers are as clear as without an interior, which nothing here follows.
            fresnel: &|_| 0.0,
            known: Known::NOTHING,
        };
        let (mut normal, mut albedo) = (Vector::ZERO, Rgb::BLACK);
        for stack in surface.stacks(&world.textures[coat.texture as usize]) {
            for part in &stack.parts {
                let seen = part.above * (stack.share * part.share);
                normal += part.normal * seen.brightness();
                albedo += part.body(world.settings.clearness) * seen;
            }
        }
        // The mean of several may be nothing.
        let length = normal.length();
        let normal = if length > 0.0 { normal / length } else { smooth };
        let gamma = world.settings.assumed_gamma;
        FirstSurface {
            depth: hit.t as f32,
            normal: normal.to_array().map(|c| c as f32),
            albedo: albedo.components().map(|c| gamma.linear(c) as f32),
            object: origins.root(hit.object),
        }
    }
}
