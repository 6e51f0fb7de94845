//! The stages that rays pass through. A stage that no effect calls for is not in the list, and does not run.

/// A stage of tracing. Rays go through all of a plan's stages in this order; those that `Scatter` sends on begin again
/// at `Intersect`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Points of the picture become rays.
    Camera,
    /// Rays find what they meet.
    Intersect,
    /// What lies between rays' starts and what they meet: fog and rainbows.
    Medium,
    /// Where a ray meets a surface: its point, its normal, its texture; elsewhere the sky.
    Surface,
    /// What surfaces send to the viewer of each light.
    Light,
    /// Rays toward the lights.
    Shadow,
    /// Rays that go on from surfaces, mirrored or through them.
    Scatter,
    /// What these rays see is added to the surfaces that they left.
    Fold,
}

impl Stage {
    /// All stages, in their order.
    pub const ALL: [Self; 8] = [
        Self::Camera,
        Self::Intersect,
        Self::Medium,
        Self::Surface,
        Self::Light,
        Self::Shadow,
        Self::Scatter,
        Self::Fold,
    ];

    /// Returns the name of the stage.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Camera => "camera",
            Self::Intersect => "intersect",
            Self::Medium => "medium",
            Self::Surface => "surface",
            Self::Light => "light",
            Self::Shadow => "shadow",
            Self::Scatter => "scatter",
            Self::Fold => "fold",
        }
    }
}
