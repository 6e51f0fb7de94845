//! Errors and intervals, held against what is published, what theory says, and chance.

use super::*;

fn gray(off: f64) -> Deviation {
    Deviation { off: [off; 3], noise: [0.0; 3] }
}

#[test]
fn wilsons_interval_has_its_published_values() {
    // R. Newcombe, Statistics in Medicine 17 (1998), table I, method 3.
    let published = [
        (81.0, 263.0, 0.2553, 0.3662),
        (15.0, 148.0, 0.0624, 0.1605),
        (0.0, 20.0, 0.0, 0.1611),
        (1.0, 29.0, 0.0061, 0.1718),
    ];
    for (hits, count, low, high) in published {
        let (l, h) = wilson(hits, count);
        assert!((l - low).abs() < 6e-5 && (h - high).abs() < 6e-5, "{hits}/{count}: {l} {h}");
    }
    assert_eq!(wilson(0.0, 0.0), (0.0, 1.0));
    assert_eq!(wilson(7.0, 7.0).1, 1.0);
}

#[test]
fn the_numbers_are_what_they_are_called() {
    let pixels: Vec<_> = (1..=1000).map(|i| gray(f64::from(i) * 1e-4)).collect();
    let rmse = (1001.0f64 * 2001.0 / 6.0).sqrt() * 1e-4;
    assert!((Metric::Rmse.of(&pixels) - rmse).abs() < 1e-12);
    assert_eq!(Metric::P99.of(&pixels), 0.099);
    // 0.0078 is not bad, 0.0079 is.
    assert_eq!(Metric::Bad.of(&pixels), 0.922);
    let one = [Deviation { off: [0.0, -0.5, 0.1], noise: [0.0; 3] }];
    assert_eq!(Metric::P99.of(&one), 0.5);
    assert!((Metric::Rmse.of(&one) - (0.26f64 / 3.0).sqrt()).abs() < 1e-15);
    for metric in Metric::ALL {
        assert_eq!(metric.of(&[]), 0.0);
        assert!(metric.resampled(&[]).is_empty());
    }
}

#[test]
fn the_bootstrap_of_a_mean_has_the_standard_error_that_theory_says() {
    // Squares are uniform on 0 … 1: their mean is 1/2 ± 1.96·√(1/12n).
    let mut random = Random(8);
    let pixels: Vec<_> = (0..2000).map(|_| gray(random.number(0.0, 1.0).sqrt())).collect();
    let Estimate { value, low, high } = Metric::Rmse.estimate(&pixels, f64::INFINITY);
    let half = Z * (1.0f64 / 12.0 / 2000.0).sqrt();
    assert!(((high * high - low * low) / 2.0 / half - 1.0).abs() < 0.1);
    assert!(low < value && value < high);
}

#[test]
fn the_noise_of_the_reference_is_not_counted_as_error() {
    // Truth 0.5, x = 0.6, and a reference whose halves are off by ±0.3 at random.
    let mut random = Random(3);
    let pixels: Vec<_> = (0..20_000)
        .map(|_| {
            let mut half = || 0.5 + random.number(-0.3, 0.3);
            let (a, b) = (half(), half());
            Deviation { off: [0.6 - (a + b) / 2.0; 3], noise: [(a - b) / 2.0; 3] }
        })
        .collect();
    assert!((Metric::Rmse.of(&pixels) - 0.1).abs() < 0.01);
    assert!((Metric::Rmse.floor(&pixels) - 0.3 / 6f64.sqrt()).abs() < 0.003);
}

#[test]
fn a_share_near_nothing_is_told_as_closely_as_its_pixels_allow_whatever_the_noise() {
    // Nothing is bad; a reference whose halves are off by up to 0.011 says so of some.
    let mut random = Random(4);
    let mut holds = 0;
    for truth in [0.0, 0.004].into_iter().cycle().take(200) {
        let pixels: Vec<_> = (0..3000)
            .map(|_| {
                let off = if random.number(0.0, 1.0) < truth { 0.5 } else { 0.0 };
                let mut half = || off + random.number(-0.011, 0.011);
                let (a, b) = (half(), half());
                Deviation { off: [(a + b) / 2.0; 3], noise: [(a - b) / 2.0; 3] }
            })
            .collect();
        assert!(Metric::Bad.floor(&pixels) > 0.02);
        let weighted = weighted(Metric::Bad, &pixels, &[1.0; 3000]).0;
        for Estimate { low, high, .. } in [Metric::Bad.estimate(&pixels, f64::INFINITY), weighted] {
            assert!(high - low < 0.03, "{low} {high}");
            holds += u32::from(low <= truth && truth <= high);
        }
    }
    assert!(holds >= 360, "{holds}");
    // Without noise it is Wilson's.
    let none = Metric::Bad.estimate(&[gray(0.0); 432], f64::INFINITY);
    assert!(none.low == 0.0 && none.high < 0.0089, "{none:?}");
}

