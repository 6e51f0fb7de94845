//! `diffuse albedo 0.7`: the fraction of all incident light that is scattered, in any direction.
//!
//! **Invariant:** a finish stores the weight of the brightest direction. With brilliance `b`, Phong's
//! exponent `n`, or Blinn's, an albedo `a` gives the weight `a·(b + 1)/2`, `a·(n + 1)/2`, `a·(n + 2) / (4·(2
//! − 2^(−n/2)))`, with the values of `b` and `n` at the end of the block; a finish that starts from this one
//! inherits the weights.
//!
//! **Source:** POV-Ray manual, section 3.4.6.3.3.1 "Diffuse" and after. The factors, and their application at
//! the end of the block, were measured on POV-Ray 3.7 and agree in all of 16 bits.

use crate::evaluate::Evaluator;
use crate::evaluate::stream::{Token, TokenKind};
use crate::math::elementary::pow;
use crate::scene::ClassicFinish;
use crate::vocabulary::Word;

/// Which weights of a block are albedos.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Albedo {
    pub diffuse: bool,
    pub phong: bool,
    pub specular: bool,
}

impl Albedo {
    /// Converts albedos to the weights of the brightest direction.
    pub fn spend(self, finish: &mut ClassicFinish) {
        if self.diffuse {
            let factor = (finish.brilliance + 1.0) / 2.0;
            finish.diffuse *= factor;
            finish.behind *= factor;
        }
        if self.phong {
            finish.phong *= (finish.phong_size + 1.0) / 2.0;
        }
        if self.specular {
            let n = 1.0 / finish.roughness;
            finish.specular *= (n + 2.0) / (4.0 * (2.0 - pow(2.0, -n / 2.0)));
        }
    }
}

impl Evaluator<'_> {
    /// Consumes `albedo` and returns whether it came next. It then applies to the block's later numbers of
    /// the same word, too.
    pub(super) fn skip_albedo(&mut self) -> bool {
        let found = matches!(self.peek(), Some(Token { kind: TokenKind::Word(Word::Albedo), .. }));
        found && self.next().is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_lambertian_surface_scatters_needs_no_factor() {
        let mut finish = ClassicFinish { diffuse: 0.7, ..ClassicFinish::default() };
        Albedo { diffuse: true, phong: true, specular: false }.spend(&mut finish);
        assert_eq!((finish.diffuse, finish.phong), (0.7, 0.0));
    }

    #[test]
    fn the_factors_are_those_of_pov_ray() {
        let all = Albedo { diffuse: true, phong: true, specular: true };
        let mut finish = ClassicFinish {
            diffuse: 0.3,
            brilliance: 3.0,
            phong: 0.03,
            phong_size: 30.0,
            specular: 0.02,
            roughness: 0.5,
            ..ClassicFinish::default()
        };
        all.spend(&mut finish);
        let wanted = [0.6, 0.465, 0.02 * 4.0 / 6.0];
        for (found, wanted) in [finish.diffuse, finish.phong, finish.specular].iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-15, "{found} is not {wanted}");
        }
    }
}
