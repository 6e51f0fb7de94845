//! `lucarne render --frames`: renders an animation, frame by frame.
//!
//! **Invariant:** a frame has the bytes of the same frame alone.

use std::cell::RefCell;
use std::io::{BufWriter, Write};
use std::path::Path;

use lucarne::disk::reason;
use lucarne::evaluate::Animation;
use lucarne::film::{Depth, Film};
use lucarne::picture::animated::{Animated, AnimatedFormat};
use lucarne::picture::{Format, encode};

use super::animation::FrameRange;
use super::arguments::{RenderArguments, Shard};
use super::exit::{Exit, Failure, Outcome};
use super::messages;
use super::output::{Output, cannot, temporary};
use super::promise::Made;
use super::render::{Frame, Job, picture};
use super::text::read_scene;

/// Renders the frames in their order. An interrupt or an error ends it; what is done is kept.
pub fn run(arguments: &RenderArguments, range: &FrameRange) -> Outcome {
    if arguments.work.shard.is_some() && arguments.output.as_deref().is_some_and(is_one_file) {
        let sentence = "parts of an animation are numbered pictures, not one file";
        return Err(Failure::usage(sentence).help("with `--shard`, write a .png"));
    }
    let out = arguments.output.as_deref();
    let extension = out.and_then(Path::extension).unwrap_or_default().to_string_lossy();
    match (out, AnimatedFormat::from_extension(&extension)) {
        (Some(path), Some(format)) => animated(arguments, range, path, format),
        (Some(path), None) if path == Path::new("-") => raw(arguments, range),
        _ => numbered(arguments, range),
    }
}

fn is_one_file(out: &Path) -> bool {
    let extension = out.extension().unwrap_or_default().to_string_lossy();
    out == Path::new("-") || AnimatedFormat::from_extension(&extension).is_some()
}

/// A picture for each frame, under the name of the output and its number.
fn numbered(arguments: &RenderArguments, range: &FrameRange) -> Outcome {
    let whole = Output::from_arguments(&arguments.file, arguments.output.as_deref())?;
    let Output::File { path, format } = whole else { return raw(arguments, range) };
    let printed = RefCell::default();
    let Shard { number, all } = arguments.work.shard.unwrap_or(Shard { number: 1, all: 1 });
    let scene = read_scene(&arguments.file)?;
    let mine = frames(range)?.into_iter().skip(number as usize - 1).step_by(all as usize);
    for (animation, clock) in mine {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let name = format!("{}.{extension}", range.name(&stem, animation.frame_number));
        let output = Output::File { path: path.with_file_name(name), format };
        match picture(
            arguments,
            &output,
            &scene,
            Some(Frame { animation, clock, printed: &printed }),
        )? {
            Exit::Done => {}
            exit => return Ok(exit),
        }
    }
    Ok(Exit::Done)
}

/// One file with all frames.
fn animated(
    arguments: &RenderArguments,
    range: &FrameRange,
    path: &Path,
    format: AnimatedFormat,
) -> Outcome {
    if arguments.bits.is_some_and(|bits| bits != 8) {
        return Err(Failure::usage("an animated picture has 8 bits a channel"));
    }
    let output = Output::File { path: path.to_owned(), format: Format::Png };
    let frame = arguments.picture.frame(&arguments.scene)?;
    output.check(frame.region, Depth::Eight, arguments.force)?;
    let failed = |error: std::io::Error| cannot(path, &reason(&error));
    let count = frames(range)?.len() as u32;
    let beside = temporary(path)?;
    let mut file = None;
    let exit = each(arguments, range, &output, &mut |film| {
        let animated = match &mut file {
            Some(animated) => animated,
            None => {
                let out = BufWriter::new(beside.reopen().map_err(failed)?);
                let fps = arguments.animation.fps;
                file.insert(Animated::new(format, film, count, fps, out).map_err(failed)?)
            }
        };
        animated.add(film).map_err(failed)
    })?;
    if let Some(animated) = file.filter(|_| exit == Exit::Done) {
        animated.finish().map_err(failed)?;
        beside.persist(path).map_err(|error| failed(error.error))?;
        messages::eprint(&format!("{}: {count} frames\n", path.display()));
    } else if exit == Exit::Interrupted {
        messages::eprint("nothing was written\n");
    }
    Ok(exit)
}

/// PPM pictures, one after the other, on standard output.
fn raw(arguments: &RenderArguments, range: &FrameRange) -> Outcome {
    let depth = Format::Ppm.depth(arguments.bits).unwrap_or_default();
    if arguments.alpha {
        return Err(Failure::usage("a stream of .ppm pictures cannot have an alpha channel"));
    }
    each(arguments, range, &Output::Stdout, &mut |film| {
        let bytes = encode(film, depth, Format::Ppm).map_err(Failure::file)?;
        messages::print_with(&|out: &mut dyn Write| out.write_all(&bytes))
    })
}

/// Returns the frames that are rendered; fails if there are none.
fn frames(range: &FrameRange) -> Result<Vec<(Animation, f64)>, Failure> {
    let frames = range.frames();
    match frames.is_empty() {
        true => Err(Failure::usage("`--only` leaves none of the frames")),
        false => Ok(frames),
    }
}

/// Renders each frame for `output`, and passes it on.
fn each(
    arguments: &RenderArguments,
    range: &FrameRange,
    output: &Output,
    pass: &mut dyn FnMut(&Film) -> Result<(), Failure>,
) -> Outcome {
    let (frames, printed) = (frames(range)?, RefCell::default());
    let scene = read_scene(&arguments.file)?;
    let format = if *output == Output::Stdout { Format::Ppm } else { Format::Png };
    for (number, &(animation, clock)) in frames.iter().enumerate() {
        let frame = Frame { animation, clock, printed: &printed };
        let mut job = Job::new(arguments, format, &scene)?;
        job.fits(arguments)?;
        let Made { traced, said, exit } = match job.make(arguments, output, Some(frame))? {
            Ok(made) => made,
            Err(exit) => return Ok(exit),
        };
        if !traced.complete {
            messages::eprint(&format!("interrupted in frame {} of {}\n", number + 1, frames.len()));
            return Ok(exit);
        }
        pass(&traced.film)?;
        messages::eprint(&format!("frame {} of {}\n{said}", number + 1, frames.len()));
        if exit != Exit::Done {
            return Ok(exit);
        }
    }
    Ok(Exit::Done)
}
