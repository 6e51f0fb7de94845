//! Lowers rainbows: angles in radians, and only what shows.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{Fault, Lowering};
use crate::color::Color;
use crate::math::elementary::RADIANS_PER_DEGREE;
use crate::math::{UnitVector, Vector};
use crate::scene;
use crate::world::Rainbow;

/// What an arc and its fading end at if they are not written: farther than all around, in radians. So a
/// `falloff_angle` alone fades hardly at all.
///
/// **Source:** POV-Ray 3.7's behaviour, measured.
const NEVER: f64 = 180.0;

impl Lowering<'_, '_> {
    pub(super) fn rainbows(&mut self) {
        for written in &self.scene.rainbows {
            let why = match written {
                _ if written.width == 0.0 => "its width is 0",
                _ if written.distance == 0.0 => "its distance is 0",
                scene::Rainbow { colors: None, .. } => "it has no colours",
                _ => {
                    let rainbow = lowered(written);
                    let Some(rainbow) = self.reporter.made(rainbow, written.site) else { continue };
                    if rainbow.is_visible() {
                        self.world.rainbows.push(rainbow);
                        self.origins.rainbows.push(written.item);
                        continue;
                    }
                    "it is seen only at angles beyond 0 to 90 degrees"
                }
            };
            self.drop_part(written.item, "rainbow", why);
        }
    }
}

impl Rainbow {
    /// Returns whether any ray is at an angle at which it shows.
    fn is_visible(&self) -> bool {
        let jitter = self.jitter.abs();
        let [one, other] = [-jitter, 1.0 + jitter].map(|at| self.inner + self.width * at);
        // Room for rounding.
        one.max(other) >= -1e-9 && one.min(other) <= FRAC_PI_2 + 1e-9
    }
}

fn lowered(written: &scene::Rainbow) -> Result<Rainbow, Fault> {
    let radians = |degrees: f64| degrees * RADIANS_PER_DEGREE;
    let half = |degrees: Option<f64>| degrees.map_or(NEVER, |degrees| radians(0.5 * degrees));
    let direction = unit(written.direction, "this rainbow's `direction`")?;
    let axis = direction.get();
    let up = unit(written.up, "this rainbow's `up`")?.get();
    let colors = written.colors.iter().flat_map(|map| map.0.iter().copied());
    let is_whole = written.arc_angle.is_some_and(|arc| radians(0.5 * arc) >= PI);
    let rainbow = Rainbow {
        direction,
        up: unit(up - axis * up.dot(axis), "this rainbow's `up`")?,
        inner: radians(written.angle - 0.5 * written.width),
        width: radians(written.width),
        distance: written.distance,
        colors: colors.collect(),
        jitter: written.jitter,
        // All around, whatever rounding makes of half a turn.
        arc: if is_whole { PI } else { half(written.arc_angle) },
        fade: half(written.falloff_angle),
    };
    let is_finite = |color: &Color| {
        color.rgb.is_finite() && color.filter.is_finite() && color.transmit.is_finite()
    };
    let numbers = [rainbow.inner, rainbow.width, rainbow.distance, rainbow.jitter];
    let all_finite = numbers.iter().all(|number| number.is_finite())
        && rainbow.colors.iter().all(|(at, color)| at.is_finite() && is_finite(color));
    match all_finite && rainbow.width != 0.0 {
        true => Ok(rainbow),
        false => Err(Fault::not_finite("this rainbow")),
    }
}

fn unit(vector: Vector, what: &str) -> Result<UnitVector, Fault> {
    UnitVector::from_direction(vector).ok_or_else(|| Fault::no_direction(what))
}
