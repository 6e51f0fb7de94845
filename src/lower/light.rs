//! Lowers lights: applies transforms to positions and directions.

use super::object::Inherited;
use super::transform::{Affine, exact};
use super::{Fault, LowerOptions, Lowering, lower_at, single};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::math::double::DoubleVector;
use crate::math::elementary::cos;
use crate::math::{UnitVector, Vector};
use crate::scene::{
    Dialect, LightKind, LightSource, LooksLike, ObjectId, ProjectedThrough, TransformId,
};
use crate::source::Site;
use crate::world::{self, Area, Attenuation, Beam, Fade, Light, World};

impl<'s> Lowering<'s, '_> {
    /// Places a light; a black one is dropped. `item` is the whole source item that contains it. Returns the object
    /// that it looks like, which is `here` then.
    pub(super) fn light(
        &mut self,
        light: &'s LightSource,
        here: &mut Inherited,
        site: Site,
        item: Site,
    ) -> Option<&'s [ObjectId]> {
        self.shining(light, here, site, item);
        let like = light.looks_like.as_ref()?;
        if self.building.is_some() {
            self.drop_part(site, "looks_like", "its light is in a solid");
            return None;
        }
        let place = self.place_of_like(light, like, &here.world_from_here);
        here.world_from_here = self.reporter.made(place, site)?;
        here.flags.no_shadow = true;
        here.light_group = self.group_of_like(here.light_group);
        Some(std::slice::from_ref(&like.object))
    }

    fn shining(&mut self, light: &LightSource, here: &Inherited, site: Site, item: Site) {
        let map = &here.world_from_here;
        if light.color.is_black() {
            self.black.get_or_insert(light.color_site.unwrap_or(site));
            return self.drop_part(site, "light_source", "its colour is black");
        }
        if matches!(light.kind, LightKind::Cylinder { beam, .. } if beam.falloff <= 0.0) {
            return self.drop_part(site, "light_source", "its cylinder has no width");
        }
        let LightSource { beam_site, fade_site, .. } = *light;
        let area_site = light.area.site;
        let spent = self.undone(&light.aimed_after).and_then(|aim| {
            let sides = self.undone(&light.area.sides_after)?;
            spend(light, map, &aim, &sides, self.scene.dialect)
        });
        let Some(mut placed) = self.reporter.made(spent, site) else { return };
        self.origins.area_lights.extend(area_site.filter(|_| placed.area.is_some()));
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
        if let Some(through) = &light.projected_through {
            let object = self.projection(through, map);
            let Some(object) = self.reporter.made(object, through.site) else { return };
            if object.objects.is_empty() {
                return self.drop_part(site, "light_source", "it shines through nothing");
            }
            placed.through = Some(self.world.projections.len() as u32);
            self.world.projections.push(object);
            self.origins.projections.push(through.site);
        }
        self.world.lights.push(placed);
        self.light_of_group(here.light_group);
        self.lamps.push(site);
        self.origins.lights.push(item);
    }

    /// Returns a World of the object that a light shines through.
    fn projection(&mut self, through: &ProjectedThrough, map: &Affine) -> Result<World, Fault> {
        let place = map.after(&self.undone(&through.after)?);
        let options = LowerOptions { objects: self.options.objects, ..LowerOptions::default() };
        let mut told = Diagnostics::new(false);
        let (world, _) = lower_at(single(self.scene, through.object), place, &options, &mut told);
        let is_of_object = |one: &&Diagnostic| one.is_error() && one.code != Code::NoCamera;
        for one in told.iter().filter(is_of_object) {
            self.reporter.diagnostics.push(one.clone());
        }
        Ok(world)
    }

    /// Returns the map of the object that a light looks like: from around the origin to the World.
    fn place_of_like(
        &mut self,
        light: &LightSource,
        like: &LooksLike,
        map: &Affine,
    ) -> Result<Affine, Fault> {
        let location = light.kind.location().unwrap_or(Vector::ZERO);
        let moved = self.transforms.product(&like.after)?.point(exact(location));
        let axes = [Vector::X, Vector::Y, Vector::Z].map(exact);
        Ok(map.after(&self.undone(&like.after)?).after(&Affine::from_columns(axes, moved)))
    }

    /// Returns the map that undoes a light's transforms before one of its words: they do not change what that word
    /// says.
    fn undone(&mut self, before: &[TransformId]) -> Result<Affine, Fault> {
        match before {
            [] => Ok(Affine::IDENTITY),
            before => self.transforms.product(before)?.checked(),
        }
    }
}

