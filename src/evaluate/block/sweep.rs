//! `sphere_sweep`: its spline, the number of spheres, and the spheres.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::Solid;
use crate::scene::sweep::{Kind, Sweep};

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Outcome, Reported};

impl Evaluator<'_> {
    /// Reads `linear_spline | b_spline | cubic_spline  count, <centre>, radius, …`.
    pub(super) fn sphere_sweep(&mut self, token: &Token) -> Outcome<Solid> {
        self.skip_commas();
        let kinds = Kind::ALL.into_iter();
        let Some((kind, word)) =
            kinds.filter_map(|kind| Some((kind, self.take_word(kind.word())?))).next()
        else {
            let found = self.peek().cloned();
            // A misspelt kind is reported as such.
            if let Some(Token { kind: TokenKind::Expression(id), here, .. }) = &found
                && self.unknown_name(here, *id).is_some()
            {
                return Err(Reported);
            }
            let wanted = "`linear_spline`, `b_spline` or `cubic_spline`";
            return Err(self.expected(wanted, found.as_ref(), (&token.here, token.span.after())));
        };
        self.skip_commas();
        let label = "expected how many there are before this".to_owned();
        if let Some(reported) = self.uncounted("", label, "how many spheres there are") {
            return Err(reported);
        }
        let count = self.number_after(&word, "how many spheres there are")?;
        let name = kind.word().name();
        if count.value < kind.least() as f64 {
            let least = kind.least();
            let message = format!("a sphere_sweep by `{name}` has {least} spheres or more");
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(count.span, format!("expected {least} or more"))
                .also(word.span, "for this");
            return Err(self.report(&count.here, diagnostic));
        }
        let wanted = self.counted(&count);
        let mut sweep = Sweep { kind, spheres: Vec::new() };
        while sweep.spheres.len() < wanted {
            let nth = sweep.spheres.len() + 1;
            self.announced = Some((count.span, nth - 1));
            let centre = self.point(token, &format!("a vector for the centre of sphere {nth}"));
            self.announced = None;
            let centre = centre?;
            let radius =
                self.number_after(token, &format!("a number for the radius of sphere {nth}"))?;
            if radius.value < 0.0 {
                self.lint_negative_radius(&radius.here, radius.span, radius.value);
            }
            sweep.spheres.push((centre.value, radius.value));
            if !self.has_memory(sweep.bytes()) {
                return Err(self.too_much_memory(&token.here, token.span));
            }
        }
        self.skip_commas();
        if let Some(TokenKind::Expression(_) | TokenKind::Literal(_)) =
            self.peek().map(|next| &next.kind)
            && let Some(next) = self.next()
        {
            let message = format!("this sphere_sweep has more than {wanted} spheres");
            let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                .at(next.span, "one too many")
                .also(count.span, "so many were announced");
            return Err(self.report(&next.here, diagnostic));
        }
        if sweep.is_sizeless() {
            let message = "a sphere_sweep of radius 0 throughout is nothing";
            let diagnostic = Diagnostic::new(self.sizeless(), message)
                .at(token.span, "expected a radius of more than 0");
            self.nothing(token, &token.here, diagnostic)?;
        }
        self.stored += sweep.bytes();
        Ok(Solid::SphereSweep(Arc::new(sweep)))
    }
}
