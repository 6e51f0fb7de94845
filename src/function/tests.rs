//! What every function keeps, on functions drawn at random and on a few written out.

use super::*;
use crate::math::random::{Random, long};

/// Something that is no arithmetic.
struct Ramp;

impl Outside for Ramp {
    fn value(&self, _: OutsideId, arguments: &[f64]) -> f64 {
        arguments.iter().map(|a| a.clamp(-1.0, 1.0)).sum()
    }

    fn bounds(&self, _: OutsideId, arguments: &[Interval]) -> Interval {
        let clamp = |a: f64| a.clamp(-1.0, 1.0);
        let clamped = |a: &Interval| match *a {
            Interval::EVERYTHING => Interval::EVERYTHING,
            Interval { low, high } => Interval::between(clamp(low), clamp(high)),
        };
        arguments.iter().map(clamped).fold(Interval::point(0.0), |sum, a| sum + a)
    }
}

const UNARY: [Unary; 12] = [
    Unary::Negate,
    Unary::Not,
    Unary::Abs,
    Unary::Floor,
    Unary::Int,
    Unary::Square,
    Unary::Sqrt,
    Unary::Exp,
    Unary::Ln,
    Unary::Sin,
    Unary::Cos,
    Unary::Atan,
];

const BINARY: [Binary; 15] = [
    Binary::Add,
    Binary::Subtract,
    Binary::Multiply,
    Binary::Divide,
    Binary::Less,
    Binary::LessOrEqual,
    Binary::Equal,
    Binary::NotEqual,
    Binary::And,
    Binary::Or,
    Binary::Min,
    Binary::Max,
    Binary::Mod,
    Binary::Pow,
    Binary::Atan2,
];

/// A function as it would be written, to be evaluated the plain way.
#[derive(Debug, Clone)]
enum Tree {
    Constant(f64),
    Parameter(usize),
    /// Of the loop that stands in so many others.
    Counter(usize),
    Unary(Unary, Box<Tree>),
    Binary(Binary, Box<[Tree; 2]>),
    Choose(Box<[Tree; 3]>),
    Ask(Box<[Tree; 2]>),
    /// From, last and a turn's value.
    Loop(Binary, Box<[Tree; 3]>),
}

fn drawn(draw: &mut Random, depth: usize, loops: usize) -> Tree {
    let inner = |draw: &mut Random| drawn(draw, depth - 1, loops);
    match draw.below(if depth == 0 { 3 } else { 12 }) {
        0 => Tree::Constant([0.0, 1.0, 2.0, -0.5, 3.0][draw.below(5)]),
        1 if loops > 0 => Tree::Counter(draw.below(loops)),
        1 | 2 => Tree::Parameter(draw.below(3)),
        3..=5 => Tree::Unary(UNARY[draw.below(UNARY.len())], Box::new(inner(draw))),
        6 => Tree::Choose(Box::new([inner(draw), inner(draw), inner(draw)])),
        7 => Tree::Ask(Box::new([inner(draw), inner(draw)])),
        8 => {
            // A few turns: from a sine to three more.
            let from = Tree::Unary(Unary::Sin, Box::new(inner(draw)));
            let last = Tree::Binary(Binary::Add, Box::new([from.clone(), Tree::Constant(2.5)]));
            let value = drawn(draw, depth - 1, loops + 1);
            let operation = [Binary::Add, Binary::Multiply][draw.below(2)];
            Tree::Loop(operation, Box::new([from, last, value]))
        }
        _ => {
            let operation = BINARY[draw.below(BINARY.len())];
            Tree::Binary(operation, Box::new([inner(draw), inner(draw)]))
        }
    }
}

fn build(builder: &mut Builder, tree: &Tree, counters: &mut Vec<Node>) -> Node {
    let built = match tree {
        Tree::Constant(value) => builder.constant(*value),
        Tree::Parameter(index) => return builder.parameter(*index).expect("one of three"),
        Tree::Counter(depth) => return counters[*depth],
        Tree::Unary(operation, a) => {
            let a = build(builder, a, counters);
            builder.unary(*operation, a)
        }
        Tree::Binary(operation, operands) => {
            let [a, b] = operands.each_ref().map(|tree| build(builder, tree, counters));
            builder.binary(*operation, a, b)
        }
        Tree::Choose(operands) => {
            let [condition, then, otherwise] =
                operands.each_ref().map(|tree| build(builder, tree, counters));
            builder.choose(condition, then, otherwise)
        }
        Tree::Ask(operands) => {
            let arguments = operands.each_ref().map(|tree| build(builder, tree, counters));
            builder.ask(OutsideId(7), &arguments)
        }
        Tree::Loop(operation, operands) => {
            let [from, last, value] = &**operands;
            let (from, last) = (build(builder, from, counters), build(builder, last, counters));
            let open = builder.open(*operation, from, last).expect("few loops");
            counters.push(open.counter);
            let value = build(builder, value, counters);
            counters.pop();
            builder.close(open, value)
        }
    };
    built.expect("few operations")
}

