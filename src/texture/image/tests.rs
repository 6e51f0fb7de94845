use super::conversion::{Encoding, SceneGamma};
use super::*;
use crate::math::random::{Random, tries};

const COLORS: Purpose =
    Purpose::Colors(SceneGamma { assumed: Gamma::LINEAR, is_stated: true, is_old: false });

fn picture(width: usize, height: usize, channels: usize, samples: Samples) -> Arc<Picture> {
    let (encoding, is_multiplied) = (Encoding::Plain, false);
    Arc::new(Picture { width, height, channels, samples, encoding, is_multiplied })
}

/// The picture of the measured table.
fn measured_picture() -> Arc<Picture> {
    let samples = (0..5 * 4 * 4u32).map(|k| ((k * k * 37 + 11 * k) % 256) as u8);
    picture(5, 4, 4, Samples::Eight(samples.collect()))
}

/// Indices 0 to 3 from left to right: red, half-clear green, clear blue and a grey.
fn palette() -> Arc<Picture> {
    let palette = vec![[255, 0, 0, 255], [0, 255, 0, 128], [0, 0, 255, 0], [9, 9, 9, 255]];
    picture(4, 1, 1, Samples::Indexed { palette, indices: vec![0, 1, 2, 3] })
}

fn numbers(color: Option<Color>) -> Pixel {
    // What POV-Ray has where a map shows nothing.
    let color = color.unwrap_or(Color { transmit: 1.0, ..Color::WHITE });
    let Rgb { red, green, blue } = color.rgb;
    [red, green, blue, color.filter, color.transmit]
}

#[track_caller]
fn close<const N: usize>(found: [f64; N], wanted: [f64; N]) {
    assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 3e-6), "{found:?} {wanted:?}");
}

#[test]
fn colors_and_values_are_those_of_povray() {
    let mut count = 0;
    for line in include_str!("../measured/image.txt").lines().skip(1) {
        let row: Vec<f64> = line.split(' ').map(|word| word.parse().expect("a number")).collect();
        let [map_type, once, interpolate, x, y, z, r, g, b, filter, transmit, value, clear] =
            row[..]
        else {
            panic!("{line}");
        };
        let point = Vector::new(x, y, z);
        let mut map = ImageMap::new(measured_picture(), COLORS, None, None);
        map.map_type = MapType::of_number(map_type as u32).expect("a map type");
        map.once = once == 1.0;
        map.interpolation = Interpolation::of_number(interpolate as u32).unwrap_or_default();
        close(numbers(map.color(point)), [r, g, b, filter, transmit]);
        close([map.value(point)], [value]);
        map.source = Source::Alpha;
        close([map.value(point)], [clear]);
        count += 1;
    }
    assert!(count >= 96);
}

/// Columns and rows, from above, that POV-Ray shows at places of a picture of 4×8 pixels.
#[test]
fn a_place_between_pixels_belongs_to_the_right_and_to_the_upper_one() {
    let samples = (0..8).flat_map(|y| (0..4).map(move |x| 10 * y + x)).collect();
    let mut map = ImageMap::new(picture(4, 8, 1, Samples::Eight(samples)), COLORS, None, None);
    let pixel = |map: &ImageMap, u, v| {
        let color = map.at_uv(u, v)?;
        let number = (color.rgb.red * 255.0).round() as u32;
        Some((number % 10, number / 10))
    };
    for (u, column) in
        [(-1.0, 0), (-0.25, 3), (-1e-9, 3), (0.0, 0), (0.25 - 1e-9, 0), (0.25, 1), (1.0, 0)]
    {
        assert_eq!(pixel(&map, u, 0.51), Some((column, 3)), "{u}");
    }
    for (v, row) in
        [(-1.0, 7), (-0.25, 1), (-1e-9, 0), (0.0, 7), (0.125 - 1e-9, 7), (0.125, 6), (1.0, 7)]
    {
        assert_eq!(pixel(&map, 0.6, v), Some((2, row)), "{v}");
    }
    map.once = true;
    assert_eq!(pixel(&map, 1.0, 0.51), Some((0, 3)));
    assert_eq!(pixel(&map, 1.0 + 1e-9, 0.51), None);
    assert_eq!(pixel(&map, -1e-9, 0.51), None);
    assert_eq!(map.value(Vector::new(-0.1, 0.5, 0.0)), 0.0);
    // The error of a point cannot separate it from a seam.
    let near = |x| map.color_within(Vector::new(x, 0.51, 0.0), Vector::splat(1e-12));
    assert_eq!(near(0.25 - 1e-13), near(0.25));
    assert_eq!(near(-1e-13), near(0.0));
}

