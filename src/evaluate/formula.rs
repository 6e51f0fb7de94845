//! Compilation of a function's body from an expression to a tape.
//!
//! Subexpressions without parameters are evaluated once, by the rules of the language. The others become
//! operations by the rules of functions: comparisons are exact, and undefined results are NaN. **Invariant:**
//! one formula is compiled at a time, and knows only its parameters, its counters and the names declared at
//! its definition.
//!
//! **Source:** manual, section 3.3.1.8, with its list of what a function may contain. As an extension, `?:`,
//! components of vectors and built-in functions of constants are allowed.

use crate::diagnostic::{Code, Diagnostic};
use crate::function::{Binary, Builder, Function, Node, TooLong, Unary};
use crate::source::Span;
use crate::syntax::ast::{
    Argument, Arguments, BinaryOperator, Callee, Component, ExpressionId, ExpressionKind,
    UnaryOperator,
};
use crate::vocabulary::Word;

use super::continuation::holds_directive;
use super::function::{AuthorFunction, FunctionId, ParameterName, outside_id};
use super::value::{Poison, Value};
use super::{Evaluator, Here, Outcome, Reported, builtin};

mod argument;
mod mention;
mod operation;
mod refused;

use mention::mention;
pub(super) use operation::operation_of;
use operation::{is_operation, operation};

/// A formula during compilation.
pub(super) struct Formula {
    pub(super) builder: Builder,
    /// The names in scope, innermost last: counters of loops hide parameters.
    names: Vec<(ParameterName, Node)>,
    /// Set when part of the formula is unsupported.
    poison: Option<Poison>,
}

impl Formula {
    fn named(&self, name: ParameterName) -> Option<Node> {
        self.names.iter().rev().find(|(other, _)| *other == name).map(|(_, node)| *node)
    }
}

