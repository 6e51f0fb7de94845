//! Which language a main file is in, by its name or by its text.

use crate::scene::Dialect;
use crate::source::file_name;
use crate::vocabulary::is_standard_include;

/// Returns the dialect of a main file by its name: POV-Ray's for `.pov` and `.inc`, else the native one.
pub fn dialect(name: &str) -> Dialect {
    let lower = name.to_lowercase();
    match lower.ends_with(".pov") || lower.ends_with(".inc") {
        true => Dialect::Pov,
        false => Dialect::Scene,
    }
}

/// Lowercase name of the program as POV-Ray scenes spell it.
const PROGRAM: &str = "persistence of vision";

/// Returns the first feature of the text that only POV-Ray scenes have.
pub fn sign_of_povray(text: &[u8]) -> Option<String> {
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

    #[test]
    fn the_extension_chooses_the_dialect() {
        assert_eq!(dialect("a.POV"), Dialect::Pov);
        assert_eq!(dialect("a.scene"), Dialect::Scene);
        assert_eq!(dialect("pov"), Dialect::Scene);
    }
}
