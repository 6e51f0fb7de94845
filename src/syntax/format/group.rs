//! Finds the partner of each bracket and directive, and the author's line breaks that are kept.
//!
//! **Invariant:** depends on the atoms and the author's line breaks only, never on widths.

use std::collections::BTreeSet;

use super::atom::{Atom, Kind, Pair};

use crate::syntax::token::Head;
use crate::vocabulary::{Family, Word};

/// No atom: the file itself.
pub(super) const NONE: usize = usize::MAX;

/// The structure of a text.
pub(super) struct Groups {
    /// The closer of an opener, the opener of a closer; for a directive, its `#end`.
    pub partner: Vec<usize>,
    /// The innermost opener around each atom; an opener, divider or closer is in the group around it.
    pub parent: Vec<usize>,
    /// For the last atom of the head of a directive that has a body, that directive or its divider.
    pub head_of: Vec<usize>,
    /// The `#ifndef` around the whole file, as in an include.
    pub guard: usize,
    /// The author's rows with a comment that allows a lint there: they are not broken.
    whole: BTreeSet<usize>,
    /// The start and end of each atom if all were on one line, and its row in the author's text.
    before: Vec<Place>,
    behind: Vec<Place>,
}

#[derive(Debug, Clone, Copy)]
struct Place {
    column: usize,
    row: usize,
}

impl Groups {
    pub fn of(atoms: &mut [Atom]) -> Self {
        let length = atoms.len();
        let mut groups = Self {
            partner: vec![NONE; length],
            parent: vec![NONE; length],
            head_of: vec![NONE; length],
            guard: NONE,
            whole: BTreeSet::new(),
            before: Vec::with_capacity(length),
            behind: Vec::with_capacity(length),
        };
        groups.pair(atoms);
        groups.heads(atoms);
        groups.guard = groups.guard(atoms);
        groups.measure(atoms);
        groups
    }

    fn pair(&mut self, atoms: &mut [Atom]) {
        let mut open: Vec<usize> = Vec::new();
        for at in 0..atoms.len() {
            let kind = atoms[at].kind;
            if kind.closes()
                && let Some(opener) = open.pop()
            {
                (self.partner[opener], self.partner[at]) = (at, opener);
                // A bracket is an index if either end says so.
                if kind == Kind::Close(Pair::Index) {
                    atoms[opener].kind = Kind::Open(Pair::Index);
                } else if atoms[opener].kind == Kind::Open(Pair::Index) {
                    atoms[at].kind = Kind::Close(Pair::Index);
                }
            }
            self.parent[at] = match kind.divides() {
                true => open.iter().rev().nth(1).copied().unwrap_or(NONE),
                false => open.last().copied().unwrap_or(NONE),
            };
            if kind.divides()
                && let Some(&opener) = open.last()
            {
                self.partner[at] = opener;
            }
            // `array[3][2]`: not entries either.
            let before = at.checked_sub(1).map(|before| atoms[before].kind);
            if kind == Kind::Open(Pair::Entry)
                && matches!(before, Some(Kind::Word(Word::Array) | Kind::Close(Pair::Index)))
            {
                atoms[at].kind = Kind::Open(Pair::Index);
            }
            if kind.opens() {
                open.push(at);
            }
        }
    }

    fn heads(&mut self, atoms: &[Atom]) {
        for (at, atom) in atoms.iter().enumerate() {
            if !atom.kind.opens_directive() && !atom.kind.divides() {
                continue;
            }
            let mut last = at;
            if atom.kind != Kind::Directive(Head::Else) {
                let round = (at + 1..atoms.len().min(at + 8))
                    .find(|&next| atoms[next].kind == Kind::Open(Pair::Round));
                last = round.map_or(at, |round| self.partner[round]);
            }
            if let Some(head) = self.head_of.get_mut(last) {
                *head = at;
            }
        }
    }

    fn guard(&self, atoms: &[Atom]) -> usize {
        let code = |atom: &Atom| !atom.kind.is_comment();
        let (first, last) = (atoms.iter().position(code), atoms.iter().rposition(code));
        match (first, last) {
            (Some(first), Some(last))
                if atoms[first].kind == Kind::Directive(Head::Ifndef)
                    && self.partner[first] == last =>
            {
                first
            }
            _ => NONE,
        }
    }

    fn measure(&mut self, atoms: &[Atom]) {
        let (mut width, mut row) = (0, 0);
        for (at, atom) in atoms.iter().enumerate() {
            let blank = at > 0 && super::space::between(&atoms[at - 1], atom);
            width += usize::from(blank);
            row += atom.lines;
            if atom.kind.is_comment() && atom.text.contains("lucarne:") {
                self.whole.insert(row);
            }
            self.before.push(Place { column: width, row });
            width += atom.width();
            row += usize::from(atom.is_tall());
            self.behind.push(Place { column: width, row });
        }
    }

    /// Returns the columns that the atoms from `first` to `last` take on one line.
    pub fn width(&self, first: usize, last: usize) -> usize {
        self.behind[last].column - self.before[first].column
    }

    /// Returns whether the author's row of this atom is not broken.
    pub fn stays_whole(&self, at: usize) -> bool {
        self.whole.contains(&self.before[at].row)
    }

    /// Returns whether the author wrote the group of this opener on one line.
    pub fn in_one_line(&self, opener: usize) -> bool {
        let closer = self.partner[opener];
        closer != NONE && self.before[closer].row == self.behind[opener].row
    }
}

