//! The comment that silences a lint: `// lucarne: allow(unused-declaration)`.
//!
//! Behind code it speaks for its line; on a line of its own for the item that follows, to the end of the
//! line on which its brackets are closed. A message about the whole scene is silenced wherever the main
//! file allows it.
//!
//! **Invariant:** an error is never silenced, and a name that is no lint is told.

use std::ops::Range;

use super::suggest::closest;
use super::{Code, Diagnostic};
use crate::source::{FileId, Source, Span};

/// A stretch of text in which a lint is not told.
#[derive(Debug, Clone, PartialEq)]
pub struct Allowance {
    file: FileId,
    reach: Range<usize>,
    lint: Code,
}

impl Allowance {
    pub fn silences(&self, diagnostic: &Diagnostic) -> bool {
        self.lint == diagnostic.code
            && match diagnostic.primary() {
                Some(label) => {
                    self.file == label.span.file && self.reach.contains(&label.span.range().start)
                }
                None => self.file == FileId(0),
            }
    }
}

/// What the comments of a text allow, and messages about names that are no lints.
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
        let Some(list) = rest.trim_start().strip_prefix("allow(") else { continue };
        let Some(end) = list.find(')') else { continue };
        let start = at + word.len() + (rest.len() - list.len());
        let line_end = text[at..].find('\n').map_or(text.len(), |end| at + end);
        let reach = match code.trim().is_empty() {
            true => line_end..end_of_item(text, line_end),
            false => line..line_end,
        };
        let mut place = start;
        for name in list[..end].split(',') {
            let lead = name.len() - name.trim_start().len();
            let span = Span::new(file, place + lead, place + lead + name.trim().len());
            place += name.len() + 1;
            match Code::from_name(name.trim()).filter(|code| code.warns()) {
                Some(lint) => allowed.push(Allowance { file, reach: reach.clone(), lint }),
                None => told.push(unknown(name.trim(), span)),
            }
        }
    }
    (allowed, told)
}

fn unknown(name: &str, span: Span) -> Diagnostic {
    let lints = Code::ALL.iter().filter(|code| code.warns()).map(|code| code.name());
    if Code::from_name(name).is_some() {
        return Diagnostic::new(Code::UnknownLint, format!("`{name}` is no lint"))
            .at(span, "it cannot be allowed")
            .help("only warnings can be silenced");
    }
    let told = Diagnostic::new(Code::UnknownLint, format!("there is no lint `{name}`"))
        .at(span, "not known");
    match closest(name, lints) {
        Some(near) => told.help(format!("did you mean `{near}`?")).fix(span, near),
        None => told.help("`lucarne explain` lists them"),
    }
}

/// Where the item after `from` ends: on the line that closes all of its brackets.
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
    fn a_name_that_is_no_lint_is_told_with_its_fix() {
        let text =
            "// lucarne: allow(color-range, unused-declarations)\n// lucarne: allow(unknown-word)";
        let (allowed, told) = allowances(&Source::new("a.scene", text), FileId(0));
        assert_eq!(allowed.len(), 1);
        let said: Vec<_> = told.iter().map(|told| told.message.as_str()).collect();
        assert_eq!(said, ["there is no lint `unused-declarations`", "`unknown-word` is no lint"]);
        assert_eq!(told[0].fixes[0].text, "unused-declaration");
        assert_eq!(&text[told[0].fixes[0].span.range()], "unused-declarations");
    }
}
