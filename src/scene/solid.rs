//! Solids as written: their own numbers, before any transform.

use std::fmt;
use std::sync::Arc;

use super::blob::Blob;
use super::height_field::HeightField;
use super::julia_fractal::JuliaFractal;
use super::mesh::Triangles;
use super::outline::{Point, Spline, are_in_line};
use super::polygon::Polygon;
use super::sweep::Sweep;
use super::text::Text;
use crate::math::Vector;
use crate::math::vector::written;
use crate::texture::Closed;
use crate::vocabulary::Word;

/// A solid or a sheet, with its numbers as written.
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// A bicubic Bézier surface.
    BicubicPatch {
        /// Four rows of four.
        points: Box<[Vector; 16]>,
        /// Texture coordinates of its corners.
        uvs: Option<Box<[[f64; 2]; 4]>>,
    },
    /// Stored once, however often it is used.
    HeightField {
        field: Arc<HeightField>,
    },
    Sphere {
        centre: Vector,
        radius: f64,
    },
    /// The half space `normal · p ≤ distance · |normal|`; as in POV-Ray, `distance` is along the normalised
    /// normal.
    Plane {
        normal: Vector,
        distance: f64,
    },
    Box {
        corners: [Vector; 2],
    },
    /// Stored once, however often it is used.
    Blob(Arc<Blob>),
    Cylinder {
        /// The centres of its ends.
        ends: [Vector; 2],
        radius: f64,
        /// Without end caps.
        open: bool,
    },
    Cone {
        /// The centres of its ends.
        ends: [Vector; 2],
        /// The radius at each end. If their signs differ, two cones touch at their tips.
        radii: [f64; 2],
        /// Without end caps.
        open: bool,
    },
    Disc {
        centre: Vector,
        normal: Vector,
        radius: f64,
        /// The radius of its central hole.
        hole: f64,
    },
    /// On the y axis, with the bottom sphere about the origin.
    Ovus {
        /// The radii of the two spheres, 0 or more.
        bottom: f64,
        top: f64,
    },
    /// Stored once, however often it is used.
    SphereSweep(Arc<Sweep>),
    /// Between −1 and 1 along each axis.
    Superellipsoid {
        /// East-west and north-south, more than 0.
        exponents: [f64; 2],
    },
    /// A surface of points given by three functions of u and v, within a container.
    Parametric {
        functions: [Arc<Closed>; 3],
        /// Two corners of the range of u and v.
        corners: [[f64; 2]; 2],
        container: Box<Container>,
    },
    /// The set where a function is less than a threshold, within a container.
    Isosurface {
        function: Arc<Closed>,
        container: Box<Container>,
        threshold: f64,
        /// A length.
        accuracy: f64,
        /// Without caps where the container cuts it.
        open: bool,
    },
    /// A four-dimensional fractal.
    JuliaFractal(Box<JuliaFractal>),
    /// About the y axis.
    Torus {
        /// The distance from the axis to the centre of the tube.
        major: f64,
        /// The radius of the tube.
        minor: f64,
    },
    /// A curve revolved about the y axis.
    Lathe {
        spline: Spline,
        /// Distance from the axis, and height. Stored once, however often it is used.
        points: Arc<[Point]>,
    },
    /// An outline in the xz plane, extruded along y.
    Prism {
        spline: Spline,
        /// The outline is scaled by y.
        conic: bool,
        heights: [f64; 2],
        /// The points of all closed curves, in sequence. Stored once, however often it is used.
        points: Arc<[Point]>,
        /// Without end caps.
        open: bool,
    },
    /// A solid of revolution whose squared radius is a function of the height.
    Sor {
        /// Radius and height. Stored once, however often it is used.
        points: Arc<[Point]>,
        /// Without end caps.
        open: bool,
    },
    /// A flat polygon.
    Polygon {
        polygon: Polygon,
    },
    /// The set where a polynomial in x, y and z is 0 or less.
    Polynomial {
        /// Its keyword.
        form: Word,
        /// 2 … 15.
        degree: usize,
        /// All coefficients, in the order of [`crate::math::terms::exponents`].
        terms: Vec<f64>,
    },
    /// Letters. Stored once, however often they are used.
    Text {
        text: Arc<Text>,
    },
    /// A single triangle or a mesh. Stored once, however often it is used.
    Triangles {
        /// The keyword that opens it.
        word: Word,
        triangles: Arc<Triangles>,
    },
}

