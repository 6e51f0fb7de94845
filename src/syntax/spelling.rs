//! Corrects misspelt keywords of directives, so that one letter does not unbalance a file.

use std::collections::HashSet;

use super::habits::{color_at, is_no_number};
use super::token::{Bracket, Head, Mark, Token, TokenKind, directive_word};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, suggest};
use crate::source::{FileId, Span};
use crate::vocabulary::{Dialect, Role, Word};

/// Spellings of other languages.
const FOREIGN: &[(&str, &str)] = &[
    ("endif", "end"),
    ("endwhile", "end"),
    ("endfor", "end"),
    ("endmacro", "end"),
    ("endswitch", "end"),
    ("next", "end"),
    ("done", "end"),
    ("fin", "end"),
    ("fi", "end"),
    ("ende", "end"),
    ("undefine", "undef"),
    ("wend", "end"),
    ("default_case", "else"),
    ("otherwise", "else"),
    ("elif", "elseif"),
    ("elsif", "elseif"),
    ("foreach", "for"),
    ("forall", "for"),
    ("import", "include"),
    ("print", "debug"),
    ("set", "declare"),
    ("let", "declare"),
    ("var", "declare"),
    ("const", "declare"),
    ("def", "declare"),
];

/// Keywords of other languages before a name and its parameters.
const FUNCTIONS: &[&str] = &["function", "func", "fn", "def", "sub", "proc", "procedure"];

/// Reports every unknown directive, and replaces it by the probable one.
pub(super) fn correct_heads(
    tokens: &mut Vec<Token>,
    text: &str,
    file: FileId,
    dialect: Dialect,
    diagnostics: &mut Diagnostics,
) {
    let (mut before, mut pairs) = (None, HashSet::new());
    for at in 0..tokens.len() {
        let Some(token) = tokens.get(at) else { continue };
        let before = before.replace(token.kind);
        if token.kind != TokenKind::Directive(Head::Unknown) {
            continue;
        }
        let [next, behind] = [1, 2].map(|more| tokens.get(at + more).map(|next| next.kind));
        let each = each_of(&tokens[at..], text);
        let Some(token) = tokens.get_mut(at) else { continue };
        let span = Span::new(file, token.start as usize, token.end as usize);
        let word = directive_word(text.get(span.range()).unwrap_or(""));
        if color_at(text.get(span.start as usize..).unwrap_or(""), before).is_some() {
            // A colour in web notation (habits/web.rs).
            continue;
        }
        if before == Some(TokenKind::Number) && is_no_number(word) {
            // Reported with the number before it (habits/number.rs).
            continue;
        }
        if word == "define" {
            // Reported with the tokens after it, which need correction too (habits/head.rs).
            token.kind = TokenKind::Directive(Head::Declare);
            continue;
        }
        if reads_as_comment(text, span) {
            continue;
        }
        let mut diagnostic =
            Diagnostic::new(Code::UnknownDirective, format!("`#{word}` is not a directive"))
                .at(span, "unknown word after `#`");
        // `#camera { … }`; POV-Ray 3.7 ignores the `#` before any keyword (measured).
        let ours = Word::from_name(word);
        let is_block = is_brace(next) && ours.is_some_and(|ours| ours.role() == Role::Statement);
        if let Some(ours) = ours.filter(|_| is_block || dialect == Dialect::Pov) {
            let start = span.end - word.len() as u32;
            let sign = Span { end: start, ..span };
            let told = diagnostic.help(format!("write `{word}` without `#`")).fix(sign, "");
            diagnostics.push(if dialect == Dialect::Pov { told.as_warning() } else { told });
            *token = Token { kind: TokenKind::Word(ours), start, ..*token };
            continue;
        }
        let is_function = FUNCTIONS.contains(&word) && opens(behind);
        let foreign = FOREIGN.iter().find(|(theirs, _)| *theirs == word).map(|&(_, ours)| ours);
        let foreign = if is_function { Some("macro") } else { foreign };
        let near = foreign
            .or_else(|| suggest::closest(word, Head::WORDS.iter().copied()))
            .or_else(|| suggest::short_of(word, Head::WORDS.iter().copied()));
        // `#foo bar` is not a `#for`.
        let fits = |near: &&str| {
            let head = Head::from_word(near);
            fits(head, next) && (head != Head::For || foreign.is_some() || opens(next))
        };
        if let Some([name, array]) = each {
            let right = format!("#for (I, 0, dimension_size({array}, 1) - 1)");
            diagnostic = diagnostic.help(format!("write `{right}`, and `{array}[I]` for `{name}`"));
            // The name is unknown: its body is not run.
            token.kind = TokenKind::Directive(Head::Ifdef);
            pairs.extend([at + 3, at + 4]);
        } else if let Some(near) = near.filter(fits) {
            let start = span.end - word.len() as u32;
            diagnostic = diagnostic
                .help(format!("did you mean `#{near}`?"))
                .fix(Span { start, ..span }, near);
            token.kind = TokenKind::Directive(Head::from_word(near));
        } else if text.get(span.range()).is_some_and(|head| head[1..].starts_with([' ', '\t'])) {
            // A comment of another language (habits/sign.rs).
            continue;
        }
        if word == "continue" {
            diagnostic =
                diagnostic.help("the rest of the turn stands in a condition: `#if (…) … #end`");
        }
        if diagnostic.help.is_empty()
            && let Some(ours) = suggest::foreign(word).find(|ours| Head::WORDS.contains(ours))
        {
            diagnostic = diagnostic.help(format!("did you mean `#{ours}`?"));
        }
        diagnostics.push(diagnostic);
    }
    if !pairs.is_empty() {
        let mut at = 0..;
        tokens.retain(|_| at.next().is_none_or(|at| !pairs.contains(&at)));
    }
    drop_their_ends(tokens);
}

