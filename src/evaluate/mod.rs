//! Ast to Scene: runs the language.
//!
//! **In:** the main file's Ast, and `Files` for what it includes. **Out:** a Scene without macro, loop,
//! include or name; always one, also from a broken input. **Invariant:** evaluation *pulls* items:
//! whoever needs the next item asks the stream for it, and directives, macro calls and includes
//! run in place, wherever they stand.

mod argument;
mod arity;
mod array;
mod block;
mod branch;
mod builtin;
mod call;
mod comparison;
mod concat;
mod directive;
mod element;
mod enclosure;
mod endless;
mod expand;
mod expression;
mod file;
mod formula;
mod function;
mod include;
mod joint;
mod lint;
mod memory;
mod options;
mod plain;
mod probe;
mod quirk;
mod remembered;
mod report;
mod run;
mod scope;
mod semicolon;
mod silent;
mod spline;
mod spread;
mod stream;
#[cfg(test)]
mod tests;
mod told;
mod turn;
mod unbounded;
mod undeclared;
mod unit;
mod unrun;
pub mod value;
mod vector;
mod way;
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

pub use options::{EvaluateOptions, Interrupt, Limits};

use builtin::RandomStreams;
use enclosure::Enclosure;
use expand::Macro;
use remembered::Remembered;
use scope::{Scopes, Symbol};
use stream::{Frame, Hold, MOST_RUN_SINCE_FAULT, Silent, Token};
use unit::{Here, Unit};
use value::{Poison, Value};

/// Runs `main`, which is gone then: of a big scene it is the larger half. Whatever is wrong goes to `diagnostics`.
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

/// It was reported; the nearest statement or object goes on without the value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Reported;

type Outcome<T> = Result<T, Reported>;

