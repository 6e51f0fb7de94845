//! Writes the finished lines, with trailing comments aligned in columns where the author aligned them.
//!
//! **Invariant:** comments that were aligned stay so; no line ends with a blank.

/// One line without its line end.
#[derive(Debug, Default, Clone)]
pub(super) struct Row {
    /// Its indentation and its code.
    pub code: String,
    /// A comment after the code, and its column in the author's text.
    pub comment: Option<(String, usize)>,
    /// The number of empty lines before it.
    pub blank: usize,
}

/// The least distance between a line's code and its comment.
const GAP: usize = 2;

/// Returns the text of all lines, each ended by `end`.
pub(super) fn write(rows: &[Row], end: &str) -> String {
    let mut out = String::with_capacity(rows.iter().map(|row| row.code.len() + 1).sum());
    let mut at = 0;
    while at < rows.len() {
        let run = run(&rows[at..]);
        let lines = &rows[at..at + run];
        let column = lines.iter().map(width).max().unwrap_or(0) + GAP;
        for row in lines {
            for _ in 0..row.blank {
                out.push_str(end);
            }
            out.push_str(&row.code);
            if let Some((comment, _)) = &row.comment {
                out.extend(std::iter::repeat_n(' ', column - width(row)));
                out.push_str(comment);
            }
            out.push_str(end);
        }
        at += run;
    }
    out
}

/// Returns how many lines from the first on have their comments in one column.
fn run(rows: &[Row]) -> usize {
    let Some((_, column)) = rows[0].comment else { return 1 };
    let below = |row: &&Row| row.blank == 0 && row.comment.as_ref().is_some_and(|c| c.1 == column);
    1 + rows[1..].iter().take_while(below).count()
}

/// Returns the width of the code's last line: a string may span several.
fn width(row: &Row) -> usize {
    row.code.rsplit('\n').next().unwrap_or("").chars().count()
}
