//! Renders a picture with each setting, and a reference to compare them with, within a time limit.
//!
//! **In:** plans, pixels to audit, a deadline. **Out:** a [`Trial`]. **Invariant:** the deadline is kept.
//! What does not fit is left out: first expensive settings, of whichever knob, then audited pixels, then
//! samples and depth of the reference. No picture is rendered twice before each that fits was rendered
//! once. Runs are interleaved: the k-th run of one picture is made between the k-th runs of the others, so
//! that other load on the machine affects all of them alike.

use super::affordable_reference::{self, Affordable, Deadline, Depths};
use super::equal_settings::{Alike, alike};
use super::forecast::{Forecast, at_once, forecast};
use super::measure::{Clock, Span, Timer, Times};
use super::reference::{Reference, Studio, colors_of};
use super::statistics::{Deviation, Metric};
use super::{Options, Unmeasured};
use crate::plan::{Arithmetic, Plan};
use crate::trace::{Counters, Watch};

/// Fractions of the remaining time, in order: for the scene's own picture, the coarsest reference, a
/// forecast, finding settings that need not be tried, one picture of each other setting, a finer reference,
/// and one picture of each setting not yet tried.
const FOR_OWN: f64 = 0.7;
const FOR_REFERENCE: f64 = 0.3;
const FOR_FORECAST: f64 = 0.05;
const FOR_ALIKE: f64 = 0.1;
const FOR_PICTURES: f64 = 0.4;
const FOR_FINER: f64 = 0.6;
const FOR_THE_REST: f64 = 0.4;
/// Fractions of the total time: for checking whether the scene's own picture fits, for the intervals of all
/// settings, and for the verdicts and the report.
const FOR_A_LOOK: f64 = 0.05;
const FOR_STATISTICS: f64 = 0.1;
const FOR_THE_REPORT: f64 = 0.02;
/// Limits for one picture: this many times its forecast, or this fraction of the remaining time for
/// pictures.
const AS_FORECAST: f64 = 2.0;
const FOR_ONE: f64 = 0.5;
/// Number of runs that as many pictures as possible should have, cheap ones first, so that the median and
/// the minimum distinguish similar settings; and the maximum for all, if time permits.
const ENOUGH_RUNS: usize = 5;
const MOST_RUNS: usize = 9;

/// The scene's own picture is not tried if the first estimate exceeds the limit by this factor.
const SURELY: f64 = 1.5;
/// Multiple of the time needed for the scene's own picture that leaves room for others.
const ROOM: f64 = 2.0;

/// Fraction of the time for more runs to plan with; the rest covers errors of the prediction.
const PREDICTED: f64 = 0.8;

/// A setting to try.
pub struct Candidate {
    pub name: String,
    pub plan: Plan,
    /// Minimum cost in camera rays per pixel.
    pub least: f64,
    /// Factor by which its settings change the cost of every ray.
    pub factor: f64,
}

/// Picture rendered with one setting.
pub struct Picture {
    /// Index of the candidate.
    pub candidate: usize,
    pub times: Times,
    pub counters: Counters,
    /// Colors of the audited pixels, clamped.
    pub colors: Vec<[f64; 3]>,
}

pub struct Trial {
    pub reference: Reference,
    /// Depth of the reference.
    pub depth: u32,
    /// In the order of the candidates; the first picture is that of the first candidate.
    pub pictures: Vec<Picture>,
    /// Candidates that needed no picture of their own.
    pub alike: Alike,
}

/// Resources for a trial.
pub struct Bench<'a> {
    pub studio: Studio<'a>,
    pub depths: Depths<'a>,
    pub options: &'a Options<'a>,
    pub clock: &'a dyn Clock,
    /// Deadline in clock time.
    pub until: f64,
}

