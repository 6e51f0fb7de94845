//! What the caller sets: the dialect, the picture's size, declarations, the clock, and what stops a scene that
//! would never end.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::scene::Dialect;

/// What the caller sets.
#[derive(Debug, Clone, PartialEq)]
pub struct EvaluateOptions {
    pub dialect: Dialect,
    /// `image_width` and `image_height`.
    pub width: u32,
    pub height: u32,
    /// `-D name=value`, in order.
    pub declares: Vec<(String, f64)>,
    pub clock: f64,
    /// Days since the beginning of the year 2000, UTC: `now`.
    pub now: f64,
    pub frame_number: f64,
    pub limits: Limits,
    /// Every brace without a partner where it is written pairs as it is run.
    pub loose: bool,
    pub interrupt: Interrupt,
}

/// Set by the caller while a scene is evaluated, it ends the loop that turns then.
#[derive(Debug, Clone, Copy, Default)]
pub struct Interrupt(pub Option<&'static AtomicBool>);

impl Interrupt {
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
            now: 0.0,
            frame_number: 0.0,
            limits: Limits::default(),
            loose: false,
            interrupt: Interrupt::default(),
        }
    }
}

/// What stops a scene that would never end, or not in this machine's memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Turns of one loop; all together may turn [`Limits::TOGETHER`] times as often, and as many
    /// macros be called.
    pub loop_turns: u64,
    /// Macro calls inside each other, and `#declare`s that wait for the values of each other.
    pub macro_depth: u32,
    /// Includes inside each other.
    pub include_depth: u32,
    /// Brackets and directives inside each other, in one file. None waits on the stack; a gigabyte holds so many
    /// blocks.
    pub nesting: u32,
    /// Objects of the scene, declared ones included.
    pub objects: u64,
    /// MiB of what has to be remembered beside the objects: strings, maps, lists of transforms.
    pub memory: u64,
    /// MiB of one string.
    pub string: u64,
}

impl Limits {
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
