//! Polynomial surfaces: their coefficients, in a list or one by one.

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::math::terms::{count_of_terms, exponents};
use crate::scene::Solid;
use crate::source::Span;
use crate::syntax::ast::{Arguments, Callee, ExpressionKind};
use crate::vocabulary::{Dialect, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::part::Given;

/// The orders that `poly` and `polynomial` accept.
const ORDERS: std::ops::RangeInclusive<f64> = 2.0..=15.0;

/// The highest order that POV-Ray 3.7 accepts.
const POV_ORDER: f64 = 35.0;

impl Evaluator<'_> {
    /// Reads `<A, B, C>, <D, E, F>, <G, H, I>, J`: Ax² + By² + Cz² + Dxy + Exz + Fyz + Gx + Hy + Iz + J.
    pub(super) fn quadric(&mut self, token: &Token) -> Outcome<Solid> {
        if let Some(reported) = self.bare_points(3, 1) {
            return Err(reported);
        }
        let squares = self.number_or_vector(token, "a vector for the squares: x², y², z²");
        let products = self.number_or_vector(token, "a vector for the products: xy, xz, yz");
        let singles = self.number_or_vector(token, "a vector for x, y and z");
        let rest = self.number_after(token, "a number for what is constant");
        let (squares, products, singles, rest) = (squares?, products?, singles?, rest?);
        let [s, p, l] = [squares.value, products.value, singles.value];
        let terms = vec![s.x, p.x, p.y, l.x, s.y, p.z, l.y, s.z, l.z, rest.value];
        self.polynomial_of(token, &rest, Word::Quadric, 2, terms)
    }

    /// Reads a vector, or one number for all three components: `0, 0, 0, -1` is three vectors and a number
    /// here, not a point without brackets.
    fn number_or_vector(&mut self, after: &Token, wanted: &str) -> Outcome<Given<Vector>> {
        let given = self.given(after, wanted)?;
        self.as_vector(given, wanted)
    }

    pub(super) fn cubic(&mut self, token: &Token) -> Outcome<Solid> {
        self.listed(token, Word::Cubic, 3)
    }

    pub(super) fn quartic(&mut self, token: &Token) -> Outcome<Solid> {
        self.listed(token, Word::Quartic, 4)
    }

    pub(super) fn poly(&mut self, token: &Token) -> Outcome<Solid> {
        let degree = self.order(token)?;
        self.listed(token, Word::Poly, degree)
    }

    /// Reads `order, xyz(i, j, k): number …`; the last of several numbers for one term counts.
    pub(super) fn polynomial(&mut self, token: &Token) -> Outcome<Solid> {
        let degree = self.order(token)?;
        let mut terms = vec![0.0; count_of_terms(degree)];
        let mut last = None;
        loop {
            self.skip_commas();
            let Some(Token { kind: TokenKind::Expression(id), here, .. }) = self.peek().cloned()
            else {
                break;
            };
            let ExpressionKind::Call(Callee::Word(Word::Xyz, _), powers) =
                here.unit.expression(id).kind
            else {
                break;
            };
            let Some(term) = self.next() else { break };
            let at = self.powers(&term, powers, degree);
            let number = self.number_after(&term, "a number for the coefficient");
            let (at, number) = (at?, number?);
            terms[at] = number.value;
            last = Some(number);
        }
        let Some(last) = last else {
            let message = "expected the coefficients after the order of `polynomial`";
            let diagnostic = Diagnostic::new(Code::MissingPart, message)
                .at(token.span, "coefficients are missing after this")
                .help("each is written as `xyz(2, 0, 1): 3`, which is 3·x²·z");
            return Err(self.report(&token.here, diagnostic));
        };
        self.polynomial_of(token, &last, Word::Polynomial, degree, terms)
    }

    fn order(&mut self, token: &Token) -> Outcome<usize> {
        if let Some(reported) = self.lacks_order() {
            return Err(reported);
        }
        let order = self.number_after(token, "a number for the order")?;
        let is_pov = self.options.dialect == Dialect::Pov;
        let value = if is_pov { order.value.trunc() } else { order.value };
        if is_pov && value > *ORDERS.end() && value <= POV_ORDER {
            let message = format!("polynomials of order {value} are not supported yet");
            let diagnostic = Diagnostic::new(Code::NotSupportedYet, message)
                .at(order.span, format!("expected {} or less", ORDERS.end()));
            return Err(self.report(&order.here, diagnostic));
        }
        if !ORDERS.contains(&value) || value.fract() != 0.0 {
            let message = match order.value.fract() == 0.0 {
                true => format!("the order is {}, and must be 2 to 15", order.value),
                false => format!("the order is {}, and must be a whole number", order.value),
            };
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(order.span, "expected 2 to 15")
                .help("the order is the greatest sum of powers in one term");
            let diagnostic = match order.value == 1.0 {
                true => diagnostic.help("of order 1 it is a `plane`"),
                false => diagnostic,
            };
            return Err(self.report(&order.here, diagnostic));
        }
        if value != order.value {
            self.lint_count(&order.here, order.span, order.value);
        }
        Ok(value as usize)
    }

    /// Reports coefficients without an order before them: `poly { <1, 0, …> }`.
    fn lacks_order(&mut self) -> Option<Reported> {
        let (list, numbers) = self.peeks_list()?;
        let degree = (2..=15).find(|&degree| count_of_terms(degree) == numbers);
        let message = "the order stands before the coefficients";
        let told = Diagnostic::new(Code::MissingPart, message)
            .at(list.span, "expected a number for the order before this");
        let told = match degree {
            Some(degree) => told
                .help(format!(
                    "{numbers} coefficients are of order {degree}: write `{degree}, <…>`"
                ))
                .fix(Span { end: list.span.start, ..list.span }, format!("{degree}, ")),
            None => told,
        };
        self.next();
        Some(self.report(&list.here, told))
    }

    /// Returns the next list of numbers in angle brackets without consuming it, and its length.
    fn peeks_list(&mut self) -> Option<(Token, usize)> {
        let next = self.peek()?.clone();
        let TokenKind::Expression(id) = next.kind else { return None };
        let count = match next.here.unit.expression(id).kind {
            ExpressionKind::Vector(numbers) => next.here.unit.ast.arguments(numbers).len(),
            ExpressionKind::Triple(_) => 3,
            _ => return None,
        };
        Some((next, count))
    }

    /// Reports an order that the keyword implies: `cubic { 3, <…> }`.
    fn needless_order(&mut self, form: Word, degree: usize) -> Option<Reported> {
        let first = self.peek()?.clone();
        let TokenKind::Expression(id) = first.kind else { return None };
        let ExpressionKind::Number(number) = first.here.unit.expression(id).kind else {
            return None;
        };
        if number != degree as f64 || form == Word::Poly {
            return None;
        }
        self.next();
        self.skip_commas();
        let (list, _) = self.peeks_list()?;
        let name = form.name();
        let told = Diagnostic::new(Code::ExtraPart, format!("a `{name}` is of order {degree}"))
            .at(first.span, "leave this out")
            .fix(Span { end: list.span.start, ..first.span }, "");
        let reported = self.report(&first.here, told);
        self.skip_values();
        Some(reported)
    }

    /// Returns the index of the term `xyz(i, j, k)`.
    fn powers(&mut self, term: &Token, powers: Arguments, degree: usize) -> Outcome<usize> {
        let mut given = self.numbers_of(&term.here, powers, term.span)?;
        if self.options.dialect == Dialect::Pov {
            // As in POV-Ray 3.7 (measured).
            given.iter_mut().for_each(|power| *power = power.trunc());
        }
        let wanted = exponents(degree)
            .position(|[i, j, k]| given.as_slice() == [i as f64, j as f64, k as f64]);
        wanted.ok_or_else(|| {
            let message = format!("this is no term of a polynomial of order {degree}");
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(term.span, format!("expected three whole powers whose sum is at most {degree}"))
                .help("`xyz(2, 0, 1)` is x²·z");
            self.report(&term.here, diagnostic)
        })
    }

    /// Reads a list in angle brackets, with one number for each term.
    fn listed(&mut self, token: &Token, form: Word, degree: usize) -> Outcome<Solid> {
        self.skip_commas();
        if let Some(reported) = self.needless_order(form, degree) {
            return Err(reported);
        }
        let list = match self.peek().cloned() {
            Some(Token { kind: TokenKind::Expression(id), span, here }) => {
                match here.unit.expression(id).kind {
                    ExpressionKind::Vector(numbers) => {
                        self.next();
                        let value = self.numbers_of(&here, numbers, span)?;
                        Some(Given { value, span, here, expression: Some(id) })
                    }
                    ExpressionKind::Triple(triple) => {
                        self.next();
                        let value = here.unit.ast.triple(triple).to_vec();
                        Some(Given { value, span, here, expression: Some(id) })
                    }
                    _ => None,
                }
            }
            _ => None,
        };
        let count = count_of_terms(degree);
        let given = match list {
            Some(list) => list,
            None => {
                let wanted = format!("a list of {count} coefficients in angle brackets");
                let given = self.given(token, &wanted)?;
                let goes_on = matches!(self.peek(), Some(Token { kind: TokenKind::Comma, .. }));
                let text = self.sources.text(given.span);
                let is_list = goes_on || text.contains(',');
                if matches!(given.value, Value::Number(_)) && is_list {
                    let name = form.name();
                    let message = format!("the coefficients of a `{name}` stand in angle brackets");
                    let right = format!("<{text}>");
                    let diagnostic = Diagnostic::new(Code::WrongType, message)
                        .at(given.span, "expected `<` before these, and `>` behind");
                    let diagnostic = match text.contains(',') {
                        true => diagnostic.fix(given.span, right),
                        false => diagnostic,
                    };
                    self.skip_values();
                    return Err(self.report(&given.here, diagnostic));
                }
                match given.value.numbers() {
                    Some(numbers) => given.with(numbers.as_slice().to_vec()),
                    None => {
                        return Err(self.wrong_type(
                            &given.here,
                            given.span,
                            &wanted,
                            &given.value,
                        ));
                    }
                }
            }
        };
        if given.value.len() != count {
            let found = given.value.len();
            let message = format!(
                "a polynomial of order {degree} has {count} coefficients, this one has {found}"
            );
            let label = if found < count { "too few numbers" } else { "too many numbers" };
            let diagnostic = Diagnostic::new(Code::WrongArity, message)
                .at(given.span, label)
                .help(format!(
                    "`polynomial {{ {degree}, xyz(2, 0, 1): 3 }}` names its terms, and leaves out the rest"
                ));
            return Err(self.report(&given.here, diagnostic));
        }
        let terms = given.value.clone();
        self.polynomial_of(token, &given, form, degree, terms)
    }

    fn polynomial_of<T>(
        &mut self,
        token: &Token,
        last: &Given<T>,
        form: Word,
        degree: usize,
        terms: Vec<f64>,
    ) -> Outcome<Solid> {
        let solid = Solid::Polynomial { form, degree, terms };
        if solid.is_sizeless() {
            let message = format!("a {} without x, y and z has no surface", form.name());
            let diagnostic = Diagnostic::new(self.sizeless(), message)
                .at(last.span, "every coefficient up to here but the last is 0");
            self.nothing(token, &last.here, diagnostic)?;
        }
        Ok(solid)
    }
}
