//! Runs a syntax tree: its macros, loops, includes and declarations become a scene.
//!
//! **In:** the main file's Ast, and `Files` for what it includes. **Out:** a Scene without macros, loops,
//! includes or names; always one, even for broken input. **Invariant:** evaluation *pulls* items: a consumer
//! asks the stream for its next item, and directives, macro calls and includes run at their position on the
//! way to it.

mod analysis_cache;
mod argument;
mod arity;
mod array;
mod block;
mod branch;
mod builtin;
mod call;
mod comparison;
mod concat;
mod continuation;
mod directive;
mod element;
mod enclosure;
mod endless;
mod expand;
mod expression;
mod fast_arithmetic;
mod file;
mod formula;
mod function;
mod geometric_query;
mod include;
mod iteration;
mod lint;
mod memory;
mod misleading_syntax;
mod missing_result;
mod multiple_results;
mod options;
mod paths;
mod report;
mod rollback;
mod run;
mod scope;
mod semicolon;
mod spline;
mod stream;
#[cfg(test)]
mod tests;
mod unbounded;
mod undeclared;
mod unit;
mod unrun;
pub(crate) mod value;
mod vector;
mod written;

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::rc::Rc;

use crate::color::Color;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::noise::NoiseGenerator;
use crate::scene::{
    ClassicFinish, Finish, FinishId, ObjectId, Pigment, PigmentId, PigmentKind, Scene, Texture,
    TextureId,
};
use crate::source::{ExpansionId, FileId, Files, Site, Sources, Span};
use crate::syntax::ast::{Ast, DirectiveId};

use crate::vocabulary::{Dialect, PREDECLARED};

pub use options::{Animation, EvaluateOptions, Interrupt, Limits};

use analysis_cache::Remembered;
use builtin::RandomStreams;
use enclosure::Enclosure;
use expand::Macro;
use scope::{Scopes, Symbol};
use stream::{Frame, Hold, MOST_RUN_SINCE_FAULT, Silent, Token};
use unit::{Here, Unit};
use value::{Poison, Value};

/// Returns the scene that a parsed main file describes. Errors and warnings go to `diagnostics`, and what is included to
/// `sources`. Drops `main`, which is the larger half of the memory of a large scene.
///
/// ```
/// use lucarne::{diagnostic::Diagnostics, source::{NoFiles, Source, Sources}, syntax::parse};
/// use lucarne::evaluate::{EvaluateOptions, evaluate};
///
/// let mut sources = Sources::default();
/// let file = sources.add(Source::new("a.scene", "#for (I, 1, 3) sphere { I*x, Radius } #end"));
/// let mut diagnostics = Diagnostics::default();
/// let ast = parse(sources.get(file), file, &Default::default(), &mut diagnostics);
/// let options = EvaluateOptions { declares: vec![("Radius".into(), 0.4)], ..Default::default() };
/// let scene = evaluate(ast, &mut sources, &NoFiles, &options, &mut diagnostics);
/// assert_eq!(scene.roots.len(), 3);
/// ```
pub fn evaluate(
    main: Ast,
    sources: &mut Sources,
    files: &dyn Files,
    options: &EvaluateOptions,
    diagnostics: &mut Diagnostics,
) -> Scene {
    let mut evaluator = Evaluator::new(sources, files, options, diagnostics);
    evaluator.run(main);
    evaluator.scene
}

/// Proof that an error was reported; the nearest statement or object goes on without the value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Reported;

type Outcome<T> = Result<T, Reported>;

