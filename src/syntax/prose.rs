//! Blanks sentences outside comments, such as the text of a mail or a web page around a scene.
//!
//! **In:** a text without comments. **Out:** the same text with blanks in their place. **Invariant:** a line
//! is a sentence only outside all braces, if it has several words of everyday speech, or their punctuation,
//! and no punctuation of a scene, or if it has any words after the comment sign of another language; one
//! diagnostic for adjacent lines.

use std::borrow::Cow;
use std::ops::Range;

use super::blank::blanked;
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};
use crate::vocabulary::Word;

/// Words that are frequent in sentences, and not used in scenes.
const SPEECH: &[&str] = &[
    "a",
    "an",
    "and",
    "any",
    "are",
    "as",
    "at",
    "be",
    "but",
    "can",
    "cannot",
    "do",
    "does",
    "doesn't",
    "everybody",
    "from",
    "have",
    "hello",
    "help",
    "here",
    "hi",
    "how",
    "i",
    "i'm",
    "in",
    "is",
    "isn't",
    "it",
    "it's",
    "know",
    "me",
    "my",
    "need",
    "not",
    "of",
    "or",
    "please",
    "should",
    "some",
    "somebody",
    "somehow",
    "that",
    "the",
    "there",
    "this",
    "to",
    "want",
    "was",
    "what",
    "what's",
    "when",
    "where",
    "which",
    "why",
    "will",
    "with",
    "works",
    "wrong",
    "you",
    "your",
    "thanks",
    "thank",
    // Of other languages.
    "das",
    "der",
    "die",
    "ein",
    "eine",
    "ich",
    "ist",
    "mit",
    "nicht",
    "und",
    "wie",
    "est",
    "je",
    "la",
    "le",
    "les",
    "mais",
    "pas",
    "pour",
    "une",
    "con",
    "el",
    "es",
    "los",
    "no",
    "para",
    "que",
    "un",
    "il",
    "che",
    "per",
    "het",
    "een",
    "en",
    "niet",
];

pub(super) fn blank<'a>(
    text: Cow<'a, str>,
    file: FileId,
    diagnostics: &mut Diagnostics,
) -> Cow<'a, str> {
    let sentences = sentences(&text);
    if sentences.is_empty() {
        return text;
    }
    let sign = |line: &Range<usize>| comment_sign(&text[line.clone()]);
    let together = |a: &Range<usize>, b: &Range<usize>| {
        text[a.end..b.start].trim().is_empty() && sign(a) == sign(b)
    };
    for lines in sentences.chunk_by(together) {
        let [first, ..] = lines else { continue };
        if let Some(theirs) = sign(first) {
            let place =
                |line: &Range<usize>| Span::new(file, line.start, line.start + theirs.len());
            let message = format!("`{theirs}` begins a comment in other languages only");
            let told = Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(place(first), "expected `//`")
                .help("a comment begins with `//`");
            let told = lines.iter().fold(told, |told, line| told.fix(place(line), "//"));
            diagnostics.push(told);
            continue;
        }
        let span = |range: &Range<usize>| Span::new(file, range.start, range.end);
        let told = Diagnostic::new(
            Code::UnexpectedCharacter,
            "this is a sentence, and no part of a scene",
        )
        .at(span(first), "expected a comment around it")
        .help("a comment begins with `//`");
        let told = lines
            .iter()
            .fold(told, |told, line| told.fix(Span::new(file, line.start, line.start), "// "));
        diagnostics.push(told);
    }
    blanked(text, sentences)
}

/// Returns the lines that are sentences, without the blanks around them.
fn sentences(text: &str) -> Vec<Range<usize>> {
    let may_be_prose = |line: &str| is_sentence(line, true) || comment_sign(line).is_some();
    if !text.lines().any(|line| may_be_prose(line.trim())) {
        return Vec::new();
    }
    let (mut found, mut start, mut depth, mut quoted) = (Vec::new(), 0, 0i64, false);
    for line in text.split_inclusive('\n') {
        let words = line.trim();
        let follows =
            found.last().is_some_and(|last: &Range<usize>| text[last.end..start].trim().is_empty());
        let is_prose = || is_sentence(words, follows) || comment_sign(words).is_some();
        if depth == 0 && !quoted && is_prose() {
            let from = start + (line.len() - line.trim_start().len());
            found.push(from..from + words.len());
        } else {
            let mut escaped = false;
            for byte in line.bytes() {
                match byte {
                    b'"' if !escaped => quoted = !quoted,
                    b'{' if !quoted => depth += 1,
                    b'}' if !quoted => depth = (depth - 1).max(0),
                    _ => {}
                }
                escaped = byte == b'\\' && !escaped;
            }
        }
        start += line.len();
    }
    found
}

