//! `lucarne explain`: prints the page of a diagnostic code.

use lucarne::diagnostic::Code;
use lucarne::diagnostic::suggest::closest;

use super::arguments::ExplainArguments;
use super::exit::{Exit, Failure, Outcome};
use super::messages;

pub fn run(arguments: &ExplainArguments) -> Outcome {
    let Some(name) = &arguments.code else {
        let list: String =
            Code::ALL.iter().map(|c| format!("{:20} {}\n", c.name(), c.sentence())).collect();
        messages::print(&list)?;
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
