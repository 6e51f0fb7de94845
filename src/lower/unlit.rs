//! Reports that a scene has no light, at the light that is black or never placed.
//!
//! **Invariant:** one message; that such a light is never placed is not reported as well.

use super::Lowering;
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::scene::Unused;

const DARK: &str = "nothing gives light, so the picture is dark";
const HELP: &str = "a light such as `light_source { <10, 20, 10> rgb 1 }`";

impl Lowering<'_, '_> {
    pub(super) fn lint_unlit(&mut self) {
        let told = Diagnostic::new(Code::NoLight, DARK);
        let dropped = self.origins.dropped.iter().find(|part| part.what == "light_source");
        let told = match (self.black, dropped) {
            (Some(color), _) => told
                .at(color.span, "of this light its colour is black")
                .help("give it a colour: `rgb 1`")
                .traced(color, self.reporter.expansions),
            (None, Some(dropped)) => {
                told.at(dropped.site.span, format!("of this light {}", dropped.why)).help(HELP)
            }
            (None, None) => return tell_unlit(&self.scene.unused, self.reporter.diagnostics),
        };
        self.reporter.diagnostics.push(told);
    }
}

/// Reports a scene that places no light, given the names that nothing uses.
pub fn tell_unlit(unused: &[Unused], diagnostics: &mut Diagnostics) {
    let lights: Vec<&Unused> = unused.iter().filter(|one| one.is_light).collect();
    let [first, others @ ..] = lights.as_slice() else {
        return diagnostics.push(Diagnostic::new(Code::NoLight, DARK).help(HELP));
    };
    let name = &first.name;
    let (message, help) = match others.len() {
        0 => (
            format!("nothing gives light: `{name}` is declared and never placed"),
            format!("place it: `light_source {{ {name} }}`"),
        ),
        more => (
            format!("nothing gives light: {} lights are declared and never placed", more + 1),
            format!("place them, as in `light_source {{ {name} }}`"),
        ),
    };
    let mut told = Diagnostic::new(Code::NoLight, message)
        .at(first.site.span, "this light does not shine")
        .help(help);
    for other in others.iter().take(2) {
        told = told.also(other.site.span, "nor does this one");
    }
    if diagnostics.tells(Code::NoLight) {
        let places: Vec<_> = lights.iter().map(|light| light.site.span).collect();
        diagnostics.retain_after(0, |one| {
            let place = one.primary().map(|label| label.span);
            one.code != Code::NeverPlaced || place.is_none_or(|place| !places.contains(&place))
        });
    }
    diagnostics.push(told);
}
