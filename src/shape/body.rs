//! The closed set of bodies: solids and sheets, each with an equation in its local space.

use super::algebraic::Algebraic;
use super::bicubic_patch::BicubicPatch;
use super::blob::Blob;
use super::cone::Cone;
use super::cylinder::Cylinder;
use super::disc::Disc;
use super::height_field::HeightField;
use super::isosurface::Isosurface;
use super::julia_fractal::JuliaFractal;
use super::lathe::Lathe;
use super::local::{Crossings, Facet, Height, Local, LocalRay, Met};
use super::mesh::Mesh;
use super::ovus::Ovus;
use super::parametric::Parametric;
use super::polygon::Polygon;
use super::prism::Prism;
use super::sor::Sor;
use super::sphere_sweep::SphereSweep;
use super::superellipsoid::Superellipsoid;
use super::text::Text;
use super::torus::Torus;
use crate::math::Vector;

/// Declares the closed set of bodies, each of which has a file of its own.
macro_rules! bodies {
    ($($kind:ident $word:literal)*) => {
        /// A body of one kind, with its parameters.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Body {
            $($kind($kind),)*
        }

        impl Body {
            /// The keywords of all kinds.
            pub const WORDS: &[&str] = &[$($word),*];

            /// Returns the keyword of its kind in the scene language.
            pub fn word(&self) -> &'static str {
                match self {
                    $(Self::$kind(_) => $word,)*
                }
            }

        }

        impl Local for Body {
            fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
                match self {
                    $(Self::$kind(body) => body.crossings(ray, found),)*
                }
            }

            fn first_crossings(
                &self,
                ray: &LocalRay,
                between: (f64, f64),
                found: &mut Crossings,
            ) {
                match self {
                    $(Self::$kind(body) => body.first_crossings(ray, between, found),)*
                }
            }

            fn crosses(
                &self,
                ray: &LocalRay,
                between: (f64, f64),
                accepts: &dyn Fn(&Met) -> bool,
            ) -> bool {
                match self {
                    $(Self::$kind(body) => body.crosses(ray, between, accepts),)*
                }
            }

            fn first_crossings_together(
                &self,
                lines: &[LocalRay],
                between: &[(f64, f64)],
                each: &mut dyn FnMut(usize, &mut Crossings),
            ) {
                match self {
                    $(Self::$kind(body) => body.first_crossings_together(lines, between, each),)*
                }
            }

            fn crosses_together(
                &self,
                lines: &[LocalRay],
                between: &[(f64, f64)],
                accepts: &dyn Fn(usize, &Met) -> bool,
            ) -> u32 {
                match self {
                    $(Self::$kind(body) => body.crosses_together(lines, between, accepts),)*
                }
            }

            fn part_at(&self, ray: &LocalRay, s: f64, leaving: bool) -> Option<u32> {
                match self {
                    $(Self::$kind(body) => body.part_at(ray, s, leaving),)*
                }
            }

            fn height(&self, part: u32, point: Vector) -> Height {
                match self {
                    $(Self::$kind(body) => body.height(part, point),)*
                }
            }

            fn facet(&self, part: u32) -> Option<Facet> {
                match self {
                    $(Self::$kind(body) => body.facet(part),)*
                }
            }

            fn extent(&self, along: Vector) -> (f64, f64) {
                match self {
                    $(Self::$kind(body) => body.extent(along),)*
                }
            }

            fn nearest_extent(&self, along: Vector) -> (f64, f64) {
                match self {
                    $(Self::$kind(body) => body.nearest_extent(along),)*
                }
            }

            fn reach(&self) -> f64 {
                match self {
                    $(Self::$kind(body) => body.reach(),)*
                }
            }

            fn contains(&self, point: Vector) -> bool {
                match self {
                    $(Self::$kind(body) => body.contains(point),)*
                }
            }

            fn certainly_contains(&self, point: Vector) -> bool {
                match self {
                    $(Self::$kind(body) => body.certainly_contains(point),)*
                }
            }

            fn numbers(&self) -> String {
                match self {
                    $(Self::$kind(body) => body.numbers(),)*
                }
            }

            fn is_iterated(&self) -> bool {
                match self {
                    $(Self::$kind(body) => body.is_iterated(),)*
                }
            }

            fn price(&self) -> u64 {
                match self {
                    $(Self::$kind(body) => body.price(),)*
                }
            }

            fn is_sheet(&self) -> bool {
                match self {
                    $(Self::$kind(body) => body.is_sheet(),)*
                }
            }

            fn shading_normal(&self, part: u32, point: Vector) -> Option<Vector> {
                match self {
                    $(Self::$kind(body) => body.shading_normal(part, point),)*
                }
            }
        }
    };
}

bodies! {
    Algebraic "polynomial"
    BicubicPatch "bicubic_patch"
    Blob "blob"
    Cone "cone"
    Cylinder "cylinder"
    Disc "disc"
    HeightField "height_field"
    Isosurface "isosurface"
    JuliaFractal "julia_fractal"
    Lathe "lathe"
    Mesh "mesh"
    Ovus "ovus"
    Parametric "parametric"
    Polygon "polygon"
    Prism "prism"
    Sor "sor"
    SphereSweep "sphere_sweep"
    Superellipsoid "superellipsoid"
    Text "text"
    Torus "torus"
}
