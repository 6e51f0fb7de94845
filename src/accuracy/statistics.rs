//! Measures the error of a picture as one number, with its uncertainty.
//!
//! **In:** deviations of single pixels from a reference. **Out:** [`Estimate`]s. **Invariant:** results are
//! reproducible, as random draws use a fixed seed.

use std::iter;

use crate::math::elementary::{erf, pow};
use crate::math::random::Random;

/// Deviation of a component above which a pixel is bad: two steps of 255.
pub const BAD: f64 = 2.0 / 255.0;
/// Half width of the central 95 % of the standard normal distribution.
const Z: f64 = 1.959_963_984_540_054;
/// Number of resamples for an interval.
const RESAMPLES: usize = 1000;
/// Number of pixels below which three more as bad as the worst may be unseen (the rule of three);
/// otherwise, one may.
///
/// **Source:** J. Hanley, A. Lippman-Hand, "If nothing goes wrong, is everything all right?", JAMA 249,
/// 1983.
const FEW: usize = 100;
/// Maximum number of draws for the ranks of a percentile: more do not narrow them, and powers of 0.99 do
/// not yet underflow.
const MOST_DRAWS: f64 = 50_000.0;
/// Seed of the resamples. All rows share them, so that differences are paired.
const SEED: u64 = 0x6c75_6361_726e_6521;

/// Error metric.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Metric {
    /// Root mean square over pixels and components.
    #[default]
    Rmse,
    /// 99th percentile: one pixel in a hundred has a component with a larger deviation.
    P99,
    /// Fraction of pixels with a deviation of more than 2/255.
    Bad,
}

/// Deviation of one pixel from the reference, in linear components clamped to 0 … 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Deviation {
    /// Deviation from the mean of the reference's two halves.
    pub off: [f64; 3],
    /// Half the difference of the halves, whose magnitude is that of the reference's standard error.
    pub noise: [f64; 3],
}

/// A value and its 95 % confidence interval.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Where the interval begins.
    pub low: f64,
    /// Where it ends.
    pub high: f64,
}

impl Metric {
    /// All metrics.
    pub const ALL: [Self; 3] = [Self::Rmse, Self::P99, Self::Bad];

