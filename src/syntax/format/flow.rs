//! Breaks the atoms into lines.
//!
//! A block that the author wrote on one line stays on one, if it fits; any other has a line for each item
//! that began one, and its closer on its own. Between items the author's line breaks are kept. A line that is
//! too long is broken before an item, after a comma, or before an operator.
//! **Invariant:** one pass; formatting the result again changes nothing.

use super::atom::{Atom, Kind, Pair, columns};
use super::group::{Groups, NONE};
use super::rows::Row;
use crate::syntax::token::Head;

/// The most columns of a line, without its comment.
const WIDTH: usize = 100;
/// The indentation of one level.
const STEP: usize = 2;
/// Lines inside parentheses are aligned with the first token after the parenthesis, up to this column.
const DEEPEST: usize = 40;
/// The most consecutive empty lines.
const MOST_BLANK: usize = 2;

/// An open group.
struct Frame {
    opener: usize,
    /// All on one line.
    flat: bool,
    /// Too long for a line: each item has its own.
    split: bool,
    /// The indentation of a line that the closer begins.
    base: usize,
    /// The indentation of the lines inside.
    inside: usize,
    /// An entry on its opener's line, before its first word.
    in_entry: bool,
}

struct Flow<'a> {
    atoms: &'a [Atom<'a>],
    groups: &'a Groups,
    frames: Vec<Frame>,
    rows: Vec<Row>,
    row: Row,
    /// The start of the current line, and its end so far.
    indent: usize,
    column: usize,
    /// Closers whose group spans several lines.
    broken: Vec<bool>,
    /// In a row of items that is too long for a line: each has its own.
    parted: bool,
    /// The line end, also inside comments.
    end: &'static str,
}

/// Returns the lines of a text.
pub(super) fn rows(atoms: &[Atom], groups: &Groups, end: &'static str) -> Vec<Row> {
    let mut flow = Flow {
        atoms,
        groups,
        frames: Vec::new(),
        rows: Vec::new(),
        row: Row::default(),
        indent: 0,
        column: 0,
        broken: vec![false; atoms.len()],
        parted: false,
        end,
    };
    for at in 0..atoms.len() {
        flow.place(at);
    }
    if !atoms.is_empty() {
        flow.rows.push(flow.row);
    }
    flow.rows
}

