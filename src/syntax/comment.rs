//! Finds comments, which become blanks, and strings without an end.
//!
//! **In:** a text. **Out:** a copy of the same length (one byte longer at most) in which comments are spaces
//! and every string is closed, and the spans of the comments. **Invariant:** comments nest to any depth; a
//! byte outside comments keeps its position and value.

use std::borrow::Cow;
use std::ops::Range;

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};

/// A text with its comments blanked.
pub(super) struct Quiet<'a> {
    pub text: Cow<'a, str>,
    pub comments: Vec<Span>,
}

/// Replaces comments by spaces and closes a string that has no end.
pub(super) fn quiet<'a>(text: &'a str, file: FileId, diagnostics: &mut Diagnostics) -> Quiet<'a> {
    let scan = Scan::of(text, false);
    let (scan, unclosed) = match scan.unclosed_string {
        // An odd quote inverts the rest of the text. Now assume that strings end with their line, and report
        // the first that does not.
        Some(last) => {
            let again = Scan::of(text, true);
            let first = again.unclosed_string.unwrap_or(last);
            (again, Some(first))
        }
        None => (scan, None),
    };
    let mut scan = scan;
    if let Some(quote) = unclosed {
        let line = text[quote..].lines().next().unwrap_or("\"");
        let end = quote + line.trim_end_matches([' ', '\t', '\r', ';', ')', '}']).len();
        let run_together =
            string_run_over_a_comma(text, quote).or_else(|| string_run_together(text, quote));
        let (quote, end, label) = match run_together {
            Some(before) => {
                if let Some(closer) = scan.closers.first_mut() {
                    *closer = before.end;
                }
                (before.start, before.end, "opened here, and the next `\"` begins another")
            }
            None => match string_before_parts(line) {
                Some(length) => {
                    if let Some(closer) = scan.closers.first_mut() {
                        *closer = quote + length;
                    }
                    let comment = line[length..].find("//").map(|at| quote + length + at);
                    scan.comments.extend(comment.map(|at| (at, quote + line.len())));
                    scan.comments.sort_unstable();
                    (quote, quote + length, "opened here, and more than a string follows")
                }
                None => (quote, end, "opened here, and no `\"` follows on this line"),
            },
        };
        let span = |from: usize, to: usize| Span::new(file, from, to);
        diagnostics.push(match quote_within(text, quote) {
            Some(inner) => {
                let message = "a `\"` inside a string is written `\\\"`";
                Diagnostic::new(Code::UnclosedString, message)
                    .at(span(inner, inner + 1), "this ends the string")
                    .also(span(inner + 1, inner + 2), "and this begins another")
                    .also(span(quote, quote + 1), "so this one is never closed")
                    .help("write `\\\"` for the first")
                    .fix(span(inner, inner), "\\")
            }
            None => Diagnostic::new(Code::UnclosedString, "this string is never closed")
                .at(span(quote, quote + 1), label)
                .fix(span(end, end), "\""),
        });
    }
    if let Some(open) = scan.unclosed_comment {
        diagnostics.push(
            Diagnostic::new(Code::UnclosedComment, "this comment is never closed")
                .at(Span::new(file, open, open + 2), "opened here, and its `*/` is missing")
                .help("comments nest: each `/*` needs its own `*/`"),
        );
    }
    for &stray in &scan.stray_closers {
        let span = Span::new(file, stray, stray + 2);
        diagnostics.push(
            Diagnostic::new(Code::StrayCloser, "this `*/` ends no comment")
                .at(span, "no `/*` is open here")
                .help("comments nest: each `/*` has its own `*/`")
                .fix(span, ""),
        );
    }
    let comments = scan.comments.iter().map(|&(start, end)| Span::new(file, start, end)).collect();
    if scan.comments.is_empty() && scan.closers.is_empty() && scan.stray_closers.is_empty() {
        return Quiet { text: Cow::Borrowed(text), comments };
    }
    let mut bytes = text.as_bytes().to_vec();
    for &(start, end) in &scan.comments {
        // Line breaks stay, so that a lone `#` before a comment still ends its line.
        for byte in &mut bytes[start..end] {
            if !matches!(byte, b'\n' | b'\r') {
                *byte = b' ';
            }
        }
    }
    for &stray in &scan.stray_closers {
        bytes[stray..stray + 2].fill(b' ');
    }
    for &place in &scan.closers {
        match bytes.get_mut(place) {
            Some(byte) => *byte = b'"',
            None => bytes.push(b'"'),
        }
    }
    // Only whole comments and line breaks were replaced, by single bytes: still UTF-8.
    Quiet { text: Cow::Owned(String::from_utf8(bytes).unwrap_or_default()), comments }
}

