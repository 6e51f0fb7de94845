//! Plans how to trace a World: which effects to simulate and why, the value of each setting, and the
//! stages that rays pass through.
//!
//! **Invariant:** each effect is listed once, as simulated or as left out. Pruning is exact or not done.
//! Values of zero weight are not in the World (`lower` drops and reports them), so the Plan depends only on
//! what the World contains. Patterns, lights and lobes are data: the tracer evaluates those that exist.
//!
//! ```
//! use lucarne::plan::{Effect, Frame, PlanOptions, plan};
//! use lucarne::{road::{Options, Road}, source::NoFiles};
//!
//! let text = "light_source { 9, rgb 1 } sphere { 0, 1 pigment { rgb 1 } finish { reflection 0.5 } }";
//! let mut road = Road::new(&NoFiles, Options::default());
//! let (world, origins) = road.compile("a.scene", text);
//! let plan = plan(&world, &origins, &PlanOptions::new(Frame::whole(64, 48)));
//! let mirrors = plan.called(Effect::Reflection).expect("it is simulated");
//! assert_eq!(road.sources.text(mirrors.by[0].span), "reflection 0.5");
//! assert!(plan.left_out.iter().any(|one| one.effect == Effect::Fog && one.why == "no `fog`"));
//! ```

mod dropped;
mod effects;
mod extent;
mod kinds;
mod numerics;
pub mod print;
mod stage;
mod surfaces;

pub use effects::plan;
pub use kinds::Kind;
pub use numerics::{Measured, Numerics, Thin};
pub use stage::Stage;

use std::fmt;

use crate::source::Site;
use crate::world::Dropped;

/// Size of the full picture and the region to trace, in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Frame {
    /// Width of the full picture.
    pub width: u32,
    /// Height of the full picture.
    pub height: u32,
    /// The part to trace.
    pub region: Region,
}

impl Frame {
    /// Returns the frame of a picture that is traced in full.
    pub const fn whole(width: u32, height: u32) -> Self {
        Self { width, height, region: Region { x: 0, y: 0, width, height } }
    }
}

/// Part of a picture, in pixels; `x` and `y` count from the top left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Region {
    /// Left edge.
    pub x: u32,
    /// Top edge.
    pub y: u32,
    /// Number of columns.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
}

impl Region {
    /// Returns the number of pixels.
    pub fn pixels(&self) -> f64 {
        f64::from(self.width) * f64::from(self.height)
    }

    /// Returns the places of its pixels, row by row.
    pub fn places(self) -> impl Iterator<Item = (u32, u32)> {
        let Self { x, y, width, height } = self;
        (y..y + height).flat_map(move |y| (x..x + width).map(move |x| (x, y)))
    }

    /// Whether a pixel is in it.
    pub fn contains(self, (x, y): (u32, u32)) -> bool {
        (self.x..self.x + self.width).contains(&x) && (self.y..self.y + self.height).contains(&y)
    }
}

/// Antialiasing mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Antialias {
    /// One ray through the centre of each pixel.
    Off,
    /// N × N rays per pixel, on a regular grid.
    Grid(u32),
    /// One ray per pixel, then 4 to `grid` × `grid` near edges, where neighbours differ by more than `threshold`
    /// in an encoded component: as many as the pixel's samples call for.
    Adaptive {
        /// 0 … 1; 1 is the difference of black and white.
        threshold: f64,
        /// Square root of the most samples of a pixel.
        grid: u32,
    },
}

impl Default for Antialias {
    fn default() -> Self {
        Self::Adaptive { threshold: 0.05, grid: 8 }
    }
}

/// Samples of an area light, or of a pixel that a lens blurs.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Samples {
    /// As the scene says.
    #[default]
    Scene,
    /// So many, wherever they are taken.
    Fixed(u32),
    /// No more than are needed for an estimated error of at most `threshold`, 1 being that between black and
    /// white, and at most `most`.
    Adaptive {
        /// The estimated error.
        threshold: f64,
        /// The most samples.
        most: u32,
    },
}

impl fmt::Display for Samples {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Scene => f.write_str("scene"),
            Self::Fixed(count) => write!(f, "{count}"),
            Self::Adaptive { threshold, most } => write!(f, "adaptive {threshold} {most}"),
        }
    }
}

/// Precision of intersections.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arithmetic {
    /// Tolerance of iterative root finding, relative to the size of the solid; 0 means full precision.
    pub root_tolerance: f64,
    /// Maximum number of iterations of a fractal; a lower number in the scene is kept.
    pub julia_iterations: Option<u32>,
}

