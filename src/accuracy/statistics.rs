//! One number for how wrong a picture is, and how sure that number is.
//!
//! **In:** deviations of single pixels from a reference. **Out:** [`Estimate`]s. **Invariant:** the
//! same on every run: what is drawn at random is drawn from a fixed seed.

use std::iter;

use crate::math::elementary::{erf, pow};
use crate::math::random::Random;

/// A pixel is bad when a component is off by more than this: two steps of 255.
pub const BAD: f64 = 2.0 / 255.0;
/// Of the standard normal distribution: 95 % lie within ± this.
const Z: f64 = 1.959_963_984_540_054;
/// How many resamples an interval is read from.
const RESAMPLES: usize = 1000;
/// Of fewer pixels than this, three more as bad as the worst may be unseen (the rule of three); of more, one.
///
/// **Source:** J. Hanley, A. Lippman-Hand, "If nothing goes wrong, is everything all right?", JAMA 249, 1983.
const FEW: usize = 100;
/// More draws make the ranks of a percentile no closer: a power of .99 is still a number for them.
const MOST_DRAWS: f64 = 50_000.0;
/// Of the resamples. All rows share them, so that their differences are those of pairs.
const SEED: u64 = 0x6c75_6361_726e_6521;

/// What "wrong" means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Metric {
    /// The root of the mean square over pixels and components.
    #[default]
    Rmse,
    /// Of a hundred pixels one has a component that is off by more.
    P99,
    /// The share of pixels that are off by more than 2/255.
    Bad,
}

/// How far one pixel is from the reference, in linear components clamped to 0 … 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Deviation {
    /// From the reference: the mean of its two halves.
    pub off: [f64; 3],
    /// Half the difference of the halves: as large as the reference's own standard error.
    pub noise: [f64; 3],
}

/// A number and the interval that holds the true one 95 times of 100.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Estimate {
    pub value: f64,
    pub low: f64,
    pub high: f64,
}

impl Metric {
    pub const ALL: [Self; 3] = [Self::Rmse, Self::P99, Self::Bad];

