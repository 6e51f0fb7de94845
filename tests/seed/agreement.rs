//! The literal reading and the tracer, pixel by pixel: on the scenes of `scenes/seed`, and on
//! scenes of chance.

use std::fs;
use std::path::PathBuf;

use lucarne::color::Rgb;
use lucarne::diagnostic::{Code, Diagnostic, Diagnostics};
use lucarne::lower::{LowerOptions, lower};
use lucarne::math::Vector;
use lucarne::math::transform::Step;
use lucarne::plan::{Antialias, Frame, PlanOptions, plan};
use lucarne::road::{Options, Road};
use lucarne::scene::{Dialect, Scene};
use lucarne::source::NoFiles;
use lucarne::trace::TraceOptions;
use lucarne::world::{Origins, World};

use super::page::{Page, Source};
use super::spent::assert_spent_as_the_page_says;
use crate::dice::Dice;

const TOLERANCE: f64 = 1e-9;

/// The scenes of `scenes/seed`, by name.
fn scenes() -> Vec<(String, String)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scenes/seed");
    let mut scenes: Vec<_> = fs::read_dir(folder)
        .expect("the folder of the seed's scenes")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|e| e == "scene"))
        .map(|path| {
            let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
            (name, fs::read_to_string(path).expect("a text"))
        })
        .collect();
    scenes.sort();
    scenes
}

/// From text to Scene, without a word from the compiler.
fn read(name: &str, text: &str) -> Scene {
    let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
    let file = road.read(&format!("{name}.scene"), text.as_bytes().to_vec());
    let ast = road.parse(file);
    let scene = road.evaluate(ast);
    assert!(road.diagnostics.is_empty(), "{name}: {:#?}", road.diagnostics);
    scene
}

fn lowered(name: &str, scene: Scene) -> (World, Origins) {
    let mut diagnostics = Diagnostics::new(true);
    let lowered = lower(scene, &LowerOptions::default(), &mut diagnostics);
    // A camera of chance may stand below the ground, and a light in a ball.
    let is_dark = |one: &Diagnostic| matches!(one.code, Code::NothingInView | Code::EnclosedLight);
    assert!(diagnostics.iter().all(is_dark), "{name}: {diagnostics:#?}");
    lowered
}

fn traced(world: &World, origins: &Origins, width: u32, height: u32) -> Vec<Rgb> {
    let frame = Frame::whole(width, height);
    let options = PlanOptions { antialias: Antialias::Off, ..PlanOptions::new(frame) };
    let plan = plan(world, origins, &options);
    crate::unrounded::radiances(world, &plan, &TraceOptions::default())
}

/// The largest difference of two colours' components; a NaN is infinitely far.
fn off(a: Rgb, b: Rgb) -> f64 {
    let (a, b) = (a.components(), b.components());
    let apart = |i: usize| Some((a[i] - b[i]).abs()).filter(|d| !d.is_nan());
    (0..3).map(|i| apart(i).unwrap_or(f64::INFINITY)).fold(0.0, f64::max)
}

/// The largest difference of any pixel, and where it is.
fn apart(a: &[Rgb], b: &[Rgb]) -> (f64, usize) {
    assert_eq!(a.len(), b.len());
    let mut worst = (0.0, 0);
    for (pixel, (a, b)) in a.iter().zip(b).enumerate() {
        if off(*a, *b) > worst.0 {
            worst = (off(*a, *b), pixel);
        }
    }
    worst
}

fn assert_agree(name: &str, page: &Page, world: &World, origins: &Origins, size: (u32, u32)) {
    assert_spent_as_the_page_says(page, world, name);
    let (width, height) = size;
    let ours = traced(world, origins, width, height);
    let pages = page.picture(width, height);
    let (difference, pixel) = apart(&ours, &pages);
    let differ = ours.iter().zip(&pages).filter(|(a, b)| off(**a, **b) > TOLERANCE).count();
    assert!(
        difference <= TOLERANCE,
        "{name}: off by {difference:e} at column {}, row {}: traced {:?}, the page says {:?}; \
         {differ} of {} pixels differ",
        pixel as u32 % width,
        pixel as u32 / width,
        ours[pixel],
        pages[pixel],
        ours.len(),
    );
}

