//! Nests the flat tokens into a tree, with an explicit stack of open brackets and directives.
//!
//! **In:** tokens whose brackets and directives pair (see `balance`). **Out:** an [`Ast`]. **Invariant:** one
//! pass, no recursion; each open bracket has a level of expressions: a *sum* where values are adjacent,
//! *full* where comparisons cannot be mistaken for vectors.

use std::collections::HashMap;

use super::ParseOptions;
use super::ast::{
    Argument, Arguments, Ast, Callee, DirectiveKind, Expression, ExpressionId, ExpressionKind,
    Item, ItemKind, Items, NameId,
};
use super::comment::Quiet;
use super::directive::Body;
use super::expression::Stacks;
use super::old_words;
use super::token::{Bracket, Head, Token, TokenKind};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};
use crate::vocabulary::{Dialect, Family, Word};

/// An open bracket or directive.
pub(super) struct Frame {
    pub kind: FrameKind,
    pub open: Span,
    /// The start of this frame's part of each pending list.
    pub items: usize,
    pub arguments: usize,
    pub operators: usize,
    /// Comparisons, logic and `?:` are allowed.
    pub full: bool,
    /// Inside the body of a `function`, where calls and indices are full too.
    pub formula: bool,
    pub state: State,
    /// The keyword whose block this is directly in, through directives.
    pub block: Option<Word>,
    /// The next block is the body of a function.
    pub function_ahead: bool,
    pub after_contextual: bool,
    /// Its expression is the value of `rgb` or the like, which may be a full one.
    pub of_color: bool,
    /// It was reported that its expression needs parentheses.
    pub level_told: bool,
    /// A vector in which a `#declare` has begun and its `;` has not been reached.
    pub declaring: bool,
}

pub(super) enum FrameKind {
    File,
    Block,
    /// `[ … ]` as an item.
    Entry,
    /// `( … )` as an operand.
    Group,
    Vector,
    Call(Callee),
    Index(ExpressionId),
    /// The part of a directive's head that is not in parentheses.
    Head(Head),
    /// `( … )` of a directive's head, one full expression.
    Condition(Head, Span),
    /// `( … )` of a directive's head, several expressions.
    List(Head, Span),
    /// The block of `#default`.
    Default(Span),
    /// The body of a directive that ends with `#end`.
    Body(Body),
}

/// The progress of a frame's expression.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// Not begun.
    Idle,
    /// An operator waits for its operand.
    Wanting,
    /// It may end here. A name, a call or an element can be indexed.
    Holding { indexable: bool },
}

pub(super) struct Nest<'a> {
    /// Without its comments.
    pub text: &'a str,
    /// The end of the text as the author wrote it.
    pub end: usize,
    pub file: FileId,
    pub dialect: Dialect,
    pub nesting_limit: usize,
    pub tokens: &'a [Token],
    pub at: usize,
    pub diagnostics: &'a mut Diagnostics,
    pub ast: Ast,
    pub names: HashMap<&'a str, NameId>,
    pub frames: Vec<Frame>,
    /// Items and arguments of open frames; moved to the tree when a frame closes.
    pub items: Vec<Item>,
    pub arguments: Vec<Argument>,
    pub stacks: Stacks,
    /// A branch without its directive was reported, which covers the `#end` after it.
    pub orphaned: bool,
    /// There are no sums outside parentheses.
    pub lacks_sums: bool,
    /// The tokens end before the text does, which was reported.
    pub ends_early: bool,
    /// The text was abandoned at a limit: open brackets are not the author's error.
    pub cut: bool,
    /// A joined vector stands where it matters of what it is made.
    pub is_in_doubt: bool,
}

/// Builds the tree of `tokens`, which are in a text of `end` bytes. With `cut`, the text continues after
/// them.
pub(super) fn nest<'a>(
    quiet: &'a Quiet<'a>,
    end: usize,
    file: FileId,
    tokens: &'a [Token],
    cut: bool,
    options: &ParseOptions,
    diagnostics: &'a mut Diagnostics,
) -> Ast {
    nested(quiet, end, file, tokens, cut, options, diagnostics).ast
}

/// As [`nest`], of tokens some of which are joined; `None` if one stands where it matters of what it is made.
pub(super) fn nest_joined<'a>(
    quiet: &'a Quiet<'a>,
    end: usize,
    file: FileId,
    tokens: &'a [Token],
    options: &ParseOptions,
    diagnostics: &'a mut Diagnostics,
) -> Option<Ast> {
    let nest = nested(quiet, end, file, tokens, false, options, diagnostics);
    (!nest.is_in_doubt).then_some(nest.ast)
}