    /// Returns its name: `rmse`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rmse => "rmse",
            Self::P99 => "p99",
            Self::Bad => "bad",
        }
    }

    /// Returns the contribution of one pixel: its square error without the contribution of the reference's
    /// noise, its largest component, or about 1 if it is bad.
    ///
    /// The first is (x − A)(x − B) for a reference of independent halves A and B; its mean is the true
    /// square error whatever their noise. The last is twice the result for both halves together minus the
    /// mean of the results for each half: noise pushes more pixels over the limit than back, twice as many
    /// with half the samples.
    ///
    /// **Source:** M. Quenouille, "Notes on bias in estimation", Biometrika 43, 1956.
    fn part(self, pixel: &Deviation) -> f64 {
        let largest = pixel.off.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
        match self {
            Self::Rmse => {
                let parts = pixel.off.iter().zip(pixel.noise);
                parts.map(|(off, noise)| off * off - noise * noise).sum::<f64>() / 3.0
            }
            Self::P99 => largest,
            Self::Bad => {
                let half =
                    |sign: f64| bad(std::array::from_fn(|i| pixel.off[i] + sign * pixel.noise[i]));
                2.0 * bad(pixel.off) - (half(1.0) + half(-1.0)) / 2.0
            }
        }
    }

    /// Computes the metric from the contributions of all pixels, which it may reorder.
    fn whole(self, parts: &mut [f64]) -> f64 {
        let mean = |parts: &[f64]| parts.iter().sum::<f64>() / parts.len().max(1) as f64;
        match self {
            Self::Rmse => mean(parts).max(0.0).sqrt(),
            Self::P99 => quantile(parts, 0.99),
            Self::Bad => mean(parts).max(0.0),
        }
    }

    pub(crate) fn of(self, pixels: &[Deviation]) -> f64 {
        let mut parts: Vec<f64> = pixels.iter().map(|pixel| self.part(pixel)).collect();
        self.whole(&mut parts)
    }

    /// Returns the same metric for the reference's own error.
    pub fn floor(self, pixels: &[Deviation]) -> f64 {
        let own: Vec<Deviation> =
            pixels.iter().map(|p| Deviation { off: p.noise, noise: [0.0; 3] }).collect();
        self.of(&own)
    }

    /// Returns the value of `Metric::of` for resamples of the pixels (with replacement), one number per
    /// resample. The k-th resample takes the same pixels whatever their values.
    ///
    /// **Source:** B. Efron, R. Tibshirani, An Introduction to the Bootstrap (1993), ch. 13.
    pub(crate) fn resampled(self, pixels: &[Deviation]) -> Vec<f64> {
        self.redrawn(&pixels.iter().map(|pixel| self.part(pixel)).collect::<Vec<_>>())
    }

    fn redrawn(self, parts: &[f64]) -> Vec<f64> {
        if parts.is_empty() {
            return Vec::new();
        }
        let mut drawn = vec![0.0; parts.len()];
        let draw = |resample| {
            let mut random = Random::of(SEED, resample as u64);
            // The upper half of a product is as uniform as a remainder, and much faster to compute.
            let mut place = || (((random.bits() >> 32) * parts.len() as u64) >> 32) as usize;
            drawn.iter_mut().for_each(|part| *part = parts[place()]);
            self.whole(&mut drawn)
        };
        (0..RESAMPLES).map(draw).collect()
    }

    /// Returns the metric with its interval: by bootstrap for RMSE, by Wilson's method for fractions, and
    /// for the 99th percentile by the ranks it has with 95 % probability. The pixels must be in the order
    /// of `audit::by_place`, with neighbours close together. They are a sample of `all` pixels; pixels in
    /// the sample add nothing to the error of a fraction.
    ///
    /// **Source:** R. Woodruff, "Confidence intervals for medians and other position measures", JASA 47,
    /// 1952, for the percentile; its ranks are those of the binomial distribution (H. David, H. Nagaraja,
    /// Order Statistics, 3rd ed. 2003, 7.1); for the fraction, W. Cochran, Sampling Techniques, 3rd ed.
    /// 1977, 2.6 (the finite population correction).
    pub fn estimate(self, pixels: &[Deviation], all: f64) -> Estimate {
        let mut parts: Vec<f64> = pixels.iter().map(|pixel| self.part(pixel)).collect();
        let value = self.whole(&mut parts);
        let (low, high) = match self {
            Self::Rmse => {
                let (low, _) = self.corrected(&parts);
                // The next pixel may be as bad as the worst so far; with few pixels, so may the next three:
                // a fraction of up to 3/n may be unseen in n draws.
                let worst = parts.iter().copied().max_by(f64::total_cmp);
                let unseen = if parts.len() < FEW { 3 } else { 1 };
                parts.extend(worst.into_iter().flat_map(|worst| iter::repeat_n(worst, unseen)));
                (low, self.corrected(&parts).1)
            }
            Self::Bad => {
                let hits: Vec<f64> = pixels.iter().map(|pixel| bad(pixel.off)).collect();
                let noise: Vec<f64> = parts.iter().zip(&hits).map(|(all, hit)| all - hit).collect();
                let count = hits.len().max(1) as f64;
                let share = hits.iter().sum::<f64>() / count;
                let unseen = (1.0 - count / all).max(1.0 / count);
                let draws = worth(&hits) / unseen;
                let off = wilson(share * draws, draws);
                // Noise matters for nearly bad pixels: it adds more to the spread than the noise's own.
                let added = (successive(&parts) - successive(&hits)).max(successive(&noise));
                with_noise(value, share, off, added.sqrt() / count)
            }
            Self::P99 => {
                let beyond: Vec<f64> =
                    pixels.iter().map(|p| f64::from(u8::from(self.part(p) > value))).collect();
                let least: Vec<f64> = pixels.iter().map(certain).collect();
                let weights = vec![1.0; parts.len()];
                spanned((&least, &parts), &weights, worth(&beyond))
            }
        };
        Estimate { value, low: low.min(value), high: high.max(value) }
    }

    /// Like [`interval`] of the resamples, corrected for bias and for the skewness of the contributions:
    /// the metric is an increasing function of their mean, and errors are skewed, as a few pixels have most
    /// of them.
    ///
    /// **Source:** B. Efron, "Better bootstrap confidence intervals", JASA 82, 1987 (BCa); the acceleration
    /// of a mean is a sixth of its standardised third moment.
    fn corrected(self, parts: &[f64]) -> (f64, f64) {
        let resamples = self.redrawn(parts);
        let value = self.whole(&mut parts.to_vec());
        let count = resamples.len().max(1) as f64;
        let below = resamples.iter().filter(|&&resample| resample < value).count() as f64;
        let bias = normal_quantile(((below + 0.5) / (count + 1.0)).clamp(0.01, 0.99));
        let mean = parts.iter().sum::<f64>() / parts.len().max(1) as f64;
        let (squares, cubes) = parts.iter().fold((0.0, 0.0), |(squares, cubes), part| {
            let off = part - mean;
            (squares + off * off, cubes + off * off * off)
        });
        let acceleration =
            if squares > 0.0 { cubes / (6.0 * squares * squares.sqrt()) } else { 0.0 };
        let mut sorted = resamples;
        let mut bound = |z: f64| {
            let shifted = bias + z;
            // Beyond its pole the correction has no meaning; the outermost resample is what there is.
            let stretched = shifted / (1.0 - acceleration * shifted).max(0.1);
            quantile(&mut sorted, normal_share(bias + stretched))
        };
        (bound(-Z), bound(Z))
    }
}

