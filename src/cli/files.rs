//! The files of a scene as the command line allows them: which folders are searched, and what is written.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use lucarne::disk::DiskFiles;
use lucarne::film::saved::Digest;
use lucarne::source::{FileError, Files, Found, WriteError};

use super::exit::Failure;
use super::messages;
use super::output::write_whole;
use super::scene::SceneArguments;

/// Searches folders as given on the command line, and allows writing if requested there.
pub fn of(main: &Path, arguments: &SceneArguments) -> DiskFiles {
    let files = DiskFiles::new(main, &arguments.include);
    let files = if arguments.sandbox { files.sandboxed() } else { files };
    if arguments.allow_write { files.writing() } else { files }
}

/// Writes and reports the scene's files if it is `whole`, that is, free of errors: each file completely, or none.
pub fn settle(files: &DiskFiles, whole: bool) -> Result<(), Failure> {
    each(files, whole, "by the scene", write_whole)
}

/// Reports the files that the scene would write if it is `whole`, that is, free of errors.
pub fn announce(files: &DiskFiles, whole: bool) -> Result<(), Failure> {
    each(files, whole, "not written: only rendering writes", |_, _| Ok(()))
}

fn each(
    files: &DiskFiles,
    whole: bool,
    said: &str,
    done: impl Fn(&Path, &[u8]) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let files = files.written().map(|written| written.take()).unwrap_or_default();
    if !whole && !files.is_empty() {
        messages::eprint("the scene has errors: the files that it writes were left as they are\n");
        return Ok(());
    }
    for (path, name, bytes) in files {
        done(&path, &bytes)?;
        let count = bytes.len();
        let s = if count == 1 { "" } else { "s" };
        messages::eprint(&format!("{name}: {count} byte{s}, {said}\n"));
    }
    Ok(())
}

/// Files whose names and contents are recorded.
pub struct Recorded<'a> {
    files: &'a dyn Files,
    read: RefCell<Digest>,
    names: RefCell<BTreeSet<String>>,
}

impl<'a> Recorded<'a> {
    pub fn new(files: &'a dyn Files) -> Self {
        Self { files, read: RefCell::default(), names: RefCell::default() }
    }

    /// Adds what was read to a digest.
    pub fn add_to(&self, digest: &mut Digest) {
        digest.add(&self.read.borrow().get().to_le_bytes());
    }

    /// Returns the names of the files that were found.
    pub fn names(&self) -> BTreeSet<String> {
        self.names.borrow().clone()
    }
}

impl Files for Recorded<'_> {
    fn read(&self, name: &str, from: &str) -> Result<Found, FileError> {
        let found = self.files.read(name, from);
        let mut read = self.read.borrow_mut();
        read.add(name.as_bytes());
        if let Ok(found) = &found {
            read.add(&found.bytes);
            self.names.borrow_mut().insert(found.name.clone());
        }
        found
    }

    fn start(&self, name: &str, append: bool) -> Result<String, WriteError> {
        self.files.start(name, append)
    }

    fn add(&self, name: &str, bytes: &[u8]) {
        self.files.add(name, bytes);
    }
}

/// Fails if one of the given folders is not a folder.
pub fn exist(folders: &[PathBuf]) -> Result<(), Failure> {
    match folders.iter().find(|folder| !folder.is_dir()) {
        None => Ok(()),
        Some(folder) => {
            let sentence = format!("`-I {}`: there is no such folder", folder.display());
            Err(Failure::usage(sentence))
        }
    }
}
