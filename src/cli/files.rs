//! Files on disk, within the folders that may be read.
//!
//! **Invariant:** nothing outside of the scene's folder, the `-I` folders and POV-Ray's well-known include
//! folders is read, whatever a name says and wherever a link leads; the same file always has the
//! same name. What the scene writes is read as it will be.

use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};
use std::sync::Mutex;

use lucarne::diagnostic::suggest::closest;
use lucarne::source::{FileError, Files, Found, WriteError};
use lucarne::vocabulary::is_standard_include;

use super::exit::{Failure, reason};
use super::scene::SceneArguments;
use super::text::{LARGEST, UTF_16, is_utf_16};
use super::written::Written;

/// Where POV-Ray's standard includes are installed; searched last.
const WELL_KNOWN: &[&str] = &[
    "/usr/share/povray-3.7/include",
    "/usr/local/share/povray-3.7/include",
    "/opt/homebrew/share/povray-3.7/include",
    "/opt/local/share/povray-3.7/include",
];

/// Where Debian keeps POV-Ray's fonts: its include folder only has links that lead there.
const FONTS: &str = "/usr/share/fonts/truetype/povray";

/// The folders one scene may read.
pub struct DiskFiles {
    /// In the order they are searched, after the including file's own: as named, and in truth.
    folders: Vec<(PathBuf, PathBuf)>,
    /// The name each file got when it was first found, by its true path.
    names: Mutex<BTreeMap<PathBuf, String>>,
    /// What the scene writes, where it may.
    written: Option<Written>,
}

impl DiskFiles {
    /// The folders of a main file: its own, then `include` in order, then the well-known ones.
    /// Folders that do not exist are left out.
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
        Self { folders, names: Mutex::new(names.into_iter().collect()), written: None }
    }

    /// The folders of a main file, as the command line has them, and the leave to write.
    pub fn of(main: &Path, arguments: &SceneArguments) -> Self {
        let written = arguments.allow_write.then(Written::here);
        Self { written, ..Self::new(main, &arguments.include) }
    }

    /// Writes what the scene has written, if it is `whole`.
    pub fn settle(&self, whole: bool) -> Result<(), Failure> {
        self.written.as_ref().map_or(Ok(()), |written| written.settle(whole))
    }

    /// Says what the scene would write, if it is `whole`.
    pub fn announce(&self, whole: bool) -> Result<(), Failure> {
        self.written.as_ref().map_or(Ok(()), |written| written.announce(whole))
    }

    fn allowed(&self, truth: &Path) -> bool {
        self.folders.iter().any(|(_, folder)| truth.starts_with(folder))
            || self.written.as_ref().is_some_and(|written| written.covers(truth))
    }

    /// The name of a file: the one it was first found by.
    fn name(&self, truth: PathBuf, found_as: &Path) -> String {
        let plain = || plain(found_as).display().to_string();
        match self.names.lock() {
            Ok(mut names) => names.entry(truth).or_insert_with(plain).clone(),
            Err(_) => plain(),
        }
    }

    /// The file as the scene writes it, if it does.
    fn own(&self, path: &Path) -> Option<Found> {
        let written = self.written.as_ref()?;
        let folder = fs::canonicalize(or_here(path.parent()?)).ok()?;
        let truth = folder.join(path.file_name()?);
        let bytes = written.bytes(&truth)?;
        Some(Found { name: self.name(truth, path), bytes })
    }

    /// Names near a missing one, in the folders where it was looked for.
    fn similar(&self, tried: &[PathBuf]) -> Vec<String> {
        let mut similar = Vec::new();
        for path in tried {
            let (Some(folder), Some(name)) = (path.parent(), path.file_name()) else { continue };
            let folder = or_here(folder);
            let known = fs::canonicalize(folder).is_ok_and(|truth| self.allowed(&truth));
            let Some(entries) = known.then(|| fs::read_dir(folder).ok()).flatten() else {
                continue;
            };
            let names: Vec<String> = entries
                .flatten()
                .filter_map(|entry| entry.file_name().into_string().ok())
                .collect();
            let (name, names) = (name.to_string_lossy(), names.iter().map(String::as_str));
            let whole = format!("{name}.inc");
            let near =
                names.clone().find(|other| *other == whole).or_else(|| closest(&name, names));
            similar.extend(near.map(str::to_owned));
        }
        let mut seen = Vec::new();
        similar.retain(|name| {
            !seen.contains(name) && {
                seen.push(name.clone());
                true
            }
        });
        similar
    }
}

