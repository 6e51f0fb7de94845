//! Scenes with plain parts in place of some of theirs: `pigment NAME` and `texture NAME` become plain ones, where
//! NAME stands in them and in no smaller one; `normal NAME`, `layer NAME`, a texture above another, and `bound NAME`,
//! a `bounded_by`, are left out.

use std::ops::Range;

const PLAIN: &str = "pigment { rgb <0.8, 0.6, 0.4> }";

/// The text with blanks for its comments, as long as before.
fn without_comments(text: &str) -> String {
    let mut text = text.as_bytes().to_vec();
    for (start, end) in [(&b"//"[..], &b"\n"[..]), (b"/*", b"*/")] {
        let mut place = 0;
        while let Some(found) = find(&text[place..], start) {
            let from = place + found;
            place = find(&text[from..], end).map_or(text.len(), |length| from + length + end.len());
            text[from..place].iter_mut().for_each(|byte| *byte = b' ');
        }
    }
    String::from_utf8_lossy(&text).into_owned()
}

fn find(text: &[u8], what: &[u8]) -> Option<usize> {
    text.windows(what.len()).position(|window| window == what)
}

/// The places of a word.
fn places<'a>(text: &'a str, word: &'a str) -> impl Iterator<Item = usize> + 'a {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word).map(|(place, _)| place).filter(move |&place| {
        !text[..place].ends_with(is_part) && !text[place + word.len()..].starts_with(is_part)
    })
}

/// The smallest block that this word opens and that holds the place.
fn block(text: &str, word: &str, place: usize) -> Option<Range<usize>> {
    let begun = places(text, word).take_while(|&start| start <= place);
    let opened = begun.filter_map(|start| {
        let mut depth = 0;
        let body = start + text[start..].find('{')?;
        let end = text[body..].char_indices().find(|&(_, c)| {
            depth += i32::from(c == '{') - i32::from(c == '}');
            depth == 0
        });
        let block = start..body + end?.0 + 1;
        block.contains(&place).then_some(block)
    });
    opened.last()
}

/// The scene with those items made plain.
pub(crate) fn plain(text: &str, items: &[(&str, &str)]) -> Result<String, String> {
    let mut text = without_comments(text);
    for &(kind, name) in items {
        let (word, plain) = match kind {
            "pigment" => ("pigment", PLAIN.to_owned()),
            "texture" => ("texture", format!("texture {{ {PLAIN} }}")),
            "layer" => ("texture", String::new()),
            "normal" => ("normal", String::new()),
            "bound" => ("bounded_by", String::new()),
            _ => return Err(format!("`{kind}` is nothing to be made plain")),
        };
        let mut is_found = false;
        let item = |text: &str| places(text, name).find_map(|place| block(text, word, place));
        while let Some(item) = item(&text) {
            text.replace_range(item, &plain);
            is_found = true;
        }
        if !is_found {
            return Err(format!("there is no {kind} with {name}"));
        }
    }
    Ok(text)
}

#[test]
fn the_smallest_item_with_the_name_is_made_plain() {
    let text = "sphere { 0, 1 texture { pigment { wood scale 2 } normal { bumps } } } // wood {\n";
    let made = |kind, name| plain(text, &[(kind, name)]).map(|made| made.trim().to_owned());
    let sphere = |inner: &str| Ok(format!("sphere {{ 0, 1 {inner} }}"));
    let bumps = "normal { bumps }";
    assert_eq!(made("pigment", "wood"), sphere(&format!("texture {{ {PLAIN} {bumps} }}")));
    assert_eq!(made("texture", "bumps"), sphere(&format!("texture {{ {PLAIN} }}")));
    assert_eq!(made("normal", "bumps"), sphere("texture { pigment { wood scale 2 }  }"));
    assert!(made("normal", "wood").is_err());
}
