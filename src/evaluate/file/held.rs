//! Files that a `.pov` writes and may not: held in memory, where the scene reads them again.

use crate::source::{FileError, Found};

use super::super::Evaluator;

impl Evaluator<'_> {
    /// A file as the scene has it: what it wrote and may not write, or what is there.
    pub(in crate::evaluate) fn read_file(
        &self,
        name: &str,
        from: &str,
    ) -> Result<Found, FileError> {
        match self.held_files.get(name) {
            Some(bytes) => Ok(Found { name: name.to_owned(), bytes: bytes.clone() }),
            None => self.files.read(name, from),
        }
    }

    /// Begins a file that stays in memory.
    pub(super) fn hold_file(&mut self, name: &str, from: &str, append: bool) {
        if append && self.held_files.contains_key(name) {
            return;
        }
        let before = self.read_file(name, from).ok().filter(|_| append);
        let bytes = before.map_or_else(Vec::new, |found| found.bytes);
        self.stored += bytes.len() as u64;
        self.held_files.insert(name.to_owned(), bytes);
    }

    /// Adds to a file that is written, wherever it is kept.
    pub(super) fn add_to_file(&mut self, name: &str, bytes: &[u8]) {
        match self.held_files.get_mut(name) {
            Some(held) => held.extend(bytes),
            None => self.files.add(name, bytes),
        }
    }
}
