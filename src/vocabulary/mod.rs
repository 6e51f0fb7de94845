//! Every word of the language, with its family, its role, and a sentence about it.
//!
//! **In:** nothing. **Out:** [`Word`], a closed enum, and the properties of each word. **Invariant:** a
//! spelling names one word. Contextual words are reserved only directly inside their block; elsewhere, they
//! are free for use as names.

/// Language of the main file, which sets the defaults; see the table in `docs/language.md`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dialect {
    /// `.scene`: right-handed coordinates, lints enabled, lucarne's own words.
    #[default]
    Scene,
    /// `.pov`: POV-Ray's left-handed coordinates and defaults.
    Pov,
}

/// Group of related words. The families are the chapters of `docs/language.md`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Family {
    /// Used after a `#`; also the modes of `#fopen`.
    Directive,
    /// Opens the block of a shape.
    Shape,
    /// Part of the block of a shape.
    ShapeItem,
    /// Combines several objects into one.
    Csg,
    /// Changes an object.
    Modifier,
    /// Moves, turns, scales or shears.
    Transform,
    /// Textures, pigments, normals, and maps of them.
    Texture,
    /// Function from points to numbers.
    Pattern,
    /// Part of the block of a pattern: maps, waves, turbulence, warps, pictures.
    PatternItem,
    /// Part of `finish`.
    FinishItem,
    /// Colors and their components.
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
    /// Function that returns a number.
    FloatFunction,
    /// Function that returns a vector.
    VectorFunction,
    /// Function that returns a string.
    StringFunction,
    /// Constant value.
    Constant,
    /// Creates values of other kinds: functions, arrays.
    Definition,
    /// Format of files or strings.
    FileKind,
}

/// Syntactic role of a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Role {
    /// Item of its own: `sphere`, `rotate`, `rgb`.
    Statement,
    /// Operand: `x`, `pi`, `clock`.
    Value,
    /// Function: an operand when called with arguments in parentheses.
    Function {
        /// Takes exactly one argument, so that the parentheses contain a full expression.
        one_argument: bool,
    },
}

/// Support for a word in this version.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// Supported.
    Built,
    /// Recognized, but not supported: its value is poison.
    Later,
    /// Parsed, with its arguments checked, but without effect on the picture.
    Inert {
        /// Words whose implementation requires this one to be implemented, too.
        until: &'static [Word],
    },
}

/// One row of the table.
struct Row {
    /// Spellings, the preferred one first.
    names: &'static [&'static str],
    family: Family,
    role: Role,
    standing: Standing,
    /// Word that opens the only block in which this one is reserved.
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

        /// Row `n` describes `Word::ALL[n]`.
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

pub use standard::{is_standard_include, standard_include_of, standard_names};
pub(crate) use standard::{is_standard_source, standard_includes};
use words::ROWS;
pub use words::Word;

/// Names with a value before the first line, which may be redeclared like any other name.
///
/// **Source:** POV-Ray 3.7 manual, section 3.3.1.5.6 "Built-in Variables"; the program accepts all of them
/// in `#declare`.
pub const PREDECLARED: &[(&str, &str)] = &[
    ("image_width", "the picture's width in pixels"),
    ("image_height", "the picture's height in pixels"),
    ("frame_number", "the number of this frame; 0 for a still"),
    ("initial_frame", "the number of the first frame; 0 for a still"),
    ("final_frame", "the number of the last frame; 0 for a still"),
    ("initial_clock", "the clock of the first frame; 0 for a still"),
    ("final_clock", "the clock of the last frame; 0 for a still"),
    ("clock_delta", "the time between two frames; 0 for a still"),
    ("input_file_name", "the name of the main file"),
];

impl Word {
    fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }

    /// Returns the reserved word with this spelling. Contextual words are not found.
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

    /// Returns the word that `name` is directly inside a block opened by `block`, and only there.
    pub fn contextual(name: &str, block: Word) -> Option<Self> {
        CONTEXTUAL
            .iter()
            .copied()
            .find(|word| word.row().block == Some(block) && word.row().names.contains(&name))
    }

    /// Returns the preferred spelling: `color`, never `colour`.
    pub fn name(self) -> &'static str {
        self.row().names[0]
    }

    /// Returns all spellings, the preferred one first.
    pub fn names(self) -> &'static [&'static str] {
        self.row().names
    }

    /// Returns its group.
    pub fn family(self) -> Family {
        self.row().family
    }

    /// Returns its syntactic role.
    pub fn role(self) -> Role {
        self.row().role
    }

    /// Returns whether it is supported.
    pub fn standing(self) -> Standing {
        self.row().standing
    }

    /// Whether a scene may use the word in this version; otherwise, its value is poison.
    pub fn is_built(self) -> bool {
        self.standing() != Standing::Later
    }

    /// Whether a scene may use the word, but it has no effect.
    pub fn is_inert(self) -> bool {
        matches!(self.standing(), Standing::Inert { .. })
    }

    /// Returns the current name of an obsolete word.
    pub fn today(self) -> Option<Word> {
        match self {
            Word::Composite => Some(Word::Union),
            Word::Alpha => Some(Word::Filter),
            _ => None,
        }
    }

    /// Returns the word that opens the only block in which this contextual word is reserved.
    pub fn block(self) -> Option<Word> {
        self.row().block
    }

    /// Returns a one-sentence description: meaning, parameters, units and default.
    pub fn sentence(self) -> &'static str {
        self.row().sentence
    }
}

/// Words that are free for use as names outside their block.
const CONTEXTUAL: [Word; 5] = [Word::File, Word::Kd, Word::Ks, Word::PhongExponent, Word::Shift];

/// Size of the hash table: more than four slots per spelling, so that most lookups compare one string.
const SLOTS: usize = 2048;

/// Hash table of reserved spellings, with linear probing.
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

/// Computes the FNV-1a hash, 32 bits, which is short and can be computed at compile time.
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
    fn the_table_has_the_495_words_the_program_reserves_and_four_of_ours() {
        let spellings: usize = Word::ALL.iter().map(|word| word.names().len()).sum();
        assert_eq!(spellings, 495 + CONTEXTUAL.len());
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
