//! Lowers lights: applies transforms to positions and directions.

use super::transform::{Affine, exact};
use super::{Fault, Lowering};
use crate::math::UnitVector;
use crate::math::double::DoubleVector;
use crate::math::elementary::cos;
use crate::scene::{LightKind, LightSource};
use crate::source::Site;
use crate::world::{self, Attenuation, Beam, Fade, Light};

impl Lowering<'_, '_> {
    /// Places a light; a black one is dropped. `item` is the whole source item that contains it.
    pub(super) fn light(&mut self, light: &LightSource, map: &Affine, site: Site, item: Site) {
        if light.color.is_black() {
            self.black.get_or_insert(light.color_site.unwrap_or(site));
            return self.drop_part(site, "light_source", "its colour is black");
        }
        if matches!(light.kind, LightKind::Cylinder { beam, .. } if beam.falloff <= 0.0) {
            return self.drop_part(site, "light_source", "its cylinder has no width");
        }
        let LightSource { beam_site, fade_site, .. } = *light;
        let spent = self.aim(light).and_then(|aim| spend(light, map, &aim));
        let Some(mut placed) = self.reporter.made(spent, site) else { return };
        let in_fog = light.media_site.filter(|_| light.media_interaction && placed.casts_shadows);
        let fog = in_fog.filter(|_| !self.world.fogs.is_empty());
        if fog.is_some() {
            let none = Attenuation { beam: None, fade: None, fog: false };
            let others = placed.attenuation.unwrap_or(none);
            placed.attenuation = Some(Attenuation { fog: true, ..others });
        }
        if let Some(Attenuation { beam, fade, .. }) = placed.attenuation {
            let sites = [beam.and(beam_site), fade.and(fade_site), fog];
            self.origins.attenuation.extend(sites.into_iter().flatten());
        }
        self.world.lights.push(placed);
        self.lamps.push(site);
        self.origins.lights.push(item);
    }

    /// Returns the map that takes a light's `point_at` to where all of the light's transforms would have
    /// moved it.
    fn aim(&mut self, light: &LightSource) -> Result<Affine, Fault> {
        match light.aimed_after.as_slice() {
            [] => Ok(Affine::IDENTITY),
            before => self.transforms.product(before)?.checked(),
        }
    }
}

fn spend(light: &LightSource, map: &Affine, aim: &Affine) -> Result<Light, Fault> {
    let kind = match light.kind {
        LightKind::Point { location } | LightKind::Spotlight { location, .. } => {
            world::LightKind::Point { position: map.point(exact(location)).round() }
        }
        LightKind::Direction { to_light } => {
            world::LightKind::Directional { to_light: unit(map.direction(exact(to_light)))? }
        }
        LightKind::Parallel { location, point_at }
        | LightKind::Cylinder { location, point_at, .. } => world::LightKind::Parallel {
            position: map.point(exact(location)).round(),
            to_light: unit(map.direction(exact(location) - aim.point(exact(point_at))))?,
        },
    };
    let finite = match kind {
        world::LightKind::Point { position } | world::LightKind::Parallel { position, .. } => {
            position.is_finite()
        }
        world::LightKind::Directional { .. } => true,
    };
    let color = light.color.bounded();
    if !finite || !color.is_finite() {
        return Err(Fault::not_finite("this light"));
    }
    let attenuation = attenuation(light, map, aim)?;
    Ok(Light { kind, color, casts_shadows: !light.shadowless, attenuation })
}

fn unit(direction: DoubleVector) -> Result<UnitVector, Fault> {
    match direction.normalized() {
        Some(unit) if unit.is_finite() => Ok(UnitVector::from_unit(unit.round())),
        Some(_) => Err(Fault::not_finite("this light's direction")),
        None => Err(Fault::no_direction("this light's direction")),
    }
}

/// Returns the beam and the fade if they have an effect. Only the axis is moved: transforms change neither
/// angles nor the width of a cylinder of light nor `fade_distance`, as in POV-Ray 3.7 (measured).
fn attenuation(
    light: &LightSource,
    map: &Affine,
    aim: &Affine,
) -> Result<Option<Attenuation>, Fault> {
    let beam = match light.kind {
        LightKind::Point { .. } | LightKind::Parallel { .. } | LightKind::Direction { .. } => None,
        LightKind::Spotlight { location, point_at, beam } => {
            let axis = unit(map.direction(aim.point(exact(point_at)) - exact(location)))?;
            let cosine = |degrees: f64| cos(degrees.abs().min(180.0).to_radians());
            let edge = cosine(beam.falloff.max(beam.radius));
            Some(Beam::Cone { axis, edge, core: cosine(beam.radius), tightness: beam.tightness })
        }
        LightKind::Cylinder { beam, .. } => {
            // Without a radius it does not fade toward its edge (measured).
            let core = if beam.radius > 0.0 { 1.0 - beam.radius / beam.falloff } else { 0.0 };
            Some(Beam::Cylinder { radius: beam.falloff, core, tightness: beam.tightness })
        }
    };
    let numbers = match beam {
        Some(Beam::Cone { tightness, edge, core, .. }) => [tightness, edge, core],
        Some(Beam::Cylinder { radius, core, tightness }) => [radius, core, tightness],
        None => [0.0; 3],
    };
    let fade = light.fade.map(|fade| Fade { distance: fade.distance, power: fade.power });
    let fades = fade.map_or([0.0; 2], |fade| [fade.distance, fade.power]);
    if numbers.iter().chain(&fades).any(|number| !number.is_finite()) {
        return Err(Fault::not_finite("this light"));
    }
    Ok((beam.is_some() || fade.is_some()).then_some(Attenuation { beam, fade, fog: false }))
}
