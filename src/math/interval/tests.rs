//! What intervals promise, on numbers drawn.

use super::*;
use crate::math::random::Random;

/// Tries a function on numbers drawn from drawn intervals.
fn holds(
    name: &str,
    interval: impl Fn(Interval, Interval) -> Interval,
    exact: impl Fn(f64, f64) -> f64,
) {
    let mut narrow = 0;
    for seed in 0..2_000 {
        let mut draw = Random::of(seed, 1);
        let drawn = |draw: &mut Random| {
            let scale = elementary::pow(10.0, draw.number(-3.0, 2.0));
            let low = draw.number(-1.0, 1.0) * scale;
            let width = if draw.below(4) == 0 { 0.0 } else { draw.number(0.0, 0.5) * scale };
            Interval { low, high: low + width }
        };
        let (a, b) = (drawn(&mut draw), drawn(&mut draw));
        let result = interval(a, b);
        narrow += usize::from(result.is_finite());
        for k in 0..24 {
            let within = |i: Interval, draw: &mut Random| match k {
                0 => i.low,
                1 => i.high,
                _ => draw.number(i.low, i.high).clamp(i.low, i.high),
            };
            let (x, y) = (within(a, &mut draw), within(b, &mut draw));
            let value = exact(x, y);
            assert!(
                value.is_nan() && result == Interval::EVERYTHING || result.contains(value),
                "{name}({x:e}, {y:e}) = {value:e} outside {result:?} of {a:?}, {b:?}"
            );
        }
    }
    assert!(narrow > 400, "{name} gave {narrow} finite intervals of 2,000");
}

#[test]
fn every_value_lies_in_the_interval_of_its_operation() {
    holds("+", |a, b| a + b, |a, b| a + b);
    holds("-", |a, b| a - b, |a, b| a - b);
    holds("*", |a, b| a * b, |a, b| a * b);
    holds("/", |a, b| a / b, |a, b| a / b);
    holds("abs", |a, _| a.abs(), |a, _| a.abs());
    holds("square", |a, _| a.square(), |a, _| a * a);
    holds("sqrt", |a, _| a.sqrt(), |a, _| a.sqrt());
    holds("sin", |a, _| Interval::sin(a), |a, _| elementary::sin(a));
    holds("cos", |a, _| Interval::cos(a), |a, _| elementary::cos(a));
    holds("tan", |a, _| Interval::tan(a), |a, _| elementary::tan(a));
    holds("atan2", Interval::atan2, elementary::atan2);
    holds("pow", Interval::pow, elementary::pow);
    holds("cube", |a, _| a.pow(Interval::point(3.0)), |a, _| elementary::pow(a, 3.0));
    holds("fmod", |a, _| a.fmod(Interval::point(0.75)), |a, _| elementary::fmod(a, 0.75));
    holds("cosh", |a, _| Interval::cosh(a), |a, _| elementary::cosh(a));
}

#[test]
fn a_sum_of_squares_has_a_root_wherever_it_is() {
    for high in [0.0, 1e-300, 0.25] {
        let side = Interval { low: -0.0, high };
        let zero = Interval::point(0.0);
        let squares: [fn(Interval) -> Interval; 3] =
            [Interval::square, |side| side.pow(Interval::point(2.0)), |side| side * side];
        for square in squares {
            let length = (square(side) + square(zero) + square(zero)).sqrt();
            assert!(
                length.low == 0.0 && length.high <= high * (1.0 + 1e-14) + 1e-150,
                "{length:?}"
            );
        }
        let less = -side - zero;
        assert!(less.high == 0.0, "{less:?}");
    }
}

#[test]
fn a_wave_is_cut_where_it_does_not_reach_its_crest() {
    let sin = |low, high| Interval::sin(Interval { low, high });
    let quarter = sin(0.1, 1.0);
    assert!(quarter.low > 0.09 && quarter.high < 0.85, "{quarter:?}");
    assert_eq!(sin(1.0, 2.0).high, 1.0);
    assert_eq!(Interval::cos(Interval { low: 3.0, high: 3.3 }).low, -1.0);
}

#[test]
fn what_may_be_undefined_may_be_everything() {
    assert_eq!(Interval { low: -1.0, high: 4.0 }.sqrt(), Interval::EVERYTHING);
    assert_eq!(Interval::point(1.0) / Interval { low: -1.0, high: 1.0 }, Interval::EVERYTHING);
}
