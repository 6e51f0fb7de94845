//! A camera as it is written: its words in order, without the defaults.

use super::TransformId;
use crate::math::Vector;
use crate::source::Site;

/// The camera's words in written order, without the defaults. As in POV-Ray 3.7 (measured) the order
/// only matters among equal words, where the last counts, and among transforms, unless `is_in_order`.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    pub kind: CameraKind,
    pub items: Vec<CameraItem>,
    /// Each word changes what those before it came to, as in scenes for POV-Ray 3.1 and older.
    pub is_in_order: bool,
    pub site: Site,
}

impl Camera {
    /// Whether its words in written order may come to another camera than the same words sorted.
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
    /// The seed's lens shift, in widths and heights of the screen.
    Shift {
        x: f64,
        y: f64,
    },
    Transform(TransformId),
    /// Where a camera whose words act in order becomes orthographic: it goes on to see what it would see
    /// there, at `look_at`.
    Orthographic,
}
