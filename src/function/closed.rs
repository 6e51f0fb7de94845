//! Closed functions: a function together with everything it calls, independent of its environment.

use super::domain::{Needed, needed};
use super::noise::NoiseFunction;
use super::slope::Sloped;
use super::tape::{Function, Step};
use super::{Outside, OutsideId};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::placement::Map;
use crate::noise::NoiseGenerator;
use crate::pattern::Pattern;
use crate::spline::Spline;

/// Something that a function calls, in self-contained form.
#[derive(Debug, Clone, PartialEq)]
pub enum Asked {
    Noise {
        function: NoiseFunction,
        /// The generator of the scene.
        generator: NoiseGenerator,
    },
    /// One component of a spline's value.
    Spline {
        spline: Spline,
        component: usize,
    },
    /// A pattern at a point, with its values mapped.
    Pattern {
        pattern: Pattern,
        pattern_from_point: Map,
        /// Sorted by value, linear between entries, constant outside; at least one entry.
        map: Vec<(f64, f64)>,
    },
    Constant(f64),
}

/// A function that contains everything it calls.
#[derive(Debug, Clone, PartialEq)]
pub struct Closed {
    function: Function,
    asked: Vec<Asked>,
    needed: Vec<Needed>,
}

impl Closed {
    /// Returns the number of operations; those inside a loop count once.
    pub fn operations(&self) -> usize {
        self.function.operations()
    }

    /// Closes a function; `None` if `asked` does not know something that the function calls.
    pub fn new(
        mut function: Function,
        mut asked: impl FnMut(OutsideId) -> Option<Asked>,
    ) -> Option<Self> {
        let mut all: Vec<(OutsideId, Asked)> = Vec::new();
        for step in &mut function.steps {
            if let Step::Ask { id, .. } = step {
                let known = all.iter().position(|(other, _)| other == id);
                let place = match known {
                    Some(place) => place,
                    None => {
                        all.push((*id, asked(*id)?));
                        all.len() - 1
                    }
                };
                *id = OutsideId(place as u32);
            }
        }
        let needed = needed(&function);
        Some(Self { function, asked: all.into_iter().map(|(_, asked)| asked).collect(), needed })
    }

    /// Returns whether it is certainly NaN for all arguments in these intervals.
    pub fn is_undefined(&self, arguments: &[Interval]) -> bool {
        self.needed.iter().any(|needed| needed.is_missed(arguments, self))
    }

    pub fn function(&self) -> &Function {
        &self.function
    }
}

impl Asked {
    fn value(&self, arguments: &[f64]) -> f64 {
        let argument = |at: usize| arguments.get(at).copied().unwrap_or(0.0);
        match self {
            Self::Noise { function, generator } => function.value(*generator, arguments),
            Self::Spline { spline, component } => {
                spline.at(argument(0)).get(*component).copied().unwrap_or(f64::NAN)
            }
            Self::Pattern { pattern, pattern_from_point, map } => {
                let point = Vector::new(argument(0), argument(1), argument(2));
                let place = pattern_from_point.point(point);
                look_up(map, pattern.value(place, Vector::ZERO).value)
            }
            Self::Constant(value) => *value,
        }
    }

    fn bounds(&self, arguments: &[Interval]) -> Interval {
        match self {
            Self::Noise { function, generator } => function.bounds(*generator, arguments),
            Self::Spline { spline, component } => {
                let over = arguments.first().copied().unwrap_or(Interval::EVERYTHING);
                spline.bounds(*component, over)
            }
            Self::Pattern { pattern, pattern_from_point, map } => {
                let side = |at: usize| arguments.get(at).copied().unwrap_or(Interval::point(0.0));
                let half = |side: Interval| (0.5 * (side.high - side.low)).next_up();
                let sides = [side(0), side(1), side(2)];
                let middle = Vector::from_array(sides.map(|s| s.low + 0.5 * (s.high - s.low)));
                let reach =
                    pattern_from_point.point_error(middle, Vector::from_array(sides.map(half)));
                let values = match middle.is_finite() && reach.is_finite() {
                    true => pattern.bounds(pattern_from_point.point(middle), reach),
                    false => Interval { low: 0.0, high: 1.0 },
                };
                look_up_all(map, values)
            }
            Self::Constant(value) => Interval::point(*value),
        }
    }
}

/// Looks up a value in a map. **Source:** like a pigment's map (`world::pigment`).
fn look_up(map: &[(f64, f64)], value: f64) -> f64 {
    let (Some(first), Some(last)) = (map.first(), map.last()) else { return f64::NAN };
    if value >= last.0 {
        return last.1;
    }
    let above = map.partition_point(|entry| entry.0 < value);
    match map.get(above.wrapping_sub(1)..=above) {
        Some([low, high]) => low.1 + (high.1 - low.1) * ((value - low.0) / (high.0 - low.0)),
        _ => first.1,
    }
}

/// Range of a map over an interval of values.
fn look_up_all(map: &[(f64, f64)], values: Interval) -> Interval {
    let entries = map.iter().filter(|entry| values.contains(entry.0)).map(|entry| entry.1);
    let ends = [look_up(map, values.low), look_up(map, values.high)];
    let all = entries.chain(ends).map(Interval::point);
    let Interval { low, high } = all.reduce(Interval::hull).unwrap_or(Interval::EVERYTHING);
    // Between two entries the value is rounded.
    let off = 4.0 * f64::EPSILON * map.iter().fold(0.0_f64, |most, entry| most.max(entry.1.abs()));
    Interval { low: low - off, high: high + off }
}

impl Outside for Closed {
    fn value(&self, id: OutsideId, arguments: &[f64]) -> f64 {
        self.asked.get(id.0 as usize).map_or(f64::NAN, |asked| asked.value(arguments))
    }

    fn bounds(&self, id: OutsideId, arguments: &[Interval]) -> Interval {
        let asked = self.asked.get(id.0 as usize);
        asked.map_or(Interval::EVERYTHING, |asked| asked.bounds(arguments))
    }

    fn sloped<const N: usize>(&self, id: OutsideId, arguments: &[Sloped<N>]) -> Sloped<N> {
        match self.asked.get(id.0 as usize) {
            Some(Asked::Noise { function, generator }) => function.sloped(*generator, arguments),
            Some(asked) => {
                let values: Vec<_> = arguments.iter().map(|argument| argument.value).collect();
                Sloped::anyhow(asked.bounds(&values), arguments.iter().all(Sloped::is_level))
            }
            None => Sloped::anyhow(Interval::EVERYTHING, false),
        }
    }
}
