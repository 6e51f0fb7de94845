//! Lines that other programs leave in a text: the fences of Markdown, the marks of a conflict of versions.
//!
//! **In:** a text without comments. **Out:** the same text with blanks in their place; of a conflict, the
//! second version goes with its marks. **Invariant:** a text without any passes uncopied; one message for
//! each conflict, and one for all fences.

use std::borrow::Cow;
use std::ops::Range;

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};

const FENCE: &str = "```";
const OURS: &str = "<<<<<<< ";
const MIDDLE: &str = "=======";
const THEIRS: &str = ">>>>>>> ";

pub(super) fn blank<'a>(
    text: Cow<'a, str>,
    file: FileId,
    diagnostics: &mut Diagnostics,
) -> Cow<'a, str> {
    if !text.contains(FENCE) && !text.contains(OURS) {
        return text;
    }
    let span = |range: &Range<usize>| Span::new(file, range.start, range.end);
    let (mut fences, mut gone, mut conflict) = (Vec::new(), Vec::new(), Vec::new());
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let range = start..start + line.trim_end().len();
        start += line.len();
        if line.starts_with(FENCE) {
            fences.push(range);
        } else if line.starts_with(OURS) {
            conflict = vec![range];
        } else if line.trim_end() == MIDDLE && conflict.len() == 1 {
            conflict.push(range);
        } else if line.starts_with(THEIRS)
            && let [ours, middle] = conflict.as_slice()
        {
            let message = "two versions of these lines stand in the file";
            let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(span(ours), "a conflict that was left as it is; the first version begins here")
                .also(span(middle), "the second one begins here")
                .also(span(&range), "and ends here")
                .help("keep one of the two, and take the three marks out");
            diagnostics.push(diagnostic);
            gone.extend([ours.clone(), middle.start..range.end]);
            conflict.clear();
        }
    }
    if let Some(first) = fences.first() {
        let message = "this is a mark of Markdown, not of the language";
        let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(span(first), "it stands around code in a text")
            .help("leave the line out");
        let diagnostic = fences.iter().fold(diagnostic, |d, fence| d.fix(span(fence), ""));
        diagnostics.push(diagnostic);
    }
    gone.append(&mut fences);
    let mut bytes = text.into_owned().into_bytes();
    for range in gone {
        for byte in bytes[range].iter_mut().filter(|byte| !matches!(**byte, b'\n' | b'\r')) {
            // Each byte of a character becomes one blank: still UTF-8.
            *byte = b' ';
        }
    }
    Cow::Owned(String::from_utf8(bytes).unwrap_or_default())
}