/// Results of POV-Ray 3.7.
#[test]
fn filter_and_transmit_replace_those_of_a_palette() {
    let mut map = ImageMap::new(palette(), COLORS, None, None);
    let at = |map: &ImageMap, i: u8| numbers(map.at_uv((f64::from(i) + 0.4) / 4.0, 0.5));
    close(at(&map, 1), [0.0, 1.0, 0.0, 0.0, 0.498_039_186]);
    assert_eq!(map.set_clear(Clear::Filter, Some(1), 0.5), Ok(()));
    let mut smooth = map.clone();
    smooth.interpolation = Interpolation::Bilinear;
    close(at(&smooth, 1), [0.1, 0.9, 0.0, 0.45, 0.448_235_273]);
    close(at(&smooth, 3), [0.031_764_708, 0.031_764_708, 0.131_764_710, 0.0, 0.1]);
    assert_eq!(map.set_clear(Clear::Transmit, None, 0.3), Ok(()));
    assert_eq!(map.set_clear(Clear::Transmit, Some(1), 0.2), Ok(()));
    close(at(&map, 1), [0.0, 1.0, 0.0, 0.5, 0.2]);
    close(at(&map, 2), [0.0, 0.0, 1.0, 0.0, 0.3]);
    assert_eq!(map.set_clear(Clear::Filter, Some(4), 0.5), Err(NoIndex::Beyond(4)));
}

/// Results of POV-Ray 3.7.
#[test]
fn transmit_all_adds_to_alpha_and_premultiplied_colors_are_divided_by_it() {
    let samples = vec![255, 0, 0, 255, 200, 100, 50, 128, 200, 100, 50, 1, 200, 100, 50, 0];
    let picture = picture(4, 1, 4, Samples::Eight(samples));
    let at =
        |map: &ImageMap| [0, 1, 2, 3].map(|i| numbers(map.at_uv((f64::from(i) + 0.5) / 4.0, 0.5)));
    let mut map = ImageMap::new(picture.clone(), COLORS, None, None);
    assert_eq!(map.set_clear(Clear::Filter, Some(0), 0.5), Err(NoIndex::NoPalette));
    assert_eq!(map.set_clear(Clear::Transmit, None, 0.3), Ok(()));
    assert_eq!(map.set_clear(Clear::Filter, None, 0.25), Ok(()));
    close(at(&map)[1], [0.784_314, 0.392_157, 0.196_078, 0.25, 0.798_039]);
    let gamma = Some(Gamma::Power(2.0));
    let divided = at(&ImageMap::new(picture.clone(), COLORS, gamma, Some(true)));
    let wanted = [[1.0, 0.0, 0.0], [1.225_490, 0.306_373, 0.076_593]];
    close(divided[0], [wanted[0][0], wanted[0][1], wanted[0][2], 0.0, 0.0]);
    close(divided[1], [wanted[1][0], wanted[1][1], wanted[1][2], 0.0, 0.498_039]);
    assert!((divided[2][0] - 156.862_76).abs() < 1e-4);
    close(divided[3], [0.615_148, 0.153_787, 0.038_447, 0.0, 1.0]);
    // Values are those of the file.
    let values = ImageMap::new(picture, Purpose::Values, None, Some(true));
    for (i, wanted) in [0.297, 0.486_275, 0.486_275, 0.486_275].into_iter().enumerate() {
        close([values.value_at_uv((i as f64 + 0.5) / 4.0, 0.5)], [wanted]);
    }
}

/// Results of POV-Ray 3.7; indices are measured as the height of bumps.
#[test]
fn a_value_is_a_brightness_or_an_index_or_how_clear_a_pixel_is() {
    let values = |picture: Arc<Picture>, source| {
        let map = ImageMap { source, ..ImageMap::new(picture, Purpose::Values, None, None) };
        [0, 1, 2, 3].map(|i| map.value_at_uv((f64::from(i) + 0.5) / 4.0, 0.5))
    };
    close(values(palette(), Source::Color), [0.297, 0.589, 0.114, 9.0 / 255.0]);
    close(values(palette(), Source::Index), [0.0, 1.0, 2.0, 3.0]);
    close(values(palette(), Source::Alpha), [0.0, 0.498_039, 1.0, 0.0]);
    let rgb = Samples::Eight(vec![255, 0, 0, 0, 255, 0, 0, 0, 255, 200, 100, 50]);
    let rgb = picture(4, 1, 3, rgb);
    close(values(rgb.clone(), Source::Color), [0.297, 0.589, 0.114, 0.486_275]);
    close(values(rgb.clone(), Source::Alpha), [1.0, 0.0, 0.0, 0.784_314]);
    // Not as in POV-Ray, which rounds the brightness between pixels.
    assert_eq!(values(rgb.clone(), Source::Index), values(rgb, Source::Color));
    let grey = picture(4, 1, 1, Samples::Sixteen(vec![0, 1, 51_405, 65_535]));
    close(values(grey, Source::Alpha), [0.0, 1.0 / 65_535.0, 0.784_390, 1.0]);
    // What is brighter than white or darker than black is cut off.
    let light = vec![3.0, -0.5, 0.25, 0.0, -0.5, 0.0, 0.0, 2.0, 0.0, 1e9, 1e9, 1.0];
    let light = picture(4, 1, 3, Samples::Float(light));
    close(values(light, Source::Color), [0.625, 0.0, 1.0, 1.0]);
}

