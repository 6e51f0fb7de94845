//! Operations and calls as other languages write them: `2(A + 1)`, `7 mod 3`, `rgb A + rgb B`, `V.dot(W)`,
//! `rotate(A, B)`, `scale(A, 2)`, `pi()`, `new sphere { … }`.

use super::Reader;
use super::part::Inside;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};
use crate::vocabulary::{Family, Role, Word};

/// What a vector is asked elsewhere, and what is called for it.
const METHODS: &[(&str, Word)] = &[
    ("dot", Word::Vdot),
    ("cross", Word::Vcross),
    ("normalize", Word::Vnormalize),
    ("normalise", Word::Vnormalize),
    ("normalized", Word::Vnormalize),
];

/// What makes an array longer elsewhere.
const GROWERS: &[&str] = &["append", "push", "push_back", "add"];

/// How many tokens of a call are looked at.
const LONGEST_CALL: usize = 200;

/// How many tokens before a sign the word that begins its sum is looked for.
const LONGEST_SUM: usize = 40;

/// An operand, in parentheses where it is more than a name, a number or a vector.
fn grouped(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_.".contains(c);
    match text.chars().all(plain) || text.starts_with('<') && text.ends_with('>') {
        true => text.to_owned(),
        false => format!("({text})"),
    }
}

/// A token of no width.
fn nothing(kind: TokenKind, place: u32) -> Token {
    Token { kind, start: place, end: place }
}