/// The region in which the surface of a function is searched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Container {
    Box { corners: [Vector; 2] },
    Sphere { centre: Vector, radius: f64 },
}

impl Container {
    fn is_sizeless(&self) -> bool {
        match self {
            Self::Box { corners: [a, b] } => (*b - *a).to_array().contains(&0.0),
            Self::Sphere { radius, .. } => *radius == 0.0,
        }
    }
}

impl fmt::Display for Container {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Box { corners: [a, b] } => write!(f, "in box {} {}", written(*a), written(*b)),
            Self::Sphere { centre, radius } => {
                write!(f, "in sphere {} {radius}", written(*centre))
            }
        }
    }
}

impl Solid {
    /// Returns the keyword that opens it.
    pub fn word(&self) -> Word {
        match self {
            Self::BicubicPatch { .. } => Word::BicubicPatch,
            Self::HeightField { .. } => Word::HeightField,
            Self::Polygon { .. } => Word::Polygon,
            Self::Sphere { .. } => Word::Sphere,
            Self::Plane { .. } => Word::Plane,
            Self::Box { .. } => Word::Box,
            Self::Blob(_) => Word::Blob,
            Self::Cylinder { .. } => Word::Cylinder,
            Self::Cone { .. } => Word::Cone,
            Self::Disc { .. } => Word::Disc,
            Self::Ovus { .. } => Word::Ovus,
            Self::SphereSweep(_) => Word::SphereSweep,
            Self::Superellipsoid { .. } => Word::Superellipsoid,
            Self::Isosurface { .. } => Word::Isosurface,
            Self::JuliaFractal(_) => Word::JuliaFractal,
            Self::Parametric { .. } => Word::Parametric,
            Self::Text { .. } => Word::Text,
            Self::Torus { .. } => Word::Torus,
            Self::Lathe { .. } => Word::Lathe,
            Self::Prism { .. } => Word::Prism,
            Self::Sor { .. } => Word::Sor,
            Self::Polynomial { form, .. } => *form,
            Self::Triangles { word, .. } => *word,
        }
    }

    /// Returns whether the solid is empty: a sphere of radius 0, a box that is a line or a point, a cylinder
    /// or a cone without length or width, a disc that is all hole, an ovus of two points, a torus of no
    /// thickness, a prism without height or with a collinear outline, a curve that is a point or lies in its
    /// axis, a constant polynomial, collinear points, a text without visible letters, a height field under
    /// water.
    pub fn is_sizeless(&self) -> bool {
        match self {
            Self::BicubicPatch { points, .. } => {
                Polygon { lines: vec![points.to_vec()] }.plane().is_none()
            }
            Self::HeightField { field } => field.is_nothing(),
            Self::Polygon { polygon } => polygon.plane().is_none(),
            Self::Sphere { radius, .. } => *radius == 0.0,
            Self::Plane { .. } | Self::Superellipsoid { .. } | Self::JuliaFractal(_) => false,
            Self::Box { corners: [first, second] } => {
                (*second - *first).to_array().iter().filter(|side| **side == 0.0).count() >= 2
            }
            Self::Blob(blob) => blob.is_weak(),
            Self::Cylinder { ends: [base, cap], radius, .. } => *radius == 0.0 || base == cap,
            Self::Cone { ends: [base, cap], radii, .. } => *radii == [0.0; 2] || base == cap,
            Self::Disc { radius, hole, .. } => radius.abs() <= hole.abs(),
            Self::Ovus { bottom, top } => bottom.max(*top) == 0.0,
            Self::SphereSweep(sweep) => sweep.is_sizeless(),
            Self::Isosurface { container, .. } => container.is_sizeless(),
            Self::Parametric { corners: [a, b], container, .. } => {
                a[0] == b[0] || a[1] == b[1] || container.is_sizeless()
            }
            Self::Text { text } => text.is_nothing(),
            Self::Torus { minor, .. } => *minor == 0.0,
            Self::Lathe { points, .. } => {
                points.iter().all(|[radius, _]| *radius == 0.0)
                    || points.iter().all(|point| *point == points[0])
            }
            Self::Prism { heights: [low, high], points, .. } => low == high || are_in_line(points),
            Self::Sor { points, .. } => {
                // The first and the last define slopes.
                points[1..points.len() - 1].iter().all(|[radius, _]| *radius == 0.0)
            }
            Self::Polynomial { terms, .. } => {
                terms.split_last().is_none_or(|(_, terms)| terms.iter().all(|term| *term == 0.0))
            }
            Self::Triangles { triangles, .. } => triangles.faces.is_empty(),
        }
    }
}

