//! Predicts the cost of a picture: traces a pilot, a sample of its pixels.
//!
//! **In:** [`World`], its [`Plan`]. **Out:** the Plan with ray counts. **Invariant:** the numbers are
//! reproducible. They are counts over pixels that depend only on the size of the picture, and the limits on
//! their number are counts, too.

use crate::math::random::Random;
use crate::plan::{Antialias, Effect, Pilot, Plan, Region};
use crate::trace::{Counters, Limited, Sampling, TraceOptions, Unwatched, aims, geometry, pixels};
use crate::world::World;

/// Maximum number of traced pixels along the longer side of the region.
const SIDE: u32 = 64;

/// Number of rays after which the pilot stops; excludes the neighbours that adaptive antialiasing examines.
const RAYS: u64 = 1 << 20;
/// Number of equations per ray of that limit, in sphere equations, after which it stops: they take about as
/// much time as the rays.
const SOLVED_A_RAY: u64 = 16;
/// Number of pixels traced at a time. A chunk that exceeds the limit does not count.
const CHUNK: usize = 64;
/// Minimum number of finished chunks; with fewer, the depth is reduced.
const ENOUGH: usize = 2;
/// Reduced depths to try, in order.
const DEPTHS: [u32; 5] = [20, 10, 5, 3, 2];

/// Traces some pixels, spread over the picture, and records how many rays each effect sent. With adaptive
/// antialiasing, traces these pixels and their neighbours as in the full picture, and takes more samples near
/// edges. For a regular grid of samples, traces one sample, whose cost is multiplied. If that is too much
/// work, traces fewer pixels and, if even a few are too many, reduces the depth.
///
/// ```
/// use lucarne::plan::{Antialias, Frame, PlanOptions, plan};
/// use lucarne::{pilot::pilot, road::{Options, Road}, source::NoFiles};
///
/// let mut road = Road::new(&NoFiles, Options::default());
/// let (world, origins) = road.compile("a.scene", "background { rgb 1 }");
/// let options = PlanOptions { antialias: Antialias::Grid(4), ..PlanOptions::new(Frame::whole(640, 480)) };
/// let mut plan = plan(&world, &origins, &options);
/// pilot(&world, &mut plan);
/// assert_eq!(plan.pilot.unwrap().rays, 1.0); // Nothing mirrors or casts shadows.
/// assert_eq!(plan.camera_rays(), 16.0 * 640.0 * 480.0);
/// ```
pub fn pilot(world: &World, plan: &mut Plan) {
    pilot_within(world, plan, RAYS);
}

fn pilot_within(world: &World, plan: &mut Plan, limit: u64) {
    let antialias = match plan.antialias {
        Antialias::Off | Antialias::Grid(_) => Antialias::Off,
        adaptive @ Antialias::Adaptive { .. } => adaptive,
    };
    let options = TraceOptions { count_work: true, ..TraceOptions::on_threads(1) };
    let geometry = geometry(world, plan, &options);
    let (width, height) = thinned(plan.frame.region);
    let places = mixed(spread(plan.frame.region, (width, height)));
    let look = |max_trace_level: u32| {
        let plan = Plan { antialias, max_trace_level, ..plan.clone() };
        // Those for the pixels around are steps, too, but not counted.
        let steps = if antialias == Antialias::Off { limit } else { 3 * limit };
        let patience = Limited::to_steps(steps, &Unwatched);
        let (mut counters, mut pixels_done) = (Counters::default(), 0);
        for chunk in places.chunks(CHUNK) {
            let aims = aims(chunk, Sampling::Planned);
            let (seen, these) = pixels(world, &geometry, &plan, &aims, &options, &patience);
            if seen.contains(&None) {
                break;
            }
            counters += these;
            pixels_done += chunk.len();
            if counters.rays() >= limit || counters.work.solving >= SOLVED_A_RAY * limit {
                break;
            }
        }
        (counters, pixels_done)
    };
    let enough = places.len().min(ENOUGH * CHUNK);
    let deep = plan.max_trace_level;
    let less = DEPTHS.into_iter().filter(|&depth| depth < deep).chain([1]);
    let mut found = (look(deep), None);
    for depth in less {
        let ((_, pixels_done), _) = found;
        if pixels_done >= enough {
            break;
        }
        found = (look(depth), Some(depth));
    }
    let ((counters, pixels_done), depth) = found;
    let camera = counters.camera.max(1) as f64;
    let is_adaptive = antialias != Antialias::Off;
    let a_pixel = is_adaptive.then_some(camera / pixels_done.max(1) as f64);
    let found = Pilot { width, height, pixels: pixels_done, depth, rays: 1.0, camera: a_pixel };
    plan.pilot = Some(found);
    let a_pixel = plan.camera_rays_a_pixel();
    let mut all = 1.0;
    for called in &mut plan.effects {
        let sent = sent(called.effect, &counters).map(|rays| rays as f64 / camera);
        all += sent.unwrap_or(0.0);
        // Camera rays beyond one per pixel.
        let more = (called.effect == Effect::Antialiasing).then_some(1.0 - 1.0 / a_pixel);
        called.rays = sent.or(more);
    }
    plan.pilot = Some(Pilot { rays: all, ..found });
}

