//! Whether fog and rainbows are simulated.

use super::{Census, Decision, because, count};

impl Census<'_> {
    pub(super) fn fog(&self) -> Decision {
        let fogs = &self.world.fogs;
        if fogs.is_empty() {
            let mut dropped = self.origins.dropped.iter().filter(|part| part.what == "fog");
            return match dropped.next() {
                Some(fog) => because("no fog veils anything", Some(fog.site)),
                None => because("no `fog`", None),
            };
        }
        let ground =
            if fogs.iter().any(|fog| fog.ground.is_some()) { ", two arc tangents" } else { "" };
        let churn = if fogs.iter().any(|fog| fog.churn.is_some()) { ", noise" } else { "" };
        let cost = format!("an exponential{ground}{churn}; {} a ray", count(fogs.len(), "fog"));
        Ok((self.origins.fogs.clone(), cost))
    }

    pub(super) fn rainbows(&self) -> Decision {
        let rainbows = &self.world.rainbows;
        if rainbows.is_empty() {
            let mut dropped = self.origins.dropped.iter().filter(|part| part.what == "rainbow");
            return match dropped.next() {
                Some(rainbow) => because("no rainbow shows", Some(rainbow.site)),
                None => because("no `rainbow`", None),
            };
        }
        let jitter = rainbows.iter().any(|rainbow| rainbow.jitter != 0.0);
        let random = if jitter { ", a random number" } else { "" };
        let cost = format!("an angle{random}; {} a ray", count(rainbows.len(), "rainbow"));
        Ok((self.origins.rainbows.clone(), cost))
    }
}
