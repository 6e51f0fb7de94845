//! Summarizes each knob in one sentence: its benefit, or that it has none in this scene.

use super::reference::ROUNDING;
use super::statistics::difference;
use super::{Metric, Order, Report, Setting, Tried, table};

/// Describes the effect of the knob on this picture.
pub fn of(report: &Report, order: &Order, tried: &Tried) -> String {
    let name = tried.name;
    let settings = &tried.settings;
    let (Some(cheap), Some(dear)) = (settings.first(), settings.last()) else {
        return format!("{name}: nothing was tried.");
    };
    let audited = report.audited;
    let most = settings.iter().map(|setting| changed(report, setting, dear)).max().unwrap_or(0);
    if settings.len() < 2 && tried.vain.is_empty() {
        return format!("{name}: only {} was tried; a larger `--budget` tries more.", cheap.label);
    }
    if most == 0 {
        let [coarse, fine] = match tried.left_out.is_empty() {
            true => tried.ends.each_ref().map(String::as_str),
            false => [cheap.label.as_str(), dear.label.as_str()],
        };
        return format!(
            "{name} buys nothing here: from {coarse} to {fine} not one of {audited} audited pixels changes."
        );
    }
    let best = best(order, settings);
    let value = |setting: &&Setting| report.error(setting.row).value;
    let worse: Vec<&Setting> =
        settings.iter().filter(|setting| order.gains(best.row, setting.row)).collect();
    let worst = worse.iter().copied().max_by(|a, b| value(a).total_cmp(&value(b)));
    if let Some(worst) = worst.filter(|_| best.row == cheap.row) {
        let names: Vec<&str> = worse.iter().map(|setting| setting.label.as_str()).collect();
        // It is the cheapest by counts; another may be faster by the clock.
        let quicker = settings.iter().find(|other| order.is_quicker(other.row, best.row));
        let (cheapest, only, but) = match quicker {
            None => (", the cheapest,", " only", String::new()),
            Some(quicker) => ("", "", format!("; by the clock {} is faster", quicker.label)),
        };
        return format!(
            "{name}: {}{cheapest} is best; {}{only} makes it worse: an error of {} instead of {}{but}.",
            best.label,
            names.join(", "),
            table::error(report, worst.row),
            table::error(report, best.row),
        );
    }
    if !order.gains(best.row, cheap.row) {
        return no_effect(report, tried, dear, most);
    }
    let (from, to) = (report.error(cheap.row), report.error(best.row));
    let differs = |setting: &Setting| changed(report, setting, dear) > 0;
    let enough = &settings[settings.iter().rposition(differs).map_or(0, |last| last + 1)];
    let beyond = match enough.row == dear.row {
        true => String::new(),
        false => format!("; beyond {} not one audited pixel changes", enough.label),
    };
    let share = match report.is_resolved(report.metric, best.row) {
        true => format!(" ({:.0} % of it)", 100.0 * (1.0 - to.value / from.value)),
        false => String::new(),
    };
    format!(
        "{name} bought, from {} to {}, an error of {} instead of {}{share} for {}{beyond}.",
        cheap.label,
        best.label,
        table::error(report, best.row),
        table::error(report, cheap.row),
        price(order, cheap, best),
    )
}

/// Describes a knob that changes `changed` pixels without a proven effect on the error.
fn no_effect(report: &Report, tried: &Tried, dear: &Setting, changed: usize) -> String {
    let (name, settings, audited) = (tried.name, &tried.settings, report.audited);
    // For fractions of bad pixels, compares with the RMSE, whose unit is that of the change in color.
    let (floor, of) = match report.metric {
        Metric::Rmse | Metric::P99 => (report.floors[report.metric as usize], "the"),
        Metric::Bad => (report.floors[Metric::Rmse as usize], "the RMSE's"),
    };
    let of_color = settings.iter().map(|setting| change(report, setting, dear)).fold(0.0, f64::max);
    if of_color <= floor.max(ROUNDING) {
        let why = match of_color {
            ..=ROUNDING => "as colors are rounded".to_owned(),
            _ => format!("below {of} noise floor of {}", table::amount(Metric::Rmse, floor)),
        };
        return format!(
            "{name} buys nothing here: {changed} of {audited} audited pixels change, by {} at most, {why}.",
            table::amount(Metric::Rmse, of_color)
        );
    }
    let of_error = |setting: &Setting| {
        let (a, b) = (&report.rows[setting.row].resamples, &report.rows[dear.row].resamples);
        let (low, high) = difference(a, b);
        low.abs().max(high.abs())
    };
    let of_error = settings.iter().map(of_error).fold(0.0, f64::max);
    format!(
        "{name} has no proven effect: {changed} of {audited} audited pixels change, and the error by at most {}.",
        table::amount(report.metric, of_error)
    )
}

