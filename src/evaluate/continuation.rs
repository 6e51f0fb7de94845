//! Expressions that continue after a directive: `(0 #for (I, 1, 3) + I*I #end)`, `function { x #if (A) * 2
//! #end }`, `sphere { 0, 2 * #if (A) 3 #else 4 #end }`.
//!
//! **Invariant:** as in POV-Ray, which reads the tokens that a directive leaves as if they were written in
//! its place, operands are evaluated in reading order, and operators bind as they would without the
//! directive.

use crate::diagnostic::{Code, Diagnostic};
use crate::function::Node;
use crate::source::Span;
use crate::syntax::ast::{
    BinaryOperator, ExpressionId, ExpressionKind, ItemKind, Items, UnaryOperator,
};

use super::formula::{Formula, operation_of};
use super::stream::{FrameKind, Hold, Token, TokenKind};
use super::value::{self, Value};
use super::{Evaluator, Here, Outcome, Reported};

/// An operator whose left operand has been read, and its span.
struct Pending<T> {
    left: T,
    operator: BinaryOperator,
    site: (Here, ExpressionId),
}

/// A partially read expression; operators that bind tighter are nearer the end.
struct Calculation<T> {
    pending: Vec<Pending<T>>,
    /// The last operand; `None` if one must follow.
    last: Option<T>,
}

/// The operations on the kind of operand that is calculated with.
trait Arithmetic<T> {
    fn evaluate(&mut self, here: &Here, id: ExpressionId) -> Outcome<T>;
    /// Continues with the items that a called macro leaves; returns `false` if they are one operand.
    fn splice(&mut self, _: &mut Calculation<T>, _: &Here, _: ExpressionId) -> Outcome<bool> {
        Ok(false)
    }
    fn apply(&mut self, operation: Pending<T>, right: T) -> Outcome<T>;
}

/// Splits an expression into its leftmost operand and the operations applied to it, in order.
fn spine(
    here: &Here,
    id: ExpressionId,
) -> (ExpressionId, Vec<(BinaryOperator, ExpressionId, ExpressionId)>) {
    let (mut first, mut operations) = (id, Vec::new());
    while let ExpressionKind::Binary(operator, left, right) = here.unit.expression(first).kind {
        operations.push((operator, right, first));
        first = left;
    }
    operations.reverse();
    (first, operations)
}

/// Returns the binary operator that an operand's sign becomes after a preceding operand.
fn sign(operator: UnaryOperator) -> Option<BinaryOperator> {
    match operator {
        UnaryOperator::Plus => Some(BinaryOperator::Add),
        UnaryOperator::Minus => Some(BinaryOperator::Subtract),
        UnaryOperator::Not => None,
    }
}

/// Returns whether an expression continues the one before it.
fn goes_on(here: &Here, id: ExpressionId) -> bool {
    match here.unit.expression(spine(here, id).0).kind {
        ExpressionKind::Joint => true,
        ExpressionKind::Unary(operator, _) => sign(operator).is_some(),
        _ => false,
    }
}

pub(super) fn holds_directive(here: &Here, items: Items) -> bool {
    let items = here.unit.ast.items(items);
    items.iter().any(|item| matches!(item.kind, ItemKind::Directive(_)))
}

impl<T> Calculation<T> {
    const EMPTY: Self = Self { pending: Vec::new(), last: None };

    /// Reads an expression from its first operand on.
    fn read(&mut self, of: &mut impl Arithmetic<T>, here: &Here, id: ExpressionId) -> Outcome<()> {
        let (first, operations) = spine(here, id);
        match here.unit.expression(first).kind {
            ExpressionKind::Joint if self.last.is_some() => {}
            // There is no operand, which is reported.
            ExpressionKind::Joint => drop(of.evaluate(here, first)?),
            ExpressionKind::Unary(operator, operand)
                if self.last.is_some()
                    && let Some(operator) = sign(operator) =>
            {
                self.operator(of, operator, (here, first))?;
                self.operand(of, here, operand)?;
            }
            _ => self.operand(of, here, first)?,
        }
        for (operator, right, id) in operations {
            self.operator(of, operator, (here, id))?;
            self.operand(of, here, right)?;
        }
        Ok(())
    }

    /// Reads an operand, whose last part a following operator may take.
    fn operand(
        &mut self,
        of: &mut impl Arithmetic<T>,
        here: &Here,
        id: ExpressionId,
    ) -> Outcome<()> {
        match here.unit.expression(id).kind {
            ExpressionKind::Binary(..) => self.read(of, here, id),
            // What comes next.
            ExpressionKind::Joint => Ok(()),
            ExpressionKind::Call(..) if of.splice(self, here, id)? => Ok(()),
            _ => {
                self.last = Some(of.evaluate(here, id)?);
                Ok(())
            }
        }
    }

