//! Splits a text into atoms, its tokens and comments in order, without blanks.
//!
//! **In:** a text without errors, and its tree. **Out:** its atoms, each with its role in the layout.
//! **Invariant:** the atoms' texts, joined, are the text without its blanks.

use std::borrow::Cow;

use crate::source::{Source, Span};
use crate::syntax::ast::{Ast, Callee, ExpressionKind, ItemKind};
use crate::syntax::numbers::{Piece, Pieces};
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::vocabulary::Word;

/// One token, one number of a run, or one comment.
#[derive(Debug, Clone)]
pub(super) struct Atom<'a> {
    pub kind: Kind,
    pub text: Cow<'a, str>,
    /// The number of line breaks between the previous atom and this one.
    pub lines: usize,
    /// The first of these line breaks is `\r\n`.
    pub wide: bool,
    /// The number of columns before it in its line; a tab advances to the next multiple of eight.
    pub column: usize,
}

/// The role of an atom in the layout.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A keyword that is an item of its own.
    Word(Word),
    /// A word that is a keyword only in its block.
    OwnWord,
    /// A number, a string, a name, or a keyword that is a value.
    Value,
    /// The callee of the parenthesis that follows.
    Callee,
    Directive(Head),
    Open(Pair),
    Close(Pair),
    /// A brace that pairs only after expansion.
    LooseOpen,
    LooseClose,
    Comma,
    Semicolon,
    Dot,
    /// `-`, `+` or `!` before its operand.
    Sign,
    /// `*` or `/`.
    Product,
    /// Any other operator between two operands.
    Operator,
    /// The `=` of a declaration.
    Assign,
    LineComment,
    BlockComment,
    /// A macro's body that is kept as it is.
    Raw,
    Stray,
}

/// Kinds of brackets, by their effect on the layout.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pair {
    Brace,
    /// `[ … ]` as an item.
    Entry,
    Index,
    Round,
    /// A vector's `< … >`.
    Angle,
}

impl Kind {
    pub fn is_comment(self) -> bool {
        matches!(self, Kind::LineComment | Kind::BlockComment)
    }

    /// Returns whether it is a directive that ends with its own `#end`.
    pub fn opens_directive(self) -> bool {
        matches!(self, Kind::Directive(head) if head.opens())
    }

    pub fn divides(self) -> bool {
        matches!(self, Kind::Directive(head) if head.divides())
    }

    pub fn opens(self) -> bool {
        matches!(self, Kind::Open(_)) || self.opens_directive()
    }

    pub fn closes(self) -> bool {
        matches!(self, Kind::Close(_) | Kind::Directive(Head::End))
    }
}

impl Atom<'_> {
    /// Returns whether it spans several lines.
    pub fn is_tall(&self) -> bool {
        self.text.contains('\n')
    }

    pub fn width(&self) -> usize {
        match self.text.is_ascii() {
            true => self.text.len(),
            false => self.text.chars().count(),
        }
    }
}

/// Information about a byte that the tree has and its token lacks.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    None,
    Item,
    Callee,
    Sign,
    Angle,
    Index,
}

fn roles(ast: &Ast, length: usize) -> Vec<Role> {
    let mut roles = vec![Role::None; length + 1];
    let mut set = |at: usize, role: Role| {
        if let Some(place) = roles.get_mut(at) {
            *place = role;
        }
    };
    let before_end = |span: Span| (span.end as usize).saturating_sub(1);
    for item in &ast.items {
        if let ItemKind::Word(_) = item.kind {
            set(item.span.start as usize, Role::Item);
        }
    }
    for node in &ast.expressions {
        match node.kind {
            ExpressionKind::Unary(..) => set(node.span.start as usize, Role::Sign),
            ExpressionKind::Vector(_) => {
                set(node.span.start as usize, Role::Angle);
                set(before_end(node.span), Role::Angle);
            }
            ExpressionKind::Triple(triple) => {
                set(node.span.start as usize, Role::Angle);
                set(before_end(node.span), Role::Angle);
                for (number, span) in ast.triple(triple).into_iter().zip(triple.spans(node.span)) {
                    if number.is_sign_negative() {
                        set(span.start as usize, Role::Sign);
                    }
                }
            }
            ExpressionKind::Call(Callee::Word(_, span) | Callee::Name(_, span), _) => {
                set(span.start as usize, Role::Callee);
            }
            ExpressionKind::Index(..) | ExpressionKind::Call(Callee::Element(_), _) => {
                set(before_end(node.span), Role::Index);
            }
            ExpressionKind::Number(_)
            | ExpressionKind::String
            | ExpressionKind::Name(_)
            | ExpressionKind::Word(_)
            | ExpressionKind::Binary(..)
            | ExpressionKind::Conditional(..)
            | ExpressionKind::Component(..)
            | ExpressionKind::Group(_)
            | ExpressionKind::GroupItems(_)
            | ExpressionKind::Joint
            | ExpressionKind::Missing => {}
        }
    }
    roles
}

