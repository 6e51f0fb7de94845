//! `density_file df3`: values of a grid in the unit cube.
//!
//! **Source:** POV-Ray 3.7 manual, section "Density File" and "DF3 File Format"; behaviour measured.

use crate::math::Vector;

/// A grid of values, 0 to 1, along x first, then y, then z.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    size: [usize; 3],
    values: Vec<f32>,
    pub interpolation: Interpolation,
}

/// How values between the points of a grid are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// 0: that of the cell.
    #[default]
    None,
    /// 1: linear along each axis.
    Linear,
    /// 2: cubic along each axis.
    Cubic,
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

    /// Returns the value at a point; 0 outside of the unit cube.
    pub fn value(&self, point: Vector) -> f64 {
        let inside = |c: f64| (0.0..=1.0).contains(&c);
        if !point.to_array().into_iter().all(inside) {
            return 0.0;
        }
        let along = |axis: usize| point[axis] * self.size[axis] as f64;
        match self.interpolation {
            Interpolation::None => {
                let cell = |axis: usize| (along(axis) as usize).min(self.size[axis] - 1) as i64;
                self.at([cell(0), cell(1), cell(2)])
            }
            Interpolation::Linear => self.blend(point, &[0, 1], |t| [1.0 - t, t]),
            Interpolation::Cubic => self.blend(point, &[-1, 0, 1, 2], |t| {
                // Catmull-Rom.
                let (a, b) = (t * t, t * t * t);
                [
                    0.5 * (-b + 2.0 * a - t),
                    0.5 * (3.0 * b - 5.0 * a + 2.0),
                    0.5 * (-3.0 * b + 4.0 * a + t),
                    0.5 * (b - a),
                ]
            }),
        }
    }

    fn blend<const N: usize>(
        &self,
        point: Vector,
        offsets: &[i64; N],
        weights: impl Fn(f64) -> [f64; N],
    ) -> f64 {
        let at = [0, 1, 2].map(|axis| point[axis] * self.size[axis] as f64 - 0.5);
        let low = at.map(|at| at.floor() as i64);
        let [x, y, z] = [0, 1, 2].map(|axis| weights(at[axis] - low[axis] as f64));
        let mut sum = 0.0;
        for (i, wx) in offsets.iter().zip(x) {
            for (j, wy) in offsets.iter().zip(y) {
                for (k, wz) in offsets.iter().zip(z) {
                    sum += wx * wy * wz * self.at([low[0] + i, low[1] + j, low[2] + k]);
                }
            }
        }
        sum
    }

    /// Returns the value of a cell; that of the nearest one outside of the grid.
    fn at(&self, cell: [i64; 3]) -> f64 {
        let [x, y, z] =
            [0, 1, 2].map(|axis| cell[axis].clamp(0, self.size[axis] as i64 - 1) as usize);
        let at = (z * self.size[1] + y) * self.size[0] + x;
        self.values.get(at).copied().unwrap_or(0.0).into()
    }
}
