//! The heads of directives as other languages write them: `#declare A 3`, a body in braces.

use super::Reader;
use super::case::innermost;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind, directive_word};
use crate::vocabulary::{Role, Word};

impl Reader<'_> {
    /// A directive with its `#`, and a head that is none.
    pub(super) fn head(&mut self, head: Head, meant: &mut Vec<Token>) -> bool {
        match head {
            Head::For => self.counting(meant) || self.then(head, meant) || self.body(head, meant),
            Head::If
            | Head::Elseif
            | Head::While
            | Head::Switch
            | Head::Case
            | Head::Ifdef
            | Head::Ifndef => {
                (head == Head::If && self.choice_by_parameter(meant))
                    || self.more_than_a_name(head, meant)
                    || self.condition(head, meant)
                    || self.then(head, meant)
                    || self.body(head, meant)
            }
            Head::Else if self.kind(1) == Some(TokenKind::Word(Word::If)) => self.else_if(meant),
            Head::Else => {
                self.else_then_if(meant)
                    || self.else_with_condition(meant)
                    || self.body(head, meant)
            }
            Head::Unknown => self.hash_comment(),
            Head::Declare | Head::Local => {
                self.defined_macro(meant)
                    || self.type_before_name(meant)
                    || self.read_as_function(meant)
                    || self.function_of_mathematics(meant)
                    || self.bare_vector(meant)
                    || self.names_of_one(meant)
                    || self.value(head, meant)
            }
            Head::Default => self.default_case(meant) || self.sign_behind_head(meant),
            Head::Version => self.sign_behind_head(meant),
            Head::End => self.end_of_what(meant),
            Head::Include => self.several_includes(meant),
            Head::Debug | Head::Warning | Head::Error => self.printed_parts(meant),
            Head::Macro => {
                self.braced_parameters(meant)
                    || self.parameters_unopened(meant)
                    || self.then(head, meant)
                    || self.body(head, meant)
            }
            Head::Undef => self.name_in_parentheses(head, meant),
            Head::Fopen | Head::Read | Head::Write | Head::Fclose => {
                self.file_directive(head, meant)
            }
            _ => false,
        }
    }

    /// `#macro Ball(Pos, Rad = 1)`: a parameter with a value of its own.
    pub(super) fn default_value(&mut self, meant: &mut [Token]) -> bool {
        let round = TokenKind::Mark(Mark::Open(Bracket::Round));
        let names = meant.iter().rev().take_while(|token| {
            matches!(token.kind, TokenKind::Name | TokenKind::Mark(Mark::Comma))
        });
        let Some(open) = meant.len().checked_sub(names.count() + 1) else { return false };
        let is_head = meant[open].kind == round
            && open >= 2
            && meant[open - 2].kind == TokenKind::Directive(Head::Macro);
        let Some(name) = meant.last().filter(|last| is_head && last.kind == TokenKind::Name) else {
            return false;
        };
        let mut depth = 0;
        let mut length = 1;
        while let Some(kind) = self.kind(length) {
            match kind {
                TokenKind::Mark(Mark::Open(_)) => depth += 1,
                TokenKind::Mark(Mark::Close(_) | Mark::Comma) if depth == 0 => break,
                TokenKind::Mark(Mark::Close(_)) => depth -= 1,
                TokenKind::Directive(_) => return false,
                _ => {}
            }
            length += 1;
        }
        let value = self.span(0, length - 1);
        let name = self.text.get(name.start as usize..name.end as usize).unwrap_or("");
        let given =
            self.text.get(value.start as usize + 1..value.end as usize).unwrap_or("").trim();
        let diagnostic = Diagnostic::new(
            Code::UnexpectedCharacter,
            "a parameter of a macro has no value of its own",
        )
        .at(value, "expected `,` or `)`")
        .help(format!(
            "`optional {name}` may be left out; the macro then sets it: \
                     `#ifndef ({name}) #local {name} = {given}; #end`"
        ));
        self.diagnostics.push(diagnostic);
        self.at += length;
        true
    }

    /// `#default` in a `#switch`, where `#else` is meant.
    fn default_case(&mut self, meant: &mut Vec<Token>) -> bool {
        if self.is(1, Mark::Open(Bracket::Brace)) {
            return false;
        }
        if innermost(meant) != Some(Head::Switch) {
            return false;
        }
        let colon = usize::from(self.is(1, Mark::Colon));
        let span = self.span(0, colon);
        let diagnostic = Diagnostic::new(
            Code::UnknownDirective,
            "in a `#switch` it is `#else` that takes the rest",
        )
        .at(span, "`#default` sets the textures of objects")
        .help("replace it with `#else`")
        .fix(span, "#else");
        self.diagnostics.push(diagnostic);
        meant.push(Token { kind: TokenKind::Directive(Head::Else), ..self.tokens[self.at] });
        self.at += 1 + colon;
        true
    }

    /// Where the line, or what can be an expression on it, ends.
    pub(super) fn line_end(&self, from: usize) -> usize {
        let mut ahead = from;
        while let Some(token) = self.tokens.get(self.at + ahead) {
            let before = self.tokens[self.at + ahead - 1];
            let gap = self.text.get(before.end as usize..token.start as usize).unwrap_or("");
            let ends = match token.kind {
                TokenKind::Directive(_) | TokenKind::Raw => true,
                TokenKind::Mark(Mark::Open(Bracket::Brace) | Mark::Close(Bracket::Brace)) => true,
                TokenKind::Word(word) => word.role() == Role::Statement && word != Word::Range,
                _ => false,
            };
            if ends || gap.contains(['\n', '\r']) {
                break;
            }
            ahead += 1;
        }
        ahead
    }

    pub(super) fn slice_is(&self, ahead: usize, text: &str) -> bool {
        self.kind(ahead) == Some(TokenKind::Name) && self.slice(ahead) == text
    }

    /// `#if (A) { … }`, `#else { … }`: a body in braces, and no `#end` to it.
    fn body(&mut self, head: Head, meant: &mut Vec<Token>) -> bool {
        // `object #if (A) { B } #end`: the braces belong to the word.
        let before = meant.last().map(|token| token.kind);
        if matches!(before, Some(TokenKind::Word(_))) || self.missing_ends() <= 0 {
            return false;
        }
        let last = match head {
            Head::Else => Some(0),
            Head::Macro => self.closed(2, Bracket::Round),
            _ => self.closed(1, Bracket::Round),
        };
        let Some(end) = last.map(|last| last + 1) else { return false };
        // `#macro Values() { 1, 2 } #end`: of a macro it is what it leaves.
        if head == Head::Macro && self.has_own_end(end) {
            return false;
        }
        let word = head.word();
        let message = format!("the body of `#{word}` stands without braces, and ends with `#end`");
        let at = Diagnostic::new(Code::MissingEnd, message);
        let (diagnostic, braced) = self.braces(end, at);
        if !braced {
            return false;
        }
        let brace = self.span(end, end);
        let diagnostic = diagnostic
            .at(brace, "the braces of another language")
            .help(format!("write `#{word} … #end`"));
        self.diagnostics.push(diagnostic);
        self.take(meant);
        true
    }

    /// Whether the braces that open at `ahead` are followed by an `#end` before another directive opens.
    fn has_own_end(&self, ahead: usize) -> bool {
        let Some(close) = self.closed(ahead, Bracket::Brace) else { return false };
        let next = self.tokens[self.at + close..].iter().find_map(|token| match token.kind {
            TokenKind::Directive(head) if head == Head::End || head.opens() => Some(head),
            _ => None,
        });
        next == Some(Head::End)
    }

    /// How many directives lack their `#end`.
    fn missing_ends(&self) -> isize {
        let [missing, _] = self.ends();
        missing
    }

    /// Whether there is an `#end` for a directive that is written without its `#`.
    pub(super) fn surplus_ends(&self) -> bool {
        self.missing_ends() < 0
    }

    /// Takes the braces that open at `ahead` for a body's: they go, and an `#end` comes.
    pub(super) fn braces(&mut self, ahead: usize, diagnostic: Diagnostic) -> (Diagnostic, bool) {
        if !self.is(ahead, Mark::Open(Bracket::Brace)) {
            return (diagnostic, false);
        }
        let Some(close) = self.closed(ahead, Bracket::Brace) else { return (diagnostic, false) };
        let goes_on = matches!(
            self.kind(close + 1),
            Some(
                TokenKind::Word(Word::Else | Word::Elseif)
                    | TokenKind::Directive(Head::Else | Head::Elseif)
            )
        );
        let ended = matches!(
            self.kind(close + 1),
            Some(TokenKind::Word(Word::End) | TokenKind::Directive(Head::End))
        );
        let end = if goes_on || ended { "" } else { "#end" };
        let (open_span, close_span) = (self.span(ahead, ahead), self.span(close, close));
        self.dropped.insert(self.at + ahead, false);
        self.dropped.insert(self.at + close, !end.is_empty());
        (diagnostic.fix(open_span, "").fix(close_span, end), true)
    }

    /// A token that is meant as the end of a body, or as nothing.
    pub(super) fn dropped(&mut self, meant: &mut Vec<Token>) -> bool {
        let Some(&ends) = self.dropped.get(&self.at) else { return false };
        if ends {
            meant.push(Token { kind: TokenKind::Directive(Head::End), ..self.tokens[self.at] });
        }
        self.at += 1;
        true
    }

    /// `#define HALF(a) (a/2)`: a macro on one line.
    fn defined_macro(&mut self, meant: &mut Vec<Token>) -> bool {
        let theirs = directive_word(self.slice(0)).to_owned();
        let is_call = self.is(2, Mark::Open(Bracket::Round)) && self.touches(2);
        let parameters = self.closed(2, Bracket::Round).filter(|_| theirs == "define" && is_call);
        let Some(close) = parameters else { return false };
        let end = self.line_end(close + 1);
        let span = self.span(0, 0);
        let word = Span { start: span.end - theirs.len() as u32, ..span };
        let text = self.text.get(self.span(1, end - 1).range()).unwrap_or("");
        self.diagnostics.push(
            Diagnostic::new(Code::UnknownDirective, format!("`#{theirs}` is not a directive"))
                .at(span, "a directive of another language")
                .help(format!("write `#macro {text} #end`"))
                .fix(word, "macro")
                .fix(self.span(end - 1, end - 1).after(), " #end"),
        );
        meant.push(Token { kind: TokenKind::Directive(Head::Macro), ..self.tokens[self.at] });
        meant.extend(&self.tokens[self.at + 1..=self.at + close]);
        self.at += close + 1;
        self.ends_before.insert(self.at + end - close - 1);
        true
    }

    /// `#declare A 3`, `#declare A: 3`, `#declare A := 3`.
    fn value(&mut self, head: Head, meant: &mut Vec<Token>) -> bool {
        if self.kind(1) != Some(TokenKind::Name) {
            return false;
        }
        let starts = |kind: Option<TokenKind>| match kind {
            Some(TokenKind::Number | TokenKind::String | TokenKind::Mark(Mark::Less)) => true,
            Some(TokenKind::Word(word)) => word.role() == Role::Statement,
            _ => false,
        };
        let colon = self.is(2, Mark::Colon);
        let assigns = colon && self.is(3, Mark::Equal) && self.touches(3);
        // `#declare Mat.001 = …` is no name.
        let misses = colon || (starts(self.kind(2)) && !self.is_hyphen_name(1));
        let word = head.word();
        let theirs = directive_word(self.slice(0)).to_owned();
        if !misses && theirs == word {
            return false;
        }
        let used = if assigns { 4 } else { 2 + usize::from(colon) };
        let (place, fix) = match colon {
            true => (self.span(2, used - 1), if self.touches(2) { " =" } else { "=" }),
            false => (self.span(1, 1).after(), " ="),
        };
        let mut diagnostic = if theirs == word {
            let (at, label) = match colon {
                true => (place, "expected `=`"),
                false => (place, "expected `=` here"),
            };
            let message = format!("`#{word}` gives a name its value by `=`");
            let name = self.slice(1);
            Diagnostic::new(Code::ExpectedExpression, message)
                .at(at, label)
                .help(format!("write `#{word} {name} = …`"))
        } else {
            // `#define A 3`
            let span = self.span(0, 0);
            let start = span.end - theirs.len() as u32;
            Diagnostic::new(Code::UnknownDirective, format!("`#{theirs}` is not a directive"))
                .at(span, "unknown word after `#`")
                .help(format!("did you mean `#{word}`?"))
                .fix(Span { start, ..span }, word)
        };
        if misses {
            diagnostic = diagnostic.fix(place, fix);
        }
        self.diagnostics.push(diagnostic);
        meant.extend([self.tokens[self.at], self.tokens[self.at + 1]]);
        if misses {
            meant.push(Token { kind: TokenKind::Mark(Mark::Equal), ..self.tokens[self.at + 1] });
        }
        self.at += if misses { used } else { 2 };
        true
    }
}