impl Files for DiskFiles {
    fn read(&self, name: &str, from: &str) -> Result<Found, FileError> {
        let here = Path::new(from).parent().map(Path::to_owned).unwrap_or_default();
        // What is written in the current folder is found there again, before all others.
        let current = self.written.as_ref().map(|_| PathBuf::new());
        let folders = self.folders.iter().map(|(folder, _)| folder.clone());
        let folders = current.into_iter().chain([here]).chain(folders);
        let mut tried: Vec<PathBuf> = Vec::new();
        for folder in folders {
            let path = plain(&folder.join(name));
            if !tried.contains(&path) {
                tried.push(path);
            }
        }
        let (mut inside, mut leads_out) = (false, false);
        for path in &tried {
            // Even whether it exists is nobody's business outside of the folders.
            let mut folders = path.ancestors().skip(1);
            let folder = folders.find_map(|folder| fs::canonicalize(or_here(folder)).ok());
            if !folder.is_some_and(|folder| self.allowed(&folder)) {
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
        Err(FileError::NotFound { searched, similar: self.similar(&tried) })
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

/// The empty path is the current folder.
pub fn or_here(folder: &Path) -> &Path {
    if folder.as_os_str().is_empty() { Path::new(".") } else { folder }
}

/// A path without `.` and, where it can be told from the path alone, without `..`.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir
                if matches!(plain.components().next_back(), Some(Component::Normal(_))) =>
            {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}

/// All of a regular file, or why not.
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

/// Fails when one of the folders that were named is none.
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
mod tests {
    use super::*;

    struct Place {
        root: tempfile::TempDir,
    }

    impl Place {
        fn new(files: &[&str]) -> Self {
            let root = tempfile::tempdir().expect("a folder");
            for file in files {
                let path = root.path().join(file);
                fs::create_dir_all(path.parent().expect("a parent")).expect("folders");
                fs::write(path, file).expect("written");
            }
            Self { root }
        }

        fn path(&self, name: &str) -> PathBuf {
            self.root.path().join(name)
        }

        fn files(&self, include: &[&str]) -> DiskFiles {
            let include: Vec<PathBuf> = include.iter().map(|name| self.path(name)).collect();
            DiskFiles::new(&self.path("scene/main.scene"), &include)
        }

        fn read(&self, files: &DiskFiles, name: &str) -> Result<String, FileError> {
            let main = self.path("scene/main.scene").display().to_string();
            files.read(name, &main).map(|found| String::from_utf8_lossy(&found.bytes).into_owned())
        }
    }

    #[test]
    fn folders_are_searched_in_order() {
        let place =
            Place::new(&["scene/a.inc", "one/a.inc", "one/b.inc", "two/b.inc", "two/c.inc"]);
        let files = place.files(&["one", "two"]);
        assert_eq!(place.read(&files, "a.inc").as_deref(), Ok("scene/a.inc"));
        assert_eq!(place.read(&files, "b.inc").as_deref(), Ok("one/b.inc"));
        assert_eq!(place.read(&files, "c.inc").as_deref(), Ok("two/c.inc"));
    }

    #[test]
    fn an_include_finds_its_neighbours_first() {
        let place = Place::new(&["scene/a.inc", "scene/parts/b.inc", "scene/parts/a.inc"]);
        let files = place.files(&[]);
        let found = files.read("a.inc", &place.path("scene/parts/b.inc").display().to_string());
        assert_eq!(found.expect("found").bytes, b"scene/parts/a.inc");
    }

    #[test]
    fn a_name_that_leads_out_is_forbidden() {
        let place = Place::new(&["scene/a.inc", "secret.inc", "scene/parts/b.inc"]);
        let files = place.files(&[]);
        assert_eq!(place.read(&files, "../secret.inc"), Err(FileError::Forbidden));
        assert_eq!(place.read(&files, "../no_such.inc"), Err(FileError::Forbidden));
        assert_eq!(place.read(&files, "parts/../../secret.inc"), Err(FileError::Forbidden));
        assert_eq!(place.read(&files, "/etc/hostname"), Err(FileError::Forbidden));
        assert_eq!(place.read(&files, "parts/../a.inc").as_deref(), Ok("scene/a.inc"));
        let absolute = place.path("scene/a.inc").display().to_string();
        assert_eq!(place.read(&files, &absolute).as_deref(), Ok("scene/a.inc"));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_that_leads_out_is_not_followed() {
        let place = Place::new(&["scene/a.inc", "secret.inc"]);
        let (secret, link) = (place.path("secret.inc"), place.path("scene/link.inc"));
        std::os::unix::fs::symlink(secret, link).expect("a link");
        std::os::unix::fs::symlink(place.path("scene/a.inc"), place.path("scene/near.inc"))
            .expect("a link");
        let files = place.files(&[]);
        assert_eq!(place.read(&files, "link.inc"), Err(FileError::Forbidden));
        assert_eq!(place.read(&files, "near.inc").as_deref(), Ok("scene/a.inc"));
    }

    #[test]
    fn one_file_has_one_name() {
        let place = Place::new(&["scene/main.scene", "scene/a.inc", "scene/parts/b.inc"]);
        let files = place.files(&["scene"]);
        let main = place.path("scene/main.scene").display().to_string();
        let name = |name: &str| files.read(name, &main).expect("found").name;
        assert_eq!(name("main.scene"), main);
        assert_eq!(name("parts/../a.inc"), name("./a.inc"));
    }

    #[test]
    fn a_missing_file_has_the_folders_searched_and_a_near_name() {
        let place = Place::new(&["scene/colours.inc", "one/x.inc"]);
        let files = place.files(&["one"]);
        let Err(FileError::NotFound { searched, similar }) = place.read(&files, "colors.inc2")
        else {
            panic!("found")
        };
        assert!(searched.len() >= 2);
        assert_eq!(similar[0], "colours.inc");
    }

    #[test]
    fn a_standard_include_names_the_folders_that_are_not_there_too() {
        let place = Place::new(&["scene/main.scene"]);
        let main = place.path("scene/main.scene");
        let mut files = place.files(&[]);
        files.folders.truncate(1);
        let main = main.display().to_string();
        let searched = |name: &str| match files.read(name, &main) {
            Err(FileError::NotFound { searched, .. }) => searched.join(", "),
            other => panic!("{other:?}"),
        };
        let absent = WELL_KNOWN.iter().filter(|folder| !Path::new(folder).is_dir()).count();
        assert_eq!(searched("colors.inc").matches("(not there)").count(), absent);
        assert!(!searched("mine.inc").contains("(not there)"));
    }

    #[test]
    fn the_page_of_the_language_names_the_well_known_folders() {
        let page = include_str!("../../docs/language.md");
        for folder in WELL_KNOWN {
            assert!(page.contains(&format!("`{folder}`")), "{folder}");
        }
    }

    #[test]
    fn a_folder_is_no_file() {
        let place = Place::new(&["scene/parts/a.inc"]);
        let files = place.files(&[]);
        let wrong = place.read(&files, "parts");
        assert_eq!(wrong, Err(FileError::Unreadable("it is a folder".to_owned())));
    }
}
