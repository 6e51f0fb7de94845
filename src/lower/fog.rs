//! Lowers fogs: heights along a unit vector, and only what changes the picture.

use super::transform::exact;
use super::{Fault, Lowering};
use crate::color::Rgb;
use crate::math::UnitVector;
use crate::math::double::DoubleVector;
use crate::noise::Turbulence;
use crate::scene;
use crate::source::Site;
use crate::world::{Churn, Fog, Ground};

/// A fog whose distance is smaller is off, as in POV-Ray 3.7 (measured).
const LEAST_DISTANCE: f64 = 1e-10;

impl Lowering<'_, '_> {
    pub(super) fn fogs(&mut self) {
        for written in &self.scene.fogs {
            let Some(fog) = self.fog(written) else { continue };
            if fog.distance.abs() < LEAST_DISTANCE {
                self.drop_part(written.item, "fog", "its distance is 0");
            } else if fog.tint == Rgb::WHITE && fog.least == 1.0 && fog.distance > 0.0 {
                self.drop_part(written.item, "fog", "it lets all light through");
            } else {
                self.world.fogs.push(fog);
                self.origins.fogs.push(written.item);
            }
        }
    }

    /// Reports a fault and returns `None` if a number is not finite.
    fn fog(&mut self, written: &scene::Fog) -> Option<Fog> {
        let ground = match written.is_ground {
            true => Some(self.ground(written)?),
            false => None,
        };
        let filter = written.color.filter;
        let color = written.color.rgb;
        let churn = written.turbulence.filter(|_| written.turb_depth != 0.0).map(|own| Churn {
            scale: own.scale,
            depth: written.turb_depth,
            turbulence: Turbulence::new(own.lambda, own.omega, own.octaves),
            noise: written.noise,
        });
        let fog = Fog {
            color,
            tint: color.map(|c| 1.0 - filter + filter * c),
            least: written.color.transmit.max(0.0),
            distance: written.distance,
            ground,
            churn,
        };
        let is_finite = fog.color.is_finite()
            && fog.tint.is_finite()
            && [fog.least, fog.distance, written.turb_depth].iter().all(|n| n.is_finite())
            && ground.is_none_or(|ground| ground.offset.is_finite() && ground.alt.is_finite())
            && churn.is_none_or(|churn| churn.scale.is_finite());
        let finite = is_finite.then_some(fog).ok_or_else(|| Fault::not_finite("this fog"));
        self.reporter.made(finite, written.site)
    }

    fn ground(&mut self, written: &scene::Fog) -> Option<Ground> {
        let mut up = exact(written.up);
        for &id in &written.transforms {
            let site = self.scene.transform_sites.get(id.index()).copied();
            let map = self.transforms.get(id);
            up = self.reporter.made(map, site.unwrap_or(written.site))?.direction(up);
        }
        let alt = match written.alt {
            alt if alt.abs() < Ground::SHARP => Ground::SHARP.copysign(alt + 0.0),
            alt => alt,
        };
        let up = self.upward(up, written.site)?;
        Some(Ground { up, offset: written.offset, alt })
    }

    fn upward(&mut self, up: DoubleVector, site: Site) -> Option<UnitVector> {
        let unit = up.normalized().and_then(|unit| UnitVector::from_direction(unit.round()));
        self.reporter.made(unit.ok_or_else(|| Fault::no_direction("this fog's `up`")), site)
    }
}