fn spend(
    light: &LightSource,
    map: &Affine,
    aim: &Affine,
    sides: &Affine,
    dialect: Dialect,
) -> Result<Light, Fault> {
    let kind = match light.kind {
        LightKind::Point { location } | LightKind::Spotlight { location, .. } => {
            world::LightKind::Point { position: map.point(exact(location)).round() }
        }
        LightKind::Direction { to_light } => {
            world::LightKind::Directional { to_light: unit(map.direction(exact(to_light)))? }
        }
        LightKind::Parallel { location, point_at, .. }
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
    let attenuation = attenuation(light, map, aim, dialect)?;
    let area = area(light, map, aim, sides)?;
    let casts_shadows = !light.shadowless;
    Ok(Light { kind, color, casts_shadows, attenuation, area, through: None })
}

/// Returns the area of a light if it has an effect.
fn area(
    light: &LightSource,
    map: &Affine,
    aim: &Affine,
    sides: &Affine,
) -> Result<Option<Area>, Fault> {
    let from = &light.area;
    let is_point =
        from.nodes.into_iter().zip(from.sides).all(|(n, side)| n == 1 || side == Vector::ZERO);
    // Without shadows, only what it shines through may keep a part of it away.
    let is_whole = light.shadowless && light.projected_through.is_none();
    if is_point || (is_whole && !from.illuminates) {
        return Ok(None);
    }
    let target = match light.kind {
        LightKind::Direction { .. } => return Ok(None),
        LightKind::Point { .. } | LightKind::Spotlight { .. } => None,
        LightKind::Parallel { point_at, .. } | LightKind::Cylinder { point_at, .. } => {
            Some(map.point(aim.point(exact(point_at))).round())
        }
    };
    let moved = |side: Vector| map.direction(sides.direction(exact(side))).round();
    let mut moved = from.sides.map(moved);
    // A side of one light has no length. All sides that turn have that of the first.
    for (side, nodes) in moved.iter_mut().zip(from.nodes) {
        if nodes == 1 && !from.orient {
            *side = Vector::ZERO;
        }
    }
    if !moved.iter().copied().chain(target).all(Vector::is_finite) {
        return Err(Fault::not_finite("this light"));
    }
    let depth = from.nodes.into_iter().map(|n| u32::BITS - (n - 1).leading_zeros()).max();
    let adaptive = from.adaptive.filter(|adaptive| depth.is_some_and(|depth| *adaptive < depth));
    Ok(Some(Area {
        sides: moved,
        nodes: from.nodes,
        least_divisions: adaptive.unwrap_or(Area::ALL_NODES),
        jitter: from.jitter,
        circular: from.circular || from.orient,
        orient: from.orient,
        illuminates: from.illuminates,
        target,
    }))
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
    dialect: Dialect,
) -> Result<Option<Attenuation>, Fault> {
    let beam = match light.kind {
        LightKind::Point { .. }
        | LightKind::Parallel { beam: None, .. }
        | LightKind::Direction { .. } => None,
        LightKind::Parallel { location, point_at, beam: Some(beam) }
        | LightKind::Spotlight { location, point_at, beam } => {
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
    // In a `.scene`, light fades the same way on both sides of its plane.
    let is_parallel = matches!(light.kind, LightKind::Parallel { .. } | LightKind::Cylinder { .. });
    let fade = light.fade.map(|fade| Fade {
        distance: fade.distance,
        power: fade.power,
        signed: is_parallel && dialect == Dialect::Pov && fade.power % 2.0 != 0.0,
    });
    let fades = fade.map_or([0.0; 2], |fade| [fade.distance, fade.power]);
    if numbers.iter().chain(&fades).any(|number| !number.is_finite()) {
        return Err(Fault::not_finite("this light"));
    }
    Ok((beam.is_some() || fade.is_some()).then_some(Attenuation { beam, fade, fog: false }))
}