struct Evaluator<'a> {
    sources: &'a mut Sources,
    files: &'a dyn Files,
    options: &'a EvaluateOptions,
    diagnostics: &'a mut Diagnostics,
    scene: Scene,
    /// The number that says how many values follow, and how many were found up to here.
    announced: Option<(Span, usize)>,
    /// One for each object of the scene.
    made: Vec<block::Made>,
    scopes: Scopes,
    macros: Vec<Rc<Macro>>,
    /// Empty; the room in it is for the arguments of the next call.
    bound: Vec<expand::Bound>,
    functions: Vec<function::AuthorFunction>,
    /// The parameters of the function that was last not understood.
    broken_function: Option<usize>,
    /// How many parameters the declared functions have that were not understood.
    broken_functions: HashMap<Symbol, usize>,
    /// Calls of macros with too many arguments, or too few, which was told.
    wrong_calls: Vec<ExpansionId>,
    /// The functions that are built in and are formulas, by their number; empty until one is asked for.
    internals: Vec<Option<function::FunctionId>>,
    /// What functions of noise are made of.
    noise: NoiseGenerator,
    streams: RandomStreams,
    /// What `#fopen` has opened.
    opened: Vec<file::Opened>,
    /// What it may not write: what reads it lacks it, and that says nothing more.
    unwritten: BTreeSet<String>,
    /// What a `.pov` has written and may not, by the names that it gave.
    held_files: BTreeMap<String, Vec<u8>>,
    /// What it has written, under the names that it is found by.
    authored: BTreeSet<String>,
    frames: Vec<Frame>,
    enclosures: Vec<Enclosure>,
    /// How many of these blocks a loose `{` has opened.
    loose_blocks: u32,
    /// How often a `}` has closed another block than it would where it is written.
    loose_closers: u64,
    peeked: Option<Token>,
    /// The value in parentheses behind a name that was taken.
    behind_name: Option<Token>,
    /// The macro call just before the item that comes next that gave no item itself.
    silent: Option<Silent>,
    /// Where the item stood that a consumer took last: the end of what it is reading.
    taken: Option<Site>,
    /// While the value of a `#declare` is read. Looking past its end runs nothing there, since that may
    /// already ask for the value; what gave the value may end.
    hold: Option<Hold>,
    /// Within [`Self::peek_on`].
    calls_wait: bool,
    /// Files already read and parsed, by the name they were found under.
    parsed: HashMap<String, Rc<Unit>>,
    /// The name that a file was found under, by what an including file calls it.
    found: HashMap<(String, FileId), String>,
    /// What meshes were read from files.
    meshes: block::MeshFiles,
    /// Fonts that were read.
    fonts: block::Fonts,
    /// The names of the files that include each other now.
    including: Vec<String>,
    default_texture: TextureId,
    /// Strings hold nothing beyond ASCII: a `.pov` has not said `charset utf8` yet.
    is_ascii: bool,
    version: f64,
    /// Whether any file said `#version`; whether the scene did, and `assumed_gamma`.
    has_version: bool,
    says_version: bool,
    warned_of_version: bool,
    /// Words of pigments and finishes stand in textures, as before version 3.0.
    has_bare_textures: bool,
    says_gamma: bool,
    /// The first colour that was converted before `assumed_gamma` was said.
    srgb_before_gamma: Option<Site>,
    /// The first word inside the object being read that is not built yet.
    poison: Option<Poison>,
    /// Other words in the same item that are not built either, by the place of the first.
    beside: BTreeMap<Span, Vec<Poison>>,
    /// An include was not found: what is missing now may have been declared there.
    lacks_include: bool,
    /// The standard includes of which it was told that an included file takes them for granted.
    lacking: BTreeSet<String>,
    /// The names of such includes, as they were written.
    unread: BTreeSet<String>,
    /// Where a part was last found missing: what else is missing there says no more.
    missing_at: Option<Site>,
    /// The ends of loops, and how long the arrays were of which an element past them was told.
    ends_told: Vec<(Span, u32)>,
    /// What the last `bounded_by` held, for `clipped_by { bounded_by }`.
    bounds: Vec<ObjectId>,
    /// The names that were told as not declared, and count as declared since, in this order.
    assumed: Vec<Symbol>,
    /// Set by `#error` and by limits: nothing further is evaluated.
    halted: bool,
    macro_depth: u32,
    /// How many `#declare`s wait for their values.
    declaring: u32,
    /// Their names.
    declared_now: Vec<Symbol>,
    /// How many expressions are being calculated inside each other.
    calculating: u64,
    /// Bytes of what the scene holds beside its objects, about.
    stored: u64,
    /// Turns of all loops so far, and of those in which a mistake was met.
    turns: u64,
    faulty_turns: u64,
    /// Turns of loops and calls of macros since the first error.
    run_since_fault: u64,
    /// A file was not understood whole, so a loop may lack what ends it.
    misread: bool,
    /// Of each condition of such a file, whether it held, and whether it did not.
    asked: HashMap<DirectiveId, [bool; 2]>,
    /// How many children of unions and the like could not be made.
    lost_children: u64,
    /// In what is being read, a condition had no known value: what is missing may be in the branch not taken.
    undecided: bool,
    /// How often something was reported, repetitions included; and how often an error.
    reports: u64,
    faults: u64,
    /// What messages were made of, by their places.
    remembered: Remembered,
    read: way::Read,
    /// The words that opened the blocks being read, outermost first.
    openers: Vec<Span>,
    /// What a block lacks, to be told unless it stands too late in it.
    owed: Option<(Here, Diagnostic)>,
    /// All of each of these blocks, from brace to brace.
    blocks: Vec<Site>,
    /// Whether an expression is an angle in radians, as far as lints have asked.
    in_radians: HashMap<Span, bool>,
    /// What `trace` and its kin have looked at.
    probes: HashMap<crate::scene::ObjectId, Rc<probe::Probe>>,
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
                transforms: Vec::new(),
                site: nowhere,
                clear: vec![],
                pattern: Vec::new(),
            }],
            finishes: vec![Finish::Classic(ClassicFinish::default())],
            textures: vec![Texture {
                pigment: PigmentId(0),
                finish: FinishId(0),
                transforms: Vec::new(),
            }],
            ..Scene::default()
        };
        let mut scopes = Scopes::default();
        let predeclared = |name: &str| match name {
            "image_width" => Value::Number(f64::from(options.width)),
            "image_height" => Value::Number(f64::from(options.height)),
            "frame_number" | "initial_frame" | "final_frame" => Value::Number(options.frame_number),
            "initial_clock" | "final_clock" => Value::Number(options.clock),
            "input_file_name" => {
                Value::string(sources.iter().next().map_or("", |(_, source)| source.name.as_str()))
            }
            _ => Value::Number(0.0),
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
            version: 3.7,
            has_version: false,
            says_version: false,
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
            read: way::Read::default(),
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
        // What a mistake kept from being run may be the use that is missing.
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