impl Evaluator<'_> {
    /// Compiles a body to a tape; poison if part of it is unsupported.
    pub(super) fn formula(
        &mut self,
        here: &Here,
        id: ExpressionId,
        parameters: &[ParameterName],
    ) -> Outcome<Result<Function, Poison>> {
        let span = here.unit.expression(id).span;
        let Ok(builder) = Builder::new(parameters.len()) else {
            return Err(self.too_long(here, span));
        };
        // Of parameters with the same name the first counts; of `x` and `u` the last (measured).
        let names = parameters.iter().enumerate().filter(|(at, name)| {
            !(matches!(name, ParameterName::Name(_)) && parameters[..*at].contains(name))
        });
        let names = names.filter_map(|(at, name)| Some((*name, builder.parameter(at)?))).collect();
        let mut formula = Formula { builder, names, poison: None };
        let result = self.joined_node(here, &mut formula, id)?;
        Ok(match formula.poison {
            Some(poison) => Err(poison),
            None => Ok(formula.builder.finish(result)),
        })
    }

    pub(super) fn built(
        &mut self,
        here: &Here,
        span: Span,
        built: Result<Node, TooLong>,
    ) -> Outcome<Node> {
        built.map_err(|TooLong| self.too_long(here, span))
    }

    pub(super) fn node(
        &mut self,
        here: &Here,
        formula: &mut Formula,
        id: ExpressionId,
    ) -> Outcome<Node> {
        // Nested brackets.
        stacker::maybe_grow(64 * 1024, 1024 * 1024, || self.node_of(here, formula, id))
    }

    fn node_of(&mut self, here: &Here, formula: &mut Formula, id: ExpressionId) -> Outcome<Node> {
        let expression = *here.unit.expression(id);
        let span = expression.span;
        match expression.kind {
            ExpressionKind::Name(name) => {
                let name = ParameterName::Name(here.symbol(name));
                match formula.named(name) {
                    Some(node) => Ok(node),
                    None => self.constant(here, formula, id),
                }
            }
            ExpressionKind::Word(Word::T) => Err(self.no_parameter(here, span)),
            ExpressionKind::Word(word) => match ParameterName::of_word(word) {
                Some(name) => formula.named(name).ok_or_else(|| self.no_parameter(here, span)),
                None => self.constant(here, formula, id),
            },
            ExpressionKind::Unary(operator, operand) => {
                let operand = self.node(here, formula, operand)?;
                let built = match operator {
                    UnaryOperator::Plus => return Ok(operand),
                    UnaryOperator::Minus => formula.builder.unary(Unary::Negate, operand),
                    UnaryOperator::Not => formula.builder.unary(Unary::Not, operand),
                };
                self.built(here, span, built)
            }
            ExpressionKind::Binary(..) => self.sum_node(here, formula, id),
            ExpressionKind::Conditional(condition, then, otherwise) => {
                let all = [condition, then, otherwise].map(|id| self.node(here, formula, id));
                let [Ok(condition), Ok(then), Ok(otherwise)] = all else { return Err(Reported) };
                self.built(here, span, formula.builder.choose(condition, then, otherwise))
            }
            ExpressionKind::Group(inner) => self.node(here, formula, inner),
            ExpressionKind::Call(callee, arguments) => {
                self.call_node(here, formula, id, callee, arguments)
            }
            ExpressionKind::Component(base, component) => {
                self.component_node(here, formula, id, base, component)
            }
            ExpressionKind::Missing => Err(Reported),
            ExpressionKind::Joint => self.expression(here, id).and(Err(Reported)),
            // `(x #if (A) + 1 #end)`
            ExpressionKind::GroupItems(items) if holds_directive(here, items) => {
                self.inside(here, items, |evaluator| evaluator.only_node(formula, (here, span)))
            }
            ExpressionKind::Number(_)
            | ExpressionKind::String
            | ExpressionKind::Vector(_)
            | ExpressionKind::Triple(_)
            | ExpressionKind::Index(..)
            | ExpressionKind::GroupItems(_) => self.constant(here, formula, id),
        }
    }

    /// Evaluates a constant subexpression once, by the rules of the language.
    fn constant(&mut self, here: &Here, formula: &mut Formula, id: ExpressionId) -> Outcome<Node> {
        let span = here.unit.expression(id).span;
        if let Some(parameter) = mention(here, formula, id) {
            if matches!(here.unit.expression(id).kind, ExpressionKind::Vector(_)) {
                let diagnostic = Diagnostic::new(
                    Code::WrongType,
                    "a function gives a number, and this is a vector",
                )
                .at(span, "expected a number")
                .help("a macro gives a vector: `#macro F(p) <p, 2*p, 0> #end`")
                .help("or a vector is made of functions: `<Fx(p), Fy(p), Fz(p)>`");
                return Err(self.report(here, diagnostic));
            }
            let text = self.sources.text(parameter).to_owned();
            if let ExpressionKind::Component(_, Component::Word(_, of) | Component::Name(_, of)) =
                here.unit.expression(id).kind
            {
                let component = self.sources.text(of);
                let message =
                    format!("`{text}` is a number here, and has no component `{component}`");
                let diagnostic = Diagnostic::new(Code::WrongType, message)
                    .at(parameter, "a parameter of the function")
                    .help("a function takes numbers: `function(x, y, z) { … }` is one of a place");
                return Err(self.report(here, diagnostic));
            }
            if let Some(reported) = self.length_of_parameters(here, id) {
                return Err(reported);
            }
            let message = format!("`{text}` has no value yet where the function is defined");
            let diagnostic = Diagnostic::new(Code::WrongType, message)
                .at(parameter, "a parameter of the function")
                .also(span, "this is evaluated once, when the function is defined");
            return Err(self.report(here, diagnostic));
        }
        let number = match self.expression(here, id)? {
            Value::Number(number) => number,
            Value::Poison(poison) => {
                formula.poison.get_or_insert(poison);
                0.0
            }
            other => {
                let help = matches!(other, Value::Vector(_) | Value::Color(_))
                    .then(|| "a function works on numbers: write a component, as `.x`".to_owned());
                return Err(self.wrong_type_with(here, span, "a number", &other, help));
            }
        };
        let built = formula.builder.constant(number);
        self.built(here, span, built)
    }

    /// Compiles a chain of operations iteratively, from the leftmost operand, however deeply they nest. Only
    /// in functions does `&` bind tighter than `|` (measured); elsewhere they have the same precedence.
    fn sum_node(&mut self, here: &Here, formula: &mut Formula, id: ExpressionId) -> Outcome<Node> {
        let (mut operations, mut first) = (Vec::new(), id);
        while let ExpressionKind::Binary(operator, left, right) = here.unit.expression(first).kind {
            operations.push((operator, right, here.unit.expression(first).span));
            first = left;
        }
        let mut node = self.node(here, formula, first);
        let mut either = None;
        for (operator, right, span) in operations.into_iter().rev() {
            // Both sides may report errors.
            let right = self.node(here, formula, right);
            if operator == BinaryOperator::Or {
                either = Some((self.either(here, formula, either, node), span));
                node = right;
                continue;
            }
            let (Ok(left), Ok(right)) = (node, right) else {
                node = Err(Reported);
                continue;
            };
            node = self.divides(here, formula, operator, [left, right], span).and_then(|()| {
                let built = operation_of(&mut formula.builder, operator, left, right);
                self.built(here, span, built)
            });
        }
        self.either(here, formula, either, node)
    }

    /// Compiles `last`, or its disjunction with the operands before it in a chain of `|`.
    fn either(
        &mut self,
        here: &Here,
        formula: &mut Formula,
        before: Option<(Outcome<Node>, Span)>,
        last: Outcome<Node>,
    ) -> Outcome<Node> {
        let Some((before, span)) = before else { return last };
        let built = formula.builder.binary(Binary::Or, before?, last?);
        self.built(here, span, built)
    }

    /// Compiles `F(x, y, z).red`; for other bases, evaluates the component now.
    fn component_node(
        &mut self,
        here: &Here,
        formula: &mut Formula,
        id: ExpressionId,
        base: ExpressionId,
        component: Component,
    ) -> Outcome<Node> {
        let ExpressionKind::Call(Callee::Name(name, _), arguments) =
            here.unit.expression(base).kind
        else {
            return self.constant(here, formula, id);
        };
        let span = here.unit.expression(base).span;
        let function = match self.scopes.read(here.symbol(name)) {
            Some(&Value::Function(function)) => function,
            Some(&Value::Poison(poison)) => {
                formula.poison.get_or_insert(poison);
                return self.constant_zero(here, formula, span);
            }
            Some(Value::Broken) => return Err(Reported),
            _ => return self.constant(here, formula, id),
        };
        let asked = &self.functions[function.0 as usize];
        let (wanted, index) = (asked.parameters(), asked.component(component));
        let Some(index) = index else {
            let text = self.sources.text(here.unit.expression(id).span).to_owned();
            let message = format!("`{text}`: this function's value has no such component");
            let diagnostic = Diagnostic::new(Code::WrongArity, message).at(span, "of this");
            return Err(self.report(here, diagnostic));
        };
        let nodes = self.argument_nodes(here, formula, arguments)?;
        let list = here.unit.ast.arguments(arguments);
        self.check_count(here, wanted, (nodes.len(), list), span)?;
        let built = match &self.functions[function.0 as usize] {
            AuthorFunction::Transform(functions) => formula.builder.call(&functions[index], &nodes),
            _ => formula.builder.ask(outside_id(function, index), &nodes),
        };
        self.built(here, span, built)
    }

    fn call_node(
        &mut self,
        here: &Here,
        formula: &mut Formula,
        id: ExpressionId,
        callee: Callee,
        arguments: Arguments,
    ) -> Outcome<Node> {
        match callee {
            Callee::Name(name, name_span) => match self.scopes.read(here.symbol(name)) {
                Some(&Value::Function(function)) => self.function_node(
                    here,
                    formula,
                    function,
                    arguments,
                    here.unit.expression(id).span,
                ),
                Some(Value::Poison(poison)) => {
                    formula.poison.get_or_insert(*poison);
                    let span = here.unit.expression(id).span;
                    let Reported = self.broken_call(here, here.symbol(name), arguments, span);
                    self.constant_zero(here, formula, name_span)
                }
                None => {
                    let reported = self.undeclared(here, here.symbol(name), name_span);
                    // Mistakes in its arguments are reported, too.
                    let _: Outcome<Vec<Node>> = self.argument_nodes(here, formula, arguments);
                    Err(reported)
                }
                Some(Value::Broken) => {
                    let _: Outcome<Vec<Node>> = self.argument_nodes(here, formula, arguments);
                    let span = here.unit.expression(id).span;
                    Err(self.broken_call(here, here.symbol(name), arguments, span))
                }
                _ => self.constant(here, formula, id),
            },
            Callee::Element(element) => match self.expression(here, element)? {
                Value::Function(function) => {
                    let span = here.unit.expression(id).span;
                    self.function_node(here, formula, function, arguments, span)
                }
                Value::Poison(poison) => {
                    formula.poison.get_or_insert(poison);
                    self.constant_zero(here, formula, here.unit.expression(element).span)
                }
                _ => self.constant(here, formula, id),
            },
            Callee::Word(word, word_span) => match word {
                Word::Sum | Word::Prod => self.loop_node(here, formula, word, word_span, arguments),
                Word::Rand | Word::Seed => Err(self.no_stream(here, word, word_span)),
                // Not a value in any position.
                Word::Pwr | Word::Sqr => self.expression(here, id).and(Err(Reported)),
                _ if is_operation(word) => {
                    self.operation_node(here, formula, word, word_span, arguments)
                }
                _ => self.constant(here, formula, id),
            },
        }
    }

    fn constant_zero(&mut self, here: &Here, formula: &mut Formula, span: Span) -> Outcome<Node> {
        let built = formula.builder.constant(0.0);
        self.built(here, span, built)
    }

    fn function_node(
        &mut self,
        here: &Here,
        formula: &mut Formula,
        function: FunctionId,
        arguments: Arguments,
        span: Span,
    ) -> Outcome<Node> {
        let nodes = self.argument_nodes(here, formula, arguments)?;
        let asked = &self.functions[function.0 as usize];
        let wanted = asked.parameters();
        if let Some(kind) = asked.compound() {
            let message = format!("this function gives {kind}, and a number is wanted");
            let part = if kind == "a colour" { ".red" } else { ".x" };
            let diagnostic = Diagnostic::new(Code::WrongType, message)
                .at(span, kind)
                .help(format!("write one of its components, as `{part}`"));
            return Err(self.report(here, diagnostic));
        }
        let list = here.unit.ast.arguments(arguments);
        self.check_count(here, wanted, (nodes.len(), list), span)?;
        let built = match &self.functions[function.0 as usize] {
            AuthorFunction::Formula(called) => formula.builder.call(called, &nodes),
            _ => formula.builder.ask(outside_id(function, 0), &nodes),
        };
        self.built(here, span, built)
    }

    /// Compiles `sum(i, 1, n, i * x)`.
    fn loop_node(
        &mut self,
        here: &Here,
        formula: &mut Formula,
        word: Word,
        word_span: Span,
        arguments: Arguments,
    ) -> Outcome<Node> {
        let unit = here.unit.clone();
        let list = unit.ast.arguments(arguments);
        let [
            Argument::Expression(counter),
            Argument::Expression(from),
            Argument::Expression(to),
            Argument::Expression(turn),
        ] = *list
        else {
            return Err(self.wrong_arity(here, word, word_span, 4..=4, (list.len(), list)));
        };
        let ExpressionKind::Name(counter) = unit.expression(counter).kind else {
            let message =
                format!("the first argument of `{}` is the name of its counter", word.name());
            let diagnostic = Diagnostic::new(Code::ExpectedExpression, message)
                .at(unit.expression(counter).span, "expected a name");
            return Err(self.report(here, diagnostic));
        };
        let from = self.node(here, formula, from)?;
        let to = self.node(here, formula, to)?;
        let operation = if word == Word::Sum { Binary::Add } else { Binary::Multiply };
        let Ok(open) = formula.builder.open(operation, from, to) else {
            return Err(self.too_long(here, word_span));
        };
        formula.names.push((ParameterName::Name(here.symbol(counter)), open.counter));
        let turn = self.node(here, formula, turn);
        formula.names.pop();
        self.built(here, word_span, formula.builder.close(open, turn?))
    }

    fn operation_node(
        &mut self,
        here: &Here,
        formula: &mut Formula,
        word: Word,
        word_span: Span,
        arguments: Arguments,
    ) -> Outcome<Node> {
        let nodes = self.argument_nodes(here, formula, arguments)?;
        let arity = builtin::arity(word).filter(|arity| !arity.contains(&nodes.len()));
        if let Some(arity) = arity {
            let list = here.unit.ast.arguments(arguments);
            return Err(self.wrong_arity(here, word, word_span, arity, (nodes.len(), list)));
        }
        self.built(here, word_span, operation(&mut formula.builder, word, &nodes))
    }
}
