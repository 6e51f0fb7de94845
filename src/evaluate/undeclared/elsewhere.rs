//! Functions that other languages call, and what is written here: `round(A)`, `eof(F)`, `noise(x, y, z)`.

use super::Call;
use crate::evaluate::Evaluator;
use crate::source::Span;

impl Evaluator<'_> {
    /// What to write for the call of `name` at `span`, of which all that stands in its parentheses is `argument`, if
    /// no other parenthesis does.
    pub(super) fn function_elsewhere(
        &self,
        name: &str,
        span: Span,
        argument: &str,
    ) -> Option<Call> {
        let text = &self.sources.get(span.file).text;
        let behind = text.get(span.end as usize..).unwrap_or("").trim_start();
        let call = format!("({argument})");
        let whole = behind.strip_prefix('(').is_some_and(|rest| {
            rest.find(['(', ')'])
                .is_some_and(|end| rest[..end].trim() == argument && rest[end..].starts_with(')'))
        });
        match name {
            "round" if whole && !argument.is_empty() => Some(Call {
                help: format!("write `floor({argument} + 0.5)`"),
                fixes: vec![
                    (span, "floor".to_owned()),
                    (self.end_of_call(span), " + 0.5)".to_owned()),
                ],
            }),
            "round" => Some(Call {
                help: "to the nearest whole number: `floor(A + 0.5)`".to_owned(),
                fixes: Vec::new(),
            }),
            "eof" | "feof" if whole => {
                let before = text.get(..span.start as usize).unwrap_or("");
                let sign = before.trim_end().strip_suffix('!').map(str::len);
                let (right, start) = match sign {
                    Some(start) => ("defined", start as u32),
                    None => ("!defined", span.start),
                };
                Some(Call {
                    help: format!("a file is `defined` up to its end: write `{right}{call}`"),
                    fixes: vec![(Span { start, ..span }, right.to_owned())],
                })
            }
            "noise" | "perlin" | "perlin_noise" | "snoise" => Some(Call {
                help: "noise is `f_noise3d(x, y, z)` of `#include \"functions.inc\"`".to_owned(),
                fixes: Vec::new(),
            }),
            _ => None,
        }
    }
}
