//! Suggests words for misspellings: the nearest known word, or the equivalent of another tool's word.
//!
//! **Invariant:** a suggestion is made only if it is likely correct, and does not depend on the order of
//! the candidates.

mod foreign;

use std::borrow::Cow;

use self::foreign::FOREIGN;

#[cfg(test)]
thread_local! {
    /// Number of searches for a closest word made by this thread.
    pub static SEARCHES: std::cell::Cell<u64> = const { std::cell::Cell::new(0) };
}

/// Returns the candidate that `word` was most likely meant to be.
///
/// A candidate with the same letters in different case comes first, then the one at the least optimal
/// string alignment distance (insertions, deletions, substitutions and transpositions of neighbours count
/// one each), up to a bound that grows with the length of the word: 1 from three letters, 2 from six, 3
/// from ten. Shorter and very long words are only compared case-insensitively.
pub fn closest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    #[cfg(test)]
    SEARCHES.with(|searches| searches.set(searches.get() + 1));
    let lower = word.to_lowercase();
    let (count, set) = letters(&lower);
    let spelled = spelling(&lower);
    let bound = match count {
        0..3 => 0,
        3..6 => 1,
        6..10 => 2,
        10..=64 => 3,
        _ => 0,
    };
    candidates
        .into_iter()
        .filter(|candidate| *candidate != word)
        .filter_map(|candidate| {
            // One edit changes the length by at most one, and the set of letters by at most two.
            let (other_count, other_set) = letters(candidate);
            let far = other_count.abs_diff(count) > bound
                || (other_set ^ set).count_ones() as usize > 2 * bound;
            // Another spelling of it changes no more than this.
            let respelt = other_count.abs_diff(count) <= 2 && (other_set ^ set).count_ones() <= 4;
            let other = (!far || respelt).then(|| candidate.to_lowercase())?;
            let same = other == lower
                || (respelt && (spelling(&other) == spelled || look_alike(word, candidate)));
            let distance = match same {
                true => 0,
                false if far => return None,
                false => strsim::osa_distance(&lower, &other).max(1),
            };
            // Of two equally near, the one of the same number, then with the same first letter, then the
            // alphabet's first.
            let number = !digits(&lower).eq(digits(&other));
            let first = lower.chars().next() != other.chars().next();
            // `Withe`: a letter that has wandered.
            let wandered =
                !first && count >= 5 && distance == bound + 1 && same_letters(&lower, &other);
            (distance <= bound || wandered).then_some((distance, number, first, candidate))
        })
        .min()
        .map(|(.., candidate)| candidate)
}

/// Returns the only three-letter candidate that is `word` plus one letter, other than the first: `rg`,
/// `bx`.
pub(crate) fn short_of<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let fits = |candidate: &&str| {
        let mut letters = candidate.chars();
        let mut inner = word.chars();
        word.len() == 2
            && candidate.len() == 3
            && letters.next() == inner.next()
            && inner.next().is_some_and(|last| letters.any(|letter| letter == last))
    };
    let mut fitting = candidates.into_iter().filter(fits);
    fitting.next().filter(|_| fitting.next().is_none())
}

fn digits(word: &str) -> impl Iterator<Item = char> {
    word.chars().filter(char::is_ascii_digit)
}

/// Returns the only candidate of at least four letters that starts like `word` and is two edits away:
/// `Cole` and `Coal`.
pub(crate) fn alike<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let lower = word.to_lowercase();
    let mut near = candidates.into_iter().filter(|candidate| {
        let other = candidate.to_lowercase();
        word.len() >= 4
            && other.len() >= 4
            && other.len().abs_diff(lower.len()) <= 1
            && other.chars().next() == lower.chars().next()
            && other != lower
            && !are_of_a_series(word, candidate)
            && strsim::osa_distance(&lower, &other) <= 2
    });
    near.next().filter(|_| near.next().is_none())
}

/// Whether two words consist of the same letters.
fn same_letters(a: &str, b: &str) -> bool {
    let sorted = |word: &str| {
        let mut letters: Vec<char> = word.chars().collect();
        letters.sort_unstable();
        letters
    };
    a.len() == b.len() && sorted(a) == sorted(b)
}

