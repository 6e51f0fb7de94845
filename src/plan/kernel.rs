//! Selects the kernel that traces a frame. Hot effects are compiled into kernels instead of being tested
//! for each ray.
//!
//! **Invariant:** one piece of code, compiled once per combination of exactly three flags.

/// Selects the kernel that traces a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Kernel {
    /// Traces rays toward lights.
    pub shadows: bool,
    /// Traces rays from surface to surface.
    pub secondary: bool,
    /// Intersects solids other than spheres, planes and boxes.
    pub bodies: bool,
}

impl Kernel {
    pub const ALL: [Self; 8] = {
        let mut all = [Self::EVERYTHING; 8];
        let mut i = 0;
        while i < all.len() {
            all[i] = Self { shadows: i & 1 != 0, secondary: i & 2 != 0, bodies: i & 4 != 0 };
            i += 1;
        }
        all
    };

    /// The kernel that can trace any World.
    pub const EVERYTHING: Self = Self { shadows: true, secondary: true, bodies: true };

    pub const fn name(self) -> &'static str {
        match (self.shadows, self.secondary, self.bodies) {
            (false, false, false) => "bare",
            (true, false, false) => "shadows",
            (false, true, false) => "secondary",
            (true, true, false) => "shadows+secondary",
            (false, false, true) => "bodies",
            (true, false, true) => "shadows+bodies",
            (false, true, true) => "secondary+bodies",
            (true, true, true) => "shadows+secondary+bodies",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_combination_is_a_kernel_of_its_own() {
        assert!(Kernel::ALL.len() <= 16, "so many at most");
        for (i, kernel) in Kernel::ALL.iter().enumerate() {
            assert_eq!(Kernel::ALL.iter().position(|other| other.name() == kernel.name()), Some(i));
        }
    }
}
