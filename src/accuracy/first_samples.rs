//! Traces the first ray of each pixel, with settings that fit the time.
//!
//! **In:** a World, and the deadline of its first pass. **Out:** a film of one ray per pixel.
//! **Invariant:** one setting for the entire picture, the scene's own if it fits. Only pixels left over
//! when a forecast turns out wrong have other settings, and they are counted.

use super::affordable_reference::{Deadline, LEAST};
use super::audit;
use super::knob::Knob;
use super::measure::Clock;
use super::reference::Studio;
use super::refine::{MOST_IN_PART, place, spread};
use super::render_settings::Easel;
use crate::film::{Channels, Film};
use crate::plan::{Antialias, Plan, PlanOptions, Samples, plan};
use crate::trace::{self, Sampling, Traced, Watch};
use crate::world::Origins;

/// Fraction of the available time that the first pass may take by prediction; the rest covers errors of the
/// prediction. On the gallery and on scenes with much glass, these were up to a fifth.
const FOR_FIRST: f64 = 0.75;
/// One pixel in this many is traced for the prediction, which takes a hundredth of the time.
const ONE_OF: u32 = 100;
/// Fraction of the allowed time; a trial that took less is accepted at once.
const SURELY: f64 = 0.5;
/// Fraction of the time for the first pass that is reserved for the cheapest settings, in case others take
/// too long after all. The cheapest are many times faster.
const FOR_REST: f64 = 0.1;
/// Number of parts into which a picture is split, or the remainder of a part that exceeded its share of the
/// time.
const PARTS: usize = 16;
/// Maximum number of shares of the time that a part may take, as parts differ; the maximum after one part
/// took longer, as others will; and the maximum fraction of the remaining time.
const UNEVEN: f64 = 4.0;
const IN_DOUBT: f64 = 0.5;
const AT_MOST: f64 = 0.8;

/// Result of the first pass.
pub struct Begun {
    pub traced: Traced,
    pub settings: PlanOptions,
    /// The cheapest settings.
    pub least: PlanOptions,
    /// Whether the settings are cheaper than the scene's own.
    pub is_less: bool,
    /// Pixels for which even those took too long; they have the cheapest settings.
    pub rest: Vec<usize>,
    /// CPU and wall-clock seconds.
    pub took: (f64, f64),
}

/// Traces one ray per pixel before the clock reaches `until`.
pub fn begin(
    studio: &Studio,
    origins: &Origins,
    easel: &Easel,
    seed: u64,
    (clock, until): (&dyn Clock, f64),
) -> Begun {
    let one = (Antialias::Off, Samples::Fixed(1));
    let own = PlanOptions { antialias: one.0, blur_samples: one.1, ..easel.own };
    let least = least(easel, own);
    let in_time = Deadline { clock, until, watch: studio.watch };
    let in_all = Studio { watch: &in_time, ..*studio };
    let settings = affordable(&in_all, origins, easel, seed, (least, own), (clock, until));
    let kept = if settings == least { 0.0 } else { FOR_REST };
    let most = until - kept * (until - clock.wall());
    let began = (clock.cpu(), clock.wall());
    let gamma = studio.world.settings.assumed_gamma;
    let mut traced = Traced::unbegun(own.frame, gamma, Channels::with(own.alpha));
    let plan = |settings| plan(studio.world, origins, settings);
    let mut rest = complete(studio, &plan(&settings), &mut traced, (clock, most));
    let took = (clock.cpu() - began.0, clock.wall() - began.1);
    if !rest.is_empty() && settings != least {
        complete(studio, &plan(&least), &mut traced, (clock, until));
        rest.retain(|&i| traced.film.pixels[i].samples() > 0);
    }
    Begun { traced, settings, least, is_less: settings != own, rest, took }
}

/// Returns the settings with each knob at its cheapest, if the scene's `own` setting is more expensive.
fn least(easel: &Easel, own: PlanOptions) -> PlanOptions {
    let mut options = own;
    for knob in turned(easel) {
        let settings = knob.with((knob.get)(&own));
        let place = |of| settings.iter().position(|&setting| setting == of);
        if place(knob.cheapest()) < place((knob.get)(&own)) {
            (knob.set)(&mut options, knob.cheapest());
        }
    }
    options
}

