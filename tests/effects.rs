//! Only what is called for, over every scene of `scenes/`: counters are zero for what is off, and every line
//! quotes what calls for its effect.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use lucarne::diagnostic::render::{Style, human};
use lucarne::film::Depth;
use lucarne::picture::{Format, encode};
use lucarne::pilot::pilot;
use lucarne::plan::{Antialias, Effect, Frame, Kind, Plan, PlanOptions, Samples, Stage, plan};
use lucarne::road::{Options, Road, dialect};
use lucarne::source::{FileError, Files, Found, Sources, Span};
use lucarne::standard::include;
use lucarne::trace::{Counters, Evaluations, TraceOptions, Traced, Unwatched, trace};
use lucarne::world::{Origins, World};

mod dropped;
mod quotes;

const OPTIONS: PlanOptions = PlanOptions {
    frame: Frame::whole(40, 30),
    antialias: Antialias::Adaptive { threshold: 0.05, grid: 2 },
    depth: None,
    adc_bailout: None,
    root_tolerance: 0.0,
    julia_iterations: None,
    light_samples: Samples::Scene,
    blur_samples: Samples::Scene,
    alpha: false,
};

/// Files as they lie on disk, or are built in, but for those that were changed here.
#[derive(Default)]
struct Changed(BTreeMap<String, String>);

impl Files for Changed {
    fn read(&self, name: &str, from: &str) -> Result<Found, FileError> {
        let near = Path::new(from).with_file_name(name).to_string_lossy().into_owned();
        let found = match fs::read(&near) {
            Ok(bytes) => Some((near, bytes)),
            Err(_) => include(name).map(|(place, text)| (place, text.as_bytes().to_vec())),
        };
        let Some((name, bytes)) = found else {
            return Err(FileError::NotFound { searched: Vec::new(), similar: Vec::new() });
        };
        let changed = self.0.get(&name).map(|text| text.clone().into_bytes());
        Ok(Found { name, bytes: changed.unwrap_or(bytes) })
    }
}

/// A scene on the far end of the road.
struct Seen {
    world: World,
    plan: Plan,
    sources: Sources,
    errors: String,
}

fn see(name: &str, files: &Changed) -> Seen {
    let text = files.0.get(name).cloned().unwrap_or_else(|| fs::read_to_string(name).expect(name));
    let mut road = Road::new(files, Options::new(dialect(name)));
    let (world, origins): (World, Origins) = road.compile(name, text.into_bytes());
    let plan = plan(&world, &origins, &OPTIONS);
    let message = |message| human(message, &road.sources, Style::PLAIN);
    let broken = road.diagnostics.has_errors();
    let errors =
        if broken { road.diagnostics.iter().map(message).collect() } else { String::new() };
    Seen { world, plan, sources: road.sources, errors }
}

fn see_text(text: &str) -> Seen {
    let name = "a.scene".to_owned();
    see(&name, &Changed([(name.clone(), text.to_owned())].into()))
}

/// Every scene of `scenes/`, by its path.
fn scenes() -> Vec<String> {
    let mut folders = vec![PathBuf::from("scenes")];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("listed").flatten() {
            match entry.path() {
                path if path.is_dir() => folders.push(path),
                path if path.extension().is_some_and(|extension| extension == "scene") => {
                    found.push(path.to_string_lossy().into_owned());
                }
                _ => {}
            }
        }
    }
    found.sort();
    assert!(found.len() > 80, "{} scenes", found.len());
    found
}

/// The texts without these pieces.
fn without(spans: &[Span], sources: &Sources) -> Changed {
    let mut spans = spans.to_vec();
    // From the last to the first, so that a piece stands where it stood; of two nested ones the outer.
    spans.sort_by_key(|span| (span.file, std::cmp::Reverse(span.end), span.start));
    let mut changed = BTreeMap::new();
    let mut last: Option<Span> = None;
    for span in spans {
        if last.is_some_and(|last| last.file == span.file && last.start < span.end) {
            assert!(last.is_some_and(|last| last.start <= span.start), "pieces overlap: {span:?}");
            continue;
        }
        let source = sources.get(span.file);
        let text: &mut String =
            changed.entry(source.name.clone()).or_insert_with(|| source.text.clone());
        text.replace_range(span.range(), " ");
        last = Some(span);
    }
    Changed(changed)
}

