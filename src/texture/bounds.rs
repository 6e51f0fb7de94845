//! Bounds of pigments and patterns: intervals that contain their colours and values over a box of points, and their
//! slopes.
//!
//! **Invariant:** an interval contains what is computed for each point of the box. It shrinks with the box, but
//! for jumps, and for patterns without bounds of their own, which have their range. Slopes are those of exact
//! colours: the steps of single precision are no surface of their own.

use super::blend::{Blend, Pattern, Source};
use super::function::{Closed, Component};
use super::pigment::Pigment;
use super::space::{Space, Start, Step};
use crate::color::{Color, Rgb};
use crate::function::{Binary, Number, Rounded, Sloped};
use crate::math::Vector;
use crate::math::finite::single;
use crate::math::interval::Interval;

/// Relative rounding of the value of a pattern, which sums noise of many octaves.
const VALUE_ROUNDING: f64 = 4096.0 * f64::EPSILON;

/// Relative rounding of a component in single precision.
const SINGLE_ROUNDING: f64 = 4.0 * f32::EPSILON as f64;

/// Intervals of red, green, blue, `filter` and `transmit`.
pub(super) type Colors = [Interval; 5];

/// The same with slopes along `N` directions.
type Slopes<const N: usize> = [Sloped<N>; 5];

/// A box of points, in the space of a node and in that of the root.
#[derive(Debug, Clone, Copy)]
struct Place<const N: usize> {
    sides: [Sloped<N>; 3],
    root: [Sloped<N>; 3],
}

impl<const N: usize> Place<N> {
    /// Returns the place in the space of a node in this one.
    fn inside(self, space: &Space) -> Self {
        let start = match space.start {
            Start::Outer => self.sides,
            Start::Slot(_) => self.root,
            Start::Uv | Start::UvTurned(_) => {
                let [x, y, _] = self.root;
                [x, y, Sloped::constant(0.0)]
            }
        };
        let sides = space.steps.iter().fold(start, |sides, step| match step {
            Step::Map(map) => {
                let (point, reach) = middle(values(&sides));
                let (moved, reach) = (map.point(point), map.point_error(point, reach));
                // The sum of the error rounds, too.
                let reach = reach * (1.0 + 16.0 * f64::EPSILON);
                let [x, y, z] = [map.matrix.x_axis, map.matrix.y_axis, map.matrix.z_axis];
                [0, 1, 2].map(|axis: usize| {
                    let value = Interval {
                        low: (moved[axis] - reach[axis]).next_down(),
                        high: (moved[axis] + reach[axis]).next_up(),
                    };
                    let row = [x[axis], y[axis], z[axis]].map(Interval::point);
                    Sloped::follow_point(value, row, &sides)
                })
            }
            Step::Warp(warp) => {
                let level = is_level(&sides);
                warp.bounds(values(&sides)).map(|side| Sloped::anyhow(side, level))
            }
        });
        Self { sides, ..self }
    }
}

fn values<const N: usize>(sides: &[Sloped<N>; 3]) -> [Interval; 3] {
    [sides[0].value, sides[1].value, sides[2].value]
}

fn is_level<const N: usize>(sides: &[Sloped<N>; 3]) -> bool {
    sides.iter().all(Sloped::is_level)
}

/// Returns the middle of a box, and its reach from there along each axis.
fn middle(sides: [Interval; 3]) -> (Vector, Vector) {
    let middle = sides.map(|Interval { low, high }| low + 0.5 * (high - low));
    let reach = [0, 1, 2].map(|axis: usize| {
        let Interval { low, high } = sides[axis];
        (high - middle[axis]).max(middle[axis] - low).next_up()
    });
    (Vector::from_array(middle), Vector::from_array(reach))
}

impl Component {
    /// Returns the interval of a number by its rounding: the steps of single precision are no surface of their own.
    fn around(self, number: f64) -> Interval {
        let off = self.share() * number.abs();
        Interval { low: number - off, high: number + off }
    }

