//! `uv_mapping`: the coordinates on the surface of each shape, in the space in which it is written.
//!
//! **In:** a point of the surface. **Out:** u and v; a texture that is mapped is evaluated at ⟨u, v, 0⟩.
//!
//! **Source:** POV-Ray manual, section "UV Mapping"; each function measured on POV-Ray 3.7 to 1/65,535.

use std::f64::consts::{PI, TAU};

use super::curve::Piece;
use super::{Placed, SurfacePoint};
use crate::math::Vector;
use crate::math::elementary::{asin, atan2};
use crate::math::placement::Map;

/// u and v.
pub type Coordinates = [f64; 2];

/// How an object's surface gets its coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Mapping {
    pub form: Form,
    /// From the world to the space of the form.
    pub map: Map,
}

/// The kinds of coordinates.
#[derive(Debug, Clone, PartialEq)]
pub enum Form {
    /// Of a sphere of radius 1 about the origin.
    Sphere,
    /// Of a box from the origin to ⟨1, 1, 1⟩.
    Box,
    /// About the y axis; the distance from it to the centre of the tube.
    Torus(f64),
    /// About the y axis; the radius of the upper sphere.
    Ovus(f64),
    /// About the y axis: all pieces of its outline, distance from the axis and height.
    Lathe(Vec<Piece>),
    /// About the y axis: the heights where its segments meet, and the radii at both ends.
    Sor { heights: Vec<f64>, ends: [f64; 2] },
    /// A bicubic patch with these coordinates at its corners, in the order of `uv_vectors`.
    Patch([Coordinates; 4]),
    /// The body's own; ⟨0, 0⟩ where it has none.
    Body,
}

/// The corners of a bicubic patch without `uv_vectors`.
pub const PATCH: [Coordinates; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

impl Mapping {
    /// Returns the coordinates of a point of the surface of an object, whose body is `placed`, if it has one.
    pub fn at(&self, surface: &SurfacePoint, placed: Option<&Placed>) -> Coordinates {
        let point = self.map.point(surface.point);
        let body = || placed.and_then(|placed| placed.uv(surface)).unwrap_or_default();
        let all = match &self.form {
            Form::Sphere => [turn(point), 0.5 + asin(point.y.clamp(-1.0, 1.0)) / PI],
            Form::Box => {
                let steepness = |axis: usize| {
                    let row = self.map.matrix.row(axis);
                    row.dot(surface.normal).abs() / row.length()
                };
                let axes = [0, 1, 2].map(|axis| (axis, steepness(axis)));
                let axis = axes.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |a| a.0);
                box_face(point, axis, point[axis] > 0.5)
            }
            Form::Torus(major) => {
                let across = out(point) - major;
                [0.5 - atan2(point.z, point.x) / TAU, 0.5 + atan2(point.y, across) / TAU]
            }
            // As from half the upper radius above the centre of its lower sphere.
            Form::Ovus(top) => [turn(point), 0.5 + atan2(point.y - top / 2.0, out(point)) / PI],
            Form::Lathe(pieces) => [turn(point), along(pieces, [out(point), point.y])],
            Form::Sor { heights, ends } => [turn(point), up(heights, *ends, point, surface, self)],
            Form::Patch(corners) => {
                let [along, across] = body();
                let mix = |i: usize| {
                    let [a, b, c, d] = corners.map(|corner| corner[i]);
                    let (near, far) = (a + (b - a) * along, d + (c - d) * along);
                    near + (far - near) * across
                };
                [mix(0), mix(1)]
            }
            Form::Body => body(),
        };
        if all.iter().all(|coordinate| coordinate.is_finite()) { all } else { [0.0; 2] }
    }
}

/// Returns the distance of a point from the y axis.
fn out(point: Vector) -> f64 {
    Vector::new(point.x, 0.0, point.z).length()
}

/// Returns the turn of a point around the y axis, from x toward z: 0 … 1.
fn turn(point: Vector) -> f64 {
    // Zero has no sign.
    let turn = atan2(point.z + 0.0, point.x + 0.0) / TAU;
    if turn < 0.0 { turn + 1.0 } else { turn }
}

/// Returns the coordinates on a face of the unit box, the lower or `upper` one across `axis`. The six faces
/// lie on a cross of 4 × 3 squares: lower x, upper z, upper x, lower z from the left in the middle row; lower
/// y below upper z, and upper y above it.
fn box_face(Vector { x, y, z }: Vector, axis: usize, upper: bool) -> Coordinates {
    let [column, row] = match (axis, upper) {
        (0, false) => [z, 1.0 + y],
        (0, true) => [3.0 - z, 1.0 + y],
        (1, false) => [1.0 + x, z],
        (1, true) => [1.0 + x, 3.0 - z],
        (_, true) => [1.0 + x, 1.0 + y],
        (_, false) => [4.0 - x, 1.0 + y],
    };
    [column / 4.0, row / 3.0]
}

