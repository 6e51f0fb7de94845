//! Cases of a `#switch` that fall through.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Ast, Case, CaseKind, DirectiveKind, ItemKind, Items};

use super::super::{Evaluator, Here};

impl Evaluator<'_> {
    /// Checks `cases`, the chosen one and those after it, for a non-empty case without `#break`. A comment
    /// ("falls through") marks it as intended.
    pub(in crate::evaluate) fn lint_runs_on(&mut self, here: &Here, cases: &[Case]) {
        let ast = &here.unit.ast;
        let ends = |case: &Case| may_break(ast, case.body);
        let Some(at) = cases.iter().position(|case| !case.body.is_empty()) else { return };
        let (case, behind) = (&cases[at], &cases[at + 1..]);
        let (Some(next), false) = (behind.first(), ends(case)) else { return };
        if behind.iter().all(|next| next.body.is_empty()) {
            return;
        }
        let Some(head) = self.head_of(here, next) else { return };
        let first = ast.items(case.body).first().map_or(head, |item| item.span);
        // A head that was mended may stand before what it heads.
        if first.start > head.start {
            return;
        }
        let between = self.sources.text(Span { end: head.start, ..first });
        if between.to_ascii_lowercase().contains("fall") {
            return;
        }
        let message = "this case has no `#break` before it: the one above runs on into it";
        let diagnostic = Diagnostic::new(Code::MissingBreak, message)
            .at(head, "what stands here is taken as well")
            .help("write `#break` at the end of the case above; or two `#case` in a row for both")
            .fix(Span { end: head.start, ..head }, "#break\n");
        let diagnostic = match self.head_of(here, case) {
            Some(chosen) => diagnostic.also(chosen, "this case was chosen"),
            None => diagnostic,
        };
        self.report_again(here, &diagnostic);
    }

    /// Returns the span of the `#case`, `#range` or `#else` of a case.
    fn head_of(&self, here: &Here, case: &Case) -> Option<Span> {
        let ast = &here.unit.ast;
        let file = ast.file;
        let (behind, word) = match case.kind {
            CaseKind::Value(id) => (ast.expression(id).span.start, "case"),
            CaseKind::Range(low, _) => (ast.expression(low).span.start, "range"),
            CaseKind::Otherwise => (ast.items(case.body).first()?.span.start, "else"),
        };
        let before = self.sources.get(file).text.get(..behind as usize)?;
        let start = before.rfind('#')?;
        let length = 1 + before[start + 1..].find(word)? + word.len();
        Some(Span::new(file, start, start + length))
    }
}

/// Returns whether a `#break` or `#error` in these items may leave their switch.
fn may_break(ast: &Ast, items: Items) -> bool {
    ast.items(items).iter().any(|item| match item.kind {
        ItemKind::Block(inside) => may_break(ast, inside),
        ItemKind::Directive(id) => match &ast.directive(id).kind {
            DirectiveKind::Break
            | DirectiveKind::Error(_)
            | DirectiveKind::Unread
            | DirectiveKind::Malformed => true,
            DirectiveKind::If { then, otherwise, .. } => {
                may_break(ast, *then) || may_break(ast, *otherwise)
            }
            _ => false,
        },
        _ => false,
    })
}
