//! Tape layout: selects the operations, their order and their registers.
//!
//! The order is a list of events. A register becomes free once its value is read for the last time; a value
//! from outside of a loop that is read inside lives until the loop ends.

use super::{Builder, Kind, Node};
use crate::function::tape::{Function, Register, Repeat, Step};

#[derive(Clone, Copy)]
enum Event {
    Run(Node),
    /// A loop reads its limits and starts counting; the events until it closes are its body.
    Open(Node),
    /// The value of an iteration is known; after the last one, so is the value of the loop.
    Close(Node),
}

/// Returns the tape that computes one node.
pub(super) fn lay_out(builder: &Builder, result: Node) -> Function {
    let reached = reached(builder, result);
    let mut events = Vec::new();
    arrange(builder, &reached, 0..builder.nodes.len(), 0, &mut events);
    let mut registers = Registers::settled(builder, &reached);
    let dying = dying(builder, &events, result);
    let (mut steps, mut asked) = (Vec::with_capacity(events.len()), Vec::new());
    let mut open = Vec::new();
    for (event, dying) in events.iter().zip(dying) {
        match *event {
            Event::Run(node) => {
                let step = registers.step(&builder.nodes[node.index()].kind, &mut asked);
                registers.release(&dying);
                steps.extend(step.map(|step| step.into(registers.take(node))));
            }
            Event::Open(node) => {
                let Kind::Loop { operation, counter, from, last, .. } = builder.kind(node) else {
                    continue;
                };
                let (from, last) = (registers.of(*from), registers.of(*last));
                registers.release(&dying);
                let counter = registers.take(*counter);
                open.push(steps.len());
                let (operation, to, value, body) = (*operation, 0, 0, 0);
                steps.push(Step::Repeat(Repeat {
                    operation,
                    to,
                    counter,
                    from,
                    last,
                    value,
                    body,
                }));
            }
            Event::Close(node) => {
                let Kind::Loop { value, .. } = builder.kind(node) else { continue };
                let value = registers.of(*value);
                registers.release(&dying);
                let to = registers.take(node);
                let Some(at) = open.pop() else { continue };
                let body = (steps.len() - at - 1) as u32;
                if let Step::Repeat(repeat) = &mut steps[at] {
                    *repeat = Repeat { to, value, body, ..*repeat };
                }
            }
        }
    }
    Function {
        parameters: builder.parameters,
        result: registers.of(result),
        registers: registers.count,
        constants: registers.constants,
        steps,
        asked,
    }
}

/// Returns, for each node, whether the result depends on it.
fn reached(builder: &Builder, result: Node) -> Vec<bool> {
    let mut reached = vec![false; builder.nodes.len()];
    reached[result.index()] = true;
    // Operands stand before what uses them.
    for index in (0..builder.nodes.len()).rev() {
        if reached[index] {
            builder.nodes[index].kind.operands(|operand| reached[operand.index()] = true);
        }
    }
    reached
}

/// Adds the events of one loop (home 0: of none), in order. Loops are nested at most [`super::DEEPEST_LOOP`]
/// deep, so recursion is safe.
fn arrange(
    builder: &Builder,
    reached: &[bool],
    nodes: std::ops::Range<usize>,
    home: u32,
    events: &mut Vec<Event>,
) {
    for index in nodes.filter(|index| reached[*index]) {
        let (built, node) = (&builder.nodes[index], Node(index as u32));
        if built.home() != home {
            continue;
        }
        match built.kind {
            Kind::Constant(_) | Kind::Parameter(_) | Kind::Counter(_) => {}
            Kind::Unary(..) | Kind::Binary(..) | Kind::Choose(..) | Kind::Ask(..) => {
                events.push(Event::Run(node));
            }
            Kind::Loop { counter, .. } => {
                events.push(Event::Open(node));
                let inner = builder.nodes[counter.index()].home();
                arrange(builder, reached, counter.index()..index, inner, events);
                events.push(Event::Close(node));
            }
        }
    }
}

