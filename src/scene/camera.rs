//! Cameras as written: the keywords in order, without defaults.

use super::{NormalId, ObjectId, PigmentId, TransformId};
use crate::math::Vector;
use crate::source::Site;

/// The camera's keywords in written order, without defaults. As in POV-Ray 3.7 (measured) the order matters
/// only among equal keywords, where the last counts, and among transforms, unless `is_in_order`.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    pub kind: CameraKind,
    /// Of a `mesh_camera`.
    pub meshes: Option<MeshCamera>,
    pub items: Vec<CameraItem>,
    /// Each keyword changes the result of those before it, as in scenes for POV-Ray 3.1 and older.
    pub is_in_order: bool,
    pub site: Site,
}

impl Camera {
    /// Returns whether the written order may give another camera than the sorted order.
    pub fn order_matters(&self) -> bool {
        let step = |item: &CameraItem| match item.kind {
            CameraItemKind::Angle(_) | CameraItemKind::LookAt(_) => 1,
            CameraItemKind::Transform(_) => 2,
            _ => 0,
        };
        let is_sorted = self.items.is_sorted_by_key(step);
        self.is_in_order && !(is_sorted && self.kind == CameraKind::Perspective)
    }
}

/// Kind of a [`Camera`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CameraKind {
    #[default]
    Perspective,
    Orthographic,
    Fisheye,
    UltraWideAngle,
    Omnimax,
    Panoramic,
    Cylinder(CylinderForm),
    Spherical,
    Mesh,
}

/// The block of a `mesh_camera`.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshCamera {
    /// At least 1.
    pub rays: u32,
    pub distribution: Distribution,
    /// What is farther away is not seen; 0: all is.
    pub max_distance: f64,
    /// At least one.
    pub meshes: Vec<ObjectId>,
    pub smooth: bool,
    pub site: Site,
}

/// How pixels choose faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Distribution {
    /// Each ray of a pixel has a mesh of its own.
    Layers,
    /// All meshes are one.
    Sum,
    /// The meshes are side by side in the picture.
    Beside,
    /// By the faces' texture coordinates.
    Unwrapped,
}

impl Distribution {
    const ALL: [Self; 4] = [Self::Layers, Self::Sum, Self::Beside, Self::Unwrapped];

    /// Returns the distribution that the language calls by this number, 0 to 3.
    pub fn from_number(number: u32) -> Option<Self> {
        Self::ALL.get(number as usize).copied()
    }

    /// Returns its number in the language.
    pub fn number(self) -> usize {
        self as usize
    }
}

impl CameraKind {
    /// Returns whether `angle` is the angle of a flat screen, and sets the length of `direction`.
    pub fn is_flat(self) -> bool {
        matches!(self, Self::Perspective | Self::Orthographic)
    }
}

/// How the screen of a cylindrical camera is bent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CylinderForm {
    /// From left to right; all rays start at one point.
    Upright,
    /// From bottom to top.
    Level,
    /// As `Upright`, with rays that start along the cylinder's axis, at right angles to it.
    UprightMoving,
    /// Likewise as `Level`.
    LevelMoving,
}

impl CylinderForm {
    const ALL: [Self; 4] = [Self::Upright, Self::Level, Self::UprightMoving, Self::LevelMoving];

    /// Returns the form that the language calls by this number, 1 to 4.
    pub fn from_number(number: u32) -> Option<Self> {
        Self::ALL.get(number.checked_sub(1)? as usize).copied()
    }

    pub fn is_upright(self) -> bool {
        matches!(self, Self::Upright | Self::UprightMoving)
    }

    pub fn is_moving(self) -> bool {
        matches!(self, Self::UprightMoving | Self::LevelMoving)
    }
}

/// A keyword of a camera, with its values.
#[derive(Debug, Clone, PartialEq)]
pub struct CameraItem {
    pub kind: CameraItemKind,
    pub site: Site,
}

/// Kind of a [`CameraItem`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CameraItemKind {
    Location(Vector),
    LookAt(Vector),
    Sky(Vector),
    Up(Vector),
    Right(Vector),
    Direction(Vector),
    /// Horizontal field of view in degrees.
    Angle(f64),
    /// Vertical field of view of a spherical camera in degrees; behind its `Angle`.
    VerticalAngle(f64),
    /// The native lens shift, in widths and heights of the screen.
    Shift {
        x: f64,
        y: f64,
    },
    /// The width of the opening through which a blurring lens sees: twice its diameter.
    Aperture(f64),
    /// The least number of rays of a pixel, if it is written, and the most.
    BlurSamples(Option<u32>, u32),
    FocalPoint(Vector),
    Confidence(f64),
    Variance(f64),
    Bokeh(PigmentId),
    Normal(NormalId),
    Transform(TransformId),
    /// The point where a camera with keywords in order becomes orthographic: it then keeps the view that it
    /// has of `look_at` there.
    Orthographic,
}