impl Flow<'_> {
    fn kind(&self, at: usize) -> Kind {
        self.atoms[at].kind
    }

    fn place(&mut self, at: usize) {
        let atom = &self.atoms[at];
        let ends = at > 0 && self.ends_before(at);
        if ends {
            self.end_line(at);
        }
        if ends || at == 0 {
            let new_row = atom.lines > 0 && !self.groups.joins(self.atoms, at);
            self.parted = (self.parted && !new_row) || self.is_long_row(at);
        }
        if self.stays_aside(at) {
            self.row.code.truncate(self.row.code.trim_end().len());
            self.row.comment = Some((atom.text.clone().into_owned(), atom.column));
        } else {
            if at > 0 && !ends && super::space::between(&self.atoms[at - 1], atom) {
                self.put(" ");
            }
            match atom.kind == Kind::BlockComment && atom.is_tall() {
                true => self.put(&self.tall_comment(at)),
                false => self.put(&atom.text),
            }
        }
        if let (Kind::Word(_), Some(frame)) = (atom.kind, self.frames.last_mut())
            && frame.in_entry
        {
            // The content of an entry is aligned with its first word: `[0 0.5 color A`, and `color B`.
            (frame.inside, frame.in_entry) = (self.column - atom.width(), false);
        }
        if atom.kind.closes() {
            self.frames.pop();
        } else if atom.kind.opens() && self.groups.partner[at] != NONE {
            self.open(at);
        }
    }

    fn put(&mut self, text: &str) {
        self.row.code.push_str(text);
        let last = text.rsplit('\n').next().unwrap_or("");
        let columns = if last.is_ascii() { last.len() } else { last.chars().count() };
        self.column = if last.len() < text.len() { columns } else { self.column + columns };
    }

    /// Returns the text of a comment over several lines, shifted as a whole if it began its line.
    fn tall_comment(&self, at: usize) -> String {
        let atom = &self.atoms[at];
        let began = atom.lines > 0 || at == 0;
        let to = if began { self.indent } else { atom.column };
        shifted(&atom.text, atom.column, to).replace('\n', self.end)
    }

    /// Returns whether a comment follows code, or is below such a comment.
    fn stays_aside(&self, at: usize) -> bool {
        let atom = &self.atoms[at];
        if atom.kind != Kind::LineComment || at == 0 {
            return false;
        }
        let above = self.rows.last().and_then(|row| row.comment.as_ref());
        atom.lines == 0
            || (atom.lines == 1
                && self.row.code.trim_start().is_empty()
                && above.is_some_and(|(_, column)| *column == atom.column))
    }

    fn end_line(&mut self, at: usize) {
        self.rows.push(std::mem::take(&mut self.row));
        if let Some(frame) = self.frames.last_mut() {
            frame.in_entry = false;
        }
        let opens =
            |before: usize| self.kind(before).opens() || self.groups.head_of[before] != NONE;
        let closes = self.kind(at).closes() || self.kind(at).divides();
        if !opens(at - 1) && !closes {
            self.row.blank = self.atoms[at].lines.saturating_sub(1).min(MOST_BLANK);
        }
        self.indent = match self.kind(at) {
            Kind::Raw => 0,
            _ => self.indent_of(at),
        };
        self.column = self.indent;
        self.row.code = " ".repeat(self.indent);
    }

    fn indent_of(&self, at: usize) -> usize {
        let kind = self.kind(at);
        let Some(frame) = self.frames.last() else {
            return if self.groups.continues(self.atoms, at) { STEP } else { 0 };
        };
        let in_switch = self.kind(frame.opener) == Kind::Directive(Head::Switch);
        if kind.closes() {
            return frame.base;
        }
        if kind.divides() || (in_switch && self.ends_case(at)) {
            return frame.base + if in_switch { STEP } else { 0 };
        }
        let bonus = self.groups.lists(self.atoms, at) && self.groups.continues(self.atoms, at);
        frame.inside + if bonus { STEP } else { 0 }
    }

    /// Returns whether this is the `#break` at the end of a case.
    fn ends_case(&self, at: usize) -> bool {
        let mut next = self.atoms[at + 1..].iter().map(|atom| atom.kind);
        let next = next.find(|kind| !kind.is_comment());
        self.kind(at) == Kind::Directive(Head::Break)
            && next.is_none_or(|next| next.divides() || next.closes())
    }

    fn open(&mut self, at: usize) {
        let (kind, closer) = (self.kind(at), self.groups.partner[at]);
        let outer_flat = self.frames.last().is_some_and(|frame| frame.flat);
        let one_line = self.groups.in_one_line(at);
        let listing = matches!(kind, Kind::Open(Pair::Brace)) || kind.opens_directive();
        let flat = outer_flat || (one_line && (!listing || self.fits(at, self.column)));
        self.broken[closer] = listing && !flat;
        let inside = match kind {
            Kind::Directive(Head::Switch) => self.indent + 2 * STEP,
            _ if at == self.groups.guard => self.indent,
            _ if listing || self.groups.opens_a_line(self.atoms, at) => self.indent + STEP,
            _ if self.column <= DEEPEST => self.column,
            _ => self.indent + 2 * STEP,
        };
        self.frames.push(Frame {
            opener: at,
            flat: flat && (listing || outer_flat),
            split: listing && !flat && one_line,
            base: self.indent,
            inside,
            in_entry: kind == Kind::Open(Pair::Entry) && inside == self.column,
        });
    }

    /// Returns whether the group of this opener, which has been written and ends at `column`, fits on its
    /// line.
    fn fits(&self, opener: usize, column: usize) -> bool {
        if self.groups.stays_whole(opener) {
            return true;
        }
        let closer = self.groups.partner[opener];
        let mut last = closer;
        while last + 1 < self.atoms.len()
            && self.atoms[last + 1].lines == 0
            && !self.atoms[last + 1].kind.is_comment()
            && !self.groups.may_end(self.atoms, last + 1)
        {
            last += 1;
        }
        column + self.groups.width(opener, last) - self.atoms[opener].width() <= WIDTH
    }

    /// Returns whether this atom begins a line.
    fn ends_before(&self, at: usize) -> bool {
        let (left, right) = (self.kind(at - 1), self.kind(at));
        if left == Kind::LineComment {
            return true;
        }
        if self.frames.last().is_some_and(|frame| frame.flat) {
            return false;
        }
        let lines = self.atoms[at].lines;
        if right.is_comment() && lines == 0 {
            return false;
        }
        if lines > 0 && !self.groups.joins(self.atoms, at) {
            return true;
        }
        self.must_end(at) || (left == Kind::Stray) || self.should_end(at)
    }

    /// Returns whether a block or a directive over several lines requires a line break.
    fn must_end(&self, at: usize) -> bool {
        let right = self.kind(at);
        let Some(frame) = self.frames.last() else {
            return (self.parted && self.groups.begins(self.atoms, at))
                || self.follows_a_block(at)
                || self.is_broken_directive(at);
        };
        let of_directive = matches!(self.kind(frame.opener), Kind::Directive(_));
        let of_block = self.kind(frame.opener) == Kind::Open(Pair::Brace);
        if right.closes() || right.divides() {
            return match right {
                Kind::Close(Pair::Brace) => at - 1 != frame.opener,
                Kind::Close(_) => self.groups.opens_a_line(self.atoms, frame.opener),
                _ => true,
            };
        }
        let opened = of_block && at - 1 == frame.opener;
        let headed = of_directive && {
            let head = self.groups.head_of[at - 1];
            head == frame.opener || (head != NONE && self.kind(head).divides())
        };
        let in_switch = self.kind(frame.opener) == Kind::Directive(Head::Switch);
        if in_switch && self.ends_case(at) {
            return true;
        }
        let split = frame.split && self.groups.begins(self.atoms, at);
        opened
            || headed
            || split
            || (self.parted && self.groups.begins(self.atoms, at))
            || self.follows_a_block(at)
            || self.is_broken_directive(at)
    }

    /// Returns whether the author's row of items that begins here is too long for a line.
    fn is_long_row(&self, at: usize) -> bool {
        let of_row = |next: usize| {
            self.groups.parent[next] == self.groups.parent[at]
                && !self.kind(next).closes()
                && !self.kind(next).is_comment()
                && (self.atoms[next].lines == 0 || self.groups.joins(self.atoms, next))
        };
        if !self.groups.lists(self.atoms, at) || self.groups.stays_whole(at) {
            return false;
        }
        let mut next = at;
        while next < self.atoms.len() && (next == at || of_row(next)) {
            let closer = self.groups.partner[next];
            let opens = self.kind(next).opens() && closer != NONE;
            let ends_here = opens && !self.groups.in_one_line(next);
            let last = if opens && !ends_here { closer } else { next };
            if self.column + self.groups.width(at, last) > WIDTH {
                return true;
            }
            if ends_here {
                return false;
            }
            next = last + 1;
        }
        false
    }

    /// Returns whether this item follows a block or a directive over several lines.
    fn follows_a_block(&self, at: usize) -> bool {
        self.broken[at - 1]
            && self.groups.lists(self.atoms, at)
            && !matches!(
                self.kind(at),
                Kind::Comma
                    | Kind::Semicolon
                    | Kind::Operator
                    | Kind::Product
                    | Kind::Dot
                    | Kind::Open(Pair::Index)
            )
    }

    /// Returns whether this is a directive over several lines that may begin one.
    fn is_broken_directive(&self, at: usize) -> bool {
        let blank = 1;
        self.kind(at).opens_directive()
            && self.groups.begins(self.atoms, at)
            && !(self.groups.in_one_line(at)
                && self.fits(at, self.column + blank + self.atoms[at].width()))
    }

    /// Returns whether the line is too long for the atoms up to the next possible break.
    fn should_end(&self, at: usize) -> bool {
        let empty = self.row.code.trim_start().is_empty();
        if empty || self.groups.stays_whole(at) || !self.groups.may_end(self.atoms, at) {
            return false;
        }
        let mut last = at;
        let mut next = at;
        loop {
            // A group on one line is kept whole.
            let closer = self.groups.partner[next];
            if self.kind(next).opens() && closer != NONE {
                if !self.groups.in_one_line(next) {
                    break;
                }
                next = closer;
                last = closer;
            }
            next += 1;
            let Some(atom) = self.atoms.get(next) else { break };
            let ends = atom.lines > 0 && !self.groups.joins(self.atoms, next);
            if ends || atom.kind.is_comment() || self.groups.may_end(self.atoms, next) {
                break;
            }
            if atom.kind.closes() && !matches!(atom.kind, Kind::Close(pair) if pair != Pair::Brace)
            {
                break;
            }
            last = next;
        }
        let blank = usize::from(super::space::between(&self.atoms[at - 1], &self.atoms[at]));
        self.column + blank + self.groups.width(at, last) > WIDTH
    }
}

/// Returns the lines of a comment after its first, shifted from column `from` to `to`.
fn shifted(text: &str, from: usize, to: usize) -> String {
    let mut lines = text.split('\n');
    let mut moved = lines.next().unwrap_or("").to_owned();
    for line in lines {
        let rest = line.trim_start_matches([' ', '\t']);
        let column = columns(&line[..line.len() - rest.len()]);
        moved.push('\n');
        if !rest.is_empty() {
            moved.extend(std::iter::repeat_n(' ', (column + to).saturating_sub(from)));
            moved.push_str(rest);
        }
    }
    moved
}
