//! Rays side by side, searched in the local space of one placed body.
//!
//! **Invariant:** each ray finds what it finds alone.

use super::super::local::{Crossings, Local, LocalRay, Met};
use super::super::seen::SeenRow;
use super::super::{Placed, Ray};
use crate::math::wide::{Instructions, ROW, Rays, Row, Simd, dispatch, numbers};
use smallvec::SmallVec;

impl Placed {
    /// [`Self::first_crossings`] for the rays of `mask`, each with its limit: calls `each` with the number of a ray
    /// that finds any, the ray, and what it finds.
    #[inline(always)]
    pub fn first_crossings_together(
        &self,
        instructions: Instructions,
        rays: &Rays,
        mask: u32,
        limits: &Row,
        mut each: impl FnMut(usize, &Ray, &[Met]),
    ) {
        self.together(instructions, rays, mask, limits, |row, numbers, rays, lines, between| {
            self.body.first_crossings_together(lines, between, &mut |nth, found| {
                let number = numbers[nth];
                found.iter_mut().for_each(|met| *met = row.met(number, *met));
                each(number, &rays[nth], found);
            });
        });
    }

    /// [`Self::crosses`] for the rays of `mask`, each with its limit: a bit for each.
    #[inline(always)]
    pub fn crosses_together(
        &self,
        instructions: Instructions,
        rays: &Rays,
        mask: u32,
        limits: &Row,
        accepts: impl Fn(usize, &Met) -> bool,
    ) -> u32 {
        let mut crossed = 0;
        self.together(instructions, rays, mask, limits, |row, numbers, rays, lines, between| {
            let found = self.body.crosses_together(lines, between, &|nth, met| {
                let number = numbers[nth];
                accepts(number, &self.shared(&rays[nth], &row.met(number, *met)))
            });
            let is_crossed = |(nth, _): &(usize, &usize)| found >> nth & 1 == 1;
            let numbers = numbers.iter().enumerate().filter(is_crossed);
            crossed = numbers.fold(0, |all, (_, number)| all | 1 << number);
        });
        crossed
    }

    /// Brings the rays of `mask` to where [`Self::add_crossings_of_part_in`] finds them.
    #[inline(always)]
    pub(crate) fn see_part<S: Simd>(&self, simd: S, rays: &Rays, mask: u32, row: &mut SeenRow) {
        row.see(simd, self, rays, mask, &[0.0; ROW], self.moved());
    }

    /// Adds [`Self::crossings_of_part`] for the ray of this number in a row to none.
    pub(crate) fn add_crossings_of_part_in(
        &self,
        row: &SeenRow,
        number: usize,
        ray: &Ray,
        found: &mut Crossings,
    ) {
        if row.reaching >> number & 1 == 1 {
            self.body.crossings(&row.line(number, self, ray), found);
            found.iter_mut().for_each(|met| *met = row.met(number, *met));
        }
    }

    /// Calls `find` with the numbers of the rays that may meet the body, the rays, their lines and where these are
    /// searched.
    #[inline(always)]
    fn together(
        &self,
        instructions: Instructions,
        rays: &Rays,
        mask: u32,
        limits: &Row,
        find: impl FnOnce(&SeenRow, &[usize], &[Ray], &[LocalRay], &[(f64, f64)]),
    ) {
        let mut row = SeenRow::NONE;
        let moved = self.edges_moved();
        dispatch!(instructions.level(), simd => row.see(simd, self, rays, mask, limits, moved));
        if row.reaching == 0 {
            return;
        }
        let numbers: SmallVec<[usize; ROW]> = numbers(row.reaching).collect();
        let rays: SmallVec<[Ray; ROW]> = numbers.iter().map(|&number| rays.at(number)).collect();
        let lines = numbers.iter().zip(&rays).map(|(&number, ray)| row.line(number, self, ray));
        let lines: SmallVec<[LocalRay; ROW]> = lines.collect();
        let between: SmallVec<[(f64, f64); ROW]> =
            numbers.iter().map(|&number| row.between(number)).collect();
        find(&row, &numbers, &rays, &lines, &between);
    }
}
