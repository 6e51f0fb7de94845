//! Calls of built-in functions, macros and user-defined functions, and the evaluation of their arguments.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Argument, Arguments, Callee, ExpressionId, ExpressionKind};
use crate::vocabulary::Word;

use super::builtin::{CallError, CallErrorKind};
use super::include::embedded;
use super::value::{Poison, Value};
use super::{Evaluator, Here, Outcome, Reported, builtin};

impl Evaluator<'_> {
    pub(super) fn call(
        &mut self,
        here: &Here,
        callee: Callee,
        arguments: Arguments,
        span: Span,
    ) -> Outcome<Value> {
        match callee {
            Callee::Word(word, word_span) => self.call_word(here, word, word_span, arguments, span),
            Callee::Element(id) => self.call_element(here, id, arguments, span),
            Callee::Name(name, name_span) => {
                let symbol = here.symbol(name);
                match self.scopes.read(symbol) {
                    None => {
                        let reported = self.undeclared(here, symbol, name_span);
                        self.run_arguments(here, arguments);
                        Err(reported)
                    }
                    Some(Value::Macro(id)) => {
                        let id = *id;
                        self.macro_value(here, id, arguments, span)
                    }
                    Some(Value::Function(id)) => {
                        let id = *id;
                        self.function_value(here, id, here.unit.ast.arguments(arguments), span)
                    }
                    Some(Value::Spline(spline)) => {
                        let spline = spline.clone();
                        self.spline_value(here, &spline, here.unit.ast.arguments(arguments), span)
                    }
                    Some(Value::Broken) => {
                        self.run_arguments(here, arguments);
                        Err(self.broken_call(here, symbol, arguments, span))
                    }
                    Some(Value::Poison(poison)) => {
                        let poison = *poison;
                        self.run_arguments(here, arguments);
                        let Reported = self.broken_call(here, symbol, arguments, span);
                        Ok(Value::Poison(poison))
                    }
                    Some(other) => {
                        let kind = other.kind();
                        let is_array = matches!(other, Value::Array(_));
                        let name = self.scopes.name(symbol).to_owned();
                        let mut diagnostic = Diagnostic::new(
                            Code::NotCallable,
                            format!("`{name}` is {kind}, and cannot be called"),
                        )
                        .at(name_span, "expected the name of a macro, a function or a spline");
                        let parentheses = Span { start: name_span.end, ..span };
                        if is_array && parentheses.start < parentheses.end {
                            diagnostic = Diagnostic::new(Code::NotCallable, diagnostic.message)
                                .at(parentheses, "an element is chosen by `[` and `]`")
                                .also(name_span, "this is the array");
                        }
                        if here.unit.ast.arguments(arguments).is_empty() && !is_array {
                            diagnostic =
                                diagnostic.help(format!("write `{name}`")).fix(parentheses, "");
                        }
                        if let Some(declared) = self.scopes.declared(symbol) {
                            diagnostic = diagnostic.also(declared.site.span, "declared here");
                        }
                        if is_array && let Some(element) = self.element_meant(span, name_span) {
                            let help = format!("an element of it: `{element}`");
                            diagnostic = diagnostic.help(help).fix(span, element);
                        }
                        Err(self.report(here, diagnostic))
                    }
                }
            }
        }
    }

    /// Calls a function or a spline stored in an array: `A[1](x, y, z)`.
    fn call_element(
        &mut self,
        here: &Here,
        id: ExpressionId,
        arguments: Arguments,
        span: Span,
    ) -> Outcome<Value> {
        let list = here.unit.ast.arguments(arguments);
        match self.expression(here, id) {
            Ok(Value::Function(function)) => self.function_value(here, function, list, span),
            Ok(Value::Spline(spline)) => self.spline_value(here, &spline, list, span),
            Ok(poison @ Value::Poison(_)) => {
                self.run_arguments(here, arguments);
                Ok(poison)
            }
            Ok(other) => {
                let element = here.unit.expression(id).span;
                let (kind, text) = (other.kind(), self.sources.text(element).to_owned());
                let message = format!("`{text}` is {kind}, and cannot be called");
                let diagnostic = Diagnostic::new(Code::NotCallable, message)
                    .at(element, "expected a function or a spline before `(`")
                    .help("is a comma missing before the parenthesis?")
                    .fix(element.after(), ", ");
                Err(self.report(here, diagnostic))
            }
            Err(reported) => {
                self.run_arguments(here, arguments);
                Err(reported)
            }
        }
    }

    /// Returns what `A(3)` or `A(I, J)` probably means, for an array `A`: `A[3]` or `A[I][J]`. `None` if there
    /// are no arguments, or one of them contains a bracket.
    fn element_meant(&self, call: Span, name: Span) -> Option<String> {
        let rest = self.sources.text(call).strip_prefix(self.sources.text(name))?.trim();
        let inside = rest.strip_prefix('(')?.strip_suffix(')')?;
        let plain = !inside.contains(['(', '[', '<']) && !inside.trim().is_empty();
        let indices: String =
            inside.split(',').map(|index| format!("[{}]", index.trim())).collect();
        plain.then(|| format!("{}{indices}", self.sources.text(name)))
    }

    /// Evaluates arguments for their side effects only (drawing from a random stream, setting a parameter).
    pub(super) fn run_arguments(&mut self, here: &Here, arguments: Arguments) {
        for argument in here.unit.ast.arguments(arguments) {
            match *argument {
                Argument::Expression(id) => {
                    if self.left_by_macro(here, id).is_none() {
                        drop(self.expression(here, id));
                    }
                }
                Argument::Items(items) => self.inside(here, items, Self::run_items),
            }
        }
    }

    fn call_word(
        &mut self,
        here: &Here,
        word: Word,
        word_span: Span,
        arguments: Arguments,
        span: Span,
    ) -> Outcome<Value> {
        let list = here.unit.ast.arguments(arguments);
        match word {
            Word::Defined => {
                // No keyword is a declared name.
                if let [Argument::Items(_)] = list {
                    return Ok(Value::truth(false));
                }
                let [Argument::Expression(id)] = list else {
                    return Err(self.wrong_arity(here, word, word_span, 1..=1, (list.len(), list)));
                };
                let name = match here.unit.expression(*id).kind {
                    ExpressionKind::Name(name) => name,
                    ExpressionKind::Index(..) => {
                        return Ok(Value::truth(self.is_set(here, *id)));
                    }
                    _ => return Ok(Value::truth(true)),
                };
                let symbol = here.symbol(name);
                self.scopes.mark_used(symbol);
                return Ok(Value::truth(self.is_known(symbol)));
            }
            Word::FileExists => {
                let [Argument::Expression(id)] = list else {
                    return Err(self.wrong_arity(here, word, word_span, 1..=1, (list.len(), list)));
                };
                let name = self.string(here, *id)?;
                let from = self.sources.get(word_span.file).name.clone();
                return Ok(Value::truth(
                    self.read_file(&name, &from).or_else(embedded(&name)).is_ok(),
                ));
            }
            Word::Dimensions | Word::DimensionSize => {
                return self.dimensions(here, word, word_span, list);
            }
            Word::MinExtent | Word::MaxExtent | Word::Inside | Word::Trace => {
                return self.probe(here, word, word_span, list);
            }
            Word::Sum | Word::Prod => {
                let (name, text) = (word.name(), self.sources.text(span).to_owned());
                let message = format!("`{name}` stands in a function only");
                let diagnostic = Diagnostic::new(Code::NotCallable, message)
                    .at(word_span, "no function is around it")
                    .help(format!(
                        "`#declare F = function {{ {text} }}`, then `F(0, 0, 0)`; or a `#for`"
                    ));
                return Err(self.report(here, diagnostic));
            }
            Word::Internal => {
                let message = "`internal(n)` is a whole function, and no number";
                let diagnostic = Diagnostic::new(Code::ExpectedExpression, message)
                    .at(span, "expected alone in the braces of a function")
                    .help("`#declare F = function { internal(57) }`, then `F(x, y, z)`");
                return Err(self.report(here, diagnostic));
            }
            Word::Xyz => {
                let message = "`xyz(i, j, k): number` is a term of a `polynomial`, and no number";
                let diagnostic = Diagnostic::new(Code::ExpectedExpression, message)
                    .at(span, "expected in the braces of a `polynomial`, after its order");
                return Err(self.report(here, diagnostic));
            }
            Word::Pwr | Word::Sqr => {
                let name = word.name();
                let message = format!("`{name}` is what a `julia_fractal` repeats, and no number");
                let diagnostic = Diagnostic::new(Code::ExpectedExpression, message)
                    .at(span, "expected in the braces of a `julia_fractal`")
                    .help("a power is `pow(a, b)`");
                return Err(self.report(here, diagnostic));
            }
            _ => {}
        }
        let Some(arity) = builtin::arity(word) else {
            self.run_arguments(here, arguments);
            return Ok(Value::Poison(Poison::new(word, here.site(word_span))));
        };
        let mut values = Vec::with_capacity(list.len());
        let mut failed = false;
        for argument in list {
            let left = match *argument {
                Argument::Expression(id) => match self.left_by_macro(here, id) {
                    Some(left) => left,
                    None => {
                        match self.argument_of_call(
                            here,
                            id,
                            builtin::wants_vector(word, values.len()),
                        ) {
                            Ok(value) => {
                                values.push(value);
                                continue;
                            }
                            Err(reported) => Err(reported),
                        }
                    }
                },
                Argument::Items(items) => {
                    self.inside(here, items, |evaluator| evaluator.values(here, span))
                }
            };
            match left {
                Ok(left) => values.extend(left),
                Err(Reported) => failed = true,
            }
        }
        let count = if failed { list.len() } else { values.len() };
        if !arity.contains(&count) {
            return Err(self.wrong_arity(here, word, word_span, arity, (count, list)));
        }
        if failed {
            return Err(Reported);
        }
        if let Some(poison) = values.iter().find(|value| matches!(value, Value::Poison(_))) {
            return Ok(poison.clone());
        }
        if let ([Argument::Expression(id)], [Value::Number(angle)]) = (list, &values[..]) {
            self.lint_trigonometry(here, word, *id, *angle);
        }
        let longest = usize::try_from(self.options.limits.string.saturating_mul(1 << 20))
            .unwrap_or(usize::MAX);
        let result = builtin::call(word, &values, &mut self.streams, longest);
        let rendered = self.unbounded_call(word, &values, &result);
        match (result, rendered) {
            (result, Some(value)) => {
                let error = result.err().unwrap_or_else(|| builtin::beyond_32_bits(word));
                if values.iter().all(Value::is_finite) {
                    let diagnostic = self.call_error(here, error, list, span);
                    self.opinion(here, diagnostic)?;
                }
                Ok(value)
            }
            (Ok(value), None) => Ok(value),
            // As at every limit, nothing further is evaluated.
            (Err(error), None) => {
                let too_long = error.kind == CallErrorKind::TooLong;
                let diagnostic = self.call_error(here, error, list, span);
                Err(match too_long {
                    true => self.halt(here.expansion, diagnostic),
                    false => self.report(here, diagnostic),
                })
            }
        }
    }

    /// Returns the diagnostic for a call of a built-in function without a value.
    fn call_error(
        &self,
        here: &Here,
        error: CallError,
        list: &[Argument],
        span: Span,
    ) -> Diagnostic {
        let at =
            error.argument.and_then(|index| list.get(index)).map_or(
                span,
                |argument| match *argument {
                    Argument::Expression(id) => here.unit.expression(id).span,
                    Argument::Items(_) => span,
                },
            );
        let too_long = error.kind == CallErrorKind::TooLong;
        let label = if too_long { "too much with this" } else { "expected another value" };
        let mut diagnostic = Diagnostic::new(error.kind.code(), error.message).at(at, label);
        // "`str(n, 0, -1)`", of what was given.
        let given = Some(self.sources.text(at)).filter(|text| at != span && text.len() < 30);
        diagnostic.help.extend(error.help.map(|help| match given {
            Some(given) => help.replace("str(n,", &format!("str({given},")),
            None => help,
        }));
        diagnostic
    }
}