fn traced(world: &World, plan: &Plan) -> Traced {
    trace(world, plan, &TraceOptions::on_threads(1), &Unwatched)
}

/// How often an effect was at work.
fn counted(effect: Effect, counters: &Counters) -> u64 {
    let Evaluations {
        diffuse,
        highlights,
        attenuation,
        area_lights,
        projections,
        light_groups,
        from_behind,
        refraction,
        absorption,
        dispersion,
        colored_shadows,
        patterns,
        hiding,
        sky,
        focal_blur,
        camera_normal,
        fog,
        rainbows,
    } = counters.evaluations;
    match effect {
        Effect::Diffuse => diffuse,
        Effect::Highlights => highlights,
        Effect::Shadows => counters.shadow,
        Effect::Attenuation => attenuation,
        Effect::AreaLights => area_lights,
        Effect::Projections => projections,
        Effect::LightGroups => light_groups,
        Effect::DoubleIllumination => from_behind,
        Effect::Reflection => counters.reflection,
        Effect::Transparency => counters.transmission,
        Effect::Refraction => refraction + counters.total_reflection,
        Effect::Absorption => absorption,
        Effect::Dispersion => dispersion,
        Effect::ColoredShadows => colored_shadows,
        Effect::Patterns => patterns,
        Effect::Hiding => hiding,
        Effect::Sky => sky,
        Effect::FocalBlur => focal_blur,
        Effect::CameraNormal => camera_normal,
        Effect::Fog => fog,
        Effect::Rainbows => rainbows,
        Effect::Antialiasing => {
            let pixels = OPTIONS.frame.width * OPTIONS.frame.height;
            counters.camera.saturating_sub(u64::from(pixels).max(focal_blur))
        }
    }
}

#[test]
fn what_is_off_is_counted_zero() {
    let mut seen = BTreeSet::new();
    for name in scenes() {
        let Seen { world, plan, .. } = see(&name, &Changed::default());
        let options = TraceOptions { count_work: true, ..TraceOptions::on_threads(1) };
        let counters = trace(&world, &plan, &options, &Unwatched).counters;
        // So few need no tree of boxes.
        let visits = counters.work.box_visits;
        assert!(world.objects.len() >= 8 || visits == 0, "{name}: {visits} boxes");
        for effect in Effect::ALL {
            let times = counted(effect, &counters);
            assert!(plan.simulates(effect) || times == 0, "{name}: {effect:?} {times}");
            if times > 0 {
                seen.insert(effect);
            }
        }
    }
    assert_eq!(seen.len(), Effect::ALL.len(), "each is on and counted somewhere: {seen:?}");
}

#[test]
fn all_stages_give_the_same_bytes_as_those_of_the_plan() {
    let mut smaller = 0;
    for name in scenes() {
        let Seen { world, plan, .. } = see(&name, &Changed::default());
        let full = Plan { stages: Stage::ALL.to_vec(), ..plan.clone() };
        if full.stages == plan.stages {
            continue;
        }
        smaller += 1;
        let bytes = |plan: &Plan| {
            let film = traced(&world, plan).film;
            encode(&film, Depth::Sixteen, Format::Png).expect("a picture")
        };
        assert_eq!(bytes(&plan), bytes(&full), "{name}");
    }
    assert!(smaller > 20, "{smaller} scenes have fewer stages");
}

