//! Renders the text of a scene to a picture in one call.
//!
//! **In:** a text, and [`RenderOptions`]. **Out:** a [`Picture`], or the [`Messages`] that say why there is none.
//! **Invariant:** the picture is the one that the command line writes with the same options.

use std::io;

use crate::diagnostic::{Code, Diagnostic, Messages};
use crate::film::{Channel, Channels, Components, Depth, Developer, Film, Surfaces};
use crate::picture::{self, Format};
use crate::plan::{Antialias, Frame, PlanOptions, plan};
use crate::road::{Options, Road, dialect, sign_of_povray};
use crate::scene::Dialect;
use crate::source::{Files, NoFiles};
use crate::trace::{TraceOptions, Unwatched, Watch, first_surfaces, trace};

/// How a picture is rendered, and what the scene may read.
///
/// ```
/// use lucarne::RenderOptions;
/// use lucarne::plan::Antialias;
///
/// let options = RenderOptions { antialias: Antialias::Grid(3), ..RenderOptions::of_size(320, 240) };
/// # assert_eq!(options.size, (320, 240));
/// ```
#[derive(Clone)]
pub struct RenderOptions<'a> {
    /// What messages call the text. Its extension, `.pov` or `.scene`, says in which language it is written; if it has
    /// neither, the text does.
    pub name: &'a str,
    /// Overrides the language.
    pub dialect: Option<Dialect>,
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Samples per pixel; by default adaptive, more where neighbours differ.
    pub antialias: Antialias,
    /// Whether the background is transparent.
    pub alpha: bool,
    /// What of the first surface of each pixel the picture has beside its colours; only an OpenEXR file holds it.
    pub channels: &'a [Channel],
    /// `None`: one for each processor. The picture does not depend on it.
    pub threads: Option<usize>,
    /// Numbers that are declared before the scene is read; `clock` sets the clock.
    pub declares: &'a [(&'a str, f64)],
    /// Where the scene finds includes, pictures, fonts and meshes: [`NoFiles`], a closure that returns the bytes of a
    /// name, or [`DiskFiles`](crate::disk::DiskFiles). The most used of POV-Ray's standard includes are built in.
    ///
    /// ```
    /// use lucarne::{RenderOptions, render};
    ///
    /// let files = |name: &str| (name == "light.inc").then(|| b"#declare Light = rgb <1, 0.5, 0.25>;".to_vec());
    /// let options = RenderOptions { files: &files, ..RenderOptions::of_size(4, 3) };
    /// let picture = render("#include \"light.inc\" background { Light }", &options)?;
    /// assert_eq!(picture.rgba8()[..4], [255, 188, 137, 255]);
    /// # Ok::<(), lucarne::Messages>(())
    /// ```
    pub files: &'a dyn Files,
    /// Hears of progress, and may stop the rendering: a [`Watched`](crate::trace::Watched) closure. A picture that was
    /// stopped is not [complete](Picture::complete).
    pub watch: &'a dyn Watch,
}

impl RenderOptions<'_> {
    /// Returns the options of the command line, for a size in pixels.
    pub fn of_size(width: u32, height: u32) -> Self {
        Self {
            name: "scene",
            dialect: None,
            size: (width, height),
            antialias: Antialias::default(),
            alpha: false,
            channels: &[],
            threads: None,
            declares: &[],
            files: &NoFiles,
            watch: &Unwatched,
        }
    }
}

/// 640×480, as of the command line.
impl Default for RenderOptions<'_> {
    fn default() -> Self {
        Self::of_size(640, 480)
    }
}

/// A rendered picture, and the warnings of its scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// The light of each pixel, and its number of samples.
    pub film: Film,
    /// `None` if no [`RenderOptions::channels`] were asked for, or the [`Watch`] stopped the picture before it had any.
    pub surfaces: Option<Surfaces>,
    /// False if the [`Watch`] stopped it: some pixels then have fewer samples, or none.
    pub complete: bool,
    /// The warnings.
    pub messages: Messages,
}

impl Picture {
    /// In pixels.
    pub fn width(&self) -> u32 {
        self.film.frame.region.width
    }

    /// In pixels.
    pub fn height(&self) -> u32 {
        self.film.frame.region.height
    }

    /// Returns red, green, blue and alpha of each pixel, row by row from the top left: sRGB, not multiplied by alpha.
    pub fn rgba8(&self) -> Vec<u8> {
        match self.developed(Depth::Eight) {
            Components::Eight(rgba) => rgba,
            Components::Sixteen(_) | Components::Linear(_) => Vec::new(),
        }
    }

