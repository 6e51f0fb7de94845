//! `internal(n)`: built-in functions, which `functions.inc` names.
//!
//! Formulas are written in the language itself, in `internal.inc`, and compiled when the first is used; noise
//! functions are implemented outside tapes.
//!
//! **Source:** the numbers are those of POV-Ray 3.7 (manual, section 3.4.9.1.7 "Functions.inc").

use crate::diagnostic::{Code, Diagnostic};
use crate::function::{Builder, NoiseFunction};
use crate::source::{ExpansionId, Source, Span};
use crate::standard::place_of;
use crate::syntax::ast::{Argument, Arguments};
use crate::syntax::{self, ParseOptions};
use crate::vocabulary::Dialect;

use super::super::value::Value;
use super::super::{Evaluator, Here, Outcome, Reported};
use super::{AuthorFunction, FunctionId};

/// Source of the formulas, each declared under one of these names.
const FORMULAS: &str = include_str!("internal.inc");

/// Names of `internal(n)`, by n; 77 belongs to a pattern, and cannot be called.
const NAMES: [&str; 79] = [
    "f_algbr_cyl1",
    "f_algbr_cyl2",
    "f_algbr_cyl3",
    "f_algbr_cyl4",
    "f_bicorn",
    "f_bifolia",
    "f_blob",
    "f_blob2",
    "f_boy_surface",
    "f_comma",
    "f_cross_ellipsoids",
    "f_crossed_trough",
    "f_cubic_saddle",
    "f_cushion",
    "f_devils_curve",
    "f_devils_curve_2d",
    "f_dupin_cyclid",
    "f_ellipsoid",
    "f_enneper",
    "f_flange_cover",
    "f_folium_surface",
    "f_folium_surface_2d",
    "f_glob",
    "f_heart",
    "f_helical_torus",
    "f_helix1",
    "f_helix2",
    "f_hex_x",
    "f_hex_y",
    "f_hetero_mf",
    "f_hunt_surface",
    "f_hyperbolic_torus",
    "f_isect_ellipsoids",
    "f_kampyle_of_eudoxus",
    "f_kampyle_of_eudoxus_2d",
    "f_klein_bottle",
    "f_kummer_surface_v1",
    "f_kummer_surface_v2",
    "f_lemniscate_of_gerono",
    "f_lemniscate_of_gerono_2d",
    "f_mesh1",
    "f_mitre",
    "f_nodal_cubic",
    "f_odd",
    "f_ovals_of_cassini",
    "f_paraboloid",
    "f_parabolic_torus",
    "f_ph",
    "f_pillow",
    "f_piriform",
    "f_piriform_2d",
    "f_poly4",
    "f_polytubes",
    "f_quantum",
    "f_quartic_paraboloid",
    "f_quartic_saddle",
    "f_quartic_cylinder",
    "f_r",
    "f_ridge",
    "f_ridged_mf",
    "f_rounded_box",
    "f_sphere",
    "f_spikes",
    "f_spikes_2d",
    "f_spiral",
    "f_steiners_roman",
    "f_strophoid",
    "f_strophoid_2d",
    "f_superellipsoid",
    "f_th",
    "f_torus",
    "f_torus2",
    "f_torus_gumdrop",
    "f_umbrella",
    "f_witch_of_agnesi",
    "f_witch_of_agnesi_2d",
    "f_noise3d",
    "",
    "f_noise_generator",
];

fn noise(number: usize) -> Option<NoiseFunction> {
    match number {
        29 => Some(NoiseFunction::Hetero),
        58 => Some(NoiseFunction::Ridge),
        59 => Some(NoiseFunction::Ridged),
        76 => Some(NoiseFunction::Noise3d),
        78 => Some(NoiseFunction::Generator),
        _ => None,
    }
}

impl Evaluator<'_> {
    /// Returns the function for a body that consists only of `internal(n)`.
    pub(super) fn internal(
        &mut self,
        here: &Here,
        list: Arguments,
        span: Span,
    ) -> Outcome<FunctionId> {
        let [Argument::Expression(id)] = *here.unit.ast.arguments(list) else {
            return Err(self.expected("a number in parentheses", None, (here, span)));
        };
        let number = self.number(here, id)?;
        let last = NAMES.len() - 1;
        let known = (0.0..NAMES.len() as f64).contains(&number).then_some(number as usize);
        // In POV-Ray 3.7 the missing one is 0 everywhere (measured).
        let is_pov = self.options.dialect == Dialect::Pov;
        if is_pov && known.is_some_and(|known| NAMES[known].is_empty()) {
            return self.zero_everywhere(here, span);
        }
        let Some(known) = known.filter(|known| !NAMES[*known].is_empty()) else {
            let message = format!("there is no built-in function {number}");
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(span, format!("expected a number from 0 to {last}, but not 77"))
                .help("`functions.inc` has their names: `f_sphere`, `f_noise3d`, …");
            return Err(self.report(here, diagnostic));
        };
        if let Some(noise) = noise(known) {
            self.functions.push(AuthorFunction::Noise(noise));
            return Ok(FunctionId(self.functions.len() as u32 - 1));
        }
        if self.internals.is_empty() {
            self.internals = self.compile_internals();
        }
        let found = self.internals.get(known).copied().flatten();
        // All of them exist (a test checks each).
        found.ok_or(Reported)
    }

    fn zero_everywhere(&mut self, here: &Here, span: Span) -> Outcome<FunctionId> {
        let built = Builder::new(3).and_then(|mut builder| {
            let zero = builder.constant(0.0)?;
            Ok(builder.finish(zero))
        });
        let function = built.map_err(|_| self.too_long(here, span))?;
        self.functions.push(AuthorFunction::Formula(function));
        Ok(FunctionId(self.functions.len() as u32 - 1))
    }

    /// Compiles every formula, indexed by its number; their names are removed again.
    fn compile_internals(&mut self) -> Vec<Option<FunctionId>> {
        let id = self.sources.add(Source::new(place_of("internal.inc"), FORMULAS.to_owned()));
        // What POV-Ray refuses of a scene stands here as the language has it.
        let options = ParseOptions::default();
        let ast = syntax::parse(self.sources.get(id), id, &options, self.diagnostics);
        let here = Here { unit: self.unit(ast), expansion: ExpansionId::MAIN };
        let (taken, hold) = (self.taken, self.hold.take());
        let peeked = self.peeked.take();
        self.scopes.open();
        self.inside(&here, here.unit.ast.root, Self::run_items);
        let found = NAMES.map(|name| {
            let symbol = self.scopes.symbol(name)?;
            match self.scopes.read(symbol) {
                Some(Value::Function(id)) => Some(*id),
                _ => None,
            }
        });
        self.scopes.close();
        (self.taken, self.hold, self.peeked) = (taken, hold, peeked);
        found.to_vec()
    }
}
