//! Conditions that parse differently from how they look: `#if (0 < A < 3)`, `#if (A = 1 | 2)`, `#case (N <
//! 3)`.

use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::{Evaluator, Here, Outcome};
use crate::source::Span;
use crate::syntax::ast::{BinaryOperator, ExpressionId, ExpressionKind, Rank};
use crate::vocabulary::Word;

impl Evaluator<'_> {
    pub(in crate::evaluate) fn lint_condition(&mut self, here: &Here, condition: ExpressionId) {
        if self.lint_value_for_condition(here, condition) {
            return;
        }
        let mut first = condition;
        while let ExpressionKind::Binary(BinaryOperator::And | BinaryOperator::Or, left, right) =
            here.unit.expression(first).kind
        {
            self.lint_chain(here, right, false);
            first = left;
        }
        self.lint_chain(here, first, first == condition);
    }

    /// As [`Self::condition`], with the lints for a condition in its own directive.
    pub(in crate::evaluate) fn asked_condition(
        &mut self,
        here: &Here,
        condition: ExpressionId,
    ) -> Outcome<bool> {
        self.lint_condition(here, condition);
        self.condition(here, condition)
    }

    /// Warns of a chained comparison, whose second operator compares 1 or 0: `0 < A < 3`.
    fn lint_chain(&mut self, here: &Here, id: ExpressionId, is_whole: bool) {
        let ExpressionKind::Binary(second, left, _) = here.unit.expression(id).kind else {
            return;
        };
        let ExpressionKind::Binary(first, _, middle) = here.unit.expression(left).kind else {
            return;
        };
        let rises = |one| matches!(one, BinaryOperator::Less | BinaryOperator::LessOrEqual);
        let falls = |one| matches!(one, BinaryOperator::Greater | BinaryOperator::GreaterOrEqual);
        if !(rises(first) && rises(second) || falls(first) && falls(second)) {
            return;
        }
        let [whole, left, middle] = [id, left, middle].map(|id| here.unit.expression(id).span);
        let [left_text, middle_text] =
            [left, middle].map(|span| self.sources.text(span).to_owned());
        let rest = Span { start: left.end, end: whole.end, ..whole };
        let rest = self.sources.text(rest).trim_start().to_owned();
        let right = format!("{left_text} & {middle_text} {rest}");
        let right = if is_whole { right } else { format!("({right})") };
        let symbol = Span { start: left.end, ..whole };
        let at = self.sources.text(symbol).find(second.symbol()).unwrap_or(0) as u32;
        let start = left.end + at;
        let sign = Span { start, end: start + second.symbol().len() as u32, ..whole };
        let message = format!("`{}` compares what `{left_text}` comes to: 1 or 0", second.symbol());
        let told = Diagnostic::new(Code::LooseOperation, message)
            .at(sign, "a comparison takes two values")
            .also(left, "this is 1 or 0")
            .help(format!("write `{right}`"));
        // A called function may return another value the second time.
        let told = if middle_text.contains('(') { told } else { told.fix(whole, right) };
        self.report(here, told);
    }

    /// Warns of a number as a condition of its own, `A = 1 | 2`; returns whether it did.
    fn lint_value_for_condition(&mut self, here: &Here, id: ExpressionId) -> bool {
        let (mut first, mut values) = (id, Vec::new());
        while let ExpressionKind::Binary(BinaryOperator::Or, left, right) =
            here.unit.expression(first).kind
        {
            values.push(right);
            first = left;
        }
        let ExpressionKind::Binary(BinaryOperator::Equal, asked, _) =
            here.unit.expression(first).kind
        else {
            return false;
        };
        let is_number = |id: &ExpressionId| matches!(here.unit.expression(*id).kind, ExpressionKind::Number(n) if n != 0.0);
        if !values.iter().all(is_number) {
            return false;
        }
        let asked = self.sources.text(here.unit.expression(asked).span).to_owned();
        values.reverse();
        let spans = values.iter().map(|id| here.unit.expression(*id).span);
        let Some(place) = spans.clone().next() else { return false };
        let number = self.sources.text(place).to_owned();
        let message = format!("`{number}` is a condition of its own here, and always true");
        let told = Diagnostic::new(Code::LooseOperation, message)
            .at(place, "compared with nothing")
            .help(format!("write `{asked} = {number}`"));
        let before = |span: Span| Span { end: span.start, ..span };
        let told = spans.fold(told, |told, span| told.fix(before(span), format!("{asked} = ")));
        self.report(here, told);
        true
    }

    /// Warns of a condition in a case, which compares the value with 1 or 0: `#case (N < 3)` in `#switch
    /// (N)`.
    pub(in crate::evaluate) fn lint_condition_as_case(&mut self, here: &Here, id: ExpressionId) {
        let mut inner = id;
        while let ExpressionKind::Group(group) = here.unit.expression(inner).kind {
            inner = group;
        }
        let ExpressionKind::Binary(operator, asked, _) = here.unit.expression(inner).kind else {
            return;
        };
        if !matches!(operator.rank(), Rank::Relational | Rank::Logical) {
            return;
        }
        let span = here.unit.expression(id).span;
        // `#switch (1) #case (N < 3)` tests each in turn.
        let before = self.sources.get(span.file).text.get(..span.start as usize).unwrap_or("");
        let Some(switch) = before.rfind("#switch") else { return };
        let head = before[switch + 1..].split('#').next().unwrap_or("");
        let asked = self.sources.text(here.unit.expression(asked).span);
        let mut words = head.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        let is_asked = words.any(|word| word == asked) && !head.contains(['<', '>', '=', '&', '|']);
        if !is_asked || Word::from_name(asked).is_some() {
            return;
        }
        let text = self.sources.text(span);
        let message = format!("`#case` takes a value, and `{text}` is a condition: 1 or 0");
        let told = Diagnostic::new(Code::NeverRuns, message)
            .at(span, "expected a value")
            .help("between two values: `#range (low, high)`")
            .help(format!("or ask by `#if ({text})`"));
        if !self.repeats(&told) {
            self.report(here, told);
        }
    }
}
