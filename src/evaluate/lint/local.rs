//! `#local Total = Total + N;` in a macro with an outer name: the result is lost when the macro ends.

use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::{Evaluator, Here};
use crate::source::Span;
use crate::syntax::ast::{Body, Directive, DirectiveKind, ExpressionKind, ItemKind, Parameter};

impl Evaluator<'_> {
    /// Checks the body of a macro at its definition. Values assigned in a loop may be used by its next turn.
    pub(in crate::evaluate) fn lint_local_sum(
        &mut self,
        here: &Here,
        parameters: &[Parameter],
        body: &Body,
    ) {
        let Body::Items(items) = body else { return };
        let unit = here.unit.clone();
        let ast = &unit.ast;
        let items = ast.items(*items);
        let Some(last) = items.last().map(|last| last.span) else { return };
        for (at, item) in items.iter().enumerate() {
            let ItemKind::Directive(id) = item.kind else { continue };
            let Directive { kind: DirectiveKind::Declare { local: true, target }, head } =
                ast.directive(id)
            else {
                continue;
            };
            let value = items.get(at + 1).and_then(|value| match value.kind {
                ItemKind::Expression(id) => Some(ast.expression(id)),
                _ => None,
            });
            let Some(value) = value.filter(|_| target.indices.is_empty()) else { continue };
            let ExpressionKind::Binary(_, first, _) = value.kind else { continue };
            let is_own = parameters.iter().any(|parameter| parameter.name == target.name);
            if is_own || ast.expression(first).kind != ExpressionKind::Name(target.name) {
                continue;
            }
            let name = self.sources.text(target.span).to_owned();
            let words = |span: Span| {
                let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
                let text = self.sources.text(span).split(move |c| !is_part(c));
                text.filter(|word| *word == name).count()
            };
            let first = items.first().map_or(*head, |first| first.span);
            let before = Span { start: first.start, end: head.start, ..first };
            let behind = Span { start: value.span.end, end: last.end.max(value.span.end), ..last };
            // Macros called after it see the name, too.
            let text = self.sources.text(behind);
            let calls = text.contains('(') || text.contains("#include");
            if words(before) > 0 || words(behind) > 0 || calls {
                continue;
            }
            let message = format!("this `{name}` ends with the macro, and nothing asks for it");
            let told = Diagnostic::new(Code::UnusedDeclaration, message)
                .at(target.span, format!("the `{name}` outside stays as it is"))
                .help("`#declare` changes the one outside")
                .fix(*head, "#declare");
            self.report(here, told);
        }
    }
}
