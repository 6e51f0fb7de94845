//! Drops diagnostics of evaluation that repeat a fault reported by the parser.
//!
//! A bracket without its partner shifts what follows it: errors that evaluation then finds are consequences
//! of it, up to where the text is certainly parsed as its author meant it. Missing parts on the
//! line of any other fault are consequences too, except in the statements after the block with the fault.
//! **In:** a file's tree, and the diagnostics about it. **Out:** the diagnostics of independent mistakes.
//! **Invariant:** an unknown name is wrong anywhere, and its diagnostic is kept.

use std::ops::Range;

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{Sources, Span};
use crate::syntax::ast::{Ast, Body, DirectiveKind, Item, ItemKind, Items};
use crate::vocabulary::{Family, Role, Word};

/// After this many faults nothing is certain any more.
const MOST_FAULTS: usize = 100;

/// A syntax error.
struct Fault {
    code: Code,
    span: Span,
    line: usize,
    /// The range in which misplaced items may be its consequence.
    doubt: Range<u32>,
    /// After the `#end` before which it was closed: the items before the `}` that was its own.
    behind: Range<u32>,
    /// The offset from which its line contains other statements.
    others: u32,
}

/// Drops, from the diagnostics after the first `parsed`, the echoes of the first ones, which are about `ast`.
pub(super) fn drop_echoes(
    ast: &Ast,
    sources: &Sources,
    parsed: usize,
    diagnostics: &mut Diagnostics,
) {
    let statements = Statements::of(ast, sources);
    let line = |span: Span| sources.get(span.file).position(span.start as usize).line;
    let mut faults: Vec<Fault> = diagnostics
        .iter()
        .take(parsed)
        .filter(|fault| fault.is_error())
        .filter_map(|fault| Some((fault.code, fault.primary()?.span, behind_end(sources, fault))))
        .filter(|(_, span, _)| span.file == ast.file)
        .take(MOST_FAULTS)
        .map(|(code, span, behind)| {
            let doubt = statements.doubt(code, span);
            let others = statements.others(code, span);
            Fault { code, span, line: line(span), doubt, behind, others }
        })
        .collect();
    if let (MOST_FAULTS, Some(last)) = (faults.len(), faults.last_mut()) {
        last.doubt.end = u32::MAX;
    }
    if faults.is_empty() {
        return;
    }
    // Keywords that were declared as names: a part missing after one was not meant for the keyword.
    let declared: Vec<&str> = diagnostics
        .iter()
        .take(parsed)
        .filter(|fault| fault.code == Code::ReservedName)
        .filter_map(|fault| Some(sources.text(fault.primary()?.span)))
        .collect();
    let keep = |later: &Diagnostic| {
        if later.code == Code::MissingPart
            && later.labels.iter().any(|label| declared.contains(&sources.text(label.span)))
        {
            return false;
        }
        // A file that ends in the middle of a block may end in the middle of a word.
        let is_cut = |place: Span| {
            let rest = sources.get(place.file).text.get(place.range().end..).unwrap_or("");
            let unclosed = |fault: &Fault| fault.code == Code::UnclosedBlock;
            rest.trim().is_empty() && faults.iter().any(unclosed)
        };
        if !later.code.is_about_place() {
            let place = later.primary().map(|label| label.span);
            return later.code != Code::ForeignWord || !place.is_some_and(is_cut);
        }
        let Some(place) = later.primary().map(|label| label.span) else { return false };
        let rest = sources.get(place.file).text.get(place.range().end..).unwrap_or("");
        let is_name = later.code == Code::UnknownWord
            && Word::from_name(sources.text(place)).is_none()
            // A file that ends in the middle of a block may end in the middle of a word.
            && !rest.trim().is_empty();
        // The number of a vector's components does not depend on its surroundings.
        let in_vector = |span: Span| {
            let text = sources.text(span);
            text.starts_with('<') && text.ends_with('>')
        };
        let is_whole = later.code == Code::WrongArity
            && later.labels.iter().any(|label| in_vector(label.span));
        let is_block = is_name && rest.trim_start().starts_with('{');
        let (reach, on_line) = (reach(sources, place), line(place));
        !faults.iter().any(|fault| {
            let shifts = fault.code.shifts_what_follows();
            let beside = fault.span.file == place.file
                && fault.line == on_line
                && (place.start >= fault.span.start || fault.span.start <= reach);
            match shifts {
                _ if fault.span.file != place.file => false,
                true if is_name => fault.code == Code::UnclosedString && beside,
                true if is_whole => beside,
                true => {
                    let doubts = [&fault.doubt, &fault.behind];
                    beside || doubts.iter().any(|doubt| doubt.contains(&place.start))
                }
                false if is_block => false,
                false => beside && place.start < fault.others,
            }
        })
    };
    diagnostics.retain_after(parsed, keep);
}