    /// Returns the relative rounding of a number.
    fn share(self) -> f64 {
        if self == Self::Value { VALUE_ROUNDING } else { SINGLE_ROUNDING }
    }

    /// Returns the interval of this component, as [`Component::of`] has it.
    fn over<const N: usize>(self, colors: Slopes<N>) -> Sloped<N> {
        let [red, green, blue, filter, transmit] = colors;
        let of = |color: Sloped<N>| {
            let Interval { low, high } = color.value;
            let (low, high) = (single(low), single(high));
            let off = SINGLE_ROUNDING * low.abs().max(high.abs());
            Sloped { value: Interval { low: low - off, high: high + off }, ..color }
        };
        match self {
            Self::Value => red,
            Self::Red => of(red),
            Self::Green => of(green),
            Self::Blue => of(blue),
            Self::Filter => of(filter),
            Self::Transmit => of(transmit),
            Self::Gray => brightness([of(red), of(green), of(blue)]),
        }
    }
}

fn brightness<const N: usize>(rgb: [Sloped<N>; 3]) -> Sloped<N> {
    let [red, green, blue] = values(&rgb);
    let value = Interval {
        low: Rgb::new(red.low, green.low, blue.low).brightness(),
        high: Rgb::new(red.high, green.high, blue.high).brightness(),
    };
    let [red, green, blue] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        .map(|[red, green, blue]| Interval::point(Rgb::new(red, green, blue).brightness()));
    Sloped::follow_point(value, [red, green, blue], &rgb)
}

impl Pigment {
    /// Returns an interval that contains a component of its colour at each point of a box; missing coordinates are 0.
    pub fn bounds(&self, point: &[Interval], component: Component) -> Interval {
        let side = |axis: usize| {
            let value = point.get(axis).copied().unwrap_or(Interval::point(0.0));
            Sloped::<0> { value, slopes: [] }
        };
        self.sloped(&[side(0), side(1), side(2)], component).value
    }

    /// Returns [`Pigment::bounds`], with bounds of its slopes.
    pub fn sloped<const N: usize>(&self, point: &[Sloped<N>], component: Component) -> Sloped<N> {
        let side = |axis: usize| point.get(axis).copied().unwrap_or(Sloped::constant(0.0));
        let sides = [0, 1, 2].map(side);
        let singles = values(&sides).map(Interval::single);
        let exact = match singles {
            [Some(x), Some(y), Some(z)] => {
                Some(component.around(component.of(self.color_at(Vector::new(x, y, z)))))
            }
            _ => None,
        };
        if let (Some(value), true) = (exact, is_level(&sides)) {
            return Sloped::anyhow(value, true);
        }
        let all = component.over(self.colors_in(Place { sides, root: sides }));
        Sloped { value: exact.unwrap_or(all.value), ..all }
    }

    /// Returns [`Pigment::bounds`], with the error of a computed number.
    pub fn rounded(&self, point: &[Rounded], component: Component) -> Rounded {
        let side =
            |axis: usize| point.get(axis).copied().unwrap_or(Rounded::constant(0.0)).sloped();
        let all = self.sloped(&[side(0), side(1), side(2)], component);
        let Rounded { value, error } = Rounded::new(all, 0.0);
        let greatest = value.low.abs().max(value.high.abs());
        Rounded { value, error: error + 0.5 * component.share() * greatest }
    }

    /// Returns whether the slopes of its colours are known.
    pub fn has_slopes(&self) -> bool {
        match self {
            Self::Color(_) | Self::Faces(_) => true,
            Self::Ramp(blend) => blend.has_slopes(|one, other| one == other, |_| true),
            Self::Blend(blend) => blend.has_slopes(|_, _| false, |pigment| pigment.has_slopes()),
            Self::Average { space, entries } => {
                space.is_linear() && entries.iter().all(|(_, pigment)| pigment.has_slopes())
            }
            Self::Image { .. } => false,
        }
    }

