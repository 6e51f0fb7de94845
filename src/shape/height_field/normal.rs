//! Normals of a smooth height field: those of the grid's corners, interpolated over each cell.

use super::HeightField;
use crate::math::Vector;

impl HeightField {
    /// Returns the normal of a triangle at a point, interpolated between the corners of its cell.
    pub(super) fn smooth_normal(&self, part: u32, point: Vector) -> Vector {
        let cell = self.cell(part);
        let share = |axis: usize, place: f64| {
            ((place + 0.5) * self.cells[axis] as f64 - cell[axis] as f64).clamp(0.0, 1.0)
        };
        let (x, z) = (share(0, point.x), share(1, point.z));
        let normal = |i: usize, j: usize| self.normal([cell[0] + i, cell[1] + j]);
        let row = |j: usize| normal(0, j).lerp(normal(1, j), x);
        row(0).lerp(row(1), z)
    }

    /// Returns the normal at a corner of the grid: the mean of the normals of the four triangles that it
    /// forms with its neighbours along x and z. Heights are scaled so that flatter triangles count more.
    ///
    /// **Source:** `trace` of POV-Ray 3.7, measured; except that POV-Ray quantizes the mean to steps of
    /// 1/32767.
    fn normal(&self, place: [usize; 2]) -> Vector {
        const STRETCHED: f64 = 65536.0;
        let sides = |axis: usize| {
            let rise = |other: usize| {
                let mut beside = place;
                beside[axis] = other;
                (self.height_of(beside) - self.height_of(place)) * STRETCHED
            };
            let after = (place[axis] < self.cells[axis]).then(|| rise(place[axis] + 1));
            let before = place[axis].checked_sub(1).map(|other| -rise(other));
            [after, before].into_iter().flatten()
        };
        let corners = sides(0).flat_map(|x| sides(1).map(move |z| Vector::new(-x, 1.0, -z)));
        let mean: Vector = corners.map(Vector::normalize).sum();
        let [x, z] = self.cells.map(|count| count as f64);
        (mean * Vector::new(x, STRETCHED, z)).normalize_or(Vector::Y)
    }
}
