//! Resolves the files that a scene names on disk.
//!
//! **Invariant:** a file always has the same name. With `--sandbox`, only files in the scene's folder, the
//! `-I` folders and POV-Ray's well-known include folders are read, whatever path is given and wherever a
//! link points. A file that the scene writes is read with its new contents.

use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};
use std::sync::Mutex;

use lucarne::diagnostic::suggest::closest;
use lucarne::source::{FileError, Files, Found, WriteError, file_name};
use lucarne::vocabulary::is_standard_include;

use super::exit::{Failure, reason};
use super::scene::SceneArguments;
use super::text::{LARGEST, UTF_16, is_utf_16};
use super::written::Written;

/// Folders where POV-Ray's standard includes are installed; searched last.
const WELL_KNOWN: &[&str] = &[
    "/usr/share/povray-3.7/include",
    "/usr/local/share/povray-3.7/include",
    "/opt/homebrew/share/povray-3.7/include",
    "/opt/local/share/povray-3.7/include",
];

/// Debian's folder for POV-Ray's fonts; the include folder only links to it.
const FONTS: &str = "/usr/share/fonts/truetype/povray";

/// File access for one scene.
pub struct DiskFiles {
    /// Folders in search order, after that of the including file: the given and the canonical path.
    folders: Vec<(PathBuf, PathBuf)>,
    /// Whether files outside `folders` are refused.
    sandbox: bool,
    /// Name under which each file was first found, by canonical path.
    names: Mutex<BTreeMap<PathBuf, String>>,
    /// Files written by the scene, if it is allowed to write.
    written: Option<Written>,
}

impl DiskFiles {
    /// Searches the folder of the main file, then `include` in order, then the well-known folders. Skips
    /// folders that do not exist.
    fn new(main: &Path, include: &[PathBuf]) -> Self {
        let own = match main.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
            _ => PathBuf::from("."),
        };
        let named = std::iter::once(own)
            .chain(include.iter().cloned())
            .chain(WELL_KNOWN.iter().chain([&FONTS]).map(PathBuf::from));
        let folders = named
            .filter_map(|folder| fs::canonicalize(&folder).ok().map(|truth| (folder, truth)))
            .filter(|(_, truth)| truth.is_dir())
            .collect();
        let names = fs::canonicalize(main).map(|truth| (truth, main.display().to_string()));
        let names = Mutex::new(names.into_iter().collect());
        Self { folders, sandbox: false, names, written: None }
    }

    /// Searches folders as given on the command line, and allows writing if requested there.
    pub fn of(main: &Path, arguments: &SceneArguments) -> Self {
        let written = arguments.allow_write.then(Written::here);
        Self { written, sandbox: arguments.sandbox, ..Self::new(main, &arguments.include) }
    }

    /// Writes the scene's files to disk if the scene is `whole`, that is, free of errors.
    pub fn settle(&self, whole: bool) -> Result<(), Failure> {
        self.written.as_ref().map_or(Ok(()), |written| written.settle(whole))
    }

    /// Reports the files that the scene would write if it is `whole`, that is, free of errors.
    pub fn announce(&self, whole: bool) -> Result<(), Failure> {
        self.written.as_ref().map_or(Ok(()), |written| written.announce(whole))
    }

    fn allowed(&self, truth: &Path) -> bool {
        !self.sandbox
            || self.folders.iter().any(|(_, folder)| truth.starts_with(folder))
            || self.written.as_ref().is_some_and(|written| written.covers(truth))
    }

    /// Whether the existence of `path` may be disclosed. In a sandbox, it may not be for files outside it.
    fn may_be_seen(&self, path: &Path) -> bool {
        let mut folders = path.ancestors().skip(1);
        !self.sandbox
            || folders
                .find_map(|folder| fs::canonicalize(or_here(folder)).ok())
                .is_some_and(|folder| self.allowed(&folder))
    }

    /// Returns the name of a file: the name under which it was first found.
    fn name(&self, truth: PathBuf, found_as: &Path) -> String {
        let plain = || plain(found_as).display().to_string();
        match self.names.lock() {
            Ok(mut names) => names.entry(truth).or_insert_with(plain).clone(),
            Err(_) => plain(),
        }
    }

    /// Returns the contents the scene writes to this file, if it does.
    fn own(&self, path: &Path) -> Option<Found> {
        let written = self.written.as_ref()?;
        let folder = fs::canonicalize(or_here(path.parent()?)).ok()?;
        let truth = folder.join(path.file_name()?);
        let bytes = written.bytes(&truth)?;
        Some(Found { name: self.name(truth, path), bytes })
    }

    /// Returns suggestions for a missing file: its file name alone, if one of the `folders` has it, and
    /// similar names in the places that were searched.
    fn similar(&self, name: &str, folders: &[PathBuf], tried: &[PathBuf]) -> Vec<String> {
        let mut similar = Vec::new();
        let last = file_name(name);
        let is_there = |folder: &PathBuf| {
            fs::canonicalize(folder.join(last))
                .is_ok_and(|path| path.is_file() && self.allowed(&path))
        };
        if last != name && folders.iter().any(is_there) {
            similar.push(last.to_owned());
        }
        for path in tried {
            let (Some(folder), Some(last)) = (path.parent(), path.file_name()) else { continue };
            let folder = or_here(folder);
            let known = fs::canonicalize(folder).is_ok_and(|truth| self.allowed(&truth));
            let Some(entries) = known.then(|| fs::read_dir(folder).ok()).flatten() else {
                continue;
            };
            let last = last.to_string_lossy();
            // A link that leads nowhere has the missing name itself.
            let names: Vec<String> = entries
                .flatten()
                .filter_map(|entry| entry.file_name().into_string().ok())
                .filter(|other| *other != last)
                .collect();
            let whole = format!("{last}.inc");
            let mut names = names.iter().map(String::as_str);
            let near =
                names.clone().find(|other| *other == whole).or_else(|| closest(&last, &mut names));
            // Beside what was named.
            let near = near.map(|near| Path::new(name).with_file_name(near).display().to_string());
            if let Some(near) = near.filter(|near| !similar.contains(near)) {
                similar.push(near);
            }
        }
        similar
    }
}