    fn operator(
        &mut self,
        of: &mut impl Arithmetic<T>,
        operator: BinaryOperator,
        (here, id): (&Here, ExpressionId),
    ) -> Outcome<()> {
        let left = self.result(of, Some(operator))?.ok_or(Reported)?;
        self.pending.push(Pending { left, operator, site: (here.clone(), id) });
        Ok(())
    }

    /// Reduces all operators that bind at least as tightly as a following operator; without one, all.
    fn result(
        &mut self,
        of: &mut impl Arithmetic<T>,
        behind: Option<BinaryOperator>,
    ) -> Outcome<Option<T>> {
        let Some(mut last) = self.last.take() else { return Ok(None) };
        let is_first = |pending: &mut Pending<T>| {
            behind.is_none_or(|behind| pending.operator.rank() >= behind.rank())
        };
        while let Some(operation) = self.pending.pop_if(is_first) {
            last = of.apply(operation, last)?;
        }
        Ok(Some(last))
    }
}

/// Calculates with values of the language.
impl Arithmetic<Value> for Evaluator<'_> {
    fn evaluate(&mut self, here: &Here, id: ExpressionId) -> Outcome<Value> {
        self.operand(here, id)
    }

    fn splice(
        &mut self,
        calculation: &mut Calculation<Value>,
        here: &Here,
        id: ExpressionId,
    ) -> Outcome<bool> {
        let Some(called) = self.leaves_operation(here, id) else { return Ok(false) };
        let expression = here.unit.expression(id);
        let ExpressionKind::Call(_, arguments) = expression.kind else { return Ok(false) };
        let span = expression.span;
        let read = self.read_macro(here, called, arguments, span, |evaluator| {
            evaluator.go_on_with_items(calculation, here, span)
        });
        read.map_or(Ok(false), |read| read.map(|()| true))
    }

    fn apply(&mut self, operation: Pending<Value>, right: Value) -> Outcome<Value> {
        let Pending { left, operator, site: (here, id) } = operation;
        if let Some(poison) =
            [&left, &right].into_iter().find(|one| matches!(one, Value::Poison(_)))
        {
            return Ok(poison.clone());
        }
        value::binary(operator, &left, &right, self.comparison()).or_else(|error| {
            let expression = here.unit.expression(id);
            let operands = match expression.kind {
                ExpressionKind::Binary(_, left, right) => [left, right],
                _ => [id; 2],
            };
            let places = (expression.span, operands);
            self.no_plain_result(&here, operator, error, places, [&left, &right])
        })
    }
}

/// Calculates with steps of a function's tape.
struct Steps<'e, 'a, 'f> {
    evaluator: &'e mut Evaluator<'a>,
    formula: &'f mut Formula,
}

impl Arithmetic<Node> for Steps<'_, '_, '_> {
    fn evaluate(&mut self, here: &Here, id: ExpressionId) -> Outcome<Node> {
        self.evaluator.node(here, self.formula, id)
    }

    fn apply(&mut self, operation: Pending<Node>, right: Node) -> Outcome<Node> {
        let Pending { left, operator, site: (here, id) } = operation;
        let built = operation_of(&mut self.formula.builder, operator, left, right);
        self.evaluator.built(&here, here.unit.expression(id).span, built)
    }
}