/// Prints its keyword and its numbers.
impl fmt::Display for Solid {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.word().name())?;
        let open = |open: bool| if open { " open" } else { "" };
        match self {
            Self::Sphere { centre, radius } => write!(f, " {} {radius}", written(*centre)),
            Self::Plane { normal, distance } => write!(f, " {} {distance}", written(*normal)),
            Self::Box { corners: [a, b] } => write!(f, " {} {}", written(*a), written(*b)),
            Self::Blob(blob) => {
                let Blob { threshold, components, .. } = &**blob;
                write!(f, " of {} components, threshold {threshold}", components.len())
            }
            Self::Cylinder { ends: [a, b], radius, open: is_open } => {
                write!(f, " {} {} {radius}{}", written(*a), written(*b), open(*is_open))
            }
            Self::Cone { ends: [a, b], radii: [base, cap], open: is_open } => {
                let (a, b) = (written(*a), written(*b));
                write!(f, " {a} {base} {b} {cap}{}", open(*is_open))
            }
            Self::Disc { centre, normal, radius, hole } => {
                write!(f, " {} {} {radius} {hole}", written(*centre), written(*normal))
            }
            Self::Ovus { bottom, top } => write!(f, " {bottom} {top}"),
            Self::SphereSweep(sweep) => {
                write!(f, " {} of {} spheres", sweep.kind.word().name(), sweep.spheres.len())
            }
            Self::Superellipsoid { exponents: [e, n] } => write!(f, " <{e}, {n}>"),
            Self::Isosurface { function, container, threshold, accuracy, open: is_open } => {
                let operations = function.function().operations();
                write!(f, " of {operations} operations, {container}, threshold {threshold}")?;
                write!(f, ", accuracy {accuracy}{}", open(*is_open))
            }
            Self::JuliaFractal(fractal) => write!(f, "{fractal}"),
            Self::Parametric { functions, corners: [a, b], container } => {
                let operations: usize =
                    functions.iter().map(|each| each.function().operations()).sum();
                write!(
                    f,
                    " of {operations} operations, <{}, {}> <{}, {}>, {container}",
                    a[0], a[1], b[0], b[1]
                )
            }
            Self::Text { text } => {
                let Text { string, letters, thickness } = &**text;
                write!(f, " {string:?} of {} letters, {thickness} thick", letters.len())
            }
            Self::Torus { major, minor } => write!(f, " {major} {minor}"),
            Self::Lathe { spline, points } => {
                write!(f, " {}", spline.word().name())?;
                write_points(f, points)
            }
            Self::Prism { spline, conic, heights: [low, high], points, open: is_open } => {
                let sweep = if *conic { " conic_sweep" } else { "" };
                write!(f, " {}{sweep} {low} {high}", spline.word().name())?;
                write_points(f, points)?;
                write!(f, "{}", open(*is_open))
            }
            Self::Sor { points, open: is_open } => {
                write_points(f, points)?;
                write!(f, "{}", open(*is_open))
            }
            Self::BicubicPatch { points, .. } => {
                points.iter().try_for_each(|point| write!(f, " {}", written(*point)))
            }
            Self::HeightField { field } => {
                let HeightField { from, heights, width, water, smooth } = &**field;
                let rows = heights.len() / width;
                let smooth = if *smooth { ", smooth" } else { "" };
                write!(f, " of {from}, {width}×{rows}, water_level {water}{smooth}")
            }
            Self::Polygon { polygon } => {
                let lines = polygon.lines.len();
                write!(f, " of {} points, {lines} line{}", polygon.count(), plural(lines))
            }
            Self::Polynomial { degree, terms, .. } => {
                write!(f, " {degree}")?;
                terms.iter().try_for_each(|term| write!(f, " {term}"))
            }
            Self::Triangles { triangles, .. } => {
                let Triangles { vertices, faces, textures, inside, .. } = &**triangles;
                write!(f, " of {} faces, {} vertices", faces.len(), vertices.len())?;
                if !textures.is_empty() {
                    let count = textures.len();
                    write!(f, ", {count} texture{}", plural(count))?;
                }
                match inside {
                    Some(way) => write!(f, ", inside_vector {}", written(*way)),
                    None => Ok(()),
                }
            }
        }
    }
}

fn write_points(f: &mut fmt::Formatter, points: &[Point]) -> fmt::Result {
    points.iter().try_for_each(|[a, b]| write!(f, " <{a}, {b}>"))
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}
