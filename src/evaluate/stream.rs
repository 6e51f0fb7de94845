//! The stream of items; running directives, macro calls and includes on the way to the next one.
//!
//! **Invariant:** a consumer sees only the items of its own block (see `enclosure`). Loops and macros are
//! frames on a list, not calls.

use std::rc::Rc;

use crate::source::{ExpansionId, ExpansionKind, FileId, Site, Span};
use crate::syntax::ast::{
    Ast, DirectiveId, DirectiveKind, ExpressionId, ExpressionKind, Item, ItemKind, Items,
};
use crate::vocabulary::Word;

use super::enclosure::Contents;
use super::scope::Symbol;
use super::value::{Components, Value};
use super::{Evaluator, Here, Outcome, Reported, Unit};

/// Number of turns after which a loop with reported mistakes ends without a further message.
pub(super) const FAULTY_TURNS: u64 = 1_000;
/// Maximum number of turns with mistakes of all loops together, which nested loops soon exceed.
pub(super) const ALL_FAULTY_TURNS: u64 = 10 * FAULTY_TURNS;

/// Maximum number of turns and calls that are run after the first error to find more: they take less than a
/// second.
pub(super) const MOST_RUN_SINCE_FAULT: u64 = 100_000;

/// A cursor over a sequence of items.
#[derive(Debug)]
pub(super) struct Frame {
    pub(super) here: Here,
    pub(super) at: u32,
    pub(super) end: u32,
    /// Number of elements already taken of the number run at `at`.
    pub(super) taken: u32,
    pub(super) kind: FrameKind,
}

impl Frame {
    /// Returns the next element of the number run at `at`, and consumes it.
    fn literal(&mut self, start: u32, count: u32, width: u32) -> Value {
        let first = (start + self.taken * width) as usize;
        self.taken += 1;
        if self.taken == count {
            (self.at, self.taken) = (self.at + 1, 0);
        }
        match &self.here.unit.ast.numbers[first..first + width as usize] {
            [number] => Value::Number(*number),
            numbers => Components::new(numbers).map_or(Value::Broken, Value::Vector),
        }
    }
}

#[derive(Debug)]
pub(super) enum FrameKind {
    /// Items of an argument or a group, past which their consumer cannot see.
    Barrier,
    /// The items of a block, which ends with its `}`.
    Block,
    /// A branch of a condition.
    Branch,
    /// A case of a switch, which `#break` ends.
    Switch,
    While {
        condition: ExpressionId,
        body: Items,
        turns: u64,
        directive: DirectiveId,
        /// Number of mistakes found before it started.
        faults: u64,
    },
    For {
        symbol: Symbol,
        value: f64,
        to: f64,
        step: f64,
        body: Items,
        turns: u64,
        directive: DirectiveId,
        /// Number of mistakes found before it started.
        faults: u64,
    },
    /// A macro's body: `#break` ends it, and no loop around it.
    Macro,
    /// An included file.
    Include,
}

/// The numbers of frames at a `#declare` and at the first item of its value.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hold {
    pub own: usize,
    pub first: usize,
}

/// A macro call that left no item.
#[derive(Debug, Clone, Copy)]
pub(super) struct Silent {
    /// `None` if the call itself was wrong and has been reported.
    pub called: Option<ExpansionId>,
    /// Position of the item taken before it.
    behind: Option<Site>,
}

/// An item as a consumer receives it.
#[derive(Debug, Clone)]
pub(super) struct Token {
    pub kind: TokenKind,
    pub span: Span,
    pub here: Here,
}

