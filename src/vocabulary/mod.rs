//! Every word of the language: its family, its role, and one sentence about it.
//!
//! **In:** nothing. **Out:** [`Word`], a closed enum, and what is known of each.
//! **Invariant:** a spelling names one word. Contextual words are words only directly inside their
//! block; everywhere else they are free as names.

/// How the main file's kind sets defaults; `docs/language.md` has the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dialect {
    /// `.scene`: right-handed frame, lints on, the seed's own words.
    #[default]
    Scene,
    /// `.pov`: POV-Ray's left-handed frame and defaults.
    Pov,
}

/// What a word belongs to. The families are the chapters of `docs/language.md`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Family {
    /// After a `#`, and the modes of `#fopen`.
    Directive,
    /// Opens a shape's block.
    Shape,
    /// A part of a shape's block.
    ShapeItem,
    /// Makes one object of several.
    Csg,
    /// Changes an object.
    Modifier,
    Transform,
    /// Textures, pigments, normals, and maps of them.
    Texture,
    /// A function from points to numbers.
    Pattern,
    /// A part of a pattern's block: maps, waves, turbulence, warps, pictures.
    PatternItem,
    /// A part of `finish`.
    FinishItem,
    /// Colours and their components.
    Color,
    /// `camera` and its parts.
    Camera,
    /// `light_source` and its parts.
    Light,
    /// `interior`, `media` and their parts.
    Interior,
    /// Background, sky, fog, rainbow.
    Atmosphere,
    /// `global_settings`, radiosity and photons.
    Setting,
    /// A function that gives a number.
    FloatFunction,
    /// A function that gives a vector.
    VectorFunction,
    /// A function that gives a string.
    StringFunction,
    /// A word that is a value.
    Constant,
    /// Makes values of other kinds: functions, arrays.
    Definition,
    /// A format of files or strings.
    FileKind,
}

/// How a word may stand in a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Role {
    /// An item of its own: `sphere`, `rotate`, `rgb`.
    Statement,
    /// An operand: `x`, `pi`, `clock`.
    Value,
    /// An operand once called with its arguments in parentheses.
    Function {
        /// It takes exactly one argument, so the parentheses hold a full expression.
        one_argument: bool,
    },
}

/// What this version does with a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    Built,
    /// Known; what it stands for is poison.
    Later,
    /// Read, its arguments checked, and without effect on any picture.
    Inert {
        /// Until one of these is built: then it is to be built, too.
        until: &'static [Word],
    },
}

/// One row of the table.
struct Row {
    /// The spellings, the usual one first.
    names: &'static [&'static str],
    family: Family,
    role: Role,
    standing: Standing,
    /// The opener of the only block it is a word in.
    block: Option<Word>,
    sentence: &'static str,
}

macro_rules! vocabulary {
    ($($family:ident {
        $($variant:ident $($name:literal)|+ $role:ident $standing:ident $(until [$($until:ident)+])? $(in $block:ident)? $sentence:literal;)*
    })*) => {
        use super::{Family, Role, Row, Standing};

        /// A word of the language.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Word { $($(#[doc = $sentence] $variant,)*)* }

        impl Word {
            /// All words, by family.
            pub const ALL: &[Word] = &[$($(Word::$variant),*),*];
        }

        /// Row `n` tells about `Word::ALL[n]`.
        pub(super) static ROWS: &[Row] = &[$($(Row {
            names: &[$($name),+],
            family: Family::$family,
            role: vocabulary!(@role $role),
            standing: vocabulary!(@standing $standing $($($until)+)?),
            block: vocabulary!(@block $($block)?),
            sentence: $sentence,
        }),*),*];
    };
    (@role statement) => { Role::Statement };
    (@role value) => { Role::Value };
    (@role function) => { Role::Function { one_argument: false } };
    (@role function1) => { Role::Function { one_argument: true } };
    (@standing built) => { Standing::Built };
    (@standing later) => { Standing::Later };
    (@standing inert $($until:ident)*) => { Standing::Inert { until: &[$(Word::$until),*] } };
    (@block) => { None };
    (@block $block:ident) => { Some(Word::$block) };
}

mod standard;
mod words;

pub use standard::{
    is_standard_include, is_standard_source, standard_include_of, standard_includes, standard_names,
};
use words::ROWS;
pub use words::Word;

/// Names that stand for a value before the first line, and may be declared anew like any other.
///
/// **Source:** POV-Ray 3.7 manual, section 3.3.1.5.6 "Built-in Variables"; the program refuses none
/// of them in `#declare`.
pub const PREDECLARED: &[(&str, &str)] = &[
    ("image_width", "the picture's width in pixels"),
    ("image_height", "the picture's height in pixels"),
    ("frame_number", "the number of this frame: 0"),
    ("initial_frame", "the number of the first frame: 0"),
    ("final_frame", "the number of the last frame: 0"),
    ("initial_clock", "the clock of the first frame: 0"),
    ("final_clock", "the clock of the last frame: 0"),
    ("clock_delta", "the time between two frames: 0"),
    ("input_file_name", "the name of the main file"),
];