/// Reorders the pixels such that every prefix is spread over the region.
fn mixed(places: Vec<(u32, u32)>) -> Vec<(u32, u32)> {
    let mut keyed: Vec<(u64, (u32, u32))> = places
        .into_iter()
        .enumerate()
        // Multiples of the golden ratio, modulo 2^64.
        .map(|(i, place)| ((i as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15), place))
        .collect();
    keyed.sort_unstable();
    keyed.into_iter().map(|(_, place)| place).collect()
}

/// Returns the rays of an effect; `None` for effects that send none of their own.
fn sent(effect: Effect, counters: &Counters) -> Option<u64> {
    match effect {
        Effect::Shadows => Some(counters.shadow),
        Effect::Reflection => Some(counters.reflection),
        Effect::Transparency => Some(counters.transmission),
        // What cannot be bent out of a medium stays in it.
        Effect::Refraction => Some(counters.total_reflection),
        Effect::Diffuse
        | Effect::Highlights
        | Effect::Attenuation
        | Effect::AreaLights
        | Effect::Projections
        | Effect::LightGroups
        | Effect::DoubleIllumination
        | Effect::Hiding
        | Effect::Absorption
        | Effect::Dispersion
        | Effect::ColoredShadows
        | Effect::Patterns
        | Effect::Sky
        | Effect::FocalBlur
        | Effect::CameraNormal
        | Effect::Fog
        | Effect::Rainbows
        | Effect::Antialiasing => None,
    }
}

/// Returns how many pixels to trace along each side of a region: all of a small one, otherwise as many as
/// keep its aspect ratio up to rounding.
fn thinned(Region { width, height, .. }: Region) -> (u32, u32) {
    let longer = width.max(height);
    let scaled = |n: u32| (u64::from(n) * u64::from(SIDE) / u64::from(longer)) as u32;
    if longer <= SIDE { (width, height) } else { (scaled(width).max(1), scaled(height).max(1)) }
}

