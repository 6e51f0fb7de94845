//! The first surface that is seen in each pixel, as further channels of a picture.
//!
//! Denoisers guide their filters by them, and compositors mask and measure with them.

/// A channel, or a group of channels, that describes the first surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Channel {
    /// [`FirstSurface::depth`].
    Depth,
    /// [`FirstSurface::normal`].
    Normal,
    /// [`FirstSurface::albedo`].
    Albedo,
    /// [`FirstSurface::object`].
    Object,
}

impl Channel {
    /// All channels, as a file lists them.
    pub const ALL: [Self; 4] = [Self::Depth, Self::Normal, Self::Albedo, Self::Object];
}

/// The first surface on the ray through the centre of a pixel. Depths and numbers of objects have no mean, so there is
/// one ray for all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstSurface {
    /// The distance along the ray from its start, in units of the scene; infinite where there is no surface.
    pub depth: f32,
    /// The normal by which it is lit, of length 1, in the axes of the scene: turned toward the viewer, then perturbed by
    /// the texture.
    pub normal: [f32; 3],
    /// The colour of its pigment in linear light, as much of it as is not clear.
    pub albedo: [f32; 3],
    /// The number of its object or light at the top level of the scene, in written order from 1.
    pub object: u32,
}

impl FirstSurface {
    /// Where the ray leaves the scene, and where the camera has no ray.
    pub const NOTHING: Self =
        Self { depth: f32::INFINITY, normal: [0.0; 3], albedo: [0.0; 3], object: 0 };
}

/// The first surfaces of a film, and which of their channels a picture has.
#[derive(Debug, Clone, PartialEq)]
pub struct Surfaces {
    /// Those of the picture, each once, in the order of [`Channel::ALL`].
    pub channels: Vec<Channel>,
    /// Those of the film's pixels.
    pub pixels: Vec<FirstSurface>,
}

impl Surfaces {
    /// Peak memory per pixel until they are written: the surfaces, the channels and the bytes of a file.
    pub const BYTES_PER_PIXEL: u64 = 3 * size_of::<FirstSurface>() as u64;
}
