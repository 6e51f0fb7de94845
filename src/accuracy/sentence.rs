//! One sentence a knob: what it bought, or that it buys nothing here.

use super::statistics::difference;
use super::{Order, Report, Setting, Tried, table};

/// What turning the knob did to this picture.
pub fn of(report: &Report, order: &Order, tried: &Tried) -> String {
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
    let best = best(order, settings);
    let worse: Vec<&Setting> =
        settings.iter().filter(|setting| order.gains(best.row, setting.row)).collect();
    if let Some(worst) = worse.last().filter(|_| best.row == cheap.row) {
        let names: Vec<&str> = worse.iter().map(|setting| setting.label.as_str()).collect();
        return format!(
            "{name}: {}, the cheapest, is best; {} only makes it worse: an error of {} instead of {}.",
            best.label,
            names.join(", "),
            table::error(report, worst.row),
            table::error(report, best.row),
        );
    }
    if !order.gains(best.row, cheap.row) {
        let change = |setting: &Setting| {
            let (a, b) = (&report.rows[setting.row].resamples, &report.rows[dear.row].resamples);
            let (low, high) = difference(a, b);
            low.abs().max(high.abs())
        };
        let most_change = settings.iter().map(change).fold(0.0, f64::max);
        return format!(
            "{name} has no proven effect: {most} of {audited} audited pixels change, and the error by at most {}.",
            table::amount(report.metric, most_change)
        );
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

/// How many audited pixels are not the same, to the last bit, under both.
fn changed(report: &Report, a: &Setting, b: &Setting) -> usize {
    let (a, b) = (&report.rows[a.row].colors, &report.rows[b.row].colors);
    a.iter().zip(b).filter(|(a, b)| a != b).count()
}

/// The cheapest that no other is proven to be better than.
fn best<'a>(order: &Order, settings: &'a [Setting]) -> &'a Setting {
    let unsurpassed =
        |this: &&Setting| !settings.iter().any(|other| order.gains(other.row, this.row));
    settings.iter().find(unsurpassed).unwrap_or(&settings[0])
}

/// What the second costs beyond the first.
fn price(order: &Order, from: &Setting, to: &Setting) -> String {
    order.saving(from.row, to.row).map_or_else(|| "no more cost".to_owned(), table::more)
}