    fn colors_in<const N: usize>(&self, outer: Place<N>) -> Slopes<N> {
        match self {
            Self::Color(color) => level(*color),
            Self::Ramp(blend) => blend.colors_in(outer, |color, _| level(*color)),
            Self::Blend(blend) => blend.colors_in(outer, |pigment, place| pigment.colors_in(place)),
            Self::Average { space, entries } => {
                let place = outer.inside(space);
                let none = [Sloped::constant(0.0); 5];
                entries.iter().fold(none, |sum, (weight, pigment)| {
                    let part = pigment.colors_in(place);
                    std::array::from_fn(|at| {
                        let part =
                            Sloped::binary(Binary::Multiply, part[at], Sloped::constant(*weight));
                        Sloped::binary(Binary::Add, sum[at], part)
                    })
                })
            }
            Self::Image { space, image } => {
                let sides = outer.inside(space).sides;
                let (point, reach) = middle(values(&sides));
                image.colors_in(point, reach).map(|color| Sloped::anyhow(color, is_level(&sides)))
            }
            Self::Faces(colors) => level(colors.first().copied().unwrap_or(Color::BLACK)),
        }
    }
}

impl Space {
    /// Returns whether it only maps points linearly.
    fn is_linear(&self) -> bool {
        self.steps.iter().all(|step| matches!(step, Step::Map(_)))
    }
}

/// Returns the intervals of one colour.
pub(super) fn exactly(Color { rgb, filter, transmit }: Color) -> Colors {
    [rgb.red, rgb.green, rgb.blue, filter, transmit].map(Interval::point)
}

fn level<const N: usize>(color: Color) -> Slopes<N> {
    exactly(color).map(|number| Sloped::anyhow(number, true))
}

/// Returns the intervals of either.
pub(super) fn hull<const N: usize>(a: [Interval; N], b: [Interval; N]) -> [Interval; N] {
    std::array::from_fn(|at| a[at].hull(b[at]))
}

fn either<const N: usize>(a: Slopes<N>, b: Slopes<N>) -> Slopes<N> {
    std::array::from_fn(|at| Sloped {
        value: a[at].value.hull(b[at].value),
        slopes: a[at].hull(&b[at]),
    })
}

impl<T> Blend<T> {
    /// Returns the intervals of the colours that `of` returns for its entries.
    fn colors_in<const N: usize>(
        &self,
        outer: Place<N>,
        of: impl Fn(&T, Place<N>) -> Slopes<N>,
    ) -> Slopes<N> {
        let place = outer.inside(&self.space);
        over(&self.entries, self.pattern.sloped(place), |entry| of(entry, place))
    }

    fn has_slopes(&self, is_same: impl Fn(&T, &T) -> bool, of: impl Fn(&T) -> bool) -> bool {
        let jumps = |pair: &[(f64, T)]| match pair {
            [(start, one), (end, other)] => start == end && !is_same(one, other),
            _ => false,
        };
        self.space.is_linear()
            && self.pattern.has_slopes()
            && !self.entries.windows(2).any(jumps)
            && self.entries.iter().all(|(_, entry)| of(entry))
    }
}

/// Returns the intervals over the `values` of a map.
fn over<T, const N: usize>(
    entries: &[(f64, T)],
    values: Sloped<N>,
    of: impl Fn(&T) -> Slopes<N>,
) -> Slopes<N> {
    let unknown = [Sloped::anyhow(Interval::EVERYTHING, false); 5];
    let [first, .., last] = entries else {
        return entries.first().map_or(unknown, |(_, one)| of(one));
    };
    let all = values.value;
    let below = (all.low <= first.0).then(|| of(&first.1));
    let above = (all.high >= last.0).then(|| of(&last.1));
    let between = entries.windows(2).filter_map(|pair| {
        let [(start, one), (end, other)] = pair else { return None };
        let (low, high) = (all.low.max(*start), all.high.min(*end));
        if low > high {
            return None;
        }
        let (one, other) = (of(one), of(other));
        if start == end {
            let stays = values.is_level() || one == other;
            let jump = either(one, other);
            return Some(if stays { jump } else { jump.map(|to| Sloped::anyhow(to.value, false)) });
        }
        let part = Interval { low, high } - Interval::point(*start);
        let part = part / Interval::point(end - start);
        let part = part.max(Interval::point(0.0)).min(Interval::point(1.0));
        let steepness = Interval::point(1.0) / Interval::point(end - start);
        let part = Sloped::follow(part, steepness, &values);
        Some(std::array::from_fn(|i| between(one[i], other[i], part)))
    });
    let all = below.into_iter().chain(above).chain(between);
    all.reduce(either).unwrap_or(unknown)
}

