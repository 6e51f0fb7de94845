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
use lucarne::road::sign_of_povray;
use lucarne::scene::Dialect;

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
}
