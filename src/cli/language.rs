//! Detects the language of a main file: `--language` takes precedence over its extension, and the extension
//! over its text.
//!
//! **Rule:** `.pov` and `.inc` are POV-Ray's language, `.scene` is lucarne's own. Other files, and standard
//! input, are POV-Ray's if their text contains one of these outside comments: `#version`, `assumed_gamma`,
//! an `#include` of a file that ships with POV-Ray, `color red` (or `green`, `blue`), `right -`, or a
//! `location` with a negative z, as is usual for POV-Ray cameras; or if it names the Persistence of Vision.
//! Otherwise they are lucarne's own.

use std::path::Path;

use clap::ValueEnum;
use lucarne::scene::Dialect;
use lucarne::source::file_name;
use lucarne::vocabulary::is_standard_include;

use super::text::name_of;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Language {
    /// POV-Ray's language, with its left-handed coordinates and its defaults
    Pov,
    /// lucarne's own language, with right-handed coordinates and lints
    Scene,
}

impl From<Language> for Dialect {
    fn from(language: Language) -> Self {
        match language {
            Language::Pov => Self::Pov,
            Language::Scene => Self::Scene,
        }
    }
}

/// Returns the language of a main file, and a note for the user if only the text decided it.
pub fn of(asked: Option<Language>, file: &Path, text: &[u8]) -> (Dialect, Option<String>) {
    if let Some(asked) = asked {
        return (asked.into(), None);
    }
    let extension = file.extension().unwrap_or_default().to_ascii_lowercase();
    match extension.to_str() {
        Some("pov" | "inc") => return (Dialect::Pov, None),
        Some("scene") => return (Dialect::Scene, None),
        _ => {}
    }
    let name = name_of(file);
    match sign_of_povray(text) {
        Some(sign) => {
            let note = format!(
                "note: reading `{name}` as POV-Ray's language, because it has `{sign}`; \
                 `--language scene` reads it as lucarne's own\n"
            );
            (Dialect::Pov, Some(note))
        }
        None => {
            let note = format!(
                "note: reading `{name}` as lucarne's own language; `--language pov` reads it as POV-Ray's\n"
            );
            (Dialect::Scene, Some(note))
        }
    }
}

/// Lowercase name of the program as POV-Ray scenes spell it.
const PROGRAM: &str = "persistence of vision";

/// Returns the first feature of the text that only POV-Ray scenes have.
fn sign_of_povray(text: &[u8]) -> Option<String> {
    let named = text.to_ascii_lowercase();
    if named.windows(PROGRAM.len()).any(|part| part == PROGRAM.as_bytes()) {
        return Some("Persistence of Vision".to_owned());
    }
    let mut last = [Piece::Sign(b' '); 2];
    // How many commas there were since a `location <`.
    let mut location: Option<usize> = None;
    let mut rest = text;
    while let Some((piece, behind)) = next(rest) {
        rest = behind;
        let sign = match (last, piece) {
            ([_, Piece::Sign(b'#')], Piece::Word(b"version")) => Some("#version".to_owned()),
            (_, Piece::Word(b"assumed_gamma")) => Some("assumed_gamma".to_owned()),
            ([Piece::Sign(b'#'), Piece::Word(b"include")], Piece::Quoted(name)) => {
                let name = String::from_utf8_lossy(name);
                is_standard_include(file_name(&name)).then(|| format!("#include \"{name}\""))
            }
            (
                [_, Piece::Word(b"color" | b"colour")],
                Piece::Word(part @ (b"red" | b"green" | b"blue")),
            ) => Some(format!("color {}", String::from_utf8_lossy(part))),
            ([_, Piece::Word(b"right")], Piece::Sign(b'-')) => Some("right -".to_owned()),
            _ => None,
        };
        location = match (last, piece) {
            ([_, Piece::Word(b"location")], Piece::Sign(b'<')) => Some(0),
            (_, Piece::Sign(b'>' | b'<' | b'(')) => None,
            (_, Piece::Sign(b',')) => location.map(|commas| commas + 1),
            ([_, Piece::Sign(b',')], Piece::Sign(b'-')) if location == Some(2) => {
                return Some("location <…, …, -".to_owned());
            }
            _ => location,
        };
        if sign.is_some() {
            return sign;
        }
        last = [last[1], piece];
    }
    None
}