impl Reader<'_> {
    /// What a word of the language does not do here.
    pub(super) fn operation(&mut self, word: Word, meant: &mut Vec<Token>) -> bool {
        self.called_value(word, meant)
            || self.function_between(word, meant)
            || self.color_word_again(word, meant)
            || self.moved_vector(word, meant)
    }

    /// `2(A + 1)`: a number, and what it multiplies.
    pub(super) fn times_group(&mut self, meant: &mut Vec<Token>) -> bool {
        let Some(number) = self.number_before(meant) else { return false };
        let Some(close) = self.closed(0, Bracket::Round) else { return false };
        // `torus { 1(0.2) }` has two values; behind a comma or a sign it is one.
        let before = meant.len().checked_sub(2).map(|at| meant[at].kind);
        let is_part = matches!(
            before,
            Some(TokenKind::Mark(
                Mark::Comma | Mark::Plus | Mark::Minus | Mark::Star | Mark::Slash
            ))
        );
        if self.inside.last().is_some_and(Inside::opens_shape) && !is_part {
            return false;
        }
        // `2(1, 0, 0)` is rather a vector.
        if close == 1 || (1..close).any(|at| self.is(at, Mark::Comma)) {
            return false;
        }
        let left = self.text.get(number.start as usize..number.end as usize).unwrap_or("");
        let group = self.span(0, close);
        let text = self.text.get(group.range()).unwrap_or("");
        let told = Diagnostic::new(
            Code::ExpectedExpression,
            format!("a `*` is missing between `{left}` and `(`"),
        )
        .at(Span { start: number.start, ..group }, "a number, and what it multiplies")
        .help(format!("write `{left}*{text}`"))
        .fix(Span { end: group.start, ..group }, "*");
        self.diagnostics.push(told);
        meant.push(nothing(TokenKind::Mark(Mark::Star), number.end));
        self.take(meant);
        true
    }

    /// `pi()`, `clock()`: a word that is a value, called.
    fn called_value(&mut self, word: Word, meant: &mut Vec<Token>) -> bool {
        let called = word.role() == Role::Value
            && self.is(1, Mark::Open(Bracket::Round))
            && self.is(2, Mark::Close(Bracket::Round))
            && self.touches(1);
        if !called {
            return false;
        }
        let (name, parentheses) = (word.name(), self.span(1, 2));
        self.diagnostics.push(
            Diagnostic::new(
                Code::NotCallable,
                format!("`{name}` is a value, and takes no parentheses"),
            )
            .at(self.span(0, 2), "called like a function")
            .help(format!("write `{name}`"))
            .fix(parentheses, ""),
        );
        meant.push(self.tokens[self.at]);
        self.at += 3;
        true
    }

    /// `7 mod 3`: a function between its values, as other languages have operators.
    fn function_between(&mut self, word: Word, meant: &mut Vec<Token>) -> bool {
        let is_single = |kind| matches!(kind, TokenKind::Number | TokenKind::Name);
        let [.., before, left] = meant[..] else { return false };
        let begins = matches!(
            before.kind,
            TokenKind::Mark(
                Mark::Equal
                    | Mark::Comma
                    | Mark::Open(Bracket::Round | Bracket::Square)
                    | Mark::Less
                    | Mark::And
                    | Mark::Or
                    | Mark::Plus
                    | Mark::Minus
                    | Mark::Question
                    | Mark::Colon
            )
        );
        let ends = match self.kind(2) {
            Some(TokenKind::Mark(mark)) => !matches!(mark, Mark::Open(_) | Mark::Dot),
            _ => true,
        };
        let between = matches!(word, Word::Mod | Word::Div)
            && is_single(left.kind)
            && self.kind(1).is_some_and(is_single);
        if !between || !begins || !ends {
            return false;
        }
        let name = word.name();
        let first = self.text.get(left.start as usize..left.end as usize).unwrap_or("");
        let right = format!("{name}({first}, {})", self.slice(1));
        let whole = Span { start: left.start, ..self.span(1, 1) };
        self.diagnostics.push(
            Diagnostic::new(
                Code::ExpectedExpression,
                format!("`{name}` stands before its two values"),
            )
            .at(self.span(0, 0), "an operator of another language")
            .help(format!("write `{right}`"))
            .fix(whole, right),
        );
        meant.pop();
        let last = self.tokens[self.at + 1];
        let mark = |mark, place| nothing(TokenKind::Mark(mark), place);
        meant.push(nothing(TokenKind::Word(word), left.start));
        meant.push(mark(Mark::Open(Bracket::Round), left.start));
        meant.push(left);
        meant.push(Token { kind: TokenKind::Mark(Mark::Comma), ..self.tokens[self.at] });
        meant.push(last);
        meant.push(mark(Mark::Close(Bracket::Round), last.end));
        self.at += 2;
        true
    }

    /// `rgb A*0.5 + rgb B*0.5`: the word stands once, before the whole.
    fn color_word_again(&mut self, word: Word, meant: &[Token]) -> bool {
        let is_color =
            |kind| matches!(kind, TokenKind::Word(word) if word.family() == Family::Color);
        let [.., last, sign] = meant else { return false };
        let is_sum = matches!(sign.kind, TokenKind::Mark(Mark::Plus | Mark::Minus))
            && matches!(
                last.kind,
                TokenKind::Number
                    | TokenKind::Name
                    | TokenKind::Mark(Mark::Greater | Mark::Close(Bracket::Round))
            );
        if word.family() != Family::Color || !is_sum {
            return false;
        }
        // `color rgb`
        let count = 1 + usize::from(self.kind(1).is_some_and(is_color));
        let begins = matches!(
            self.kind(count),
            Some(
                TokenKind::Name
                    | TokenKind::Number
                    | TokenKind::Mark(Mark::Less | Mark::Open(Bracket::Round))
            )
        );
        let near = &meant[meant.len().saturating_sub(LONGEST_SUM)..];
        let first = near.iter().rev().find(|token| {
            is_color(token.kind)
                || matches!(
                    token.kind,
                    TokenKind::Directive(_)
                        | TokenKind::Mark(
                            Mark::Semicolon
                                | Mark::Open(Bracket::Brace | Bracket::Square)
                                | Mark::Close(Bracket::Brace | Bracket::Square)
                        )
                )
        });
        if !begins || first.map(|first| first.kind) != self.kind(count - 1) {
            return false;
        }
        let words = self.span(0, count - 1);
        let text = self.text.get(words.range()).unwrap_or("");
        let sign = Span { start: sign.start, end: sign.end, ..words };
        self.diagnostics.push(
            Diagnostic::new(
                Code::ExpectedExpression,
                format!("`{text}` stands once, before the whole of a sum"),
            )
            .at(words, "expected a value")
            .also(sign, "of this sum")
            .help("leave it out here")
            .fix(Span { end: self.span(count, count).start, ..words }, ""),
        );
        self.at += count;
        true
    }

    /// `#declare V = rotate(A, <0, 30, 0>);`, `scale(A, 2)`: what moves an object, called with a vector.
    fn moved_vector(&mut self, word: Word, meant: &mut Vec<Token>) -> bool {
        let moves = matches!(word, Word::Rotate | Word::Scale | Word::Translate);
        let wanted = moves
            && matches!(
                meant.last().map(|last| last.kind),
                Some(TokenKind::Mark(
                    Mark::Equal
                        | Mark::Plus
                        | Mark::Minus
                        | Mark::Star
                        | Mark::Open(Bracket::Round)
                ))
            );
        let Some(close) = self.closed(1, Bracket::Round).filter(|_| wanted) else { return false };
        let Some(comma) = self.one_comma(close) else { return false };
        let (ours, sign) = match word {
            Word::Rotate => ("vrotate", None),
            Word::Scale => ("*", Some(Mark::Star)),
            Word::Translate => ("+", Some(Mark::Plus)),
            _ => return false,
        };
        let span = self.span(0, 0);
        let [first, second] = [self.text_between(1, comma), self.text_between(comma, close)];
        let whole = match sign {
            None => format!("{ours}({first}, {second})"),
            Some(_) => format!("({})", [grouped(first), grouped(second)].join(ours)),
        };
        let name = word.name();
        let message = format!("`{name}` is a word for objects, and no function of vectors");
        self.diagnostics.push(
            Diagnostic::new(Code::ForeignWord, message)
                .at(span, format!("for a vector it is `{ours}`"))
                .help(format!("write `{whole}`"))
                .fix(self.span(0, close), whole),
        );
        let round = |mark: fn(Bracket) -> Mark, token: Token| Token {
            kind: TokenKind::Mark(mark(Bracket::Round)),
            ..token
        };
        let [start, comma_token] = [0, comma].map(|ahead| self.tokens[self.at + ahead]);
        match sign {
            None => {
                meant.push(Token { kind: TokenKind::Word(Word::Vrotate), ..start });
                meant.extend(&self.tokens[self.at + 1..=self.at + close]);
            }
            // `((A) + (B))`
            Some(sign) => {
                meant.extend([round(Mark::Open, start), self.tokens[self.at + 1]]);
                meant.extend(&self.tokens[self.at + 2..self.at + comma]);
                meant
                    .push(nothing(TokenKind::Mark(Mark::Close(Bracket::Round)), comma_token.start));
                meant.push(Token { kind: TokenKind::Mark(sign), ..comma_token });
                meant.push(nothing(TokenKind::Mark(Mark::Open(Bracket::Round)), comma_token.end));
                meant.extend(&self.tokens[self.at + comma + 1..=self.at + close]);
                let end = self.tokens[self.at + close].end;
                meant.push(nothing(TokenKind::Mark(Mark::Close(Bracket::Round)), end));
            }
        }
        self.at += close + 1;
        true
    }

    /// The only comma of a parenthesis that opens at 1 and closes at `close`, but for those of vectors and calls.
    fn one_comma(&self, close: usize) -> Option<usize> {
        let mut depth = 0;
        if close > LONGEST_CALL {
            return None;
        }
        let mut commas = (2..close).filter(|&at| {
            match self.kind(at) {
                Some(TokenKind::Mark(Mark::Less | Mark::Open(_))) => depth += 1,
                Some(TokenKind::Mark(Mark::Greater | Mark::Close(_))) => depth -= 1,
                _ => {}
            }
            depth == 0 && self.is(at, Mark::Comma)
        });
        let first = commas.next()?;
        (commas.next().is_none() && first > 2 && first + 1 < close).then_some(first)
    }

    /// `V.dot(W)`, `Points.append(3)`: what other languages ask a value itself.
    pub(super) fn method(&mut self, meant: &mut Vec<Token>) -> bool {
        let dotted = self.is(1, Mark::Dot)
            && matches!(self.kind(2), Some(TokenKind::Name | TokenKind::Word(_)))
            && self.touches(1)
            && self.touches(2)
            && self.touches(3);
        let Some(close) = (if dotted { self.closed(3, Bracket::Round) } else { None }) else {
            return false;
        };
        let (name, asked) = (self.slice(0), self.slice(2));
        if !self.declares_anywhere(name) {
            return false;
        }
        if GROWERS.contains(&asked) && self.inside.is_empty() {
            let told = Diagnostic::new(
                Code::UnexpectedCharacter,
                "an array is as long as it was declared",
            )
            .at(self.span(2, 2), format!("there is no `.{asked}`"))
            .help(format!("an element is set by its index: `#declare {name}[0] = …;`"));
            self.diagnostics.push(told);
            self.at += close + 1 + usize::from(self.is(close + 1, Mark::Semicolon));
            return true;
        }
        let Some(&(_, word)) = METHODS.iter().find(|(theirs, _)| *theirs == asked) else {
            return false;
        };
        let alone = close == 4;
        if alone != (word == Word::Vnormalize) {
            return false;
        }
        let ours = word.name();
        let right = match alone {
            true => format!("{ours}({name})"),
            false => format!("{ours}({name}, {})", self.text_between(3, close)),
        };
        let told = Diagnostic::new(Code::ForeignWord, format!("`.{asked}` is a function here"))
            .at(self.span(2, 2), "behind a point stands only a component")
            .help(format!("write `{right}`"))
            .fix(self.span(0, close), right);
        self.diagnostics.push(told);
        let first = self.tokens[self.at];
        meant.push(nothing(TokenKind::Word(word), first.start));
        meant.push(nothing(TokenKind::Mark(Mark::Open(Bracket::Round)), first.start));
        meant.push(first);
        if !alone {
            meant.push(Token { kind: TokenKind::Mark(Mark::Comma), ..self.tokens[self.at + 1] });
            meant.extend(&self.tokens[self.at + 4..self.at + close]);
        }
        meant.push(self.tokens[self.at + close]);
        self.at += close + 1;
        true
    }

    /// `new sphere { … }`: a word of the language makes it by itself.
    pub(super) fn made_by_new(&mut self) -> bool {
        let made = match self.kind(1) {
            Some(TokenKind::Word(word)) => word.role() == Role::Statement,
            _ => false,
        };
        let opens = self.is(2, Mark::Open(Bracket::Brace));
        if !made
            || !opens
            || self.slice(0) != "new"
            || self.breaks_before(1)
            || self.declares_anywhere("new")
        {
            return false;
        }
        let (span, next) = (self.span(0, 0), self.span(1, 1));
        let told = Diagnostic::new(Code::ForeignWord, "`new` is not a word of the language")
            .at(span, format!("`{}` alone makes one", self.slice(1)))
            .help("leave it out")
            .fix(Span { end: next.start, ..span }, "");
        self.diagnostics.push(told);
        self.at += 1;
        true
    }
}
