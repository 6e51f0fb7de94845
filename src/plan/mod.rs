//! What to do about a World: which effects to simulate and why, and what each knob is set to.
//!
//! **Invariant:** each effect is named once, as simulated or as left out; pruning is exact or not
//! done. Diffuse light, highlights, shadows, reflection and the sky are decisions: the tracer asks
//! the Plan. Patterns, single lights and lobes are data: the tracer evaluates those the World has
//! (and passes over black lights by itself), and the Plan only says whether there are any.

mod effects;
pub mod print;

pub use effects::plan;

use crate::source::Site;

/// The whole picture's size and the part of it to trace, in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Frame {
    pub width: u32,
    pub height: u32,
    pub region: Region,
}

impl Frame {
    pub const fn whole(width: u32, height: u32) -> Self {
        Self { width, height, region: Region { x: 0, y: 0, width, height } }
    }
}

/// Part of a picture: `x`, `y` from its top left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Region {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

/// How edges are smoothed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Antialias {
    /// One ray through the centre of each pixel.
    Off,
    /// N × N rays in each pixel, on a regular grid.
    Grid(u32),
    /// One ray a pixel, then `grid` × `grid` where neighbours differ by more than `threshold` in
    /// an encoded component.
    Adaptive { threshold: f64, grid: u32 },
}

impl Default for Antialias {
    fn default() -> Self {
        Self::Adaptive { threshold: 0.05, grid: 4 }
    }
}

/// What the caller asks of the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanOptions {
    pub frame: Frame,
    pub antialias: Antialias,
    /// Overrides the scene's `max_trace_level`.
    pub depth: Option<u32>,
}

/// Something the tracer can simulate, or not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Effect {
    Diffuse,
    Highlights,
    Shadows,
    Reflection,
    Patterns,
    Sky,
    Antialiasing,
}

impl Effect {
    /// In the order the plan lists them.
    pub const ALL: [Self; 7] = [
        Self::Diffuse,
        Self::Highlights,
        Self::Shadows,
        Self::Reflection,
        Self::Patterns,
        Self::Sky,
        Self::Antialiasing,
    ];

    /// How people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Diffuse => "diffuse light",
            Self::Highlights => "highlights",
            Self::Shadows => "shadows",
            Self::Reflection => "reflection",
            Self::Patterns => "patterns",
            Self::Sky => "sky",
            Self::Antialiasing => "antialiasing",
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    pub frame: Frame,
    pub antialias: Antialias,
    /// Surfaces deep: 1 follows the camera's rays alone.
    pub max_trace_level: u32,
    pub adc_bailout: f64,
    /// What will be simulated.
    pub effects: Vec<Called>,
    /// What will not, and why.
    pub left_out: Vec<LeftOut>,
}

/// An effect, and everything that called for it.
#[derive(Debug, Clone, PartialEq)]
pub struct Called {
    pub effect: Effect,
    /// Empty when the caller's options did.
    pub by: Vec<Site>,
    /// What it costs: `one ray a light and hit`.
    pub cost: String,
}

#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut {
    pub what: String,
    pub why: String,
    pub site: Option<Site>,
}

impl Plan {
    pub fn simulates(&self, effect: Effect) -> bool {
        self.effects.iter().any(|called| called.effect == effect)
    }
}