impl Evaluator<'_> {
    /// Returns the value of an item already taken, and of its continuation after a directive.
    pub(super) fn joined_value(&mut self, token: &Token) -> Outcome<Value> {
        let mut calculation = Calculation::EMPTY;
        match &token.kind {
            TokenKind::Expression(id) if !self.is_by_directive() => {
                if !ends_open(&token.here, *id) {
                    return self.expression(&token.here, *id);
                }
                calculation.read(self, &token.here, *id)?;
            }
            TokenKind::Expression(id) => match token.here.unit.expression(*id).kind {
                ExpressionKind::Binary(..) => calculation.read(self, &token.here, *id)?,
                _ => calculation.last = Some(self.expression(&token.here, *id)?),
            },
            TokenKind::Literal(value) => calculation.last = Some(value.as_ref().clone()),
            _ => {}
        }
        while let Some((here, id)) = self.next_joint(calculation.last.is_none()) {
            calculation.read(self, &here, id)?;
        }
        match calculation.result(self, None)? {
            Some(value) => Ok(value),
            None => Err(self.lacks_operand(&calculation, &token.here, token.span)),
        }
    }

    /// Evaluates an expression in which a macro leaves an operation: in a `.pov`, the macro's text replaces
    /// the call.
    pub(super) fn spliced_value(&mut self, here: &Here, id: ExpressionId) -> Outcome<Value> {
        let mut calculation = Calculation::EMPTY;
        calculation.read(self, here, id)?;
        calculation.result(self, None)?.ok_or(Reported)
    }

    fn go_on_with_items(
        &mut self,
        calculation: &mut Calculation<Value>,
        here: &Here,
        span: Span,
    ) -> Outcome<()> {
        while let Some(token) = self.next() {
            match token.kind {
                TokenKind::Semicolon => {}
                TokenKind::Expression(id) if calculation.last.is_none() => {
                    calculation.read(self, &token.here, id)?;
                }
                TokenKind::Expression(id) if goes_on(&token.here, id) => {
                    calculation.read(self, &token.here, id)?;
                }
                _ if calculation.last.is_none() => {
                    calculation.last = Some(self.value_of(&token)?);
                }
                _ => return Err(self.more_than_one(&token)),
            }
        }
        match calculation.last {
            Some(_) => Ok(()),
            None => Err(self.expected("a value", None, (here, span.after()))),
        }
    }

    /// Returns whether a directive separates the item taken last from the next.
    pub(super) fn is_by_directive(&self) -> bool {
        self.peeked.is_some()
            || self.frames.last().is_some_and(|frame| match frame.at == frame.end {
                true => {
                    !matches!(frame.kind, FrameKind::Barrier | FrameKind::Block | FrameKind::Macro)
                }
                false => matches!(
                    frame.here.unit.ast.items[frame.at as usize].kind,
                    ItemKind::Directive(_)
                ),
            })
    }

    /// As [`Self::joined_value`], for a formula that begins with this expression.
    pub(super) fn joined_node(
        &mut self,
        here: &Here,
        formula: &mut Formula,
        id: ExpressionId,
    ) -> Outcome<Node> {
        let is_alone = !self.peeks_joint() && !ends_open(here, id);
        if is_alone {
            return self.node(here, formula, id);
        }
        let mut calculation = Calculation::EMPTY;
        calculation.read(&mut Steps { evaluator: self, formula }, here, id)?;
        while let Some((here, id)) = self.next_joint(calculation.last.is_none()) {
            calculation.read(&mut Steps { evaluator: self, formula }, &here, id)?;
        }
        let node = calculation.result(&mut Steps { evaluator: self, formula }, None)?;
        node.ok_or_else(|| self.lacks_operand(&calculation, here, here.unit.expression(id).span))
    }

    /// Reports an operand that no directive left.
    fn lacks_operand<T>(
        &mut self,
        calculation: &Calculation<T>,
        here: &Here,
        span: Span,
    ) -> Reported {
        if let Some(Pending { site: (here, id), .. }) = calculation.pending.last()
            && let ExpressionKind::Binary(_, _, right) = here.unit.expression(*id).kind
        {
            return self.nothing_joined(here, here.unit.expression(right).span);
        }
        self.expected("a value", None, (here, span.after()))
    }

    fn peeks_joint(&mut self) -> bool {
        let Some(token) = self.peek() else { return false };
        matches!(token.kind, TokenKind::Expression(id) if goes_on(&token.here, id))
    }

    /// Returns the next expression if it continues the one before, or if an operand is missing.
    fn next_joint(&mut self, wanted: bool) -> Option<(Here, ExpressionId)> {
        // A required operand comes before the end of a `#declare`.
        let hold = if wanted { self.hold.take() } else { self.hold };
        self.peek_on();
        let first = self.frames.len();
        self.hold = if wanted { hold.map(|hold| Hold { first, ..hold }) } else { hold };
        let token = self.peeked.as_ref()?;
        let TokenKind::Expression(id) = token.kind else { return None };
        let here = token.here.clone();
        let is_joint = wanted || goes_on(&here, id);
        is_joint.then(|| {
            self.next();
            (here, id)
        })
    }

    /// Reports an operand that is missing after a directive.
    pub(super) fn nothing_joined(&mut self, here: &Here, place: Span) -> Reported {
        let text = self.sources.get(place.file).text.as_str();
        let sign = |c: &char| "*/<>=!&|+-".contains(*c);
        let behind = text.get(place.end as usize..).and_then(|rest| rest.chars().next());
        let (side, span) = match behind.filter(sign) {
            Some(_) => ("before", Span { end: place.end + 1, ..place }),
            None => ("after", Span { start: place.start.saturating_sub(1), ..place }),
        };
        let message = format!("expected a value {side} `{}`", self.sources.text(span));
        let diagnostic = Diagnostic::new(Code::ExpectedExpression, message)
            .at(span, "this operator stands between two values");
        self.report(here, diagnostic)
    }
}

/// Returns whether the last operand of an expression is still missing.
fn ends_open(here: &Here, mut id: ExpressionId) -> bool {
    while let ExpressionKind::Binary(_, _, right) = here.unit.expression(id).kind {
        id = right;
    }
    matches!(here.unit.expression(id).kind, ExpressionKind::Joint)
}
