//! Extracts the source lines that a message shows, and makes them safe to print.
//!
//! **In:** spans in any number of files. **Out:** the lines around them, as one text per run of adjacent
//! lines. All runs share one space of offsets, and the run of the first span comes first. **Invariant:**
//! only those lines are copied; no line is wider than its window; no control or bidirectional formatting
//! character remains.

use super::cut::{TAB, columns, parts};
use crate::source::{FileId, Position, Sources, Span};

/// Labels that span more lines than this are cut to their first line.
const LONGEST_LABEL: usize = 8;
/// Columns next to the line number, plus the one after the line that a caret may need.
const BESIDE: usize = 5;
/// Columns next to the bars of multi-line labels.
const BESIDE_BARS: usize = 3;

/// Adjacent lines of one file.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    pub file: FileId,
    /// Number of the first line, from 1.
    pub first_line: usize,
    /// Offset of this run in the shared space of offsets.
    pub base: usize,
    /// Text of the lines, each terminated by a line feed.
    pub text: String,
    /// For each character shown: its byte offset in the source and in `text`.
    places: Vec<(usize, usize)>,
}

/// The runs that contain all spans, and the offsets of the spans.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Excerpt {
    pub runs: Vec<Run>,
    /// For each given span: its start and end offset, and the source position of its start.
    pub marks: Vec<(usize, usize, Position)>,
    /// Number of digits of the largest line number.
    pub digits: usize,
}

impl Excerpt {
    /// Extracts the lines around `spans`, with one line of context before and after each, for a window of
    /// `width` columns.
    pub fn around(spans: &[Span], sources: &Sources, width: usize) -> Self {
        let spans: Vec<Span> = spans.iter().map(|&span| shortened(span, sources)).collect();
        let lines = |span: &Span| {
            let line = |at: u32| sources.get(span.file).position(at as usize).line;
            (line(span.start), line(span.end))
        };
        let last = spans.iter().map(|span| lines(span).1 + 1).max().unwrap_or(0);
        let digits = last.to_string().len();
        let bars = match spans.iter().filter(|span| lines(span).0 < lines(span).1).count() {
            0 => 0,
            count => count + BESIDE_BARS,
        };
        let room = width.saturating_sub(digits + BESIDE + bars);
        let mut files: Vec<FileId> = Vec::new();
        for span in &spans {
            if !files.contains(&span.file) {
                files.push(span.file);
            }
        }
        let mut excerpt = Self { digits, ..Self::default() };
        for file in files {
            let here: Vec<Span> = spans.iter().copied().filter(|span| span.file == file).collect();
            excerpt.add_file(file, &here, sources, room);
        }
        excerpt.put_first(spans.first());
        excerpt.marks = spans
            .iter()
            .map(|span| {
                let position = sources.get(span.file).position(span.start as usize);
                let start = excerpt.offset(span.file, span.start as usize);
                (start, excerpt.offset(span.file, span.end as usize).max(start), position)
            })
            .collect();
        excerpt
    }

    fn add_file(&mut self, file: FileId, spans: &[Span], sources: &Sources, room: usize) {
        let source = sources.get(file);
        let mut lines: Vec<usize> = Vec::new();
        let blank = |line: usize| source.line(line).trim().is_empty();
        for span in spans {
            let first = source.position(span.start as usize).line;
            let last = source.position(span.end as usize).line;
            lines.extend(first..=last);
            // One line of context on both sides, where it says something.
            lines.extend((first > 1 && !blank(first - 1)).then(|| first - 1));
            lines.extend((last < source.line_count() && !blank(last + 1)).then_some(last + 1));
        }
        lines.sort_unstable();
        let gaps: Vec<usize> =
            lines.windows(2).filter(|w| w[1] == w[0] + 2).map(|w| w[0] + 1).collect();
        lines.extend(gaps);
        lines.sort_unstable();
        lines.dedup();
        let mut previous = None;
        for line in lines {
            if previous.is_none_or(|previous| line > previous + 1) {
                let (text, places) = (String::new(), Vec::new());
                self.runs.push(Run { file, first_line: line, base: 0, text, places });
            }
            previous = Some(line);
            if let Some(run) = self.runs.last_mut() {
                run.add_line(source.line(line), source.line_start(line), spans, room);
            }
        }
    }

