//! Cases of small scenes and the messages that are expected of each, in a form that reads as a list:
//!
//! ```text
//! === a misspelt word
//! sphere { 0, 1 pigmnt { rgb 1 } }
//! --- 1:15 unknown-word: `pigmnt` | did you mean `pigment` | fix pigment
//! ```
//!
//! A case is a title, the scene, and every message that is expected, in the order of the places; any other
//! message is a failure. A message is the line and the column it points at (`file:line:column` in an
//! include, `-` for the scene as a whole), its code, and words that its sentences hold. `fix TEXT`
//! is the text of a fix (a message without has none), `also 2:7` a place it points at too,
//! `via 4:1` a step of its trace (a message without has none). `+++ a.inc` starts a file the scene may
//! include. In a title, `(escaped)` lets the scene write bytes as `\xE9`, `\t`, `\r`.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use lucarne::diagnostic::Diagnostic;
use lucarne::source::{FileError, FileId, Files, Found, Sources, Span, WriteError};

/// The files of one case.
#[derive(Default)]
pub struct Includes(pub BTreeMap<String, Vec<u8>>);

impl Files for Includes {
    fn read(&self, name: &str, _: &str) -> Result<Found, FileError> {
        match self.0.get(name) {
            Some(bytes) => Ok(Found { name: name.to_owned(), bytes: bytes.clone() }),
            None if name.starts_with("../") => Err(FileError::Forbidden),
            None => {
                let names = self.0.keys().map(String::as_str);
                let similar = lucarne::diagnostic::suggest::closest(name, names);
                let similar = similar.map(str::to_owned).into_iter().collect();
                Err(FileError::NotFound { searched: Vec::new(), similar })
            }
        }
    }

    /// The files of a case may be written.
    fn start(&self, name: &str, _: bool) -> Result<String, WriteError> {
        match self.0.contains_key(name) {
            true => Ok(name.to_owned()),
            false if name.starts_with("../") => Err(WriteError::Outside),
            false => Err(WriteError::NotAllowed),
        }
    }
}

#[derive(Debug, Default)]
pub struct Case {
    pub file: String,
    pub line: usize,
    pub title: String,
    pub scene: String,
    pub files: Vec<(String, String)>,
    pub expected: Vec<Expected>,
}

#[derive(Debug, Default, Clone, PartialEq)]
pub struct Expected {
    pub place: String,
    pub code: String,
    pub words: Vec<String>,
    pub fixes: Vec<String>,
    pub also: Vec<String>,
    pub via: Vec<String>,
}

impl Expected {
    fn parse(line: &str) -> Self {
        let (head, rest) = line.split_once(':').map_or((line, ""), |_| {
            line.find(": ").map_or((line, ""), |at| (&line[..at], &line[at + 2..]))
        });
        let (place, code) = head.trim().split_once(' ').expect("a place and a code");
        let mut expected = Self {
            place: place.to_owned(),
            code: code.trim_end_matches(':').to_owned(),
            ..Self::default()
        };
        for part in rest.split('|').map(str::trim).filter(|part| !part.is_empty()) {
            let list = if let Some(text) = part.strip_prefix("fix") {
                expected.fixes.push(text.trim().to_owned());
                continue;
            } else if let Some(place) = part.strip_prefix("also ") {
                (&mut expected.also, place)
            } else if let Some(place) = part.strip_prefix("via ") {
                (&mut expected.via, place)
            } else {
                (&mut expected.words, part)
            };
            list.0.push(list.1.to_owned());
        }
        expected
    }
}

fn cases(path: &Path) -> Vec<Case> {
    let text = fs::read_to_string(path).expect("readable");
    let file = path.file_name().expect("a name").to_string_lossy().into_owned();
    let mut cases: Vec<Case> = Vec::new();
    for (at, line) in text.lines().enumerate() {
        if let Some(title) = line.strip_prefix("=== ") {
            let (file, title) = (file.clone(), title.to_owned());
            cases.push(Case { file, line: at + 1, title, ..Case::default() });
            continue;
        }
        let Some(case) = cases.last_mut() else { continue };
        if let Some(expected) = line.strip_prefix("--- ") {
            case.expected.push(Expected::parse(expected));
        } else if let Some(name) = line.strip_prefix("+++ ") {
            case.files.push((name.to_owned(), String::new()));
        } else {
            let text = case.files.last_mut().map_or(&mut case.scene, |(_, text)| text);
            text.push_str(line);
            text.push('\n');
        }
    }
    cases
}

/// `\xE9` and its kin as bytes; the last line break goes, so that a file may end anywhere.
fn unescaped(text: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut rest = text.strip_suffix('\n').unwrap_or(text).as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        rest = after;
        let escape = (first == b'\\').then(|| after.first().copied()).flatten();
        let (byte, used) = match escape {
            Some(b't') => (b'\t', 1),
            Some(b'r') => (b'\r', 1),
            Some(b'x') => {
                let digits = std::str::from_utf8(&after[1..3]).expect("two digits");
                (u8::from_str_radix(digits, 16).expect("hexadecimal"), 3)
            }
            _ => (first, 0),
        };
        bytes.push(byte);
        rest = &rest[used..];
    }
    bytes
}

