//! `lucarne plan`: prints what will be simulated, what requires it, what it costs, and what is left out.

use lucarne::pilot::pilot;
use lucarne::plan::{Antialias, Effect, Measured, Plan, Samples, plan, print};
use lucarne::road::Road;
use lucarne::source::{Position, Site, Sources, Span};
use serde::Serialize;

use super::arguments::PlanArguments;
use super::exit::{Exit, Failure, Outcome};
use super::files;
use super::messages;
use super::text::{name_of, read_scene};

/// First line of the plan of a scene with errors.
const INCOMPLETE: &str =
    "incomplete: the scene has errors, and this is the plan of what could be read\n";

pub fn run(arguments: &PlanArguments) -> Outcome {
    let frame = arguments.picture.frame(&arguments.scene)?;
    let bytes = read_scene(&arguments.file)?;
    let files = files::of(&arguments.file, &arguments.scene);
    let dialect = arguments.scene.dialect(&arguments.file, &bytes);
    let mut options = arguments.scene.options(dialect, Some(frame));
    options.coinciding = true;
    let mut road = Road::new(&files, options);
    let (world, origins) = road.compile(&name_of(&arguments.file), bytes);
    let mut plan = plan(&world, &origins, &arguments.picture.options(frame));
    pilot(&world, &mut plan);
    let incomplete = road.diagnostics.has_errors();
    let text = match arguments.json {
        // Names and numbers only: nothing here can fail to serialise.
        true => {
            let report = Report::of(&plan, &road.sources, incomplete);
            serde_json::to_string_pretty(&report).unwrap_or_default() + "\n"
        }
        false if incomplete => INCOMPLETE.to_owned() + &print::dump(&plan, &road.sources),
        false => print::dump(&plan, &road.sources),
    };
    let mut messages = arguments.scene.messages();
    // Standard output is reserved for the plan.
    messages.picture_on_stdout = true;
    messages.print(road.diagnostics.in_text_order().into_iter(), &road.sources)?;
    messages.summarize();
    files::announce(&files, messages.exit() == Exit::Done)?;
    messages::print(&text)?;
    Ok::<Exit, Failure>(messages.exit())
}

/// Returns samples as the text of a plan names them; `None` if they are the scene's.
fn named(samples: Samples) -> Option<String> {
    (samples != Samples::Scene).then(|| samples.to_string())
}

/// Plan as printed by `--json`; `docs/effects.md` explains each name.
#[derive(Serialize)]
struct Report<'a> {
    /// Whether the scene has errors, and this is the plan of what could be read.
    incomplete: bool,
    width: u32,
    height: u32,
    region: [u32; 4],
    antialias: Smoothing,
    max_trace_level: u32,
    adc_bailout: f64,
    root_tolerance: f64,
    julia_iterations: Option<u32>,
    light_samples: Option<String>,
    blur_samples: Option<String>,
    stages: Vec<&'a str>,
    effects: Vec<Row<'a>>,
    dropped: Vec<Part<'a>>,
    shapes: Vec<Shapes<'a>>,
    surfaces: Vec<Parts<'a>>,
    numerics: Numbers<'a>,
    rays: Option<Rays>,
}

#[derive(Serialize)]
#[serde(rename_all = "lowercase", tag = "kind")]
enum Smoothing {
    Off,
    Grid { n: u32 },
    Adaptive { n: u32, threshold: f64 },
}

#[derive(Serialize)]
struct Row<'a> {
    effect: &'a str,
    on: bool,
    /// Why the effect is off.
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cost: Option<&'a str>,
    called_for_by: Vec<Place<'a>>,
    /// Where the scene turns the effect off.
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<Place<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rays_per_camera_ray: Option<f64>,
}

#[derive(Serialize)]
struct Part<'a> {
    what: &'a str,
    why: &'a str,
    place: Place<'a>,
    /// Macro calls that lead to this location.
    calls: Vec<Place<'a>>,
}

#[derive(Serialize)]
struct Parts<'a> {
    part: &'a str,
    count: usize,
    cost: &'a str,
    places: Vec<Place<'a>>,
}

#[derive(Serialize)]
struct Shapes<'a> {
    shape: &'a str,
    count: usize,
    cost: &'a str,
    places: Vec<Place<'a>>,
}

#[derive(Serialize)]
struct Thin<'a> {
    what: &'a str,
    value: f64,
    place: Option<Place<'a>>,
}

#[derive(Serialize)]
struct Endless<'a> {
    shape: &'a str,
    place: Option<Place<'a>>,
}

#[derive(Serialize)]
struct Numbers<'a> {
    smallest_half_width: Option<Number<'a>>,
    largest_half_width: Option<Number<'a>>,
    farthest_in_half_widths: Option<Number<'a>>,
    endless: Vec<Endless<'a>>,
    thin: Vec<Thin<'a>>,
    near_singular: Vec<Number<'a>>,
    coinciding: Vec<Pair<'a>>,
}

/// Two parts of one solid that share a face.
#[derive(Serialize)]
struct Pair<'a> {
    shapes: [&'a str; 2],
    places: [Place<'a>; 2],
}

#[derive(Serialize)]
struct Number<'a> {
    value: f64,
    place: Option<Place<'a>>,
}

