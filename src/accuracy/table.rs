//! The report as a table that a person reads in ten seconds.

use std::fmt::Write;

use super::{Estimate, Metric, Report, Setting, Span, Tried, Verdict};
use crate::math::elementary::log10;

/// The whole report.
pub fn text(report: &Report, file: &str, threads: usize) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut out, report, file, threads);
    out
}

fn write(out: &mut String, report: &Report, file: &str, threads: usize) -> std::fmt::Result {
    let region = report.frame.region;
    let floor = report.floors[report.metric as usize];
    writeln!(
        out,
        "{file} {}×{}: {} audited pixels (seed {}), reference of {} samples each, noise floor {}",
        region.width,
        region.height,
        report.audited,
        report.seed,
        report.reference_samples,
        amount(report.metric, floor)
    )?;
    if !report.cut.is_empty() {
        writeln!(out, "to keep the budget only {}", report.cut.join(", "))?;
    }
    writeln!(
        out,
        "seconds of {}, {}; cost is the work counted, in rays of the camera; * is the scene's own, or `render`'s",
        runs(report),
        count(threads, "thread")
    )?;
    writeln!(out, "faster is less cost counted, and a middle run below the other's shortest")?;
    let share = report.share_of_time(threads);
    if share < BUSY {
        let percent = 100.0 * share;
        writeln!(
            out,
            "the machine is busy: of their time the threads had {percent:.0} %, and seconds say less than cost"
        )?;
    }
    writeln!(out)?;
    writeln!(
        out,
        "  {:18} {:>14} {:>14} {:>4} {:>8} {:>8} {:>8} {:>8}  {:>9} {:18} worth it?",
        "setting",
        "CPU min..med",
        "wall min..med",
        "runs",
        "rays/px",
        "boxes/px",
        "roots/px",
        "cost/px",
        heading(report.metric),
        "95 % interval"
    )?;
    for knob in &report.knobs {
        writeln!(out, "{}", knob.name)?;
        for setting in &knob.settings {
            let row = &report.rows[setting.row];
            writeln!(
                out,
                "{} {:18} {:>14} {:>14} {:>4} {:>8.2} {:>8.2} {:>8.2} {:>8.2}  {:>9} {:18} {}",
                if setting.is_own { '*' } else { ' ' },
                setting.label,
                span(Span::of(&row.times.cpu)),
                span(Span::of(&row.times.wall)),
                row.times.cpu.len(),
                report.a_pixel(row.counters.rays() as f64),
                report.a_pixel(row.counters.work.box_visits as f64),
                report.a_pixel(row.counters.work.root_solves as f64),
                report.a_pixel(report.cost(setting.row)),
                error(report, setting.row),
                bounds(report, report.error(setting.row)),
                verdict(report, knob, setting)
            )?;
        }
        if !knob.left_out.is_empty() {
            writeln!(out, "  not tried within the budget: {}", knob.left_out.join(", "))?;
        }
    }
    writeln!(out)?;
    for knob in &report.knobs {
        writeln!(out, "{}", knob.sentence)?;
    }
    for sentence in &report.idle {
        writeln!(out, "{sentence}.")?;
    }
    Ok(())
}

/// On the front, or what is to be preferred: first among the settings of its own knob.
fn verdict(report: &Report, knob: &Tried, setting: &Setting) -> String {
    let name = |row: usize| {
        let mine = knob.settings.iter().find(|other| other.row == row);
        mine.map_or(report.rows[row].name.as_str(), |mine| mine.label.as_str())
    };
    let verdict = match setting.verdict {
        Verdict::Front => report.rows[setting.row].verdict,
        other => other,
    };
    match verdict {
        Verdict::Front => "front".to_owned(),
        Verdict::Tied { with } => format!("tied with {}", name(with)),
        Verdict::Unproven { over, times } => {
            format!("no proven gain over {}, for {}", name(over), more(times))
        }
        Verdict::Dominated { by, times, error } => {
            let times = times.map_or_else(|| "is the same work".to_owned(), less);
            let below = if report.is_resolved(report.metric, by) { "" } else { "< " };
            let error = match 100.0 * error {
                percent if percent < 99.0 => format!("with {below}{percent:.0} % of the error"),
                percent if percent < 99.95 => format!("with {below}{percent:.1} % of the error"),
                _ => "with no more error".to_owned(),
            };
            format!("no: {} {times}, {error}", name(by))
        }
    }
}

