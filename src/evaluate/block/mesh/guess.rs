//! Diagnostics for a mesh file written without `file`: `mesh { "bunny.ply" }`, `mesh2 { obj "bunny.obj" }`.

use crate::diagnostic::{Code, Diagnostic};
use crate::mesh_file;
use crate::scene::Dialect;
use crate::source::Span;
use crate::syntax::ast::ExpressionKind;
use crate::vocabulary::Word;

use super::super::super::stream::{Token, TokenKind};
use super::super::super::{Evaluator, Reported};

impl Evaluator<'_> {
    /// Reports a mesh's file name right after `{`, without `file` before it or with another word. The
    /// following items are read for their own mistakes. `token` opened the block, as `word`.
    pub(super) fn file_unworded(&mut self, token: &Token, word: Word) -> Option<Reported> {
        let first = self.peek()?.clone();
        let TokenKind::Expression(id) = first.kind else { return None };
        let text = &self.sources.get(first.span.file).text;
        let rest = text.get(first.span.end as usize..)?;
        let is_string = matches!(first.here.unit.expression(id).kind, ExpressionKind::String);
        let quoted = match is_string {
            true => self.sources.text(first.span),
            false => {
                self.unknown_name(&first.here, id)?;
                let inside = rest.trim_start().strip_prefix('"')?.split(['"', '\n']).next()?;
                rest.get(..rest.find('"')? + inside.len() + 2)?.trim_start()
            }
        };
        if !mesh_file::is_named(quoted.trim_matches('"')) {
            return None;
        }
        let right = format!("mesh {{ file {quoted} }}");
        let name = self.sources.text(first.span);
        let of_scene = self.options.dialect == Dialect::Scene;
        let told = match is_string {
            true => {
                Diagnostic::new(Code::ExtraPart, "the name of a mesh's file stands behind `file`")
                    .at(first.span, "expected `file` before it")
            }
            false => {
                let message = format!("`{name}` is not a word in `{}`", word.name());
                let label = match name == Word::File.name() {
                    true if of_scene => "it is a word only in `mesh`",
                    true => "it is a word only in `.scene` files",
                    false => "did you mean `file`?",
                };
                Diagnostic::new(Code::UnknownWord, message).at(first.span, label)
            }
        };
        let mut told = match of_scene {
            true => told.help(format!("write `{right}`")),
            false => told.help(format!("a `.scene` file reads it with `{right}`")),
        };
        if of_scene {
            told = match is_string {
                true => told.fix(Span { end: first.span.start, ..first.span }, "file "),
                false if name == Word::File.name() => told,
                false => told.fix(first.span, Word::File.name()),
            };
            if word == Word::Mesh2 && self.sources.text(token.span) == word.name() {
                told = told.fix(token.span, Word::Mesh.name());
            }
        }
        self.next();
        let reported = self.report(&first.here, told);
        self.skip_values();
        Some(reported)
    }
}
