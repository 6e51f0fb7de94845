//! Whether the words of a finish make a whole one: the seed's three together, or POV-Ray's; never both,
//! wherever the finish starts from.

use super::albedo::Albedo;
use super::list_once;
use crate::color::Rgb;
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::Given;
use crate::evaluate::stream::Token;
use crate::evaluate::{Evaluator, Outcome};
use crate::scene::{Finish, FinishOrigin};
use crate::source::{Site, Span};
use crate::vocabulary::Word;

/// What was written in one block: the last number of each of the seed's words, and the first word of each
/// vocabulary.
#[derive(Default)]
pub(super) struct Written {
    pub kd: Option<f64>,
    pub ks: Option<f64>,
    pub phong_exponent: Option<f64>,
    pub seed: Option<(Word, Span)>,
    /// All of the seed's words, from the first to the last.
    pub seed_item: Option<Site>,
    /// Each `ks`.
    pub ks_items: Vec<(f64, Site)>,
    pub classic: Option<(Word, Span)>,
    /// Each of POV-Ray's words.
    pub said: Vec<(Word, Site)>,
    /// Enough of the last item for it to weigh nothing, where not all of it is.
    pub pieces: Option<Vec<Site>>,
    pub albedo: Albedo,
    /// The last `ambient`.
    pub ambient: Option<Given<Rgb>>,
    /// Each word of a highlight, for its strength or its size.
    pub highlights: Vec<(Word, Site)>,
    /// Where it starts from: its words count as written here.
    pub origin: FinishOrigin,
}

impl Written {
    /// An item set the weight of `word`; where `pieces` of it make that zero, the rest still hides what
    /// was set before.
    pub fn weigh(&mut self, word: Word, weightless: bool, item: Site, pieces: Option<Vec<Site>>) {
        let Self { origin, .. } = self;
        origin.zeros.retain(|(other, _)| *other != word);
        if weightless || pieces.is_some() {
            match word {
                Word::Ior => origin.ior.clear(),
                Word::Reflection => origin.reflection.clear(),
                _ => origin.highlights.retain(|(other, _)| *other != word),
            }
        }
        let pieces = match weightless {
            true => {
                origin.zeros.push((word, item));
                Vec::new()
            }
            false => pieces.unwrap_or(vec![item]),
        };
        for piece in pieces {
            match word {
                Word::Ior => list_once(&mut origin.ior, piece),
                Word::Reflection => list_once(&mut origin.reflection, piece),
                _ => origin.list_highlight(word, piece),
            }
        }
    }

    /// The seed's words made a whole finish of weight `ks`, of one with the weight `before`.
    pub fn weigh_seed(&mut self, ks: f64, before: Option<f64>) {
        let Self { origin, .. } = self;
        let Some(item) = self.seed_item else { return };
        origin.zeros.clear();
        let zero = self.ks_items.iter().rposition(|(weight, _)| *weight == 0.0);
        if ks == 0.0 || before == Some(0.0) || (before.is_some() && zero.is_some()) {
            // What was before stays hidden, or is nothing.
            origin.highlights.clear();
            origin.reflection.clear();
            origin.all_of_seed = false;
        }
        let pieces: Vec<Site> = match before {
            _ if ks == 0.0 => {
                origin.zeros.push((Word::Ks, item));
                return;
            }
            Some(_) if !origin.all_of_seed => {
                let since = self.ks_items.iter().skip(zero.map_or(0, |zero| zero + 1));
                since.map(|(_, item)| *item).collect()
            }
            // All of them, or some would be left alone.
            _ => {
                origin.all_of_seed = true;
                vec![item]
            }
        };
        for piece in pieces {
            origin.list_highlight(Word::Ks, piece);
            list_once(&mut origin.reflection, piece);
        }
    }

    /// Both vocabularies in one finish: the word that came later is wrong.
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

impl FinishOrigin {
    fn list_highlight(&mut self, word: Word, item: Site) {
        if self.highlights.iter().all(|(_, site)| site.span != item.span) {
            self.highlights.push((word, item));
        }
    }
}

impl Evaluator<'_> {
    /// The seed's words come together, and with none of POV-Ray's.
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
