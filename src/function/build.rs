//! Building a tape: constants folded, equal operations shared, loops left with what needs them.
//!
//! **Invariant:** a node's operands were built before it, so the order of building is an order of
//! running. A node belongs to the innermost loop on whose counter it depends, wherever it was
//! written.

use std::collections::HashMap;

use super::OutsideId;
use super::operation::{Binary, Unary};
use super::tape::{Function, Register, Step};

mod layout;

/// A function has no more parameters, and asks with no more arguments (manual, section 3.3.1.8.3).
pub const MOST_ARGUMENTS: usize = 56;

/// No more loops stand inside one another (the same section).
pub const DEEPEST_LOOP: usize = 56;

/// A tape has no more operations, those inside a loop counted once.
pub const MOST_OPERATIONS: usize = 1_000_000;

/// The result of an operation, or what it starts from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Node(u32);

/// The function has more than [`MOST_OPERATIONS`], [`MOST_ARGUMENTS`] or [`DEEPEST_LOOP`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooLong;

/// A loop that is being built: what is built until [`Builder::close`] may use its counter.
#[derive(Debug)]
pub struct Loop {
    pub counter: Node,
    operation: Binary,
    from: Node,
    last: Node,
    /// How many loops it stands in.
    depth: usize,
}

#[derive(Debug, Clone, PartialEq, Eq, Hash)]
enum Kind {
    /// Its bits: two zeros are two constants.
    Constant(u64),
    Parameter(u32),
    /// Each loop has a counter of its own.
    Counter(u32),
    Unary(Unary, Node),
    Binary(Binary, Node, Node),
    Choose(Node, Node, Node),
    Ask(OutsideId, Vec<Node>),
    Loop {
        operation: Binary,
        counter: Node,
        from: Node,
        last: Node,
        value: Node,
    },
}

#[derive(Debug)]
struct Built {
    kind: Kind,
    /// Bit d: it depends on the counter of a loop that stands in d others.
    needs: u64,
}

/// Builds one function, operands first.
#[derive(Debug)]
pub struct Builder {
    parameters: u32,
    nodes: Vec<Built>,
    known: HashMap<Kind, Node>,
    depth: usize,
}

impl Builder {
    /// A function of so many parameters.
    pub fn new(parameters: usize) -> Result<Self, TooLong> {
        if parameters > MOST_ARGUMENTS {
            return Err(TooLong);
        }
        let mut builder =
            Self { parameters: 0, nodes: Vec::new(), known: HashMap::new(), depth: 0 };
        for index in 0..parameters as u32 {
            builder.add(Kind::Parameter(index))?;
        }
        builder.parameters = parameters as u32;
        Ok(builder)
    }

    /// The parameter of this index.
    pub fn parameter(&self, index: usize) -> Option<Node> {
        (index < self.parameters as usize).then_some(Node(index as u32))
    }

    /// Whether `b` is the number 0, and `a` no number that is known.
    pub fn divides_by_zero(&self, a: Node, b: Node) -> bool {
        self.value(a).is_none() && self.value(b) == Some(0.0)
    }

    pub fn constant(&mut self, value: f64) -> Result<Node, TooLong> {
        self.add(Kind::Constant(value.to_bits()))
    }

    pub fn unary(&mut self, operation: Unary, a: Node) -> Result<Node, TooLong> {
        match self.value(a) {
            Some(value) => self.constant(operation.of(value)),
            None => self.add(Kind::Unary(operation, a)),
        }
    }

    pub fn binary(&mut self, operation: Binary, a: Node, b: Node) -> Result<Node, TooLong> {
        match (operation, self.value(a), self.value(b)) {
            (_, Some(x), Some(y)) => self.constant(operation.of(x, y)),
            // What changes no bit of a number.
            (Binary::Multiply | Binary::Divide | Binary::Pow, _, Some(1.0)) => Ok(a),
            (Binary::Multiply, Some(1.0), _) => Ok(b),
            (Binary::Subtract, _, Some(zero)) if zero.to_bits() == 0 => Ok(a),
            (Binary::Pow, _, Some(2.0)) => self.unary(Unary::Square, a),
            (Binary::Multiply, ..) if a == b => self.unary(Unary::Square, a),
            _ => {
                let swap = operation.commutes() && b < a;
                let (a, b) = if swap { (b, a) } else { (a, b) };
                self.add(Kind::Binary(operation, a, b))
            }
        }
    }

    /// `condition ? then : otherwise`.
    pub fn choose(
        &mut self,
        condition: Node,
        then: Node,
        otherwise: Node,
    ) -> Result<Node, TooLong> {
        match self.value(condition) {
            Some(0.0) => Ok(otherwise),
            Some(_) => Ok(then),
            None if then == otherwise => Ok(then),
            None => self.add(Kind::Choose(condition, then, otherwise)),
        }
    }

    /// The value of something that is no arithmetic.
    pub fn ask(&mut self, id: OutsideId, arguments: &[Node]) -> Result<Node, TooLong> {
        if arguments.len() > MOST_ARGUMENTS {
            return Err(TooLong);
        }
        self.add(Kind::Ask(id, arguments.to_vec()))
    }

