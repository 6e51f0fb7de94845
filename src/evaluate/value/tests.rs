//! Promotion and calculation.

use super::*;

fn binary(operator: BinaryOperator, a: &Value, b: &Value) -> Result<Value, OperationError> {
    super::binary(operator, a, b, Comparison::Relative)
}

fn vector(values: &[f64]) -> Value {
    Value::Vector(Components::new(values).expect("two to five numbers"))
}

#[test]
fn a_number_fills_all_components_and_a_short_vector_fills_up_with_zeros() {
    let sum = binary(BinaryOperator::Add, &Value::Number(1.0), &vector(&[1.0, 2.0, 3.0]));
    assert_eq!(sum, Ok(vector(&[2.0, 3.0, 4.0])));
    let product = binary(BinaryOperator::Multiply, &vector(&[1.0, 2.0, 3.0]), &vector(&[1.0, 2.0]));
    assert_eq!(product, Ok(vector(&[1.0, 4.0, 0.0])));
}

#[test]
fn a_number_added_to_a_colour_reaches_filter_and_transmit_too() {
    let red = Value::Color(Color::opaque(Rgb::new(1.0, 0.0, 0.0)));
    let sum = binary(BinaryOperator::Add, &red, &Value::Number(0.5)).expect("numbers");
    assert_eq!(sum.numbers().expect("five").as_slice(), [1.5, 0.5, 0.5, 0.5, 0.5]);
}

#[test]
fn comparison_is_by_component_and_forgives_decimal_leftovers_only() {
    fn equal(a: &Value, b: &Value) -> Result<Value, OperationError> {
        binary(BinaryOperator::Equal, a, b)
    }
    assert_eq!(
        equal(&vector(&[1.0, 2.0, 3.0]), &vector(&[1.0, 5.0, 3.0])),
        Ok(vector(&[1.0, 0.0, 1.0]))
    );
    assert_eq!(equal(&Value::Number(0.1 + 0.2), &Value::Number(0.3)), Ok(Value::truth(true)));
    assert_eq!(equal(&Value::Number(1e-12), &Value::Number(2e-12)), Ok(Value::truth(false)));
}

#[test]
fn what_has_no_finite_result_says_so() {
    let divide = |a, b| binary(BinaryOperator::Divide, &Value::Number(a), &Value::Number(b));
    assert_eq!(divide(1.0, 0.0), Err(OperationError::DivisionByZero));
    assert_eq!(divide(1e300, 1e-300), Err(OperationError::NotFinite));
    let error = binary(BinaryOperator::Add, &Value::string("a"), &Value::Number(1.0));
    assert_eq!(error, Err(OperationError::NotNumeric(0)));
}
