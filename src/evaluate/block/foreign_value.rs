//! Recognition of values written as in other tools and countries: `0,5`, `"#ff0000"`, `opacity 0.5`.
//!
//! **In:** a position that already has a diagnostic. **Out:** the intended value, if the text shows it.

use crate::color::{self, Rgb};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::{Dialect, Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Reported};
use super::{Place, opens_value};

impl Evaluator<'_> {
    /// For the `5` of `0,5` at `span`, returns the whole span and the number with a decimal point.
    pub(super) fn comma_before(&self, span: Span) -> Option<(Span, String)> {
        let text = &self.sources.get(span.file).text;
        self.decimal(span, text.get(..span.start as usize)?)
    }

    /// Likewise for the `0` of `0,5` at `span`, or of `0, 5` if nothing else can be meant.
    pub(super) fn comma_after(&self, span: Span) -> Option<(Span, String)> {
        let text = &self.sources.get(span.file).text;
        let behind = text.get(span.end as usize..)?.strip_prefix(',')?;
        let after = behind.trim_start_matches(' ');
        let length = after.bytes().take_while(u8::is_ascii_digit).count() as u32;
        let start = span.end + 1 + (behind.len() - after.len()) as u32;
        let fraction = Span { start, end: start + length, ..span };
        self.decimal(fraction, text.get(..span.end as usize + 1)?)
            .filter(|(whole, _)| whole.start == span.start)
    }

    /// Returns the diagnostic for `0,5`, whose `0` is at `span`.
    pub(in crate::evaluate) fn decimal_comma(&self, span: Span) -> Option<Diagnostic> {
        let (whole, number) = self.comma_after(span)?;
        Some(told_comma(self.sources.text(whole), whole, number))
    }

    /// Handles `#declare R = 0,5;`: the name gets the intended number, so that no further error is reported
    /// for it.
    pub(super) fn declare_with_point(&mut self, number: Span, meant: &str) {
        let text = &self.sources.get(number.file).text;
        let before = text.get(..number.start as usize).unwrap_or("").trim_end();
        let Some(before) = before.strip_suffix('=').map(str::trim_end) else { return };
        let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let name = &before[before.trim_end_matches(is_name).len()..];
        if let (Some(symbol), Ok(meant)) = (self.scopes.symbol(name), meant.parse())
            && let Some(Value::Number(_)) = self.scopes.look(symbol)
        {
            self.scopes.assign(symbol, Value::Number(meant));
        }
    }

    /// Returns the number whose fraction is at `span`, after a comma that ends the text `before`.
    fn decimal(&self, span: Span, before: &str) -> Option<(Span, String)> {
        let fraction = digits(self.sources.text(span))?;
        let before = before.strip_suffix(',')?;
        let whole = &before[before.trim_end_matches(|c: char| c.is_ascii_digit()).len()..];
        let (whole, lone) = (digits(whole)?, before.strip_suffix(whole)?);
        let begins = !lone.ends_with(|c: char| c.is_ascii_alphanumeric() || "_.,".contains(c));
        let start = lone.len() as u32;
        begins.then(|| (Span { start, ..span }, format!("{whole}.{fraction}")))
    }

    /// Returns the vector of three that is meant if commas without a blank are decimal points: `<0,5, 1,5,
    /// 2>`.
    pub(in crate::evaluate) fn commas_within(&self, span: Span) -> Option<String> {
        let text = self.sources.text(span).strip_prefix('<')?.strip_suffix('>')?;
        let parts: Vec<&str> = text.split(", ").collect();
        let number = |part: &str| {
            let part = part.trim().replace(',', ".");
            part.parse::<f64>().is_ok().then_some(part)
        };
        let numbers: Option<Vec<String>> = parts.iter().map(|part| number(part)).collect();
        numbers.filter(|numbers| numbers.len() == 3).map(|n| format!("<{}>", n.join(", ")))
    }

    /// Returns the diagnostic for an axis and an angle, as other tools have it: `rotate z, A`.
    pub(super) fn angle_behind_axis(&self, token: &Token, value: &Value) -> Option<Diagnostic> {
        value.as_number()?;
        let text = &self.sources.get(token.span.file).text;
        let before = text.get(..token.span.start as usize)?.trim_end().strip_suffix(',')?;
        let statement = before.rfind("rotate")?;
        let axis = before[statement + "rotate".len()..].trim();
        let plain = |c: char| c.is_ascii_alphanumeric() || "_<>., -".contains(c);
        let is_word =
            before[..statement].ends_with(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        if axis.is_empty() || !is_word || !axis.chars().all(plain) || axis.contains("  ") {
            return None;
        }
        let angle = self.sources.text(token.span);
        let right = format!("rotate {angle}*{axis}");
        let (start, file) = (statement as u32, token.span.file);
        let whole = Span { file, start, end: token.span.end };
        let message = "`rotate` takes one vector: degrees about x, y and z";
        Some(
            Diagnostic::new(Code::ExtraPart, message)
                .at(token.span, "expected no number after the vector")
                .also(Span { end: start + 6, ..whole }, "an axis and an angle stand behind it")
                .help(format!("write `{right}`"))
                .fix(whole, right),
        )
    }

    /// Returns the diagnostic for a unit: `rotate 45 degrees`.
    pub(super) fn unit_of_angle(&self, token: &Token, word: Word) -> Option<Diagnostic> {
        let name = word.name();
        let text = &self.sources.get(token.span.file).text;
        let before = text.get(..token.span.start as usize)?.trim_end();
        if !before.ends_with(|c: char| c.is_ascii_alphanumeric() || ")>*".contains(c)) {
            return None;
        }
        let message = format!("`{name}` has no meaning behind a number");
        let diagnostic = Diagnostic::new(Code::ExtraPart, message)
            .at(token.span, "angles of the language are in degrees");
        Some(match word {
            Word::Degrees => diagnostic
                .help("leave it out: `rotate 45*y`")
                .fix(Span { start: before.len() as u32, ..token.span }, ""),
            _ => {
                diagnostic.help("write `degrees(…)` around the angle: it turns radians to degrees")
            }
        })
    }

    /// Returns the colour name that is meant by a component's keyword without a value: `pigment { gren }`.
    pub(super) fn color_meant(&mut self, near: &str) -> Option<String> {
        let has_value = matches!(
            self.peek().map(|next| &next.kind),
            Some(TokenKind::Expression(_) | TokenKind::Literal(_))
        );
        if has_value || !matches!(near, "red" | "green" | "blue") {
            return None;
        }
        let mut visible = self.scopes.visible();
        visible.find(|name| name.eq_ignore_ascii_case(near)).map(str::to_owned)
    }

    /// Returns the positions of missing commas, with the separated values, for numbers such as `0 -2`, where
    /// a sign without a blank after it probably begins a new number.
    pub(super) fn commas_lost(&self, span: Span) -> Vec<(Span, String)> {
        let text = self.sources.text(span);
        let number = |c: char| c.is_ascii_digit() || c == '.';
        let pair = |(at, _): (usize, &str)| {
            let (before, behind) = (text.get(..at)?, text.get(at + 2..)?);
            let length = behind.find(|c| !number(c)).unwrap_or(behind.len());
            let start = before.trim_end_matches(number).len();
            let place = Span { start: span.start + at as u32, end: span.start + at as u32, ..span };
            (length > 0 && start < at).then(|| (place, text[start..at + 2 + length].to_owned()))
        };
        text.match_indices(" -").filter_map(pair).collect()
    }

    /// Handles a keyword where a value is expected: `size` for the declared `Size`, or another language's
    /// name.
    pub(super) fn meant_by_word(
        &mut self,
        diagnostic: Diagnostic,
        next: Option<&Token>,
        wanted: &str,
    ) -> Diagnostic {
        let Some(&Token { kind: TokenKind::Word(word), span, .. }) = next else {
            return diagnostic;
        };
        let is_meant = |name: &&str| name.eq_ignore_ascii_case(word.name());
        let declared = self.scopes.visible().find(is_meant).map(str::to_owned);
        if let Some(name) = declared {
            self.next();
            return diagnostic.help(format!("did you mean `{name}`?")).fix(span, name);
        }
        next.and_then(|next| self.called_elsewhere(next, wanted)).unwrap_or(diagnostic)
    }

    /// Reports a value in braces and skips it: `scale { 2 }`, `rgb {1, 0, 0}`.
    pub(super) fn value_in_braces(
        &mut self,
        after: &Token,
        next: &Token,
        wanted: &str,
    ) -> Option<Reported> {
        let TokenKind::Block(_) = next.kind else { return None };
        if let Some(told) = self.braced_macro(next.span) {
            return Some(self.report(&next.here, told));
        }
        let name = match after.kind {
            TokenKind::Word(word) if !opens_value(word) => word.name(),
            _ => return None,
        };
        let inside = self.sources.text(next.span).strip_prefix('{')?.strip_suffix('}')?.trim();
        // A row of numbers is a vector without its angle brackets.
        let row = inside.contains(',') && !inside.contains(['<', '(']);
        let value = if row { format!("<{inside}>") } else { inside.to_owned() };
        let short = !inside.is_empty() && !inside.contains(['\n', '{']) && inside.len() < 60;
        let opener = Span { end: next.span.start + 1, ..next.span };
        let message = format!("`{name}` takes {wanted} without braces");
        let mut diagnostic =
            Diagnostic::new(Code::MissingPart, message).at(opener, format!("expected {wanted}"));
        if short {
            let right = format!("{name} {value}");
            diagnostic = diagnostic.help(format!("write `{right}`")).fix(next.span, value);
        }
        let reported = self.report(&after.here, diagnostic);
        self.next();
        let TokenKind::Block(contents) = next.kind else { return None };
        let before = self.told();
        self.inside_block(&next.here, contents, next.span, Self::run_items);
        self.take_back(before);
        Some(reported)
    }

    /// Returns whether three numbers in a row may be three vectors, as in `triangle { 0, 0, 0 }`, which
    /// POV-Ray 3.7 accepts (measured).
    pub(super) fn takes_bare_numbers(&self, after: &Token) -> bool {
        use Word as W;
        self.options.dialect == Dialect::Pov
            && matches!(
                after.kind,
                TokenKind::Word(
                    W::Triangle
                        | W::SmoothTriangle
                        | W::Disc
                        | W::AreaLight
                        | W::Cylinder
                        | W::Cone
                )
            )
    }

    /// Reports exactly as many bare numbers as `points` points and `numbers` numbers have, with the points as
    /// they should be written: `sphere { 0 0 0, 1 }`.
    pub(super) fn bare_points(&mut self, points: usize, numbers: usize) -> Option<Reported> {
        let first = self.peek()?.span;
        let text = &self.sources.get(first.file).text;
        let mut at = first.start as usize;
        // Most points are vectors and names.
        if !matches!(text.as_bytes().get(at), Some(b'0'..=b'9' | b'.' | b'+' | b'-' | b',')) {
            return None;
        }
        let (mut found, wanted): (Vec<Span>, _) = (Vec::new(), 3 * points + numbers);
        // One more would be too many.
        while found.len() <= wanted {
            let rest = text.get(at..)?;
            let blank =
                rest.len() - rest.trim_start_matches(|c: char| c.is_whitespace() || c == ',').len();
            let number =
                rest[blank..].split(|c: char| c.is_whitespace() || ",}/".contains(c)).next()?;
            if number.parse::<f64>().is_err() || !number.ends_with(|c: char| c.is_ascii_digit()) {
                break;
            }
            found.push(Span::new(first.file, at + blank, at + blank + number.len()));
            at += blank + number.len();
        }
        // `cone { 0, 0.6, 1.2*y, 0.25 }`: the last is the start of a vector.
        let goes_on = text.get(at..)?.trim_start();
        let is_product = goes_on.starts_with('*') || goes_on.starts_with('/');
        let is_comment = goes_on.starts_with("//") || goes_on.starts_with("/*");
        if found.len() != wanted || is_product && !is_comment && wanted == 3 * points {
            return None;
        }
        let mut diagnostic =
            Diagnostic::new(Code::WrongType, "a point is three numbers in angle brackets");
        for point in found.chunks_exact(3).take(points) {
            let [a, b, c] = [0, 1, 2].map(|i| self.sources.text(point[i]));
            let (span, meant) = (point[0].to(point[2]), format!("<{a}, {b}, {c}>"));
            diagnostic = match diagnostic.labels.is_empty() {
                true => diagnostic.at(span, format!("did you mean `{meant}`?")),
                false => diagnostic.also(span, format!("and `{meant}`")),
            };
            diagnostic = diagnostic.fix(span, meant);
        }
        let here = self.peek()?.here.clone();
        Some(self.report(&here, diagnostic))
    }

    /// Returns the diagnostic for a colour with an alpha component, which the language lacks: `rgba <1, 0, 0,
    /// 0.5>`, `rgba(255, 0, 0, 0.5)`.
    pub(in crate::evaluate) fn alpha_color(&self, name: &str, span: Span) -> Option<Diagnostic> {
        let ours = match name.to_lowercase().as_str() {
            "rgba" => "rgbt",
            "srgba" => "srgbt",
            _ => return None,
        };
        let diagnostic = Diagnostic::new(
            Code::ForeignWord,
            format!("`{name}` is not a colour here: none has an alpha"),
        )
        .at(span, format!("did you mean `{ours}`?"));
        let help = format!(
            "`{ours} <red, green, blue, transmit>` takes the opposite: transmit is 1 - alpha"
        );
        Some(match self.alpha_numbers(span) {
            Some((whole, numbers)) => {
                let right = format!("{ours} <{numbers}>");
                diagnostic.help(format!("write `{right}`: transmit is 1 - alpha")).fix(whole, right)
            }
            None => diagnostic.help(help),
        })
    }

    /// Skips the vector or number right after `rgba` that was used as a value.
    pub(in crate::evaluate) fn skip_behind(&mut self, name: Span) {
        let Some(next) = self.peek_on().map(|next| next.span) else { return };
        let text = &self.sources.get(name.file).text;
        let between = text.get(name.end as usize..next.start as usize);
        let is_value = |c: char| c == '<' || c.is_ascii_digit();
        let value = text.get(next.start as usize..).is_some_and(|rest| rest.starts_with(is_value));
        if next.file == name.file && value && between.is_some_and(|b| b.trim().is_empty()) {
            self.next();
        }
    }

    /// Returns the four literal numbers after `rgba`, the last one inverted, and their whole span.
    fn alpha_numbers(&self, span: Span) -> Option<(Span, String)> {
        let rest = self.sources.get(span.file).text.get(span.end as usize..)?;
        let list = rest.trim_start();
        let close = match list.chars().next()? {
            '<' => '>',
            '(' => ')',
            _ => return None,
        };
        let length = list.find(close)?;
        let inside = list[1..length].trim().trim_start_matches('<');
        let mut numbers = Vec::new();
        for part in inside.split(',') {
            numbers.push(part.trim().parse::<f64>().ok().filter(|number| *number >= 0.0)?);
        }
        let &[.., alpha] = numbers.as_slice() else { return None };
        if numbers.len() != 4 || alpha > 1.0 {
            return None;
        }
        // `rgba(255, 0, 0, 0.5)`, as on the web.
        let most = if numbers[..3].iter().any(|c| *c > 1.0) { 255.0 } else { 1.0 };
        let short = |number: f64| format!("{}", (number * 1000.0).round() / 1000.0);
        let mut texts: Vec<String> = numbers[..3].iter().map(|c| short(c / most)).collect();
        texts.push(short(1.0 - alpha));
        let end = span.end as usize + (rest.len() - list.len()) + length + 1;
        Some((Span { end: end as u32, ..span }, texts.join(", ")))
    }

    /// Reports a keyword for transparency, `transparency 0.5` or `opacity 0.5`: `transmit` belongs to a
    /// colour.
    pub(super) fn clear_word(
        &self,
        diagnostic: Diagnostic,
        name: &str,
        span: Span,
        place: Place,
    ) -> Diagnostic {
        let diagnostic = diagnostic.at(span, "did you mean `transmit`?");
        let opposite = matches!(name.to_lowercase().as_str(), "opacity" | "alpha");
        if opposite {
            diagnostic.help("`transmit` is the opposite: `pigment { rgb 1 transmit 0.7 }` for 0.3")
        } else if place.families.contains(&Family::Color) {
            diagnostic.help("replace it with `transmit`").fix(span, "transmit")
        } else {
            diagnostic.help("it belongs to a colour: `pigment { rgb 1 transmit 0.5 }`")
        }
    }
}

