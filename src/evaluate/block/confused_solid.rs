//! Diagnostics for a solid's parts in the order or number of another solid: `torus { 0, 1, 0.2 }`.
//!
//! **In:** a solid with an invalid part. **Out:** the intended parts, if the text of all parts shows them.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{ExpressionId, ExpressionKind, ItemKind};
use crate::vocabulary::Word;

use super::super::stream::{FrameKind, Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Here, Reported};
use super::Given;

/// Maximum expression depth that is examined.
const DEEPEST: u32 = 20;

/// A part as it is written: a point or direction, or a number.
struct Part {
    span: Span,
    is_point: bool,
}

impl Evaluator<'_> {
    /// Handles a non-number where `after` needs a number. If the other parts explain the mistake, they are
    /// skipped.
    pub(super) fn no_number(
        &mut self,
        after: &Token,
        given: &Given<Value>,
        wanted: &str,
    ) -> Reported {
        let told = match (&after.kind, &given.value) {
            (&TokenKind::Word(solid), Value::Vector(_)) => self.mistaken_parts(solid, given.span),
            _ => None,
        };
        let Some(told) = told else {
            return self.wrong_type(&given.here, given.span, wanted, &given.value);
        };
        let reported = self.report(&given.here, told);
        self.skip_values();
        // No other part is missing.
        let end = self.peek().map_or(after.span, |next| next.span);
        self.missing_at = Some(after.here.site(end));
        reported
    }

    /// Returns the diagnostic for the part at `refused` of the solid being read.
    pub(super) fn mistaken_parts(&self, solid: Word, refused: Span) -> Option<Diagnostic> {
        let opener = *self.openers.last()?;
        let parts = self.plain_parts()?;
        let holds = |part: &Part| part.span.start <= refused.start && refused.end <= part.span.end;
        if self.sources.text(opener) != solid.name() || !parts.iter().any(holds) {
            return None;
        }
        // `cylinder { 0, y, 1 }`: a number denotes a point.
        let begins = matches!(solid, Word::Cone | Word::Cylinder | Word::Disc);
        let letter = |(i, part): (usize, &Part)| {
            if part.is_point || begins && i == 0 { 'p' } else { 'n' }
        };
        let kinds: String = parts.iter().enumerate().map(letter).collect();
        let at = |i: usize| parts[i].span;
        let text = |i: usize| self.sources.text(at(i));
        let is_zero = |i: usize| text(i).chars().all(|c| "<0.,> ".contains(c));
        // Those from the first of `order` on, in another order.
        let ordered = |told: Diagnostic, first: usize, order: &[usize]| {
            let right = order.iter().map(|&i| text(i)).collect::<Vec<_>>().join(", ");
            let last = first + order.len() - 1;
            told.help(format!("write `{right}`")).fix(at(first).to(at(last)), right)
        };
        let told = |code, message: &str| Diagnostic::new(code, message);
        let cone = "a cone is written `base, radius, cap, radius`";
        let cylinder = "a cylinder is written `base, cap, radius`";
        Some(match (solid, kinds.as_str()) {
            (Word::Cone, "ppnn") => {
                let told = told(Code::WrongType, cone).at(at(1), "expected the radius at the base");
                ordered(told, 1, &[2, 1, 3])
            }
            (Word::Cone, "ppn") => told(Code::WrongType, cone)
                .at(at(1), "expected the radius at the base")
                .help(format!(
                    "it ends in a point with `{}, {}, {}, 0`; of one radius is a `cylinder`",
                    text(0),
                    text(2),
                    text(1)
                )),
            (Word::Cylinder, "ppnn") | (Word::Cylinder, "pnpn") => {
                let (cap, first, second) = if kinds == "ppnn" { (1, 2, 3) } else { (2, 1, 3) };
                if text(first) == text(second) && cap == 2 {
                    let told = told(Code::WrongType, cylinder).at(at(1), "expected the cap");
                    let right = format!("{}, {}", text(2), text(3));
                    told.help(format!("write `{right}`")).fix(at(1).to(at(3)), right)
                } else {
                    let right = format!("{}, {}, {}", text(first), text(cap), text(second));
                    told(Code::ExtraPart, "with two radii it is a cone")
                        .at(refused, "a cylinder is written `base, cap, radius`")
                        .also(opener, "did you mean `cone`?")
                        .help(format!("write `cone {{ {}, {right}`", text(0)))
                        .fix(opener, Word::Cone.name())
                        .fix(at(1).to(at(3)), right)
                }
            }
            (Word::Cylinder, "pnp") => {
                let told = told(Code::WrongType, cylinder).at(at(1), "expected the cap");
                ordered(told, 1, &[2, 1])
            }
            (Word::Disc, "pnp" | "pnpn") => {
                let message = "a disc is written `centre, normal, radius`: two are swapped";
                ordered(told(Code::WrongType, message).at(at(1), "expected the normal"), 1, &[2, 1])
            }
            (Word::Torus, "pnn") | (Word::Torus, "nnn") if kinds == "pnn" || is_zero(0) => {
                let place = text(0);
                let told =
                    told(Code::ExtraPart, "a torus lies around the origin: it has no centre")
                        .at(at(0), "expected the two radii alone")
                        .fix(Span { end: at(1).start, ..at(0) }, "");
                match is_zero(0) {
                    true => told.help("leave it out"),
                    false => told
                        .help(format!(
                            "leave it out, and write `translate {place}` behind the radii"
                        ))
                        .fix(at(2).after(), format!(" translate {place}")),
                }
            }
            (Word::Plane, "pp") => {
                let told = told(Code::WrongType, "a plane is written `normal, distance`")
                    .at(at(1), "expected a number: how far from the origin it lies");
                let normal = match (is_zero(0), is_zero(1)) {
                    (true, false) => text(1),
                    (false, true) => text(0),
                    _ => return Some(told),
                };
                let right = format!("{normal}, 0");
                told.help(format!("write `{right}`")).fix(at(0).to(at(1)), right)
            }
            (Word::Box, "ppn") => told(Code::ExtraPart, "a box has two corners, and sharp edges")
                .at(at(2), "one part too many")
                .help(format!(
                    "`Round_Box({}, {}, {}, 0)` of `shapes.inc` is a rounded one",
                    text(0),
                    text(1),
                    text(2)
                )),
            _ => return None,
        })
    }

    /// Handles a missing number that is the vector's fourth component: `sphere { <1, 2, 3, 0.5> }`.
    pub(super) fn number_within(&mut self, given: &Given<Value>, wanted: &str) -> Option<Reported> {
        let Value::Vector(components) = &given.value else { return None };
        let text = self.sources.text(given.span).to_owned();
        let goes_on = self.goes_on();
        let (point, number) = text.strip_suffix('>')?.rsplit_once(',')?;
        if components.len() != 4 || goes_on || self.commas_within(given.span).is_some() {
            return None;
        }
        let right = format!("{}>, {}", point.trim_end(), number.trim());
        let message = "the vector has three numbers, and a fourth stands behind it";
        let told = Diagnostic::new(Code::WrongArity, message)
            .at(given.span, format!("expected {wanted} behind this"))
            .help(format!("write `{right}`"))
            .fix(given.span, right);
        Some(self.report(&given.here, told))
    }

    /// Returns whether the block being read has exactly this many points, and nothing else, before its first
    /// keyword.
    pub(super) fn has_plain_points(&self, count: usize) -> bool {
        let parts = self.plain_parts().unwrap_or_default();
        parts.len() == count && parts.iter().all(|part| part.is_point)
    }

    /// Returns the parts of the block being read, up to its first keyword, if they are literal values. Their
    /// kinds are inferred from the text.
    fn plain_parts(&self) -> Option<Vec<Part>> {
        let block = self.within_block()?.span;
        let frame = self.frames.last()?;
        let unit = &frame.here.unit;
        if !matches!(frame.kind, FrameKind::Block) || unit.ast.file != block.file {
            return None;
        }
        // The items of the block are contiguous, preceded by the contents of nested blocks.
        let items = &unit.ast.items;
        let mut first = frame.at as usize;
        while let Some(before) = first.checked_sub(1).and_then(|at| items.get(at))
            && before.span.start >= block.start
            && items.get(first).is_none_or(|next| {
                first == frame.end as usize || before.span.end <= next.span.start
            })
        {
            first -= 1;
        }
        let mut parts = Vec::new();
        for item in items.get(first..frame.end as usize)? {
            match item.kind {
                ItemKind::Comma => {}
                ItemKind::Expression(id) => {
                    let is_point = self.is_point(&frame.here, id, DEEPEST)?;
                    parts.push(Part { span: item.span, is_point });
                }
                ItemKind::Word(_) => break,
                _ => return None,
            }
        }
        (!parts.is_empty()).then_some(parts)
    }

    /// Returns whether an expression is a point or direction rather than a number; `None` if neither is
    /// evident.
    fn is_point(&self, here: &Here, id: ExpressionId, depth: u32) -> Option<bool> {
        let depth = depth.checked_sub(1)?;
        match here.unit.expression(id).kind {
            ExpressionKind::Number(_) | ExpressionKind::Component(..) => Some(false),
            ExpressionKind::Vector(_)
            | ExpressionKind::Triple(_)
            | ExpressionKind::Word(Word::X | Word::Y | Word::Z) => Some(true),
            // In a macro the order of its arguments may be the mistake.
            ExpressionKind::Name(_) if self.macro_depth > 0 => None,
            ExpressionKind::Name(name) => match self.scopes.look(here.symbol(name))? {
                Value::Number(_) => Some(false),
                Value::Vector(_) => Some(true),
                _ => None,
            },
            ExpressionKind::Unary(_, inner) | ExpressionKind::Group(inner) => {
                self.is_point(here, inner, depth)
            }
            ExpressionKind::Binary(_, left, right) => {
                Some(self.is_point(here, left, depth)? || self.is_point(here, right, depth)?)
            }
            _ => None,
        }
    }
}