#[test]
fn the_stages_of_the_plan_are_those_that_run() {
    let mut absent = 0;
    for name in scenes() {
        let Seen { world, plan, .. } = see(&name, &Changed::default());
        let Counters { camera, shadow, reflection, transmission, total_reflection, .. } =
            traced(&world, &plan).counters;
        assert!(camera > 0, "{name}");
        let onward = reflection + transmission + total_reflection;
        for (stage, rays) in [(Stage::Shadow, shadow), (Stage::Scatter, onward)] {
            assert!(plan.runs(stage) || rays == 0, "{name}: {rays} rays of {stage:?}");
            absent += usize::from(!plan.runs(stage));
        }
        // And none is missing: without its stage, a ray of that kind is.
        if shadow > 0 {
            let stages = Stage::ALL.into_iter().filter(|stage| *stage != Stage::Shadow).collect();
            assert_eq!(traced(&world, &Plan { stages, ..plan.clone() }).counters.shadow, 0);
        }
    }
    assert!(absent > 20, "{absent}");
}

#[test]
fn the_pilot_knows_what_the_picture_takes() {
    let threshold = 0.05;
    let fine = Antialias::Adaptive { threshold, grid: 3 };
    for name in
        ["scenes/gallery/first.scene", "scenes/seed/mirror.scene", "scenes/gallery/glass.scene"]
    {
        let Seen { world, plan, .. } = see(name, &Changed::default());
        let cost = |frame: Frame, antialias: Antialias| {
            let mut plan = Plan { frame, antialias, ..plan.clone() };
            pilot(&world, &mut plan);
            let rays = plan.pilot.expect("sent").rays * plan.camera_rays();
            let counters = traced(&world, &plan).counters;
            (plan, rays, counters)
        };
        // A small picture is its own pilot.
        for antialias in [Antialias::Off, fine] {
            let (plan, rays, counters) = cost(Frame::whole(60, 45), antialias);
            assert!((plan.camera_rays() - counters.camera as f64).abs() < 1e-6, "{name}");
            assert!((rays - counters.rays() as f64).abs() < 1e-6, "{name}");
        }
        let (plan, rays, counters) = cost(Frame::whole(200, 150), fine);
        let all = counters.camera as f64 / 30_000.0;
        let found = plan.pilot.and_then(|pilot| pilot.camera).expect("adaptive");
        // Of 3072 pixels drawn at random, four standard errors of numbers from 1 to 9: those of a part each are off by
        // less.
        let error = ((all - 1.0) * (9.0 - all) / 3072.0).sqrt();
        assert!((found - all).abs() < 4.0 * error, "{name}: {found} of {all} ± {error}");
        assert!((rays / counters.rays() as f64 - 1.0).abs() < 0.15, "{name}");
    }
}

/// A scene in which nothing is called for but a camera: an object that only glows.
const BARE: &str = "camera { location <0, 1, 6> look_at 0 }
sphere { 0, 1 pigment { rgb 1 } finish { ambient 1 diffuse 0 } }
";

/// As [`BARE`], under a light that casts shadows.
const LIT: &str = "camera { location <0, 1, 6> look_at 0 }
light_source { <4, 8, 6>, rgb 1 }
sphere { 0, 1 pigment { rgb 1 } }
";

/// A clear sheet under a lamp whose light it does not stop, and nothing else.
const CLEAR: &str = "camera { location <0, 1, 6> look_at 0 }
light_source { <4, 8, 6>, rgb 1 }
plane { y, -3 pigment { rgb 1 } }
#declare Window = texture { pigment { rgbt <1, 1, 1, 1> } finish { ambient 0 diffuse 0 } }
box { -1, <1, -0.9, 1> texture { Window } no_shadow }
";

/// A lamp written once, and placed: its piece of text calls for its light already.
const LAMPS: &str = "#macro Lamp(Beam)
  light_source { 9, rgb 1 #if (Beam = 1) spotlight #end #if (Beam = 2) area_light x, y, 3, 3 #end
    #if (Beam = 3) projected_through { sphere { 3, 1 } } #end }
#end
sphere { 0, 1 pigment { rgb 1 } }
Lamp(0)
";

/// The lines of a plan: effects on with their places, but for antialiasing.
fn lines(seen: &Seen) -> BTreeMap<&'static str, Vec<String>> {
    let effects = seen.plan.effects.iter().filter(|c| c.effect != Effect::Antialiasing);
    let text = |span: Span| seen.sources.text(span).to_owned();
    effects.map(|c| (c.effect.name(), c.by.iter().map(|site| text(site.span)).collect())).collect()
}

