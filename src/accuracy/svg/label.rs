//! Places labels in a diagram next to their points, without overlaps.
//!
//! **Invariant:** a placed box lies in the frame and overlaps no marker and no other label; labels that do
//! not fit anywhere are omitted. The same input gives the same positions.
//!
//! **Source:** greedy choice among candidate positions in order of increasing badness, one label after the
//! other: J. Christensen, J. Marks, S. Shieber, "An empirical study of algorithms for point-feature label
//! placement", ACM TOG 14, 1995, §3.1.

/// An axis-aligned rectangle; y points down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Rectangle {
    /// Returns the square with half width `reach` around a point.
    pub fn about((x, y): (f64, f64), reach: f64) -> Self {
        Self { left: x - reach, top: y - reach, right: x + reach, bottom: y + reach }
    }

    pub fn meets(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    pub fn holds(&self, other: &Self) -> bool {
        self.left <= other.left
            && self.top <= other.top
            && self.right >= other.right
            && self.bottom >= other.bottom
    }

    /// Returns the point of the rectangle nearest to the given one.
    pub fn nearest(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (x.clamp(self.left, self.right), y.clamp(self.top, self.bottom))
    }

    /// Whether a line segment passes through the rectangle (Liang–Barsky clipping).
    fn is_crossed(&self, (from, to): Line) -> bool {
        let (mut enters, mut leaves) = (0.0f64, 1.0f64);
        let sides = [(from.0, to.0, self.left, self.right), (from.1, to.1, self.top, self.bottom)];
        for (from, to, low, high) in sides {
            let way = to - from;
            if way == 0.0 {
                if from <= low || from >= high {
                    return false;
                }
                continue;
            }
            let (a, b) = ((low - from) / way, (high - from) / way);
            (enters, leaves) = (enters.max(a.min(b)), leaves.min(a.max(b)));
        }
        enters < leaves
    }
}

/// Line segment between two points.
pub type Line = ((f64, f64), (f64, f64));

/// Content of the diagram.
#[derive(Debug, Clone)]
pub struct Layout {
    /// Area that labels must not leave.
    pub frame: Rectangle,
    /// Areas that labels must not overlap: markers, and the labels placed so far.
    pub taken: Vec<Rectangle>,
    /// Lines that labels should avoid.
    pub lines: Vec<Line>,
}

/// Height of a label's box above and below the baseline, relative to the font size.
const ABOVE: f64 = 0.8;
const BELOW: f64 = 0.25;
/// Distances between a point and its label, in the order in which they are tried.
const DISTANCES: [f64; 10] = [9.0, 12.0, 17.0, 24.0, 33.0, 45.0, 60.0, 80.0, 105.0, 135.0];
/// Directions from best to worst: the best is to the right and above, away from the front.
const DIRECTIONS: [(f64, f64); 16] = [
    (0.7, -0.7),
    (1.0, 0.0),
    (0.9, -0.4),
    (0.4, -0.9),
    (0.0, -1.0),
    (0.7, 0.7),
    (0.9, 0.4),
    (-0.7, -0.7),
    (-0.4, -0.9),
    (-1.0, 0.0),
    (-0.9, -0.4),
    (-0.7, 0.7),
    (0.0, 1.0),
    (0.4, 0.9),
    (-0.4, 0.9),
    (-0.9, 0.4),
];
/// Cost of a line under a label, in units of distance.
const CROSSED: f64 = 14.0;
const HIDDEN: f64 = 40.0;

/// Part of a text that its position refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    Start,
    Middle,
    End,
}

impl Side {
    /// Returns the fraction of the text that lies before its position.
    fn part(self) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::Middle => 0.5,
            Self::End => 1.0,
        }
    }
}

/// Returns the position on the baseline of a text of `size` with the given box.
pub fn baseline(of: &Rectangle, side: Side, size: f64) -> (f64, f64) {
    (of.left + side.part() * (of.right - of.left), of.top + ABOVE * size)
}

/// Returns the box of a text at `(x, y)`.
pub fn text_box(text: &str, size: f64, side: Side, (x, y): (f64, f64)) -> Rectangle {
    let wide = width(text, size);
    let left = x - side.part() * wide;
    Rectangle { left, top: y - ABOVE * size, right: left + wide, bottom: y + BELOW * size }
}

