//! Compiles a scene stage by stage.
//!
//! **In:** a main file's text and access to its includes. **Out:** the result of each stage in turn; sources
//! and diagnostics are collected alongside. **Invariant:** every stage yields a result, even from invalid
//! input.
//!
//! ```
//! use lucarne::{road::{Options, Road}, source::NoFiles};
//!
//! let mut road = Road::new(&NoFiles, Options::default());
//! let file = road.read("a.scene", "union { sphere { 0, 1 } box { 0, 1 } translate 2*y }");
//! let ast = road.parse(file);
//! let scene = road.evaluate(ast);
//! assert_eq!(scene.roots.len(), 1); // The union.
//! let (world, _) = road.lower(scene);
//! assert_eq!((world.spheres[0].centre.y, world.boxes.len()), (2.0, 1));
//! assert!(!road.diagnostics.has_errors());
//! ```

mod again;
mod dark;
mod dialect;
mod echo;
mod unread;

use crate::diagnostic::{Code, Diagnostic, Diagnostics, Fix, Levels, Severity, allowances};
use crate::evaluate::{EvaluateOptions, evaluate};
use crate::lower::{LowerOptions, lower};
use crate::scene::{Dialect, Scene};
use crate::source::{FileId, Files, Source, Sources, Span, decode};
use crate::syntax::ast::Ast;
use crate::syntax::{ParseOptions, legacy, parse};
use crate::vocabulary::is_standard_include;
use crate::world::{Origins, World};

pub use dialect::{dialect, sign_of_povray};

/// Options of the compilation.
#[derive(Debug, Clone)]
pub struct Options {
    /// The level of each lint.
    pub levels: Levels,
    /// Width and height in pixels of the output picture, if known.
    pub picture: Option<(u32, u32)>,
    /// Report every old form in the main file, even in branches that are not run.
    pub legacy: bool,
    /// Search for coinciding faces even if no diagnostic would report them.
    pub coinciding: bool,
    /// The size that the scene reads, the names that are declared before it, its clock, and limits.
    pub evaluate: EvaluateOptions,
}

/// Those of a `.scene`.
impl Default for Options {
    fn default() -> Self {
        Self::new(Dialect::default())
    }
}

impl Options {
    /// Returns the defaults of a dialect: lints on for `.scene`, 640×480.
    pub fn new(dialect: Dialect) -> Self {
        let evaluate = EvaluateOptions { dialect, ..EvaluateOptions::default() };
        Self {
            levels: Levels::new(dialect == Dialect::Scene),
            picture: None,
            legacy: false,
            coinciding: false,
            evaluate,
        }
    }

    /// Sets the size of the picture, in pixels.
    pub fn for_picture(mut self, (width, height): (u32, u32)) -> Self {
        self.picture = Some((width, height));
        (self.evaluate.width, self.evaluate.height) = (width, height);
        self
    }

    /// Declares numbers before the scene is evaluated. `clock`, a keyword and not an identifier, sets the clock.
    pub fn declaring(mut self, declares: Vec<(String, f64)>) -> Self {
        if let Some((_, clock)) = declares.iter().rfind(|(name, _)| name == "clock") {
            self.evaluate.clock = *clock;
        }
        self.evaluate.declares = declares;
        self
    }
}

/// A scene in the pipeline, with its sources and diagnostics so far.
pub struct Road<'a> {
    files: &'a dyn Files,
    options: Options,
    /// The texts that were read so far.
    pub sources: Sources,
    /// The messages so far.
    pub diagnostics: Diagnostics,
    /// The number of sources whose comments were searched for allowed lints.
    heard: usize,
}

impl<'a> Road<'a> {
    /// Returns an empty one; `files` finds what the scene includes and reads.
    pub fn new(files: &'a dyn Files, options: Options) -> Self {
        let diagnostics = Diagnostics::with_levels(options.levels.clone());
        let sources = Sources::default();
        Self { files, options, sources, diagnostics, heard: 0 }
    }

