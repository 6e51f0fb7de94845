//! Tells how many pixels are rendered, in POV-Ray's words.

use std::sync::atomic::{AtomicU64, Ordering};

use lucarne::plan::Region;
use lucarne::trace::Watch;

use super::settings::Settings;
use super::streams::Stream;
use crate::cli::stop;

/// Watches one picture.
pub struct Rendered<'a> {
    settings: &'a Settings,
    pixels: f64,
    /// The percentage that was printed last.
    shown: AtomicU64,
}

impl<'a> Rendered<'a> {
    pub fn new(settings: &'a Settings, region: Region) -> Self {
        Self { settings, pixels: region.pixels(), shown: AtomicU64::new(0) }
    }

    /// Prints a part of the picture, 0 … 1, if it is more than before.
    pub fn show(&self, done: f64) {
        let percent = (100.0 * done) as u64;
        let is_more = self.shown.fetch_max(percent, Ordering::Relaxed) < percent;
        if self.settings.verbose && is_more {
            let (done, all) = ((done * self.pixels) as u64, self.pixels as u64);
            let text = format!("Rendered {done} of {all} pixels ({percent}%)\r");
            self.settings.streams.say(Stream::Render, &text);
        }
    }
}

impl Watch for Rendered<'_> {
    fn progress(&self, done: usize, total: usize) {
        self.show(done as f64 / total.max(1) as f64);
    }

    fn should_stop(&self) -> bool {
        stop::is_set()
    }
}
