//! Tapes: operations in execution order, each of which writes to a register.
//!
//! **Invariant:** the arguments are in the first registers, followed by the constants, then by the results of
//! steps. A step reads only registers written before it, and a register is reused once its value is no longer
//! needed.

use smallvec::SmallVec;

use super::number::{Number, Turn};
use super::operation::{Binary, Unary};
use super::{Outside, OutsideId};
use crate::function::build::MOST_ARGUMENTS;

/// Number of iterations after which a loop yields NaN: it would appear not to terminate.
pub(super) const MOST_TURNS: u32 = 10_000_000;

pub(super) type Register = u32;

/// One operation. `to` is the register of its result; the others are those of its operands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Step {
    Unary {
        operation: Unary,
        to: Register,
        a: Register,
    },
    Binary {
        operation: Binary,
        to: Register,
        a: Register,
        b: Register,
    },
    Choose {
        to: Register,
        condition: Register,
        then: Register,
        otherwise: Register,
    },
    /// Calls [`Outside`]; its arguments are `count` registers of the tape's list, from `first` on.
    Ask {
        id: OutsideId,
        to: Register,
        first: u32,
        count: u32,
    },
    Repeat(Repeat),
}

/// A sum or product: the following `body` steps run once for each value of the counter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Repeat {
    /// [`Binary::Add`] or [`Binary::Multiply`].
    pub operation: Binary,
    pub to: Register,
    pub counter: Register,
    pub from: Register,
    pub last: Register,
    pub value: Register,
    pub body: u32,
}

/// A function that maps numbers to a number.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    pub(super) parameters: u32,
    /// Constants, in the registers after the arguments.
    pub(super) constants: Vec<f64>,
    pub(super) registers: u32,
    pub(super) steps: Vec<Step>,
    /// The arguments of every [`Step::Ask`].
    pub(super) asked: Vec<Register>,
    pub(super) result: Register,
}

impl Function {
    /// Returns the number of arguments.
    pub fn parameters(&self) -> usize {
        self.parameters as usize
    }

    /// Returns the number of operations; those inside a loop count once.
    pub fn operations(&self) -> usize {
        self.steps.len()
    }

    /// Prepares it for evaluation at one point after another.
    pub fn run<N: Number>(&self) -> Run<'_, N> {
        let mut registers = SmallVec::from_elem(N::constant(0.0), self.registers as usize);
        for (register, constant) in registers[self.parameters()..].iter_mut().zip(&self.constants) {
            *register = N::constant(*constant);
        }
        Run { function: self, registers }
    }
}

/// A function and its registers.
#[derive(Debug, Clone)]
pub struct Run<'f, N> {
    function: &'f Function,
    /// Few functions need an allocation.
    registers: SmallVec<[N; 24]>,
}

impl<N: Number> Run<'_, N> {
    /// Returns the function's value; missing arguments are zero, and extra ones are ignored.
    pub fn at(&mut self, arguments: &[N], outside: &impl Outside) -> N {
        let parameters = self.function.parameters();
        for (index, register) in self.registers[..parameters].iter_mut().enumerate() {
            *register = arguments.get(index).copied().unwrap_or_else(|| N::constant(0.0));
        }
        self.steps(&self.function.steps, outside);
        self.registers[self.function.result as usize]
    }

    #[cfg(test)]
    pub(super) fn registers(&self) -> usize {
        self.registers.len()
    }

    fn steps(&mut self, steps: &[Step], outside: &impl Outside) {
        let mut at = 0;
        while let Some(step) = steps.get(at) {
            at += 1;
            match *step {
                Step::Unary { operation, to, a } => {
                    self.registers[to as usize] = N::unary(operation, self.read(a));
                }
                Step::Binary { operation, to, a, b } => {
                    self.registers[to as usize] = N::binary(operation, self.read(a), self.read(b));
                }
                Step::Choose { to, condition, then, otherwise } => {
                    self.registers[to as usize] =
                        N::choose(self.read(condition), self.read(then), self.read(otherwise));
                }
                Step::Ask { id, to, first, count } => {
                    let mut arguments = [N::constant(0.0); MOST_ARGUMENTS];
                    let asked = &self.function.asked[first as usize..][..count as usize];
                    for (argument, register) in arguments.iter_mut().zip(asked) {
                        *argument = self.read(*register);
                    }
                    self.registers[to as usize] = N::ask(outside, id, &arguments[..count as usize]);
                }
                Step::Repeat(repeat) => {
                    let (body, _) = steps[at..].split_at(repeat.body as usize);
                    self.registers[repeat.to as usize] = self.repeat(repeat, body, outside);
                    at += repeat.body as usize;
                }
            }
        }
    }

    fn repeat(&mut self, repeat: Repeat, body: &[Step], outside: &impl Outside) -> N {
        let undefined = N::constant(f64::NAN);
        let (mut counter, last) = (self.read(repeat.from), self.read(repeat.last));
        let mut total = N::constant(if repeat.operation == Binary::Add { 0.0 } else { 1.0 });
        for _ in 0..=MOST_TURNS {
            let counts = match N::turn(counter, last) {
                Turn::Again(counts) => counts,
                Turn::Done => return total,
                Turn::Unknown => return undefined,
            };
            self.registers[repeat.counter as usize] = counter;
            self.steps(body, outside);
            let next = N::binary(repeat.operation, total, self.read(repeat.value));
            total = N::choose(counts, next, total);
            counter = N::binary(Binary::Add, counter, N::constant(1.0));
        }
        undefined
    }

    #[inline]
    fn read(&self, register: Register) -> N {
        self.registers[register as usize]
    }
}