fn function(parameters: usize, tree: &Tree) -> Function {
    let mut builder = Builder::new(parameters).expect("few parameters");
    let result = build(&mut builder, tree, &mut Vec::new());
    builder.finish(result)
}

fn plain(tree: &Tree, arguments: &[f64], counters: &mut Vec<f64>) -> f64 {
    let mut of = |tree: &Tree| plain(tree, arguments, counters);
    match tree {
        Tree::Constant(value) => *value,
        Tree::Parameter(index) => arguments[*index],
        Tree::Counter(depth) => counters[*depth],
        Tree::Unary(operation, a) => operation.of(of(a)),
        Tree::Binary(Binary::Pow, operands) => match operands.each_ref().map(of) {
            // As the builder has it: correctly rounded.
            [a, 2.0] => a * a,
            [a, b] => Binary::Pow.of(a, b),
        },
        Tree::Binary(operation, operands) => {
            let [a, b] = operands.each_ref().map(of);
            operation.of(a, b)
        }
        Tree::Choose(operands) => {
            let [condition, then, otherwise] = operands.each_ref().map(of);
            if condition != 0.0 { then } else { otherwise }
        }
        Tree::Ask(operands) => Ramp.value(OutsideId(7), &operands.each_ref().map(of)),
        Tree::Loop(operation, operands) => {
            let [from, last, value] = &**operands;
            let (mut at, last) = (of(from), of(last));
            let mut total = if *operation == Binary::Add { 0.0 } else { 1.0 };
            while at <= last {
                counters.push(at);
                total = operation.of(total, plain(value, arguments, counters));
                counters.pop();
                at += 1.0;
            }
            total
        }
    }
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

#[test]
fn a_tape_a_batch_and_the_bounds_say_what_the_tree_says() {
    let mut finite = 0;
    for seed in 0..(2_000 * long() as u64) {
        let mut draw = Random::of(seed, 3);
        let tree = drawn(&mut draw, 5, 0);
        let function = function(3, &tree);
        let (mut run, mut batch, mut bounds) = (function.run(), function.run(), function.run());
        let corner = [0; 3].map(|_| draw.number(-2.0, 2.0));
        let width = if seed % 2 == 0 { 0.01 } else { 1.0 };
        let boxed = corner.map(|low| Interval { low, high: low + width });
        let points = [(); LANES].map(|()| boxed.map(|i| draw.number(i.low, i.high).min(i.high)));
        let lanes = [0, 1, 2].map(|axis| Batch(points.map(|point| point[axis])));
        let together = batch.at(&lanes, &Ramp);
        let bounds: Interval = bounds.at(&boxed, &Ramp);
        finite += usize::from(bounds.is_finite());
        for (point, lane) in points.iter().zip(together.0) {
            let expected = plain(&tree, point, &mut Vec::new());
            let value: f64 = run.at(point, &Ramp);
            assert!(
                same(value, expected),
                "seed {seed}: {value} {expected}\n{tree:?}\n{function:?}"
            );
            assert!(same(value, lane), "seed {seed}: in a batch {lane}, alone {value}");
            let held = bounds.contains(value) || value.is_nan() && bounds == Interval::EVERYTHING;
            assert!(held, "seed {seed}: {value:e} outside {bounds:?}\n{tree:?}");
        }
    }
    assert!(finite > 1_000, "{finite} of 2,000 have bounds");
}

/// (p0 + p1)·2 over the builder's own calls.
fn built(make: impl FnOnce(&mut Builder, [Node; 2]) -> Result<Node, TooLong>) -> Function {
    let mut builder = Builder::new(2).expect("two");
    let parameters = [0, 1].map(|index| builder.parameter(index).expect("two"));
    let result = make(&mut builder, parameters).expect("few operations");
    builder.finish(result)
}

#[test]
fn constants_fold_and_equal_operations_are_made_once() {
    let f = built(|b, [x, y]| {
        let (two, three) = (b.constant(2.0)?, b.constant(3.0)?);
        let six = b.binary(Binary::Multiply, two, three)?;
        let (one, other) = (b.binary(Binary::Add, x, y)?, b.binary(Binary::Add, y, x)?);
        let sum = b.binary(Binary::Multiply, one, other)?;
        b.binary(Binary::Add, sum, six)
    });
    assert_eq!(f.operations(), 3, "a sum, its square, and six more");
    assert_eq!(f.run::<f64>().at(&[1.0, 2.0], &Nothing), 15.0);
}

#[test]
fn what_does_not_need_the_counter_leaves_the_loop_and_what_nothing_needs_is_not_there() {
    let f = built(|b, [x, y]| {
        let (one, ten) = (b.constant(1.0)?, b.constant(10.0)?);
        let open = b.open(Binary::Add, one, ten)?;
        let dear = b.unary(Unary::Sin, y)?;
        b.unary(Unary::Exp, x)?;
        let turn = b.binary(Binary::Multiply, open.counter, dear)?;
        b.close(open, turn)
    });
    assert_eq!(f.operations(), 3, "a sine, a loop, and a product in it: {f:?}");
    let sine: f64 = crate::math::elementary::sin(0.5);
    let by_hand = (1..=10).fold(0.0, |sum, i| sum + f64::from(i) * sine);
    assert_eq!(f.run::<f64>().at(&[0.0, 0.5], &Nothing), by_hand);
}

#[test]
fn a_function_called_by_another_becomes_part_of_it() {
    let inner = built(|b, [x, y]| b.binary(Binary::Subtract, x, y));
    let outer = built(|b, [x, y]| {
        let there = b.call(&inner, &[x, y])?;
        let back = b.call(&inner, &[y, x])?;
        b.binary(Binary::Multiply, there, back)
    });
    assert_eq!(outer.operations(), 3);
    assert_eq!(outer.run::<f64>().at(&[5.0, 3.0], &Nothing), -4.0);
}

#[test]
fn long_chains_need_few_registers() {
    let f = built(|b, [x, y]| {
        let mut node = x;
        for _ in 0..1_000 {
            let sine = b.unary(Unary::Sin, node)?;
            node = b.binary(Binary::Add, sine, y)?;
        }
        Ok(node)
    });
    assert_eq!(f.operations(), 2_000);
    assert!(f.run::<f64>().registers() <= 4);
}

#[test]
fn a_loop_that_would_seem_never_to_end_has_no_result() {
    let f = built(|b, [x, y]| {
        let open = b.open(Binary::Add, x, y)?;
        let turn = open.counter;
        b.close(open, turn)
    });
    assert!(f.run::<f64>().at(&[1e300, 1e300], &Nothing).is_nan(), "1e300 + 1 is 1e300");
    assert_eq!(f.run::<f64>().at(&[1.0, 4.0], &Nothing), 10.0);
    assert_eq!(f.run::<f64>().at(&[1.0, 0.0], &Nothing), 0.0, "no turn at all");
}

#[test]
fn a_function_too_long_says_so() {
    assert!(Builder::new(57).is_err());
    let mut builder = Builder::new(1).expect("one");
    let mut node = builder.parameter(0).expect("one");
    let outcome = (0..=build::MOST_OPERATIONS).try_for_each(|_| {
        node = builder.unary(Unary::Sin, node)?;
        Ok(())
    });
    assert_eq!(outcome, Err(TooLong));
}

#[test]
fn values_change_no_faster_than_the_slopes_of_a_box_around_them() {
    let mut known = 0;
    for seed in 0..(2_000 * long() as u64) {
        let mut draw = Random::of(seed, 9);
        let function = function(3, &drawn(&mut draw, 5, 0));
        let corner = [0; 3].map(|_| draw.number(-2.0, 2.0));
        let width = if seed % 2 == 0 { 0.01 } else { 1.0 };
        let boxed = corner.map(|low| Interval { low, high: low + width });
        let along = |axis: usize| {
            let mut slopes = [Interval::point(0.0); 3];
            slopes[axis] = Interval::point(1.0);
            Sloped { value: boxed[axis], slopes }
        };
        let Sloped { value, slopes } = function.run().at(&[0, 1, 2].map(along), &Ramp);
        assert_eq!(value, function.run().at(&boxed, &Ramp), "seed {seed}");
        known += usize::from(slopes.iter().all(|slope| slope.is_finite()));
        let (mut run, mut bounds) = (function.run::<f64>(), function.run::<Interval>());
        for _ in 0..12 {
            let from = boxed.map(|i| draw.number(i.low, i.high).min(i.high));
            let axis = draw.below(3);
            let mut to = from;
            to[axis] = draw.number(boxed[axis].low, boxed[axis].high).min(boxed[axis].high);
            let step = to[axis] - from[axis];
            let change = run.at(&to, &Ramp) - run.at(&from, &Ramp);
            if !change.is_finite() || step == 0.0 {
                continue;
            }
            let mut rounding = |point: [f64; 3]| {
                let Interval { low, high } = bounds.at(&point.map(Interval::point), &Ramp);
                high - low
            };
            let off = (rounding(from) + rounding(to)) / step.abs();
            let (slope, Interval { low, high }) = (change / step, slopes[axis]);
            let sound = low - off <= slope && slope <= high + off;
            assert!(
                sound,
                "seed {seed}: {slope:e} outside {low:e} {high:e}, axis {axis}\n{function:?}"
            );
        }
    }
    assert!(known > 500, "{known} of 2,000 have slopes");
}
