//! Lists the knobs: every setting that trades time for accuracy, in one table.
//!
//! **Invariant:** a knob is a field of [`PlanOptions`] and one entry of [`KNOBS`]; a knob for an effect
//! that the scene does not use is skipped. Unit costs are constants, so choices based on them are the same
//! on every machine and run.

use super::ladder::{BLURS, LADDER, LIGHTS, flag_of, place_of, places, rung, samples};
use crate::geometry::Work;
use crate::plan::{Antialias, Effect, Plan, PlanOptions, Samples};
use crate::trace::Counters;
use crate::world::World;

/// A setting of the plan, with its values from cheap to expensive.
#[derive(Debug, Clone, Copy)]
pub struct Knob {
    /// Name of the knob: `depth`.
    pub name: &'static str,
    /// What the scene must contain for the knob to have an effect.
    pub needs: Need,
    /// Message for scenes that do not contain it.
    pub idle: &'static str,
    /// Settings from coarse to fine, ascending or descending. They are also approximately in order of cost; a
    /// report orders them by measured cost.
    pub settings: &'static [f64],
    /// Where the scene's own value lies among the settings.
    pub own: Own,
    /// Setting of the reference: the finest, unless a coarser one has no error but noise, which the reference's many
    /// samples of a pixel average.
    pub reference: Option<f64>,
    /// Sets it in the options of a plan.
    pub set: fn(&mut PlanOptions, f64),
    /// Reads it from the options of a plan.
    pub get: fn(&PlanOptions) -> f64,
    /// Minimum cost of a setting, in camera rays per pixel.
    pub least: fn(f64) -> f64,
    /// Factor by which a setting changes the cost of every ray.
    pub factor: fn(f64) -> f64,
    /// Name of a setting in a report: `4×4`.
    pub label: fn(f64) -> String,
    /// Flag of `render` that selects the setting.
    pub flag: fn(f64) -> String,
}

/// Position of the scene's own value among the settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Own {
    /// It is one of the settings.
    Among,
    /// It may lie between two settings.
    Between,
    /// It is the finest, whatever the settings: no finer one changes anything.
    Last,
}

