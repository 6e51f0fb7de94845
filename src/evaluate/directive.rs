//! Directives, run at their position between two items of the current consumer.

use crate::diagnostic::{Code, Diagnostic, Severity};
use crate::source::{FileId, Span};
use crate::syntax::ast::{
    DirectiveId, DirectiveKind, ExpressionId, ExpressionKind, Item, ItemKind, Items, Target, Test,
};
use crate::vocabulary::{Family, Word};

use super::branch::is_bracket;
use super::scope::{Owner, Symbol};
use super::stream::{Hold, Token, TokenKind};
use super::value::Value;
use super::{Evaluator, Here, Outcome, Reported};

impl Evaluator<'_> {
    // Apart from the loop that asks for items: what each of these needs would be made ready for every item.
    #[inline(never)]
    pub(super) fn directive(&mut self, here: &Here, id: DirectiveId) -> Outcome<()> {
        let directive = here.unit.ast.directive(id);
        match &directive.kind {
            DirectiveKind::Declare { local, target } => {
                self.declare(here, directive.head, *local, target)
            }
            DirectiveKind::Undef(target) => {
                let symbol = here.symbol(target.name);
                self.scopes.mark_used(symbol);
                if !target.indices.is_empty() {
                    return self.forget_element(here, target);
                }
                if self.scopes.undefine(symbol) {
                    self.scopes.note_undone(symbol, here.site(target.span));
                }
                Ok(())
            }
            DirectiveKind::If { test, then, otherwise } => {
                let taken = match test {
                    Test::Condition(condition) => match self.asked_condition(here, *condition) {
                        // `#if (Broken) merge { #else union { #end`: one of the branches opens it.
                        Err(reported)
                            if is_bracket(here, *then) && is_bracket(here, *otherwise) =>
                        {
                            self.push_branch(here, *then);
                            return Err(reported);
                        }
                        Err(reported) => {
                            self.run_neither(here, *then, *otherwise);
                            return Err(reported);
                        }
                        condition => condition?,
                    },
                    Test::Defined(target) => self.is_defined(here, target),
                    Test::NotDefined(target) => !self.is_defined(here, target),
                };
                self.note_asked(here, id, taken);
                self.push_branch(here, if taken { *then } else { *otherwise });
                Ok(())
            }
            DirectiveKind::While { condition, body } => {
                self.lint_condition(here, *condition);
                self.push_while(here, *condition, *body, id);
                Ok(())
            }
            DirectiveKind::For { name, from, to, step, body, name_span } => {
                let spans = [*from, *to].map(|id| here.unit.expression(id).span);
                let from = self.number(here, *from);
                let to = self.number(here, *to);
                let (step_value, step_span) = match step {
                    Some(step) => (self.number(here, *step), here.unit.expression(*step).span),
                    None => (Ok(1.0), directive.head),
                };
                let symbol = here.symbol(*name);
                let (Ok(from), Ok(to), Ok(step)) = (from, to, step_value) else {
                    // The number of turns is unknown: the body is read once, for its own mistakes.
                    self.scopes.note_declaration(symbol, here.site(*name_span), Owner::Other);
                    self.scopes.assign_local(symbol, Value::Number(from.unwrap_or(0.0)));
                    self.push_switch(here, *body);
                    self.undecided = true;
                    return Err(Reported);
                };
                if step == 0.0 {
                    let diagnostic = Diagnostic::new(
                        Code::OutOfRange,
                        "the step of a `#for` is zero, so it never ends",
                    )
                    .at(step_span, "expected a number other than zero");
                    return Err(self.report(here, diagnostic));
                }
                let named =
                    self.sources.text(*name_span).starts_with(|c: char| !c.is_ascii_digit());
                if (to - from) * step < 0.0 && named {
                    let own = (step_span != directive.head).then_some(step_span);
                    self.lint_never_runs(here, directive.head, spans, own);
                }
                self.lint_counted_twice(here, *name, *body);
                self.scopes.note_declaration(symbol, here.site(*name_span), Owner::Other);
                self.push_for(here, symbol, [from, to, step], *body, id);
                Ok(())
            }
            DirectiveKind::Switch { value, lead, cases } => {
                self.tell_case_lacking(here, *lead, cases, directive.head);
                let value = self.number(here, *value);
                let chosen = match value.and_then(|value| self.chosen_case(here, value, cases)) {
                    Ok(chosen) => chosen.unwrap_or(cases.len()),
                    Err(reported) => {
                        // The intended case is unknown.
                        for case in cases {
                            self.declare_broken(here, case.body);
                        }
                        return Err(reported);
                    }
                };
                self.lint_runs_on(here, &cases[chosen..]);
                self.push_switch(here, Items::default());
                for case in cases[chosen..].iter().rev() {
                    self.push_branch(here, case.body);
                }
                self.push_branch(here, *lead);
                Ok(())
            }
            DirectiveKind::Break => {
                if self.break_out() {
                    return Ok(());
                }
                let diagnostic = Diagnostic::new(
                    Code::StrayDirective,
                    "`#break` stands outside of any loop or `#switch`",
                )
                .at(directive.head, "nothing to break out of");
                Err(self.report(here, diagnostic))
            }
            DirectiveKind::Macro { name, name_span, parameters, body } => {
                self.define_macro(here, (*name, *name_span, directive.head), parameters, body);
                Ok(())
            }
            DirectiveKind::Include(file) => self.include(here, *file, directive.head),
            DirectiveKind::Default(items) => self.inside(here, *items, |evaluator| {
                evaluator.default_items();
                Ok(())
            }),
            DirectiveKind::Version(version) => {
                self.has_version = true;
                self.says_version |= self.in_main();
                self.version = self.number(here, *version)?;
                self.default_noise();
                self.end_of_version(here, *version);
                self.check_version(here, here.unit.expression(*version).span)
            }
            DirectiveKind::Debug(text) => self.say(here, Code::AuthorDebug, *text, directive.head),
            DirectiveKind::Warning(text) => {
                self.say(here, Code::AuthorWarning, *text, directive.head)
            }
            DirectiveKind::Error(text) => {
                // After an error it is probably a consequence: the rest is read for its own mistakes.
                let goes_on = self.diagnostics.has_errors();
                let said = self.say(here, Code::AuthorError, *text, directive.head);
                self.halted = !goes_on;
                said
            }
            DirectiveKind::Fopen { name, name_span, file, mode } => {
                self.open_file(here, (*name, *name_span), *file, *mode)
            }
            DirectiveKind::Read { name, name_span, targets } => {
                self.read_values(here, (*name, *name_span), targets)
            }
            DirectiveKind::Write { name, name_span, arguments } => {
                self.write_values(here, (*name, *name_span), *arguments)
            }
            DirectiveKind::Fclose { name, name_span } => {
                self.close_file(here, (*name, *name_span));
                Ok(())
            }
            DirectiveKind::OldStream(text) => {
                let word = self.sources.text(directive.head).to_owned();
                let message = format!("`{word}` writes to a stream that is gone");
                let diagnostic = Diagnostic::new(Code::LegacyForm, message)
                    .at(directive.head, "an old form")
                    .help("write `#debug`")
                    .fix(directive.head, "#debug");
                self.report(here, diagnostic);
                self.say(here, Code::AuthorDebug, *text, directive.head)
            }
            DirectiveKind::Unread => {
                self.run_unread(here, directive.head);
                Ok(())
            }
            DirectiveKind::Malformed => Err(Reported),
        }
    }

    /// Reports a `#version` newer than any release, which POV-Ray refuses as well, and warns of one newer
    /// than the language implemented here.
    fn check_version(&mut self, here: &Here, span: Span) -> Outcome<()> {
        /// Newest version of POV-Ray.
        const NEWEST: f64 = 3.8;
        /// The version whose language is implemented.
        const BUILT: f64 = 3.7;
        if self.version <= NEWEST {
            // Includes save the scene's version, and set it again.
            if self.version > BUILT && !std::mem::replace(&mut self.warned_of_version, true) {
                let message = format!("version {} is newer than the language here", self.version);
                let diagnostic = Diagnostic::new(Code::OldVersion, message)
                    .at(span, format!("it is that of {BUILT}, with few words of what comes"))
                    .help(format!("write `#version {BUILT};`"));
                // Nobody edits an installed file.
                let diagnostic = match span.file == FileId(0) {
                    true => diagnostic.fix(span, BUILT.to_string()),
                    false => diagnostic,
                };
                self.report(here, diagnostic);
            }
            return Ok(());
        }
        let message = format!("there is no version {} of POV-Ray", self.version);
        let diagnostic = Diagnostic::new(Code::OutOfRange, message)
            .at(span, format!("the newest is {NEWEST}"))
            .help("write `#version 3.7;`");
        Err(self.report(here, diagnostic))
    }

    fn say(&mut self, here: &Here, code: Code, text: ExpressionId, head: Span) -> Outcome<()> {
        if let Some(reported) = self.lacks_quotes(here, text) {
            return Err(reported);
        }
        let text = match self.expression(here, text)? {
            Value::String(text) => text,
            // The author's own messages are not suppressed.
            Value::Poison(poison) => return Err(self.not_supported(poison, Some(head))),
            other => {
                let span = here.unit.expression(text).span;
                let help = matches!(other, Value::Number(_))
                    .then(|| "a number becomes a string by `str(n, 0, -1)`".to_owned());
                return Err(self.wrong_type_with(here, span, "a string", &other, help));
            }
        };
        let label = match code.severity() {
            Severity::Error => "the scene stops itself here",
            Severity::Warning | Severity::Note => "said here",
        };
        // A message may be one of several pieces of a line.
        let said = match code.severity() {
            Severity::Note => &*text,
            Severity::Error | Severity::Warning => text.trim_end_matches('\n'),
        };
        let diagnostic = Diagnostic::new(code, said).at(head, label);
        self.report(here, diagnostic);
        Ok(())
    }

    fn is_defined(&mut self, here: &Here, target: &Target) -> bool {
        let symbol = here.symbol(target.name);
        self.scopes.mark_used(symbol);
        if !target.indices.is_empty() {
            return self.is_element_set(here, target);
        }
        self.is_known(symbol)
    }

    /// Returns whether `defined` and `#ifdef` hold for a name. They do not for a file that is closed or read
    /// to its end.
    pub(super) fn is_known(&mut self, symbol: Symbol) -> bool {
        match self.scopes.read(symbol) {
            Some(Value::Broken) | None => false,
            Some(Value::File(handle)) => {
                let handle = *handle;
                self.is_open(handle)
            }
            Some(_) => true,
        }
    }

    /// Runs `#declare Name = …`, whose value is what the next items leave.
    fn declare(&mut self, here: &Here, head: Span, local: bool, target: &Target) -> Outcome<()> {
        let symbol = here.symbol(target.name);
        let (home, in_main) = (self.scopes.home(symbol, local), self.in_main());
        if !target.indices.is_empty() {
            let indices = self.target_indices(here, target);
            let value = self.declared_value(here, head, target);
            return self.assign_element(here, target, indices, value);
        }
        self.broken_function = None;
        self.declared_now.push(symbol);
        let value = self.declared_value(here, head, target);
        self.declared_now.pop();
        self.note_broken(symbol, matches!(value, Err(Reported) | Ok(Value::Poison(_))));
        if let Some(held @ (Value::Function(_) | Value::Macro(_))) =
            self.scopes.held_in(home, symbol)
        {
            let kind = held.kind();
            self.redeclared(here, (head, target.span), kind);
        }
        if home == 0 && self.scopes.take_unread(symbol) {
            self.lint_replaced_option(here, target);
        }
        let owner = match in_main {
            true => Owner::Main,
            false if local && self.in_macro_of_main(here) => Owner::Macro,
            false => Owner::Other,
        };
        self.scopes.note_declaration(symbol, here.site(target.span), owner);
        self.scopes.assign_in(home, symbol, value.unwrap_or(Value::Broken));
        Ok(())
    }

    /// Reports a redeclaration that POV-Ray refuses: another kind of value for the name of a function or a
    /// macro, or a macro for the name of a value. The new one is used.
    pub(super) fn redeclared(&mut self, here: &Here, (head, span): (Span, Span), kind: &str) {
        let name = self.sources.text(span).to_owned();
        let before = Span { end: head.start, ..head };
        let message = format!("`{name}` is {kind}, and is declared again");
        let mut diagnostic = Diagnostic::new(Code::RedeclaredFunction, message)
            .at(span, "the name is taken")
            .help(format!("take it back first: `#undef {name}`; or choose another name"))
            .fix(before, format!("#undef {name}\n"));
        let declared = self.scopes.symbol(&name).and_then(|symbol| self.scopes.declared(symbol));
        if let Some(declared) = declared.map(|declared| declared.site.span)
            && declared != span
        {
            diagnostic = diagnostic.also(declared, "declared here");
        }
        self.report(here, diagnostic);
    }

    /// Returns the value that the next items leave. Another `#declare` may precede the first of them,
    /// recursively, bounded only by a limit.
    fn declared_value(&mut self, here: &Here, head: Span, target: &Target) -> Outcome<Value> {
        let limit = self.options.limits.macro_depth;
        // A macro that supplies the value may declare names, and call itself for it.
        if self.declaring >= limit.saturating_add(self.macro_depth) {
            let message = format!("values of `#declare` are nested more than {limit} deep");
            let diagnostic = Diagnostic::new(Code::NestingLimit, message)
                .at(target.span, "reading stops here")
                .help("`--limit macro-depth=N` raises the limit");
            return Err(self.halt(here.expansion, diagnostic));
        }
        if let Some(number) = self.plain_value(here) {
            return Ok(Value::Number(number));
        }
        let (outer_poison, outer_hold) = (self.poison.take(), self.hold.take());
        let own = self.frames.len();
        self.declaring += 1;
        let value = stacker::maybe_grow(128 * 1024, 2 * 1024 * 1024, || {
            self.silent = None;
            self.lint_silent_macro(target.span);
            match self.next() {
                Some(first) => {
                    self.hold = Some(Hold { own, first: self.frames.len() });
                    self.value_of(&first)
                }
                None => Err(self.expected("a value", None, (here, target.span.after()))),
            }
        });
        self.end_of_declaration(head, value.as_ref().ok());
        self.declaring -= 1;
        (self.poison, self.hold) = (outer_poison, outer_hold);
        value
    }

    /// Returns the number that comes next, with its `;`, if it consists of numbers only, as do most
    /// declarations in loops. `here` is the position of the next items.
    fn plain_value(&mut self, here: &Here) -> Option<f64> {
        if self.peeked.is_some() || self.halted {
            return None;
        }
        let frame = self.frames.last()?;
        let items = here.unit.ast.items.get(frame.at as usize..frame.end as usize)?;
        let [Item { kind: ItemKind::Expression(id), .. }, end, ..] = *items else { return None };
        // A second one is handled by the general case.
        let twice = items.get(2).is_some_and(|item| item.kind == ItemKind::Semicolon);
        if end.kind != ItemKind::Semicolon || twice {
            return None;
        }
        let number = self.plain_number(here, id)?;
        self.frames.last_mut()?.at += 2;
        Some(number)
    }

    /// Evaluates an expression for its side effects. Its vectors may have any number of components, as those
    /// of unsupported shapes do.
    pub(super) fn run_expression(&mut self, here: &Here, id: ExpressionId) {
        match here.unit.expression(id).kind {
            ExpressionKind::Vector(components) => self.run_arguments(here, components),
            _ => drop(self.expression(here, id)),
        }
    }

    /// Runs the rest of a block for its directives and calls only.
    pub(super) fn run_items(&mut self) {
        let mut is_color = false;
        loop {
            self.skip_run();
            let Some(Token { kind, here, span }) = self.next() else { break };
            let before = std::mem::replace(
                &mut is_color,
                matches!(kind, TokenKind::Word(word) if word.family() == Family::Color),
            );
            match kind {
                // A colour is a colour, whatever its purpose.
                TokenKind::Expression(id) if before && self.unknown_name(&here, id).is_none() => {
                    drop(self.expression(&here, id));
                }
                TokenKind::Expression(id) => match self.unknown_name(&here, id) {
                    Some(symbol) => drop(self.undeclared_among(&here, symbol, span, |word| {
                        word.family() != Family::Directive
                    })),
                    None => self.run_expression(&here, id),
                },
                TokenKind::Block(contents) => {
                    self.inside_block(&here, contents, span, Self::run_items);
                }
                TokenKind::Entry(items) => self.inside(&here, items, Self::run_items),
                TokenKind::Word(Word::Function) => self.skip_function(),
                TokenKind::Word(_)
                | TokenKind::Comma
                | TokenKind::Semicolon
                | TokenKind::Literal(_) => {}
            }
        }
    }
}
