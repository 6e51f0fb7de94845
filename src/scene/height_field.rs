//! Landscapes as they were read: heights in rows.

/// Heights over the unit square.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightField {
    /// What it came from, for people to read.
    pub from: String,
    /// From 0 to 1, along x; rows of them along z.
    pub heights: Vec<f32>,
    /// How many there are in a row: 2 or more, as of rows.
    pub width: usize,
    /// What is lower is not seen.
    pub water: f64,
    /// It is lit as if it were round.
    pub smooth: bool,
}

impl HeightField {
    /// Nothing of it is above the water.
    pub fn is_nothing(&self) -> bool {
        !self.heights.iter().any(|height| f64::from(*height) >= self.water)
    }
}
