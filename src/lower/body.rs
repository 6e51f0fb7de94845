//! Converts each solid other than a sphere, plane or box to a body in its own space, with one placement that
//! holds all its transforms.
//!
//! **In:** a solid as written, and the product of its transforms. **Out:** a [`Placed`].

use std::sync::Arc;

use super::Fault;
use super::quadric;
use super::shape::{FLAT, no_size, traceable};
use super::transform::{Affine, exact};
use crate::math::double::{Double, DoubleVector, exact_middle, power_of_two};
use crate::math::placement::{ExactPlacement, Placement};
use crate::math::terms::exponents;
use crate::math::{UnitVector, Vector, reciprocal_power_of_two};
use crate::scene::mesh::Triangles;
use crate::scene::{self, Container};
use crate::shape::isosurface;
use crate::shape::julia_fractal::{Algebra, Function};
use crate::shape::mesh::{Face, Skin};
use crate::shape::{
    Algebraic, Body, Cone, Cylinder, Disc, Isosurface, JuliaFractal, Memory, Mesh, Ovus,
    Parametric, Placed, Superellipsoid, Torus,
};
use crate::texture::Closed;
use crate::vocabulary::Word;

/// Returns the cylinder of radius 1 from z = −1 to z = 1, between the centres of the ends.
pub fn cylinder(ends: [Vector; 2], radius: f64, open: bool) -> Result<(Body, Affine), Fault> {
    let frame = along_axis(ends, Double::from(radius).abs())?;
    Ok((Body::Cylinder(Cylinder { open }), frame))
}

/// Returns the polynomial in units of λ, divided by its greatest coefficient; a cone about its tip.
pub fn polynomial(degree: usize, terms: &[f64]) -> Result<(Body, Affine), Fault> {
    let (mut terms, mut scale) = normalised(degree, terms);
    let mut tip = DoubleVector::ZERO;
    if degree == 2
        && let Some((about, place)) = quadric::about_tip(&terms)
    {
        tip = place * Double::from(power_of_two(scale));
        let (about, again) = normalised(degree, &about);
        (terms, scale) = (about, scale + again);
    }
    let finite = terms.iter().all(|term| term.is_finite()) && tip.is_finite();
    let surface = Algebraic::new(degree, terms).filter(|_| finite);
    let surface = surface.ok_or_else(|| Fault::not_finite("this polynomial"))?;
    let columns =
        [0, 1, 2].map(|i| DoubleVector::axis(i).map(|c| c * Double::from(power_of_two(scale))));
    Ok((Body::Algebraic(surface), Affine::from_columns(columns, tip)))
}

/// Returns the terms in units of λ, divided by the greatest, and the binary logarithm of λ, chosen so that no
/// term of lower degree outweighs those of the highest.
fn normalised(degree: usize, terms: &[f64]) -> (Vec<f64>, i32) {
    let sum = |powers: [usize; 3]| powers.iter().sum::<usize>();
    let degrees: Vec<usize> = exponents(degree).map(sum).collect();
    let mut greatest = vec![0.0_f64; degree + 1];
    for (term, &degree) in terms.iter().zip(&degrees) {
        greatest[degree] = greatest[degree].max(term.abs());
    }
    let top = greatest.iter().rposition(|size| *size > 0.0).unwrap_or(0);
    let binary = |size: f64| (size.to_bits() >> 52) as i32 - 1023;
    let weight = |d: usize| f64::from(binary(greatest[d]) - binary(greatest[top]));
    let share = |d: usize| (weight(d) / (top - d) as f64).round() as i32;
    let scale = (0..top).filter(|&d| greatest[d] > 0.0).map(share).max().unwrap_or(0);
    let power = |d: usize| binary(greatest[d]) + scale * d as i32;
    let most = (0..=top).filter(|&d| greatest[d] > 0.0).map(power).max().unwrap_or(0);
    let terms = terms.iter().zip(&degrees).map(|(term, &d)| {
        // In two steps, neither of which overflows.
        let shift = scale * d as i32 - most;
        term * power_of_two(shift / 2) * power_of_two(shift - shift / 2)
    });
    (terms.collect(), scale)
}

