//! Diagnostics for a second colour or pattern: a pigment has one colour or one pattern.
//!
//! **Source:** POV-Ray 3.7 refuses each of these; only after a declared pigment may another colour or pattern
//! replace it (measured).

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{Site, Span};
use crate::syntax::ast::{Item, ItemKind};
use crate::vocabulary::Word;

use super::super::super::enclosure::Contents;
use super::super::super::stream::{Token, TokenKind};
use super::super::super::{Evaluator, Outcome, Reported};
use super::Written;

/// The first colour or pattern in a block.
#[derive(Debug, Clone, Copy)]
pub(super) struct First {
    /// A pattern; `None` for one colour.
    pattern: Option<Word>,
    site: Site,
    /// A second one has been reported: a third is the same mistake.
    told: bool,
}

impl Written {
    /// Records that the item begun by `token` was reported, so that it is unknown what it was meant as, and
    /// what conflicts with it.
    pub(super) fn mistaken(&mut self, token: &Token) {
        let site = token.here.site(token.span);
        self.first = Some(First { pattern: None, site, told: true });
    }
}

/// Returns the number of colours after a pattern that takes them without a map.
pub(in crate::evaluate::block) fn colors_of(pattern: Word) -> Option<usize> {
    Some(match pattern {
        Word::Checker | Word::Brick | Word::Object => 2,
        Word::Hexagon => 3,
        Word::Square => 4,
        Word::Cubic | Word::Triangular => 6,
        _ => return None,
    })
}

