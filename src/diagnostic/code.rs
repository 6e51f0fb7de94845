//! Defines the closed list of diagnostic codes; each has a page in `docs/diagnostics/`.

use super::Severity;

macro_rules! codes {
    ($($variant:ident $name:literal $severity:ident $sentence:literal;)*) => {
        /// Diagnostic code. `lucarne explain CODE` prints its page.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Code { $(#[doc = $sentence] $variant,)* }

        impl Code {
            /// All codes.
            pub const ALL: &[Code] = &[$(Code::$variant),*];

            /// Returns the name shown to the user: `unknown-word`.
            pub fn name(self) -> &'static str {
                match self { $(Code::$variant => $name),* }
            }

            /// Returns its severity where no level changes it.
            pub fn severity(self) -> Severity {
                match self { $(Code::$variant => codes!(@severity $severity)),* }
            }

            /// Whether this is a lint: a message about something that a correct scene might contain.
            pub fn is_lint(self) -> bool {
                match self { $(Code::$variant => codes!(@lint $severity)),* }
            }

            /// Whether this lint is also reported for `.pov` files, because no finished scene triggers it.
            pub fn is_sure(self) -> bool {
                match self { $(Code::$variant => codes!(@sure $severity)),* }
            }

            /// Whether this lint is reported only if requested by name or with all others, because it does
            /// not indicate a problem.
            pub fn is_quiet(self) -> bool {
                match self { $(Code::$variant => codes!(@quiet $severity)),* }
            }

            /// Whether this message is a warning by default.
            pub fn warns(self) -> bool {
                self.severity() == Severity::Warning
            }

            /// Whether this error is only a warning in `.pov` files, because POV-Ray 3.7 renders the scene
            /// anyway.
            pub fn is_opinion(self) -> bool {
                match self { $(Code::$variant => codes!(@opinion $severity)),* }
            }

            /// Whether this message is or may be a warning, and therefore has a level and can be silenced.
            pub fn may_warn(self) -> bool {
                self.warns() || self.is_opinion()
            }

            /// Returns a one-sentence summary.
            pub fn sentence(self) -> &'static str {
                match self { $(Code::$variant => $sentence),* }
            }

            /// Returns the page in Markdown: what the message means, an example, and how to fix it.
            pub fn page(self) -> &'static str {
                match self {
                    $(Code::$variant => {
                        include_str!(concat!("../../docs/diagnostics/", $name, ".md"))
                    })*
                }
            }

            /// Returns the code with this name.
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|code| code.name() == name)
            }
        }
    };
    (@severity error) => { Severity::Error };
    (@severity opinion) => { Severity::Error };
    (@severity warning) => { Severity::Warning };
    (@severity lint) => { Severity::Warning };
    (@severity sure) => { Severity::Warning };
    (@severity quiet) => { Severity::Warning };
    (@severity note) => { Severity::Note };
    (@lint lint) => { true };
    (@lint sure) => { true };
    (@lint quiet) => { true };
    (@lint $other:ident) => { false };
    (@sure sure) => { true };
    (@sure $other:ident) => { false };
    (@opinion opinion) => { true };
    (@opinion $other:ident) => { false };
    (@quiet quiet) => { true };
    (@quiet $other:ident) => { false };
}