/// Returns whether a keyword stays on the line of the one before.
fn continues_a_word(word: Word) -> bool {
    word.family() == Family::Color || matches!(word, Word::Albedo | Word::All | Word::Once)
}

/// Returns whether the keyword is a component of a colour: `red 1 green 0.5`.
fn is_component(word: Word) -> bool {
    matches!(word, Word::Red | Word::Green | Word::Blue | Word::Filter | Word::Transmit)
}

impl Groups {
    /// Returns whether the atoms here are a list of items: those of a block, a directive, or the file.
    pub fn lists(&self, atoms: &[Atom], at: usize) -> bool {
        match self.parent[at] {
            NONE => true,
            parent => {
                matches!(atoms[parent].kind, Kind::Open(Pair::Brace) | Kind::Directive(_))
            }
        }
    }

    /// Returns whether the author's line break before this atom is removed.
    pub fn joins(&self, atoms: &[Atom], at: usize) -> bool {
        use Kind as K;
        let Some(before) = at.checked_sub(1) else { return true };
        let (left, right) = (atoms[before].kind, atoms[at].kind);
        match (left, right) {
            (K::LineComment, _) => false,
            (_, K::Raw) | (K::Raw, _) => false,
            (_, K::LineComment | K::BlockComment) | (K::BlockComment, _) => false,
            (_, K::Comma | K::Semicolon | K::Dot | K::Open(Pair::Index)) => true,
            (K::Stray, _) => false,
            (K::Open(Pair::Index), _) => true,
            // Like its opener: both have a line break inside, or none.
            (_, K::Close(Pair::Round | Pair::Entry | Pair::Angle | Pair::Index)) => {
                !self.opens_a_line(atoms, self.partner[at])
            }
            (K::Dot | K::Sign | K::Callee, _) => true,
            (K::Assign, right) => !matches!(right, K::Directive(_)),
            (K::Directive(head), _) if !matches!(head, Head::Else | Head::End | Head::Break) => {
                true
            }
            (_, K::Open(Pair::Brace)) => {
                let is_head = self.head_of[before] != NONE
                    && atoms[self.head_of[before]].kind != K::Directive(Head::Default);
                !is_head
                    && matches!(
                        left,
                        K::Word(_)
                            | K::OwnWord
                            | K::Value
                            | K::Close(Pair::Round | Pair::Entry | Pair::Index)
                    )
            }
            (K::Word(Word::Function | Word::Array), _) => true,
            (
                K::Word(word),
                K::Value | K::Callee | K::Sign | K::Open(Pair::Round | Pair::Angle),
            ) => {
                matches!(word.family(), Family::Transform | Family::FinishItem | Family::Color)
            }
            (K::Word(word), K::Word(next)) => {
                matches!(word, Word::Color) && next.family() == Family::Color
            }
            _ => false,
        }
    }

    /// Returns whether the author began the opener's content on a line of its own.
    pub fn opens_a_line(&self, atoms: &[Atom], opener: usize) -> bool {
        let at = opener.wrapping_add(1);
        let Some(next) = atoms.get(at).filter(|next| !next.kind.closes()) else { return false };
        next.kind == Kind::LineComment || (next.lines > 0 && !self.joins(atoms, at))
    }

    /// Returns whether an item begins here, so that a line may.
    pub fn begins(&self, atoms: &[Atom], at: usize) -> bool {
        use Kind as K;
        let Some(before) = at.checked_sub(1) else { return true };
        if !self.lists(atoms, at) {
            return false;
        }
        let left = atoms[before].kind;
        if matches!(left, K::Assign | K::Operator | K::Product | K::Sign | K::Dot) {
            return false;
        }
        match atoms[at].kind {
            K::Word(word) => !continues_a_word(word),
            K::OwnWord => true,
            K::Directive(_) => true,
            K::Callee => {
                matches!(left, K::Close(_) | K::Semicolon | K::Value | K::Directive(Head::End))
            }
            K::Open(Pair::Entry) => !matches!(left, K::Word(_) | K::OwnWord),
            _ => false,
        }
    }

    /// Returns whether a line that begins here continues the line before.
    pub fn continues(&self, atoms: &[Atom], at: usize) -> bool {
        use Kind as K;
        let left = atoms[..at].iter().rev().map(|atom| atom.kind).find(|kind| !kind.is_comment());
        let right = atoms[at].kind;
        let unfinished = matches!(
            left,
            Some(K::Assign | K::Operator | K::Product | K::Sign | K::Dot | K::Callee)
        );
        let component = matches!(right, K::Word(word) if is_component(word))
            && matches!(left, Some(K::Value | K::Close(Pair::Round) | K::Word(_)));
        unfinished || component || matches!(right, K::Operator | K::Product | K::Dot)
    }

    /// Returns whether a line that would be too long may be broken before this atom.
    pub fn may_end(&self, atoms: &[Atom], at: usize) -> bool {
        let Some(before) = at.checked_sub(1) else { return false };
        let (left, right) = (atoms[before].kind, atoms[at].kind);
        let after_comma = left == Kind::Comma
            && !right.closes()
            && !matches!(right, Kind::Comma | Kind::Semicolon)
            && !right.is_comment();
        after_comma || right == Kind::Operator || self.begins(atoms, at)
    }
}
