//! Shows a progress bar while tracing.
//!
//! **Invariant:** the bar is drawn on standard error, and only if that is a terminal; otherwise a line is
//! printed at intervals. The display never stalls.

use std::io::IsTerminal;
use std::sync::OnceLock;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use lucarne::trace::Watch;

use super::heartbeat::{Life, NOW_AND_THEN};
use super::messages;
use super::stats::cpu_seconds;
use super::stop;

/// Interval between updates of the display.
const TICK: Duration = Duration::from_millis(200);
/// Reports progress of work that has no bar, if standard error is not a terminal.
pub fn life(name: &'static str) -> Option<Life> {
    let say = |line: &str| messages::eprint(line);
    (!std::io::stderr().is_terminal()).then(|| Life::begin(name, NOW_AND_THEN, say))
}

/// Progress display of one trace.
pub struct Progress {
    bar: ProgressBar,
    life: Option<Life>,
    started: f64,
    built: OnceLock<f64>,
}

impl Progress {
    /// Starts the display with `name` as the current step. From now on, Ctrl-C and limits stop the trace.
    pub fn start(name: &'static str) -> Self {
        let bar = match std::io::stderr().is_terminal() {
            true => ProgressBar::new(1),
            false => ProgressBar::hidden(),
        };
        let template = "{spinner} {bar:40} {percent:>3} %  {elapsed} (about {eta} left)";
        bar.set_style(
            ProgressStyle::with_template(template)
                .unwrap_or_else(|_| ProgressStyle::default_bar())
                .progress_chars("━━ "),
        );
        // Updates the elapsed time even while one step takes long.
        bar.enable_steady_tick(TICK);
        stop::begin_tracing();
        Self { bar, life: life(name), started: cpu_seconds(), built: OnceLock::new() }
    }

    /// Returns the CPU seconds from the start until the bounding volume hierarchy was built.
    pub fn build_cpu_seconds(&self) -> f64 {
        self.built.get().map_or(0.0, |built| built - self.started)
    }

    /// Whether the trace is to stop.
    pub fn is_stopped(&self) -> bool {
        stop::is_set()
    }

    /// Starts the next step.
    pub fn next(&self, name: &'static str) {
        self.life.iter().for_each(|life| life.next(name));
    }

    /// Prints a line while the bar is shown.
    pub fn say(&self, text: &str) {
        self.bar.suspend(|| messages::eprint(text));
    }

    pub fn end(&self) {
        self.bar.finish_and_clear();
    }
}

impl Watch for Progress {
    fn progress(&self, done: usize, total: usize) {
        self.bar.set_length(total as u64);
        self.bar.set_position(done as u64);
        self.life.iter().for_each(|life| life.progress(done, total));
    }

    fn built(&self) {
        self.built.get_or_init(cpu_seconds);
    }

    fn should_stop(&self) -> bool {
        stop::is_set()
    }
}
