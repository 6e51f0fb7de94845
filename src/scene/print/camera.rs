//! Prints the meshes of a camera of a Scene.

use std::fmt::{self, Write};

use super::Printer;
use crate::scene::{Camera, MeshCamera};

impl Printer<'_> {
    pub(super) fn camera_meshes(&self, out: &mut String, camera: &Camera) -> fmt::Result {
        let Some(MeshCamera { rays, distribution, max_distance, meshes, smooth, .. }) =
            &camera.meshes
        else {
            return Ok(());
        };
        let smooth = if *smooth { " smooth" } else { "" };
        let distribution = distribution.number();
        writeln!(out, "  rays {rays} distribution {distribution} to {max_distance}{smooth}")?;
        for mesh in meshes {
            let object = &self.scene.objects[mesh.index()];
            writeln!(out, "  mesh {}  ({})", mesh.0, self.sources.place(object.site.span))?;
        }
        Ok(())
    }
}