    /// Reads the main file from its text or its bytes, UTF-8 or Latin-1. Messages call it `name`.
    pub fn read(&mut self, name: &str, bytes: impl Into<Vec<u8>>) -> FileId {
        let bytes = bytes.into();
        let wide = matches!(bytes.get(..2), Some([0xff, 0xfe] | [0xfe, 0xff]));
        // The offset of the first byte that is not UTF-8, in the text decoded as Latin-1.
        let wrong = std::str::from_utf8(&bytes).err().map(|error| {
            let before = &bytes[..error.valid_up_to()];
            error.valid_up_to() + before.iter().filter(|byte| !byte.is_ascii()).count()
        });
        let file = self.take_in(Source::decoded(name, decode(bytes)));
        if let Some(at) = wrong {
            let end =
                self.sources.get(file).text[at..].chars().next().map_or(at, |c| at + c.len_utf8());
            let help = match wide {
                true => "it looks like UTF-16: save it as UTF-8",
                false => "save it as UTF-8",
            };
            self.diagnostics.push(
                Diagnostic::new(
                    Code::BadEncoding,
                    "the file is not UTF-8, and was read as Latin-1",
                )
                .at(Span::new(file, at, end), "the first byte that is not UTF-8")
                .help(help),
            );
        }
        file
    }

    fn take_in(&mut self, main: Source) -> FileId {
        if dark::is_whole(&main.text) {
            self.diagnostics.of_whole_scene();
        }
        self.sources.add(main)
    }

    /// Parses a file that was [read](Self::read).
    pub fn parse(&mut self, file: FileId) -> Ast {
        let EvaluateOptions { dialect, limits, loose, ref declares, .. } = self.options.evaluate;
        let options = ParseOptions {
            dialect,
            nesting_limit: limits.nesting as usize,
            alone: declares.is_empty(),
            loose,
            ..ParseOptions::default()
        };
        let ast = parse(self.sources.get(file), file, &options, &mut self.diagnostics);
        self.drop_encoding_of_comments(&ast);
        if self.options.legacy {
            legacy(&ast, self.sources.get(file), &mut self.diagnostics);
        }
        self.silence(0);
        ast
    }

    /// Drops the diagnostic about a file's encoding if only its comments are affected.
    fn drop_encoding_of_comments(&mut self, ast: &Ast) {
        let is_its = |told: &Diagnostic| {
            told.code == Code::BadEncoding
                && told.primary().is_some_and(|label| label.span.file == ast.file)
        };
        if !self.diagnostics.iter().any(is_its) {
            return;
        }
        let text = &self.sources.get(ast.file).text;
        if ast.is_ascii_but_for_comments(text) {
            self.diagnostics.retain_after(0, |told| !is_its(told));
        }
    }

    /// Runs a parsed file: its macros, loops, includes and declarations.
    pub fn evaluate(&mut self, ast: Ast) -> Scene {
        let options = &self.options.evaluate;
        let mut before = self.diagnostics.len();
        // Only a tree with faults is searched for echoes; others are large, and dropped after evaluation.
        let faulty = self.diagnostics.has_errors().then(|| ast.clone());
        let scene = evaluate(ast, &mut self.sources, self.files, options, &mut self.diagnostics);
        if let Some(ast) = &faulty {
            before = unread::tell_unread(&scene.skipped, before, &mut self.diagnostics);
            echo::drop_echoes(ast, &self.sources, before, &mut self.diagnostics);
        }
        if self.options.legacy {
            self.drop_twice_told();
        }
        self.silence(before);
        self.with_loose_braces().unwrap_or(scene)
    }

    /// Lowers the scene, unless it exceeded a limit: then it is incomplete, and that was reported.
    pub fn lower(&mut self, scene: Scene) -> (World, Origins) {
        if self.diagnostics.iter().any(|message| message.code == Code::ObjectLimit) {
            return (World::default(), Origins::default());
        }
        let Options { picture, coinciding, ref evaluate, .. } = self.options;
        let objects = evaluate.limits.objects;
        let lights_known = self.are_lights_known(&scene);
        let options = LowerOptions { objects, picture, coinciding, lights_known };
        let before = self.diagnostics.len();
        let (unused, holds) = (scene.unused.clone(), dark::Holds::of(&scene));
        let lowered = lower(scene, &options, &mut self.diagnostics);
        self.drop_doubtful(before);
        self.tell_blind(holds);
        self.tell_dark(&unused, holds);
        self.tell_empty();
        self.silence(before);
        lowered
    }