/// Returns the comment sign of another language before a line of words: `-- like this`.
fn comment_sign(line: &str) -> Option<&str> {
    const SIGNS: [&str; 6] = ["--", ";", "%", "'", "REM ", "rem "];
    let sign = SIGNS.into_iter().find(|sign| line.starts_with(sign))?;
    let words = line.strip_prefix(sign)?.trim_start_matches(sign);
    let (sign, _) = line.split_at(line.len() - words.len());
    let is_word = |word: &str| {
        word.starts_with(|c: char| c.is_alphanumeric() || c == '(')
            && word.chars().all(|c| c.is_alphanumeric() || "()'’-_.,:!?…".contains(c))
    };
    // A `;` has a meaning here, too.
    let is_spoken = || {
        let is_long = |word: &&str| word.chars().count() > 2;
        let is_told =
            |word: &str| word.starts_with(char::is_alphabetic) && Word::from_name(word).is_none();
        words.split_whitespace().filter(is_long).count() >= 2
            && words.split_whitespace().all(is_told)
    };
    let is_text = words.trim_start().starts_with(char::is_alphabetic)
        && words.split_whitespace().count() >= 2
        && words.split_whitespace().all(is_word)
        && (!sign.starts_with(';') || is_spoken());
    is_text.then_some(sign.trim_end())
}

/// Returns whether a line is a sentence; `follows`: a sentence precedes it.
fn is_sentence(line: &str, follows: bool) -> bool {
    if !line.starts_with(char::is_alphabetic)
        || line.ends_with(';')
        || line.contains(|c| "{}<>[]=#\"/*+|&".contains(c))
    {
        return false;
    }
    // `Follow (Cart, Here, Ahead)` is probably a call.
    let name = line.trim_start_matches(|c: char| c.is_alphanumeric() || c == '_').trim_start();
    if name.starts_with('(') && name.ends_with(')') {
        return false;
    }
    let (mut count, mut of_speech, mut punctuated) = (0, 0, false);
    for word in line.split_whitespace() {
        let plain = word.trim_matches(|c| "()".contains(c));
        let bare = plain.trim_end_matches(['.', ',', '!', '?', ':', ';', '…']);
        punctuated |= bare.len() < plain.len();
        if !bare.chars().all(|c| c.is_alphanumeric() || "'’-._".contains(c)) {
            return false;
        }
        count += usize::from(bare.starts_with(char::is_alphabetic));
        of_speech += usize::from(SPEECH.contains(&bare.to_lowercase().replace('’', "'").as_str()));
    }
    if line.contains(';') && of_speech < 2 {
        return false;
    }
    let plain = count >= 3 && (of_speech >= 2 || (of_speech == 1 && punctuated));
    let short = count >= 2 && of_speech >= 1 && line.ends_with(['!', '.', '?']);
    plain || short || (follows && count > 0 && of_speech >= 1 && punctuated)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_are_told_from_what_scenes_say() {
        for line in [
            "Here is my scene, I hope somebody can tell what's wrong with it.",
            "Hello everybody, please help me",
            "ich weiss nicht, warum es dunkel ist",
            "this one works:",
            "The end!",
            "The library builds its cache; this may take a moment.",
        ] {
            assert!(is_sentence(line, false), "{line}");
        }
        for line in [
            "sphere { a, 1 }",
            "Ball Box Cone",
            "Post(a, the, is)",
            "Follow (Cart, Here, Ahead, the, is)",
            "my_ball",
            "rotate a translate b scale c",
            "open",
            "normal in",
            "rgb A 1, 2, 3,",
        ] {
            assert!(!is_sentence(line, false), "{line}");
        }
    }

    #[test]
    fn comments_of_other_languages_are_told_by_their_signs() {
        let signs =
            ["-- a comment", ";;; this comment", "% a comment", "' a comment", "REM a comment"];
        assert_eq!(signs.map(comment_sign), ["--", ";;;", "%", "'", "REM"].map(Some));
        for line in [
            "-- b - c",
            "; sphere { a, 1 }",
            "; scale 1 no_shadow",
            "; A B",
            "--B",
            "; x",
            "- a comment",
            "'a' + b",
        ] {
            assert_eq!(comment_sign(line), None, "{line}");
        }
    }

    #[test]
    fn a_sentence_in_a_block_or_a_string_stays() {
        assert!(sentences("a {\nthis is not one, is it\n}").is_empty());
        assert!(sentences("#debug \"\nthis is not one, is it\n\"").is_empty());
        assert_eq!(sentences("\n  this is one, is it\n"), vec![3..21]);
    }
}
