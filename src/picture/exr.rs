//! Encodes OpenEXR files: linear light, and the channels of the first surfaces.
//!
//! **Invariant:** one part of scan lines from top to bottom, whose channels have the usual names.
//!
//! **Source:** "OpenEXR File Layout" and "Technical Introduction to OpenEXR", openexr.com.

use std::io::{Cursor, Error, Result, Write};

use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::LineOrder;
use exr::prelude::{Compression, LayerAttributes};

use crate::film::{Channel, Components, Developer, Film, FirstSurface, Surfaces};
use crate::plan::Region;

/// ZIP makes files a third smaller, and takes four times as long.
const ENCODING: Encoding = Encoding {
    compression: Compression::RLE,
    blocks: Blocks::ScanLines,
    line_order: LineOrder::Increasing,
};

/// Writes a film, with its first surfaces if there are any.
pub fn write(
    film: &Film,
    surfaces: Option<&Surfaces>,
    developer: &Developer,
    out: &mut dyn Write,
) -> Result<()> {
    let Region { width, height, .. } = film.frame.region;
    if film.pixels.is_empty() {
        return Err(Error::other("an .exr picture has at least one pixel"));
    }
    let mut colors = vec![Vec::with_capacity(film.pixels.len()); film.channels.count()];
    for row in film.rows() {
        let Components::Linear(row) = developer.develop(row, film.channels) else {
            return Err(Error::other("OpenEXR holds linear light"));
        };
        for pixel in row.chunks(colors.len()) {
            colors.iter_mut().zip(pixel).for_each(|(channel, &c)| channel.push(c));
        }
    }
    let colors = ["R", "G", "B", "A"].into_iter().zip(colors.into_iter().map(FlatSamples::F32));
    let surfaces = surfaces.into_iter().flat_map(channels_of_surfaces);
    let list = colors.chain(surfaces).map(|(name, samples)| AnyChannel::new(name, samples));
    let layer = Layer::new(
        (width as usize, height as usize),
        LayerAttributes::default(),
        ENCODING,
        AnyChannels::sort(list.collect()),
    );
    let mut file = Cursor::new(Vec::new());
    let image = Image::from_layer(layer);
    image.write().non_parallel().to_buffered(&mut file).map_err(|error| match error {
        exr::error::Error::Io(error) => error,
        error => Error::other(error),
    })?;
    out.write_all(file.get_ref())
}

/// Returns the channels of first surfaces with their names.
fn channels_of_surfaces(surfaces: &Surfaces) -> Vec<(&'static str, FlatSamples)> {
    let pixels = || surfaces.pixels.iter();
    let axes = |names: [&'static str; 3], of: fn(&FirstSurface) -> [f32; 3]| {
        let axis = |i: usize| FlatSamples::F32(pixels().map(|one| of(one)[i]).collect());
        names.into_iter().enumerate().map(|(i, name)| (name, axis(i))).collect()
    };
    let channels = surfaces.channels.iter().flat_map(|channel| match channel {
        Channel::Depth => {
            vec![("Z", FlatSamples::F32(pixels().map(|one| one.depth).collect()))]
        }
        Channel::Normal => axes(["normal.X", "normal.Y", "normal.Z"], |one| one.normal),
        Channel::Albedo => axes(["albedo.R", "albedo.G", "albedo.B"], |one| one.albedo),
        Channel::Object => {
            vec![("object", FlatSamples::U32(pixels().map(|one| one.object).collect()))]
        }
    });
    channels.collect()
}