/// `union { … #end pigment { … } }`: the range from the `#end` before which a block was closed, to the
/// block's own `}`.
fn behind_end(sources: &Sources, fault: &Diagnostic) -> Range<u32> {
    let of_block = fault.code == Code::UnclosedBlock;
    let ends =
        fault.labels.iter().find(|label| !label.primary && sources.text(label.span) == "#end");
    let Some(end) = ends.filter(|_| of_block).map(|label| label.span) else { return 0..0 };
    let rest = sources.get(end.file).text.get(end.end as usize..).unwrap_or("");
    let mut depth = 0;
    let own = rest.bytes().position(|byte| {
        depth += match byte {
            b'{' => 1,
            b'}' => -1,
            _ => 0,
        };
        depth < 0
    });
    own.map_or(0..0, |own| end.end..end.end + own as u32)
}

/// Returns the end of the block that begins at `at`, as far as its line shows it.
fn reach(sources: &Sources, at: Span) -> u32 {
    let text = &sources.get(at.file).text;
    let line = text.get(at.start as usize..).and_then(|rest| rest.lines().next());
    let (line, mut depth) = (line.unwrap_or(""), 0);
    let end = line.bytes().position(|byte| {
        depth += match byte {
            b'{' | b'(' | b'[' => 1,
            b'}' | b')' | b']' => -1,
            _ => return false,
        };
        depth <= 0
    });
    at.start + end.unwrap_or(line.len()) as u32
}

/// The items at the top level of a file, and in the bodies of its directives.
struct Statements<'a> {
    ast: &'a Ast,
    sources: &'a Sources,
    /// In source order, without the directives that have a body.
    items: Vec<Item>,
}

impl<'a> Statements<'a> {
    fn of(ast: &'a Ast, sources: &'a Sources) -> Self {
        let (mut items, mut lists) = (Vec::new(), vec![ast.root]);
        while let Some(list) = lists.pop() {
            for &item in ast.items(list) {
                let bodies = bodies(ast, item);
                if bodies.is_empty() {
                    items.push(item);
                }
                lists.extend(bodies);
            }
        }
        items.sort_unstable_by_key(|item| item.span.start);
        Self { ast, sources, items }
    }

    /// Returns the offset of the first word after `fault` that begins an item.
    fn word_after(&self, fault: Span) -> Option<u32> {
        let text = &self.sources.get(fault.file).text;
        let behind = text.get(fault.range().end..)?;
        let mut at = 0;
        while let Some(start) = behind[at..].find(|c: char| c.is_ascii_alphabetic() || c == '_') {
            let begin = at + start;
            let length = behind[begin..].find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            at = length.map_or(behind.len(), |length| begin + length);
            let word = Word::from_name(&behind[begin..at]);
            if word.is_some_and(|word| word.role() == Role::Statement) {
                return Some(fault.end + begin as u32);
            }
        }
        None
    }

    /// Returns the range from a fault, or from before it, to where the text is certainly parsed as meant.
    fn doubt(&self, code: Code, fault: Span) -> Range<u32> {
        let nowhere = fault.start..fault.start;
        match code {
            Code::NestingLimit | Code::UnclosedComment => fault.start..u32::MAX,
            _ if !code.shifts_what_follows() => nowhere,
            _ if matches!(self.sources.text(fault), "<" | ">" | "(" | ")" | "[" | "]")
                && let Some(end) = self.block_around(fault) =>
            {
                // No vector contains a word that begins an item: the vector ends before it.
                let left = self.word_after(fault).filter(|_| self.sources.text(fault) == "<");
                fault.start..left.map_or(end, |left| end.min(left + 1))
            }
            _ => self.start(code, fault)..self.certain_after(fault),
        }
    }

