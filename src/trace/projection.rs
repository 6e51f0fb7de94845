//! Lights that shine through an object (`projected_through`): only where a ray to the light meets that.
//!
//! **In:** a ray toward a light. **Out:** how far it has to be free. **Invariant:** a pure function of the ray and the
//! light; other lights do not come here.
//!
//! **Source:** POV-Ray manual, section "Projected Through"; POV-Ray 3.7's behaviour, measured.

use super::Walk;
use super::shadow::Aim;
use super::tracer::Tracer;
use crate::math::Vector;
use crate::shape::Ray;
use crate::world::Light;

impl Tracer<'_> {
    /// Returns the way from `origin` to the nearest crossing of the object that `light` shines through: what is beyond
    /// casts no shadow. `None` if there is none before the light.
    #[inline(always)]
    pub(super) fn shone_through(
        &self,
        walk: &mut Walk,
        light: &Light,
        origin: Vector,
        aim: &Aim,
    ) -> Option<Aim> {
        match light.through {
            None => Some(*aim),
            Some(object) => self.way_to_object(walk, object, origin, aim),
        }
    }

    #[cold]
    #[inline(never)]
    fn way_to_object(
        &self,
        walk: &mut Walk,
        object: u32,
        origin: Vector,
        aim: &Aim,
    ) -> Option<Aim> {
        if self.counts {
            walk.counters.evaluations.projections += 1;
        }
        let ray = Ray { origin, direction: aim.to_light };
        let object = self.geometry.projection(object);
        let hit = object.nearest_counted(&ray, &mut walk.counters.work).found()?;
        // Where the object is in the scene, too, it casts no shadow by itself.
        let reach = (hit.t - 2.0 * hit.error).max(0.0);
        (hit.t < aim.reach).then_some(Aim { reach, ..*aim })
    }
}
