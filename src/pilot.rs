//! The plan's pilot: a small picture of the same view, traced to see what the large one will cost.
//!
//! **In:** [`World`], its [`Plan`]. **Out:** the Plan with rays counted. **Invariant:** the same numbers
//! on every run: they are counts, of a picture that depends on nothing but World and Plan.

use crate::plan::{Antialias, Effect, Frame, Pilot, Plan, Region};
use crate::trace::{Counters, TraceOptions, Unwatched, trace};
use crate::world::World;

/// Pixels along the longer side of the pilot's picture.
const SIDE: u32 = 64;

/// Traces a thinned picture, one ray a pixel, and notes how many rays each effect sent.
pub fn pilot(world: &World, plan: &mut Plan) {
    let frame = thinned(plan.frame);
    let small = Plan { frame, antialias: Antialias::Off, ..plan.clone() };
    let options = TraceOptions::on_threads(1);
    let counters = trace(world, &small, &options, &Unwatched).counters;
    let camera = counters.camera.max(1) as f64;
    let mut all = 1.0;
    for called in &mut plan.effects {
        called.rays = sent(called.effect, &counters).map(|rays| rays as f64 / camera);
        all += called.rays.unwrap_or(0.0);
    }
    let Region { width, height, .. } = frame.region;
    plan.pilot = Some(Pilot { width, height, rays: all });
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

/// The same view and the same part of it with fewer pixels: its shape is kept as far as whole pixels
/// can.
fn thinned(frame: Frame) -> Frame {
    let Frame { width, height, region } = frame;
    let longer = region.width.max(region.height);
    if longer <= SIDE {
        return frame;
    }
    let scaled = |n: u32| u64::from(n) * u64::from(SIDE) / u64::from(longer);
    let part = |start: u32, length: u32| {
        let first = scaled(start) as u32;
        (first, (scaled(start + length) as u32).saturating_sub(first).max(1))
    };
    let ((x, wide), (y, high)) = (part(region.x, region.width), part(region.y, region.height));
    let region = Region { x, y, width: wide, height: high };
    Frame {
        width: (scaled(width) as u32).max(x + wide),
        height: (scaled(height) as u32).max(y + high),
        region,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thinned_picture_keeps_its_shape_and_its_part() {
        assert_eq!(thinned(Frame::whole(640, 480)), Frame::whole(64, 48));
        assert_eq!(thinned(Frame::whole(3, 64)), Frame::whole(3, 64));
        assert_eq!(thinned(Frame::whole(1, 1_000_000)), Frame::whole(1, 64));
        let region = Region { x: 320, y: 120, width: 320, height: 128 };
        let small = thinned(Frame { region, ..Frame::whole(640, 480) });
        let region = Region { x: 64, y: 24, width: 64, height: 25 };
        assert_eq!(small, Frame { region, ..Frame::whole(128, 96) });
    }
}
