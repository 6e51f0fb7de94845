//! Prints diagnostics.
//!
//! **Invariant:** messages for people go to standard error, messages for programs (`json`) to standard
//! output. A closed pipe is not an error.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufWriter, ErrorKind, IsTerminal, Write};
use std::path::Path;

use clap::ValueEnum;
use lucarne::diagnostic::{Code, Diagnostic, Severity, json, narrate, render, sarif};
use lucarne::disk::reason;
use lucarne::source::{Source, Sources, Span};

use super::exit::{Exit, Failure};
use super::output::Picture;
use super::text::name_of;

/// Maximum number of errors, and of warnings, printed in the human format; the rest are only counted.
const MOST_SHOWN: usize = 100;
/// Maximum number of messages with the same code printed in the human format.
const MOST_OF_A_CODE: usize = 20;

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Format {
    /// With source excerpts, on standard error
    #[default]
    Human,
    /// `file:line:column: severity[code]: message`, on standard error
    Short,
    /// Plain sentences for a screen reader, on standard error
    Narrated,
    /// One JSON object per line, on standard output
    Json,
    /// A SARIF log, for code scanning services, on standard output
    Sarif,
    /// Commands of GitHub's workflows, which show messages beside their lines, on standard output
    Github,
}

/// Ends the text with a newline, so that output the scene author prints in pieces occupies its own line.
fn end_line(text: &mut String) {
    if !text.is_empty() && !text.ends_with('\n') {
        text.push('\n');
    }
}

/// Prints messages and determines the exit code from them.
pub struct Messages {
    format: Format,
    deny_warnings: bool,
    /// Whether standard output is reserved for a picture.
    pub picture_on_stdout: bool,
    /// What a SARIF log has so far.
    results: RefCell<Vec<serde_json::Value>>,
    /// In an animation: the messages of frames so far that are not printed again.
    printed: Option<Vec<Diagnostic>>,
    style: render::Style,
    errors: usize,
    warnings: usize,
    limits: usize,
    /// Codes that the command line allows by name.
    allowed: Vec<Code>,
    /// Those of them that were reported as errors, which cannot be allowed.
    not_allowed: BTreeSet<Code>,
}

impl Messages {
    pub fn new(format: Format, deny_warnings: bool) -> Self {
        let style = style();
        Self {
            format,
            deny_warnings,
            picture_on_stdout: false,
            results: RefCell::default(),
            printed: None,
            style,
            errors: 0,
            warnings: 0,
            limits: 0,
            allowed: Vec::new(),
            not_allowed: BTreeSet::new(),
        }
    }

    /// Sets the codes that the command line allows by name.
    pub fn allowing(self, allowed: Vec<Code>) -> Self {
        Self { allowed, ..self }
    }

    /// Prints a warning that several frames have once, and one SARIF log for all of them, by [`Self::print_log`].
    pub fn of_frames(self) -> Self {
        Self { printed: Some(Vec::new()), ..self }
    }

    /// Starts the messages of the next frame, which are counted anew.
    pub fn next_frame(&mut self) {
        (self.errors, self.warnings, self.limits) = (0, 0, 0);
    }

    /// Whether a message is printed: in an animation, a warning is only the first time, and in SARIF, each message.
    fn is_new(&mut self, one: &Diagnostic) -> bool {
        let Some(printed) = &mut self.printed else { return true };
        if one.severity != Severity::Warning && self.format != Format::Sarif {
            return true;
        }
        let is_new = !printed.contains(one);
        if is_new {
            printed.push(one.clone());
        }
        is_new
    }

