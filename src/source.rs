//! Texts of scenes, locations in them, and access to files.
//!
//! **Invariant:** a [`Source`] never changes after reading; every [`Span`] indexes into one.

mod encoding;

use std::collections::BTreeMap;
use std::fmt;

pub use encoding::{UTF_16, decode, is_utf_16, to_latin};

/// Identifies one [`Source`] in [`Sources`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FileId(pub u32);

/// Range of bytes in one source; the end is exclusive. Bounds are always on character boundaries.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Span {
    /// The source.
    pub file: FileId,
    /// Offset of the first byte.
    pub start: u32,
    /// Offset after the last byte.
    pub end: u32,
}

impl fmt::Debug for Span {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}..{}", self.file.0, self.start, self.end)
    }
}

impl Span {
    /// Returns a span of these offsets.
    pub fn new(file: FileId, start: usize, end: usize) -> Self {
        Self { file, start: start as u32, end: end as u32 }
    }

    /// Returns the span from the start of `self` to the end of `other`, in the same file.
    pub fn to(self, other: Self) -> Self {
        Self { end: other.end.max(self.end), ..self }
    }

    /// Whether all of `other` lies in this span.
    pub fn contains(self, other: Self) -> bool {
        self.file == other.file && self.start <= other.start && other.end <= self.end
    }

    /// Returns the empty span directly after this one.
    pub fn after(self) -> Self {
        Self { start: self.end, ..self }
    }

    /// Returns its offsets.
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// A location in a text, and the expansions that led there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Site {
    /// The location.
    pub span: Span,
    /// The macro call or include that was evaluated there.
    pub expansion: ExpansionId,
}

/// Identifies one [`Expansion`]; [`ExpansionId::MAIN`] is the text of the main file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ExpansionId(pub u32);

impl ExpansionId {
    /// The main file itself.
    pub const MAIN: Self = Self(0);
}

/// The reason why a text is evaluated: a macro call or an include.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expansion {
    /// The expansion that contains the call.
    pub parent: ExpansionId,
    /// Span of the call.
    pub call: Span,
    /// Whether it is a macro call or an include.
    pub kind: ExpansionKind,
    name: ExpansionName,
}

/// Kind of an [`Expansion`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExpansionKind {
    /// A macro call.
    Macro,
    /// An `#include` of a file.
    Include,
}

/// Index into the names in [`Expansions`], which are unique.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExpansionName(u32);

/// All expansions of one evaluation, parents before children. Entry `n` has the id `n + 1`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Expansions {
    list: Vec<Expansion>,
    names: Vec<String>,
    by_name: BTreeMap<String, ExpansionName>,
}

impl Expansions {
    /// Returns the index of the name of a macro or file, for passing it to [`Self::add`].
    pub fn named(&mut self, name: &str) -> ExpansionName {
        if let Some(&known) = self.by_name.get(name) {
            return known;
        }
        let new = ExpansionName(self.names.len() as u32);
        self.names.push(name.to_owned());
        self.by_name.insert(name.to_owned(), new);
        new
    }

    /// Adds a call of the macro, or an include of the file, with this name.
    pub fn add(
        &mut self,
        parent: ExpansionId,
        call: Span,
        kind: ExpansionKind,
        name: ExpansionName,
    ) -> ExpansionId {
        self.list.push(Expansion { parent, call, kind, name });
        self.newest()
    }

    /// Returns the most recent expansion, or [`ExpansionId::MAIN`] if there is none.
    pub(crate) fn newest(&self) -> ExpansionId {
        ExpansionId(self.list.len() as u32)
    }

    /// Returns the expansion, or `None` for [`ExpansionId::MAIN`].
    pub fn get(&self, id: ExpansionId) -> Option<&Expansion> {
        self.list.get((id.0 as usize).checked_sub(1)?)
    }

    /// Returns the name of the macro or file.
    pub fn name(&self, expansion: &Expansion) -> &str {
        &self.names[expansion.name.0 as usize]
    }

    /// Maps two locations to the innermost text that contains both, in its order. A location inside a macro
    /// becomes the macro's call.
    pub(crate) fn side_by_side(&self, mut a: Site, mut b: Site) -> [Site; 2] {
        // Parents have the smaller ids, and the main file the smallest.
        while a.expansion != b.expansion {
            let inner = if a.expansion > b.expansion { &mut a } else { &mut b };
            let Some(Expansion { parent, call, .. }) = self.get(inner.expansion) else { break };
            *inner = Site { span: *call, expansion: *parent };
        }
        if a.span.start <= b.span.start { [a, b] } else { [b, a] }
    }

    /// Returns the calls that led to `id`, innermost first.
    pub fn chain(&self, id: ExpansionId) -> impl Iterator<Item = &Expansion> {
        std::iter::successors(self.get(id), |expansion| self.get(expansion.parent))
    }
}