/// Returns, for each event, the nodes that are read there for the last time.
fn dying(builder: &Builder, events: &[Event], result: Node) -> Vec<Vec<Node>> {
    let mut closes = vec![0; events.len()];
    let mut open = Vec::new();
    for (time, event) in events.iter().enumerate() {
        match event {
            Event::Run(_) => {}
            Event::Open(_) => open.push(time),
            Event::Close(_) => closes[open.pop().unwrap_or(time)] = time,
        }
    }
    // Parameters and constants are never made, and never die.
    let mut made = vec![None; builder.nodes.len()];
    let mut dies = vec![None; builder.nodes.len()];
    let mut open = Vec::new();
    for (time, event) in events.iter().enumerate() {
        let mut read = |node: Node, open: &[usize]| {
            if let Some(made) = made[node.index()] {
                let outermost = open.iter().find(|opened| **opened > made);
                dies[node.index()] = Some(outermost.map_or(time, |opened| closes[*opened]));
            }
        };
        match *event {
            Event::Run(node) => {
                builder.kind(node).operands(|operand| read(operand, &open));
                made[node.index()] = Some(time);
            }
            Event::Open(node) => {
                if let Kind::Loop { counter, from, last, .. } = *builder.kind(node) {
                    read(from, &open);
                    read(last, &open);
                    made[counter.index()] = Some(time);
                }
                open.push(time);
            }
            Event::Close(node) => {
                if let Kind::Loop { counter, value, .. } = *builder.kind(node) {
                    read(value, &open);
                    read(counter, &open);
                }
                open.pop();
                made[node.index()] = Some(time);
            }
        }
    }
    dies[result.index()] = None;
    let mut dying = vec![Vec::new(); events.len()];
    for (index, time) in dies.into_iter().enumerate() {
        if let Some(time) = time {
            dying[time].push(Node(index as u32));
        }
    }
    dying
}

/// Assigns registers to nodes.
struct Registers {
    of: Vec<Register>,
    constants: Vec<f64>,
    count: u32,
    free: Vec<Register>,
}

impl Registers {
    /// Parameters and constants keep their own registers throughout.
    fn settled(builder: &Builder, reached: &[bool]) -> Self {
        let mut of = vec![0; builder.nodes.len()];
        let mut constants = Vec::new();
        for (index, built) in builder.nodes.iter().enumerate() {
            match built.kind {
                Kind::Parameter(parameter) => of[index] = parameter,
                Kind::Constant(bits) if reached[index] => {
                    of[index] = builder.parameters + constants.len() as u32;
                    constants.push(f64::from_bits(bits));
                }
                _ => {}
            }
        }
        let count = builder.parameters + constants.len() as u32;
        Self { of, constants, count, free: Vec::new() }
    }

    fn of(&self, node: Node) -> Register {
        self.of[node.index()]
    }

    fn release(&mut self, nodes: &[Node]) {
        self.free.extend(nodes.iter().map(|node| self.of[node.index()]));
    }

    fn take(&mut self, node: Node) -> Register {
        let register = self.free.pop().unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        });
        self.of[node.index()] = register;
        register
    }

    /// Returns the step of an operation, without the register of its result.
    fn step(&self, kind: &Kind, asked: &mut Vec<Register>) -> Option<Step> {
        let to = 0;
        Some(match kind {
            Kind::Unary(operation, a) => Step::Unary { operation: *operation, to, a: self.of(*a) },
            Kind::Binary(operation, a, b) => {
                Step::Binary { operation: *operation, to, a: self.of(*a), b: self.of(*b) }
            }
            Kind::Choose(condition, then, otherwise) => Step::Choose {
                to,
                condition: self.of(*condition),
                then: self.of(*then),
                otherwise: self.of(*otherwise),
            },
            Kind::Ask(id, arguments) => {
                let (first, count) = (asked.len() as u32, arguments.len() as u32);
                asked.extend(arguments.iter().map(|argument| self.of(*argument)));
                Step::Ask { id: *id, to, first, count }
            }
            Kind::Constant(_) | Kind::Parameter(_) | Kind::Counter(_) | Kind::Loop { .. } => {
                return None;
            }
        })
    }
}

impl Step {
    fn into(mut self, register: Register) -> Self {
        match &mut self {
            Self::Unary { to, .. }
            | Self::Binary { to, .. }
            | Self::Choose { to, .. }
            | Self::Ask { to, .. } => *to = register,
            Self::Repeat(repeat) => repeat.to = register,
        }
        self
    }
}
