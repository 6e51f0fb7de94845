//! The settings a promised picture is made and judged by, and the flags that make them.
//!
//! **In:** a World and its frame. **Out:** its own settings, the dearest, and the knobs between.

use super::knob::Knob;
use super::{Options, called_for, dearest, own};
use crate::plan::PlanOptions;
use crate::world::{Origins, World};

/// The plans a picture is made and judged by.
pub struct Easel<'a> {
    pub own: PlanOptions,
    pub deepest: PlanOptions,
    /// Those the scene calls for.
    pub knobs: Vec<&'a Knob>,
}

impl<'a> Easel<'a> {
    pub fn new(world: &World, origins: &Origins, options: &Options<'a>) -> Self {
        let own = own(world, options.frame);
        let deepest = dearest(own, options.knobs);
        Self { own, deepest, knobs: called_for(world, origins, own, options.knobs) }
    }

    pub fn flags(&self, options: &PlanOptions) -> String {
        let flags = self.knobs.iter().map(|knob| (knob.flag)((knob.get)(options)));
        flags.collect::<Vec<_>>().join(" ")
    }

    /// The same without the number of samples, which is each pixel's own.
    pub fn flags_of_rays(&self, options: &PlanOptions) -> String {
        let knobs = self.knobs.iter().filter(|knob| knob.name != "antialias");
        let flags = knobs.map(|knob| (knob.flag)((knob.get)(options)));
        flags.collect::<Vec<_>>().join(" ")
    }
}
