//! An INI file of POV-Ray as the file of `render`: its options as words of the command line.
//!
//! **Invariant:** an option on the command line counts instead.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use clap::CommandFactory;
use clap::parser::ValueSource;
use lucarne::evaluate::Animation;
use lucarne::plan::{Antialias, Region};
use lucarne::source::decode;

use super::arguments::Arguments;
use super::exit::Failure;
use super::messages;
use super::output::Output;
use super::povray::{Settings, is_without_effect, section_of};
use super::text::read_main;

/// An INI file, or a section of one.
pub struct Ini {
    /// The scene that it names.
    pub scene: PathBuf,
    file: String,
    settings: Settings,
}

impl Ini {
    /// Reads a file whose name ends in `.ini`, or in `.ini[section]`; `None` for others.
    pub fn read(path: &Path) -> Result<Option<Self>, Failure> {
        let file = path.to_string_lossy().into_owned();
        let name = file.split('[').next().unwrap_or_default();
        if !name.to_ascii_lowercase().ends_with(".ini") {
            return Ok(None);
        }
        let read = |path: &Path| fs::read(path).ok().map(|bytes| decode(bytes).0);
        let mut settings = Settings::default();
        let text = decode(read_main(Path::new(name))?).0;
        let section = file[name.len()..].trim_matches(['[', ']']).trim();
        let sections: Vec<&str> = text.lines().filter_map(section_of).collect();
        if !section.is_empty() && !sections.iter().any(|one| one.eq_ignore_ascii_case(section)) {
            let failure = Failure::usage(format!("`{name}` has no section `{section}`"));
            return Err(match sections.is_empty() {
                true => failure,
                false => failure.help(format!("it has {}", listed(&sections))),
            });
        }
        if settings.take_file(&file, &read).is_err() {
            return Err(Failure::usage(wrong_line(name, &text, &file[name.len()..], &read)));
        }
        let Some(input) = &settings.input else {
            return Err(Failure::usage(format!("`{name}` names no scene"))
                .help("add a line such as `Input_File_Name=scene.pov`"));
        };
        if let Err(edge) = settings.region() {
            let sentence =
                format!("`{name}`: the part to render has its {edge} outside of the picture");
            return Err(Failure::usage(sentence));
        }
        // Paths are relative to the current folder, as in POV-Ray; otherwise, to that of the file.
        let beside = Path::new(name).with_file_name(input);
        let is_beside = !Path::new(input).exists() && beside.exists();
        let scene = if is_beside { beside } else { PathBuf::from(input) };
        Ok(Some(Self { scene, file, settings }))
    }

