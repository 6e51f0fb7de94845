//! Terms of polynomials in x, y and z, in the order in which the language lists them: by descending powers of
//! x, then of y, then of z.

/// Returns the exponents of all terms, in order.
///
/// **Source:** the manual's table of polynomial terms, section 3.4.5.3.5.
pub fn exponents(degree: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..=degree).rev().flat_map(move |i| {
        (0..=degree - i).rev().flat_map(move |j| (0..=degree - i - j).rev().map(move |k| [i, j, k]))
    })
}

/// Returns the number of terms of a polynomial: (n + 1)(n + 2)(n + 3) / 6.
pub fn count_of_terms(degree: usize) -> usize {
    (degree + 1) * (degree + 2) * (degree + 3) / 6
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_stand_in_the_manuals_order() {
        let quadric: Vec<_> = exponents(2).collect();
        let written = [
            [2, 0, 0],
            [1, 1, 0],
            [1, 0, 1],
            [1, 0, 0],
            [0, 2, 0],
            [0, 1, 1],
            [0, 1, 0],
            [0, 0, 2],
            [0, 0, 1],
            [0, 0, 0],
        ];
        assert_eq!(quadric, written);
    }

    #[test]
    fn terms_are_as_many_as_are_listed() {
        for degree in 0..=15 {
            assert_eq!(exponents(degree).count(), count_of_terms(degree));
        }
        assert_eq!(count_of_terms(4), 35);
    }
}
