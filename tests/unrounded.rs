//! The radiance of each pixel before a film rounds it, for tests of what holds beyond its precision.

use lucarne::color::Rgb;
use lucarne::plan::{Antialias, Plan};
use lucarne::trace::{Sampling, TraceOptions, Unwatched, aims, geometry, pixels, trace};
use lucarne::world::World;

/// Traces a picture, row by row. Only that of adaptive antialiasing comes from a film.
pub fn radiances(world: &World, plan: &Plan, options: &TraceOptions) -> Vec<Rgb> {
    let side = match plan.antialias {
        Antialias::Off => 1,
        Antialias::Grid(side) => side,
        Antialias::Adaptive { .. } => {
            return trace(world, plan, options, &Unwatched).film.radiances().collect();
        }
    };
    let places: Vec<_> = plan.frame.region.places().collect();
    let aims = aims(&places, Sampling::Planned);
    let (seen, _) =
        pixels(world, &geometry(world, plan, options), plan, &aims, options, &Unwatched);
    let count = f64::from(side * side);
    seen.into_iter()
        .map(|seen| seen.expect("not stopped").sum.radiance.map(|c| c / count))
        .collect()
}