/// Returns the metric with its interval, and that of the reference's own error, for randomly drawn pixels
/// with weights that are inverse to their probabilities.
///
/// **Source:** as [`Metric::estimate`]; fractions and ranks as for the number of equal draws with the same
/// variance (E. Korn, B. Graubard, 1998).
pub fn weighted(metric: Metric, pixels: &[Deviation], weights: &[f64]) -> (Estimate, f64) {
    let count = pixels.len().max(1) as f64;
    let scaled: Vec<Deviation> = pixels
        .iter()
        .zip(weights)
        .map(|(pixel, weight)| {
            let root = weight.sqrt();
            Deviation { off: pixel.off.map(|c| c * root), noise: pixel.noise.map(|c| c * root) }
        })
        .collect();
    let parts = |of: &dyn Fn(&Deviation) -> f64| -> Vec<f64> {
        pixels.iter().zip(weights).map(|(pixel, weight)| weight * of(pixel)).collect()
    };
    let noise = |pixel: &Deviation| Deviation { off: pixel.noise, noise: [0.0; 3] };
    match metric {
        Metric::Rmse => (metric.estimate(&scaled, f64::INFINITY), metric.floor(&scaled)),
        Metric::Bad => {
            let hits = parts(&|pixel| bad(pixel.off));
            let of_noise = parts(&|pixel| metric.part(pixel) - bad(pixel.off));
            let [share, added] = [&hits, &of_noise].map(|parts| parts.iter().sum::<f64>() / count);
            let value = (share + added).clamp(0.0, 1.0);
            let draws = equal_draws(&hits, weights);
            let off = wilson(share.min(1.0) * draws, draws);
            let spread = |parts: &[f64], mean: f64| -> f64 {
                parts.iter().map(|part| (part - mean) * (part - mean)).sum()
            };
            let both = spread(&parts(&|pixel| metric.part(pixel)), share + added);
            let more = (both - spread(&hits, share)).max(spread(&of_noise, added));
            let (low, high) = with_noise(value, share.min(1.0), off, more.sqrt() / count);
            let floor = parts(&|pixel| metric.part(&noise(pixel))).iter().sum::<f64>() / count;
            (Estimate { value, low: low.min(value), high: high.max(value) }, floor)
        }
        Metric::P99 => {
            let off: Vec<f64> = pixels.iter().map(|pixel| metric.part(pixel)).collect();
            let own: Vec<f64> = pixels.iter().map(|pixel| metric.part(&noise(pixel))).collect();
            let value = exceeded(&off, weights, 0.01);
            let draws =
                equal_draws(&parts(&|p| f64::from(u8::from(metric.part(p) > value))), weights);
            let least: Vec<f64> = pixels.iter().map(certain).collect();
            let (low, high) = spanned((&least, &off), weights, draws);
            (
                Estimate { value, low: low.min(value), high: high.max(value) },
                exceeded(&own, weights, 0.01),
            )
        }
    }
}

