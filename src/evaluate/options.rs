//! Options of an evaluation: the dialect, the image size, declarations, the clock, and limits for scenes that
//! would never end.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::scene::Dialect;

/// Options set by the caller.
#[derive(Debug, Clone, PartialEq)]
pub struct EvaluateOptions {
    /// The language of the main file.
    pub dialect: Dialect,
    /// Value of `image_width`.
    pub width: u32,
    /// Value of `image_height`.
    pub height: u32,
    /// `-D name=value` options, in order.
    pub declares: Vec<(String, f64)>,
    /// Value of `clock`.
    pub clock: f64,
    /// Language version of a scene before its first `#version`; `None`: that of a scene without one.
    pub version: Option<f64>,
    /// Days since the beginning of the year 2000, UTC: the value of `now`.
    pub now: f64,
    /// `None`: a still.
    pub animation: Option<Animation>,
    /// When to stop.
    pub limits: Limits,
    /// Whether every brace without a partner where it is written pairs at run time.
    pub loose: bool,
    /// A flag that stops it earlier.
    pub interrupt: Interrupt,
}

/// A frame of an animation; `clock` has its own option.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Animation {
    /// Value of `frame_number`.
    pub frame_number: u32,
    /// Numbers of the first and the last frame.
    pub frames: (u32, u32),
    /// Clocks of the first and the last frame.
    pub clocks: (f64, f64),
    /// Time between two frames.
    pub clock_delta: f64,
}

impl Animation {
    /// Returns the value of a predeclared identifier.
    pub(super) fn number(&self, name: &str) -> f64 {
        match name {
            "frame_number" => self.frame_number.into(),
            "initial_frame" => self.frames.0.into(),
            "final_frame" => self.frames.1.into(),
            "initial_clock" => self.clocks.0,
            "final_clock" => self.clocks.1,
            "clock_delta" => self.clock_delta,
            _ => 0.0,
        }
    }
}

/// A flag that the caller sets during evaluation to end the loop that is running.
#[derive(Debug, Clone, Copy, Default)]
pub struct Interrupt(pub Option<&'static AtomicBool>);

impl Interrupt {
    /// Whether the flag is set.
    pub fn is_set(self) -> bool {
        self.0.is_some_and(|set| set.load(Ordering::Relaxed))
    }
}

impl PartialEq for Interrupt {
    fn eq(&self, other: &Self) -> bool {
        match (self.0, other.0) {
            (Some(a), Some(b)) => std::ptr::eq(a, b),
            (a, b) => a.is_none() && b.is_none(),
        }
    }
}

impl Default for EvaluateOptions {
    fn default() -> Self {
        Self {
            dialect: Dialect::Scene,
            width: 640,
            height: 480,
            declares: Vec::new(),
            clock: 0.0,
            version: None,
            now: 0.0,
            animation: None,
            limits: Limits::default(),
            loose: false,
            interrupt: Interrupt::default(),
        }
    }
}

/// Limits that stop a scene that would never end or would exhaust memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Turns of one loop; the total of all loops, and the number of macro calls, may be [`Limits::TOGETHER`]
    /// times as many.
    pub loop_turns: u64,
    /// Depth of nested macro calls, and of `#declare`s that wait for the values of each other.
    pub macro_depth: u32,
    /// Depth of nested includes.
    pub include_depth: u32,
    /// Depth of nested brackets and directives in one file. They do not use the stack; a gigabyte holds this
    /// many blocks.
    pub nesting: u32,
    /// Number of objects in the scene, including declared ones.
    pub objects: u64,
    /// MiB of data beside the objects: strings, maps, lists of transforms.
    pub memory: u64,
    /// MiB of one string.
    pub string: u64,
}

impl Limits {
    /// Turns of all loops together, in turns of one loop.
    pub const TOGETHER: u64 = 4;
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            loop_turns: 1_000_000_000,
            macro_depth: 1_000,
            include_depth: 64,
            nesting: 200_000,
            objects: 5_000_000,
            memory: 2_048,
            string: 16,
        }
    }
}
