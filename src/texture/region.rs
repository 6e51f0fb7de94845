//! Regions of space: what is inside an object, for the pattern `object`.

use std::any::Any;
use std::fmt;
use std::sync::Arc;

use crate::math::Vector;

/// Something that contains some points of space.
///
/// A trait, because what a pattern contains lies in a module above this one: a World of its own.
pub trait Contains: fmt::Debug + Send + Sync {
    fn contains(&self, point: Vector) -> bool;

    /// Returns whether it is of the same type as `other`, and equal to it.
    fn is_equal(&self, other: &dyn Any) -> bool;

    fn as_any(&self) -> &dyn Any;
}

/// A region, shared by the patterns that have it.
#[derive(Debug, Clone)]
pub struct Region(pub Arc<dyn Contains>);

impl PartialEq for Region {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0.is_equal(other.0.as_any())
    }
}

impl Region {
    /// Returns 1 inside, and 0 outside.
    pub fn value(&self, point: Vector) -> f64 {
        f64::from(u8::from(self.0.contains(point)))
    }
}
