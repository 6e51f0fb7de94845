//! Holds the files that a scene writes, for whoever writes them to disk once the scene is free of errors.
//!
//! **Invariant:** none lies outside the current folder, whatever path is given and wherever a link points, and none is
//! hidden. Nothing here changes the disk.

use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};
use std::sync::Mutex;

use super::reason;
use crate::source::WriteError;

/// Files that one scene has started to write.
pub struct Written {
    /// Canonical path of the current folder.
    root: PathBuf,
    /// Contents by canonical path.
    files: Mutex<BTreeMap<PathBuf, Vec<u8>>>,
}

impl Written {
    /// Allows writing below the current folder. If that folder does not exist any more, writing fails.
    pub fn here() -> Self {
        Self::below(fs::canonicalize(".").unwrap_or(PathBuf::from(".")))
    }

    fn below(root: PathBuf) -> Self {
        Self { root, files: Mutex::default() }
    }

    /// Whether a file that is read lies where this scene may write.
    pub(crate) fn covers(&self, truth: &Path) -> bool {
        truth.starts_with(&self.root)
    }

    /// Returns the current contents of the file, if the scene writes it.
    pub fn bytes(&self, truth: &Path) -> Option<Vec<u8>> {
        self.files.lock().ok()?.get(truth).cloned()
    }

    /// Starts a file and returns its canonical path.
    pub fn start(&self, name: &str, append: bool) -> Result<PathBuf, WriteError> {
        let truth = self.place(name)?;
        let impossible = |error| WriteError::Impossible(reason(&error));
        let before = match self.bytes(&truth) {
            _ if !append => Vec::new(),
            Some(bytes) => bytes,
            None => match fs::read(&truth) {
                Err(error) if error.kind() == ErrorKind::NotFound => Vec::new(),
                read => read.map_err(impossible)?,
            },
        };
        if let Ok(mut files) = self.files.lock() {
            files.insert(truth.clone(), before);
        }
        Ok(truth)
    }

    /// Appends to a started file.
    pub(crate) fn add(&self, truth: &Path, bytes: &[u8]) {
        if let Ok(mut files) = self.files.lock()
            && let Some(file) = files.get_mut(truth)
        {
            file.extend(bytes);
        }
    }

    /// Returns the canonical path at which a file with this name is written.
    fn place(&self, name: &str) -> Result<PathBuf, WriteError> {
        let impossible = |why: &str| Err(WriteError::Impossible(why.to_owned()));
        let mut place = self.root.clone();
        let mut parts = Path::new(name).components().peekable();
        if name.is_empty() || name.ends_with(['/', '\\']) || name.contains('\0') {
            return impossible("this is no name of a file");
        }
        let stays = |part: Component| matches!(part, Component::CurDir | Component::Normal(_));
        if !Path::new(name).components().all(stays) {
            return Err(WriteError::Outside);
        }
        while let Some(part) = parts.next() {
            let Component::Normal(part) = part else { continue };
            if part.to_string_lossy().starts_with('.') {
                return impossible("a scene writes no hidden files");
            }
            place.push(part);
            let about = match fs::symlink_metadata(&place) {
                Ok(about) => Some(about),
                Err(error) if error.kind() == ErrorKind::NotFound => None,
                Err(error) => return impossible(&reason(&error)),
            };
            if about.as_ref().is_some_and(fs::Metadata::is_symlink) {
                return Err(WriteError::Outside);
            }
            match (parts.peek(), about) {
                (Some(_), Some(about)) if about.is_dir() => {}
                (Some(_), _) => return impossible("there is no such folder"),
                (None, Some(about)) if about.is_dir() => return impossible("it is a folder"),
                (None, Some(about)) if !about.is_file() => {
                    return impossible("it is not a regular file");
                }
                (None, _) => {}
            }
        }
        match place == self.root {
            true => impossible("this is no name of a file"),
            false => Ok(place),
        }
    }

    /// Takes out the path, the name below the current folder and the contents of each file. From then on, they are read
    /// from disk.
    pub fn take(&self) -> Vec<(PathBuf, String, Vec<u8>)> {
        let Ok(mut files) = self.files.lock() else { return Vec::new() };
        let files = std::mem::take(&mut *files);
        let name =
            |path: &Path| path.strip_prefix(&self.root).unwrap_or(path).display().to_string();
        files.into_iter().map(|(path, bytes)| (path.clone(), name(&path), bytes)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place() -> (tempfile::TempDir, Written) {
        let root = tempfile::tempdir().expect("a folder");
        fs::create_dir(root.path().join("sub")).expect("a folder");
        fs::write(root.path().join("old.txt"), "old").expect("written");
        let written = Written::below(fs::canonicalize(root.path()).expect("a path"));
        (root, written)
    }

    #[test]
    fn names_that_lead_out_are_refused() {
        let (root, written) = place();
        let start = |name: &str| written.start(name, false).map(drop);
        for name in ["../a.txt", "sub/../../a.txt", "sub/../a.txt", "/tmp/a.txt"] {
            assert_eq!(start(name), Err(WriteError::Outside), "{name}");
        }
        let absolute = root.path().join("a.txt").display().to_string();
        assert_eq!(start(&absolute), Err(WriteError::Outside));
        for name in
            ["", ".", "sub", "sub/", "none/a.txt", "old.txt/a", ".hidden", "sub/.git", "a\0b"]
        {
            assert!(matches!(start(name), Err(WriteError::Impossible(_))), "{name}");
        }
        assert_eq!(start("./sub/a.txt"), Ok(()));
        assert_eq!(start("b.txt"), Ok(()));
    }

    #[cfg(unix)]
    #[test]
    fn links_are_not_followed() {
        let (root, written) = place();
        let link = |to: &str, name: &str| {
            std::os::unix::fs::symlink(to, root.path().join(name)).expect("a link");
        };
        link("/tmp", "folder");
        link("old.txt", "near.txt");
        link("/tmp/nowhere", "far.txt");
        for name in ["folder/a.txt", "near.txt", "far.txt"] {
            assert_eq!(written.start(name, false), Err(WriteError::Outside), "{name}");
        }
    }

    #[test]
    fn files_are_held_and_not_written() {
        let (root, written) = place();
        let read = |name: &str| fs::read_to_string(root.path().join(name)).ok();
        let old = written.start("old.txt", true).expect("started");
        let new = written.start("sub/new.txt", false).expect("started");
        written.add(&old, b" and new");
        written.add(&new, b"new");
        assert_eq!(written.bytes(&old).as_deref(), Some(&b"old and new"[..]));
        assert_eq!((read("old.txt").as_deref(), read("sub/new.txt")), (Some("old"), None));
        let files = written.take();
        let files: Vec<_> =
            files.iter().map(|(_, name, bytes)| (name.as_str(), &bytes[..])).collect();
        assert_eq!(files, [("old.txt", &b"old and new"[..]), ("sub/new.txt", b"new")]);
    }

    #[test]
    fn a_file_that_is_started_anew_is_empty() {
        let (_root, written) = place();
        let path = written.start("old.txt", false).expect("started");
        assert_eq!(written.bytes(&path).as_deref(), Some(&b""[..]));
        written.add(&path, b"1");
        written.start("old.txt", true).expect("started");
        assert_eq!(written.bytes(&path).as_deref(), Some(&b"1"[..]));
    }
}
