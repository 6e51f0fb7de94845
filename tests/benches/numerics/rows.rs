//! The rows of the table in `docs/numerics.md`: what is measured, and from how far. A body's row has its word.

/// What it says above each column.
pub const HEADER: &str = "| what | distance | f32: wrong | error | ns | f64: wrong | error | ns | ours: wrong | error | bound | share | ns | × |";

/// Each kernel, and the distances from which it is tried.
pub const ROWS: [(&str, &[f64]); 28] = [
    (SPHERE, FAR),
    (PLANET, &[1e4, 1e6, 1e8, 1e10, 1e12]),
    (PLANE, FAR),
    (BOX, FAR),
    (ELLIPSOID, FAR),
    (CYLINDER, FAR),
    (CONE, FAR),
    (TORUS, FAR),
    (QUADRIC, FAR),
    (POLYNOMIAL, FAR),
    (MESH, FAR),
    (POLYGON, FAR),
    (BICUBIC_PATCH, FAR),
    (HEIGHT_FIELD, FAR),
    (TEXT, FAR),
    (DISC, FAR),
    (PRISM, FAR),
    (LATHE, FAR),
    (SOR, FAR),
    (OVUS, FAR),
    (BLOB, FAR),
    (SPHERE_SWEEP, FAR),
    (SUPERELLIPSOID, FAR),
    (ISOSURFACE, FAR),
    (JULIA_FRACTAL, FAR),
    (PARAMETRIC, FAR),
    (WHOLE, FAR),
    (SINE, FAR),
];

pub const SPHERE: &str = "sphere";
pub const PLANET: &str = "planet";
pub const PLANE: &str = "plane";
pub const BOX: &str = "box";
pub const ELLIPSOID: &str = "ellipsoid";
pub const CYLINDER: &str = "cylinder";
pub const CONE: &str = "cone";
pub const TORUS: &str = "torus";
pub const QUADRIC: &str = "quadric";
pub const POLYNOMIAL: &str = "polynomial";
pub const MESH: &str = "mesh";
pub const POLYGON: &str = "polygon";
pub const BICUBIC_PATCH: &str = "bicubic_patch";
pub const HEIGHT_FIELD: &str = "height_field";
pub const TEXT: &str = "text";
pub const DISC: &str = "disc";
pub const PRISM: &str = "prism";
pub const LATHE: &str = "lathe";
pub const SOR: &str = "sor";
pub const OVUS: &str = "ovus";
pub const BLOB: &str = "blob";
pub const SPHERE_SWEEP: &str = "sphere_sweep";
pub const SUPERELLIPSOID: &str = "superellipsoid";
pub const JULIA_FRACTAL: &str = "julia_fractal";
pub const ISOSURFACE: &str = "isosurface";
pub const PARAMETRIC: &str = "parametric";
pub const WHOLE: &str = "difference";
pub const SINE: &str = "sine";

const FAR: &[f64] = &[1e1, 1e3, 1e5, 1e6, 1e8];
