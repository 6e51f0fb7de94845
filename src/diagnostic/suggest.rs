//! Did you mean: the nearest known word, and ours for another tool's.
//!
//! **Invariant:** a suggestion is made only when it is likely right, and does not depend on the order
//! of the candidates.

use std::borrow::Cow;

#[cfg(test)]
thread_local! {
    /// How often this thread has looked for a closest word.
    pub static SEARCHES: std::cell::Cell<u64> = const { std::cell::Cell::new(0) };
}

/// The candidate that `word` was most likely meant to be.
///
/// The same letters in another case come first; then the least optimal-string-alignment distance
/// (insertion, deletion, substitution and transposition of neighbours count one each), up to a
/// bound that grows with the word: 1 for three letters, 2 from six, 3 from ten. Shorter and very
/// long words are only matched case-blind.
pub fn closest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    #[cfg(test)]
    SEARCHES.with(|searches| searches.set(searches.get() + 1));
    let lower = word.to_lowercase();
    let (count, set) = letters(&lower);
    let spelled = spelling(&lower);
    let bound = match count {
        0..3 => 0,
        3..6 => 1,
        6..10 => 2,
        10..=64 => 3,
        _ => 0,
    };
    candidates
        .into_iter()
        .filter(|candidate| *candidate != word)
        .filter_map(|candidate| {
            // One edit changes the length by one at most, and the set of letters by two.
            let (other_count, other_set) = letters(candidate);
            let far = other_count.abs_diff(count) > bound
                || (other_set ^ set).count_ones() as usize > 2 * bound;
            // Another spelling of it changes no more than this.
            let respelt = other_count.abs_diff(count) <= 2 && (other_set ^ set).count_ones() <= 4;
            let other = (!far || respelt).then(|| candidate.to_lowercase())?;
            let distance = match other == lower || (respelt && spelling(&other) == spelled) {
                true => 0,
                false if far => return None,
                false => strsim::osa_distance(&lower, &other).max(1),
            };
            // Of two equally near, the one with the same first letter, then the alphabet's first.
            let first = lower.chars().next() != other.chars().next();
            (distance <= bound).then_some((distance, first, candidate))
        })
        .min()
        .map(|(_, _, candidate)| candidate)
}

/// Whether two names differ only in the number or the capital that tells the members of a series apart:
/// `Ball1` and `Ball2`, `RadiusA` and `RadiusB`. One is rarely meant where the other is written.
pub fn are_of_a_series(a: &str, b: &str) -> bool {
    let digits = |name: &str| name.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let letter = |name: &str| {
        let stem = name.strip_suffix(|c: char| c.is_ascii_alphabetic())?;
        let capital = name.ends_with(|c: char| c.is_ascii_uppercase());
        let apart = stem.ends_with(|c: char| c == '_' || c.is_ascii_digit())
            || (capital && stem.ends_with(|c: char| c.is_ascii_lowercase()));
        apart.then_some(stem.len())
    };
    let stems = |a: usize, b: usize| a == b && a > 0;
    let same = |length: usize| a.get(..length) == b.get(..length);
    let numbered = stems(digits(a), digits(b)) && same(digits(a));
    let lettered = match (letter(a), letter(b)) {
        (Some(of_a), Some(of_b)) => of_a == of_b && same(of_a),
        _ => false,
    };
    a != b && (numbered || (lettered && !a.eq_ignore_ascii_case(b)))
}

/// A word in lower case as it is spelt in America, its numbers without zeros before them: `Grey5` and
/// `Gray05` are one.
fn spelling(word: &str) -> Cow<'_, str> {
    let mut spelt = Cow::Borrowed(word);
    for (theirs, ours) in [("grey", "gray"), ("colour", "color"), ("centre", "center")] {
        if spelt.contains(theirs) {
            spelt = Cow::Owned(spelt.replace(theirs, ours));
        }
    }
    if !spelt.contains('0') {
        return spelt;
    }
    let mut plain = String::with_capacity(spelt.len());
    let mut rest = spelt.chars().peekable();
    while let Some(c) = rest.next() {
        let leads = c == '0' && !plain.ends_with(|last: char| last.is_ascii_digit());
        if !(leads && rest.peek().is_some_and(char::is_ascii_digit)) {
            plain.push(c);
        }
    }
    Cow::Owned(plain)
}

/// How many letters a word has in lower case, and which (one bit for each, some sharing one).
fn letters(word: &str) -> (usize, u32) {
    if word.is_ascii() {
        // The low five bits of a letter do not know its case.
        return (word.len(), word.bytes().fold(0, |set, b| set | 1 << (b % 32)));
    }
    word.chars()
        .flat_map(char::to_lowercase)
        .fold((0, 0), |(count, set), c| (count + 1, set | 1 << (c as u32 % 32)))
}

