//! Parses the comment that silences a lint: `// lucarne: allow(unused-declaration)`.
//!
//! After code, the comment applies to its line. On a line of its own, it applies to the next item, up to
//! the end of the line that closes the item's brackets. A message about the scene as a unit is silenced by
//! a comment anywhere in the main file that allows it by name. `allow(all)` allows every lint in its range,
//! but no message about the scene as a unit.
//!
//! **Invariant:** errors are never silenced. Names that are not lints are reported, and so are malformed
//! comments that are apparently meant to silence a lint.

use std::ops::Range;

use super::suggest::closest;
use super::{Code, Diagnostic};
use crate::source::{FileId, Source, Span};

/// A range of text in which a lint is not reported.
#[derive(Debug, Clone, PartialEq)]
pub struct Allowance {
    file: FileId,
    reach: Range<usize>,
    lints: Lints,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Lints {
    One(Code),
    All,
}

/// Prefix of a comment that silences lints.
const ADDRESS: &str = "lucarne";

/// Name that stands for all lints.
const ALL: &str = "all";

impl Lints {
    fn named(name: &str) -> Option<Self> {
        match name {
            ALL => Some(Self::All),
            _ => Code::from_name(name).filter(|code| code.may_warn()).map(Self::One),
        }
    }
}

impl Allowance {
    pub fn silences(&self, diagnostic: &Diagnostic) -> bool {
        if diagnostic.is_error() {
            return false;
        }
        match diagnostic.primary() {
            Some(label) => self.reaches(diagnostic.code, label.span),
            None => self.lints == Lints::One(diagnostic.code) && self.file == FileId(0),
        }
    }

