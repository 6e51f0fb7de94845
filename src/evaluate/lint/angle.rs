//! Angles in radians where degrees are meant, and vice versa.

use super::is_literal;
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::Given;
use crate::evaluate::stream::FrameKind;
use crate::evaluate::value::Value;
use crate::evaluate::{Evaluator, Here};
use crate::math::Vector;
use crate::source::{Site, Span};
use crate::syntax::ast::{
    Argument, BinaryOperator, Callee, DirectiveKind, ExpressionId, ExpressionKind, NameId,
    UnaryOperator,
};
use crate::vocabulary::Word;

/// Larger angles are not radians: a full turn is 2π.
const FULL_TURN: f64 = 6.5;
/// Tolerance for a literal angle that is truncated to three decimals.
const TYPED: f64 = 0.0011;
/// Smallest step of a counter that counts a turn in degrees: 0, 30 … 330 or 360.
const FEWEST_DEGREES: f64 = 5.0;

/// Common names of angles.
const ANGLES: [&str; 6] = ["angle", "theta", "phi", "alpha", "deg", "tilt"];

/// Returns whether a literal looks like a fraction of π: 0.785, 1.5708; with two decimals only known ones.
fn is_typed_in_radians(angle: f64) -> bool {
    let hundredths = (angle.abs() * 100.0).round();
    if hundredths / 100.0 == angle.abs() {
        return matches!(hundredths as u32, 157 | 314 | 471 | 628);
    }
    // Steps of 15° and of 22.5°.
    let near = |step: f64| {
        let steps = (angle.abs() / step).round();
        steps >= 1.0 && (angle.abs() - steps * step).abs() < TYPED
    };
    near(std::f64::consts::PI / 12.0) || near(std::f64::consts::PI / 8.0)
}

/// Returns the degrees for which a literal angle in radians stands: 180 for 3.14.
fn typed_for(radians: f64) -> String {
    let meant = radians.to_degrees();
    match (meant - meant.round()).abs() < 0.2 {
        true => format!("{}", meant.round()),
        false => format!("{meant:.1}"),
    }
}

