//! Letters and signs beyond ASCII: `Größe`, `−5`, `0，1`, a no-break space.
//!
//! **Invariant:** one message for a whole word, however often it stands in the file, with all its places
//! as fixes; then the word is a name like any other.

use std::collections::BTreeMap;

use super::Reader;
use super::template::STAND_IN;
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::source::Span;
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};
use crate::vocabulary::Word;

/// Words with letters beyond ASCII, and what is said of each.
pub(super) type Foreign = BTreeMap<String, Diagnostic>;

impl Reader<'_> {
    /// Whether a character beyond ASCII stands here that could be part of a name.
    fn is_letter(&self, ahead: usize) -> bool {
        self.kind(ahead) == Some(TokenKind::Stray)
            && self.slice(ahead).chars().all(|c| c.is_alphabetic() || is_combining(c))
    }

    /// A word with letters that no name can have.
    pub(super) fn letters(&mut self, meant: &mut Vec<Token>) -> bool {
        let mut end = 1;
        let mut foreign = self.is_letter(0);
        while self.touches(end)
            && (self.is_letter(end)
                || matches!(
                    self.kind(end),
                    Some(TokenKind::Name | TokenKind::Word(_) | TokenKind::Number)
                ) && self.slice(end).bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_'))
        {
            foreign |= self.is_letter(end);
            end += 1;
        }
        if !foreign {
            return false;
        }
        let span = self.span(0, end - 1);
        let name = self.text.get(span.range()).unwrap_or("").to_owned();
        let declared = meant.last().is_some_and(|l| matches!(l.kind, TokenKind::Directive(_)))
            || self.foreign.contains_key(&name);
        if let Some(known) = likeness(&name).filter(|known| !declared && self.is_known(known)) {
            return self.alike(meant, span, known, end);
        }
        let plain = ascii(&name).filter(|plain| self.is_free(plain));
        match (self.foreign.get_mut(&name), &plain) {
            (Some(told), Some(plain)) => told.fixes.push(Fix { span, text: plain.clone() }),
            (Some(_), None) => {}
            (None, _) => {
                let message = match name.as_str() {
                    "π" => "`π` is written `pi`".to_owned(),
                    _ => format!(
                        "`{name}` is no name: names are written with a to z, digits and `_`"
                    ),
                };
                let mut told = Diagnostic::new(Code::UnexpectedCharacter, message)
                    .at(span, "a letter beyond ASCII stands in it");
                if let Some(plain) = plain {
                    told = told.help(format!("write `{plain}`")).fix(span, plain);
                }
                self.foreign.insert(name, told);
            }
        }
        let place = self.tokens[self.at];
        let kind = match self.text.get(span.range()) {
            Some("π") => TokenKind::Word(Word::Pi),
            _ => TokenKind::Name,
        };
        meant.push(Token { kind, end: span.end, ..place });
        self.at += end;
        true
    }

    /// Whether a name stands in this file, or is a word of the language.
    fn is_known(&self, name: &str) -> bool {
        Word::from_name(name).is_some() || !self.is_free(name)
    }

    /// `Bаse`, with a Cyrillic `а`, where `Base` is known: that is meant.
    fn alike(&mut self, meant: &mut Vec<Token>, span: Span, known: String, used: usize) -> bool {
        let name = self.text.get(span.range()).unwrap_or("");
        let message =
            format!("`{name}` is not `{known}`: a letter of another alphabet looks alike");
        let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(span, "a letter beyond ASCII stands in it")
            .help(format!("replace it with `{known}`"))
            .fix(span, known.clone());
        self.diagnostics.push(diagnostic);
        // What a name stands for is not known here: any value does.
        let word = Word::from_name(&known).unwrap_or(Word::Yes);
        meant.push(Token { kind: TokenKind::Word(word), end: span.end, ..self.tokens[self.at] });
        self.at += used;
        true
    }

    /// The word of the language that an invisible character parts in two.
    fn word_around(&self, meant: &[Token]) -> Option<Word> {
        let (before, after) = (meant.last()?, self.tokens.get(self.at + 1)?);
        let here = self.tokens[self.at];
        let is_part = |kind| matches!(kind, TokenKind::Name | TokenKind::Word(_));
        let touch = before.end == here.start && here.end == after.start;
        if !touch || !is_part(before.kind) || !is_part(after.kind) {
            return None;
        }
        let text = |token: &Token| self.text.get(token.start as usize..token.end as usize);
        Word::from_name(&format!("{}{}", text(before)?, text(after)?))
    }

    /// Whether a name is not used for something else in this file.
    fn is_free(&self, name: &str) -> bool {
        name == "pi"
            || Word::from_name(name).is_none()
                && !(self.tokens.iter()).any(|token| {
                    token.kind == TokenKind::Name
                        && self.text.get(token.start as usize..token.end as usize) == Some(name)
                })
    }

    /// `0·5`, as a fraction is printed in Britain.
    fn raised_point(&mut self, meant: &mut [Token]) -> bool {
        let is_point = matches!(self.slice(0), "·" | "∙" | "⋅");
        let Some(whole) = self.number_before(meant).filter(|_| is_point) else { return false };
        if self.kind(1) != Some(TokenKind::Number) || !self.touches(1) {
            return false;
        }
        let span = Span { start: whole.start, ..self.span(0, 1) };
        let text = self.text.get(span.range()).unwrap_or("").to_owned();
        let number = text.replace(self.slice(0), ".");
        if number.parse::<f64>().is_err() {
            return false;
        }
        self.diagnostics.push(
            Diagnostic::new(Code::MalformedNumber, format!("`{text}` is not a number"))
                .at(span, "a fraction is written with a point")
                .help(format!("write `{number}`"))
                .fix(span, number),
        );
        if let Some(whole) = meant.last_mut() {
            (whole.kind, whole.end) = (STAND_IN, span.end);
        }
        self.at += 2;
        true
    }

    /// `１２．５`, as a keyboard for Chinese or Japanese writes digits.
    fn wide_number(&mut self, meant: &mut Vec<Token>) -> bool {
        let is_wide = |text: &str| text.chars().all(|c| c == '．' || wide_digit(c).is_some());
        if !is_wide(self.slice(0)) {
            return false;
        }
        let mut end = 1;
        while self.touches(end)
            && (self.kind(end) == Some(TokenKind::Number)
                || self.slice(end) == "."
                || is_wide(self.slice(end)))
        {
            end += 1;
        }
        let before = self.number_before(meant);
        let here = self.span(0, end - 1);
        let span = Span { start: before.map_or(here.start, |before| before.start), ..here };
        let text = self.text.get(span.range()).unwrap_or("");
        let narrow = |c: char| match c {
            '．' => '.',
            c => wide_digit(c).and_then(|digit| char::from_digit(digit, 10)).unwrap_or(c),
        };
        let number: String = text.chars().map(narrow).collect();
        if number.parse::<f64>().is_err() {
            return false;
        }
        self.diagnostics.push(
            Diagnostic::new(Code::MalformedNumber, format!("`{text}` is not a number"))
                .at(span, "its digits are wide ones, of another alphabet")
                .help(format!("write `{number}`"))
                .fix(span, number),
        );
        let stand_in = Token { kind: STAND_IN, end: span.end, ..self.tokens[self.at] };
        match (before, meant.last_mut()) {
            (Some(_), Some(whole)) => (whole.kind, whole.end) = (STAND_IN, span.end),
            _ => meant.push(stand_in),
        }
        self.at += end;
        true
    }

    /// A sign that looks like one of the language's.
    pub(super) fn sign(&mut self, meant: &mut Vec<Token>) -> bool {
        let text = self.slice(0).to_owned();
        if self.raised_point(meant) || self.wide_number(meant) {
            return true;
        }
        let Some((name, ours)) = sign(&text) else { return false };
        let span = self.span(0, 0);
        let word = if ours.is_empty() { self.word_around(meant) } else { None };
        let mut diagnostic = Diagnostic::new(
            Code::UnexpectedCharacter,
            format!("{name} has no meaning in the language"),
        );
        diagnostic = match ours {
            " " => diagnostic
                .at(span, "it looks like a blank, and is none")
                .help("write a plain blank"),
            "" => diagnostic.at(span, "nothing is written for it").help("leave it out"),
            ours => diagnostic
                .at(span, format!("expected `{ours}`"))
                .help(format!("replace it with `{ours}`")),
        };
        self.diagnostics.push(diagnostic.fix(span, ours));
        if let Some(word) = word
            && let Some(last) = meant.last_mut()
        {
            // The rest of the word goes with it.
            let end = self.tokens[self.at + 1].end;
            (last.kind, last.end) = (TokenKind::Word(word), end);
            self.at += 1;
        }
        if let Some(mark) = mark(ours) {
            let token = Token { kind: TokenKind::Mark(mark), ..self.tokens[self.at] };
            match mark {
                Mark::Open(bracket) => self.enter(bracket, meant.last()),
                Mark::Close(_) => {
                    if let Some(inside) = self.inside.pop() {
                        self.leave(inside);
                    }
                }
                _ => {}
            }
            meant.push(token);
        }
        self.at += 1;
        true
    }
}

