//! Holding lucarne's picture against the exact one.

use lucarne::color::Rgb;
use lucarne::film::Film;
use lucarne::plan::{Antialias, Frame, PlanOptions, plan};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::NoFiles;
use lucarne::trace::{TraceOptions, Unwatched, trace};
use lucarne::world::{Origins, World};

use super::exact::Exact;
use super::scene::{Scene, Triple};
use crate::unrounded::radiances;

/// A pixel is off when a linear channel is farther than this from the exact one.
const OFF: f64 = 0.03;
/// A pixel whose exact colour changes by more than that so near its centre, in pixels, is not judged.
const NEAR: f64 = 1e-3;

pub const SIZE: (u32, u32) = (48, 36);

/// By the road that the command line takes. Warnings are allowed, errors are not.
pub fn compiled(text: &str) -> (World, Origins) {
    let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
    let compiled = road.compile("hard.scene", text.as_bytes().to_vec());
    assert!(!road.diagnostics.has_errors(), "{text}\n{:#?}", road.diagnostics);
    compiled
}

/// One ray through the centre of each pixel.
pub fn rendered(text: &str, (width, height): (u32, u32)) -> Film {
    let (world, origins) = compiled(text);
    let frame = Frame::whole(width, height);
    let options = PlanOptions { antialias: Antialias::Off, ..PlanOptions::new(frame) };
    let plan = plan(&world, &origins, &options);
    trace(&world, &plan, &TraceOptions::on_threads(1), &Unwatched).film
}

/// The radiance of each pixel of such a picture, before its film rounds it.
pub fn unrounded(text: &str, (width, height): (u32, u32)) -> Vec<Rgb> {
    let (world, origins) = compiled(text);
    let frame = Frame::whole(width, height);
    let options = PlanOptions { antialias: Antialias::Off, ..PlanOptions::new(frame) };
    let plan = plan(&world, &origins, &options);
    radiances(&world, &plan, &TraceOptions::on_threads(1))
}

/// Asserts that no pixel of the scene's picture is bad.
#[track_caller]
pub fn hold(name: &str, scene: &Scene) {
    hold_sized(name, scene, SIZE);
}

/// As [`hold`], in a given size.
#[track_caller]
pub fn hold_sized(name: &str, scene: &Scene, size: (u32, u32)) {
    Truth::of(scene, size).hold(name, &scene.text());
}

/// As [`hold_sized`], of a checker to its horizon, near which a pixel in four may change too fast to be judged.
#[track_caller]
pub fn hold_horizon(name: &str, scene: &Scene, size: (u32, u32)) {
    Truth::of(scene, size).hold_judged(name, &scene.text(), 4);
}

/// What is seen at a pixel and is not what is there.
#[derive(Debug)]
#[allow(dead_code, reason = "to be printed")]
pub struct Bad {
    place: (u32, u32),
    seen: Rgb,
    expected: Triple,
}

/// How a picture compares with the exact one.
pub struct Held {
    pub bad: Vec<Bad>,
    pub unjudged: u32,
    /// So many pixels are not the background.
    pub shown: u32,
}

/// The exact picture of a scene.
pub struct Truth<'a> {
    exact: Exact<'a>,
    size: (u32, u32),
    /// In rows from the top.
    pixels: Vec<Triple>,
    /// So many are not the background.
    shown: u32,
}

impl<'a> Truth<'a> {
    pub fn of(scene: &'a Scene, (width, height): (u32, u32)) -> Self {
        let exact = Exact::new(scene);
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let center = |(x, y)| (f64::from(x) + 0.5, f64::from(y) + 0.5);
        let pixels: Vec<Triple> =
            places.map(center).map(|(x, y)| exact.at(x, y, width, height)).collect();
        let is_shown = |&&pixel: &&Triple| apart(pixel, scene.background) > OFF;
        let shown = pixels.iter().filter(is_shown).count() as u32;
        Self { exact, size: (width, height), pixels, shown }
    }

    /// Asserts that no pixel of the picture of a text that is to show the scene is bad.
    #[track_caller]
    pub fn hold(&self, name: &str, text: &str) {
        self.hold_judged(name, text, 25);
    }

    /// No more than a pixel in so many may be left unjudged: a picture that is nowhere judged proves nothing.
    #[track_caller]
    fn hold_judged(&self, name: &str, text: &str, in_so_many: u32) {
        let Held { mut bad, unjudged, shown } = self.held(text);
        assert!(shown > 0, "{name}: nothing but the background is to be seen");
        let count = bad.len();
        bad.truncate(6);
        assert!(count == 0, "{name}: {count} bad pixels, {unjudged} not judged: {bad:?}\n{text}");
        let few = in_so_many * unjudged <= self.size.0 * self.size.1;
        assert!(few, "{name}: {unjudged} pixels are not judged\n{text}");
    }

    /// Renders such a text, and compares it.
    pub fn held(&self, text: &str) -> Held {
        let film = rendered(text, self.size);
        let mut held = Held { bad: Vec::new(), unjudged: 0, shown: self.shown };
        let (width, height) = self.size;
        for y in 0..height {
            for x in 0..width {
                let place = film.index(x, y);
                let (seen, expected) = (film.radiance(place), self.pixels[place]);
                if apart(components(seen), expected) <= OFF {
                    continue;
                }
                if changes_near(&self.exact, (x, y), self.size) {
                    held.unjudged += 1;
                } else {
                    held.bad.push(Bad { place: (x, y), seen, expected });
                }
            }
        }
        held
    }
}

/// Whether the exact picture changes so near the centre of a pixel that it is not judged.
pub fn changes_near(exact: &Exact, (x, y): (u32, u32), (width, height): (u32, u32)) -> bool {
    let at = |dx: f64, dy: f64| {
        exact.at(f64::from(x) + 0.5 + dx, f64::from(y) + 0.5 + dy, width, height)
    };
    let expected = at(0.0, 0.0);
    ring().any(|(dx, dy)| apart(at(dx, dy), expected) > OFF)
}

/// Sixteen places around a pixel's centre.
fn ring() -> impl Iterator<Item = (f64, f64)> {
    (0..8).flat_map(|eighth| {
        let (sine, cosine) = lucarne::math::elementary::sin_cos_degrees(45.0 * f64::from(eighth));
        [(NEAR * cosine, NEAR * sine), (0.5 * NEAR * cosine, 0.5 * NEAR * sine)]
    })
}

fn components(color: Rgb) -> Triple {
    color.components()
}

/// The largest difference of what a display can show; no number is as far from all others as can
/// be.
pub fn apart(a: Triple, b: Triple) -> f64 {
    let shown = |c: f64| c.clamp(0.0, 1.0);
    let off = |(a, b): (f64, f64)| if a.is_nan() { 1.0 } else { (shown(a) - shown(b)).abs() };
    a.into_iter().zip(b).map(off).fold(0.0, f64::max)
}