    /// Returns its options, but for those that are among these words of a command line; prints a note about options that
    /// `render` has not.
    pub fn words(&self, of_line: &[OsString]) -> Vec<OsString> {
        let matches = Arguments::command().try_get_matches_from(of_line).ok();
        let render = matches.as_ref().and_then(|all| all.subcommand_matches("render"));
        let given = |id: &str| {
            render.is_some_and(|render| render.value_source(id) == Some(ValueSource::CommandLine))
        };
        let Settings { width, height, ref names, .. } = self.settings;
        let has = |one: &str| names.contains(one);
        let range = self.settings.frames();
        let mut words: Vec<String> = Vec::new();
        let mut add = |id: &str, name: &str, value: &str| {
            if id.is_empty() || !given(id) {
                words.push(format!("--{name}{}{value}", if value.is_empty() { "" } else { "=" }));
            }
        };
        if has("width") || has("height") {
            add("size", "size", &format!("{width}x{height}"));
        }
        let has_part = ["start_column", "end_column", "start_row", "end_row"].into_iter().any(has);
        if let Some(Region { x, y, width, height }) =
            self.settings.region().ok().filter(|_| has_part)
        {
            add("region", "region", &format!("{x},{y},{width},{height}"));
        }
        if has("antialias") && !given("max_error") && !given("time_budget") {
            add(
                "antialias",
                "antialias",
                &match self.settings.antialias() {
                    Antialias::Adaptive { threshold, grid } => {
                        format!("adaptive:{threshold}:{grid}")
                    }
                    Antialias::Grid(grid) => grid.to_string(),
                    Antialias::Off => "off".to_owned(),
                },
            );
        }
        if has("output_file_name") || has("output_file_type") {
            match self.settings.output(&self.scene, None) {
                Output::File { path, .. } => add("output", "output", &path.to_string_lossy()),
                Output::Stdout => add("output", "output", "-"),
            }
        }
        // Another output may be of a type that has no 16 bits.
        let has_16 = self.settings.bits == 16 && self.settings.format.depth(Some(16)).is_some();
        if has_16 && !given("output") {
            add("bits", "bits", "16");
        }
        if self.settings.alpha {
            add("alpha", "alpha", "");
        }
        if let Some(threads) = self.settings.threads {
            add("threads", "threads", &threads.to_string());
        }
        let is_still = range.is_none();
        if let Some(range) = range.filter(|_| !given("frames")) {
            let (first, last) = range.frames;
            add("frames", "frames", &format!("{first}..{last}/{}", range.step));
            add("clocks", "clocks", &format!("{}..{}", range.clocks.0, range.clocks.1));
            if range.is_cyclic {
                add("cyclic", "cyclic", "");
            }
            if range.subset != (None, None) {
                let rendered = range.frames();
                let number = |at: Option<&(Animation, f64)>| at.map_or(0, |at| at.0.frame_number);
                let (first, last) = (number(rendered.first()), number(rendered.last()));
                // Without any, `render` says that none are left.
                add("only", "only", &format!("{first}..{last}"));
            }
        }
        // These may be given several times, and the last counts.
        for folder in &self.settings.folders {
            add("", "include", &folder.to_string_lossy());
        }
        for (name, value) in &self.settings.declares {
            add("", "declare", &format!("{name}={value}"));
        }
        if has("clock") && is_still && !given("frames") {
            add("", "declare", &format!("clock={}", self.settings.clock));
        }
        self.note_unused();
        words.into_iter().map(OsString::from).collect()
    }

    fn note_unused(&self) {
        let is_unused = |name: &&String| !USED.contains(&name.as_str()) && !is_without_effect(name);
        let names: Vec<&String> = self.settings.names.iter().filter(is_unused).collect();
        if !names.is_empty() {
            messages::eprint(&format!(
                "note: `{file}`: `render` leaves out {}; `lucarne povray {file}` reads all options\n",
                listed(&names),
                file = self.file
            ));
        }
    }
}

/// Options that [`Ini::words`] reads.
const USED: &[&str] = &[
    "antialias",
    "antialias_depth",
    "antialias_threshold",
    "bits_per_color",
    "clock",
    "cyclic_animation",
    "declare",
    "end_column",
    "end_row",
    "final_clock",
    "final_frame",
    "frame_step",
    "height",
    "initial_clock",
    "initial_frame",
    "input_file_name",
    "library_path",
    "output_alpha",
    "output_file_name",
    "output_file_type",
    "sampling_method",
    "start_column",
    "start_row",
    "subset_end_frame",
    "subset_start_frame",
    "width",
    "work_threads",
];

fn listed(names: &[impl std::fmt::Display]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// Says which line of an INI file cannot be understood: the first that makes those before it wrong.
fn wrong_line(
    name: &str,
    text: &str,
    section: &str,
    read: &dyn Fn(&Path) -> Option<String>,
) -> String {
    let section = section.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
    let lines: Vec<&str> = text.lines().collect();
    let is_wrong = |&count: &usize| {
        Settings::default().take_text(&lines[..count].join("\n"), section, read).is_err()
    };
    match (1..=lines.len()).find(is_wrong) {
        Some(number) => {
            let line = lines[number - 1].trim();
            format!("line {number} of `{name}` cannot be understood: `{line}`")
        }
        None => format!("`{name}` cannot be understood"),
    }
}
