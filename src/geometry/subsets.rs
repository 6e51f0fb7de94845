//! What rays of a kind can meet, where that is not all: geometries of some of the objects.
//!
//! **Invariant:** what a search for rays of a kind finds is the same in their subset as among all objects.

use super::{Entry, Geometry};
use crate::world::{Object, World};

impl Geometry {
    /// Arranges the objects of a World.
    pub fn build(world: &World) -> Self {
        let part = |holds: fn(&Object) -> bool| {
            let solids = || world.solids().filter(|&solid| holds(&world.objects[solid as usize]));
            let is_part = !world.objects.iter().all(holds);
            is_part.then(|| Box::new(Self::of(world, solids())))
        };
        let all = Self::of(world, world.solids());
        let few = |is_one: fn(&Entry) -> bool| {
            let ones = all.entries.iter().filter(|entry| is_one(entry));
            let mut solids: Vec<u32> = ones.map(|entry| entry.object).collect();
            solids.sort_unstable();
            let is_few = 2 * solids.len() <= all.entries.len();
            is_few.then(|| Box::new(Self::of(world, solids.into_iter())))
        };
        Self {
            in_image: part(|object| object.in_image),
            in_reflections: part(|object| object.in_reflections),
            opaque: few(|entry| entry.blocks),
            filters: few(|entry| entry.filters),
            projections: world.projections.iter().map(Self::build).collect(),
            ..all
        }
    }

    /// What the camera's rays meet, as long as nothing has mirrored them.
    pub fn in_image(&self) -> &Self {
        self.in_image.as_deref().unwrap_or(self)
    }

    /// What mirrored rays meet.
    pub fn in_reflections(&self) -> &Self {
        self.in_reflections.as_deref().unwrap_or(self)
    }

    /// What stops light, and perhaps more.
    pub(super) fn opaque(&self) -> &Self {
        self.opaque.as_deref().unwrap_or(self)
    }

    /// What stops a part of light, and perhaps more.
    pub(super) fn filtering(&self) -> &Self {
        self.filters.as_deref().unwrap_or(self)
    }

    pub(super) fn parts(mut self, change: impl Fn(Self) -> Self) -> Self {
        let Self { in_image, in_reflections, opaque, filters, .. } = &mut self;
        for part in [in_image, in_reflections, opaque, filters] {
            *part = part.take().map(|part| Box::new(change(*part)));
        }
        self
    }
}
