//! Macros: definition, calls and parameter passing.
//!
//! **Invariant:** as in POV-Ray, a lone name or an array element is passed by reference and everything else
//! by value. An optional parameter that a call omits, at the end or empty between commas, is undeclared in
//! the body (`optional` is from version 3.8; 3.7 has no such word).

use std::rc::Rc;

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{ExpansionId, ExpansionKind, ExpansionName, Span};
use crate::syntax::ast::{
    Argument, Arguments, Body, Callee, ExpressionId, ExpressionKind, Items, NameId, Parameter,
};

use crate::vocabulary::Word;

use super::arity::surplus;
use super::report::count;
use super::scope::{MacroId, Owner, Slot, Symbol};
use super::value::{Poison, Value};
use super::{Evaluator, Here, Limits, Outcome, Reported, Unit};

/// Maximum average number of brackets around each macro call in a chain of nested calls.
const MOST_AROUND: u64 = 10;

/// A macro definition.
#[derive(Debug)]
pub(super) struct Macro {
    pub name: Symbol,
    called: ExpansionName,
    /// Each parameter, and whether it is optional.
    pub parameters: Vec<(Symbol, bool)>,
    /// Number of leading parameters that no call may omit.
    required: usize,
    pub body: MacroBody,
    pub unit: Rc<Unit>,
    /// Span of the name in its definition.
    pub defined: Span,
}

#[derive(Debug, Clone, Copy)]
pub(super) enum MacroBody {
    Items(Items),
    /// Unparsed text: its brackets do not pair where they are written.
    Raw(Span),
}

impl Macro {
    /// Returns the body and the unit that contains it, if the body was parsed as items.
    pub fn parts(&self) -> Option<(&Rc<Unit>, Items)> {
        match self.body {
            MacroBody::Items(body) => Some((&self.unit, body)),
            MacroBody::Raw(_) => None,
        }
    }

    /// Returns the span of the body's items; `None` if it has none, or is unparsed.
    pub fn text(&self) -> Option<Span> {
        let MacroBody::Items(body) = self.body else { return None };
        match self.unit.ast.items(body) {
            [] => None,
            [first, .., last] | [first @ last] => Some(first.span.to(last.span)),
        }
    }
}

/// The binding of a parameter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bound {
    slot: Slot,
    /// Whether the slot is the parameter's own, not the caller's.
    own: bool,
}

impl Bound {
    const NOTHING: Self = Self { slot: Slot::NONE, own: false };
}

