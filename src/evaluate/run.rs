//! Fast paths that read from the text without a token: marks, and runs of numbers, which may be megabytes
//! long.

use crate::syntax::ast::{Item, ItemKind};

use super::Evaluator;

impl Evaluator<'_> {
    /// Takes the next item of the text if it is a comma or a semicolon, the only values of `mark`. Returns
    /// `false` if finding the next item may require running more.
    pub(super) fn pass(&mut self, mark: ItemKind) -> bool {
        if self.peeked.is_some() || self.halted || !self.has_memory(0) {
            return false;
        }
        let Some(frame) = self.frames.last_mut().filter(|frame| frame.at < frame.end) else {
            return false;
        };
        let Item { kind, span } = frame.here.unit.ast.items[frame.at as usize];
        if kind != mark {
            return false;
        }
        frame.at += 1;
        self.taken = Some(frame.here.site(span));
        true
    }

    /// Skips a run of numbers, if one comes next; it may be megabytes long.
    pub(super) fn skip_run(&mut self) {
        if self.peeked.is_none()
            && let Some(frame) = self.frames.last_mut()
            && frame.at < frame.end
            && let ItemKind::Numbers { .. } = frame.here.unit.ast.items[frame.at as usize].kind
        {
            (frame.at, frame.taken) = (frame.at + 1, 0);
        }
    }

    /// Moves up to `most` vectors of `width` numbers from the run of numbers that comes next, if any, to
    /// `entries`, padding each with zeros. A run may be megabytes long.
    pub(super) fn take_run(&mut self, width: usize, most: usize, entries: &mut Vec<[f64; 3]>) {
        if self.peeked.is_some() || self.halted {
            return;
        }
        let Some(frame) = self.frames.last_mut() else { return };
        if frame.at == frame.end {
            return;
        }
        let unit = frame.here.unit.clone();
        let Item { kind, span } = unit.ast.items[frame.at as usize];
        let ItemKind::Numbers { start, count, width: found } = kind else { return };
        if found as usize != width {
            return;
        }
        let taken = (count - frame.taken).min(most as u32);
        let first = start as usize + frame.taken as usize * width;
        let numbers = &unit.ast.numbers[first..first + taken as usize * width];
        entries.extend(numbers.chunks_exact(width).map(|numbers| {
            let mut entry = [0.0; 3];
            entry[..width].copy_from_slice(numbers);
            entry
        }));
        frame.taken += taken;
        if frame.taken == count {
            (frame.at, frame.taken) = (frame.at + 1, 0);
        }
        self.taken = Some(frame.here.site(span));
    }
}