impl Bench<'_> {
    /// Returns the time at which the fraction `part` of the time remaining before `until` is over.
    fn after(&self, part: f64, until: f64) -> f64 {
        let now = self.clock.wall();
        now + part * (until - now).max(0.0)
    }

    /// Makes one timed run of a candidate. `None` if it takes longer than allowed.
    fn picture(
        &self,
        (number, candidate): (usize, &Candidate),
        list: &[(u32, u32)],
        until: f64,
    ) -> Option<Picture> {
        let in_time = Deadline { clock: self.clock, until, watch: self.studio.watch };
        let timer = Timer::new(self.clock, &in_time);
        let traced = self.studio.picture(&candidate.plan, &timer);
        let (cpu, wall) = timer.read();
        traced.complete.then(|| Picture {
            candidate: number,
            times: Times { cpu: vec![cpu], wall: vec![wall] },
            counters: traced.counters,
            colors: colors_of(&traced.film, list),
        })
    }

    /// Tries the candidates, the first of which has the scene's own settings. `knobs` lists the candidates
    /// of each knob from coarse to fine.
    pub fn run(
        &self,
        candidates: &[Candidate],
        knobs: &[Vec<usize>],
        list: &[(u32, u32)],
    ) -> Result<Trial, Unmeasured> {
        let Options { metric, seed, .. } = *self.options;
        let began = self.clock.wall();
        let (until, look_until) = (self.until, self.after(FOR_A_LOOK, self.until));
        let own = at_once(&self.studio, &candidates[0], list, (self.clock, look_until));
        let stopped = || match self.studio.watch.should_stop() {
            true => Unmeasured::Stopped,
            false => {
                let own = own.max(self.clock.wall() - began);
                Unmeasured::TooShort { own, enough: ROOM * own / FOR_OWN }
            }
        };
        if own > SURELY * FOR_OWN * (until - self.clock.wall()) {
            return Err(stopped());
        }

        // Computing the intervals takes time, too; less for fewer pixels.
        let all_rows = candidates.len() as f64 * statistics_take(self.clock, metric);
        let whole = self.until - self.clock.wall();
        let most = (FOR_STATISTICS * whole / all_rows) as usize;
        let list = &list[..list.len().min(most.max(affordable_reference::LEAST))];
        let until = until - all_rows * list.len() as f64 - FOR_THE_REPORT * whole;

        let own = self.picture((0, &candidates[0]), list, self.after(FOR_OWN, until));
        let own = own.ok_or_else(stopped)?;
        let known = affordable_reference::reference(
            &self.studio,
            &self.depths,
            list,
            seed,
            (self.clock, self.after(FOR_REFERENCE, until)),
        );
        let Affordable { mut reference, plan: deep, a_sample } = known.ok_or_else(stopped)?;
        let list = &list[..reference.pixels()];

        let mut pictures = vec![own];
        pictures[0].colors.truncate(list.len());
        let mut forecast =
            forecast(&self.studio, candidates, list, (self.clock, self.after(FOR_FORECAST, until)));
        let alike_until = self.after(FOR_ALIKE, until);
        let is_exact = reference.has(&pictures[0].colors);
        let time = (self.clock, alike_until);
        let alike = alike(&self.studio, candidates, knobs, &forecast, list, is_exact, time);
        let timed: Vec<usize> = (0..candidates.len()).filter(|&c| alike.is_timed(c)).collect();
        let first_until = self.after(FOR_PICTURES, until);
        self.others((candidates, &timed), &mut forecast, &deep, list, first_until, &mut pictures)?;

        // Refines the reference as far as needed, or as time permits.
        let finer_until = self.after(FOR_FINER, until);
        let in_time = Deadline { clock: self.clock, until: finer_until, watch: self.studio.watch };
        let finer = Studio { watch: &in_time, ..self.studio };
        loop {
            let errors = pictures.iter().map(|p| metric.of(&reference.deviations(&p.colors)));
            let resolved = errors.filter(|&error| error > 0.0).fold(f64::INFINITY, f64::min);
            let enough = 4.0 * reference.floor(metric) <= resolved;
            let samples = f64::from(reference.samples()) * list.len() as f64;
            let fits = self.clock.wall() + 2.0 * a_sample * samples <= finer_until;
            if enough || !fits || reference.double(&finer, &deep, list) != Some(true) {
                break;
            }
        }
        let rest_until = self.after(FOR_THE_REST, until);
        self.others((candidates, &timed), &mut forecast, &deep, list, rest_until, &mut pictures)?;
        self.more_runs(candidates, until, &mut pictures)?;
        Ok(Trial { reference, depth: deep.max_trace_level, pictures, alike })
    }

    /// Makes more runs of the pictures while time remains. Pictures that are the same work share their
    /// runs.
    fn more_runs(
        &self,
        candidates: &[Candidate],
        until: f64,
        pictures: &mut [Picture],
    ) -> Result<(), Unmeasured> {
        let work = |p: &Picture| (p.counters, candidates[p.candidate].plan.arithmetic());
        let mut runners: Vec<Runner> = Vec::new();
        let mut runner_of = Vec::new();
        for picture in pictures.iter() {
            let same = runners.iter().position(|runner| runner.work == work(picture));
            let number = same.unwrap_or(runners.len());
            if same.is_none() {
                let plan = &candidates[picture.candidate].plan;
                runners.push(Runner { work: work(picture), plan, times: Times::default() });
            }
            runners[number].times.cpu.extend(&picture.times.cpu);
            runners[number].times.wall.extend(&picture.times.wall);
            runner_of.push(number);
        }
        let in_time = Deadline { clock: self.clock, until, watch: self.studio.watch };
        let mut backwards = true;
        for enough in std::iter::once(ENOUGH_RUNS).chain(2..=MOST_RUNS) {
            let fit = affordable(&runners, enough, until - self.clock.wall());
            loop {
                let lacks = |&number: &usize| runners[number].runs() < enough;
                let mut round: Vec<usize> = fit.iter().copied().filter(lacks).collect();
                if round.is_empty() {
                    break;
                }
                if backwards {
                    round.reverse();
                }
                backwards = !backwards;
                for number in round {
                    if !runners[number].run(&self.studio, self.clock, &in_time) {
                        break;
                    }
                }
                if in_time.should_stop() {
                    break;
                }
            }
        }
        for (picture, number) in pictures.iter_mut().zip(runner_of) {
            picture.times = runners[number].times.clone();
        }
        match self.studio.watch.should_stop() {
            true => Err(Unmeasured::Stopped),
            false => Ok(()),
        }
    }

    /// Renders one picture for each candidate in `timed` that is not yet tried, those with the lowest
    /// forecast first, of whichever knob, until one does not fit. Skips settings deeper than both the
    /// reference and the scene's own.
    fn others(
        &self,
        (candidates, timed): (&[Candidate], &[usize]),
        forecast: &mut Forecast,
        deep: &Plan,
        list: &[(u32, u32)],
        until: f64,
        pictures: &mut Vec<Picture>,
    ) -> Result<(), Unmeasured> {
        let untried = |number: &usize| pictures.iter().all(|picture| picture.candidate != *number);
        let depth = |number: usize| candidates[number].plan.max_trace_level;
        let own = pictures.first().map_or(0, |own| depth(own.candidate));
        let shallow = |number: &usize| depth(*number) <= deep.max_trace_level.max(own);
        let mut order: Vec<usize> = timed.iter().copied().filter(untried).filter(shallow).collect();
        order.sort_by(|&a, &b| forecast.compare(candidates, a, b));
        for number in order {
            let seconds = forecast.seconds(number, pictures);
            let now = self.clock.wall();
            if now + seconds > until && seconds.is_finite() {
                break;
            }
            let end = self.after(FOR_ONE, until);
            let end = if seconds.is_finite() { end.max(now + AS_FORECAST * seconds) } else { end };
            match self.picture((number, &candidates[number]), list, end.min(until)) {
                Some(picture) => pictures.push(picture),
                None if self.studio.watch.should_stop() => return Err(Unmeasured::Stopped),
                None => {
                    forecast.is_at_least(number, self.clock.wall() - now, pictures);
                    break;
                }
            }
        }
        pictures.sort_by_key(|picture| picture.candidate);
        Ok(())
    }
}

