//! Builds tapes: folds constants, shares equal operations, and moves invariant operations out of loops.
//!
//! **Invariant:** a node's operands are built before it, so the build order is an execution order. A node
//! belongs to the innermost loop whose counter it depends on, wherever it was written.

use std::collections::HashMap;

use super::OutsideId;
use super::operation::{Binary, Unary};
use super::tape::{Function, Register, Step};

mod layout;

/// Maximum number of parameters of a function, and of arguments of a call (manual, section 3.3.1.8.3).
pub const MOST_ARGUMENTS: usize = 56;

/// Maximum nesting depth of loops (same section).
pub const DEEPEST_LOOP: usize = 56;

/// Maximum number of operations of a tape; those inside a loop count once.
pub const MOST_OPERATIONS: usize = 1_000_000;

/// The result of an operation, a parameter or a constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Node(u32);

/// Error: the function exceeds [`MOST_OPERATIONS`], [`MOST_ARGUMENTS`] or [`DEEPEST_LOOP`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooLong;

/// A loop under construction: what is built before [`Builder::close`] may use its counter.
#[derive(Debug)]
pub struct Loop {
    pub counter: Node,
    operation: Binary,
    from: Node,
    last: Node,
    /// Number of enclosing loops.
    depth: usize,
}

#[derive(Debug, Clone, PartialEq, Eq, Hash)]
enum Kind {
    /// The bits of the value: the two zeros are different constants.
    Constant(u64),
    Parameter(u32),
    /// Each loop has its own counter.
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
    /// Bit d is set if it depends on the counter of a loop with d enclosing loops.
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
    /// Starts a function with this number of parameters.
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

    /// Returns the parameter with this index.
    pub fn parameter(&self, index: usize) -> Option<Node> {
        (index < self.parameters as usize).then_some(Node(index as u32))
    }

    /// Returns whether `b` is the constant 0, and `a` is not a constant.
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

    /// Adds `condition ? then : otherwise`.
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

    /// Adds a call of something that is not arithmetic.
    pub fn ask(&mut self, id: OutsideId, arguments: &[Node]) -> Result<Node, TooLong> {
        if arguments.len() > MOST_ARGUMENTS {
            return Err(TooLong);
        }
        self.add(Kind::Ask(id, arguments.to_vec()))
    }

    /// Opens a sum ([`Binary::Add`]) or product over a counter that starts at `from` and increases by 1 until
    /// it exceeds `last`.
    pub fn open(&mut self, operation: Binary, from: Node, last: Node) -> Result<Loop, TooLong> {
        if self.depth >= DEEPEST_LOOP {
            return Err(TooLong);
        }
        let counter = self.add(Kind::Counter(self.nodes.len() as u32))?;
        let depth = self.depth;
        self.depth += 1;
        Ok(Loop { counter, operation, from, last, depth })
    }

    /// Closes the innermost loop; `value` is the value of an iteration.
    pub fn close(&mut self, open: Loop, value: Node) -> Result<Node, TooLong> {
        let Loop { counter, operation, from, last, depth } = open;
        self.depth = depth;
        self.add(Kind::Loop { operation, counter, from, last, value })
    }

    /// Inlines another function's operations with these arguments; returns its value.
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

    /// Returns the function whose value is this node.
    pub fn finish(self, result: Node) -> Function {
        layout::lay_out(&self, result)
    }

    fn kind(&self, node: Node) -> &Kind {
        &self.nodes[node.index()].kind
    }

    /// Returns the value of a node, if it is a constant.
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
    /// Depth of the innermost loop whose counter it needs: 0 if it needs none.
    fn home(&self) -> u32 {
        u64::BITS - self.needs.leading_zeros()
    }
}