/// Returns the diagnostic for `0,5` where a number is expected.
pub(super) fn told_comma(text: &str, span: Span, number: String) -> Diagnostic {
    let thousands = text.split_once(',').filter(|(whole, rest)| {
        rest.len() == 3 && !whole.trim_start_matches('-').starts_with('0') && !rest.contains('.')
    });
    let told = Diagnostic::new(Code::ExtraPart, format!("`{text}` is no number"))
        .at(span, "expected a point, not a comma")
        .help(format!("a fraction is written with a point: `{number}`"))
        .fix(span, number);
    match thousands {
        Some((whole, rest)) => {
            told.help(format!("or, where the comma parts thousands, without it: `{whole}{rest}`"))
        }
        None => told,
    }
}

fn digits(text: &str) -> Option<&str> {
    (!text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())).then_some(text)
}

/// Returns the colour on the display of a web colour string, `"#ff0000"` or `"red"`, if `text` is one.
pub(in crate::evaluate) fn color_of_string(text: &str) -> Option<Rgb> {
    let code = match text.to_ascii_lowercase().as_str() {
        "red" => "#f00",
        "green" | "lime" => "#0f0",
        "blue" => "#00f",
        "yellow" => "#ff0",
        "cyan" => "#0ff",
        "magenta" => "#f0f",
        "orange" => "#ffa500",
        "white" => "#fff",
        "black" => "#000",
        "gray" | "grey" => "#808080",
        _ => text,
    };
    color::web(code)
}
