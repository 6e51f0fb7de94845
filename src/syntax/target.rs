//! Parses names that directives declare, test or undefine: `Name`, `Name[i][j]`.

use super::ast::{ExpressionId, ExpressionKind, ItemKind, Items, NameId, Target};
use super::nest::Nest;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

impl<'a> Nest<'a> {
    /// Returns `Name` or `Name[i][j]`; `None` without a diagnostic if it is neither.
    pub(super) fn target_if_any(&mut self, id: ExpressionId) -> Option<Target> {
        let span = self.ast.expression(id).span;
        let (mut of, mut indices) = (id, Vec::new());
        while let ExpressionKind::Index(inner, index) = self.ast.expression(of).kind {
            indices.push(index);
            of = inner;
        }
        indices.reverse();
        let name = match self.ast.expression(of).kind {
            ExpressionKind::Name(name) => name,
            ExpressionKind::Word(_) => self.reserved(self.ast.expression(of).span),
            _ => return None,
        };
        Some(Target { name, indices, span })
    }

    pub(super) fn target(&mut self, id: ExpressionId) -> Option<Target> {
        let target = self.target_if_any(id);
        if target.is_none() {
            self.expected_name(self.ast.expression(id).span);
        }
        target
    }

    pub(super) fn name_of(&mut self, id: ExpressionId) -> Option<(NameId, Span)> {
        let target = self.target(id)?;
        if target.indices.is_empty() {
            return Some((target.name, target.span));
        }
        self.expected_name(target.span);
        None
    }

    /// Returns a name from items: a reserved word that is not a value is an item, not an expression.
    pub(super) fn name_of_items(&mut self, items: Items) -> Option<(NameId, Span)> {
        let first = *self.ast.items(items).first()?;
        if let ItemKind::Word(_) = first.kind {
            return Some((self.reserved(first.span), first.span));
        }
        self.expected_name(first.span);
        None
    }

    pub(super) fn expected_name(&mut self, span: Span) {
        if self.slice(span).is_empty() {
            return;
        }
        let text = self.slice(span).lines().next().unwrap_or("");
        let diagnostic =
            Diagnostic::new(Code::ExpectedExpression, format!("expected a name, found `{text}`"));
        // `#declare Mean(A, B) = …`
        let called = text.split_once('(').map(|(name, rest)| (name.trim_end(), rest));
        let is_name = |name: &str| {
            name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
                && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
        };
        let diagnostic = match called.filter(|(name, _)| is_name(name)) {
            Some((name, parameters)) => diagnostic
                .at(span, "parameters stand behind `function`")
                .help(format!("write `#declare {name} = function({parameters} {{ … }};`")),
            None if text.split_once('.').is_some_and(|(name, _)| is_name(name)) => diagnostic
                .at(span, "a component cannot be declared alone")
                .help("a vector is declared whole: `#declare V = <1, 2, 3>;`"),
            None => diagnostic.at(span, "a name starts with a letter or `_`"),
        };
        self.report(diagnostic);
    }

    /// Reports a keyword in place of a new name, and treats it as a name.
    pub(super) fn reserved(&mut self, span: Span) -> NameId {
        let text = self.slice(span);
        if self.names.contains_key(text) {
            return self.name(text);
        }
        let mut capital = text.to_owned();
        if let Some(first) = capital.get_mut(..1) {
            first.make_ascii_uppercase();
        }
        self.report(
            Diagnostic::new(Code::ReservedName, format!("`{text}` is a word of the language"))
                .at(span, "it cannot be declared")
                .help(format!("names that start with a capital are always free: `{capital}`")),
        );
        self.name(text)
    }
}
