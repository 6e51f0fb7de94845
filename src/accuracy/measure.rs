//! How long pictures take: interleaved runs, timed apart from what surrounds them.
//!
//! **Invariant:** the k-th run of one picture is made between the k-th runs of the others, so that
//! whatever else the machine does meets all of them alike.

use std::sync::Mutex;

use super::reference::Studio;
use crate::plan::Plan;
use crate::trace::Watch;

/// Seconds, from wherever they are counted.
pub trait Clock: Sync {
    fn wall(&self) -> f64;
    /// Of all threads of the process together.
    fn cpu(&self) -> f64;
}

/// Seconds of tracing alone: the tree of boxes is built before.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Times {
    pub cpu: Vec<f64>,
    pub wall: Vec<f64>,
}

/// The least and the middle one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Span {
    pub min: f64,
    pub median: f64,
}

impl Span {
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

impl Times {
    /// What runs of the same thing differ by: two that are closer cannot be told apart. From fewer
    /// than three runs nobody can know, and a third of the time is taken.
    pub fn spread(&self) -> f64 {
        let Span { min, median } = Span::of(&self.cpu);
        if self.cpu.len() < 3 { min / 3.0 } else { median - min }
    }
}

/// Watches one picture: notes when tracing begins, and passes on only the wish to stop.
pub struct Timer<'a> {
    clock: &'a dyn Clock,
    watch: &'a dyn Watch,
    began: Mutex<Option<(f64, f64)>>,
}

impl<'a> Timer<'a> {
    pub fn new(clock: &'a dyn Clock, watch: &'a dyn Watch) -> Self {
        Self { clock, watch, began: Mutex::new(None) }
    }

    /// CPU and wall-clock seconds since tracing began.
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

    fn progress(&self, _: usize, _: usize) {}

    fn should_stop(&self) -> bool {
        self.watch.should_stop()
    }
}

/// One run of each plan, in turn; every second round backwards. `None` when stopped.
pub fn round(
    studio: &Studio,
    plans: &[Plan],
    clock: &dyn Clock,
    watch: &dyn Watch,
    times: &mut [Times],
) -> Option<()> {
    let backwards = times.first().is_some_and(|times| times.cpu.len() % 2 == 1);
    for turn in 0..plans.len() {
        let i = if backwards { plans.len() - 1 - turn } else { turn };
        let timer = Timer::new(clock, watch);
        let traced = studio.picture(&plans[i], &timer);
        let (cpu, wall) = timer.read();
        if !traced.complete {
            return None;
        }
        times[i].cpu.push(cpu);
        times[i].wall.push(wall);
    }
    Some(())
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
    fn a_spread_is_not_believed_before_the_third_run() {
        let spread = |cpu: &[f64]| Times { cpu: cpu.to_vec(), wall: Vec::new() }.spread();
        assert_eq!(spread(&[3.0, 3.0]), 1.0);
        assert_eq!(spread(&[3.0, 3.5, 9.0]), 0.5);
    }
}