/// Returns a + (b − a)·part; as for numbers, each end of the value depends on the same end of both.
fn between<const N: usize>(a: Sloped<N>, b: Sloped<N>, part: Sloped<N>) -> Sloped<N> {
    let at = |a: f64, b: f64| {
        Interval::point(a) + (Interval::point(b) - Interval::point(a)) * part.value
    };
    let value = Interval {
        low: at(a.value.low, b.value.low).low,
        high: at(a.value.high, b.value.high).high,
    };
    let step = Sloped::binary(Binary::Subtract, b, a);
    let rise = Sloped::binary(Binary::Multiply, step, part);
    Sloped { value, ..Sloped::binary(Binary::Add, a, rise) }
}

impl Pattern {
    /// Returns intervals that contain its value at each point of a box, and the slopes.
    fn sloped<const N: usize>(&self, place: Place<N>) -> Sloped<N> {
        let (point, reach) = middle(values(&place.sides));
        let level = is_level(&place.sides);
        let raw = match &self.source {
            Source::Kind(kind) if point.is_finite() && reach.is_finite() => {
                let sloped = if level { None } else { kind.sloped(point, reach, &self.setting) };
                match sloped {
                    Some((value, slopes)) => Sloped::follow_point(value, slopes, &place.sides),
                    None => Sloped::anyhow(kind.bounds(point, reach, &self.setting), level),
                }
            }
            Source::Kind(kind) => Sloped::anyhow(kind.range(), level),
            Source::Function(function) => of_function(function, &place.sides),
            Source::Pigment(pigment) => {
                let [red, green, blue, ..] = pigment.colors_in(place);
                brightness([red, green, blue])
            }
            Source::Image(image) => Sloped::anyhow(image.values_in(point, reach), level),
            Source::Material { count, .. } => {
                Sloped::anyhow(Interval { low: 0.0, high: *count as f64 }, level)
            }
            Source::Object(_) => Sloped::anyhow(Interval::UNDECIDED, level),
            Source::Density(_) | Source::Slope(_) | Source::Aoi => {
                Sloped::anyhow(Interval::EVERYTHING, level)
            }
        };
        Sloped::follow(self.wave.bounds(raw.value), self.wave.steepness(raw.value), &raw)
    }

    fn has_slopes(&self) -> bool {
        match &self.source {
            Source::Kind(kind) => kind.sloped(Vector::ZERO, Vector::ZERO, &self.setting).is_some(),
            Source::Function(function) => function.has_slopes(),
            Source::Pigment(pigment) => pigment.has_slopes(),
            _ => false,
        }
    }
}

/// Returns the values of a function as [`Pattern::measured`] has them.
fn of_function<const N: usize>(function: &Closed, sides: &[Sloped<N>; 3]) -> Sloped<N> {
    let all = function.function().run::<Sloped<N>>().at(sides, function);
    let (raw, level) = (all.value, is_level(sides));
    if !raw.is_finite() {
        return Sloped::anyhow(Interval { low: f64::MIN, high: 1.0 }, level);
    }
    match raw.high > 1.0 {
        false => all,
        true if raw.low > 1.0 => Sloped::anyhow(raw.fmod(Interval::point(1.0)), level),
        true => Sloped::anyhow(Interval { low: raw.low.min(0.0), high: 1.0 }, level),
    }
}

#[cfg(test)]
mod tests;
