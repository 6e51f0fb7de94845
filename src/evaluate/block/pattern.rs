//! Patterns: their words, parameters and modifiers, as pigments, normals, textures and functions share them.
//!
//! **In:** the items of a block in which a pattern is chosen. **Out:** the pattern, its parameters by the table
//! that it declares, its modifiers, and what moves it.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::noise::{NoiseGenerator, Turbulence};
use crate::pattern::{Kind, WaveKind};
use crate::scene::texture::{Layers, Modifiers};
use crate::scene::{
    ColorMap, Colors, Pattern, Pigment, PigmentId, PigmentKind, Source, Step, TransformId,
};
use crate::source::Site;
use crate::vocabulary::{Dialect, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::Place;
use super::parts::{Block, Part, Parts};

mod argument;
mod source;

pub(in crate::evaluate) use source::Grids;

/// A pattern during reading.
#[derive(Debug, Clone)]
pub(super) struct OpenPattern {
    /// The pattern that was chosen in this block, with its site.
    pub chosen: Option<(Source, Site)>,
    /// The pattern of the declared value that the block began with.
    pub inherited: Option<Pattern>,
    pub modifiers: Modifiers,
    pub steps: Vec<Step>,
    /// The number of steps that the declared value began with.
    pub inherited_steps: usize,
}

impl OpenPattern {
    /// Begins without a pattern.
    pub fn new(noise: NoiseGenerator, waves: usize) -> Self {
        let mut modifiers = Modifiers::default();
        (modifiers.setting.noise, modifiers.setting.waves) = (noise, waves);
        let (chosen, inherited, steps) = (None, None, Vec::new());
        Self { chosen, inherited, modifiers, steps, inherited_steps: 0 }
    }

    /// Returns the pattern of a normal that names none.
    pub fn flat(site: Site) -> Pattern {
        Pattern { source: Source::Average, site, modifiers: Modifiers::default() }
    }

    /// Goes on from a declared pattern, if there is one, and from what moved it.
    pub fn inherit(&mut self, pattern: Option<&Pattern>, steps: &[Step]) {
        self.chosen = None;
        if let Some(pattern) = pattern {
            let uv_mapping = self.modifiers.uv_mapping || pattern.modifiers.uv_mapping;
            self.modifiers = Modifiers { uv_mapping, ..pattern.modifiers };
        }
        self.inherited = pattern.cloned();
        self.steps = steps.to_vec();
        self.inherited_steps = steps.len();
    }

    /// Chooses a pattern. Its word sets what it has by itself, over what was written before: the wave of `wood`
    /// and the like, and the frequency 0 of lists and pictures. Those of another pattern before it stay
    /// (measured on POV-Ray 3.7).
    pub fn choose(&mut self, source: Source, site: Site) {
        let before = match &self.chosen {
            Some((source, _)) => Some(source),
            None => self.inherited.as_ref().map(|pattern| &pattern.source),
        };
        let (wave, frequency) = before.map_or((None, None), Source::own_wave);
        let modifiers = &mut self.modifiers;
        modifiers.wave = modifiers.wave.or(wave);
        modifiers.frequency = modifiers.frequency.or(frequency);
        let (wave, frequency) = source.own_wave();
        modifiers.wave = modifiers.wave.filter(|_| wave.is_none());
        modifiers.frequency = modifiers.frequency.filter(|_| frequency.is_none());
        self.chosen = Some((source, site));
    }

    /// Returns the pattern that was chosen, or the inherited one, with all modifiers.
    pub fn close(&self) -> Option<Pattern> {
        let modifiers = self.modifiers;
        if let Some((source, site)) = &self.chosen {
            return Some(Pattern { source: source.clone(), site: *site, modifiers });
        }
        self.inherited.clone().map(|pattern| Pattern { modifiers, ..pattern })
    }

    fn change_layers(&mut self, change: impl FnOnce(&mut Layers)) {
        change(&mut self.modifiers.layers);
        let Layers { octaves, lambda, omega } = self.modifiers.layers;
        self.modifiers.setting.turbulence = Turbulence::new(lambda, omega, octaves);
    }

    fn kind(&mut self) -> Option<&mut Kind> {
        let source = match &mut self.chosen {
            Some((source, _)) => source,
            None => &mut self.inherited.as_mut()?.source,
        };
        match source {
            Source::Kind(kind) => Some(kind),
            _ => None,
        }
    }
}

/// As the block `pattern { … }`; the other blocks of a pattern read its parts among their own.
impl Block for OpenPattern {
    const PLACE: Place = Place::PATTERN;
    const PARTS: Parts<Self> = &[
        Part::Number(Word::Frequency, |open, n, _| open.modifiers.frequency = Some(n)),
        Part::Number(Word::Phase, |open, n, _| open.modifiers.phase = Some(n)),
        Part::Vector(Word::Turbulence, "a number or a vector", |open, vector, _| {
            open.modifiers.turbulence = Some(vector);
        }),
        Part::Number(Word::Octaves, |open, n, _| open.change_layers(|it| it.octaves = n)),
        Part::Number(Word::Lambda, |open, n, _| open.change_layers(|it| it.lambda = n)),
        Part::Number(Word::Omega, |open, n, _| open.change_layers(|it| it.omega = n)),
        Part::Special(Word::NoiseGenerator, |evaluator, token, open| {
            open.modifiers.setting.noise = evaluator.noise_generator_after(token)?;
            Ok(())
        }),
        Part::Flag(Word::UvMapping, |open, (), _| open.modifiers.uv_mapping = true),
        Part::Special(Word::Warp, |evaluator, token, open| {
            evaluator.warp(token).map(|warp| open.steps.push(Step::Warp(warp)))
        }),
    ];

    fn other(&mut self, evaluator: &mut Evaluator, token: &Token) -> Option<Outcome<()>> {
        if let Some(read) = evaluator.pattern_item(token, self) {
            return Some(read);
        }
        let TokenKind::Word(word) = token.kind else { return None };
        Some(evaluator.pattern_source(token, word)?.and_then(|source| {
            self.choose(source, evaluator.whole(token));
            evaluator.only_in_normals(token, word)
        }))
    }

    fn transform(&mut self, _: &mut Evaluator, transform: TransformId, _: Site) {
        self.steps.push(Step::Transform(transform));
    }
}

/// Returns the wave of a word, with the exponent of `poly_wave`.
fn wave_of(word: Word) -> Option<WaveKind> {
    Some(match word {
        Word::RampWave => WaveKind::Ramp,
        Word::TriangleWave => WaveKind::Triangle,
        Word::SineWave => WaveKind::Sine,
        Word::ScallopWave => WaveKind::Scallop,
        Word::CubicWave => WaveKind::Cubic,
        Word::PolyWave => WaveKind::Poly(2.0),
        _ => return None,
    })
}

/// Returns the pattern that a word names by itself.
pub(super) fn kind_of(word: Word) -> Option<Kind> {
    Kind::of_word(word.name())
}

impl Evaluator<'_> {
    /// Reads an item that moves or modifies a pattern, or sets one of its parameters; `None` for other items.
    pub(super) fn pattern_item(
        &mut self,
        token: &Token,
        open: &mut OpenPattern,
    ) -> Option<Outcome<()>> {
        if let Some(transform) = self.transform_from(token) {
            return Some(transform.map(|id| open.steps.push(Step::Transform(id))));
        }
        let TokenKind::Word(word) = token.kind else { return None };
        if !word.is_built() {
            return None;
        }
        if let Some(kind) = wave_of(word) {
            return Some(self.wave_after(token, kind).map(|kind| open.modifiers.wave = Some(kind)));
        }
        match word {
            Word::Interpolate => self.interpolation(token, open),
            _ => match self.listed_part(token, word, open) {
                Some(read) => Some(read),
                None => self.pattern_parameter(token, word, open),
            },
        }
    }

    /// Reports `facets` where a pattern has values.
    pub(super) fn only_in_normals(&mut self, token: &Token, word: Word) -> Outcome<()> {
        if word != Word::Facets {
            return Ok(());
        }
        let diagnostic =
            Diagnostic::new(Code::MisplacedBlock, "`facets` turns normals, and has no values")
                .at(token.span, "expected a pattern with values")
                .help("write `normal { facets … }`; `crackle` has values, over cells of this kind");
        Err(self.report(&token.here, diagnostic))
    }

    /// Reads the exponent of `poly_wave`, which may be missing.
    fn wave_after(&mut self, token: &Token, kind: WaveKind) -> Outcome<WaveKind> {
        match kind {
            WaveKind::Poly(_) if self.is_before_value() => {
                Ok(WaveKind::Poly(self.number_after(token, "an exponent")?.value))
            }
            kind => Ok(kind),
        }
    }

    /// Reads the pattern that a word begins, with the values after it; `None` for other words. What a list
    /// holds is read by the caller.
    pub(super) fn pattern_source(&mut self, token: &Token, word: Word) -> Option<Outcome<Source>> {
        if !word.is_built() {
            return None;
        }
        if let Some(kind) = kind_of(word) {
            return Some(self.kind_after(token, kind).map(Source::Kind));
        }
        match word {
            Word::Magnet => Some(self.magnet(token)),
            Word::Average => Some(Ok(Source::Average)),
            Word::ImagePattern => {
                Some(self.image(token, word).map(|placed| Source::Image(Arc::new(placed.image))))
            }
            Word::Slope => Some(self.slope(token)),
            Word::Aoi => Some(Ok(Source::Aoi)),
            Word::DensityFile => Some(self.density_file(token)),
            Word::Object => {
                Some(self.object_pattern(token, |_, _| Ok(())).map(|(source, ())| source))
            }
            Word::PigmentPattern => Some(self.pigment(token).map(Source::Pigment)),
            Word::Function => Some(self.function_pattern(token)),
            _ => None,
        }
    }

    /// Reads `function { … }` as a pattern.
    fn function_pattern(&mut self, token: &Token) -> Outcome<Source> {
        let id = match self.function(token)? {
            Value::Function(id) => id,
            Value::Poison(poison) => {
                self.set_poison(poison);
                return Err(Reported);
            }
            _ => return Err(Reported),
        };
        match self.closed(id) {
            Some(function) => Ok(Source::Function(Arc::new(function))),
            None => {
                let diagnostic = Diagnostic::new(
                    Code::WrongType,
                    "the function of a pattern gives a number, and this one does not",
                )
                .at(token.span, "expected a function whose value is a number");
                Err(self.report(&token.here, diagnostic))
            }
        }
    }

    /// Reads the number of a noise generator.
    pub(super) fn noise_generator_after(&mut self, token: &Token) -> Outcome<NoiseGenerator> {
        let given = self.number_after(token, "1, 2 or 3")?;
        match given.value as i64 {
            // That of the scene, in POV-Ray (measured).
            0 if self.options.dialect == Dialect::Pov => Ok(self.noise),
            1 => Ok(NoiseGenerator::Plateaus),
            2 => Ok(NoiseGenerator::RangeCorrected),
            3 => Ok(NoiseGenerator::Perlin),
            _ => {
                self.out_of_range(&given, Word::NoiseGenerator, "1, 2 or 3");
                Err(Reported)
            }
        }
    }

    /// Reads `pattern { … }`, after its keyword, as a pigment whose red is the pattern's value.
    pub(in crate::evaluate) fn pattern_block(&mut self, token: &Token) -> Outcome<PigmentId> {
        let mut open = OpenPattern::new(self.noise, self.waves);
        let told = self.reports;
        self.block(token, Word::Pattern, |evaluator| evaluator.parts(&mut open))?;
        let site = token.here.site(token.span);
        let Some(pattern) = open.close() else {
            if self.poison.is_some() || self.reports > told {
                return Err(Reported);
            }
            let diagnostic = Diagnostic::new(Code::MissingPart, "this `pattern` names none")
                .at(site.span, "expected a pattern, as `gradient x`");
            return Err(self.report(&token.here, diagnostic));
        };
        if pattern.source == Source::Average {
            let diagnostic = Diagnostic::new(Code::WrongType, "`average` has no values of its own")
                .at(pattern.site.span, "it is the mean of pigments, normals or textures")
                .help("for the mean of pigments: `function { pigment { average pigment_map { … } } }`");
            return Err(self.report_in(pattern.site.expansion, diagnostic));
        }
        // Its values are numbers, also those of a list.
        let last = pattern.source.list().map_or(1, |count| count - 1) as f64;
        let gray = |value: f64| crate::color::Color::opaque(crate::color::Rgb::gray(value));
        let map = ColorMap(vec![(0.0, gray(0.0)), (last, gray(last))]);
        let kind = PigmentKind::Patterned { pattern: Box::new(pattern), colors: Colors::Map(map) };
        Ok(self.add_pigment(Pigment {
            kind,
            steps: open.steps,
            site,
            clear: None,
            has_own_colors: false,
            quick_color: None,
        }))
    }
}
