//! The colours after a pattern that takes a list of them: `checker rgb 0, rgb 1`.

use crate::color::{Color, Rgb};
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::{Evaluator, Outcome};
use crate::scene::{ColorMap, Colors, Pigment, PigmentId, PigmentKind, Source};
use crate::source::Site;
use crate::vocabulary::Word;

/// A colour of a list.
#[derive(Debug, Clone, Copy)]
enum Listed {
    Color(Color),
    Pigment(PigmentId),
}

/// Returns the colours of a list where none are written.
fn defaults(source: &Source) -> Vec<Color> {
    if let Source::Object(_) = source {
        // Measured.
        return vec![
            Color::opaque(Rgb::new(0.0, 0.0, 1.0)),
            Color::opaque(Rgb::new(0.0, 1.0, 0.0)),
        ];
    }
    let Source::Kind(kind) = source else { return Vec::new() };
    let colors = kind.colors().iter();
    colors.map(|&(_, [red, green, blue])| Color::opaque(Rgb::new(red, green, blue))).collect()
}

impl Evaluator<'_> {
    /// Reads the colours or pigments after a pattern that takes `count`; also returns the first colour that
    /// lets light through.
    pub(super) fn list_of_colors(
        &mut self,
        token: &Token,
        source: &Source,
        count: usize,
    ) -> Outcome<(Colors, Option<Site>)> {
        let mut colors: Vec<Listed> = Vec::new();
        let mut clear = None;
        let mut pigments = 0;
        while colors.len() < count {
            self.skip_commas();
            if self.at_color() {
                let first = self.peek().cloned();
                let color = self.color_after(token, "a colour")?.value;
                if color.is_clear() {
                    clear = clear.or(first.map(|first| self.whole(&first)));
                }
                colors.push(Listed::Color(color));
            } else if let Some(Token { kind: TokenKind::Word(Word::Pigment), .. }) = self.peek() {
                let Some(next) = self.next() else { break };
                pigments += 1;
                let id = self.pigment(&next)?;
                let pigment = &self.scene.pigments[id.index()];
                clear = clear.or(pigment.clear);
                colors.push(match pigment {
                    Pigment { kind: PigmentKind::Color(color), .. } => Listed::Color(*color),
                    _ => Listed::Pigment(id),
                });
            } else {
                break;
            }
        }
        self.complete_list(token, source, (&mut colors, count), pigments);
        Ok((self.list(colors), clear))
    }

    /// Adds the colours that are not written.
    fn complete_list(
        &mut self,
        token: &Token,
        source: &Source,
        (colors, count): (&mut Vec<Listed>, usize),
        pigments: usize,
    ) {
        let given = colors.len();
        // `checker rgb 1; rgb 0`.
        if given == 1
            && let Some(sign) = self.next_if(|kind| matches!(kind, TokenKind::Semicolon))
        {
            let diagnostic =
                Diagnostic::new(Code::UnexpectedCharacter, "commas part the colours of a pattern")
                    .at(sign.span, "expected `,`")
                    .help("replace the `;` with `,`")
                    .fix(sign.span, ",");
            self.report(&sign.here, diagnostic);
            self.skip_color(token);
        } else if given > 0 && given < count && self.poison.is_none() {
            // Without any, the author knows those that it has.
            self.lint_missing_color(token, source.word(), (given, count), pigments > 0);
        }
        let own = defaults(source);
        let default = self.scene.textures[self.default_texture.index()].kind.first_pigment();
        for place in given..count {
            colors.push(match own.get(place) {
                // Beside a pigment, the others are the default one, as in POV-Ray 3.7 (measured).
                _ if pigments > 0 => Listed::Pigment(default),
                Some(color) => Listed::Color(*color),
                None => Listed::Color(Color::BLACK),
            });
        }
    }

    /// Returns the colours at the values 0, 1, 2 …
    fn list(&mut self, listed: Vec<Listed>) -> Colors {
        let plain = |listed: &Listed| match listed {
            Listed::Color(color) => Some(*color),
            Listed::Pigment(id) => match self.scene.pigments[id.index()].kind {
                PigmentKind::Color(color) => Some(color),
                _ => None,
            },
        };
        let colors: Option<Vec<Color>> = listed.iter().map(plain).collect();
        if let Some(colors) = colors {
            let entries = colors.into_iter().enumerate();
            return Colors::Map(ColorMap(entries.map(|(at, color)| (at as f64, color)).collect()));
        }
        let pigments = listed.into_iter().enumerate().map(|(at, listed)| {
            let id = match listed {
                Listed::Pigment(id) => id,
                Listed::Color(color) => self.pigment_of_color(color),
            };
            (at as f64, id)
        });
        Colors::Pigments(pigments.collect())
    }

    /// Returns a pigment of one colour.
    pub(super) fn pigment_of_color(&mut self, color: Color) -> PigmentId {
        let site = self.scene.pigments[0].site;
        let kind = PigmentKind::Color(color);
        self.add_pigment(Pigment {
            kind,
            steps: Vec::new(),
            site,
            clear: None,
            has_own_colors: false,
            quick_color: None,
        })
    }
}
