//! Assignments and operators as other languages write them: `let A = 1`, `A += 1`, `==`, `&&`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::vocabulary::{Family, Role, Word};

/// What declares a name elsewhere.
const DECLARERS: &[&str] = &[
    "let", "var", "const", "def", "define", "set", "float", "double", "int", "vector", "vec3",
    "color3",
];

/// What may stand before one of them.
const QUALIFIERS: &[&str] =
    &["const", "static", "final", "let", "var", "uniform", "in", "public", "constexpr", "auto"];

/// How many tokens behind `+=` the end of its statement is looked for.
const LONGEST_CHANGE: usize = 40;

impl Reader<'_> {
    /// `let A = 1`.
    pub(super) fn declarer(&mut self, meant: &mut Vec<Token>) -> bool {
        // `const float A = 1`
        let last = usize::from(
            QUALIFIERS.contains(&self.slice(0))
                && self.kind(1).is_some()
                && DECLARERS.contains(&self.slice(1))
                && matches!(self.kind(2), Some(TokenKind::Name | TokenKind::Word(_))),
        );
        let fits = DECLARERS.contains(&self.slice(last))
            // A word of the language is told as that.
            && matches!(self.kind(last + 1), Some(TokenKind::Name | TokenKind::Word(_)))
            && self.is(last + 2, Mark::Equal)
            && !(self.is(last + 3, Mark::Equal) && self.touches(last + 3));
        if fits {
            let span = self.span(0, last);
            let word = self.text.get(span.range()).unwrap_or("").to_owned();
            self.at += last;
            let diagnostic = Diagnostic::new(
                Code::UnknownWord,
                format!("a name is declared by `#declare`, not by `{word}`"),
            )
            .at(span, "not a word of the language")
            .help("replace it with `#declare`")
            .fix(span, "#declare");
            // `vec3 A = vec3(1, 2, 3)`
            let made = self.makes_vector(3).map(|close| (self.span(3, 4), self.span(close, close)));
            let diagnostic = match made {
                Some((open, close)) => {
                    self.made = Some(self.at + 3);
                    diagnostic.fix(open, "<").fix(close, ">")
                }
                None => diagnostic,
            };
            self.diagnostics.push(diagnostic);
            meant.push(Token { kind: TokenKind::Directive(Head::Declare), ..self.tokens[self.at] });
            self.at += 1;
        }
        fits
    }

    /// `background = rgb 1;`: what stands in a block is given by an `=`.
    pub(super) fn assigned_block(&mut self, word: Word, meant: &mut Vec<Token>) -> bool {
        let declared = matches!(
            meant.last().map(|token| token.kind),
            Some(TokenKind::Directive(_) | TokenKind::Mark(_))
        ) && !matches!(
            meant.last().map(|token| token.kind),
            Some(TokenKind::Mark(Mark::Semicolon | Mark::Close(_)))
        );
        let opens = word.role() == Role::Statement
            && matches!(
                word.family(),
                Family::Shape | Family::Csg | Family::Camera | Family::Atmosphere | Family::Light
            )
            || word == Word::GlobalSettings;
        let assigns = self.is(1, Mark::Equal) && !(self.is(2, Mark::Equal) && self.touches(2));
        if declared || !opens || !assigns || !self.inside.is_empty() {
            return false;
        }
        let (name, sign) = (word.name(), self.span(1, 1));
        let diagnostic = Diagnostic::new(
            Code::UnexpectedCharacter,
            format!("`{name}` takes what is in it in braces, and no `=`"),
        )
        .at(sign, "expected `{` here");
        if self.is(2, Mark::Open(Bracket::Brace)) {
            self.diagnostics.push(diagnostic.help(format!("write `{name} {{ … }}`")).fix(sign, ""));
            meant.push(self.tokens[self.at]);
            self.at += 2;
            return true;
        }
        let mut end = 2;
        while let Some(token) = self.tokens.get(self.at + end) {
            let before = self.tokens[self.at + end - 1].end as usize;
            let gap = self.text.get(before..token.start as usize).unwrap_or("");
            if gap.contains('\n') || self.is(end, Mark::Semicolon) {
                break;
            }
            end += 1;
        }
        if end == 2 {
            return false;
        }
        let value = self.span(2, end - 1);
        let text = self.text.get(value.range()).unwrap_or("").to_owned();
        let semicolon = usize::from(self.is(end, Mark::Semicolon));
        let whole = sign.to(self.span(end - 1 + semicolon, end - 1 + semicolon));
        let right = format!("{{ {text} }}");
        self.diagnostics.push(diagnostic.help(format!("write `{name} {right}`")).fix(whole, right));
        let place = self.tokens[self.at + 1];
        let mark = |mark| Token { kind: TokenKind::Mark(mark), ..place };
        meant.extend([self.tokens[self.at], mark(Mark::Open(Bracket::Brace))]);
        meant.extend(&self.tokens[self.at + 2..self.at + end]);
        let last = self.tokens[self.at + end - 1];
        meant.push(Token {
            kind: TokenKind::Mark(Mark::Close(Bracket::Brace)),
            start: last.end,
            end: last.end,
        });
        self.at += end + semicolon;
        true
    }

    /// `return a*2`: a body is its value.
    pub(super) fn returns(&mut self) -> bool {
        let begins = match self.kind(1) {
            Some(TokenKind::Name | TokenKind::Number | TokenKind::Word(_)) => true,
            Some(TokenKind::Mark(mark)) => {
                matches!(mark, Mark::Open(Bracket::Round) | Mark::Less | Mark::Minus)
            }
            _ => false,
        };
        if self.slice(0) != "return" || !begins {
            return false;
        }
        let span = self.span(0, 0);
        let gap = Span { start: span.end, end: self.span(1, 1).start, ..span };
        let mut diagnostic =
            Diagnostic::new(Code::UnknownWord, "`return` is not a word of the language")
                .at(span, "a function's body is its value, and a macro's is what is left of it")
                .help("leave it out")
                .fix(span.to(gap), "");
        // `return a*2;`
        let ends = (1..).take_while(|ahead| {
            !matches!(self.kind(*ahead), None | Some(TokenKind::Directive(_)))
                && !self.is(*ahead, Mark::Close(Bracket::Brace))
        });
        if let Some(last) = ends.last().filter(|last| self.is(*last, Mark::Semicolon)) {
            let in_macro = self.kind(last + 1) == Some(TokenKind::Directive(Head::End));
            if in_macro {
                diagnostic = diagnostic.fix(self.span(last, last), "");
            }
            if in_macro || self.is(last + 1, Mark::Close(Bracket::Brace)) {
                self.dropped.insert(self.at + last, false);
            }
        }
        self.diagnostics.push(diagnostic);
        self.at += 1;
        true
    }

    /// `$fn = 50;`: a name with a sign of another language, and its value.
    pub(super) fn dollar(&mut self, meant: &mut Vec<Token>) -> bool {
        let named = self.slice(0) == "$"
            && self.kind(1) == Some(TokenKind::Name)
            && self.touches(1)
            && self.is(2, Mark::Equal);
        if named {
            let (sign, name) = (self.span(0, 0), self.slice(1).to_owned());
            let message = "names have no `$`, and get their values in a `#declare`";
            let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(sign, "not a sign of the language")
                .help(format!("write `#declare {name} = …`"))
                .fix(sign, "#declare ");
            self.diagnostics.push(diagnostic);
            meant.push(Token { kind: TokenKind::Directive(Head::Declare), ..self.tokens[self.at] });
            self.at += 1;
        }
        named
    }

    /// `difference() {`: what opens a block takes nothing in parentheses.
    pub(super) fn empty_parentheses(&mut self, word: Word, meant: &mut Vec<Token>) -> bool {
        let [open, close, block] =
            [Mark::Open(Bracket::Round), Mark::Close(Bracket::Round), Mark::Open(Bracket::Brace)];
        let empty = self.is(1, open) && self.is(2, close) && self.is(3, block);
        let fits = empty && word.role() == Role::Statement;
        if fits {
            let (name, parentheses) = (word.name(), self.span(1, 2));
            // That a word is not built says enough.
            if word.is_built() {
                let message = format!("`{name}` takes no parentheses");
                let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
                    .at(parentheses, "expected `{` here")
                    .help(format!("write `{name} {{ … }}`"))
                    .fix(parentheses, "");
                self.diagnostics.push(diagnostic);
            }
            meant.push(self.tokens[self.at]);
            self.at += 3;
        }
        fits
    }

    /// `A += 1`, `A++`.
    pub(super) fn changes(&mut self, meant: &mut Vec<Token>) -> bool {
        let operator = match self.kind(1) {
            Some(TokenKind::Mark(Mark::Plus)) => "+",
            Some(TokenKind::Mark(Mark::Minus)) => "-",
            Some(TokenKind::Mark(Mark::Star)) => "*",
            Some(TokenKind::Mark(Mark::Slash)) => "/",
            _ => return false,
        };
        let assigns = self.is(2, Mark::Equal) && self.touches(2);
        let same = self.kind(1) == self.kind(2) && self.touches(2) && matches!(operator, "+" | "-");
        let steps = same
            && matches!(
                self.kind(3),
                None | Some(
                    TokenKind::Mark(Mark::Semicolon | Mark::Close(_)) | TokenKind::Directive(_)
                )
            );
        if !assigns && !steps {
            return false;
        }
        let name = self.slice(0).to_owned();
        let sign = format!("{operator}{}", if assigns { "=" } else { operator });
        let value = if assigns { self.changed_by(operator) } else { Some("1".to_owned()) };
        let change = value.clone().unwrap_or_else(|| "…".to_owned());
        let before = meant.last().map(|token| token.kind);
        let declared = match before {
            Some(TokenKind::Directive(Head::Local)) => Some("#local"),
            Some(TokenKind::Directive(Head::Declare)) => Some("#declare"),
            _ => None,
        };
        let head = declared.unwrap_or("#declare");
        let diagnostic = Diagnostic::new(
            Code::UnexpectedCharacter,
            format!("`{sign}` is not an operator of the language"),
        )
        .at(self.span(1, 2), "no value is changed in place")
        .help(format!("write `{head} {name} = {name} {operator} {change};`"));
        // `#declare N = N++`
        if steps && self.is_declared_as(meant, &name) {
            let right = format!("{name} {operator} 1");
            let diagnostic = diagnostic.fix(self.span(0, 2), right);
            self.diagnostics.push(diagnostic);
            meant.push(self.tokens[self.at]);
            self.at += 3;
            return true;
        }
        let reach = if assigns { LONGEST_CHANGE } else { 1 };
        let ends = (3..3 + reach).find(|ahead| self.is(*ahead, Mark::Semicolon));
        let diagnostic = match (value, ends) {
            (Some(value), Some(end)) => {
                let whole = format!("{name} = {name} {operator} {value}");
                let whole = match declared {
                    Some(_) => whole,
                    None => format!("{head} {whole}"),
                };
                diagnostic.fix(self.span(0, end - 1), whole)
            }
            _ => diagnostic,
        };
        self.diagnostics.push(diagnostic);
        // Read as `#declare A = A + …`, with the `#declare` that may stand before it.
        let token = |kind| Token { kind, ..self.tokens[self.at] };
        if declared.is_none() {
            meant.push(token(TokenKind::Directive(Head::Declare)));
        }
        meant.extend([
            token(TokenKind::Name),
            token(TokenKind::Mark(Mark::Equal)),
            token(TokenKind::Name),
        ]);
        if assigns {
            meant.push(self.tokens[self.at + 1]);
        }
        self.at += 3;
        true
    }

    /// What stands behind `A +=` up to the `;` on its line, so that it may stand behind an operator.
    fn changed_by(&self, operator: &str) -> Option<String> {
        let end = (3..3 + LONGEST_CHANGE).find(|ahead| self.is(*ahead, Mark::Semicolon))?;
        let (from, to) = (self.span(3, 3).start as usize, self.span(end, end).start as usize);
        let text = self.text.get(from..to).map(str::trim)?;
        if text.is_empty() || text.contains(['\n', '#', '{']) {
            return None;
        }
        let is_sum = text.chars().skip(1).any(|c| matches!(c, '+' | '-'));
        let is_term = operator == "+" || !(is_sum || operator == "/" && text.contains(['*', '/']));
        Some(if is_term { text.to_owned() } else { format!("({text})") })
    }

    /// Whether what stands before is `#declare name =`.
    fn is_declared_as(&self, meant: &[Token], name: &str) -> bool {
        let [.., head, declared, equal] = meant else { return false };
        matches!(head.kind, TokenKind::Directive(Head::Declare | Head::Local))
            && equal.kind == TokenKind::Mark(Mark::Equal)
            && self.text.get(declared.start as usize..declared.end as usize) == Some(name)
    }

    /// `==`, `&&`, `||`.
    pub(super) fn doubled(&mut self, mark: Mark, meant: &mut Vec<Token>) -> bool {
        if !(self.is(1, mark) && self.touches(1)) {
            return false;
        }
        // `===`, as one other language has it.
        let last = if mark == Mark::Equal && self.is(2, mark) && self.touches(2) { 2 } else { 1 };
        let span = self.span(0, last);
        let (message, help, fix) = match mark {
            Mark::Equal if self.declares() => {
                ("a name gets its value by a single `=`", "replace it with `=`", Some("="))
            }
            Mark::Equal => ("equality is written `=`, not `==`", "replace it with `=`", Some("=")),
            Mark::And => ("`&&` is written `&`", "replace it with `&`", Some("&")),
            Mark::Or => ("`||` is written `|`", "replace it with `|`", Some("|")),
            _ => return false,
        };
        let mut diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(span, "an operator of another language")
            .help(help);
        let compares = self
            .inside
            .last()
            .is_some_and(|inside| inside.is(Bracket::Round) || inside.opens(Word::Function));
        let is_equal = mark == Mark::Equal;
        if let Some(fix) = fix.filter(|_| compares || (is_equal && self.declares())) {
            diagnostic = diagnostic.fix(span, fix);
        } else if fix.is_some() {
            diagnostic = diagnostic.help(match is_equal {
                true => "a comparison stands in parentheses: `(a = b)`",
                false => "a whole condition stands in parentheses: `(a & b)`",
            });
            if is_equal && last == 1 && self.between_single_values() {
                let (before, after) = (self.tokens[self.at - 1], self.tokens[self.at + 2]);
                let at = |place: u32| Span::new(self.file, place as usize, place as usize);
                diagnostic =
                    diagnostic.fix(at(before.start), "(").fix(span, "=").fix(at(after.end), ")");
            }
        }
        self.diagnostics.push(diagnostic);
        // As long as it is written: where it stands alone it is told no second time.
        meant.push(Token { end: span.end, ..self.tokens[self.at] });
        self.at += last + 1;
        true
    }

    /// `#declare A == 1`.
    fn declares(&self) -> bool {
        let head = self.at.checked_sub(2).map(|at| self.tokens[at].kind);
        matches!(head, Some(TokenKind::Directive(Head::Declare | Head::Local)))
    }

    /// `== ` with one name or number on each side, and nothing else.
    fn between_single_values(&self) -> bool {
        let kind = |at: Option<usize>| at.and_then(|at| self.tokens.get(at)).map(|t| t.kind);
        let value = |kind| matches!(kind, Some(TokenKind::Name | TokenKind::Number));
        let parted = |kind| {
            matches!(
                kind,
                Some(
                    TokenKind::Mark(
                        Mark::Comma
                            | Mark::Semicolon
                            | Mark::Equal
                            | Mark::Open(_)
                            | Mark::Close(_)
                    ) | TokenKind::Numbers
                        | TokenKind::Vectors
                        | TokenKind::Triple
                        | TokenKind::Word(_)
                )
            )
        };
        value(kind(self.at.checked_sub(1)))
            && parted(kind(self.at.checked_sub(2)))
            && value(kind(Some(self.at + 2)))
            && parted(kind(Some(self.at + 3)))
    }
}