fn nested<'a>(
    quiet: &'a Quiet<'a>,
    end: usize,
    file: FileId,
    tokens: &'a [Token],
    cut: bool,
    options: &ParseOptions,
    diagnostics: &'a mut Diagnostics,
) -> Nest<'a> {
    let mut nest = Nest {
        text: &quiet.text,
        end,
        file,
        dialect: options.dialect,
        nesting_limit: options.nesting_limit,
        tokens,
        at: 0,
        diagnostics,
        ast: Ast {
            file,
            // Usually more than needed: memory that is never written is never committed.
            items: Vec::with_capacity(tokens.len()),
            expressions: Vec::with_capacity(tokens.len() / 2),
            directives: Vec::new(),
            names: Vec::new(),
            arguments: Vec::with_capacity(tokens.len() / 4),
            numbers: Vec::new(),
            comments: quiet.comments.clone(),
            root: Items::default(),
        },
        names: HashMap::new(),
        frames: Vec::new(),
        items: Vec::new(),
        arguments: Vec::new(),
        stacks: Stacks::default(),
        orphaned: false,
        lacks_sums: old_words::lacks_sums(tokens, &quiet.text, options.dialect),
        ends_early: cut,
        cut: false,
        is_in_doubt: false,
    };
    nest.open(FrameKind::File, Span::new(file, 0, 0), false);
    while let Some(&token) = tokens.get(nest.at) {
        // The last token before a cut lacks what follows it.
        nest.cut |= cut && nest.at + 1 == tokens.len();
        nest.token(token);
        nest.at += 1;
    }
    nest.end_of_file();
    nest
}

impl<'a> Nest<'a> {
    pub(super) fn span(&self, token: Token) -> Span {
        // A quote added to close a string may be past the end.
        let (start, end) = (token.start as usize, token.end as usize);
        Span::new(self.file, start.min(self.end), end.min(self.end))
    }

