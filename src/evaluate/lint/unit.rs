//! Inference of whether an expression is an angle in radians, from its form.
//!
//! **In:** an expression, and the declarations of the names in it. **Out:** the power of the unit radian: 1
//! for `pi/4` and `atan2(1, 1)`, 0 for `45` and `sin(pi)`, negative for the conversion factor `180/pi`.
//! **Invariant:** examines a bounded number of nodes; anything uncertain has power 0.

use crate::evaluate::{Evaluator, Here, Unit};
use crate::syntax::ast::{
    Argument, BinaryOperator, Callee, DirectiveId, DirectiveKind, Expression, ExpressionId,
    ExpressionKind, ItemKind, NameId, UnaryOperator,
};
use crate::vocabulary::Word;

/// Maximum number of nodes examined in an expression and in the declarations of its names.
const MOST_NODES: u32 = 200;
/// Maximum depth examined: an expression may be nested deeper than the stack allows.
const DEEPEST: u32 = 40;
/// Relative tolerance for a literal π: 3.14 qualifies.
const TYPED_PI: f64 = 0.001;

impl Evaluator<'_> {
    pub(super) fn is_in_radians(&mut self, here: &Here, id: ExpressionId) -> bool {
        let span = here.unit.expression(id).span;
        if let Some(&known) = self.in_radians.get(&span) {
            return known;
        }
        let mut walk = Walk { unit: &here.unit, nodes: MOST_NODES, within: Vec::new() };
        let known = walk.power(id, DEEPEST) == Some(1);
        self.in_radians.insert(span, known);
        known
    }
}

struct Walk<'a> {
    unit: &'a Unit,
    /// Number of nodes that may still be examined.
    nodes: u32,
    /// Names whose declarations are being examined.
    within: Vec<NameId>,
}

