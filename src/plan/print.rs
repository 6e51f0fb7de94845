//! Formats a Plan for `lucarne plan`.

use std::fmt::{self, Write};

use super::{Antialias, Called, Effect, Kind, Measured, Plan, Samples};
use crate::source::{Site, Sources, Span};
use crate::world::Coinciding;

/// Maximum number of locations printed for one effect; the rest are counted.
const PLACES_SHOWN: usize = 3;

/// Maximum number of characters quoted from the source.
const QUOTE: usize = 48;

/// Formats the settings and the stages; each effect, with its cause and cost or the reason why it is off;
/// what was dropped; and the numerical difficulties.
pub fn dump(plan: &Plan, sources: &Sources) -> String {
    let mut out = String::new();
    let printer = Printer { plan, sources };
    // Writing to a string cannot fail.
    let _ = printer.write(&mut out);
    out
}

struct Printer<'a> {
    plan: &'a Plan,
    sources: &'a Sources,
}

impl Printer<'_> {
    fn write(&self, out: &mut String) -> fmt::Result {
        self.knobs(out)?;
        if !self.plan.effects.is_empty() {
            writeln!(out, "on")?;
        }
        for called in &self.plan.effects {
            self.called(out, called)?;
        }
        if !self.plan.left_out.is_empty() {
            writeln!(out, "off")?;
        }
        for left in &self.plan.left_out {
            writeln!(out, "  {}: {}{}", left.effect.name(), left.why, self.at(left.site))?;
        }
        if !self.plan.dropped.is_empty() {
            writeln!(out, "dropped")?;
            for part in &self.plan.dropped {
                write!(out, "  {}: {}{}", part.what, part.why, self.at(Some(part.site)))?;
                if !part.calls.is_empty() {
                    write!(
                        out,
                        ", in {} at {}",
                        count(part.calls.len(), "call"),
                        self.list(&part.calls)
                    )?;
                }
                writeln!(out)?;
            }
        }
        self.kinds(out, "shapes", &self.plan.kinds)?;
        self.kinds(out, "surfaces", &self.plan.surfaces)?;
        self.numerics(out)?;
        self.rays(out)
    }

    fn knobs(&self, out: &mut String) -> fmt::Result {
        let plan = self.plan;
        let frame = plan.frame;
        write!(out, "picture {}×{}", frame.width, frame.height)?;
        let region = frame.region;
        if (region.width, region.height) != (frame.width, frame.height) {
            write!(out, ", {}×{} from {},{}", region.width, region.height, region.x, region.y)?;
        }
        writeln!(out)?;
        match plan.antialias {
            Antialias::Off => writeln!(out, "antialias off: one ray a pixel")?,
            Antialias::Grid(n) => writeln!(out, "antialias {n}: {n}×{n} rays a pixel")?,
            Antialias::Adaptive { threshold, grid } => writeln!(
                out,
                "antialias adaptive: up to {grid}×{grid} rays near edges, where neighbours differ by more than {threshold}"
            )?,
        }
        writeln!(out, "max_trace_level {}", plan.max_trace_level)?;
        writeln!(out, "adc_bailout {}", part(plan.adc_bailout))?;
        if plan.root_tolerance > 0.0 {
            writeln!(out, "root_tolerance {}", plan.root_tolerance)?;
        }
        if let Some(most) = plan.julia_iterations {
            writeln!(out, "julia_iterations {most}")?;
        }
        for (name, samples) in
            [("light_samples", plan.light_samples), ("blur_samples", plan.blur_samples)]
        {
            if samples != Samples::Scene {
                writeln!(out, "{name} {samples}")?;
            }
        }
        let stages: Vec<&str> = plan.stages.iter().map(|stage| stage.name()).collect();
        writeln!(out, "stages: {}", stages.join(", "))?;
        let (on, off) = (plan.effects.len(), plan.left_out.len());
        let dropped = plan.dropped.len();
        writeln!(out, "{} on, {off} off, {} dropped", count(on, "effect"), count(dropped, "part"))
    }

    fn called(&self, out: &mut String, called: &Called) -> fmt::Result {
        write!(out, "  {}: {}", called.effect.name(), called.cost)?;
        if let Some(rays) = called.rays {
            write!(out, "; {}", self.counted(rays))?;
        }
        writeln!(out)?;
        for &site in called.by.iter().take(PLACES_SHOWN) {
            writeln!(out, "    {}{}", self.quote(site), self.at(Some(site)))?;
        }
        match called.by.len() {
            0 if called.effect == Effect::Antialiasing => {
                let default = self.plan.antialias == Antialias::default();
                writeln!(out, "    by {}", if default { "default" } else { "the options" })
            }
            0..=PLACES_SHOWN => Ok(()),
            more => writeln!(out, "    and {} more", more - PLACES_SHOWN),
        }
    }

    fn kinds(&self, out: &mut String, title: &str, kinds: &[Kind]) -> fmt::Result {
        if !kinds.is_empty() {
            writeln!(out, "{title}")?;
        }
        for Kind { word, count, by, cost } in kinds {
            writeln!(out, "  {word}, {count}: {cost}")?;
            let places: Vec<Span> = by.iter().map(|site| site.span).collect();
            if !places.is_empty() {
                writeln!(out, "    ({})", self.list(&places))?;
            }
        }
        Ok(())
    }

    fn numerics(&self, out: &mut String) -> fmt::Result {
        let numerics = &self.plan.numerics;
        writeln!(out, "numerics")?;
        let at = |measured: &Measured| self.at(measured.site);
        if let (Some(least), Some(most)) = (&numerics.smallest, &numerics.largest) {
            let (small, large) = (number(least.value), number(most.value));
            writeln!(out, "  half widths from {small}{} to {large}{}", at(least), at(most))?;
        }
        if let Some(far) = &numerics.farthest {
            let value = number(far.value);
            writeln!(out, "  farthest for its size: {value} half widths away{}", at(far))?;
        }
        for (word, site) in &numerics.endless {
            writeln!(out, "  no half width: {}{}", without_end(word), self.at(*site))?;
        }
        for thin in numerics.thin.iter().take(PLACES_SHOWN) {
            let (what, times, place) = (thin.what, number(thin.slenderness), self.at(thin.site));
            writeln!(out, "  nearly degenerate: {what}, {times} times as long as thick{place}")?;
        }
        if let more @ 1.. = numerics.thin.len().saturating_sub(PLACES_SHOWN) {
            writeln!(out, "  and {more} more")?;
        }
        for Coinciding { words: [first, second], sites } in
            numerics.coinciding.iter().take(PLACES_SHOWN)
        {
            let [one, other] = sites.map(|site| self.at(Some(site)));
            writeln!(out, "  a face in common: {first}{one}, {second}{other}")?;
        }
        if let more @ 1.. = numerics.coinciding.len().saturating_sub(PLACES_SHOWN) {
            writeln!(out, "  and {more} more")?;
        }
        let near = &numerics.near_singular;
        for found in near.iter().take(PLACES_SHOWN) {
            let (quote, condition) = (self.quote(found.site), number(found.condition));
            let place = self.at(Some(found.site));
            writeln!(out, "  nearly flattens space: {quote}, condition {condition}{place}")?;
        }
        match near.len() {
            0 => writeln!(out, "  no transform nearly flattens space"),
            1..=PLACES_SHOWN => Ok(()),
            more => writeln!(out, "  and {} more", more - PLACES_SHOWN),
        }
    }

    fn rays(&self, out: &mut String) -> fmt::Result {
        let Some(pilot) = self.plan.pilot else { return Ok(()) };
        write!(out, "rays: {}", self.counted(pilot.rays))?;
        let whole = (pilot.width as usize) * (pilot.height as usize);
        write!(out, " (counted by a pilot of ")?;
        if pilot.pixels < whole {
            write!(out, "{} of ", pilot.pixels)?;
        }
        write!(out, "{}×{} pixels", pilot.width, pilot.height)?;
        if let Some(depth) = pilot.depth {
            let all = self.plan.max_trace_level;
            write!(out, ", only {depth} of {all} surfaces deep: there are more rays")?;
        }
        writeln!(out, ")")
    }

    /// Formats rays per camera ray, as rays per pixel and in total.
    fn counted(&self, rays: f64) -> String {
        let each = rays * self.plan.camera_rays_a_pixel();
        if each == 0.0 {
            return a_pixel(each);
        }
        // A pilot with reduced depth counts only some of the rays.
        let is_short = self.plan.pilot.is_some_and(|pilot| pilot.depth.is_some());
        let (least, about) = if is_short { ("at least ", "") } else { ("", "about ") };
        format!("{least}{}, {about}{}", a_pixel(each), round(rays * self.plan.camera_rays()))
    }

    /// Lists the first locations, and the number of the rest.
    fn list(&self, places: &[Span]) -> String {
        let first = places.iter().take(PLACES_SHOWN).map(|span| self.sources.place(*span));
        let first = first.collect::<Vec<_>>().join(", ");
        match places.len() {
            0..=PLACES_SHOWN => first,
            more => format!("{first} and {} more", more - PLACES_SHOWN),
        }
    }

    fn at(&self, site: Option<Site>) -> String {
        site.map_or(String::new(), |site| format!("  ({})", self.sources.place(site.span)))
    }

    /// Returns the source text of a location on one line, truncated to fit.
    fn quote(&self, site: Site) -> String {
        let words: Vec<&str> = self.sources.text(site.span).split_whitespace().collect();
        let text = words.join(" ");
        match text.char_indices().nth(QUOTE) {
            Some((cut, _)) => format!("`{}…`", text[..cut].trim_end()),
            None => format!("`{text}`"),
        }
    }
}