/// Returns the cone whose wider end, at z = −1, has the radius 1; a cylinder if the radii are equal.
pub fn cone(
    [base, cap]: [Vector; 2],
    radii: [f64; 2],
    open: bool,
) -> Result<(Body, Affine), Fault> {
    let is_base_wide = radii[0].abs() >= radii[1].abs();
    let (wide, narrow) = if is_base_wide { (radii[0], radii[1]) } else { (radii[1], radii[0]) };
    if wide == narrow {
        return cylinder([base, cap], wide, open);
    }
    let ends = if is_base_wide { [base, cap] } else { [cap, base] };
    let cap = (Double::from(narrow) / Double::from(wide)).round();
    Ok((Body::Cone(Cone { cap, open }), along_axis(ends, Double::from(wide).abs())?))
}

/// Returns the disc of radius 1 around the z axis, facing along it.
pub fn disc(
    centre: Vector,
    normal: Vector,
    radius: f64,
    hole: f64,
) -> Result<(Body, Affine), Fault> {
    let size = Double::from(radius).abs();
    let (across, aside, unit) = frame(exact(normal))?;
    let hole = (Double::from(hole).abs() / size).round();
    let columns = [across * size, aside * size, unit * size];
    Ok((Body::Disc(Disc { hole }), Affine::from_columns(columns, exact(centre))))
}

/// Returns the ovus from z = −1 to z = 1.
pub fn ovus(bottom: f64, top: f64) -> (Body, Affine) {
    let (bottom, top) = (Double::from(bottom), Double::from(top));
    let half = Double::from(0.5);
    let size = bottom + top * half;
    let [x, y, z] = [0, 1, 2].map(DoubleVector::axis);
    let frame = Affine::from_columns([x * size, -z * size, y * size], y * (top * half));
    (Body::Ovus(Ovus::new(bottom, top)), frame)
}

/// Returns the superellipsoid in the space it is written in.
pub fn superellipsoid([east, north]: [f64; 2]) -> (Body, Affine) {
    (Body::Superellipsoid(Superellipsoid::new(east, north)), Affine::IDENTITY)
}

/// Returns the Julia fractal in the space it is written in.
pub fn julia_fractal(written: &scene::JuliaFractal) -> (Body, Affine) {
    let scene::JuliaFractal { parameter, iterations, distance, .. } = *written;
    let algebra = match (written.hypercomplex, written.function) {
        (false, function) => Algebra::Quaternion { is_cube: function == Word::Cube },
        (true, function) => Algebra::Hypercomplex(function_of(function, written.power)),
    };
    let squares = written.normal.map(|each| Double::from(each) * Double::from(each));
    let length = squares.into_iter().fold(Double::from(0.0), |sum, square| sum + square).sqrt();
    let normal = written.normal.map(|each| (Double::from(each) / length).round());
    let fractal = JuliaFractal { parameter, algebra, iterations, normal, distance };
    (Body::JuliaFractal(fractal), Affine::IDENTITY)
}

fn function_of(word: Word, power: [f64; 2]) -> Function {
    match word {
        Word::Cube => Function::Cube,
        Word::Exp => Function::Exp,
        Word::Reciprocal => Function::Reciprocal,
        Word::Sin => Function::Sin,
        Word::Asin => Function::Asin,
        Word::Sinh => Function::Sinh,
        Word::Asinh => Function::Asinh,
        Word::Cos => Function::Cos,
        Word::Acos => Function::Acos,
        Word::Cosh => Function::Cosh,
        Word::Acosh => Function::Acosh,
        Word::Tan => Function::Tan,
        Word::Atan => Function::Atan,
        Word::Tanh => Function::Tanh,
        Word::Atanh => Function::Atanh,
        Word::Ln => Function::Ln,
        Word::Pwr => match power {
            [2.0, 0.0] => Function::Sqr,
            [3.0, 0.0] => Function::Cube,
            _ => Function::Pwr(power),
        },
        _ => Function::Sqr,
    }
}

