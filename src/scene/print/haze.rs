//! Prints fog and rainbows of a Scene.

use std::fmt::{self, Write};

use super::Printer;
use crate::math::vector::written as vector;
use crate::scene::FogTurbulence;

impl Printer<'_> {
    pub(super) fn fogs(&self, out: &mut String) -> fmt::Result {
        for fog in &self.scene.fogs {
            writeln!(out, "fog  ({})", self.sources.place(fog.site.span))?;
            writeln!(out, "  color {}", fog.color)?;
            writeln!(out, "  distance {}", fog.distance)?;
            if fog.is_ground {
                writeln!(out, "  fog_type 2")?;
                writeln!(out, "  fog_offset {}", fog.offset)?;
                writeln!(out, "  fog_alt {}", fog.alt)?;
                writeln!(out, "  up {}", vector(fog.up))?;
                for &id in &fog.transforms {
                    self.transform(out, id, "  ")?;
                }
            }
            if let Some(FogTurbulence { scale, octaves, lambda, omega }) = fog.turbulence {
                write!(out, "  turbulence {} octaves {octaves}", vector(scale))?;
                writeln!(out, " lambda {lambda} omega {omega}")?;
                writeln!(out, "  turb_depth {} {:?}", fog.turb_depth, fog.noise)?;
            }
        }
        Ok(())
    }

    pub(super) fn rainbows(&self, out: &mut String) -> fmt::Result {
        for rainbow in &self.scene.rainbows {
            writeln!(out, "rainbow  ({})", self.sources.place(rainbow.site.span))?;
            writeln!(out, "  direction {}", vector(rainbow.direction))?;
            write!(out, "  angle {} width {}", rainbow.angle, rainbow.width)?;
            writeln!(out, " distance {} jitter {}", rainbow.distance, rainbow.jitter)?;
            writeln!(out, "  up {}", vector(rainbow.up))?;
            for (word, angle) in
                [("arc_angle", rainbow.arc_angle), ("falloff_angle", rainbow.falloff_angle)]
            {
                angle.map_or(Ok(()), |angle| writeln!(out, "  {word} {angle}"))?;
            }
            for (position, color) in rainbow.colors.iter().flat_map(|map| &map.0) {
                writeln!(out, "  [{position} {color}]")?;
            }
        }
        Ok(())
    }
}