    /// Opens a sum ([`Binary::Add`]) or product over a counter from `from`, by ones, while it is not
    /// past `last`.
    pub fn open(&mut self, operation: Binary, from: Node, last: Node) -> Result<Loop, TooLong> {
        if self.depth >= DEEPEST_LOOP {
            return Err(TooLong);
        }
        let counter = self.add(Kind::Counter(self.nodes.len() as u32))?;
        let depth = self.depth;
        self.depth += 1;
        Ok(Loop { counter, operation, from, last, depth })
    }

    /// Closes the innermost loop, whose turns have this value.
    pub fn close(&mut self, open: Loop, value: Node) -> Result<Node, TooLong> {
        let Loop { counter, operation, from, last, depth } = open;
        self.depth = depth;
        self.add(Kind::Loop { operation, counter, from, last, value })
    }

    /// Another function's value at these arguments; its operations become this one's.
    pub fn call(&mut self, function: &Function, arguments: &[Node]) -> Result<Node, TooLong> {
        let zero = self.constant(0.0)?;
        let mut registers = vec![zero; function.registers as usize];
        for (register, argument) in registers[..function.parameters()].iter_mut().zip(arguments) {
            *register = *argument;
        }
        for (index, value) in function.constants.iter().enumerate() {
            registers[function.parameters() + index] = self.constant(*value)?;
        }
        self.replay(function, &function.steps, &mut registers)?;
        Ok(registers[function.result as usize])
    }

    fn replay(
        &mut self,
        function: &Function,
        steps: &[Step],
        registers: &mut [Node],
    ) -> Result<(), TooLong> {
        let mut at = 0;
        while let Some(step) = steps.get(at) {
            at += 1;
            let read = |register: Register| registers[register as usize];
            let (to, node) = match *step {
                Step::Unary { operation, to, a } => (to, self.unary(operation, read(a))?),
                Step::Binary { operation, to, a, b } => {
                    (to, self.binary(operation, read(a), read(b))?)
                }
                Step::Choose { to, condition, then, otherwise } => {
                    (to, self.choose(read(condition), read(then), read(otherwise))?)
                }
                Step::Ask { id, to, first, count } => {
                    let asked = &function.asked[first as usize..][..count as usize];
                    let arguments: Vec<Node> =
                        asked.iter().map(|register| read(*register)).collect();
                    (to, self.ask(id, &arguments)?)
                }
                Step::Repeat(repeat) => {
                    let open = self.open(repeat.operation, read(repeat.from), read(repeat.last))?;
                    registers[repeat.counter as usize] = open.counter;
                    let body = &steps[at..][..repeat.body as usize];
                    self.replay(function, body, registers)?;
                    at += repeat.body as usize;
                    (repeat.to, self.close(open, registers[repeat.value as usize])?)
                }
            };
            registers[to as usize] = node;
        }
        Ok(())
    }

    /// The function whose value is this node's.
    pub fn finish(self, result: Node) -> Function {
        layout::lay_out(&self, result)
    }

    fn kind(&self, node: Node) -> &Kind {
        &self.nodes[node.index()].kind
    }

    /// What a node is, if it is a constant.
    fn value(&self, node: Node) -> Option<f64> {
        match *self.kind(node) {
            Kind::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    fn add(&mut self, kind: Kind) -> Result<Node, TooLong> {
        if let Some(node) = self.known.get(&kind) {
            return Ok(*node);
        }
        if self.nodes.len() >= MOST_OPERATIONS {
            return Err(TooLong);
        }
        let mut needs = 0;
        kind.operands(|operand| needs |= self.nodes[operand.index()].needs);
        match kind {
            Kind::Counter(_) => needs = 1 << self.depth,
            Kind::Loop { .. } => needs &= !(1 << self.depth),
            _ => {}
        }
        let node = Node(self.nodes.len() as u32);
        self.nodes.push(Built { kind: kind.clone(), needs });
        self.known.insert(kind, node);
        Ok(node)
    }
}

impl Node {
    fn index(self) -> usize {
        self.0 as usize
    }
}

impl Kind {
    fn operands(&self, mut each: impl FnMut(Node)) {
        match self {
            Self::Constant(_) | Self::Parameter(_) | Self::Counter(_) => {}
            Self::Unary(_, a) => each(*a),
            Self::Binary(_, a, b) => [*a, *b].into_iter().for_each(each),
            Self::Choose(condition, then, otherwise) => {
                [*condition, *then, *otherwise].into_iter().for_each(each);
            }
            Self::Ask(_, arguments) => arguments.iter().copied().for_each(each),
            Self::Loop { counter, from, last, value, .. } => {
                [*counter, *from, *last, *value].into_iter().for_each(each);
            }
        }
    }
}

impl Built {
    /// How many loops stand around the innermost whose counter it needs, and that one: 0 outside all.
    fn home(&self) -> u32 {
        u64::BITS - self.needs.leading_zeros()
    }
}
