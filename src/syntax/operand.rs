//! Parses operands: literals, names, keywords, calls, and runs of numbers.

use super::ast::{Callee, ExpressionKind, Item, ItemKind, NameId};
use super::nest::{FrameKind, Nest, State};
use super::numbers::{self, Piece, Pieces};
use super::token::{Bracket, Mark, Token, TokenKind};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::Dialect;
use crate::vocabulary::{Role, Word};

impl<'a> Nest<'a> {
    /// Begins an operand: a complete one before it is a value of its own.
    pub(super) fn before_operand(&mut self) {
        if let State::Holding { .. } = self.top().state {
            self.finish_expression();
        }
    }

    pub(super) fn operand(&mut self, kind: ExpressionKind, span: Span, indexable: bool) {
        self.before_operand();
        let id = self.add(kind, span);
        self.stacks.operands.push(id);
        self.top().state = State::Holding { indexable };
    }

    pub(super) fn named(&mut self, span: Span, after_contextual: bool) {
        let text = self.slice(span);
        if self.next_is(TokenKind::Mark(Mark::Open(Bracket::Brace))) {
            // A misspelt keyword and its block cannot be a component.
            self.leave_vectors(span);
        }
        let top = self.top();
        if let Some(block) = top.block
            && top.state != State::Wanting
            && !after_contextual
            && self.dialect == Dialect::Scene
            && let Some(word) = Word::contextual(text, block)
        {
            self.item(ItemKind::Word(word), span);
            self.top().after_contextual = true;
            return;
        }
        let name = self.name(text);
        if self.next_is(TokenKind::Mark(Mark::Open(Bracket::Round))) {
            self.call(Callee::Name(name, span), span, false);
        } else {
            self.operand(ExpressionKind::Name(name), span, true);
        }
    }

    /// Opens a call: a name or function and the parenthesis after it.
    pub(super) fn call(&mut self, callee: Callee, span: Span, full: bool) {
        self.before_operand();
        self.at += 1;
        self.open(FrameKind::Call(callee), span, full);
    }

    /// `2*scale`: returns the name `Scale`, which differs in case only, where a value is expected.
    fn name_but_for_case(&mut self, span: Span) -> Option<NameId> {
        let text = self.slice(span);
        let alike = self.names.iter().filter(|(name, _)| name.eq_ignore_ascii_case(text));
        let (&name, &id) = alike.filter(|(name, _)| **name != text).min()?;
        let diagnostic = Diagnostic::new(
            Code::UndeclaredName,
            format!("`{text}` is a word of the language, and no value"),
        )
        .at(span, "expected a value")
        .help(format!("did you mean `{name}`?"))
        .fix(span, name);
        self.report(diagnostic);
        Some(id)
    }

    /// Returns whether a keyword of blocks is used as a value: `2 * scale;`, `radius*x`.
    fn stands_for_value(&mut self) -> bool {
        let Some(TokenKind::Mark(next)) = self.tokens.get(self.at + 1).map(|token| token.kind)
        else {
            return false;
        };
        let multiplied = matches!(next, Mark::Star | Mark::Slash);
        let ended = matches!(next, Mark::Close(_) | Mark::Comma | Mark::Semicolon | Mark::Plus);
        let top = self.top();
        let wanted = top.state == State::Wanting || top.formula;
        multiplied && !matches!(top.state, State::Holding { .. }) || ended && wanted
    }

    fn word_for_value(&mut self, span: Span) {
        let text = self.slice(span);
        let message = format!("`{text}` is a word of the language, and no value");
        let mut own = text.to_owned();
        own[..1].make_ascii_uppercase();
        let diagnostic = Diagnostic::new(Code::ExpectedExpression, message)
            .at(span, "expected a value")
            .help(format!("a name of your own may be `{own}`, declared before it is used"));
        self.report(diagnostic);
        self.operand(ExpressionKind::Missing, span, false);
    }