    /// Whether this allowance silences `lint` at `place`.
    pub fn reaches(&self, lint: Code, place: Span) -> bool {
        let is_meant = match self.lints {
            Lints::One(one) => one == lint,
            Lints::All => lint.may_warn(),
        };
        is_meant && self.file == place.file && self.reach.contains(&place.range().start)
    }
}

/// Returns the allowances in a text, and messages about names that are not lints.
pub fn allowances(source: &Source, file: FileId) -> (Vec<Allowance>, Vec<Diagnostic>) {
    let (mut allowed, mut told) = (Vec::new(), Vec::new());
    let text = &source.text;
    for (at, word) in text.match_indices("lucarne:") {
        let line = text[..at].rfind('\n').map_or(0, |end| end + 1);
        let before = text[line..at].trim_end();
        let Some(code) = before.strip_suffix("//").or_else(|| before.strip_suffix("/*")) else {
            continue;
        };
        let rest = text[at + word.len()..].lines().next().unwrap_or("");
        let list = rest.trim_start().strip_prefix("allow(");
        let Some((list, end)) = list.and_then(|list| Some((list, list.find(')')?))) else {
            let lead = rest.len() - rest.trim_start().len();
            told.extend(unclear(rest.trim_start(), file, at + word.len() + lead));
            continue;
        };
        let start = at + word.len() + (rest.len() - list.len());
        let line_end = text[at..].find('\n').map_or(text.len(), |end| at + end);
        // `/* lucarne: allow(no-pigment) */ sphere { … }`
        let closed = text[at..line_end].find("*/").map(|end| at + end + "*/".len());
        let before_code = closed.filter(|end| !text[*end..line_end].trim().is_empty());
        let reach = match (code.trim().is_empty(), before_code) {
            (true, Some(end)) => end..end_of_item(text, end),
            (true, None) => line_end..end_of_item(text, line_end),
            (false, _) => line..line_end,
        };
        let mut place = start;
        for name in list[..end].split(',') {
            let lead = name.len() - name.trim_start().len();
            let span = Span::new(file, place + lead, place + lead + name.trim().len());
            place += name.len() + 1;
            match Lints::named(name.trim()) {
                Some(lints) => allowed.push(Allowance { file, reach: reach.clone(), lints }),
                None => told.push(unknown(name.trim(), span)),
            }
        }
    }
    told.extend(unaddressed(text, file));
    (allowed, told)
}

/// Reports comments with a malformed prefix: `// Lucarne: allow(no-light)`, `// lucarne allow(no-light)`.
fn unaddressed(text: &str, file: FileId) -> impl Iterator<Item = Diagnostic> {
    text.match_indices("allow").filter_map(move |(at, _)| {
        let line = text[..at].rfind('\n').map_or(0, |end| end + 1);
        let before = text[line..at].trim_end();
        let addressed = before.strip_suffix(':').unwrap_or(before).trim_end();
        let start = addressed.len().checked_sub(ADDRESS.len())?;
        let address = addressed.get(start..)?;
        let begins = addressed[..start].trim_end();
        let is_comment = begins.ends_with("//") || begins.ends_with("/*");
        let is_right = address == ADDRESS && before.len() == addressed.len() + 1;
        if !is_comment || is_right || !address.eq_ignore_ascii_case(ADDRESS) {
            return None;
        }
        let list = text[at + "allow".len()..].trim_start().strip_prefix('(')?;
        let opened = text.len() - list.len();
        let (list, _) = list.split_once(')')?;
        list.split(',').any(|name| Lints::named(name.trim()).is_some()).then(|| {
            let span = Span::new(file, line + start, line + before.len());
            let right = format!("{ADDRESS}: allow(");
            let message = "a comment that silences a warning begins with `lucarne:`";
            Diagnostic::new(Code::UnknownLint, message)
                .at(span, "this allows nothing")
                .help(format!("write `// {right}{list})`"))
                .fix(Span::new(file, line + start, opened), right)
        })
    })
}

/// Reports malformed text after `lucarne:`, such as `deny(no-light)` or `allow no-light`, unless it is
/// prose.
fn unclear(text: &str, file: FileId, at: usize) -> Option<Diagnostic> {
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    let verb = &text[..text.find(|c| !is_name(c)).unwrap_or(text.len())];
    let behind = &text[verb.len()..];
    let list = behind.trim_start().trim_start_matches(['(', ':', '=']).trim_start();
    let names = list.split(|c: char| c == ',' || c.is_whitespace());
    let names: Vec<&str> = names
        .map(|name| name.trim_end_matches(')'))
        .filter(|name| !name.is_empty())
        .take_while(|name| is_like_a_code(name) || is_all(name, list))
        .collect();
    let (&first, span) = (names.first()?, Span::new(file, at, at + verb.len()));
    if verb != "allow" {
        let diagnostic =
            Diagnostic::new(Code::UnknownLint, "a comment to lucarne can only `allow`")
                .at(span, "this does nothing");
        return Some(match verb {
            "deny" | "warn" => diagnostic.help(format!("`--{verb} {first}` does it for all files")),
            _ => diagnostic.help(format!("write `// lucarne: allow({first})`")),
        });
    }
    // The names stand one after another at the beginning of the list.
    let length =
        names.iter().fold(0, |end, name| end + list[end..].find(name).unwrap_or(0) + name.len());
    let start = at + text.len() - list.len();
    let meant = format!("({})", names.join(", "));
    let closes = list[length..].starts_with(')');
    let whole = Span::new(file, at + verb.len(), start + length + usize::from(closes));
    Some(
        Diagnostic::new(Code::UnknownLint, "`allow` takes the lints in parentheses")
            .at(span, "this allows nothing")
            .help(format!("write `// lucarne: allow{meant}`"))
            .fix(whole, meant),
    )
}

/// Whether a word is the code of a message, or was meant to be one.
fn is_like_a_code(name: &str) -> bool {
    let codes = || Code::ALL.iter().map(|code| code.name());
    codes().any(|code| code == name) || (name.contains('-') && closest(name, codes()).is_some())
}

/// Whether `all` is the only name in a list, rather than a word of a sentence.
fn is_all(name: &str, list: &str) -> bool {
    name == ALL && list.trim_end().trim_end_matches("*/").trim_end().trim_end_matches(')') == ALL
}

fn unknown(name: &str, span: Span) -> Diagnostic {
    let lints = || Code::ALL.iter().filter(|code| code.may_warn()).map(|code| code.name());
    if Code::from_name(name).is_some() {
        return Diagnostic::new(Code::UnknownLint, format!("`{name}` is no lint"))
            .at(span, "it cannot be allowed")
            .help("only warnings can be silenced");
    }
    let told = Diagnostic::new(Code::UnknownLint, format!("there is no lint `{name}`"))
        .at(span, "not known");
    // `allow(unused)`: a part of one name, and of no other.
    let mut holding = lints().filter(|lint| lint.split('-').any(|part| part == name));
    let only = holding.next().filter(|_| holding.next().is_none());
    let meant = match name.to_lowercase().as_str() {
        "*" | "everything" | "any" | "lints" | "warnings" => Some(ALL),
        lower => {
            let hyphened = lower.replace(['_', ' '], "-");
            let same = lints().chain([ALL]).find(|lint| *lint == hyphened);
            same.or_else(|| closest(&hyphened, lints().chain([ALL]))).or(only)
        }
    };
    match meant {
        Some(near) => told.help(format!("did you mean `{near}`?")).fix(span, near),
        None => told.help("`lucarne explain` lists them"),
    }
}

/// Returns the end of the item after `from`: the end of the line that closes all of its brackets.
fn end_of_item(text: &str, from: usize) -> usize {
    let (mut depth, mut last) = (0_i64, None);
    let mut rest = text[from..].char_indices().peekable();
    while let Some((at, c)) = rest.next() {
        let next = rest.peek().map(|&(_, c)| c);
        match c {
            '\n' if depth <= 0 && last.is_some_and(|last| last != '=') => return from + at,
            '/' if next == Some('/') => while rest.next_if(|&(_, c)| c != '\n').is_some() {},
            '/' if next == Some('*') => {
                let mut before = ' ';
                while let Some((_, c)) = rest.next()
                    && !(before == '*' && c == '/')
                {
                    before = c;
                }
            }
            '"' => {
                while let Some((_, c)) = rest.next()
                    && c != '"'
                {
                    if c == '\\' {
                        rest.next();
                    }
                }
                last = Some('"');
            }
            '{' | '(' | '[' => (depth, last) = (depth + 1, Some(c)),
            '}' | ')' | ']' => (depth, last) = (depth - 1, Some(c)),
            c if c.is_whitespace() => {}
            c => last = Some(c),
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What of a text each of its allowances reaches.
    fn reached(text: &str) -> Vec<String> {
        let (allowed, told) = allowances(&Source::new("a.scene", text), FileId(0));
        assert_eq!(told, []);
        allowed.iter().map(|one| text[one.reach.clone()].trim().to_owned()).collect()
    }

    #[test]
    fn behind_code_it_speaks_for_its_line() {
        let text = "a = 1;\nb = 2; // lucarne: allow(color-range) as meant\nc = 3;";
        assert_eq!(reached(text), ["b = 2; // lucarne: allow(color-range) as meant"]);
    }

    #[test]
    fn on_a_line_of_its_own_it_speaks_for_the_item_that_follows() {
        let text = "// lucarne: allow( no-pigment , color-range)\n\n// of glass\nsphere {\n  0, 1 // }\n  f(\"}\\\"\")\n}\nbox { }";
        let item = "// of glass\nsphere {\n  0, 1 // }\n  f(\"}\\\"\")\n}";
        assert_eq!(reached(text), [item, item]);
        let text = "/* lucarne: allow(never-placed) */\n#declare A =\n  /* } */ box {\n 0, 1 }\nA";
        assert_eq!(reached(text), ["#declare A =\n  /* } */ box {\n 0, 1 }"]);
        assert_eq!(reached("// lucarne: allow(never-placed)"), [""]);
    }

    #[test]
    fn other_comments_and_other_texts_allow_nothing() {
        assert_eq!(reached("// lucarne: allow nothing\n\"lucarne: allow(no-light)\""), [""; 0]);
    }

    #[test]
    fn a_comment_that_means_to_allow_and_does_not_is_told() {
        for (text, said, mended) in [
            ("// lucarne: allow no-pigment", "in parentheses", "allow(no-pigment)"),
            ("// lucarne: allow no-pigment, no-light", "in parentheses", "(no-pigment, no-light)"),
            ("// lucarne: allow (no-light) as it is", "in parentheses", "allow(no-light) as it"),
            ("// lucarne: allow(no-light", "in parentheses", "allow(no-light)"),
            ("// lucarne: allow all", "in parentheses", "allow(all)"),
            ("// lucarne: allow(*)", "there is no lint", "allow(all)"),
            ("// lucarne: allow(unused)", "there is no lint", "allow(unused-declaration)"),
            ("// lucarne: allow(No_Pigment)", "there is no lint", "allow(no-pigment)"),
            ("// lucarne: deny(no-pigment)", "can only `allow`", "deny"),
            ("// lucarne: ignore no-pigment", "can only `allow`", "ignore"),
        ] {
            let (allowed, told) = allowances(&Source::new("a.scene", text), FileId(0));
            let [told] = told.as_slice() else { panic!("{text}: {told:?}") };
            assert!(allowed.is_empty() && told.message.contains(said), "{text}: {told:?}");
            let mut after = text.to_owned();
            told.fixes.iter().for_each(|fix| after.replace_range(fix.span.range(), &fix.text));
            assert!(after.contains(mended), "{after}");
        }
        let (allowed, told) =
            allowances(&Source::new("a.scene", "// lucarne: a house with windows"), FileId(0));
        assert_eq!((allowed, told), (vec![], vec![]));
    }

    #[test]
    fn all_lints_of_a_place_are_allowed_but_those_of_the_whole_scene_by_name_only() {
        let text = "a // lucarne: allow(all)\nb";
        let (allowed, told) = allowances(&Source::new("a.scene", text), FileId(0));
        let ([allowed], []) = (&allowed[..], &told[..]) else { panic!("{allowed:?} {told:?}") };
        let at = |code: Code, place: usize| {
            Diagnostic::new(code, "told").at(Span::new(FileId(0), place, place + 1), "here")
        };
        assert!(allowed.silences(&at(Code::NoPigment, 0)));
        assert!(allowed.silences(&at(Code::UnusedDeclaration, 0)));
        assert!(!allowed.silences(&at(Code::UnknownWord, 0)));
        assert!(!allowed.silences(&at(Code::NoPigment, text.len() - 1)));
        assert!(!allowed.silences(&Diagnostic::new(Code::NoCamera, "told")));
        let (allowed, _) =
            allowances(&Source::new("a.scene", "// lucarne: allow all of them"), FileId(0));
        assert!(allowed.is_empty());
    }

    #[test]
    fn a_name_that_is_no_lint_is_told_with_its_fix() {
        let text = "// lucarne: allow(color-range, unused-declarations)\n// lucarne: allow(unclosed-block)";
        let (allowed, told) = allowances(&Source::new("a.scene", text), FileId(0));
        assert_eq!(allowed.len(), 1);
        let said: Vec<_> = told.iter().map(|told| told.message.as_str()).collect();
        assert_eq!(said, ["there is no lint `unused-declarations`", "`unclosed-block` is no lint"]);
        assert_eq!(told[0].fixes[0].text, "unused-declaration");
        assert_eq!(&text[told[0].fixes[0].span.range()], "unused-declarations");
    }
}