/// A picture to run again, on behalf of all that do the same work.
struct Runner<'a> {
    work: (Counters, Arithmetic),
    plan: &'a Plan,
    times: Times,
}

impl Runner<'_> {
    fn runs(&self) -> usize {
        self.times.wall.len()
    }

    /// Returns false if stopped; the run then does not count.
    fn run(&mut self, studio: &Studio, clock: &dyn Clock, watch: &dyn Watch) -> bool {
        let timer = Timer::new(clock, watch);
        let complete = studio.picture(self.plan, &timer).complete;
        if complete {
            let (cpu, wall) = timer.read();
            self.times.cpu.push(cpu);
            self.times.wall.push(wall);
        }
        complete
    }
}

/// Returns as many as possible, cheap ones first, that can have `enough` runs in `time`; in their original
/// order.
fn affordable(runners: &[Runner], enough: usize, time: f64) -> Vec<usize> {
    let takes = |number: usize| Span::of(&runners[number].times.wall).median;
    let mut order: Vec<usize> = (0..runners.len()).collect();
    order.sort_by(|&a, &b| takes(a).total_cmp(&takes(b)));
    let mut left = PREDICTED * time;
    order.retain(|&number| {
        left -= enough.saturating_sub(runners[number].runs()) as f64 * takes(number);
        left >= 0.0
    });
    order.sort_unstable();
    order
}

/// Returns the seconds per audited pixel that the intervals of one row take.
fn statistics_take(clock: &dyn Clock, metric: Metric) -> f64 {
    let some: Vec<Deviation> = (0..SOME)
        .map(|i| Deviation { off: [f64::from(i * 37 % SOME); 3], noise: [0.0; 3] })
        .collect();
    let began = clock.wall();
    let bounds = Metric::ALL.map(|metric| metric.estimate(&some, f64::INFINITY));
    let resamples = metric.resampled(&some);
    std::hint::black_box((bounds, resamples));
    (clock.wall() - began) / f64::from(SOME)
}

const SOME: u32 = 256;