    pub(super) fn word(&mut self, word: Word, span: Span) {
        // A keyword that was wrongly declared as a name, used as a value: reported before.
        let is_name = match word.role() {
            Role::Statement => {
                self.top().state == State::Wanting
                    || matches!(self.top().kind, FrameKind::Vector | FrameKind::Call(_))
            }
            Role::Value => !matches!(word, Word::X | Word::Y | Word::Z),
            Role::Function { .. } => false,
        };
        if is_name && self.names.contains_key(self.slice(span)) {
            return self.named(span, false);
        }
        if self.top().state == State::Wanting
            && word.role() == Role::Statement
            && let Some(name) = self.name_but_for_case(span)
        {
            return self.operand(ExpressionKind::Name(name), span, true);
        }
        if word.role() == Role::Statement && self.stands_for_value() {
            return self.word_for_value(span);
        }
        match word.role() {
            Role::Value => self.operand(ExpressionKind::Word(word), span, false),
            Role::Function { one_argument } => {
                if self.next_is(TokenKind::Mark(Mark::Open(Bracket::Round))) {
                    return self.call(Callee::Word(word, span), span, one_argument);
                }
                if self.lists_items() && self.top().state != State::Wanting {
                    // The functions of a `julia_fractal` have no arguments.
                    return self.item(ItemKind::Word(word), span);
                }
                let name = word.name();
                self.report(
                    Diagnostic::new(
                        Code::ExpectedExpression,
                        format!("`{name}` takes its arguments in parentheses"),
                    )
                    .at(span, format!("expected `(` after `{name}`"))
                    .help(word.sentence()),
                );
                self.operand(ExpressionKind::Missing, span, false);
            }
            Role::Statement => {
                self.leave_vectors(span);
                self.item(ItemKind::Word(word), span);
                self.top().of_color = is_color_vector(word);
                if word == Word::Function {
                    self.top().function_ahead = true;
                }
            }
        }
    }

    pub(super) fn number(&mut self, token: Token) {
        let mut span = self.span(token);
        if self.number_to_another_base(span) || self.grouped_number(span) {
            return;
        }
        // `1.2.3` and `1e+` come as two tokens that touch.
        while let Some(&next) = self.tokens.get(self.at + 1) {
            let text = self.slice(self.span(next));
            let continues = match next.kind {
                TokenKind::Number => text.starts_with('.'),
                TokenKind::Name => text == "e" || text == "E",
                // `1e-`, without digits after it.
                TokenKind::Mark(Mark::Minus | Mark::Plus) => {
                    let behind = self.tokens.get(self.at + 2).map(|token| token.start);
                    self.slice(span).ends_with(['e', 'E']) && behind != Some(next.end)
                }
                _ => false,
            };
            if next.start != span.end || !continues {
                break;
            }
            span.end = next.end;
            self.at += 1;
        }
        let text = self.slice(span);
        match text.parse::<f64>() {
            // A number that is too large is reported on use, if a `.pov` uses it.
            Ok(number) if number.is_finite() || self.dialect == Dialect::Pov => {
                self.operand(ExpressionKind::Number(number), span, false);
            }
            parsed => {
                let why = match parsed {
                    Ok(_) => "larger than any number that can be stored",
                    Err(_) if text.ends_with(['e', 'E', '-', '+']) => {
                        "expected digits after the exponent"
                    }
                    Err(_) => "expected one decimal point at most",
                };
                let message = format!("`{text}` is not a number");
                let told = Diagnostic::new(Code::MalformedNumber, message).at(span, why);
                let alone = matches!(self.top().kind, FrameKind::Vector)
                    && self.next_is(TokenKind::Mark(Mark::Greater));
                self.report(match (with_commas(text).filter(|_| alone), with_one_point(text)) {
                    (Some(right), _) => told
                        .help(format!("does a point stand for a comma? write `{right}`"))
                        .fix(span, right),
                    (None, Some(right)) => told.help(format!("is `{right}` meant?")),
                    (None, None) => told,
                });
                self.operand(ExpressionKind::Missing, span, false);
            }
        }
    }

    /// `0x1F`, as in other languages: a `0` and a name that touch.
    fn number_to_another_base(&mut self, zero: Span) -> bool {
        let Some(&next) = self.tokens.get(self.at + 1) else { return false };
        let digits = self.span(next);
        if self.slice(zero) != "0" || next.kind != TokenKind::Name || digits.start != zero.end {
            return false;
        }
        let name = self.slice(digits);
        let (base, what) = match name.as_bytes() {
            [b'x' | b'X', _, ..] => (16, "hexadecimal"),
            [b'b' | b'B', _, ..] => (2, "binary"),
            [b'o' | b'O', _, ..] => (8, "octal"),
            _ => return false,
        };
        let Ok(value) = u32::from_str_radix(&name[1..], base) else { return false };
        let whole = zero.to(digits);
        let text = self.slice(whole);
        self.report(
            Diagnostic::new(Code::MalformedNumber, format!("`{text}` is not a number"))
                .at(whole, format!("{what} numbers are of other languages"))
                .help(format!("write `{value}`"))
                .fix(whole, value.to_string()),
        );
        self.at += 1;
        self.operand(ExpressionKind::Number(f64::from(value)), whole, false);
        true
    }

