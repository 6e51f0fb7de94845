//! Lints clear objects that coincide: light passes through each of them here, but through only one in
//! POV-Ray.
//!
//! **Invariant:** searched only if the lint is enabled; each pair of locations in the source is reported
//! once.

use std::collections::BTreeSet;

use super::Lowering;
use crate::diagnostic::{Code, Diagnostic};
use crate::geometry::doubled::doubled;
use crate::world::Object;

impl Lowering<'_, '_> {
    pub(super) fn doubled(&mut self) {
        let diagnostics = &self.reporter.diagnostics;
        if !diagnostics.tells(Code::ClearTwice) || diagnostics.has_errors() {
            return;
        }
        let world = &self.world;
        let is_clear = |object: &Object| world.is_clear(object);
        let clear: Vec<u32> =
            world.solids().filter(|&solid| world.parts(solid).iter().any(is_clear)).collect();
        let object = |solid: u32| &world.objects[solid as usize];
        let mut known = BTreeSet::new();
        let mut all = Vec::new();
        for pair in doubled(world, &clear) {
            let [a, b] = pair.map(object);
            let sites = pair.map(|solid| self.origins.objects[solid as usize]);
            let meets_one_ray = a.in_image && b.in_image
                || a.in_reflections && b.in_reflections
                || a.casts_shadow && b.casts_shadow;
            if !meets_one_ray || !known.insert(sites.map(|site| site.span)) {
                continue;
            }
            let [first, second] = [a, b].map(|object| match object.csg_solid {
                Some(_) => "solid",
                None => world.word(object),
            });
            let told = match sites[0].span == sites[1].span {
                true => {
                    let message = format!("clear copies of this {second} stand in one place");
                    Diagnostic::new(Code::ClearTwice, message)
                        .at(sites[1].span, "light goes through each; POV-Ray shows one of them")
                }
                false => {
                    let message = format!("this clear {second} stands where a clear {first} does");
                    Diagnostic::new(Code::ClearTwice, message)
                        .at(sites[1].span, "light goes through both; POV-Ray shows one of them")
                        .also(sites[0].span, format!("the other {first}"))
                }
            };
            all.push((told.help("leave out all but one of them"), sites[1]));
        }
        for (told, site) in all {
            self.reporter.diagnostics.push(told.traced(site, self.reporter.expansions));
        }
    }
}
