//! `lucarne render --frames`: renders an animation, frame by frame.
//!
//! **Invariant:** a frame has the bytes of the same frame alone.

use std::cell::RefCell;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use lucarne::disk::reason;
use lucarne::film::Film as Light;
use lucarne::picture::animated::{Animated, AnimatedFormat};
use lucarne::picture::{Format, encode};

use super::animation::Film;
use super::arguments::{RenderArguments, Shard};
use super::exit::{Exit, Failure, Outcome};
use super::messages;
use super::output::{Output, can_be_made, cannot};
use super::promise::Made;
use super::render::{Frame, Job, picture};

/// Renders the frames in their order. An interrupt or an error ends it; what is done is kept.
pub fn run(arguments: &RenderArguments, film: &Film) -> Outcome {
    if arguments.work.shard.is_some() && arguments.output.as_deref().is_some_and(is_one_file) {
        let sentence = "parts of an animation are numbered pictures, not one file";
        return Err(Failure::usage(sentence).help("with `--shard`, write a .png"));
    }
    let out = arguments.output.as_deref();
    let extension = out.and_then(Path::extension).unwrap_or_default().to_string_lossy();
    match (out, AnimatedFormat::from_extension(&extension)) {
        (Some(path), Some(format)) => animated(arguments, film, path, format),
        (Some(path), None) if path == Path::new("-") => raw(arguments, film),
        _ => numbered(arguments, film),
    }
}

fn is_one_file(out: &Path) -> bool {
    let extension = out.extension().unwrap_or_default().to_string_lossy();
    out == Path::new("-") || AnimatedFormat::from_extension(&extension).is_some()
}

/// A picture for each frame, under the name of the output and its number.
fn numbered(arguments: &RenderArguments, film: &Film) -> Outcome {
    let whole = Output::from_arguments(&arguments.file, arguments.output.as_deref())?;
    let Output::File { path, format } = whole else { return raw(arguments, film) };
    let told = RefCell::default();
    let Shard { number, all } = arguments.work.shard.unwrap_or(Shard { number: 1, all: 1 });
    let mine = film.frames().into_iter().skip(number as usize - 1).step_by(all as usize);
    for (animation, clock) in mine {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let name = format!("{}.{extension}", film.name(&stem, animation.frame_number));
        let output = Output::File { path: path.with_file_name(name), format };
        match picture(arguments, &output, Some(Frame { animation, clock, told: &told }))? {
            Exit::Done => {}
            exit => return Ok(exit),
        }
    }
    Ok(Exit::Done)
}

/// One file with all frames.
fn animated(
    arguments: &RenderArguments,
    film: &Film,
    path: &Path,
    format: AnimatedFormat,
) -> Outcome {
    if arguments.bits.is_some_and(|bits| bits != 8) {
        return Err(Failure::usage("an animated picture has 8 bits a channel"));
    }
    can_be_made(path)?;
    let partial = PathBuf::from(format!("{}.part", path.display()));
    let failed = |error: std::io::Error| cannot(path, &reason(&error));
    let frames = film.frames().len() as u32;
    let mut file = None;
    let exit = each(arguments, film, &mut |light| {
        let animated = match &mut file {
            Some(animated) => animated,
            None => {
                let out = BufWriter::new(File::create(&partial).map_err(failed)?);
                let fps = arguments.animation.fps;
                file.insert(Animated::new(format, light, frames, fps, out).map_err(failed)?)
            }
        };
        animated.add(light).map_err(failed)
    });
    let is_whole = matches!(exit, Ok(Exit::Done));
    match file.filter(|_| is_whole) {
        Some(animated) => {
            animated.finish().map_err(failed)?;
            std::fs::rename(&partial, path).map_err(failed)?;
            messages::eprint(&format!("{}: {frames} frames\n", path.display()));
        }
        None => drop(std::fs::remove_file(&partial)),
    }
    exit
}

/// PPM pictures, one after the other, on standard output.
fn raw(arguments: &RenderArguments, film: &Film) -> Outcome {
    each(arguments, film, &mut |light| {
        let depth = Format::Ppm.depth(arguments.bits).unwrap_or_default();
        let bytes = encode(light, depth, Format::Ppm).map_err(Failure::file)?;
        messages::print_with(&|out: &mut dyn Write| out.write_all(&bytes))
    })
}

/// Renders each frame and passes it on.
fn each(
    arguments: &RenderArguments,
    film: &Film,
    pass: &mut dyn FnMut(&Light) -> Result<(), Failure>,
) -> Outcome {
    let (frames, told) = (film.frames(), RefCell::default());
    for (number, &(animation, clock)) in frames.iter().enumerate() {
        let frame = Frame { animation, clock, told: &told };
        let format = if arguments.alpha { Format::Png } else { Format::Ppm };
        let mut job = Job::new(arguments, format)?;
        let Made { traced, said, exit } = match job.make(arguments, &Output::Stdout, Some(frame))? {
            Ok(made) => made,
            Err(exit) => return Ok(exit),
        };
        if !traced.complete {
            messages::eprint("interrupted: nothing was written\n");
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