/// Of `０` to `９`.
fn wide_digit(c: char) -> Option<u32> {
    (c as u32).checked_sub('０' as u32).filter(|digit| *digit < 10)
}

/// A letter's accent that is a character of its own.
fn is_combining(c: char) -> bool {
    ('\u{300}'..='\u{36f}').contains(&c)
}

/// A sign's name and what is written for it.
fn sign(text: &str) -> Option<(&'static str, &'static str)> {
    Some(match text {
        "\u{a0}" => ("a no-break space", " "),
        "\u{2000}" | "\u{2001}" | "\u{2002}" | "\u{2003}" | "\u{2004}" | "\u{2005}"
        | "\u{2006}" | "\u{2007}" | "\u{2008}" | "\u{2009}" | "\u{200a}" | "\u{202f}"
        | "\u{3000}" => ("a typographic space", " "),
        "\u{200b}" | "\u{200c}" | "\u{200d}" | "\u{2060}" | "\u{feff}" | "\u{ad}" => {
            ("an invisible character", "")
        }
        "−" | "－" => ("a typographic minus sign", "-"),
        "–" | "—" => ("a dash", "-"),
        "×" | "·" | "∙" | "⋅" => ("a sign of multiplication", "*"),
        "÷" | "∕" => ("a sign of division", "/"),
        "≤" => ("`≤`", "<="),
        "≥" => ("`≥`", ">="),
        "≠" => ("`≠`", "!="),
        "°" => ("a degree sign", ""),
        "，" | "、" => ("a full-width comma", ","),
        "‚" | "،" | "᠂" => ("a sign that looks like a comma", ","),
        "\u{37e}" => ("a Greek question mark", ";"),
        "；" => ("a full-width semicolon", ";"),
        "：" => ("a full-width colon", ":"),
        "（" => ("a full-width parenthesis", "("),
        "）" => ("a full-width parenthesis", ")"),
        "｛" => ("a full-width brace", "{"),
        "｝" => ("a full-width brace", "}"),
        "［" => ("a full-width bracket", "["),
        "］" => ("a full-width bracket", "]"),
        "＜" | "〈" | "⟨" => ("a typographic angle bracket", "<"),
        "＞" | "〉" | "⟩" => ("a typographic angle bracket", ">"),
        "＝" => ("a full-width equals sign", "="),
        "＋" => ("a full-width plus sign", "+"),
        "＊" => ("a full-width asterisk", "*"),
        "／" => ("a full-width slash", "/"),
        "．" => ("a full-width point", "."),
        _ => return None,
    })
}

