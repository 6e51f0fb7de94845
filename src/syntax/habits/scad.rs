//! Objects as OpenSCAD calls them: `cube([1, 2, 3]);`, `cylinder(h = 3, r = 1);`, `hull() { … }`, `color("red") …`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};
use crate::vocabulary::{Family, Role, Word};

/// The arguments of a call by name, those without one by an empty name.
struct Given(Vec<(String, String)>);

impl Given {
    /// The argument of one of these names, or the one at `place` among those without a name.
    fn get(&self, names: &[&str], place: usize) -> Option<&str> {
        let named = self.0.iter().find(|(name, _)| names.contains(&name.as_str()));
        let bare = || self.0.iter().filter(|(name, _)| name.is_empty()).nth(place);
        named.or_else(bare).map(|(_, value)| value.as_str())
    }

    /// A radius, or half of a diameter.
    fn radius(&self, radius: &str, diameter: &str, place: usize) -> Option<String> {
        match self.get(&[diameter], usize::MAX) {
            Some(across) => Some(format!("{across}/2")),
            None => self.get(&[radius], place).map(str::to_owned),
        }
    }

    fn is_centered(&self, place: usize) -> bool {
        self.get(&["center"], place) == Some("true")
    }

    fn bare(&self) -> usize {
        self.0.iter().filter(|(name, _)| name.is_empty()).count()
    }
}

/// How an object that another tool calls is written here, and what it is.
fn written(name: &str, given: &Given) -> Option<(&'static str, String)> {
    let or = |value: Option<&str>, other: &str| value.unwrap_or(other).to_owned();
    Some(match name {
        "cube" if given.bare() < 3 => {
            let size = or(given.get(&["size"], 0), "1");
            let whole = match given.is_centered(1) {
                true => format!("box {{ -{size}/2, {size}/2 }}"),
                false => format!("box {{ 0, {size} }}"),
            };
            ("a box", whole)
        }
        "sphere" if given.bare() < 2 => {
            let radius = given.radius("r", "d", 0).unwrap_or_else(|| "1".to_owned());
            ("a sphere", format!("sphere {{ 0, {radius} }}"))
        }
        "cylinder" => {
            let height = or(given.get(&["h"], 0), "1");
            let ends = match given.is_centered(3) {
                true => [format!("-{height}/2*z"), format!("{height}/2*z")],
                false => ["0".to_owned(), format!("{height}*z")],
            };
            let both = given.radius("r", "d", usize::MAX);
            let [low, high] = [("r1", "d1", 1), ("r2", "d2", 2)]
                .map(|(radius, diameter, place)| given.radius(radius, diameter, place));
            match (both.or_else(|| low.clone()), high) {
                (Some(low), Some(high)) if low != high => {
                    ("a cone", format!("cone {{ {}, {low}, {}, {high} }}", ends[0], ends[1]))
                }
                (radius, _) => {
                    let radius = radius.unwrap_or_else(|| "1".to_owned());
                    ("a cylinder", format!("cylinder {{ {}, {}, {radius} }}", ends[0], ends[1]))
                }
            }
        }
        "circle" => {
            let radius = given.radius("r", "d", 0).unwrap_or_else(|| "1".to_owned());
            ("a disc", format!("disc {{ 0, z, {radius} }}"))
        }
        "square" | "polygon" => ("a polygon", "polygon { count, points }".to_owned()),
        "polyhedron" => {
            let form = "mesh2 { vertex_vectors { … } face_indices { … } }";
            ("a mesh", form.to_owned())
        }
        "linear_extrude" => {
            let height = or(given.get(&["height", "h"], 0), "height");
            ("an outline that is drawn up", format!("prism {{ 0, {height}, count, points }}"))
        }
        "rotate_extrude" => ("an outline that is turned", "lathe { count, points }".to_owned()),
        "hull" | "minkowski" => ("what is around objects", "union { … }".to_owned()),
        _ => return None,
    })
}

