//! The syntax tree: items and expressions as typed.
//!
//! **Invariant:** flat arenas; a child precedes its parent, so nothing here recurses. Every byte of the
//! source is in a node, a comment or a blank.

use std::ops::Range;

use crate::source::{FileId, Span};
use crate::vocabulary::Word;

/// The tree of one parsed file. Always complete: a part that could not be parsed is
/// [`ExpressionKind::Missing`], and has been reported.
#[derive(Debug, Clone, PartialEq)]
pub struct Ast {
    pub file: FileId,
    /// The items of one block are contiguous; those of the file itself come last.
    pub items: Vec<Item>,
    pub expressions: Vec<Expression>,
    /// The heads and bodies of directives.
    pub directives: Vec<Directive>,
    /// Names that are not keywords, each once.
    pub names: Vec<String>,
    /// Lists that nodes index: arguments of calls, components of vectors, indices of targets.
    pub arguments: Vec<Argument>,
    /// The decoded literals of every number run.
    pub numbers: Vec<f64>,
    pub comments: Vec<Span>,
    pub root: Items,
}

/// A range of consecutive items.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Items {
    pub start: u32,
    pub end: u32,
}

/// A range of consecutive arguments.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Arguments {
    pub start: u32,
    pub end: u32,
}

impl Items {
    pub fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
    pub fn is_empty(self) -> bool {
        self.start == self.end
    }
}