    /// `1_000`, as other languages group digits.
    fn grouped_number(&mut self, first: Span) -> bool {
        let Some(&next) = self.tokens.get(self.at + 1) else { return false };
        let rest = self.span(next);
        let groups = self.slice(rest);
        let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        let grouped = groups.strip_prefix('_').is_some_and(|rest| rest.split('_').all(digits));
        if next.kind != TokenKind::Name || rest.start != first.end || !grouped {
            return false;
        }
        let whole = first.to(rest);
        let text = self.slice(whole);
        let meant = text.replace('_', "");
        let Ok(value) = meant.parse::<f64>() else { return false };
        self.report(
            Diagnostic::new(Code::MalformedNumber, format!("`{text}` is not a number"))
                .at(whole, "no sign stands between the digits of a number")
                .help(format!("write `{meant}`"))
                .fix(whole, meant),
        );
        self.at += 1;
        self.operand(ExpressionKind::Number(value), whole, false);
        true
    }

    /// Returns whether adjacent values are separate items.
    pub(super) fn lists_items(&mut self) -> bool {
        let top = self.top();
        match &top.kind {
            FrameKind::File | FrameKind::Entry | FrameKind::Default(_) | FrameKind::Body(_) => true,
            FrameKind::Block => !top.formula,
            FrameKind::Group
            | FrameKind::Vector
            | FrameKind::Call(_)
            | FrameKind::Index(_)
            | FrameKind::Head(_)
            | FrameKind::Condition(..)
            | FrameKind::List(..) => false,
        }
    }

    /// Adds literals with their commas: as one item where adjacent values are items, else token by token.
    pub(super) fn run(&mut self, token: Token) {
        let mut span = self.span(token);
        loop {
            if self.lists_items() && self.top().state != State::Wanting {
                break;
            }
            span.start += self.first_of_run(span) as u32;
            if span.start >= span.end {
                return;
            }
        }
        self.finish_expression();
        let start = self.ast.numbers.len() as u32;
        let mut next = start;
        for row in numbers::decode(self.slice(span), &mut self.ast.numbers) {
            let kind = ItemKind::Numbers { start: next, count: row.count, width: row.width };
            next += row.count * row.width;
            let place = Span {
                start: span.start + row.start as u32,
                end: span.start + row.end as u32,
                ..span
            };
            self.items.push(Item { kind, span: place });
        }
    }

    /// Adds the first element of a run and its comma as tokens. Returns their length.
    pub(super) fn first_of_run(&mut self, run: Span) -> usize {
        let text = self.slice(run);
        let part = |from: usize, to: usize| (run.start + from as u32, run.start + to as u32);
        let mut inside = false;
        for (at, piece) in Pieces::of(text) {
            let (kind, (start, end)) = match piece {
                Piece::Open => (TokenKind::Mark(Mark::Less), part(at, at + 1)),
                Piece::Close => (TokenKind::Mark(Mark::Greater), part(at, at + 1)),
                Piece::Comma => (TokenKind::Mark(Mark::Comma), part(at, at + 1)),
                Piece::Number { mut start, end } => {
                    let sign = match text.as_bytes()[start] {
                        b'-' => Some(Mark::Minus),
                        b'+' => Some(Mark::Plus),
                        _ => None,
                    };
                    if let Some(sign) = sign {
                        let (from, to) = part(start, start + 1);
                        self.token(Token { kind: TokenKind::Mark(sign), start: from, end: to });
                        start += 1;
                    }
                    (TokenKind::Number, part(start, end))
                }
            };
            match piece {
                Piece::Open => inside = true,
                Piece::Close => inside = false,
                Piece::Comma | Piece::Number { .. } => {}
            }
            self.token(Token { kind, start, end });
            if piece == Piece::Comma && !inside {
                return (end - run.start) as usize;
            }
        }
        text.len()
    }
}

/// Returns whether the keyword takes a full expression: `rgb A > B ? C : D`.
///
/// **Source:** POV-Ray 3.7 accepts one there, and nowhere else outside parentheses (measured).
fn is_color_vector(word: Word) -> bool {
    use Word as W;
    matches!(
        word,
        W::Rgb | W::Rgbf | W::Rgbt | W::Rgbft | W::Srgb | W::Srgbf | W::Srgbt | W::Srgbft
    )
}

/// Returns `0.0.00` with its first point alone.
fn with_one_point(text: &str) -> Option<String> {
    let (whole, rest) = text.split_once('.')?;
    let right = format!("{whole}.{}", rest.replace('.', ""));
    right.parse::<f64>().is_ok().then_some(right)
}

/// Returns `1.0.0` as three integers.
fn with_commas(text: &str) -> Option<String> {
    let parts: Vec<&str> = text.split('.').collect();
    let whole = |part: &&str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    (parts.len() == 3 && parts.iter().all(whole)).then(|| parts.join(", "))
}
