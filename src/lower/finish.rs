//! Lowers finishes: the kinds of reflection that a surface has, and their weights.
//!
//! **In:** the native or POV-Ray's keywords. **Out:** the World's finish. **Invariant:** every component of
//! weight zero or less is left out, as in POV-Ray 3.7 (measured); every number is finite.

use super::Fault;
use crate::color::Rgb;
use crate::noise::NoiseGenerator;
use crate::scene::{self, ClassicFinish, Settings};
use crate::world::{Extras, Finish, Irid, Lobe, LobeKind, Reflection};

/// A finish that reflects and emits no light.
pub const BARE: Finish = Finish {
    emission: Rgb::BLACK,
    diffuse: 0.0,
    brilliance: 1.0,
    lobes: Vec::new(),
    reflection: None,
    conserve_energy: false,
    seed: false,
    extras: None,
};

/// Returns the World's finish, without components of weight zero or less.
pub fn lower_finish(finish: &scene::Finish, settings: &Settings) -> Result<Finish, Fault> {
    let lowered = match finish {
        &scene::Finish::Seed { kd, ks, phong_exponent } => Finish {
            emission: settings.ambient_light * kd,
            diffuse: kd,
            lobes: lobe(LobeKind::Blinn, ks, phong_exponent, 1.0),
            reflection: (ks != 0.0).then_some(Reflection {
                minimum: Rgb::gray(ks),
                maximum: Rgb::gray(ks),
                falloff: 1.0,
                fresnel: false,
                exponent: 1.0,
                metallic: 0.0,
            }),
            seed: true,
            ..BARE
        },
        scene::Finish::Classic(classic) => lower_classic(classic, settings),
    };
    let exponents = lowered.lobes.iter().flat_map(|lobe| [lobe.weight, lobe.exponent]);
    let mut rare = Vec::new();
    if let Some(Extras { behind, grain, irid, passed }) = lowered.extras.as_deref() {
        rare.extend([*behind, *grain, *passed]);
        rare.extend(irid.iter().flat_map(|irid| [irid.amount, irid.thickness, irid.turbulence]));
        rare.extend(irid.iter().flat_map(|irid| irid.wavelengths.components()));
    }
    let mut numbers = exponents.chain([lowered.diffuse, lowered.brilliance]).chain(rare);
    if !lowered.emission.is_finite() || numbers.any(|n| !n.is_finite()) {
        return Err(Fault::not_finite("this object's finish"));
    }
    Ok(lowered)
}

fn lower_classic(finish: &ClassicFinish, settings: &Settings) -> Finish {
    let mut lobes = lobe(LobeKind::Phong, finish.phong, finish.phong_size, finish.metallic);
    lobes.extend(lobe(LobeKind::Blinn, finish.specular, 1.0 / finish.roughness, finish.metallic));
    let reflection = finish.reflection.as_deref();
    let reflection = reflection.filter(|r| r.minimum.gives_light() || r.maximum.gives_light());
    let diffuse = if finish.diffuse < 0.0 { 0.0 } else { finish.diffuse };
    let scatters = diffuse > 0.0 || finish.behind > 0.0;
    let answers = scatters || !lobes.is_empty() || reflection.is_some();
    Finish {
        emission: finish.ambient * settings.ambient_light + finish.emission,
        diffuse,
        // Brilliance affects diffuse reflection only.
        brilliance: if scatters { finish.brilliance } else { 1.0 },
        extras: extras(finish, scatters, answers, settings),
        lobes,
        reflection: reflection.map(|r| Reflection {
            minimum: r.minimum,
            maximum: r.maximum,
            // With equal ends, the interpolation between them does not matter.
            falloff: if r.fresnel { 1.0 } else { r.falloff },
            fresnel: r.fresnel && r.minimum != r.maximum,
            exponent: r.exponent,
            metallic: r.metallic,
        }),
        conserve_energy: finish.conserve_energy,
        seed: false,
    }
}

/// Returns the rare properties, without those that nothing can show.
fn extras(
    finish: &ClassicFinish,
    scatters: bool,
    answers: bool,
    settings: &Settings,
) -> Option<Box<Extras>> {
    let irid = finish.irid.as_deref().copied();
    let irid = irid.filter(|irid| irid.amount > 0.0 && answers);
    let irid = irid.map(|scene::Irid { amount, thickness, turbulence, generator }| {
        let turbulence = if thickness == 0.0 { 0.0 } else { turbulence };
        let generator = if turbulence == 0.0 { NoiseGenerator::default() } else { generator };
        Irid { amount, thickness, turbulence, wavelengths: settings.irid_wavelength, generator }
    });
    let extras = Extras {
        behind: if finish.behind > 0.0 { finish.behind } else { 0.0 },
        grain: if scatters && finish.crand > 0.0 { finish.crand } else { 0.0 },
        irid,
        passed: finish.refraction,
    };
    extras.kept()
}

fn lobe(kind: LobeKind, weight: f64, exponent: f64, metallic: f64) -> Vec<Lobe> {
    if weight <= 0.0 { Vec::new() } else { vec![Lobe { kind, weight, exponent, metallic }] }
}
