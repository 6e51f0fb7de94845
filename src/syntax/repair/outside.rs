//! Estimates where an unclosed bracket or directive ended, from the layout of the text.
//!
//! **Invariant:** an item that is closed after all has no such position inside it, so closers inserted at
//! these positions never cross.

use super::{Open, Repair};
use crate::syntax::balance::Opener;
use crate::syntax::layout::Place;
use crate::syntax::token::{Bracket, Head, Mark, TokenKind};
use crate::vocabulary::{Family, Role, Word};

/// The first token inside an open item that appears to be outside it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Outside {
    pub token: usize,
    /// Certain by indentation, or by what a block can contain. Otherwise it is a guess, which produces no
    /// diagnostic.
    pub certain: bool,
}

impl Repair<'_> {
    /// Records where open items seem to have ended, from the innermost outward.
    pub(super) fn look_for_outside(&mut self, at: usize) {
        let place = self.layout.place(at);
        let begins = place.first && (self.begins_statement(at) || self.is_call(at));
        for level in (0..self.open.len()).rev() {
            let known = self.open[level].outside;
            if known.is_none_or(|outside| !outside.certain) {
                match self.outside(&self.open[level], at, place, begins) {
                    Some(certain) if certain || known.is_none() => {
                        self.open[level].outside = Some(Outside { token: at, certain });
                    }
                    Some(_) => {}
                    None if known.is_none() => break,
                    None => {}
                }
            }
            // A token that begins no statement ends only the innermost item, unless it belongs beside several
            // blocks; items around one that has ended before have ended, too.
            let ended = known.is_some_and(|outside| outside.certain);
            if !begins && (ended || !self.stands_beside(self.open[level].token, at)) {
                break;
            }
        }
        if let Some(top) = self.open.last_mut().filter(|top| place.first && top.inner.is_none()) {
            top.inner = Some(place.indent);
        }
    }

    /// Returns whether `open` seems to have ended before token `at`, and whether that is certain.
    fn outside(&self, open: &Open, at: usize, place: Place, begins: bool) -> Option<bool> {
        let indented = open.inner.is_some_and(|inner| inner > open.indent);
        let beside = begins && place.indent <= open.indent;
        match open.opener {
            Opener::Bracket(Bracket::Brace) => {
                let ended = beside && indented || begins && !self.may_hold(open.token, at);
                (ended || self.stands_beside(open.token, at)).then_some(true)
            }
            Opener::Directive if beside && indented => Some(true),
            // In a text without indentation, it holds one statement.
            Opener::Directive => {
                let brace = TokenKind::Mark(Mark::Close(Bracket::Brace));
                (beside && self.tokens[at - 1].kind == brace).then_some(false)
            }
            // `[0 rgb 0` and an entry below it.
            Opener::Bracket(Bracket::Square)
                if place.first
                    && place.indent == open.indent
                    && self.tokens[at].kind == TokenKind::Mark(Mark::Open(Bracket::Square)) =>
            {
                Some(true)
            }
            Opener::Bracket(Bracket::Round | Bracket::Square) => {
                let ends = self.tokens[at].kind == TokenKind::Mark(Mark::Semicolon);
                // `#macro G(a, b sphere {`: parameters are names.
                let head = open.token.checked_sub(2).map(|head| self.tokens[head].kind);
                let body = head == Some(TokenKind::Directive(Head::Macro));
                // `A[I pigment {`: the index of an element is a value.
                let before = open.token.checked_sub(1).map(|before| self.tokens[before]);
                let index = open.opener == Opener::Bracket(Bracket::Square)
                    && before.is_some_and(|name| {
                        name.kind == TokenKind::Name && name.end == self.tokens[open.token].start
                    });
                // `#range (1, 2` and a directive below it.
                let of_head =
                    before.is_some_and(|head| matches!(head.kind, TokenKind::Directive(_)));
                // `#if (A < 2 sphere {`: a condition is a value.
                let opens = (body || index || of_head) && self.begins_statement(at);
                (ends || beside || opens || of_head && begins).then_some(true)
            }
        }
    }

    /// Returns whether a directive, or a keyword that opens a block, is at `at`.
    pub(super) fn begins_statement(&self, at: usize) -> bool {
        let brace = TokenKind::Mark(Mark::Open(Bracket::Brace));
        match self.tokens[at].kind {
            TokenKind::Directive(head) => head != Head::End && !head.divides(),
            TokenKind::Word(word) => {
                word.role() == Role::Statement
                    && self.tokens.get(at + 1).is_some_and(|next| next.kind == brace)
            }
            _ => false,
        }
    }

    /// Returns whether a macro call may be at `at`: `Disk(0, Red)`.
    pub(super) fn is_call(&self, at: usize) -> bool {
        let round = TokenKind::Mark(Mark::Open(Bracket::Round));
        self.tokens[at].kind == TokenKind::Name
            && self.tokens.get(at + 1).is_some_and(|next| next.kind == round)
    }

    /// Returns whether the statement at `at` may only be beside the block that opens at `opener`, never in
    /// it: a `finish` and a `pigment`.
    pub(super) fn stands_beside(&self, opener: usize, at: usize) -> bool {
        let TokenKind::Word(inner) = self.tokens[at].kind else { return false };
        let outer = opener.checked_sub(1).map(|before| self.tokens[before].kind);
        let Some(TokenKind::Word(outer)) = outer else { return false };
        let of_surface = matches!(
            outer,
            Word::Pigment
                | Word::Normal
                | Word::Finish
                | Word::Interior
                | Word::TransformWord
                | Word::ColorMap
        );
        let of_shapes = matches!(outer, Word::ContainedBy | Word::BoundedBy | Word::ClippedBy);
        match inner {
            Word::Pigment | Word::Normal | Word::Finish | Word::Texture => {
                (of_surface || of_shapes || is_list(outer)) && self.begins_statement(at)
            }
            Word::Threshold
            | Word::Accuracy
            | Word::MaxGradient
            | Word::Evaluate
            | Word::AllIntersections => matches!(outer, Word::ContainedBy | Word::Function),
            Word::ContainedBy => outer == Word::Function,
            Word::FaceIndices
            | Word::NormalIndices
            | Word::UvIndices
            | Word::NormalVectors
            | Word::UvVectors
            | Word::TextureList => {
                (is_list(outer) || outer == Word::TextureList) && self.begins_statement(at)
            }
            Word::InsideVector => is_list(outer) || outer == Word::TextureList,
            Word::Interior | Word::Material => {
                (of_surface || is_list(outer) || outer == Word::Texture)
                    && self.begins_statement(at)
            }
            Word::Translate | Word::Rotate | Word::Scale | Word::Matrix => {
                is_list(outer) || matches!(outer, Word::Finish | Word::ColorMap | Word::Function)
            }
            _ => false,
        }
    }

    /// Returns `false` if the block that opens at `opener` cannot contain the statement at `at`: an object is
    /// valid at the top level, and in few blocks.
    pub(super) fn may_hold(&self, opener: usize, at: usize) -> bool {
        let TokenKind::Word(inner) = self.tokens[at].kind else { return true };
        let only_outside = matches!(inner.family(), Family::Shape | Family::Csg)
            || matches!(
                inner,
                Word::Camera
                    | Word::LightSource
                    | Word::GlobalSettings
                    | Word::SkySphere
                    | Word::Background
            );
        let outer = opener.checked_sub(1).map(|before| self.tokens[before].kind);
        let Some(TokenKind::Word(outer)) = outer else { return true };
        let holds_objects = match outer.family() {
            Family::Shape => matches!(outer, Word::Blob | Word::Mesh),
            Family::Light => outer != Word::LightSource,
            Family::Texture | Family::FinishItem | Family::PatternItem => false,
            Family::Camera | Family::Atmosphere | Family::Setting => false,
            _ => true,
        };
        (!only_outside || holds_objects) && !self.stands_beside(opener, at)
    }

    /// Forgets the estimated ends of items around `closed` that are inside it.
    pub(super) fn forget_outsides_since(&mut self, closed: &Open) {
        for open in self.open.iter_mut().rev() {
            match open.outside {
                Some(outside) if outside.token > closed.token => open.outside = None,
                _ => break,
            }
        }
    }
}

/// Returns whether the keyword is a list of a mesh2; such lists are adjacent.
fn is_list(word: Word) -> bool {
    matches!(
        word,
        Word::VertexVectors
            | Word::NormalVectors
            | Word::UvVectors
            | Word::FaceIndices
            | Word::NormalIndices
            | Word::UvIndices
    )
}