    /// Prints all of the messages.
    pub fn print<'a>(
        &mut self,
        list: impl Iterator<Item = &'a Diagnostic>,
        sources: &Sources,
    ) -> Result<(), Failure> {
        let (mut out, mut errors, mut warnings, mut more) = (String::new(), 0, 0, 0);
        let mut of_code: BTreeMap<Code, usize> = BTreeMap::new();
        for diagnostic in list {
            if !self.is_new(diagnostic) {
                continue;
            }
            match diagnostic.severity {
                Severity::Error if diagnostic.code.is_limit() => self.limits += 1,
                Severity::Error => self.errors += 1,
                Severity::Warning => self.warnings += 1,
                Severity::Note => {}
            }
            if diagnostic.is_error() && self.allowed.contains(&diagnostic.code) {
                self.not_allowed.insert(diagnostic.code);
            }
            match self.format {
                Format::Human | Format::Narrated => {
                    // Output of the scene and warnings do not count toward the limit of errors.
                    let shown = match diagnostic.severity {
                        Severity::Error => &mut errors,
                        Severity::Warning => &mut warnings,
                        Severity::Note => {
                            out.push_str(&render::plain(diagnostic));
                            continue;
                        }
                    };
                    let alike = of_code.entry(diagnostic.code).or_default();
                    if *shown == MOST_SHOWN || *alike == MOST_OF_A_CODE {
                        more += 1;
                        continue;
                    }
                    end_line(&mut out);
                    *shown += 1;
                    *alike += 1;
                    out.push_str(&match self.format {
                        Format::Narrated => narrate::narrated(diagnostic, sources),
                        _ => render::human(diagnostic, sources, self.style),
                    });
                    out.push('\n');
                }
                Format::Short => out.push_str(&(render::short(diagnostic, sources) + "\n")),
                Format::Json => out.push_str(&(json::line(diagnostic, sources) + "\n")),
                Format::Sarif => {
                    self.results.borrow_mut().push(sarif::result(diagnostic, sources));
                }
                Format::Github => {
                    out.push_str(&(sarif::workflow_command(diagnostic, sources) + "\n"));
                }
            }
        }
        end_line(&mut out);
        if more > 0 {
            out.push_str(&format!("… and {more} more; `--message-format short` shows them all\n"));
        }
        match self.is_for_programs() && !self.picture_on_stdout {
            true => print(&out),
            false => {
                eprint(&out);
                Ok(())
            }
        }
    }

    /// Reports why a file could not be read, in the selected format.
    pub fn fail(&mut self, file: &Path, failure: &Failure) -> Result<(), Failure> {
        if !self.is_for_programs() {
            fail(failure);
            return Ok(());
        }
        let told = Diagnostic::new(Code::UnreadableFile, failure.sentence.as_str());
        let told = failure.help.iter().fold(told, |told, help| told.help(help.as_str()));
        let mut sources = Sources::default();
        let start = Span::new(sources.add(Source::new(name_of(file), "")), 0, 0);
        self.print(std::iter::once(&told.at(start, "")), &sources)
    }

    fn is_for_programs(&self) -> bool {
        matches!(self.format, Format::Json | Format::Sarif | Format::Github)
    }

    /// Prints the log of SARIF, if it was asked for.
    pub fn print_log(&self) {
        if self.format == Format::Sarif {
            let log = sarif::log(&self.results.take()) + "\n";
            match self.picture_on_stdout {
                true => eprint(&log),
                false => drop(print(&log)),
            }
        }
    }

    /// Prints the totals (`2 errors, 1 warning`) in the formats for people, and the log of SARIF unless more frames
    /// follow.
    pub fn summarize(&self) {
        if self.printed.is_none() {
            self.print_log();
        }
        let summary = render::summary(self.errors + self.limits, self.warnings);
        if let (Format::Human | Format::Narrated, Some(summary)) = (self.format, summary) {
            eprint(&format!("{summary}\n"));
        }
        for code in self.not_allowed.iter().filter(|_| !self.is_for_programs()) {
            eprint(&format!(
                "note: `--allow {}` silences warnings, and these are errors\n",
                code.name()
            ));
        }
        let warnings_alone = self.errors + self.limits == 0 && self.exit() != Exit::Done;
        if warnings_alone && !self.is_for_programs() {
            eprint("error: warnings are errors here (--deny-warnings)\n");
        }
    }

    /// Reports that a file has no messages, in the formats for people.
    pub fn nothing(&self, file: &str) {
        if let Format::Human | Format::Narrated = self.format {
            eprint(&format!("{file}: no messages\n"));
        }
    }

    /// Returns the exit code for the messages so far: a limit takes precedence over errors.
    pub fn exit(&self) -> Exit {
        match self {
            Self { limits: 1.., .. } => Exit::Limit,
            Self { errors: 1.., .. } => Exit::Scene,
            Self { warnings: 1.., deny_warnings: true, .. } => Exit::Scene,
            _ => Exit::Done,
        }
    }
}

/// Returns the style for standard error: the width of the terminal or of `COLUMNS`, in color if it is a
/// terminal and `NO_COLOR` is unset.
fn style() -> render::Style {
    let stderr = std::io::stderr();
    let asked = std::env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok());
    let asked = asked.unwrap_or(render::Style::PLAIN.width);
    if !stderr.is_terminal() {
        return render::Style { width: asked, ..render::Style::PLAIN };
    }
    let width = terminal_size::terminal_size_of(&stderr).map_or(asked, |(width, _)| width.0.into());
    let plain = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty())
        || std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    render::Style { width, color: !plain }
}

/// Prints text to standard output. A closed pipe is not an error.
pub fn print(text: &str) -> Result<(), Failure> {
    print_with(&|out| out.write_all(text.as_bytes()))
}

/// Prints bytes to standard output, like [`print`].
pub fn print_with(content: Picture) -> Result<(), Failure> {
    print_while_open(content).map(drop)
}

/// Prints bytes to standard output; returns false if it is a closed pipe.
pub fn print_while_open(content: Picture) -> Result<bool, Failure> {
    let mut out = BufWriter::new(std::io::stdout().lock());
    match content(&mut out).and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(false),
        Err(error) => {
            Err(Failure::file(format!("cannot write to standard output: {}", reason(&error))))
        }
        Ok(()) => Ok(true),
    }
}

/// Prints text to standard error.
pub fn eprint(text: &str) {
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}

/// Reports why the program ends.
pub fn fail(failure: &Failure) {
    let help = failure.help.as_ref().map_or(String::new(), |help| format!("  help: {help}\n"));
    eprint(&format!("error: {}\n{help}", failure.sentence));
}