/// Returns the knobs that the first pass may change.
fn turned<'a>(easel: &'a Easel) -> impl Iterator<Item = &'a Knob> {
    easel.knobs.iter().copied().filter(|knob| !knob.samples_pixels())
}

/// Traces the unfinished pixels, spread over the picture, and returns those that are left when the clock
/// reaches `until`. Each part is limited to a few shares of the time. Parts that took longer are split and
/// retried with the time left by the others, so that one slow pixel does not delay the others.
fn complete(
    studio: &Studio,
    plan: &Plan,
    traced: &mut Traced,
    (clock, until): (&dyn Clock, f64),
) -> Vec<usize> {
    let film = &mut traced.film;
    let in_time = Deadline { clock, until, watch: studio.watch };
    let undone = |film: &Film| -> Vec<usize> {
        let all = spread(film.pixels.len());
        all.filter(|&i| film.pixels[i].samples() == 0).collect()
    };
    let (mut list, mut size, mut shares) = (undone(film), film.pixels.len(), UNEVEN);
    while !list.is_empty() && size > 0 {
        size = (size / PARTS).clamp(1, MOST_IN_PART);
        let mut parts = list.chunks(size);
        while let Some(part) = parts.next() {
            let now = clock.wall();
            let share = (until - now) * (shares / (parts.len() + 1) as f64).min(AT_MOST);
            let in_share = Deadline { until: now + share, ..in_time };
            let aim = |&i| (place(film.frame.region, i), Sampling::Planned);
            let aims: Vec<_> = part.iter().map(aim).collect();
            let studio = Studio { watch: &in_share, ..*studio };
            let (seen, counters) = studio.pixels(plan, &aims);
            traced.counters += counters;
            for (&i, seen) in part.iter().zip(seen) {
                match seen {
                    Some(seen) => film.pixels[i] = seen.mean.pixel(1),
                    None => shares = IN_DOUBT,
                }
            }
            if in_time.should_stop() {
                size = 1;
                break;
            }
        }
        list = undone(film);
        // There is nothing smaller than a pixel.
        size -= usize::from(size == 1);
    }
    traced.complete = list.is_empty();
    list
}

/// Returns the settings of the first pass: the scene's `own`. If a few pixels show that these do not fit,
/// each knob in turn comes as close to them as fits, with the others at their `least`.
fn affordable(
    studio: &Studio,
    origins: &Origins,
    easel: &Easel,
    seed: u64,
    (least, own): (PlanOptions, PlanOptions),
    (clock, until): (&dyn Clock, f64),
) -> PlanOptions {
    let region = own.frame.region;
    let pixels = region.width.saturating_mul(region.height);
    let few = (pixels / ONE_OF).max(LEAST as u32);
    let list = trace::aims(&audit::sets(region, few, 1, seed)[0], Sampling::Planned);
    let share = list.len() as f64 / f64::from(pixels);
    let fits = |options: &PlanOptions| {
        let plan = plan(studio.world, origins, options);
        studio.geometry(&plan);
        // Other load on the machine may slow the first trial; the second is then shorter, and the mean of
        // both is used. Twice the allowed time is too long whatever the second trial shows.
        let look = || {
            // Startup takes time, too, and must not be scaled.
            let before = clock.wall();
            studio.pixels(&plan, &list[..1]);
            let now = clock.wall();
            let allowed = (now - before) + FOR_FIRST * share * (until - now);
            let watch = &Deadline { clock, until: now + 2.0 * allowed, watch: studio.watch };
            let (seen, _) = Studio { watch, ..*studio }.pixels(&plan, &list);
            match seen.iter().all(Option::is_some) {
                true => (clock.wall() - now) / allowed,
                false => f64::INFINITY,
            }
        };
        let first = look();
        first <= SURELY || (first.is_finite() && first + look() <= 2.0)
    };
    if least == own || fits(&own) {
        return own;
    }
    let mut options = least;
    for knob in turned(easel) {
        let all = knob.with((knob.get)(&own));
        let place = |of| all.iter().position(|&setting| setting == of).unwrap_or(0);
        let (from, to) = (place((knob.get)(&options)), place((knob.get)(&own)));
        for &setting in all.iter().take(to + 1).skip(from + 1) {
            let mut dearer = options;
            (knob.set)(&mut dearer, setting);
            if !fits(&dearer) {
                break;
            }
            options = dearer;
        }
    }
    options
}
