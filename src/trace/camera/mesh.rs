//! The camera whose rays start on faces of meshes.
//!
//! **Source:** POV-Ray manual, section 3.4.2.2.3 "Mesh projection"; measured on POV-Ray 3.7, whose first two rows are
//! the same faces, and whose last column and first row have texture coordinates half a pixel off.

use std::sync::Arc;

use smallvec::SmallVec;

use crate::math::Vector;
use crate::shape::Ray;
use crate::world::{Faces, MeshCamera, UnwrappedFace};

/// The most cells along a side of the grid over texture coordinates.
const MOST_CELLS: f64 = 256.0;

/// The rays of a place in the picture.
type Rays = SmallVec<[Option<Ray>; 1]>;

/// A camera on meshes, and the picture it makes.
pub(super) struct Meshes {
    camera: Arc<MeshCamera>,
    width: f64,
    height: f64,
    grid: Grid,
}

impl Meshes {
    pub fn new(camera: Arc<MeshCamera>, width: u32, height: u32) -> Self {
        let grid = match &camera.faces {
            Faces::Unwrapped { faces, .. } => Grid::new(faces),
            Faces::Layers(_) | Faces::Beside(_) => Grid::default(),
        };
        Self { camera, width: width.into(), height: height.into(), grid }
    }

    /// Returns how many rays a place has, some of which may be missing.
    pub fn rays_of_a_place(&self) -> usize {
        match &self.camera.faces {
            Faces::Layers(lists) => lists.len(),
            Faces::Beside(_) | Faces::Unwrapped { .. } => 1,
        }
    }

    /// Returns the rays of the place (`u`, `v`), −½ … ½ from left to right and from bottom to top.
    pub fn rays(&self, u: f64, v: f64) -> Rays {
        let x = snapped((u + 0.5) * self.width).min(self.width - 1.0);
        let y = (snapped((0.5 - v) * self.height) - 1.0).max(0.0);
        let number = |row: f64| (y.floor() * row + x.floor()) as usize;
        let of_face = |list: &Vec<crate::world::Face>, number: usize| {
            let face = list.get(number)?;
            Some(Ray { origin: face.origin, direction: face.direction.get() })
        };
        match &self.camera.faces {
            Faces::Layers(lists) => {
                lists.iter().map(|list| of_face(list, number(self.width))).collect()
            }
            Faces::Beside(lists) => {
                let part = self.width / lists.len() as f64;
                let list = lists.get((x / part) as usize);
                let ray = list.and_then(|list| of_face(list, number(part.floor())));
                std::iter::once(ray).collect()
            }
            Faces::Unwrapped { faces, offset } => {
                let at = [(x - 0.5) / self.width, 1.0 - (y + 0.5) / self.height];
                let ray = self.grid.candidates(at).iter().find_map(|&face| {
                    let face = &faces[face as usize];
                    Some(face.ray(face.shares(at)?, *offset))
                });
                std::iter::once(ray).collect()
            }
        }
    }
}

/// Returns a place in pixels without what rounding adds: the middle of a pixel may lie on the edge of a face.
fn snapped(pixels: f64) -> f64 {
    const STEPS: f64 = (1u32 << 24) as f64;
    (pixels * STEPS).round() / STEPS
}

impl UnwrappedFace {
    /// Returns how much of each corner is at a place of the texture; `None` if it is outside of the face.
    fn shares(&self, [u, v]: [f64; 2]) -> Option<[f64; 3]> {
        let area = |[a, b]: [[f64; 2]; 2]| (a[0] - u) * (b[1] - v) - (b[0] - u) * (a[1] - v);
        let [a, b, c] = self.uvs;
        let parts = [area([b, c]), area([c, a]), area([a, b])];
        let whole = parts[0] + parts[1] + parts[2];
        let shares = parts.map(|part| part / whole);
        shares.iter().all(|share| *share >= 0.0).then_some(shares)
    }

    fn ray(&self, shares: [f64; 3], offset: f64) -> Ray {
        let mean = |of: [Vector; 3]| of[0] * shares[0] + of[1] * shares[1] + of[2] * shares[2];
        let direction = super::unit(mean(self.directions.map(|direction| direction.get())));
        Ray { origin: mean(self.corners) + direction * offset, direction }
    }
}

/// The faces at each place of the texture, in their order.
#[derive(Default)]
struct Grid {
    side: usize,
    cells: Vec<Vec<u32>>,
}

impl Grid {
    fn new(faces: &[UnwrappedFace]) -> Self {
        let side = (faces.len() as f64).sqrt().clamp(1.0, MOST_CELLS) as usize;
        let mut grid = Self { side, cells: vec![Vec::new(); side * side] };
        for (number, face) in faces.iter().enumerate() {
            let range = |axis: usize| {
                let ends = face.uvs.map(|uv| uv[axis]);
                let low = ends.into_iter().fold(f64::INFINITY, f64::min);
                let high = ends.into_iter().fold(f64::NEG_INFINITY, f64::max);
                grid.cell(low)..=grid.cell(high)
            };
            let (columns, rows) = (range(0), range(1));
            for row in rows {
                for column in columns.clone() {
                    grid.cells[row * side + column].push(number as u32);
                }
            }
        }
        grid
    }

    /// Returns the cell of a coordinate along a side; those outside of 0 … 1 are in the outermost cells.
    fn cell(&self, coordinate: f64) -> usize {
        ((coordinate * self.side as f64).max(0.0) as usize).min(self.side - 1)
    }

    fn candidates(&self, [u, v]: [f64; 2]) -> &[u32] {
        match self.side {
            0 => &[],
            side => &self.cells[self.cell(v) * side + self.cell(u)],
        }
    }
}

#[cfg(test)]
mod tests;
