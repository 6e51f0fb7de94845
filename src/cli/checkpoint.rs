//! Saves what is done of a long render now and then, so that `--resume` goes on from there.
//!
//! **Invariant:** a checkpoint is complete or absent, and of one scene with one set of options: others are refused.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use lucarne::disk::reason;
use lucarne::film::saved::{Digest, Purpose, Saved, load, save};
use lucarne::film::{Film, Pixel};
use lucarne::plan::Region;
use lucarne::trace::Watch;

use super::exit::Failure;
use super::messages;
use super::output::{cannot, write_with};
use super::progress::Progress;

/// Returns the place of the checkpoint of a picture.
pub fn beside(path: &Path) -> PathBuf {
    PathBuf::from(format!("{}.checkpoint", path.display()))
}

/// Returns a number that differs for other scenes and options: what is hashed is what decides a picture.
pub fn key(what: impl FnOnce(&mut Digest)) -> u64 {
    let mut digest = Digest::default();
    digest.add(env!("CARGO_PKG_VERSION").as_bytes());
    what(&mut digest);
    digest.get()
}

/// Reads the films of a checkpoint; none if there is no such file.
pub fn resumed(path: &Path, key: u64) -> Result<Vec<Film>, Failure> {
    let bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => {
            let sentence = format!("cannot read `{}`: {}", path.display(), reason(&error));
            return Err(Failure::file(sentence));
        }
    };
    let wrong = |why: &str| {
        Failure::file(format!("cannot go on from `{}`: {why}", path.display()))
            .help("without `--resume`, the picture is rendered from its beginning")
    };
    match load(&bytes) {
        Ok(Saved { purpose: Purpose::Part, .. }) => Err(wrong("it is a part for `lucarne merge`")),
        Ok(Saved { key: found, films, .. }) if found == key => Ok(films),
        Ok(_) => Err(wrong("it is of another scene, or of other options")),
        Err(damage) => Err(wrong(&damage.to_string())),
    }
}

/// Removes a checkpoint, once its picture is written.
pub fn remove(path: &Path) -> Result<(), Failure> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(cannot(path, &reason(&error)))
        }
        _ => Ok(()),
    }
}

/// Watches a render, and saves it.
pub struct Checkpoint<'a> {
    progress: &'a Progress,
    path: PathBuf,
    every: Duration,
    state: Mutex<State>,
}

struct State {
    /// With the film of each pass, once there is one: a render that is soon done takes no memory for it.
    saved: Saved,
    /// The films of the passes so far, without pixels.
    shapes: Vec<Film>,
    next: Instant,
    /// Whether the films are copied.
    copies: bool,
    is_noted: bool,
}

impl<'a> Checkpoint<'a> {
    /// The first is saved after twice the time between two, and has what is done from then on. `begun` is what a
    /// checkpoint had.
    pub fn new(
        progress: &'a Progress,
        path: PathBuf,
        (key, region): (u64, Region),
        every: Duration,
        begun: Vec<Film>,
    ) -> Self {
        let (copies, next) = (!begun.is_empty(), Instant::now() + 2 * every);
        let saved = Saved { purpose: Purpose::Checkpoint, key, region, films: begun };
        let state = State { saved, shapes: Vec::new(), next, copies, is_noted: false };
        Self { progress, path, every, state: Mutex::new(state) }
    }

    /// Saves what is done, if that is worth it.
    pub fn save(&self) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if state.copies {
            self.write(&mut state);
        }
    }

    /// Writes the checkpoint. If that fails, prints a note once; the render goes on.
    fn write(&self, State { saved, next, is_noted, .. }: &mut State) {
        if let Err(failure) = write_with(&self.path, &|out| save(saved, out))
            && !std::mem::replace(is_noted, true)
        {
            messages::eprint(&format!("note: no checkpoint: {}\n", failure.sentence));
        }
        *next = Instant::now() + self.every;
    }
}

impl State {
    /// Makes a film for each pass so far that has none; false if there is no memory.
    fn make_films(&mut self) -> bool {
        for shape in &self.shapes[self.saved.films.len().min(self.shapes.len())..] {
            let count = shape.frame.region.width as usize * shape.frame.region.height as usize;
            let mut pixels = Vec::new();
            if pixels.try_reserve_exact(count).is_err() {
                return false;
            }
            pixels.resize(count, Pixel::default());
            self.saved.films.push(Film { pixels, ..shape.clone() });
        }
        true
    }
}

impl Watch for Checkpoint<'_> {
    fn built(&self) {
        self.progress.built();
    }

    fn begins(&self, pass: usize, film: &Film) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let Film { frame, assumed_gamma, channels, .. } = *film;
        state.shapes.truncate(pass);
        state.shapes.push(Film { frame, assumed_gamma, channels, pixels: Vec::new() });
        if state.copies && !state.make_films() {
            state.copies = false;
        }
    }

    fn traced(&self, pass: usize, (x, y): (u32, u32), rows: &[&mut [Pixel]]) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let is_due = Instant::now() >= state.next;
        if is_due && !state.copies {
            state.copies = state.make_films();
        }
        if !state.copies {
            return;
        }
        let Some(film) = state.saved.films.get_mut(pass) else { return };
        for (line, row) in (y..).zip(rows) {
            let start = film.index(x, line);
            film.pixels[start..start + row.len()].copy_from_slice(row);
        }
        if is_due {
            self.write(&mut state);
        }
    }

    fn progress(&self, done: usize, total: usize) {
        self.progress.progress(done, total);
    }

    fn should_stop(&self) -> bool {
        self.progress.should_stop()
    }
}
