//! Habits of other languages, a file each: directives, loops, cases and macros as they write them, their operators,
//! names, numbers, vectors and strings, the parts of blocks by name, and what a text around a scene leaves in it.
//!
//! **In:** the tokens. **Out:** the tokens that were meant, and one message for each habit.
//! **Invariant:** a text without mistakes passes unchanged: nothing here is a form of the language.

use std::cell::OnceCell;
use std::collections::{BTreeMap, HashMap, HashSet};

mod array;
mod assign;
mod bare;
mod branch;
mod called;
mod case;
mod component;
mod condition;
mod counting;
mod declared;
mod directive;
mod dotted;
mod file;
mod formula;
mod head;
mod known;
mod letter;
mod line;
mod map;
mod name;
mod number;
mod operation;
mod operator;
mod part;
mod reserved;
mod sample;
mod scad;
mod sign;
mod template;
mod unopened;
mod vector;
mod web;

use self::known::Known;
use self::letter::Foreign;
pub(super) use self::number::is_no_number;
use self::part::Inside;
pub(super) use self::web::color_at;
use super::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};
use crate::vocabulary::{Dialect, Word};

pub(super) fn translate(
    tokens: Vec<Token>,
    text: &str,
    file: FileId,
    dialect: Dialect,
    diagnostics: &mut Diagnostics,
) -> Vec<Token> {
    let mut reader = Reader {
        tokens: &tokens,
        at: 0,
        text,
        file,
        dialect,
        inside: Vec::new(),
        dropped: HashMap::new(),
        ends_before: HashSet::new(),
        made: None,
        named: None,
        closers: OnceCell::new(),
        known: OnceCell::new(),
        missing_ends: OnceCell::new(),
        foreign: Foreign::new(),
        hyphens: BTreeMap::new(),
        reserved: BTreeMap::new(),
        ascii: text.is_ascii(),
        diagnostics,
    };
    let mut meant = Vec::with_capacity(tokens.len());
    reader.find_hyphens();
    reader.find_reserved();
    while reader.at < tokens.len() {
        if !reader.literal_vector(&mut meant) && !reader.habit(&mut meant) {
            reader.take(&mut meant);
        }
    }
    let end = tokens.last().map_or(0, |last| last.end);
    for _ in reader.ends_before.drain() {
        meant.push(Token { kind: TokenKind::Directive(Head::End), start: end, end });
    }
    while let Some(inside) = reader.inside.pop() {
        reader.leave(inside);
    }
    let hyphens = std::mem::take(&mut reader.hyphens).into_values().map(|(told, _)| told);
    let reserved = std::mem::take(&mut reader.reserved).into_values().map(|(told, _)| told);
    let names = hyphens.chain(reserved);
    for told in std::mem::take(&mut reader.foreign).into_values().chain(names) {
        reader.diagnostics.push(told);
    }
    meant
}

struct Reader<'a> {
    tokens: &'a [Token],
    at: usize,
    text: &'a str,
    file: FileId,
    dialect: Dialect,
    /// The brackets around the place reached.
    inside: Vec<Inside>,
    /// Tokens to be left out, such as the braces of a directive's body; and whether each is meant as `#end`.
    dropped: HashMap<usize, bool>,
    /// Tokens before which an `#end` is meant.
    ends_before: HashSet<usize>,
    /// The call that makes a vector, as has been told with its declaration.
    made: Option<usize>,
    /// Where the parenthesis of the last call opens whose arguments have names, as has been told.
    named: Option<u32>,
    /// Where the bracket that opens at a token closes.
    closers: OnceCell<HashMap<usize, usize>>,
    /// The names that the text declares anywhere.
    known: OnceCell<Known<'a>>,
    /// How many directives lack their `#end`, and how often `#else #if` stands on one line.
    missing_ends: OnceCell<[isize; 2]>,
    foreign: Foreign,
    /// Declared names that cannot be, such as `my-size`; what is said of each, and its plain spelling.
    hyphens: BTreeMap<String, (Diagnostic, String)>,
    /// Words of the language that are declared as names; what is said of each, and a name that is free.
    reserved: BTreeMap<&'static str, (Diagnostic, String)>,
    /// The text has no character beyond ASCII.
    ascii: bool,
    diagnostics: &'a mut Diagnostics,
}

