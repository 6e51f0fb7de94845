//! Whether lights that do not light all that they see are simulated.

use super::{Census, Decision, because, scatters, shines};

impl Census<'_> {
    pub(super) fn projections(&self) -> Decision {
        if self.world.projections.is_empty() {
            return because("no light has a `projected_through`", None);
        }
        if !self.any(|plain| scatters(plain) || shines(plain)) {
            return because("no surface answers a light", None);
        }
        let cost = "one more ray a projected light and lit hit".to_owned();
        Ok((self.origins.projections.clone(), cost))
    }

    pub(super) fn light_groups(&self) -> Decision {
        if self.world.light_sets.is_empty() {
            return because("every light lights every object", None);
        }
        if !self.any(|plain| scatters(plain) || shines(plain)) {
            return because("no surface answers a light", None);
        }
        let cost = "lights one by one; a look-up a light and hit".to_owned();
        Ok((self.origins.light_groups.clone(), cost))
    }
}
