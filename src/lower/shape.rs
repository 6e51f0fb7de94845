//! Applies an affine map to a solid: returns the simplest canonical form that holds the result exactly.
//!
//! **In:** a solid as written, and the product of its transforms. **Out:** a canonical solid. **Invariant:**
//! the form depends on the resulting solid, not on its spelling.

use super::Fault;
use super::transform::{Affine, Cofactors, exact};
use crate::diagnostic::Code;
use crate::math::double::{Double, DoubleVector};
use crate::math::placement::Placement;
use crate::math::{Matrix, UnitVector, Vector};
use crate::shape::{Box_, Ellipsoid, Plane, Sphere};

/// The canonical form of a sphere.
pub enum Round {
    Sphere(Sphere),
    Ellipsoid(Ellipsoid),
}

/// A flat face of a solid before its map: the local plane `normal · p = distance`.
#[derive(Debug, Clone, Copy)]
pub struct LocalFace {
    pub normal: DoubleVector,
    pub distance: Double,
}

/// Returns a sphere if the map consists of translations, rotations and uniform scales, else an ellipsoid.
pub fn sphere(centre: Vector, radius: f64, map: &Affine) -> Result<Round, Fault> {
    let radius = Double::from(radius).abs();
    let centre = map.point(exact(centre)).round();
    if let Some(scale) = map.uniform_scale() {
        let radius = (radius * scale).round();
        if !centre.is_finite() || !radius.is_finite() {
            return Err(Fault::not_finite("this sphere"));
        }
        if radius == 0.0 {
            return Err(no_size("this sphere is too small for a number"));
        }
        return Ok(Round::Sphere(Sphere { centre, radius }));
    }
    let (world_from_local, local_from_world) = map.stretch().ok_or_else(|| no_size(FLAT))?;
    let placement = Placement {
        centre,
        world_from_local: world_from_local.matrix(radius),
        local_from_world: local_from_world.matrix(Double::ONE / radius),
    };
    let placement = traceable(placement, "this sphere")?;
    Ok(Round::Ellipsoid(Ellipsoid { placement }))
}

/// Returns the placement, or a fault if the squares of its lengths, with room for their sums and for the
/// surroundings, are not finite: rays are intersected in the solid's own space.
pub fn traceable(placement: Placement, what: &str) -> Result<Placement, Fault> {
    let Placement { centre, world_from_local, local_from_world } = placement;
    let maps = [world_from_local, local_from_world];
    if !(centre.is_finite() && maps.iter().all(Matrix::is_finite)) {
        return Err(Fault::not_finite(what));
    }
    let size =
        |map: &Matrix| [map.x_axis, map.y_axis, map.z_axis].map(|axis| axis.abs().max_element());
    let greatest = |map: &Matrix| size(map).into_iter().fold(0.0, f64::max);
    match maps.iter().all(|map| greatest(map) < LARGEST) {
        true => Ok(placement),
        false => {
            let end = if greatest(&world_from_local) < LARGEST { "small" } else { "large" };
            let message = format!("{what} is too {end} to be traced");
            Err(Fault::new(Code::OutOfRange, message)
                .label("spheres and boxes may be of any size, other solids of 10⁻¹⁴⁴ to 10¹⁴⁴"))
        }
    }
}

/// 2⁴⁸⁰: its square, times any number of lengths that can be written, is finite, and so is that of its
/// reciprocal.
const LARGEST: f64 = 3.1217485503159922e+144;

/// Returns the plane `normal · p = distance · |normal|`, inside out if `inverse`.
pub fn plane(
    normal: Vector,
    distance: f64,
    inverse: bool,
    map: &Affine,
) -> Result<(Plane, LocalFace), Fault> {
    let local_normal =
        exact(normal).normalized().ok_or_else(|| Fault::no_direction("this plane's normal"))?;
    let local = LocalFace { normal: local_normal, distance: Double::from(distance) };
    let Cofactors { rows, determinant } = map.cofactors().ok_or_else(|| no_size(FLAT))?;
    // The normal transforms by the inverse transpose, here times |determinant|.
    let n = local.normal;
    let towards = rows[0] * n.x + rows[1] * n.y + rows[2] * n.z;
    let towards = if determinant.round() < 0.0 { -towards } else { towards };
    let unit = towards.normalized().ok_or_else(|| no_size(FLAT))?;
    let unit = map.without_rounding(unit);
    let distance = local.distance * determinant.abs() / towards.length() + unit.dot(map.offset());
    let (unit, distance) = if inverse { (-unit, -distance) } else { (unit, distance) };
    if !unit.is_finite() || !distance.is_finite() {
        return Err(Fault::not_finite("this plane"));
    }
    let plane = Plane { normal: UnitVector::from_unit(unit.round()), distance: distance.round() };
    Ok((plane, local))
}

