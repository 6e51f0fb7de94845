//! `lucarne explain`: prints the page of a diagnostic code.

use lucarne::diagnostic::suggest::closest;
use lucarne::diagnostic::{Code, Severity};

use super::arguments::ExplainArguments;
use super::exit::{Exit, Failure, Outcome};
use super::messages;

pub fn run(arguments: &ExplainArguments) -> Outcome {
    let Some(name) = &arguments.code else {
        messages::print(&list())?;
        return Ok(Exit::Done);
    };
    let Some(code) = Code::from_name(name) else {
        let failure = Failure::usage(format!("there is no code `{name}`"));
        let help = match closest(name, Code::ALL.iter().map(|code| code.name())) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "`lucarne explain` lists them all".to_owned(),
        };
        return Err(failure.help(help));
    };
    messages::print(&plain(code.page()))?;
    if code.may_warn() {
        let is = match code.is_opinion() {
            true => "In a `.pov` that POV-Ray renders all the same, this is a warning.",
            false => "This is a warning.",
        };
        messages::print(&format!(
            "\n{is} `--allow {name}` silences it, as does the comment\n\n    \
             // lucarne: allow({name})\n\nbehind the code it is about, or on the line before. \
             `--deny {name}` makes it an error.\n"
        ))?;
    }
    Ok(Exit::Done)
}

/// A heading of the list of codes, and whether a code stands below it.
type Group = (&'static str, fn(Code) -> bool);

/// The headings of the list. Each code is below exactly one.
const GROUPS: &[Group] = &[
    ("Errors", |code| code.severity() == Severity::Error && !code.is_opinion() && !code.is_limit()),
    ("Opinions: errors, but warnings in a `.pov` that POV-Ray renders all the same", |code| {
        code.is_opinion()
    }),
    ("Limits: errors until `--limit` raises the limit", Code::is_limit),
    ("Warnings in every file", |code| code.warns() && (!code.is_lint() || code.is_sure())),
    ("Lints: warnings in a `.scene`, and with `--lint` in a `.pov`", |code| {
        code.is_lint() && !code.is_sure() && !code.is_quiet()
    }),
    ("Lints that only `--warn CODE` enables", Code::is_quiet),
    ("Output of the scene", |code| code.severity() == Severity::Note),
];

/// Lists all codes by kind, each with its sentence.
fn list() -> String {
    let mut out =
        "`lucarne explain CODE` explains a code, with an example. `--allow CODE` silences a \
                   warning,\n`--deny CODE` makes it an error.\n"
            .to_owned();
    for (heading, holds) in GROUPS {
        out.push_str(&format!("\n{heading}\n"));
        for code in Code::ALL.iter().filter(|code| holds(**code)) {
            out.push_str(&format!("  {:20} {}\n", code.name(), code.sentence()));
        }
    }
    out
}

/// Formats a page for a terminal: examples are indented instead of fenced.
fn plain(page: &str) -> String {
    let mut fenced = false;
    let mut text = String::new();
    for line in page.lines() {
        if line.starts_with("```") {
            fenced = !fenced;
            continue;
        }
        let line = if fenced {
            format!("    {line}")
        } else {
            line.trim_start_matches('#').trim_start().to_owned()
        };
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_code_is_below_one_heading() {
        for code in Code::ALL {
            let headings = GROUPS.iter().filter(|(_, holds)| holds(*code)).count();
            assert_eq!(headings, 1, "{}", code.name());
        }
    }
}