/// The caller's options.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanOptions {
    /// Size of the picture, and the region to trace.
    pub frame: Frame,
    /// Samples per pixel.
    pub antialias: Antialias,
    /// Overrides the scene's `max_trace_level`.
    pub depth: Option<u32>,
    /// Overrides the scene's `adc_bailout`.
    pub adc_bailout: Option<f64>,
    /// See [`Arithmetic`].
    pub root_tolerance: f64,
    /// See [`Arithmetic`].
    pub julia_iterations: Option<u32>,
    /// Samples per area light and place that it may light.
    pub light_samples: Samples,
    /// Samples per pixel that a lens blurs.
    pub blur_samples: Samples,
    /// Each pixel knows how much of it is not the background.
    pub alpha: bool,
}

impl PlanOptions {
    /// Returns the defaults of `render`.
    pub fn new(frame: Frame) -> Self {
        Self {
            frame,
            antialias: Antialias::default(),
            depth: None,
            adc_bailout: None,
            root_tolerance: 0.0,
            julia_iterations: None,
            light_samples: Samples::Scene,
            blur_samples: Samples::Scene,
            alpha: false,
        }
    }
}

/// Effect that the tracer can simulate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Effect {
    /// Light that surfaces scatter.
    Diffuse,
    /// Reflections of lights themselves: `phong`, `specular`.
    Highlights,
    /// Rays toward lights.
    Shadows,
    /// Lights dimmer than their color in some places: spotlight beams, and light that fades with distance.
    Attenuation,
    /// Soft shadows from lights that are a grid of lights.
    AreaLights,
    /// Lights that shine through an object, and nowhere else.
    Projections,
    /// Lights that do not light all objects.
    LightGroups,
    /// Light on one side of a surface that also illuminates the other side.
    DoubleIllumination,
    /// Rays that surfaces mirror.
    Reflection,
    /// Rays that continue through transparent surfaces.
    Transparency,
    /// Effects of the index of refraction: bent rays, and the fraction of light reflected.
    Refraction,
    /// Light that fades on its way through an interior.
    Absorption,
    /// Light split into its colours where it is bent.
    Dispersion,
    /// Light filtered by transparent surfaces.
    ColoredShadows,
    /// Colours and normals that depend on the point.
    Patterns,
    /// Objects that are invisible to the camera or in reflections.
    Hiding,
    /// A `sky_sphere`.
    Sky,
    /// A lens that blurs what is not in focus.
    FocalBlur,
    /// Rays of the camera that its normal bends.
    CameraNormal,
    /// Fog between surfaces.
    Fog,
    /// Coloured arcs around a direction.
    Rainbows,
    /// More than one sample per pixel.
    Antialiasing,
}

impl Effect {
    /// All effects, in the order in which the plan lists them.
    pub const ALL: [Self; 22] = [
        Self::Diffuse,
        Self::Highlights,
        Self::Shadows,
        Self::Attenuation,
        Self::AreaLights,
        Self::Projections,
        Self::LightGroups,
        Self::DoubleIllumination,
        Self::Reflection,
        Self::Transparency,
        Self::Refraction,
        Self::Absorption,
        Self::Dispersion,
        Self::ColoredShadows,
        Self::Patterns,
        Self::Hiding,
        Self::Sky,
        Self::FocalBlur,
        Self::CameraNormal,
        Self::Fog,
        Self::Rainbows,
        Self::Antialiasing,
    ];

    /// Returns the name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Diffuse => "diffuse light",
            Self::Highlights => "highlights",
            Self::Shadows => "shadows",
            Self::Attenuation => "beams and fading",
            Self::AreaLights => "area lights",
            Self::Projections => "projected lights",
            Self::LightGroups => "light groups",
            Self::DoubleIllumination => "light from behind",
            Self::Reflection => "reflection",
            Self::Transparency => "transparency",
            Self::Refraction => "refraction",
            Self::Absorption => "absorption",
            Self::Dispersion => "dispersion",
            Self::ColoredShadows => "coloured shadows",
            Self::Patterns => "patterns",
            Self::Hiding => "hidden objects",
            Self::Sky => "sky",
            Self::FocalBlur => "focal blur",
            Self::CameraNormal => "camera normal",
            Self::Fog => "fog",
            Self::Rainbows => "rainbows",
            Self::Antialiasing => "antialiasing",
        }
    }
}

