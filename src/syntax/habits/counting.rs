//! Loops that count, as other languages write them: `for (i = 0; i < 3; i++) { … }`, `for i in range(3):`.

use super::Reader;
use super::sample::sample;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::vocabulary::Word;

/// What joins the parts of a loop elsewhere.
const JOINTS: &[&str] = &["in", "to", "until", "range", "from", "do", "upto"];

/// A loop's name, its first and its last value, as tokens; and the text of the last one.
struct Count {
    name: usize,
    first: Vec<usize>,
    last: Vec<usize>,
    last_text: String,
}

impl Count {
    /// The head of a loop, and no more is known of it.
    fn unclear(name: usize) -> Self {
        Self { name, first: Vec::new(), last: Vec::new(), last_text: String::new() }
    }
}

impl Reader<'_> {
    /// `for (i = 0; i < 3; i++)`, `for i in range(3):`, `#for (I = 0, 3)`, `#for I = 0 to 3`.
    pub(super) fn counting(&mut self, meant: &mut Vec<Token>) -> bool {
        let signed = matches!(self.kind(0), Some(TokenKind::Directive(_)));
        let round = self.is(1, Mark::Open(Bracket::Round));
        let (from, to) = match round {
            true => match self.closed(1, Bracket::Round) {
                Some(close) => (2, close),
                None => return false,
            },
            false if self.kind(1) == Some(TokenKind::Name) => (1, self.line_end(1)),
            false => return false,
        };
        let commas = self.kind(from) == Some(TokenKind::Name) && self.is(from + 1, Mark::Comma);
        // `#for (I, 0, 6; I++)`
        let counts = (from..to).any(|at| self.is(at, Mark::Semicolon));
        if commas && round && !counts {
            return false;
        }
        // `#for (I 0 2)`: commas may be left out.
        let plain = |kind| {
            matches!(
                kind,
                Some(
                    TokenKind::Name
                        | TokenKind::Number
                        | TokenKind::Mark(Mark::Minus | Mark::Star | Mark::Plus | Mark::Slash)
                )
            )
        };
        let words = (from..to).filter(|&at| self.kind(at) == Some(TokenKind::Name));
        if round && (from..to).all(|at| plain(self.kind(at))) && words.count() == 1 {
            return false;
        }
        let Some(count) = self.count(from, to) else { return false };
        let mut end = if round { to + 1 } else { to };
        if round && self.is(end, Mark::Colon) {
            end += 1;
        }
        let span = self.span(0, end - 1);
        let name = self.slice(count.name).to_owned();
        let text = |ahead: &[usize]| ahead.iter().map(|&at| self.slice(at)).collect::<String>();
        let right = match count.first.as_slice() {
            [] => format!("#for ({name}, 0, {})", count.last_text),
            first => format!("#for ({name}, {}, {})", text(first), count.last_text),
        };
        let certain = !count.last_text.is_empty();
        let inside = self.span(from, to.max(from + 1) - 1);
        let head = self.text.get(inside.range()).unwrap_or("");
        let sample = if certain { None } else { sample(head, &name) };
        let diagnostic = match signed {
            true => {
                let message = match round {
                    true => "`#for` takes a name, a start and an end, with commas between them",
                    false => "`#for` takes a name, a start and an end, in parentheses with commas",
                };
                let told = Diagnostic::new(Code::ExpectedExpression, message);
                // `#for (I = 0, 3)`: all but one sign is right.
                let sign = round && certain && self.is(from + 1, Mark::Equal);
                match sign && (from..to).filter(|&at| self.is(at, Mark::Comma)).count() == 1 {
                    true => told.at(self.span(from + 1, from + 1), "expected a comma"),
                    false => told.at(inside, "the head of a loop of another language"),
                }
            }
            false => Diagnostic::new(Code::UnknownDirective, "a loop of another language")
                .at(span, "`#for` is a directive here, and counts by itself"),
        };
        let (mut diagnostic, braced) = self.braces(end, diagnostic);
        let ended = signed || braced || self.surplus_ends();
        let right = match (&sample, certain) {
            (_, true) => Some(right),
            (Some(sample), false) => Some(format!("#for {}", sample.text)),
            (None, false) => None,
        };
        diagnostic = match &right {
            Some(right) => diagnostic.help(format!("write `{right} … #end`: the end is included")),
            None if self.is_each(from, to) => {
                let array = self.slice(to - 1);
                diagnostic.help(format!(
                    "write `#for (I, 0, dimension_size({array}, 1) - 1) … #end`, and `{array}[I]` for `{name}`"
                ))
            }
            None => diagnostic
                .help(format!("write `#for ({name}, 0, 9) … #end`: from 0 to 9, both included")),
        };
        let sure = certain || sample.is_some_and(|sample| sample.certain);
        match right.filter(|_| sure && ended) {
            Some(right) => diagnostic = diagnostic.fix(span, right),
            // Half a fix is none.
            None => diagnostic.fixes.clear(),
        }
        self.diagnostics.push(diagnostic);
        let place = self.tokens[self.at];
        let mark = |mark| Token { kind: TokenKind::Mark(mark), ..place };
        let head = |head| Token { kind: TokenKind::Directive(head), ..place };
        let tokens = |ahead: &[usize]| -> Vec<Token> {
            ahead.iter().map(|at| self.tokens[self.at + at]).collect()
        };
        if certain && ended && !count.first.is_empty() {
            meant.extend([head(Head::For), mark(Mark::Open(Bracket::Round))]);
            meant.extend(tokens(&[count.name]));
            meant.push(mark(Mark::Comma));
            meant.extend(tokens(&count.first));
            meant.push(mark(Mark::Comma));
            meant.extend(tokens(&count.last));
            meant.push(mark(Mark::Close(Bracket::Round)));
        } else if ended {
            // Nothing is known of the name: its body is not run.
            meant.extend([head(Head::Ifdef), mark(Mark::Open(Bracket::Round))]);
            meant.extend(tokens(&[count.name]));
            meant.push(mark(Mark::Close(Bracket::Round)));
        } else {
            // Without an end, the body is taken once; for that the name has a value.
            let value = if count.first.is_empty() { &count.last } else { &count.first };
            meant.push(head(Head::Declare));
            meant.extend(tokens(&[count.name]));
            meant.push(mark(Mark::Equal));
            meant.extend(tokens(value));
            meant.push(mark(Mark::Semicolon));
        }
        self.at += end;
        true
    }

    /// `V in A`: each element of an array.
    fn is_each(&self, from: usize, to: usize) -> bool {
        let is_name = |at: usize| self.kind(at) == Some(TokenKind::Name);
        to == from + 3 && is_name(from) && self.slice_is(from + 1, "in") && is_name(from + 2)
    }

    /// Reads the head of a loop between two tokens.
    fn count(&self, from: usize, to: usize) -> Option<Count> {
        let is_name = |at: usize| at < to && self.kind(at) == Some(TokenKind::Name);
        let int = self.kind(from) == Some(TokenKind::Word(Word::Int));
        let declares =
            (int || is_name(from)) && is_name(from + 1) && !JOINTS.contains(&self.slice(from + 1));
        let name = if declares { from + 1 } else { from };
        if !is_name(name) || (self.kind(name + 1).is_none()) {
            return None;
        }
        let semicolons: Vec<usize> =
            (from..to).filter(|&at| self.is(at, Mark::Semicolon)).collect();
        let commas = |reader: &Self| -> Vec<usize> {
            (from..to).filter(|&at| reader.is(at, Mark::Comma)).collect()
        };
        let mut exclusive = false;
        let (first, mut last): (Vec<usize>, Vec<usize>);
        if let [one, other] = semicolons.as_slice() {
            first = (name + 2..*one).collect();
            let compares = one + 2;
            exclusive = self.is(compares, Mark::Less);
            if !exclusive && !self.is(compares, Mark::LessOrEqual) {
                return Some(Count { name, first, last: Vec::new(), last_text: String::new() });
            }
            last = (compares + 1..*other).collect();
            let step: String = (other + 1..to).map(|at| self.slice(at)).collect();
            if !self.is_by_one(name, &step) {
                return Some(Count { name, first, last, last_text: String::new() });
            }
        } else if let ([end], [a, b]) = (semicolons.as_slice(), commas(self).as_slice()) {
            let step: String = (end + 1..to).map(|at| self.slice(at)).collect();
            if b > end || !self.is_by_one(name, &step) {
                return Some(Count::unclear(name));
            }
            (first, last) = ((a + 1..*b).collect(), (b + 1..*end).collect());
        } else {
            // `0..5` is read as `0.` and `.5`: what is meant cannot be taken from these.
            let dots =
                |at: usize| self.slice(at).ends_with('.') && self.slice(at + 1).starts_with('.');
            if (name + 1..to.saturating_sub(1)).any(dots) {
                return Some(Count::unclear(name));
            }
            let mut pieces: Vec<Vec<usize>> = vec![Vec::new()];
            for at in name + 1..to {
                let joint = match self.kind(at) {
                    Some(TokenKind::Name) if JOINTS.contains(&self.slice(at)) => {
                        exclusive |= self.slice(at) == "range";
                        true
                    }
                    Some(TokenKind::Word(Word::Range)) => {
                        exclusive = true;
                        true
                    }
                    Some(TokenKind::Mark(
                        Mark::Equal
                        | Mark::Colon
                        | Mark::Comma
                        | Mark::Dot
                        | Mark::Open(_)
                        | Mark::Close(_),
                    )) => true,
                    _ => false,
                };
                match joint {
                    true => pieces.push(Vec::new()),
                    false => pieces.last_mut()?.push(at),
                }
            }
            pieces.retain(|piece| !piece.is_empty());
            // `#for I 0 3`
            if let [both] = pieces.as_slice()
                && let [one, other] = *both.as_slice()
            {
                pieces = vec![vec![one], vec![other]];
            }
            (first, last) = match pieces.as_slice() {
                [last] if exclusive => (Vec::new(), last.clone()),
                [first, last] if !self.falls(first, last) => (first.clone(), last.clone()),
                // It counts down, or a step may stand in the middle or at the end.
                _ => return Some(Count::unclear(name)),
            };
        }
        if !self.is_simple(&last) || !(first.is_empty() || self.is_simple(&first)) {
            last.clear();
            return Some(Count { name, first, last, last_text: String::new() });
        }
        let text: String = last.iter().map(|&at| self.slice(at)).collect();
        let last_text = match (exclusive, text.parse::<i64>()) {
            (false, _) => text,
            (true, Ok(end)) => (end - 1).to_string(),
            (true, Err(_)) => format!("{text} - 1"),
        };
        Some(Count { name, first, last, last_text })
    }

    /// `i++`, `i += 1`: the counter's name, and how it counts on.
    fn is_by_one(&self, name: usize, step: &str) -> bool {
        let name = self.slice(name);
        let by_one = [
            format!("{name}++"),
            format!("++{name}"),
            format!("{name}+=1"),
            format!("{name}={name}+1"),
        ];
        by_one.iter().any(|one| one == step)
    }

    /// Whether one whole number is more than another.
    fn falls(&self, first: &[usize], last: &[usize]) -> bool {
        let whole = |ahead: &[usize]| {
            let text: String = ahead.iter().map(|&at| self.slice(at)).collect();
            text.parse::<i64>().ok()
        };
        matches!((whole(first), whole(last)), (Some(first), Some(last)) if first > last)
    }

    /// A number, with or without a sign, or a name.
    fn is_simple(&self, ahead: &[usize]) -> bool {
        let value = |at: usize| matches!(self.kind(at), Some(TokenKind::Number | TokenKind::Name));
        match *ahead {
            [at] => value(at),
            [sign, at] => self.is(sign, Mark::Minus) && value(at),
            _ => false,
        }
    }
}