/// Returns how many audited pixels differ between two settings, to the last bit.
fn changed(report: &Report, a: &Setting, b: &Setting) -> usize {
    let (a, b) = (&report.rows[a.row].colors, &report.rows[b.row].colors);
    a.iter().zip(b).filter(|(a, b)| a != b).count()
}

/// Returns the maximum difference of a component of an audited pixel between two settings.
fn change(report: &Report, a: &Setting, b: &Setting) -> f64 {
    let (a, b) = (&report.rows[a.row].colors, &report.rows[b.row].colors);
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Returns the cheapest setting that no other is proven to be better than.
fn best<'a>(order: &Order, settings: &'a [Setting]) -> &'a Setting {
    let unsurpassed =
        |this: &&Setting| !settings.iter().any(|other| order.gains(other.row, this.row));
    settings.iter().find(unsurpassed).unwrap_or(&settings[0])
}

/// Describes the additional cost of the second setting.
fn price(order: &Order, from: &Setting, to: &Setting) -> String {
    order.times(from.row, to.row).map_or_else(|| table::NO_LONGER.to_owned(), table::more)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::svg::tests::report;

    /// Of two settings, the second twice as dear: the colour of the one pixel, the error.
    fn sentence([a, b]: [(f64, f64); 2], floor: f64) -> String {
        let mut report = report(&[(1.0, a.1, 0.0), (2.0, b.1, 0.0)], &["knob"], floor);
        report.rows[0].colors = vec![[0.5, 0.5, a.0]];
        report.rows[1].colors = vec![[0.5, 0.5, b.0]];
        report.judge();
        report.knobs[0].sentence.clone()
    }

    #[test]
    fn a_knob_that_changes_only_what_is_rounded_buys_nothing() {
        let said = "knob buys nothing here: 1 of 4800 audited pixels change, by 1.0e-13 at most, as colors are rounded.";
        // Whatever the error is: as small, or that of another knob.
        assert_eq!(sentence([(0.3, 2e-13), (0.3 + 1e-13, 1e-13)], ROUNDING), said);
        assert_eq!(sentence([(0.3, 0.1), (0.3 + 1e-13, 0.1)], ROUNDING), said);
        let said = "knob buys nothing here: from own to adaptive 0.01 1×1 not one of 4800 audited pixels changes.";
        assert_eq!(sentence([(0.3, 0.1), (0.3, 0.1)], ROUNDING), said);
    }

    #[test]
    fn a_change_below_the_noise_floor_buys_nothing_and_one_above_is_not_proven() {
        assert_eq!(
            sentence([(0.3, 0.1), (0.3004, 0.1)], 0.001),
            "knob buys nothing here: 1 of 4800 audited pixels change, by 0.00040 at most, below the noise floor of 0.00100."
        );
        assert_eq!(
            sentence([(0.3, 0.1), (0.32, 0.1)], 0.001),
            "knob has no proven effect: 1 of 4800 audited pixels change, and the error by at most 0."
        );
    }

    #[test]
    fn the_noise_floor_is_that_of_the_head() {
        let mut report = report(&[(1.0, 0.1, 0.0), (2.0, 0.1, 0.0)], &["knob"], 0.0);
        report.floors = [0.001, 0.002, 0.0];
        (report.rows[0].colors, report.rows[1].colors) = (vec![[0.3; 3]], vec![[0.3005; 3]]);
        let said = [
            (Metric::Rmse, "the noise floor of 0.00100."),
            (Metric::P99, "the noise floor of 0.00200."),
            (Metric::Bad, "the RMSE's noise floor of 0.00100."),
        ];
        for (metric, floor) in said {
            report.metric = metric;
            report.judge();
            assert!(report.knobs[0].sentence.ends_with(floor), "{}", report.knobs[0].sentence);
        }
    }

    #[test]
    fn what_was_bought_is_told_and_what_only_makes_it_worse() {
        assert_eq!(
            sentence([(0.3, 0.1), (0.4, 0.05)], 0.001),
            "knob bought, from own to adaptive 0.01 1×1, an error of 0.0500 instead of 0.100 (50 % of it) for 2.0× the time."
        );
        assert_eq!(
            sentence([(0.3, 0.05), (0.4, 0.1)], 0.001),
            "knob: own, the cheapest, is best; adaptive 0.01 1×1 only makes it worse: an error of 0.100 instead of 0.0500."
        );
    }
    #[test]
    fn what_the_clock_saw_is_not_contradicted() {
        let mut report = report(&[(1.0, 0.05, 0.0), (2.0, 0.1, 0.0)], &["knob"], 0.001);
        report.rows[0].colors = vec![[0.3; 3]];
        report.rows[1].colors = vec![[0.4; 3]];
        // More was counted of the second, and it took half the seconds.
        report.rows[1].times.cpu = vec![0.5; 3];
        report.judge();
        assert_eq!(
            report.knobs[0].sentence,
            "knob: own is best; adaptive 0.01 1×1 makes it worse: an error of 0.100 instead of 0.0500; by the clock adaptive 0.01 1×1 is faster."
        );
    }
}
