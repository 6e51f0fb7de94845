//! Cameras on meshes against POV-Ray 3.7's pictures.

use super::super::tests::assert_meets;

/// Declarations of meshes; then lines as [`assert_meets`] reads them.
const MEASURED: &str = include_str!("measured.txt");

#[test]
fn rays_start_where_pov_ray_lets_them() {
    assert_meets(MEASURED, 214);
}