/// A machine that leaves its threads less than this part of their time is busy.
const BUSY: f64 = 0.75;

/// From here on a ratio is told as one, and below as a percentage.
const LARGE: f64 = 1.2;

/// What the faster of two is.
fn less(ratio: f64) -> String {
    match ratio {
        LARGE.. => format!("is {} faster", times(ratio)),
        _ => format!("takes {} less time", percent(1.0 - 1.0 / ratio)),
    }
}

/// What the slower of two takes.
pub(super) fn more(ratio: f64) -> String {
    match ratio {
        LARGE.. => format!("{} the time", times(ratio)),
        _ => format!("{} more time", percent(ratio - 1.0)),
    }
}

fn times(ratio: f64) -> String {
    if ratio < 10.0 { format!("{ratio:.1}×") } else { format!("{ratio:.0}×") }
}

/// A small part with one digit or two.
fn percent(part: f64) -> String {
    let percent = 100.0 * part;
    let digits = (-log10(percent).floor()).clamp(0.0, 9.0) as usize;
    format!("{percent:.digits$} %")
}

fn heading(metric: Metric) -> &'static str {
    match metric {
        Metric::Rmse => "RMSE",
        Metric::P99 => "p99",
        Metric::Bad => "bad",
    }
}

/// An error of a row, or that it is below what the reference can resolve.
pub fn error(report: &Report, row: usize) -> String {
    match report.is_resolved(report.metric, row) {
        true => amount(report.metric, report.error(row).value),
        false => {
            let most = report.resolution(report.metric).max(report.error(row).high);
            format!("< {}", amount(report.metric, most))
        }
    }
}

fn bounds(report: &Report, Estimate { low, high, .. }: Estimate) -> String {
    format!("[{}, {}]", amount(report.metric, low), amount(report.metric, high))
}

/// An error as people read it: shares in percent, others with two or three digits.
pub fn amount(metric: Metric, value: f64) -> String {
    match metric {
        Metric::Bad => format!("{:.2} %", 100.0 * value),
        Metric::Rmse | Metric::P99 if value >= 0.1 => format!("{value:.3}"),
        Metric::Rmse | Metric::P99 if value >= 0.01 => format!("{value:.4}"),
        Metric::Rmse | Metric::P99 if value >= 0.000_1 => format!("{value:.5}"),
        Metric::Rmse | Metric::P99 if value == 0.0 => "0".to_owned(),
        Metric::Rmse | Metric::P99 => format!("{value:.1e}"),
    }
}

/// The least of some runs and the middle one.
pub(super) fn span(Span { min, median }: Span) -> String {
    format!("{}..{}", seconds(min), seconds(median))
}

/// Seconds with three digits.
fn seconds(s: f64) -> String {
    match s {
        100.0.. => format!("{s:.0}"),
        10.0.. => format!("{s:.1}"),
        1.0.. => format!("{s:.2}"),
        0.1.. => format!("{s:.3}"),
        0.01.. => format!("{s:.4}"),
        _ => format!("{s:.5}"),
    }
}

/// `5 interleaved runs`, or `1 to 9 interleaved runs`.
pub(super) fn runs(report: &Report) -> String {
    match report.runs() {
        (least, most) if least == most => count(most, "interleaved run"),
        (least, most) => format!("{least} to {most} interleaved runs"),
    }
}

fn count(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_has_two_or_three_digits_whatever_its_size() {
        let rmse = |value| amount(Metric::Rmse, value);
        assert_eq!(rmse(0.1234), "0.123");
        assert_eq!(rmse(0.01234), "0.0123");
        assert_eq!(rmse(0.001234), "0.00123");
        assert_eq!(rmse(1.234e-7), "1.2e-7");
        assert_eq!(rmse(0.0), "0");
        assert_eq!(amount(Metric::Bad, 0.161), "16.10 %");
    }

    #[test]
    fn a_saving_is_told_however_small() {
        let savings = [31.86, 1.857, 1.0526, 1.0004, 1.000_012];
        assert_eq!(
            savings.map(less),
            [
                "is 32× faster",
                "is 1.9× faster",
                "takes 5 % less time",
                "takes 0.04 % less time",
                "takes 0.001 % less time"
            ]
        );
        assert_eq!(more(savings[1]), "1.9× the time");
        assert_eq!(more(savings[2]), "5 % more time");
    }
}