impl Reader<'_> {
    /// Takes a token as it stands.
    fn take(&mut self, meant: &mut Vec<Token>) {
        let token = self.tokens[self.at];
        match token.kind {
            TokenKind::Mark(Mark::Open(bracket)) => self.enter(bracket, meant.last()),
            TokenKind::Mark(Mark::Close(_)) => {
                if let Some(inside) = self.inside.pop() {
                    self.leave(inside);
                }
            }
            _ => {}
        }
        meant.push(token);
        self.at += 1;
    }

    fn kind(&self, ahead: usize) -> Option<TokenKind> {
        self.tokens.get(self.at + ahead).map(|token| token.kind)
    }

    fn is(&self, ahead: usize, mark: Mark) -> bool {
        self.kind(ahead) == Some(TokenKind::Mark(mark))
    }

    /// Whether nothing stands between the token at `ahead` and the one before it.
    fn touches(&self, ahead: usize) -> bool {
        match (self.tokens.get(self.at + ahead - 1), self.tokens.get(self.at + ahead)) {
            (Some(before), Some(after)) => before.end == after.start,
            _ => false,
        }
    }

    fn span(&self, from: usize, to: usize) -> Span {
        let (from, to) = (self.tokens[self.at + from], self.tokens[self.at + to]);
        Span::new(self.file, from.start as usize, to.end as usize)
    }

    fn slice(&self, ahead: usize) -> &str {
        let token = self.tokens[self.at + ahead];
        self.text.get(token.start as usize..token.end as usize).unwrap_or("")
    }

    /// Takes a habit that starts here, if one does.
    fn habit(&mut self, meant: &mut Vec<Token>) -> bool {
        if !self.ends_before.is_empty() && self.ends_before.remove(&self.at) {
            meant.push(Token { kind: TokenKind::Directive(Head::End), ..self.tokens[self.at] });
        }
        if !self.dropped.is_empty() && self.dropped(meant) {
            return true;
        }
        let kind = self.tokens[self.at].kind;
        if !self.ascii
            && matches!(kind, TokenKind::Name | TokenKind::Word(_) | TokenKind::Stray)
            && self.letters(meant)
        {
            return true;
        }
        if !self.hyphens.is_empty()
            && matches!(kind, TokenKind::Name | TokenKind::Word(_) | TokenKind::Number)
            && self.hyphens(meant)
        {
            return true;
        }
        match kind {
            TokenKind::Word(word) if self.opens_block(word) => self.operation(word, meant),
            TokenKind::Word(word) if self.reserved(word, meant) => true,
            TokenKind::Word(Word::If) if self.choice_behind(meant) => true,
            TokenKind::Word(Word::Transmit | Word::Filter) if self.clear_in_vector(meant) => true,
            TokenKind::Word(word) => {
                self.named_components(meant)
                    || self.times(meant)
                    || self.parted_word(meant)
                    || (word == Word::Int && self.declarer(meant))
                    || (word == Word::Function
                        && (self.function_alone(meant) || self.definer(meant)))
                    || (word == Word::Version && self.version_without_hash(meant))
                    || self.case(word, meant)
                    || self.head_without_hash(word, meant)
                    || self.scad(meant)
                    || self.empty_parentheses(word, meant)
                    || self.operation(word, meant)
                    || self.member(meant)
                    || self.assigned_block(word, meant)
                    || self.part(meant)
            }
            TokenKind::Name => {
                self.suffix(meant)
                    || self.letter_in_number(meant)
                    || self.parted_exponent(meant)
                    || self.exponent_of_fortran(meant)
                    || self.numbered_name(meant)
                    || self.member(meant)
                    || self.number_of_python(meant)
                    || self.times(meant)
                    || self.space_of_names()
                    || self.parted_word(meant)
                    || self.parted_standard_name(meant)
                    || self.declarer(meant)
                    || self.definer(meant)
                    || self.library(meant)
                    || self.method(meant)
                    || self.made_by_new()
                    || self.include_of_others(meant)
                    || self.console(meant)
                    || self.returns()
                    || self.changes(meant)
                    || self.logic(meant)
                    || self.scad(meant)
                    || self.vector(meant)
                    || self.part(meant)
                    || self.bare_string(meant)
                    || self.formatted_string(meant)
            }
            TokenKind::Directive(Head::Unknown)
                if self.web_color(meant) || self.number_of_c(meant) =>
            {
                true
            }
            TokenKind::Directive(head) => self.head(head, meant),
            TokenKind::Stray => {
                self.vulgar_fraction(meant)
                    || self.web_color(meant)
                    || self.time_with_sign(meant)
                    || self.dollar(meant)
                    || self.template(meant)
                    || self.percent(meant)
                    || self.operator(meant)
                    || self.single_quotes(meant)
                    || (!self.ascii && self.sign(meant))
            }
            TokenKind::Mark(Mark::Open(Bracket::Square)) => {
                self.entry_in_entry(meant)
                    || self.sizes_by_comma(meant)
                    || self.array_list(Bracket::Square, meant)
                    || self.vector(meant)
            }
            TokenKind::Mark(Mark::Open(Bracket::Brace)) => {
                self.template(meant) || self.vector(meant)
            }
            TokenKind::String => self.quotes_within(meant) || self.part(meant),
            TokenKind::Number => {
                self.range_of_dots(meant) || self.hexadecimal_color(meant) || self.map(meant)
            }
            TokenKind::Mark(Mark::Open(Bracket::Round)) => {
                self.uncertain_number(meant)
                    || self.times_group(meant)
                    || self.array_list(Bracket::Round, meant)
                    || self.map(meant)
                    || self.vector(meant)
            }
            TokenKind::Mark(Mark::Dot) => {
                self.dots()
                    || self.truth_of_fortran(meant)
                    || self.parted_number(meant)
                    || self.color_by_dot(meant)
            }
            TokenKind::Mark(Mark::Comma) => self.second_name(meant),
            TokenKind::Mark(Mark::Colon) => {
                self.colon_before_block(meant) || self.colon_in_entry(meant)
            }
            TokenKind::Mark(Mark::Semicolon) => self.semicolon_in_list(meant),
            TokenKind::Mark(Mark::Equal)
                if self.formula_behind_sign(meant)
                    || self.values_behind_sign(meant)
                    || self.default_value(meant)
                    || self.named_argument(meant) =>
            {
                true
            }
            TokenKind::Mark(Mark::Minus) => {
                self.options_of_command_line(meant)
                    || self.arrow(meant)
                    || self.comment_of_dashes(meant)
            }
            TokenKind::Mark(Mark::Slash) => self.half_comment(meant),
            TokenKind::Mark(Mark::Less) if self.comment_of_html() || self.doubled_angle() => true,
            TokenKind::Mark(Mark::Or) if self.length_between_bars(meant) => true,
            TokenKind::Mark(Mark::Plus) if self.options_of_command_line(meant) => true,
            TokenKind::Mark(Mark::Greater)
                if self.quoted_lines(meant) || self.unopened_vector(meant) =>
            {
                true
            }
            TokenKind::Mark(Mark::Equal | Mark::Less) if self.turned(meant) => true,
            TokenKind::Mark(Mark::Star)
                if self.number_without_room(meant) || self.operator(meant) =>
            {
                true
            }
            TokenKind::Mark(mark @ (Mark::Equal | Mark::And | Mark::Or)) => {
                self.doubled(mark, meant)
            }
            _ => false,
        }
    }

    /// `if (…)`, `declare A = …`: the word of a directive where only its `#` makes sense.
    fn head_without_hash(&mut self, word: Word, meant: &mut Vec<Token>) -> bool {
        let after_paren = self.is(1, Mark::Open(Bracket::Round));
        let names = matches!(self.kind(1), Some(TokenKind::Name));
        let fits = match word {
            Word::For => after_paren || names,
            Word::If | Word::While | Word::Switch | Word::Elseif | Word::Ifdef | Word::Ifndef => {
                // `(1 if A else 2)` is no directive.
                after_paren || !self.inside.last().is_some_and(|i| i.is(Bracket::Round))
            }
            Word::Declare | Word::Local | Word::Macro | Word::Undef => names,
            Word::Include => self.kind(1) == Some(TokenKind::String),
            Word::Else | Word::End => true,
            _ => return false,
        };
        if !fits {
            return false;
        }
        let name = word.name();
        let span = self.span(0, 0);
        if word == Word::End && case::innermost(meant).is_none() {
            let diagnostic = Diagnostic::new(Code::StrayDirective, "this `end` ends nothing")
                .at(span, "no directive is open here, and blocks end with `}`")
                .help("leave it out")
                .fix(span, "");
            self.diagnostics.push(diagnostic);
            self.at += 1;
            return true;
        }
        if word == Word::If && self.choice_in_formula(meant) {
            return true;
        }
        if word == Word::For && self.counting(meant) {
            return true;
        }
        if word == Word::Else && self.kind(1) == Some(TokenKind::Word(Word::If)) {
            return self.else_if(meant);
        }
        let diagnostic =
            Diagnostic::new(Code::UnknownDirective, format!("`{name}` needs a `#` before it"))
                .at(span, "a directive without its `#`")
                .help(format!("write `#{name}`"))
                .fix(Span { end: span.start, ..span }, "#");
        let diagnostic = self.without_hash(word, diagnostic);
        if !after_paren
            && matches!(
                word,
                Word::If | Word::While | Word::Switch | Word::Elseif | Word::Ifdef | Word::Ifndef
            )
        {
            return self.bare_condition(Head::from_word(name), diagnostic, meant);
        }
        let body = match word {
            Word::Else => Some(1),
            _ if after_paren => self.closed(1, Bracket::Round).map(|close| close + 1),
            _ => None,
        };
        let diagnostic = match body {
            Some(body) => self.braces(body, diagnostic).0,
            None => diagnostic,
        };
        self.diagnostics.push(diagnostic);
        meant.push(Token {
            kind: TokenKind::Directive(Head::from_word(name)),
            ..self.tokens[self.at]
        });
        self.at += 1;
        true
    }

    /// Where the bracket that opens at `ahead` closes, if it is this kind of bracket.
    fn closed(&self, ahead: usize, bracket: Bracket) -> Option<usize> {
        if !self.is(ahead, Mark::Open(bracket)) {
            return None;
        }
        self.closer(self.at + ahead).map(|close| close - self.at)
    }

    /// Where the bracket that opens at a token closes.
    fn closer(&self, opener: usize) -> Option<usize> {
        let closers = self.closers.get_or_init(|| {
            let (mut open, mut closers) = ([vec![], vec![], vec![]], HashMap::new());
            for (at, token) in self.tokens.iter().enumerate() {
                match token.kind {
                    TokenKind::Mark(Mark::Open(bracket)) => open[bracket as usize].push(at),
                    TokenKind::Mark(Mark::Close(bracket)) => {
                        if let Some(opener) = open[bracket as usize].pop() {
                            closers.insert(opener, at);
                        }
                    }
                    _ => {}
                }
            }
            closers
        });
        closers.get(&opener).copied()
    }
}