/// What a scene must contain.
#[derive(Debug, Clone, Copy)]
pub enum Need {
    /// Anything that is not a single uniform color, seen by a camera that does not blur it.
    Edges,
    /// One of these effects.
    Effect(&'static [Effect]),
    /// A solid whose intersections are found iteratively.
    IteratedRoots,
    /// A fractal with several iterations.
    Fractals,
}

impl Need {
    /// Whether the scene contains it.
    pub(crate) fn is_met(self, world: &World, plan: &Plan) -> bool {
        match self {
            Self::Edges => {
                let is_seen = !world.objects.is_empty() || plan.simulates(Effect::Patterns);
                is_seen && !plan.simulates(Effect::FocalBlur)
            }
            Self::Effect(effects) => effects.iter().any(|&effect| plan.simulates(effect)),
            Self::IteratedRoots => world.has_iterated_roots(),
            Self::Fractals => world.julia_iterations().is_some(),
        }
    }
}

/// All knobs. A new effect adds its entry here.
pub const KNOBS: &[Knob] = &[
    Knob {
        name: "antialias",
        needs: Need::Edges,
        idle: "there is nothing to see, or a lens blurs it",
        settings: &places::<{ LADDER.len() }>(),
        own: Own::Among,
        reference: None,
        set: |options, place| options.antialias = rung(place),
        get: |options| {
            LADDER.iter().position(|&rung| rung == options.antialias).unwrap_or(0) as f64
        },
        least: |place| match rung(place) {
            Antialias::Off | Antialias::Adaptive { .. } => 1.0,
            Antialias::Grid(n) => f64::from(n * n),
        },
        factor: |_| 1.0,
        label: |place| match rung(place) {
            Antialias::Off => "off".to_owned(),
            Antialias::Adaptive { threshold, grid } => {
                format!("adaptive {threshold} {grid}×{grid}")
            }
            Antialias::Grid(n) => format!("{n}×{n}"),
        },
        flag: |place| match rung(place) {
            Antialias::Off => "--antialias off".to_owned(),
            Antialias::Adaptive { threshold, grid } => {
                format!("--antialias adaptive:{threshold}:{grid}")
            }
            Antialias::Grid(n) => format!("--antialias {n}"),
        },
    },
    Knob {
        name: "depth",
        needs: Need::Effect(&[Effect::Reflection, Effect::Transparency]),
        idle: "no surface reflects or is clear",
        settings: &[1.0, 2.0, 3.0, 5.0, 10.0, 25.0, 250.0],
        own: Own::Between,
        reference: None,
        set: |options, depth| options.depth = Some(depth as u32),
        get: |options| options.depth.map_or(0.0, f64::from),
        least: |_| 1.0,
        factor: |_| 1.0,
        label: |depth| format!("{depth}"),
        flag: |depth| format!("--depth {depth}"),
    },
    Knob {
        name: "adc-bailout",
        needs: Need::Effect(&[Effect::Reflection, Effect::Transparency]),
        idle: "no surface reflects or is clear",
        settings: &[0.1, 1.0 / 64.0, 1.0 / 255.0, 1.0 / 4096.0, 1e-6],
        own: Own::Between,
        reference: None,
        set: |options, weight| options.adc_bailout = Some(weight),
        get: |options| options.adc_bailout.unwrap_or(0.0),
        least: |_| 1.0,
        factor: |_| 1.0,
        label: share,
        flag: |weight| format!("--adc-bailout {}", share(weight)),
    },
    Knob {
        name: "root-tolerance",
        needs: Need::IteratedRoots,
        idle: "no solid's crossings are found by steps that come nearer and nearer",
        settings: &[1e-2, 1e-4, 1e-6, 0.0],
        own: Own::Among,
        reference: None,
        set: |options, tolerance| options.root_tolerance = tolerance,
        get: |options| options.root_tolerance,
        least: |_| 1.0,
        // Instructions saved where nearly all shapes have iterated roots: Newton's last steps are few.
        factor: |tolerance| if tolerance > 0.0 { 0.985 } else { 1.0 },
        label: |tolerance| match tolerance {
            0.0 => "all digits".to_owned(),
            tolerance => format!("{tolerance:e}"),
        },
        flag: |tolerance| match tolerance {
            0.0 => "--root-tolerance 0".to_owned(),
            tolerance => format!("--root-tolerance {tolerance:e}"),
        },
    },
    Knob {
        name: "julia-iterations",
        needs: Need::Fractals,
        idle: "there is no julia_fractal",
        settings: &[1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0],
        own: Own::Last,
        reference: None,
        set: |options, most| options.julia_iterations = Some(most as u32),
        get: |options| options.julia_iterations.map_or(0.0, f64::from),
        least: |_| 1.0,
        // Their cost is included in the counted equations.
        factor: |_| 1.0,
        label: |most| format!("{most}"),
        flag: |most| format!("--julia-iterations {most}"),
    },
    Knob {
        name: "light-samples",
        needs: Need::Effect(&[Effect::AreaLights]),
        idle: "no light has an area",
        settings: &places::<{ LIGHTS.len() }>(),
        own: Own::Among,
        reference: Some(3.0),
        set: |options, place| options.light_samples = samples(&LIGHTS, place),
        get: |options| place_of(&LIGHTS, options.light_samples),
        least: |_| 1.0,
        factor: |_| 1.0,
        label: |place| samples(&LIGHTS, place).to_string(),
        flag: |place| format!("--light-samples {}", flag_of(samples(&LIGHTS, place))),
    },
    Knob {
        name: "blur-samples",
        needs: Need::Effect(&[Effect::FocalBlur]),
        idle: "everything is in focus",
        settings: &places::<{ BLURS.len() }>(),
        own: Own::Among,
        reference: None,
        set: |options, place| options.blur_samples = samples(&BLURS, place),
        get: |options| place_of(&BLURS, options.blur_samples),
        least: |place| match samples(&BLURS, place) {
            Samples::Scene | Samples::Adaptive { .. } => 1.0,
            Samples::Fixed(count) => f64::from(count),
        },
        factor: |_| 1.0,
        label: |place| samples(&BLURS, place).to_string(),
        flag: |place| format!("--blur-samples {}", flag_of(samples(&BLURS, place))),
    },
];

/// Formats a weight as `1/255`, `0.3` or `1e-6`, such that parsing it returns the same number.
pub fn share(weight: f64) -> String {
    let parts = (1.0 / weight).round();
    let (plain, short) = (format!("{weight}"), format!("{weight:e}"));
    match format!("{parts}") {
        few if few.len() < 5 && parts > 1.0 && weight > 0.0 && 1.0 / parts == weight => {
            format!("1/{few}")
        }
        _ if short.len() < plain.len() => short,
        _ => plain,
    }
}

impl Knob {
    /// Whether a coarser setting changes the scene's solids, rather than only the accuracy of their
    /// picture.
    pub fn changes_solids(&self) -> bool {
        matches!(self.needs, Need::IteratedRoots | Need::Fractals)
    }

    /// Whether it sets how many samples each pixel has, rather than what each of them is.
    pub(crate) fn samples_pixels(&self) -> bool {
        matches!(self.name, "antialias" | "blur-samples")
    }

    /// Returns the setting with the lowest cost in any scene.
    pub(crate) fn cheapest(&self) -> f64 {
        let cost = |setting: f64| (self.least)(setting) * (self.factor)(setting);
        let first = self.settings.first().copied().unwrap_or_default();
        self.settings
            .iter()
            .copied()
            .fold(first, |best, s| if cost(s) < cost(best) { s } else { best })
    }