/// Returns the atoms of `source`, whose `tokens` pair. `quiet` is its text without comments.
pub(super) fn atoms<'a>(
    source: &'a Source,
    quiet: &str,
    tokens: &[Token],
    ast: &Ast,
) -> Vec<Atom<'a>> {
    let mut list = List {
        text: &source.text,
        roles: roles(ast, source.text.len()),
        atoms: Vec::with_capacity(tokens.len() + ast.comments.len()),
        end: 0,
        line: 0,
        declares: false,
        kept: 0,
    };
    let mut comments = ast.comments.iter().peekable();
    let parts = tokens.iter().flat_map(|&token| parts(token, quiet));
    for token in parts {
        while let Some(comment) = comments.next_if(|comment| comment.start < token.start) {
            // A body that is kept as it is contains its comments.
            if comment.start as usize >= list.kept {
                list.comment(*comment);
            }
        }
        list.token(token);
    }
    comments.for_each(|comment| list.comment(*comment));
    list.atoms
}

/// Returns the tokens of a run of numbers; any other token alone.
pub(super) fn parts(token: Token, quiet: &str) -> Vec<Token> {
    if !matches!(token.kind, TokenKind::Numbers | TokenKind::Vectors) {
        return vec![token];
    }
    let part = |kind, from: usize, to: usize| Token {
        kind,
        start: token.start + from as u32,
        end: token.start + to as u32,
    };
    let run = quiet.get(token.start as usize..token.end as usize).unwrap_or("");
    let parts = Pieces::of(run).map(|(at, piece)| match piece {
        Piece::Number { start, end } => part(TokenKind::Number, start, end),
        Piece::Open => part(TokenKind::Vectors, at, at + 1),
        Piece::Close => part(TokenKind::Numbers, at, at + 1),
        Piece::Comma => part(TokenKind::Mark(Mark::Comma), at, at + 1),
    });
    parts.collect()
}

struct List<'a> {
    text: &'a str,
    roles: Vec<Role>,
    atoms: Vec<Atom<'a>>,
    /// The end of the last atom.
    end: usize,
    /// The start of the line in which it ends.
    line: usize,
    /// In the head of a declaration, before its `=`.
    declares: bool,
    /// The end of the last body that is kept as it is.
    kept: usize,
}

impl<'a> List<'a> {
    fn add(&mut self, kind: Kind, start: usize, end: usize) {
        let text = self.text.get(start..end).unwrap_or("");
        let gap = self.text.get(self.end..start).unwrap_or("");
        let lines = count_lines(gap);
        let wide = gap.trim_start_matches([' ', '\t']).starts_with("\r\n");
        if let Some(at) = gap.rfind(['\n', '\r']) {
            self.line = self.end + at + 1;
        }
        // Only comments keep their columns.
        let column = match kind {
            Kind::LineComment | Kind::BlockComment => {
                columns(self.text.get(self.line..start).unwrap_or(""))
            }
            _ => 0,
        };
        let shown = match kind {
            Kind::Directive(head) => Cow::Owned(format!("#{}", head.word())),
            Kind::LineComment => Cow::Borrowed(text.trim_end()),
            Kind::BlockComment => with_plain_lines(text),
            _ => Cow::Borrowed(text),
        };
        self.atoms.push(Atom { kind, text: shown, lines, wide, column });
        self.end = end;
        if let Some(at) = text.rfind(['\n', '\r']) {
            self.line = start + at + 1;
        }
    }

    fn comment(&mut self, span: Span) {
        let (start, end) = (span.start as usize, span.end as usize);
        let kind = match self.text.get(start..) {
            Some(text) if text.starts_with("//") => Kind::LineComment,
            _ => Kind::BlockComment,
        };
        self.add(kind, start, end);
    }

