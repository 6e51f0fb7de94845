//! Formats messages as SARIF, for code scanning services, and as commands of GitHub's workflows.
//!
//! **Invariant:** lines and columns count from 1, columns are in characters, ends are exclusive.
//!
//! **Source:** OASIS, Static Analysis Results Interchange Format (SARIF) 2.1.0, 2020; GitHub, "Workflow commands".

use serde_json::{Value, json};

use super::json::{Place, severity_name};
use super::{Diagnostic, Severity};
use crate::source::Sources;

/// Returns one result of a SARIF log.
pub fn result(diagnostic: &Diagnostic, sources: &Sources) -> Value {
    let location = |place: &Place| {
        json!({
            "artifactLocation": { "uri": uri(place.file) },
            "region": {
                "startLine": place.line,
                "startColumn": place.column,
                "endLine": place.end_line,
                "endColumn": place.end_column,
            },
        })
    };
    let text = [&[diagnostic.message.trim_end().to_owned()], &diagnostic.help[..]].concat();
    let labels = diagnostic.labels.iter().filter(|label| !label.primary);
    let related: Vec<Value> = labels
        .enumerate()
        .map(|(id, label)| {
            json!({
                "id": id,
                "physicalLocation": location(&Place::of(label.span, sources)),
                "message": { "text": label.text },
            })
        })
        .collect();
    let mut result = json!({
        "ruleId": diagnostic.code.name(),
        "level": severity_name(diagnostic.severity),
        "message": { "text": text.join("\n") },
        "locations": [{ "physicalLocation": location(&Place::primary(diagnostic, sources)) }],
    });
    if !related.is_empty() {
        result["relatedLocations"] = related.into();
    }
    if !diagnostic.fixes.is_empty() {
        let changes: Vec<Value> = diagnostic
            .fixes
            .iter()
            .map(|fix| {
                let place = Place::of(fix.span, sources);
                json!({
                    "artifactLocation": { "uri": uri(place.file) },
                    "replacements": [{
                        "deletedRegion": location(&place)["region"],
                        "insertedContent": { "text": fix.text },
                    }],
                })
            })
            .collect();
        result["fixes"] = json!([{ "artifactChanges": changes }]);
    }
    result
}

/// Returns the log of these results, as one line.
pub fn log(results: &[Value]) -> String {
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": { "name": "lucarne", "version": env!("CARGO_PKG_VERSION") } },
            "columnKind": "unicodeCodePoints",
            "results": results,
        }],
    });
    log.to_string()
}

/// Returns a workflow command of GitHub, which shows the message beside its line.
pub fn workflow_command(diagnostic: &Diagnostic, sources: &Sources) -> String {
    let kind = match diagnostic.severity {
        Severity::Note => "notice",
        Severity::Warning => "warning",
        Severity::Error => "error",
    };
    let Place { file, line, column, end_line, end_column } = Place::primary(diagnostic, sources);
    let text = [&[diagnostic.message.trim_end().to_owned()], &diagnostic.help[..]].concat();
    let (file, title) = (escaped(file, true), diagnostic.code.name());
    let text = escaped(&text.join("\n"), false);
    let end = if end_line == line { format!(",endColumn={end_column}") } else { String::new() };
    format!(
        "::{kind} file={file},line={line},endLine={end_line},col={column}{end},title={title}::{text}"
    )
}

/// Returns a path as a relative reference: with `/`, and other signs in hexadecimal.
fn uri(path: &str) -> String {
    let mut uri = String::new();
    for byte in path.replace('\\', "/").bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
                uri.push(byte.into());
            }
            byte => uri += &format!("%{byte:02X}"),
        }
    }
    uri
}

fn escaped(text: &str, is_property: bool) -> String {
    let text = text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A");
    if is_property { text.replace(':', "%3A").replace(',', "%2C") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Code;
    use crate::source::{Source, Span};

    fn told() -> (Diagnostic, Sources) {
        let mut sources = Sources::default();
        let file = sources.add(Source::new("a b,c.scene", "é spere { 0, 1 }\n"));
        let at = Span::new(file, 3, 8);
        let told = Diagnostic::new(Code::UnknownWord, "50 % of `spere`\n")
            .at(at, "here")
            .also(Span::new(file, 9, 10), "the brace")
            .help("did you mean `sphere`?")
            .fix(at, "sphere");
        (told, sources)
    }

    #[test]
    fn a_result_has_its_place_its_fix_and_what_is_related() {
        let (told, sources) = told();
        let result = result(&told, &sources);
        assert_eq!(result["ruleId"], "unknown-word");
        assert_eq!(result["level"], "error");
        let place = &result["locations"][0]["physicalLocation"];
        assert_eq!(place["artifactLocation"]["uri"], "a%20b%2Cc.scene");
        assert_eq!(
            place["region"],
            json!({"startLine": 1, "startColumn": 3, "endLine": 1, "endColumn": 8})
        );
        let replacement = &result["fixes"][0]["artifactChanges"][0]["replacements"][0];
        assert_eq!(replacement["insertedContent"]["text"], "sphere");
        assert_eq!(result["relatedLocations"][0]["message"]["text"], "the brace");
        let log: Value = serde_json::from_str(&log(&[result])).expect("JSON");
        assert_eq!(
            log["runs"][0]["results"][0]["message"]["text"],
            "50 % of `spere`\ndid you mean `sphere`?"
        );
    }

    #[test]
    fn a_command_is_one_line_and_what_it_separates_by_is_escaped() {
        let (told, sources) = told();
        assert_eq!(
            workflow_command(&told, &sources),
            "::error file=a b%2Cc.scene,line=1,endLine=1,col=3,endColumn=8,title=unknown-word::50 %25 of `spere`%0Adid you mean `sphere`?"
        );
    }
}