/// The light that POV-Ray 3.7 shows, of 65,535, on a plane across z that a `bump_map` with `use_index interpolate 3
/// bump_size 0.002` covers, lit along x and z by half of its diffuse light; at 40 places from left to right.
const INDEXED: [f64; 20] = [
    23294., 23837., 24329., 24772., 25126., 25327., 25525., 25680., 25787., 25843., 25843., 25789.,
    25683., 25529., 25332., 25121., 24766., 24324., 23832., 23288.,
];

#[test]
fn an_index_between_pixels_has_no_fraction() {
    let palette = (0..=255).map(|i| [i, i, i, 255]).collect();
    let indices = [0, 100, 100, 0].repeat(4);
    let picture = picture(4, 4, 1, Samples::Indexed { palette, indices });
    let mut map = ImageMap::new(picture, Purpose::Values, None, None);
    (map.source, map.interpolation) = (Source::Index, Interpolation::Bicubic);
    for (place, seen) in INDEXED.into_iter().enumerate() {
        let point = Vector::new((place as f64 + 0.5) / 40.0, 0.125, 0.0);
        let heights = map.heights(point).expect("a place in the picture");
        let moved = super::super::normal::bump_map::displacement(-Vector::Z, heights) * 0.002;
        let normal = (moved - Vector::Z).normalize();
        let light = -normal.dot(Vector::X + Vector::Z) * std::f64::consts::FRAC_1_SQRT_2;
        assert!((light * 32767.5 - seen).abs() < 1.0, "{place}: {light} {seen}");
    }
}

/// As in POV-Ray 3.7 (measured).
#[test]
fn heights_of_a_picture_shown_once_wrap_but_do_not_blend_across_its_edges() {
    let picture = picture(4, 1, 1, Samples::Eight(vec![255, 0, 0, 0]));
    let mut map = ImageMap::new(picture, Purpose::Values, None, None);
    map.interpolation = Interpolation::Bilinear;
    let heights = |map: &ImageMap| {
        let heights = map.heights(Vector::new(0.95, 0.5, 0.0)).expect("a place in the picture");
        [heights(0.0, 0.0), heights(1.0, 0.0)]
    };
    close(heights(&map), [0.3, 0.7]);
    map.once = true;
    close(heights(&map), [0.0, 0.7]);
}

/// As in POV-Ray 3.7 (measured), except where its weights round to less than 1: it has 0 there.
#[test]
fn a_texture_between_pixels_is_that_of_the_number_without_its_fraction() {
    let picture = picture(2, 1, 3, Samples::Eight(vec![10, 200, 0, 20, 0, 200]));
    let mut map = ImageMap::new(picture, Purpose::Values, None, None);
    (map.source, map.interpolation) = (Source::Material, Interpolation::Bilinear);
    let entries = [0.25, 0.29, 0.5, 0.54, 0.56, 0.74, 0.75];
    let entries = entries.map(|u| map.entry(Vector::new(u, 0.5, 0.0), 256));
    assert_eq!(entries, [10.0, 10.0, 15.0, 15.0, 16.0, 19.0, 20.0]);
}

#[test]
fn colors_and_values_are_finite_at_all_points() {
    let mut random = Random(7);
    let float = Samples::Float(vec![f32::NAN, f32::INFINITY, -f32::MAX, 1.0]);
    let pictures = [measured_picture(), palette(), picture(2, 1, 2, float)];
    let wild = [0.0, -0.0, 1.0, 1e-300, -1e300, f64::MAX, f64::MIN_POSITIVE, 0.3];
    for turn in 0..tries() {
        let mut map = ImageMap::new(pictures[turn % 3].clone(), COLORS, None, Some(turn % 2 == 0));
        map.map_type = MapType::ALL[random.below(4)];
        map.once = random.below(2) == 0;
        map.interpolation = Interpolation::of_number(random.below(5) as u32).unwrap_or_default();
        map.source = [Source::Color, Source::Index, Source::Alpha][random.below(3)];
        let point = Vector::from_array([(); 3].map(|()| wild[random.below(wild.len())]));
        assert!(map.value(point).is_finite(), "{map:?} {point}");
        assert!(numbers(map.color(point)).iter().all(|n| n.is_finite()), "{map:?} {point}");
    }
}

/// Measured on POV-Ray 3.7: the textures for the numbers 0 to 5, of 2 to 5 textures.
#[test]
fn numbers_of_textures_start_again_after_the_last_but_for_one() {
    let chosen = |count| [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(|index| entry_of(index, count));
    assert_eq!(chosen(2.0), [0.0, 1.0, 1.0, 1.0, 0.0, 1.0]);
    assert_eq!(chosen(3.0), [0.0, 1.0, 2.0, 2.0, 1.0, 2.0]);
    assert_eq!(chosen(4.0), [0.0, 1.0, 2.0, 3.0, 3.0, 1.0]);
    assert_eq!(chosen(5.0), [0.0, 1.0, 2.0, 3.0, 4.0, 4.0]);
}
