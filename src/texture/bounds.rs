//! Bounds of pigments and patterns: intervals that contain their colours and values over a box of points.
//!
//! **Invariant:** an interval contains what is computed for each point of the box. It shrinks with the box, but
//! for jumps, and for patterns without bounds of their own, which have their range.

use super::blend::{Blend, Pattern, Source};
use super::function::{Closed, Component};
use super::pigment::Pigment;
use super::space::{Space, Start, Step};
use crate::color::{Color, Rgb};
use crate::math::Vector;
use crate::math::finite::single;
use crate::math::interval::Interval;

/// Relative rounding of the value of a pattern, which sums noise of many octaves.
const VALUE_ROUNDING: f64 = 4096.0 * f64::EPSILON;

/// Intervals of red, green, blue, `filter` and `transmit`.
pub(super) type Colors = [Interval; 5];

/// A box of points, in the space of a node and in that of the root.
#[derive(Debug, Clone, Copy)]
struct Place {
    sides: [Interval; 3],
    root: [Interval; 3],
}

impl Place {
    /// Returns the place in the space of a node in this one.
    fn inside(self, space: &Space) -> Self {
        let start = match space.start {
            Start::Outer => self.sides,
            Start::Slot(_) => self.root,
            Start::Uv | Start::UvTurned(_) => {
                let [x, y, _] = self.root;
                [x, y, Interval::point(0.0)]
            }
        };
        let sides = space.steps.iter().fold(start, |sides, step| match step {
            Step::Map(map) => {
                let (point, reach) = middle(sides);
                let (moved, reach) = (map.point(point), map.point_error(point, reach));
                // The sum of the error rounds, too.
                let reach = reach * (1.0 + 16.0 * f64::EPSILON);
                [0, 1, 2].map(|axis| Interval {
                    low: (moved[axis] - reach[axis]).next_down(),
                    high: (moved[axis] + reach[axis]).next_up(),
                })
            }
            Step::Warp(warp) => warp.bounds(sides),
        });
        Self { sides, ..self }
    }
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
        let share = match self {
            Self::Value => VALUE_ROUNDING,
            _ => 4.0 * f64::from(f32::EPSILON),
        };
        let off = share * number.abs();
        Interval { low: number - off, high: number + off }
    }

    /// Returns the interval of this component, as [`Component::of`] has it.
    fn over(self, colors: Colors) -> Interval {
        let [red, green, blue, filter, transmit] = colors;
        let of = |color: Interval| Interval { low: single(color.low), high: single(color.high) };
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

fn brightness([red, green, blue]: [Interval; 3]) -> Interval {
    Interval {
        low: Rgb::new(red.low, green.low, blue.low).brightness(),
        high: Rgb::new(red.high, green.high, blue.high).brightness(),
    }
}

impl Pigment {
    /// Returns an interval that contains a component of its colour at each point of a box; missing coordinates are 0.
    pub fn bounds(&self, point: &[Interval], component: Component) -> Interval {
        let side = |axis: usize| point.get(axis).copied().unwrap_or(Interval::point(0.0));
        let sides = [0, 1, 2].map(side);
        if let [Some(x), Some(y), Some(z)] = sides.map(Interval::single) {
            return component.around(component.of(self.color_at(Vector::new(x, y, z))));
        }
        component.over(self.colors_in(Place { sides, root: sides }))
    }

    fn colors_in(&self, outer: Place) -> Colors {
        match self {
            Self::Color(color) => exactly(*color),
            Self::Ramp(blend) => blend.colors_in(outer, |color, _| exactly(*color)),
            Self::Blend(blend) => blend.colors_in(outer, |pigment, place| pigment.colors_in(place)),
            Self::Average { space, entries } => {
                let place = outer.inside(space);
                let none = [Interval::point(0.0); 5];
                entries.iter().fold(none, |sum, (weight, pigment)| {
                    let part = pigment.colors_in(place);
                    std::array::from_fn(|at| sum[at] + part[at] * Interval::point(*weight))
                })
            }
            Self::Image { space, image } => {
                let (point, reach) = middle(outer.inside(space).sides);
                image.colors_in(point, reach)
            }
            Self::Faces(colors) => exactly(colors.first().copied().unwrap_or(Color::BLACK)),
        }
    }
}

/// Returns the intervals of one colour.
pub(super) fn exactly(Color { rgb, filter, transmit }: Color) -> Colors {
    [rgb.red, rgb.green, rgb.blue, filter, transmit].map(Interval::point)
}

/// Returns the intervals of either.
pub(super) fn hull<const N: usize>(a: [Interval; N], b: [Interval; N]) -> [Interval; N] {
    std::array::from_fn(|at| a[at].hull(b[at]))
}

impl<T> Blend<T> {
    /// Returns the intervals of the colours that `of` returns for its entries.
    fn colors_in(&self, outer: Place, of: impl Fn(&T, Place) -> Colors) -> Colors {
        let place = outer.inside(&self.space);
        over(&self.entries, self.pattern.bounds(place), |entry| of(entry, place))
    }
}

/// Returns the intervals over the `values` of a map.
fn over<T>(entries: &[(f64, T)], values: Interval, of: impl Fn(&T) -> Colors) -> Colors {
    let [first, .., last] = entries else {
        return entries.first().map_or([Interval::EVERYTHING; 5], |(_, one)| of(one));
    };
    let below = (values.low <= first.0).then(|| of(&first.1));
    let above = (values.high >= last.0).then(|| of(&last.1));
    let between = entries.windows(2).filter_map(|pair| {
        let [(start, one), (end, other)] = pair else { return None };
        let (low, high) = (values.low.max(*start), values.high.min(*end));
        if low > high {
            return None;
        }
        let (one, other) = (of(one), of(other));
        if start == end {
            return Some(hull(one, other));
        }
        let part = Interval { low, high } - Interval::point(*start);
        let part = part / Interval::point(end - start);
        let part = part.max(Interval::point(0.0)).min(Interval::point(1.0));
        let at =
            |a: f64, b: f64| Interval::point(a) + (Interval::point(b) - Interval::point(a)) * part;
        Some(std::array::from_fn(|i| {
            let (a, b) = (one[i], other[i]);
            Interval { low: at(a.low, b.low).low, high: at(a.high, b.high).high }
        }))
    });
    let all = below.into_iter().chain(above).chain(between);
    all.reduce(hull).unwrap_or([Interval::EVERYTHING; 5])
}

impl Pattern {
    /// Returns an interval that contains its value at each point of a box.
    fn bounds(&self, place: Place) -> Interval {
        let (point, reach) = middle(place.sides);
        let raw = match &self.source {
            Source::Kind(kind) => match point.is_finite() && reach.is_finite() {
                true => kind.bounds(point, reach, &self.setting),
                false => kind.range(),
            },
            Source::Function(function) => of_function(function, &place.sides),
            Source::Pigment(pigment) => {
                let [red, green, blue, ..] = pigment.colors_in(place);
                brightness([red, green, blue])
            }
            Source::Image(image) => image.values_in(point, reach),
            Source::Material { count, .. } => Interval { low: 0.0, high: *count as f64 },
            Source::Object(_) => Interval::UNDECIDED,
            Source::Density(_) | Source::Slope(_) | Source::Aoi => Interval::EVERYTHING,
        };
        self.wave.bounds(raw)
    }
}

/// Returns the values of a function as [`Pattern::measured`] has them.
fn of_function(function: &Closed, sides: &[Interval]) -> Interval {
    let raw = function.function().run::<Interval>().at(sides, function);
    if !raw.is_finite() {
        return Interval { low: f64::MIN, high: 1.0 };
    }
    match raw.high > 1.0 {
        false => raw,
        true if raw.low > 1.0 => raw.fmod(Interval::point(1.0)),
        true => Interval { low: raw.low.min(0.0), high: 1.0 },
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::math::placement::Map;
    use crate::math::random::{Random, tries};
    use crate::pattern::{Kind, Setting, Warp, Wave, WaveKind};
    use crate::texture::ImageMap;
    use crate::texture::image::Interpolation;
    use crate::texture::image::conversion::{Encoding, Purpose};
    use crate::texture::picture::{Picture, Samples};

    fn color(random: &mut Random) -> Color {
        let mut number = || random.number(-0.5, 1.5);
        Color { rgb: Rgb::new(number(), number(), number()), filter: number(), transmit: number() }
    }

    fn image(random: &mut Random) -> Arc<ImageMap> {
        let samples = Samples::Eight((0..4 * 3 * 3).map(|_| random.below(256) as u8).collect());
        let (encoding, is_multiplied) = (Encoding::Plain, false);
        let picture =
            Picture { width: 4, height: 3, channels: 3, samples, encoding, is_multiplied };
        let mut image = ImageMap::new(Arc::new(picture), Purpose::Values, None, None);
        image.interpolation =
            Interpolation::of_number(1 + random.below(4) as u32).unwrap_or_default();
        image.once = random.below(2) == 0;
        Arc::new(image)
    }

    fn pattern(random: &mut Random, source: Source) -> Pattern {
        let wave = Wave::new(WaveKind::Sine, random.number(0.1, 3.0), random.number(-1.0, 1.0));
        let amount = random.point(1.0);
        Pattern { source, setting: Setting { amount, ..Setting::default() }, wave }
    }

    fn space(random: &mut Random) -> Space {
        let map = Map::new(random.point(2.0), random.matrix());
        let mut steps = vec![Step::Map(map)];
        if random.below(2) == 0 {
            let turbulence = Warp::of_word("turbulence").map(|warp| warp.canonical());
            steps.extend(turbulence.map(Step::Warp));
        }
        Space { start: Start::Outer, steps }
    }

    fn pigment(random: &mut Random, depth: u32) -> Arc<Pigment> {
        let entries = |random: &mut Random| {
            let entry = |random: &mut Random, position| (position, pigment(random, depth - 1));
            [0.2, 0.5, 0.5, 0.9].map(|position| entry(random, position)).to_vec()
        };
        let space = space(random);
        let kinds = Kind::all();
        let source = Source::Kind(kinds[random.below(kinds.len())].canonical());
        Arc::new(match random.below(if depth == 0 { 3 } else { 7 }) {
            0 => Pigment::Color(color(random)),
            1 => Pigment::Image { space, image: image(random) },
            2 => {
                let entries = [0.0, 0.5, 1.0].map(|position| (position, color(random))).to_vec();
                let pattern = pattern(random, source);
                Pigment::Ramp(Box::new(Blend { space, pattern, entries }))
            }
            3 => {
                let mut entries = entries(random);
                entries.iter_mut().for_each(|entry| entry.0 = 0.25);
                Pigment::Average { space, entries }
            }
            4 => {
                let source = Source::Pigment(pigment(random, depth - 1));
                let pattern = pattern(random, source);
                Pigment::Blend(Box::new(Blend { space, pattern, entries: entries(random) }))
            }
            5 => {
                let source = Source::Image(image(random));
                let pattern = pattern(random, source);
                Pigment::Blend(Box::new(Blend { space, pattern, entries: entries(random) }))
            }
            _ => {
                let pattern = pattern(random, source);
                Pigment::Blend(Box::new(Blend { space, pattern, entries: entries(random) }))
            }
        })
    }

    #[test]
    fn bounds_contain_the_colours_of_a_box() {
        let mut random = Random(31);
        for _ in 0..tries() {
            let pigment = pigment(&mut random, 2);
            let (point, reach) = (random.point(3.0), random.size(-9.0, 0.0));
            let sides = point.to_array().map(|at| Interval { low: at - reach, high: at + reach });
            for component in
                [Component::Value, Component::Green, Component::Gray, Component::Transmit]
            {
                let bounds = pigment.bounds(&sides, component);
                let inside = sides.map(|Interval { low, high }| random.number(low, high));
                let value = component.of(pigment.color_at(Vector::from_array(inside)));
                assert!(bounds.contains(value), "{pigment:?} {inside:?}: {value} {bounds:?}");
                let Interval { low, high } =
                    pigment.bounds(&inside.map(Interval::point), component);
                assert!(low <= value && value <= high && high - low <= 1e-6 * value.abs());
            }
        }
    }

    #[test]
    fn bounds_shrink_with_the_box() {
        let mut random = Random(32);
        // Those whose values jump everywhere, or whose bounds are not known.
        let vague = ["brick", "julia", "mandel", "magnet_julia", "magnet_mandel", "pavement"];
        for kind in Kind::all().into_iter().filter(|kind| !vague.contains(&kind.word())) {
            let mut narrow = 0;
            for _ in 0..100 {
                let wave = Wave::new(kind.wave(), 1.0, 0.0);
                let setting = Setting { amount: Vector::ONE, ..Setting::default() };
                let pattern = Pattern { source: Source::Kind(kind.canonical()), setting, wave };
                let entries = vec![(0.0, Color::BLACK), (6.0, Color::WHITE)];
                let blend = Blend { space: space(&mut random), pattern, entries };
                let pigment = Pigment::Ramp(Box::new(blend));
                let point = random.point(3.0).to_array();
                let sides = point.map(|at| Interval { low: at - 1e-8, high: at + 1e-8 });
                let Interval { low, high } = pigment.bounds(&sides, Component::Value);
                narrow += usize::from(high - low < 1e-3);
            }
            assert!(narrow > 90, "{kind:?}: {narrow}");
        }
    }
}
