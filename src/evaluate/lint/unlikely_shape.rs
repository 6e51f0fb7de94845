//! Valid but unlikely shapes: a `difference` of one object, a `torus` thicker than it is wide.

use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::Evaluator;
use crate::evaluate::block::Given;
use crate::evaluate::stream::Token;
use crate::scene::Operation;

impl Evaluator<'_> {
    /// Warns of `difference { A }`, as POV-Ray does.
    pub(in crate::evaluate) fn lint_lone_child(&mut self, token: &Token, operation: Operation) {
        if self.poison.is_some() {
            return;
        }
        let label = match operation {
            Operation::Difference => "nothing is taken away from its first object",
            Operation::Intersection => "nothing is there to have something in common with",
            Operation::Merge => return,
        };
        let message = format!("this {} has one object only", operation.word().name());
        let diagnostic = Diagnostic::new(Code::DegenerateShape, message).at(token.span, label);
        self.report(&token.here, diagnostic);
    }

    /// Warns of swapped radii: `torus { 0.06, 0.45 }`.
    pub(in crate::evaluate) fn lint_spindle(&mut self, major: &Given<f64>, minor: &Given<f64>) {
        /// Ratio of the radii above which it is more likely a mistake than a spindle torus.
        const THICK: f64 = 2.0;
        let is_literal = |given: &Given<f64>| super::is_literal(self.sources.text(given.span));
        let both = is_literal(major) && is_literal(minor);
        if !both || major.value <= 0.0 || minor.value < THICK * major.value {
            return;
        }
        let [first, second] = [major, minor].map(|given| self.sources.text(given.span));
        let right = format!("{second}, {first}");
        let message = "the tube of this torus is thicker than its ring: it has no hole";
        let diagnostic = Diagnostic::new(Code::DegenerateShape, message)
            .at(major.span, "the radius of the ring")
            .also(minor.span, "the radius of the tube")
            .help(format!("are the two swapped? write `{right}`"));
        self.report(&major.here, diagnostic);
    }
}