impl Evaluator<'_> {
    /// Checks the vector of a `rotate`: degrees about each axis.
    pub(in crate::evaluate) fn lint_rotation(&mut self, given: &Given<Vector>) {
        if self.lint_degrees(given, &given.value.to_array()) {
            return;
        }
        let text = self.sources.text(given.span);
        let is_number = is_literal(text) || self.is_of_numbers(text);
        if given.value == Vector::ZERO || !is_number {
            return;
        }
        // `rotate 45 degrees` is reported as such.
        let behind = self.sources.get(given.span.file).text.get(given.span.end as usize..);
        if behind.is_some_and(|text| text.trim_start().starts_with("deg")) {
            return;
        }
        let message = "a number turns about all three axes, one after the other";
        let diagnostic = Diagnostic::new(Code::ShortVector, message)
            .at(given.span, format!("this is <{text}, {text}, {text}>"))
            .help(format!("did you mean `rotate {text}*y`?"));
        self.report(&given.here, diagnostic);
    }

    /// Returns whether an expression consists of numbers only, without random ones: `I*360/Teeth`.
    fn is_of_numbers(&self, text: &str) -> bool {
        let of_name = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
        let is_number = |word: &str| {
            let symbol = self.scopes.symbol(word);
            let held = symbol.and_then(|symbol| self.scopes.look(symbol));
            word.is_empty()
                || word.parse::<f64>().is_ok()
                || matches!(word, "clock" | "pi")
                || matches!(held, Some(Value::Number(_)))
        };
        text.contains(['*', '/'])
            && text.chars().all(|c| of_name(c) || "+-*/ ".contains(c))
            && text.split(|c: char| !of_name(c)).all(is_number)
    }

    /// Warns if angles that should be degrees look like radians; returns whether it did.
    fn lint_degrees<T>(&mut self, given: &Given<T>, degrees: &[f64]) -> bool {
        let largest = degrees.iter().fold(0.0f64, |most, value| most.max(value.abs()));
        if largest == 0.0 || largest > FULL_TURN {
            return false;
        }
        let text = self.sources.text(given.span);
        let literal = text.chars().all(|c| !c.is_alphabetic() || "xyz".contains(c));
        let looks = literal && degrees.iter().any(|value| is_typed_in_radians(*value));
        let certain = given.expression.filter(|id| looks || self.is_in_radians(&given.here, *id));
        let Some(expression) = certain else { return false };
        let diagnostic = Diagnostic::new(
            Code::SuspiciousUnit,
            "this angle looks like radians, and is taken as degrees",
        )
        .at(given.span, format!("{largest:.4} degrees"));
        let written = match literal {
            true => self.typed_in_degrees(&given.here, expression, degrees),
            false => self.in_degrees(&given.here, expression, degrees.len() == 1),
        };
        let meant = typed_for(largest);
        let diagnostic = match written {
            Some(written) if literal => diagnostic
                .help(format!("as radians it is {meant} degrees: write `{written}`"))
                .fix(given.span, written),
            Some(written) => diagnostic.help(format!("write `{written}`")).fix(given.span, written),
            None => diagnostic.help(format!("as radians it is {meant} degrees: write these")),
        };
        self.report(&given.here, diagnostic);
        true
    }

    /// Warns of a single angle that is certainly in radians; returns whether it did.
    pub(in crate::evaluate) fn lint_angle_in_radians(&mut self, given: &Given<f64>) -> bool {
        !is_literal(self.sources.text(given.span)) && self.lint_degrees(given, &[given.value])
    }

    /// Returns a literal rotation in whole degrees or tenths: `<0, 3.14159/4, 0>`, `1.5708*y`.
    fn typed_in_degrees(&self, here: &Here, id: ExpressionId, angles: &[f64]) -> Option<String> {
        let unit = &here.unit;
        let whole = unit.expression(id).span;
        let is_axis = |id: ExpressionId| {
            matches!(unit.expression(id).kind, ExpressionKind::Word(Word::X | Word::Y | Word::Z))
        };
        let largest = angles.iter().copied().find(|angle| *angle != 0.0)?;
        let pieces: Vec<(Span, f64)> = match unit.expression(id).kind {
            ExpressionKind::Vector(list) => {
                let list = unit.ast.arguments(list);
                let parts = list.iter().zip(angles).filter(|(_, angle)| **angle != 0.0);
                let parts = parts.map(|(argument, angle)| match *argument {
                    Argument::Expression(id) if is_typed_in_radians(*angle) => {
                        Some((unit.expression(id).span, *angle))
                    }
                    Argument::Expression(_) | Argument::Items(_) => None,
                });
                let parts: Option<Vec<(Span, f64)>> = parts.collect();
                parts.filter(|_| list.len() == angles.len())?
            }
            ExpressionKind::Triple(triple) => {
                let parts = triple.spans(whole).into_iter().zip(angles.iter().copied());
                let parts: Vec<(Span, f64)> = parts.filter(|(_, angle)| *angle != 0.0).collect();
                let all = parts.iter().all(|(_, angle)| is_typed_in_radians(*angle));
                Some(parts).filter(|_| all && angles.len() == 3)?
            }
            ExpressionKind::Binary(BinaryOperator::Multiply, left, right) if is_axis(right) => {
                vec![(unit.expression(left).span, largest)]
            }
            ExpressionKind::Binary(BinaryOperator::Multiply, left, right) if is_axis(left) => {
                vec![(unit.expression(right).span, largest)]
            }
            _ => return None,
        };
        let mut text = self.sources.text(whole).to_owned();
        for (piece, angle) in pieces.into_iter().rev() {
            let at = (piece.start - whole.start) as usize..(piece.end - whole.start) as usize;
            text.replace_range(at, &typed_for(angle));
        }
        Some(text)
    }

    /// Returns an expression with radians converted to degrees, if they are a factor or a component of it.
    fn in_degrees(&mut self, here: &Here, id: ExpressionId, is_number: bool) -> Option<String> {
        let unit = here.unit.clone();
        let whole = unit.expression(id).span;
        let axis = |id: ExpressionId| {
            matches!(unit.expression(id).kind, ExpressionKind::Word(Word::X | Word::Y | Word::Z))
        };
        // Each with the expression that it begins with.
        let pieces: Vec<(Span, ExpressionId)> = match unit.expression(id).kind {
            ExpressionKind::Vector(list) => unit
                .ast
                .arguments(list)
                .iter()
                .filter_map(|argument| match *argument {
                    Argument::Expression(id) if self.is_in_radians(here, id) => {
                        Some((unit.expression(id).span, id))
                    }
                    Argument::Expression(_) | Argument::Items(_) => None,
                })
                .collect(),
            ExpressionKind::Binary(BinaryOperator::Multiply, left, right) if axis(right) => {
                vec![(unit.expression(left).span, left)]
            }
            _ if is_number => vec![(whole, id)],
            _ => {
                // `y*pi/4`: everything after the axis.
                let (mut at, mut rest) = (id, None);
                while let ExpressionKind::Binary(
                    operator @ (BinaryOperator::Multiply | BinaryOperator::Divide),
                    left,
                    right,
                ) = unit.expression(at).kind
                {
                    if operator == BinaryOperator::Multiply && axis(left) {
                        let start = unit.expression(right).span;
                        rest = Some((Span { end: whole.end, ..start }, right));
                    }
                    at = left;
                }
                rest.into_iter().collect()
            }
        };
        let mut text = self.sources.text(whole).to_owned();
        for &(piece, first) in pieces.iter().rev() {
            let at = (piece.start - whole.start) as usize..(piece.end - whole.start) as usize;
            let alone = unit.expression(first).span == piece;
            let replaced = match within_radians(here, first).filter(|_| alone) {
                Some(inner) => self.sources.text(inner).to_owned(),
                None => format!("degrees({})", &text[at.clone()]),
            };
            text.replace_range(at, &replaced);
        }
        (!pieces.is_empty()).then_some(text)
    }

    /// Warns if an argument of `sin`, `cos` or `tan` looks like degrees.
    pub(in crate::evaluate) fn lint_trigonometry(
        &mut self,
        here: &Here,
        word: Word,
        id: ExpressionId,
        angle: f64,
    ) {
        // Nothing else needs a check, and these are called often.
        let is_small = angle.abs() < FEWEST_DEGREES;
        if is_small || !matches!(word, Word::Sin | Word::Cos | Word::Tan) {
            return;
        }
        let typed = angle.fract() == 0.0 && self.is_typed_in_degrees(here, id);
        if !typed && !self.is_called_an_angle(here, id, angle) {
            return;
        }
        let span = here.unit.expression(id).span;
        let (text, name) = (self.sources.text(span), word.name());
        let right = format!("radians({text})");
        let message = format!("`{name}` takes radians, and this looks like degrees");
        let diagnostic = Diagnostic::new(Code::SuspiciousUnit, message)
            .at(span, format!("{angle} radians"))
            .help(format!("write `{right}`"))
            .fix(span, right);
        self.report(here, diagnostic);
    }

    /// Returns whether an expression is a literal multiple of 15, or the counter of a loop that goes round in
    /// whole degrees.
    fn is_typed_in_degrees(&self, here: &Here, id: ExpressionId) -> bool {
        let unit = &here.unit;
        let (mut id, mut shifted) = (id, false);
        loop {
            match unit.expression(id).kind {
                ExpressionKind::Unary(UnaryOperator::Minus, inner)
                | ExpressionKind::Group(inner) => id = inner,
                ExpressionKind::Binary(
                    BinaryOperator::Add | BinaryOperator::Subtract,
                    left,
                    right,
                ) if !shifted => match number(here, right) {
                    Some(turn) if turn % 15.0 == 0.0 => (id, shifted) = (left, true),
                    _ => return false,
                },
                ExpressionKind::Number(degrees) => {
                    return !shifted && degrees % 15.0 == 0.0 && degrees <= 720.0;
                }
                // `cos(I*60)`
                ExpressionKind::Binary(BinaryOperator::Multiply, left, right) => {
                    let counted = |one: ExpressionId, other: ExpressionId| {
                        matches!(unit.expression(one).kind, ExpressionKind::Name(_))
                            && number(here, other).is_some_and(|n| {
                                [30.0, 45.0, 60.0, 90.0, 120.0, 180.0, 360.0].contains(&n)
                            })
                    };
                    return counted(left, right) || counted(right, left);
                }
                ExpressionKind::Name(name) => {
                    return self.counts_degrees(here, name)
                        || self.is_degrees_beside(unit.expression(id).span);
                }
                _ => return false,
            }
        }
    }

    /// Returns whether a name suggests an angle and its value is less than a turn in degrees: `sin(Theta/2)`
    /// with 104.5 for `Theta`.
    fn is_called_an_angle(&self, here: &Here, id: ExpressionId, angle: f64) -> bool {
        let unit = &here.unit;
        let (name, whole) = match unit.expression(id).kind {
            ExpressionKind::Name(_) => (id, angle),
            ExpressionKind::Binary(BinaryOperator::Divide, left, right) => {
                match number(here, right) {
                    Some(part) => (left, angle * part),
                    None => return false,
                }
            }
            _ => return false,
        };
        let ExpressionKind::Name(name) = unit.expression(name).kind else { return false };
        let symbol = here.symbol(name);
        let called = self.scopes.name(symbol).to_ascii_lowercase();
        let is_angle = ANGLES.iter().any(|angle| called.contains(angle));
        if !is_angle || !(2.0 * FULL_TURN..=360.0).contains(&whole.abs()) {
            return false;
        }
        // A computed or counted angle may exceed a turn.
        self.scopes.declared(symbol).is_some_and(|declared| {
            let Site { span, .. } = declared.site;
            let text = self.sources.get(span.file).text.get(span.end as usize..).unwrap_or("");
            let value = text.trim_start().strip_prefix('=').unwrap_or("");
            is_literal(value.split([';', '\n']).next().unwrap_or("").trim())
        })
    }

    /// Returns whether the same line converts a name from degrees: `<cos(radians(A)), sin(A)>`.
    fn is_degrees_beside(&self, name: Span) -> bool {
        let text = &self.sources.get(name.file).text;
        let (before, behind) = text.split_at(name.start as usize);
        let line = &before[before.rfind('\n').map_or(0, |at| at + 1)..];
        let rest = behind.split('\n').next().unwrap_or("");
        let turned = format!("radians({})", self.sources.text(name));
        line.contains(&turned) || rest.contains(&turned)
    }

    /// Returns whether a name counts a full or half turn in whole degrees: `#for (I, 0, 360, 30)`.
    fn counts_degrees(&self, here: &Here, name: NameId) -> bool {
        let symbol = here.symbol(name);
        let counter = self.frames.iter().rev().take(64).find_map(|frame| match frame.kind {
            FrameKind::For { symbol: counter, directive, .. } if counter == symbol => {
                Some((&frame.here, directive))
            }
            _ => None,
        });
        let Some((there, directive)) = counter else { return false };
        // In a macro that the loop calls, the name may be local.
        if there.expansion != here.expansion {
            return false;
        }
        let DirectiveKind::For { from, to, step: Some(step), .. } =
            there.unit.ast.directive(directive).kind
        else {
            return false;
        };
        let [Some(from), Some(to), Some(step)] = [from, to, step].map(|id| number(there, id))
        else {
            return false;
        };
        let (range, step) = ((to - from).abs(), step.abs());
        let whole = from.fract() == 0.0 && step.fract() == 0.0;
        let round = range == 180.0 || (360.0 - step..=360.0).contains(&range);
        whole && round && (FEWEST_DEGREES..=120.0).contains(&step)
    }
}

/// Returns the name or number that an expression converts to radians.
fn within_radians(here: &Here, id: ExpressionId) -> Option<Span> {
    let ExpressionKind::Call(Callee::Word(Word::Radians, _), list) = here.unit.expression(id).kind
    else {
        return None;
    };
    let [Argument::Expression(inner)] = here.unit.ast.arguments(list) else { return None };
    let inner = here.unit.expression(*inner);
    matches!(inner.kind, ExpressionKind::Number(_) | ExpressionKind::Name(_)).then_some(inner.span)
}

/// Returns a literal number with its sign.
fn number(here: &Here, id: ExpressionId) -> Option<f64> {
    match here.unit.expression(id).kind {
        ExpressionKind::Number(number) => Some(number),
        ExpressionKind::Unary(UnaryOperator::Minus, inner) => {
            match here.unit.expression(inner).kind {
                ExpressionKind::Number(number) => Some(-number),
                _ => None,
            }
        }
        _ => None,
    }
}
