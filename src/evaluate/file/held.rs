//! Files that a `.pov` writes without permission: held in memory, from where the scene can read them.

use std::path::{Component, Path};

use crate::source::{FileError, Found};

use super::super::Evaluator;

impl Evaluator<'_> {
    /// Reads a file as the scene sees it: what it wrote without permission, or the file that exists.
    pub(in crate::evaluate) fn read_file(
        &self,
        name: &str,
        from: &str,
    ) -> Result<Found, FileError> {
        match self.held_files.get(&plain(name)) {
            Some(bytes) => Ok(Found { name: name.to_owned(), bytes: bytes.clone() }),
            None => self.files.read(name, from),
        }
    }

    /// Starts a file that stays in memory.
    pub(super) fn hold_file(&mut self, name: &str, from: &str, append: bool) {
        if append && self.held_files.contains_key(&plain(name)) {
            return;
        }
        let before = self.read_file(name, from).ok().filter(|_| append);
        let bytes = before.map_or_else(Vec::new, |found| found.bytes);
        self.stored += bytes.len() as u64;
        self.held_files.insert(plain(name), bytes);
    }

    /// Appends to a file that is being written, wherever it is kept.
    pub(super) fn add_to_file(&mut self, name: &str, bytes: &[u8]) {
        match self.held_files.get_mut(&plain(name)) {
            Some(held) => held.extend(bytes),
            None => self.files.add(name, bytes),
        }
    }
}

/// Normalizes the paths to one file: without `.`, `..` after a folder, and `\`.
fn plain(name: &str) -> String {
    let slashed = name.replace('\\', "/");
    let mut parts: Vec<Component<'_>> = Vec::new();
    for part in Path::new(&slashed).components() {
        match (part, parts.last()) {
            (Component::CurDir, _) => {}
            (Component::ParentDir, Some(Component::Normal(_))) => {
                parts.pop();
            }
            _ => parts.push(part),
        }
    }
    let path: std::path::PathBuf = parts.into_iter().collect();
    path.to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::{Path, plain};

    #[test]
    fn one_file_has_one_name() {
        for name in ["a/b.txt", "./a/b.txt", "a\\b.txt", "a/c/../b.txt", "a//./b.txt"] {
            assert_eq!(plain(name), Path::new("a").join("b.txt").to_string_lossy(), "{name}");
        }
        assert_eq!(plain("../x"), Path::new("..").join("x").to_string_lossy());
    }
}
