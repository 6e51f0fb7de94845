//! FLIP: a measure of the difference that a viewer sees when two pictures alternate.
//!
//! **Source:** P. Andersson et al., "FLIP: a difference evaluator for alternating images", Proceedings of the
//! ACM on Computer Graphics and Interactive Techniques 3 (2020): sections 4.1 (color), 4.2 (features) and 4.3
//! (both together), with the constants of the paper.

use std::f32::consts::PI;

use image::RgbImage;

/// Pixels that fill one degree of who sits 0.7 m before a screen 0.7 m and 3840 pixels wide.
const PIXELS_PER_DEGREE: f32 = 3840.0 * PI / 180.0;

/// Contrast sensitivity to light, red against green, and blue against yellow: each a sum of Gaussians `a`, `b`.
const SENSITIVITY: [&[(f32, f32)]; 3] =
    [&[(1.0, 0.0047)], &[(1.0, 0.0053)], &[(34.1, 0.04), (13.5, 0.025)]];

/// The exponent, and the part of the color differences that gets a larger part of the errors.
const COLOR_EXPONENT: f32 = 0.7;
const COLOR_PART: f32 = 0.4;
const ERROR_PART: f32 = 0.95;

/// How wide a feature is in degrees, and the exponent of feature differences.
const FEATURE_WIDTH: f32 = 0.082;
const FEATURE_EXPONENT: f32 = 0.5;

/// White of the standard illuminant D65, in XYZ.
const WHITE: [f32; 3] = [0.950_428_6, 1.0, 1.088_900_4];

/// From linear sRGB to XYZ, rows first.
const TO_XYZ: [[f32; 3]; 3] = [
    [0.412_387_5, 0.357_591_6, 0.180_449_5],
    [0.212_637, 0.715_183, 0.072_18],
    [0.019_330_6, 0.119_197_2, 0.950_372_6],
];

/// A value for each pixel.
struct Plane {
    width: usize,
    values: Vec<f32>,
}

impl Plane {
    /// Correlates with `across` along rows and with `down` along columns; what is outside is as the nearest inside.
    fn filtered(&self, across: &[f32], down: &[f32]) -> Self {
        let (width, height) = (self.width, self.values.len() / self.width);
        let reach = |at: usize, tap: usize, taps: usize, end: usize| {
            (at + tap).saturating_sub(taps / 2).min(end - 1)
        };
        let mut rows = Vec::with_capacity(self.values.len());
        for y in 0..height {
            for x in 0..width {
                let taps = across.iter().enumerate();
                rows.push(
                    taps.map(|(i, weight)| {
                        weight * self.values[y * width + reach(x, i, across.len(), width)]
                    })
                    .sum::<f32>(),
                );
            }
        }
        let mut values = Vec::with_capacity(rows.len());
        for y in 0..height {
            for x in 0..width {
                let taps = down.iter().enumerate();
                values.push(
                    taps.map(|(i, weight)| {
                        weight * rows[reach(y, i, down.len(), height) * width + x]
                    })
                    .sum(),
                );
            }
        }
        Self { width, values }
    }
}

/// The error of each pixel from 0 to 1, row by row.
pub fn errors(pictures: &[RgbImage; 2]) -> Vec<f32> {
    let opponents = pictures.each_ref().map(opponents);
    let seen = opponents.each_ref().map(seen);
    let most = distance(hunt_lab([0.0, 1.0, 0.0]), hunt_lab([0.0, 0.0, 1.0])).powf(COLOR_EXPONENT);
    let color = seen[0].iter().zip(&seen[1]).map(|(&a, &b)| {
        let error = distance(a, b).powf(COLOR_EXPONENT);
        let knee = COLOR_PART * most;
        match error < knee {
            true => error * ERROR_PART / knee,
            false => ERROR_PART + (error - knee) / (most - knee) * (1.0 - ERROR_PART),
        }
    });
    let [edges, points] = [Feature::Edge, Feature::Point].map(|feature| {
        let [a, b] = opponents.each_ref().map(|planes| feature.strength(&planes[0]));
        a.into_iter().zip(b).map(|(a, b)| (a - b).abs()).collect::<Vec<f32>>()
    });
    color
        .zip(edges.into_iter().zip(points))
        .map(|(color, (edge, point))| {
            let feature = (edge.max(point) / 2.0_f32.sqrt()).powf(FEATURE_EXPONENT);
            color.powf(1.0 - feature)
        })
        .collect()
}

/// The mean of the [`errors`].
pub fn mean(errors: &[f32]) -> f32 {
    errors.iter().sum::<f32>() / errors.len() as f32
}