impl Evaluator<'_> {
    pub(super) fn define_macro(
        &mut self,
        here: &Here,
        (name, name_span, head): (NameId, Span, Span),
        parameters: &[Parameter],
        body: &Body,
    ) {
        let symbol = here.symbol(name);
        // Told already: its body would read the language's own word, or what no parameter gives.
        let is_word = |p: &Parameter| Word::from_name(here.unit.ast.name(p.name)).is_some();
        let lacks = parameters.is_empty() && self.lacks_parameters(name_span);
        let broken = lacks || parameters.iter().any(is_word);
        let id = MacroId(self.macros.len() as u32);
        self.lint_local_sum(here, parameters, body);
        let required = parameters.iter().rposition(|p| !p.optional).map_or(0, |last| last + 1);
        let parameters = parameters.iter().map(|p| (here.symbol(p.name), p.optional)).collect();
        self.macros.push(Rc::new(Macro {
            name: symbol,
            called: self.scene.expansions.named(self.scopes.name(symbol)),
            parameters,
            required,
            body: match body {
                Body::Items(items) => MacroBody::Items(*items),
                Body::Raw(span) => MacroBody::Raw(*span),
            },
            unit: here.unit.clone(),
            defined: name_span,
        }));
        let home = self.scopes.home(symbol, false);
        if let Some(held) = self.scopes.held_in(home, symbol)
            && !matches!(held, Value::Macro(_) | Value::Broken | Value::Poison(_))
        {
            let kind = held.kind();
            self.redeclared(here, (head, name_span), kind);
        }
        let owner = if self.in_main() { Owner::Main } else { Owner::Other };
        self.scopes.note_declaration(symbol, here.site(name_span), owner);
        self.scopes.assign(symbol, if broken { Value::Broken } else { Value::Macro(id) });
    }

    /// Runs a macro called as an item: its items come next. Returns `Ok(false)` if the expression is not such
    /// a call.
    #[inline(never)]
    pub(super) fn splices_macro(&mut self, here: &Here, id: ExpressionId) -> Outcome<bool> {
        let ExpressionKind::Call(Callee::Name(name, _), arguments) = here.unit.expression(id).kind
        else {
            return Ok(false);
        };
        let Some(Value::Macro(macro_id)) = self.scopes.read(here.symbol(name)) else {
            return Ok(false);
        };
        let span = here.unit.expression(id).span;
        let definition = self.macros[macro_id.0 as usize].clone();
        if !self.has_a_way(&definition) {
            // Its missing value is the mistake.
            return Ok(false);
        }
        let expansion = self.enter_macro(here, &definition, arguments, span)?;
        match self.body_of(&definition, expansion) {
            Ok((unit, body)) => {
                self.push_macro(&unit, expansion, body);
                Ok(true)
            }
            Err(reported) => {
                self.scopes.close();
                Err(reported)
            }
        }
    }

    /// Returns whether a frame runs the body of a macro that was called for its value.
    pub(super) fn is_body_of_macro(&self, frame: usize) -> bool {
        let frame = &self.frames[frame];
        self.macros.iter().any(|definition| match definition.body {
            MacroBody::Items(body) => {
                body.end == frame.end && Rc::ptr_eq(&definition.unit, &frame.here.unit)
            }
            MacroBody::Raw(_) => self.is_body_on_a_way(frame),
        })
    }

    /// Runs a macro called inside an expression, which leaves one value.
    pub(super) fn macro_value(
        &mut self,
        here: &Here,
        id: MacroId,
        arguments: Arguments,
        span: Span,
    ) -> Outcome<Value> {
        let lacking = || Ok(Value::Poison(Poison::new(Word::Macro, here.site(span))));
        self.read_macro(here, id, arguments, span, |evaluator| evaluator.only_value(here, span))
            .unwrap_or_else(lacking)
    }

    /// Reads what a macro leaves, which must not be empty. Returns `None` if its body cannot be read as
    /// values.
    pub(super) fn read_macro<T>(
        &mut self,
        here: &Here,
        id: MacroId,
        arguments: Arguments,
        span: Span,
        reader: impl FnOnce(&mut Self) -> Outcome<T>,
    ) -> Option<Outcome<T>> {
        let definition = self.macros[id.0 as usize].clone();
        if !self.has_a_way(&definition) {
            return None;
        }
        let expansion = match self.enter_macro(here, &definition, arguments, span) {
            Ok(expansion) => expansion,
            Err(reported) => return Some(Err(reported)),
        };
        self.macro_depth += 1;
        let value = self.body_of(&definition, expansion).and_then(|(unit, body)| {
            self.inside(&Here { unit, expansion }, body, |evaluator| match evaluator.peek() {
                None => Err(evaluator.leaves_no_value(expansion, "a value")),
                Some(_) => reader(evaluator),
            })
        });
        self.macro_depth -= 1;
        self.scopes.close();
        Some(value)
    }

    /// Evaluates the arguments, then opens the macro's table with its parameters bound.
    fn enter_macro(
        &mut self,
        here: &Here,
        definition: &Macro,
        arguments: Arguments,
        span: Span,
    ) -> Outcome<ExpansionId> {
        let list = match here.unit.ast.arguments(arguments) {
            // A call may end with a comma, as in POV-Ray.
            [all @ .., Argument::Items(last)]
                if last.is_empty() && all.len() == definition.parameters.len() =>
            {
                all
            }
            list => list,
        };
        let spread = match list.len() < definition.required {
            true => {
                self.spread(here, list, definition.required..=definition.parameters.len(), span)?
            }
            false => Vec::new(),
        };
        // With too many or too few, the body is read nevertheless, for its own mistakes.
        let wrong =
            spread.is_empty() && self.check_arguments(here, definition, list, span).is_err();
        if self.has_run_enough() {
            self.halted = true;
            return Err(Reported);
        }
        if self.macro_depth >= self.options.limits.macro_depth {
            let limit = self.options.limits.macro_depth;
            let message = format!("macros call each other more than {limit} deep");
            let help = "a recursion needs a condition that ends it, as `#if (N > 0) … #end`; `--limit macro-depth=N` raises the limit";
            return Err(self.too_many_calls(here, definition, span, message, help));
        }
        // The brackets around each nested call count too: all of them are waiting.
        let around = self.enclosures.len() as u64 + self.calculating;
        let Limits { nesting, macro_depth, .. } = self.options.limits;
        let most = u64::from(nesting) + MOST_AROUND * u64::from(macro_depth);
        if around > most {
            let message = format!("macros call each other inside of more than {most} brackets");
            let help = "a recursion needs a condition that ends it, as `#if (N > 0) … #end`; `--limit macro-depth=N` raises the limit, which is a multiple of it";
            return Err(self.too_many_calls(here, definition, span, message, help));
        }
        // Reused between calls; a nested call in an argument uses another buffer.
        let mut bound = std::mem::take(&mut self.bound);
        if wrong {
            // Which argument belongs to which parameter is unknown.
            self.run_arguments(here, arguments);
            let broken = || Bound { slot: self.scopes.keep(Value::Broken), own: true };
            bound.extend(std::iter::repeat_with(broken).take(definition.parameters.len()));
        }
        for (i, argument) in list.iter().enumerate().filter(|_| !wrong) {
            if let Some((_, values)) = spread.iter().find(|(at, _)| *at == i) {
                let keep =
                    |value: &Value| Bound { slot: self.scopes.keep(value.clone()), own: true };
                bound.extend(values.iter().map(keep));
            } else {
                let optional = definition.parameters[bound.len()].1;
                bound.push(self.bound(here, argument, optional, span));
            }
        }
        bound.resize(definition.parameters.len(), Bound::NOTHING);
        let expansion = self.scene.expansions.add(
            here.expansion,
            span,
            ExpansionKind::Macro,
            definition.called,
        );
        if wrong {
            self.wrong_calls.push(expansion);
        }
        let most = self.options.limits.loop_turns.saturating_mul(Limits::TOGETHER);
        if u64::from(expansion.0) > most {
            let message = format!("macros and includes have been called {most} times");
            let help = "`--limit loop-turns=N` raises the limit, which is a multiple of it";
            return Err(self.too_many_calls(here, definition, span, message, help));
        }
        self.scopes.open();
        for (&(parameter, _), &Bound { slot, own }) in definition.parameters.iter().zip(&bound) {
            self.scopes.bind(parameter, slot, own);
        }
        bound.clear();
        self.bound = bound;
        Ok(expansion)
    }

    /// Checks that there are as many arguments as parameters; optional ones may be omitted.
    fn check_arguments(
        &mut self,
        here: &Here,
        definition: &Macro,
        list: &[Argument],
        span: Span,
    ) -> Outcome<()> {
        let parameters = &definition.parameters;
        let wanted = definition.required..=parameters.len();
        let diagnostic = if !wanted.contains(&list.len()) {
            let name = self.scopes.name(definition.name);
            let wanted = count(&wanted, "argument");
            let message = format!("macro `{name}` takes {wanted}, and is given {}", list.len());
            // `#macro Ball(P, R = 1)`, which has been reported.
            if list.len() < definition.required && self.has_default(definition.defined) {
                return Err(Reported);
            }
            let more = list.get(parameters.len()..).and_then(|more| surplus(here, more));
            let at = more.unwrap_or_else(|| self.end_of_call(span));
            let told =
                Diagnostic::new(Code::WrongArity, message).at(at, format!("expected {wanted}"));
            // `Ball(0, 1, 2, 3)` with two parameters: a vector without its angle brackets.
            let vector = parameters
                .len()
                .checked_sub(1)
                .filter(|last| list.len() == last + 3)
                .and_then(|last| surplus(here, &list[last..]))
                .filter(|three| {
                    let parts = self.sources.text(*three).split(',').map(str::trim);
                    parts.clone().count() == 3
                        && parts.clone().all(|part| part.parse::<f64>().is_ok())
                });
            match vector {
                Some(three) => {
                    let right = format!("<{}>", self.sources.text(three));
                    told.help(format!("is `{right}` meant?")).fix(three, right)
                }
                None => told.help(format!("it is called as `{}`", self.form(definition))),
            }
        } else if let Some(empty) =
            list.iter().zip(parameters).position(|(argument, (_, optional))| {
                !optional && matches!(argument, Argument::Items(items) if items.is_empty())
            })
        {
            let name = self.scopes.name(definition.name);
            let parameter = self.scopes.name(parameters[empty].0);
            let message = format!("`{parameter}` of macro `{name}` is left empty");
            Diagnostic::new(Code::WrongArity, message)
                .at(
                    self.empty_argument(here, list, empty, span),
                    format!("expected a value for `{parameter}`"),
                )
                .help("only a parameter that is declared `optional` may be left out")
        } else {
            return Ok(());
        };
        Err(self.report(here, diagnostic.also(definition.defined, "defined here")))
    }

    /// Returns the form of a call of the macro: `Ball(Where, Radius)`.
    pub(super) fn form(&self, definition: &Macro) -> String {
        let name = self.scopes.name(definition.name);
        let parameters = definition.parameters.iter().map(|&(symbol, _)| self.scopes.name(symbol));
        format!("{name}({})", parameters.collect::<Vec<_>>().join(", "))
    }

    /// Binds an argument: a lone name or `A[i]` by reference, everything else by value.
    fn bound(&mut self, here: &Here, argument: &Argument, optional: bool, span: Span) -> Bound {
        let value = match *argument {
            Argument::Expression(id) => match here.unit.expression(id).kind {
                ExpressionKind::Name(name) => {
                    let symbol = here.symbol(name);
                    self.scopes.mark_used(symbol);
                    if let Some(slot) = self.scopes.slot(symbol) {
                        return Bound { slot, own: false };
                    }
                    if optional && self.scopes.is_left_out(symbol) {
                        return Bound::NOTHING;
                    }
                    self.expression(here, id)
                }
                ExpressionKind::Index(..) => match self.referred(here, id) {
                    Ok(Some((slot, indices))) => {
                        return Bound { slot: self.scopes.refer(slot, indices), own: true };
                    }
                    Ok(None) => self.expression(here, id),
                    Err(Reported) => Err(Reported),
                },
                _ => match self.plain_number(here, id) {
                    Some(number) => {
                        return Bound { slot: self.scopes.keep(Value::Number(number)), own: true };
                    }
                    None => self.any_value(here, id),
                },
            },
            Argument::Items(items) if items.is_empty() => return Bound::NOTHING,
            Argument::Items(items) => {
                self.inside(here, items, |evaluator| evaluator.only_value(here, span))
            }
        };
        Bound { slot: self.scopes.keep(value.unwrap_or(Value::Broken)), own: true }
    }
}
