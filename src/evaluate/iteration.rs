//! Loop turns, and the selection of a switch's case.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{
    Argument, Callee, Case, CaseKind, ExpressionId, ExpressionKind, ItemKind, Items,
};
use crate::vocabulary::Word;

use super::comparison::Comparison;
use super::stream::{ALL_FAULTY_TURNS, FAULTY_TURNS, Frame, FrameKind, MOST_RUN_SINCE_FAULT};
use super::value::Value;
use super::{Evaluator, Here, Limits, Outcome, endless};

/// Number of turns after which a loop is analysed for anything that can end it: most loops have fewer, and
/// the analysis costs as much as some thousand turns.
const SUSPICIOUS_TURNS: u64 = 10_000;

impl Evaluator<'_> {
    /// Starts the next turn of the innermost loop, or ends it.
    #[inline(never)]
    pub(super) fn turn(&mut self) {
        let worn_out = match self.frames.last().map(|frame| &frame.kind) {
            Some(
                &FrameKind::While { turns, faults, .. } | &FrameKind::For { turns, faults, .. },
            ) => self.is_worn_out(turns, faults) || self.has_run_enough(),
            _ => false,
        };
        self.undecided |= worn_out;
        let Some(Frame { here, kind, at, end, .. }) = self.frames.last_mut() else { return };
        let limit = self.options.limits.loop_turns;
        let interrupt = self.options.interrupt;
        let comparison = Comparison::of(self.options.dialect);
        self.turns += 1;
        let exhausted = self.turns > limit.saturating_mul(Limits::TOGETHER);
        if exhausted || interrupt.is_set() {
            let (directive, turns) = match kind {
                FrameKind::While { directive, turns, .. }
                | FrameKind::For { directive, turns, .. } => (*directive, *turns),
                _ => return,
            };
            let here = here.clone();
            let (message, label) = match exhausted {
                true => (
                    format!("the loops of this scene have turned {} times", self.turns - 1),
                    "in this one as the last".to_owned(),
                ),
                false => (
                    "interrupted while a loop turned".to_owned(),
                    format!("this one, after {turns} turns"),
                ),
            };
            let _: Outcome<()> = self.loop_limit(&here, directive, message, &label);
            return;
        }
        match kind {
            FrameKind::While { condition, body, turns, directive, .. } => {
                *turns += 1;
                let (here, condition, body, turns, directive) =
                    (here.clone(), *condition, *body, *turns, *directive);
                // A mistake in the body may prevent the computation that ends the loop.
                let faulty = worn_out || (turns > FAULTY_TURNS && self.misread);
                let goes_on = if faulty { Ok(false) } else { self.condition(&here, condition) };
                let unknown = goes_on.is_err()
                    || (goes_on == Ok(false) && self.asks_of_broken(&here, condition));
                if unknown && turns == 1 {
                    // The condition's value is unknown: the body is read once, for its own mistakes.
                    self.pop_frame();
                    self.undecided = true;
                    return self.push_switch(&here, body);
                }
                if goes_on == Ok(true) {
                    if turns > limit {
                        let message = format!("this loop has turned {limit} times, the limit");
                        let label = "its condition stays true";
                        let _: Outcome<()> = self.loop_limit(&here, directive, message, label);
                        return;
                    }
                    if let Some(frame) = self.frames.last_mut() {
                        (frame.at, frame.end) = (body.start, body.end);
                    }
                    let ast = &here.unit.ast;
                    let constant = turns == 1 && endless::is_constant(ast, condition);
                    if body.is_empty()
                        || (constant && !endless::may_leave(ast, body))
                        || (turns == SUSPICIOUS_TURNS && self.never_changes(&here, condition, body))
                    {
                        // A misspelt word may have meant another directive; and one without its end lacks what would
                        // end it.
                        let head = ast.directive(directive).head;
                        let told = self.diagnostics.iter().any(|one| {
                            matches!(one.code, Code::MissingEnd | Code::UnclosedBlock)
                                && one.labels.iter().any(|label| label.span == head)
                        });
                        if told || !self.sources.text(head).ends_with("while") {
                            return self.pop_frame();
                        }
                        // Nothing can change: the loop would only run into the limit.
                        let message = "this loop does not end".to_owned();
                        let label = "its condition is always true";
                        let _: Outcome<()> = self.loop_limit(&here, directive, message, label);
                    }
                } else {
                    self.pop_frame();
                }
            }
            FrameKind::For { .. } if worn_out => self.pop_frame(),
            FrameKind::For { symbol, value, to, step, body, turns, directive, .. } => {
                // The body may have set the counter.
                let set = match *turns {
                    0 => None,
                    _ => self.scopes.read(*symbol).and_then(Value::as_number),
                };
                let now = set.map_or(*value, |set| set + *step);
                *value = now;
                let apart = (now - *to).abs();
                // NaN is never reached.
                let reached = !apart.is_nan() && comparison.same(now, *to)
                    // A step's worth of rounding: 0, 0.1 … 1 has eleven values.
                    || (step.is_finite() && apart <= 1e-9 * step.abs());
                let goes_on = reached || (*step > 0.0 && now < *to) || (*step < 0.0 && now > *to);
                let left = ((*to - now) / *step).max(0.0);
                // Without a way out it need not turn to be known.
                let known = *turns == 0
                    && left >= limit as f64
                    && !endless::may_leave(&here.unit.ast, *body);
                *turns += 1;
                if goes_on && (*turns > limit || known) {
                    let (here, directive) = (here.clone(), *directive);
                    let all = *turns as f64 + left.floor();
                    let message = format!("this loop has {all} turns; the limit is {limit}");
                    let label = "it turns too often";
                    let _: Outcome<()> = self.loop_limit(&here, directive, message, label);
                } else if goes_on {
                    (*at, *end) = (body.start, body.end);
                    let symbol = *symbol;
                    self.scopes.assign_local(symbol, Value::Number(now));
                } else {
                    let symbol = *symbol;
                    self.scopes.assign_local(symbol, Value::Number(now));
                    self.pop_frame();
                }
            }
            FrameKind::Barrier
            | FrameKind::Block
            | FrameKind::Branch
            | FrameKind::Switch
            | FrameKind::Macro
            | FrameKind::Include => {}
        }
    }

    /// `#break`: leaves the innermost loop, switch or macro. Returns `false` if there is none in this block
    /// or file.
    pub(super) fn break_out(&mut self) -> bool {
        let reach = self.frames.iter().rposition(|frame| !matches!(frame.kind, FrameKind::Branch));
        let Some(at) = reach else { return false };
        match self.frames[at].kind {
            FrameKind::While { .. } | FrameKind::For { .. } | FrameKind::Switch => {
                self.frames.truncate(at);
                true
            }
            FrameKind::Macro => self.end_of_macro(at),
            FrameKind::Barrier if self.is_body_of_macro(at) => self.end_of_macro(at),
            FrameKind::Barrier | FrameKind::Block | FrameKind::Branch | FrameKind::Include => false,
        }
    }

    /// Continues at the end of the macro whose body a frame runs.
    fn end_of_macro(&mut self, at: usize) -> bool {
        self.frames.truncate(at + 1);
        if let Some(frame) = self.frames.last_mut() {
            frame.at = frame.end;
        }
        true
    }

    /// Returns whether a condition is `#while (defined(File))` for a file that could not be opened.
    fn asks_of_broken(&self, here: &Here, condition: ExpressionId) -> bool {
        let asked = match here.unit.expression(condition).kind {
            ExpressionKind::Group(inner) => here.unit.expression(inner).kind,
            kind => kind,
        };
        let ExpressionKind::Call(Callee::Word(Word::Defined, _), list) = asked else {
            return false;
        };
        let [Argument::Expression(id)] = here.unit.ast.arguments(list) else { return false };
        let ExpressionKind::Name(name) = here.unit.expression(*id).kind else { return false };
        self.scopes.look(here.symbol(name)) == Some(&Value::Broken)
    }

    /// Reports a switch with a value, a word or a block before its first case, or with no case at all:
    /// `#switch (A) sphere { 0, 1 } #case (1) …`.
    pub(super) fn tell_case_lacking(
        &mut self,
        here: &Here,
        lead: Items,
        cases: &[Case],
        head: Span,
    ) {
        let ast = &here.unit.ast;
        let stray = ast
            .items(lead)
            .iter()
            .find(|item| !matches!(item.kind, ItemKind::Directive(_) | ItemKind::Semicolon));
        let place = match stray {
            Some(item) => item.span,
            None if cases.is_empty() => head,
            None => return,
        };
        let message = "`#switch` is followed by `#case` or `#range`";
        let diagnostic = Diagnostic::new(Code::ExpectedExpression, message);
        let diagnostic = match stray {
            Some(_) => diagnostic.at(place, "expected `#case (…)` before this"),
            None => diagnostic.at(place, "this one has no case"),
        };
        self.report(here, diagnostic);
    }

    /// Returns whether a loop has had enough turns since its first mistake.
    fn is_worn_out(&mut self, turns: u64, faults: u64) -> bool {
        let faulty = turns > 0 && self.faults > faults;
        self.faulty_turns += u64::from(faulty);
        faulty && (turns > FAULTY_TURNS || self.faulty_turns > ALL_FAULTY_TURNS)
    }

    /// Counts a turn or a call, and returns whether enough has been run since the first error: there will be
    /// no image, and the author is waiting for the messages.
    pub(super) fn has_run_enough(&mut self) -> bool {
        self.run_since_fault += u64::from(self.misread || self.faults > 0);
        self.run_since_fault > MOST_RUN_SINCE_FAULT
    }

    /// Returns the items of the case that `value` selects, up to the end of the switch: cases fall through.
    pub(super) fn chosen_case(
        &mut self,
        here: &Here,
        value: f64,
        cases: &[Case],
    ) -> Outcome<Option<usize>> {
        for (index, case) in cases.iter().enumerate() {
            let chosen = match case.kind {
                CaseKind::Value(id) => {
                    self.lint_condition_as_case(here, id);
                    let case = self.number(here, id)?;
                    self.comparison().same(value, case)
                }
                CaseKind::Range(low, high) => {
                    let span = here.unit.expression(low).span.to(here.unit.expression(high).span);
                    let (low, high) = (self.number(here, low)?, self.number(here, high)?);
                    self.lint_empty_range(here, span, low, high);
                    (low..=high).contains(&value)
                }
                CaseKind::Otherwise => true,
            };
            if chosen {
                return Ok(Some(index));
            }
        }
        Ok(None)
    }
}
