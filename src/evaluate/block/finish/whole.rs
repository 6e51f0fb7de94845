//! Completeness of a finish: it has either all of the seed's three keywords or only POV-Ray's, never both,
//! including those of the finish from which it starts.

use super::albedo::Albedo;
use crate::color::Rgb;
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::Given;
use crate::evaluate::stream::Token;
use crate::evaluate::{Evaluator, Outcome};
use crate::scene::{Finish, FinishOrigin};
use crate::source::{Site, Span};
use crate::vocabulary::Word;

/// Keywords of one block: the last value of each of the seed's, and the first keyword of each vocabulary.
#[derive(Default)]
pub(super) struct Written {
    pub kd: Option<f64>,
    pub ks: Option<f64>,
    pub phong_exponent: Option<f64>,
    pub seed: Option<(Word, Span)>,
    pub classic: Option<(Word, Span)>,
    /// Each of POV-Ray's keywords.
    pub said: Vec<(Word, Site)>,
    pub albedo: Albedo,
    /// The last `ambient`.
    pub ambient: Option<Given<Rgb>>,
    /// Each keyword for the strength or the size of a highlight.
    pub highlights: Vec<(Word, Site)>,
    /// The origin of the finish from which this one starts; its keywords count as written here.
    pub origin: FinishOrigin,
}

impl Written {
    /// Returns the diagnostic for both vocabularies in one finish, at the later keyword.
    fn mixed(&self) -> Option<Diagnostic> {
        let earlier = |word: Option<(Word, Site)>| word.map(|(word, site)| (word, site.span));
        let (seed, seed_span) = self.seed.or(earlier(self.origin.seed))?;
        let (classic, classic_span) = self.classic.or(earlier(self.origin.classic))?;
        let diagnostic = Diagnostic::new(
            Code::MixedFinish,
            format!("a finish mixes `{}` with `{}`", seed.name(), classic.name()),
        );
        let (of_seed, of_classic) = ("a word of the seed's", "a word of POV-Ray's finish");
        let diagnostic = match self.classic {
            Some(_) => diagnostic.at(classic_span, of_classic).also(seed_span, of_seed),
            None => diagnostic.at(seed_span, of_seed).also(classic_span, of_classic),
        };
        Some(diagnostic.help("`kd`, `ks` and `phong_exponent` stand alone; else use `diffuse`, `specular`, `reflection` and their kin"))
    }
}

impl Evaluator<'_> {
    /// Checks that the seed's keywords are complete and not mixed with POV-Ray's.
    pub(super) fn whole_finish(
        &mut self,
        opener: &Token,
        finish: &mut Finish,
        written: &Written,
    ) -> Outcome<()> {
        if let Some(diagnostic) = written.mixed() {
            return Err(self.report(&opener.here, diagnostic));
        }
        let Some((_, seed_span)) = written.seed else { return Ok(()) };
        let (old_kd, old_ks, old_exponent) = match finish {
            Finish::Seed { kd, ks, phong_exponent } => {
                (Some(*kd), Some(*ks), Some(*phong_exponent))
            }
            Finish::Classic(_) => (None, None, None),
        };
        let kd = written.kd.or(old_kd);
        let ks = written.ks.or(old_ks);
        let exponent = written.phong_exponent.or(old_exponent);
        if let (Some(kd), Some(ks), Some(phong_exponent)) = (kd, ks, exponent) {
            *finish = Finish::Seed { kd, ks, phong_exponent };
            return Ok(());
        }
        let missing: Vec<&str> = [("`kd`", kd), ("`ks`", ks), ("`phong_exponent`", exponent)]
            .iter()
            .filter(|(_, value)| value.is_none())
            .map(|(name, _)| *name)
            .collect();
        let diagnostic = Diagnostic::new(
            Code::IncompleteFinish,
            format!("this finish lacks {}", missing.join(" and ")),
        )
        .at(seed_span, "the seed's three words come together")
        .also(opener.span, "in this finish");
        Err(self.report(&opener.here, diagnostic))
    }
}
