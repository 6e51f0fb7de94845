//! A Plan for people to read: `lucarne plan`.

use std::fmt::{self, Write};

use super::{Antialias, Called, Plan};
use crate::source::{Site, Sources};

/// Places named for one effect; the rest are counted.
const PLACES_SHOWN: usize = 3;

/// The knobs, then each effect with what called for it and what it costs, then what was left out
/// and why.
pub fn dump(plan: &Plan, sources: &Sources) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut out, plan, sources);
    out
}

fn write(out: &mut String, plan: &Plan, sources: &Sources) -> fmt::Result {
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
            "antialias adaptive: {grid}×{grid} rays where neighbours differ by more than {threshold}"
        )?,
    }
    writeln!(out, "max_trace_level {}", plan.max_trace_level)?;
    writeln!(out, "adc_bailout {}", plan.adc_bailout)?;
    writeln!(out, "simulated")?;
    for called in &plan.effects {
        writeln!(out, "  {}: {}", called.effect.name(), called.cost)?;
        writeln!(out, "    called for by {}", callers(called, sources))?;
    }
    writeln!(out, "left out")?;
    for left in &plan.left_out {
        let place = left.site.map_or(String::new(), |site| format!("  ({})", place(site, sources)));
        writeln!(out, "  {}: {}{place}", left.what, left.why)?;
    }
    Ok(())
}

fn callers(called: &Called, sources: &Sources) -> String {
    let mut places: Vec<String> = called.by.iter().map(|&site| place(site, sources)).collect();
    places.dedup();
    match places.len() {
        0 => "the options, or their defaults".to_owned(),
        1..=PLACES_SHOWN => places.join(", "),
        more => format!("{} and {} more", places[..PLACES_SHOWN].join(", "), more - PLACES_SHOWN),
    }
}

fn place(site: Site, sources: &Sources) -> String {
    sources.place(site.span)
}
