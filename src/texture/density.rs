//! `density_file df3`: values of a grid in the unit cube.
//!
//! **Source:** POV-Ray 3.7 manual, section "Density File" and "DF3 File Format"; values measured on POV-Ray 3.7, to
//! its single precision.

use std::sync::Arc;

use crate::math::Vector;

/// A grid of values, 0 to 1, along x first, then y, then z.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    size: [usize; 3],
    values: Arc<[f32]>,
    pub interpolation: Interpolation,
}

/// How values between the points of a grid are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// 0: that of the cell.
    #[default]
    None,
    /// 1: linear along each axis, between the lowest corners of the cells.
    Linear,
    /// 2: cubic along each axis, between the same points.
    Cubic,
}

impl Interpolation {
    /// Returns the interpolation that `interpolate` names, without its fraction; any other number is 2.
    pub fn of_number(number: f64) -> Self {
        match number.trunc() {
            0.0 => Self::None,
            1.0 => Self::Linear,
            _ => Self::Cubic,
        }
    }
}

impl Grid {
    /// Reads a file of the kind df3: three sizes, then values of 1, 2 or 4 bytes, the highest first.
    ///
    /// # Errors
    /// Says what is wrong with the bytes.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        let size = |at: usize| {
            let pair = bytes.get(2 * at..2 * at + 2).ok_or("it is shorter than its three sizes")?;
            Ok::<_, &str>(usize::from(pair[0]) * 256 + usize::from(pair[1]))
        };
        let size = [size(0)?, size(1)?, size(2)?];
        let count: usize = size.iter().product();
        if count == 0 {
            return Err("one of its sizes is 0".to_owned());
        }
        let rest = &bytes[6..];
        let width = match rest.len() / count {
            0 => return Err(format!("it has {} bytes for {count} values", rest.len())),
            1 => 1,
            2 | 3 => 2,
            _ => 4,
        };
        let most = match width {
            1 => 255.0,
            2 => 65_535.0,
            _ => u32::MAX as f32,
        };
        let value = |bytes: &[u8]| bytes.iter().fold(0.0, |sum, &b| sum * 256.0 + f32::from(b));
        let values = rest.chunks_exact(width).take(count).map(|bytes| value(bytes) / most);
        Ok(Self { size, values: values.collect(), interpolation: Interpolation::None })
    }

    /// Returns the value at a point; 0 outside of the unit cube. A cubic may exceed 1. The values are those of the low corners of the
    /// cells, and the grid goes on behind its end as at its beginning.
    pub fn value(&self, point: Vector) -> f64 {
        let inside = |c: f64| (0.0..1.0).contains(&c);
        if !point.to_array().into_iter().all(inside) {
            return 0.0;
        }
        match self.interpolation {
            Interpolation::None => self.blend(point, &[0], |_| [1.0]),
            Interpolation::Linear => self.blend(point, &[0, 1], |t| [1.0 - t, t]),
            Interpolation::Cubic => {
                let cubic = self.blend(point, &[-1, 0, 1, 2], |t| {
                    // Catmull-Rom.
                    let (a, b) = (t * t, t * t * t);
                    [
                        0.5 * (-b + 2.0 * a - t),
                        0.5 * (3.0 * b - 5.0 * a + 2.0),
                        0.5 * (-3.0 * b + 4.0 * a + t),
                        0.5 * (b - a),
                    ]
                });
                cubic.max(0.0)
            }
        }
    }

    fn blend<const N: usize>(
        &self,
        point: Vector,
        offsets: &[i64; N],
        weights: impl Fn(f64) -> [f64; N],
    ) -> f64 {
        let at = [0, 1, 2].map(|axis| point[axis] * self.size[axis] as f64);
        let low = at.map(|at| at as i64);
        let [x, y, z] = [0, 1, 2].map(|axis| weights(at[axis] - low[axis] as f64));
        let mut sum = 0.0;
        for (i, wx) in offsets.iter().zip(x) {
            for (j, wy) in offsets.iter().zip(y) {
                for (k, wz) in offsets.iter().zip(z) {
                    sum += wx * wy * wz * self.at([low[0] + i, low[1] + j, low[2] + k]);
                }
            }
        }
        // A cubic may undershoot, and overshoot: what exceeds 1 begins again, as in any pattern.
        sum.max(0.0)
    }

    /// Returns the value of a cell, cyclic along each axis. POV-Ray 3.7 takes −1 modulo the size without its sign,
    /// so its first cells are another's unless the size is a power of two.
    fn at(&self, cell: [i64; 3]) -> f64 {
        let [x, y, z] =
            [0, 1, 2].map(|axis| cell[axis].rem_euclid(self.size[axis] as i64) as usize);
        let at = (z * self.size[1] + y) * self.size[0] + x;
        self.values.get(at).copied().unwrap_or(0.0).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers printed by POV-Ray 3.7: the file, then points with the value of each interpolation.
    const MEASURED: &str = include_str!("measured/density.txt");

    #[test]
    fn values_between_the_points_of_a_grid_are_those_of_pov_ray() {
        let bytes: Vec<u8> = MEASURED.lines().next().map_or(Vec::new(), |line| {
            line.split(',').map(|byte| byte.parse().expect("a byte")).collect()
        });
        let grid = Grid::read(&bytes).expect("a grid");
        for line in MEASURED.lines().skip(1) {
            let numbers: Vec<f64> =
                line.split(' ').map(|number| number.parse().expect("a number")).collect();
            let [x, y, z, values @ ..] = &numbers[..] else { panic!("{line}") };
            let kinds = [Interpolation::None, Interpolation::Linear, Interpolation::Cubic];
            for (interpolation, expected) in kinds.into_iter().zip(values) {
                let grid = Grid { interpolation, ..grid.clone() };
                let value = grid.value(Vector::new(*x, *y, *z));
                assert!((value - expected).abs() < 1e-6, "{interpolation:?} {line}: {value}");
            }
        }
    }

    #[test]
    fn other_numbers_of_interpolation_are_truncated() {
        let bytes = [0, 4, 0, 1, 0, 1, 0, 100, 50, 255];
        let mut grid = Grid::read(&bytes).expect("a grid");
        // x, and 255 times the value by no interpolation, linear and cubic, as POV-Ray 3.7 gives them.
        let rows = [
            (0.0, 0.0, 0.0, 0.0),
            (0.0312, 0.0, 12.48, 0.0),
            (0.125, 0.0, 50.0, 37.187),
            (0.25, 100.0, 100.0, 100.0),
            (0.375, 100.0, 75.0, 68.437),
            (0.625, 50.0, 152.5, 165.313),
            (0.75, 255.0, 255.0, 255.0),
            (0.875, 255.0, 127.5, 134.062),
            (0.9375, 255.0, 63.75, 49.570),
            (1.0, 0.0, 0.0, 0.0),
        ];
        for (x, none, linear, cubic) in rows {
            for (number, wanted) in [(0.0, none), (1.9, linear), (2.0, cubic), (-1.0, cubic)] {
                grid.interpolation = Interpolation::of_number(number);
                let value = 255.0 * grid.value(Vector::new(x, 0.5, 0.5));
                assert!((value - wanted).abs() < 2e-3, "{x} {number}: {value}, {wanted}");
            }
        }
    }
}
