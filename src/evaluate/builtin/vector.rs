//! Functions of three-component vectors; a number fills all three components, two numbers get a zero.
//!
//! **Invariant:** quarter turns about the axes are exact; intermediate lengths and directions neither
//! overflow nor underflow.

use super::{Arguments, CallError, CallErrorKind, Function};
use crate::math::elementary::sin_cos_degrees;
use crate::math::{UnitVector, Vector};
use crate::noise::Turbulence;
use crate::vocabulary::Word;

/// Returns the function that `word` names, if it is in this family.
pub(super) fn function(word: Word) -> Option<Function> {
    match word {
        Word::Vdot => Function::number(2..=2, |a| Ok(a.vector3(0)?.dot(a.vector3(1)?))),
        Word::Vlength => Function::number(1..=1, |a| Ok(length(a.vector3(0)?))),
        Word::VaxisRotate => Function::vector(3..=3, |a| {
            Ok(axis_rotated(a.vector3(0)?, direction(a, 1)?, a.number(2)?))
        }),
        Word::Vcross => Function::vector(2..=2, |a| Ok(a.vector3(0)?.cross(a.vector3(1)?))),
        Word::Vnormalize => Function::vector(1..=1, |a| Ok(direction(a, 0)?.get())),
        Word::Vrotate => Function::vector(2..=2, |a| Ok(rotated(a.vector3(0)?, a.vector3(1)?))),
        Word::Vturbulence => Function::vector(4..=4, |a| {
            let turbulence = Turbulence::new(a.number(0)?, a.number(1)?, a.number(2)?);
            Ok(turbulence.vector(a.vector3(3)?))
        }),
        _ => None,
    }
}

/// Returns the direction of an argument. For the zero vector, POV-Ray returns it with a warning, or `nan` for
/// an axis.
fn direction(a: &Arguments, i: usize) -> Result<UnitVector, CallError> {
    let v = a.vector3(i)?;
    UnitVector::from_direction(v).ok_or_else(|| {
        let message = "takes a vector with a direction, not the zero vector".to_owned();
        a.error(CallErrorKind::ZeroVector, Some(i), message)
    })
}

/// Returns the Euclidean length, even where the squares would overflow or underflow.
fn length(v: Vector) -> f64 {
    let squared = v.length_squared();
    if (1e-280..1e300).contains(&squared) {
        return squared.sqrt();
    }
    if !v.is_finite() {
        return squared.sqrt();
    }
    UnitVector::from_direction(v).map_or(0.0, |direction| v.dot(direction.get()))
}

