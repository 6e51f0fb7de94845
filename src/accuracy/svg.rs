//! The report as a work-precision diagram: error against time, both logarithmic.
//!
//! **Out:** one SVG that stands on a light page and on a dark one, and is fit for print. **Invariant:**
//! colours are told apart by shape too, and every point says what it is when pointed at.
//!
//! **Source:** the form is that of E. Hairer, G. Wanner, Solving Ordinary Differential Equations II;
//! the colours are M. Okabe's and K. Ito's, which the colour-blind tell apart.

use std::fmt::Write;

use super::json::Host;
use super::{Metric, Report, Span, Verdict, table};
use crate::math::elementary::{log10, pow};

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 500.0;
const LEFT: f64 = 78.0;
const RIGHT: f64 = WIDTH - 30.0;
const TOP: f64 = 64.0;
const BOTTOM: f64 = HEIGHT - 62.0;

const STYLE: &str = "\
text{font:13px 'Source Sans 3','Helvetica Neue',Arial,sans-serif;fill:#222}
.big{font-size:16px;font-weight:600}.small{font-size:11px}.dim{fill:#666}
.page{fill:#fff}.plot{fill:none;stroke:#444}.grid{stroke:#e4e4e4}.minor{stroke:#f2f2f2}
.floor{fill:#8882}.edge{stroke:#888;stroke-dasharray:5 3}
.front{fill:none;stroke:#222;stroke-width:1.6}.bar{stroke-width:1.2}.own{fill:none;stroke:#222;stroke-width:1.6}
.k0{fill:#0072b2;stroke:#0072b2}.k1{fill:#d55e00;stroke:#d55e00}.k2{fill:#009e73;stroke:#009e73}
.k3{fill:#cc79a7;stroke:#cc79a7}.k4{fill:#b07a00;stroke:#b07a00}.k5{fill:#56b4e9;stroke:#56b4e9}
@media (prefers-color-scheme:dark){text{fill:#eee}.dim{fill:#aaa}.page{fill:#161616}.plot{stroke:#aaa}
.grid{stroke:#333}.minor{stroke:#242424}.front,.own{stroke:#eee}
.k0{fill:#4aa8e0;stroke:#4aa8e0}.k1{fill:#ff8a3d;stroke:#ff8a3d}.k2{fill:#2fd0a0;stroke:#2fd0a0}
.k4{fill:#f0b429;stroke:#f0b429}}";

/// A logarithmic scale between two places of the page.
struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// Holds all values with room around them.
    fn around(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let valid = values.filter(|value| value.is_finite() && *value > 0.0);
        let (low, high) = valid
            .fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), v| (low.min(v), high.max(v)));
        let (low, high) = if low <= high { (low / 1.4, high * 1.4) } else { (0.1, 10.0) };
        Self { low, high, from, to }
    }

    fn at(&self, value: f64) -> f64 {
        let value = value.clamp(self.low, self.high);
        let part = log10(value / self.low) / log10(self.high / self.low);
        self.from + part * (self.to - self.from)
    }

    /// Lines at 1 … 9 times powers of ten; those with numbers are at 1, and at 2 and 5 where there
    /// is room.
    fn ticks(&self) -> Vec<(f64, bool)> {
        let decades = log10(self.high / self.low);
        let mut ticks = Vec::new();
        for exponent in log10(self.low).floor() as i32..=log10(self.high).ceil() as i32 {
            for digit in 1..10 {
                let value = f64::from(digit) * pow(10.0, f64::from(exponent));
                let named = digit == 1 || (decades < 3.0 && (digit == 2 || digit == 5));
                if (self.low..=self.high).contains(&value) {
                    ticks.push((value, named));
                }
            }
        }
        ticks
    }
}

/// The diagram as a file.
pub fn text(report: &Report, file: &str, host: &Host) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut out, report, file, host);
    out
}

fn write(out: &mut String, report: &Report, file: &str, host: &Host) -> std::fmt::Result {
    let rows = 0..report.rows.len();
    let span = |row: usize| Span::of(&report.rows[row].times.cpu);
    let error = |row: usize| report.error(row);
    let shown = |row: usize| error(row).value.max(report.resolution());
    let times = rows.clone().flat_map(|row| [span(row).min, span(row).median]);
    let x = Axis::around(times, LEFT, RIGHT);
    let errors = rows.clone().flat_map(|row| {
        let resolved = report.is_resolved(row);
        [
            shown(row),
            if resolved { error(row).low.max(shown(row) / 10.0) } else { shown(row) },
            error(row).high,
        ]
    });
    let y = Axis::around(errors, BOTTOM, TOP);
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" role=\"img\">"
    )?;
    writeln!(
        out,
        "<title>Error against time of {}</title>\n<style>{STYLE}</style>",
        escaped(file)
    )?;
    writeln!(out, "<rect class=\"page\" width=\"{WIDTH}\" height=\"{HEIGHT}\"/>")?;
    heads(out, report, file, host)?;
    axes(out, report, &x, &y)?;
    if report.resolution() >= y.low && report.resolution() <= y.high {
        let top = y.at(report.resolution());
        writeln!(
            out,
            "<rect class=\"floor\" x=\"{LEFT}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\"/><line class=\"edge\" x1=\"{LEFT}\" y1=\"{top:.1}\" x2=\"{RIGHT}\" y2=\"{top:.1}\"/>",
            RIGHT - LEFT,
            BOTTOM - top
        )?;
        writeln!(
            out,
            "<text class=\"small dim\" x=\"{:.1}\" y=\"{:.1}\">four times the reference’s noise</text>",
            LEFT + 6.0,
            top + 13.0
        )?;
    }
    front(out, report, &x, &y)?;
    for (number, knob) in report.knobs.iter().enumerate() {
        for setting in &knob.settings {
            let row = setting.row;
            let (px, py) = (x.at(span(row).min), y.at(shown(row)));
            writeln!(out, "<g class=\"k{}\">", number % 6)?;
            writeln!(
                out,
                "<title>{} {}: {} s, {}</title>",
                knob.name,
                escaped(&setting.label),
                table::seconds(span(row).min),
                escaped(&table::error(report, row))
            )?;
            let (low, high) = (y.at(error(row).low.max(y.low)), y.at(error(row).high));
            if report.is_resolved(row) {
                writeln!(
                    out,
                    "<line class=\"bar\" x1=\"{px:.1}\" y1=\"{low:.1}\" x2=\"{px:.1}\" y2=\"{high:.1}\"/>"
                )?;
            }
            writeln!(
                out,
                "<line class=\"bar\" x1=\"{px:.1}\" y1=\"{py:.1}\" x2=\"{:.1}\" y2=\"{py:.1}\"/>{}\n</g>",
                x.at(span(row).median),
                marker(number, px, py)
            )?;
        }
    }
    if !report.rows.is_empty() {
        let (px, py) = (x.at(span(0).min), y.at(shown(0)));
        writeln!(out, "<circle class=\"own\" cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"8\"/>")?;
    }
    labels(out, report, &x, &y)?;
    legend(out, report)?;
    writeln!(out, "</svg>")
}

fn heads(out: &mut String, report: &Report, file: &str, host: &Host) -> std::fmt::Result {
    let region = report.frame.region;
    writeln!(
        out,
        "<text class=\"big\" x=\"{LEFT}\" y=\"26\">{}, {}×{}</text>",
        escaped(file),
        region.width,
        region.height
    )?;
    writeln!(
        out,
        "<text class=\"small dim\" x=\"{LEFT}\" y=\"46\">{} audited pixels, reference of {} samples; {} run{}, {} thread{}; {}; lucarne {}</text>",
        report.audited,
        report.reference_samples,
        report.runs,
        if report.runs == 1 { "" } else { "s" },
        host.threads,
        if host.threads == 1 { "" } else { "s" },
        escaped(&host.cpu),
        escaped(&host.version)
    )
}

fn axes(out: &mut String, report: &Report, x: &Axis, y: &Axis) -> std::fmt::Result {
    for (value, named) in x.ticks() {
        let (at, class) = (x.at(value), if named { "grid" } else { "minor" });
        writeln!(
            out,
            "<line class=\"{class}\" x1=\"{at:.1}\" y1=\"{TOP}\" x2=\"{at:.1}\" y2=\"{BOTTOM}\"/>"
        )?;
        if named {
            writeln!(
                out,
                "<text text-anchor=\"middle\" x=\"{at:.1}\" y=\"{:.1}\">{}</text>",
                BOTTOM + 18.0,
                number(value)
            )?;
        }
    }
    for (value, named) in y.ticks() {
        let (at, class) = (y.at(value), if named { "grid" } else { "minor" });
        writeln!(
            out,
            "<line class=\"{class}\" x1=\"{LEFT}\" y1=\"{at:.1}\" x2=\"{RIGHT}\" y2=\"{at:.1}\"/>"
        )?;
        if named {
            writeln!(
                out,
                "<text text-anchor=\"end\" x=\"{:.1}\" y=\"{:.1}\">{}</text>",
                LEFT - 7.0,
                at + 4.0,
                number(value)
            )?;
        }
    }
    writeln!(
        out,
        "<rect class=\"plot\" x=\"{LEFT}\" y=\"{TOP}\" width=\"{:.1}\" height=\"{:.1}\"/>",
        RIGHT - LEFT,
        BOTTOM - TOP
    )?;
    let (middle, centre) = ((LEFT + RIGHT) / 2.0, (TOP + BOTTOM) / 2.0);
    writeln!(
        out,
        "<text text-anchor=\"middle\" x=\"{middle:.1}\" y=\"{:.1}\">CPU seconds, least and median run</text>",
        BOTTOM + 40.0
    )?;
    let name = match report.metric {
        Metric::Rmse => "RMSE of linear colour, with 95 % interval",
        Metric::P99 => "99th percentile of the error, with 95 % interval",
        Metric::Bad => "share of pixels off by more than 2/255, with 95 % interval",
    };
    writeln!(
        out,
        "<text text-anchor=\"middle\" transform=\"translate(20 {centre:.1}) rotate(-90)\">{name}</text>"
    )
}

/// From each proven setting to the next: what is paid first, then what it buys.
fn front(out: &mut String, report: &Report, x: &Axis, y: &Axis) -> std::fmt::Result {
    let mut path = String::new();
    for (i, row) in proven(report).into_iter().enumerate() {
        let (px, py) = place(report, row, x, y);
        match i {
            0 => write!(path, "M{px:.1} {py:.1}")?,
            _ => write!(path, " H{px:.1} V{py:.1}")?,
        }
    }
    match path.is_empty() {
        true => Ok(()),
        false => writeln!(out, "<path class=\"front\" d=\"{path}\"/>"),
    }
}

/// The rows on the front by their time.
fn proven(report: &Report) -> Vec<usize> {
    let on_front = |&row: &usize| report.rows[row].verdict == Verdict::Front;
    let mut rows: Vec<usize> = (0..report.rows.len()).filter(on_front).collect();
    let time = |row: usize| Span::of(&report.rows[row].times.cpu).min;
    rows.sort_by(|&a, &b| time(a).total_cmp(&time(b)));
    rows
}

fn place(report: &Report, row: usize, x: &Axis, y: &Axis) -> (f64, f64) {
    let time = Span::of(&report.rows[row].times.cpu).min;
    (x.at(time), y.at(report.error(row).value.max(report.resolution())))
}

/// Names beside the points of the front, above and to the right, where the front is not.
fn labels(out: &mut String, report: &Report, x: &Axis, y: &Axis) -> std::fmt::Result {
    for row in proven(report) {
        let (px, py) = place(report, row, x, y);
        let knob = report.knobs.iter().find_map(|knob| {
            let setting = knob.settings.iter().find(|setting| setting.row == row)?;
            Some(match row {
                0 => "as rendered".to_owned(),
                _ => format!("{} {}", knob.name, setting.label),
            })
        });
        let (anchor, dx) = if px > RIGHT - 130.0 { ("end", -4.0) } else { ("start", 8.0) };
        let label = knob.unwrap_or_default();
        writeln!(
            out,
            "<text class=\"small\" text-anchor=\"{anchor}\" x=\"{:.1}\" y=\"{:.1}\">{}</text>",
            px + dx,
            py - 8.0,
            escaped(&label)
        )?;
    }
    Ok(())
}

fn legend(out: &mut String, report: &Report) -> std::fmt::Result {
    let (x, mut y) = (RIGHT - 150.0, TOP + 20.0);
    for (number, knob) in report.knobs.iter().enumerate() {
        writeln!(
            out,
            "<g class=\"k{}\">{}</g><text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
            number % 6,
            marker(number, x, y - 4.0),
            x + 14.0,
            y,
            knob.name
        )?;
        y += 19.0;
    }
    writeln!(
        out,
        "<circle class=\"own\" cx=\"{x}\" cy=\"{:.1}\" r=\"7\"/><text x=\"{:.1}\" y=\"{y:.1}\">as rendered</text>",
        y - 4.0,
        x + 14.0
    )?;
    y += 19.0;
    writeln!(
        out,
        "<line class=\"front\" x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\"/><text x=\"{:.1}\" y=\"{y:.1}\">proven front</text>",
        x - 8.0,
        y - 4.0,
        x + 8.0,
        y - 4.0,
        x + 14.0
    )
}

/// A shape for each knob.
fn marker(number: usize, x: f64, y: f64) -> String {
    match number % 4 {
        0 => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.2\"/>"),
        1 => format!(
            "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"7.6\" height=\"7.6\"/>",
            x - 3.8,
            y - 3.8
        ),
        2 => format!("<path d=\"M{x:.1} {:.1}l4.8 8.4h-9.6z\"/>", y - 5.4),
        _ => format!("<path d=\"M{x:.1} {:.1}l5 5-5 5-5-5z\"/>", y - 5.0),
    }
}

/// A power of ten, or a digit times one, in as few characters as will do.
fn number(value: f64) -> String {
    if (0.000_9..10_000.0).contains(&value) {
        let digits = (-log10(value * 1.000_001).floor()).max(0.0) as usize;
        format!("{value:.digits$}")
    } else {
        format!("{value:.0e}")
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_is_even_in_ratios_and_names_its_powers_of_ten() {
        let axis = Axis::around([0.001, 10.0, f64::NAN, 0.0, -1.0].into_iter(), 0.0, 100.0);
        let steps: Vec<f64> = [0.01, 0.1, 1.0].map(|v| axis.at(v * 10.0) - axis.at(v)).to_vec();
        assert!((steps[0] - steps[1]).abs() < 1e-9 && (steps[1] - steps[2]).abs() < 1e-9);
        let named: Vec<String> =
            axis.ticks().into_iter().filter(|tick| tick.1).map(|tick| number(tick.0)).collect();
        assert_eq!(named, ["0.001", "0.01", "0.1", "1", "10"]);
        assert!(Axis::around(std::iter::empty(), 0.0, 1.0).at(1.0).is_finite());
    }

    #[test]
    fn numbers_are_short() {
        let short = [0.002, 0.05, 0.5, 2.0, 5000.0, 2e-5, 1e7].map(number);
        assert_eq!(short, ["0.002", "0.05", "0.5", "2", "5000", "2e-5", "1e7"]);
        assert_eq!(escaped("a<b & \"c\">"), "a&lt;b &amp; &quot;c&quot;&gt;");
    }
}