/// The text of one file.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// Name of the file as given or as included.
    pub name: String,
    /// Its contents.
    pub text: String,
    /// The file was not UTF-8: each character is one byte of it.
    pub is_latin: bool,
    line_starts: Vec<u32>,
    /// Number of characters that start before each block of [`BLOCK`] bytes: lines may be long.
    blocks: Vec<u32>,
}

const BLOCK: usize = 1024;

/// Returns the number of characters that start in these bytes.
fn characters(bytes: &[u8]) -> usize {
    bytes.iter().filter(|byte| !matches!(byte, 0x80..=0xbf)).count()
}

/// Line and column, both counted from 1; columns are in characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// From 1.
    pub line: usize,
    /// From 1, in characters.
    pub column: usize,
}

impl Source {
    /// Returns a source of this name and text.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        let text = text.into();
        let mut line_starts = vec![0];
        line_starts.extend(text.match_indices('\n').map(|(at, _)| at as u32 + 1));
        // A lone carriage return ends a line too (old Macintosh files).
        let lone = text.match_indices('\r').filter(|(at, _)| !text[at + 1..].starts_with('\n'));
        line_starts.extend(lone.map(|(at, _)| at as u32 + 1));
        line_starts.sort_unstable();
        let blocks = text.as_bytes().chunks(BLOCK).scan(0, |before, block| {
            let start = *before;
            *before += characters(block) as u32;
            Some(start)
        });
        Self { name: name.into(), line_starts, blocks: blocks.collect(), text, is_latin: false }
    }

    /// As [`Self::new`], of what [`decode`] gave.
    pub(crate) fn decoded(name: impl Into<String>, (text, is_latin): (String, bool)) -> Self {
        Self { is_latin, ..Self::new(name, text) }
    }

    /// Returns the position of a byte.
    pub fn position(&self, offset: usize) -> Position {
        let line = self.line_starts.partition_point(|&start| start as usize <= offset) - 1;
        let start = self.line_starts[line] as usize;
        let column = self.characters_before(offset) - self.characters_before(start) + 1;
        Position { line: line + 1, column }
    }

    fn characters_before(&self, offset: usize) -> usize {
        let offset = offset.min(self.text.len());
        // The end of the text may be the end of a block.
        let block = (offset / BLOCK).min(self.blocks.len().saturating_sub(1));
        let before = self.blocks.get(block).map_or(0, |&before| before as usize);
        before + characters(&self.text.as_bytes()[block * BLOCK..offset])
    }

    /// Returns the text of line `number` (from 1), without its line break.
    pub fn line(&self, number: usize) -> &str {
        let start = self.line_starts[number - 1] as usize;
        let end = self.line_starts.get(number).map_or(self.text.len(), |&end| end as usize);
        self.text[start..end].trim_end_matches(['\n', '\r'])
    }

    /// Returns the byte offset of the start of line `number` (from 1).
    pub fn line_start(&self, number: usize) -> usize {
        self.line_starts[number - 1] as usize
    }

    /// Returns the number of lines.
    pub fn line_count(&self) -> usize {
        self.line_starts.len()
    }
}

/// All texts of one run, in the order in which they were read.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sources(Vec<Source>);

impl Sources {
    /// Adds a source and returns its id.
    pub fn add(&mut self, source: Source) -> FileId {
        self.0.push(source);
        FileId(self.0.len() as u32 - 1)
    }

    /// Returns the source with this id.
    pub fn get(&self, id: FileId) -> &Source {
        &self.0[id.0 as usize]
    }

    /// Returns the text of a span.
    pub fn text(&self, span: Span) -> &str {
        // Returns nothing for a span that combines locations in different files.
        self.get(span.file).text.get(span.range()).unwrap_or("")
    }

    /// Returns the text between two locations in one file, if the first precedes the second.
    pub(crate) fn between(&self, first: Span, second: Span) -> Option<&str> {
        let gap = Span { start: first.end, end: second.start, ..first };
        let in_order = first.file == second.file && gap.start <= gap.end;
        in_order.then(|| self.text(gap))
    }

    /// Returns the name, number or sign directly before a location after which something is missing, or the
    /// location itself if there is none.
    pub(crate) fn sign_before(&self, place: Span) -> Span {
        let before = self.get(place.file).text.get(..place.start as usize).unwrap_or("");
        let Some(last) = before.chars().next_back().filter(|last| !last.is_whitespace()) else {
            return place;
        };
        let of_word = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
        let length = match before.len() - before.trim_end_matches(of_word).len() {
            0 => last.len_utf8(),
            word => word,
        };
        Span { start: place.start - length as u32, end: place.start, ..place }
    }