    fn token(&mut self, token: Token) {
        let (start, end) = (token.start as usize, token.end as usize);
        let role = self.roles.get(start).copied().unwrap_or(Role::None);
        let kind = match token.kind {
            TokenKind::Word(_) | TokenKind::Name if role == Role::Callee => Kind::Callee,
            TokenKind::Word(word) if role == Role::Item => Kind::Word(word),
            TokenKind::Name if role == Role::Item => Kind::OwnWord,
            TokenKind::Word(_)
            | TokenKind::Name
            | TokenKind::Number
            | TokenKind::Triple
            | TokenKind::String => Kind::Value,
            TokenKind::Directive(head) => {
                self.declares = matches!(head, Head::Declare | Head::Local);
                Kind::Directive(head)
            }
            TokenKind::LooseOpen => Kind::LooseOpen,
            TokenKind::LooseClose => Kind::LooseClose,
            TokenKind::Raw | TokenKind::Unread => return self.raw(start, end),
            TokenKind::Stray => Kind::Stray,
            TokenKind::Mark(mark) => self.mark(mark, role),
            // A vector's brackets in a run: see `parts`.
            TokenKind::Vectors => Kind::Open(Pair::Angle),
            TokenKind::Numbers => Kind::Close(Pair::Angle),
        };
        self.add(kind, start, end);
    }

    /// Adds a body unchanged, starting at the indentation of its first line.
    fn raw(&mut self, start: usize, end: usize) {
        let body = self.text.get(start..end).unwrap_or("");
        let blank = body.len() - body.trim_start().len();
        let line = body[..blank].rfind(['\n', '\r']).map_or(blank, |line| line + 1);
        self.add(Kind::Raw, start + line, start + body.trim_end().len());
        self.kept = end;
    }

    fn mark(&mut self, mark: Mark, role: Role) -> Kind {
        match mark {
            Mark::Open(Bracket::Brace) => Kind::Open(Pair::Brace),
            Mark::Close(Bracket::Brace) => Kind::Close(Pair::Brace),
            Mark::Open(Bracket::Round) => Kind::Open(Pair::Round),
            // `A[1](x)`: the bracket of a called element touches it, too.
            Mark::Close(Bracket::Round) if role == Role::Index => Kind::Close(Pair::Index),
            Mark::Close(Bracket::Round) => Kind::Close(Pair::Round),
            // Their closers show which of them are indices.
            Mark::Open(Bracket::Square) => Kind::Open(Pair::Entry),
            Mark::Close(Bracket::Square) if role == Role::Index => Kind::Close(Pair::Index),
            Mark::Close(Bracket::Square) => Kind::Close(Pair::Entry),
            Mark::Less if role == Role::Angle => Kind::Open(Pair::Angle),
            Mark::Greater | Mark::GreaterOrEqual if role == Role::Angle => Kind::Close(Pair::Angle),
            Mark::Comma => Kind::Comma,
            Mark::Semicolon => Kind::Semicolon,
            Mark::Dot => Kind::Dot,
            Mark::Not => Kind::Sign,
            Mark::Plus | Mark::Minus if role == Role::Sign => Kind::Sign,
            Mark::Star | Mark::Slash => Kind::Product,
            Mark::Equal if std::mem::take(&mut self.declares) => Kind::Assign,
            Mark::Plus
            | Mark::Minus
            | Mark::Less
            | Mark::LessOrEqual
            | Mark::Equal
            | Mark::NotEqual
            | Mark::GreaterOrEqual
            | Mark::Greater
            | Mark::And
            | Mark::Or
            | Mark::Question
            | Mark::Colon => Kind::Operator,
        }
    }
}

/// Counts line ends: `\n`, `\r\n` and `\r`.
fn count_lines(gap: &str) -> usize {
    let bytes = gap.as_bytes();
    let ends = bytes.iter().enumerate().filter(|&(at, byte)| match byte {
        b'\n' => true,
        b'\r' => bytes.get(at + 1) != Some(&b'\n'),
        _ => false,
    });
    ends.count()
}

/// Returns the width of a line's text on a terminal.
pub(super) fn columns(text: &str) -> usize {
    text.chars().fold(0, |column, c| if c == '\t' { (column / 8 + 1) * 8 } else { column + 1 })
}

/// Returns the text with `\n` for every line end.
pub(super) fn with_plain_lines(text: &str) -> Cow<'_, str> {
    match text.contains('\r') {
        true => Cow::Owned(text.replace("\r\n", "\n").replace('\r', "\n")),
        false => Cow::Borrowed(text),
    }
}