#[test]
fn every_scene_of_the_page_is_traced_as_the_page_says() {
    let scenes = scenes();
    assert!(scenes.len() >= 22, "only {} scenes", scenes.len());
    let mut failures = Vec::new();
    for (name, text) in scenes {
        let agree = || {
            let scene = read(&name, &text);
            let page = Page::read(&scene);
            let (world, origins) = lowered(&name, scene);
            assert_agree(&name, &page, &world, &origins, (160, 120));
        };
        if let Err(panic) = std::panic::catch_unwind(std::panic::AssertUnwindSafe(agree)) {
            let message = panic.downcast::<String>().map_or_else(|_| "?".into(), |text| *text);
            failures.push(format!("{name}: {message}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn scenes_of_chance_are_traced_as_the_page_says() {
    for number in 0..100 {
        let scene = Dice(number).scene();
        let page = Page::read(&scene);
        let name = format!("dice {number}");
        let (world, origins) = lowered(&name, scene);
        assert_agree(&name, &page, &world, &origins, (48, 24));
    }
}

#[test]
fn every_scene_says_its_rule_in_its_first_line_and_shows_every_object_and_light() {
    for (name, text) in scenes() {
        let first = text.lines().next().unwrap_or_default();
        assert!(first.starts_with("// ") && first.ends_with('.'), "{name}: {first}");
        let page = Page::read(&read(&name, &text));
        let picture = page.picture(80, 60);
        let hidden = |fault: &str, page: &Page| {
            if apart(&picture, &page.picture(80, 60)).0 <= TOLERANCE {
                Some(fault.to_owned())
            } else {
                None
            }
        };
        let objects = (0..page.objects.len()).filter_map(|o| {
            let mut without = page.clone();
            without.objects.remove(o);
            hidden(&format!("object {o} {:?}", page.objects[o]), &without)
        });
        let lights = (0..page.lights.len()).filter_map(|l| {
            let mut without = page.clone();
            without.lights.remove(l);
            hidden(&format!("light {l} {:?}", page.lights[l]), &without)
        });
        let unseen: Vec<String> = objects.chain(lights).collect();
        // That light is there to be barred.
        let meant = if name == "plane_from_inside" { 1 } else { 0 };
        assert_eq!(unseen.len(), meant, "{name}: nothing shows {unseen:#?}");
    }
}

/// Ways to get the page wrong by a little, each with the scene that must tell.
#[test]
fn a_fault_of_a_millionth_in_any_quantity_of_the_page_is_seen() {
    let small = 1.0 + 1e-6;
    type Fault = (&'static str, &'static str, fn(&mut Page, f64));
    let faults: [Fault; 15] = [
        ("sphere", "a radius", |p, k| grow(p, 0, k)),
        ("point_light", "a plane", |p, k| grow(p, 0, k)),
        ("point_light", "a box", |p, k| grow(p, 3, k)),
        ("ambient", "the ambient light", |p, k| p.ambient.red *= k),
        ("diffuse", "kd", |p, k| p.objects.iter_mut().for_each(|o| o.surface.kd *= k)),
        ("specular", "ks", |p, k| p.objects.iter_mut().for_each(|o| o.surface.ks *= k)),
        ("specular", "n", |p, k| p.objects.iter_mut().for_each(|o| o.surface.n *= k)),
        ("coefficients", "a colour", |p, k| p.objects[3].surface.color.green *= k),
        ("lights_sum", "a light", |p, k| p.lights[0].intensity.blue *= k),
        ("camera_distance", "the screen's distance", |p, k| p.eye.distance *= k),
        ("sphere", "where the axis passes the screen", |p, k| p.eye.axis[1] *= k),
        ("mirrors_facing", "one reflection less", |p, _| p.bound -= 1),
        ("mirrors_facing", "one reflection more", |p, _| p.bound += 1),
        ("camera_wide", "the screen's width", |p, k| p.eye.size[0] *= k),
        ("point_light", "a light's place", |p, k| {
            if let Source::Point(at) = &mut p.lights[0].source {
                *at *= k;
            }
        }),
    ];
    fn grow(page: &mut Page, object: usize, k: f64) {
        let form = &mut page.objects[object].form;
        *form = form.after(&Step::Scale(Vector::ONE * k));
    }
    for (name, what, fault) in faults {
        let (_, text) = scenes().into_iter().find(|(n, _)| n == name).expect("the scene");
        let scene = read(name, &text);
        let mut page = Page::read(&scene);
        let (world, origins) = lowered(name, scene);
        let ours = traced(&world, &origins, 160, 120);
        assert!(apart(&ours, &page.picture(160, 120)).0 <= TOLERANCE, "{name}");
        fault(&mut page, small);
        assert!(apart(&ours, &page.picture(160, 120)).0 > TOLERANCE, "{name}: {what}");
    }
}
