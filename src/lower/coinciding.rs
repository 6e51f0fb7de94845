//! Lints coinciding faces of parts of one solid: they render cleanly here, and as speckles elsewhere.
//!
//! **Invariant:** searched only if the lint is enabled.

use std::collections::BTreeSet;

use super::Lowering;
use crate::diagnostic::{Code, Diagnostic};
use crate::geometry::coinciding::coinciding_parts;
use crate::world::Coinciding;

impl Lowering<'_, '_> {
    pub(super) fn coinciding(&mut self) {
        let told = self.reporter.diagnostics.tells(Code::CoincidingFaces);
        if self.world.csg_solids.is_empty() || !(told || self.options.coinciding) {
            return;
        }
        let mut known = BTreeSet::new();
        for parts in coinciding_parts(&self.world) {
            let sites = parts.map(|part| self.origins.objects[part as usize]);
            if known.insert(sites.map(|site| site.span)) {
                let words = parts.map(|part| self.world.word(&self.world.objects[part as usize]));
                self.origins.coinciding.push(Coinciding { words, sites });
            }
        }
        for Coinciding { words: [first, second], sites } in &self.origins.coinciding {
            let message = match sites[0].span == sites[1].span {
                true => format!("copies of this {first} have a face in common"),
                false => format!("this {second} and a {first} have a face in common"),
            };
            let mut told = Diagnostic::new(Code::CoincidingFaces, message)
                .at(sites[1].span, "drawn as it is here; POV-Ray draws speckles")
                .help("for POV-Ray, let the one reach a little beyond the other");
            if sites[0].span != sites[1].span {
                told = told.also(sites[0].span, format!("the {first}"));
            }
            self.reporter.diagnostics.push(told.traced(sites[1], self.reporter.expansions));
        }
    }
}
