//! Suggestions for other tools' keywords that have no single equivalent: `intensity 3` in a light, `far 100`
//! in a camera, `ellipsoid { … }`.

use crate::diagnostic::suggest;
use crate::vocabulary::{Family, Word};

use super::Place;

/// Returns whether the block that another tool calls `theirs` has different parts than ours: four corners are
/// too many for a triangle.
pub(super) fn has_other_parts(theirs: &str, word: Word) -> bool {
    use Word as W;
    let is_listed = matches!(
        word,
        W::Triangle
            | W::Polygon
            | W::Cone
            | W::Mesh
            | W::Prism
            | W::Lathe
            | W::SphereSweep
            | W::Disc
    );
    is_listed && suggest::closest(theirs, [word.name()]).is_none()
}

/// Returns the advice for a keyword without a single equivalent: `intensity 3` in a light, `far 100` in a
/// camera.
pub(super) fn custom(name: &str, place: Place) -> Option<&'static str> {
    let name = name.to_lowercase();
    if matches!(name.as_str(), "hsv" | "hsl") {
        return Some(
            "`CHSV2RGB(<hue, saturation, value>)` of `colors.inc` makes a colour of these",
        );
    }
    let is_solid = place.families.contains(&Family::Shape);
    match name.as_str() {
        "circle" if is_solid => {
            return Some("a disc has a normal, too: `disc { <centre>, <normal>, radius }`");
        }
        "line" if is_solid => {
            return Some("a thin cylinder is one: `cylinder { <0, 0, 0>, <1, 1, 1>, 0.02 }`");
        }
        _ => {}
    }
    match (place.word?, name.as_str()) {
        (_, "mirror" | "flip") => Some("scaled by -1 a thing is mirrored: `scale <-1, 1, 1>`"),
        (Word::LightSource, "intensity" | "energy" | "power" | "strength" | "brightness") => {
            Some("a light is as strong as its colour: `rgb 2` is twice `rgb 1`")
        }
        (Word::LightSource, "angle" | "cone_angle" | "cone") => {
            Some("`radius 15 falloff 20` is how wide a spotlight shines, in degrees from its axis")
        }
        (Word::LightSource, "attenuation" | "decay") => {
            Some("light fades with the distance by `fade_distance` and `fade_power`")
        }
        (Word::LightSource, "shadows" | "shadow") => {
            Some("a light that throws no shadows is `shadowless`, without a value")
        }
        (Word::Camera, "width" | "height" | "size" | "resolution") => Some(
            "`--size 640x480` says how large the picture is, \
             `right x*image_width/image_height` how wide for its height",
        ),
        (Word::Camera, "aspect" | "aspect_ratio") => {
            Some("the picture's width and height give its shape, or `right` does")
        }
        (Word::Camera, "near" | "far" | "znear" | "zfar" | "clip_start" | "clip_end") => {
            Some("a camera sees what is before it at any distance: leave this out")
        }
        (Word::Camera, "lens" | "focal" | "focal_length" | "zoom") => {
            Some("`angle` gives the field of view, in degrees")
        }
        _ => None,
    }
}

/// Returns whether no word of `place` is the equivalent of a name, whatever resembles it.
pub(super) fn has_no_word(name: &str, place: Place) -> bool {
    place.word == Some(Word::Camera) && matches!(name, "height" | "size" | "resolution")
}