fn mark(text: &str) -> Option<Mark> {
    Some(match text {
        "-" => Mark::Minus,
        "*" => Mark::Star,
        "/" => Mark::Slash,
        "+" => Mark::Plus,
        "<=" => Mark::LessOrEqual,
        ">=" => Mark::GreaterOrEqual,
        "!=" => Mark::NotEqual,
        "=" => Mark::Equal,
        "," => Mark::Comma,
        ";" => Mark::Semicolon,
        ":" => Mark::Colon,
        "." => Mark::Dot,
        "<" => Mark::Less,
        ">" => Mark::Greater,
        "(" => Mark::Open(Bracket::Round),
        ")" => Mark::Close(Bracket::Round),
        "{" => Mark::Open(Bracket::Brace),
        "}" => Mark::Close(Bracket::Brace),
        "[" => Mark::Open(Bracket::Square),
        "]" => Mark::Close(Bracket::Square),
        _ => return None,
    })
}

/// A name whose letters of other alphabets look like letters that names are written with, in those.
fn likeness(name: &str) -> Option<String> {
    const ALIKE: &str =
        "аaеeоoрpсcхxуyіiѕsјjһhԁdАAВBЕEКKМMНHОOРPСCТTХXУYІIЅSαaοoνvρpΑAΒBΕEΖZΗHΙIΚKΜMΝNΟOΡPΤTΥYΧX";
    // The letters of wide scripts, in the order of ASCII.
    const WIDE: u32 = '！' as u32 - '!' as u32;
    let alike = |c: char| match c {
        _ if c.is_ascii() => Some(c),
        '！'..='～' => char::from_u32(c as u32 - WIDE),
        _ => ALIKE.chars().skip_while(|other| *other != c).nth(1),
    };
    let plain: Option<String> = name.chars().map(alike).collect();
    plain.filter(|plain| {
        plain != name && plain.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
    })
}

