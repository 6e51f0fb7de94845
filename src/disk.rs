//! Finds the files that a scene names in folders of the disk: [`DiskFiles`].
//!
//! **Invariant:** a file always has the same name. With `--sandbox`, only files in the scene's folder, the
//! `-I` folders and POV-Ray's well-known include folders are read, whatever path is given and wherever a
//! link points. A file that the scene writes is read with its new contents.

mod written;

use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};
use std::sync::Mutex;

use crate::diagnostic::suggest::closest;
use crate::source::{FileError, Files, Found, UTF_16, WriteError, file_name, is_utf_16};
use crate::vocabulary::is_standard_include;

pub use written::Written;

/// Folders where POV-Ray's standard includes are installed; searched last.
const WELL_KNOWN: &[&str] = &[
    "/usr/share/povray-3.7/include",
    "/usr/local/share/povray-3.7/include",
    "/opt/homebrew/share/povray-3.7/include",
    "/opt/local/share/povray-3.7/include",
];

/// Largest file size that is read, in bytes: text positions have 32 bits.
#[doc(hidden)]
pub const LARGEST: u64 = 1 << 30;

/// Debian's folder for POV-Ray's fonts; the include folder only links to it.
const FONTS: &str = "/usr/share/fonts/truetype/povray";

/// Finds the files of one scene on disk.
///
/// ```no_run
/// use lucarne::{RenderOptions, disk::DiskFiles, render};
///
/// let files = DiskFiles::new("scenes/chess.pov".as_ref(), &["include".into()]);
/// let text = std::fs::read_to_string("scenes/chess.pov")?;
/// let options = RenderOptions { name: "scenes/chess.pov", files: &files, ..RenderOptions::default() };
/// render(&text, &options)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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
    /// Searches the folder of the main file, then `include` in order, then the folders where POV-Ray's includes are
    /// usually installed. Skips folders that do not exist.
    pub fn new(main: &Path, include: &[PathBuf]) -> Self {
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

    /// Refuses files outside the folders that are searched.
    pub fn sandboxed(self) -> Self {
        Self { sandbox: true, ..self }
    }

    /// Lets the scene write files below the current folder. They are held in memory, where the scene reads them;
    /// [`Self::written`] returns them for its caller to write.
    pub fn writing(self) -> Self {
        Self { written: Some(Written::here()), ..self }
    }

    /// Returns the files that the scene writes, if it may.
    pub fn written(&self) -> Option<&Written> {
        self.written.as_ref()
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
#[doc(hidden)]
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

/// Returns the operating system's reason as a clause, without the error number: `permission denied`.
pub fn reason(error: &std::io::Error) -> String {
    let text = error.to_string();
    let text = text.split(" (os error").next().unwrap_or(&text);
    let mut chars = text.chars();
    let first = chars.next().map(|c| c.to_lowercase().to_string()).unwrap_or_default();
    first + chars.as_str()
}

#[cfg(test)]
mod tests;
