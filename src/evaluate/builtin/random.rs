//! Random numbers: `seed` opens a stream and `rand` draws from it, with the same numbers as POV-Ray.
//!
//! **In:** a scene's calls, in order. **Out:** numbers from 0 to 1, both inclusive. **Invariant:** a stream
//! depends only on its seed.
//!
//! The generator was inferred from the program's output: the first number of `seed(n + 1)` minus that of
//! `seed(n)` is always 1812433253 / (2³² − 1), that of `seed(0)` is 12345 / (2³² − 1), and `seed(12345)`
//! continues where `seed(0)` is after one draw. So a state s becomes 1812433253 s + 12345 modulo 2³², and the
//! number is s / (2³² − 1). Seeds and streams are truncated to integers; a seed outside 32 bits counts as
//! −2³¹.

use super::{Arguments, Body, CallError, Function};
use crate::vocabulary::Word;

const MULTIPLIER: u32 = 1_812_433_253;
const INCREMENT: u32 = 12_345;

/// The streams that a scene has opened; a stream's value is its index.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RandomStreams {
    states: Vec<u32>,
}

impl RandomStreams {
    fn open(&mut self, seed: f64) -> f64 {
        let whole = seed.trunc();
        let fits = (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&whole);
        self.states.push(if fits { whole as i32 as u32 } else { i32::MIN as u32 });
        (self.states.len() - 1) as f64
    }

    /// Returns the next number; `None` if no such stream is open.
    fn draw(&mut self, stream: f64) -> Option<f64> {
        let stream = stream.trunc();
        if stream < 0.0 {
            return None;
        }
        let state = self.states.get_mut(stream as usize)?;
        *state = state.wrapping_mul(MULTIPLIER).wrapping_add(INCREMENT);
        Some(f64::from(*state) / f64::from(u32::MAX))
    }
}

/// Returns the function that `word` names, if it is in this family.
pub(super) fn function(word: Word) -> Option<Function> {
    match word {
        Word::Seed => Some(Function { arity: 1..=1, body: Body::Random(seed) }),
        Word::Rand => Some(Function { arity: 1..=1, body: Body::Random(rand) }),
        _ => None,
    }
}

fn seed(a: &Arguments, streams: &mut RandomStreams) -> Result<f64, CallError> {
    Ok(streams.open(a.number(0)?))
}

fn rand(a: &Arguments, streams: &mut RandomStreams) -> Result<f64, CallError> {
    let stream = a.number(0)?;
    streams.draw(stream).ok_or_else(|| {
        a.out_of_range(0, "a stream that `seed` opened")
            .with_help("`#declare R = seed(1);` opens a stream, `rand(R)` draws from it")
    })
}

#[cfg(test)]
mod tests {
    use super::super::{CallErrorKind, call, measured};
    use super::*;
    use crate::evaluate::value::Value;

    #[test]
    fn streams_draw_the_numbers_that_pov_ray_draws() {
        let mut seeds = 0;
        for line in measured::RANDOM.lines().filter(|line| !line.starts_with('#')) {
            let (seed, draws) = line.split_once(':').expect("a seed and its draws");
            let mut streams = RandomStreams::default();
            let stream = streams.open(seed.trim().parse().expect("a seed"));
            for draw in draws.split_whitespace() {
                let measured: f64 = draw.parse().expect("a number");
                let drawn = streams.draw(stream).expect("an open stream");
                assert!((drawn - measured).abs() < 1e-16, "seed({seed}): {drawn} and {measured}");
            }
            seeds += 1;
        }
        assert!(seeds >= 10);
    }

    #[test]
    fn streams_are_counted_from_zero_and_do_not_disturb_each_other() {
        let mut streams = RandomStreams::default();
        let mut number = |word, n| {
            let value = call(word, &[Value::Number(n)], &mut streams, usize::MAX).expect("a value");
            value.as_number().expect("a number")
        };
        assert_eq!((number(Word::Seed, 7.0), number(Word::Seed, 7.0)), (0.0, 1.0));
        let first = number(Word::Rand, 0.0);
        let second = number(Word::Rand, 0.9); // a fraction of a stream's number is dropped
        assert_ne!(first, second);
        assert_eq!((number(Word::Rand, 1.0), number(Word::Rand, 1.0)), (first, second));
    }

    #[test]
    fn a_stream_that_was_never_opened_is_an_error_with_help() {
        for stream in [-1.0, 1.0, 1e300] {
            let mut streams = RandomStreams::default();
            streams.open(1.0);
            let error = call(Word::Rand, &[Value::Number(stream)], &mut streams, usize::MAX);
            let error = error.expect_err("no such stream");
            assert_eq!(error.kind, CallErrorKind::OutOfRange);
            assert!(error.message.starts_with("`rand` takes a stream that `seed` opened, not "));
            assert!(error.help.is_some());
        }
    }
}
