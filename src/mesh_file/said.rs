//! Error messages for lines that cannot be read: what was expected and what was found.
//!
//! The parser crates report that a line is wrong, but not what was expected; that follows from the preceding
//! lines.

/// Maximum number of characters of a line to show.
const MOST_SHOWN: usize = 40;

/// A line of a file, counted from 1, trimmed; `None` past the end.
fn line(bytes: &[u8], number: usize) -> Option<String> {
    let mut rest = bytes.split(|byte| *byte == b'\n').skip(number.checked_sub(1)?);
    let line = String::from_utf8_lossy(rest.next()?).trim().to_owned();
    (!line.is_empty() || rest.next().is_some()).then_some(line)
}

/// Returns `found …`, quoting the text.
pub fn found(text: &str) -> String {
    let text = text.trim();
    let is_text = |c: char| !c.is_control() && c != char::REPLACEMENT_CHARACTER || c == '\t';
    match text.chars().nth(MOST_SHOWN) {
        _ if text.is_empty() => "found an empty line".to_owned(),
        _ if !text.chars().all(is_text) => "found bytes that are no text".to_owned(),
        None => format!("found `{text}`"),
        Some(_) => format!("found `{}…`", text.chars().take(MOST_SHOWN).collect::<String>()),
    }
}

/// Returns the message for a line of an STL file, according to its position.
pub fn of_stl(bytes: &[u8], number: usize) -> String {
    let (mut last, mut corners) = (String::new(), 0);
    let before = bytes.split(|byte| *byte == b'\n').take(number.saturating_sub(1));
    for line in before {
        let line = String::from_utf8_lossy(line).to_lowercase();
        let Some(word) = line.split_whitespace().next() else { continue };
        corners = if word == "vertex" { corners + 1 } else { 0 };
        word.clone_into(&mut last);
    }
    let wanted = match last.as_str() {
        "solid" | "endfacet" => "`facet normal` with three finite numbers, or `endsolid`",
        "facet" => "`outer loop`",
        "vertex" if corners >= 3 => "`endloop`",
        "outer" | "vertex" => "`vertex` with three finite numbers",
        "endloop" => "`endfacet`",
        _ => "`solid`",
    };
    let found = line(bytes, number).map_or("found its end".to_owned(), |line| found(&line));
    format!("expected {wanted}, {found}")
}

/// Returns the message for a line of a PLY header.
pub fn of_ply_head(bytes: &[u8], number: usize) -> String {
    let Some(text) = line(bytes, number) else {
        return "the file ends before `end_header`".to_owned();
    };
    let head = bytes.split(|byte| *byte == b'\n').take(number.saturating_sub(1));
    let is_before =
        |word: &str| head.clone().any(|line| line.trim_ascii_start().starts_with(word.as_bytes()));
    let wanted = match text.split_whitespace().next().unwrap_or("") {
        _ if number == 1 => "`ply`",
        "end_header" if is_before("format") => return "its `format` has no version".to_owned(),
        "end_header" => return "its head has no `format`".to_owned(),
        "format" if is_before("format") => return "its head has a second `format`".to_owned(),
        "format" => {
            "`format ascii 1.0`, `format binary_little_endian 1.0` or `format binary_big_endian 1.0`"
        }
        "element" => "`element` with a name and how many there are",
        "property" if !is_before("element") => {
            return "this `property` is of no `element`: one comes before it".to_owned();
        }
        "property" => {
            "`property` with a type and a name, or `property list` with two types and a name (types \
             are char, uchar, short, ushort, int, uint, float, double)"
        }
        _ => "`element`, `property`, `comment` or `end_header`",
    };
    format!("expected {wanted}, {}", found(&text))
}

/// Returns the message for a line that should contain numbers with these names; `what` names it, such as
/// `vertex 2`.
pub fn of_numbers(what: &str, names: &str, bytes: &[u8], number: usize) -> String {
    match line(bytes, number) {
        Some(text) => format!("{what}: expected numbers, {names}; {}", found(&text)),
        None => format!("the file ends before {what}"),
    }
}
