//! A ray under way, and what is known of it before it meets anything.

use super::media::Within;
use super::shade::Place;
use super::{bumpy, reflection};
use crate::geometry::Hit;
use crate::shape::Ray;

/// A ray under way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Way {
    pub ray: Ray,
    /// How much of what it sees could come back at most, for `adc_bailout`.
    pub weight: f64,
    /// 1 for the camera's rays.
    pub level: u32,
    /// Something has mirrored it, or one it goes on from.
    pub mirrored: bool,
    pub inside: Option<Inside>,
    /// Its position in the spectrum, 0 to 1; `None` while it is of all colours.
    pub spectrum: Option<f64>,
    /// The solids it is in.
    pub within: Within,
}

/// A ray starts on the surface of an object and inside of that: it was bent there, or mirrored.
#[derive(Debug, Clone, Copy)]
pub(super) struct Inside {
    pub object: u32,
    /// How far along the ray the start may be from where it was meant.
    pub off: f64,
}

impl Inside {
    /// Where a crossing moves by its error along one ray, another face moves by some more along the next.
    pub fn of(hit: &Hit) -> Self {
        Self { object: hit.object, off: 16.0 * hit.error }
    }
}

impl Way {
    #[inline(always)]
    /// The ray of the camera that has this number in its batch.
    pub fn from_camera(ray: Ray, root: u32) -> Self {
        let within = Within::Start(root);
        Self { ray, weight: 1.0, level: 1, mirrored: false, inside: None, spectrum: None, within }
    }

    /// The ray that is mirrored where this one ends.
    #[inline(always)]
    pub fn mirrored(self, place: &Place, weight: f64) -> Self {
        let direction = match place.smooth {
            None => reflection::mirrored(self.ray.direction, place.normal),
            Some(smooth) => bumpy::reflected(self.ray.direction, place.normal, smooth),
        };
        Self {
            ray: Ray { origin: place.start(direction), direction },
            weight,
            level: self.level + 1,
            mirrored: true,
            inside: None,
            spectrum: self.spectrum,
            within: self.within,
        }
    }
}