impl Word {
    fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }

    /// The reserved word of this spelling. Contextual words have none outside their block.
    pub fn from_name(name: &str) -> Option<Self> {
        let mut slot = hash(name.as_bytes()) % SLOTS;
        while let Some((word, spelling)) = TABLE[slot] {
            if spelling == name {
                return Some(word);
            }
            slot = (slot + 1) % SLOTS;
        }
        None
    }

    /// The word that `name` is directly inside the block that `block` opened, and nowhere else.
    pub fn contextual(name: &str, block: Word) -> Option<Self> {
        CONTEXTUAL
            .iter()
            .copied()
            .find(|word| word.row().block == Some(block) && word.row().names.contains(&name))
    }

    /// The usual spelling: `color`, never `colour`.
    pub fn name(self) -> &'static str {
        self.row().names[0]
    }

    /// Every spelling, the usual one first.
    pub fn names(self) -> &'static [&'static str] {
        self.row().names
    }

    pub fn family(self) -> Family {
        self.row().family
    }

    pub fn role(self) -> Role {
        self.row().role
    }

    pub fn standing(self) -> Standing {
        self.row().standing
    }

    /// True if a scene may use it in this version; else its value is poison.
    pub fn is_built(self) -> bool {
        self.standing() != Standing::Later
    }

    /// True if a scene may use it and it changes nothing.
    pub fn is_inert(self) -> bool {
        matches!(self.standing(), Standing::Inert { .. })
    }

    /// What a word of old versions is called today.
    pub fn today(self) -> Option<Word> {
        match self {
            Word::Composite => Some(Word::Union),
            Word::Alpha => Some(Word::Filter),
            _ => None,
        }
    }

    /// The opener of the only block it is a word in, for a contextual word.
    pub fn block(self) -> Option<Word> {
        self.row().block
    }

    /// One sentence: what it means, its parameters, units and default.
    pub fn sentence(self) -> &'static str {
        self.row().sentence
    }
}

/// The words that are free as names outside their block.
const CONTEXTUAL: [Word; 5] = [Word::File, Word::Kd, Word::Ks, Word::PhongExponent, Word::Shift];

/// A little more than four slots a spelling, so that most look-ups compare one string.
const SLOTS: usize = 2048;

/// Reserved spellings by their hash, with linear probing.
static TABLE: [Option<(Word, &str)>; SLOTS] = table();

const fn table() -> [Option<(Word, &'static str)>; SLOTS] {
    let mut table = [None; SLOTS];
    let mut row = 0;
    while row < ROWS.len() {
        let mut spelling = 0;
        while spelling < ROWS[row].names.len() && ROWS[row].block.is_none() {
            let name = ROWS[row].names[spelling];
            let mut slot = hash(name.as_bytes()) % SLOTS;
            while table[slot].is_some() {
                slot = (slot + 1) % SLOTS;
            }
            table[slot] = Some((Word::ALL[row], name));
            spelling += 1;
        }
        row += 1;
    }
    table
}

/// FNV-1a, 32 bits: short, and computed while compiling too.
///
/// **Source:** Fowler, Noll, Vo, "The FNV Non-Cryptographic Hash Algorithm".
const fn hash(name: &[u8]) -> usize {
    let mut hash = 0x811c_9dc5_u32;
    let mut i = 0;
    while i < name.len() {
        hash = (hash ^ name[i] as u32).wrapping_mul(0x0100_0193);
        i += 1;
    }
    (hash ^ (hash >> 15)) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_spelling_leads_back_to_its_word() {
        for &word in Word::ALL {
            for name in word.names() {
                match word.block() {
                    None => assert_eq!(Word::from_name(name), Some(word), "{name}"),
                    Some(block) => {
                        assert_eq!(Word::from_name(name), None, "{name}");
                        assert_eq!(Word::contextual(name, block), Some(word), "{name}");
                        assert_eq!(Word::contextual(name, Word::Sphere), None, "{name}");
                    }
                }
            }
        }
    }

    #[test]
    fn spellings_are_unique_and_case_counts() {
        let mut names: Vec<_> = Word::ALL.iter().flat_map(|word| word.names()).collect();
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
        assert_eq!(Word::from_name("colour"), Some(Word::Color));
        assert_eq!(Word::from_name("Sphere"), None);
        assert_eq!(Word::from_name(""), None);
        assert_eq!(Word::from_name("image_width"), None);
    }

    #[test]
    fn the_table_has_the_494_words_the_program_reserves_and_four_of_ours() {
        let spellings: usize = Word::ALL.iter().map(|word| word.names().len()).sum();
        assert_eq!(spellings, 494 + CONTEXTUAL.len());
    }

    #[test]
    fn a_word_is_inert_only_until_what_it_is_about_is_built() {
        for &word in Word::ALL {
            let Standing::Inert { until } = word.standing() else { continue };
            let built = until.iter().find(|until| until.is_built());
            assert_eq!(built, None, "it is built, and `{}` changes it", word.name());
        }
    }

    #[test]
    fn sentences_are_single_and_plain() {
        for &word in Word::ALL {
            let sentence = word.sentence();
            assert!(!sentence.is_empty() && !sentence.ends_with('.') || sentence.ends_with('…'));
            assert!(!sentence.contains('\n'), "{sentence}");
        }
    }
}