/// Formats a number of rays per pixel; small numbers are not rounded to zero.
#[doc(hidden)]
pub fn a_pixel(rays: f64) -> String {
    match rays {
        0.0 => "none sent by the pilot".to_owned(),
        ..0.005 => "below 0.01 a pixel".to_owned(),
        rays => format!("{rays:.2} a pixel"),
    }
}

/// Explains why a kind of shape has no half width.
#[doc(hidden)]
pub fn without_end(word: &str) -> String {
    match word {
        "plane" => "a plane has no end".to_owned(),
        _ => format!("where a {word} ends is not known"),
    }
}

/// Formats a number, as a fraction `1/n` if it is one.
#[doc(hidden)]
pub fn part(value: f64) -> String {
    match 1.0 / value {
        parts if parts > 1.0 && parts.round() == parts => format!("1/{parts}"),
        _ => format!("{value}"),
    }
}

/// Formats a count with its noun: `1 part`, `2 parts`.
pub(super) fn count(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
}

/// Formats a number with three digits, in the shortest form.
fn number(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    match rounded.abs() {
        size if (1e-3..1e6).contains(&size) || size == 0.0 => format!("{rounded}"),
        f64::INFINITY => "more than 1.79e308".to_owned(),
        _ => format!("{rounded:e}"),
    }
}

/// Formats a count rounded to two digits, with digits in groups of three.
fn round(count: f64) -> String {
    let rounded: f64 = format!("{count:.1e}").parse().unwrap_or(count);
    let digits = format!("{rounded:.0}");
    let mut grouped = String::new();
    for (i, digit) in digits.char_indices() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_rounded_and_grouped() {
        assert_eq!(round(0.0), "0");
        assert_eq!(round(640.0), "640");
        assert_eq!(round(228_480.0), "230,000");
        assert_eq!(round(12_345_678.0), "12,000,000");
    }

    #[test]
    fn numbers_have_three_digits() {
        assert_eq!(number(0.0), "0");
        assert_eq!(number(1.0 / 3.0), "0.333");
        assert_eq!(number(123_456.0), "123000");
        assert_eq!(number(1.234e12), "1.23e12");
        assert_eq!(number(f64::MAX), "more than 1.79e308");
    }
}
