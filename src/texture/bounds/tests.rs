//! Bounds of pigments drawn at random hold their colours, shrink with the box, and hold their slopes.

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
    let picture = Picture { width: 4, height: 3, channels: 3, samples, encoding, is_multiplied };
    let mut image = ImageMap::new(Arc::new(picture), Purpose::Values, None, None);
    image.interpolation = Interpolation::of_number(1 + random.below(4) as u32).unwrap_or_default();
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
            Pigment::Ramp(Blend { space, pattern, entries })
        }
        3 => {
            let mut entries = entries(random);
            entries.iter_mut().for_each(|entry| entry.0 = 0.25);
            Pigment::Average { space, entries }
        }
        4 => {
            let source = Source::Pigment(pigment(random, depth - 1));
            let pattern = pattern(random, source);
            Pigment::Blend(Blend { space, pattern, entries: entries(random) })
        }
        5 => {
            let source = Source::Image(image(random));
            let pattern = pattern(random, source);
            Pigment::Blend(Blend { space, pattern, entries: entries(random) })
        }
        _ => {
            let pattern = pattern(random, source);
            Pigment::Blend(Blend { space, pattern, entries: entries(random) })
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
        for component in [Component::Value, Component::Green, Component::Gray, Component::Transmit]
        {
            let bounds = pigment.bounds(&sides, component);
            let inside = sides.map(|Interval { low, high }| random.number(low, high));
            let value = component.of(pigment.color_at(Vector::from_array(inside)));
            assert!(bounds.contains(value), "{pigment:?} {inside:?}: {value} {bounds:?}");
            let Interval { low, high } = pigment.bounds(&inside.map(Interval::point), component);
            assert!(low <= value && value <= high && high - low <= 1e-6 * value.abs());
        }
    }
}

#[test]
fn colours_change_no_faster_than_their_slopes_say() {
    let mut random = Random(33);
    let mut known = 0;
    for _ in 0..4 * tries() {
        let pigment = pigment(&mut random, 2);
        let (point, reach) = (random.point(3.0), random.size(-4.0, 0.0));
        let sides = point.to_array().map(|at| Interval { low: at - reach, high: at + reach });
        let along = |axis: usize| {
            let mut slopes = [Interval::point(0.0); 3];
            slopes[axis] = Interval::point(1.0);
            Sloped { value: sides[axis], slopes }
        };
        let all = pigment.sloped(&[along(0), along(1), along(2)], Component::Value);
        if !all.slopes.iter().all(|slope| slope.is_finite()) {
            continue;
        }
        known += usize::from(!all.is_level());
        let axis = random.below(3);
        let from = sides.map(|Interval { low, high }| random.number(low, high));
        let mut to = from;
        to[axis] = random.number(sides[axis].low, sides[axis].high);
        let [value, other] = [from, to].map(|at| pigment.color_at(Vector::from_array(at)).rgb.red);
        let (step, Interval { low, high }) = (to[axis] - from[axis], all.slopes[axis]);
        let (slope, off) = ((other - value) / step, 1e-7 / step.abs());
        assert!(low - off <= slope && slope <= high + off, "{slope} {all:?} {pigment:?}");
    }
    assert!(known > tries() / 100, "{known}");
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
            let pigment = Pigment::Ramp(Blend { space: space(&mut random), pattern, entries });
            let point = random.point(3.0).to_array();
            let sides = point.map(|at| Interval { low: at - 1e-8, high: at + 1e-8 });
            let Interval { low, high } = pigment.bounds(&sides, Component::Value);
            narrow += usize::from(high - low < 1e-3);
        }
        assert!(narrow > 90, "{kind:?}: {narrow}");
    }
}