/// Returns one pixel at a random position in each cell of the region, so that edges along rows of cells are
/// hit as often as others.
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
    use crate::plan::{Frame, PlanOptions, plan};
    use crate::road::{Options, Road};
    use crate::scene::Dialect;
    use crate::source::NoFiles;

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

    #[test]
    fn a_first_part_of_the_mixed_pixels_is_spread_over_all() {
        let all: Vec<(u32, u32)> = (0..3072).map(|i| (i % 64, i / 64)).collect();
        let mixed = mixed(all.clone());
        let mut sorted = mixed.clone();
        sorted.sort_unstable_by_key(|&(x, y)| (y, x));
        assert_eq!(sorted, all);
        for band in 0..4 {
            let inside = mixed[..256].iter().filter(|(_, y)| y / 12 == band).count();
            assert!((48..=80).contains(&inside), "{inside} in band {band}");
        }
    }

    /// Clear balls that mirror: paths fork at each surface.
    fn glass(depth: u32) -> (World, Plan) {
        compiled(format!(
            "global_settings {{ max_trace_level {depth} }}
            camera {{ location <0, 3, 6> look_at 0 angle 45 }}
            light_source {{ <-8, 12, 10>, rgb 1 }}
            #for (I, 0, 3) #for (J, 0, 3) sphere {{
              <2*I - 3, 0, 2*J - 3>, 0.9 pigment {{ rgbt 1 }}
              finish {{ ambient 0 diffuse 0 reflection 0.9 }} interior {{ ior 1.5 }}
            }} #end #end"
        ))
    }

    /// Within mirrors paths end only where one looks no deeper.
    fn mirrors(depth: u32) -> (World, Plan) {
        compiled(format!(
            "global_settings {{ max_trace_level {depth} adc_bailout 0 }}
            camera {{ location 0.1 look_at z }}
            light_source {{ 0.2, rgb 1 }}
            box {{ -1, 1 pigment {{ rgb 1 }} finish {{ reflection 1 ambient 0.1 }} }}"
        ))
    }

    fn compiled(text: String) -> (World, Plan) {
        let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
        let (world, origins) = road.compile("a.scene", text.into_bytes());
        assert!(!road.diagnostics.has_errors());
        let plan = plan(&world, &origins, &PlanOptions::new(Frame::whole(320, 240)));
        (world, plan)
    }

    fn piloted((world, mut plan): (World, Plan), limit: u64) -> Pilot {
        pilot_within(&world, &mut plan, limit);
        let again = plan.pilot;
        pilot_within(&world, &mut plan, limit);
        assert_eq!(plan.pilot, again, "the same on every run");
        let sent: f64 = plan
            .effects
            .iter()
            .filter_map(|called| match called.effect {
                Effect::Antialiasing => None,
                _ => called.rays,
            })
            .sum();
        let pilot = plan.pilot.expect("sent");
        assert!((1.0 + sent - pilot.rays).abs() < 1e-9 * pilot.rays, "the lines add up to all");
        pilot
    }

    #[test]
    fn where_paths_fork_the_pilot_traces_fewer_pixels_or_looks_less_deep() {
        let shallow = piloted(glass(2), 1 << 20);
        assert_eq!((shallow.pixels, shallow.depth), (64 * 48, None));
        let fewer = piloted(glass(4), 1 << 15);
        assert!((128..64 * 48).contains(&fewer.pixels) && fewer.depth.is_none(), "{fewer:?}");
        let less = piloted(glass(200), 1 << 16);
        assert!(less.pixels >= 128 && less.depth.is_some_and(|depth| depth < 20), "{less:?}");
    }

    #[test]
    fn where_paths_do_not_end_the_pilot_looks_less_deep() {
        let less = piloted(mirrors(1_000_000), 1 << 16);
        assert!(less.pixels >= 128 && less.depth == Some(20), "{less:?}");
    }

    #[test]
    fn where_solids_are_dear_the_pilot_traces_fewer_pixels() {
        let text = b"#include \"functions.inc\"
            camera { location <0, 0, 6> look_at 0 angle 30 }
            isosurface { function { f_noise3d(9*x, 9*y, 9*z) - 0.5 } contained_by { sphere { 0, 1 } } }";
        let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
        let (world, origins) = road.compile("a.scene", text.to_vec());
        assert!(!road.diagnostics.has_errors());
        let mut plan = plan(&world, &origins, &PlanOptions::new(Frame::whole(320, 240)));
        pilot_within(&world, &mut plan, 1 << 14);
        let pilot = plan.pilot.expect("sent");
        assert!((128..64 * 48).contains(&pilot.pixels), "{pilot:?}");
        let rays = pilot.rays * plan.camera_rays_a_pixel() * pilot.pixels as f64;
        assert!(rays < f64::from(1 << 14), "not for its rays: {rays}");
    }
}