impl Layout {
    /// Finds a position for a text next to a point, and marks it as taken.
    pub fn place(&mut self, text: &str, size: f64, (x, y): (f64, f64)) -> Option<Rectangle> {
        let (wide, high) = (width(text, size), (ABOVE + BELOW) * size);
        let mut best: Option<(f64, Rectangle)> = None;
        for distance in DISTANCES {
            for (rank, (dx, dy)) in DIRECTIONS.into_iter().enumerate() {
                let left = x + dx * distance - (1.0 - dx) / 2.0 * wide;
                let top = y + dy * distance - (1.0 - dy) / 2.0 * high;
                let place = Rectangle { left, top, right: left + wide, bottom: top + high };
                if !self.frame.holds(&place) || self.taken.iter().any(|taken| taken.meets(&place)) {
                    continue;
                }
                let under = self.lines.iter().filter(|&&line| place.is_crossed(line)).count();
                let leader = ((x, y), place.nearest((x, y)));
                let own = Rectangle::about((x, y), 1.0);
                let strangers = self.taken.iter().filter(|taken| !taken.meets(&own));
                let hidden = strangers.filter(|taken| taken.is_crossed(leader)).count();
                let badness =
                    distance + 0.8 * rank as f64 + CROSSED * under as f64 + HIDDEN * hidden as f64;
                if best.is_none_or(|(least, _)| badness < least) {
                    best = Some((badness, place));
                }
            }
        }
        let (_, place) = best?;
        self.taken.push(place);
        Some(place)
    }
}

/// Returns the approximate maximum width of a text: the advances of Helvetica, plus a seventh for wider
/// fonts.
///
/// **Source:** Adobe Font Metrics of Helvetica, in thousandths of the font size.
pub fn width(text: &str, size: f64) -> f64 {
    let advance = |letter: char| match letter {
        'i' | 'j' | 'l' | '\'' | '’' => 222.0,
        ' ' | '.' | ',' | ':' | ';' | '!' | '|' | '/' | 't' | 'f' | 'I' | '[' | ']' => 278.0,
        'r' | '-' | '(' | ')' => 333.0,
        'c' | 'k' | 's' | 'v' | 'x' | 'y' | 'z' | 'J' => 500.0,
        'm' | 'M' => 833.0,
        'w' | 'A' | 'B' | 'E' | 'K' | 'P' | 'S' | 'V' | 'X' | 'Y' => 722.0,
        'C' | 'D' | 'G' | 'H' | 'N' | 'O' | 'Q' | 'R' | 'U' => 778.0,
        'a'..='z' | '0'..='9' | 'F' | 'L' | 'T' | 'Z' | '×' | '+' | '=' | '<' | '>' => 611.0,
        'W' | '%' | '…' | '@' => 1015.0,
        letter if letter.is_ascii() => 611.0,
        _ => 1015.0,
    };
    text.chars().map(advance).sum::<f64>() * 1.15 * size / 1000.0
}

/// Truncates a text to the available width.
pub fn fitted(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let mut kept = String::new();
    for letter in text.chars() {
        if width(&kept, size) + width(&format!("{letter}…"), size) > room {
            break;
        }
        kept.push(letter);
    }
    kept + "…"
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Rectangle = Rectangle { left: 0.0, top: 0.0, right: 300.0, bottom: 200.0 };

    fn empty() -> Layout {
        Layout { frame: FRAME, taken: Vec::new(), lines: Vec::new() }
    }

    #[test]
    fn a_lonely_label_stands_above_and_to_the_right_unless_it_would_leave_the_frame() {
        let beside = |point: (f64, f64)| empty().place("2×2", 10.0, point).expect("a place");
        let place = beside((100.0, 100.0));
        assert!(place.left > 100.0 && place.bottom < 100.0);
        let place = beside((299.0, 1.0));
        assert!(place.right < 299.0 && place.top > 1.0);
    }

    #[test]
    fn what_is_taken_stays_free_and_a_full_frame_takes_no_label() {
        let mut layout = empty();
        layout.taken.push(Rectangle::about((150.0, 100.0), 5.0));
        let mut placed = 0;
        while layout.place("antialias 3×3", 11.0, (150.0, 100.0)).is_some() {
            placed += 1;
        }
        assert!((4..100).contains(&placed), "{placed}");
        for (i, a) in layout.taken.iter().enumerate() {
            assert!(FRAME.holds(a) && layout.taken[..i].iter().all(|b| !a.meets(b)));
        }
    }

    #[test]
    fn a_line_is_avoided_while_that_costs_little() {
        let mut layout = empty();
        layout.lines.push(((100.0, 100.0), (300.0, 0.0)));
        layout.lines.push(((100.0, 100.0), (300.0, 100.0)));
        let place = layout.place("depth 2", 10.0, (100.0, 100.0)).expect("a place");
        assert!(layout.lines.iter().all(|&line| !place.is_crossed(line)), "{place:?}");
        let across = ((0.0, 50.0), (300.0, 60.0));
        assert!(Rectangle::about((150.0, 55.0), 2.0).is_crossed(across));
        assert!(!Rectangle::about((150.0, 65.0), 2.0).is_crossed(across));
        assert!(!Rectangle::about((310.0, 60.0), 2.0).is_crossed(across));
    }

    #[test]
    fn a_text_that_is_too_long_loses_its_end() {
        assert_eq!(fitted("first.scene", 10.0, 100.0), "first.scene");
        let cut = fitted(&"a long name ".repeat(30), 10.0, 100.0);
        assert!(cut.ends_with('…') && width(&cut, 10.0) <= 100.0 && cut.len() > 12, "{cut}");
    }
}
