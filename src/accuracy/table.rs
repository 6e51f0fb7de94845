//! Formats the report as a table for people.

use super::{Cut, Estimate, Line, Metric, Report, Setting, Span, Times, Tried, Verdict, answer};
use crate::math::elementary::log10;
use crate::plan::Frame;

/// Amount of detail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Width {
    /// Lines of at most 100 columns.
    Narrow,
    /// All counts, and full verdicts.
    Wide,
}

/// Maximum line width in columns.
const COLUMNS: usize = 100;
/// Minimum width of the column of names.
const NAME: usize = 17;
/// Indentation of continuation lines.
const SET_IN: usize = 4;

/// Formats the full report: first the recommendation, then the cost and the accuracy of each setting.
pub fn text(report: &Report, file: &str, threads: usize, width: Width) -> String {
    let mut lines = answer::of(report, &report.order());
    lines.push(String::new());
    lines.extend(heads(report, file, threads, width));
    lines.push(String::new());
    let labels = report.knobs.iter().flat_map(Tried::lines).map(|line| line.label.chars().count());
    let name = labels.max().unwrap_or(0).max(NAME);
    lines.push(match width {
        Width::Narrow => format!(
            "  {:name$} {:>6} {:>4} {:>6} {:>9} {:18} worth it?",
            "setting",
            "CPU s",
            "±",
            "rays",
            heading(report.metric),
            "95 % interval"
        ),
        Width::Wide => format!(
            "  {:name$} {:>14} {:>14} {:>4} {:>8} {:>8} {:>8} {:>8}  {:>9} {:18} worth it?",
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
        ),
    });
    for knob in &report.knobs {
        lines.push(knob.name.to_owned());
        lines.extend(knob.lines().map(|line| row(report, knob, &line, (width, name))));
        let also = |what: &str, labels: &[String]| {
            (!labels.is_empty()).then(|| format!("  {what}: {}", labels.join(", ")))
        };
        lines.extend(also("the same picture", &knob.vain));
        lines.extend(also("not tried within the budget", &knob.left_out));
    }
    lines.push(String::new());
    lines.extend(report.knobs.iter().map(|knob| knob.sentence.clone()));
    lines.extend(report.idle.iter().map(|sentence| format!("{sentence}.")));
    let broken = |line: &String| match width {
        Width::Narrow => wrapped(line),
        Width::Wide => format!("{line}\n"),
    };
    lines.iter().map(broken).collect()
}

/// Describes what was measured, and how to read the table.
fn heads(report: &Report, file: &str, threads: usize, width: Width) -> Vec<String> {
    let region = report.frame.region;
    let floor = report.floors[report.metric as usize];
    let Frame { width: wide, height: high, .. } = report.frame;
    let part = match (region.width, region.height) == (wide, high) {
        true => String::new(),
        false => format!(" of {wide}×{high}"),
    };
    let mut lines = vec![format!(
        "{file} {}×{}{part}: {} audited pixels (seed {}), reference of {} samples each, noise floor {}",
        region.width,
        region.height,
        report.audited,
        report.seed,
        report.reference_samples,
        amount(report.metric, floor)
    )];
    let cut = cut(report);
    if !cut.is_empty() {
        lines.push(format!("to keep the budget only {}", cut.join(", ")));
    }
    let (runs, threads_told) = (runs(report), count(threads, "thread"));
    match width {
        Width::Narrow => lines.extend([
            format!(
                "seconds: the middle of {runs}, {threads_told}; rays of a pixel; * is the scene's own, or `render`'s"
            ),
            "no: that is faster, with so much of the error where it is less; unsure: that is faster, and not proven worse"
                .to_owned(),
        ]),
        Width::Wide => lines.extend([
            format!(
                "seconds of {runs}, {threads_told}; cost is the work counted, in rays of the camera; * is the scene's own, or `render`'s"
            ),
            "faster is a middle run below the other's shortest, and less cost counted or 15 % less time"
                .to_owned(),
        ]),
    }
    let share = report.share_of_time(threads);
    if share < BUSY {
        lines.push(format!(
            "the machine is busy: of their time the threads had {:.0} %, and seconds say less than cost",
            100.0 * share
        ));
    }
    lines
}

