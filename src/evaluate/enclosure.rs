//! Enclosures: the blocks, and other sequences of items, that are open at the moment.
//!
//! **Invariant:** a consumer sees only the items of its own enclosure, and items that it does not read are
//! dropped. A `}` closes the innermost block, whether that block was nested when its file was parsed or was
//! opened by an unpaired brace from a macro: blocks pair at run time, and blocks that were nested when parsed
//! incur no cost for it.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{Site, Span};
use crate::syntax::ast::{ItemKind, Items};

use super::stream::{Frame, FrameKind, TokenKind};
use super::{Evaluator, Here};

/// The contents of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Contents {
    Items(Items),
    /// The following items, up to a `}` that has no partner where it is written.
    Following,
}

/// A sequence of items that is read to its end and no further.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Enclosure {
    /// An argument, a group or a file, which no `}` can close.
    Own,
    /// A block.
    Block,
}

impl Evaluator<'_> {
    /// Runs `consumer` on these items only; no brace can leave them.
    pub(super) fn inside<T>(
        &mut self,
        here: &Here,
        items: Items,
        consumer: impl FnOnce(&mut Self) -> T,
    ) -> T {
        let depth = self.frames.len();
        self.push(here, items, FrameKind::Barrier);
        self.enclosed(Enclosure::Own, consumer, |evaluator| evaluator.drop_frames(depth))
    }

    /// Runs `consumer` on the contents of a block whose `{` is at the start of `span`.
    pub(super) fn inside_block<T>(
        &mut self,
        here: &Here,
        contents: Contents,
        span: Span,
        consumer: impl FnOnce(&mut Self) -> T,
    ) -> T {
        let opened = here.site(Span { end: span.start + 1, ..span });
        let Contents::Items(items) = contents else {
            self.loose_blocks += 1;
            self.limit_nesting(opened);
            let result = self.enclosed(Enclosure::Block, consumer, |evaluator| {
                evaluator.close_block(opened);
            });
            self.loose_blocks -= 1;
            return result;
        };
        let depth = self.frames.len();
        let closers = self.loose_closers;
        self.push(here, items, FrameKind::Block);
        self.enclosed(Enclosure::Block, consumer, |evaluator| {
            // No unpaired brace has come between its own.
            if evaluator.loose_closers == closers {
                evaluator.drop_frames(depth);
            } else {
                evaluator.close_block(opened);
            }
        })
    }

    fn enclosed<T>(
        &mut self,
        enclosure: Enclosure,
        consumer: impl FnOnce(&mut Self) -> T,
        end: impl FnOnce(&mut Self),
    ) -> T {
        let (peeked, taken, silent) = (self.peeked.take(), self.taken, self.silent);
        // The items that a `#declare` must not look at are after the block.
        let hold = self.hold.take();
        let undecided = std::mem::take(&mut self.undecided);
        self.enclosures.push(enclosure);
        // Nested blocks and macros may exceed the depth of a thread's stack.
        let result = stacker::maybe_grow(128 * 1024, 2 * 1024 * 1024, || consumer(self));
        (self.peeked, self.taken) = (None, taken);
        end(self);
        self.silent = silent;
        self.undecided |= undecided;
        self.enclosures.pop();
        self.hold = hold;
        self.peeked = peeked;
        result
    }

    fn drop_frames(&mut self, depth: usize) {
        while self.frames.len() > depth {
            self.pop_frame();
        }
    }

    /// Returns whether the next `}`, which has no partner in its text, closes the innermost block.
    pub(super) fn may_close(&mut self, here: &Here, span: Span) -> bool {
        if self.enclosures.last() == Some(&Enclosure::Block) {
            self.loose_closers += 1;
            return true;
        }
        let diagnostic = Diagnostic::new(Code::StrayCloser, "this `}` closes nothing")
            .at(span, "no `{` is open where this is run")
            .help("leave it out");
        self.report(here, diagnostic);
        false
    }

    /// Skips what a consumer has left, and consumes the `}` after it.
    fn close_block(&mut self, opened: Site) {
        let taken = self.taken;
        while let Some(token) = self.next() {
            if let TokenKind::Block(Contents::Following) = token.kind {
                self.inside_block(&token.here, Contents::Following, token.span, |_| {});
            }
        }
        self.taken = taken;
        match self.frames.last_mut() {
            Some(Frame { kind: FrameKind::Block, at, end, .. }) if *at == *end => {
                // The literal brace belongs to another block.
                self.loose_closers += 1;
                self.pop_frame();
            }
            Some(Frame { here, at, end, .. })
                if *at < *end
                    && here.unit.ast.items[*at as usize].kind == ItemKind::Close
                    && !self.halted =>
            {
                let closer = here.unit.ast.items[*at as usize].span;
                *at += 1;
                self.taken = Some(here.site(closer));
            }
            _ if self.halted => {}
            _ => self.never_closed(opened),
        }
    }

    fn never_closed(&mut self, opened: Site) {
        let diagnostic = Diagnostic::new(Code::UnclosedBlock, "this `{` is never closed")
            .at(opened.span, "opened here, and no `}` follows where this is run")
            .help("what one macro opens, another may close, or the text that calls it");
        self.report_in(opened.expansion, diagnostic);
    }

    fn limit_nesting(&mut self, opened: Site) {
        let limit = self.options.limits.nesting;
        if self.loose_blocks <= limit {
            return;
        }
        let message = format!("brackets are nested more than {limit} deep");
        let diagnostic = Diagnostic::new(Code::NestingLimit, message)
            .at(opened.span, "opened here once more")
            .help("`--limit nesting=N` raises the limit");
        self.halt(opened.expansion, diagnostic);
    }
}