impl Reader<'_> {
    /// A call of OpenSCAD's where an object stands.
    pub(super) fn scad(&mut self, meant: &mut Vec<Token>) -> bool {
        if !self.is(1, Mark::Open(Bracket::Round)) || !self.is_place_of_objects(meant) {
            return false;
        }
        let name = self.slice(0).to_owned();
        let Some(close) = self.closed(1, Bracket::Round) else { return false };
        if name == "color" {
            return self.painted(close);
        }
        let Some(given) = self.arguments(2, close) else { return false };
        let Some((what, right)) = written(&name, &given) else { return false };
        let braces = self.is(close + 1, Mark::Open(Bracket::Brace));
        let of_whole = matches!(name.as_str(), "hull" | "minkowski");
        // `Ball(3)` may be a macro of the author's, and `sphere (0, 1)` lacks its braces.
        let marked = given.0.iter().any(|(name, value)| !name.is_empty() || value.starts_with('<'))
            || self.is(close + 1, Mark::Semicolon)
            || matches!(name.as_str(), "linear_extrude" | "rotate_extrude")
            || (of_whole && braces);
        let own = self.kind(0) == Some(TokenKind::Name)
            && (self.text.contains(&format!("macro {name}")) || self.text.contains("#include"));
        let has_block = braces && !of_whole && !name.ends_with("_extrude");
        if !marked || own || has_block {
            return false;
        }
        let is_declared = meant.last().is_some_and(|t| t.kind == TokenKind::Mark(Mark::Equal));
        let end = match name.as_str() {
            // The outline belongs to it.
            _ if name.ends_with("_extrude") => self.end_of_statement(close + 1),
            _ if of_whole => close + 1,
            _ => {
                let ends = self.is(close + 1, Mark::Semicolon) && !is_declared;
                close + 1 + usize::from(ends)
            }
        };
        let span = self.span(0, close);
        let message = match of_whole {
            true => format!("`{name}` is a word of OpenSCAD: there is nothing like it here"),
            false => format!("`{name}(…)` is how OpenSCAD writes {what}"),
        };
        let diagnostic = Diagnostic::new(Code::ForeignWord, message)
            .at(
                span,
                if of_whole { "no object here" } else { "objects have their parts in braces" },
            )
            .help(format!("write `{right}`"));
        let whole = self.span(0, end - 1);
        let complete = !right.contains("count") && !right.contains('…');
        self.diagnostics.push(if complete { diagnostic.fix(whole, right) } else { diagnostic });
        // An object stands in its place.
        let token = self.tokens[self.at];
        meant.push(Token { kind: TokenKind::Word(Word::Union), ..token });
        if !(of_whole && braces) {
            let sign = |mark| Token { kind: TokenKind::Mark(mark), start: token.end, ..token };
            meant.push(sign(Mark::Open(Bracket::Brace)));
            meant.push(sign(Mark::Close(Bracket::Brace)));
        }
        self.at += end;
        true
    }

    /// `color("red") cube(1);`: the colour is told, the object stays.
    fn painted(&mut self, close: usize) -> bool {
        let follows = match self.kind(close + 1) {
            Some(TokenKind::Word(word)) => {
                matches!(word.family(), Family::Shape | Family::Csg | Family::Transform)
                    || word == Word::Cube
            }
            Some(TokenKind::Name) => self.is(close + 2, Mark::Open(Bracket::Round)),
            Some(TokenKind::Mark(Mark::Open(Bracket::Brace))) => true,
            _ => false,
        };
        if !follows {
            return false;
        }
        let name = self.slice(2).trim_matches('"');
        let numbers = self.closed(2, Bracket::Square).filter(|end| *end > 3);
        let color = match numbers.map(|end| self.span(3, end - 1)) {
            Some(numbers) => format!("rgb <{}>", self.text.get(numbers.range()).unwrap_or("")),
            None => match name.split_at_checked(1) {
                Some((first, rest)) if name.chars().all(|c| c.is_ascii_alphabetic()) => {
                    format!("{}{}", first.to_ascii_uppercase(), rest.to_ascii_lowercase())
                }
                _ => "rgb <red, green, blue>".to_owned(),
            },
        };
        let diagnostic = Diagnostic::new(
            Code::MisplacedBlock,
            "`color` stands inside the object that it paints, behind its parts",
        )
        .at(self.span(0, close), "not before an object, as in other languages")
        .help(format!("write `sphere {{ … pigment {{ {color} }} }}`"));
        self.diagnostics.push(diagnostic);
        self.at += close + 1;
        true
    }

    /// Whether an object may stand where the reader is.
    fn is_place_of_objects(&self, meant: &[Token]) -> bool {
        let holds = self.inside.last().is_none_or(super::part::Inside::holds_objects);
        let begins = match meant.last().map(|token| token.kind) {
            None | Some(TokenKind::Directive(_)) => true,
            Some(TokenKind::Mark(mark)) => matches!(
                mark,
                Mark::Open(Bracket::Brace)
                    | Mark::Close(Bracket::Brace | Bracket::Round)
                    | Mark::Semicolon
                    | Mark::Equal
            ),
            // Behind a directive's own value.
            Some(TokenKind::String) => self.inside.is_empty(),
            _ => false,
        };
        holds && begins
    }

    /// What stands between the tokens `from` and `to`, if each is a value.
    fn arguments(&self, from: usize, to: usize) -> Option<Given> {
        let mut given = Vec::new();
        let mut at = from;
        while at < to {
            let mut end = at;
            let mut depth = 0_i32;
            while end < to && (depth > 0 || !self.is(end, Mark::Comma)) {
                depth += match self.kind(end)? {
                    TokenKind::Mark(Mark::Open(Bracket::Brace)) | TokenKind::Directive(_) => {
                        return None;
                    }
                    TokenKind::Mark(Mark::Open(_)) => 1,
                    TokenKind::Mark(Mark::Close(_)) => -1,
                    // A part of a shape, and no argument.
                    TokenKind::Word(word)
                        if word.role() == Role::Statement && !self.is(end + 1, Mark::Equal) =>
                    {
                        return None;
                    }
                    _ => 0,
                };
                end += 1;
            }
            let named = end > at + 2
                && matches!(self.kind(at), Some(TokenKind::Name | TokenKind::Word(_)))
                && self.is(at + 1, Mark::Equal);
            // `$fn = 64`: how round it is drawn.
            if self.kind(at) != Some(TokenKind::Stray) && end > at {
                let first = if named { at + 2 } else { at };
                let name = if named { self.slice(at).to_owned() } else { String::new() };
                given.push((name, self.value_here(first, end)));
            }
            at = end + 1;
        }
        Some(Given(given))
    }

    /// A value with its vectors as they are written here.
    fn value_here(&self, from: usize, end: usize) -> String {
        let text = self.text.get(self.span(from, end - 1).range()).unwrap_or("");
        match text.strip_prefix('[').and_then(|text| text.strip_suffix(']')) {
            Some(inside) if !inside.contains('[') => format!("<{}>", inside.trim()),
            _ => text.to_owned(),
        }
    }

    /// Behind the `;` or the block that ends what begins at `from`.
    fn end_of_statement(&self, from: usize) -> usize {
        let mut at = from;
        while let Some(kind) = self.kind(at) {
            match kind {
                TokenKind::Mark(Mark::Semicolon) => return at + 1,
                TokenKind::Mark(Mark::Close(Bracket::Brace)) | TokenKind::Directive(_) => {
                    return at;
                }
                TokenKind::Mark(Mark::Open(bracket)) => {
                    let Some(close) = self.closed(at, bracket) else { return at };
                    at = close + 1;
                    if bracket == Bracket::Brace {
                        return at;
                    }
                }
                _ => at += 1,
            }
        }
        at
    }
}
