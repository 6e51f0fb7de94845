//! Detects lights so bright that they matter even in a fraction of a pixel that falls between samples.
//!
//! **Invariant:** features that no sample hits do not appear in the estimated error; if they may be
//! significant, a note says so.

use crate::world::World;

/// Brightness in units of white from which a sliver of a thirtieth of a pixel makes all of it white.
const GLARING: f64 = 30.0;

/// Returns the brightness of the brightest light or emission in units of white, if it is high enough to
/// matter between samples. Lights that fade are excluded, because their brightness depends on the distance.
pub fn glare(world: &World) -> Option<f64> {
    let lights = world
        .lights
        .iter()
        .filter(|light| light.attenuation.is_none_or(|less| less.fade.is_none()))
        .map(|light| light.color.largest());
    let plains = world.textures.iter().flat_map(|texture| texture.plains());
    let emissions = plains.flat_map(|plain| {
        let emission = plain.finish.emission;
        plain.pigment.colors().into_iter().map(move |color| (color.rgb * emission).largest())
    });
    let brightest = lights.chain(emissions).fold(0.0, f64::max);
    (brightest >= GLARING).then_some(brightest)
}
