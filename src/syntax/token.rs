//! Splits a text into tokens; the only module that uses pest.
//!
//! **In:** a text without comments. **Out:** its tokens, in order, without blanks. **Invariant:** every byte
//! that is not blank is in exactly one token.

use std::collections::HashMap;

use pest::Parser;
use pest_derive::Parser;

use super::numeric;
use crate::vocabulary::Word;

#[derive(Parser)]
#[grammar = "../grammar/lucarne.pest"]
struct Grammar;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Token {
    pub kind: TokenKind,
    pub start: u32,
    pub end: u32,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TokenKind {
    Word(Word),
    Name,
    Number,
    String,
    /// Literals, each followed by a comma.
    Numbers,
    /// Vectors of literals, each followed by a comma.
    Vectors,
    /// A vector of three literals (see `compact`).
    Triple,
    Mark(Mark),
    Directive(Head),
    /// A brace that pairs only after expansion.
    LooseOpen,
    LooseClose,
    /// Replaces the body of a macro whose other brackets pair only after expansion.
    Raw,
    /// Replaces a body that stays text until it is run.
    Unread,
    /// A character without meaning, or a `#` without a word.
    Stray,
}

/// Brackets, separators and operators.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mark {
    Open(Bracket),
    Close(Bracket),
    Comma,
    Semicolon,
    Dot,
    Plus,
    Minus,
    Star,
    Slash,
    Not,
    Less,
    LessOrEqual,
    Equal,
    NotEqual,
    GreaterOrEqual,
    Greater,
    And,
    Or,
    Question,
    Colon,
}

/// The brackets that pair regardless of what is between them (`<` does not).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Bracket {
    Brace,
    Square,
    Round,
}

impl Bracket {
    pub fn opener(self) -> char {
        match self {
            Bracket::Brace => '{',
            Bracket::Square => '[',
            Bracket::Round => '(',
        }
    }

    pub fn closer(self) -> char {
        match self {
            Bracket::Brace => '}',
            Bracket::Square => ']',
            Bracket::Round => ')',
        }
    }
}

macro_rules! heads {
    ($($variant:ident $word:literal)*) => {
        /// The keyword of a directive.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub(super) enum Head { $($variant,)* Unknown }

        impl Head {
            pub const WORDS: &[&str] = &[$($word),*];

            pub fn from_word(word: &str) -> Self {
                match word { $($word => Head::$variant,)* _ => Head::Unknown }
            }

            pub fn word(self) -> &'static str {
                match self { $(Head::$variant => $word,)* Head::Unknown => "" }
            }
        }
    };
}

heads! {
    Declare "declare" Local "local" Undef "undef"
    If "if" Ifdef "ifdef" Ifndef "ifndef" Else "else" Elseif "elseif" End "end"
    While "while" For "for" Switch "switch" Case "case" Range "range" Break "break"
    Macro "macro" Include "include" Default "default" Version "version"
    Debug "debug" Warning "warning" Error "error"
    Fopen "fopen" Fclose "fclose" Read "read" Write "write"
    Render "render" Statistics "statistics"
}

impl Head {
    /// Returns whether the directive ends with its own `#end`.
    pub fn opens(self) -> bool {
        matches!(
            self,
            Head::If
                | Head::Ifdef
                | Head::Ifndef
                | Head::While
                | Head::For
                | Head::Switch
                | Head::Macro
        )
    }

    /// Returns whether the directive starts another branch.
    pub fn divides(self) -> bool {
        matches!(self, Head::Else | Head::Elseif | Head::Case | Head::Range)
    }
}

/// The longest stretch of words and marks whose tokens are remembered, and the most of them.
const STRETCH: usize = 256;
const STRETCHES: usize = 4096;

