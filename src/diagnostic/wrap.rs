//! Wraps sentences into lines, broken between words.
//!
//! **Invariant:** no line is wider than the room; only blanks at line ends are lost; text between two
//! backticks is one word, unless it is wider than a line.

use super::cut::{TAB, columns, forward};

/// Wraps a text to `room` columns.
pub fn wrapped(text: &str, room: usize) -> Vec<String> {
    let text = text.replace('\t', &" ".repeat(TAB));
    text.split('\n').flat_map(|line| broken(line, room)).collect()
}

/// Like [`wrapped`], with lines of similar length: the narrowest width that needs no more lines and breaks
/// no more words.
pub fn balanced(text: &str, room: usize) -> Vec<String> {
    let lines = wrapped(text, room);
    let widest = text.lines().flat_map(words).map(|word| columns(word.trim_end())).max();
    (widest.unwrap_or(room)..room)
        .map(|narrower| wrapped(text, narrower))
        .find(|others| others.len() == lines.len())
        .unwrap_or(lines)
}

fn broken(text: &str, room: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = String::new();
    for piece in words(text).into_iter().flat_map(|word| pieces(word, room)) {
        if columns(&line) + columns(piece.trim_end()) > room {
            let full = std::mem::take(&mut line);
            lines.extend((!full.trim().is_empty()).then(|| full.trim_end().to_owned()));
        }
        line.push_str(piece);
    }
    lines.push(line.trim_end().to_owned());
    lines
}

/// Splits a line into words, each with the blanks after it.
fn words(line: &str) -> Vec<&str> {
    let mut words = Vec::new();
    let mut start = 0;
    let (mut quoted, mut blank) = (false, false);
    let mut ticks = line.matches('`').count();
    for (i, c) in line.char_indices() {
        if blank && c != ' ' && !quoted {
            words.push(&line[start..i]);
            start = i;
        }
        blank = c == ' ';
        if c == '`' {
            ticks -= 1;
            quoted = !quoted && ticks > 0;
        }
    }
    words.push(&line[start..]);
    words
}

/// Splits a word that is wider than a line: between quotations and, if a part is still too wide, after as
/// much as fits, up to a `/` if possible.
fn pieces(word: &str, room: usize) -> Vec<&str> {
    if columns(word.trim_end()) <= room {
        return vec![word];
    }
    let mut pieces = Vec::new();
    for mut piece in word.split_inclusive(' ') {
        while columns(piece.trim_end()) > room {
            let fits = forward(piece, 0, room).max(piece.chars().next().map_or(0, char::len_utf8));
            let end = piece[..fits].rfind('/').map_or(fits, |slash| slash + 1);
            pieces.push(&piece[..end]);
            piece = &piece[end..];
        }
        pieces.push(piece);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_breaks_between_words_and_keeps_its_own_lines_and_its_code_whole() {
        assert_eq!(wrapped("one two three", 9), ["one two", "three"]);
        assert_eq!(
            wrapped("write `pigment { rgb 1 }` there", 21),
            ["write", "`pigment { rgb 1 }`", "there"]
        );
        assert_eq!(wrapped("a\n\n  b  c", 9), ["a", "", "  b  c"]);
        assert_eq!(wrapped("one ` is alone", 9), ["one ` is", "alone"]);
    }

    #[test]
    fn balanced_lines_leave_no_word_alone_and_no_code_broken() {
        assert_eq!(balanced("one two three four", 14), ["one two", "three four"]);
        assert_eq!(balanced("it is `a b c d` here now", 18), ["it is `a b c d`", "here now"]);
        assert_eq!(balanced("one two", 14), ["one two"]);
    }

    #[test]
    fn what_is_wider_than_a_line_is_broken_where_it_must_be() {
        assert_eq!(wrapped("insert `a { b { c 1 } }`", 11), ["insert `a {", "b { c 1 }", "}`"]);
        assert_eq!(wrapped("no file some/where/else", 9), ["no file", "some/", "where/", "else"]);
        assert_eq!(wrapped("球球球球球", 5), ["球球", "球球", "球"]);
        for text in ["x".repeat(99), " ".repeat(99), "`a b` ".repeat(30), "e\u{301}".repeat(50)] {
            assert!(wrapped(&text, 20).iter().all(|line| columns(line) <= 20), "{text}");
        }
    }
}
