//! `lucarne render --frames`: renders an animation, frame by frame.
//!
//! **Invariant:** a frame has the bytes of the same frame alone.

use std::io::{BufWriter, Write};
use std::path::Path;

use lucarne::disk::reason;
use lucarne::film::{Depth, Film};
use lucarne::picture::animated::{Animated, AnimatedFormat};
use lucarne::picture::{Format, encode};

use super::animation::FrameRange;
use super::arguments::{RenderArguments, Shard};
use super::exit::{Exit, Failure, Outcome};
use super::files;
use super::kept::Kept;
use super::messages;
use super::output::{Output, cannot, temporary};
use super::promise::Made;
use super::render::{Frame, Job, Shared, picture};
use super::stop::{self, Cause};
use super::text::read_scene;

/// Renders the frames in their order. An interrupt or an error ends it; what is done is kept.
pub fn run(arguments: &RenderArguments, range: &FrameRange) -> Outcome {
    if arguments.work.shard.is_some() && arguments.output.as_deref().is_some_and(is_one_file) {
        let sentence = "parts of an animation are numbered pictures, not one file";
        return Err(Failure::usage(sentence).help("with `--shard`, write a .png"));
    }
    let scene = read_scene(&arguments.file)?;
    let disk = files::of(&arguments.file, &arguments.scene);
    let messages = arguments.scene.messages().of_frames();
    let mut shared = Shared { scene: &scene, disk: &disk, files: &Kept::new(&disk), messages };
    let outcome = all(arguments, range, &mut shared);
    shared.messages.print_log();
    outcome
}

fn all(arguments: &RenderArguments, range: &FrameRange, shared: &mut Shared) -> Outcome {
    let out = arguments.output.as_deref();
    let extension = out.and_then(Path::extension).unwrap_or_default().to_string_lossy();
    match (out, AnimatedFormat::from_extension(&extension)) {
        (Some(path), Some(format)) => animated(arguments, range, shared, (path, format)),
        (Some(path), None) if path == Path::new("-") => raw(arguments, range, shared),
        _ => numbered(arguments, range, shared),
    }
}

fn is_one_file(out: &Path) -> bool {
    let extension = out.extension().unwrap_or_default().to_string_lossy();
    out == Path::new("-") || AnimatedFormat::from_extension(&extension).is_some()
}

/// A picture for each frame, under the name of the output and its number.
fn numbered(arguments: &RenderArguments, range: &FrameRange, shared: &mut Shared) -> Outcome {
    let whole = Output::from_arguments(&arguments.file, arguments.output.as_deref())?;
    let Output::File { path, format } = whole else { return raw(arguments, range, shared) };
    let Shard { number, all } = arguments.work.shard.unwrap_or(Shard { number: 1, all: 1 });
    let mine = frames(range)?.into_iter().skip(number as usize - 1).step_by(all as usize);
    for frame in mine {
        let (animation, _) = frame;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let name = format!("{}.{extension}", range.name(&stem, animation.frame_number));
        let output = Output::File { path: path.with_file_name(name), format };
        shared.messages.next_frame();
        match picture(arguments, &output, shared, Some(frame))? {
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
    shared: &mut Shared,
    (path, format): (&Path, AnimatedFormat),
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
    let exit = each(arguments, range, shared, &output, &mut |film| {
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
fn raw(arguments: &RenderArguments, range: &FrameRange, shared: &mut Shared) -> Outcome {
    let depth = Format::Ppm.depth(arguments.bits).unwrap_or_default();
    if arguments.alpha {
        return Err(Failure::usage("a stream of .ppm pictures cannot have an alpha channel"));
    }
    each(arguments, range, shared, &Output::Stdout, &mut |film| {
        let bytes = encode(film, depth, Format::Ppm).map_err(Failure::file)?;
        match messages::print_while_open(&|out: &mut dyn Write| out.write_all(&bytes))? {
            true => Ok(()),
            // More frames would be rendered for nothing.
            false => Err(Failure::file("the program that reads the frames has ended")),
        }
    })
}

/// Returns the frames that are rendered; fails if there are none.
fn frames(range: &FrameRange) -> Result<Vec<Frame>, Failure> {
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
    shared: &mut Shared,
    output: &Output,
    pass: &mut dyn FnMut(&Film) -> Result<(), Failure>,
) -> Outcome {
    let frames = frames(range)?;
    let format = if *output == Output::Stdout { Format::Ppm } else { Format::Png };
    for (number, &frame) in frames.iter().enumerate() {
        shared.messages.next_frame();
        let mut job = Job::new(arguments, format)?;
        job.fits(arguments)?;
        let Made { traced, said, exit } = match job.make(arguments, output, shared, Some(frame))? {
            Ok(made) => made,
            Err(exit) => return Ok(exit),
        };
        if !traced.complete {
            let cause = stop::cause().unwrap_or(Cause::Interrupt);
            let (number, all) = (number + 1, frames.len());
            messages::eprint(&format!("{cause}: in frame {number} of {all}\n"));
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