impl Files for DiskFiles {
    fn read(&self, name: &str, from: &str) -> Result<Found, FileError> {
        let here = Path::new(from).parent().map(Path::to_owned).unwrap_or_default();
        // What is written in the current folder is found there again, before all others.
        let current = self.written.as_ref().map(|_| PathBuf::new());
        let folders = self.folders.iter().map(|(folder, _)| folder.clone());
        let folders: Vec<PathBuf> = current.into_iter().chain([here]).chain(folders).collect();
        let mut tried: Vec<PathBuf> = Vec::new();
        for folder in &folders {
            let path = plain(&folder.join(name));
            if !tried.contains(&path) {
                tried.push(path);
            }
        }
        let (mut inside, mut leads_out) = (false, false);
        for path in &tried {
            if !self.may_be_seen(path) {
                continue;
            }
            inside = true;
            if let Some(found) = self.own(path) {
                return Ok(found);
            }
            match fs::canonicalize(path) {
                Ok(truth) if !self.allowed(&truth) => leads_out = true,
                Ok(truth) => {
                    let bytes = read_file(&truth).map_err(FileError::Unreadable)?;
                    return Ok(Found { name: self.name(truth, path), bytes });
                }
                Err(error) if error.kind() == ErrorKind::PermissionDenied => {
                    return Err(FileError::Unreadable(reason(&error)));
                }
                Err(_) => {}
            }
        }
        if leads_out || !inside {
            return Err(FileError::Forbidden);
        }
        let searched = tried.iter().filter_map(|path| path.parent());
        let mut searched: Vec<String> =
            searched.map(|folder| or_here(folder).display().to_string()).collect();
        if is_standard_include(name) {
            // Where it would have been found, had it been installed.
            let absent = WELL_KNOWN.iter().filter(|folder| !Path::new(folder).is_dir());
            searched.extend(absent.map(|folder| format!("{folder} (not there)")));
        }
        Err(FileError::NotFound { searched, similar: self.similar(name, &folders, &tried) })
    }

    fn start(&self, name: &str, append: bool) -> Result<String, WriteError> {
        let written = self.written.as_ref().ok_or(WriteError::NotAllowed)?;
        Ok(self.name(written.start(name, append)?, Path::new(name)))
    }

    fn add(&self, name: &str, bytes: &[u8]) {
        let Some(written) = &self.written else { return };
        let truth = self.names.lock().ok().and_then(|names| {
            let mut found = names.iter().filter(|(_, other)| *other == name);
            found.next().map(|(truth, _)| truth.clone())
        });
        if let Some(truth) = truth {
            written.add(&truth, bytes);
        }
    }
}

/// Returns the folder, with the empty path replaced by the current folder.
pub fn or_here(folder: &Path) -> &Path {
    if folder.as_os_str().is_empty() { Path::new(".") } else { folder }
}

/// Removes `.` components and, if no folder on the path is a link, `..` components.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir
                if matches!(plain.components().next_back(), Some(Component::Normal(_)))
                    && !plain.is_symlink() =>
            {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}

/// Reads a regular file, or returns why it cannot be read.
fn read_file(path: &Path) -> Result<Vec<u8>, String> {
    let about = fs::metadata(path).map_err(|error| reason(&error))?;
    if about.is_dir() {
        return Err("it is a folder".to_owned());
    }
    if !about.is_file() {
        return Err("it is not a regular file".to_owned());
    }
    if about.len() > LARGEST {
        return Err("it is larger than 1 GiB".to_owned());
    }
    let bytes = fs::read(path).map_err(|error| reason(&error))?;
    match is_utf_16(&bytes) {
        true => Err(format!("{UTF_16}; save it as UTF-8")),
        false => Ok(bytes),
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

#[cfg(test)]
mod tests;
