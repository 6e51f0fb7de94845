//! Where a light stands as seen from a point, and whether anything is between.

use std::cmp::Ordering;

use super::Walk;
use super::media::Within;
use super::texture;
use super::tracer::Tracer;
use crate::color::Rgb;
use crate::geometry::{Between, Hit, Occluder};
use crate::math::wide::{Rays, Row};
use crate::math::{UnitVector, Vector};
use crate::shape::Ray;
use crate::world::LightKind;

/// From a point toward a light.
#[derive(Clone, Copy)]
pub(super) struct Aim {
    /// Of length 1.
    pub to_light: Vector,
    /// What is not nearer than this casts no shadow; negative behind a parallel light's plane.
    pub reach: f64,
}

/// Positive where `light` is on the side of a surface that `normal` points to, 0 where it is in the
/// very plane of it.
#[inline(always)]
pub(super) fn height(light: &LightKind, point: Vector, normal: Vector) -> f64 {
    match *light {
        LightKind::Point { position } => normal.dot(position - point),
        LightKind::Directional { to_light } | LightKind::Parallel { to_light, .. } => {
            normal.dot(to_light.get())
        }
    }
}

/// `None` when the point is the light.
///
/// A `parallel` light shines on both sides of its plane; only what stands between the plane and
/// the point, on the side it shines to, casts a shadow. **Source:** POV-Ray 3.7's behaviour.
#[inline(always)]
pub(super) fn aim(light: &LightKind, point: Vector) -> Option<Aim> {
    match *light {
        LightKind::Point { position } => {
            let way = position - point;
            let square = way.length_squared();
            if square.is_normal() {
                let reach = square.sqrt();
                Some(Aim { to_light: way / reach, reach })
            } else {
                let to_light = UnitVector::from_direction(way)?.get();
                Some(Aim { to_light, reach: way.dot(to_light) })
            }
        }
        LightKind::Directional { to_light } => {
            Some(Aim { to_light: to_light.get(), reach: f64::INFINITY })
        }
        LightKind::Parallel { position, to_light } => {
            let to_light = to_light.get();
            Some(Aim { to_light, reach: (position - point).dot(to_light) })
        }
    }
}

/// Whether something opaque stands between `origin` (just off a surface) and the light, the `light`th.
#[inline(always)]
pub(super) fn shadowed(
    tracer: &Tracer,
    walk: &mut Walk,
    light: usize,
    origin: Vector,
    aim: &Aim,
) -> bool {
    walk.counters.shadow += 1;
    let ray = Ray { origin, direction: aim.to_light };
    let guess = walk.occluders.get(light).copied().unwrap_or(Occluder::NONE);
    let occluder = tracer.geometry.occluder(&ray, aim.reach, guess, &mut walk.counters.work);
    if occluder != guess {
        walk.remember(light, occluder);
    }
    occluder != Occluder::NONE
}

/// As [`shadowed`], for rays and how far they go: a bit for each.
#[inline(always)]
pub(super) fn shadowed_together(
    tracer: &Tracer,
    walk: &mut Walk,
    light: usize,
    rays: &Rays,
    reaches: &Row,
) -> u32 {
    walk.counters.shadow += u64::from(rays.mask.count_ones());
    let guess = walk.occluders.get(light).copied().unwrap_or(Occluder::NONE);
    let mut occluder = guess;
    let work = &mut walk.counters.work;
    let shadowed = tracer.geometry.occluded_together(rays, reaches, &mut occluder, work);
    if occluder != guess {
        walk.remember(light, occluder);
    }
    shadowed
}

/// As [`shadowed_together`], where only a few things may stand between.
#[inline(always)]
pub(super) fn shadowed_between(
    tracer: &Tracer,
    walk: &mut Walk,
    light: usize,
    between: &Between,
    (rays, reaches): (&Rays, &Row),
) -> u32 {
    walk.counters.shadow += u64::from(rays.mask.count_ones());
    let guess = walk.occluders.get(light).copied().unwrap_or(Occluder::NONE);
    let mut occluder = guess;
    let work = &mut walk.counters.work;
    let rays = (rays, reaches);
    let shadowed = tracer.geometry.occluded_between(between, rays, &mut occluder, work);
    if occluder != guess {
        walk.remember(light, occluder);
    }
    shadowed
}

/// The part of the light that comes through the clear surfaces between `origin` and the light: the
/// product of what each lets through, in and out. Straight on, whatever they are filled with.
///
/// The factors are multiplied in the order of the surfaces, not of the search.
///
/// **Source:** POV-Ray 3.7's behaviour, measured: neither reflection nor `conserve_energy` nor `ior`
/// takes part in it.
#[inline(never)]
pub(super) fn filtered(
    tracer: &Tracer,
    walk: &mut Walk,
    within: Within,
    origin: Vector,
    aim: &Aim,
) -> Rgb {
    let ray = Ray { origin, direction: aim.to_light };
    let Filters { hits, factors } = &mut walk.filters;
    hits.clear();
    tracer.geometry.filters(&ray, aim.reach, hits, &mut walk.counters.work);
    factors.clear();
    factors.extend(hits.iter().map(|hit| (hit.t, texture::to_light(tracer, &ray, hit))));
    factors.sort_by(|(a, x), (b, y)| {
        let ties = x.components().into_iter().zip(y.components()).map(|(x, y)| x.total_cmp(&y));
        ties.fold(a.total_cmp(b), Ordering::then)
    });
    let light = factors.iter().fold(Rgb::WHITE, |light, (_, factor)| light * *factor);
    if !tracer.absorbs || light.is_black() {
        return light;
    }
    light * walk.media.left_of_light(tracer.solids(), within, hits)
}

/// Room for the surfaces between a point and a light.
#[derive(Debug, Default)]
pub(super) struct Filters {
    hits: Vec<Hit>,
    /// How far away each is, and what it lets through.
    factors: Vec<(f64, Rgb)>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_on_the_point_itself_has_no_direction() {
        let light = LightKind::Point { position: Vector::ONE };
        assert!(aim(&light, Vector::ONE).is_none());
    }

    #[test]
    fn a_light_is_found_at_any_distance() {
        for size in [1e-300, 1e-160, 1.0, 1e160, 1e300] {
            let light = LightKind::Point { position: Vector::new(3.0, 4.0, 0.0) * size };
            let aim = aim(&light, Vector::ZERO).expect("not on the light");
            assert!((aim.to_light - Vector::new(0.6, 0.8, 0.0)).length() < 1e-14);
            assert!((aim.reach / size - 5.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_parallel_light_reaches_to_its_plane_and_not_behind() {
        let position = Vector::new(7.0, 2.0, 7.0);
        let light = LightKind::Parallel { position, to_light: UnitVector::Y };
        assert_eq!(aim(&light, Vector::ZERO).map(|a| a.reach), Some(2.0));
        assert_eq!(aim(&light, Vector::Y * 5.0).map(|a| a.reach), Some(-3.0));
    }
}