    pub fn name(self) -> &'static str {
        match self {
            Self::Rmse => "rmse",
            Self::P99 => "p99",
            Self::Bad => "bad",
        }
    }

    /// The part of one pixel in the number: its square error without what the reference's noise
    /// adds to it, its largest component, or about 1 if it is bad.
    ///
    /// The first is (x − A)(x − B) for a reference of independent halves A and B, whose mean is
    /// the true square error whatever their noise. The last is twice what both halves together say
    /// less what each alone says: noise pushes more pixels over the limit than back, twice as many
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

    /// From the parts of all pixels, which it may rearrange.
    fn whole(self, parts: &mut [f64]) -> f64 {
        let mean = |parts: &[f64]| parts.iter().sum::<f64>() / parts.len().max(1) as f64;
        match self {
            Self::Rmse => mean(parts).max(0.0).sqrt(),
            Self::P99 => quantile(parts, 0.99),
            Self::Bad => mean(parts).max(0.0),
        }
    }

    pub fn of(self, pixels: &[Deviation]) -> f64 {
        let mut parts: Vec<f64> = pixels.iter().map(|pixel| self.part(pixel)).collect();
        self.whole(&mut parts)
    }

    /// The same measure of the reference's own error.
    pub fn floor(self, pixels: &[Deviation]) -> f64 {
        let own: Vec<Deviation> =
            pixels.iter().map(|p| Deviation { off: p.noise, noise: [0.0; 3] }).collect();
        self.of(&own)
    }

    /// What [`Metric::of`] would have been with other pixels: one number a resample (with
    /// replacement). The k-th resample takes the same pixels whatever they hold.
    ///
    /// **Source:** B. Efron, R. Tibshirani, An Introduction to the Bootstrap (1993), ch. 13.
    pub fn resampled(self, pixels: &[Deviation]) -> Vec<f64> {
        self.redrawn(&pixels.iter().map(|pixel| self.part(pixel)).collect::<Vec<_>>())
    }

    fn redrawn(self, parts: &[f64]) -> Vec<f64> {
        if parts.is_empty() {
            return Vec::new();
        }
        let mut drawn = vec![0.0; parts.len()];
        let draw = |resample| {
            let mut random = Random::of(SEED, resample as u64);
            // The upper half of a product is as even as a remainder, and much sooner had.
            let mut place = || (((random.bits() >> 32) * parts.len() as u64) >> 32) as usize;
            drawn.iter_mut().for_each(|part| *part = parts[place()]);
            self.whole(&mut drawn)
        };
        (0..RESAMPLES).map(draw).collect()
    }

    /// The number with its interval: by bootstrap for RMSE, by Wilson's for shares, and for the
    /// 99th percentile by the ranks that it has 95 times of 100. The pixels are as `audit::by_place` has them:
    /// neighbours close together, and drawn from `all` there are: what was looked at adds nothing to the error of
    /// a share.
    ///
    /// **Source:** R. Woodruff, "Confidence intervals for medians and other position measures", JASA 47,
    /// 1952, for the percentile; its ranks are those of the binomial distribution (H. David, H. Nagaraja,
    /// Order Statistics, 3rd ed. 2003, 7.1); for the share, W. Cochran, Sampling Techniques, 3rd ed. 1977, 2.6
    /// (the finite population correction).
    pub fn estimate(self, pixels: &[Deviation], all: f64) -> Estimate {
        let mut parts: Vec<f64> = pixels.iter().map(|pixel| self.part(pixel)).collect();
        let value = self.whole(&mut parts);
        let (low, high) = match self {
            Self::Rmse => {
                let (low, _) = self.corrected(&parts);
                // The next pixel may be as bad as the worst so far; where few are known, so may the next
                // three: of what n draws did not show there may be 3/n.
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
                // Noise shows where pixels are nearly bad: it adds more to their spread than its own.
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

    /// As [`interval`] of the resamples, corrected for bias and for the skewness of the parts, of
    /// whose mean the number is a rising function: errors are skewed, a few pixels have most of them.
    ///
    /// **Source:** B. Efron, "Better bootstrap confidence intervals", JASA 82, 1987 (BCa); the
    /// acceleration of a mean is a sixth of its standardised third moment.
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

/// The number with its interval, and that of the reference's own error, by pixels drawn at random of which
/// each counts as much as its weight: the less, the likelier it was to be drawn.
///
/// **Source:** as [`Metric::estimate`]; shares and ranks as of so many equal draws as have the same
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

/// Where the 99th percentile lies, 95 times of 100, if the list tells as much as so many equal draws, or as
/// many as it has: the few that lie beyond do not tell that it says more. No deviation is greater than 1; where
/// there are few draws, it may be that much. Of each deviation there is the least that it may be: with the
/// reference's noise taken for error the percentile is too high.
fn spanned((least, list): (&[f64], &[f64]), weights: &[f64], draws: f64) -> (f64, f64) {
    let draws = draws.min(list.len() as f64).floor().clamp(1.0, MOST_DRAWS);
    let (few, many) = beyond_p99(draws);
    let low = exceeded(least, weights, many / draws);
    (low, few.map_or(1.0, |few| exceeded(list, weights, few / draws)))
}

/// What of a pixel's largest deviation is beyond the reference's own.
fn certain(pixel: &Deviation) -> f64 {
    let parts = pixel.off.iter().zip(pixel.noise);
    parts.map(|(off, noise)| (off * off - noise * noise).max(0.0).sqrt()).fold(0.0, f64::max)
}

/// How many of so many draws may lie beyond the 99th percentile: more than the first number, as far as there
/// is one, and no more than the second. Each end is left to a chance of 2½ of 100, of which the number at the
/// end counts half: so the interval holds 95 times of 100 in the mean of all lengths of the list, where whole
/// numbers of draws cannot do so for each; counted whole, it would hold too often.
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

/// The least number of a list that no more than `share` of the whole exceeds.
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

/// How many draws of equal weight would tell a share as surely as these, whose hits count as much as
/// their weights say. Where hits are few they say little, and one more is supposed beside them.
fn equal_draws(hits: &[f64], weights: &[f64]) -> f64 {
    let count = hits.len().max(1) as f64;
    let share = (hits.iter().sum::<f64>() / count).clamp(0.0, 1.0);
    let here: f64 = hits.iter().map(|hit| (hit - share) * (hit - share)).sum();
    let most = weights.iter().copied().fold(1.0, f64::max);
    count * (count * share * (1.0 - share) + 1.0) / (here + most)
}

/// How many pixels drawn from anywhere would tell the share of hits as surely as these do, each of
/// which was drawn from a square of its own: what squares side by side have in common adds nothing to
/// the share's error. Two neighbours estimate the variance in a square; where hits are few they say
/// little, and one that stands alone is supposed beside those that were seen.
///
/// **Source:** the variance is that of successive differences (K. Wolter, Introduction to Variance
/// Estimation, 2nd ed. 2007, ch. 8); an interval from as many draws as are worth the same is that of
/// E. Korn, B. Graubard, "Confidence intervals for proportions with small expected number of positive
/// counts estimated from survey data", Survey Methodology 24, 1998.
fn worth(hits: &[f64]) -> f64 {
    let count = hits.len() as f64;
    let share = hits.iter().sum::<f64>() / count.max(1.0);
    let anywhere = count * share * (1.0 - share);
    count * (anywhere.max(0.0) + 1.0) / (successive(hits) + 1.0)
}

/// The sum of the parts' square distances from their mean, as neighbours tell it.
fn successive(parts: &[f64]) -> f64 {
    parts.windows(2).map(|pair| (pair[0] - pair[1]) * (pair[0] - pair[1])).sum::<f64>() / 2.0
}

/// 1 where a component is off by more than [`BAD`], else 0.
fn bad(off: [f64; 3]) -> f64 {
    f64::from(u8::from(off.iter().any(|c| c.abs() > BAD)))
}

/// The interval about `value`, a `share` whose own is known and what the reference's noise added to it,
/// which is known to a standard error: the squares of the distances to both ends add up.
///
/// **Source:** G. Zou, A. Donner, "Construction of confidence limits about effect measures", Statistics in
/// Medicine 27, 2008.
fn with_noise(value: f64, share: f64, (low, high): (f64, f64), noise: f64) -> (f64, f64) {
    let half = |end: f64| ((end - share) * (end - share) + Z * Z * noise * noise).sqrt();
    ((value - half(low)).max(0.0), (value + half(high)).min(1.0))
}

/// What lies between the 2½th and the 97½th hundredth.
pub fn interval(resamples: &[f64]) -> (f64, f64) {
    let mut sorted = resamples.to_vec();
    (quantile(&mut sorted, 0.025), quantile(&mut sorted, 0.975))
}

/// The share of a standard normal distribution below `z`.
fn normal_share(z: f64) -> f64 {
    0.5 * (1.0 + erf(z * std::f64::consts::FRAC_1_SQRT_2))
}

/// The inverse of [`normal_share`], by bisection.
fn normal_quantile(share: f64) -> f64 {
    let (mut low, mut high) = (-10.0, 10.0);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if normal_share(middle) < share { low = middle } else { high = middle }
    }
    (low + high) / 2.0
}

/// How much more `a` is than `b`, resample by resample; the interval tells whether it is proven.
pub fn difference(a: &[f64], b: &[f64]) -> (f64, f64) {
    interval(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>())
}

/// The least number that at least `share` of the list do not exceed; 0 of an empty one.
fn quantile(list: &mut [f64], share: f64) -> f64 {
    let rank = (share * list.len() as f64).ceil() as usize;
    let place = rank.clamp(1, list.len().max(1)) - 1;
    match place < list.len() {
        true => *list.select_nth_unstable_by(place, f64::total_cmp).1,
        false => 0.0,
    }
}

/// The 95 % interval of a share of which `hits` of `count` were seen; 0 of n is at most 3.84/n.
///
/// **Source:** E. Wilson, "Probable inference, the law of succession, and statistical inference",
/// JASA 22, 1927.
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
