//! Draws the report as a work-precision diagram: error against time, both logarithmic.
//!
//! **Out:** one SVG for light and dark pages and for print. **Invariant:** knobs differ in color and in
//! shape; every point has a tooltip; no text leaves the page, overlaps another text or covers a marker.
//!
//! **Source:** the form follows E. Hairer, G. Wanner, Solving Ordinary Differential Equations II; the
//! colors are those of M. Okabe and K. Ito, which color-blind readers can distinguish.

mod axis;
mod label;

use std::fmt::{Result, Write};

use super::json::Host;
use super::{Metric, Report, Span, Verdict, table};
use axis::{Axis, number};
use label::Side::{self, End, Middle, Start};
use label::{Layout, Line, Rectangle, baseline, fitted, text_box, width};

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 520.0;
const LEFT: f64 = 78.0;
const RIGHT: f64 = WIDTH - 30.0;
const BOTTOM: f64 = HEIGHT - 62.0;
/// Position of the first line of the legend, and distance between lines.
const LEGEND: f64 = 72.0;
const LEGEND_LINE: f64 = 20.0;
/// Font sizes: default, title, and small print.
const TEXT: f64 = 13.0;
const BIG: f64 = 16.0;
const SMALL: f64 = 11.0;
/// Radius around a point: of its marker, and of the ring around the picture as rendered.
const MARKER: f64 = 5.4;
const RING: f64 = 8.0;

