//! What is certain of a whole scene though it has mistakes: that nothing in it is written to give light, or that
//! it is seen by no camera.
//!
//! **Invariant:** a scene whose text, or an include of it, has any word of light is said nothing of, and so is
//! one that is not whole; likewise of a camera.

use super::Road;
use crate::diagnostic::suggest::closest;
use crate::diagnostic::{Code, Diagnostic};
use crate::vocabulary::is_standard_include;

/// Parts of the words by which a scene, or its author's macros, give light.
const OF_LIGHT: &[&str] = &[
    "light",
    "lamp",
    "sun",
    "emission",
    "ambient",
    "glow",
    "sky_sphere",
    "background",
    "radiosity",
];

/// Whether a text is a scene: without these it is rather a part of one.
pub(super) fn is_whole(main: &str) -> bool {
    main.contains("camera") && (main.contains("global_settings") || main.contains("#version"))
}

/// A light that is commented out gives none.
fn without_comments(text: &str) -> String {
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n")
}

/// What is not there may have come behind the end.
fn is_cut_off(told: &Diagnostic) -> bool {
    told.code == Code::UnclosedBlock && told.message.starts_with("the file ends")
}

impl Road<'_> {
    /// The main file's text and those of the author's own includes, in lower case.
    fn own_texts(&self) -> Vec<String> {
        let own = self.sources.iter().enumerate().filter(|(at, (_, source))| {
            let name = source.name.rsplit(['/', '\\']).next().unwrap_or(&source.name);
            *at == 0 || !is_standard_include(name)
        });
        own.map(|(_, (_, source))| source.text.to_ascii_lowercase()).collect()
    }

    /// That a scene with lights, `global_settings` and mistakes has no camera; of one without mistakes `lower` tells it.
    pub(super) fn tell_blind(&mut self) {
        let lacking = |one: &Diagnostic| {
            matches!(
                one.code,
                Code::MissingInclude
                    | Code::ForbiddenFile
                    | Code::ForeignFile
                    | Code::NoCamera
                    | Code::MissingEnd
            )
        };
        if !self.diagnostics.has_errors() || self.diagnostics.iter().any(lacking) {
            return;
        }
        let texts = self.own_texts();
        let misspelt = |text: &str| {
            let mut words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            words.any(|word| word.starts_with("cam") || closest(word, ["camera"]).is_some())
        };
        let whole = texts
            .first()
            .is_some_and(|main| main.contains("global_settings") && main.contains("light_source"));
        if whole && !texts.iter().any(|text| misspelt(text)) {
            let message = "the scene has no camera; it is seen from <0, 0, 0>";
            let help = "a camera such as `camera { location <0, 1, 5> look_at <0, 1, 0> }`";
            self.diagnostics.push(Diagnostic::new(Code::NoCamera, message).help(help));
        }
    }

    pub(super) fn tell_dark(&mut self) {
        let lacking = |one: &Diagnostic| {
            matches!(one.code, Code::MissingInclude | Code::ForbiddenFile | Code::NoLight)
                || is_cut_off(one)
        };
        if !self.diagnostics.has_errors() || self.diagnostics.iter().any(lacking) {
            return;
        }
        let texts = self.own_texts();
        let whole = texts.first().is_some_and(|main| is_whole(main));
        let misspelt = |text: &str| {
            let mut words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            words.any(|word| closest(word, ["light_source", "background", "emission"]).is_some())
        };
        let has_light =
            |text: &str| OF_LIGHT.iter().any(|word| text.contains(word)) || misspelt(text);
        if !whole || texts.iter().any(|text| has_light(&without_comments(text))) {
            return;
        }
        let message = "nothing gives light, so the picture is dark";
        let help = "a light such as `light_source { <10, 20, 10> rgb 1 }`";
        self.diagnostics.push(Diagnostic::new(Code::NoLight, message).help(help));
    }
}
