//! Equivalents of functions of other languages: `round(A)`, `eof(F)`, `noise(x, y, z)`.

use super::Call;
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::Evaluator;
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::value::Value;
use crate::source::Span;

impl Evaluator<'_> {
    /// Reports and skips another language's function that is a keyword here, where a value is expected:
    /// `distance(a, b)`.
    pub(in crate::evaluate) fn called_elsewhere(
        &mut self,
        token: &Token,
        wanted: &str,
    ) -> Option<Diagnostic> {
        let TokenKind::Word(word) = token.kind else { return None };
        let call = self.call_elsewhere(word.name(), token.span, None)?;
        self.next();
        // Its arguments.
        self.skip_behind_parenthesis(token.span);
        let message = format!("expected {wanted}: `{}` is no function here", word.name());
        let diagnostic = Diagnostic::new(Code::ForeignWord, message)
            .at(token.span, "other languages call it")
            .help(call.help);
        Some(call.fixes.into_iter().fold(diagnostic, |told, (at, by)| told.fix(at, by)))
    }

    /// Skips the parentheses right after `name`.
    fn skip_behind_parenthesis(&mut self, name: Span) {
        let Some(next) = self.peek_on().map(|next| next.span) else { return };
        let text = &self.sources.get(name.file).text;
        let between = text.get(name.end as usize..next.start as usize);
        let group = next.file == name.file
            && between.is_some_and(|between| between.trim().is_empty())
            && text.get(next.start as usize..).is_some_and(|rest| rest.starts_with('('));
        if group {
            self.next();
        }
    }

    /// Returns the equivalent of another language's call: `len(A)`, `random()`.
    pub(super) fn call_elsewhere(
        &mut self,
        name: &str,
        span: Span,
        close: Option<&str>,
    ) -> Option<Call> {
        if close.is_some_and(|close| close.eq_ignore_ascii_case(name)) {
            return None;
        }
        let text = &self.sources.get(span.file).text;
        let rest = text.get(span.range().end..)?;
        let inner = rest.trim_start().strip_prefix('(')?;
        let inner = inner.split(['(', ')', '\n']).next()?;
        let start = text.len() - (rest.len() - rest.find('(')? - 1);
        let argument = inner.trim().to_owned();
        let symbol = self.scopes.symbol(&argument);
        let value = symbol.and_then(|symbol| self.scopes.read(symbol)).cloned();
        let stays = |help: &str| Some(Call { help: help.to_owned(), fixes: Vec::new() });
        match name.to_lowercase().as_str() {
            "len" | "length" | "size" | "count" | "sizeof" => match value {
                Some(Value::Array(_)) => {
                    let close = Span::new(span.file, start + inner.len(), start + inner.len());
                    let whole = format!("dimension_size({argument}, 1)");
                    let fixes = vec![(span, "dimension_size".into()), (close, ", 1".into())];
                    Some(Call { help: format!("write `{whole}`"), fixes })
                }
                Some(Value::String(_)) => Some(Call::renamed(span, "strlen")),
                None if argument.starts_with('"') => Some(Call::renamed(span, "strlen")),
                Some(Value::Vector(_) | Value::Color(_)) => Some(Call::renamed(span, "vlength")),
                // `length(x, y, z)` with three numbers.
                None if inner.matches(',').count() == 2 && !inner.contains('<') => stays(
                    "the length of a vector: `vlength(<x, y, z>)`; in a function, `sqrt(x*x + y*y + z*z)`",
                ),
                _ if name.eq_ignore_ascii_case("length") => None,
                _ => stays(
                    "`dimension_size(A, 1)` of an array, `strlen(S)` of a string, `vlength(V)` of a \
                     vector",
                ),
            },
            "random" | "rnd" | "randf" | "frand" | "drand" if value.is_none() => stays(
                "`#declare R = seed(1);` once, then `rand(R)` is another number from 0 to 1 each time",
            ),
            "mix" | "lerp" => stays("between two values: `A + (B - A)*T`"),
            "saturate" => stays("within 0 and 1: `min(max(A, 0), 1)`"),
            "clamp" if !self.has_read("math.inc") => {
                stays("within two values: `min(max(A, low), high)`")
            }
            "distance" => stays("from one point to another: `vlength(B - A)`"),
            "smoothstep" => {
                stays("with `#local T = min(max((X - A)/(B - A), 0), 1);` it is `T*T*(3 - 2*T)`")
            }
            "hypot" => stays("the length of a vector: `vlength(<A, B, 0>)`"),
            "fract" | "frac" => stays("what is behind the point: `mod(A, 1)`"),
            "cbrt" => stays("the third root: `pow(A, 1/3)`"),
            "sign" | "sgn" if !self.has_read("math.inc") => {
                stays("`select(A, -1, 0, 1)` is below 0, 0, or above")
            }
            "step" => stays("0 or 1: `(X >= Edge)`"),
            other => self.function_elsewhere(other, span, &argument),
        }
    }

    /// Returns the replacement for the call of `name` at `span`. `argument` is the whole text in its
    /// parentheses, if it contains no others.
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
            "noise" | "noise3d" | "perlin" | "perlin_noise" | "snoise" => Some(Call {
                help: "noise is `f_noise3d(x, y, z)` of `#include \"functions.inc\"`".to_owned(),
                fixes: Vec::new(),
            }),
            _ => None,
        }
    }
}
