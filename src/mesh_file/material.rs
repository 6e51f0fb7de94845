//! MTL: materials of an OBJ file; only their colours are used.
//!
//! **Source:** Alias|Wavefront, "Advanced Visualizer Manual", appendix B1.

use std::collections::HashMap;

use super::Fault;

/// `Kd`, linear, and `d`, the opacity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Material {
    pub rgb: [f64; 3],
    pub alpha: f64,
    /// Whether its colour also uses a texture.
    pub pictured: bool,
}

/// Reads the materials of a library, by name; `None` for those without a colour.
pub(super) fn read(text: &str) -> Result<HashMap<String, Option<Material>>, Fault> {
    const PLAIN: Material = Material { rgb: [1.0; 3], alpha: 1.0, pictured: false };
    let mut all: HashMap<String, Option<Material>> = HashMap::new();
    let mut current: Option<String> = None;
    for (number, line) in text.lines().enumerate() {
        let line = line.trim();
        let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        let fault = |what: &str| Fault::line(number + 1, format!("expected {what} after `{word}`"));
        if word == "newmtl" {
            all.insert(rest.to_owned(), None);
            current = Some(rest.to_owned());
            continue;
        }
        let Some(slot) = current.as_ref().and_then(|name| all.get_mut(name)) else { continue };
        match word {
            // Other forms name a spectrum, or another space of colours.
            "Kd" if !rest.starts_with(['s', 'x']) => {
                let numbers: Option<Vec<f64>> =
                    rest.split_whitespace().map(|number| number.parse().ok()).collect();
                let rgb = match numbers.as_deref() {
                    Some(&[gray]) => [gray; 3],
                    Some(&[red, green, blue, ..]) => [red, green, blue],
                    _ => return Err(fault("three numbers")),
                };
                slot.get_or_insert(PLAIN).rgb = rgb;
            }
            "d" | "Tr" => {
                let number =
                    rest.split_whitespace().next_back().and_then(|n| n.parse::<f64>().ok());
                let number = number.ok_or_else(|| fault("a number"))?;
                let alpha = if word == "d" { number } else { 1.0 - number };
                if alpha != 1.0 || slot.is_some() {
                    slot.get_or_insert(PLAIN).alpha = alpha;
                }
            }
            "map_Kd" => slot.get_or_insert(PLAIN).pictured = true,
            _ => {}
        }
    }
    Ok(all)
}