/// Rotates about x, then y, then z, in degrees, by the right-hand rule.
fn rotated(v: Vector, degrees: Vector) -> Vector {
    let (s, c) = sin_cos_degrees(degrees.x);
    let v = Vector::new(v.x, c * v.y - s * v.z, s * v.y + c * v.z);
    let (s, c) = sin_cos_degrees(degrees.y);
    let v = Vector::new(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
    let (s, c) = sin_cos_degrees(degrees.z);
    Vector::new(c * v.x - s * v.y, s * v.x + c * v.y, v.z)
}

/// Rotates about an axis.
///
/// **Source:** Rodrigues, "Des lois géométriques qui régissent les déplacements d'un système solide", 1840: v
/// cos θ + (k × v) sin θ + k (k · v)(1 − cos θ).
fn axis_rotated(v: Vector, axis: UnitVector, degrees: f64) -> Vector {
    let (s, c) = sin_cos_degrees(degrees);
    let k = axis.get();
    v * c + k.cross(v) * s + k * (k.dot(v) * (1.0 - c))
}

/// Returns whether the argument at this zero-based position is a vector.
pub fn wants_vector(word: Word, place: usize) -> bool {
    match word {
        Word::Vlength | Word::Vnormalize => place == 0,
        Word::Vdot | Word::Vcross | Word::Vrotate | Word::VaxisRotate => place < 2,
        Word::Vstr => place == 1,
        Word::Vturbulence => place == 3,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::{CallErrorKind, RandomStreams, call, measured};
    use super::*;
    use crate::evaluate::value::Value;

    fn value(word: Word, arguments: &[Value]) -> Value {
        call(word, arguments, &mut RandomStreams::default(), usize::MAX).expect("a value")
    }

    fn vector(word: Word, arguments: &[Value]) -> Vector {
        value(word, arguments).as_vector3().expect("a vector")
    }

    fn number(word: Word, arguments: &[Value]) -> f64 {
        value(word, arguments).as_number().expect("a number")
    }

    #[test]
    fn vectors_are_those_that_pov_ray_prints() {
        measured::check(measured::VECTOR);
    }

    #[test]
    fn quarter_turns_are_exact() {
        let v = Value::vector3(Vector::new(1.0, 2.0, 3.0));
        let turned =
            |x, y, z| vector(Word::Vrotate, &[v.clone(), Value::vector3(Vector::new(x, y, z))]);
        assert_eq!(turned(90.0, 0.0, 0.0), Vector::new(1.0, -3.0, 2.0));
        assert_eq!(turned(0.0, 90.0, 0.0), Vector::new(3.0, 2.0, -1.0));
        assert_eq!(turned(0.0, 0.0, -450.0), Vector::new(2.0, -1.0, 3.0));
        assert_eq!(turned(180.0, 180.0, 180.0), Vector::new(1.0, 2.0, 3.0));
        let about_y = [v.clone(), Value::vector3(Vector::Y), Value::Number(270.0)];
        assert_eq!(vector(Word::VaxisRotate, &about_y), Vector::new(-3.0, 2.0, 1.0));
    }

    #[test]
    fn a_zero_vector_has_no_direction() {
        let zero = Value::Number(0.0);
        let error = call(
            Word::Vnormalize,
            std::slice::from_ref(&zero),
            &mut RandomStreams::default(),
            usize::MAX,
        );
        let error = error.expect_err("no direction");
        assert_eq!(
            error.message,
            "`vnormalize` takes a vector with a direction, not the zero vector"
        );
        let arguments = [Value::Number(1.0), zero, Value::Number(30.0)];
        let error = call(Word::VaxisRotate, &arguments, &mut RandomStreams::default(), usize::MAX);
        let error = error.expect_err("no axis");
        assert_eq!((error.kind, error.argument), (CallErrorKind::ZeroVector, Some(1)));
    }

    #[test]
    fn turbulence_takes_four_arguments_the_last_a_point() {
        let n = Value::Number(2.0);
        let error = |arguments: &[Value]| {
            let error =
                call(Word::Vturbulence, arguments, &mut RandomStreams::default(), usize::MAX);
            error.expect_err("no turbulence")
        };
        let three = error(&[n.clone(), n.clone(), n.clone()]);
        assert_eq!(three.message, "`vturbulence` takes 4 arguments, not 3");
        assert_eq!((three.kind, three.argument), (CallErrorKind::WrongArity, None));
        let five = error(&[n.clone(), n.clone(), n.clone(), n.clone(), n.clone()]);
        assert_eq!(five.message, "`vturbulence` takes 4 arguments, not 5");
        assert_eq!(five.argument, Some(4));
        let point = Value::vector3(Vector::ONE);
        let swapped = error(&[point.clone(), n.clone(), n.clone(), n.clone()]);
        assert_eq!(swapped.message, "`vturbulence` takes a number, not a vector");
        assert_eq!((swapped.kind, swapped.argument), (CallErrorKind::WrongType, Some(0)));
        let loud = error(&[n.clone(), Value::Number(1e38), Value::Number(10.0), point]);
        assert_eq!(loud.kind, CallErrorKind::NotFinite);
    }

    #[test]
    fn huge_and_tiny_vectors_have_lengths_and_directions() {
        for size in [1e200, 1e-200] {
            let v = Value::vector3(Vector::new(3.0, 0.0, 4.0) * size);
            assert!(
                (number(Word::Vlength, std::slice::from_ref(&v)) / (5.0 * size) - 1.0).abs()
                    < 1e-15
            );
            let direction = vector(Word::Vnormalize, &[v]);
            assert!((direction - Vector::new(0.6, 0.0, 0.8)).length() < 1e-15);
        }
    }

    fn any_vector() -> impl Strategy<Value = Vector> {
        [-10.0..10.0f64, -10.0..10.0, -10.0..10.0].prop_map(Vector::from_array)
    }

    proptest! {
        #[test]
        fn a_cross_product_is_orthogonal_to_both_and_as_long_as_their_area(a in any_vector(), b in any_vector()) {
            let (u, v) = (Value::vector3(a), Value::vector3(b));
            let cross = value(Word::Vcross, &[u.clone(), v.clone()]);
            prop_assert!(number(Word::Vdot, &[cross.clone(), u.clone()]).abs() < 1e-11);
            prop_assert!(number(Word::Vdot, &[cross.clone(), v.clone()]).abs() < 1e-11);
            let area = number(Word::Vlength, &[cross]).powi(2);
            let dot = number(Word::Vdot, &[u, v]);
            let law = a.length_squared() * b.length_squared() - dot * dot;
            prop_assert!((area - law).abs() < 1e-9 * (1.0 + a.length_squared() * b.length_squared()));
        }

        #[test]
        fn rotations_keep_lengths_and_their_axis(v in any_vector(), turn in any_vector(), degrees in -720.0..720.0f64) {
            let rotated = vector(Word::Vrotate, &[Value::vector3(v), Value::vector3(turn * 36.0)]);
            prop_assert!((rotated.length() - v.length()).abs() < 1e-13);
            prop_assume!(turn != Vector::ZERO);
            let arguments = [Value::vector3(v), Value::vector3(turn), Value::Number(degrees)];
            let rotated = vector(Word::VaxisRotate, &arguments);
            prop_assert!((rotated.length() - v.length()).abs() < 1e-13);
            prop_assert!((rotated.dot(turn) - v.dot(turn)).abs() < 1e-11);
        }

        #[test]
        fn both_rotations_agree_about_the_axes(v in any_vector(), degrees in -720.0..720.0f64) {
            for axis in [Vector::X, Vector::Y, Vector::Z] {
                let one = vector(Word::Vrotate, &[Value::vector3(v), Value::vector3(axis * degrees)]);
                let arguments = [Value::vector3(v), Value::vector3(axis), Value::Number(degrees)];
                prop_assert!((one - vector(Word::VaxisRotate, &arguments)).length() < 1e-13);
            }
        }
    }
}
