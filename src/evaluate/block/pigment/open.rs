//! Incremental reading of a pigment: from a block of its own, or from an old texture that contains its items.

use crate::color::{Color, Rgb};
use crate::evaluate::stream::Token;
use crate::evaluate::{Evaluator, Outcome, Reported};
use crate::scene::{ColorMap, Colors, Pigment, PigmentId, PigmentKind, Source};
use crate::vocabulary::{Dialect, Word};

use super::super::pattern::OpenPattern;
use super::Written;

/// A pigment during reading.
pub(in crate::evaluate::block) struct OpenPigment {
    pub(super) pigment: Pigment,
    pub(super) pattern: OpenPattern,
    /// Whether it began as the default.
    is_default: bool,
    pub(super) written: Written,
    failed: bool,
}

impl OpenPigment {
    /// Allows the next items to replace the colour or the pattern.
    pub(in crate::evaluate::block) fn begin_anew(&mut self) {
        self.written.first = None;
    }
}

impl Evaluator<'_> {
    /// Returns a pigment, begun by `token`, into which items are read.
    pub(in crate::evaluate::block) fn open_pigment(
        &self,
        token: &Token,
        start: PigmentId,
    ) -> OpenPigment {
        let site = token.here.site(token.span);
        let pigment = Pigment { site, ..self.scene.pigments[start.index()].clone() };
        let is_default = start == PigmentId(0);
        let mut pattern = OpenPattern::new(self.noise, self.waves);
        pattern.inherit(pigment.pattern(), &pigment.steps);
        OpenPigment { pigment, pattern, is_default, written: Written::default(), failed: false }
    }

    pub(in crate::evaluate::block) fn item_of_pigment(
        &mut self,
        token: &Token,
        open: &mut OpenPigment,
    ) {
        if self.pigment_item(token, open) == Err(Reported) {
            open.failed = true;
            open.written.mistaken(token);
            self.skip_values();
        }
    }

    pub(in crate::evaluate::block) fn close_pigment(
        &mut self,
        open: OpenPigment,
    ) -> Outcome<PigmentId> {
        let OpenPigment { mut pigment, pattern: open, is_default, written, mut failed } = open;
        let pattern = open.close();
        // A map may precede its pattern.
        if written.is_map
            && let Some((_, token)) = &written.colors
            && !failed
        {
            let is_new = is_default && written.first.is_none() && !written.named;
            let source = pattern.as_ref().map(|pattern| &pattern.source);
            failed |= self.judge_map(source, token, is_new) == Err(Reported);
        }
        if failed {
            return Err(Reported);
        }
        pigment.steps = open.steps;
        let Some(pattern) = pattern else { return Ok(self.add_pigment(pigment)) };
        let given = written.colors.map(|(colors, _)| (colors, written.clear));
        let (colors, clear) = match (given, &pigment.kind) {
            (Some(given), _) => {
                pigment.has_own_colors = false;
                given
            }
            // In POV-Ray 3.7 the written colours stay, and those that `checker` has by itself (measured).
            (None, PigmentKind::Patterned { colors, .. })
                if open.chosen.is_none()
                    || self.options.dialect == Dialect::Pov
                        && !pigment.has_own_colors
                        && *colors != Colors::Image =>
            {
                (colors.clone(), pigment.clear)
            }
            (None, _) => {
                pigment.has_own_colors = true;
                (self.own_colors(&pattern.source), None)
            }
        };
        if pattern.source == Source::Average && !matches!(colors, Colors::Pigments(_)) {
            return Err(self.average_of_nothing(pattern.site, Word::PigmentMap));
        }
        (pigment.kind, pigment.clear) =
            (PigmentKind::Patterned { pattern: Box::new(pattern), colors }, clear);
        Ok(self.add_pigment(pigment))
    }

    /// Returns the colours of a pattern without a map.
    fn own_colors(&self, source: &Source) -> Colors {
        match source {
            Source::Kind(kind) => {
                let colors = kind.colors().iter().map(|&(value, [red, green, blue])| {
                    (value, Color::opaque(Rgb::new(red, green, blue)))
                });
                Colors::Map(ColorMap(colors.collect()))
            }
            _ => Colors::Map(ColorMap::gray()),
        }
    }
}