codes! {
    // form
    UnclosedBlock "unclosed-block" error "a brace, bracket, parenthesis or angle was opened and never closed";
    UnclosedString "unclosed-string" error "a string has no closing quote";
    UnclosedComment "unclosed-comment" error "a comment was opened and never closed";
    StrayCloser "stray-closer" error "a closing brace, bracket, parenthesis or angle has no opener";
    MissingEnd "missing-end" error "a directive such as `#if` or `#macro` has no `#end`";
    StrayDirective "stray-directive" error "an `#else`, `#end` or `#case` stands outside its directive";
    UnexpectedCharacter "unexpected-character" error "a character has no meaning in the language";
    MalformedNumber "malformed-number" error "a number is not written as a number";
    ExpectedExpression "expected-expression" error "a value was expected here";
    NestingLimit "nesting-limit" error "brackets, directives, signs or declarations are nested deeper than the limit";
    UnreadBranch "unread-branch" sure "a branch that is not run is not in the language";
    ControlCharacter "control-character" lint "a character that cannot be seen stands in the text";
    BadEncoding "bad-encoding" lint "the file is not UTF-8 and was read as Latin-1";
    // words and names
    UnknownWord "unknown-word" opinion "a word is not known in this place";
    UndeclaredName "undeclared-name" error "a name is used and was never declared";
    ReservedName "reserved-name" error "a word of the language cannot be declared";
    RedeclaredFunction "redeclared-function" error "a function or a macro is declared again as something else, without `#undef`";
    NotSupportedYet "not-supported-yet" opinion "the language has this word, and this version does not build it yet";
    ForeignWord "foreign-word" error "a word of another tool stands where ours has another name";
    UnknownDirective "unknown-directive" opinion "the word after `#` is not a directive";
    // values
    WrongType "wrong-type" opinion "a value has another type than the place needs";
    WrongArity "wrong-arity" error "a call or a vector has too many or too few parts";
    MissingPart "missing-part" opinion "a block lacks a part it cannot do without";
    ExtraPart "extra-part" opinion "a block has more parts than it can use";
    DivisionByZero "division-by-zero" opinion "a number is divided by zero";
    NotANumber "not-a-number" opinion "a calculation has no finite result";
    OutOfRange "out-of-range" opinion "a number lies outside what the place allows";
    ZeroScale "zero-scale" opinion "a transform flattens everything to nothing";
    ZeroSize "zero-size" opinion "a shape has no size";
    ZeroVector "zero-vector" opinion "a direction or normal is the zero vector";
    MixedFinish "mixed-finish" error "a finish mixes the seed's words with POV-Ray's";
    IncompleteFinish "incomplete-finish" error "`kd`, `ks` and `phong_exponent` come together";
    NotCallable "not-callable" error "something is called that is neither a macro nor a function";
    // scene as a whole
    NoCamera "no-camera" lint "the scene has no camera";
    PictureShape "picture-shape" lint "the picture and the camera have different shapes, so pixels are not square";
    DuplicateCamera "duplicate-camera" sure "the scene has two cameras; the last one is used";
    MisplacedBlock "misplaced-block" error "a block stands inside another that cannot hold it";
    DegenerateCamera "degenerate-camera" opinion "the camera's directions leave no picture plane";
    NoLight "no-light" lint "nothing gives light, so the picture is dark";
    EmptyScene "empty-scene" lint "the scene shows nothing";
    UnusedDeclaration "unused-declaration" lint "a declared name is never used";
    NeverPlaced "never-placed" lint "a declared object is never placed in the scene";
    NothingInView "nothing-in-view" sure "every object lies outside of what the camera sees";
    FarAway "far-away" lint "an object is too far from the camera, for its size, to be drawn exactly";
    LowIor "low-ior" sure "an index of refraction is below 1";
    NoPigment "no-pigment" lint "an object has no pigment, and is black";
    MissingColor "missing-color" sure "a pattern is given fewer colours than it takes";
    SuspiciousUnit "suspicious-unit" sure "an angle looks like radians where degrees are meant, or a part like a percentage";
    DeepTrace "deep-trace" warning "rays are to be followed deeper than POV-Ray follows them";
    ShortVector "short-vector" lint "a vector is written with fewer numbers than its place has";
    LostComma "lost-comma" sure "two numbers of a vector, of which the second has a sign, have no comma between them";
    ColorRange "color-range" sure "a colour looks as if written as 0 to 255, or is negative";
    UnlikelyFinish "unlikely-finish" lint "a number of a finish that no surface has, or that another one hides";
    UnlikelyLight "unlikely-light" lint "words of a light have no effect, or contradict each other";
    EnclosedLight "enclosed-light" sure "a light stands inside an opaque object, and lights nothing outside of it";
    TooClear "too-clear" lint "a colour is clearer than it can be";
    FresnelWithoutIor "fresnel-without-ior" lint "`fresnel` on an object without an index of refraction";
    NegativeSize "negative-size" sure "a radius is negative; its absolute value is used";
    DegenerateShape "degenerate-shape" lint "a shape is flat or has nothing inside";
    DegenerateTriangle "degenerate-triangle" sure "the corners of a triangle lie in a line";
    NothingLeft "nothing-left" sure "nothing is left of an intersection, a difference, or an object that is clipped";
    TakesNothing "takes-nothing" lint "what a difference takes away does not reach what it takes it from";
    OpenOutline "open-outline" sure "the outline of a shape does not end where it began, and is closed";
    CoincidingFaces "coinciding-faces" quiet "faces of two parts of one solid coincide, where POV-Ray draws speckles";
    ClearTwice "clear-twice" sure "clear objects stand in one place, where each counts, and POV-Ray shows one";
    ComparedSurface "compared-surface" sure "the formula of a surface is an equation, which is 0 or 1";
    UnsortedMap "unsorted-map" sure "the entries of a map are not in rising order";
    MapRange "map-range" lint "an entry of a map lies where a pattern has no values";
    HeightRange "height-range" lint "heights of a function go beyond 0 to 1, where they begin anew";
    MissingBreak "missing-break" quiet "a case of a `#switch` without `#break` runs on into the next one";
    NeverRuns "never-runs" sure "a loop counts away from its end, so it has no turn, or a case is never chosen as it is meant";
    CountedTwice "counted-twice" sure "a `#for` that counts by itself is counted on in its body, too";
    FractionalIndex "fractional-index" lint "an index or a count is not whole; its fraction is dropped";
    ShortFile "short-file" sure "a file of values ends in the middle of what `#read` reads together";
    ReplacedPigment "replaced-pigment" lint "an object or a texture has two pigments; the last one is used";
    RepeatedTime "repeated-time" sure "a spline has two values for one time, and one of them does not count";
    RepeatedParameter "repeated-parameter" sure "two parameters of a macro have one name";
    LooseOperation "loose-operation" sure "an operation is taken otherwise than it looks: of what a macro leaves, or in a condition";
    LegacyForm "legacy-form" lint "an old form of the language";
    UnknownLint "unknown-lint" lint "a comment that is to silence a warning does not";
    // files
    MissingInclude "missing-include" error "an included file is not found";
    CircularInclude "circular-include" error "a file includes itself";
    ForbiddenFile "forbidden-file" opinion "a file lies outside the folders that `--sandbox` allows, or may not be written";
    ForeignFile "foreign-file" error "a file is another program's, and no scene";
    MalformedMesh "malformed-mesh" error "a mesh's file is not what its format says, or of no format that is read";
    IncompleteMesh "incomplete-mesh" sure "a mesh's file asks for what is not there, or not read";
    UnreadableFile "unreadable-file" error "a file is there and cannot be read, or cannot be made";
    StandInFont "stand-in-font" lint "a font of POV-Ray's is not there, and the built-in one is used";
    MissingLetter "missing-letter" lint "a text has a letter that its font does not have";
    // limits
    LoopLimit "loop-limit" error "a loop turns more often than the limit";
    MacroLimit "macro-limit" error "macros call each other deeper than the limit";
    IncludeLimit "include-limit" error "files include each other deeper than the limit";
    StringLimit "string-limit" error "a string is longer than the limit";
    MemoryLimit "memory-limit" error "what the scene has to remember is larger than the limit";
    ObjectLimit "object-limit" error "the scene has more objects than the limit";
    // the author's own
    AuthorError "author-error" error "the scene's own `#error`";
    AuthorWarning "author-warning" warning "the scene's own `#warning`";
    AuthorDebug "author-debug" note "the scene's own `#debug`";
    SilentMacro "silent-macro" warning "a macro called for a value leaves none, and what comes next is taken";
    Comma "comma" warning "a comma stands where it parts no values";
    ExtraComponent "extra-component" warning "a colour is given more components than its word takes";
    Semicolon "semicolon" warning "a `;` is missing behind a declared number, or stands where none can";
    OldVersion "old-version" warning "a `.pov` file without `#version` or `assumed_gamma`, or of a version to come or of a patch";
}

