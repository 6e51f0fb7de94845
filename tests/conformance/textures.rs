//! Textures drawn at random look as POV-Ray 3.7 shows them.
//!
//! What is not drawn, as POV-Ray 3.7 is at fault (measured at 64×48, of 3072 pixels):
//!
//! * `aoi` and `slope` in a blend of textures, whose entry has a normal. There the angle depends on how the
//!   object is turned: `gradient y texture_map { [0 pigment { aoi }] }` on a sphere is the same turned by
//!   `<47, -49, -56>` and not; with `normal { wood 0.0001 }` in the entry, turning changes 919 pixels, which is
//!   all of the sphere.
//! * `conserve_energy` with a picture shown `once`. Outside of the picture, the light seen through is not
//!   reduced: a mirror of 0.2 over a background of <0.8, 0.6, 0.4> shows 245, 185, 123, and the same with
//!   `rgbt 1` shows 205, 154, 102.
//! * `fresnel` without an `ior`, over a normal: where the normal leans away from the viewer, the quotient has
//!   no value; 160 pixels of a sphere differ, and none with `ior 1.4`.
//! * `filter all` or `transmit all` of a picture with alpha: both together exceed 1, so what the surface
//!   itself shows is less than nothing, and a reflection's `exponent` has no value for that; 714 pixels of a
//!   sphere differ, and none of a picture without alpha.
//! * A second `noise_generator` in a pigment, also after the default's: the bits of both numbers count
//!   together, so `noise_generator 2 noise_generator 1` is 3.
//!
//! Nor are these drawn, which have tests of their own: `crand`, `interior_texture`, `cutaway_textures`, `texture_list`,
//! textures of the parts of a blob, `dispersion`, `fade_distance`, `gamma` and `premultiplied` of a picture, and
//! `tiling 1`, whose number a negative amount would make a difference.
//!
//! Nor is `interpolate` drawn for a `material_map`, where lucarne interpolates the numbers of textures in
//! another way.

mod pattern;
mod scene;
mod surface;

pub use surface::{DEEPEST, finish, normal, pigment};

use super::drawn::{Kind, difference, hold, repeat};

const KIND: Kind = Kind { name: "textures", count: 12, scene: scene::scene, difference };

#[test]
fn textures_drawn_at_random_look_the_same() {
    hold(&KIND);
}

#[test]
fn a_number_draws_the_same_scene_again() {
    repeat(&KIND);
}