    /// Returns the start of a span as `file:line:column`.
    pub fn place(&self, span: Span) -> String {
        let source = self.get(span.file);
        let Position { line, column } = source.position(span.start as usize);
        format!("{}:{line}:{column}", source.name)
    }

    /// Returns all sources with their ids.
    pub fn iter(&self) -> impl Iterator<Item = (FileId, &Source)> {
        self.0.iter().enumerate().map(|(i, source)| (FileId(i as u32), source))
    }
}

/// A file that [`Files`] found.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// Path of the file, which also identifies it: the same file has the same name.
    pub name: String,
    /// Its contents.
    pub bytes: Vec<u8>,
}

/// Reason why a file cannot be read.
#[derive(Debug, Clone, PartialEq)]
pub enum FileError {
    /// No such file.
    NotFound {
        /// The searched folders.
        searched: Vec<String>,
        /// Similar names that are found there.
        similar: Vec<String>,
    },
    /// The file lies outside the folders to which reading is restricted.
    Forbidden,
    /// The file exists, but cannot be read, for the given system error.
    Unreadable(String),
}

/// Reason why a scene may not write a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum WriteError {
    /// The scene has no permission to write.
    NotAllowed,
    /// The file, or the target of a link, lies outside the current folder.
    Outside,
    /// The file cannot be created, for the given reason.
    Impossible(String),
}

/// Access to files: the only source of external data, and the only destination for files that a scene
/// writes.
pub trait Files {
    /// Looks for `name` in the folder of the file `from`, then in the include folders. Also finds files
    /// that the scene has written.
    fn read(&self, name: &str, from: &str) -> Result<Found, FileError>;

    /// Starts writing the file `name`, which is empty or (`append`) has its previous contents. Returns the
    /// name under which the file is found from now on.
    ///
    /// Does not write to disk; the implementor does that once the scene has proved free of errors.
    ///
    /// # Errors
    ///
    /// See [`WriteError`]. The default implementation does not allow writing.
    fn start(&self, _name: &str, _append: bool) -> Result<String, WriteError> {
        Err(WriteError::NotAllowed)
    }

    /// Appends to a started file, given the name returned by [`Self::start`].
    fn add(&self, _name: &str, _bytes: &[u8]) {}
}

/// Returns the last component of a path as written in scenes, on any system: the part after `/`, `\` or the
/// `:` of a drive.
pub fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\', ':']).next().unwrap_or(path)
}

/// Finds files by a function that returns the bytes of a name, if it knows it.
///
/// ```
/// use lucarne::{RenderOptions, render};
///
/// let files = |name: &str| (name == "radius.inc").then(|| b"#declare Radius = 2;".to_vec());
/// let text = "#include \"radius.inc\" sphere { 0, Radius pigment { rgb 1 } } camera { location 9*z look_at 0 }
///     light_source { 9, rgb 1 }";
/// render(text, &RenderOptions { files: &files, ..RenderOptions::of_size(8, 6) })?;
/// # Ok::<(), lucarne::Messages>(())
/// ```
impl<F: Fn(&str) -> Option<Vec<u8>>> Files for F {
    fn read(&self, name: &str, _: &str) -> Result<Found, FileError> {
        let found = self(name).map(|bytes| Found { name: name.to_owned(), bytes });
        found.ok_or_else(|| FileError::NotFound { searched: Vec::new(), similar: Vec::new() })
    }
}

/// Provides no files, for texts that stand alone.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoFiles;

impl Files for NoFiles {
    fn read(&self, _: &str, _: &str) -> Result<Found, FileError> {
        Err(FileError::NotFound { searched: Vec::new(), similar: Vec::new() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_lines_and_characters_from_one() {
        let source = Source::new("a", "é x\r\nb\rc\n");
        assert_eq!(source.position(3), Position { line: 1, column: 3 });
        assert_eq!(source.position(6), Position { line: 2, column: 1 });
        assert_eq!(source.position(8), Position { line: 3, column: 1 });
        assert_eq!(source.position(10), Position { line: 4, column: 1 });
        assert_eq!((source.line(1), source.line(2), source.line(3)), ("é x", "b", "c"));
    }

    #[test]
    fn columns_of_a_long_line_count_its_characters() {
        let source = Source::new("a", format!("\n{}x", "aé".repeat(3_000)));
        for (offset, _) in source.text.char_indices().chain([(source.text.len(), ' ')]).skip(1) {
            let column = source.text[1..offset].chars().count() + 1;
            assert_eq!(source.position(offset), Position { line: 2, column });
        }
        assert_eq!(Source::new("a", "").position(0), Position { line: 1, column: 1 });
        assert_eq!(Source::new("a", "b".repeat(1024)).position(1024).column, 1025);
    }
}
