//! `rainbow { direction … angle … width … color_map { … } … }`: a coloured arc.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::Rainbow;
use crate::source::Site;
use crate::vocabulary::Word;

use super::super::stream::Token;
use super::super::value::Value;
use super::super::{Evaluator, Outcome};
use super::Place;
use super::parts::{Block, Part, Parts};
use super::range::Range;

/// The angles of an arc.
const ARC: Range = Range::new(|n| (0.0..=360.0).contains(&n), "0 to 360");

/// A rainbow during reading.
#[derive(Debug)]
struct OpenRainbow {
    rainbow: Rainbow,
    /// Its `angle` was read.
    angle: bool,
    falloff: Option<Site>,
    up: Option<Site>,
}

impl Block for OpenRainbow {
    const PLACE: Place = Place {
        word: Some(Word::Rainbow),
        families: &[],
        others: &[
            Word::Angle,
            Word::ArcAngle,
            Word::ColorMap,
            Word::Direction,
            Word::Distance,
            Word::FalloffAngle,
            Word::Jitter,
            Word::Up,
            Word::Width,
        ],
    };
    const PARTS: Parts<Self> = &[
        Part::Special(Word::Direction, |evaluator, token, open| {
            let what = "the direction of the sun's light";
            open.rainbow.direction = evaluator.direction_after(token, what)?.value;
            Ok(())
        }),
        Part::Number(Word::Angle, |open, number, _| {
            (open.rainbow.angle, open.angle) = (number, true);
        }),
        Part::Number(Word::Width, |open, number, _| open.rainbow.width = number),
        Part::Number(Word::Distance, |open, number, _| open.rainbow.distance = number),
        Part::Special(Word::ColorMap, |evaluator, token, open| {
            match evaluator.color_map(token)? {
                Value::ColorMap(map) => open.rainbow.colors = Some(map.map.clone()),
                Value::Poison(poison) => evaluator.set_poison(poison),
                _ => {}
            }
            Ok(())
        }),
        Part::Number(Word::Jitter, |open, number, _| open.rainbow.jitter = number),
        Part::Special(Word::Up, |evaluator, token, open| {
            open.rainbow.up = evaluator.direction_after(token, "the middle of the arc")?.value;
            open.up = Some(evaluator.whole(token));
            Ok(())
        }),
        Part::Ranged(Word::ArcAngle, ARC, |open, number, _| open.rainbow.arc_angle = Some(number)),
        Part::Ranged(Word::FalloffAngle, ARC, |open, number, site| {
            open.rainbow.falloff_angle = Some(number);
            open.falloff = Some(site);
        }),
    ];

    fn inherit(&mut self, _: &Evaluator, value: &Value) -> bool {
        let Value::Rainbow(declared) = value else { return false };
        self.rainbow = Rainbow { site: self.rainbow.site, ..declared.as_ref().clone() };
        self.angle = true;
        true
    }
}

impl Evaluator<'_> {
    /// Reads a rainbow of the scene.
    pub(super) fn placed_rainbow(&mut self, token: &Token) -> Outcome<()> {
        if let Value::Rainbow(rainbow) = self.rainbow(token)? {
            let item = self.whole(token);
            self.stored += rainbow.bytes();
            self.scene.rainbows.push(Rainbow { item, ..rainbow.as_ref().clone() });
            return Ok(());
        }
        self.needs_poison()
    }

    /// Reads `rainbow { [Name] … }`.
    pub(super) fn rainbow(&mut self, token: &Token) -> Outcome<Value> {
        let opener = token.clone();
        self.value_or_poison(|evaluator| {
            let rainbow = Rainbow::new(opener.here.site(opener.span));
            let mut open = OpenRainbow { rainbow, angle: false, falloff: None, up: None };
            evaluator.block(&opener, Word::Rainbow, |evaluator| {
                evaluator.parts(&mut open)?;
                match evaluator.poison {
                    Some(_) => Ok(()),
                    None => evaluator.rainbow_is_whole(&opener, &open),
                }
            })?;
            Ok(Value::Rainbow(Arc::new(open.rainbow)))
        })
    }

    /// Reports what a rainbow lacks, and arcs that contradict themselves.
    fn rainbow_is_whole(&mut self, opener: &Token, open: &OpenRainbow) -> Outcome<()> {
        let rainbow = &open.rainbow;
        if rainbow.direction == Vector::ZERO {
            let diagnostic =
                Diagnostic::new(Code::MissingPart, "this `rainbow` has no direction")
                    .at(opener.span, "expected `direction` in it")
                    .help("it is the one in which the sun's light goes, such as `direction <0.2, -0.3, 1>`");
            return Err(self.report(&opener.here, diagnostic));
        }
        self.arc_is_possible(opener, open)?;
        let lacks = [
            (!open.angle, "angle", "`angle 42`", "it is 0"),
            (rainbow.width == 0.0, "width", "`width 5`", "nothing shows"),
            (rainbow.colors.is_none(), "color_map", "`color_map { … }`", "nothing shows"),
        ];
        for (_, what, wanted, otherwise) in lacks.into_iter().filter(|(lacks, ..)| *lacks) {
            let message = format!("this `rainbow` has no `{what}`; {otherwise}");
            let diagnostic = Diagnostic::new(Code::MissingPart, message)
                .at(opener.span, format!("expected {wanted} in it"));
            self.opinion(&opener.here, diagnostic)?;
        }
        Ok(())
    }

    fn arc_is_possible(&mut self, opener: &Token, open: &OpenRainbow) -> Outcome<()> {
        let Rainbow { direction, up, arc_angle, falloff_angle, .. } = open.rainbow;
        let (axis, top) = (direction.normalize(), up.normalize());
        if axis.cross(top).length() < PARALLEL {
            let message = "`up` of this `rainbow` runs along its `direction`";
            let at = open.up.map_or(opener.span, |site| site.span);
            let diagnostic = Diagnostic::new(Code::ZeroVector, message)
                .at(at, "expected another direction")
                .help("from the axis, `up` points to the middle of the arc");
            return Err(self.report(&opener.here, diagnostic));
        }
        let Some((falloff, site)) = falloff_angle.zip(open.falloff) else { return Ok(()) };
        match arc_angle {
            Some(arc) if arc < falloff => {
                let message = format!("`falloff_angle` is {falloff}, and `arc_angle` only {arc}");
                let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                    .at(site.span, format!("expected {arc} or less"))
                    .help("the rainbow fades from `falloff_angle` to `arc_angle`");
                Err(self.report(&opener.here, diagnostic))
            }
            Some(_) => Ok(()),
            None => {
                let message = "`falloff_angle` has no effect without `arc_angle`";
                let diagnostic = Diagnostic::new(Code::MissingPart, message)
                    .at(site.span, "leave this out, or write `arc_angle`, too")
                    .help("the rainbow fades from `falloff_angle` to `arc_angle`");
                self.opinion(&opener.here, diagnostic)
            }
        }
    }
}

/// The sine of the angle between `up` and `direction` below which they are parallel.
///
/// **Source:** POV-Ray 3.7's behaviour, measured.
const PARALLEL: f64 = 1.414e-5;