/// Our words for `word` as other tools, or people, call the same thing; the likeliest first. Which it is
/// depends on the place.
pub fn foreign(word: &str) -> impl Iterator<Item = &'static str> {
    let lower = word.to_lowercase();
    FOREIGN.iter().filter(move |(theirs, _)| *theirs == lower).map(|&(_, ours)| ours)
}

/// Other tools' words, in lower case, and ours.
const FOREIGN: &[(&str, &str)] = &[
    // shapes
    ("ball", "sphere"),
    ("orb", "sphere"),
    ("globe", "sphere"),
    ("uv_sphere", "sphere"),
    ("uvsphere", "sphere"),
    ("ico_sphere", "sphere"),
    ("cube", "box"),
    ("cuboid", "box"),
    ("block", "box"),
    ("ground", "plane"),
    ("group", "union"),
    ("add", "union"),
    ("subtract", "difference"),
    ("subtraction", "difference"),
    ("minus", "difference"),
    ("intersect", "intersection"),
    ("tube", "cylinder"),
    ("capsule", "sphere_sweep"),
    ("donut", "torus"),
    ("doughnut", "torus"),
    ("ring", "torus"),
    ("metaball", "blob"),
    ("metaballs", "blob"),
    ("heightmap", "height_field"),
    ("heightfield", "height_field"),
    ("terrain", "height_field"),
    ("revolve", "lathe"),
    ("rotate_extrude", "lathe"),
    ("extrude", "prism"),
    ("linear_extrude", "prism"),
    ("quad", "triangle"),
    ("face", "triangle"),
    ("facet", "triangle"),
    ("tri", "triangle"),
    ("vertices", "vertex_vectors"),
    ("verts", "vertex_vectors"),
    ("vertexes", "vertex_vectors"),
    ("faces", "face_indices"),
    ("indices", "face_indices"),
    ("triangles", "face_indices"),
    ("normals", "normal_vectors"),
    ("uvs", "uv_vectors"),
    ("texcoords", "uv_vectors"),
    // lights
    ("light", "light_source"),
    ("lamp", "light_source"),
    ("pointlight", "light_source"),
    ("point_light", "light_source"),
    ("spot", "spotlight"),
    ("spot_light", "spotlight"),
    ("spotlite", "spotlight"),
    ("arealight", "area_light"),
    ("sun", "light_source"),
    ("directional", "parallel"),
    ("directionallight", "parallel"),
    ("target", "point_at"),
    ("target", "look_at"),
    // cameras
    ("fov", "angle"),
    ("field_of_view", "angle"),
    ("position", "location"),
    ("position", "translate"),
    ("eye", "location"),
    ("pos", "location"),
    ("look_from", "location"),
    ("lookfrom", "location"),
    ("lookat", "look_at"),
    ("lookat", "point_at"),
    ("look_to", "look_at"),
    ("vup", "sky"),
    ("ortho", "orthographic"),
    // surfaces
    ("diffuse_color", "pigment"),
    ("albedo", "pigment"),
    ("base_color", "pigment"),
    ("basecolor", "pigment"),
    ("paint", "pigment"),
    ("surface", "finish"),
    ("shader", "finish"),
    ("bsdf", "finish"),
    ("lambert", "diffuse"),
    ("specularity", "specular"),
    ("gloss", "specular"),
    ("glossiness", "specular"),
    ("glossy", "specular"),
    ("shiny", "specular"),
    ("shininess", "phong_size"),
    ("phong_exp", "phong_size"),
    ("emissive", "emission"),
    ("emit", "emission"),
    ("glow", "emission"),
    ("mirror", "reflection"),
    ("reflect", "reflection"),
    ("reflectivity", "reflection"),
    ("reflective", "reflection"),
    ("metalness", "metallic"),
    ("metal", "metallic"),
    ("opacity", "transmit"),
    ("alpha", "transmit"),
    ("transparency", "transmit"),
    ("transparent", "transmit"),
    ("refraction", "ior"),
    ("refractive_index", "ior"),
    ("index_of_refraction", "ior"),
    ("bump", "bumps"),
    ("checkerboard", "checker"),
    ("chessboard", "checker"),
    ("ramp", "color_map"),
    ("color_ramp", "color_map"),
    ("colorramp", "color_map"),
    ("palette", "color_map"),
    ("image", "image_map"),
    ("bitmap", "image_map"),
    // files of pictures
    ("jpg", "jpeg"),
    ("tif", "tiff"),
    // the sky
    ("skybox", "sky_sphere"),
    ("skydome", "sky_sphere"),
    ("sky_dome", "sky_sphere"),
    ("environment", "sky_sphere"),
    ("envmap", "sky_sphere"),
    ("background_color", "background"),
    // transforms
    ("move", "translate"),
    ("translation", "translate"),
    ("rotation", "rotate"),
    ("rotatex", "rotate"),
    ("rotate_x", "rotate"),
    ("rotatey", "rotate"),
    ("rotate_y", "rotate"),
    ("rotatez", "rotate"),
    ("rotate_z", "rotate"),
    ("rot", "rotate"),
    ("turn", "rotate"),
    ("resize", "scale"),
    ("size", "scale"),
    ("scaling", "scale"),
    ("scl", "scale"),
    // directives and functions
    ("define", "declare"),
    ("let", "declare"),
    ("var", "declare"),
    ("set", "declare"),
    ("import", "include"),
    ("use", "include"),
    ("load", "include"),
    ("def", "macro"),
    ("module", "macro"),
    ("elif", "elseif"),
    ("elsif", "elseif"),
    ("endif", "end"),
    ("print", "debug"),
    ("echo", "debug"),
    ("loop", "while"),
    ("repeat", "for"),
    ("arccos", "acos"),
    ("arcsin", "asin"),
    ("arctan", "atan2"),
    ("atan", "atan2"),
    ("cross", "vcross"),
    ("dot", "vdot"),
    ("length", "vlength"),
    ("norm", "vlength"),
    ("normalize", "vnormalize"),
    ("round", "int"),
    ("random", "rand"),
    ("trunc", "int"),
    ("ceiling", "ceil"),
    ("fabs", "abs"),
    ("absolute", "abs"),
    ("rad", "radians"),
    ("deg", "degrees"),
    ("deg2rad", "radians"),
    ("rad2deg", "degrees"),
    ("substring", "substr"),
    ("upper", "strupr"),
    ("toupper", "strupr"),
    ("lower", "strlwr"),
    ("tolower", "strlwr"),
    ("tostring", "str"),
    ("parsefloat", "val"),
    ("atof", "val"),
    ("fmod", "mod"),
    ("power", "pow"),
];