/// Returns all tokens of a text.
///
/// A text that a program writes repeats what stands between its numbers: the grammar splits each such stretch
/// of words and marks once.
pub(super) fn tokens(text: &str) -> Vec<Token> {
    let mut tokens = Vec::with_capacity(text.len() / 3);
    let mut known: HashMap<&str, Vec<Token>> = HashMap::new();
    let bytes = text.as_bytes();
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        if numeric::is_blank(byte) {
            at += 1;
            continue;
        }
        if numeric::is_figure(byte) {
            at = numeric::part(text, at, numeric::end(bytes, at), &mut tokens);
            continue;
        }
        // A word may belong to the `#` before it.
        let is_behind_hash = tokens.last().is_some_and(|last| last.kind == TokenKind::Stray);
        let end = if is_behind_hash { at } else { end_of_stretch(bytes, at) };
        let Some(stretch) = text.get(at..end).filter(|stretch| !stretch.is_empty()) else {
            let behind = split(text, at, Rule::token, &mut tokens);
            // The grammar accepts every character.
            at = if behind > at { behind } else { text.len() };
            continue;
        };
        let moved = |token: &Token| Token {
            kind: token.kind,
            start: token.start + at as u32,
            end: token.end + at as u32,
        };
        match known.get(stretch) {
            Some(parts) => tokens.extend(parts.iter().map(moved)),
            None => {
                let mut parts = Vec::new();
                split(stretch, 0, Rule::stretch, &mut parts);
                tokens.extend(parts.iter().map(moved));
                if known.len() < STRETCHES {
                    known.insert(stretch, parts);
                }
            }
        }
        at = end;
    }
    tokens
}

/// Returns the end of the words, marks and blanks from `at` on. It is the end of a token.
fn end_of_stretch(bytes: &[u8], at: usize) -> usize {
    let mut end = at;
    while let Some(byte) = bytes.get(end)
        && end < at + STRETCH
    {
        end += 1;
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'_' => {
                while let Some(b'a'..=b'z' | b'A'..=b'Z' | b'_' | b'0'..=b'9') = bytes.get(end) {
                    end += 1;
                }
            }
            b'{'..=b'}' | b'('..=b'*' | b'=' | b':' | b';' | b'[' | b']' | b'?' | b'&' => {}
            byte if numeric::is_blank(*byte) => {}
            _ => return end - 1,
        }
    }
    end
}

/// Adds the tokens that the grammar finds by a rule in the text from `from` on, and returns the end of the last.
fn split(text: &str, from: usize, rule: Rule, tokens: &mut Vec<Token>) -> usize {
    let Some(pairs) = text.get(from..).and_then(|rest| Grammar::parse(rule, rest).ok()) else {
        return from;
    };
    let mut behind = from;
    for pair in pairs.flatten().filter(|pair| pair.as_rule() == Rule::token) {
        let start = from + pair.as_span().start();
        let token = pair.as_str();
        if start < behind {
            continue;
        }
        behind = start + token.len();
        let kind = match token.as_bytes() {
            [byte, ..] if numeric::is_figure(*byte) => {
                behind = numeric::part(text, start, behind, tokens);
                continue;
            }
            [b'a'..=b'z' | b'A'..=b'Z' | b'_', ..] => word(token),
            [b'#', _, ..] => {
                let word = token[1..].trim_start_matches([' ', '\t']);
                TokenKind::Directive(Head::from_word(word))
            }
            [b'"', _, ..] => TokenKind::String,
            _ => mark(token),
        };
        match (kind, tokens.last_mut()) {
            // The word may be on a line after its `#`.
            (TokenKind::Word(_) | TokenKind::Name, Some(hash))
                if hash.kind == TokenKind::Stray
                    && text.get(hash.start as usize..hash.end as usize) == Some("#")
                    && Head::WORDS.contains(&token) =>
            {
                hash.kind = TokenKind::Directive(Head::from_word(token));
                hash.end = behind as u32;
            }
            _ => tokens.push(Token { kind, start: start as u32, end: behind as u32 }),
        }
    }
    behind
}

