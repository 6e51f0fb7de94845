//! What stops a run before its end: Ctrl-C, or a limit on its time or its memory.
//!
//! **Invariant:** a trace that is stopped ends by itself, and what is done of it is kept. Before tracing, a loop of the
//! scene is stopped; other work ends with the program.

use std::fmt;
use std::process;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use lucarne::evaluate::Interrupt;
use memory_stats::memory_stats;

use super::exit::{Exit, Failure};
use super::messages;

/// Whether tracing has started.
static TRACING: AtomicBool = AtomicBool::new(false);
/// Whether the run is to stop.
static STOP: AtomicBool = AtomicBool::new(false);
static CAUSE: OnceLock<Cause> = OnceLock::new();

/// Time granted to a loop of the scene to notice the stop and to print the message that names it.
const GRACE: Duration = Duration::from_secs(1);
/// Time between two looks at the memory.
const PAUSE: Duration = Duration::from_millis(5);
/// While a run that takes too much memory stops, it may take up to one part in so many more.
const SLACK: u64 = 8;

/// Why a run stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cause {
    /// Ctrl-C, or a signal that ends programs.
    Interrupt,
    /// The limit in seconds.
    Time(f64),
    /// The limit in bytes.
    Memory(u64),
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Interrupt => write!(f, "interrupted"),
            Self::Time(seconds) => {
                // 700 thousandths are a little more than 0.7.
                let seconds = (seconds * 1e6).round() / 1e6;
                write!(f, "the limit of {seconds} s (`--time`) is over")
            }
            Self::Memory(bytes) => {
                write!(f, "more memory is used than {} MiB (`--memory`)", bytes >> 20)
            }
        }
    }
}

/// Installs the Ctrl-C handler. While tracing, the first Ctrl-C stops the trace and the second ends the
/// program. Before tracing, the first one stops a running loop of the scene, or else ends the program with
/// the message `before_tracing` and this exit code.
pub fn hear_interrupts(before_tracing: &'static str, code: i32) {
    // If this fails, Ctrl-C ends the program at once, which is acceptable.
    let _ = ctrlc::set_handler(move || {
        let again = stop(Cause::Interrupt);
        if !again && !TRACING.load(Ordering::SeqCst) {
            thread::sleep(GRACE);
        }
        if again || !TRACING.load(Ordering::SeqCst) {
            messages::eprint(if again { "\n" } else { before_tracing });
            process::exit(code);
        }
    });
}

/// Stops the run once it takes longer than `time`, in seconds from now, or more than `memory` bytes.
///
/// # Errors
///
/// If the system does not tell how much memory is used, or starts no thread that watches.
pub fn limit(time: Option<f64>, memory: Option<u64>) -> Result<(), Failure> {
    if memory.is_some() && memory_stats().is_none() {
        return Err(Failure::usage(
            "`--memory`: this system does not tell how much memory is used",
        ));
    }
    if time.is_none() && memory.is_none() {
        return Ok(());
    }
    let began = Instant::now();
    let watched = thread::Builder::new().spawn(move || {
        loop {
            let passed = began.elapsed().as_secs_f64();
            match (time, memory) {
                (Some(limit), _) if passed >= limit => return end(Cause::Time(limit), memory),
                (_, Some(limit)) if used() > limit => return end(Cause::Memory(limit), memory),
                (Some(limit), None) => thread::sleep(Duration::from_secs_f64(limit - passed)),
                _ => thread::sleep(PAUSE),
            }
        }
    });
    let failed = |_| Failure::limit("the limits cannot be watched: no thread can be started");
    watched.map(drop).map_err(failed)
}

/// Stops the run, and ends the program if it reads on, or takes much more memory.
fn end(cause: Cause, memory: Option<u64>) {
    stop(cause);
    let stopped = Instant::now();
    let most = memory.map_or(u64::MAX, |limit| limit.saturating_add(limit / SLACK));
    loop {
        let is_reading = !TRACING.load(Ordering::SeqCst);
        let cause = match used() > most {
            true => memory.map_or(cause, Cause::Memory),
            false if is_reading && stopped.elapsed() > GRACE => cause,
            false => {
                thread::sleep(PAUSE);
                continue;
            }
        };
        let what = if is_reading { "the scene was being read" } else { "nothing more is written" };
        messages::eprint(&format!("error: {cause}: {what}\n"));
        process::exit(Exit::Limit as i32);
    }
}

/// Returns how much memory the program takes now, in bytes; 0 if that is unknown.
fn used() -> u64 {
    memory_stats().map_or(0, |used| used.physical_mem as u64)
}

/// Stops the run; returns whether it was stopped before. The first cause counts.
fn stop(cause: Cause) -> bool {
    let _ = CAUSE.set(cause);
    STOP.swap(true, Ordering::SeqCst)
}

/// Returns why the run stops, if it does.
pub fn cause() -> Option<Cause> {
    CAUSE.get().copied()
}

/// Returns the flag that a stop sets.
pub fn interrupt() -> Interrupt {
    Interrupt(Some(&STOP))
}

/// Whether the run is to stop.
pub fn is_set() -> bool {
    STOP.load(Ordering::Relaxed)
}

/// From now on, a stop ends the trace.
pub fn begin_tracing() {
    TRACING.store(true, Ordering::SeqCst);
}
