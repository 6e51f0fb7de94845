//! Prints a progress line at intervals if no progress bar can be shown: the current step, its progress and
//! the time taken.
//!
//! **Invariant:** a separate thread prints the lines, so they appear however long one step takes.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Interval between lines.
pub const NOW_AND_THEN: Duration = Duration::from_secs(10);

/// Reports progress until it is dropped.
pub struct Life {
    shared: Arc<Shared>,
    teller: Option<JoinHandle<()>>,
}

struct Shared {
    now: Mutex<Now>,
    ended: Condvar,
}

/// The current step.
struct Now {
    name: &'static str,
    began: Instant,
    /// Completed and total amount of work.
    done: Option<(usize, usize)>,
    ended: bool,
}

impl Life {
    /// Reports on work with this name by calling `say` after each `pause`.
    pub fn begin(name: &'static str, pause: Duration, say: impl Fn(&str) + Send + 'static) -> Self {
        let now = Now { name, began: Instant::now(), done: None, ended: false };
        let shared = Arc::new(Shared { now: Mutex::new(now), ended: Condvar::new() });
        let told = shared.clone();
        let tell = move || {
            let mut now = told.now();
            while !now.ended {
                let asleep = told.ended.wait_timeout(now, pause);
                now = asleep.unwrap_or_else(PoisonError::into_inner).0;
                if !now.ended {
                    say(&now.line());
                }
            }
        };
        // If the thread cannot be started, no lines are printed, but the work goes on.
        let teller = thread::Builder::new().spawn(tell).ok();
        Self { shared, teller }
    }

    /// Starts the next step.
    pub fn next(&self, name: &'static str) {
        let mut now = self.shared.now();
        (now.name, now.began, now.done) = (name, Instant::now(), None);
    }

    pub fn progress(&self, done: usize, total: usize) {
        self.shared.now().done = Some((done, total));
    }
}

impl Drop for Life {
    fn drop(&mut self) {
        self.shared.now().ended = true;
        self.shared.ended.notify_all();
        // One that panicked has nothing left to say.
        self.teller.take().map(JoinHandle::join);
    }
}

impl Shared {
    fn now(&self) -> MutexGuard<'_, Now> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Now {
    fn line(&self) -> String {
        let passed = duration(self.began.elapsed().as_secs_f64());
        let done = match self.done {
            Some((done, total)) => format!("{} % after ", 100 * done / total.max(1)),
            None => "for ".to_owned(),
        };
        format!("note: {}: {done}{passed}\n", self.name)
    }
}

/// Formats a duration at forecast precision: `8 s`, `3 min`.
pub fn duration(seconds: f64) -> String {
    match seconds {
        5400.0.. => format!("{:.1} h", seconds / 3600.0),
        90.0.. => format!("{:.0} min", seconds / 60.0),
        10.0.. => format!("{seconds:.0} s"),
        _ => format!("{seconds:.1} s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;

    #[test]
    fn work_that_says_nothing_itself_is_told_now_and_then_until_it_ends() {
        let (say, heard) = channel();
        let life = Life::begin("reading", Duration::from_millis(1), move |line| {
            let _ = say.send(line.to_owned());
        });
        let long = Duration::from_secs(60);
        assert_eq!(heard.recv_timeout(long).expect("a line"), "note: reading: for 0.0 s\n");
        life.next("tracing");
        life.progress(3, 4);
        let told = "note: tracing: 75 % after 0.0 s\n";
        assert!((0..1000).any(|_| heard.recv_timeout(long).expect("a line") == told));
        drop(life);
        // The teller has gone, and its end of the channel with it.
        assert!(heard.iter().count() < 1000);
    }

    #[test]
    fn short_work_ends_without_a_line_and_at_once() {
        let began = Instant::now();
        drop(Life::begin("short", Duration::from_secs(600), |_| panic!("nothing is said")));
        assert!(began.elapsed() < Duration::from_secs(60));
    }
}