#[test]
fn one_object_with_one_effect_changes_exactly_its_line() {
    let unlit = "sphere { 0, 1 }";
    // An object that answers a light which throws no shadow of it: one that does is called for by the
    // light.
    let unshadowed = "camera { location 9*z look_at 0 } light_source { 9, rgb 1 }
sphere { 0, 1 no_shadow }";
    // Clear or not, a ray ends at the first surface.
    let flat = "global_settings { max_trace_level 1 } light_source { 9, rgb 1 } sphere { 0, 1 }";
    let dull = "finish { ambient 0 diffuse 0 }";
    let window = format!("sphere {{ x, 1 pigment {{ rgbt <1, 1, 1, 0.5> }} {dull} }}");
    let filter = format!("sphere {{ x, 1 pigment {{ rgbf <1, 0, 0, 1> }} {dull} }}");
    // Of the same window, so that no other piece of text calls for transparency.
    let filled = "sphere { 3*x, 0.5 texture { Window } interior { ior 1.5 } no_shadow }";
    let cases: [(&str, &str, Effect, &str); 23] = [
        (
            unlit,
            "light_source { 9, rgb 1 shadowless }",
            Effect::Diffuse,
            "light_source { 9, rgb 1 shadowless }",
        ),
        (unshadowed, "sphere { x, 1 }", Effect::Shadows, "light_source { 9, rgb 1 }"),
        (LAMPS, "Lamp(1)", Effect::Attenuation, "spotlight"),
        (LAMPS, "Lamp(2)", Effect::AreaLights, "area_light x, y, 3, 3"),
        (LAMPS, "Lamp(3)", Effect::Projections, "projected_through { sphere { 3, 1 } }"),
        (
            LIT,
            "sphere { x, 1 double_illuminate on }",
            Effect::DoubleIllumination,
            "double_illuminate on",
        ),
        (
            LIT,
            "disc { x, z, 1 finish { diffuse 0.6, 0.3 } }",
            Effect::DoubleIllumination,
            "diffuse 0.6, 0.3",
        ),
        (LIT, "sphere { x, 1 no_image }", Effect::Hiding, "no_image"),
        (LIT, "union { sphere { x, 1 } no_reflection on }", Effect::Hiding, "no_reflection on"),
        (
            LIT,
            "#declare S = sphere { x, 1 no_image off no_image } object { S scale 2 }",
            Effect::Hiding,
            "no_image",
        ),
        (BARE, &window, Effect::Transparency, "rgbt <1, 1, 1, 0.5>"),
        (CLEAR, filled, Effect::Refraction, "ior 1.5"),
        (flat, &filter, Effect::ColoredShadows, "rgbf <1, 0, 0, 1>"),
        (
            BARE,
            "sphere { x, 1 finish { diffuse 0 reflection 0.3 } }",
            Effect::Reflection,
            "reflection 0.3",
        ),
        (
            BARE,
            "plane { y, 0 pigment { checker rgb 1 rgb 0 } finish { diffuse 0 } }",
            Effect::Patterns,
            "checker",
        ),
        (BARE, "sky_sphere { pigment { rgb 1 } }", Effect::Sky, "pigment { rgb 1 }"),
        (LIT, "fog { distance 9 rgb 1 }", Effect::Fog, "fog { distance 9 rgb 1 }"),
        (
            LIT,
            "rainbow { direction -z angle 9 width 20 color_map { [0 rgb 1] } }",
            Effect::Rainbows,
            "rainbow { direction -z angle 9 width 20 color_map { [0 rgb 1] } }",
        ),
        (LIT, "sphere { x, 1 finish { phong 0.4 phong_size 9 } }", Effect::Highlights, "phong 0.4"),
        (
            LIT,
            "#declare S = finish { specular 0.5 } box { 0, 1 finish { S } }",
            Effect::Highlights,
            "specular 0.5",
        ),
        (
            LIT,
            "sphere { x, 1 finish { reflection { 0.1, 1 falloff 2 } } }",
            Effect::Reflection,
            "reflection { 0.1, 1 falloff 2 }",
        ),
        (
            LIT,
            "#macro M(F) sphere { x, 1 finish { reflection F } } #end M(0.2)",
            Effect::Reflection,
            "reflection F",
        ),
        (
            LIT,
            "plane { y, 0 pigment { gradient y scale 2 color_map { [0 rgb 0] [1 rgb 1] } } }",
            Effect::Patterns,
            "gradient y",
        ),
    ];
    for (scene, object, effect, quote) in cases {
        let before = see_text(scene);
        let after = see_text(&format!("{scene}{object}\n"));
        assert_eq!((before.errors.as_str(), after.errors.as_str()), ("", ""), "{object}");
        let mut expected = lines(&before);
        let replaced = expected.insert(effect.name(), vec![quote.to_owned()]);
        assert_eq!(replaced, None, "{object}");
        assert_eq!(lines(&after), expected, "{object}");
        // Nor do the costs of the other lines change, nor why they are off.
        let others = |seen: &Seen| {
            let on = seen.plan.effects.iter().map(|on| (on.effect, &on.cost, None));
            let off = seen.plan.left_out.iter().map(|off| (off.effect, &off.why, off.site));
            let mut all: Vec<_> = on.chain(off).map(|(e, why, at)| (e, why.clone(), at)).collect();
            all.retain(|(other, ..)| *other != effect);
            all.sort_by_key(|(effect, ..)| *effect);
            all
        };
        assert_eq!(others(&after), others(&before), "{object}");
    }
}