    /// Returns red, green, blue and alpha of each pixel, row by row from the top left: linear light, multiplied by
    /// alpha; 1 is the display's white, and light may be brighter.
    ///
    /// ```
    /// use lucarne::{RenderOptions, render};
    ///
    /// let picture = render("background { rgb <4, 0.5, 0> }", &RenderOptions::of_size(2, 2))?;
    /// assert_eq!(picture.linear()[..4], [4.0, 0.5, 0.0, 1.0]);
    /// # Ok::<(), lucarne::Messages>(())
    /// ```
    pub fn linear(&self) -> Vec<f32> {
        match self.developed(Depth::Linear) {
            Components::Linear(rgba) => rgba,
            Components::Eight(_) | Components::Sixteen(_) => Vec::new(),
        }
    }

    fn developed(&self, depth: Depth) -> Components {
        let Film { assumed_gamma, pixels, .. } = &self.film;
        Developer::new(depth, *assumed_gamma, pixels.len()).develop(pixels, Channels::Rgba)
    }

    /// Writes a file of this format, with the usual number of bits.
    ///
    /// # Errors
    ///
    /// What `out` fails with, and a size that the format cannot have.
    pub fn write(&self, format: Format, out: &mut dyn io::Write) -> io::Result<()> {
        if let Some(why) = format.too_large(self.width(), self.height()) {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, why));
        }
        let Film { assumed_gamma, pixels, .. } = &self.film;
        let depth = format.depth(None).unwrap_or_default();
        let developer = Developer::new(depth, *assumed_gamma, pixels.len());
        match &self.surfaces {
            Some(surfaces) if format.holds_channels() => {
                picture::write_with_surfaces(&self.film, surfaces, &developer, out)
            }
            _ => picture::write(&self.film, &developer, format, out),
        }
    }
}

/// Renders the text of a scene.
///
/// ```
/// use lucarne::{RenderOptions, render};
///
/// let text = "camera { location 5*z look_at 0 } light_source { <9, 9, 9>, rgb 1 }
///     sphere { 0, 1 pigment { rgb <1, 0.5, 0> } }";
/// let picture = render(text, &RenderOptions::of_size(64, 48))?;
/// assert_eq!(picture.rgba8().len(), 64 * 48 * 4);
/// # Ok::<(), lucarne::Messages>(())
/// ```
///
/// A scene with mistakes has no picture, but messages, as data and as text:
///
/// ```
/// use lucarne::{RenderOptions, render};
///
/// let messages = render("spere { 0, 1 }", &RenderOptions::default()).unwrap_err();
/// assert_eq!(messages.lines().next().unwrap(), "scene:1:1: error[unknown-word]: `spere` is not a word at the top level");
/// ```
///
/// # Errors
///
/// The messages of a scene that has errors, and warnings among them; also if there is no memory for the picture.
pub fn render(text: &str, options: &RenderOptions) -> Result<Picture, Messages> {
    let (width, height) = options.size;
    let mut road = Road::new(options.files, options.compile_options(text));
    let (world, origins) = road.compile(options.name, text);
    let frame = Frame::whole(width, height);
    if !fits(frame) {
        let why = format!("there is no memory for a picture of {width}×{height} pixels");
        road.diagnostics.push(Diagnostic::new(Code::MemoryLimit, why));
    }
    let list = road.diagnostics.in_text_order().into_iter().cloned().collect();
    let messages = Messages::new(list, road.sources);
    if messages.has_errors() {
        return Err(messages);
    }
    let RenderOptions { antialias, alpha, channels, threads, watch, .. } = *options;
    let asked = PlanOptions { antialias, alpha, ..PlanOptions::new(frame) };
    let plan = plan(&world, &origins, &asked);
    let threads = TraceOptions { threads, ..TraceOptions::default() };
    let surfaces = first_surfaces((&world, &origins), &plan, channels, &threads, watch);
    let traced = trace(&world, &plan, &threads, watch);
    let complete = traced.complete && (surfaces.is_some() || channels.is_empty());
    Ok(Picture { film: traced.film, surfaces, complete, messages })
}

impl RenderOptions<'_> {
    fn compile_options(&self, text: &str) -> Options {
        let named = self.name.rsplit_once('.').map(|(_, extension)| extension.to_lowercase());
        let dialect = self.dialect.unwrap_or_else(|| match named.as_deref() {
            Some("pov" | "inc" | "scene") => dialect(self.name),
            _ if sign_of_povray(text.as_bytes()).is_some() => Dialect::Pov,
            _ => Dialect::Scene,
        });
        let declares = self.declares.iter().map(|&(name, value)| (name.to_owned(), value));
        Options::new(dialect).for_picture(self.size).declaring(declares.collect())
    }
}

/// Whether there is memory for a film; a failed allocation would abort the program.
fn fits(frame: Frame) -> bool {
    let pixels = u64::from(frame.width) * u64::from(frame.height);
    usize::try_from(pixels.saturating_mul(Film::BYTES_PER_PIXEL))
        .is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok())
}
