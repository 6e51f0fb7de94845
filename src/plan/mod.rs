//! What to do about a World: which effects to simulate and why, what each knob is set to, and which
//! kernel traces it.
//!
//! **Invariant:** each effect is named once, as simulated or as left out; pruning is exact or not
//! done. Values of no weight are not in the World at all (`lower` drops them and says so); the Plan
//! decides by what is there. Shadows and secondary rays are hot: the tracer has a kernel for each
//! combination. Patterns, lights and lobes are data: it evaluates those there are.

mod dropped;
mod effects;
mod extent;
mod kernel;
mod kinds;
mod numerics;
pub mod print;

pub use effects::plan;
pub use kernel::Kernel;
pub use kinds::Kind;
pub use numerics::{Measured, Numerics, Thin};

use crate::source::Site;
use crate::world::Dropped;

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

impl Region {
    /// How many there are.
    pub fn pixels(&self) -> f64 {
        f64::from(self.width) * f64::from(self.height)
    }
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

/// The arithmetic that rays and shapes meet in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    /// 32 bits, for shapes that have such a kernel.
    Single,
    /// 64 bits.
    #[default]
    Double,
}

/// How exactly rays and shapes meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arithmetic {
    pub precision: Precision,
    /// How near a crossing must be found, of the size of its solid, where steps come nearer and nearer
    /// to it; 0 asks for all that the arithmetic can tell.
    pub root_tolerance: f64,
    /// So many iterations of a fractal are looked at, where it has more.
    pub julia_iterations: Option<u32>,
}

/// What the caller asks of the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanOptions {
    pub frame: Frame,
    pub antialias: Antialias,
    /// Overrides the scene's `max_trace_level`.
    pub depth: Option<u32>,
    /// Overrides the scene's `adc_bailout`.
    pub adc_bailout: Option<f64>,
    pub precision: Precision,
    /// See [`Arithmetic`].
    pub root_tolerance: f64,
    /// Likewise.
    pub julia_iterations: Option<u32>,
}

impl PlanOptions {
    /// What `render` does unless it is told otherwise.
    pub fn new(frame: Frame) -> Self {
        let (antialias, precision) = (Antialias::default(), Precision::Double);
        Self {
            frame,
            antialias,
            depth: None,
            adc_bailout: None,
            precision,
            root_tolerance: 0.0,
            julia_iterations: None,
        }
    }
}

/// Something the tracer can simulate, or not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Effect {
    Diffuse,
    Highlights,
    Shadows,
    /// Lights that are less than their colour somewhere: beams, and light that fades with the distance.
    Attenuation,
    /// Light on one side of a surface that lights the other, too.
    DoubleIllumination,
    Reflection,
    /// Rays that go on behind clear surfaces.
    Transparency,
    /// What indices of refraction do: bend rays, and say how much is reflected.
    Refraction,
    /// Light that comes through clear surfaces.
    ColoredShadows,
    Patterns,
    /// Objects that the camera or mirrors do not see.
    Hiding,
    Sky,
    Antialiasing,
}

impl Effect {
    /// In the order the plan lists them.
    pub const ALL: [Self; 13] = [
        Self::Diffuse,
        Self::Highlights,
        Self::Shadows,
        Self::Attenuation,
        Self::DoubleIllumination,
        Self::Reflection,
        Self::Transparency,
        Self::Refraction,
        Self::ColoredShadows,
        Self::Patterns,
        Self::Hiding,
        Self::Sky,
        Self::Antialiasing,
    ];

    /// How people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Diffuse => "diffuse light",
            Self::Highlights => "highlights",
            Self::Shadows => "shadows",
            Self::Attenuation => "beams and fading",
            Self::DoubleIllumination => "light from behind",
            Self::Reflection => "reflection",
            Self::Transparency => "transparency",
            Self::Refraction => "refraction",
            Self::ColoredShadows => "coloured shadows",
            Self::Patterns => "patterns",
            Self::Hiding => "hidden objects",
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
    pub precision: Precision,
    /// See [`Arithmetic`].
    pub root_tolerance: f64,
    /// Likewise.
    pub julia_iterations: Option<u32>,
    pub kernel: Kernel,
    /// What will be simulated.
    pub effects: Vec<Called>,
    /// What will not, and why.
    pub left_out: Vec<LeftOut>,
    /// Parts of the scene that cannot change the picture.
    pub dropped: Vec<Dropped>,
    pub numerics: Numerics,
    /// Each kind of shape that there is.
    pub kinds: Vec<Kind>,
    /// `None` where nobody sent one.
    pub pilot: Option<Pilot>,
}

/// An effect, and everything that called for it.
#[derive(Debug, Clone, PartialEq)]
pub struct Called {
    pub effect: Effect,
    /// In text order, each place once: without all of these pieces of text the effect is gone, and the
    /// scene still whole. Empty when the caller's options called.
    pub by: Vec<Site>,
    /// What it costs: `one ray a light and hit`.
    pub cost: String,
    /// How many rays the pilot sent for it, a ray of the camera; `None` for what sends none. Of
    /// antialiasing: how many of the camera's are beyond one a pixel.
    pub rays: Option<f64>,
}

/// An effect that nothing calls for.
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut {
    pub effect: Effect,
    pub why: String,
    pub site: Option<Site>,
}

/// Some pixels of the picture, traced to count rays.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pilot {
    /// How many pixels there were to be, side by side and one above the other, spread over the region.
    pub width: u32,
    pub height: u32,
    /// How many were traced, as far as its limit of rays went; these are spread over the region, too.
    pub pixels: usize,
    /// How many surfaces deep, where as deep as the plan says not one of many would have been done.
    pub depth: Option<u32>,
    /// All rays, a ray of the camera.
    pub rays: f64,
    /// The share of the pixels that adaptive antialiasing samples anew; `None` where it is not
    /// adaptive.
    pub edges: Option<f64>,
}

impl Plan {
    pub fn simulates(&self, effect: Effect) -> bool {
        self.called(effect).is_some()
    }

    pub fn called(&self, effect: Effect) -> Option<&Called> {
        self.effects.iter().find(|called| called.effect == effect)
    }

    pub fn arithmetic(&self) -> Arithmetic {
        let Self { precision, root_tolerance, julia_iterations, .. } = *self;
        Arithmetic { precision, root_tolerance, julia_iterations }
    }

    /// Rays of the camera, of the whole region.
    pub fn camera_rays(&self) -> f64 {
        let Region { width, height, .. } = self.frame.region;
        f64::from(width) * f64::from(height) * self.camera_rays_a_pixel()
    }

    /// Where antialiasing is adaptive, with what its pilot found; before that, the least number.
    pub fn camera_rays_a_pixel(&self) -> f64 {
        let squared = |n: u32| f64::from(n.max(1)) * f64::from(n.max(1));
        match self.antialias {
            Antialias::Off => 1.0,
            Antialias::Grid(n) => squared(n),
            Antialias::Adaptive { grid, .. } => {
                let edges = self.pilot.and_then(|pilot| pilot.edges).unwrap_or(0.0);
                1.0 + edges * squared(grid)
            }
        }
    }
}
