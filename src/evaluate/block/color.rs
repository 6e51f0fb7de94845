//! Colours: `rgb <…>`, `srgb <…>`, `color Red filter 0.5`, `color red 1 green 0.5`.
//!
//! **Source:** POV-Ray manual, sections 3.3.1.7 "Specifying Colors" and 3.3.1.7.2 "sRGB Colors".

use crate::color::{Color, Rgb};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::{Dialect, Family, Role, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::Given;

impl Evaluator<'_> {
    /// Reads the colour that starts with `token`, a word of the colour family.
    pub(super) fn color_from(&mut self, token: &Token) -> Outcome<Color> {
        let TokenKind::Word(word) = token.kind else {
            return self.color_after(token, "a colour").map(|given| given.value);
        };
        let color = match word {
            Word::Color if self.lacks_color() => {
                return self.black_for_missing(token, "a colour").map(|black| black.value);
            }
            Word::Color => match self.peek().map(|next| &next.kind) {
                Some(TokenKind::Word(next)) if is_component(*next) => {
                    let first = self.peek().cloned();
                    let first = first.as_ref().unwrap_or(token);
                    return self.color_of_components(first, Color::BLACK);
                }
                Some(TokenKind::Word(next)) if next.family() == Family::Color => {
                    return match self.next() {
                        Some(next) => self.color_from(&next),
                        None => Ok(Color::BLACK),
                    };
                }
                _ => {
                    if let Some(reported) = self.unknown_part_of_color() {
                        return Err(reported);
                    }
                    let given = self.given(token, "a colour")?;
                    self.bare_components(Some(token), &given)?;
                    self.plain_color(&given, "a colour")?
                }
            },
            whole if is_whole(whole) => self.color_vector(token, whole)?,
            component if is_component(component) => {
                let mut color = Color::BLACK;
                self.color_component(token, component, &mut color)?;
                return self.color_of_components(token, color);
            }
            _ => return Err(self.word_not_built(token, word)),
        };
        self.color_components(color)
    }

    /// Reads a colour, with or without `color` and its variants.
    pub(super) fn color_after(&mut self, after: &Token, wanted: &str) -> Outcome<Given<Color>> {
        self.skip_commas();
        if self.lacks_color() {
            return self.black_for_missing(after, wanted);
        }
        if let Some(reported) = self.paint_for_color(after) {
            return Err(reported);
        }
        if let Some(Token { kind: TokenKind::Word(word), .. }) = self.peek()
            && word.family() == crate::vocabulary::Family::Color
            && let Some(token) = self.next()
        {
            let color = self.color_from(&token)?;
            return Ok(Given {
                value: color,
                span: token.span,
                here: token.here,
                expression: None,
            });
        }
        if let Some(reported) = self.misspelt_color(after) {
            return Err(reported);
        }
        let given = self.given(after, wanted)?;
        if !matches!(given.value, Value::Color(_)) {
            self.bare_components(None, &given)?;
        }
        let color = self.plain_color(&given, wanted)?;
        let color = self.color_components(color)?;
        Ok(given.with(color))
    }

    /// Returns whether a colour is missing in a `.pov`, where POV-Ray 3.7 substitutes black (measured).
    fn lacks_color(&mut self) -> bool {
        self.options.dialect == Dialect::Pov
            && match self.peek().map(|next| &next.kind) {
                None => true,
                Some(TokenKind::Word(word)) => {
                    word.role() == Role::Statement && word.family() != Family::Color
                }
                Some(_) => false,
            }
    }

    fn black_for_missing(&mut self, after: &Token, wanted: &str) -> Outcome<Given<Color>> {
        let span = self.taken.map_or(after.span, |taken| taken.span);
        let text = self.describe(after);
        let message = format!("expected {wanted} after {text}; it is black");
        let diagnostic = Diagnostic::new(Code::MissingPart, message)
            .at(span.after(), format!("{wanted} is missing here"));
        self.opinion(&after.here, diagnostic)?;
        Ok(Given { value: Color::BLACK, span, here: after.here.clone(), expression: None })
    }

    /// Converts a value without a keyword before it to a colour.
    pub(super) fn plain_color(&mut self, given: &Given<Value>, wanted: &str) -> Outcome<Color> {
        let Some(color) = given.value.as_color() else {
            return Err(self.wrong_type(&given.here, given.span, wanted, &given.value));
        };
        self.lint_color(given, color.rgb);
        Ok(color)
    }

    /// Reads `rgb`, `srgbft` and the like, with their components.
    fn color_vector(&mut self, token: &Token, word: Word) -> Outcome<Color> {
        let is_display = matches!(word, Word::Srgb | Word::Srgbf | Word::Srgbt | Word::Srgbft);
        let what = if is_display { "display values" } else { "a vector" };
        let given = self.given(token, what)?;
        if is_display && !self.says_gamma {
            self.srgb_before_gamma.get_or_insert(given.site());
        }
        let gamma = self.scene.settings.assumed_gamma;
        let meant = |rgb: Rgb| if is_display { rgb.map(|c| gamma.of_srgb(c)) } else { rgb };
        if !matches!(given.value, Value::Color(_)) {
            self.bare_components(Some(token), &given)?;
        }
        let Some(numbers) = given.value.numbers() else {
            return Err(self.wrong_type(&given.here, given.span, what, &given.value));
        };
        let wanted = components_of(word);
        self.lint_extra_components(token, word, wanted, &given);
        if numbers.len() == 3 && wanted > 3 {
            if let Some(reported) = self.number_behind_vector(token, &given) {
                return Err(reported);
            }
            let lacking = if takes_transmit(word) { "transmit" } else { "filter" };
            self.lint_short_color(&given, word, lacking);
        }
        let mut all = [0.0; 5];
        match *numbers.as_slice() {
            [gray] => all[..wanted].fill(gray),
            // Also more components than the word takes: `rgb Red` passes unchanged.
            ref written => all[..written.len()].copy_from_slice(written),
        }
        // The fourth is the transmit and a fifth is dropped, also for a colour, as in POV-Ray.
        if takes_transmit(word) {
            (all[3], all[4]) = (0.0, all[3]);
        }
        if numbers.len() == wanted && wanted == 4 {
            let clear = if takes_transmit(word) { Word::Transmit } else { Word::Filter };
            let last = self.last_component(given.span);
            last.into_iter().for_each(|last| self.lint_clear_percentage(&given.here, last, clear));
        }
        let [red, green, blue, filter, transmit] = all;
        let rgb = Rgb::new(red, green, blue);
        self.lint_color(&given, rgb);
        Ok(Color { rgb: meant(rgb), filter, transmit })
    }

    /// Returns the span of the last component of a vector literal.
    fn last_component(&self, vector: Span) -> Option<Span> {
        let inside = self.sources.text(vector).strip_suffix('>')?.trim_end();
        let last = inside.rsplit(',').next()?.trim_start();
        let end = vector.start + inside.len() as u32;
        Some(Span { start: end - last.len() as u32, end, ..vector })
    }

    /// Handles a fourth component after the vector: `rgbt <1, 1, 1> 0.5`.
    fn number_behind_vector(&mut self, token: &Token, given: &Given<Value>) -> Option<Reported> {
        let next = self.peek_on()?.clone();
        let between = self.sources.between(given.span, next.span)?;
        let number = self.sources.text(next.span);
        let vector = self.sources.text(given.span).strip_suffix('>')?;
        if !between.trim().is_empty() || !vector.starts_with('<') || number.parse::<f64>().is_err()
        {
            return None;
        }
        let right = format!("{vector}, {number}>");
        let told = Diagnostic::new(Code::WrongArity, "all numbers of a colour stand in its vector")
            .at(next.span, "expected before the `>`")
            .help(format!("write `{} {right}`", self.sources.text(token.span)))
            .fix(given.span.to(next.span), right);
        self.next();
        Some(self.report(&given.here, told))
    }

    /// Handles bare numbers instead of a vector, with or without a colour keyword: `rgb 1 0 0`, `1, 0, 0`. A
    /// single number is a grey.
    pub(super) fn bare_components(
        &mut self,
        token: Option<&Token>,
        given: &Given<Value>,
    ) -> Outcome<()> {
        let text = &self.sources.get(given.span.file).text;
        let Some((end, numbers)) = numbers_at(text, given.span) else { return Ok(()) };
        let goes_on = |next: &Token| next.span.file == given.span.file && next.span.start < end;
        if !self.peek_on().is_some_and(goes_on) {
            return Ok(());
        }
        let whole = Span { end, ..given.span };
        let of_255 = numbers.iter().take(3).any(|c| *c >= 16.0)
            && numbers.iter().all(|c| c.fract() == 0.0 && (0.0..=255.0).contains(c));
        let list: Vec<String> = numbers.iter().map(f64::to_string).collect();
        let word = match token.map(|token| &token.kind) {
            Some(TokenKind::Word(word)) if is_whole(*word) => word.name(),
            _ => "rgb",
        };
        let vector = format!("<{}>{}", list.join(", "), if of_255 { "/255" } else { "" });
        let ours = format!("{word} {vector}");
        // `color` takes a colour of any form.
        let (place, of_color) = match token {
            Some(token) if token.kind == TokenKind::Word(Word::Color) => (whole, true),
            Some(token) if token.span.file == whole.file => (token.span.to(whole), false),
            Some(_) => (whole, false),
            None => (whole, true),
        };
        let fix = if place == whole && !of_color { vector } else { ours.clone() };
        while self.peek().is_some_and(goes_on) {
            self.next();
        }
        let diagnostic = Diagnostic::new(
            Code::UnexpectedCharacter,
            "the numbers of a colour stand between `<` and `>`",
        )
        .at(whole, "expected a vector")
        .help(format!("write `{ours}`"))
        .fix(place, fix);
        Err(self.report(&given.here, diagnostic))
    }

    /// Reads what may follow a colour: `red 1`, `filter 0.5` …, each replacing one component.
    pub(super) fn color_components(&mut self, mut color: Color) -> Outcome<Color> {
        while let Some(Token { kind: TokenKind::Word(word), .. }) = self.peek_on() {
            let word = *word;
            if !is_component(word) {
                break;
            }
            if let Some(token) = self.next() {
                self.color_component(&token, word, &mut color)?;
            }
        }
        Ok(color)
    }

    /// Reads a colour that consists of named components only.
    fn color_of_components(&mut self, first: &Token, color: Color) -> Outcome<Color> {
        let color = self.color_components(color)?;
        self.lint_color_range(&first.here, first.span, color.rgb);
        Ok(color)
    }

    fn color_component(&mut self, token: &Token, word: Word, color: &mut Color) -> Outcome<()> {
        let has_number = matches!(
            self.peek().map(|next| &next.kind),
            Some(TokenKind::Expression(_) | TokenKind::Literal(_))
        );
        // `green , 0.5`
        let behind = self.sources.get(token.span.file).text.get(token.span.end as usize..);
        let behind = behind.and_then(|text| text.trim_start().strip_prefix(','));
        let goes_on =
            behind.is_some_and(|text| text.trim_start().starts_with(|c: char| c.is_ascii_digit()));
        if matches!(word, Word::Red | Word::Green | Word::Blue) && !has_number && !goes_on {
            let name = word.name();
            let diagnostic =
                Diagnostic::new(Code::MissingPart, format!("`{name}` is a part of a colour"))
                    .at(token.span, "its number is missing");
            let capital = format!("{}{}", name[..1].to_uppercase(), &name[1..]);
            let declared = self.scopes.symbol(&capital).and_then(|s| self.scopes.declared(s));
            let diagnostic = match declared.map(|declared| declared.site.span) {
                Some(span) => diagnostic
                    .also(span, format!("`{capital}` is declared here"))
                    .help(format!("did you mean `{capital}`?"))
                    .fix(token.span, capital),
                None => {
                    diagnostic.help(format!("write `{name} 1`, or all three as in `rgb <1, 0, 0>`"))
                }
            };
            return Err(self.report(&token.here, diagnostic));
        }
        match self.number_after(token, "a number") {
            Ok(number) => {
                if matches!(word, Word::Filter | Word::Transmit) {
                    self.lint_clear_percentage(&number.here, number.span, word);
                }
                match word {
                    Word::Red => color.rgb.red = number.value,
                    Word::Green => color.rgb.green = number.value,
                    Word::Blue => color.rgb.blue = number.value,
                    Word::Filter => color.filter = number.value,
                    _ => color.transmit = number.value,
                }
            }
            Err(reported) => {
                self.skip_color_components();
                return Err(reported);
            }
        }
        Ok(())
    }

    /// Skips the rest of a colour in which a component was reported.
    fn skip_color_components(&mut self) {
        while let Some(&Token { kind: TokenKind::Word(word), .. }) = self.peek_on()
            && is_component(word)
        {
            self.next();
            self.skip_values();
        }
    }

    /// Handles an unsupported word of the colour family: poison for the object being read.
    fn word_not_built(&mut self, token: &Token, word: Word) -> super::super::Reported {
        if let Some(today) = word.today() {
            return self.old_word(token, word, today);
        }
        let poison = super::super::value::Poison::new(word, token.here.site(token.span));
        self.skip_arguments(word);
        self.set_poison(poison);
        super::super::Reported
    }

    /// Returns whether the next item begins a colour.
    pub(super) fn at_color(&mut self) -> bool {
        match self.peek().map(|token| &token.kind) {
            Some(TokenKind::Word(word)) => word.family() == Family::Color,
            Some(TokenKind::Expression(_) | TokenKind::Literal(_)) => true,
            _ => false,
        }
    }
}