#[cfg(test)]
mod tests {
    use super::*;

    const WORDS: &[&str] =
        &["sphere", "box", "pigment", "finish", "color_map", "translate", "rotate", "red", "rgb"];

    fn near(word: &str) -> Option<&'static str> {
        closest(word, WORDS.iter().copied())
    }

    #[test]
    fn a_word_in_the_wrong_case_is_known_however_short() {
        assert_eq!(near("BOX"), Some("box"));
        assert_eq!(closest("X", ["x", "y"]), Some("x"));
    }

    #[test]
    fn a_slip_of_the_keyboard_is_known() {
        assert_eq!(near("pigmnet"), Some("pigment"));
        assert_eq!(near("shpere"), Some("sphere"));
        assert_eq!(near("colour_map"), Some("color_map"));
        assert_eq!(near("colormap"), Some("color_map"));
        assert_eq!(near("bxo"), Some("box"));
    }

    #[test]
    fn another_spelling_of_a_word_is_nearer_than_a_slip() {
        let grays = ["Grey", "Gray05", "Gray10", "Gray50", "Gray15"];
        assert_eq!(closest("Grey5", grays), Some("Gray05"));
        assert_eq!(closest("Grey50", grays), Some("Gray50"));
        assert_eq!(closest("LightColour", ["LightColor", "LightColours"]), Some("LightColor"));
        assert_eq!(closest("A0", ["A00", "A10"]), Some("A00"));
    }

    #[test]
    fn a_word_that_resembles_nothing_gets_no_hint() {
        assert_eq!(near("wood"), None);
        assert_eq!(near("xy"), None);
        assert_eq!(near("bax1"), None);
        assert_eq!(near(""), None);
        assert_eq!(near(&"pigment".repeat(1000)), None);
    }

    #[test]
    fn members_of_a_series_are_told_from_slips() {
        for (a, b) in
            [("Ball1", "Ball2"), ("Ball", "Ball1"), ("RadiusA", "RadiusB"), ("p_a", "p_b")]
        {
            assert!(are_of_a_series(a, b) && are_of_a_series(b, a), "{a} {b}");
        }
        for (a, b) in
            [("Ball", "Bal"), ("Radius", "Radiuz"), ("RED", "REC"), ("RadiusA", "Radiusa")]
        {
            assert!(!are_of_a_series(a, b), "{a} {b}");
        }
    }

    #[test]
    fn the_order_of_candidates_does_not_matter() {
        assert_eq!(closest("cat", ["bat", "car"]), Some("car"));
        assert_eq!(closest("cat", ["car", "bat"]), Some("car"));
        assert_eq!(closest("cat", ["cap", "can"]), Some("can"));
    }

    #[test]
    fn other_tools_words_are_known_in_any_case() {
        assert!(foreign("Cube").eq(["box"]));
        assert!(foreign("shininess").eq(["phong_size"]));
        assert!(foreign("target").eq(["point_at", "look_at"]));
        assert_eq!(foreign("sphere").next(), None);
    }

    #[test]
    fn each_pair_of_a_foreign_word_and_ours_stands_once() {
        for (at, pair @ (word, ours)) in FOREIGN.iter().enumerate() {
            assert_ne!(word, ours);
            assert_eq!(FOREIGN.iter().position(|other| other == pair), Some(at), "{word}");
        }
    }
}