/// Returns the torus about the z axis whose greatest distance from it is 1.
pub fn torus(major: f64, minor: f64) -> (Body, Affine) {
    let (major, minor) = (Double::from(major).abs(), Double::from(minor).abs());
    let size = major + minor;
    let torus = Torus { major: (major / size).round(), minor: (minor / size).round() };
    let [x, y, z] = [0, 1, 2].map(DoubleVector::axis);
    let columns = [x * size, -z * size, y * size];
    (Body::Torus(torus), Affine::from_columns(columns, exact(Vector::ZERO)))
}

/// Returns the surface about its container's centre, in units of a power of two that makes the container of
/// size about 1.
pub fn isosurface(
    function: &Arc<Closed>,
    container: Container,
    threshold: f64,
    accuracy: f64,
    open: bool,
) -> Result<(Body, Affine), Fault> {
    let (container, centre, scale) = held(container)?;
    let function = function.clone();
    let accuracy = accuracy / scale;
    let cells = Memory::default();
    let body = Isosurface { function, threshold, container, centre, scale, accuracy, open, cells };
    Ok((Body::Isosurface(body), about(centre, scale)))
}

/// Returns the surface in the space of its container, as for an isosurface.
pub fn parametric(
    functions: &[Arc<Closed>; 3],
    corners: [[f64; 2]; 2],
    container: Container,
) -> Result<(Body, Affine), Fault> {
    let (container, centre, scale) = held(container)?;
    if !corners.iter().flatten().all(|corner| corner.is_finite()) {
        return Err(Fault::not_finite("the range of u and v"));
    }
    let surface = Parametric::new(functions.clone(), corners, container, centre, scale);
    Ok((Body::Parametric(surface), about(centre, scale)))
}

/// Returns the map that scales by `scale` and moves the origin to `centre`.
fn about(centre: Vector, scale: f64) -> Affine {
    let columns = [0, 1, 2].map(|i| DoubleVector::axis(i).map(|c| c * Double::from(scale)));
    Affine::from_columns(columns, exact(centre))
}

/// Returns a container about its own centre, of size about 1; its centre; and its unit, a power of two.
fn held(container: Container) -> Result<(isosurface::Container, Vector, f64), Fault> {
    let (centre, half) = match container {
        Container::Sphere { centre, radius } => (centre, Vector::splat(radius.abs())),
        Container::Box { corners: [a, b] } => (a * 0.5 + b * 0.5, (b * 0.5 - a * 0.5).abs()),
    };
    if !(centre.is_finite() && half.is_finite()) {
        return Err(Fault::not_finite("this container"));
    }
    let inverse = reciprocal_power_of_two(half.max_element());
    let scale = 1.0 / inverse;
    let container = match container {
        Container::Sphere { .. } => isosurface::Container::Sphere(half.x * inverse),
        Container::Box { .. } => isosurface::Container::Box(half * inverse),
    };
    Ok((container, centre, scale))
}

/// Returns the map that takes the z axis from −1 to 1 to the line between two points, and scales lengths
/// across it by `radius`.
fn along_axis([a, b]: [Vector; 2], radius: Double) -> Result<Affine, Fault> {
    let half = Double::from(0.5);
    let (a, b) = (exact(a), exact(b));
    let axis = (b - a) * half;
    let (across, aside, _) = frame(axis)?;
    Ok(Affine::from_columns([across * radius, aside * radius, axis], (a + b) * half))
}

/// Returns three orthonormal vectors, the last along `axis`.
pub(super) fn frame(
    axis: DoubleVector,
) -> Result<(DoubleVector, DoubleVector, DoubleVector), Fault> {
    let unit = axis.normalized().ok_or_else(|| no_size("this solid has no length"))?;
    // The coordinate axis farthest from it.
    let sizes = unit.round().abs();
    let away = (0..3).min_by(|&i, &j| sizes[i].total_cmp(&sizes[j])).unwrap_or(0);
    let across = unit.cross(DoubleVector::axis(away)).normalized();
    let across = across.ok_or_else(|| no_size("this solid has no length"))?;
    Ok((across, unit.cross(across), unit))
}

