//! Lowers a `mesh_camera`: the rays of its faces.
//!
//! **Source:** POV-Ray manual, section "Mesh projection"; POV-Ray 3.7's behaviour, measured.

use std::sync::Arc;

use super::transform::{Affine, exact};
use super::{Fault, Lowering};
use crate::diagnostic::Code;
use crate::math::double::DoubleVector;
use crate::math::{UnitVector, Vector};
use crate::scene::{
    self, Dialect, Distribution, ModifierKind, ObjectId, ObjectKind, Solid, mesh::Triangles,
};
use crate::source::Site;
use crate::world::{Face, Faces, MeshCamera, UnwrappedFace};

/// A greatest distance that is not more is none.
const LEAST_DISTANCE: f64 = 1e-10;

/// Triangles and where they are.
struct Placed<'s> {
    triangles: &'s Triangles,
    map: Affine,
    /// Directions of the outer sides, by those of the triangles.
    normals: [DoubleVector; 3],
}

impl<'s> Lowering<'s, '_> {
    /// Returns the faces of a `mesh_camera` that is at `location` and looks along `direction`, whose z alone count:
    /// how far off the faces the rays start, and whether they go to the inner side.
    pub(super) fn mesh_camera(
        &mut self,
        written: &scene::MeshCamera,
        location: Vector,
        direction: Vector,
    ) -> Result<MeshCamera, (Fault, Site)> {
        let ahead = match self.scene.dialect {
            Dialect::Pov => direction.z,
            Dialect::Scene => -direction.z,
        };
        let turn = if ahead < 0.0 { -1.0 } else { 1.0 };
        let mut meshes = Vec::with_capacity(written.meshes.len());
        for &mesh in &written.meshes {
            meshes.push(self.placed_mesh(mesh)?);
        }
        let offset = turn * location.z;
        let lists = || meshes.iter().map(|mesh| mesh.rays(turn, offset));
        let faces = match written.distribution {
            Distribution::Layers => Faces::Layers(lists().take(written.rays as usize).collect()),
            Distribution::Sum => Faces::Layers(vec![lists().flatten().collect()]),
            Distribution::Beside => Faces::Beside(lists().collect()),
            // The first mesh alone counts (measured).
            Distribution::Unwrapped => {
                let faces = meshes.first().map(|mesh| mesh.unwrapped(turn, written.smooth));
                Faces::Unwrapped { faces: faces.unwrap_or_default(), offset }
            }
        };
        if !offset.is_finite() || written.max_distance.is_nan() {
            return Err((Fault::not_finite("this camera").refused(), written.site));
        }
        let limited = written.max_distance > LEAST_DISTANCE;
        let reach = if limited { written.max_distance } else { f64::INFINITY };
        Ok(MeshCamera { faces, reach })
    }

    fn placed_mesh(&mut self, id: ObjectId) -> Result<Placed<'s>, (Fault, Site)> {
        let site = self.scene.objects[id.index()].site;
        let mut map = Affine::IDENTITY;
        let mut id = id;
        loop {
            let object = &self.scene.objects[id.index()];
            let moves = object.modifiers.iter().filter_map(|modifier| match modifier.kind {
                ModifierKind::Transform(id) => Some(id),
                _ => None,
            });
            let moves: Vec<_> = moves.collect();
            let own = self.transforms.product(&moves).map_err(|fault| (fault, site))?;
            map = map.after(&own);
            match &object.kind {
                ObjectKind::Use(used) => id = *used,
                ObjectKind::Solid(Solid::Triangles { triangles, .. }) => {
                    let flat = || Fault::new(Code::DegenerateShape, "this mesh is flattened");
                    let cofactors = map
                        .cofactors()
                        .ok_or_else(|| (flat().label("its transforms leave no volume"), site))?;
                    let sign = cofactors.determinant.round().signum();
                    let normals = cofactors.rows.map(|row| if sign < 0.0 { -row } else { row });
                    return Ok(Placed { triangles: Arc::as_ref(triangles), map, normals });
                }
                _ => {
                    let fault = Fault::new(Code::WrongType, "a `mesh_camera` looks from meshes");
                    return Err((fault.label("this is no mesh"), site));
                }
            }
        }
    }
}

impl Placed<'_> {
    fn corners(&self, face: &scene::mesh::Face) -> [Vector; 3] {
        face.vertices.map(|i| self.map.point(exact(self.triangles.vertices[i as usize])).round())
    }

    /// Returns the direction of a normal in the World.
    fn normal(&self, normal: Vector) -> Option<UnitVector> {
        let normal = exact(normal);
        let [x, y, z] = self.normals;
        let turned = DoubleVector {
            x: x.x * normal.x + y.x * normal.y + z.x * normal.z,
            y: x.y * normal.x + y.y * normal.y + z.y * normal.z,
            z: x.z * normal.x + y.z * normal.y + z.z * normal.z,
        };
        UnitVector::from_direction(turned.normalized()?.round())
    }

    /// Returns the direction away from the outer side of a face; `None` if it has no area.
    fn outward(&self, face: &scene::mesh::Face) -> Option<UnitVector> {
        let [a, b, c] = face.vertices.map(|i| exact(self.triangles.vertices[i as usize]));
        let normal = (c - a).cross(b - a).normalized()?;
        self.normal(normal.round())
    }

    /// Returns the rays of all faces.
    fn rays(&self, turn: f64, offset: f64) -> Vec<Face> {
        let ray = |face: &scene::mesh::Face| {
            let direction = UnitVector::from_unit(self.outward(face)?.get() * turn);
            let [a, b, c] = self.corners(face);
            let origin = a / 3.0 + b / 3.0 + c / 3.0 + direction.get() * offset;
            origin.is_finite().then_some(Face { origin, direction })
        };
        self.triangles.faces.iter().filter_map(ray).collect()
    }

    /// Returns the faces that have texture coordinates.
    fn unwrapped(&self, turn: f64, smooth: bool) -> Vec<UnwrappedFace> {
        let unwrapped = |face: &scene::mesh::Face| {
            let uvs = face.uvs?.map(|i| self.triangles.uvs[i as usize]);
            let flat = self.outward(face)?;
            let normals = face.normals.filter(|_| smooth);
            let normals = normals.map_or([flat; 3], |normals| {
                normals.map(|i| self.normal(self.triangles.normals[i as usize]).unwrap_or(flat))
            });
            let directions = normals.map(|normal| UnitVector::from_unit(normal.get() * turn));
            let corners = self.corners(face);
            let is_finite = corners.iter().all(|corner| corner.is_finite())
                && uvs.as_flattened().iter().all(|n| n.is_finite());
            is_finite.then_some(UnwrappedFace { uvs, corners, directions })
        };
        self.triangles.faces.iter().filter_map(unwrapped).collect()
    }
}