impl Arguments {
    pub fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ExpressionId(pub u32);

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct DirectiveId(pub u32);

/// Index into [`Ast::names`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NameId(pub u32);

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Item {
    pub kind: ItemKind,
    pub span: Span,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ItemKind {
    /// A keyword that is not a value: `sphere`, `rotate`, `color`, `rgb`.
    Word(Word),
    /// A value: a sum, or (inside parentheses and in function bodies) a full expression.
    Expression(ExpressionId),
    /// `{ … }`.
    Block(Items),
    /// `[ … ]` that is not an index: an entry of a map, the size of an array.
    Entry(Items),
    /// A `{` that pairs only after expansion: `#macro Open() union { #end`.
    Open,
    /// A `}` that pairs only after expansion.
    Close,
    Comma,
    Semicolon,
    Directive(DirectiveId),
    /// A long run of literals, each followed by a comma: `numbers[start .. start + count · width]`. Plain
    /// numbers if `width` is 1, else vectors of that many components.
    Numbers {
        start: u32,
        count: u32,
        width: u32,
    },
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expression {
    pub kind: ExpressionKind,
    pub span: Span,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ExpressionKind {
    Number(f64),
    /// The span with its quotes; escapes are decoded on use (not in paths).
    String,
    /// A declared name.
    Name(NameId),
    /// A keyword that is a value: `x`, `pi`, `clock`, `true`.
    Word(Word),
    Unary(UnaryOperator, ExpressionId),
    Binary(BinaryOperator, ExpressionId, ExpressionId),
    /// `a ? b : c`.
    Conditional(ExpressionId, ExpressionId, ExpressionId),
    /// `<a, b, c>`.
    Vector(Arguments),
    /// `<1, -2.5, 0>`, one node instead of up to seven: most of a large text is these.
    Triple(Triple),
    /// `f(a, b)`: a built-in function, a macro or a user's function.
    Call(Callee, Arguments),
    /// `a[i]`.
    Index(ExpressionId, ExpressionId),
    /// `a.x`, `c.red`. The component's name is a keyword if the language has it.
    Component(ExpressionId, Component),
    /// `( … )` around one expression.
    Group(ExpressionId),
    /// `( … )` around anything else: directives, several values.
    GroupItems(Items),
    /// The operand on the other side of a directive: `(2 #if (A) * 3 #end)`, `(2 * #if (A) 3 #end)`.
    Joint,
    /// A part that could not be parsed and was reported.
    Missing,
}

/// A vector of three finite literals, each with or without a `-`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Triple {
    /// The index of the first in [`Ast::numbers`].
    pub numbers: u32,
    /// The bytes between the `<` and the start of each.
    pub starts: [u8; 3],
    /// The bytes between the `<` and the end of each.
    pub ends: [u8; 3],
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnaryOperator {
    Plus,
    Minus,
    Not,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BinaryOperator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Less,
    LessOrEqual,
    Equal,
    NotEqual,
    GreaterOrEqual,
    Greater,
    And,
    Or,
}

/// The precedence of an operator; a higher rank binds first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rank {
    Conditional,
    Logical,
    Relational,
    Sum,
    Product,
    Unary,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Callee {
    /// A built-in function and the span of its keyword.
    Word(Word, Span),
    /// A macro or a function of the author's.
    Name(NameId, Span),
    /// A function or a spline in an array: `A[1](0.5)`, without a blank before the parenthesis.
    Element(ExpressionId),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Component {
    Word(Word, Span),
    Name(NameId, Span),
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Argument {
    Expression(ExpressionId),
    /// A block or several items as one argument: `M(pigment { Red })`.
    Items(Items),
}

#[derive(Debug, Clone, PartialEq)]
pub struct Directive {
    pub kind: DirectiveKind,
    /// The `#` and its keyword.
    pub head: Span,
}

/// The name that a directive assigns to or tests: `Name[i][j]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    pub name: NameId,
    pub indices: Vec<ExpressionId>,
    pub span: Span,
}

#[derive(Debug, Clone, PartialEq)]
pub enum DirectiveKind {
    /// `#declare Name =` or `#local Name =`: the value is the result of the following items.
    Declare {
        local: bool,
        target: Target,
    },
    Undef(Target),
    If {
        test: Test,
        then: Items,
        otherwise: Items,
    },
    While {
        condition: ExpressionId,
        body: Items,
    },
    /// `#for (Name, from, to, step)`.
    For {
        name: NameId,
        name_span: Span,
        from: ExpressionId,
        to: ExpressionId,
        step: Option<ExpressionId>,
        body: Items,
    },
    Switch {
        value: ExpressionId,
        /// Items before the first case: evaluated whatever the value is, as in POV-Ray.
        lead: Items,
        cases: Vec<Case>,
    },
    Break,
    Macro {
        name: NameId,
        name_span: Span,
        parameters: Vec<Parameter>,
        body: Body,
    },
    Include(ExpressionId),
    /// `#default { … }`.
    Default(Items),
    Version(ExpressionId),
    Debug(ExpressionId),
    Warning(ExpressionId),
    Error(ExpressionId),
    /// `#fopen Name "file" read`; the mode is `read`, `write` or `append`, or missing, which was reported.
    Fopen {
        name: NameId,
        name_span: Span,
        file: ExpressionId,
        mode: Option<Word>,
    },
    Fclose {
        name: NameId,
        name_span: Span,
    },
    Read {
        name: NameId,
        name_span: Span,
        targets: Vec<Target>,
    },
    Write {
        name: NameId,
        name_span: Span,
        arguments: Arguments,
    },
    /// `#render`, `#statistics`: output as by `#debug`, since their own streams no longer exist.
    OldStream(ExpressionId),
    /// The body of a directive that could not be parsed, in a `.pov`: it is parsed, and its errors are
    /// reported, when it is run.
    Unread,
    /// Could not be parsed; reported.
    Malformed,
}

/// The test of `#if`, `#ifdef`, `#ifndef` and `#elseif`. An `#elseif` is an `If` alone in `otherwise`.
#[derive(Debug, Clone, PartialEq)]
pub enum Test {
    Condition(ExpressionId),
    Defined(Target),
    NotDefined(Target),
}

#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    pub kind: CaseKind,
    /// Items up to the next case; control falls through into it unless a `#break` comes first.
    pub body: Items,
}

#[derive(Debug, Clone, PartialEq)]
pub enum CaseKind {
    Value(ExpressionId),
    Range(ExpressionId, ExpressionId),
    Otherwise,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    pub name: NameId,
    pub span: Span,
    /// `optional Name` of version 3.8.
    pub optional: bool,
}

#[derive(Debug, Clone, PartialEq)]
pub enum Body {
    Items(Items),
    /// The bytes between head and `#end` of a macro whose parentheses pair only after expansion, as in one
    /// standard include. (Such braces are [`ItemKind::Open`] and [`ItemKind::Close`].)
    Raw(Span),
}

impl Ast {
    /// Returns whether every non-ASCII character of `text`, the text of this tree, is in a comment.
    pub fn is_ascii_but_for_comments(&self, text: &str) -> bool {
        let in_comment = |at: usize| {
            let after = self.comments.partition_point(|span| span.start as usize <= at);
            after.checked_sub(1).is_some_and(|last| self.comments[last].range().contains(&at))
        };
        text.char_indices().all(|(at, c)| c.is_ascii() || in_comment(at))
    }

    pub fn items(&self, items: Items) -> &[Item] {
        &self.items[items.range()]
    }
    pub fn expression(&self, id: ExpressionId) -> &Expression {
        &self.expressions[id.0 as usize]
    }
    /// Returns the numbers of a triple.
    pub fn triple(&self, triple: Triple) -> [f64; 3] {
        let first = triple.numbers as usize;
        match self.numbers.get(first..first + 3) {
            Some(&[x, y, z]) => [x, y, z],
            _ => [0.0; 3],
        }
    }
    pub fn directive(&self, id: DirectiveId) -> &Directive {
        &self.directives[id.0 as usize]
    }
    pub fn arguments(&self, arguments: Arguments) -> &[Argument] {
        &self.arguments[arguments.range()]
    }
    pub fn name(&self, id: NameId) -> &str {
        &self.names[id.0 as usize]
    }
}

impl Triple {
    /// Returns the spans of its numbers, signs included; `whole` is its own.
    pub fn spans(self, whole: Span) -> [Span; 3] {
        std::array::from_fn(|i| Span {
            start: whole.start + u32::from(self.starts[i]),
            end: whole.start + u32::from(self.ends[i]),
            ..whole
        })
    }
}

impl UnaryOperator {
    /// Returns its source symbol.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Plus => "+",
            Self::Minus => "-",
            Self::Not => "!",
        }
    }
}

impl BinaryOperator {
    /// Returns its precedence.
    pub fn rank(self) -> Rank {
        match self {
            Self::Multiply | Self::Divide => Rank::Product,
            Self::Add | Self::Subtract => Rank::Sum,
            Self::Less
            | Self::LessOrEqual
            | Self::Equal
            | Self::NotEqual
            | Self::GreaterOrEqual
            | Self::Greater => Rank::Relational,
            Self::And | Self::Or => Rank::Logical,
        }
    }

    /// Returns its source symbol.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Less => "<",
            Self::LessOrEqual => "<=",
            Self::Equal => "=",
            Self::NotEqual => "!=",
            Self::GreaterOrEqual => ">=",
            Self::Greater => ">",
            Self::And => "&",
            Self::Or => "|",
        }
    }
}