/// Returns how far along all pieces of an outline its point nearest to `place` is: 0 … 1.
fn along(pieces: &[Piece], place: [f64; 2]) -> f64 {
    const STEPS: usize = 16;
    let off = |piece: &Piece, u: f64| {
        let ([x, y], _) = piece.at(u);
        // What is left of the axis is mirrored.
        let (x, y) = (x.abs() - place[0], y - place[1]);
        x * x + y * y
    };
    let all = pieces.iter().enumerate();
    let starts = all.flat_map(|(at, piece)| {
        (0..=STEPS).map(move |step| (off(piece, step as f64 / STEPS as f64), at, piece, step))
    });
    let nearest = starts.min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, at, piece, step)) = nearest else { return 0.0 };
    let step = step as f64;
    let (mut low, mut high) = ((step - 1.0).max(0.0), (step + 1.0).min(STEPS as f64));
    (low, high) = (low / STEPS as f64, high / STEPS as f64);
    // Where the distance no longer falls.
    let rises = |u: f64| {
        let ([x, y], [along_x, along_y]) = piece.at(u);
        let (mirror, x) = (x.signum(), x.abs());
        (x - place[0]) * mirror * along_x + (y - place[1]) * along_y >= 0.0
    };
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        *(if rises(middle) { &mut high } else { &mut low }) = middle;
    }
    (at as f64 + 0.5 * (low + high)) / pieces.len() as f64
}

/// Returns how far up a sor a point is: 0 … 1 on its side, −1 and 2 in the middle of its ends.
fn up(
    heights: &[f64],
    ends: [f64; 2],
    point: Vector,
    surface: &SurfacePoint,
    mapping: &Mapping,
) -> f64 {
    let (Some(&first), Some(&last)) = (heights.first(), heights.last()) else { return 0.0 };
    let row = mapping.map.matrix.row(1);
    let is_end = row.dot(surface.normal).abs() >= row.length() * (1.0 - 1e-9);
    let size = last - first;
    if is_end && point.y >= last - 1e-9 * size {
        return 2.0 - out(point) / ends[1];
    }
    if is_end && point.y <= first + 1e-9 * size {
        return out(point) / ends[0] - 1.0;
    }
    let segments = heights.len() - 1;
    let segment = heights.partition_point(|height| *height < point.y).clamp(1, segments) - 1;
    let (low, high) = (heights[segment], heights[segment + 1]);
    (segment as f64 + (point.y - low) / (high - low)) / segments as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Matrix;

    const MEASURED: &str = include_str!("measured/uv.txt");

    fn of(shape: &str) -> Mapping {
        let heights = vec![-0.8, -0.4, 0.3, 0.9];
        let form = match shape {
            "sphere" => Form::Sphere,
            "box" => {
                let (low, high) = (Vector::splat(-1.0), Vector::new(0.9, 0.8, 0.7));
                let matrix = Matrix::from_diagonal((high - low).recip());
                return Mapping { form: Form::Box, map: Map::new(low, matrix) };
            }
            "torus" => Form::Torus(0.7),
            "ovus" => Form::Ovus(0.4),
            _ => Form::Sor { heights, ends: [0.7, 0.6] },
        };
        Mapping { form, map: Map::IDENTITY }
    }

    #[test]
    fn coordinates_are_those_of_pov_ray() {
        let mut compared = 0;
        for line in MEASURED.lines().filter(|line| !line.starts_with('#')) {
            let mut words = line.split(' ');
            let mapping = of(words.next().expect("a shape"));
            let n: Vec<f64> = words.map(|word| word.parse().expect("a number")).collect();
            let (point, normal) = (Vector::new(n[0], n[1], n[2]), Vector::new(n[3], n[4], n[5]));
            let made = mapping.at(&SurfacePoint { point, normal, error: 0.0, face: 0 }, None);
            for (made, seen) in made.into_iter().zip([n[6], n[7]]) {
                let off = made - seen;
                assert!((off - off.round()).abs() < 2e-5, "{line}: {made}");
            }
            compared += 1;
        }
        assert!(compared > 100);
    }

    #[test]
    fn a_turn_goes_from_x_toward_z() {
        assert_eq!(turn(Vector::X), 0.0);
        assert_eq!(turn(Vector::Z), 0.25);
        assert_eq!(turn(-Vector::Z), 0.75);
        assert_eq!(turn(Vector::new(1.0, 0.0, -0.0)), 0.0);
    }

    #[test]
    fn a_point_of_an_outline_is_as_far_along_as_its_parameter() {
        let pieces = [
            Piece::line([0.0, 0.0], [1.0, 0.0]),
            Piece::bezier(&[[1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 2.0]]).expect("a piece"),
        ];
        for (at, u) in [(0, 0.25), (1, 0.125), (1, 0.7)] {
            let found = along(&pieces, pieces[at].at(u).0);
            assert!((found - (at as f64 + u) / 2.0).abs() < 1e-7, "{found}");
        }
    }
}
