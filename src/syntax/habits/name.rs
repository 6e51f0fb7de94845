//! Names as they cannot be: with hyphens, in two words, of a space of names; and words of the language in parts.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::source::Span;
use crate::syntax::token::{Head, Mark, Token, TokenKind};
use crate::vocabulary::{Role, Word, standard_include_of, standard_names};

/// What a vector or a colour is asked for.
const COMPONENTS: &[&str] = &[
    "x", "y", "z", "t", "u", "v", "red", "green", "blue", "filter", "transmit", "gray", "grey",
    "r", "g", "b",
];

/// No word of the language is longer.
const LONGEST_WORD: usize = 30;

impl Reader<'_> {
    /// `Colors::Red`: a name of a space of names.
    pub(super) fn space_of_names(&mut self) -> bool {
        let (colon, second) = (self.is(1, Mark::Colon), self.is(2, Mark::Colon));
        let is_name = matches!(self.kind(3), Some(TokenKind::Name | TokenKind::Word(_)));
        let touch = |at: usize| self.span(at, at).end == self.span(at + 1, at + 1).start;
        if !(colon && second && is_name && (0..3).all(touch)) {
            return false;
        }
        let (whole, name) = (self.span(0, 3), self.slice(3).to_owned());
        self.diagnostics.push(
            Diagnostic::new(
                Code::UnexpectedCharacter,
                "names belong to no space: there is no `::`",
            )
            .at(whole, format!("the name is `{name}`"))
            .fix(self.span(0, 2), ""),
        );
        self.at += 3;
        true
    }

    /// `look at`, `light source { … }`, `max-trace-level`: a word of the language in parts.
    pub(super) fn parted_word(&mut self, meant: &mut Vec<Token>) -> bool {
        if self.next_part(0).is_none() {
            return false;
        }
        let mut found = None;
        let (mut last, mut whole) = (0, self.slice(0).trim_end_matches('_').to_owned());
        while let Some(next) = self.next_part(last) {
            last = next;
            whole = format!("{whole}_{}", self.slice(last));
            if whole.len() > LONGEST_WORD {
                break;
            }
            let word = Word::from_name(&whole).filter(|word| word.role() == Role::Statement);
            found = word.map(|word| (word, last, whole.clone())).or(found);
        }
        let Some((word, last, whole)) = found else { return false };
        let span = self.span(0, last);
        self.diagnostics.push(
            Diagnostic::new(Code::UnknownWord, format!("`{whole}` is one word"))
                .at(span, format!("did you mean `{whole}`?"))
                .help(format!("replace it with `{whole}`"))
                .fix(span, whole),
        );
        meant.push(Token { kind: TokenKind::Word(word), end: span.end, ..self.tokens[self.at] });
        self.at += last + 1;
        true
    }

    /// `T-Stone21`, `T_Stone 21`: a name of a standard include in two parts.
    pub(super) fn parted_standard_name(&mut self, meant: &mut Vec<Token>) -> bool {
        let hyphen = self.is(1, Mark::Minus) && self.touches(1) && self.kind(2).is_some();
        let last = if hyphen && self.touches(2) { 2 } else { 1 };
        let is_part = matches!(self.kind(last), Some(TokenKind::Name | TokenKind::Number));
        if !is_part || !self.slice(0).starts_with(char::is_uppercase) {
            return false;
        }
        let (first, second) = (self.slice(0), self.slice(last));
        let is_known =
            |name: &str| self.declares_anywhere(name) || standard_include_of(name).is_some();
        let joined = [format!("{first}_{second}"), format!("{first}{second}")];
        let whole = joined.into_iter().find(|name| standard_include_of(name).is_some());
        // `Bright-Gold` of an include of one's own is a difference.
        let is_difference = last == 2 && is_known(second) && self.includes_own();
        let is_one = !is_known(first) && !is_difference && !self.breaks_before(last);
        let Some(whole) = whole.filter(|_| is_one) else {
            return false;
        };
        let span = self.span(0, last);
        self.diagnostics.push(
            Diagnostic::new(Code::UndeclaredName, format!("`{whole}` is one name"))
                .at(span, "no blank and no hyphen stands in it")
                .help(format!("did you mean `{whole}`?"))
                .fix(span, whole),
        );
        meant.push(Token { kind: TokenKind::Name, end: span.end, ..self.tokens[self.at] });
        self.at += last + 1;
        true
    }

    /// Whether the text includes a file that is no standard one.
    fn includes_own(&self) -> bool {
        self.tokens.windows(2).any(|two| {
            let name = self.text.get(two[1].start as usize..two[1].end as usize).unwrap_or("");
            two[0].kind == TokenKind::Directive(Head::Include)
                && standard_names(name.trim_matches('"')).next().is_none()
        })
    }

    /// Where a further part of a word stands behind the one at `ahead`, after a blank or a hyphen.
    fn next_part(&self, ahead: usize) -> Option<usize> {
        let hyphen = self.is(ahead + 1, Mark::Minus) && self.touches(ahead + 1);
        let next = if hyphen && self.kind(ahead + 2).is_some() && self.touches(ahead + 2) {
            ahead + 2
        } else {
            ahead + 1
        };
        let is_part = matches!(self.kind(next), Some(TokenKind::Name | TokenKind::Word(_)));
        let start = self.tokens.get(self.at + next)?.start;
        let gap =
            Span { start: self.span(ahead, ahead).end, end: start, ..self.span(ahead, ahead) };
        let is_near =
            self.text.get(gap.range()).is_some_and(|gap| gap.chars().all(|c| " \t-".contains(c)));
        (is_part && is_near).then_some(next)
    }

    /// `#declare my-size = 3`, `#declare my size = 3`: the names that cannot be, and what is said of each.
    pub(super) fn find_hyphens(&mut self) {
        for at in 0..self.tokens.len() {
            if !matches!(self.tokens[at].kind, TokenKind::Directive(Head::Declare | Head::Local)) {
                continue;
            }
            self.at = at;
            let part = |kind| {
                matches!(
                    kind,
                    Some(
                        TokenKind::Name
                            | TokenKind::Word(_)
                            | TokenKind::Number
                            | TokenKind::Mark(Mark::Minus)
                    )
                )
            };
            let mut end = 2;
            while part(self.kind(end)) && self.touches(end) {
                end += 1;
            }
            // Of two words.
            let is_name = |kind| matches!(kind, Some(TokenKind::Name | TokenKind::Word(_)));
            let parted = end == 2
                && self.kind(1) == Some(TokenKind::Name)
                && is_name(self.kind(2))
                && self.is(3, Mark::Equal)
                && !self.is_type(1);
            // `ball.radius`: a component of what is declared is another mistake.
            let dotted = end == 2
                && self.is(2, Mark::Dot)
                && self.touches(2)
                && self.touches(3)
                && is_name(self.kind(3))
                && !COMPONENTS.contains(&self.slice(3));
            let end = match (parted, dotted) {
                (true, _) => 3,
                (_, true) => 4,
                _ => end,
            };
            let assigned = self.is(end, Mark::Equal) && part(self.kind(1)) && end > 2;
            if !assigned || self.is(1, Mark::Minus) {
                continue;
            }
            let span = self.span(1, end - 1);
            let name = self.text.get(span.range()).unwrap_or("").to_owned();
            let digit = name.starts_with(|c: char| c.is_ascii_digit());
            let plain = match parted {
                true => format!("{}_{}", self.slice(1), self.slice(2)),
                false => name.replace(['-', '.'], "_"),
            };
            let plain = if digit { format!("_{plain}") } else { plain };
            let why = match digit {
                true => "a name begins with a letter or `_`",
                false if parted => "a name has no blank in it",
                false if name.contains('-') => "a name has no hyphen in it",
                false => "a name has no dot in it: letters, digits and `_` alone",
            };
            let told = Diagnostic::new(Code::UnexpectedCharacter, format!("`{name}` is no name"))
                .at(span, why)
                .help(format!("write `{plain}`"));
            self.hyphens.entry(name).or_insert((told, plain));
        }
        self.at = 0;
    }

    /// Whether the name at `ahead` is the beginning of one that `find_hyphens` has found.
    pub(super) fn is_hyphen_name(&self, ahead: usize) -> bool {
        let start = self.tokens.get(self.at + ahead).map_or(0, |token| token.start as usize);
        let rest = self.text.get(start..).unwrap_or("");
        self.hyphens.keys().any(|name| rest.starts_with(name.as_str()))
    }

    /// A name that `find_hyphens` has found.
    pub(super) fn hyphens(&mut self, meant: &mut Vec<Token>) -> bool {
        let token = self.tokens[self.at];
        let rest = self.text.get(token.start as usize..).unwrap_or("");
        let ends = |name: &&String| {
            rest.strip_prefix(name.as_str()).is_some_and(|after| {
                !after.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-')
            })
        };
        let Some(name) = self.hyphens.keys().find(ends).cloned() else { return false };
        let end = token.start + name.len() as u32;
        let span = Span { end, ..self.span(0, 0) };
        if let Some((told, plain)) = self.hyphens.get_mut(&name) {
            told.fixes.push(Fix { span, text: plain.clone() });
        }
        meant.push(Token { kind: TokenKind::Name, end, ..token });
        while self.tokens.get(self.at).is_some_and(|token| token.start < end) {
            self.at += 1;
        }
        true
    }
}
