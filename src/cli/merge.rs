//! `lucarne merge`: makes one picture of the parts that `render --shard` wrote.
//!
//! **Invariant:** the picture has the bytes of one that was rendered at once.

use std::fs;
use std::io::ErrorKind;

use lucarne::film::saved::{Damage, Purpose, Saved, load};
use lucarne::film::{Channels, Developer, Film};
use lucarne::picture;

use super::arguments::MergeArguments;
use super::exit::{Exit, Failure, Outcome};
use super::messages;
use super::output::{Output, Picture, depth_of};
use lucarne::disk::reason;

pub fn run(arguments: &MergeArguments) -> Outcome {
    let output = Output::from_arguments(&arguments.output, Some(&arguments.output))?;
    let format = output.format();
    let mut whole: Option<(u64, Film)> = None;
    for path in &arguments.parts {
        let name = path.display();
        let wrong = |why: &str| Failure::file(format!("cannot merge `{name}`: {why}"));
        // What is missing or incomplete will be there when its render has run again.
        let bytes = fs::read(path).map_err(|error| match error.kind() {
            ErrorKind::NotFound => wrong(&reason(&error)).again(),
            _ => wrong(&reason(&error)),
        })?;
        let saved = load(&bytes).map_err(|damage| match damage {
            Damage::Broken => wrong(&damage.to_string()).again(),
            Damage::Foreign => wrong(&damage.to_string()),
        })?;
        let Saved { purpose: Purpose::Part, key, region, films } = saved else {
            return Err(wrong("it is a checkpoint: its part is not finished").again());
        };
        let [part] = &films[..] else { return Err(wrong("it is not a part of a picture")) };
        let (expected, film) = whole.get_or_insert_with(|| {
            let frame = lucarne::plan::Frame { region, ..part.frame };
            let film = Film { channels: part.channels, ..Film::new(frame, part.assumed_gamma) };
            (key, film)
        });
        if *expected != key || region != film.frame.region {
            return Err(wrong("it is of another picture than the parts before it"));
        }
        film.place(part).ok_or_else(|| wrong("it is not a part of a picture"))?;
    }
    let Some((_, film)) = whole else { return Ok(Exit::Done) };
    let region = film.frame.region;
    let missing: Vec<u32> = (region.y..)
        .zip(film.rows())
        .filter(|(_, row)| row.iter().any(|pixel| pixel.samples() == 0))
        .map(|(y, _)| y)
        .collect();
    if let (Some(first), Some(last)) = (missing.first(), missing.last()) {
        let sentence = format!("parts are missing: {} rows, from {first} to {last}", missing.len());
        return Err(Failure::file(sentence).again().help("render them, and merge again"));
    }
    let depth = depth_of(format, arguments.bits, film.channels == Channels::Rgba)?;
    output.check(region, depth, arguments.force)?;
    let developer = Developer::new(depth, film.assumed_gamma, film.pixels.len());
    let picture: Picture = &|out| picture::write(&film, &developer, format, out);
    output.write(picture).map_err(|failure| output.rescue(&output, picture, failure))?;
    messages::eprint(&format!(
        "{}: {}×{}, of {} parts\n",
        output.name(),
        region.width,
        region.height,
        arguments.parts.len()
    ));
    Ok(Exit::Done)
}