/// Describes what was reduced to keep the budget, apart from settings.
pub(super) fn cut(report: &Report) -> Vec<String> {
    let Cut { pixels, samples, depth } = report.cut;
    let pixels = pixels.map(|all| format!("{} of {all} audited pixels", report.audited));
    let samples = samples.map(|samples| format!("{samples} samples of each in the reference"));
    let depth =
        depth.map(|(deep, most)| format!("{deep} of {most} surfaces deep in the reference"));
    [pixels, samples, depth].into_iter().flatten().collect()
}

/// Formats the settings of a line.
fn row(report: &Report, knob: &Tried, line: &Line, (width, name): (Width, usize)) -> String {
    let row = &report.rows[line.first.row];
    let star = if line.is_own { '*' } else { ' ' };
    let cpu = Span::of(&row.times.cpu);
    let rays = report.a_pixel(row.counters.rays() as f64);
    let error_told = error(report, line.first.row);
    let bounds = bounds(report, report.error(line.first.row));
    let verdict = verdict(report, knob, line.first, width);
    match width {
        Width::Narrow => format!(
            "{star} {:name$} {:>6} {:>4} {:>6} {error_told:>9} {bounds:18} {verdict}",
            line.label,
            seconds(cpu.median),
            apart(&row.times),
            short(rays),
        ),
        Width::Wide => format!(
            "{star} {:name$} {:>14} {:>14} {:>4} {rays:>8.2} {:>8.2} {:>8.2} {:>8.2}  {error_told:>9} {bounds:18} {verdict}",
            line.label,
            span(cpu),
            span(Span::of(&row.times.wall)),
            row.times.cpu.len(),
            report.a_pixel(row.counters.work.box_visits as f64),
            report.a_pixel(row.counters.work.root_solves as f64),
            report.a_pixel(report.cost(line.first.row)),
        ),
    }
}

/// Formats half of the spread of the runs, relative to the median; empty for a single run.
fn apart(times: &Times) -> String {
    let middle = Span::of(&times.cpu).median;
    match times.ends() {
        Some((least, most)) if times.cpu.len() > 1 && middle > 0.0 => {
            format!("{:.0}%", (50.0 * (most - least) / middle).min(99.0))
        }
        _ => String::new(),
    }
}

/// Formats a number with three or four digits.
fn short(n: f64) -> String {
    match n {
        100.0.. => format!("{n:.0}"),
        10.0.. => format!("{n:.1}"),
        _ => format!("{n:.2}"),
    }
}

/// Wraps a line between words, with indented continuation lines.
fn wrapped(line: &str) -> String {
    // A line of the table is short enough, and its blanks stay.
    if line.chars().count() <= COLUMNS {
        return format!("{line}\n");
    }
    let words = line.trim_start();
    let blanks = line.len() - words.len();
    let (mut out, mut length) = (" ".repeat(blanks), blanks);
    for (number, word) in words.split(' ').enumerate() {
        let long = word.chars().count();
        if number > 0 {
            if length + 1 + long > COLUMNS {
                length = blanks + SET_IN;
                out.push('\n');
                out.push_str(&" ".repeat(length));
            } else {
                length += 1;
                out.push(' ');
            }
        }
        out.push_str(word);
        length += long;
    }
    out + "\n"
}

