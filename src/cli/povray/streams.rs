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

/// The name of each stream in options, and of its file where none is named.
const NAMES: [(&str, Stream, &str); 5] = [
    ("debug", Stream::Debug, "debug.out"),
    ("fatal", Stream::Fatal, "fatal.out"),
    ("render", Stream::Render, "render.out"),
    ("statistic", Stream::Statistic, "stats.out"),
    ("warning", Stream::Warning, "warning.out"),
];

/// Where each stream goes.
#[derive(Debug, Clone, PartialEq)]
pub struct Streams {
    /// Whether each goes to standard error.
    console: [bool; 5],
    /// The file that each goes to, too.
    files: [Option<String>; 5],
    /// Whether files keep the text that they have.
    append: bool,
}

impl Default for Streams {
    fn default() -> Self {
        Self { console: [true; 5], files: Default::default(), append: false }
    }
}

impl Streams {
    /// Sets an option by its name; returns false if it is about something else.
    pub fn set(&mut self, name: &str, value: &str) -> bool {
        if name == "append_file" {
            self.append = switch(value);
            return true;
        }
        let Some((stream, kind)) = name.split_once('_') else { return false };
        let places = NAMES.iter().enumerate().filter(|(_, one)| stream == "all" || one.0 == stream);
        if !matches!(kind, "console" | "file") || places.clone().next().is_none() {
            return false;
        }
        for (at, (_, _, file)) in places {
            match (kind, value.to_ascii_lowercase().as_str()) {
                ("console", _) => self.console[at] = switch(value),
                (_, "on" | "yes" | "true" | "1") => {
                    let file = if stream == "all" { "alltext.out" } else { file };
                    self.files[at] = Some(file.to_owned());
                }
                (_, "off" | "no" | "false" | "0") => self.files[at] = None,
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
        for file in self.files.iter().flatten().filter(|_| !self.append) {
            let _ = std::fs::File::create(file);
        }
    }

    pub fn say(&self, stream: Stream, text: &str) {
        let at = NAMES.iter().position(|(_, one, _)| *one == stream).unwrap_or_default();
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
        for (name, value) in [
            ("all_console", "off"),
            ("fatal_console", "on"),
            ("all_file", "Off"),
            ("debug_file", "a.log"),
            ("statistic_file", "true"),
            ("append_file", "true"),
        ] {
            assert!(streams.set(name, value), "{name}");
        }
        assert_eq!(streams.console, [false, true, false, false, false]);
        assert_eq!(streams.files[0].as_deref(), Some("a.log"));
        assert_eq!(
            (streams.files[1].as_deref(), streams.files[3].as_deref()),
            (None, Some("stats.out"))
        );
        assert!(streams.append && !streams.set("width", "3"));
    }

    #[test]
    fn all_text_is_ascii() {
        assert_eq!(ascii("3 × 3 “é” …"), "3 x 3 \"?\" ...");
    }
}
