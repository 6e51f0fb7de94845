//! Lints old forms of the language in the tree, with their current names and spellings.
//!
//! **In:** the tree of one file. **Out:** a `legacy-form` for each, with a fix where the rewriting is
//! certain. **Invariant:** a fix does not change the picture, except where a vector without commas has lost a
//! component, which is stated. Branches that are not run are searched, too.
//!
//! **Source:** POV-Ray 3.7 manual: 3.3.1.7 and 3.3.1.7.3 "Color Keywords" (components, `alpha`),
//! 3.3.2.2.1 "Declaring identifiers" (`;`), 3.4.1.4 "HF_Gray_16", 3.4.5.1.1 "Blob" (`component`),
//! 3.4.5.4.2 "Union" (`composite`), 3.4.6.1.2 "Color Map" (entries with two values), 3.4.6.3.5 "Specular
//! Reflection" (`reflection_exponent`), 3.4.6.5.2 "Tiles", 3.4.6.5.3 "Material Maps", 3.4.8.1 "Interior"
//! (what was in `finish`).

mod form;

use super::ast::{
    Argument, Ast, Body, DirectiveKind, Expression, ExpressionKind, Item, ItemKind, Items,
};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Fix};
use crate::source::{Source, Span};
use crate::vocabulary::{Family, Word};

/// Reports every old form in a file.
pub fn legacy(ast: &Ast, source: &Source, diagnostics: &mut Diagnostics) {
    let mut legacy = Legacy { ast, source, found: Vec::new(), lists: vec![(ast.root, None)] };
    while let Some((items, block)) = legacy.lists.pop() {
        legacy.list(items, block);
    }
    legacy.vectors();
    legacy.found.sort_by_key(|one| one.primary().map(|label| label.span.start));
    legacy.found.into_iter().for_each(|one| diagnostics.push(one));
}

struct Legacy<'a> {
    ast: &'a Ast,
    source: &'a Source,
    found: Vec<Diagnostic>,
    /// Lists that remain to be searched, and the keyword whose block each is in.
    lists: Vec<(Items, Option<Word>)>,
}

