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
    let Estimate { value, low, high } = Metric::Rmse.estimate(&pixels);
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
        for Estimate { low, high, .. } in [Metric::Bad.estimate(&pixels), weighted] {
            assert!(high - low < 0.03, "{low} {high}");
            holds += u32::from(low <= truth && truth <= high);
        }
    }
    assert!(holds >= 360, "{holds}");
    // Without noise it is Wilson's.
    let none = Metric::Bad.estimate(&[gray(0.0); 432]);
    assert!(none.low == 0.0 && none.high < 0.0089, "{none:?}");
}

#[test]
fn the_interval_of_a_percentile_holds_it_95_times_of_100() {
    let mut random = Random(5);
    let holds = (0..400).filter(|_| {
        let pixels: Vec<_> = (0..600).map(|_| gray(random.number(0.0, 1.0))).collect();
        let Estimate { low, high, .. } = Metric::P99.estimate(&pixels);
        low <= 0.99 && 0.99 <= high
    });
    assert!((365..=396).contains(&holds.count()));
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