impl Evaluator<'_> {
    /// Checks that the `pattern` or colour from the item that `token` began is the pigment's first.
    pub(super) fn alone_in_pigment(
        &mut self,
        token: &Token,
        pattern: Option<Word>,
        written: &mut Written,
    ) -> Outcome<()> {
        let item = self.whole(token);
        match &mut written.first {
            // `magnet 1 mandel 50` is one pattern.
            Some(First { pattern: Some(Word::Magnet), .. })
                if matches!(pattern, Some(Word::Mandel | Word::Julia)) =>
            {
                Ok(())
            }
            None => {
                written.first = Some(First { pattern, site: item, told: false });
                Ok(())
            }
            Some(First { told: true, .. }) => Err(Reported),
            Some(first) => {
                first.told = true;
                let first = *first;
                Err(self.second_in_pigment(token, item, first, pattern, written))
            }
        }
    }

    /// Checks that a declared pigment precedes the colour or pattern that replaces it.
    pub(super) fn first_in_pigment(&mut self, token: &Token, written: &Written) -> Outcome<()> {
        let Some(first) = written.first else { return Ok(()) };
        let text = self.sources.text(token.span).to_owned();
        let diagnostic = Diagnostic::new(
            Code::ExtraPart,
            format!("the declared pigment `{text}` stands behind another"),
        )
        .at(token.span, "it would replace what stands before it")
        .also(first.site.span, "the pigment has this already")
        .help(format!("a declared pigment comes first: `pigment {{ {text} … }}`"));
        Err(self.report(&token.here, diagnostic))
    }

    /// Returns whether the next block begins with a colour, so that nothing remains of a pigment before it.
    pub(in crate::evaluate::block) fn begins_with_color(&mut self) -> bool {
        let Some(Token { kind: TokenKind::Block(Contents::Items(items)), here, .. }) = self.peek()
        else {
            return false;
        };
        let first = here.unit.ast.items(*items).first().map(|item| item.kind);
        matches!(first, Some(ItemKind::Word(Word::Color | Word::Rgb | Word::Srgb)))
    }

    /// Returns the site of the pigment written directly in the next block, that of the texture begun by
    /// `token`.
    pub(in crate::evaluate::block) fn pigment_within(&mut self, token: &Token) -> Option<Site> {
        let Some(Token { kind: TokenKind::Block(Contents::Items(items)), here, .. }) = self.peek()
        else {
            return None;
        };
        let is_pigment = |item: &&Item| item.kind == ItemKind::Word(Word::Pigment);
        let pigment = here.unit.ast.items(*items).iter().find(is_pigment)?;
        Some(token.here.site(pigment.span))
    }

    /// Returns whether the pigment whose keyword is at `site` is literally one opaque colour.
    pub(in crate::evaluate::block) fn is_opaque_as_written(&self, site: Site) -> bool {
        let text = &self.sources.get(site.span.file).text;
        let behind = text.get(site.span.end as usize..).unwrap_or("").trim_start();
        let paint = behind.strip_prefix('{').and_then(|rest| rest.split('}').next());
        let mut words = paint.unwrap_or("").split(|c: char| !c.is_ascii_alphabetic());
        let is_color = words.clone().any(|word| matches!(word, "rgb" | "srgb"));
        is_color && words.all(|word| matches!(word, "" | "rgb" | "srgb" | "color" | "colour"))
    }

    fn second_in_pigment(
        &mut self,
        token: &Token,
        item: Site,
        first: First,
        pattern: Option<Word>,
        written: &Written,
    ) -> Reported {
        let text = |site: Site| self.sources.text(site.span).to_owned();
        let (shown, before) = (text(item), text(first.site));
        let diagnostic = |message: String, label: &str| {
            Diagnostic::new(Code::ExtraPart, message)
                .at(item.span, label)
                .also(first.site.span, "the pigment has this already")
        };
        let diagnostic = match (first.pattern, pattern) {
            (Some(list), None) if colors_of(list).is_some() => {
                let (name, count) = (list.name(), colors_of(list).unwrap_or_default());
                let message = format!("`{name}` takes {count} colours, and here is one more");
                let told = diagnostic(message, "one colour too many").help("leave it out");
                self.gone_from(told, first.site, item)
            }
            (Some(of), None) if !written.is_map => {
                let name = of.name();
                let message = format!("the colours of `{name}` stand in a `color_map`");
                let told =
                    diagnostic(message, "a colour by itself has no meaning behind a pattern");
                return self.colors_meant(token, item, told);
            }
            (Some(_), None) => {
                let message = "a pigment is one pattern or one colour, and this is a colour more";
                let told = diagnostic(message.to_owned(), "a second one").help("leave it out");
                self.gone_from(told, item, item)
            }
            (None, None) => match self.comma_in_color(token, first.site, item) {
                Some(comma) => {
                    let name = self.sources.text(token.span);
                    let message = format!("no comma stands before `{name}`");
                    Diagnostic::new(Code::ExtraPart, message)
                        .at(comma, "this ends the colour")
                        .help("leave it out")
                        .fix(comma, "")
                }
                None => {
                    let message = "a pigment has one colour, and this is a second".to_owned();
                    let label = "expected a word of this block, or its end";
                    diagnostic(message, label).help(format!(
                        "leave one of the two out, or name a pattern: `checker {before}, {shown}`"
                    ))
                }
            },
            (None, Some(_)) => {
                let message = "a pigment is one colour or one pattern, and not both";
                let told = diagnostic(message.to_owned(), "a pattern behind a colour")
                    .help(format!("leave `{before}` out"));
                match self.side_by_side(first.site, item) {
                    true => told.fix(Span { end: item.span.start, ..first.site.span }, ""),
                    false => told,
                }
            }
            (Some(_), Some(other)) => {
                let (other, map) = (other.name(), "pigment_map { [0 …] [1 …] }");
                let message = format!("a pigment has one pattern, and `{other}` is a second");
                diagnostic(message, "expected a word of this block, or its end")
                    .help(format!("patterns lie in each other by a map: `gradient y {map}`"))
            }
        };
        self.report(&token.here, diagnostic)
    }

    /// Returns the comma before a component of a colour, if there is one: `rgb x, transmit 0.5`.
    fn comma_in_color(&self, token: &Token, first: Site, item: Site) -> Option<Span> {
        let is_component = matches!(
            token.kind,
            TokenKind::Word(Word::Filter | Word::Transmit | Word::Red | Word::Green | Word::Blue)
        );
        let between = Span { start: first.span.end, end: item.span.start, ..first.span };
        let comma = self.side_by_side(first, item).then(|| self.sources.text(between).find(','))?;
        let start = between.start + comma? as u32;
        is_component.then_some(Span { start, end: start + 1, ..between })
    }

    /// Returns whether only blanks and a comma separate two pieces of a text.
    fn side_by_side(&self, a: Site, b: Site) -> bool {
        let between = self.sources.between(a.span, b.span).map(str::trim);
        a.expansion == b.expansion && matches!(between, Some("" | ","))
    }

    /// Adds the fix that removes `item`, with the comma between it and `before`.
    fn gone_from(&self, told: Diagnostic, before: Site, item: Site) -> Diagnostic {
        match self.side_by_side(before, item) {
            true => told.fix(Span { start: before.span.end, ..item.span }, ""),
            false => told.fix(item.span, ""),
        }
    }

    /// Reports colours after a pattern that needs a map, takes the following ones too, and shows the map:
    /// `gradient y rgb 1, rgb x`.
    fn colors_meant(&mut self, token: &Token, item: Site, told: Diagnostic) -> Reported {
        let (mut colors, mut last) = (vec![self.sources.text(item.span).to_owned()], item);
        loop {
            self.skip_commas();
            let Some(next) = self.peek().cloned().filter(|_| self.at_color()) else { break };
            let before = self.told();
            let read = self.color_after(token, "a colour");
            self.take_back(before);
            let site = self.whole(&next);
            if read.is_err() || !self.side_by_side(last, site) {
                break;
            }
            colors.push(self.sources.text(site.span).to_owned());
            last = site;
        }
        let steps = colors.len() - 1;
        let entries: Vec<String> = colors
            .iter()
            .enumerate()
            .map(|(step, color)| match step {
                0 => format!("[0 {color}]"),
                _ if step == steps => format!("[1 {color}]"),
                _ => format!("[{step}/{steps} {color}]"),
            })
            .collect();
        let diagnostic = match steps {
            0 => told.help(format!("write `color_map {{ [0 rgb 0] [1 {}] }}`", colors[0])),
            _ => {
                let map = format!("color_map {{ {} }}", entries.join(" "));
                told.help(format!("write `{map}`")).fix(item.span.to(last.span), map)
            }
        };
        self.report(&token.here, diagnostic)
    }
}
