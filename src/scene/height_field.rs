//! Height fields as read: rows of heights.

/// Heights over the unit square.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightField {
    /// The name of its source, for display.
    pub from: String,
    /// Heights from 0 to 1, along x, in rows along z.
    pub heights: Vec<f32>,
    /// The number of heights in a row; at least 2 heights and 2 rows.
    pub width: usize,
    /// Heights below this are invisible.
    pub water: f64,
    /// Shaded with interpolated normals.
    pub smooth: bool,
}

impl HeightField {
    /// Returns whether no height reaches the water level.
    pub fn is_nothing(&self) -> bool {
        !self.heights.iter().any(|height| f64::from(*height) >= self.water)
    }
}