/// `#foreach (V, A)`: returns the name for each element, and the array.
fn each_of<'a>(tokens: &[Token], text: &'a str) -> Option<[&'a str; 2]> {
    let [head, open, name, comma, array, close, ..] = tokens else { return None };
    let slice = |token: &Token| text.get(token.start as usize..token.end as usize).unwrap_or("");
    let round = |mark: fn(Bracket) -> Mark| TokenKind::Mark(mark(Bracket::Round));
    let is_each = head.kind == TokenKind::Directive(Head::Unknown)
        && matches!(directive_word(slice(head)), "foreach" | "forall")
        && open.kind == round(Mark::Open)
        && name.kind == TokenKind::Name
        && comma.kind == TokenKind::Mark(Mark::Comma)
        && array.kind == TokenKind::Name
        && close.kind == round(Mark::Close);
    is_each.then(|| [slice(name), slice(array)])
}

/// Returns whether `#word` is probably a misspelt directive, or another language's.
pub(super) fn is_near_a_directive(head: &str) -> bool {
    let word = directive_word(head);
    FOREIGN.iter().any(|(theirs, _)| *theirs == word)
        || suggest::closest(word, Head::WORDS.iter().copied()).is_some()
}

/// `# Declare the balls`: returns whether a sentence begins with a keyword (reported in habits/sign.rs).
fn reads_as_comment(text: &str, head: Span) -> bool {
    let word = text.get(head.start as usize + 1..head.end as usize).unwrap_or("");
    let prose = word.starts_with([' ', '\t']) && word.trim_start().starts_with(char::is_uppercase);
    let line = text.get(head.end as usize..).and_then(|rest| rest.split(['\n', '\r']).next());
    prose && line.is_some_and(|line| !line.contains(['=', '(', '"', '{']))
}

fn is_brace(next: Option<TokenKind>) -> bool {
    next == Some(TokenKind::Mark(Mark::Open(Bracket::Brace)))
}

fn opens(next: Option<TokenKind>) -> bool {
    next == Some(TokenKind::Mark(Mark::Open(Bracket::Round)))
}

/// Returns whether the next token can begin a condition, if the directive has one.
fn fits(head: Head, next: Option<TokenKind>) -> bool {
    let has_condition = matches!(head, Head::Elseif | Head::Case | Head::Range)
        || (head.opens() && head != Head::Macro);
    let may_begin = matches!(
        next,
        Some(
            TokenKind::Mark(Mark::Open(Bracket::Round) | Mark::Not)
                | TokenKind::Name
                | TokenKind::Number
        )
    );
    !has_condition || may_begin
}

/// Drops surplus `#end`s: if there are more than directives to end, those of the unknown ones are dropped
/// with them.
fn drop_their_ends(tokens: &mut Vec<Token>) {
    let takes_parentheses = |at: usize| {
        tokens
            .get(at + 1)
            .is_some_and(|next| next.kind == TokenKind::Mark(Mark::Open(Bracket::Round)))
    };
    let mut surplus: isize = 0;
    let (mut open, mut ends) = (Vec::new(), Vec::new());
    for (at, token) in tokens.iter().enumerate() {
        match token.kind {
            TokenKind::Directive(Head::Unknown) if takes_parentheses(at) => open.push(true),
            TokenKind::Directive(Head::End) => {
                surplus += 1;
                if open.pop() == Some(true) {
                    ends.push(at);
                }
            }
            TokenKind::Directive(head) if head.opens() => {
                surplus -= 1;
                open.push(false);
            }
            _ => {}
        }
    }
    let dropped: HashSet<usize> = ends.into_iter().rev().take(surplus.max(0) as usize).collect();
    let mut at = 0..;
    tokens.retain(|_| at.next().is_none_or(|at| !dropped.contains(&at)));
}
