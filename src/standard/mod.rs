//! The standard includes, in our own words: for those who have not installed POV-Ray's.
//!
//! **In:** a file's name. **Out:** its text. **Invariant:** a name means what it means in POV-Ray's include of
//! that name, and reading one gives no message. One text declares no more than an author would look for in it;
//! where a pattern is not built yet, what needs it is poison, as anywhere.
//!
//! **Source:** POV-Ray 3.7 manual, section 3.4.9 "Include Files"; numbers (of colours, of metals) are the
//! program's, measured.

macro_rules! texts {
    ($($name:literal),* $(,)?) => {
        /// Every include there is: its name, and what it says.
        pub const TEXTS: &[(&str, &str)] = &[$(($name, include_str!($name))),*];
    };
}

texts![
    "arrays.inc",
    "colors.inc",
    "consts.inc",
    "debug.inc",
    "finish.inc",
    "functions.inc",
    "glass.inc",
    "golds.inc",
    "math.inc",
    "metals.inc",
    "rand.inc",
    "shapes.inc",
    "shapes2.inc",
    "shapes_old.inc",
    "skies.inc",
    "stars.inc",
    "stdinc.inc",
    "stoneold.inc",
    "stones.inc",
    "stones1.inc",
    "stones2.inc",
    "strings.inc",
    "textures.inc",
    "transforms.inc",
    "woodmaps.inc",
    "woods.inc",
];

/// What messages and `check --where` call them: no file has such a name.
const PLACE: &str = "embedded:";

/// The name and text of an include.
pub fn include(name: &str) -> Option<(String, &'static str)> {
    let (name, text) = TEXTS.iter().find(|(known, _)| *known == name)?;
    Some((format!("{PLACE}{name}"), text))
}

/// What a text of our own that is no include is called.
pub fn place_of(name: &str) -> String {
    format!("{PLACE}{name}")
}

/// The include that a source of this name is, if it is one of these.
pub fn embedded_name(source: &str) -> Option<&str> {
    source.strip_prefix(PLACE)
}