#[derive(Serialize)]
struct Rays {
    per_camera_ray: f64,
    camera_per_pixel: f64,
    camera: f64,
    all: f64,
    pilot: [u32; 2],
    /// Pixels the pilot traced before it reached its limit of rays.
    pilot_pixels: usize,
    /// Recursion depth of the pilot, if less than that of the plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pilot_depth: Option<u32>,
}

#[derive(Serialize)]
struct Place<'a> {
    file: &'a str,
    line: usize,
    column: usize,
    /// Byte offsets in the file's text; the end is exclusive.
    start: u32,
    end: u32,
    text: &'a str,
}

impl<'a> Report<'a> {
    fn of(plan: &'a Plan, sources: &'a Sources, incomplete: bool) -> Self {
        let region = plan.frame.region;
        let place = |site: Site| Place::of(site, sources);
        let mut effects: Vec<Row> = Vec::new();
        for effect in Effect::ALL {
            effects.extend(plan.called(effect).map(|called| Row {
                effect: effect.name(),
                on: true,
                why: None,
                cost: Some(&called.cost),
                called_for_by: called.by.iter().copied().map(place).collect(),
                place: None,
                rays_per_camera_ray: called.rays,
            }));
            let left_out = plan.left_out.iter().filter(|left| left.effect == effect);
            effects.extend(left_out.map(|left| Row {
                effect: effect.name(),
                on: false,
                why: Some(&left.why),
                cost: None,
                called_for_by: Vec::new(),
                place: left.site.map(place),
                rays_per_camera_ray: None,
            }));
        }
        let number =
            |measured: Measured| Number { value: measured.value, place: measured.site.map(place) };
        Self {
            incomplete,
            width: plan.frame.width,
            height: plan.frame.height,
            region: [region.x, region.y, region.width, region.height],
            antialias: match plan.antialias {
                Antialias::Off => Smoothing::Off,
                Antialias::Grid(n) => Smoothing::Grid { n },
                Antialias::Adaptive { threshold, grid } => {
                    Smoothing::Adaptive { n: grid, threshold }
                }
            },
            max_trace_level: plan.max_trace_level,
            adc_bailout: plan.adc_bailout,
            root_tolerance: plan.root_tolerance,
            julia_iterations: plan.julia_iterations,
            light_samples: named(plan.light_samples),
            blur_samples: named(plan.blur_samples),
            stages: plan.stages.iter().map(|stage| stage.name()).collect(),
            effects,
            dropped: plan
                .dropped
                .iter()
                .map(|part| Part {
                    what: &part.what,
                    why: &part.why,
                    place: place(part.site),
                    calls: part.calls.iter().map(|&span| Place::at(span, sources)).collect(),
                })
                .collect(),
            shapes: plan
                .kinds
                .iter()
                .map(|kind| Shapes {
                    shape: &kind.word,
                    count: kind.count,
                    cost: kind.cost,
                    places: kind.by.iter().copied().map(place).collect(),
                })
                .collect(),
            surfaces: plan
                .surfaces
                .iter()
                .map(|kind| Parts {
                    part: &kind.word,
                    count: kind.count,
                    cost: kind.cost,
                    places: kind.by.iter().copied().map(place).collect(),
                })
                .collect(),
            numerics: Numbers {
                smallest_half_width: plan.numerics.smallest.map(number),
                largest_half_width: plan.numerics.largest.map(number),
                farthest_in_half_widths: plan.numerics.farthest.map(number),
                endless: plan
                    .numerics
                    .endless
                    .iter()
                    .map(|&(shape, site)| Endless { shape, place: site.map(place) })
                    .collect(),
                thin: plan
                    .numerics
                    .thin
                    .iter()
                    .map(|thin| Thin {
                        what: thin.what,
                        value: thin.slenderness,
                        place: thin.site.map(place),
                    })
                    .collect(),
                near_singular: plan
                    .numerics
                    .near_singular
                    .iter()
                    .map(|near| Number { value: near.condition, place: Some(place(near.site)) })
                    .collect(),
                coinciding: plan
                    .numerics
                    .coinciding
                    .iter()
                    .map(|pair| Pair { shapes: pair.words, places: pair.sites.map(place) })
                    .collect(),
            },
            rays: plan.pilot.map(|pilot| Rays {
                per_camera_ray: pilot.rays,
                camera_per_pixel: plan.camera_rays_a_pixel(),
                camera: plan.camera_rays(),
                all: pilot.rays * plan.camera_rays(),
                pilot: [pilot.width, pilot.height],
                pilot_pixels: pilot.pixels,
                pilot_depth: pilot.depth,
            }),
        }
    }
}

impl<'a> Place<'a> {
    fn of(site: Site, sources: &'a Sources) -> Self {
        Self::at(site.span, sources)
    }

    fn at(span: Span, sources: &'a Sources) -> Self {
        let source = sources.get(span.file);
        let Position { line, column } = source.position(span.start as usize);
        let Span { start, end, .. } = span;
        Self { file: &source.name, line, column, start, end, text: sources.text(span) }
    }
}