/// Returns the keyword of a directive, without its `#` and the blanks between the two.
pub(super) fn directive_word(directive: &str) -> &str {
    directive.trim_start_matches(|c: char| c == '#' || c.is_whitespace())
}

/// Returns a keyword, or a name.
pub(super) fn word(text: &str) -> TokenKind {
    Word::from_name(text).map_or(TokenKind::Name, TokenKind::Word)
}

/// Returns the marks that do not occur in numeric text.
fn mark(text: &str) -> TokenKind {
    TokenKind::Mark(match text {
        "{" => Mark::Open(Bracket::Brace),
        "}" => Mark::Close(Bracket::Brace),
        "[" => Mark::Open(Bracket::Square),
        "]" => Mark::Close(Bracket::Square),
        "(" => Mark::Open(Bracket::Round),
        ")" => Mark::Close(Bracket::Round),
        ";" => Mark::Semicolon,
        "*" => Mark::Star,
        "!" => Mark::Not,
        "=" => Mark::Equal,
        "!=" => Mark::NotEqual,
        "&" => Mark::And,
        "|" => Mark::Or,
        "?" => Mark::Question,
        ":" => Mark::Colon,
        _ => return TokenKind::Stray,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds(text: &str) -> Vec<(TokenKind, &str)> {
        tokens(text).iter().map(|t| (t.kind, &text[t.start as usize..t.end as usize])).collect()
    }

    #[test]
    fn a_run_needs_eight_literals_each_with_its_comma() {
        let run = "1, -2,3.5 ,.5,5.,1e5,7,8,";
        assert_eq!(
            kinds(&format!("{run} 9")),
            [(TokenKind::Numbers, &format!("{run} ")[..]), (TokenKind::Number, "9"),]
        );
        assert_eq!(kinds("1,2,3,4,5,6,7,8").len(), 15);
    }

    #[test]
    fn vectors_of_literals_make_a_run() {
        let run = "<1,-2, 3>, ".repeat(8);
        assert_eq!(kinds(&run), [(TokenKind::Vectors, &run[..])]);
        assert_eq!(kinds("<1,2>").len(), 5);
    }

    #[test]
    fn a_directive_takes_its_blanks_and_a_lone_hash_is_stray() {
        assert_eq!(
            kinds("#  debug\"a\"#\nx"),
            [
                (TokenKind::Directive(Head::Debug), "#  debug"),
                (TokenKind::String, "\"a\""),
                (TokenKind::Stray, "#"),
                (TokenKind::Word(Word::X), "x"),
            ]
        );
    }

    #[test]
    fn a_directive_may_have_its_word_on_the_next_line() {
        let head = |head| TokenKind::Directive(head);
        assert_eq!(kinds("#\n declare"), [(head(Head::Declare), "#\n declare")]);
        assert_eq!(
            kinds("#\nend#\n\nelse"),
            [(head(Head::End), "#\nend"), (head(Head::Else), "#\n\nelse")]
        );
    }

    #[test]
    fn stretches_have_the_tokens_that_the_grammar_finds_in_the_whole_text() {
        let text = "sphere{<1,2e5,3>=x a1 }\n#\n if(b!=c)# debug\"a\\\"1\"3e4e5 _x9|[2]?&&:*) \
                    \u{e9}t .5.5 >== 1e1e 2 e1x_ 3 !a ` # 3";
        let whole = text.repeat(3) + &"{ word }".repeat(100) + text;
        let mut expected = Vec::new();
        assert_eq!(split(&whole, 0, Rule::stretch, &mut expected), whole.len());
        assert_eq!(tokens(&whole), expected);
    }

    #[test]
    fn every_character_is_in_a_token_or_blank() {
        let text = "a\u{e9}<=>=!=!{}[]()1.2.3 @ \"x\\\"y\" `";
        let joined: String = kinds(text).iter().map(|(_, text)| *text).collect();
        assert_eq!(joined, text.replace(' ', ""));
    }
}