#[test]
fn a_share_is_known_the_more_closely_the_more_of_all_pixels_were_looked_at() {
    let mut random = Random(11);
    let (all, bad, times) = (1728, 40, 1000_u32);
    for (count, most) in [(432, 0.036), (864, 0.025), (1296, 0.015)] {
        let (mut holds, mut widths) = (0, 0.0);
        for _ in 0..times {
            // Which of all are drawn; the first are bad.
            let mut left = count;
            let drawn = |i: usize| {
                let is_drawn = random.below(all - i) < left;
                left -= usize::from(is_drawn);
                is_drawn.then_some(if i < bad { 0.5 } else { 0.0 })
            };
            let off: Vec<f64> = (0..all).filter_map(drawn).collect();
            // Bad ones are anywhere.
            let mut pixels: Vec<_> = off.into_iter().map(gray).collect();
            for last in (1..pixels.len()).rev() {
                pixels.swap(last, random.below(last + 1));
            }
            let Estimate { low, high, .. } = Metric::Bad.estimate(&pixels, all as f64);
            let truth = bad as f64 / all as f64;
            holds += u32::from((low..=high).contains(&truth));
            widths += (high - low) / f64::from(times);
        }
        assert!((900..=990).contains(&holds) && widths < most, "{count}: {holds} {widths}");
    }
    // Of a picture all of which was looked at, nothing is left in doubt.
    let pixels: Vec<_> = (0..900).map(|i| gray(f64::from(i % 9) / 9.0)).collect();
    let Estimate { value, low, high } = Metric::Bad.estimate(&pixels, 900.0);
    assert!(low <= value && value <= high && high - low < 2e-3, "{low} {high}");
}

#[test]
fn the_interval_of_a_percentile_holds_it_95_times_of_100() {
    let mut random = Random(5);
    for (count, times) in [(36, 400), (200, 400), (298, 400), (400, 400), (600, 400), (4096, 200)] {
        let (mut holds, mut weighted_holds, mut known) = (0, 0, 0);
        for _ in 0..times {
            let off: Vec<f64> = (0..count).map(|_| random.number(0.0, 1.0)).collect();
            let pixels: Vec<_> = off.iter().map(|&off| gray(off)).collect();
            let held = |Estimate { low, high, .. }| u32::from(low <= 0.99 && 0.99 <= high);
            let estimate = Metric::P99.estimate(&pixels, f64::INFINITY);
            holds += held(estimate);
            known += u32::from(estimate.high < 1.0);
            // Twice as likely to be drawn from above the middle, and half the weight there.
            let drawn: Vec<f64> = (0..count)
                .map(|_| random.number(0.0, 1.5))
                .map(|x| if x < 0.5 { x } else { 0.5 + (x - 0.5) / 2.0 })
                .collect();
            let weights: Vec<f64> =
                drawn.iter().map(|&x| if x < 0.5 { 1.5 } else { 0.75 }).collect();
            let pixels: Vec<_> = drawn.iter().map(|&off| gray(off)).collect();
            weighted_holds += held(weighted(Metric::P99, &pixels, &weights).0);
        }
        // 95 % and three standard deviations.
        let least = f64::from(times) * 0.95 - 3.0 * (f64::from(times) * 0.95 * 0.05).sqrt();
        assert!(f64::from(holds) >= least, "{holds} of {times} by {count}");
        assert!(f64::from(weighted_holds) >= least, "weighted: {weighted_holds} by {count}");
        // Not even the worst of 298 is beyond it often enough.
        assert_eq!(known, if count > 298 { times } else { 0 }, "{count}");
    }
}

#[test]
fn the_ranks_of_a_percentile_have_their_tabulated_values() {
    // Of 298 draws none lies beyond with a chance of .99^298 = .0500, of 299 .0495; half of it is held against
    // 2½ of 100. Of 1000 draws 3 or fewer lie beyond with a chance of .0101, 4 or fewer with .0287, 16 or fewer
    // with .9736, 17 or fewer with .9862.
    assert_eq!(beyond_p99(298.0).0, None);
    assert_eq!(beyond_p99(299.0).0, Some(0.0));
    assert_eq!(beyond_p99(1000.0), (Some(4.0), 16.0));
}

#[test]
fn pairs_tell_apart_what_single_intervals_cannot() {
    let mut random = Random(9);
    let a: Vec<_> = (0..500).map(|_| gray(random.number(0.0, 0.2))).collect();
    let b: Vec<_> = a.iter().map(|pixel| gray(pixel.off[0] * 0.99)).collect();
    let (of_a, of_b) = (Metric::Rmse.resampled(&a), Metric::Rmse.resampled(&b));
    assert!(interval(&of_a).0 < interval(&of_b).1);
    assert!(difference(&of_a, &of_b).0 > 0.0);
    assert_eq!(difference(&of_a, &of_a), (0.0, 0.0));
}
