//! The plan's pilot: some pixels of the picture, traced to see what all of them will cost.
//!
//! **In:** [`World`], its [`Plan`]. **Out:** the Plan with rays counted. **Invariant:** the same numbers
//! on every run: they are counts, of pixels that depend on nothing but the picture's size.

use crate::math::random::Random;
use crate::plan::{Antialias, Effect, Pilot, Plan, Region};
use crate::trace::{Counters, Sampling, TraceOptions, Unwatched, geometry, pixels};
use crate::world::World;

/// Pixels along the longer side of the picture, of those that are traced.
const SIDE: u32 = 64;

/// Traces some pixels, spread over the picture, and notes how many rays each effect sent. With adaptive
/// antialiasing they and their neighbours are looked at as the picture will be, and those on an edge
/// traced as finely; a regular grid of samples costs so many times one, which is traced.
pub fn pilot(world: &World, plan: &mut Plan) {
    let antialias = match plan.antialias {
        Antialias::Off | Antialias::Grid(_) => Antialias::Off,
        adaptive @ Antialias::Adaptive { .. } => adaptive,
    };
    let small = Plan { antialias, ..plan.clone() };
    let (width, height) = thinned(plan.frame.region);
    let places = spread(plan.frame.region, (width, height));
    let options = TraceOptions::on_threads(1);
    let geometry = geometry(world, &small, &options);
    let planned = Sampling::Planned;
    let counters =
        pixels(world, &geometry, &small, &places, planned, &options, &Unwatched).counters;
    let camera = counters.camera.max(1) as f64;
    let edges = match antialias {
        Antialias::Off | Antialias::Grid(_) => None,
        Antialias::Adaptive { grid, .. } => {
            let finer = counters.camera - places.len() as u64;
            let each = u64::from(grid.max(1)).pow(2) * places.len() as u64;
            Some(finer as f64 / each as f64)
        }
    };
    plan.pilot = Some(Pilot { width, height, rays: 1.0, edges });
    let a_pixel = plan.camera_rays_a_pixel();
    let mut all = 1.0;
    for called in &mut plan.effects {
        let sent = sent(called.effect, &counters).map(|rays| rays as f64 / camera);
        all += sent.unwrap_or(0.0);
        // The camera's own rays, those beyond one a pixel.
        let more = (called.effect == Effect::Antialiasing).then_some(1.0 - 1.0 / a_pixel);
        called.rays = sent.or(more);
    }
    plan.pilot = Some(Pilot { width, height, rays: all, edges });
}

/// The rays of an effect; `None` for those that send none of their own.
fn sent(effect: Effect, counters: &Counters) -> Option<u64> {
    match effect {
        Effect::Shadows => Some(counters.shadow),
        Effect::Reflection => Some(counters.reflection),
        Effect::Transparency => Some(counters.transmission),
        Effect::Diffuse
        | Effect::Highlights
        | Effect::Attenuation
        | Effect::DoubleIllumination
        | Effect::Hiding
        | Effect::Refraction
        | Effect::ColoredShadows
        | Effect::Patterns
        | Effect::Sky
        | Effect::Antialiasing => None,
    }
}

/// How many pixels are traced along each side of a region: all of a small one, and else so many that its
/// shape is kept as far as whole pixels can.
fn thinned(Region { width, height, .. }: Region) -> (u32, u32) {
    let longer = width.max(height);
    let scaled = |n: u32| (u64::from(n) * u64::from(SIDE) / u64::from(longer)) as u32;
    if longer <= SIDE { (width, height) } else { (scaled(width).max(1), scaled(height).max(1)) }
}

/// One pixel of each part of the region, somewhere in it: edges that run along rows of parts are hit as
/// often as any.
fn spread(region: Region, (wide, high): (u32, u32)) -> Vec<(u32, u32)> {
    let within = |part: u32, parts: u32, length: u32, random: &mut Random| {
        let start = |part: u32| u64::from(part) * u64::from(length) / u64::from(parts);
        let (first, end) = (start(part), start(part + 1));
        first as u32 + random.below((end - first) as usize) as u32
    };
    let parts = (0..high).flat_map(|j| (0..wide).map(move |i| (i, j)));
    let places = parts.map(|(i, j)| {
        let mut random = Random::of(0, u64::from(i) << 32 | u64::from(j));
        let x = region.x + within(i, wide, region.width, &mut random);
        (x, region.y + within(j, high, region.height, &mut random))
    });
    places.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thinned_picture_keeps_its_shape() {
        let whole = |width, height| Region { x: 0, y: 0, width, height };
        assert_eq!(thinned(whole(640, 480)), (64, 48));
        assert_eq!(thinned(whole(3, 64)), (3, 64));
        assert_eq!(thinned(whole(1, 1_000_000)), (1, 64));
    }

    #[test]
    fn the_pixels_are_spread_over_the_region_one_in_each_part() {
        let region = Region { x: 320, y: 120, width: 320, height: 128 };
        let places = spread(region, (64, 25));
        assert_eq!(places.len(), 64 * 25);
        for (k, &(x, y)) in places.iter().enumerate() {
            let (i, j) = (k as u32 % 64, k as u32 / 64);
            assert!(x >= 320 + 5 * i && x < 325 + 5 * i, "{x} in part {i}");
            let rows = 120 + j * 128 / 25..120 + (j + 1) * 128 / 25;
            assert!(rows.contains(&y), "{y} in part {j}");
        }
        // Of a small region each once.
        let small = Region { x: 2, y: 1, width: 3, height: 2 };
        let all = [(2, 1), (3, 1), (4, 1), (2, 2), (3, 2), (4, 2)];
        assert_eq!(spread(small, thinned(small)), all);
    }
}
