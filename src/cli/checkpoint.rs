//! Saves what is done of a long render now and then, so that `--resume` goes on from there.
//!
//! **Invariant:** a checkpoint is complete or absent, and of one scene with one set of options: others are refused. The
//! render that saves it, or goes on from it, has locked it: no other replaces or removes it. The lock ends with the process.

use std::fs::{self, File, TryLockError};
use std::io::{ErrorKind, Read};
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
use super::output::{cannot, replaced};
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

/// What a checkpoint has of a picture.
#[derive(Default)]
pub struct Begun {
    pub films: Vec<Film>,
    /// The locked file, if there is one.
    file: Option<File>,
}

/// Locks a checkpoint until the file is closed; returns false if another render has. Where the system has no locks, none
/// has.
fn lock(file: &File) -> bool {
    !matches!(file.try_lock(), Err(TryLockError::WouldBlock))
}

/// Reads a checkpoint, and locks it; nothing is begun if there is no such file.
pub fn resumed(path: &Path, key: u64) -> Result<Begun, Failure> {
    let failed = |error: std::io::Error| {
        Failure::file(format!("cannot read `{}`: {}", path.display(), reason(&error)))
    };
    let mut file = match File::open(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Begun::default()),
        opened => opened.map_err(failed)?,
    };
    let wrong = |why: &str| Failure::file(format!("cannot go on from `{}`: {why}", path.display()));
    if !lock(&file) {
        return Err(wrong("another render of this picture is running").again());
    }
    let wrong = |why: &str| {
        wrong(why).help("without `--resume`, the picture is rendered from its beginning")
    };
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(failed)?;
    match load(&bytes) {
        Ok(Saved { purpose: Purpose::Part, .. }) => Err(wrong("it is a part for `lucarne merge`")),
        Ok(Saved { key: found, films, .. }) if found == key => {
            Ok(Begun { films, file: Some(file) })
        }
        Ok(_) => Err(wrong("it is of another scene, or of other options")),
        Err(damage) => Err(wrong(&damage.to_string())),
    }
}

/// Removes a checkpoint, once its picture is written, unless another render has locked it.
pub fn remove(path: &Path) -> Result<(), Failure> {
    if is_of_another(path) {
        return Ok(());
    }
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(cannot(path, &reason(&error))),
        _ => Ok(()),
    }
}

/// Whether another render has locked the checkpoint.
fn is_of_another(path: &Path) -> bool {
    File::open(path).is_ok_and(|file| !lock(&file))
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
    /// The checkpoint that is on disk, locked.
    file: Option<File>,
}

impl<'a> Checkpoint<'a> {
    /// The first is saved after twice the time between two, and has what is done from then on; if the run is limited,
    /// what is done from its start on. `begun` is what a checkpoint had.
    pub fn new(
        progress: &'a Progress,
        path: PathBuf,
        (key, region): (u64, Region),
        (every, is_limited): (Duration, bool),
        Begun { films, file }: Begun,
    ) -> Self {
        let (copies, next) = (is_limited || !films.is_empty(), Instant::now() + 2 * every);
        let saved = Saved { purpose: Purpose::Checkpoint, key, region, films };
        let state = State { saved, shapes: Vec::new(), next, copies, is_noted: false, file };
        Self { progress, path, every, state: Mutex::new(state) }
    }

    /// Saves what is done, if that is worth it.
    pub fn save(&self) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if state.copies {
            self.write(&mut state);
        }
    }

    /// Whether `--resume` can go on from what is saved.
    pub fn is_kept(&self) -> bool {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).file.is_some()
    }

    /// Writes the checkpoint. If that fails, prints a note once; the render goes on.
    fn write(&self, state: &mut State) {
        if let Err(failure) = self.replace(state)
            && !std::mem::replace(&mut state.is_noted, true)
        {
            messages::eprint(&format!("note: no checkpoint: {}\n", failure.sentence));
        }
        state.next = Instant::now() + self.every;
    }

    fn replace(&self, State { saved, file, .. }: &mut State) -> Result<(), Failure> {
        if file.is_none() && is_of_another(&self.path) {
            return Err(cannot(&self.path, "another render of this picture is running"));
        }
        // Locked before anyone sees it; the one that it replaces is locked until then.
        *file = Some(replaced(&self.path, &|out| save(saved, out), |new| {
            lock(new);
        })?);
        Ok(())
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