    /// Moves the run that contains `span` to the front, because the first run is read first, and lays out
    /// the runs.
    fn put_first(&mut self, span: Option<&Span>) {
        let first = span.and_then(|span| self.run(span.file, span.start as usize));
        if let Some(first) = first {
            self.runs[..=first].rotate_right(1);
        }
        let mut base = 0;
        for run in &mut self.runs {
            run.base = base;
            base += run.text.len() + 1;
        }
    }

    /// Returns the index of the last run of `file` that starts at or before byte `at`.
    fn run(&self, file: FileId, at: usize) -> Option<usize> {
        let begin = |i: &usize| {
            let run = &self.runs[*i];
            run.places.first().map(|place| place.0).filter(|&b| run.file == file && b <= at)
        };
        (0..self.runs.len()).filter(|i| begin(i).is_some()).max_by_key(begin)
    }

    /// Returns the offset at which byte `at` of `file` is shown, or that of the cut before it.
    fn offset(&self, file: FileId, at: usize) -> usize {
        let Some(run) = self.run(file, at).map(|i| &self.runs[i]) else { return 0 };
        let after = run.places.partition_point(|place| place.0 <= at);
        run.base + run.places[after.saturating_sub(1)].1
    }
}

impl Run {
    fn add_line(&mut self, line: &str, start: usize, spans: &[Span], room: usize) {
        let end = start + line.len();
        let here = spans.iter().filter(|s| s.start as usize <= end && s.end as usize >= start);
        let from = |span: &Span| (span.start as usize).max(start) - start;
        let to = |span: &Span| (span.end as usize).min(end) - start;
        let mut places: Vec<_> = here.map(|span| from(span)..to(span)).collect();
        places.sort_unstable_by_key(|place| place.start);
        // Of labels over each other, a later one may be underlined behind the line's end.
        let mut reached = 0;
        let behind = places.iter().filter(|place| {
            let over = place.start < reached;
            reached = reached.max(place.end).max(place.start + 1);
            over
        });
        let room = room.saturating_sub(behind.count()).max(room / 2);
        let drawn = self.text.len();
        let mut shown = 0;
        for part in parts(line, &places, room) {
            if part.start > shown {
                self.text.push('…');
            }
            for (i, c) in line[part.clone()].char_indices() {
                self.places.push((start + part.start + i, self.text.len()));
                match c {
                    '\t' => {
                        let blanks = TAB - columns(&self.text[drawn..]) % TAB;
                        self.text.extend(std::iter::repeat_n(' ', blanks));
                    }
                    _ => push_visible(&mut self.text, c),
                }
            }
            self.places.push((start + part.end, self.text.len()));
            shown = part.end;
        }
        if shown < line.len() {
            self.text.push('…');
        }
        self.text.push('\n');
    }
}

/// Cuts a span over many lines to its first line.
fn shortened(span: Span, sources: &Sources) -> Span {
    let source = sources.get(span.file);
    let first = source.position(span.start as usize).line;
    if source.position(span.end as usize).line - first < LONGEST_LABEL {
        return span;
    }
    let end = source.line_start(first) + source.line(first).len();
    Span::new(span.file, span.start as usize, end.max(span.start as usize))
}

/// Appends `c` in a visible form that does not move the cursor: control characters as control pictures,
/// invisible and bidirectional formatting characters by number.
pub fn push_visible(text: &mut String, c: char) {
    match c {
        '\t' => text.push('\t'),
        '\0'..' ' => text.extend(char::from_u32(0x2400 + c as u32)),
        '\u{7f}' => text.push('␡'),
        '\u{80}'..='\u{9f}'
        | '\u{ad}'
        | '\u{61c}'
        | '\u{180e}'
        | '\u{200b}'..='\u{200f}'
        | '\u{2028}'..='\u{202e}'
        | '\u{2060}'..='\u{206f}'
        | '\u{fe00}'..='\u{fe0f}'
        | '\u{feff}'
        | '\u{fff9}'..='\u{fffb}'
        | '\u{e0000}'..='\u{e0fff}' => text.push_str(&format!("‹U+{:04X}›", c as u32)),
        _ => text.push(c),
    }
}

