//! What alpha is, and what a picture with it is over its background.

use lucarne::film::{Channels, Film};
use lucarne::plan::{Antialias, Frame, PlanOptions, plan};
use lucarne::trace::{TraceOptions, Unwatched, trace};

use super::text::compiled;

const CAMERA: &str = "camera { location <0, 1, 6> look_at 0 } light_source { <3, 5, 4>, rgb 0.7 }";

/// Nothing in it tints what is seen through it, and mirrors show the background.
const GREY: &str = "
    sphere { <-1.5, 0, 0>, 1 pigment { rgbt <0.9, 0.3, 0.2, 0.6> } finish { phong 0.3 } }
    sphere { <1.5, 0, 0>, 1 pigment { rgbf <0.8, 0.8, 0.8, 0.9> } interior { ior 1.5 }
      finish { reflection { 0, 1 fresnel } conserve_energy } }
    box { <-0.6, 0.5, -2>, <0.6, 1.5, 2> pigment { rgb <0.2, 0.3, 0.4> } finish { reflection 0.3 } }
    torus { 0.8, 0.2 translate <0, -1, 1> pigment { rgbft <1, 1, 1, 0.3, 0.2> } }
    fog { distance 20 color rgbt <0.1, 0.2, 0.1, 0.3> }";

fn film(text: &str, antialias: Antialias, alpha: bool) -> Film {
    let (world, origins) = compiled(text, &[]);
    let frame = Frame::whole(40, 30);
    let options = PlanOptions { antialias, alpha, ..PlanOptions::new(frame) };
    let plan = plan(&world, &origins, &options);
    trace(&world, &plan, &TraceOptions::on_threads(1), &Unwatched).film
}

/// The largest difference between a picture without alpha and one with it over its background.
fn off(plain: &Film, clear: &Film, background: [f64; 3]) -> f64 {
    let over = clear.pixels.iter().map(|pixel| {
        let behind = background.map(|c| c * (1.0 - pixel.opacity()));
        let parts = pixel.radiance().components().into_iter().zip(behind);
        parts.map(|(c, behind)| c + behind).collect::<Vec<_>>()
    });
    let pairs = over.zip(plain.radiances()).flat_map(|(over, plain)| {
        over.into_iter().zip(plain.components()).map(|(a, b)| (a - b).abs())
    });
    pairs.fold(0.0, f64::max)
}

#[test]
fn alpha_is_one_on_what_is_opaque_none_where_nothing_is_and_between_at_edges() {
    let ball = format!("{CAMERA} sphere {{ 0, 1 pigment {{ rgb 0 }} finish {{ ambient 0 }} }}");
    for antialias in [Antialias::Off, Antialias::Grid(3), Antialias::default()] {
        let film = film(&ball, antialias, true);
        assert_eq!(film.channels, Channels::Rgba);
        let at = |x, y| film.pixels[film.index(x, y)].opacity();
        assert_eq!((at(20, 15), at(0, 0)), (1.0, 0.0));
        let between = film.pixels.iter().filter(|one| (0.01..0.99).contains(&one.opacity()));
        // A black ball before nothing: only its alpha has an edge.
        assert_eq!(between.count() > 10, antialias != Antialias::Off);
    }
    let before = format!("{ball} background {{ rgb <0.2, 0.3, 0.4> }}");
    assert!(film(&before, Antialias::Off, true).pixels.iter().all(|one| one.opacity() == 1.0));
    let plain = film(&ball, Antialias::Off, false);
    assert!(plain.channels == Channels::Rgb && plain.pixels.iter().all(|one| one.opacity() == 1.0));
}

#[test]
fn a_picture_with_alpha_over_its_background_is_that_without() {
    let background = [0.3, 0.5, 0.7];
    let [red, green, blue] = background;
    let behind = |transmit: f64| {
        format!("{CAMERA} {GREY} background {{ rgbt <{red}, {green}, {blue}, {transmit}> }}")
    };
    for antialias in [Antialias::Off, Antialias::Grid(2)] {
        let plain = film(&behind(0.0), antialias, false);
        let clear = film(&behind(1.0), antialias, true);
        assert!(clear.pixels.iter().any(|one| one.opacity() == 1.0));
        assert!(clear.pixels.iter().any(|one| one.opacity() < 0.8));
        // Alpha has 16 bits.
        let least = 1e-5;
        assert!(off(&plain, &clear, background) < least);
        // Planted: a ball that is a little clearer.
        let faulty = behind(1.0).replace("0.2, 0.6>", "0.2, 0.601>");
        assert_ne!(faulty, behind(1.0));
        assert!(off(&plain, &film(&faulty, antialias, true), background) > least);
    }
}

#[test]
fn an_opaque_background_makes_the_picture_without_alpha() {
    let text = format!("{CAMERA} {GREY} background {{ rgb <0.3, 0.5, 0.7> }}");
    let [plain, clear] = [false, true].map(|alpha| film(&text, Antialias::default(), alpha));
    assert!(clear.pixels.iter().all(|one| one.opacity() == 1.0));
    assert_eq!(plain.pixels, clear.pixels);
}
