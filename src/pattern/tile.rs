//! Convex tiles that repeat on a lattice of the plane, and the distance of a point from its tile's border.

use crate::math::elementary::sin_cos_degrees;

/// A point of the plane, or a displacement.
pub(super) type Flat = [f64; 2];

/// Coordinates are clamped to this, beyond which they are too coarse for tiles.
const FAR: f64 = 1e15;

/// A convex tile.
#[derive(Debug, Clone)]
pub(super) struct Tile {
    /// The number that tells kinds of tiles apart.
    pub kind: u8,
    /// Vertices, anticlockwise.
    corners: Vec<Flat>,
    /// Factors of the distances from some sides, by the side's outward normal in degrees.
    shortened: &'static [(f64, f64)],
}

impl Tile {
    pub fn new(kind: u8, corners: Vec<Flat>) -> Self {
        Self { kind, corners, shortened: &[] }
    }

    /// Returns a rectangle.
    pub fn rectangle(kind: u8, [x, z]: Flat, [width, depth]: Flat) -> Self {
        let (w, d) = (width / 2.0, depth / 2.0);
        Self::new(kind, vec![[x - w, z - d], [x + w, z - d], [x + w, z + d], [x - w, z + d]])
    }

    /// Returns a regular polygon of side 1, whose first side has an outward normal of `degrees`.
    pub fn regular(kind: u8, sides: u16, [x, z]: Flat, degrees: f64) -> Self {
        let turn = 360.0 / f64::from(sides);
        let radius = 0.5 / sin_cos_degrees(turn / 2.0).0;
        let corner = |i: u16| {
            let (sin, cos) = sin_cos_degrees(degrees + turn * (f64::from(i) - 0.5));
            [x + radius * cos, z + radius * sin]
        };
        Self::new(kind, (0..sides).map(corner).collect())
    }

    /// Multiplies the distances from some sides, given by their outward normals in degrees.
    pub fn with_shortened(self, shortened: &'static [(f64, f64)]) -> Self {
        Self { shortened, ..self }
    }

    fn sides(&self, by: Flat) -> Vec<Side> {
        let next = self.corners.iter().cycle().skip(1);
        let side = |(from, to): (&Flat, &Flat)| {
            let along = [to[0] - from[0], to[1] - from[1]];
            let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
            let inward = [-along[1] / length, along[0] / length];
            let factor = self.shortened.iter().find(|(degrees, _)| {
                let (sin, cos) = sin_cos_degrees(*degrees);
                inward[0] * cos + inward[1] * sin < -0.99
            });
            let factor = factor.map_or(1.0, |(_, factor)| *factor);
            let inward = inward.map(|component| component * factor);
            Side { inward, offset: dot(inward, [from[0] + by[0], from[1] + by[1]]) }
        };
        self.corners.iter().zip(next).map(side).collect()
    }
}

/// A half-plane.
#[derive(Debug, Clone)]
struct Side {
    inward: Flat,
    offset: f64,
}

/// Tiles that cover the plane.
#[derive(Debug)]
pub(super) struct Lattice {
    /// Two displacements that repeat it.
    steps: [Flat; 2],
    /// All tiles that overlap the parallelogram of `steps`, by kind.
    cell: Vec<(u8, Vec<Side>)>,
}

/// A place within a tile.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub kind: u8,
    /// The distance from the tile's border.
    pub depth: f64,
}

impl Lattice {
    /// Builds the lattice from one tile of each class.
    pub fn new(steps: [Flat; 2], tiles: &[Tile]) -> Self {
        let mut cell = Vec::new();
        let reach = -6..=6;
        for tile in tiles {
            let corners = tile.corners.iter().map(|&corner| in_steps(steps, corner));
            let (mut low, mut high) = ([f64::MAX; 2], [f64::MIN; 2]);
            for corner in corners {
                for axis in 0..2 {
                    low[axis] = low[axis].min(corner[axis]);
                    high[axis] = high[axis].max(corner[axis]);
                }
            }
            for (i, j) in reach.clone().flat_map(|i| reach.clone().map(move |j| (i, j))) {
                let moved = [f64::from(i), f64::from(j)];
                let overlaps = |axis: usize| {
                    low[axis] + moved[axis] < 1.0 + SLACK && high[axis] + moved[axis] > -SLACK
                };
                if overlaps(0) && overlaps(1) {
                    cell.push((tile.kind, tile.sides(from_steps(steps, moved))));
                }
            }
        }
        cell.sort_by_key(|(kind, _)| *kind);
        Self { steps, cell }
    }

    /// Returns the place of a point that may be off by `error` in any direction. A point that may be on a
    /// border is on it, in the tile of the lowest kind.
    pub fn place(&self, point: Flat, error: f64) -> Place {
        let point = point.map(|coordinate| coordinate.clamp(-FAR, FAR));
        let error = error + (point[0].abs() + point[1].abs() + 4.0) * (4.0 * f64::EPSILON);
        let cell = in_steps(self.steps, point).map(f64::floor);
        let start = from_steps(self.steps, cell);
        let point = [point[0] - start[0], point[1] - start[1]];
        let mut nearest = Place { kind: 0, depth: f64::NEG_INFINITY };
        for (kind, sides) in &self.cell {
            let mut depth = f64::INFINITY;
            for side in sides {
                depth = depth.min(dot(side.inward, point) - side.offset);
                if depth <= nearest.depth {
                    break;
                }
            }
            if depth > nearest.depth {
                nearest = Place { kind: *kind, depth };
                if depth >= -error {
                    break;
                }
            }
        }
        let depth = if nearest.depth <= error { 0.0 } else { nearest.depth };
        Place { depth, ..nearest }
    }
}

/// Margin, in steps, by which a cell is widened for rounding.
const SLACK: f64 = 1e-6;

fn dot(a: Flat, b: Flat) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Returns the displacement of numbers of steps.
fn from_steps([u, v]: [Flat; 2], [i, j]: Flat) -> Flat {
    [u[0] * i + v[0] * j, u[1] * i + v[1] * j]
}

/// Returns the inverse of [`from_steps`].
fn in_steps([u, v]: [Flat; 2], [x, z]: Flat) -> Flat {
    let area = u[0] * v[1] - u[1] * v[0];
    [(x * v[1] - z * v[0]) / area, (u[0] * z - u[1] * x) / area]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_border_has_one_kind_throughout() {
        let square = |kind, x| Tile::regular(kind, 4, [x, 0.5], 0.0);
        let stripes = Lattice::new([[2.0, 0.0], [0.0, 1.0]], &[square(1, 0.5), square(0, 1.5)]);
        for off in [-1e-10, 0.0, 1e-10] {
            for border in [-2.0, -1.0, 0.0, 1.0, 7.0] {
                let place = stripes.place([border + off, 0.3], 1e-9);
                assert_eq!((place.kind, place.depth), (0, 0.0), "{border} {off}");
            }
        }
        let place = stripes.place([4.25, 0.5], 1e-9);
        assert!(place.kind == 1 && (place.depth - 0.25).abs() < 1e-15);
    }
}