/// Light, red against green and blue against yellow: the space YCxCz.
fn opponents(picture: &RgbImage) -> [Plane; 3] {
    let pixels: Vec<[f32; 3]> = picture
        .pixels()
        .map(|pixel| {
            let [x, y, z] = relative_xyz(pixel.0.map(linear));
            [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
        })
        .collect();
    let width = picture.width() as usize;
    [0, 1, 2].map(|i| Plane { width, values: pixels.iter().map(|pixel| pixel[i]).collect() })
}

/// What is seen of the colors at a distance, in a space where distances are differences.
fn seen(opponents: &[Plane; 3]) -> Vec<[f32; 3]> {
    let widest = SENSITIVITY.iter().flat_map(|sum| sum.iter()).map(|(_, b)| *b);
    let widest = widest.fold(0.0, f32::max);
    let reach = (3.0 * (widest / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as i32;
    let filtered: Vec<Plane> = opponents
        .iter()
        .zip(SENSITIVITY)
        .map(|(plane, gaussians)| {
            // The weight of each Gaussian is that of its sum over the square.
            let parts: Vec<(Plane, f32)> = gaussians
                .iter()
                .map(|&(a, b)| {
                    let taps: Vec<f32> = (-reach..=reach)
                        .map(|i| i as f32 / PIXELS_PER_DEGREE)
                        .map(|x| (-PI * PI * x * x / b).exp())
                        .collect();
                    let weight = a * (PI / b).sqrt() * taps.iter().sum::<f32>().powi(2);
                    let sum: f32 = taps.iter().sum();
                    let taps: Vec<f32> = taps.iter().map(|tap| tap / sum).collect();
                    (plane.filtered(&taps, &taps), weight)
                })
                .collect();
            let all: f32 = parts.iter().map(|(_, weight)| weight).sum();
            let value = |i: usize| -> f32 {
                parts.iter().map(|(part, weight)| part.values[i] * weight / all).sum()
            };
            Plane { width: plane.width, values: (0..plane.values.len()).map(value).collect() }
        })
        .collect();
    (0..filtered[0].values.len())
        .map(|i| {
            let y = (filtered[0].values[i] + 16.0) / 116.0;
            let x = y + filtered[1].values[i] / 500.0;
            let z = y - filtered[2].values[i] / 200.0;
            let xyz = [x * WHITE[0], y * WHITE[1], z * WHITE[2]];
            hunt_lab(linear_rgb(xyz).map(|part| part.clamp(0.0, 1.0)))
        })
        .collect()
}

/// What the eye finds in the light of a picture.
#[derive(Clone, Copy)]
enum Feature {
    Edge,
    Point,
}

impl Feature {
    fn strength(self, light: &Plane) -> Vec<f32> {
        let deviation = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
        let reach = (3.0 * deviation).ceil() as i32;
        let bell = |x: f32| (-x * x / (2.0 * deviation * deviation)).exp();
        let offsets = || (-reach..=reach).map(|i| i as f32);
        let sum: f32 = offsets().map(bell).sum();
        let smooth: Vec<f32> = offsets().map(|x| bell(x) / sum).collect();
        let slope: Vec<f32> = match self {
            Self::Edge => offsets().map(|x| -x * bell(x)).collect(),
            Self::Point => {
                offsets().map(|x| (x * x / (deviation * deviation) - 1.0) * bell(x)).collect()
            }
        };
        // What is positive comes to 1, and what is negative to -1.
        let [above, below] =
            [1.0, -1.0].map(|sign| -> f32 { slope.iter().map(|tap| (tap * sign).max(0.0)).sum() });
        let slope: Vec<f32> =
            slope.iter().map(|&tap| if tap > 0.0 { tap / above } else { tap / below }).collect();
        let values = light.values.iter().map(|value| (value + 16.0) / 116.0).collect();
        let light = Plane { width: light.width, values };
        let (across, down) = (light.filtered(&slope, &smooth), light.filtered(&smooth, &slope));
        across.values.iter().zip(&down.values).map(|(x, y)| x.hypot(*y)).collect()
    }
}

fn linear(byte: u8) -> f32 {
    let part = f32::from(byte) / 255.0;
    if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
}

fn relative_xyz(rgb: [f32; 3]) -> [f32; 3] {
    let dot = |row: [f32; 3]| row.iter().zip(rgb).map(|(a, b)| a * b).sum::<f32>();
    let [x, y, z] = TO_XYZ.map(dot);
    [x / WHITE[0], y / WHITE[1], z / WHITE[2]]
}

/// The inverse of [`TO_XYZ`].
fn linear_rgb([x, y, z]: [f32; 3]) -> [f32; 3] {
    [
        3.241_003_3 * x - 1.537_398_9 * y - 0.498_615_9 * z,
        -0.969_224_2 * x + 1.875_93 * y + 0.041_554_2 * z,
        0.055_639_3 * x - 0.204_011_2 * y + 1.057_149_7 * z,
    ]
}

/// CIE L*a*b*, with colors that are the paler the darker they are (the Hunt effect).
fn hunt_lab(rgb: [f32; 3]) -> [f32; 3] {
    const EDGE: f32 = 6.0 / 29.0;
    let root = |t: f32| match t > EDGE * EDGE * EDGE {
        true => t.cbrt(),
        false => t / (3.0 * EDGE * EDGE) + 4.0 / 29.0,
    };
    let [x, y, z] = relative_xyz(rgb).map(root);
    let light = 116.0 * y - 16.0;
    [light, 0.01 * light * 500.0 * (x - y), 0.01 * light * 200.0 * (y - z)]
}

/// HyAB: city blocks in light, as the crow flies in color.
fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    (a[0] - b[0]).abs() + (a[1] - b[1]).hypot(a[2] - b[2])
}

/// **Source of the numbers:** the authors' own program for FLIP, version 1.2.
#[test]
fn errors_are_those_of_the_authors_of_flip() {
    let plain = RgbImage::from_fn(64, 48, |x, y| image::Rgb([x as u8 * 3, y as u8 * 4, 90]));
    let bluer = RgbImage::from_fn(64, 48, |x, y| image::Rgb([x as u8 * 3, y as u8 * 4, 140]));
    let mut spotted = plain.clone();
    (0..12 * 12).for_each(|i| spotted.put_pixel(20 + i % 12, 20 + i / 12, image::Rgb([255; 3])));
    for (other, expected) in [(plain.clone(), 0.0), (spotted, 0.082_101), (bluer, 0.387_815)] {
        let found = mean(&errors(&[plain.clone(), other]));
        assert!((found - expected).abs() < 2e-5, "{found} and not {expected}");
    }
}
