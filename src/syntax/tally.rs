//! Merges repeated diagnostics of the same mistake.
//!
//! **In:** diagnostics, in source order. **Out:** the same, but adjacent closers without an opener share one
//! diagnostic, and so do all but the first few openers that lack their closer at the same position; each
//! gives the number of further ones.

use std::collections::HashMap;

use crate::diagnostic::{Code, Diagnostic};

/// The most openers of one kind that are reported one by one.
const FEW: usize = 10;

pub(super) fn tally(found: Vec<Diagnostic>, text: &str) -> Vec<Diagnostic> {
    let mut told: Vec<Diagnostic> = Vec::with_capacity(found.len().min(1000));
    // The number of further diagnostics for each in `told`.
    let mut more: HashMap<usize, usize> = HashMap::new();
    let mut openers: HashMap<String, (usize, usize)> = HashMap::new();
    // The end of the run that the last diagnostic covers.
    let mut run_end = 0;
    for diagnostic in found {
        let Some(place) = diagnostic.primary().map(|label| label.span) else {
            told.push(diagnostic);
            continue;
        };
        match diagnostic.code {
            Code::StrayCloser | Code::StrayDirective => {
                let gap = text.get(run_end..place.start as usize).unwrap_or("x");
                run_end = place.end as usize;
                if let Some(last) = told.last_mut()
                    && (last.code, &last.message) == (diagnostic.code, &diagnostic.message)
                    && gap.trim().is_empty()
                {
                    if let ([fix], [other]) = (last.fixes.as_mut_slice(), &diagnostic.fixes[..]) {
                        fix.span = fix.span.to(other.span);
                    }
                    *more.entry(told.len() - 1).or_default() += 1;
                    continue;
                }
            }
            Code::UnclosedBlock | Code::MissingEnd if diagnostic.fixes.is_empty() => {
                let (count, last) = openers.entry(diagnostic.message.clone()).or_insert((0, 0));
                *count += 1;
                if *count > FEW {
                    *more.entry(*last).or_default() += 1;
                    continue;
                }
                *last = told.len();
            }
            _ => {}
        }
        told.push(diagnostic);
    }
    for (at, more) in more {
        let count = thousands(more);
        told[at].help.insert(0, format!("and {count} more like it"));
    }
    told
}

/// Returns a number with thousands separators: `49,999`.
fn thousands(number: usize) -> String {
    let digits = number.to_string();
    let groups = digits.as_bytes().rchunks(3).rev();
    groups.map(|group| String::from_utf8_lossy(group)).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::{Code, Diagnostic, Diagnostics};
    use crate::source::{FileId, Source};
    use crate::syntax::{ParseOptions, parse};

    fn told(text: &str) -> Vec<Diagnostic> {
        let mut diagnostics = Diagnostics::new(true);
        let source = Source::new("a.scene", text.to_owned());
        parse(&source, FileId(0), &ParseOptions::default(), &mut diagnostics);
        diagnostics.iter().cloned().collect()
    }

    #[test]
    fn fifty_thousand_closers_are_one_message_that_says_how_many_and_one_fix() {
        for closer in ["}", ")", "]", ">", "} ", "#end\n"] {
            let text = closer.repeat(50_000);
            let told = told(&text);
            assert_eq!(told.len(), 1, "{closer}: {told:#?}");
            assert_eq!(told[0].help[0], "and 49,999 more like it", "{closer}");
            for fix in &told[0].fixes {
                assert_eq!(fix.span.range(), 0..text.trim_end().len(), "{closer}");
            }
        }
    }

    #[test]
    fn what_stands_between_closers_parts_them() {
        let told = told("sphere { 0, 1 } } sphere { 0, 1 } }}");
        assert_eq!(told.len(), 2);
        assert_eq!(told[0].help, ["leave it out"]);
        assert_eq!(told[1].help, ["and 1 more like it", "leave it out"]);
    }

    #[test]
    fn blocks_in_blocks_that_nobody_closes_are_a_handful_of_messages() {
        let told = told(&"sphere {\n".repeat(999));
        assert!(told.iter().all(|one| one.code == Code::UnclosedBlock));
        assert_eq!(told.len(), 10);
        assert_eq!(told[9].help, ["and 989 more like it"]);
    }
}
