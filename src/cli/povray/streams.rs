//! What POV-Ray prints where: streams of text that go to standard error, to files, or nowhere.
//!
//! **Invariant:** nothing goes to standard output, and all is ASCII.

use std::io::Write;
use std::path::Path;

use super::settings::switch;
use crate::cli::messages;

/// What a text is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stream {
    /// What the scene says with `#debug`.
    Debug,
    /// Why there is no picture.
    Fatal,
    /// What is rendered, and how.
    Render,
    Statistic,
    Warning,
}

const NAMES: [(&str, Stream); 5] = [
    ("debug", Stream::Debug),
    ("fatal", Stream::Fatal),
    ("render", Stream::Render),
    ("statistic", Stream::Statistic),
    ("warning", Stream::Warning),
];

/// Where each stream goes.
#[derive(Debug, Clone, PartialEq)]
pub struct Streams {
    /// Whether each goes to standard error.
    console: [bool; 5],
    /// The file that each goes to, too.
    files: [Option<String>; 5],
}

impl Default for Streams {
    fn default() -> Self {
        Self { console: [true; 5], files: Default::default() }
    }
}

impl Streams {
    /// Sets an option by its name; returns false if it is about something else.
    pub fn set(&mut self, name: &str, value: &str) -> bool {
        let Some((stream, kind)) = name.split_once('_') else { return false };
        let which = |(name, _): &(&str, Stream)| stream == "all" || *name == stream;
        let places: Vec<usize> =
            NAMES.iter().enumerate().filter(|(_, name)| which(name)).map(|(at, _)| at).collect();
        if places.is_empty() || !matches!(kind, "console" | "file") {
            return false;
        }
        for at in places {
            match kind {
                "console" => self.console[at] = switch(value),
                _ => self.files[at] = Some(value.to_owned()),
            }
        }
        true
    }

    /// Whether a stream is written to this file.
    pub fn overwrite(&self, scene: &Path) -> bool {
        let Ok(scene) = std::fs::canonicalize(scene) else { return false };
        let is_it = |file: &String| std::fs::canonicalize(file).is_ok_and(|file| file == scene);
        self.files.iter().flatten().any(is_it)
    }

    /// Empties the files, once the options are known.
    pub fn begin(&self) {
        for file in self.files.iter().flatten() {
            let _ = std::fs::File::create(file);
        }
    }

    pub fn say(&self, stream: Stream, text: &str) {
        let at = NAMES.iter().position(|(_, one)| *one == stream).unwrap_or_default();
        let text = ascii(text);
        if self.console[at] {
            messages::eprint(&text);
        }
        if let Some(file) = &self.files[at]
            && let Ok(mut file) = std::fs::OpenOptions::new().append(true).create(true).open(file)
        {
            let _ = file.write_all(text.as_bytes());
        }
    }
}

/// Returns the text with the nearest ASCII characters.
fn ascii(text: &str) -> String {
    let near = |c: char| match c {
        '×' => 'x',
        '‘' | '’' => '\'',
        '“' | '”' => '"',
        '–' | '—' | '─' | '╌' => '-',
        '│' | '╎' | '·' | '╷' | '╵' => '|',
        '╭' | '╰' | '├' | '┬' | '┴' | '╮' | '╯' => '+',
        '▲' | '△' => '^',
        c if c.is_ascii() => c,
        _ => '?',
    };
    text.replace('…', "...").chars().map(near).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_about_one_stream_or_all() {
        let mut streams = Streams::default();
        assert!(streams.set("all_console", "off"));
        assert!(streams.set("fatal_console", "on"));
        assert!(streams.set("debug_file", "a.log"));
        assert_eq!(streams.console, [false, true, false, false, false]);
        assert_eq!(streams.files[0].as_deref(), Some("a.log"));
        assert!(!streams.set("width", "3"));
    }

    #[test]
    fn all_text_is_ascii() {
        assert_eq!(ascii("3 × 3 “é” …"), "3 x 3 \"?\" ...");
    }
}