impl Walk<'_> {
    /// Returns the power; `None` if the limits were exceeded.
    fn power(&mut self, id: ExpressionId, depth: u32) -> Option<i32> {
        self.nodes = self.nodes.checked_sub(1)?;
        let depth = depth.checked_sub(1)?;
        let power = match self.unit.expression(id).kind {
            ExpressionKind::Number(number) => power_of_number(number),
            ExpressionKind::Word(Word::Pi) => 1,
            ExpressionKind::Name(name) => match self.counter(name, id) {
                Some((to, step)) => self.power(to, depth)?.max(self.power(step, depth)?),
                None => self.power_of_name(name, depth)?,
            },
            ExpressionKind::Unary(UnaryOperator::Plus | UnaryOperator::Minus, inner)
            | ExpressionKind::Group(inner)
            | ExpressionKind::Component(inner, _) => self.power(inner, depth)?,
            ExpressionKind::Binary(operator, left, right) => {
                let (a, b) = (self.power(left, depth)?, self.power(right, depth)?);
                match operator {
                    BinaryOperator::Add | BinaryOperator::Subtract => a.max(b),
                    BinaryOperator::Multiply => a + b + self.turn(left) + self.turn(right),
                    BinaryOperator::Divide => a - b + self.turn(left),
                    BinaryOperator::Less
                    | BinaryOperator::LessOrEqual
                    | BinaryOperator::Equal
                    | BinaryOperator::NotEqual
                    | BinaryOperator::GreaterOrEqual
                    | BinaryOperator::Greater
                    | BinaryOperator::And
                    | BinaryOperator::Or => 0,
                }
            }
            ExpressionKind::Conditional(_, then, otherwise) => {
                self.power(then, depth)?.max(self.power(otherwise, depth)?)
            }
            ExpressionKind::Vector(list) => {
                let unit = self.unit;
                self.largest(unit.ast.arguments(list), depth)?
            }
            ExpressionKind::Triple(triple) => {
                let numbers = self.unit.ast.triple(triple);
                // A sign is a node.
                let levels = numbers.map(|number| 1 + u32::from(number.is_sign_negative()));
                self.nodes = self.nodes.checked_sub(levels.into_iter().sum())?;
                levels.into_iter().try_for_each(|level| depth.checked_sub(level).map(|_| ()))?;
                numbers.into_iter().map(|number| power_of_number(number.abs())).fold(0, i32::max)
            }
            ExpressionKind::Call(Callee::Word(word, _), list) => {
                let unit = self.unit;
                match word {
                    Word::Atan | Word::Atan2 | Word::Asin | Word::Acos | Word::Radians => 1,
                    Word::Abs | Word::Min | Word::Max | Word::Mod => {
                        self.largest(unit.ast.arguments(list), depth)?
                    }
                    _ => 0,
                }
            }
            ExpressionKind::Call(Callee::Name(..) | Callee::Element(_), _)
            | ExpressionKind::Unary(UnaryOperator::Not, _)
            | ExpressionKind::String
            | ExpressionKind::Word(_)
            | ExpressionKind::Index(..)
            | ExpressionKind::GroupItems(_)
            | ExpressionKind::Joint
            | ExpressionKind::Missing => 0,
        };
        Some(power)
    }

    fn largest(&mut self, list: &[Argument], depth: u32) -> Option<i32> {
        list.iter().try_fold(0, |most, argument| match *argument {
            Argument::Expression(id) => Some(self.power(id, depth)?.max(most)),
            Argument::Items(_) => Some(most),
        })
    }

    /// A factor of 180 or 360 converts π or turns to degrees.
    fn turn(&self, id: ExpressionId) -> i32 {
        let Expression { kind, .. } = self.unit.expression(id);
        -i32::from(matches!(kind, ExpressionKind::Number(180.0 | 360.0)))
    }

    /// If a name is the counter of the innermost enclosing loop, returns its end value and step.
    fn counter(&self, name: NameId, at: ExpressionId) -> Option<(ExpressionId, ExpressionId)> {
        let ast = &self.unit.ast;
        let span = self.unit.expression(at).span;
        let around = ast.directives.iter().filter_map(|directive| match directive.kind {
            DirectiveKind::For { name: other, to, step, body, .. } if other == name => {
                let items = ast.items(body);
                let (first, last) = (items.first()?, items.last()?);
                let is_around = first.span.start <= span.start && span.end <= last.span.end;
                is_around.then_some((first.span.start, (to, step.unwrap_or(to))))
            }
            _ => None,
        });
        around.max_by_key(|(start, _)| *start).map(|(_, counts)| counts)
    }

    /// Returns the power common to all declarations of a name, ignoring zeros; 0 if they differ.
    fn power_of_name(&mut self, name: NameId, depth: u32) -> Option<i32> {
        if self.within.contains(&name) {
            return Some(0);
        }
        let unit = self.unit;
        self.within.push(name);
        let mut common = None;
        for (index, directive) in unit.ast.directives.iter().enumerate() {
            let power = match &directive.kind {
                DirectiveKind::Declare { target, .. } if target.name == name => {
                    match declared(unit, index) {
                        Some(id) if is_zero(unit.expression(id)) => continue,
                        Some(id) => self.power(id, depth)?,
                        None => 0,
                    }
                }
                DirectiveKind::For { name: other, .. } if *other == name => 0,
                // Values that calls pass for it are not examined.
                DirectiveKind::Macro { parameters, .. }
                    if parameters.iter().any(|parameter| parameter.name == name) =>
                {
                    0
                }
                _ => continue,
            };
            if *common.get_or_insert(power) != power {
                common = Some(0);
                break;
            }
        }
        self.within.pop();
        Some(common.unwrap_or(0))
    }
}

/// Returns the power of a number: it is in radians if it is a literal for π or 2π, and a conversion factor if
/// it is a literal for 180/π or π/180.
fn power_of_number(number: f64) -> i32 {
    let is = |wanted: f64| (number / wanted - 1.0).abs() < TYPED_PI;
    let (pi, degree) = (std::f64::consts::PI, std::f64::consts::PI / 180.0);
    let fraction = number.fract() != 0.0;
    i32::from(is(pi) || is(2.0 * pi) || is(degree)) - i32::from(is(1.0 / degree) && fraction)
}

fn is_zero(expression: &Expression) -> bool {
    matches!(expression.kind, ExpressionKind::Number(0.0))
}

/// Returns the expression that follows a `#declare`.
fn declared(unit: &Unit, directive: usize) -> Option<ExpressionId> {
    let directive = DirectiveId(u32::try_from(directive).ok()?);
    let at = unit.ast.items.iter().position(|i| i.kind == ItemKind::Directive(directive))?;
    match unit.ast.items.get(at + 1)?.kind {
        ItemKind::Expression(id) => Some(id),
        _ => None,
    }
}