/// Returns the 95 % interval of the 99th percentile, if the list is worth `draws` equal draws, or its
/// length if that is less: the few pixels beyond the percentile are no evidence of more. The upper end is
/// 1, the maximum deviation, if there are few draws. `least` has a lower bound of each deviation, because
/// counting the reference's noise as error overestimates the percentile.
fn spanned((least, list): (&[f64], &[f64]), weights: &[f64], draws: f64) -> (f64, f64) {
    let draws = draws.min(list.len() as f64).floor().clamp(1.0, MOST_DRAWS);
    let (few, many) = beyond_p99(draws);
    let low = exceeded(least, weights, many / draws);
    (low, few.map_or(1.0, |few| exceeded(list, weights, few / draws)))
}

/// Returns the part of a pixel's largest deviation that exceeds the reference's own error.
fn certain(pixel: &Deviation) -> f64 {
    let parts = pixel.off.iter().zip(pixel.noise);
    parts.map(|(off, noise)| (off * off - noise * noise).max(0.0).sqrt()).fold(0.0, f64::max)
}

/// Returns how many of `draws` draws may lie beyond the 99th percentile: more than the first number, if
/// any, and at most the second. Each end is exceeded with a probability of 2.5 %, where the number at the
/// end counts half. Thus the interval holds with 95 % probability on average over all lengths of the list;
/// whole numbers of draws cannot achieve that for each length, and counting the end in full would be
/// conservative.
///
/// **Source:** H. Lancaster, "Significance tests in discrete distributions", JASA 56, 1961 (mid-P).
fn beyond_p99(draws: f64) -> (Option<f64>, f64) {
    let tail = 0.025;
    // The binomial distribution, term by term.
    let (mut chance, mut below, mut beyond) = (pow(0.99, draws), 0.0, 0.0);
    let mut few = None;
    while beyond <= draws {
        let middle = below + chance / 2.0;
        if middle <= tail {
            few = Some(beyond);
        } else if middle >= 1.0 - tail {
            break;
        }
        below += chance;
        chance *= (draws - beyond) / (beyond + 1.0) * (0.01 / 0.99);
        beyond += 1.0;
    }
    (few, beyond - 1.0)
}

/// Returns the least number of a list that at most `share` of the total weight exceeds.
fn exceeded(list: &[f64], weights: &[f64], share: f64) -> f64 {
    let mut both: Vec<(f64, f64)> = list.iter().copied().zip(weights.iter().copied()).collect();
    both.sort_by(|a, b| b.0.total_cmp(&a.0));
    let most = share * weights.iter().sum::<f64>();
    let mut sum = 0.0;
    let found = both.iter().find(|(_, weight)| {
        sum += weight;
        sum > most
    });
    found.map_or(0.0, |&(value, _)| value)
}

/// Returns the number of equally weighted draws that would estimate a fraction as precisely as these
/// weighted ones. Few hits are weak evidence, so one more is assumed.
fn equal_draws(hits: &[f64], weights: &[f64]) -> f64 {
    let count = hits.len().max(1) as f64;
    let share = (hits.iter().sum::<f64>() / count).clamp(0.0, 1.0);
    let here: f64 = hits.iter().map(|hit| (hit - share) * (hit - share)).sum();
    let most = weights.iter().copied().fold(1.0, f64::max);
    count * (count * share * (1.0 - share) + 1.0) / (here + most)
}

