//! Evaluates a file a second time if its braces pair only at run time.
//!
//! POV-Ray 3.7 reads word by word: a block may be opened in one file or branch and closed in another
//! (measured). **In:** a `.pov` that is rejected for its braces. **Out:** the same scene, where each brace
//! without a partner in its own text or branch is paired when it is run (`evaluate/enclosure.rs`).
//! **Invariant:** a scene that is invalid either way is reported as written.

use super::Road;
use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Dialect, Scene};
use crate::source::FileId;

impl Road<'_> {
    /// Returns the scene evaluated with loose braces if that succeeds, and drops the diagnostics of the first
    /// attempt.
    pub(super) fn with_loose_braces(&mut self) -> Option<Scene> {
        let evaluate = &self.options.evaluate;
        let may_be_right = evaluate.dialect == Dialect::Pov && !evaluate.loose;
        if !may_be_right || !self.diagnostics.iter().any(is_of_braces) {
            return None;
        }
        let mut options = self.options.clone();
        options.evaluate.loose = true;
        let mut again = Road::new(self.files, options);
        let main = self.sources.get(FileId(0));
        let file = again.take_in(main.clone());
        let of_encoding = self.diagnostics.iter().filter(|told| told.code == Code::BadEncoding);
        of_encoding.for_each(|told| again.diagnostics.push(told.clone()));
        let ast = again.parse(file);
        let scene = again.evaluate(ast);
        let is_wrong = |told: &Diagnostic| told.is_error() && told.code != Code::NotSupportedYet;
        if again.diagnostics.iter().any(is_wrong) {
            return None;
        }
        *self = again;
        Some(scene)
    }
}

fn is_of_braces(told: &Diagnostic) -> bool {
    told.is_error() && matches!(told.code, Code::UnclosedBlock | Code::StrayCloser)
}