struct Evaluator<'a> {
    sources: &'a mut Sources,
    files: &'a dyn Files,
    options: &'a EvaluateOptions,
    diagnostics: &'a mut Diagnostics,
    scene: Scene,
    /// The number that announces a list's length, and how many entries were found so far.
    announced: Option<(Span, usize)>,
    /// One entry for each object of the scene.
    made: Vec<block::Made>,
    scopes: Scopes,
    macros: Vec<Rc<Macro>>,
    /// Scratch buffer for the arguments of the next call; empty between calls.
    bound: Vec<expand::Bound>,
    functions: Vec<function::AuthorFunction>,
    /// Number of parameters of the last function that could not be read.
    broken_function: Option<usize>,
    /// Number of parameters of the declared functions that could not be read.
    broken_functions: HashMap<Symbol, usize>,
    /// Calls of macros with too many or too few arguments, which have been reported.
    wrong_calls: Vec<ExpansionId>,
    /// The built-in functions that are formulas, by number; empty until one is used.
    internals: Vec<Option<function::FunctionId>>,
    /// The generator behind noise functions.
    noise: NoiseGenerator,
    /// `noise_generator` is written.
    says_noise: bool,
    /// The number of centres of `waves` and `ripples`.
    waves: usize,
    /// Pictures that were read.
    pictures: block::Pictures,
    grids: block::Grids,
    streams: RandomStreams,
    /// Files that `#fopen` has opened.
    opened: Vec<file::Opened>,
    /// Files that the scene may not write; a later read of one reports nothing more.
    unwritten: BTreeSet<String>,
    /// Contents that a `.pov` wrote to files it may not write, by the names that it gave.
    held_files: BTreeMap<String, Vec<u8>>,
    /// Files that the scene has written, under the names by which they are found.
    authored: BTreeSet<String>,
    frames: Vec<Frame>,
    enclosures: Vec<Enclosure>,
    /// Number of these blocks that were opened by an unpaired `{`.
    loose_blocks: u32,
    /// How often a `}` has closed another block than the one it would close where it is written.
    loose_closers: u64,
    peeked: Option<Token>,
    /// The parenthesized value after a name that was taken.
    behind_name: Option<Token>,
    /// The macro call right before the next item, if it left no item.
    silent: Option<Silent>,
    /// Position of the item taken last: the end of what a consumer is reading.
    taken: Option<Site>,
    /// Set while the value of a `#declare` is read. Lookahead past its end runs nothing there, since that may
    /// already use the value; the frames that produced the value may end.
    hold: Option<Hold>,
    /// Set within [`Self::peek_on`].
    calls_wait: bool,
    /// Parsed files, by the name under which they were found.
    parsed: HashMap<String, Rc<Unit>>,
    /// The name under which a file was found, by the name that the including file uses.
    found: HashMap<(String, FileId), String>,
    /// Meshes read from files.
    meshes: block::MeshFiles,
    /// Fonts read from files.
    fonts: block::Fonts,
    /// Names of the files in the current chain of includes.
    including: Vec<String>,
    default_texture: TextureId,
    /// Strings are limited to ASCII: a `.pov` has not set `charset utf8` yet.
    is_ascii: bool,
    version: f64,
    /// Whether any file, or an option, has a version; whether the scene does.
    has_version: bool,
    says_version: bool,
    warned_of_version: bool,
    /// Pigment and finish keywords may appear directly in textures, as before version 3.0.
    has_bare_textures: bool,
    says_gamma: bool,
    /// The first colour that was converted before `assumed_gamma` was set.
    srgb_before_gamma: Option<Site>,
    /// The first unsupported word in the object being read.
    poison: Option<Poison>,
    /// Further unsupported words in the same item, by the span of the first.
    beside: BTreeMap<Span, Vec<Poison>>,
    /// An include was not found: a missing name may have been declared there.
    lacks_include: bool,
    /// Standard includes that were reported as assumed by an included file but not included.
    lacking: BTreeSet<String>,
    /// The includes that could not be read, as they were written.
    unread: BTreeSet<String>,
    /// Where a part was last reported missing: another missing part there adds nothing.
    missing_at: Option<Site>,
    /// The end values of loops that run past the end of an array, and the array's length; these have been
    /// reported.
    ends_told: Vec<(Span, u32)>,
    /// The objects of the last `bounded_by`, for `clipped_by { bounded_by }`.
    bounds: Vec<ObjectId>,
    /// The names that were reported as undeclared and count as declared since, in order.
    assumed: Vec<Symbol>,
    /// Set by `#error` and by limits; stops the evaluation.
    halted: bool,
    macro_depth: u32,
    /// Number of `#declare`s that wait for their values.
    declaring: u32,
    /// The names of those `#declare`s.
    declared_now: Vec<Symbol>,
    /// Current nesting depth of expressions being evaluated.
    calculating: u64,
    /// Approximate size in bytes of the scene's data beside its objects.
    stored: u64,
    /// Number of turns of all loops so far, and of those in which a mistake was found.
    turns: u64,
    faulty_turns: u64,
    /// Number of loop turns and macro calls since the first error.
    run_since_fault: u64,
    /// A file had syntax errors, so a loop may lack what ends it.
    misread: bool,
    /// For each condition of such a file, whether it was ever true, and whether it was ever false.
    asked: HashMap<DirectiveId, [bool; 2]>,
    /// Number of children of unions and the like that could not be created.
    lost_children: u64,
    /// A condition in what is being read had no known value: a missing part may be in the branch not taken.
    undecided: bool,
    /// Number of reports including repetitions, and number of errors among them.
    reports: u64,
    faults: u64,
    /// Cached analyses for messages, by span.
    remembered: Remembered,
    read: paths::Read,
    /// The keywords that opened the blocks being read, outermost first.
    openers: Vec<Span>,
    /// A diagnostic for a part that a block lacks, reported unless the part appears too late in the block.
    owed: Option<(Here, Diagnostic)>,
    /// The whole spans of these blocks, from brace to brace.
    blocks: Vec<Site>,
    /// Whether an expression is an angle in radians, cached for lints.
    in_radians: HashMap<Span, bool>,
    /// The objects that `trace` and similar functions have examined.
    probes: HashMap<crate::scene::ObjectId, Rc<geometric_query::Probe>>,
}

