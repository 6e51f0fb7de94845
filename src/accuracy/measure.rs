//! Measures how long pictures take; tracing is timed separately from setup.

use std::sync::Mutex;

use crate::trace::Watch;

/// Clocks, in seconds from an arbitrary origin.
pub trait Clock: Sync {
    /// Time of day.
    fn wall(&self) -> f64;
    /// CPU time of all threads of the process.
    fn cpu(&self) -> f64;
}

/// A clock of one kind, for a program with one thread: wall-clock time counts as CPU time.
impl<F: Fn() -> f64 + Sync> Clock for F {
    fn wall(&self) -> f64 {
        self()
    }

    fn cpu(&self) -> f64 {
        self()
    }
}

/// Seconds for tracing alone; the bounding volume hierarchy is built before.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Times {
    /// CPU time of each run.
    pub cpu: Vec<f64>,
    /// Wall-clock time of each run.
    pub wall: Vec<f64>,
}

/// Minimum number of runs from which a spread can be computed.
const TELL: usize = 3;

impl Times {
    /// Returns the spread of the runs: the difference of the longest and the shortest, relative to the
    /// shortest, in CPU seconds. `None` with too few runs.
    pub fn apart(&self) -> Option<f64> {
        let (least, most) = self.ends()?;
        (self.cpu.len() >= TELL && least > 0.0).then_some(most / least - 1.0)
    }

    /// Returns the shortest and the longest run, in CPU seconds.
    pub fn ends(&self) -> Option<(f64, f64)> {
        let least = self.cpu.iter().copied().reduce(f64::min)?;
        let most = self.cpu.iter().copied().reduce(f64::max)?;
        Some((least, most))
    }
}

/// Minimum and median.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Span {
    /// The least.
    pub min: f64,
    /// The middle one.
    pub median: f64,
}

impl Span {
    /// Returns those of a list; 0 for an empty one.
    pub fn of(seconds: &[f64]) -> Self {
        let mut sorted = seconds.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |place: usize| sorted.get(place).copied().unwrap_or(0.0);
        let half = sorted.len() / 2;
        let median = match sorted.len() % 2 {
            0 => (at(half.saturating_sub(1)) + at(half)) / 2.0,
            _ => at(half),
        };
        Self { min: at(0), median }
    }
}

/// Watches one picture: records when tracing begins, and forwards only stop requests.
pub struct Timer<'a> {
    clock: &'a dyn Clock,
    watch: &'a dyn Watch,
    began: Mutex<Option<(f64, f64)>>,
}

impl<'a> Timer<'a> {
    pub fn new(clock: &'a dyn Clock, watch: &'a dyn Watch) -> Self {
        Self { clock, watch, began: Mutex::new(None) }
    }

    /// Returns CPU and wall-clock seconds since tracing began.
    pub fn read(&self) -> (f64, f64) {
        let began = self.began.lock().map_or(None, |began| *began).unwrap_or_default();
        (self.clock.cpu() - began.0, self.clock.wall() - began.1)
    }
}

impl Watch for Timer<'_> {
    fn built(&self) {
        if let Ok(mut began) = self.began.lock() {
            *began = Some((self.clock.cpu(), self.clock.wall()));
        }
    }

    fn progress(&self, done: usize, total: usize) {
        self.watch.progress(done, total);
    }

    fn should_stop(&self) -> bool {
        self.watch.should_stop()
    }
}

/// Watches many pictures, and reports the fraction of the budget that is spent at each step of any of them.
pub struct Elapsing<'a> {
    pub clock: &'a dyn Clock,
    pub began: f64,
    /// In seconds.
    pub budget: f64,
    pub watch: &'a dyn Watch,
}

impl Watch for Elapsing<'_> {
    fn progress(&self, _: usize, _: usize) {
        let elapsed = self.clock.wall() - self.began;
        let thousandths = |seconds: f64| (1000.0 * seconds) as usize;
        self.watch.progress(thousandths(elapsed), thousandths(elapsed.max(self.budget)));
    }

    fn should_stop(&self) -> bool {
        self.watch.should_stop()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_is_the_least_and_the_middle_of_the_runs() {
        assert_eq!(Span::of(&[3.0, 1.0, 2.0]), Span { min: 1.0, median: 2.0 });
        assert_eq!(Span::of(&[4.0, 1.0]), Span { min: 1.0, median: 2.5 });
        assert_eq!(Span::of(&[]), Span::default());
    }

    #[test]
    fn progress_is_the_part_of_the_budget_that_is_spent_and_never_falls_back() {
        struct Seen(Mutex<Vec<(usize, usize)>>);
        impl Watch for Seen {
            fn progress(&self, done: usize, total: usize) {
                self.0.lock().expect("one thread").push((done, total));
            }
            fn should_stop(&self) -> bool {
                true
            }
        }
        struct Hand(Mutex<f64>);
        impl Clock for Hand {
            fn wall(&self) -> f64 {
                *self.0.lock().expect("one thread")
            }
            fn cpu(&self) -> f64 {
                0.0
            }
        }
        let (seen, hand) = (Seen(Mutex::new(Vec::new())), Hand(Mutex::new(0.0)));
        let whole = Elapsing { clock: &hand, began: 1.0, budget: 4.0, watch: &seen };
        let picture = Timer::new(&hand, &whole);
        for (now, done) in [(2.0, 1), (3.0, 7), (6.0, 1)] {
            *hand.0.lock().expect("one thread") = now;
            picture.progress(done, 9);
        }
        assert_eq!(*seen.0.lock().expect("one thread"), [(1000, 4000), (2000, 4000), (5000, 5000)]);
        assert!(whole.should_stop());
    }
}
