//! Whoever waits for a picture, and when work is stopped.
//!
//! **Invariant:** between two questions whether to stop stands bounded work, also within one pixel.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::film::{Film, Pixel};

/// Follows the tracing of a film, and may stop it: [`Watched`] for most programs. Called from several threads at once.
pub trait Watch: Sync {
    /// Called when the tree of boxes is built and tracing begins.
    fn built(&self) {}
    /// Called when a pass over a film begins; `film` has the pixels that are already done.
    fn begins(&self, _pass: usize, _film: &Film) {}
    /// Called when a tile is done, with its rows, and the place of its top left pixel.
    fn traced(&self, _pass: usize, _place: (u32, u32), _rows: &[&mut [Pixel]]) {}
    /// Called when `done` of `total` pieces of work are done.
    fn progress(&self, done: usize, total: usize);
    /// Asked before each piece, and now and then within one; once it says yes, no further piece is
    /// begun, and the pixels under way are left as they were.
    fn should_stop(&self) -> bool;
}

/// Neither follows the tracing nor stops it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn progress(&self, _: usize, _: usize) {}
    fn should_stop(&self) -> bool {
        false
    }
}

/// Calls a closure with the part of the work that is done, 0 … 1, now and then and from several threads; it returns
/// whether to go on.
///
/// ```
/// use lucarne::{RenderOptions, render, trace::Watched};
///
/// let watch = Watched::new(|done| {
///     print!("\r{:.0} %", 100.0 * done);
///     done < 0.5
/// });
/// let text = "camera { location 5*z look_at 0 } sphere { 0, 1 pigment { rgb 1 } } light_source { 9, rgb 1 }";
/// let picture = render(text, &RenderOptions { watch: &watch, ..RenderOptions::of_size(320, 240) })?;
/// assert!(!picture.complete);
/// # Ok::<(), lucarne::Messages>(())
/// ```
#[derive(Debug, Default)]
pub struct Watched<F> {
    call: F,
    /// The bits of the part that is done.
    done: AtomicU64,
}

impl<F: Fn(f64) -> bool + Sync> Watched<F> {
    /// Watches by a closure.
    pub fn new(call: F) -> Self {
        Self { call, done: AtomicU64::new(0) }
    }
}

impl<F: Fn(f64) -> bool + Sync> Watch for Watched<F> {
    fn progress(&self, done: usize, total: usize) {
        let done = done as f64 / total.max(1) as f64;
        // Numbers that are not negative are ordered as their bits.
        self.done.fetch_max(done.to_bits(), Ordering::Relaxed);
    }

    fn should_stop(&self) -> bool {
        !(self.call)(f64::from_bits(self.done.load(Ordering::Relaxed)))
    }
}

/// Stops after so many steps, too: where each piece of work is done by one thread, the same ones on every run.
pub struct Limited<'a> {
    /// Questions.
    left: AtomicU64,
    watch: &'a dyn Watch,
}

impl<'a> Limited<'a> {
    /// A step is a sample of a pixel, a surface that rays go on from, or a ray toward an area light.
    pub fn to_steps(steps: u64, watch: &'a dyn Watch) -> Self {
        Self { left: AtomicU64::new(steps / u64::from(Patience::STEPS)), watch }
    }
}

impl Watch for Limited<'_> {
    fn built(&self) {
        self.watch.built();
    }

    fn progress(&self, done: usize, total: usize) {
        self.watch.progress(done, total);
    }

    fn should_stop(&self) -> bool {
        let one_less = |left: u64| left.checked_sub(1);
        self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, one_less).is_err()
            || self.watch.should_stop()
    }
}

/// How long a thread works within one pixel before it asks again whether to stop. One pixel can be
/// more work than all others together: where every path forks, 250 surfaces deep, or is mirrored a million
/// times.
#[derive(Debug, Default)]
pub(super) struct Patience {
    /// Steps until then.
    left: u32,
    /// The watch wants no more: what the pixel at hand shows is no longer true.
    pub is_over: bool,
}

impl Patience {
    /// A step is a sample of a pixel, a surface that rays go on from, or a ray toward an area light.
    pub const STEPS: u32 = 64;

    /// Whether to give up, after some more steps.
    #[inline(always)]
    pub fn is_over_after(&mut self, mut steps: u32, watch: &dyn Watch) -> bool {
        while steps > self.left {
            steps -= self.left;
            if self.ask(watch) {
                return true;
            }
        }
        self.left -= steps;
        false
    }

    #[cold]
    #[inline(never)]
    pub fn ask(&mut self, watch: &dyn Watch) -> bool {
        self.is_over = self.is_over || watch.should_stop();
        self.left = if self.is_over { 0 } else { Self::STEPS };
        self.is_over
    }
}
