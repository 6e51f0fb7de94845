//! One sentence a knob: what it bought, or that it buys nothing here.

use super::statistics::{difference, interval};
use super::{Report, Setting, Span, Tried, table};

/// What turning the knob did to this picture.
pub fn of(report: &Report, tried: &Tried) -> String {
    let name = tried.name;
    let settings = &tried.settings;
    let (Some(cheap), Some(dear)) = (settings.first(), settings.last()) else {
        return format!("{name}: nothing was tried.");
    };
    let audited = report.audited;
    let most = settings.iter().map(|setting| changed(report, setting, dear)).max().unwrap_or(0);
    if settings.len() < 2 {
        return format!("{name}: only {} was tried; a larger `--budget` tries more.", cheap.label);
    }
    if most == 0 {
        return format!(
            "{name} buys nothing here: from {} to {} not one of {audited} audited pixels changes.",
            cheap.label, dear.label
        );
    }
    let best = best(report, settings);
    let (from, to) = (report.error(cheap.row), report.error(best.row));
    let less = difference(&report.rows[cheap.row].resamples, &report.rows[best.row].resamples);
    let proven = report.is_resolved(cheap.row) && less.0 > 0.0 && best.row != cheap.row;
    if !proven {
        let change = |setting: &Setting| {
            let (a, b) = (&report.rows[setting.row].resamples, &report.rows[dear.row].resamples);
            let (low, high) = interval(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>());
            low.abs().max(high.abs())
        };
        let most_change = settings.iter().map(change).fold(0.0, f64::max);
        return format!(
            "{name} has no proven effect: {most} of {audited} audited pixels change, and the error by at most {}.",
            table::amount(report.metric, most_change)
        );
    }
    let enough = settings.iter().find(|setting| changed(report, setting, dear) == 0);
    let beyond = match enough {
        Some(enough) if enough.row != dear.row => {
            format!("; beyond {} not one audited pixel changes", enough.label)
        }
        _ => String::new(),
    };
    let share = match report.is_resolved(best.row) {
        true => format!(" ({:.0} % of it)", 100.0 * (1.0 - to.value / from.value)),
        false => String::new(),
    };
    format!(
        "{name} bought, from {} to {}, an error of {} instead of {}{share} for {}{beyond}.",
        cheap.label,
        best.label,
        table::error(report, best.row),
        table::error(report, cheap.row),
        price(report, cheap, best),
    )
}

/// How many audited pixels are not the same, to the last bit, under both.
fn changed(report: &Report, a: &Setting, b: &Setting) -> usize {
    let (a, b) = (&report.rows[a.row].colors, &report.rows[b.row].colors);
    a.iter().zip(b).filter(|(a, b)| a != b).count()
}

/// The first, from cheap to dear, whose error is not proven to be more than a hundredth above the
/// least, and that is no slower than another of those.
fn best<'a>(report: &Report, settings: &'a [Setting]) -> &'a Setting {
    let error = |setting: &Setting| report.error(setting.row).value.max(report.resolution());
    let resamples = |setting: &Setting| &report.rows[setting.row].resamples;
    let times = |setting: &Setting| &report.rows[setting.row].times;
    let least = settings.iter().map(error).fold(f64::INFINITY, f64::min);
    let champion = settings.iter().find(|setting| error(setting) <= least).unwrap_or(&settings[0]);
    let as_good = |setting: &&Setting| {
        let above = difference(resamples(setting), resamples(champion)).0;
        error(setting) <= 1.01 * least || above <= 0.01 * least
    };
    let good: Vec<&Setting> = settings.iter().filter(as_good).collect();
    let time = |setting: &&Setting| Span::of(&times(setting).cpu).min;
    let fastest = good.iter().map(time).fold(f64::INFINITY, f64::min);
    let in_time = |setting: &&&Setting| time(setting) <= fastest + times(setting).spread();
    good.iter().find(in_time).copied().unwrap_or(champion)
}

/// What the second costs beyond the first.
fn price(report: &Report, from: &Setting, to: &Setting) -> String {
    let times = |setting: &Setting| &report.rows[setting.row].times;
    let (a, b) = (times(from), times(to));
    let (low, high) = (Span::of(&a.cpu).min, Span::of(&b.cpu).min);
    if high <= low + a.spread().max(b.spread()) || low <= 0.0 {
        return "no more time than runs differ by".to_owned();
    }
    match high / low {
        ratio if ratio < 2.0 => format!("{:.0} % more time", 100.0 * (ratio - 1.0)),
        ratio => format!("{ratio:.1} times the time"),
    }
}