    /// Drops the lint for an old form that is also reported as an error.
    fn drop_twice_told(&mut self) {
        let errors = self.diagnostics.iter().filter(|one| one.is_error());
        let mended: Vec<Vec<Fix>> =
            errors.map(|one| one.fixes.clone()).filter(|fixes| !fixes.is_empty()).collect();
        self.diagnostics
            .retain_after(0, |one| one.code != Code::LegacyForm || !mended.contains(&one.fixes));
    }

    /// Drops those diagnostics after the first `len` that comments allow.
    fn silence(&mut self, len: usize) {
        for (file, source) in self.sources.iter().skip(self.heard) {
            let (allowed, told) = allowances(source, file);
            self.diagnostics.allow(allowed);
            told.into_iter().for_each(|told| self.diagnostics.push(told));
            self.heard += 1;
        }
        let sources = &self.sources;
        self.diagnostics.drop_allowed_after(len);
        self.diagnostics.retain_after(len, |told| !is_of_a_standard_include(told, sources));
    }

    /// Compiles the main file to its World: runs [`Self::read`], [`Self::parse`], [`Self::evaluate`] and [`Self::lower`].
    pub fn compile(&mut self, name: &str, bytes: impl Into<Vec<u8>>) -> (World, Origins) {
        let file = self.read(name, bytes);
        let ast = self.parse(file);
        let scene = self.evaluate(ast);
        self.lower(scene)
    }
}

/// Returns whether a lint is about a file that ships with POV-Ray, where its reader cannot act on it.
fn is_of_a_standard_include(told: &Diagnostic, sources: &Sources) -> bool {
    let file = told.primary().map_or(FileId(0), |label| label.span.file);
    // An error, by its code, that is lowered because POV-Ray renders the scene all the same.
    let is_opinion = told.code.severity() == Severity::Error && !told.is_error();
    if !(told.code.is_lint() || is_opinion) || file == FileId(0) {
        return false;
    }
    let name = &sources.get(file).name;
    is_standard_include(name.rsplit(['/', '\\']).next().unwrap_or(name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::NoFiles;

    #[test]
    fn a_file_that_is_not_utf_8_is_read_and_its_first_foreign_byte_named() {
        let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
        let file = road.read("a.scene", b"// \xc3\xa9 \xe9\n");
        let warning = road.diagnostics.iter().next().expect("a message");
        assert_eq!(warning.code, Code::BadEncoding);
        let span = warning.primary().expect("a place").span;
        assert_eq!(road.sources.text(span), "é");
        assert_eq!(road.sources.get(file).position(span.start as usize).column, 7);
    }

    #[test]
    fn a_text_nested_too_deep_is_told_that_and_nothing_else() {
        let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
        let deep = format!("sphere {{ 0, {}1", "(".repeat(200_001));
        road.compile("a.scene", deep);
        let codes: Vec<Code> = road.diagnostics.iter().map(|message| message.code).collect();
        assert_eq!(codes, [Code::NestingLimit]);
    }

    #[test]
    fn a_scene_beyond_the_object_limit_is_not_lowered() {
        let world = |objects| {
            let mut options = Options::new(Dialect::Scene);
            options.evaluate.limits.objects = objects;
            let mut road = Road::new(&NoFiles, options);
            let text = "sphere { 0, 1 } sphere { x, 1 } sphere { y, 1 }";
            let (world, _) = road.compile("a.scene", text);
            let limits = road.diagnostics.iter().filter(|m| m.code == Code::ObjectLimit).count();
            (world.objects.len(), limits)
        };
        assert_eq!(world(2), (0, 1));
        assert_eq!(world(100), (3, 0));
    }
}