impl<'a> Evaluator<'a> {
    fn new(
        sources: &'a mut Sources,
        files: &'a dyn Files,
        options: &'a EvaluateOptions,
        diagnostics: &'a mut Diagnostics,
    ) -> Self {
        let nowhere = Site { span: Span::new(FileId(0), 0, 0), expansion: ExpansionId::MAIN };
        let scene = Scene {
            dialect: options.dialect,
            pigments: vec![Pigment {
                kind: PigmentKind::Color(Color::BLACK),
                steps: Vec::new(),
                site: nowhere,
                clear: None,
                has_own_colors: false,
                quick_color: None,
            }],
            finishes: vec![Finish::Classic(ClassicFinish::default())],
            textures: vec![Texture::plain(PigmentId(0), FinishId(0))],
            ..Scene::default()
        };
        let mut scopes = Scopes::default();
        let predeclared = |name: &str| match name {
            "image_width" => Value::Number(f64::from(options.width)),
            "image_height" => Value::Number(f64::from(options.height)),
            "input_file_name" => {
                Value::string(sources.iter().next().map_or("", |(_, source)| source.name.as_str()))
            }
            _ => Value::Number(options.animation.map_or(0.0, |animation| animation.number(name))),
        };
        for (name, _) in PREDECLARED {
            let symbol = scopes.intern(name);
            scopes.assign(symbol, predeclared(name));
        }
        for (name, value) in &options.declares {
            scopes.give(name, Value::Number(*value));
        }
        Self {
            sources,
            files,
            options,
            diagnostics,
            scene,
            announced: None,
            made: Vec::new(),
            scopes,
            macros: Vec::new(),
            bound: Vec::new(),
            functions: Vec::new(),
            broken_function: None,
            broken_functions: HashMap::new(),
            wrong_calls: Vec::new(),
            internals: Vec::new(),
            noise: NoiseGenerator::default(),
            says_noise: false,
            waves: 10,
            pictures: block::Pictures::default(),
            grids: block::Grids::default(),
            streams: RandomStreams::default(),
            opened: Vec::new(),
            unwritten: BTreeSet::new(),
            held_files: BTreeMap::new(),
            authored: BTreeSet::new(),
            frames: Vec::new(),
            enclosures: Vec::new(),
            loose_blocks: 0,
            loose_closers: 0,
            peeked: None,
            behind_name: None,
            silent: None,
            taken: None,
            hold: None,
            calls_wait: false,
            parsed: HashMap::new(),
            found: HashMap::new(),
            meshes: block::MeshFiles::default(),
            fonts: block::Fonts::new(),
            including: Vec::new(),
            default_texture: TextureId(0),
            is_ascii: options.dialect == Dialect::Pov,
            version: options.version.unwrap_or(3.7),
            has_version: options.version.is_some(),
            says_version: options.version.is_some(),
            warned_of_version: false,
            has_bare_textures: false,
            says_gamma: false,
            srgb_before_gamma: None,
            poison: None,
            beside: BTreeMap::new(),
            lacks_include: false,
            lacking: BTreeSet::new(),
            unread: BTreeSet::new(),
            missing_at: None,
            ends_told: Vec::new(),
            bounds: Vec::new(),
            assumed: Vec::new(),
            halted: false,
            macro_depth: 0,
            declaring: 0,
            declared_now: Vec::new(),
            calculating: 0,
            stored: 0,
            turns: 0,
            faulty_turns: 0,
            run_since_fault: 0,
            misread: false,
            asked: HashMap::new(),
            lost_children: 0,
            undecided: false,
            reports: 0,
            faults: 0,
            remembered: Remembered::default(),
            read: paths::Read::default(),
            openers: Vec::new(),
            owed: None,
            blocks: Vec::new(),
            in_radians: HashMap::new(),
            probes: HashMap::new(),
        }
    }

    fn run(&mut self, main: Ast) {
        let file = main.file;
        let unit = self.unit(main);
        let main_name = self.sources.get(file).name.clone();
        self.including.push(main_name);
        self.misread = self.diagnostics.has_errors();
        self.default_noise();
        let root = unit.ast.root;
        let here = Here { unit, expansion: ExpansionId::MAIN };
        self.inside(&here, root, Self::scene_items);
        self.scene.skipped = self.skipped(&here.unit.ast);
        self.note_old_version();
        self.warn_of_unread(&here.unit);
        if self.run_since_fault > MOST_RUN_SINCE_FAULT {
            self.diagnostics.help_first_error(format!(
                "behind an error loops and macros run {MOST_RUN_SINCE_FAULT} times at most: there may be more errors"
            ));
        }
        if self.halted {
            // Nobody looks at what there is of it.
            self.scene.roots.clear();
        }
        // The missing use may be in code that a mistake kept from running.
        if !self.halted && !self.diagnostics.has_errors() {
            self.lint_declarations(&here.unit);
            self.lint_options(&here.unit);
            self.warn_of_old_version(&here.unit, (self.says_version, self.says_gamma));
        } else {
            if let Some(says) = self.certainly_says() {
                self.warn_of_old_version(&here.unit, says);
            }
            if !self.halted && !self.lacks_file() {
                self.lint_lone_names(&here.unit);
                self.lint_options(&here.unit);
            }
        }
    }
}
