//! Warnings for flaws with which a mesh can still be rendered: degenerate triangles and normals of length 0.
//!
//! **Invariant:** each flaw is reported once for each mesh, however many of its triangles have it.

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::math::double::DoubleVector;
use crate::source::Site;
use crate::vocabulary::{Dialect, Word};

use super::super::super::stream::Token;
use super::super::super::{Evaluator, Outcome};

/// The number of elements with a flaw, and the position of the first, if known.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Flawed {
    pub count: u32,
    pub first: Option<Site>,
}

impl Flawed {
    pub fn add(&mut self, site: Site) {
        self.count += 1;
        self.first.get_or_insert(site);
    }
}

#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Flaws {
    /// Triangles that are lines or points.
    pub degenerate: Flawed,
    /// Normals of length 0 at corners of the other triangles.
    pub aimless: Flawed,
}

impl Evaluator<'_> {
    /// Reports an empty list of a `mesh2`; POV-Ray also refuses a mesh without triangles.
    pub(super) fn expect_entries(&mut self, list: &Token, count: usize, of: &str) -> Outcome<()> {
        if count > 0 {
            return Ok(());
        }
        let diagnostic = Diagnostic::new(Code::MissingPart, format!("this mesh2 has no {of}"))
            .at(list.span, "this list is empty")
            .help("leave the mesh out where nothing of it is left, by `#if`");
        Err(self.report(&list.here, diagnostic))
    }

    pub(super) fn one_for_each(
        &mut self,
        list: &Token,
        (found, of_what): (usize, &str),
        (what, of): (&str, usize),
    ) -> Outcome<()> {
        if found == of {
            return Ok(());
        }
        let many = if what == "vertex" { "vertices" } else { "faces" };
        let message = format!("{found} {of_what} for {of} {many}");
        let diagnostic = Diagnostic::new(Code::WrongArity, message)
            .at(list.span, format!("expected one for each {what}: {of}"));
        let diagnostic = match (of_what, what) {
            ("normals", "vertex") => {
                diagnostic.help("or `normal_indices`, which say which of them each corner has")
            }
            _ => diagnostic,
        };
        Err(self.report(&list.here, diagnostic))
    }

    /// Warns of flawed triangles in a mesh, of which `left` remain visible.
    pub(super) fn tell_of_flaws(&mut self, token: &Token, word: Word, left: usize, flaws: Flaws) {
        let Flaws { degenerate, aimless } = flaws;
        let mesh = token.here.site(token.span);
        if left == 0 && self.poison.is_none() {
            self.scene.sizeless.push((word.name(), mesh));
            // POV-Ray 3.7 then draws nothing for a mesh2, and refuses a mesh (measured).
            if word == Word::Mesh2 && degenerate.count > 0 && self.options.dialect == Dialect::Pov {
                let diagnostic = without_triangles(token, word, degenerate.count);
                self.report(&token.here, diagnostic.as_warning());
                return;
            }
            // Unless its triangles come too late.
            self.owed =
                Some((token.here.clone(), without_triangles(token, word, degenerate.count)));
        } else if degenerate.count > 0 {
            let message = match degenerate.count {
                1 => "a triangle of this mesh is a line or a point".to_owned(),
                count => format!("{count} triangles of this mesh are lines or points"),
            };
            let site = degenerate.first.unwrap_or(mesh);
            let diagnostic = Diagnostic::new(Code::DegenerateShape, message)
                .at(site.span, "left out: nothing of it could be seen");
            let text = self.sources.text(site.span).trim_matches(['<', '>']);
            let numbers: Vec<&str> = text.split(',').map(str::trim).collect();
            let diagnostic = match numbers.as_slice() {
                [a, b, c] if a == b || a == c => {
                    diagnostic.help(format!("vertex {a} is two of its corners"))
                }
                [_, b, c] if b == c => diagnostic.help(format!("vertex {b} is two of its corners")),
                _ => diagnostic,
            };
            self.report_in(site.expansion, diagnostic);
        }
        self.tell_of_aimless(aimless, word, mesh);
    }

    /// Warns of normals of length 0, which `lower` omits.
    pub(super) fn tell_of_aimless(&mut self, normals: Flawed, word: Word, mesh: Site) {
        let message = match normals.count {
            0 => return,
            1 => "a normal of length 0 points nowhere".to_owned(),
            count => format!("{count} normals of length 0 point nowhere"),
        };
        let site = normals.first.unwrap_or(mesh);
        let help = match word {
            Word::Mesh2 => "write the way that the surface faces there; POV-Ray takes `x` for it",
            _ => "write the way that the surface faces there",
        };
        let diagnostic = Diagnostic::new(Code::DegenerateShape, message)
            .at(site.span, "left out: its face is lit by the other normals, or as a flat one")
            .help(help);
        self.report_in(site.expansion, diagnostic);
    }
}

/// Returns the diagnostic for a mesh without any triangle left, which POV-Ray refuses as well.
fn without_triangles(token: &Token, word: Word, degenerate: u32) -> Diagnostic {
    let name = word.name();
    let told = match degenerate {
        0 => Diagnostic::new(Code::MissingPart, format!("this {name} has no triangles"))
            .at(token.span, "expected one at least"),
        1 => Diagnostic::new(
            Code::ZeroSize,
            format!("the one triangle of this {name} is a line or a point"),
        )
        .at(token.span, "nothing is left of it"),
        count => Diagnostic::new(
            Code::ZeroSize,
            format!("all {count} triangles of this {name} are lines or points"),
        )
        .at(token.span, "nothing is left of it"),
    };
    match (word, degenerate) {
        (Word::Mesh, 0) => {
            told.help("a triangle is written `triangle { <corner>, <corner>, <corner> }`")
        }
        _ => told,
    }
}

/// Returns whether three corners are collinear, or one of them is not finite.
pub(super) fn is_degenerate(corners: [Vector; 3]) -> bool {
    let is_nowhere = corners.iter().any(|corner| !corner.is_finite());
    let [a, b, c] = corners.map(DoubleVector::from);
    is_nowhere || (b - a).cross(c - a).is_zero()
}