/// Whether two names differ only in the number or capital letter that distinguishes members of a series, as
/// in `Ball1` and `Ball2` or `RadiusA` and `RadiusB`. One is rarely a misspelling of the other.
pub(crate) fn are_of_a_series(a: &str, b: &str) -> bool {
    let digits = |name: &str| name.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let letter = |name: &str| {
        let stem = name.strip_suffix(|c: char| c.is_ascii_alphabetic())?;
        let capital = name.ends_with(|c: char| c.is_ascii_uppercase());
        let apart = stem.ends_with(|c: char| c == '_' || c.is_ascii_digit())
            || (capital && stem.ends_with(|c: char| c.is_ascii_lowercase()));
        apart.then_some(stem.len())
    };
    let stems = |a: usize, b: usize| a == b && a > 0;
    let same = |length: usize| a.get(..length) == b.get(..length);
    let numbered = stems(digits(a), digits(b)) && same(digits(a));
    let lettered = match (letter(a), letter(b)) {
        (Some(of_a), Some(of_b)) => of_a == of_b && same(of_a),
        _ => false,
    };
    a != b && (numbered || (lettered && !a.eq_ignore_ascii_case(b)))
}

/// Whether two words look alike: `T_0` and `T_O`, `l1` and `ll`.
fn look_alike(a: &str, b: &str) -> bool {
    let shape = |c: char| match c {
        'O' | 'o' => '0',
        'I' | 'l' | '|' => '1',
        'S' => '5',
        c => c,
    };
    a.chars().map(shape).eq(b.chars().map(shape))
}

/// Normalizes a word: lower case, American spelling, no separators, no leading zeros. `Grey5`, `Gray05` and
/// `Gray_5` are equal.
fn spelling(word: &str) -> Cow<'_, str> {
    let mut spelt = Cow::Borrowed(word);
    for (theirs, ours) in [("grey", "gray"), ("colour", "color"), ("centre", "center"), ("_", "")] {
        if spelt.contains(theirs) {
            spelt = Cow::Owned(spelt.replace(theirs, ours));
        }
    }
    if !spelt.contains('0') {
        return spelt;
    }
    let mut plain = String::with_capacity(spelt.len());
    let mut rest = spelt.chars().peekable();
    while let Some(c) = rest.next() {
        let leads = c == '0' && !plain.ends_with(|last: char| last.is_ascii_digit());
        if !(leads && rest.peek().is_some_and(char::is_ascii_digit)) {
            plain.push(c);
        }
    }
    Cow::Owned(plain)
}

/// Returns the number of letters in a word, and the set of its lower-case letters (one bit per letter, some
/// shared).
fn letters(word: &str) -> (usize, u32) {
    if word.is_ascii() {
        // The low five bits of a letter do not know its case.
        return (word.len(), word.bytes().fold(0, |set, b| set | 1 << (b % 32)));
    }
    word.chars()
        .flat_map(char::to_lowercase)
        .fold((0, 0), |(count, set), c| (count + 1, set | 1 << (c as u32 % 32)))
}

/// Returns lucarne's words for what other tools or people call `word`, the likeliest first. The right one
/// depends on the context.
pub(crate) fn foreign(word: &str) -> impl Iterator<Item = &'static str> {
    let lower = word.to_lowercase();
    FOREIGN.iter().filter(move |(theirs, _)| *theirs == lower).map(|&(_, ours)| ours)
}

/// Returns the candidate made of the same parts as `word`, in another order or with synonyms:
/// `pretrace_begin` for `pretrace_start`, `max_reuse` for `maximum_reuse`, `count_nearest`.
pub(crate) fn reworded<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    const SAME: [&[&str]; 13] = [
        &["start", "begin", "first", "from"],
        &["end", "finish", "last", "stop", "to"],
        &["min", "minimum", "least"],
        &["max", "maximum", "most"],
        &["limit", "bound", "level", "depth", "max", "maximum"],
        &["count", "number", "num", "samples"],
        &["size", "scale"],
        &["offset", "shift", "height", "start", "begin"],
        &["distance", "dist", "length"],
        &["color", "colour", "tint"],
        &["exponent", "exp", "power"],
        &["threshold", "thresh", "cutoff"],
        &["level", "height", "depth"],
    ];
    let lower = word.to_lowercase();
    let theirs: Vec<&str> = lower.split('_').collect();
    if theirs.len() < 2 {
        return None;
    }
    let same = |a: &str, b: &str| {
        a == b || SAME.iter().any(|group| group.contains(&a) && group.contains(&b))
    };
    let fits = |candidate: &&str| {
        let mut ours: Vec<&str> = candidate.split('_').collect();
        let equal = theirs.iter().filter(|part| ours.contains(part)).count();
        // Some part says what it is about, and the others say no more than that one means.
        let all = theirs.iter().all(|part| {
            let exact = ours.iter().position(|own| own == part);
            let found = exact.or_else(|| ours.iter().position(|own| same(own, part)));
            found.map(|at| ours.remove(at)).is_some()
        });
        **candidate != *word && equal > 0 && all && ours.is_empty()
    };
    let mut fitting = candidates.into_iter().filter(fits);
    // If several candidates fit, none is likely.
    fitting.next().filter(|_| fitting.next().is_none())
}

