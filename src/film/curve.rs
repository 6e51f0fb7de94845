//! The codes by which a display shows components of colours.
//!
//! **In:** a component in a scene's working space. **Out:** its code. **Invariant:** a table gives the code that the
//! definition gives.

use crate::color::{Gamma, srgb_encode};

/// Returns the code of a component, 0 … `last`, by definition.
fn code(component: f64, gamma: Gamma, display: Gamma, last: u32) -> u32 {
    let light = gamma.linear(component);
    let shown = match display {
        Gamma::Srgb => srgb_encode(light),
        Gamma::Power(_) => display.of_light(light.min(1.0)),
    };
    (shown * f64::from(last)).round() as u32
}

/// Computes [`code`] by table: `steps[k]` is the least component with a code above `k`.
///
/// The definition takes two powers, a search only a few comparisons. Both agree for every number, because
/// the steps are computed with the definition itself.
pub(super) struct Curve {
    last: u32,
    /// Transfer function from components to light.
    gamma: Gamma,
    /// Transfer function from codes to light.
    display: Gamma,
    /// Empty if there are so few pixels that computing the steps costs more than it saves.
    steps: Vec<f64>,
    /// For each of `starts.len()` equal parts of 0 … 1, the code of its lower end.
    starts: Vec<u32>,
}

impl Curve {
    /// `wanted` is the approximate number of components to convert.
    pub fn new(last: u32, gamma: Gamma, display: Gamma, wanted: usize) -> Self {
        let mut curve = Self { last, gamma, display, steps: Vec::new(), starts: Vec::new() };
        // Each step costs about twenty evaluations.
        if wanted / 20 > last as usize {
            curve.steps = (0..last).map(|k| step_above(k, gamma, display, last)).collect();
            let parts = 16 * (last as usize + 1);
            let mut at = 0;
            curve.starts = (0..parts)
                .map(|part| {
                    let low = part as f64 / parts as f64;
                    at += curve.steps[at..].iter().take_while(|&&step| step <= low).count();
                    at as u32
                })
                .collect();
        }
        curve
    }

    /// Returns the code of alpha, which is shown as it is.
    pub fn of_alpha(&self, alpha: f64) -> u32 {
        (alpha * f64::from(self.last)).round() as u32
    }

    #[inline]
    pub fn code(&self, component: f64) -> u32 {
        if self.steps.is_empty() {
            return code(component, self.gamma, self.display, self.last);
        }
        // Casting clamps below and makes NaN 0.
        let part = (component * self.starts.len() as f64) as usize;
        let Some(&start) = self.starts.get(part) else { return self.last };
        let mut code = start;
        while code < self.last && self.steps[code as usize] <= component {
            code += 1;
        }
        code
    }
}

/// Returns the least component with a code above `k`, by bisection over the bits of a float around the
/// inverse formula.
fn step_above(k: u32, gamma: Gamma, display: Gamma, last: u32) -> f64 {
    let above = |bits: u64| code(f64::from_bits(bits), gamma, display, last) > k;
    let shown = (f64::from(k) + 0.5) / f64::from(last);
    let guess = if gamma == display { shown } else { gamma.of_light(display.linear(shown)) };
    let guess = guess.to_bits();
    let mut width = 16;
    let (mut low, mut high) = (guess, guess);
    while above(low) {
        low = low.saturating_sub(width);
        width *= 16;
    }
    width = 16;
    while !above(high) {
        high += width;
        width *= 16;
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if above(middle) { high = middle } else { low = middle }
    }
    f64::from_bits(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_agrees_with_the_definition_at_and_around_every_step() {
        let powers = [1.0, 2.2, 0.4].map(Gamma::Power);
        let curves = [255, 65_535].into_iter().flat_map(|last| {
            powers.into_iter().chain([Gamma::Srgb]).map(move |gamma| (last, gamma, Gamma::Srgb))
        });
        let others = [(Gamma::LINEAR, 1.8), (Gamma::Srgb, 2.2), (Gamma::Power(2.2), 1.0)];
        let others = others.map(|(gamma, display)| (255, gamma, Gamma::Power(display)));
        for (last, gamma, display) in curves.chain(others) {
            let code = |c: f64, gamma, last| code(c, gamma, display, last);
            let curve = Curve::new(last, gamma, display, usize::MAX);
            assert_eq!(curve.steps.len(), last as usize);
            assert!(curve.steps.windows(2).all(|pair| pair[0] < pair[1]));
            for &step in &curve.steps {
                for bits in step.to_bits() - 3..step.to_bits() + 3 {
                    let c = f64::from_bits(bits);
                    assert_eq!(curve.code(c), code(c, gamma, last), "{c} {gamma} {last}");
                }
            }
            for i in -10..70_000 {
                let c = f64::from(i) / 65_535.0;
                assert_eq!(curve.code(c), code(c, gamma, last), "{c} {gamma} {last}");
            }
            for c in [f64::NAN, f64::INFINITY, -f64::INFINITY, -0.0, 1e-320, 1.0, 1e300] {
                assert_eq!(curve.code(c), code(c, gamma, last), "{c} {gamma} {last}");
            }
        }
    }
}