const STYLE: &str = "\
text{font:13px Helvetica,Arial,'Liberation Sans',sans-serif;fill:#222}
.big{font-size:16px;font-weight:600}.small{font-size:11px}.dim{fill:#666}
.page{fill:#fff}.plot{fill:none;stroke:#444}.grid{stroke:#e4e4e4}.minor{stroke:#f2f2f2}
.floor{fill:#888;fill-opacity:.13}.edge{stroke:#888;stroke-dasharray:5 3}
.label{font-size:11px;paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}
.leader{stroke:#888;stroke-width:.7}
.front{fill:none;stroke:#222;stroke-width:1.6}.bar{stroke-width:1.2}.own{fill:none;stroke:#222;stroke-width:1.6}
.rest{opacity:.55}.open{fill:#fff}
.k0{fill:#0072b2;stroke:#0072b2}.k1{fill:#d55e00;stroke:#d55e00}.k2{fill:#009e73;stroke:#009e73}
.k3{fill:#cc79a7;stroke:#cc79a7}.k4{fill:#b07a00;stroke:#b07a00}.k5{fill:#56b4e9;stroke:#56b4e9}
.k6{fill:#7b5ea7;stroke:#7b5ea7}.k7{fill:#8c5a2b;stroke:#8c5a2b}
@media (prefers-color-scheme:dark){text{fill:#eee}.dim{fill:#aaa}.page,.open{fill:#161616}.plot{stroke:#aaa}
.grid{stroke:#333}.minor{stroke:#242424}.front,.own{stroke:#eee}.label{stroke:#161616}
.k0{fill:#4aa8e0;stroke:#4aa8e0}.k1{fill:#ff8a3d;stroke:#ff8a3d}.k2{fill:#2fd0a0;stroke:#2fd0a0}
.k4{fill:#f0b429;stroke:#f0b429}.k6{fill:#b39ddb;stroke:#b39ddb}.k7{fill:#d2a679;stroke:#d2a679}}";

/// Returns the diagram as the text of an SVG file.
pub fn text(report: &Report, file: &str, host: &Host) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = Diagram::new(report).write(&mut out, file, host);
    out
}

/// The report and the layout of the diagram.
struct Diagram<'a> {
    report: &'a Report,
    x: Axis,
    y: Axis,
    /// Upper edge of the plot.
    top: f64,
    /// Entries of the legend, each with its position.
    legend: Vec<(Key, (f64, f64))>,
    /// Rows that no other dominates, in order of time.
    standing: Vec<usize>,
}

/// Entry of the legend.
#[derive(Clone, Copy)]
enum Key {
    Knob(usize),
    Own,
    Front,
}

impl<'a> Diagram<'a> {
    fn new(report: &'a Report) -> Self {
        let keys = (0..report.knobs.len()).map(Key::Knob).chain([Key::Own, Key::Front]);
        let (mut legend, mut place) = (Vec::new(), (LEFT + 8.0, LEGEND));
        for key in keys {
            let wide = 14.0 + width(key.text(report), TEXT);
            if place.0 + wide > RIGHT && place.0 > LEFT + 8.0 {
                place = (LEFT + 8.0, place.1 + LEGEND_LINE);
            }
            legend.push((key, place));
            place.0 += wide + 22.0;
        }
        let top = place.1 + 16.0;
        let rows = || 0..report.rows.len();
        let spans = rows().map(|row| Span::of(&report.rows[row].times.cpu));
        let x = Axis::around(spans.flat_map(|span| [span.min, span.median]), LEFT, RIGHT);
        // An interval that nearly reaches zero does not make the diagram high.
        let errors = rows().map(|row| report.error(row));
        let ends =
            errors.flat_map(|error| [error.value, error.low.max(error.value / 10.0), error.high]);
        let y = Axis::around(ends, BOTTOM, top);
        let stands = |row: &usize| !matches!(report.rows[*row].verdict, Verdict::Dominated { .. });
        let mut standing: Vec<usize> = rows().filter(stands).collect();
        let time = |row: usize| Span::of(&report.rows[row].times.cpu).min;
        standing.sort_by(|&a, &b| time(a).total_cmp(&time(b)));
        Self { report, x, y, top, legend, standing }
    }

    fn is_on_front(&self, row: usize) -> bool {
        self.report.rows[row].verdict == Verdict::Front
    }

    fn write(&self, out: &mut String, file: &str, host: &Host) -> Result {
        writeln!(
            out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" role=\"img\">"
        )?;
        writeln!(out, "<title>Error against time of {}</title>", escaped(file))?;
        writeln!(out, "<style>{STYLE}</style>")?;
        writeln!(out, "<rect class=\"page\" width=\"{WIDTH}\" height=\"{HEIGHT}\"/>")?;
        self.heads(out, file, host)?;
        for &(key, (x, y)) in &self.legend {
            let sign = match key {
                Key::Knob(number) => {
                    format!(
                        "<g class=\"k{}\">{}</g>",
                        number % SHAPES,
                        marker(number, x, y - 4.0, "")
                    )
                }
                Key::Own => {
                    format!("<circle class=\"own\" cx=\"{x:.1}\" cy=\"{:.1}\" r=\"7\"/>", y - 4.0)
                }
                Key::Front => line("front", ((x - 8.0, y - 4.0), (x + 8.0, y - 4.0))),
            };
            writeln!(out, "{sign}{}", words("", Start, (x + 14.0, y), key.text(self.report)))?;
        }
        self.axes(out)?;
        let floor = self.report.resolution(self.report.metric);
        let shows_floor = floor > self.y.low;
        if shows_floor {
            let top = self.y.at(floor);
            let (wide, high) = (RIGHT - LEFT, BOTTOM - top);
            writeln!(
                out,
                "<rect class=\"floor\" x=\"{LEFT}\" y=\"{top:.1}\" width=\"{wide:.1}\" height=\"{high:.1}\"/>{}",
                line("edge", ((LEFT, top), (RIGHT, top)))
            )?;
        }
        let path = self.path();
        if !path.is_empty() {
            let to = |(x, y): &(f64, f64)| format!("{x:.1} {y:.1}");
            let path: Vec<String> = path.iter().map(to).collect();
            writeln!(out, "<path class=\"front\" d=\"M{}\"/>", path.join(" L"))?;
        }
        self.points(out)?;
        self.labels(out, shows_floor.then_some(floor))?;
        writeln!(out, "</svg>")
    }

    fn heads(&self, out: &mut String, file: &str, host: &Host) -> Result {
        let report = self.report;
        let (region, room) = (report.frame.region, RIGHT - LEFT);
        let size = format!(", {}×{}", region.width, region.height);
        let file = fitted(file, BIG, room - width(&size, BIG));
        writeln!(out, "{}", words("big", Start, (LEFT, 26.0), &(file + &size)))?;
        let plural = |count: usize| if count == 1 { "" } else { "s" };
        let about = format!(
            "{} audited pixels, reference of {} samples; {}, {} thread{}; lucarne {}; {}",
            report.audited,
            report.reference_samples,
            table::runs(report),
            host.threads,
            plural(host.threads),
            host.version,
            host.cpu
        );
        writeln!(out, "{}", words("small dim", Start, (LEFT, 46.0), &fitted(&about, SMALL, room)))
    }

    fn axes(&self, out: &mut String) -> Result {
        for (value, named) in self.x.ticks() {
            let (at, class) = (self.x.at(value), if named { "grid" } else { "minor" });
            writeln!(out, "{}", line(class, ((at, self.top), (at, BOTTOM))))?;
            if named {
                let name = words("", Middle, (at, BOTTOM + 18.0), &number(value));
                writeln!(out, "{name}")?;
            }
        }
        for (value, named) in self.y.ticks() {
            let (at, class) = (self.y.at(value), if named { "grid" } else { "minor" });
            writeln!(out, "{}", line(class, ((LEFT, at), (RIGHT, at))))?;
            if named {
                let name = words("", End, (LEFT - 7.0, at + 4.0), &number(value));
                writeln!(out, "{name}")?;
            }
        }
        let (wide, high) = (RIGHT - LEFT, BOTTOM - self.top);
        writeln!(
            out,
            "<rect class=\"plot\" x=\"{LEFT}\" y=\"{}\" width=\"{wide}\" height=\"{high}\"/>",
            self.top
        )?;
        let name = "CPU seconds, least and median run";
        let place = ((LEFT + RIGHT) / 2.0, BOTTOM + 40.0);
        writeln!(out, "{}", words("", Middle, place, name))?;
        let name = match self.report.metric {
            Metric::Rmse => "RMSE of linear colour, with 95 % interval",
            Metric::P99 => "99th percentile of the error, with 95 % interval",
            Metric::Bad => "share of pixels off by more than 2/255, with 95 % interval",
        };
        let centre = (self.top + BOTTOM) / 2.0;
        writeln!(
            out,
            "<text text-anchor=\"middle\" transform=\"translate(20 {centre:.1}) rotate(-90)\">{name}</text>"
        )
    }

    fn place(&self, row: usize) -> (f64, f64) {
        let time = Span::of(&self.report.rows[row].times.cpu).min;
        (self.x.at(time), self.y.at(self.report.error(row).value))
    }

    /// Returns the line of the least error so far over time. No point lies below and to the left of it,
    /// because a dominated setting takes longer than another and is no better.
    fn path(&self) -> Vec<(f64, f64)> {
        let mut path: Vec<(f64, f64)> = Vec::new();
        for (x, y) in self.standing.iter().map(|&row| self.place(row)) {
            match path.last() {
                Some(&(_, last)) if y <= last => (),
                Some(&(_, last)) => path.extend([(x, last), (x, y)]),
                None => path.push((x, y)),
            }
        }
        path
    }

    /// Returns the error interval of a row, and the span of its run times.
    fn bars(&self, row: usize) -> [Line; 2] {
        let (x, y) = self.place(row);
        let error = self.report.error(row);
        let median = self.x.at(Span::of(&self.report.rows[row].times.cpu).median);
        [((x, self.y.at(error.low)), (x, self.y.at(error.high))), ((x, y), (median, y))]
    }

    fn points(&self, out: &mut String) -> Result {
        for (number, knob) in self.report.knobs.iter().enumerate() {
            for settings in knob.lines() {
                let row = settings.first.row;
                let rest = if self.is_on_front(row) { "" } else { " rest" };
                let (x, y) = self.place(row);
                let [interval, runs] = self.bars(row).map(|bar| line("bar", bar));
                writeln!(
                    out,
                    "<g class=\"k{}{rest}\"><title>{} {}: {} s, {}</title>{interval}{runs}{}</g>",
                    number % SHAPES,
                    knob.name,
                    escaped(&settings.label),
                    table::span(Span::of(&self.report.rows[row].times.cpu)),
                    escaped(&table::error(self.report, row)),
                    // What is not resolved is somewhere below.
                    match self.report.is_resolved(self.report.metric, row) {
                        true => marker(number, x, y, ""),
                        false => marker(number, x, y, " class=\"open\""),
                    }
                )?;
            }
        }
        if !self.report.rows.is_empty() {
            let (x, y) = self.place(0);
            writeln!(out, "<circle class=\"own\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{RING}\"/>")?;
        }
        Ok(())
    }

    /// Draws the names of the points of the front.
    fn labels(&self, out: &mut String, floor: Option<f64>) -> Result {
        let frame = Rectangle { left: LEFT, top: self.top, right: RIGHT, bottom: BOTTOM };
        let rows = || self.report.knobs.iter().flat_map(|knob| &knob.settings).map(|s| s.row);
        let reach = |row: usize| if row == 0 { RING + 1.0 } else { MARKER };
        let taken = rows().map(|row| Rectangle::about(self.place(row), reach(row))).collect();
        let path = self.path();
        let front = path.windows(2).map(|ends| (ends[0], ends[1]));
        let lines = front.chain(rows().flat_map(|row| self.bars(row))).collect();
        let mut layout = Layout { frame, taken, lines };
        if let Some(floor) = floor {
            let (name, y) = ("four times the reference’s noise", self.y.at(floor));
            let below = |x: f64| text_box(name, SMALL, Start, (x, y + 13.0));
            let wide = width(name, SMALL);
            let places = (0..=8)
                .map(|part| LEFT + 6.0 + f64::from(part) / 8.0 * (RIGHT - LEFT - wide - 12.0));
            let fits = |place: &Rectangle| {
                frame.holds(place) && !layout.taken.iter().any(|taken| taken.meets(place))
            };
            if let Some(place) = places.map(below).find(fits) {
                layout.taken.push(place);
                writeln!(
                    out,
                    "{}",
                    words("small dim", Start, baseline(&place, Start, SMALL), name)
                )?;
            }
        }
        for &row in self.standing.iter().filter(|&&row| self.is_on_front(row)) {
            let named = self.report.knobs.iter().find_map(|knob| {
                let setting = knob.settings.iter().find(|setting| setting.row == row)?;
                Some(format!("{} {}", knob.name, setting.label))
            });
            let name = if row == 0 { Some("as rendered".to_owned()) } else { named };
            let Some(name) = name else { continue };
            let at = self.place(row);
            let Some(place) = layout.place(&name, SMALL, at) else { continue };
            let end = place.nearest(at);
            let (dx, dy) = (end.0 - at.0, end.1 - at.1);
            let away = (dx * dx + dy * dy).sqrt();
            if away > 14.0 {
                let part = reach(row) / away;
                let start = (at.0 + part * (end.0 - at.0), at.1 + part * (end.1 - at.1));
                writeln!(out, "{}", line("leader", (start, end)))?;
            }
            let side = match (place.right <= at.0, place.left >= at.0) {
                (true, _) => End,
                (false, true) => Start,
                (false, false) => Middle,
            };
            writeln!(out, "{}", words("label", side, baseline(&place, side, SMALL), &name))?;
        }
        Ok(())
    }
}

impl Key {
    fn text(self, report: &Report) -> &'static str {
        match self {
            Self::Knob(number) => report.knobs[number].name,
            Self::Own => "as rendered",
            Self::Front => "front; pale is not proven",
        }
    }
}

/// Number of marker shapes; equal to the number of colors.
const SHAPES: usize = 8;

/// Draws the marker of a knob.
fn marker(number: usize, x: f64, y: f64, with: &str) -> String {
    match number % SHAPES {
        0 => format!("<circle{with} cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.2\"/>"),
        1 => format!(
            "<rect{with} x=\"{:.1}\" y=\"{:.1}\" width=\"7.6\" height=\"7.6\"/>",
            x - 3.8,
            y - 3.8
        ),
        2 => format!("<path{with} d=\"M{x:.1} {:.1}l4.8 8.4h-9.6z\"/>", y - 5.4),
        3 => format!("<path{with} d=\"M{x:.1} {:.1}l5 5l-5 5l-5-5z\"/>", y - 5.0),
        4 => format!("<path{with} d=\"M{x:.1} {:.1}l-4.8-8.4h9.6z\"/>", y + 5.4),
        5 => format!("<path{with} d=\"M{:.1} {y:.1}l-8.4 4.8v-9.6z\"/>", x + 5.4),
        6 => format!("<path{with} d=\"M{:.1} {y:.1}l8.4 4.8v-9.6z\"/>", x - 5.4),
        _ => format!(
            "<path{with} d=\"M{:.1} {:.1}h2.8v3.2h3.2v2.8h-3.2v3.2h-2.8v-3.2h-3.2v-2.8h3.2z\"/>",
            x - 1.4,
            y - 4.6
        ),
    }
}

fn line(class: &str, ((x1, y1), (x2, y2)): Line) -> String {
    format!("<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>")
}

fn words(class: &str, side: Side, (x, y): (f64, f64), text: &str) -> String {
    let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
    let anchor = match side {
        Start => "",
        Middle => " text-anchor=\"middle\"",
        End => " text-anchor=\"end\"",
    };
    format!("<text{class}{anchor} x=\"{x:.1}\" y=\"{y:.1}\">{}</text>", escaped(text))
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
pub(super) mod tests;