/// Returns the number of unstratified pixels that would estimate the fraction of hits as precisely as
/// these, each of which was drawn from its own square: similarity of adjacent squares reduces the error of
/// the fraction. The variance in a square is estimated from two neighbours. Few hits are weak evidence, so
/// one more isolated hit is assumed.
///
/// **Source:** the variance is that of successive differences (K. Wolter, Introduction to Variance
/// Estimation, 2nd ed. 2007, ch. 8); an interval from the effective number of draws is that of E. Korn, B.
/// Graubard, "Confidence intervals for proportions with small expected number of positive counts estimated
/// from survey data", Survey Methodology 24, 1998.
fn worth(hits: &[f64]) -> f64 {
    let count = hits.len() as f64;
    let share = hits.iter().sum::<f64>() / count.max(1.0);
    let anywhere = count * share * (1.0 - share);
    count * (anywhere.max(0.0) + 1.0) / (successive(hits) + 1.0)
}

/// Returns the sum of squared deviations from the mean, estimated from successive differences.
fn successive(parts: &[f64]) -> f64 {
    parts.windows(2).map(|pair| (pair[0] - pair[1]) * (pair[0] - pair[1])).sum::<f64>() / 2.0
}

/// Returns 1 if a component is off by more than [`BAD`], otherwise 0.
fn bad(off: [f64; 3]) -> f64 {
    f64::from(u8::from(off.iter().any(|c| c.abs() > BAD)))
}

/// Returns the interval around `value`, given the `share` with a known interval, and the contribution of
/// the reference's noise with its standard error: the squared distances to the ends add up.
///
/// **Source:** G. Zou, A. Donner, "Construction of confidence limits about effect measures", Statistics in
/// Medicine 27, 2008.
fn with_noise(value: f64, share: f64, (low, high): (f64, f64), noise: f64) -> (f64, f64) {
    let half = |end: f64| ((end - share) * (end - share) + Z * Z * noise * noise).sqrt();
    ((value - half(low)).max(0.0), (value + half(high)).min(1.0))
}

/// Returns the interval between the 2.5th and the 97.5th percentile.
pub fn interval(resamples: &[f64]) -> (f64, f64) {
    let mut sorted = resamples.to_vec();
    (quantile(&mut sorted, 0.025), quantile(&mut sorted, 0.975))
}

/// Returns the cumulative distribution function of the standard normal distribution at `z`.
fn normal_share(z: f64) -> f64 {
    0.5 * (1.0 + erf(z * std::f64::consts::FRAC_1_SQRT_2))
}

/// Returns the inverse of [`normal_share`], by bisection.
fn normal_quantile(share: f64) -> f64 {
    let (mut low, mut high) = (-10.0, 10.0);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if normal_share(middle) < share { low = middle } else { high = middle }
    }
    (low + high) / 2.0
}

/// Returns the interval of the differences of `a` and `b` by resample; the difference is proven if the
/// interval excludes 0.
pub fn difference(a: &[f64], b: &[f64]) -> (f64, f64) {
    interval(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>())
}

/// Returns the least number that at least `share` of the list do not exceed; 0 for an empty list.
fn quantile(list: &mut [f64], share: f64) -> f64 {
    let rank = (share * list.len() as f64).ceil() as usize;
    let place = rank.clamp(1, list.len().max(1)) - 1;
    match place < list.len() {
        true => *list.select_nth_unstable_by(place, f64::total_cmp).1,
        false => 0.0,
    }
}

/// Returns the 95 % interval of a fraction, given `hits` of `count`; for no hits in n, at most 3.84/n.
///
/// **Source:** E. Wilson, "Probable inference, the law of succession, and statistical inference", JASA 22,
/// 1927.
pub fn wilson(hits: f64, count: f64) -> (f64, f64) {
    if count <= 0.0 {
        return (0.0, 1.0);
    }
    let (share, z) = (hits / count, Z * Z / count);
    let middle = share + z / 2.0;
    let half = (z * share * (1.0 - share) + z * z / 4.0).sqrt();
    (((middle - half) / (1.0 + z)).max(0.0), ((middle + half) / (1.0 + z)).min(1.0))
}

#[cfg(test)]
mod tests;
