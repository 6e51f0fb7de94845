//! Lights: transforms are spent on positions and directions.

use super::transform::{Affine, exact};
use super::{Fault, Lowering};
use crate::math::UnitVector;
use crate::math::double::DoubleVector;
use crate::scene::{LightKind, LightSource};
use crate::source::Site;
use crate::world::{self, Light};

impl Lowering<'_, '_> {
    /// A black light gives nothing and is dropped. `item` is all of what it stands in.
    pub(super) fn light(&mut self, light: &LightSource, map: &Affine, site: Site, item: Site) {
        if light.color.is_black() {
            return self.drop_part(site, "light_source", "its colour is black");
        }
        if let Some(light) = self.reporter.made(spend(light, map), site) {
            self.world.lights.push(light);
            self.origins.lights.push(item);
        }
    }
}

fn spend(light: &LightSource, map: &Affine) -> Result<Light, Fault> {
    let unit = |to_light: DoubleVector| match to_light.normalized() {
        Some(unit) if unit.is_finite() => Ok(UnitVector::from_unit(unit.round())),
        Some(_) => Err(Fault::not_finite("this light's direction")),
        None => Err(Fault::no_direction("this light's direction")),
    };
    let kind = match light.kind {
        LightKind::Point { location } => {
            world::LightKind::Point { position: map.point(exact(location)).round() }
        }
        LightKind::Direction { to_light } => {
            world::LightKind::Directional { to_light: unit(map.direction(exact(to_light)))? }
        }
        LightKind::Parallel { location, point_at } => world::LightKind::Parallel {
            position: map.point(exact(location)).round(),
            to_light: unit(map.direction(exact(location) - exact(point_at)))?,
        },
    };
    let finite = match kind {
        world::LightKind::Point { position } | world::LightKind::Parallel { position, .. } => {
            position.is_finite()
        }
        world::LightKind::Directional { .. } => true,
    };
    if !finite || !light.color.is_finite() {
        return Err(Fault::not_finite("this light"));
    }
    Ok(Light { kind, color: light.color, casts_shadows: !light.shadowless })
}
