//! The hot effects: those the tracer decides by a kernel of its own, not by a branch for each ray.
//!
//! **Invariant:** one piece of code, compiled once for each combination; two bits, at most three; at most
//! sixteen kernels in all.

/// Which kernel traces a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Kernel {
    /// Rays toward lights.
    pub shadows: bool,
    /// Rays from surface to surface.
    pub secondary: bool,
}

impl Kernel {
    pub const ALL: [Self; 4] = [
        Self { shadows: false, secondary: false },
        Self { shadows: true, secondary: false },
        Self { shadows: false, secondary: true },
        Self::EVERYTHING,
    ];

    /// The kernel that can trace any World.
    pub const EVERYTHING: Self = Self { shadows: true, secondary: true };

    pub const fn name(self) -> &'static str {
        match (self.shadows, self.secondary) {
            (false, false) => "bare",
            (true, false) => "shadows",
            (false, true) => "secondary",
            (true, true) => "shadows+secondary",
        }
    }

    /// Whether this program has it. All are there but in a build for measurements, with
    /// `--cfg lucarne_only_kernel="shadows"` and the like, which has that one alone.
    pub const fn is_compiled(self) -> bool {
        match (self.shadows, self.secondary) {
            _ if !only_one() => true,
            (false, false) => cfg!(lucarne_only_kernel = "bare"),
            (true, false) => cfg!(lucarne_only_kernel = "shadows"),
            (false, true) => cfg!(lucarne_only_kernel = "secondary"),
            (true, true) => cfg!(lucarne_only_kernel = "shadows+secondary"),
        }
    }
}

const fn only_one() -> bool {
    cfg!(any(
        lucarne_only_kernel = "bare",
        lucarne_only_kernel = "shadows",
        lucarne_only_kernel = "secondary",
        lucarne_only_kernel = "shadows+secondary"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_combination_is_a_kernel_of_its_own_and_is_compiled() {
        assert!(Kernel::ALL.len() <= 16, "so many at most");
        for (i, kernel) in Kernel::ALL.iter().enumerate() {
            assert_eq!(Kernel::ALL.iter().position(|other| other.name() == kernel.name()), Some(i));
            assert!(kernel.is_compiled());
        }
    }
}