fn place(span: Span, sources: &Sources) -> String {
    let source = sources.get(span.file);
    let position = source.position(span.start as usize);
    let (line, column) = (position.line, position.column);
    match span.file {
        FileId(0) => format!("{line}:{column}"),
        _ => format!("{}:{line}:{column}", source.name),
    }
}

/// What was said, in the form of the cases.
pub fn said(diagnostic: &Diagnostic, sources: &Sources) -> Expected {
    let primary = diagnostic.primary().map(|label| label.span);
    let mut words = vec![diagnostic.message.clone()];
    words.extend(diagnostic.labels.iter().map(|label| label.text.clone()));
    words.extend(diagnostic.help.iter().cloned());
    Expected {
        place: primary.map_or("-".to_owned(), |span| place(span, sources)),
        code: diagnostic.code.name().to_owned(),
        words,
        fixes: diagnostic.fixes.iter().map(|fix| fix.text.trim().to_owned()).collect(),
        also: diagnostic
            .labels
            .iter()
            .filter(|label| !label.primary)
            .map(|label| place(label.span, sources))
            .collect(),
        via: diagnostic.trace.iter().map(|step| place(step.span, sources)).collect(),
    }
}

/// What differs between what was expected and what was said.
fn differences(wanted: &Expected, said: &Expected) -> Vec<String> {
    let mut found = Vec::new();
    if wanted.place != said.place || wanted.code != said.code {
        found.push(format!("expected {} {}", wanted.place, wanted.code));
    }
    let all = said.words.join("\n");
    for words in wanted.words.iter().filter(|words| !all.contains(*words)) {
        found.push(format!("says nothing of {words}"));
    }
    if wanted.fixes != said.fixes {
        found.push(format!("expected the fixes {:?}", wanted.fixes));
    }
    for place in wanted.also.iter().filter(|place| !said.also.contains(place)) {
        found.push(format!("does not point at {place}"));
    }
    if wanted.via != said.via {
        found.push(format!("expected the trace {:?}", wanted.via));
    }
    found
}

pub fn shown(said: &Expected) -> String {
    let Expected { place, code, words, fixes, also, via } = said;
    let mut text = format!("{place} {code}: {}", words.join(" | "));
    fixes.iter().for_each(|fix| text += &format!(" | fix {fix}"));
    also.iter().for_each(|place| text += &format!(" | also {place}"));
    via.iter().for_each(|place| text += &format!(" | via {place}"));
    text
}

impl Case {
    pub fn bytes(&self, text: &str) -> Vec<u8> {
        match self.title.contains("(escaped)") {
            true => unescaped(text),
            false => text.as_bytes().to_vec(),
        }
    }

    pub fn files(&self) -> Includes {
        let files = self.files.iter();
        Includes(files.map(|(name, text)| (name.clone(), self.bytes(text))).collect())
    }

    /// What differs between the expected messages and those that were given; empty where nothing does.
    pub fn mismatches(&self, mut found: Vec<Expected>) -> String {
        let mut wrong = String::new();
        for wanted in &self.expected {
            // The one that fits; else the one at the same place, or of the same code, is shown beside it.
            let by = |test: &dyn Fn(&Expected) -> bool| found.iter().position(test);
            let near = by(&|one| differences(wanted, one).is_empty())
                .or_else(|| by(&|one| one.place == wanted.place && one.code == wanted.code))
                .or_else(|| by(&|one| one.place == wanted.place))
                .or_else(|| by(&|one| one.code == wanted.code));
            match near {
                Some(at) => {
                    let one = found.remove(at);
                    let differences = differences(wanted, &one);
                    if !differences.is_empty() {
                        wrong += &format!("  ! {}\n    {}\n", differences.join("; "), shown(&one));
                    }
                }
                None => wrong += &format!("  ! not said: {} {}\n", wanted.place, wanted.code),
            }
        }
        for one in &found {
            wrong += &format!("  + {}\n", shown(one));
        }
        wrong
    }

    /// The report on a case in which something is wrong.
    pub fn report(&self, wrong: &str) -> String {
        match wrong {
            "" => String::new(),
            _ => format!("{}:{} {}\n{wrong}", self.file, self.line, self.title),
        }
    }
}

/// The cases of all files in a folder below `tests/`, in the order of their names.
pub fn corpus(folder: &str) -> Vec<Case> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(folder);
    let mut paths: Vec<PathBuf> = fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.sort();
    paths.iter().flat_map(|path| cases(path)).collect()
}

/// Fails with the reports on all cases in which something is wrong.
pub fn assert_none(failures: impl Iterator<Item = String>) {
    let failures: Vec<String> = failures.filter(|failure| !failure.is_empty()).collect();
    assert!(failures.is_empty(), "{} cases\n{}", failures.len(), failures.concat());
}
