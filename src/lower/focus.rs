//! Lowers the lens of a camera: its blur and its normal.

use std::sync::Arc;

use super::{Fault, Lowering};
use crate::diagnostic::Code;
use crate::math::double::DoubleVector;
use crate::math::{Vector, double::Double};
use crate::scene::{CameraItemKind, Dialect, NormalId, PigmentId};
use crate::source::Site;
use crate::texture::Normal;
use crate::texture::space::Start;
use crate::world::Focus;

/// The keywords of a lens.
#[derive(Default)]
pub(super) struct Lens {
    aperture: Option<(f64, Site)>,
    samples: Option<(Option<u32>, u32)>,
    focal_point: Option<(Vector, Site)>,
    confidence: Option<f64>,
    variance: Option<f64>,
    bokeh: Option<PigmentId>,
    normal: Option<(NormalId, Site)>,
}

/// The least number of rays of a pixel by default: the first if the most is less than the second.
const LEAST: [u32; 2] = [4, 7];
/// The radius of a lens of `aperture` 1.
///
/// **Source:** measured on POV-Ray 3.7.
const RADIUS: f64 = 0.25;

impl Lens {
    pub fn take(&mut self, item: CameraItemKind, site: Site) {
        match item {
            CameraItemKind::Aperture(width) => self.aperture = Some((width, site)),
            CameraItemKind::BlurSamples(least, most) => self.samples = Some((least, most)),
            CameraItemKind::FocalPoint(at) => self.focal_point = Some((at, site)),
            CameraItemKind::Confidence(n) => self.confidence = Some(n),
            CameraItemKind::Variance(n) => self.variance = Some(n),
            CameraItemKind::Bokeh(id) => self.bokeh = Some(id),
            CameraItemKind::Normal(id) => self.normal = Some((id, site)),
            _ => {}
        }
    }
}

/// What a lens does to rays besides the camera's kind: its blur, and its normal.
type Blurred = (Option<Focus>, Option<Arc<Normal>>);

impl Lowering<'_, '_> {
    /// Reports that the rays of a `mesh_camera` go through no lens.
    pub(super) fn no_lens(&mut self, lens: &Lens) {
        let aperture = lens.aperture.filter(|(width, _)| *width != 0.0).map(|(_, site)| site);
        let normal = lens.normal.map(|(_, site)| site);
        for (word, site) in [("aperture", aperture), ("normal", normal)] {
            let Some(site) = site else { continue };
            let message = format!("`{word}` is not simulated in a `mesh_camera` yet");
            let fault = Fault::new(Code::NotSupportedYet, message);
            self.reporter.fault(fault.label("the rays are as without it"), site);
        }
    }

    /// Returns the blur of a lens, if it has any, and its normal. The distance in focus is that from the camera's
    /// written `location` to `focal_point`, and no transform changes it, nor the width of the lens (measured). Without a
    /// `focal_point`, it is the length of `direction` in POV-Ray 3.7 (measured, though its manual says <0, 0, 0>).
    pub(super) fn lens(
        &mut self,
        lens: &Lens,
        location: DoubleVector,
        direction: f64,
    ) -> Result<Blurred, (Fault, Site)> {
        let normal = match lens.normal {
            Some((id, site)) => {
                let normal = self.nodes().normal(id, Start::Outer, &[], 0);
                normal.map_err(|fault| (fault, site))?.map(Arc::new)
            }
            None => None,
        };
        self.origins.camera_normal = lens.normal.map(|(_, site)| site).filter(|_| normal.is_some());
        let Some((aperture, site)) = lens.aperture.filter(|(width, _)| *width != 0.0) else {
            return Ok((None, normal));
        };
        let Some((least, most)) = lens.samples else {
            let message = "this `aperture` blurs nothing without `blur_samples`";
            // POV-Ray 3.7 renders it without blur.
            let code = match self.scene.dialect {
                Dialect::Pov => Code::DegenerateCamera,
                Dialect::Scene => Code::MissingPart,
            };
            let fault = Fault::new(code, message).label("the camera has no number of rays");
            let fault = fault.help("write how many rays a pixel may have: `blur_samples 50`");
            self.reporter.fault(fault, site);
            return Ok((None, normal));
        };
        let (focal_point, focal_site) = lens.focal_point.unwrap_or((Vector::ZERO, site));
        let distance = match (lens.focal_point, self.scene.dialect) {
            (None, Dialect::Pov) => direction,
            _ => (super::transform::exact(focal_point) - location).length().round(),
        };
        let radius = (Double::from(RADIUS) * aperture.into()).round();
        if !distance.is_finite() || !radius.is_finite() {
            return Err((Fault::not_finite("this lens").refused(), site));
        }
        if distance == 0.0 {
            let message = "the camera stands at its `focal_point`, so nothing is in focus";
            let fault = Fault::new(Code::DegenerateCamera, message);
            self.reporter.fault(fault.label("expected a point in front of the camera"), focal_site);
        }
        let default = if most < LEAST[1] { LEAST[0] } else { LEAST[1] };
        let bokeh = match lens.bokeh {
            Some(id) => {
                let pigment = self.nodes().pigment(id, Start::Outer, &[], 0);
                Some(Arc::new(pigment.map_err(|fault| (fault, site))?))
            }
            None => None,
        };
        self.origins.aperture = Some(site);
        let focus = Focus {
            radius,
            distance,
            least: least.unwrap_or(default).min(most),
            most,
            confidence: lens.confidence.unwrap_or(0.9),
            variance: lens.variance.unwrap_or(1.0 / 128.0),
            bokeh,
        };
        Ok((Some(focus), normal))
    }
}
