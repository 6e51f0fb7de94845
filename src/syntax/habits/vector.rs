//! Vectors as other languages write them: `(1, 0, 0)`, `[1, 0, 0]`, `vec3(1, 0, 0)`, `translate([2, 0, 0])`.

use super::Reader;
use super::part::Inside;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::literal::literal_vector;
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};
use crate::vocabulary::{Family, Role, Word};

/// What makes a vector elsewhere.
const MAKERS: &[&str] = &[
    "vec2", "vec3", "vec4", "float2", "float3", "float4", "vector3", "Vector", "Vector2",
    "Vector3", "Vector4", "Vec2", "Vec3", "Vec4", "Color", "Color3",
];

/// How many tokens of a vector are looked at, at most.
pub(super) const LONGEST_VECTOR: usize = 12;

impl Reader<'_> {
    /// `<1, -2, 3>`: there is no habit in it, unless its `>` begins a line.
    pub(super) fn literal_vector(&mut self, meant: &mut Vec<Token>) -> bool {
        let tokens = &self.tokens[self.at..];
        let is_undisturbed =
            self.hyphens.is_empty() && self.dropped.is_empty() && self.ends_before.is_empty();
        let Some(length) = literal_vector(tokens).filter(|_| is_undisturbed) else { return false };
        if self.line_begins_at(self.at + length - 1) {
            return false;
        }
        meant.extend_from_slice(&tokens[..length]);
        self.at += length;
        true
    }

    /// `(1, 0, 0)`, `[1, 0, 0]`, `vec3(1, 0, 0)` where a vector is meant.
    pub(super) fn vector(&mut self, meant: &mut Vec<Token>) -> bool {
        // `new Vector3(0, 1, 0)`
        let new = usize::from(
            self.kind(0) == Some(TokenKind::Name)
                && self.slice(0) == "new"
                && self.kind(1) == Some(TokenKind::Name),
        );
        // `THREE.Vector3(0, 1, 0)`
        let dotted = self.is(new + 1, Mark::Dot)
            && self.touches(new + 1)
            && self.kind(new + 2) == Some(TokenKind::Name);
        let new = new + if dotted { 2 } else { 0 };
        let made = self.kind(new) == Some(TokenKind::Name);
        if made && !MAKERS.contains(&self.slice(new)) {
            return false;
        }
        let open = new + usize::from(made);
        let bracket = match self.kind(open) {
            Some(TokenKind::Mark(Mark::Open(bracket))) => bracket,
            _ => return false,
        };
        if !made && self.bracket_in_angle(bracket, meant) {
            return true;
        }
        if made && self.vector_of_one(open, meant) {
            return true;
        }
        let before = |back: usize| {
            let token = meant.len().checked_sub(back).and_then(|at| meant.get(at));
            token.map(|token| token.kind)
        };
        // `translate([2, 0, 0])`
        let argument = bracket == Bracket::Square
            && before(1) == Some(TokenKind::Mark(Mark::Open(Bracket::Round)))
            && matches!(before(2), Some(TokenKind::Word(_) | TokenKind::Name));
        let fits = match before(1) {
            _ if argument => true,
            // `A + (1, 2, 3)`, `M(A, (1, 2, 3))`: a group has no commas.
            Some(TokenKind::Mark(mark))
                if bracket == Bracket::Round && stands_before_value(mark) =>
            {
                true
            }
            // `rgb {1, 0, 0}`; other braces hold parts, or rows of an array.
            Some(TokenKind::Word(word)) if bracket == Bracket::Brace => {
                word.role() == Role::Statement
                    && matches!(word.family(), Family::Transform | Family::Color)
            }
            // `sphere { {0, 1, 0}, 1 }`
            Some(TokenKind::Mark(Mark::Open(Bracket::Brace) | Mark::Comma))
                if bracket == Bracket::Brace =>
            {
                self.inside.last().is_some_and(Inside::opens_shape)
            }
            _ if bracket == Bracket::Brace => false,
            Some(TokenKind::Mark(Mark::Open(Bracket::Brace) | Mark::Comma)) => true,
            // `[0.5 vec3(1, 0, 0)]` in a map.
            Some(TokenKind::Number) if made => {
                self.inside.last().is_some_and(|inside| inside.is(Bracket::Square))
            }
            // `= [1, 2, 3]` is rather an array.
            Some(TokenKind::Mark(Mark::Equal)) => bracket == Bracket::Round,
            Some(TokenKind::Word(word)) => {
                word.role() == Role::Statement
                    && matches!(
                        word.family(),
                        Family::Transform
                            | Family::Color
                            | Family::Camera
                            | Family::Pattern
                            | Family::Light
                            | Family::FinishItem
                    )
            }
            _ => false,
        };
        let inside_brace = self.inside.last().is_none_or(|inside| inside.is(Bracket::Brace));
        let group = matches!(before(1), Some(TokenKind::Mark(mark)) if stands_before_value(mark))
            && bracket == Bracket::Round;
        let anywhere = inside_brace || made || argument || group;
        if !fits || !anywhere || (made && bracket != Bracket::Round) {
            return false;
        }
        let formula = self.inside.last().is_some_and(|inside| inside.opens(Word::Function));
        // `translate [0, H, 0]`: no word of the language but one that takes a vector stands before it.
        let behind_word = matches!(before(1), Some(TokenKind::Word(_)));
        let plain = !(made || argument || group || behind_word) || formula;
        let in_map = self.inside.last().is_some_and(Inside::is_map);
        let parted = bracket == Bracket::Square && !made && !in_map;
        let bare = || self.row_without_commas(open).filter(|_| parted);
        let Some(close) = self.row(open, bracket, plain).or_else(bare) else { return false };
        let (first, last) = (self.span(0, open), self.span(close, close));
        let before = meant.len().checked_sub(2).map(|word| meant[word]);
        let moved = before.filter(|word| {
            argument
                && (self.inside.len() == 1 || self.begins_object(close + 2))
                && matches!(word.kind, TokenKind::Word(word) if word.family() == Family::Transform)
        });
        let diagnostic = if let Some(word) = moved {
            // `translate([0, 2, 0]) sphere(…)`
            let word = Span::new(self.file, word.start as usize, word.end as usize);
            let name = self.text.get(word.range()).unwrap_or("");
            let inside = Span { start: first.end, end: last.start, ..first };
            let numbers = self.text.get(inside.range()).unwrap_or("").trim();
            let message =
                format!("`{name}` stands inside the object that it moves, behind its parts");
            Diagnostic::new(Code::MisplacedBlock, message)
                .at(word, "not before an object, as in other languages")
                .help(format!("write `sphere {{ … {name} <{numbers}> }}`"))
        } else {
            let inside = Span { start: first.end, end: last.start, ..first };
            let numbers = self.text.get(inside.range()).unwrap_or("x, y, z").trim();
            let is_bare = !numbers.contains(',');
            if meant.last().map(|token| token.kind) == Some(TokenKind::Word(Word::Rotate))
                && self.axis_and_angle(close, numbers.to_owned(), meant)
            {
                return true;
            }
            // `reflection [0.1, 0.3]`: the least and the most.
            if meant.last().map(|token| token.kind) == Some(TokenKind::Word(Word::Reflection)) {
                return self.reflection(close, numbers.to_owned(), meant);
            }
            let message = match made {
                true => format!(
                    "`{}` makes no vector here: a vector stands between `<` and `>`",
                    self.slice(open - 1)
                ),
                false => format!(
                    "a vector stands between `<` and `>`, not in `{}{}`",
                    bracket.opener(),
                    bracket.closer()
                ),
            };
            let told = Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(self.span(0, close), "expected a vector");
            if is_bare {
                let row: Vec<&str> = numbers.split_whitespace().collect();
                let vector = format!("<{}>", row.join(", "));
                told.help(format!("write `{vector}`")).fix(self.span(0, close), vector)
            } else {
                told.help(format!("write `<{numbers}>`")).fix(first, "<").fix(last, ">")
            }
        };
        if self.made != Some(self.at) || !made {
            self.diagnostics.push(diagnostic);
        }
        if moved.is_some() && self.inside.len() > 1 {
            // What stands before an object inside a block goes, with its parentheses.
            meant.truncate(meant.len() - 2);
            self.inside.pop();
            self.at += close + 2;
            return true;
        }
        if moved.is_some() {
            self.drop_moved(close + 2);
        }
        let sign =
            |at: usize, mark| Token { kind: TokenKind::Mark(mark), ..self.tokens[self.at + at] };
        meant.push(sign(open, Mark::Less));
        let commas = (open + 1..close).any(|at| self.is(at, Mark::Comma));
        for at in open + 1..close {
            let begins = !commas && at > open + 1 && !self.touches(at);
            meant.extend(
                begins.then(|| Token {
                    end: self.tokens[self.at + at].start,
                    ..sign(at, Mark::Comma)
                }),
            );
            meant.push(self.tokens[self.at + at]);
        }
        meant.push(sign(close, Mark::Greater));
        self.at += close + 1;
        true
    }

    /// `rotate(90, y)`: an angle and an axis.
    fn axis_and_angle(&mut self, close: usize, inside: String, meant: &mut Vec<Token>) -> bool {
        let Some((one, other)) = inside.split_once(',') else { return false };
        let (one, other) = (one.trim(), other.trim());
        let is_axis = |text: &str| matches!(text.trim_start_matches('-'), "x" | "y" | "z");
        let (angle, axis) = match (is_axis(one), is_axis(other)) {
            (false, true) => (one, other),
            (true, false) => (other, one),
            _ => return false,
        };
        let whole = self.span(0, close);
        let right = format!(" {angle}*{axis}");
        let message = "`rotate` takes one vector: degrees about x, y and z";
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(whole, "an angle and an axis, as elsewhere")
                .help(format!("write `rotate{right}`"))
                .fix(whole, right),
        );
        let first = self.tokens[self.at];
        meant.push(Token { kind: TokenKind::Word(Word::X), end: first.start + 1, ..first });
        self.at += close + 1;
        true
    }

    /// `vec3(0.0)`: three times the same.
    fn vector_of_one(&mut self, open: usize, meant: &mut Vec<Token>) -> bool {
        let one = matches!(self.kind(open + 1), Some(TokenKind::Number | TokenKind::Name))
            && self.is(open + 2, Mark::Close(Bracket::Round))
            && self.slice(open - 1).ends_with('3');
        if !one {
            return false;
        }
        let (whole, maker) = (self.span(0, open + 2), self.slice(open - 1));
        let value = self.slice(open + 1);
        let vector = format!("<{value}, {value}, {value}>");
        let message =
            format!("`{maker}` makes no vector here: a vector stands between `<` and `>`");
        let told = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(whole, "expected a vector")
            .help(format!("write `{vector}`"))
            .fix(whole, vector);
        self.diagnostics.push(told);
        let value = self.tokens[self.at + open + 1];
        let sign = |mark| Token { kind: TokenKind::Mark(mark), ..value };
        meant.push(sign(Mark::Less));
        for separator in [Mark::Comma, Mark::Comma, Mark::Greater] {
            meant.extend([value, sign(separator)]);
        }
        self.at += open + 3;
        true
    }

    /// `<[1, 2, 3]>`, `<(1, 2, 3)>`: a list of another language within a vector.
    fn bracket_in_angle(&mut self, bracket: Bracket, meant: &mut Vec<Token>) -> bool {
        let is_first = meant.last().is_some_and(|last| last.kind == TokenKind::Mark(Mark::Less));
        let close = self.row(0, bracket, false).filter(|_| is_first && bracket != Bracket::Brace);
        let Some(close) = close.filter(|close| self.is(close + 1, Mark::Greater)) else {
            return false;
        };
        let (first, last) = (self.span(0, 0), self.span(close, close));
        let inside = Span { start: first.end, end: last.start, ..first };
        let numbers = self.text.get(inside.range()).unwrap_or("").trim();
        let message = "the numbers of a vector stand right between `<` and `>`";
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(self.span(0, close), "brackets of another language")
                .help(format!("write `<{numbers}>`"))
                .fix(first, "")
                .fix(last, ""),
        );
        meant.extend(&self.tokens[self.at + 1..self.at + close]);
        self.at += close + 1;
        true
    }

    /// `reflection [0.1, 0.3]`, whose last bracket is `close` tokens ahead.
    fn reflection(&mut self, close: usize, numbers: String, meant: &mut Vec<Token>) -> bool {
        let (first, last) = (self.span(0, 0), self.span(close, close));
        let message = "what is in a `reflection` stands between `{` and `}`";
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(self.span(0, close), "expected a number, or braces")
                .help(format!("write `reflection {{ {numbers} }}`"))
                .fix(first, "{ ")
                .fix(last, " }"),
        );
        self.in_braces(close, meant);
        true
    }

    /// Takes what stands in other brackets up to `close` as if these were braces.
    pub(super) fn in_braces(&mut self, close: usize, meant: &mut Vec<Token>) {
        let brace =
            |mark, ahead| Token { kind: TokenKind::Mark(mark), ..self.tokens[self.at + ahead] };
        meant.push(brace(Mark::Open(Bracket::Brace), 0));
        meant.extend(&self.tokens[self.at + 1..self.at + close]);
        meant.push(brace(Mark::Close(Bracket::Brace), close));
        self.at += close + 1;
    }

    /// `cube([1, 2, 3]);` behind `translate([0, 0, 1])`: it belongs to that mistake.
    fn drop_moved(&mut self, name: usize) {
        let named = matches!(self.kind(name), Some(TokenKind::Name | TokenKind::Word(_)));
        let Some(mut last) = self.closed(name + 1, Bracket::Round).filter(|_| named) else {
            return;
        };
        last += usize::from(self.is(last + 1, Mark::Semicolon));
        self.dropped.extend((name..=last).map(|ahead| (self.at + ahead, false)));
    }

    /// Whether an object begins at `ahead`.
    fn begins_object(&self, ahead: usize) -> bool {
        match self.kind(ahead) {
            Some(TokenKind::Word(word)) => {
                matches!(word.family(), Family::Shape | Family::Csg) || word == Word::Object
            }
            Some(TokenKind::Name) => self.is(ahead + 1, Mark::Open(Bracket::Round)),
            _ => false,
        }
    }

    /// Where `vec3(1, 0, 0)` ends, if one stands at `ahead`.
    pub(super) fn makes_vector(&self, ahead: usize) -> Option<usize> {
        let made = self.kind(ahead) == Some(TokenKind::Name) && MAKERS.contains(&self.slice(ahead));
        let open = made && self.is(ahead + 1, Mark::Open(Bracket::Round));
        self.row(ahead + 1, Bracket::Round, false).filter(|_| open)
    }

    /// `[0.5 1.25 -0.75]`, as numpy prints a vector: where it closes, with two to five plain numbers in it.
    fn row_without_commas(&self, open: usize) -> Option<usize> {
        let (mut close, mut numbers) = (open + 1, 0);
        loop {
            let is_signed = self.is(close, Mark::Minus) && self.touches(close + 1);
            let number = close + usize::from(is_signed);
            if self.kind(number) != Some(TokenKind::Number) {
                break;
            }
            numbers += 1;
            close = number + 1;
        }
        let closes = self.is(close, Mark::Close(Bracket::Square));
        (closes && (2..=5).contains(&numbers)).then_some(close)
    }

    /// Where the bracket that opens at `open` closes, with two to five values in it and nothing else: plain
    /// numbers, or names and sums as well.
    fn row(&self, open: usize, bracket: Bracket, plain: bool) -> Option<usize> {
        let (mut close, mut commas, mut number) = (open + 1, 0, false);
        loop {
            match self.kind(close) {
                Some(TokenKind::Number) if !number => number = true,
                Some(TokenKind::Name) if !number && !plain => number = true,
                // `A.x`
                Some(TokenKind::Mark(Mark::Dot)) if number && !plain => close += 1,
                Some(TokenKind::Word(word)) if !number && !plain && word.role() == Role::Value => {
                    number = true;
                }
                Some(TokenKind::Mark(Mark::Minus | Mark::Plus | Mark::Star | Mark::Slash))
                    if number && !plain =>
                {
                    number = false;
                }
                Some(TokenKind::Mark(Mark::Minus | Mark::Plus)) if !number => {}
                Some(TokenKind::Mark(Mark::Comma)) if number => {
                    commas += 1;
                    number = false;
                }
                Some(TokenKind::Mark(Mark::Close(other))) if other == bracket && number => break,
                _ => return None,
            }
            close += 1;
        }
        (1..=4).contains(&commas).then_some(close)
    }
}

/// Whether a value follows a mark in an expression.
fn stands_before_value(mark: Mark) -> bool {
    matches!(
        mark,
        Mark::Plus
            | Mark::Minus
            | Mark::Star
            | Mark::Slash
            | Mark::Comma
            | Mark::Open(Bracket::Round)
            | Mark::Equal
            | Mark::Question
            | Mark::Colon
    )
}
