//! Cached values that are derived from a shape.
//!
//! **Invariant:** a cached value is not part of the shape: shapes that differ only in it compare equal.

use std::fmt;
use std::ops::{Deref, DerefMut};

#[derive(Clone, Copy, Default)]
pub struct Memory<T>(pub T);

impl<T> Deref for Memory<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T> DerefMut for Memory<T> {
    fn deref_mut(&mut self) -> &mut T {
        &mut self.0
    }
}

impl<T> PartialEq for Memory<T> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl<T> fmt::Debug for Memory<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Memory")
    }
}
