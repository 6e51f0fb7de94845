//! Finds the items of a tree that contain a piece of the text.

use super::ast::{Ast, Body, Case, DirectiveKind, ItemKind, Items};
use crate::source::Span;

impl Ast {
    /// Returns the span from the first to the last of the fewest adjacent items that contain all of `piece`:
    /// items of the innermost block or branch around it.
    pub fn around(&self, piece: Span) -> Option<Span> {
        let (mut list, mut found) = (self.root, None);
        loop {
            let items = self.items(list);
            // The items are in source order.
            let first = items.partition_point(|item| item.span.end <= piece.start);
            let behind = items.partition_point(|item| item.span.start < piece.end);
            let held = items.get(first..behind)?;
            let (Some(a), Some(b)) = (held.first(), held.last()) else { return found };
            let span = a.span.to(b.span);
            if span.start > piece.start || span.end < piece.end {
                return found;
            }
            found = Some(span);
            let [only] = held else { return found };
            let inner = self.lists(only.kind).into_iter().find(|inner| {
                let items = self.items(*inner);
                let whole = items.first().zip(items.last()).map(|(a, b)| a.span.to(b.span));
                whole.is_some_and(|whole| whole.start <= piece.start && piece.end <= whole.end)
            });
            let Some(inner) = inner else { return found };
            list = inner;
        }
    }

    /// Returns the lists of items directly inside an item, one for each branch.
    fn lists(&self, item: ItemKind) -> Vec<Items> {
        let directive = match item {
            ItemKind::Block(items) | ItemKind::Entry(items) => return vec![items],
            ItemKind::Directive(id) => self.directive(id),
            ItemKind::Word(_)
            | ItemKind::Expression(_)
            | ItemKind::Open
            | ItemKind::Close
            | ItemKind::Comma
            | ItemKind::Semicolon
            | ItemKind::Numbers { .. } => return Vec::new(),
        };
        match &directive.kind {
            DirectiveKind::If { then, otherwise, .. } => vec![*then, *otherwise],
            DirectiveKind::While { body, .. }
            | DirectiveKind::For { body, .. }
            | DirectiveKind::Macro { body: Body::Items(body), .. }
            | DirectiveKind::Default(body) => vec![*body],
            DirectiveKind::Switch { lead, cases, .. } => {
                let cases = cases.iter().map(|Case { body, .. }| *body);
                std::iter::once(*lead).chain(cases).collect()
            }
            _ => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Diagnostics;
    use crate::source::{FileId, Source, Span};
    use crate::syntax::{ParseOptions, parse};

    #[test]
    fn the_fewest_items_around_a_piece_are_those_of_the_innermost_list() {
        let text = "a b { c #if (1) d e #else f #end g } #macro M() h i #end";
        let around = |piece: &str| {
            let source = Source::new("a.scene", text);
            let mut diagnostics = Diagnostics::new(false);
            let ast = parse(&source, FileId(0), &ParseOptions::default(), &mut diagnostics);
            let from = text.find(piece).expect(piece);
            let span = ast.around(Span::new(FileId(0), from, from + piece.len())).expect("in it");
            text[span.start as usize..span.end as usize].to_owned()
        };
        assert_eq!(around("d e"), "d e");
        assert_eq!(around("e #else f"), "#if (1) d e #else f #end");
        assert_eq!(around("h i"), "h i");
        assert_eq!(around("b { c"), "b { c #if (1) d e #else f #end g }");
    }
}
