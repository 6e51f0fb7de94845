//! Reports what certainly holds for a whole scene despite its errors: that it has no light, no camera, or no
//! object.
//!
//! **Invariant:** no report if the scene or one of its includes contains any word related to light, or if the
//! scene is incomplete; likewise for the camera.

use std::collections::{BTreeSet, HashSet};
use std::ops::Range;

use super::Road;
use crate::diagnostic::suggest::closest;
use crate::diagnostic::{Code, Diagnostic};
use crate::lower::unlit::tell_unlit;
use crate::scene::{Dialect, ObjectKind, Scene, Unused};
use crate::source::{FileId, Span};
use crate::vocabulary::{Family, Word, is_standard_source, standard_include_of};

/// Substrings of words by which a scene, or its author's macros, give light.
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

/// Returns whether a text is a complete scene: without these words it is probably a part of one.
pub(super) fn is_whole(main: &str) -> bool {
    main.contains("camera") && (main.contains("global_settings") || main.contains("#version"))
}

/// What a scene with errors contains.
#[derive(Debug, Clone, Copy)]
pub(super) struct Holds {
    camera: bool,
    light: bool,
    solid: bool,
}

impl Holds {
    pub(super) fn of(scene: &Scene) -> Self {
        let is_light = |root: &crate::scene::Root| {
            matches!(scene.objects[root.object.index()].kind, ObjectKind::LightSource(_))
        };
        Self {
            camera: !scene.cameras.is_empty(),
            light: scene.roots.iter().any(is_light),
            solid: scene.roots.iter().any(|root| !is_light(root)),
        }
    }
}

/// Returns approximately the range from a word to the end of its block: braces in comments are counted.
fn block_behind(text: &str, word: Span) -> Range<u32> {
    let mut depth = 0;
    let behind = text.get(word.end as usize..).unwrap_or("");
    let end = behind.char_indices().find(|(_, c)| {
        depth += match c {
            '{' => 1,
            '}' => -1,
            _ => 0,
        };
        *c == '}' && depth <= 0
    });
    word.start..end.map_or(text.len() as u32, |(at, _)| word.end + at as u32)
}

/// Returns the text without comments: a light that is commented out gives none.
fn without_comments(text: &str) -> String {
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n")
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
}

const NO_OBJECT: &str = "the scene has no object: its lights shine on nothing";

const AMBIENT: &str = "ambient";

/// Returns whether each `ambient` of a text is at most the default, so that it does not brighten the picture.
fn has_dim_ambient(text: &str) -> bool {
    let is_dim = |(at, _): (usize, &str)| {
        let value = text[at + AMBIENT.len()..].trim_start();
        let end = value.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(value.len());
        value[..end].parse::<f64>().is_ok_and(|value| value <= 0.1)
    };
    text.match_indices(AMBIENT).all(is_dim)
}

/// Returns the name and the keyword of `#declare Sun = light_source { … }`, if the text has no other light
/// and does not use this name elsewhere.
fn unplaced_lights(text: &str) -> Vec<&str> {
    const LIGHT: &str = "light_source";
    let names: Option<Vec<&str>> = text
        .match_indices(LIGHT)
        .map(|(at, _)| {
            let declares = text[..at].trim_end().strip_suffix('=')?;
            let name = words(declares.trim_end()).last()?;
            (words(text).filter(|word| *word == name).count() == 1).then_some(name)
        })
        .collect();
    names.map_or(Vec::new(), |names| names.into_iter().chain([LIGHT]).collect())
}

/// Returns whether a word gives or may give light: `LightBlue` and `P_Sunset` are colours.
fn is_of_light(word: &str) -> bool {
    let lower = word.to_ascii_lowercase();
    let of_light = OF_LIGHT.iter().any(|part| lower.contains(part));
    of_light && !lower.contains("sunset") && standard_include_of(word).is_none()
        || closest(&lower, ["light_source", "background", "emission"]).is_some()
}