/// What [`trace`](crate::trace::trace()) does, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Size of the picture, and the region to trace.
    pub frame: Frame,
    /// Samples per pixel.
    pub antialias: Antialias,
    /// Maximum recursion depth; 1 traces camera rays only.
    pub max_trace_level: u32,
    /// Weight below which a ray is not followed.
    pub adc_bailout: f64,
    /// See [`Arithmetic`].
    pub root_tolerance: f64,
    /// See [`Arithmetic`].
    pub julia_iterations: Option<u32>,
    /// See [`PlanOptions`].
    pub light_samples: Samples,
    /// See [`PlanOptions`].
    pub blur_samples: Samples,
    /// See [`PlanOptions`].
    pub alpha: bool,
    /// The stages that run, in their order.
    pub stages: Vec<Stage>,
    /// Effects that are simulated.
    pub effects: Vec<Called>,
    /// Effects that are not simulated, and why.
    pub left_out: Vec<LeftOut>,
    /// Parts of the scene that cannot change the picture.
    pub dropped: Vec<Dropped>,
    /// What may strain the arithmetic.
    pub numerics: Numerics,
    /// Kinds of shapes that occur.
    pub kinds: Vec<Kind>,
    /// Kinds of patterns, normals, patterned textures and layers that occur.
    pub surfaces: Vec<Kind>,
    /// Statistics of the pilot, if one was traced.
    pub pilot: Option<Pilot>,
}

/// An effect that is simulated, and everything that requires it.
#[derive(Debug, Clone, PartialEq)]
pub struct Called {
    /// The effect.
    pub effect: Effect,
    /// Source locations in text order, without duplicates. Removing all of them removes the effect and
    /// leaves a valid scene. Empty if the caller's options require the effect.
    pub by: Vec<Site>,
    /// What it costs: `one ray a light and hit`.
    pub cost: String,
    /// Rays that the pilot sent for this effect, per camera ray; `None` for effects that send none. For
    /// antialiasing: camera rays beyond one per pixel.
    pub rays: Option<f64>,
}

/// An effect that nothing requires.
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut {
    /// The effect.
    pub effect: Effect,
    /// Why it is not simulated.
    pub why: String,
    /// What in the scene says so, if anything does.
    pub site: Option<Site>,
}

/// A sample of the picture's pixels, traced to count rays.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pilot {
    /// Columns and rows of the planned grid of pixels, which covers the region.
    pub width: u32,
    /// See `width`.
    pub height: u32,
    /// Pixels traced before the limit of rays was reached; they are spread over the region, too.
    pub pixels: usize,
    /// Recursion depth, if it was reduced because too few pixels would have been traced at the planned
    /// depth.
    pub depth: Option<u32>,
    /// All rays, per camera ray.
    pub rays: f64,
    /// Camera rays per pixel; `None` if antialiasing is not adaptive.
    pub camera: Option<f64>,
}

impl Plan {
    /// Returns whether a stage runs.
    pub fn runs(&self, stage: Stage) -> bool {
        self.stages.contains(&stage)
    }

    /// Whether an effect is simulated.
    pub fn simulates(&self, effect: Effect) -> bool {
        self.called(effect).is_some()
    }

    /// Returns what requires an effect; `None` if it is not simulated.
    pub fn called(&self, effect: Effect) -> Option<&Called> {
        self.effects.iter().find(|called| called.effect == effect)
    }

    /// Returns the precision of intersections.
    pub fn arithmetic(&self) -> Arithmetic {
        let Self { root_tolerance, julia_iterations, .. } = *self;
        Arithmetic { root_tolerance, julia_iterations }
    }

    /// Returns the number of camera rays for the region.
    pub fn camera_rays(&self) -> f64 {
        let Region { width, height, .. } = self.frame.region;
        f64::from(width) * f64::from(height) * self.camera_rays_a_pixel()
    }

    /// Returns the camera rays per pixel. With adaptive antialiasing, uses the pilot's result or, before
    /// the pilot, the minimum.
    pub fn camera_rays_a_pixel(&self) -> f64 {
        let squared = |n: u32| f64::from(n.max(1)) * f64::from(n.max(1));
        match self.antialias {
            Antialias::Off => 1.0,
            Antialias::Grid(n) => squared(n),
            Antialias::Adaptive { .. } => self.pilot.and_then(|pilot| pilot.camera).unwrap_or(1.0),
        }
    }
}