    pub(super) fn slice(&self, span: Span) -> &'a str {
        self.text.get(span.range()).unwrap_or("")
    }

    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        if !self.cut {
            self.diagnostics.push(diagnostic);
        }
    }

    pub(super) fn name(&mut self, name: &'a str) -> NameId {
        let names = &mut self.ast.names;
        *self.names.entry(name).or_insert_with(|| {
            names.push(name.to_owned());
            NameId(names.len() as u32 - 1)
        })
    }

    pub(super) fn add(&mut self, kind: ExpressionKind, span: Span) -> ExpressionId {
        self.ast.expressions.push(Expression { kind, span });
        ExpressionId(self.ast.expressions.len() as u32 - 1)
    }

    /// Returns the innermost frame. There is always at least the file's own.
    pub(super) fn top(&mut self) -> &mut Frame {
        let last = self.frames.len() - 1;
        &mut self.frames[last]
    }

    pub(super) fn next_is(&self, kind: TokenKind) -> bool {
        self.tokens.get(self.at + 1).is_some_and(|token| token.kind == kind)
    }

    pub(super) fn open(&mut self, kind: FrameKind, open: Span, full: bool) {
        let outer = self.frames.last();
        let (block, formula) = match kind {
            FrameKind::Body(_) => (outer.and_then(|f| f.block), false),
            FrameKind::Group | FrameKind::Call(_) | FrameKind::Index(_) => {
                (None, outer.is_some_and(|f| f.formula))
            }
            _ => (None, false),
        };
        self.frames.push(Frame {
            kind,
            open,
            items: self.items.len(),
            arguments: self.arguments.len(),
            operators: self.stacks.operators.len(),
            full: full || formula,
            formula,
            state: State::Idle,
            block,
            function_ahead: false,
            after_contextual: false,
            of_color: false,
            level_told: false,
            declaring: false,
        });
    }

    /// Pops the innermost frame. The file's own stays.
    pub(super) fn pop(&mut self) -> Option<Frame> {
        if self.frames.len() > 1 { self.frames.pop() } else { None }
    }

    /// Moves the pending items from `base` on into the tree.
    pub(super) fn take_items(&mut self, base: usize) -> Items {
        let start = self.ast.items.len() as u32;
        self.ast.items.extend(self.items.drain(base..));
        Items { start, end: self.ast.items.len() as u32 }
    }

    pub(super) fn take_arguments(&mut self, base: usize) -> Arguments {
        let start = self.ast.arguments.len() as u32;
        self.ast.arguments.extend(self.arguments.drain(base..));
        Arguments { start, end: self.ast.arguments.len() as u32 }
    }

    pub(super) fn item(&mut self, kind: ItemKind, span: Span) {
        self.finish_expression();
        self.items.push(Item { kind, span });
    }

    pub(super) fn token(&mut self, token: Token) {
        if self.head_takes(token) {
            return;
        }
        let contextual = std::mem::take(&mut self.top().after_contextual);
        let span = self.span(token);
        match token.kind {
            TokenKind::Number => self.number(token),
            TokenKind::String => self.operand(ExpressionKind::String, span, false),
            TokenKind::Name => self.named(span, contextual),
            TokenKind::Word(word) => self.word(word, span),
            TokenKind::Numbers | TokenKind::Vectors => self.run(token),
            TokenKind::Triple => self.joined(span),
            TokenKind::Mark(mark) => self.mark(mark, token),
            TokenKind::Directive(head) => {
                if !self.is_within_vector() {
                    self.leave_vectors(span);
                }
                self.finish_expression();
                self.directive_goes_on();
                self.directive(head, span);
            }
            TokenKind::LooseOpen | TokenKind::LooseClose => self.loose(token.kind, span),
            TokenKind::Raw => self.raw(span),
            TokenKind::Unread => self.add_directive(DirectiveKind::Unread, span, span),
            TokenKind::Stray => self.stray(token),
        }
    }

    /// Adds a vector that is one token, where it can be nothing else.
    fn joined(&mut self, span: Span) {
        let deep = self.frames.len() > self.nesting_limit;
        let is_list = self.lists_items() || matches!(self.top().kind, FrameKind::Call(_));
        let top = self.top();
        let is_plain = is_list && !top.full && top.state != State::Wanting && !deep;
        let is_compared = top.of_color && top.state != State::Idle;
        self.before_operand();
        if !is_plain || is_compared || self.ends_early || !self.add_triple(span) {
            self.is_in_doubt = true;
        }
    }

    /// Ends the current expression, if there is one, and adds it to its frame.
    pub(super) fn finish_expression(&mut self) {
        let (state, base) = (self.top().state, self.top().operators);
        match state {
            State::Idle => return,
            State::Holding { .. } => {}
            State::Wanting => {
                if let Some(&operator) = self.stacks.operators.last()
                    && self.goes_on_in_a_directive()
                {
                    self.operand(ExpressionKind::Joint, operator.span.after(), false);
                } else if let Some(&operator) = self.stacks.operators.last() {
                    let text = self.slice(operator.span);
                    let message = format!("expected a value after `{text}`");
                    let diagnostic = Diagnostic::new(Code::ExpectedExpression, message)
                        .at(operator.span, "nothing it could be applied to follows");
                    let next = self.tokens.get(self.at).map(|token| token.kind);
                    let of_objects =
                        |word: Word| matches!(word.family(), Family::Shape | Family::Csg);
                    let diagnostic = match next {
                        Some(TokenKind::Word(word)) if text == "-" && of_objects(word) => {
                            diagnostic
                                .help("objects are taken from each other by `difference { A B }`")
                        }
                        Some(TokenKind::Word(word)) if text == "+" && of_objects(word) => {
                            diagnostic.help("objects are put together by `union { A B }`")
                        }
                        _ => diagnostic,
                    };
                    self.report(diagnostic);
                    self.operand(ExpressionKind::Missing, operator.span.after(), false);
                }
            }
        }
        if let Some(question) = self.stacks.open_question(base) {
            self.report(
                Diagnostic::new(Code::ExpectedExpression, "this `?` has no `:`")
                    .at(question, "expected `condition ? one : other`"),
            );
            while self.stacks.open_question(base).is_some() {
                self.stacks.colon(base, &mut self.ast.expressions);
                let id = self.add(ExpressionKind::Missing, question.after());
                self.stacks.operands.push(id);
            }
        }
        let top = self.top();
        let told = std::mem::take(&mut top.level_told);
        (top.state, top.of_color) = (State::Idle, false);
        let Some(mut id) = self.stacks.finish(base, &mut self.ast.expressions) else { return };
        if told {
            id = self.add(ExpressionKind::Missing, self.ast.expression(id).span);
        }
        let is_behind_directive = self.items.len() > self.top().items;
        if self.in_vector() && !self.top().declaring && !is_behind_directive {
            self.arguments.push(Argument::Expression(id));
        } else {
            let span = self.ast.expression(id).span;
            self.items.push(Item { kind: ItemKind::Expression(id), span });
        }
    }

    pub(super) fn end_of_file(&mut self) {
        let end = Span::new(self.file, self.end, self.end);
        loop {
            self.leave_vectors(end);
            self.finish_expression();
            if self.complete_head() {
                continue;
            }
            let bracket = match &self.top().kind {
                FrameKind::File => break,
                FrameKind::Block | FrameKind::Default(_) => Bracket::Brace,
                FrameKind::Entry | FrameKind::Index(_) => Bracket::Square,
                FrameKind::Body(_) => {
                    self.end_directive(end);
                    continue;
                }
                FrameKind::Group
                | FrameKind::Call(_)
                | FrameKind::Condition(..)
                | FrameKind::List(..)
                | FrameKind::Vector
                | FrameKind::Head(_) => Bracket::Round,
            };
            self.close_bracket(bracket, end);
        }
        self.ast.root = self.take_items(0);
    }
}