impl Token {
    /// Returns the span of its start: a block's opening brace, or the whole span of anything shorter.
    pub fn span_head(&self) -> Span {
        match self.kind {
            TokenKind::Block(_) | TokenKind::Entry(_) => {
                Span { end: self.span.start + 1, ..self.span }
            }
            _ => self.span,
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum TokenKind {
    Word(Word),
    Expression(ExpressionId),
    Block(Contents),
    Entry(Items),
    Comma,
    Semicolon,
    /// An element of a number run.
    Literal(Box<Value>),
}

impl Evaluator<'_> {
    pub(super) fn push(&mut self, here: &Here, items: Items, kind: FrameKind) {
        self.push_owned(here.clone(), items, kind);
    }

    fn push_owned(&mut self, here: Here, items: Items, kind: FrameKind) {
        self.frames.push(Frame { here, at: items.start, end: items.end, taken: 0, kind });
    }

    pub(super) fn push_branch(&mut self, here: &Here, items: Items) {
        if !items.is_empty() {
            self.push(here, items, FrameKind::Branch);
        }
    }

    pub(super) fn push_switch(&mut self, here: &Here, items: Items) {
        self.push(here, items, FrameKind::Switch);
    }

    /// Pushes a loop, positioned at its (empty) end, where its condition is evaluated.
    pub(super) fn push_while(
        &mut self,
        here: &Here,
        condition: ExpressionId,
        body: Items,
        directive: DirectiveId,
    ) {
        let empty = Items { start: body.end, end: body.end };
        let faults = self.faults;
        self.push(here, empty, FrameKind::While { condition, body, turns: 0, directive, faults });
    }

    pub(super) fn push_for(
        &mut self,
        here: &Here,
        symbol: Symbol,
        [from, to, step]: [f64; 3],
        body: Items,
        directive: DirectiveId,
    ) {
        let empty = Items { start: body.end, end: body.end };
        let (turns, faults) = (0, self.faults);
        self.push(
            here,
            empty,
            FrameKind::For { symbol, value: from, to, step, body, turns, directive, faults },
        );
    }

    /// Pushes a macro's body; the caller has opened the macro's table and bound its parameters.
    pub(super) fn push_macro(&mut self, unit: &Rc<Unit>, expansion: ExpansionId, body: Items) {
        self.macro_depth += 1;
        self.push_owned(Here { unit: unit.clone(), expansion }, body, FrameKind::Macro);
    }

    pub(super) fn push_include(&mut self, unit: &Rc<Unit>, expansion: ExpansionId, name: String) {
        self.scopes.open();
        self.including.push(name);
        let root = unit.ast.root;
        self.push(&Here { unit: unit.clone(), expansion }, root, FrameKind::Include);
    }

    pub(super) fn pop_frame(&mut self) {
        let Some(frame) = self.frames.pop() else { return };
        match frame.kind {
            FrameKind::Macro => {
                self.macro_depth -= 1;
                self.scopes.close();
            }
            FrameKind::Include => {
                self.including.pop();
                self.scopes.close();
            }
            FrameKind::Barrier
            | FrameKind::Block
            | FrameKind::Branch
            | FrameKind::Switch
            | FrameKind::While { .. }
            | FrameKind::For { .. } => {}
        }
    }

    /// Returns whether the next statement is in the main file itself, outside macros.
    pub(super) fn in_main(&self) -> bool {
        self.scopes.depth() == 1
    }

    /// Returns whether `here` is in a running macro of the main file.
    pub(super) fn in_macro_of_main(&self, here: &Here) -> bool {
        let innermost = self.scene.expansions.chain(here.expansion).next();
        here.unit.ast.file == FileId(0)
            && innermost.is_some_and(|expansion| expansion.kind == ExpansionKind::Macro)
    }

    /// Returns the next item without consuming it.
    pub(super) fn peek(&mut self) -> Option<&Token> {
        if self.peeked.is_none() {
            self.peeked = self.pull();
        }
        self.peeked.as_ref()
    }

    /// As [`Self::peek`], at a position where a value could end: past the end of a `#declare` no macro is
    /// called, since its arguments may already use the value.
    pub(super) fn peek_on(&mut self) -> Option<&Token> {
        self.calls_wait = true;
        self.peek();
        self.calls_wait = false;
        self.peeked.as_ref()
    }

    /// Consumes and returns the next item; `None` at the end of the block.
    pub(super) fn next(&mut self) -> Option<Token> {
        let token = match self.peeked.take() {
            Some(token) => Some(token),
            None => self.pull(),
        };
        if let Some(token) = &token {
            self.taken = Some(token.here.site(token.span));
        }
        token
    }

    /// Consumes the next item if it is this word.
    pub(super) fn take_word(&mut self, word: Word) -> Option<Token> {
        match self.peek() {
            Some(token) if token.kind == TokenKind::Word(word) => self.next(),
            _ => None,
        }
    }

    /// Consumes the next item if its kind satisfies `suits`.
    pub(super) fn next_if(&mut self, suits: impl FnOnce(&TokenKind) -> bool) -> Option<Token> {
        if self.peek().is_some_and(|token| suits(&token.kind)) { self.next() } else { None }
    }

    /// Consumes one comma, if there is one.
    pub(super) fn skip_comma(&mut self) {
        let is_next = |token: &Token| matches!(token.kind, TokenKind::Comma);
        if !self.pass(ItemKind::Comma) && self.peek().is_some_and(is_next) {
            self.next();
        }
    }

    /// Consumes commas, which are optional between parts.
    pub(super) fn skip_commas(&mut self) {
        while self.pass(ItemKind::Comma) {}
        while matches!(self.peek(), Some(Token { kind: TokenKind::Comma, .. })) {
            self.next();
        }
    }

    /// Returns whether the next item must not run now because it is after the value of a `#declare`.
    fn waits(&self) -> bool {
        let Some(hold) = self.hold else { return false };
        let Some(frame) = self.frames.last() else { return false };
        let depth = self.frames.len();
        if frame.at == frame.end {
            let turns = matches!(frame.kind, FrameKind::While { .. } | FrameKind::For { .. });
            return depth <= hold.own || (depth <= hold.first && turns);
        }
        let ast = &frame.here.unit.ast;
        depth <= hold.first
            && match ast.items[frame.at as usize].kind {
                ItemKind::Directive(_) => true,
                ItemKind::Expression(id) => {
                    self.calls_wait && matches!(ast.expression(id).kind, ExpressionKind::Call(..))
                }
                _ => false,
            }
    }

    fn pull(&mut self) -> Option<Token> {
        let newest = self.scene.expansions.newest();
        if self.silent.is_some_and(|silent| silent.behind != self.taken) {
            self.silent = None;
        }
        loop {
            if self.halted {
                return None;
            }
            // A directive may have looked past its value.
            if self.peeked.is_some() {
                return self.peeked.take();
            }
            if let Some(token) = self.behind_name.take() {
                return Some(token);
            }
            if self.waits() {
                return None;
            }
            let has_memory = self.has_memory(0);
            let frame = self.frames.last_mut()?;
            if frame.at == frame.end {
                match frame.kind {
                    FrameKind::Barrier | FrameKind::Block => return None,
                    FrameKind::While { .. } | FrameKind::For { .. } => self.turn(),
                    FrameKind::Branch | FrameKind::Switch | FrameKind::Include => self.pop_frame(),
                    FrameKind::Macro => {
                        let called = frame.here.expansion;
                        if called > newest {
                            self.silent = Some(Silent { called: Some(called), behind: self.taken });
                        }
                        self.pop_frame();
                    }
                }
                continue;
            }
            let Item { kind, span } = frame.here.unit.ast.items[frame.at as usize];
            let here = frame.here.clone();
            if !has_memory {
                self.too_much_memory(&here, span);
                return None;
            }
            if kind == ItemKind::Close {
                if self.may_close(&here, span) {
                    return None;
                }
                self.frames.last_mut()?.at += 1;
                continue;
            }
            if let ItemKind::Numbers { start, count, width } = kind {
                let value = frame.literal(start, count, width);
                return Some(Token { kind: TokenKind::Literal(Box::new(value)), span, here });
            }
            frame.at += 1;
            if let Some(kind) = taken_as_it_is(&here.unit.ast, kind) {
                return Some(Token { kind, span, here });
            }
            match kind {
                ItemKind::Expression(id) => match self.splices_macro(&here, id) {
                    Ok(true) => {}
                    Ok(false) => {
                        if let Some((name, group)) = self.value_before_group(&here, id) {
                            let span = here.unit.expression(group).span;
                            let kind = TokenKind::Expression(group);
                            self.behind_name = Some(Token { kind, span, here });
                            return Some(name);
                        }
                        return Some(Token { kind: TokenKind::Expression(id), span, here });
                    }
                    Err(Reported) => {
                        self.silent = Some(Silent { called: None, behind: self.taken });
                    }
                },
                ItemKind::Directive(id) => {
                    let (taken, silent) = (self.taken, self.silent);
                    // Reported where it happened; the statement is the fault boundary.
                    let _: Outcome<()> = self.directive(&here, id);
                    (self.taken, self.silent) = (taken, silent);
                    // Its `;` is not part of the enclosing block.
                    if let DirectiveKind::Version(_) = here.unit.ast.directive(id).kind {
                        self.pass(ItemKind::Semicolon);
                    }
                }
                _ => {}
            }
        }
    }
}

/// Returns the token of an item that can be taken without running anything.
#[inline]
fn taken_as_it_is(ast: &Ast, kind: ItemKind) -> Option<TokenKind> {
    Some(match kind {
        ItemKind::Open => TokenKind::Block(Contents::Following),
        ItemKind::Word(word) => TokenKind::Word(word),
        ItemKind::Block(items) => TokenKind::Block(Contents::Items(items)),
        ItemKind::Entry(items) => TokenKind::Entry(items),
        ItemKind::Comma => TokenKind::Comma,
        ItemKind::Semicolon => TokenKind::Semicolon,
        ItemKind::Expression(id) => match ast.expression(id).kind {
            ExpressionKind::Call(..) | ExpressionKind::Unary(..) => return None,
            _ => TokenKind::Expression(id),
        },
        ItemKind::Close | ItemKind::Numbers { .. } | ItemKind::Directive(_) => return None,
    })
}
