//! Holds the settings with which a picture under a promise is rendered and judged, and the flags for them.
//!
//! **In:** a World and its frame. **Out:** its own settings, the most expensive ones, and the knobs between
//! them.

use super::knob::Knob;
use super::{Options, called_for, dearest, own};
use crate::plan::PlanOptions;
use crate::world::{Origins, World};

/// The plans with which a picture is rendered and judged.
pub struct Easel<'a> {
    pub own: PlanOptions,
    pub deepest: PlanOptions,
    /// Knobs that affect the scene.
    pub knobs: Vec<&'a Knob>,
}

impl<'a> Easel<'a> {
    pub fn new(world: &World, origins: &Origins, options: &Options<'a>) -> Self {
        let own = PlanOptions { alpha: options.alpha, ..own(world, options.frame) };
        let deepest = dearest(own, options.knobs);
        Self { own, deepest, knobs: called_for(world, origins, own, options.knobs) }
    }

    pub fn flags(&self, options: &PlanOptions) -> String {
        let flags = self.knobs.iter().map(|knob| (knob.flag)((knob.get)(options)));
        flags.collect::<Vec<_>>().join(" ")
    }

    /// Returns the flags without the number of samples, which differs between pixels.
    pub fn flags_of_rays(&self, options: &PlanOptions) -> String {
        let knobs = self.knobs.iter().filter(|knob| !knob.samples_pixels());
        let flags = knobs.map(|knob| (knob.flag)((knob.get)(options)));
        flags.collect::<Vec<_>>().join(" ")
    }
}
