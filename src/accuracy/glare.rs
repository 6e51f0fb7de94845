//! Light so far beyond white that what shows it is seen in less of a pixel than a sample has.
//!
//! **Invariant:** what no sample met is in no error that samples tell; where that may be much, it is said.

use crate::world::World;

/// In whites: from here on a sliver of a thirtieth of a pixel makes all of it white.
const GLARING: f64 = 30.0;

/// How many times white the brightest light or glow is, where that is so much that it may hide between
/// samples. A light that fades is as bright as it is where it shines, which is not known.
pub fn glare(world: &World) -> Option<f64> {
    let lights = world
        .lights
        .iter()
        .filter(|light| light.attenuation.is_none_or(|less| less.fade.is_none()))
        .map(|light| light.color.largest());
    let glows = world.materials.iter().flat_map(|material| {
        let glow = material.finish.glow;
        material.pigment.colors().map(move |color| (color.rgb * glow).largest())
    });
    let brightest = lights.chain(glows).fold(0.0, f64::max);
    (brightest >= GLARING).then_some(brightest)
}
