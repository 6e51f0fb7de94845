//! How fast functions are evaluated, point by point and in batches.
//!
//! `cargo bench --bench function`. The functions have eight operations each, of arithmetic alone and
//! with a sine and a root among them; twenty million evaluations a second are promised.

use divan::counter::ItemsCount;
use lucarne::function::{Batch, Binary, Builder, Function, LANES, Nothing, TooLong, Unary};

fn main() {
    divan::main();
}

const POINTS: usize = 4096;

/// x·y + (x − z)·z − y/z, less 1, halved.
fn arithmetic() -> Result<Function, TooLong> {
    let mut b = Builder::new(3)?;
    let [x, y, z] = [0, 1, 2].map(|index| b.parameter(index).expect("three parameters"));
    let (one, half) = (b.constant(1.0)?, b.constant(0.5)?);
    let product = b.binary(Binary::Multiply, x, y)?;
    let difference = b.binary(Binary::Subtract, x, z)?;
    let other = b.binary(Binary::Multiply, difference, z)?;
    let sum = b.binary(Binary::Add, product, other)?;
    let quotient = b.binary(Binary::Divide, y, z)?;
    let rest = b.binary(Binary::Subtract, sum, quotient)?;
    let less = b.binary(Binary::Subtract, rest, one)?;
    let result = b.binary(Binary::Multiply, less, half)?;
    Ok(b.finish(result))
}

/// √(x² + z²) − y + sin(x)/2 less 1: a rippled cone.
fn ripple() -> Result<Function, TooLong> {
    let mut b = Builder::new(3)?;
    let [x, y, z] = [0, 1, 2].map(|index| b.parameter(index).expect("three parameters"));
    let half = b.constant(0.5)?;
    let squares = [b.unary(Unary::Square, x)?, b.unary(Unary::Square, z)?];
    let sum = b.binary(Binary::Add, squares[0], squares[1])?;
    let root = b.unary(Unary::Sqrt, sum)?;
    let height = b.binary(Binary::Subtract, root, y)?;
    let sine = b.unary(Unary::Sin, x)?;
    let wave = b.binary(Binary::Multiply, sine, half)?;
    let result = b.binary(Binary::Add, height, wave)?;
    Ok(b.finish(result))
}

fn point(index: usize) -> [f64; 3] {
    let t = index as f64 / POINTS as f64;
    [t * 4.0 - 2.0, t * t, 1.5 - t]
}

#[divan::bench(args = ["arithmetic", "ripple"])]
fn points(bencher: divan::Bencher, name: &str) {
    let function = named(name);
    let points: Vec<_> = (0..POINTS).map(point).collect();
    let mut run = function.run::<f64>();
    bencher
        .counter(ItemsCount::new(POINTS))
        .bench_local(|| points.iter().map(|point| run.at(point, &Nothing)).sum::<f64>());
}

#[divan::bench(args = ["arithmetic", "ripple"])]
fn batches(bencher: divan::Bencher, name: &str) {
    let function = named(name);
    let lanes = |batch: usize| {
        let point = |axis: usize| {
            Batch(std::array::from_fn(|lane| self::point(batch * LANES + lane)[axis]))
        };
        [point(0), point(1), point(2)]
    };
    let batches: Vec<_> = (0..POINTS / LANES).map(lanes).collect();
    let mut run = function.run::<Batch>();
    bencher
        .counter(ItemsCount::new(POINTS))
        .bench_local(|| batches.iter().map(|batch| run.at(batch, &Nothing).0[0]).sum::<f64>());
}

fn named(name: &str) -> Function {
    let function = if name == "ripple" { ripple() } else { arithmetic() }.expect("few operations");
    assert_eq!(function.operations(), 8);
    function
}
