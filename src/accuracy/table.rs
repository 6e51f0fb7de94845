//! The report as a table that a person reads in ten seconds.

use std::fmt::Write;

use super::{Estimate, Metric, Report, Setting, Span, Tried, Verdict};

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
        "CPU seconds of {}, {}; wall clock beside; * is the scene's own, or `render`'s\n",
        count(report.runs, "interleaved run"),
        count(threads, "thread")
    )?;
    writeln!(
        out,
        "  {:22} {:>15} {:>8} {:>9} {:>9} {:>9}  {:>9} {:21} worth it?",
        "setting",
        "CPU min..median",
        "wall",
        "rays/px",
        "boxes/px",
        "roots/px",
        heading(report.metric),
        "95 % interval"
    )?;
    for knob in &report.knobs {
        writeln!(out, "{}", knob.name)?;
        for setting in &knob.settings {
            let row = &report.rows[setting.row];
            let (cpu, wall) = (Span::of(&row.times.cpu), Span::of(&row.times.wall));
            writeln!(
                out,
                "{} {:22} {:>15} {:>8} {:>9.2} {:>9.2} {:>9.2}  {:>9} {:21} {}",
                if setting.is_own { '*' } else { ' ' },
                setting.label,
                format!("{}..{}", seconds(cpu.min), seconds(cpu.median)),
                seconds(wall.min),
                report.a_pixel(row.counters.rays()),
                report.a_pixel(row.counters.work.box_visits),
                report.a_pixel(row.counters.work.root_solves),
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
        Verdict::Dominated { by, time, error } => {
            let time = match time {
                ratio if ratio >= 1.05 => format!("{ratio:.1}× faster"),
                _ => "as fast".to_owned(),
            };
            let error = match 100.0 * error {
                percent if percent < 99.5 => format!("with {percent:.0} % of the error"),
                _ => "with no more error".to_owned(),
            };
            format!("no: {} is {time}, {error}", name(by))
        }
    }
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
    match report.is_resolved(row) {
        true => amount(report.metric, report.error(row).value),
        false => format!("< {}", amount(report.metric, report.resolution())),
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

pub(super) fn seconds(s: f64) -> String {
    match s {
        10.0.. => format!("{s:.1}"),
        0.1.. => format!("{s:.3}"),
        _ => format!("{s:.5}"),
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
}
