//! Compilation of operators and built-in functions to operations of a tape.

use crate::function::{Binary, Builder, Node, TooLong, Unary};
use crate::math::elementary::RADIANS_PER_DEGREE;
use crate::syntax::ast::BinaryOperator;
use crate::vocabulary::Word;

/// Returns the operation `left operator right`. NaN compares greater than any number, as in POV-Ray 3.7
/// (measured), where `a > b` is "not a <= b".
pub(in crate::evaluate) fn operation_of(
    builder: &mut Builder,
    operator: BinaryOperator,
    left: Node,
    right: Node,
) -> Result<Node, TooLong> {
    let operation = match operator {
        BinaryOperator::Add => Binary::Add,
        BinaryOperator::Subtract => Binary::Subtract,
        BinaryOperator::Multiply => Binary::Multiply,
        BinaryOperator::Divide => Binary::Divide,
        BinaryOperator::Less => Binary::Less,
        BinaryOperator::LessOrEqual => Binary::LessOrEqual,
        BinaryOperator::Equal => Binary::Equal,
        BinaryOperator::NotEqual => Binary::NotEqual,
        BinaryOperator::And => Binary::And,
        BinaryOperator::Or => Binary::Or,
        BinaryOperator::GreaterOrEqual | BinaryOperator::Greater => {
            let opposite = match operator {
                BinaryOperator::Greater => Binary::LessOrEqual,
                _ => Binary::Less,
            };
            let is_opposite = builder.binary(opposite, left, right)?;
            return builder.unary(Unary::Not, is_opposite);
        }
    };
    builder.binary(operation, left, right)
}

fn unary_of(word: Word) -> Option<Unary> {
    Some(match word {
        Word::Abs => Unary::Abs,
        Word::Acos => Unary::Acos,
        Word::Acosh => Unary::Acosh,
        Word::Asin => Unary::Asin,
        Word::Asinh => Unary::Asinh,
        Word::Atan => Unary::Atan,
        Word::Atanh => Unary::Atanh,
        Word::Ceil => Unary::Ceil,
        Word::Cos => Unary::Cos,
        Word::Cosh => Unary::Cosh,
        Word::Exp => Unary::Exp,
        Word::Floor => Unary::Floor,
        Word::Int => Unary::Int,
        Word::Ln => Unary::Ln,
        Word::Log => Unary::Log,
        Word::Sin => Unary::Sin,
        Word::Sinh => Unary::Sinh,
        Word::Sqrt => Unary::Sqrt,
        Word::Tan => Unary::Tan,
        Word::Tanh => Unary::Tanh,
        _ => return None,
    })
}

fn binary_of(word: Word) -> Option<Binary> {
    Some(match word {
        Word::Atan2 => Binary::Atan2,
        Word::Mod => Binary::Mod,
        Word::Pow => Binary::Pow,
        Word::Min => Binary::Min,
        Word::Max => Binary::Max,
        _ => return None,
    })
}

/// Returns whether a function of the language is allowed in a formula.
pub(super) fn is_operation(word: Word) -> bool {
    unary_of(word).is_some()
        || binary_of(word).is_some()
        || matches!(word, Word::Div | Word::Degrees | Word::Radians | Word::Select)
}

/// Returns the operation that a word names; the number of operands has been checked.
pub(super) fn operation(
    builder: &mut Builder,
    word: Word,
    nodes: &[Node],
) -> Result<Node, TooLong> {
    match (word, nodes) {
        (Word::Degrees, [a]) => {
            let factor = builder.constant(RADIANS_PER_DEGREE)?;
            builder.binary(Binary::Divide, *a, factor)
        }
        (Word::Radians, [a]) => {
            let factor = builder.constant(RADIANS_PER_DEGREE)?;
            builder.binary(Binary::Multiply, *a, factor)
        }
        (Word::Div, [a, b]) => {
            let quotient = builder.binary(Binary::Divide, *a, *b)?;
            builder.unary(Unary::Int, quotient)
        }
        (Word::Select, [a, below, rest @ ..]) => {
            let zero = builder.constant(0.0)?;
            let is_below = builder.binary(Binary::Less, *a, zero)?;
            let rest = match rest {
                [equal, above] => {
                    let is_equal = builder.binary(Binary::Equal, *a, zero)?;
                    builder.choose(is_equal, *equal, *above)?
                }
                [other] => *other,
                _ => zero,
            };
            builder.choose(is_below, *below, rest)
        }
        _ => match (unary_of(word), binary_of(word), nodes) {
            (Some(operation), _, [a]) => builder.unary(operation, *a),
            (_, Some(operation), [first, rest @ ..]) => {
                rest.iter().try_fold(*first, |node, next| builder.binary(operation, node, *next))
            }
            _ => builder.constant(f64::NAN),
        },
    }
}