/// `concat("Frame "", N, "")`: returns the quote that ends a string and touches the next one, if an extra
/// quote is on the line of the unpaired `quote`.
fn quote_within(text: &str, quote: usize) -> Option<usize> {
    let line = text[..quote].rfind(['\n', '\r']).map_or(0, |end| end + 1);
    let strings = &text[line..quote];
    if strings.contains('\\') {
        return None;
    }
    let quotes: Vec<usize> = strings.match_indices('"').map(|(at, _)| at).collect();
    let touching = |pair: &&[usize]| match **pair {
        [open, close, next] => open + 1 < close && close + 1 == next,
        _ => false,
    };
    // Every second one ends a string.
    let ends = quotes.windows(3).step_by(2).find(touching)?;
    Some(line + ends[1])
}

/// `"a.ttf "POV" 1`: returns the string before the unpaired quote, up to the blank where its closing quote is
/// missing.
fn string_run_together(text: &str, quote: usize) -> Option<Range<usize>> {
    let line = text[..quote].rfind(['\n', '\r']).map_or(0, |end| end + 1);
    let strings = &text[line..quote];
    let close = strings.rfind('"')?;
    let inside = strings[..close].strip_suffix(' ')?;
    let start = inside.rfind('"')?;
    let runs_on = strings[close + 1..].starts_with(|c: char| c.is_ascii_alphanumeric());
    let pairs = strings.matches('"').count().is_multiple_of(2) && !strings.contains('\\');
    (runs_on && pairs && start + 1 < inside.len()).then(|| line + start..line + inside.len())
}

/// `"Hello, 0.3, 0 pigment { … }`: returns the end of a string before further parts, which begin with a comma
/// or a number.
fn string_before_parts(line: &str) -> Option<usize> {
    let block = line.find('{')?;
    let begins = |at: usize| {
        let behind = line[at..].trim_start_matches([' ', '-', '+', '.']);
        line[at..].starts_with(',')
            || line[at..].starts_with(' ') && behind.starts_with(|c: char| c.is_ascii_digit())
    };
    (2..block).filter(|at| line.is_char_boundary(*at)).find(|at| begins(*at))
}

/// `"Jan", "Feb, "Mar"`: in a list before the unpaired quote, returns the first string that runs into the
/// next because its closing quote is missing.
fn string_run_over_a_comma(text: &str, quote: usize) -> Option<Range<usize>> {
    let line = text[..quote].rfind(['\n', '\r']).map_or(0, |end| end + 1);
    let strings = &text[line..quote];
    if strings.contains("\\\"") {
        return None;
    }
    let quotes: Vec<usize> = strings.match_indices('"').map(|(at, _)| at).collect();
    // Every second one should end a string; if a letter follows, it begins one.
    quotes.chunks_exact(2).find_map(|pair| {
        let [open, close] = *pair else { return None };
        let runs_on =
            strings[close + 1..].trim_start().starts_with(|c: char| c.is_ascii_alphanumeric());
        let inside = strings[open..close].trim_end().strip_suffix(',')?;
        (runs_on && inside.len() > 1).then(|| line + open..line + open + inside.len())
    })
}

/// Drops diagnostics caused by swallowed closers: an unclosed string swallows the closers on its line, and an
/// unclosed comment all that follow. `found` is in source order.
pub(super) fn drop_swallowed(found: &mut Vec<Diagnostic>, text: &str) {
    let place = |one: &Diagnostic| one.primary().map_or(0, |label| label.span.start as usize);
    if let Some(comment) = found.iter().find(|one| one.code == Code::UnclosedComment).map(place) {
        found.retain(|one| {
            let unclosed = matches!(one.code, Code::UnclosedBlock | Code::MissingEnd);
            let ends = one.labels.iter().map(|label| label.span.end as usize).max().unwrap_or(0);
            !(unclosed && ends > comment)
        });
    }
    let Some(at) = found.iter().position(|one| one.code == Code::UnclosedString) else { return };
    let start = place(&found[at]);
    let line = text.get(start..).and_then(|rest| rest.lines().next()).unwrap_or("");
    for (opener, closer) in [('{', '}'), ('(', ')'), ('[', ']'), ('<', '>')] {
        let count = |sign: char| line.chars().filter(|c| *c == sign).count();
        for _ in count(opener)..count(closer) {
            let unclosed = |one: &Diagnostic| {
                let opens = text.get(place(one)..).is_some_and(|rest| rest.starts_with(opener));
                one.code == Code::UnclosedBlock && opens && place(one) < start
            };
            let Some(echo) = found.iter().rposition(unclosed) else { break };
            found.remove(echo);
        }
    }
}

#[derive(Default)]
struct Scan {
    comments: Vec<(usize, usize)>,
    unclosed_comment: Option<usize>,
    /// The first opening quote without an end.
    unclosed_string: Option<usize>,
    /// Each `*/` outside all comments.
    stray_closers: Vec<usize>,
    /// Positions where a closing quote replaces a line break, or is added at the end of the text.
    closers: Vec<usize>,
}