    /// Returns the settings and the scene's `own`, without duplicates, from coarse to fine.
    pub fn with(&self, own: f64) -> Vec<f64> {
        let mut all = self.settings.to_vec();
        let rising = all.first() < all.last();
        let dearer = |&setting: &f64| if rising { setting > own } else { setting < own };
        let place = all.iter().position(dearer).unwrap_or(all.len());
        if self.own != Own::Among && !all.contains(&own) {
            all.insert(place, own);
        }
        if self.own == Own::Last {
            all.retain(|setting| !dearer(setting));
        }
        all
    }
}

/// Cost of a ray apart from finding its intersection, and of finding it, in camera rays that hit nothing.
/// Fitted to CPU seconds of the gallery, see `docs/accuracy.md`. Apart from its intersection, a ray toward
/// a light costs nothing.
const REFLECTION: f64 = 0.15;
const TRANSMISSION: f64 = 6.1;
const BOX_VISIT: f64 = 0.24;
/// Cost of solving the equation of a sphere; other equations are counted as multiples of it.
const ROOT_SOLVE: f64 = 0.24;

/// Returns the counted work in camera rays that hit nothing.
pub fn cost(counters: &Counters) -> f64 {
    let Counters {
        camera,
        shadow: _,
        reflection,
        transmission,
        total_reflection,
        work,
        evaluations: _,
    } = *counters;
    let Work { box_visits, root_solves: _, solving } = work;
    camera as f64
        + REFLECTION * (reflection + total_reflection) as f64
        + TRANSMISSION * transmission as f64
        + BOX_VISIT * box_visits as f64
        + ROOT_SOLVE * solving as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Frame;

    #[test]
    fn every_setting_is_what_it_says_after_it_was_set() {
        for knob in KNOBS {
            for &setting in knob.settings {
                let mut options = PlanOptions::new(Frame::whole(1, 1));
                (knob.set)(&mut options, setting);
                assert_eq!((knob.get)(&options), setting, "{}", knob.name);
                assert!(!(knob.label)(setting).is_empty());
                assert!((knob.flag)(setting).starts_with(&format!("--{} ", knob.name)));
            }
        }
    }

    #[test]
    fn fewer_iterations_and_looser_roots_are_other_solids() {
        let names = KNOBS.iter().filter(|knob| knob.changes_solids()).map(|knob| knob.name);
        assert_eq!(names.collect::<Vec<_>>(), ["root-tolerance", "julia-iterations"]);
    }

    #[test]
    fn what_render_does_is_a_rung_of_the_ladder() {
        assert!(LADDER.contains(&Antialias::default()));
        let options = PlanOptions::new(Frame::whole(1, 1));
        assert_eq!((KNOBS[0].label)((KNOBS[0].get)(&options)), "adaptive 0.05 8×8");
    }

    #[test]
    fn the_scenes_samples_are_its_own_and_the_reference_of_lights_is_unbiased() {
        let options = PlanOptions::new(Frame::whole(1, 1));
        let knob = |name: &str| KNOBS.iter().find(|knob| knob.name == name).expect("a knob");
        for name in ["light-samples", "blur-samples"] {
            assert_eq!((knob(name).label)((knob(name).get)(&options)), "scene");
        }
        let lights = knob("light-samples");
        assert_eq!(lights.reference.map(lights.label).as_deref(), Some("16"));
        assert_eq!((lights.flag)(4.0), "--light-samples adaptive:0.05:64");
    }

    #[test]
    fn the_cheapest_setting_costs_least_and_the_last_is_the_finest() {
        let cheapest: Vec<String> = KNOBS.iter().map(|k| (k.label)(k.cheapest())).collect();
        assert_eq!(cheapest, ["off", "1", "1/10", "1e-2", "1", "1", "1"]);
        let finest = |knob: &Knob| (knob.label)(knob.settings[knob.settings.len() - 1]);
        let finest: Vec<String> = KNOBS.iter().map(finest).collect();
        assert_eq!(finest, ["32×32", "250", "1e-6", "all digits", "20", "256", "1000"]);
    }

    #[test]
    fn the_scenes_own_setting_stands_where_it_belongs() {
        let depth = KNOBS.iter().find(|knob| knob.name == "depth").expect("a knob");
        assert_eq!(depth.with(7.0)[3..6], [5.0, 7.0, 10.0]);
        assert_eq!(depth.with(5.0), depth.settings);
        assert_eq!(depth.with(999.0).last(), Some(&999.0));
        let fractal = KNOBS.iter().find(|knob| knob.name == "julia-iterations").expect("a knob");
        assert_eq!(fractal.with(5.0), [1.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!(fractal.with(2.0), [1.0, 2.0]);
        assert_eq!(fractal.with(1.0), [1.0]);
        assert_eq!(fractal.with(50.0).last(), Some(&50.0));
        let cut = KNOBS.iter().find(|knob| knob.name == "adc-bailout").expect("a knob");
        assert_eq!(cut.with(0.05)[..3], [0.1, 0.05, 1.0 / 64.0]);
        assert_eq!((cut.label)(1.0 / 255.0), "1/255");
        assert_eq!((cut.flag)(1.0 / 64.0), "--adc-bailout 1/64");
        let labels = [0.0, 0.05, 0.3, 1.0, 2e-5].map(cut.label);
        assert_eq!(labels, ["0", "1/20", "0.3", "1", "2e-5"]);
    }
}