#[test]
fn a_planted_near_singular_matrix_is_found_at_its_place() {
    let near = |text: &str| {
        let seen = see_text(&format!("{LIT}{text}"));
        assert_eq!(seen.errors, "", "{text}");
        let near = seen.plan.numerics.near_singular.iter();
        let text = |span| seen.sources.text(span).to_owned();
        near.map(|near| (text(near.site.span), near.condition)).collect::<Vec<_>>()
    };
    // Of two rows that differ by δ = 1e-9 the singular values are √2 and δ/√2, but for δ² of each.
    let matrix = "matrix <1, 0, 0, 1, 1e-9, 0, 0, 0, 1, 0, 0, 0>";
    let found = near(&format!("#for (I, 1, 3) box {{ 0, 1 {matrix} translate I*x }} #end"));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, matrix);
    assert!((found[0].1 / 2e9 - 1.0).abs() < 1e-6, "{found:?}");
    // In a pigment, too; and a flat scale is one.
    let scale = "scale <1, 1e-9, 1>";
    let found = near(&format!("sphere {{ 0, 1 pigment {{ checker rgb 1 rgb 0 {scale} }} }}"));
    assert_eq!(found[0].0, scale);
    assert!((found[0].1 / 1e9 - 1.0).abs() < 1e-12, "{found:?}");
    // None alone, but all together: the object is named.
    let found = near("sphere { 0, 1 scale <1, 1e-5, 1> translate y scale <1, 1e-5, 1> }");
    assert_eq!((found.len(), found[0].0.as_str()), (1, "sphere"));
    assert!(near("sphere { 0, 1 scale 1e-12 rotate 40 scale <1, 1000, 1> }").is_empty());
}

#[test]
fn the_range_of_sizes_and_the_farthest_thing_are_found_at_their_places() {
    let seen = see_text(
        "camera { location <0, 0, 100> look_at 0 }
sphere { 0, 2 }
sphere { 50*x, 1e-6 }
box { -7, <7, 7, 500> }
union { sphere { 0, 1 scale <1, 2, 3> } translate 1e6*z }
plane { y, -1e9 }",
    );
    let numerics = &seen.plan.numerics;
    let found = |measured: Option<lucarne::plan::Measured>| {
        let measured = measured.expect("found");
        let place = seen.sources.place(measured.site.expect("a place").span);
        (measured.value, place)
    };
    assert_eq!(found(numerics.smallest), (1e-6, "a.scene:3:1".to_owned()));
    assert_eq!(found(numerics.largest), (253.5, "a.scene:4:1".to_owned()));
    let (far, place) = found(numerics.farthest);
    assert_eq!(place, "a.scene:3:1");
    assert!((far / 1e6 / 12_500f64.sqrt() - 1.0).abs() < 1e-12, "{far}");
}