    /// Returns the offset from which statements are independent of a fault within a block.
    fn others(&self, code: Code, fault: Span) -> u32 {
        match self.block_around(fault) {
            Some(_) if !code.shifts_what_follows() => {
                self.certain_after(fault).min(self.statement_around(fault).unwrap_or(u32::MAX))
            }
            _ => u32::MAX,
        }
    }

    /// Returns the end of the innermost object, light or camera around `place`: in a union another may
    /// follow.
    fn statement_around(&self, place: Span) -> Option<u32> {
        let holds = |pair: &&[Item]| {
            let (ItemKind::Word(word), ItemKind::Block(_)) = (pair[0].kind, pair[1].kind) else {
                return false;
            };
            let block = pair[1].span;
            let is_whole = matches!(word.family(), Family::Shape | Family::Csg)
                || matches!(word, Word::Object | Word::LightSource | Word::Camera);
            is_whole && block.start < place.start && place.start < block.end
        };
        self.ast.items.windows(2).filter(holds).map(|pair| pair[1].span.end).min()
    }

    /// Returns the end of the innermost block around `place`.
    fn block_around(&self, place: Span) -> Option<u32> {
        let holds = |item: &&Item| {
            matches!(item.kind, ItemKind::Block(_))
                && item.span.start < place.start
                && place.start < item.span.end
        };
        self.ast.items.iter().filter(holds).map(|item| item.span.end).min()
    }

    /// Returns the start of the first statement that a fault does not affect.
    fn certain_after(&self, fault: Span) -> u32 {
        let behind = self.items.partition_point(|item| item.span.start <= fault.start);
        let touched = self.items[..behind].last().map_or(0, |item| item.span.end);
        let rest = &self.items[behind..];
        let begins = |at: &usize| {
            let item = rest[*at];
            item.span.start >= touched && begins_statement(item, rest.get(at + 1))
        };
        (0..rest.len()).find(begins).map_or(u32::MAX, |at| rest[at].span.start)
    }

    /// Returns the start of the affected range. Items right before an extra `}`, alone at the start of its
    /// line, and indented more than it, were meant for the block that it was to close.
    fn start(&self, code: Code, fault: Span) -> u32 {
        let alone = self.indent(fault.start).filter(|_| code == Code::StrayCloser);
        let Some(own) = alone else { return fault.start };
        let behind = self.items.partition_point(|item| item.span.start < fault.start);
        let inner = self.items[..behind]
            .iter()
            .rev()
            .take_while(|item| self.indent(item.span.start).is_none_or(|indent| indent > own));
        // A block belongs to the word before it, whatever its indentation.
        let begins = |item: &&Item| self.indent(item.span.start).is_some();
        inner.filter(begins).last().map_or(fault.start, |item| item.span.start)
    }

    /// Returns the indentation of a position that begins its line.
    fn indent(&self, place: u32) -> Option<usize> {
        let text = self.sources.get(self.ast.file).text.get(..place as usize)?;
        let line = text.rsplit(['\n', '\r']).next().unwrap_or(text);
        line.bytes().all(|byte| matches!(byte, b' ' | b'\t')).then_some(line.len())
    }
}

/// Returns whether an item begins a statement: a directive, or a keyword or an unknown name with its block.
/// Modifiers begin none.
fn begins_statement(item: Item, next: Option<&Item>) -> bool {
    let opens = next.is_some_and(|next| matches!(next.kind, ItemKind::Block(_)));
    match item.kind {
        ItemKind::Directive(_) => true,
        ItemKind::Word(word) => {
            let changes =
                matches!(word.family(), Family::Texture | Family::Modifier | Family::Transform);
            word.role() == Role::Statement && opens && !changes
        }
        ItemKind::Expression(_) => opens,
        _ => false,
    }
}

/// Returns the items between a directive's head and its `#end`.
fn bodies(ast: &Ast, item: Item) -> Vec<Items> {
    let ItemKind::Directive(id) = item.kind else { return Vec::new() };
    match &ast.directive(id).kind {
        DirectiveKind::If { then, otherwise, .. } => vec![*then, *otherwise],
        DirectiveKind::While { body, .. }
        | DirectiveKind::For { body, .. }
        | DirectiveKind::Macro { body: Body::Items(body), .. } => vec![*body],
        DirectiveKind::Switch { cases, .. } => cases.iter().map(|case| case.body).collect(),
        _ => Vec::new(),
    }
}