/// The usual spelling without accents; none for letters of another script.
fn ascii(name: &str) -> Option<String> {
    if name == "π" {
        return Some("pi".to_owned());
    }
    let mut plain = String::new();
    for c in name.chars().filter(|c| !is_combining(*c)) {
        match c {
            'a'..='z' | 'A'..='Z' | '0'..='9' | '_' => plain.push(c),
            'ä' | 'æ' => plain += "ae",
            'ö' | 'œ' | 'ø' => plain += "oe",
            'ü' => plain += "ue",
            'Ä' | 'Æ' => plain += "Ae",
            'Ö' | 'Œ' | 'Ø' => plain += "Oe",
            'Ü' => plain += "Ue",
            'ß' => plain += "ss",
            'à' | 'á' | 'â' | 'ã' | 'ā' | 'ą' => plain.push('a'),
            'å' => plain += "aa",
            'ç' | 'ć' | 'č' => plain.push('c'),
            'è' | 'é' | 'ê' | 'ë' | 'ē' | 'ę' | 'ě' => plain.push('e'),
            'ì' | 'í' | 'î' | 'ï' | 'ī' | 'ı' => plain.push('i'),
            'ł' => plain.push('l'),
            'ñ' | 'ń' | 'ň' => plain.push('n'),
            'ò' | 'ó' | 'ô' | 'õ' | 'ő' => plain.push('o'),
            'ř' => plain.push('r'),
            'ś' | 'š' | 'ş' => plain.push('s'),
            'ù' | 'ú' | 'û' | 'ů' | 'ű' => plain.push('u'),
            'ý' | 'ÿ' => plain.push('y'),
            'ź' | 'ż' | 'ž' => plain.push('z'),
            'À' | 'Á' | 'Â' | 'Ã' => plain.push('A'),
            'Å' => plain += "Aa",
            'Ç' | 'Ć' | 'Č' => plain.push('C'),
            'È' | 'É' | 'Ê' | 'Ë' => plain.push('E'),
            'Ì' | 'Í' | 'Î' | 'Ï' => plain.push('I'),
            'Ł' => plain.push('L'),
            'Ñ' => plain.push('N'),
            'Ò' | 'Ó' | 'Ô' | 'Õ' => plain.push('O'),
            'Ś' | 'Š' => plain.push('S'),
            'Ù' | 'Ú' | 'Û' => plain.push('U'),
            'Ź' | 'Ż' | 'Ž' => plain.push('Z'),
            _ => return None,
        }
    }
    let begins = plain.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    begins.then_some(plain)
}