#[test]
fn half_widths_are_those_of_the_shape_and_what_has_none_is_named() {
    let halves = |solid: &str| {
        let seen = see_text(&format!("camera {{ location 9*z look_at 0 }} {solid}"));
        assert_eq!(seen.errors, "", "{solid}");
        let numerics = seen.plan.numerics;
        let value = |found: Option<lucarne::plan::Measured>| found.map(|found| found.value);
        let endless: Vec<&str> = numerics.endless.iter().map(|(word, _)| *word).collect();
        (value(numerics.smallest).zip(value(numerics.largest)), endless)
    };
    for (solid, least, greatest) in [
        ("cylinder { -2*y, 2*y, 0.6 }", 0.6, 2.0),
        ("cone { 0, 1, 2*y, 0 }", 1.0, 1.0),
        ("triangle { -x, x, y }", 0.5, 1.0),
        ("torus { 3, 0.5 }", 0.5, 3.5),
        ("disc { 0, y, 2 }", 2.0, 2.0),
        ("cylinder { 0, 6*y, 1 scale <1, 2, 5> }", 1.0, 6.0),
        ("quadric { <1, 1, 1>, 0, 0, -1 }", 1.0, 1.0),
        ("quadric { <1, 4, 1>, 0, <-6, 0, 0>, 5 rotate 30*y }", 1.0, 2.0),
    ] {
        let (found, endless) = halves(solid);
        let (from, to) = found.expect(solid);
        let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
        assert!(close(from, least) && close(to, greatest), "{solid}: {from} to {to}");
        assert!(endless.is_empty(), "{solid}");
    }
    assert_eq!(halves("quadric { <1, 1, -1>, 0, 0, -1 }"), (None, vec!["quadric"]));
    assert_eq!(halves("plane { y, 0 }"), (None, vec!["plane"]));
}

#[test]
fn what_is_thin_for_its_length_is_found_at_its_place() {
    let thin = |solid: &str| {
        let seen = see_text(&format!("{LIT}{solid}"));
        assert_eq!(seen.errors, "", "{solid}");
        let thin = seen.plan.numerics.thin.first().copied();
        thin.map(|thin| (thin.what, thin.slenderness))
    };
    let (what, times) = thin("torus { 1e9, 1 }").expect("thin");
    assert!(what == "torus" && (times / 1e9 - 1.0).abs() < 1e-6, "{what} {times}");
    let needle = "mesh { triangle { 0, x, <0.5, 1e-13, 0> } triangle { 0, x, y } }";
    let (what, times) = thin(needle).expect("thin");
    assert!(what == "triangle of a mesh" && (times / 1e13 - 1.0).abs() < 0.01, "{what} {times}");
    assert_eq!(thin("torus { 1, 1e-6 }"), None);
    assert_eq!(thin("box { 0, <1, 1e-3, 1> }"), None);
}

#[test]
fn each_kind_of_shape_has_a_line_and_what_is_not_there_has_none() {
    let kinds = |text: &str| {
        let kinds = see_text(text).plan.kinds;
        let line = |kind: &Kind| format!("{} {} {}", kind.word, kind.count, kind.by.len());
        kinds.iter().map(line).collect::<Vec<_>>()
    };
    let many = "#for (I, 1, 3) sphere { I, 1 } #end union { box { 0, 1 } sphere { 0, 1 } }";
    assert_eq!(kinds(many), ["box 1 1", "sphere 4 2"]);
    let cut = "difference { box { 0, 1 } merge { torus { 1, 0.1 } cylinder { 0, x, 1 } } }";
    let parts = ["box 1 1", "cylinder 1 1", "torus 1 1", "difference 1 1", "merge 1 1"];
    assert_eq!(kinds(cut), parts);
    assert!(kinds("light_source { 9, rgb 1 }").is_empty());
}
