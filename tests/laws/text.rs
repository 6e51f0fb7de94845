//! From a text to its World and to its Film, without a mistake on the way.

use lucarne::color::Rgb;
use lucarne::plan::{Antialias, Frame, Plan, PlanOptions, Region, plan};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::{FileError, Files, Found};
use lucarne::trace::{TraceOptions, Unwatched, trace};
use lucarne::world::{Origins, World};

use crate::unrounded::radiances;

/// Traces a World by its Plan.
type Traced = fn(&World, &Plan, &TraceOptions) -> Vec<Rgb>;

/// Files to include, by name.
struct Shelf<'a>(&'a [(&'a str, &'a str)]);

impl Files for Shelf<'_> {
    fn read(&self, name: &str, _: &str) -> Result<Found, FileError> {
        let missing = FileError::NotFound { searched: Vec::new(), similar: Vec::new() };
        let (name, text) = self.0.iter().find(|(n, _)| *n == name).ok_or(missing)?;
        Ok(Found { name: (*name).to_owned(), bytes: text.as_bytes().to_vec() })
    }
}

pub fn compiled(text: &str, includes: &[(&str, &str)]) -> (World, Origins) {
    let shelf = Shelf(includes);
    let mut road = Road::new(&shelf, Options::new(Dialect::Scene));
    let compiled = road.compile("law.scene", text.as_bytes().to_vec());
    assert!(!road.diagnostics.has_errors(), "{text}\n{:#?}", road.diagnostics);
    compiled
}

/// How a film is made.
#[derive(Clone, Copy)]
pub struct Shot {
    pub frame: Frame,
    pub antialias: Antialias,
    pub threads: usize,
}

impl Shot {
    pub fn new(width: u32, height: u32) -> Self {
        Self { frame: Frame::whole(width, height), antialias: Antialias::Off, threads: 1 }
    }

    pub fn region(mut self, region: Region) -> Self {
        self.frame.region = region;
        self
    }

    /// Radiance on the film, row by row.
    pub fn of(self, text: &str) -> Vec<Rgb> {
        self.by(text, |world, plan, options| {
            trace(world, plan, options, &Unwatched).film.radiances().collect()
        })
    }

    /// Radiance before a film rounds it.
    pub fn unrounded(self, text: &str) -> Vec<Rgb> {
        self.by(text, radiances)
    }

    fn by(self, text: &str, traced: Traced) -> Vec<Rgb> {
        let (world, origins) = compiled(text, &[]);
        let Self { frame, antialias, threads } = self;
        let plan = plan(&world, &origins, &PlanOptions { antialias, ..PlanOptions::new(frame) });
        traced(&world, &plan, &TraceOptions::on_threads(threads))
    }
}

/// The largest difference of any component; NaN counts as infinitely far.
pub fn apart(a: &[Rgb], b: &[Rgb]) -> f64 {
    assert_eq!(a.len(), b.len());
    let components = |film: &[Rgb]| film.iter().flat_map(|c| c.components()).collect::<Vec<_>>();
    components(a)
        .into_iter()
        .zip(components(b))
        .map(|(a, b)| if a.is_nan() || b.is_nan() { f64::INFINITY } else { (a - b).abs() })
        .fold(0.0, f64::max)
}
