//! The arguments about a picture: its size, its part that is traced, and how well.

use clap::Args;
use lucarne::plan::{Antialias, Frame, PlanOptions, Region, Samples};

use crate::cli::exit::Failure;
use crate::cli::scene::SceneArguments;
use crate::cli::values::{antialias, depth, region, samples, size, tolerance, weight};

/// Size of the picture and the part of it to trace.
#[derive(Debug, Args)]
pub struct FrameArguments {
    /// Width and height of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = size, allow_hyphen_values = true)]
    #[arg(default_value = "640x480")]
    size: (u32, u32),
    /// Render only this rectangle: left, top, width and height in pixels
    #[arg(long, value_name = "X,Y,W,H", value_parser = region, allow_hyphen_values = true)]
    region: Option<Region>,
}

/// Size and quality of the picture.
#[derive(Debug, Args)]
pub struct PictureArguments {
    #[command(flatten)]
    frame: FrameArguments,
    /// Antialiasing: `off` traces one ray per pixel; N traces N×N; `adaptive` traces up to 8×8 near edges,
    /// where neighbouring pixels differ by more than 0.05; `adaptive:T:N` up to N×N for differences of T. N finds lines thinner than a pixel
    #[arg(long, value_name = "off|N|adaptive", value_parser = antialias, default_value = "adaptive")]
    antialias: Antialias,
    /// Maximum recursion depth of rays; overrides max_trace_level in the scene
    #[arg(long, value_name = "N", value_parser = depth, allow_negative_numbers = true)]
    depth: Option<u32>,
    /// Do not trace reflected or transmitted rays with a weight below W (such as 0.01 or 1/255); overrides
    /// adc_bailout in the scene
    #[arg(long, value_name = "W", value_parser = weight, allow_negative_numbers = true)]
    adc_bailout: Option<f64>,
    /// Tolerance of iterative root finding (used for the torus, for example), relative to the size of the
    /// solid; 0 means full precision
    #[arg(long, value_name = "T", value_parser = tolerance, default_value = "0")]
    #[arg(allow_negative_numbers = true)]
    root_tolerance: f64,
    /// Maximum number of iterations of a julia_fractal; a lower number in the scene is kept
    #[arg(long, value_name = "N", value_parser = depth, allow_negative_numbers = true)]
    julia_iterations: Option<u32>,
    /// Samples of each area light at each place that it may light: `scene` takes the nodes of the scene's
    /// grid; N spreads N samples over the light's area; `adaptive:T:N` takes up to N until the light is known
    /// to about T, where 1 is white
    #[arg(long, value_name = "scene|N|adaptive:T:N", value_parser = samples, default_value = "scene")]
    #[arg(allow_negative_numbers = true)]
    light_samples: Samples,
    /// Samples of each pixel that a lens with an `aperture` blurs: `scene` takes the scene's blur_samples,
    /// confidence and variance; N takes N; `adaptive:T:N` takes up to N until the pixel is known to about T
    #[arg(long, value_name = "scene|N|adaptive:T:N", value_parser = samples, default_value = "scene")]
    #[arg(allow_negative_numbers = true)]
    blur_samples: Samples,
}

impl PictureArguments {
    /// Returns the picture size and the region to trace. Fails if the region exceeds the picture, or the
    /// picture the pixel limit.
    pub fn frame(&self, scene: &SceneArguments) -> Result<Frame, Failure> {
        self.frame.frame(scene)
    }

    /// Returns the plan options that these arguments select.
    pub fn options(&self, frame: Frame) -> PlanOptions {
        PlanOptions {
            frame,
            antialias: self.antialias,
            depth: self.depth,
            adc_bailout: self.adc_bailout,
            root_tolerance: self.root_tolerance,
            julia_iterations: self.julia_iterations,
            light_samples: self.light_samples,
            blur_samples: self.blur_samples,
            alpha: false,
        }
    }
}

impl FrameArguments {
    /// Returns the picture size and the region to trace. Fails if the region exceeds the picture, or the
    /// picture the pixel limit.
    pub fn frame(&self, scene: &SceneArguments) -> Result<Frame, Failure> {
        let (width, height) = self.size;
        let mut frame = Frame::whole(width, height);
        if let Some(region) = self.region {
            let right = u64::from(region.x) + u64::from(region.width);
            let bottom = u64::from(region.y) + u64::from(region.height);
            if right > width.into() || bottom > height.into() {
                let sentence = format!(
                    "the region ends at {right},{bottom}, outside of the {width}×{height} picture"
                );
                return Err(Failure::usage(sentence));
            }
            frame.region = region;
        }
        let (pixels, most) =
            (u64::from(frame.region.width) * u64::from(frame.region.height), scene.most_pixels());
        if pixels > most {
            return Err(Failure::limit(format!(
                "the picture has {pixels} pixels, and the limit is {most}"
            ))
            .help(format!("`--limit pixels={pixels}` raises it; `--region` renders a part")));
        }
        Ok(frame)
    }
}