/// Makes a sentence safe to print: like [`push_visible`], but keeps line breaks.
pub fn visible(text: &str) -> String {
    visible_untrimmed(text.trim_end())
}

/// Like [`visible`], but keeps trailing white space.
pub fn visible_untrimmed(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if c == '\n' { out.push(c) } else { push_visible(&mut out, c) }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;

    fn excerpt(text: &str, spans: &[(usize, usize)]) -> Excerpt {
        let mut sources = Sources::default();
        let file = sources.add(Source::new("a", text));
        let spans: Vec<Span> = spans.iter().map(|&(s, e)| Span::new(file, s, e)).collect();
        Excerpt::around(&spans, &sources, 72)
    }

    fn marked(excerpt: &Excerpt, mark: usize) -> &str {
        let (start, end, _) = excerpt.marks[mark];
        let run = excerpt.runs.iter().rev().find(|run| run.base <= start).expect("a run");
        &run.text[start - run.base..end - run.base]
    }

    #[test]
    fn only_the_lines_around_the_places_are_copied() {
        let text: String = (0..1000).map(|i| format!("line{i:04}\n")).collect();
        let cut = excerpt(&text, &[(9 * 500, 9 * 500 + 8), (9 * 10, 9 * 10 + 4)]);
        assert_eq!(cut.runs[1].text, "line0009\nline0010\nline0011\n");
        assert_eq!((cut.runs[0].first_line, cut.runs[0].text.lines().count()), (500, 3));
        assert_eq!((marked(&cut, 0), marked(&cut, 1)), ("line0500", "line"));
    }

    #[test]
    fn a_huge_line_is_cut_around_its_labels() {
        let text = format!("{}WRONG{}ALSO{}", "é".repeat(1 << 20), "é".repeat(999), "x".repeat(99));
        let at = 2 << 20;
        let cut = excerpt(&text, &[(at, at + 5), (at + 5 + 1998, at + 9 + 1998)]);
        assert!(cut.runs[0].text.len() < 400, "{}", cut.runs[0].text);
        assert_eq!((marked(&cut, 0), marked(&cut, 1)), ("WRONG", "ALSO"));
        assert_eq!(cut.marks[0].2, Position { line: 1, column: (1 << 20) + 1 });
        assert!(cut.runs[0].text.starts_with("…éé") && cut.runs[0].text.ends_with("xx…\n"));
    }

    #[test]
    fn a_label_over_a_huge_line_is_cut_to_the_room() {
        let text = "y".repeat(1 << 20);
        let cut = excerpt(&text, &[(0, 1 << 20)]);
        assert!(cut.runs[0].text.chars().count() <= 74);
        assert!(marked(&cut, 0).chars().all(|c| c == 'y') && marked(&cut, 0).len() > 20);
    }

    #[test]
    fn a_label_over_many_lines_is_cut_to_its_first() {
        let text = "union {\n".to_owned() + &"a\n".repeat(100) + "}";
        let cut = excerpt(&text, &[(6, text.len())]);
        assert_eq!(marked(&cut, 0), "{");
        assert_eq!(cut.runs[0].text, "union {\na\n");
    }

    #[test]
    fn what_cannot_be_seen_is_made_visible_and_labels_still_fit() {
        let text = "a\u{1b}[31m \u{202e}b pigmnt\n";
        let at = text.find("pigmnt").expect("there");
        let cut = excerpt(text, &[(at, at + 6)]);
        assert_eq!(cut.runs[0].text, "a␛[31m ‹U+202E›b pigmnt\n");
        assert_eq!(marked(&cut, 0), "pigmnt");
        assert_eq!(visible("a\n\tb\u{7}\n"), "a\n\tb␇");
    }

    #[test]
    fn an_empty_file_and_a_files_end_have_places() {
        assert_eq!(excerpt("", &[(0, 0)]).runs[0].text, "\n");
        let end = excerpt("a {\n", &[(4, 4)]);
        assert_eq!(end.runs[0].text, "a {\n\n");
        assert_eq!((end.marks[0].0, end.marks[0].1), (4, 4));
    }
}