impl Code {
    /// Whether this error reports that a limit was exceeded, which `--limit` raises.
    pub fn is_limit(self) -> bool {
        matches!(
            self,
            Self::LoopLimit
                | Self::MacroLimit
                | Self::IncludeLimit
                | Self::ObjectLimit
                | Self::MemoryLimit
                | Self::StringLimit
                | Self::NestingLimit
        )
    }

    /// Whether this syntax error makes the parser assign the text after it to the wrong blocks.
    pub fn shifts_what_follows(self) -> bool {
        matches!(
            self,
            Self::UnclosedBlock
                | Self::UnclosedString
                | Self::UnclosedComment
                | Self::StrayCloser
                | Self::MissingEnd
                | Self::NestingLimit
        )
    }

    /// Whether the message says that a calculation with the given values has no result.
    pub fn is_about_calculation(self) -> bool {
        matches!(
            self,
            Self::DivisionByZero | Self::NotANumber | Self::OutOfRange | Self::ZeroVector
        )
    }

    /// Whether the message says that something is misplaced or missing.
    pub fn is_about_place(self) -> bool {
        matches!(
            self,
            Self::MisplacedBlock
                | Self::ExtraPart
                | Self::MissingPart
                | Self::ExpectedExpression
                | Self::UnknownWord
                | Self::WrongArity
                | Self::ExtraComponent
                | Self::UnusedDeclaration
                | Self::NeverPlaced
        )
    }
}