/// Returns the candidate with the same first letter and the same consonants as `word`, if one of the two
/// has no vowels: `Count` for `Cnt`.
pub(crate) fn contracted<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let consonants = |word: &str| {
        let vowel = |c: char| matches!(c, 'a' | 'e' | 'i' | 'o' | 'u' | 'y');
        let lower = word.to_lowercase();
        let mut letters = lower.chars();
        letters.next().into_iter().chain(letters.filter(|c| !vowel(*c))).collect::<String>()
    };
    let bare = consonants(word);
    let fits = |candidate: &&str| {
        let is_short = |a: &str, b: &str| a.len() < b.len() && a.to_lowercase() == bare;
        bare.len() >= 3
            && consonants(candidate) == bare
            && (is_short(word, candidate) || is_short(candidate, word))
    };
    let mut fitting = candidates.into_iter().filter(fits);
    fitting.next().filter(|_| fitting.next().is_none())
}

/// Returns the candidate that `word` abbreviates or spells out part by part, or whose first parts it is:
/// `LeafPigment` for `LeafPig`, `Copper_Old` for `Old_Copper`, `low_error` for `low_error_factor`.
pub(crate) fn abridged<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let theirs = parts(word);
    if theirs.len() < 2 {
        return None;
    }
    let begins = |a: &str, b: &str| a == b || (a.len() >= 3 && b.starts_with(a));
    let fits = |candidate: &&str| {
        let ours = parts(candidate);
        let pairs = || theirs.iter().zip(&ours);
        let same = theirs.len() == ours.len()
            && pairs().any(|(a, b)| a == b)
            && pairs().all(|(a, b)| begins(a, b) || begins(b, a));
        let begun =
            theirs.len() < ours.len() && candidate.contains('_') && ours.starts_with(&theirs);
        let (mut a, mut b) = (theirs.clone(), ours);
        a.sort_unstable();
        b.sort_unstable();
        **candidate != *word && (same || begun || a == b)
    };
    let mut fitting = candidates.into_iter().filter(fits);
    fitting.next().filter(|_| fitting.next().is_none())
}

/// Returns the candidate that shares a prefix of two thirds of the longer word with `word`, or its stem:
/// `contained_by` for `container`, `extinction` for `extinct`, `spacing` for `space`.
pub(crate) fn begun<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    const LEAST: usize = 4;
    let fits = |candidate: &&str| {
        let same = word.bytes().zip(candidate.bytes()).take_while(|(a, b)| a == b).count();
        let longer = word.len().max(candidate.len());
        let of_one_stem = stem(word).len() >= LEAST && stem(word) == stem(candidate);
        **candidate != *word && (of_one_stem || same >= LEAST && 3 * same >= 2 * longer)
    };
    let mut fitting = candidates.into_iter().filter(fits);
    fitting.next().filter(|_| fitting.next().is_none())
}

/// Returns a word without its suffix.
fn stem(word: &str) -> &str {
    const ENDINGS: [&str; 9] = ["ing", "ity", "ion", "ed", "er", "or", "e", "s", "y"];
    ENDINGS.iter().find_map(|ending| word.strip_suffix(ending)).unwrap_or(word)
}

/// Splits a name into its words, in lower case: `LeafPigment`, `leaf_pigment`.
fn parts(name: &str) -> Vec<String> {
    let mut parts = vec![String::new()];
    let mut before = '_';
    for c in name.chars() {
        let begins = c == '_' || (c.is_uppercase() && before.is_lowercase());
        if begins && parts.last().is_some_and(|part| !part.is_empty()) {
            parts.push(String::new());
        }
        if c != '_'
            && let Some(part) = parts.last_mut()
        {
            part.extend(c.to_lowercase());
        }
        before = c;
    }
    parts.retain(|part| !part.is_empty());
    parts
}

#[cfg(test)]
mod tests;
