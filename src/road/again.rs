//! A second reading, for braces that pair only as they are run.
//!
//! POV-Ray 3.7 reads word by word: a block may be opened in one file or branch and closed in another (measured).
//! **In:** a `.pov` that is refused for its braces. **Out:** the same scene, where each brace that has no partner
//! in its own text or branch pairs as it is run (`evaluate/enclosure.rs`).
//! **Invariant:** a scene that is wrong either way is judged as it is written.

use super::Road;
use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Dialect, Scene};
use crate::source::FileId;

impl Road<'_> {
    /// The scene with loose braces, where that is no error; what was said of the first reading is dropped then.
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
