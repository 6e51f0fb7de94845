//! Singular values of a matrix: the factors by which it stretches space along orthogonal axes that it keeps
//! orthogonal.

use super::{Matrix, Vector};

/// Maximum number of sweeps over the pairs of columns; three almost always suffice.
const SWEEPS: usize = 30;

/// Returns the singular values of a finite matrix, largest first.
///
/// Pairs of columns are rotated until all are orthogonal; their lengths are the values.
///
/// **Error:** a few units in the last place of the largest value; of each value itself if the columns are
/// orthogonal from the start, however different their lengths.
///
/// **Source:** Demmel and Veselić, "Jacobi's method is more accurate than QR", SIAM J. Matrix Anal. Appl. 13
/// (1992), algorithm 4.1.
pub fn singular_values(matrix: Matrix) -> [f64; 3] {
    let [a, b, c, d, e, f, g, h, i] = matrix.to_cols_array();
    let mut columns = [Vector::new(a, b, c), Vector::new(d, e, f), Vector::new(g, h, i)];
    for _ in 0..SWEEPS {
        let mut turned = false;
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let (long, short) = (length(columns[p]), length(columns[q]));
            if long == 0.0 || short == 0.0 {
                continue;
            }
            let cosine = (columns[p] / long).dot(columns[q] / short);
            if cosine.abs() <= f64::EPSILON {
                continue;
            }
            turned = true;
            let half = (short / long - long / short) / (2.0 * cosine);
            let tangent = half.signum() / (half.abs() + (1.0 + half * half).sqrt());
            let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
            let sine = cosine * tangent;
            let (first, second) = (columns[p], columns[q]);
            columns[p] = first * cosine - second * sine;
            columns[q] = first * sine + second * cosine;
        }
        if !turned {
            break;
        }
    }
    let mut values = columns.map(length);
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// |v|, even if its square overflows or underflows.
fn length(v: Vector) -> f64 {
    let largest = v.abs().max_element();
    if largest == 0.0 { 0.0 } else { (v / largest).length() * largest }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::elementary::{cos, sin};

    fn turn(angle: f64) -> Matrix {
        let (s, c) = (sin(angle), cos(angle));
        Matrix::from_cols(Vector::new(c, s, 0.0), Vector::new(-s, c, 0.0), Vector::Z)
    }

    #[test]
    fn a_scale_between_rotations_is_found_again() {
        for factors in [[3.0, 2.0, 1.0], [1e9, 1.0, 1e-3], [5.0, 5.0, 1e-12]] {
            let scale = Matrix::from_diagonal(Vector::from_array(factors));
            let found = singular_values(turn(0.7) * scale * turn(-1.3));
            for (found, factor) in found.iter().zip(factors) {
                assert!((found - factor).abs() < 1e-15 * 8.0 * factors[0], "{found} {factor}");
            }
        }
    }

    #[test]
    fn columns_at_right_angles_are_exact_at_any_size() {
        let scale = Matrix::from_diagonal(Vector::new(1e-200, 1e200, -4.0));
        assert_eq!(singular_values(scale), [1e200, 4.0, 1e-200]);
        assert_eq!(singular_values(Matrix::ZERO), [0.0; 3]);
    }

    #[test]
    fn nearly_equal_columns_leave_a_small_value() {
        let near = Vector::new(1.0, 1e-9, 0.0);
        let [large, _, small] = singular_values(Matrix::from_cols(Vector::X, near, Vector::Z));
        assert!((large / small / 2e9 - 1.0).abs() < 1e-6, "{large} {small}");
    }
}
