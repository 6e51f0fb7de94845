//! What to say of a call with too few or too many arguments.

use std::ops::RangeInclusive;

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::Word;

use super::report::count;
use super::{Evaluator, Here, Reported};

impl Evaluator<'_> {
    pub(super) fn wrong_arity(
        &mut self,
        here: &Here,
        word: Word,
        span: Span,
        arity: RangeInclusive<usize>,
        found: usize,
    ) -> Reported {
        let diagnostic = Diagnostic::new(
            Code::WrongArity,
            format!("`{}` takes {}, and is given {found}", word.name(), count(&arity, "argument")),
        )
        .at(span, format!("expected {}", count(&arity, "argument")));
        let diagnostic = match word {
            Word::Rand => diagnostic
                .help("it takes a stream: `#declare R = seed(1);` once, and then `rand(R)`"),
            Word::DimensionSize if found == 1 => diagnostic
                .help("which dimension comes second: `dimension_size(A, 1)` is how many elements"),
            Word::Str if found == 1 => {
                let call = self.sources.text(span);
                let asked = call.split_once('(').and_then(|(_, rest)| rest.strip_suffix(')'));
                let asked = asked.map(str::trim).filter(|asked| !asked.contains('\n'));
                diagnostic.help(format!(
                    "how wide and how many digits: `str({}, 0, 3)` has three behind the point",
                    asked.unwrap_or("A")
                ))
            }
            // `vlength(1, 2, 3)`
            _ if *arity.end() == 1 && found == 3 && word.sentence().contains("(v)") => diagnostic
                .help(format!("a vector has angles: `{}(<1, 2, 3>)`", word.name()))
                .help(word.sentence()),
            _ => diagnostic.help(word.sentence()),
        };
        self.report(here, diagnostic)
    }
}