impl<'a> Legacy<'a> {
    fn text(&self, span: Span) -> &'a str {
        self.source.text.get(span.range()).unwrap_or("")
    }

    /// Returns whether a span contains a comment, which a replacement would lose.
    fn has_comment(&self, span: Span) -> bool {
        let comments = &self.ast.comments;
        let after = comments.partition_point(|comment| comment.start < span.start);
        comments.get(after).is_some_and(|comment| comment.start < span.end)
    }

    fn tell(&mut self, span: Span, message: impl Into<String>, help: impl Into<String>) {
        self.found.push(
            Diagnostic::new(Code::LegacyForm, message).at(span, "an old form").help(help.into()),
        );
    }

    /// As [`Self::tell`]; the new text replaces `whole`, if no comment would be lost.
    fn tell_and_fix(&mut self, span: Span, message: &str, whole: Span, new: String) {
        let shown =
            if new.is_empty() { "leave it out".to_owned() } else { format!("write `{new}`") };
        self.tell(span, message, shown);
        if !self.has_comment(whole)
            && let Some(last) = self.found.last_mut()
        {
            last.fixes.push(Fix { span: whole, text: new });
        }
    }

    fn list(&mut self, list: Items, block: Option<Word>) {
        let ast = self.ast;
        let items = ast.items(list);
        let mut at = 0;
        while let Some(item) = items.get(at) {
            let word_before = at.checked_sub(1).and_then(|before| word_of(&items[before]));
            let mut used = 1;
            match item.kind {
                ItemKind::Block(inner) => self.lists.push((inner, word_before)),
                ItemKind::Entry(inner) => {
                    if block == Some(Word::ColorMap) {
                        self.entry(item.span, ast.items(inner));
                    }
                    self.lists.push((inner, block));
                }
                ItemKind::Directive(id) => {
                    let kind = &ast.directive(id).kind;
                    self.bodies(kind, block);
                    if let DirectiveKind::Declare { .. } = kind {
                        self.declaration(&items[at + 1..]);
                    }
                }
                ItemKind::Word(word) => used = self.word(word, items, at, block),
                ItemKind::Expression(id) => self.groups(ast.expression(id)),
                ItemKind::Open
                | ItemKind::Close
                | ItemKind::Comma
                | ItemKind::Semicolon
                | ItemKind::Numbers { .. } => {}
            }
            at += used;
        }
    }

    /// Queues the items inside parentheses and among arguments.
    fn groups(&mut self, node: &Expression) {
        match node.kind {
            ExpressionKind::GroupItems(items) => self.lists.push((items, None)),
            ExpressionKind::Call(_, arguments) => {
                let lists = self.ast.arguments(arguments).iter().filter_map(|one| match one {
                    Argument::Items(items) => Some((*items, None)),
                    Argument::Expression(_) => None,
                });
                self.lists.extend(lists);
            }
            _ => {}
        }
    }

    fn bodies(&mut self, kind: &DirectiveKind, block: Option<Word>) {
        match kind {
            DirectiveKind::If { then, otherwise, .. } => {
                self.lists.extend([(*then, block), (*otherwise, block)]);
            }
            DirectiveKind::While { body, .. }
            | DirectiveKind::For { body, .. }
            | DirectiveKind::Macro { body: Body::Items(body), .. } => {
                self.lists.push((*body, block));
            }
            DirectiveKind::Switch { cases, .. } => {
                self.lists.extend(cases.iter().map(|case| (case.body, block)));
            }
            DirectiveKind::Default(items) => self.lists.push((*items, None)),
            DirectiveKind::Declare { .. }
            | DirectiveKind::Undef(_)
            | DirectiveKind::Break
            | DirectiveKind::Macro { body: Body::Raw(_), .. }
            | DirectiveKind::Include(_)
            | DirectiveKind::Version(_)
            | DirectiveKind::Debug(_)
            | DirectiveKind::Warning(_)
            | DirectiveKind::Error(_)
            | DirectiveKind::Fopen { .. }
            | DirectiveKind::Fclose { .. }
            | DirectiveKind::Read { .. }
            | DirectiveKind::Write { .. }
            | DirectiveKind::OldStream(_)
            | DirectiveKind::Unread
            | DirectiveKind::Malformed => {}
        }
    }

    /// Checks the keyword at `at` and the items after it. Returns how many items were consumed.
    fn word(&mut self, word: Word, list: &[Item], at: usize, block: Option<Word>) -> usize {
        let (items, span) = (&list[at..], list[at].span);
        let before = at.checked_sub(1).map(|before| list[before].kind);
        let of_color =
            |kind: ItemKind| matches!(kind, ItemKind::Word(word) if word.family() == Family::Color);
        match word {
            Word::Color if !before.is_some_and(of_color) => {
                return 1 + self.components(span, &items[1..]);
            }
            // After a colour they modify it: `rgb 1 red 0.5`.
            Word::Red | Word::Green | Word::Blue
                if !before.is_some_and(|kind| {
                    of_color(kind) || matches!(kind, ItemKind::Expression(_))
                }) =>
            {
                return self.components(span, items).max(1);
            }
            Word::Alpha => {
                let message = "`alpha` is an old word";
                self.tell_and_fix(span, message, span, "filter".to_owned());
            }
            Word::Composite => {
                let message = "`composite` is an old word";
                self.tell_and_fix(span, message, span, "union".to_owned());
            }
            Word::Component if block == Some(Word::Blob) => self.component(span, &items[1..]),
            Word::Tiles => {
                let help = "write `checker texture { … } texture { … }`";
                self.tell(span, "`tiles` is an old form", help);
            }
            Word::MaterialMap => {
                let help = "write `image_pattern { … } texture_map { … }`";
                self.tell(span, "`material_map` is an old form", help);
            }
            Word::HfGray16 => {
                let switch = items.get(1).filter(|next| self.is_switch(next));
                let whole = span.to(switch.map_or(span, |switch| switch.span));
                let message = "`hf_gray_16` has no effect since version 3.7";
                self.tell_and_fix(span, message, whole, String::new());
            }
            Word::Reflection => return self.reflection(items),
            Word::ReflectionExponent => {
                let help = "write `reflection { … exponent … }`";
                self.tell(span, "`reflection_exponent` is an old form", help);
            }
            Word::Ior
            | Word::Refraction
            | Word::Caustics
            | Word::FadePower
            | Word::FadeDistance
                if block == Some(Word::Finish) =>
            {
                let name = word.name();
                let help = match word {
                    Word::Refraction => "leave it out: an `ior` refracts".to_owned(),
                    _ => format!("write `interior {{ {name} … }}` beside the texture"),
                };
                self.tell(span, format!("`{name}` in a finish is an old form"), help);
            }
            _ => {}
        }
        1
    }
}

fn word_of(item: &Item) -> Option<Word> {
    match item.kind {
        ItemKind::Word(word) => Some(word),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