impl Road<'_> {
    /// Returns whether the missing part may follow the end of the file: a complete file ends with an item.
    fn is_cut_off(&self, told: &Diagnostic) -> bool {
        let main = self.sources.iter().next().map_or("", |(_, source)| source.text.trim_end());
        match told.code {
            Code::UnclosedBlock => told.message.starts_with("the file ends"),
            Code::MissingEnd => !main.ends_with(['}', ';', ')']),
            _ => false,
        }
    }

    /// Returns the texts of the main file and of the author's own includes.
    fn own_texts(&self) -> Vec<String> {
        let own = self.sources.iter().enumerate();
        let own = own.filter(|(at, (_, source))| *at == 0 || !is_standard_source(&source.name));
        own.map(|(_, (_, source))| source.text.to_string()).collect()
    }

    /// Returns whether each light of a scene with errors was read: as many as its text has, without any other
    /// word related to light.
    pub(super) fn are_lights_known(&self, scene: &Scene) -> bool {
        let may_hold = |one: &Diagnostic| {
            matches!(one.code, Code::MissingInclude | Code::ForbiddenFile | Code::ForeignFile)
                || self.is_cut_off(one)
        };
        if !self.diagnostics.has_errors() || self.diagnostics.iter().any(may_hold) {
            return false;
        }
        let (light, texts) = (Word::LightSource.name(), self.own_texts());
        // An emitting surface does not light others.
        let is_other = |word: &&str| {
            let glows = ["ambient", "emission", "background", "sky_sphere"].contains(word);
            *word != light && !glows && is_of_light(word)
        };
        if texts.iter().any(|text| words(text).any(|word| is_other(&word))) {
            return false;
        }
        let written = texts.iter().flat_map(|text| words(text)).filter(|word| *word == light);
        let is_light = |kind: &ObjectKind| matches!(kind, ObjectKind::LightSource(_));
        written.count() == scene.objects.iter().filter(|object| is_light(&object.kind)).count()
    }

    /// Drops `nothing-in-view` diagnostics if an error in the camera's block, or in the object's, was
    /// skipped: its position may be another.
    pub(super) fn drop_doubtful(&mut self, before: usize) {
        let is_error = |one: &&Diagnostic| one.is_error();
        let faults = self.diagnostics.iter().filter(is_error);
        let faults: Vec<Span> = faults.filter_map(|one| Some(one.primary()?.span)).collect();
        if faults.is_empty() {
            return;
        }
        let sources = &self.sources;
        // A name on the line of a fault may have another value.
        let lines: BTreeSet<(FileId, usize)> = faults
            .iter()
            .map(|fault| (fault.file, sources.get(fault.file).position(fault.start as usize).line))
            .collect();
        let doubtful: HashSet<&str> = lines
            .into_iter()
            .flat_map(|(file, line)| words(sources.get(file).line(line)))
            .filter(|word| {
                word.starts_with(|c: char| !c.is_ascii_digit()) && Word::from_name(word).is_none()
            })
            .collect();
        let is_faulty = |opener: Span| {
            let text = &sources.get(opener.file).text;
            let block = block_behind(text, opener);
            let inside = text.get(block.start as usize..block.end as usize).unwrap_or("");
            faults.iter().any(|fault| fault.file == opener.file && block.contains(&fault.start))
                || words(inside).any(|word| doubtful.contains(&word))
        };
        self.diagnostics.retain_after(before, |told| {
            told.code != Code::NothingInView
                || !told.labels.iter().any(|label| is_faulty(label.span))
        });
    }

    /// Returns whether the scene is in the native dialect and `holds`.
    fn is_scene(&self, holds: bool) -> bool {
        holds && self.options.evaluate.dialect == Dialect::Scene
    }

    /// Reports that a scene with lights, `global_settings` and errors has no camera; without errors, `lower`
    /// does.
    pub(super) fn tell_blind(&mut self, holds: Holds) {
        let lacking = |one: &Diagnostic| {
            matches!(
                one.code,
                Code::MissingInclude | Code::ForbiddenFile | Code::ForeignFile | Code::NoCamera
            ) || self.is_cut_off(one)
        };
        if !self.diagnostics.has_errors() || self.diagnostics.iter().any(lacking) {
            return;
        }
        let texts = self.own_texts();
        let misspelt = |text: &str| {
            let mut words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            words.any(|word| {
                let word = word.to_ascii_lowercase();
                word.starts_with("cam") || closest(&word, ["camera"]).is_some()
            })
        };
        let whole = texts
            .first()
            .is_some_and(|main| main.contains("global_settings") && main.contains("light_source"));
        let whole = whole || self.is_scene(holds.light && holds.solid);
        if whole && !texts.iter().any(|text| misspelt(text)) {
            let message = "the scene has no camera; it is seen from <0, 0, 0>";
            let help = "a camera such as `camera { location <0, 1, 5> look_at <0, 1, 0> }`";
            self.diagnostics.push(Diagnostic::new(Code::NoCamera, message).help(help));
        }
    }

    /// Reports that a scene with lights and an unsupported feature has no object, nor any call that might
    /// place one.
    pub(super) fn tell_empty(&mut self) {
        let is_built_later =
            |one: &Diagnostic| matches!(one.code, Code::NotSupportedYet) || !one.is_error();
        if !self.diagnostics.has_errors() || !self.diagnostics.iter().all(is_built_later) {
            return;
        }
        let texts: Vec<String> =
            self.own_texts().iter().map(|text| without_comments(text)).collect();
        let places = |word: &str| {
            let of_object = |word: Word| {
                matches!(word.family(), Family::Shape | Family::Csg) || word == Word::Object
            };
            Word::from_name(word).is_some_and(of_object)
        };
        let has_object = |text: &str| text.contains('(') || words(text).any(places);
        let whole = texts
            .first()
            .is_some_and(|main| is_whole(main) && words(main).any(|word| word == "light_source"));
        if whole && !texts.iter().any(|text| has_object(text)) {
            self.diagnostics.push(Diagnostic::new(Code::EmptyScene, NO_OBJECT));
        }
    }

    /// Reports that a scene with errors has no light; `unused` are the names that are never used.
    pub(super) fn tell_dark(&mut self, unused: &[Unused], holds: Holds) {
        let lacking = |one: &Diagnostic| {
            matches!(one.code, Code::MissingInclude | Code::ForbiddenFile | Code::NoLight)
                || self.is_cut_off(one)
        };
        if !self.diagnostics.has_errors() || self.diagnostics.iter().any(lacking) {
            return;
        }
        let texts = self.own_texts();
        let whole = texts.first().is_some_and(|main| is_whole(main))
            || self.is_scene(holds.camera && holds.solid);
        let has_light = |text: &str| {
            let unplaced = unplaced_lights(text);
            let is_dim = has_dim_ambient(text);
            words(text).any(|word| {
                is_of_light(word) && !unplaced.contains(&word) && !(is_dim && word == AMBIENT)
            })
        };
        if !whole || texts.iter().any(|text| has_light(&without_comments(text))) {
            return;
        }
        tell_unlit(unused, &mut self.diagnostics);
    }
}
