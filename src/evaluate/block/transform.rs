//! Transforms: `translate`, `rotate`, `scale`, `matrix` and `transform`.

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::math::transform::Step;
use crate::scene::TransformId;
use crate::source::Span;
use crate::syntax::ast::{Argument, BinaryOperator, Callee, ExpressionId, ExpressionKind};
use crate::vocabulary::{Dialect, Word};

use super::super::arity::surplus;
use super::super::scope::Scopes;
use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Here, Outcome, Reported};
use super::Given;
use super::Place;

impl Evaluator<'_> {
    /// Reads the transform that starts with `token`; returns `None` if the word starts none.
    pub(super) fn transform_from(&mut self, token: &Token) -> Option<Outcome<TransformId>> {
        let step = self.step_from(token)?;
        Some(step.map(|step| self.add_transform(vec![step], token)))
    }

    fn step_from(&mut self, token: &Token) -> Option<Outcome<Step>> {
        let TokenKind::Word(word) = token.kind else { return None };
        match word {
            Word::Translate | Word::Rotate | Word::Scale | Word::Matrix => {
                Some(self.step(token, word))
            }
            Word::TransformWord => Some(self.transform_block(token).map(Step::Transform)),
            _ => None,
        }
    }

    fn add_transform(&mut self, steps: Vec<Step>, token: &Token) -> TransformId {
        if let [Step::Transform(whole)] = steps[..] {
            return whole;
        }
        self.scene.transform_sites.push(self.whole(token));
        // Lowering stores a map for each.
        self.stored += 256 + size_of_val(&steps[..]) as u64;
        self.scene.transforms.push(steps);
        TransformId(self.scene.transforms.len() as u32 - 1)
    }

    fn step(&mut self, token: &Token, word: Word) -> Outcome<Step> {
        match word {
            Word::Translate => {
                let given = self.vector_after(token, "a vector")?;
                self.no_number_after(word, &given)?;
                self.lint_axis_and_number(token, &given);
                Ok(Step::Translate(given.value))
            }
            Word::Rotate => {
                let given = self.vector_after(token, "a vector of degrees")?;
                self.no_number_after(word, &given)?;
                self.lint_axis_and_number(token, &given);
                self.lint_rotation(&given);
                Ok(Step::Rotate(given.value))
            }
            Word::Matrix => self.matrix(token),
            _ => {
                let given = self.vector_after(token, "a vector of factors")?;
                self.no_number_after(word, &given)?;
                let factors = given.value;
                if factors.to_array().contains(&0.0) {
                    let uniform = factors == Vector::ZERO;
                    let [x, y, z] = factors.to_array().map(|f| if f == 0.0 { 1.0 } else { f });
                    let mut diagnostic = Diagnostic::new(
                        Code::ZeroScale,
                        "a scale of zero flattens everything to nothing",
                    )
                    .at(given.span, "expected factors other than zero");
                    if let Some((whole, number)) = self.comma_after(given.span) {
                        let message = format!("`{}` is no number", self.sources.text(whole));
                        diagnostic = Diagnostic::new(Code::MalformedNumber, message)
                            .at(whole, "a comma parts two numbers")
                            .help(format!("a fraction is written with a point: `{number}`"))
                            .fix(whole, number);
                        let reported = self.report(&given.here, diagnostic);
                        self.skip_values();
                        return Err(reported);
                    }
                    if !uniform {
                        diagnostic = diagnostic.help(format!(
                            "a direction that is to stay as it is takes the factor 1: `<{x}, {y}, {z}>`"
                        ));
                    }
                    if self.options.dialect == Dialect::Pov {
                        diagnostic = diagnostic.help("as in POV-Ray, a factor of 0 is read as 1");
                    }
                    let diagnostic = self.in_this_turn(diagnostic);
                    self.opinion(&given.here, diagnostic)?;
                    return Ok(Step::Scale(Vector::new(x, y, z)));
                }
                Ok(Step::Scale(factors))
            }
        }
    }

    /// Reports transforms written as in other tools: `rotate y 45`, `rotate 45, y`, `translate x 2 y 3`,
    /// `scale y 2`.
    fn no_number_after(&mut self, word: Word, given: &Given<Vector>) -> Outcome<()> {
        // `sphere { translate x 0, 1 }`: the late parts were reported.
        if self.lacks_part() {
            return Ok(());
        }
        let kind = |here: &Here, id| here.unit.expression(id).kind;
        let first = given.expression.map(|id| kind(&given.here, id));
        let is_number = matches!(first, Some(ExpressionKind::Number(_)));
        // Of factors, each number may be all three, and an axis alone is none.
        if is_number && word == Word::Rotate {
            self.skip_commas();
        }
        let Some(Token { kind: TokenKind::Expression(id), span, here }) = self.peek().cloned()
        else {
            return Ok(());
        };
        let axis = first.and_then(axis_of);
        let text = |evaluator: &Self, span: Span| evaluator.sources.text(span).to_owned();
        let (mut pairs, label) = match (kind(&here, id), axis) {
            (ExpressionKind::Number(_), Some(axis)) => {
                (vec![(axis, text(self, span))], "expected no number after the vector")
            }
            (ExpressionKind::Number(_), None) if !is_number && word == Word::Rotate => {
                (Vec::new(), "expected no number after the vector")
            }
            (second, None) if is_number => match axis_of(second) {
                Some(axis) => {
                    (vec![(axis, text(self, given.span))], "expected no vector after the number")
                }
                None => return Ok(()),
            },
            _ => return Ok(()),
        };
        self.next();
        let mut end = span;
        // Another axis, and its number.
        while !pairs.is_empty()
            && let Some((axis, number, last)) = self.axis_and_number()
        {
            pairs.push((axis, number));
            end = last;
        }
        let name = word.name();
        let one = |(axis, number): &(usize, String)| format!("{number}*{}", ["x", "y", "z"][*axis]);
        let in_order = pairs.is_sorted_by(|(a, _), (b, _)| a < b);
        let right = match pairs.as_slice() {
            [] => format!("{}*{}", text(self, span), text(self, given.span)),
            [pair] if word != Word::Scale => one(pair),
            // Rotations are applied about x first, and then y.
            pairs if in_order => {
                let mut all = [if word == Word::Scale { "1" } else { "0" }; 3];
                for (axis, number) in pairs {
                    all[*axis] = number;
                }
                format!("<{}>", all.join(", "))
            }
            pairs => {
                let steps: Vec<String> = pairs.iter().map(one).collect();
                steps.join(&format!(" {name} "))
            }
        };
        let takes = match word {
            Word::Rotate => "degrees about x, y and z",
            Word::Scale => "factors along x, y and z",
            _ => "how far along x, y and z",
        };
        let diagnostic =
            Diagnostic::new(Code::ExtraPart, format!("`{name}` takes one vector: {takes}"))
                .at(span, label);
        let diagnostic = match word == Word::Scale && !in_order {
            true => diagnostic,
            false => {
                diagnostic.help(format!("write `{name} {right}`")).fix(given.span.to(end), right)
            }
        };
        Err(self.report(&here, diagnostic))
    }

    /// Returns an axis and a number that come next, and where they end: `y 45`, `z -2`.
    fn axis_and_number(&mut self) -> Option<(usize, String, Span)> {
        let Token { kind: TokenKind::Expression(id), here, span } = self.peek()?.clone() else {
            return None;
        };
        let kind = |here: &Here, id| here.unit.expression(id).kind;
        let is_number = |here: &Here, id| matches!(kind(here, id), ExpressionKind::Number(_));
        // `z -2` parses as a difference.
        if let ExpressionKind::Binary(BinaryOperator::Subtract, axis, number) = kind(&here, id) {
            let axis = axis_of(kind(&here, axis)).filter(|_| is_number(&here, number))?;
            let number = self.sources.text(here.unit.expression(number).span);
            let number = format!("-{number}");
            self.next();
            return Some((axis, number, span));
        }
        let axis = axis_of(kind(&here, id))?;
        self.next();
        let Token { kind: TokenKind::Expression(id), here, span } = self.peek()?.clone() else {
            return None;
        };
        if !is_number(&here, id) {
            return None;
        }
        self.next();
        Some((axis, self.sources.text(span).to_owned(), span))
    }

    /// Reads `matrix <…12 numbers…>`, which has more numbers than a vector can hold.
    fn matrix(&mut self, token: &Token) -> Outcome<Step> {
        let next = match self.next() {
            Some(next) => next,
            None => {
                return Err(self.expected(
                    "twelve numbers in angle brackets",
                    None,
                    (&token.here, token.span),
                ));
            }
        };
        let unit = next.here.unit.clone();
        let numbers = match next.kind {
            TokenKind::Expression(id) => match unit.expression(id).kind {
                ExpressionKind::Vector(components) => Some(Ok(components)),
                ExpressionKind::Triple(triple) => Some(Err(unit.ast.triple(triple).to_vec())),
                _ => None,
            },
            _ => None,
        };
        let Some(numbers) = numbers else {
            if let Some(reported) = self.bare_matrix(&next) {
                return Err(reported);
            }
            return Err(self.expected(
                "twelve numbers in angle brackets",
                Some(&next),
                (&token.here, token.span),
            ));
        };
        if let Some(reported) = self.matrix_of_rows(&next) {
            return Err(reported);
        }
        let components = numbers.as_ref().ok().copied();
        let numbers = match numbers {
            Ok(components) => self.numbers_of(&next.here, components, next.span)?,
            Err(numbers) => numbers,
        };
        let Ok(numbers) = <[f64; 12]>::try_from(numbers.as_slice()) else {
            let lost = self.commas_lost(next.span);
            let place = match lost.first() {
                Some((at, _)) => *at,
                None if numbers.len() < 12 => self.end_of_call(next.span),
                // The first surplus number.
                None => {
                    let more = components.and_then(|all| unit.ast.arguments(all).get(12..));
                    more.and_then(|more| surplus(&next.here, more)).unwrap_or(next.span)
                }
            };
            let diagnostic = Diagnostic::new(
                Code::WrongArity,
                format!("a matrix has 12 numbers, this one has {}", numbers.len()),
            )
            .at(place, "expected four rows of three numbers");
            let diagnostic = match (lost.len(), self.without_column(next.span)) {
                (_, Some(right)) => diagnostic
                    .help("the fourth column is always 0, 0, 0, 1, and is left out")
                    .fix(next.span, right),
                (0, None) => diagnostic.help("the last row is the translation: `matrix <1,0,0, 0,1,0, 0,0,1, 0,0,0>` changes nothing"),
                // With several differences, only the author knows which are meant.
                (n, None) if n + numbers.len() != 12 => diagnostic.help("`0 -2` is one number, and `0, -2` are two"),
                _ => lost.iter().fold(diagnostic, |told, (at, pair)| {
                    told.help(format!("`{pair}` is one number: a comma is missing in it")).fix(*at, ",")
                }),
            };
            return Err(self.report(&next.here, diagnostic));
        };
        let row = |i: usize| Vector::new(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
        let rows = [row(0), row(1), row(2), row(3)];
        match self.options.dialect {
            // Whether it is singular is decided exactly in lowering.
            Dialect::Scene => Ok(Step::Matrix(rows)),
            Dialect::Pov => self.with_columns(&next, rows),
        }
    }

    /// Reads `transform { … }` or `transform Name`.
    pub(super) fn transform_block(&mut self, token: &Token) -> Outcome<TransformId> {
        if let Some(Token { kind: TokenKind::Expression(_), .. }) = self.peek() {
            let given = self.given(token, "a transform")?;
            let Value::Transform(id) = given.value else {
                let help = "`rotate` turns, `translate` moves, `scale` stretches".to_owned();
                let help = matches!(given.value, Value::Vector(_)).then_some(help);
                let (here, wanted) = (&given.here, "a transform");
                return Err(self.wrong_type_with(here, given.span, wanted, &given.value, help));
            };
            return Ok(id);
        }
        // In POV-Ray 3.7 it inverts the whole block, at any position and if repeated (measured).
        let inverts_all = self.options.dialect == Dialect::Pov;
        let steps = self.block(token, Word::TransformWord, |evaluator| {
            let (mut steps, mut inverse) = (Vec::new(), None);
            let mut failed = false;
            while let Some(token) = evaluator.next() {
                match evaluator.step_from(&token) {
                    Some(Ok(step)) => steps.push(step),
                    Some(Err(Reported)) => failed = true,
                    None => match token.kind {
                        TokenKind::Word(Word::Inverse) if inverts_all => inverse = Some(token),
                        TokenKind::Word(Word::Inverse) => {
                            let all = evaluator.add_transform(std::mem::take(&mut steps), &token);
                            steps.push(Step::InverseOf(all));
                        }
                        TokenKind::Expression(id) => match evaluator.declared(&token, id) {
                            Some(Value::Transform(id)) => steps.push(Step::Transform(id)),
                            Some(Value::Broken) => failed = true,
                            _ => {
                                evaluator.unexpected(&token, Place::TRANSFORM);
                                failed = true;
                            }
                        },
                        _ => evaluator.unexpected(&token, Place::TRANSFORM),
                    },
                }
            }
            if let Some(token) = inverse {
                let all = evaluator.add_transform(std::mem::take(&mut steps), &token);
                steps.push(Step::InverseOf(all));
            }
            if failed { Err(Reported) } else { Ok(steps) }
        })?;
        Ok(self.add_transform(steps, token))
    }

    /// Handles a name that is a keyword in the block that `block` opened, if only running it shows that it is
    /// in that block: in a macro's body, or in an include. An apparent call such as `ks (1 - A)*2` is the
    /// keyword followed by its value.
    pub(super) fn contextual_word(&mut self, token: &Token, block: Word) -> Option<Word> {
        let TokenKind::Expression(id) = token.kind else { return None };
        let unit = token.here.unit.clone();
        let mut leftmost = id;
        while let ExpressionKind::Binary(_, left, _) = unit.expression(leftmost).kind {
            leftmost = left;
        }
        let (name, value) = match unit.expression(leftmost).kind {
            ExpressionKind::Name(name) if leftmost == id => (name, None),
            ExpressionKind::Call(Callee::Name(name, span), arguments) => {
                match *unit.ast.arguments(arguments) {
                    [Argument::Expression(value)] => (name, Some((span, value))),
                    _ => return None,
                }
            }
            _ => return None,
        };
        if self.options.dialect != Dialect::Scene
            || self.scopes.slot(token.here.symbol(name)).is_some()
        {
            return None;
        }
        let word = Word::contextual(unit.ast.name(name), block)?;
        if let Some((name, value)) = value {
            let value = self.sum_from(&token.here, id, value).unwrap_or(Value::Broken);
            let span = Span { start: name.end, ..token.span };
            let here = token.here.clone();
            self.peeked = Some(Token { kind: TokenKind::Literal(Box::new(value)), span, here });
        }
        Some(word)
    }

    /// Returns the value of a taken token that is a lone declared name or an array element; errors in the
    /// latter are reported.
    pub(super) fn declared(&mut self, token: &Token, id: ExpressionId) -> Option<Value> {
        match token.here.unit.expression(id).kind {
            ExpressionKind::Index(..) => {
                Some(self.expression(&token.here, id).unwrap_or(Value::Broken))
            }
            _ => self.named(&token.here, id),
        }
    }

    /// Returns the value that comes next, if it is declared, before it is known whether it is wanted.
    pub(super) fn peek_declared(&mut self) -> Option<&Value> {
        self.settle_element();
        let token = self.peeked.as_ref()?;
        match &token.kind {
            TokenKind::Literal(value) => Some(value),
            TokenKind::Expression(id) => named(&mut self.scopes, &token.here, *id),
            _ => None,
        }
    }

    /// Replaces an array element's expression by its value, so that it is evaluated once.
    fn settle_element(&mut self) {
        let Some(Token { kind: TokenKind::Expression(id), here, .. }) = self.peek() else { return };
        let id = *id;
        if matches!(here.unit.expression(id).kind, ExpressionKind::Index(..))
            && let Some(Token { here, span, .. }) = self.next()
        {
            let value = self.expression(&here, id).unwrap_or(Value::Broken);
            self.peeked = Some(Token { kind: TokenKind::Literal(Box::new(value)), span, here });
        }
    }

    /// Returns the value of an expression that is a lone declared name; reports nothing.
    pub(super) fn named(&mut self, here: &Here, id: ExpressionId) -> Option<Value> {
        named(&mut self.scopes, here, id).cloned()
    }
}

fn named<'s>(scopes: &'s mut Scopes, here: &Here, id: ExpressionId) -> Option<&'s Value> {
    match here.unit.expression(id).kind {
        ExpressionKind::Name(name) => {
            scopes.read(here.symbol(name)).filter(|value| !matches!(value, Value::Macro(_)))
        }
        _ => None,
    }
}

/// Returns the index of an axis keyword.
fn axis_of(kind: ExpressionKind) -> Option<usize> {
    match kind {
        ExpressionKind::Word(Word::X) => Some(0),
        ExpressionKind::Word(Word::Y) => Some(1),
        ExpressionKind::Word(Word::Z) => Some(2),
        _ => None,
    }
}
