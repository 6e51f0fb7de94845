//! The camera in canonical form: a point and three vectors, a lens, and how space is shown on the screen.

use std::sync::Arc;

use crate::math::{UnitVector, Vector};
use crate::texture::{Normal, Pigment};

/// The camera. The point (u, v) of the screen, −½ … ½ from left to right and from bottom to top, is seen
/// along `forward + u·right + v·up` from `location` (perspective), or along `forward` from `location +
/// u·right + v·up` (orthographic). A lens shift is part of `forward` or `location`. `docs/world.md` has the other
/// kinds.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    pub kind: CameraKind,
    pub location: Vector,
    pub forward: Vector,
    pub right: Vector,
    pub up: Vector,
    pub focus: Option<Focus>,
    /// Of a camera whose rays start on meshes.
    pub meshes: Option<Arc<MeshCamera>>,
    /// Bends the rays.
    pub normal: Option<Arc<Normal>>,
}

impl Camera {
    /// Returns whether all rays start at the camera's `location`.
    pub fn has_one_origin(&self) -> bool {
        self.kind.has_one_origin() && self.focus.is_none()
    }
}

/// A lens that blurs what is not in focus.
#[derive(Debug, Clone, PartialEq)]
pub struct Focus {
    /// More than 0.
    pub radius: f64,
    /// The distance of what is in focus: along `forward` for flat screens, otherwise along each ray.
    pub distance: f64,
    /// The rays of a pixel, at least and at most: 1 ≤ `least` ≤ `most`.
    pub least: u32,
    pub most: u32,
    /// The probability with which the variance of a pixel is below `variance`, 0 ≤ `confidence` < 1.
    pub confidence: f64,
    pub variance: f64,
    /// How bright the lens is, over the square <0, 0> … <1, 1>; `None` for a disc that is bright everywhere.
    pub bokeh: Option<Arc<Pigment>>,
}

/// A camera whose rays start on faces of meshes.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshCamera {
    pub faces: Faces,
    /// What is farther away is not seen by its rays; may be infinite.
    pub reach: f64,
}

/// The faces that a camera's rays start on.
#[derive(Debug, Clone, PartialEq)]
pub enum Faces {
    /// A pixel has a ray for each list, at the place of its number, and shows the mean of them.
    Layers(Vec<Vec<Face>>),
    /// The lists are side by side in the picture.
    Beside(Vec<Vec<Face>>),
    /// Rays start where the first face has the place in the picture as texture coordinates, `offset` along their
    /// directions.
    Unwrapped { faces: Vec<UnwrappedFace>, offset: f64 },
}

/// The ray of a face: its direction has length 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    pub origin: Vector,
    pub direction: UnitVector,
}

/// A face with the texture coordinates of its corners, and the directions of rays there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnwrappedFace {
    pub uvs: [[f64; 2]; 3],
    pub corners: [Vector; 3],
    pub directions: [UnitVector; 3],
}

/// How a camera shows space on the screen. Angles are in turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CameraKind {
    Perspective,
    Orthographic,
    Fisheye {
        angle: f64,
    },
    UltraWideAngle {
        angle: f64,
    },
    Omnimax,
    Panoramic,
    /// The screen is bent from left to right (`upright`) or from bottom to top by `angle`. Rays start at one point, or
    /// along the axis of the cylinder (`moving`).
    Cylinder {
        upright: bool,
        moving: bool,
        angle: f64,
    },
    Spherical {
        across: f64,
        down: f64,
    },
    /// Rays start on faces; see `Camera::meshes`.
    Mesh,
}

impl CameraKind {
    /// Returns whether all rays start at one point, without a lens that blurs.
    fn has_one_origin(self) -> bool {
        match self {
            Self::Orthographic | Self::Mesh => false,
            Self::Cylinder { moving, .. } => !moving,
            _ => true,
        }
    }

    /// Returns whether the screen is a plane.
    pub fn is_flat(self) -> bool {
        matches!(self, Self::Perspective | Self::Orthographic)
    }
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            kind: CameraKind::Perspective,
            location: Vector::ZERO,
            forward: -Vector::Z,
            right: Vector::X * (4.0 / 3.0),
            up: Vector::Y,
            focus: None,
            meshes: None,
            normal: None,
        }
    }
}
