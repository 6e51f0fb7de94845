//! `lower`: from what the author meant to what is there.
//!
//! **In:** a [`Scene`]. **Out:** the canonical [`World`] and where its parts came from.
//! **Invariant:** always yields a World; what cannot be built is reported and left out. Every number
//! of the World was computed in extended precision and rounded once. Specified in `docs/world.md`.

mod camera;
mod finish;
mod light;
mod lint;
mod object;
mod shape;
mod texture;
mod transform;

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::scene::Scene;
use crate::source::{Expansions, Site};
use crate::world::{Origins, Settings, World};

/// What the caller sets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LowerOptions {
    /// The most objects, uses of one another counted each: shared unions can hold 2ⁿ in n lines.
    pub objects: u64,
}

impl Default for LowerOptions {
    fn default() -> Self {
        Self { objects: 5_000_000 }
    }
}

/// Lowers a Scene; see the module.
pub fn lower(
    scene: Scene,
    options: &LowerOptions,
    diagnostics: &mut Diagnostics,
) -> (World, Origins) {
    let mut lowering = Lowering {
        world: World::default(),
        origins: Origins::default(),
        reporter: Reporter { diagnostics, expansions: &scene.expansions },
        materials: texture::Materials::default(),
        transforms: transform::Transforms::new(&scene.transforms),
        scene: &scene,
        options: *options,
    };
    lowering.settings();
    lowering.camera();
    lowering.sky();
    lowering.objects();
    lowering.lint();
    let Lowering { world, mut origins, .. } = lowering;
    origins.expansions = scene.expansions;
    (world, origins)
}

/// A lowering under way: what is read, what is written, what is remembered.
struct Lowering<'s, 'd> {
    scene: &'s Scene,
    options: LowerOptions,
    world: World,
    origins: Origins,
    reporter: Reporter<'s, 'd>,
    materials: texture::Materials,
    transforms: transform::Transforms<'s>,
}

impl Lowering<'_, '_> {
    fn settings(&mut self) {
        let settings = &self.scene.settings;
        self.world.settings = Settings {
            max_trace_level: settings.max_trace_level.max(1),
            adc_bailout: settings.adc_bailout,
            assumed_gamma: settings.assumed_gamma,
        };
        self.origins.max_trace_level = settings.max_trace_level_site;
        if let Some(background) = &self.scene.background {
            let rgb = background.color.rgb;
            let rgb = rgb.is_finite().then_some(rgb).ok_or(Fault::not_finite("the background"));
            self.world.background = self.reporter.made(rgb, background.site).unwrap_or_default();
        }
    }
}

/// Why a part of the Scene cannot be built; whoever knows the place adds it.
#[derive(Debug, Clone, PartialEq)]
struct Fault {
    code: Code,
    message: String,
    label: String,
    help: Option<&'static str>,
}

impl Fault {
    fn new(code: Code, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), label: String::new(), help: None }
    }

    fn label(self, label: impl Into<String>) -> Self {
        Self { label: label.into(), ..self }
    }

    fn help(self, help: &'static str) -> Self {
        Self { help: Some(help), ..self }
    }

    /// `what` has a number that is infinite or not a number.
    fn not_finite(what: &str) -> Self {
        Self::new(Code::NotANumber, format!("a number of {what} is not finite"))
            .label("too large for a number, or not a number at all")
    }
}

/// The sink, and what it takes to say how evaluation came to a place.
struct Reporter<'s, 'd> {
    diagnostics: &'d mut Diagnostics,
    expansions: &'s Expansions,
}

impl Reporter<'_, '_> {
    fn fault(&mut self, fault: Fault, site: Site) {
        let mut diagnostic = Diagnostic::new(fault.code, fault.message)
            .at(site.span, fault.label)
            .traced(site, self.expansions);
        if let Some(help) = fault.help {
            diagnostic = diagnostic.help(help);
        }
        self.diagnostics.push(diagnostic);
    }

    /// What was made, or `None` and a message.
    fn made<T>(&mut self, result: Result<T, Fault>, site: Site) -> Option<T> {
        result.map_err(|fault| self.fault(fault, site)).ok()
    }

    /// As [`Self::made`], for faults that bring their place along.
    fn made_there<T>(&mut self, result: Result<T, (Fault, Site)>) -> Option<T> {
        result.map_err(|(fault, site)| self.fault(fault, site)).ok()
    }
}

#[cfg(test)]
mod tests;
