//! Fractals: a Julia fractal as the surface of a function of space.

use super::Fault;
use super::transform::{Affine, exact};
use crate::math::Vector;
use crate::math::double::{Double, DoubleVector, power_of_two_near};
use crate::scene;
use crate::shape::Body;
use crate::shape::isosurface::{Container, Field, Isosurface};
use crate::shape::julia_fractal::{HypercomplexFunction, Iteration, Julia, JuliaFractal};
use crate::vocabulary::Word;

/// Around the ball that no iterate may leave, with room to end inside.
const ROOM: f64 = 1.0 + 1.0 / 64.0;

/// The fractal in lengths of a power of two near its ball's radius.
pub fn julia(written: &scene::Julia) -> Result<(Body, Affine), Fault> {
    let [a, b, c, d] = written.slice;
    let iteration = match (written.hypercomplex, written.function) {
        (false, Word::Cube) => Iteration::QuaternionCube,
        (false, _) => Iteration::QuaternionSquare,
        (true, function) => Iteration::Hypercomplex(hypercomplex(function, written.power)),
    };
    let length = [a, b, c, d].iter().map(|n| n * n).sum::<f64>().sqrt();
    let field = Julia {
        parameter: written.parameter,
        iteration,
        count: written.iterations,
        slice: Vector::new(a, b, c) / -d,
        offset: written.distance * length / d,
    };
    let radius = field.radius() * ROOM;
    let known = written.parameter.iter().chain(&written.power).all(|number| number.is_finite());
    if !(known && radius.is_finite() && field.slice.is_finite() && field.offset.is_finite()) {
        return Err(Fault::not_finite("this fractal"));
    }
    let scale = power_of_two_near(radius);
    let accuracy = 0.02 / written.precision / scale;
    let body = JuliaFractal(Isosurface {
        field: Field::Julia(field),
        threshold: 0.0,
        container: Container::Sphere(radius / scale),
        centre: Vector::ZERO,
        scale,
        accuracy,
        finest: accuracy,
        open: false,
    });
    let columns = [0, 1, 2].map(|i| DoubleVector::axis(i).map(|c| c * Double::from(scale)));
    Ok((Body::JuliaFractal(body), Affine::from_columns(columns, exact(Vector::ZERO))))
}

fn hypercomplex(function: Word, [re, im]: [f64; 2]) -> HypercomplexFunction {
    use HypercomplexFunction as Of;
    match function {
        Word::Cube => Of::Cube,
        Word::Exp => Of::Exp,
        Word::Reciprocal => Of::Reciprocal,
        Word::Sin => Of::Sin,
        Word::Asin => Of::Asin,
        Word::Sinh => Of::Sinh,
        Word::Asinh => Of::Asinh,
        Word::Cos => Of::Cos,
        Word::Acos => Of::Acos,
        Word::Cosh => Of::Cosh,
        Word::Acosh => Of::Acosh,
        Word::Tan => Of::Tan,
        Word::Atan => Of::Atan,
        Word::Tanh => Of::Tanh,
        Word::Atanh => Of::Atanh,
        Word::Ln => Of::Ln,
        Word::Pwr => Of::Power(re, im),
        _ => Of::Square,
    }
}
