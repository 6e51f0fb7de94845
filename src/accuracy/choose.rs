//! Chooses the settings to render with: the cheapest that keep a promise, or the best affordable ones.
//!
//! **In:** tuning pixels and their reference. **Out:** a [`Choice`]. **Invariant:** costs are ray counts
//! times unit costs, so the choice is reproducible, unless a time limit is set for choosing.

use std::collections::BTreeMap;

use super::knob::{Knob, cost};
use super::reference::{Reference, Studio};
use super::statistics::{Estimate, Metric};
use crate::plan::{Antialias, PlanOptions, Samples, plan};
use crate::trace::{Counters, Sampling, Watch};
use crate::world::Origins;

/// Settings and their results on the tuning pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    pub options: PlanOptions,
    /// In camera rays per pixel.
    pub cost: f64,
    pub error: Estimate,
}

/// Pixels with a known reference, on which settings are tried.
pub struct Tuning<'a> {
    pub studio: Studio<'a>,
    pub origins: &'a Origins,
    pub list: &'a [(u32, u32)],
    pub reference: &'a Reference,
    pub metric: Metric,
    /// Knobs that affect the scene.
    pub knobs: &'a [&'a Knob],
    /// The scene's own settings.
    pub own: PlanOptions,
    tried: BTreeMap<Vec<usize>, Choice>,
    settings: Vec<Vec<f64>>,
    /// Receives the progress of changing a knob.
    pub watch: Option<&'a dyn Watch>,
    /// Called before a knob is changed, with its name and the maximum number of samples per pixel that this
    /// takes.
    pub tell: Option<&'a dyn Fn(&'static str, f64)>,
}

/// Fraction of the predicted work that a setting is assumed to take at least.
const PREDICTED: f64 = 0.9;

impl<'a> Tuning<'a> {
    pub fn new(
        studio: Studio<'a>,
        origins: &'a Origins,
        (list, reference): (&'a [(u32, u32)], &'a Reference),
        metric: Metric,
        knobs: &'a [&'a Knob],
        own: PlanOptions,
    ) -> Self {
        let settings = knobs.iter().map(|knob| knob.with((knob.get)(&own))).collect();
        Self {
            studio,
            origins,
            list,
            reference,
            metric,
            knobs,
            own,
            tried: BTreeMap::new(),
            settings,
            watch: None,
            tell: None,
        }
    }

    /// Excludes depths greater than `most`, except the scene's own: a reference of that depth cannot
    /// measure the error of deeper settings.
    pub fn no_deeper_than(&mut self, most: u32) {
        for (knob, settings) in self.knobs.iter().zip(&mut self.settings) {
            let own = self.own;
            settings.retain(|&setting| {
                let mut turned = own;
                (knob.set)(&mut turned, setting);
                turned == own || turned.depth.is_none_or(|depth| depth <= most)
            });
        }
    }

    /// Returns the colors of the tuning pixels.
    fn colors(&self, options: &PlanOptions) -> Option<(Vec<[f64; 3]>, Counters)> {
        let plan = plan(self.studio.world, self.origins, options);
        self.studio.colors(&plan, self.list, Sampling::Planned)
    }

    /// Evaluates settings, one per knob, on the tuning pixels. `None` if stopped or unavailable.
    fn try_out(&mut self, places: &[usize]) -> Option<Choice> {
        if let Some(known) = self.tried.get(places) {
            return Some(known.clone());
        }
        let options = self.options(places);
        let (colors, counters) = self.colors(&options)?;
        let all = self.own.frame.region.pixels();
        let error = self.metric.estimate(&self.reference.deviations(&colors), all);
        let factors = self.knobs.iter().map(|knob| (knob.factor)((knob.get)(&options)));
        let cost = factors.product::<f64>() * cost(&counters) / self.list.len() as f64;
        let choice = Choice { options, cost, error };
        self.tried.insert(places.to_vec(), choice.clone());
        Some(choice)
    }

    fn options(&self, places: &[usize]) -> PlanOptions {
        let mut options = self.own;
        for ((knob, settings), &place) in self.knobs.iter().zip(&self.settings).zip(places) {
            (knob.set)(&mut options, settings[place]);
        }
        options
    }

    fn last_places(&self) -> Vec<usize> {
        self.settings.iter().map(|all| all.len() - 1).collect()
    }

    /// Evaluates every knob at its most expensive setting. `None` if stopped.
    pub fn dearest(&mut self) -> Option<Choice> {
        self.try_out(&self.last_places())
    }

    pub fn is_dearest(&self, options: &PlanOptions) -> bool {
        self.options(&self.last_places()) == *options
    }

    /// Returns the cheapest settings whose error satisfies `keeps`, or the most expensive if none does.
    /// Lowers one knob after the other; the rest are at their most expensive or as settled before.
    pub fn cheapest(&mut self, keeps: &dyn Fn(&Estimate) -> bool) -> Option<Choice> {
        let mut places = self.last_places();
        let mut best: Option<Choice> = None;
        for turned in 0..places.len() {
            if turned > 0 && best.is_none() {
                break;
            }
            let settings = self.settings[turned].clone();
            let samples: Vec<f64> = (0..settings.len())
                .map(|place| {
                    let mut trial = places.clone();
                    trial[turned] = place;
                    self.most_samples(&self.options(&trial))
                })
                .collect();
            let all = samples.iter().sum::<f64>();
            self.tell.iter().for_each(|tell| tell(self.knobs[turned].name, all));
            // What a frame costs here of nothing but what it sends at least.
            let mut unit = 1.0f64;
            for (place, &setting) in settings.iter().enumerate() {
                let done = samples[..place].iter().sum::<f64>();
                self.watch.iter().for_each(|watch| watch.progress(done as usize, all as usize));
                let least = (self.knobs[turned].least)(setting);
                if best.as_ref().is_some_and(|best| least * unit >= best.cost) {
                    continue;
                }
                let mut trial = places.clone();
                trial[turned] = place;
                let choice = self.try_out(&trial)?;
                if least > 1.0 || place == 0 {
                    unit = unit.max(PREDICTED * choice.cost / least);
                }
                // Of equals the first, so that nothing is set deeper than it is looked at.
                let cheaper = best.as_ref().is_none_or(|best| {
                    choice.cost < best.cost || (choice.cost == best.cost && place < places[turned])
                });
                if keeps(&choice.error) && cheaper {
                    places = trial;
                    best = Some(choice);
                }
            }
        }
        match best {
            Some(best) => Some(best),
            None => self.dearest(),
        }
    }

    /// Maximum number of samples with which a pixel is tried. If neighbours decide, theirs are included.
    fn most_samples(&self, options: &PlanOptions) -> f64 {
        let samples = |grid: u32| f64::from(grid) * f64::from(grid);
        if let Some(focus) = &self.studio.world.camera.focus {
            return f64::from(match options.blur_samples {
                Samples::Scene => focus.most,
                Samples::Fixed(most) | Samples::Adaptive { most, .. } => most,
            });
        }
        match options.antialias {
            Antialias::Off => 1.0,
            Antialias::Grid(grid) => samples(grid),
            Antialias::Adaptive { grid, .. } => 25.0 + samples(grid),
        }
    }
}
