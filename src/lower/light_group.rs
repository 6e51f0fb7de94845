//! Lowers light groups: which lights light an object.

use super::Lowering;
use super::object::Inherited;
use crate::source::Site;

/// A visited light group.
pub(super) struct LightGroup {
    /// Indices into `World::lights`.
    lights: Vec<u32>,
    /// The lights of no group light its objects, too.
    global: bool,
    /// A group whose lights light its objects, too.
    other: Option<u32>,
}

impl Lowering<'_, '_> {
    /// Begins a light group, and returns its number.
    ///
    /// **Source:** measured on POV-Ray 3.7: a group in another has its `global_lights`, and none of its lights.
    pub(super) fn begin_light_group(
        &mut self,
        inherited: &Inherited,
        global: bool,
        item: Site,
    ) -> u32 {
        let outer = inherited.light_group.map(|outer| &self.light_groups[outer as usize]);
        let global = outer.map_or(global, |outer| outer.global);
        if outer.is_none() {
            self.origins.light_groups.push(item);
        }
        self.light_groups.push(LightGroup { lights: Vec::new(), global, other: None });
        self.light_groups.len() as u32 - 1
    }

    /// Returns the group of the object that a light of a group looks like: the lights of no group light it in any
    /// case (measured on POV-Ray 3.7).
    pub(super) fn group_of_like(&mut self, group: Option<u32>) -> Option<u32> {
        let other = Some(group?);
        self.light_groups.push(LightGroup { lights: Vec::new(), global: true, other });
        Some(self.light_groups.len() as u32 - 1)
    }

    /// Adds the last light to a group.
    pub(super) fn light_of_group(&mut self, group: Option<u32>) {
        let light = self.world.lights.len() as u32 - 1;
        if let Some(group) = group {
            self.light_groups[group as usize].lights.push(light);
        }
    }

    /// Gives each object its set of lights, if any object is not lit by all; until now it has the number of its
    /// group.
    pub(super) fn light_sets(&mut self) {
        if self.light_groups.is_empty() {
            return;
        }
        let mut is_global = vec![true; self.world.lights.len()];
        let grouped = self.light_groups.iter().flat_map(|group| &group.lights);
        grouped.for_each(|&light| is_global[light as usize] = false);
        let lights = || 0..self.world.lights.len() as u32;
        let global: Vec<u32> = lights().filter(|&light| is_global[light as usize]).collect();
        let of_group = |group: &LightGroup| {
            let mut set = group.lights.clone();
            set.extend(
                group.other.iter().flat_map(|&other| &self.light_groups[other as usize].lights),
            );
            set.extend(global.iter().filter(|_| group.global));
            set.sort_unstable();
            set
        };
        let by_group: Vec<Vec<u32>> =
            std::iter::once(global.clone()).chain(self.light_groups.iter().map(of_group)).collect();
        let is_whole = |set: &Vec<u32>| set.len() == self.world.lights.len();
        let mut sets: Vec<Vec<u32>> = Vec::new();
        if self.world.objects.iter().all(|object| is_whole(&by_group[object.lights as usize])) {
            self.world.objects.iter_mut().for_each(|object| object.lights = 0);
            self.origins.light_groups.clear();
            return;
        }
        for object in &mut self.world.objects {
            let set = &by_group[object.lights as usize];
            let known = sets.iter().position(|known| known == set);
            object.lights = known.unwrap_or(sets.len()) as u32;
            if known.is_none() {
                sets.push(set.clone());
            }
        }
        self.world.light_sets = sets;
    }
}
