//! Files that are read once for all frames of an animation.
//!
//! **Invariant:** a frame reads what it would read alone. What the scene writes is read anew, and so is what was not
//! found: a frame may have written it since.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use lucarne::source::{FileError, Files, Found, WriteError, file_name};

/// Keeps the contents of files.
pub struct Kept<'a> {
    files: &'a dyn Files,
    /// By the name that is asked for, and the file that asks.
    found: RefCell<BTreeMap<(String, String), Found>>,
    /// The last components of the names that the scene writes.
    written: RefCell<BTreeSet<String>>,
}

impl<'a> Kept<'a> {
    pub fn new(files: &'a dyn Files) -> Self {
        Self { files, found: RefCell::default(), written: RefCell::default() }
    }
}

/// Returns the last component of a name, as systems that ignore case compare it.
fn last(name: &str) -> String {
    file_name(name).to_lowercase()
}

impl Files for Kept<'_> {
    fn read(&self, name: &str, from: &str) -> Result<Found, FileError> {
        if self.written.borrow().contains(&last(name)) {
            return self.files.read(name, from);
        }
        let key = (name.to_owned(), from.to_owned());
        if let Some(found) = self.found.borrow().get(&key) {
            return Ok(found.clone());
        }
        let found = self.files.read(name, from)?;
        self.found.borrow_mut().insert(key, found.clone());
        Ok(found)
    }

    fn start(&self, name: &str, append: bool) -> Result<String, WriteError> {
        let started = self.files.start(name, append)?;
        let names = [last(name), last(&started)];
        // A link has another name than the file that it leads to.
        let is_it = |asked: &str, found: &Found| {
            names.contains(&last(asked)) || names.contains(&last(&found.name))
        };
        self.found.borrow_mut().retain(|(asked, _), found| !is_it(asked, found));
        self.written.borrow_mut().extend(names);
        Ok(started)
    }

    fn add(&self, name: &str, bytes: &[u8]) {
        self.files.add(name, bytes);
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use lucarne::road::{Options, Road};
    use lucarne::scene::Dialect;

    use super::*;

    /// Files in memory, and how often each was read.
    #[derive(Default)]
    struct Counting {
        files: RefCell<BTreeMap<String, Vec<u8>>>,
        reads: RefCell<BTreeMap<String, u32>>,
        missed: Cell<u32>,
    }

    impl Files for Counting {
        fn read(&self, name: &str, _: &str) -> Result<Found, FileError> {
            let bytes = self.files.borrow().get(name).cloned().ok_or_else(|| {
                self.missed.set(self.missed.get() + 1);
                FileError::NotFound { searched: Vec::new(), similar: Vec::new() }
            })?;
            *self.reads.borrow_mut().entry(name.to_owned()).or_default() += 1;
            Ok(Found { name: name.to_owned(), bytes })
        }

        fn start(&self, name: &str, append: bool) -> Result<String, WriteError> {
            let mut files = self.files.borrow_mut();
            let bytes = files.entry(name.to_owned()).or_default();
            if !append {
                bytes.clear();
            }
            Ok(name.to_owned())
        }

        fn add(&self, name: &str, bytes: &[u8]) {
            self.files.borrow_mut().entry(name.to_owned()).or_default().extend(bytes);
        }
    }

    /// Includes a file twice, reads a mesh, and counts the frames in a file of its own.
    const FRAME: &str = "#include \"a.inc\" object { M }
        #if (file_exists(\"count.txt\")) #fopen F \"count.txt\" read #read (F, N) #fclose F
        #else #declare N = 0; #end
        #fopen F \"count.txt\" write #write (F, N + 1) #fclose F
        #include \"a.inc\" sphere { N*x, 1 }";

    fn of_frames(files: &dyn Files, frames: usize) -> Vec<String> {
        let frame = |_| {
            let mut options = Options::new(Dialect::Scene);
            options.levels.set_all(lucarne::diagnostic::Level::Allow);
            let mut road = Road::new(files, options);
            let (world, _) = road.compile("a.pov", FRAME);
            let errors: Vec<_> = road.diagnostics.iter().filter(|one| one.is_error()).collect();
            assert!(errors.is_empty(), "{errors:?}");
            format!("{:?}", world.spheres)
        };
        (0..frames).map(frame).collect()
    }

    fn counting() -> Counting {
        let counting = Counting::default();
        let cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        for (name, text) in [("a.inc", "#declare M = mesh { file \"a.obj\" };"), ("a.obj", cube)] {
            counting.files.borrow_mut().insert(name.to_owned(), text.into());
        }
        counting
    }

    #[test]
    fn frames_read_each_file_once_but_those_that_the_scene_writes() {
        let (kept, alone) = (counting(), counting());
        let frames = of_frames(&Kept::new(&kept), 4);
        assert_eq!(frames, of_frames(&alone, 4));
        assert!(frames[1] != frames[2]);
        let reads = |counting: &Counting, name| counting.reads.borrow().get(name).copied();
        for name in ["a.inc", "a.obj"] {
            assert_eq!(reads(&kept, name), Some(1), "{name}");
            assert!(reads(&alone, name) >= Some(4), "{name}");
        }
        assert_eq!(reads(&kept, "count.txt"), reads(&alone, "count.txt"));
        assert_eq!(kept.missed, alone.missed);
    }
}