/// Formats the verdict: on the front, or which setting is preferable, primarily among those of its own
/// knob.
fn verdict(report: &Report, knob: &Tried, setting: &Setting, width: Width) -> String {
    let name = |row: usize| {
        let mine = knob.settings.iter().find(|other| other.row == row);
        let name = mine.map_or(report.rows[row].name.as_str(), |mine| mine.label.as_str());
        match width {
            Width::Narrow => name.trim_start_matches("antialias ").trim_start_matches("adaptive "),
            Width::Wide => name,
        }
        .to_owned()
    };
    let verdict = match setting.verdict {
        Verdict::Front => report.rows[setting.row].verdict,
        other => other,
    };
    match (verdict, width) {
        (Verdict::Front, _) => "front".to_owned(),
        (Verdict::Tied { with }, _) => format!("tied with {}", name(with)),
        (Verdict::Unproven { over, times }, Width::Wide) => {
            format!("no proven gain over {}, for {}", name(over), more(times))
        }
        (Verdict::Unproven { over, times }, Width::Narrow) => {
            format!("unsure: {} {}", name(over), faster(times))
        }
        (Verdict::Dominated { by, times, error }, Width::Wide) => {
            let times = times.map_or_else(|| "is the same work".to_owned(), less);
            let below = if report.is_resolved(report.metric, by) { "" } else { "< " };
            let error = match 100.0 * error {
                percent if percent < 99.0 => format!("with {below}{percent:.0} % of the error"),
                percent if percent < 99.95 => format!("with {below}{percent:.1} % of the error"),
                _ => "with no more error".to_owned(),
            };
            format!("no: {} {times}, {error}", name(by))
        }
        (Verdict::Dominated { by, times, error }, Width::Narrow) => {
            let times = times.map_or_else(|| "same work".to_owned(), faster);
            let below = if report.is_resolved(report.metric, by) { "" } else { "< " };
            let error = match 100.0 * error {
                percent if percent < 99.0 => format!(", {below}{percent:.0} %"),
                _ => String::new(),
            };
            format!("no: {} {times}{error}", name(by))
        }
    }
}

/// Fraction of the threads' time below which a machine counts as busy.
const BUSY: f64 = 0.75;

/// Ratio from which a difference is printed as a ratio instead of a percentage.
const LARGE: f64 = 1.2;

/// Describes the cost of the faster of two settings.
fn less(ratio: f64) -> String {
    match ratio {
        LARGE.. => format!("is {} faster", times(ratio)),
        _ => format!("takes {} less time", percent(1.0 - 1.0 / ratio)),
    }
}

/// Description of the slower setting if it is not proven to take longer.
pub(super) const NO_LONGER: &str = "no clearly longer time";

/// Describes how much faster the faster of two settings is.
pub(super) fn faster(ratio: f64) -> String {
    match ratio {
        LARGE.. => format!("{} faster", times(ratio)),
        // Less is nothing that anybody would notice.
        _ => match 1.0 - 1.0 / ratio {
            part if 100.0 * part < 0.1 => "0.1 % faster".to_owned(),
            part => format!("{} faster", percent(part)),
        },
    }
}

/// Describes the cost of the slower of two settings.
pub(super) fn more(ratio: f64) -> String {
    match ratio {
        LARGE.. => format!("{} the time", times(ratio)),
        _ => format!("{} more time", percent(ratio - 1.0)),
    }
}

fn times(ratio: f64) -> String {
    if ratio < 10.0 { format!("{ratio:.1}×") } else { format!("{ratio:.0}×") }
}

/// Formats a small fraction as a percentage with one or two digits.
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

/// Formats the error of a row, or that it is below the resolution of the reference.
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

/// Formats an error: fractions in percent, others with two or three digits.
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

/// Formats the minimum and the median of the runs.
pub(super) fn span(Span { min, median }: Span) -> String {
    format!("{}..{}", seconds(min), seconds(median))
}

/// Formats seconds with three digits.
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

/// Formats `5 interleaved runs`, or `1 to 9 interleaved runs`.
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
    fn a_long_line_is_broken_between_words_and_stays_set_in() {
        let long = format!("  {}", "setting, ".repeat(30).trim_end());
        let lines: Vec<String> = wrapped(&long).lines().map(str::to_owned).collect();
        assert!(lines.len() > 2 && lines.iter().all(|line| line.chars().count() <= COLUMNS));
        assert!(lines[0].starts_with("  setting,") && lines[1].starts_with("      setting,"));
        assert_eq!(lines.iter().flat_map(|line| line.split_whitespace()).count(), 30);
        assert_eq!(wrapped("  short  of blanks"), "  short  of blanks\n");
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