/// Returns triangles about the centre of their bounding box, of size about 1; `None` if every one is
/// degenerate. The size is rounded to a power of two, and subtracting the centre does not round any vertex: a
/// vertex shared by two meshes is the same in both.
pub fn mesh(triangles: &Triangles) -> Result<Option<(Body, Affine)>, Fault> {
    if triangles.faces.is_empty() {
        return Ok(None);
    }
    let used = || triangles.faces.iter().flat_map(|face| face.vertices);
    let (low, high) = used().fold((Vector::INFINITY, Vector::NEG_INFINITY), |(low, high), i| {
        let vertex = triangles.vertices[i as usize];
        (low.min(vertex), high.max(vertex))
    });
    if !(low.is_finite() && high.is_finite()) {
        return Err(Fault::not_finite("this mesh"));
    }
    let middle = Vector::from_array([0, 1, 2].map(|axis| exact_middle((low[axis], high[axis]))));
    let half = (middle - low).abs().max((high - middle).abs());
    let inverse_size = reciprocal_power_of_two(half.max_element());
    let size = 1.0 / inverse_size;
    let local = |vertex: &Vector| (*vertex * inverse_size - middle * inverse_size) * 0.5;
    let corners = triangles.vertices.iter().map(local).collect();
    let faces =
        triangles.faces.iter().map(|face| Face { corners: face.vertices, normals: face.normals });
    let inside = triangles.inside.and_then(UnitVector::from_direction);
    // A zero normal is ignored; the others of its face count alone.
    let unit =
        |normal: &Vector| UnitVector::from_direction(*normal).map_or(Vector::ZERO, |n| n.get());
    let normals = triangles.normals.iter().map(unit).collect();
    let body = Mesh::with_skin(corners, normals, faces.collect(), inside, skin(triangles));
    let size = Double::from(2.0 * size);
    let columns = [0, 1, 2].map(|axis| DoubleVector::axis(axis) * size);
    let frame = Affine::from_columns(columns, exact(middle));
    Ok(body.map(|mesh| (Body::Mesh(mesh), frame)))
}

/// Returns the textures of the faces.
fn skin(triangles: &Triangles) -> Skin {
    let Triangles { faces, uvs, textures, .. } = triangles;
    let mut skin = Skin::default();
    if faces.iter().any(|face| face.paint.is_some()) {
        // The mesh's own texture follows those of its faces.
        let bare = match textures.len() {
            0 => Skin::BARE,
            count => [count as u32; 3],
        };
        skin.paint = faces.iter().map(|face| face.paint.unwrap_or(bare)).collect();
    }
    if faces.iter().any(|face| face.uvs.is_some()) {
        skin.places = faces.iter().map(|face| face.uvs.unwrap_or(Skin::BARE)).collect();
        skin.uvs.clone_from(uvs);
    }
    skin
}

/// Returns a body placed in the world by `map`.
pub fn place(body: Arc<Body>, map: &Affine) -> Result<Placed, Fault> {
    let what = format!("this {}", body.word());
    if !map.is_finite() {
        return Err(Fault::not_finite(&what));
    }
    let inverse = map.checked().map_err(|_| no_size(FLAT))?;
    let placement = Placement {
        centre: map.offset().round(),
        world_from_local: map.matrix(Double::ONE),
        local_from_world: inverse.matrix(Double::ONE),
    };
    let placement = traceable(placement, &what)?;
    let exact = || Box::new(ExactPlacement::new(map.rows(), map.offset(), &placement));
    let exact = body.keeps_exact_place().then(exact);
    Ok(Placed { body, placement, root_tolerance: 0.0, exact })
}
