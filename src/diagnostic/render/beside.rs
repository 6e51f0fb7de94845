//! Positions the text of a label: to the right of its bar or, if it does not fit there, to the left if that
//! takes fewer rows.
//!
//! miette only supports the right side. It is given a mark in place of each text, and the marks are
//! replaced in the rows that it drew.

use super::super::cut::columns;
use super::super::wrap::{balanced, wrapped};

/// Minimum columns for a text; with less room, it is drawn over the bars of other labels.
const LEAST: usize = 10;
/// Columns between a bar and its text.
const ARM: usize = 4;

/// Returns the mark that stands in for the text of a label. It does not occur in source text that was made
/// visible.
pub fn mark(label: usize) -> String {
    format!("\u{1}{label}\u{2}")
}

/// Replaces each mark in a drawing by its text, for a window of `width` columns.
pub fn completed(drawn: &str, texts: &[String], width: usize) -> String {
    let mut text = String::new();
    for line in drawn.lines() {
        let rows = row(line, texts, width).unwrap_or_else(|| vec![line.to_owned()]);
        rows.iter().for_each(|row| text.extend([row.trim_end(), "\n"]));
    }
    text
}

/// Returns the rows that replace a row with a mark.
fn row(line: &str, texts: &[String], width: usize) -> Option<Vec<String>> {
    let (before, rest) = line.split_once('\u{1}')?;
    let (label, after) = rest.split_once('\u{2}')?;
    let text = texts.get(label.parse::<usize>().ok()?)?;
    // Where there are colours, one begins at the bar and again at the text.
    let Some(before) = before_code(before).0.strip_suffix("╰── ") else {
        return Some(below_lines(before, text, after, width));
    };
    let (left, colour) = before_code(before);
    let bar = plain(left).count();
    let free = left.len() - left.trim_end_matches(' ').len();
    let right_room = width.saturating_sub(bar + ARM);
    let left_room = free.saturating_sub(ARM);
    let wide = text.lines().map(columns).max().unwrap_or(0);
    let rows = |room: usize| match room < LEAST {
        true => usize::MAX,
        false => wrapped(text, room).len(),
    };
    let goes_right = wide <= right_room
        || (wide > left_room && right_room >= LEAST && rows(right_room) <= rows(left_room));
    if goes_right {
        let lines = balanced(text, right_room);
        let arm = |i: usize| match (i, lines.len()) {
            (0, 1) => "╰── ",
            (0, _) => "╰─┤ ",
            _ => "  │ ",
        };
        let draw = |(i, line): (usize, &String)| format!("{left}{colour}{}{line}{after}", arm(i));
        return Some(lines.iter().enumerate().map(draw).collect());
    }
    let gutter = plain(left).position(|c| c == '·').map_or(0, |at| at + 2);
    let lines = balanced(text, left_room.max(LEAST.min(bar.saturating_sub(gutter + ARM - 1))));
    let wide = lines.iter().map(|line| columns(line)).max().unwrap_or(0);
    let left = beginning(left, (bar + 1).saturating_sub(ARM + wide));
    let arm = |i: usize| match (i, lines.len()) {
        (0, 1) => " ──╯",
        (0, _) => " ├─╯",
        _ => " │",
    };
    let draw = |(i, line): (usize, &String)| {
        let pad = " ".repeat(wide - columns(line));
        format!("{left}{colour}{line}{pad}{}{after}", arm(i))
    };
    Some(lines.iter().enumerate().map(draw).collect())
}

/// Splits a row before the escape code at its end, and returns both parts.
fn before_code(row: &str) -> (&str, &str) {
    let code = row.rfind('\u{1b}').filter(|_| row.ends_with('m'));
    row.split_at(code.unwrap_or(row.len()))
}

/// Returns the rows for the text of a multi-line label, which is placed below the last of its lines.
fn below_lines(before: &str, text: &str, after: &str, width: usize) -> Vec<String> {
    let lines = balanced(text, width.saturating_sub(plain(before).count()).max(LEAST));
    let (arm, end) = before.rsplit_once('─').unwrap_or((before, ""));
    let bars = arm.replace(['╰', '─'], " ");
    let draw = |(i, line): (usize, &String)| match (i, lines.len()) {
        (0, 1) => format!("{before}{line}{after}"),
        (0, _) => format!("{arm}┤{end}{line}{after}"),
        _ => format!("{bars}│{end}{line}{after}"),
    };
    lines.iter().enumerate().map(draw).collect()
}

/// Returns the characters of a row; for each, whether it is visible rather than part of a color code.
fn seen(row: &str) -> impl Iterator<Item = (char, bool)> {
    let mut code = false;
    row.chars().map(move |c| {
        let begins = c == '\u{1b}';
        let seen = !code && !begins;
        code = begins || (code && c != 'm');
        (c, seen)
    })
}

fn plain(row: &str) -> impl Iterator<Item = char> {
    seen(row).filter(|(_, seen)| *seen).map(|(c, _)| c)
}

/// Returns the first columns of a row, with all of its color codes.
fn beginning(row: &str, count: usize) -> String {
    let mut kept = 0;
    let keep = |&(_, seen): &(char, bool)| {
        kept += usize::from(seen);
        !seen || kept <= count
    };
    seen(row).filter(keep).map(|(c, _)| c).collect()
}
