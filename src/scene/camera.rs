//! Cameras as written: the keywords in order, without defaults.

use super::TransformId;
use crate::math::Vector;
use crate::source::Site;

/// The camera's keywords in written order, without defaults. As in POV-Ray 3.7 (measured) the order matters
/// only among equal keywords, where the last counts, and among transforms, unless `is_in_order`.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    pub kind: CameraKind,
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

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CameraKind {
    #[default]
    Perspective,
    Orthographic,
}

#[derive(Debug, Clone, PartialEq)]
pub struct CameraItem {
    pub kind: CameraItemKind,
    pub site: Site,
}

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
    /// The native lens shift, in widths and heights of the screen.
    Shift {
        x: f64,
        y: f64,
    },
    Transform(TransformId),
    /// The point where a camera with keywords in order becomes orthographic: it then keeps the view that it
    /// has of `look_at` there.
    Orthographic,
}