impl Scan {
    fn of(text: &str, strings_end_with_lines: bool) -> Self {
        let bytes = text.as_bytes();
        let mut scan = Self::default();
        let mut at = 0;
        while at < bytes.len() {
            match (bytes[at], bytes.get(at + 1)) {
                (b'"', _) => at = scan.string(bytes, at, strings_end_with_lines),
                (b'/', Some(b'/')) => {
                    let line = bytes[at..].iter().position(|b| matches!(b, b'\n' | b'\r'));
                    let end = line.map_or(bytes.len(), |line| at + line);
                    scan.comments.push((at, end));
                    at = end;
                }
                (b'/', Some(b'*')) => at = scan.block_comment(bytes, at),
                // `2 */* two */ 3` and `2 *// two` multiply.
                (b'*', Some(b'/')) if !matches!(bytes.get(at + 2), Some(b'*' | b'/')) => {
                    scan.stray_closers.push(at);
                    at += 2;
                }
                _ => {
                    let begins = |byte: &u8| matches!(byte, b'"' | b'/' | b'*');
                    let rest = &bytes[at + 1..];
                    at += 1 + rest.iter().position(begins).unwrap_or(rest.len());
                }
            }
        }
        scan
    }

    /// Returns the offset after the string whose quote is at `start`.
    fn string(&mut self, bytes: &[u8], start: usize, ends_with_line: bool) -> usize {
        let mut at = start + 1;
        while at < bytes.len() {
            match (bytes[at], bytes.get(at + 1)) {
                (b'"', _) => return at + 1,
                (b'\n' | b'\r', _) if ends_with_line => break,
                // A backslash before the end would escape the closing quote.
                (b'\\', Some(b'\n' | b'\r')) if ends_with_line => break,
                (b'\\', None) => break,
                (b'\\', _) => at += 2,
                _ => at += 1,
            }
        }
        self.unclosed_string.get_or_insert(start);
        self.closers.push(at);
        at + 1
    }

    /// Returns the offset after the `*/` of the `/*` at `start`.
    fn block_comment(&mut self, bytes: &[u8], start: usize) -> usize {
        let mut at = start + 2;
        let mut depth = 1;
        while depth > 0 && at < bytes.len() {
            match (bytes[at], bytes.get(at + 1)) {
                (b'*', Some(b'/')) => (depth, at) = (depth - 1, at + 2),
                (b'/', Some(b'*')) => (depth, at) = (depth + 1, at + 2),
                _ => at += 1,
            }
        }
        if depth > 0 {
            self.unclosed_comment = Some(start);
        }
        self.comments.push((start, at));
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text_of(text: &str) -> (String, Vec<Code>) {
        let mut diagnostics = Diagnostics::new(true);
        let quiet = quiet(text, FileId(0), &mut diagnostics).text.into_owned();
        (quiet, diagnostics.iter().map(|d| d.code).collect())
    }

    #[test]
    fn comments_nest_and_become_blanks() {
        assert_eq!(text_of("a/*b/*c*/d*/e//f\ng"), ("a           e   \ng".to_owned(), vec![]));
        assert_eq!(text_of("\"/*\" é // é\n").0, "\"/*\" é      \n");
    }

    #[test]
    fn comments_nested_very_deep_are_only_comments() {
        let text = "/*".repeat(50_000) + &"*/".repeat(50_000) + "x";
        assert_eq!(text_of(&text).0.trim(), "x");
        assert_eq!(text_of(&"/*".repeat(50_000)).1, [Code::UnclosedComment]);
    }

    #[test]
    fn an_end_without_a_beginning_is_told_once_and_left_out() {
        assert_eq!(text_of("/*a*/ b */ c").0, "      b    c");
        assert_eq!(text_of("b */").1, [Code::StrayCloser]);
        assert_eq!(text_of("\"*/\" // */\n2 */*b*/ 3 *// c\n4").1, []);
    }

    #[test]
    fn an_unclosed_string_ends_with_its_line_and_is_told_once() {
        let (text, codes) = text_of("#include \"a.inc\n#include \"b.inc\"\n");
        assert_eq!(codes, [Code::UnclosedString]);
        assert_eq!(text, "#include \"a.inc\"#include \"b.inc\"\n");
        assert_eq!(text_of("\"a"), ("\"a\"".to_owned(), vec![Code::UnclosedString]));
        assert_eq!(text_of("\"a\\"), ("\"a\"".to_owned(), vec![Code::UnclosedString]));
    }

    #[test]
    fn a_string_may_hold_line_breaks_and_quotes() {
        let text = "\"a\nb\" \"c\\\"d\"";
        assert_eq!(text_of(text), (text.to_owned(), vec![]));
    }
}
