//! Reports the old forms that have a rewriting, one by one.

use super::Legacy;
use crate::diagnostic::Fix;
use crate::source::Span;
use crate::syntax::ast::{
    Argument, Arguments, Ast, BinaryOperator, Callee, Expression, ExpressionKind, Item, ItemKind,
};
use crate::vocabulary::{Family, Word};

impl Legacy<'_> {
    /// Reports `red 1 green 0.5`, after `color` or alone. Returns how many items it takes.
    pub(super) fn components(&mut self, first: Span, items: &[Item]) -> usize {
        const ORDER: [Word; 5] = [Word::Red, Word::Green, Word::Blue, Word::Filter, Word::Transmit];
        let mut values: [Option<Span>; 5] = [None; 5];
        let mut used = 0;
        for pair in items.as_chunks::<2>().0 {
            let [Item { kind: ItemKind::Word(word), .. }, value] = pair else { break };
            let place = ORDER.iter().position(|component| component == word);
            let (Some(place), ItemKind::Expression(_)) = (place, value.kind) else { break };
            if values[place].replace(value.span).is_some() {
                break;
            }
            used += 2;
        }
        if used == 0 {
            return 0;
        }
        let whole = items[0].span.to(items[used - 1].span);
        let written = |place: usize| values[place].map_or("0", |span| self.text(span));
        let (name, places): (&str, &[usize]) = match (values[3], values[4]) {
            (None, None) => ("rgb", &[0, 1, 2]),
            (Some(_), None) => ("rgbf", &[0, 1, 2, 3]),
            (None, Some(_)) => ("rgbt", &[0, 1, 2, 4]),
            (Some(_), Some(_)) => ("rgbft", &[0, 1, 2, 3, 4]),
        };
        let parts: Vec<&str> = places.iter().map(|&place| written(place)).collect();
        let new = format!("{name} <{}>", parts.join(", "));
        let message = "a colour by the names of its components is an old form";
        self.tell_and_fix(first.to(items[used - 1].span), message, whole, new);
        used
    }

    /// Reports `[from, to color a color b]`.
    pub(super) fn entry(&mut self, span: Span, items: &[Item]) {
        let parts: Vec<&Item> = items.iter().filter(|item| item.kind != ItemKind::Comma).collect();
        let is_value = |item: &Item| matches!(item.kind, ItemKind::Expression(_));
        let [from, to, rest @ ..] = &parts[..] else { return };
        let Some(first) = rest.first().filter(|_| is_value(from) && is_value(to)) else { return };
        let starts = |item: &Item| match item.kind {
            ItemKind::Word(word) => word.family() == Family::Color && !is_component(word),
            _ => false,
        };
        // After a colour, components modify it: `[0.5 Red filter 0.3]`.
        let two_values = is_value(first) && rest.len() == 2 && is_value(rest[1]);
        if !starts(first) && !two_values {
            return;
        }
        let second = match first.kind {
            ItemKind::Word(Word::Color) => {
                rest.iter().skip(1).position(|item| item.kind == ItemKind::Word(Word::Color))
            }
            ItemKind::Word(_) => rest.get(2).filter(|item| starts(item)).map(|_| 1),
            _ => Some(0),
        };
        let message = "an entry with two values is an old form";
        let help = "write two entries, one for each value";
        self.tell(span, message, help);
        let (Some(second), false) = (second, self.has_comment(span)) else { return };
        let (one, other) = rest.split_at(second + 1);
        let text = |items: &[&Item]| match items {
            [first, .., last] => self.text(first.span.to(last.span)),
            [only] => self.text(only.span),
            [] => "",
        };
        let new = format!(
            "[{} {}] [{} {}]",
            self.text(from.span),
            text(one),
            self.text(to.span),
            text(other)
        );
        if let Some(last) = self.found.last_mut() {
            last.fixes.push(Fix { span, text: new });
        }
    }

    /// Reports a number, a vector or a colour that is declared without a `;`. `items` follow the `=`.
    pub(super) fn declaration(&mut self, items: &[Item]) {
        let is_color = |item: &&Item| {
            matches!(item.kind, ItemKind::Word(word)
                if word.family() == Family::Color && !is_component(word))
        };
        let words = items.iter().take_while(is_color).count();
        let mut used = words;
        if let Some(Item { kind: ItemKind::Expression(id), .. }) = items.get(used) {
            if words == 0 && !self.is_number(self.ast.expression(*id)) {
                return;
            }
            used += 1;
        }
        while let [
            Item { kind: ItemKind::Word(word), .. },
            Item { kind: ItemKind::Expression(_), .. },
            ..,
        ] = &items[used..]
            && is_component(*word)
        {
            used += 2;
        }
        let Some(last) = used.checked_sub(1).map(|last| items[last]) else { return };
        let ends = matches!(
            items.get(used).map(|next| next.kind),
            Some(ItemKind::Semicolon | ItemKind::Comma | ItemKind::Block(_) | ItemKind::Entry(_))
        );
        if ends || !matches!(last.kind, ItemKind::Expression(_)) {
            return;
        }
        self.tell(
            items[0].span.to(last.span),
            "a declaration without `;` is an old form",
            "write `;` behind a number, a vector or a colour",
        );
        if let Some(told) = self.found.last_mut() {
            told.fixes.push(Fix { span: last.span.after(), text: ";".to_owned() });
        }
    }

    /// Returns whether the expression is certainly a number or a vector, whatever its names are.
    fn is_number(&self, node: &Expression) -> bool {
        match node.kind {
            ExpressionKind::Number(_)
            | ExpressionKind::Word(_)
            | ExpressionKind::Unary(..)
            | ExpressionKind::Binary(..)
            | ExpressionKind::Component(..)
            | ExpressionKind::Vector(_)
            | ExpressionKind::Triple(_) => true,
            ExpressionKind::Call(Callee::Word(word, _), _) => {
                matches!(word.family(), Family::FloatFunction | Family::VectorFunction)
            }
            ExpressionKind::Group(_)
            | ExpressionKind::Call(Callee::Name(..) | Callee::Element(_), _)
            | ExpressionKind::String
            | ExpressionKind::Name(_)
            | ExpressionKind::Conditional(..)
            | ExpressionKind::Index(..)
            | ExpressionKind::GroupItems(_)
            | ExpressionKind::Joint
            | ExpressionKind::Missing => false,
        }
    }

    /// Reports `component strength, radius, <centre>` of a blob.
    pub(super) fn component(&mut self, span: Span, items: &[Item]) {
        let mut parts = items.iter().filter(|item| item.kind != ItemKind::Comma).take(3);
        let part = |item: Option<&Item>| match item {
            Some(item) if matches!(item.kind, ItemKind::Expression(_)) => Some(item.span),
            _ => None,
        };
        let message = "`component` is an old form";
        match (part(parts.next()), part(parts.next()), part(parts.next())) {
            (Some(strength), Some(radius), Some(centre)) => {
                let [strength_text, radius, centre_text] =
                    [strength, radius, centre].map(|part| self.text(part));
                let new = format!("sphere {{ {centre_text}, {radius}, {strength_text} }}");
                self.tell_and_fix(span, message, span.to(centre), new);
            }
            _ => self.tell(span, message, "write `sphere { <centre>, radius, strength }`"),
        }
    }

    /// Reports `reflection colour reflection_exponent n`. Returns how many items it takes, 1 for the current
    /// form.
    pub(super) fn reflection(&mut self, items: &[Item]) -> usize {
        let of_color = |item: &&Item| matches!(item.kind, ItemKind::Word(word) if word.family() == Family::Color);
        let words = items[1..].iter().take_while(of_color).count();
        let [
            Item { kind: ItemKind::Expression(_), span: color },
            Item { kind: ItemKind::Word(Word::ReflectionExponent), span },
            Item { kind: ItemKind::Expression(_), span: exponent },
            ..,
        ] = items[1 + words..]
        else {
            return 1;
        };
        let color = self.text(items[1].span.to(color));
        let new = format!("reflection {{ {color} exponent {} }}", self.text(exponent));
        let message = "`reflection_exponent` is an old form";
        self.tell_and_fix(span, message, items[0].span.to(exponent), new);
        words + 4
    }

    /// Returns whether the item is a switch value, such as `on`, `off` or `1`.
    pub(super) fn is_switch(&self, item: &Item) -> bool {
        match item.kind {
            ItemKind::Expression(id) => matches!(
                self.ast.expression(id).kind,
                ExpressionKind::Number(_)
                    | ExpressionKind::Word(
                        Word::On | Word::Off | Word::Yes | Word::No | Word::True | Word::False
                    )
            ),
            _ => false,
        }
    }

    /// `3 -10`, typed with a sign that touches the second number: returns the whole span, and the end of the
    /// first number.
    fn difference(&self, node: &Expression) -> Option<(Span, Span)> {
        let ExpressionKind::Binary(BinaryOperator::Subtract, first, second) = node.kind else {
            return None;
        };
        let [first, second] = [first, second].map(|id| self.ast.expression(id));
        let is_typed = |one: &Expression| is_literal(self.text(one.span));
        let between = Span { start: first.span.end, end: second.span.start, ..node.span };
        let touches =
            self.text(between).trim_start_matches([' ', '\t']) == "-" && self.text(between) != "-";
        (touches && is_typed(first) && is_typed(second)).then(|| (node.span, first.span.after()))
    }

    /// Reports `<1 2 3>`: components without commas.
    pub(super) fn vectors(&mut self) {
        let ast = self.ast;
        for node in &ast.expressions {
            let ExpressionKind::Vector(arguments) = node.kind else { continue };
            let spans: Vec<Span> = arguments_of(ast, arguments).map(|one| one.span).collect();
            let gaps = spans.windows(2).filter(|two| {
                let gap = Span { start: two[0].end, end: two[1].start, ..two[0] };
                !self.text(gap).contains(',')
            });
            let mut ends: Vec<Span> = gaps.map(|two| two[0].after()).collect();
            if ends.is_empty() {
                continue;
            }
            // `<0 3 -10>`: three numbers that are parsed as two give an unintended picture.
            let lost = arguments_of(ast, arguments).filter_map(|one| self.difference(one));
            let lost: Vec<(Span, Span)> = lost.collect();
            match lost[..] {
                [(whole, end)] if spans.len() == 2 => {
                    let message = format!(
                        "this vector without commas has two components: `{}` is one number",
                        self.text(whole)
                    );
                    self.tell(node.span, message, "write a comma between two components");
                    ends.push(end);
                    ends.sort_by_key(|end| end.start);
                }
                _ => {
                    let message = "a vector without commas is an old form";
                    self.tell(node.span, message, "write a comma between two components");
                }
            }
            if let Some(told) = self.found.last_mut() {
                let comma = |span| Fix { span, text: ",".to_owned() };
                told.fixes.extend(ends.into_iter().map(comma));
            }
        }
    }
}

/// Returns whether the text is a literal with an optional sign: `-1.5`.
fn is_literal(text: &str) -> bool {
    let digits = text.trim_start_matches(['-', '+', ' ']);
    digits.starts_with(|c: char| c.is_ascii_digit() || c == '.') && digits.parse::<f64>().is_ok()
}

/// Returns the expressions among arguments.
fn arguments_of(ast: &Ast, arguments: Arguments) -> impl Iterator<Item = &Expression> {
    ast.arguments(arguments).iter().filter_map(|one| match one {
        Argument::Expression(id) => Some(ast.expression(*id)),
        Argument::Items(_) => None,
    })
}

/// Returns whether the keyword is a component of a colour, and modifies the one before it.
fn is_component(word: Word) -> bool {
    matches!(
        word,
        Word::Red | Word::Green | Word::Blue | Word::Filter | Word::Transmit | Word::Alpha
    )
}
