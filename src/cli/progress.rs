//! A bar while the tracer works, and Ctrl-C.
//!
//! **Invariant:** the bar stands on standard error, and only on a terminal, elsewhere a line comes now and
//! then; it never stands still.

use std::io::IsTerminal;
use std::process;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use lucarne::evaluate::Interrupt;
use lucarne::trace::Watch;

use super::exit::Exit;
use super::life::{Life, NOW_AND_THEN};
use super::messages;
use super::stats::cpu_seconds;

/// From one sign of life to the next.
const TICK: Duration = Duration::from_millis(200);
/// A trace is under way, or was.
static TRACING: AtomicBool = AtomicBool::new(false);
/// Ctrl-C was heard.
static STOP: AtomicBool = AtomicBool::new(false);

/// So long a loop of the scene may take to notice Ctrl-C, and the message that names it to be printed.
const GRACE: Duration = Duration::from_secs(1);

/// From here on the first Ctrl-C stops the trace, and the second ends the program; where nothing is
/// traced yet, the first ends the scene's loop that turns, or else the program with this sentence.
pub fn hear_interrupts(before_tracing: &'static str) {
    // Without a handler Ctrl-C ends the program at once, which is no error.
    let _ = ctrlc::set_handler(move || {
        let again = STOP.swap(true, Ordering::SeqCst);
        if !again && !TRACING.load(Ordering::SeqCst) {
            thread::sleep(GRACE);
        }
        if again || !TRACING.load(Ordering::SeqCst) {
            messages::eprint(if again { "\n" } else { before_tracing });
            process::exit(Exit::Interrupted as i32);
        }
    });
}

/// Set by Ctrl-C.
pub fn interrupt() -> Interrupt {
    Interrupt(Some(&STOP))
}

/// Tells of work that has no bar, where standard error is no terminal.
pub fn life(name: &'static str) -> Option<Life> {
    let say = |line: &str| messages::eprint(line);
    (!std::io::stderr().is_terminal()).then(|| Life::begin(name, NOW_AND_THEN, say))
}

/// Watches one trace.
pub struct Progress {
    bar: ProgressBar,
    life: Option<Life>,
    started: f64,
    built: OnceLock<f64>,
}

impl Progress {
    /// From here on Ctrl-C stops the trace; `name` is what is being done.
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
        // A piece may take long: the time goes on, and is seen to.
        bar.enable_steady_tick(TICK);
        TRACING.store(true, Ordering::SeqCst);
        Self { bar, life: life(name), started: cpu_seconds(), built: OnceLock::new() }
    }

    /// CPU seconds from the start until the tree of boxes stood.
    pub fn build_cpu_seconds(&self) -> f64 {
        self.built.get().map_or(0.0, |built| built - self.started)
    }

    /// Ctrl-C was heard.
    pub fn is_stopped(&self) -> bool {
        STOP.load(Ordering::Relaxed)
    }

    /// Something else is being done from here on.
    pub fn next(&self, name: &'static str) {
        self.life.iter().for_each(|life| life.next(name));
    }

    /// Says something while the bar stands.
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
        STOP.load(Ordering::Relaxed)
    }
}