/// Returns whether a word takes all components at once.
fn is_whole(word: Word) -> bool {
    matches!(
        word,
        Word::Rgb
            | Word::Rgbf
            | Word::Rgbt
            | Word::Rgbft
            | Word::Srgb
            | Word::Srgbf
            | Word::Srgbt
            | Word::Srgbft
    )
}

/// Returns the number of components of a word that takes all at once.
fn components_of(word: Word) -> usize {
    match word {
        Word::Rgbf | Word::Rgbt | Word::Srgbf | Word::Srgbt => 4,
        Word::Rgbft | Word::Srgbft => 5,
        _ => 3,
    }
}

/// Returns whether the fourth component is the transmit.
pub(in crate::evaluate) fn takes_transmit(word: Word) -> bool {
    matches!(word, Word::Rgbt | Word::Srgbt)
}

/// Returns three to five adjacent literal numbers, the first at `first`, and where they end. Returns `None`
/// among the arguments of a call.
fn numbers_at(text: &str, first: Span) -> Option<(u32, Vec<f64>)> {
    let plain = |c: char| c.is_ascii_digit() || c == '.';
    let (mut numbers, mut at, mut end) = (Vec::new(), first.start as usize, 0);
    loop {
        let rest = text.get(at..)?;
        let digits = rest.len() - rest.trim_start_matches(plain).len();
        let Ok(number) = rest[..digits].parse::<f64>() else { break };
        // `1e3`, `0.5*x`, `1 + 2`: not plain numbers.
        let behind = &rest[digits..];
        if behind.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_')
            || behind.trim_start().starts_with(['*', '/', '+', '-'])
        {
            return None;
        }
        numbers.push(number);
        end = at + digits;
        let blank = behind.trim_start_matches([' ', '\t']);
        let next = match blank.strip_prefix(',') {
            Some(after) => after.trim_start_matches([' ', '\t']),
            None => blank,
        };
        at = text.len() - next.len();
    }
    let is_argument = text[end..].trim_start().starts_with([',', ')']);
    ((3..=5).contains(&numbers.len()) && end > first.end as usize && !is_argument)
        .then_some((end as u32, numbers))
}

fn is_component(word: Word) -> bool {
    matches!(word, Word::Red | Word::Green | Word::Blue | Word::Filter | Word::Transmit)
}
