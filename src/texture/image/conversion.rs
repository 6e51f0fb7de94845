//! How the numbers of a picture become the numbers of a scene's colours.
//!
//! **Source:** POV-Ray 3.7 manual, sections "The Gamma Option" and "Image Pattern"; all cases measured on
//! POV-Ray 3.7 to 1e-7, except that it takes nearly equal gammas of file and scene for equal.

use crate::color::Gamma;

/// What the numbers of a picture are by its file alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Encoding {
    /// The file itself states this gamma.
    Stated(Gamma),
    /// The file states none; pictures of its type are made for displays.
    Display,
    /// Linear light, by definition of the type.
    Light,
    /// Plain numbers, which a scene takes for its own.
    Plain,
}

/// What a scene says about gamma.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneGamma {
    /// `assumed_gamma`.
    pub assumed: Gamma,
    /// Whether the scene states `assumed_gamma`.
    pub is_stated: bool,
    /// Whether the scene is for a version below 3.7.
    pub is_old: bool,
}

impl Default for SceneGamma {
    fn default() -> Self {
        Self { assumed: Gamma::LINEAR, is_stated: true, is_old: false }
    }
}

/// What the numbers are used for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Purpose {
    /// As colours: `image_map`.
    Colors(SceneGamma),
    /// As values: `image_pattern`, `bump_map`, `height_field`. Only a gamma in the block counts.
    Values,
}

/// A function from a picture's numbers, 0 to 1 or above, to a scene's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conversion {
    /// From the file's number to light; `None` if it is light already.
    decode: Option<Gamma>,
    /// From light to the scene's number.
    encode: Gamma,
}

impl Conversion {
    pub const NONE: Self = Self { decode: None, encode: Gamma::LINEAR };

    /// Returns the conversion for a file's encoding and the `gamma` of the block that names the file.
    pub fn new(encoding: Encoding, block: Option<Gamma>, purpose: Purpose) -> Self {
        let scene = match purpose {
            Purpose::Colors(scene) => scene,
            Purpose::Values => return Self { decode: block, encode: Gamma::LINEAR }.simplified(),
        };
        let encode = scene.assumed;
        let of = |gamma| Self { decode: Some(gamma), encode };
        let conversion = match (block, encoding) {
            (Some(gamma), _) => of(gamma),
            (None, Encoding::Light) => Self { decode: None, encode },
            (None, Encoding::Stated(gamma)) if !scene.is_old || scene.is_stated => of(gamma),
            (None, Encoding::Display) if !scene.is_old => of(Gamma::Srgb),
            (None, Encoding::Stated(_) | Encoding::Display | Encoding::Plain) => Self::NONE,
        };
        conversion.simplified()
    }

    /// Returns [`Conversion::NONE`] if decoding and encoding cancel out.
    fn simplified(self) -> Self {
        match self.decode {
            Some(Gamma::LINEAR) if self.encode == Gamma::LINEAR => Self::NONE,
            Some(gamma) if gamma == self.encode => Self::NONE,
            _ => self,
        }
    }

    /// Converts one component.
    pub fn convert(self, number: f64) -> f64 {
        let light = self.decode.map_or(number, |gamma| gamma.linear(number));
        self.encode.of_light(light)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SRGB: Gamma = Gamma::Srgb;
    const POWER: Gamma = Gamma::Power(2.2);

    /// Results of POV-Ray 3.7 by encoding, `gamma` of the block, scene and number.
    #[test]
    fn numbers_are_converted_as_povray_converts_them() {
        let new = |assumed| SceneGamma { assumed, is_stated: true, is_old: false };
        let old = |assumed| SceneGamma { is_old: true, ..new(assumed) };
        let bare = SceneGamma { is_stated: false, ..old(Gamma::LINEAR) };
        let stated = Encoding::Stated(Gamma::Power(100_000.0 / 55_556.0));
        let named = Some(Gamma::Power(1.8));
        let number = 100.0 / 255.0;
        let table = [
            (Encoding::Display, None, new(Gamma::LINEAR), number, 0.127_437_696),
            (Encoding::Display, None, new(POWER), number, 0.392_028_153),
            (Encoding::Display, None, new(SRGB), number, 0.392_156_869),
            (Encoding::Display, None, bare, number, 0.392_156_869),
            (Encoding::Display, None, old(Gamma::LINEAR), number, 0.392_156_869),
            (Encoding::Display, None, old(POWER), number, 0.392_156_869),
            (stated, None, new(Gamma::LINEAR), number, 0.185_452_849),
            (stated, None, new(POWER), number, 0.464_920_700),
            (stated, None, new(SRGB), number, 0.467_817_068),
            (stated, None, bare, number, 0.392_156_869),
            (stated, None, old(Gamma::LINEAR), number, 0.185_452_849),
            (stated, None, old(POWER), number, 0.464_920_700),
            (Encoding::Stated(SRGB), None, old(POWER), number, 0.392_028_153),
            (Encoding::Plain, None, new(POWER), number, 0.392_156_869),
            (Encoding::Plain, named, new(Gamma::LINEAR), number, 0.185_450_375),
            (Encoding::Plain, named, new(SRGB), number, 0.467_814_147),
            (Encoding::Plain, named, bare, number, 0.185_450_375),
            (Encoding::Light, None, new(POWER), 0.375, 0.640_291_691),
            (Encoding::Light, None, old(POWER), 4.0, 1.877_861_738),
            (Encoding::Light, None, new(SRGB), 4.0, 1.824_796_200),
            (Encoding::Light, named, bare, 4.0, 12.125_731_468),
            (Encoding::Light, named, new(SRGB), 4.0, 2.928_990_126),
        ];
        for (encoding, block, scene, number, wanted) in table {
            let conversion = Conversion::new(encoding, block, Purpose::Colors(scene));
            let found = conversion.convert(number);
            let off = (found - wanted).abs();
            // It calculates in single precision.
            assert!(off < 2e-7 * wanted.max(1.0), "{encoding:?} {block:?} {scene:?} {off:e}");
        }
    }

    #[test]
    fn for_values_only_the_gamma_of_the_block_counts() {
        for encoding in [Encoding::Display, Encoding::Stated(POWER), Encoding::Light] {
            assert_eq!(Conversion::new(encoding, None, Purpose::Values), Conversion::NONE);
            let conversion = Conversion::new(encoding, Some(Gamma::Power(2.0)), Purpose::Values);
            assert_eq!(conversion.convert(0.5), 0.25);
        }
    }

    #[test]
    fn negative_light_stays_as_it_is_where_nothing_is_converted() {
        let scene = Purpose::Colors(SceneGamma::default());
        assert_eq!(Conversion::new(Encoding::Light, None, scene).convert(-0.5), -0.5);
        let gamma = Some(Gamma::Power(1.8));
        assert_eq!(Conversion::new(Encoding::Light, gamma, scene).convert(-0.5), 0.0);
    }
}