/// Token of a text, outside comments and whitespace.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Piece<'a> {
    /// Letters, digits and `_`.
    Word(&'a [u8]),
    /// Text between two `"`.
    Quoted(&'a [u8]),
    Sign(u8),
}

/// Returns the first token and the text after it.
fn next(mut text: &[u8]) -> Option<(Piece<'_>, &[u8])> {
    loop {
        text = match text {
            [] => return None,
            [b'/', b'/', ..] => {
                let end = text.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
                &text[end.unwrap_or(text.len())..]
            }
            [b'/', b'*', rest @ ..] => behind_comment(rest),
            [blank, rest @ ..] if blank.is_ascii_whitespace() => rest,
            [b'"', rest @ ..] => {
                let end = rest.iter().position(|byte| *byte == b'"').unwrap_or(rest.len());
                return Some((
                    Piece::Quoted(&rest[..end]),
                    rest.get(end + 1..).unwrap_or_default(),
                ));
            }
            [first, rest @ ..] => {
                let of_word = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
                let length = text.iter().position(|byte| !of_word(byte)).unwrap_or(text.len());
                return Some(match length {
                    0 => (Piece::Sign(*first), rest),
                    _ => (Piece::Word(&text[..length]), &text[length..]),
                });
            }
        }
    }
}

/// Returns the text after an open comment. Comments nest.
fn behind_comment(mut text: &[u8]) -> &[u8] {
    let mut depth = 1;
    while depth > 0 {
        text = match text {
            [] => return text,
            [b'/', b'*', rest @ ..] => {
                depth += 1;
                rest
            }
            [b'*', b'/', rest @ ..] => {
                depth -= 1;
                rest
            }
            [_, rest @ ..] => rest,
        };
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_decides_before_the_text_and_the_flag_before_the_name() {
        let of = |asked, name: &str, text: &str| of(asked, Path::new(name), text.as_bytes());
        for (name, text, dialect) in [
            ("a.pov", "", Dialect::Pov),
            ("a.INC", "", Dialect::Pov),
            ("a.scene", "#version 3.7;", Dialect::Scene),
        ] {
            assert_eq!(of(None, name, text), (dialect, None), "{name}");
        }
        assert_eq!(of(Some(Language::Scene), "a.pov", ""), (Dialect::Scene, None));
        assert_eq!(of(Some(Language::Pov), "a.scene", ""), (Dialect::Pov, None));
        for name in ["-", "a.txt", "a", "a.pov.bak", "pov"] {
            let (dialect, note) = of(None, name, "#version 3.7;");
            let note = note.expect("a note");
            assert!(dialect == Dialect::Pov && note.contains("`--language scene`"), "{note}");
            let (dialect, note) = of(None, name, "sphere { 0, 1 }");
            let note = note.expect("a note");
            assert!(dialect == Dialect::Scene && note.contains("`--language pov`"), "{note}");
        }
    }

    #[test]
    fn what_only_scenes_for_povray_have_is_found_outside_of_comments_and_strings() {
        for (text, sign) in [
            ("# version 3.5;", "#version"),
            ("global_settings { assumed_gamma 1.0 }", "assumed_gamma"),
            ("#include \"colors.inc\"", "#include \"colors.inc\""),
            ("// a comment\r#include // another\n\"stones.inc\"", "#include \"stones.inc\""),
            ("pigment { color red 1 }", "color red"),
            ("camera { right -x*4/3 }", "right -"),
            ("/* /* */ */ #version 3.7;", "#version"),
        ] {
            assert_eq!(sign_of_povray(text.as_bytes()).as_deref(), Some(sign), "{text}");
        }
        for text in [
            "",
            "// #version 3.7;",
            "/* #version 3.7; /* */ assumed_gamma */",
            "#debug \"#version assumed_gamma\"",
            "#include \"mine.inc\"",
            "#if (version < 3) #end",
            "pigment { color Red }",
            "/* never closed",
            "\"never closed",
            "#",
        ] {
            assert_eq!(sign_of_povray(text.as_bytes()), None, "{text}");
        }
    }
}