/// Returns the box between two corners, and its six faces before the map, in the order of the canonical box.
///
/// Each normal is named after its nearest axis and points along it, so that a box rotated by 90° is the box
/// with its sides exchanged.
pub fn box_(corners: [Vector; 2], map: &Affine) -> Result<(Box_, [LocalFace; 6]), Fault> {
    let [a, b] = corners.map(exact);
    let half = Double::from(0.5);
    let centre = map.point((a + b) * half);
    let half_widths = ((b - a) * half).map(Double::abs).components();
    let sides = match map.is_translation {
        true => std::array::from_fn(|axis| {
            let (normal, half_width) = (DoubleVector::axis(axis), half_widths[axis]);
            Side { axis, normal, half_width, turned: false }
        }),
        false => turned_sides(half_widths, map)?,
    };
    let faces = sides.each_ref().map(|side| {
        let (low, high) = (a.components()[side.axis], b.components()[side.axis]);
        let (low, high) = if low.round() <= high.round() { (low, high) } else { (high, low) };
        let axis = DoubleVector::axis(side.axis);
        let ends = [
            LocalFace { normal: axis, distance: high },
            LocalFace { normal: -axis, distance: -low },
        ];
        if side.turned { [ends[1], ends[0]] } else { ends }
    });
    if !centre.is_finite()
        || !sides.iter().all(|side| side.normal.is_finite() && side.half_width.is_finite())
    {
        return Err(Fault::not_finite("this box"));
    }
    let solid = Box_ {
        centre: centre.round(),
        normals: sides.each_ref().map(|side| UnitVector::from_unit(side.normal.round())),
        half_widths: sides.each_ref().map(|side| side.half_width.round()),
    };
    if solid.half_widths.iter().filter(|width| **width == 0.0).count() >= 2 {
        return Err(no_size("this box is too small for a number"));
    }
    let [x, y, z] = faces;
    Ok((solid, [x[0], x[1], y[0], y[1], z[0], z[1]]))
}

/// Returns the sides of a box of these half widths that a map turns.
fn turned_sides(half_widths: [Double; 3], map: &Affine) -> Result<[Side; 3], Fault> {
    let Cofactors { rows, determinant } = map.cofactors().ok_or_else(|| no_size(FLAT))?;
    let mut sides = Vec::with_capacity(3);
    for (axis, row) in rows.into_iter().enumerate() {
        let unit = map.without_rounding(row.normalized().ok_or_else(|| no_size(FLAT))?);
        let unit = if determinant.round() < 0.0 { -unit } else { unit };
        let half_width = half_widths[axis] * determinant.abs() / row.length();
        sides.push(Side { axis, normal: unit, half_width, turned: false });
    }
    Ok(in_canonical_order(sides, map.bound()))
}

/// One of a box's three pairs of opposite faces.
#[derive(Debug, Clone, Copy)]
struct Side {
    /// The local axis of the pair.
    axis: usize,
    normal: DoubleVector,
    half_width: Double,
    /// The canonical normal is that of the low face.
    turned: bool,
}

/// Orders the sides so that the first is nearest to x, and the second, of the others, nearest to y, each
/// pointing along its axis. Components closer than `bound` count as equal, and the next axis decides.
fn in_canonical_order(mut sides: Vec<Side>, bound: f64) -> [Side; 3] {
    let near = |a: f64, b: f64| (a - b).abs() <= bound;
    std::array::from_fn(|axis| {
        let key = |side: &Side| {
            let n = side.normal.components().map(Double::round);
            let key = [n[axis], n[(axis + 1) % 3], n[(axis + 2) % 3]];
            let leading = key.iter().find(|c| !near(**c, 0.0)).copied().unwrap_or(0.0);
            (leading < 0.0, key.map(|c| if leading < 0.0 { -c } else { c }))
        };
        let mut best = 0;
        for candidate in 1..sides.len() {
            let (ours, theirs) = (key(&sides[candidate]).1, key(&sides[best]).1);
            let decisive = ours.iter().zip(theirs).find(|&(&a, b)| !near(a, b));
            if decisive.is_some_and(|(&a, b)| a > b) {
                best = candidate;
            }
        }
        let side = sides.remove(best);
        match key(&side).0 {
            true => Side { normal: -side.normal, turned: true, ..side },
            false => side,
        }
    })
}

pub const FLAT: &str = "the transforms leave this solid no volume";

pub fn no_size(message: &str) -> Fault {
    Fault::new(Code::ZeroSize, message).label("nothing of it can be seen")
}
