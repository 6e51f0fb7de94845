//! Draws numbers, vectors, colours, transforms and lists, as text of the scene language.

use std::fmt::Write as _;

use crate::dice::Dice;

/// The files that scenes read; `files.rs` writes them.
pub const PICTURES: [&str; 3] = ["color.png", "palette.png", CLEAR];
/// A picture with alpha.
pub const CLEAR: &str = "clear.png";
pub const GRID: &str = "grid.df3";

/// What scenes are drawn with.
pub struct Draw {
    pub dice: Dice,
    /// Number of blocks that the current one is in.
    pub depth: usize,
    /// Pictures may be shown once; then no finish has `conserve_energy`.
    pub has_once: bool,
    /// The current block is in a blend of textures.
    pub in_blend: bool,
    /// The current block is in `#default`.
    pub is_default: bool,
}

impl Draw {
    /// Starts the draw of a number.
    pub fn new(number: u64) -> Self {
        let mut draw = Self {
            dice: Dice(number),
            depth: 0,
            has_once: false,
            in_blend: false,
            is_default: false,
        };
        draw.has_once = draw.chance(40);
        draw
    }

    /// Returns true `percent` times in a hundred.
    pub fn chance(&mut self, percent: usize) -> bool {
        self.dice.below(100) < percent
    }

    /// Returns the text `percent` times in a hundred, and otherwise none.
    pub fn maybe(&mut self, percent: usize, text: impl FnOnce(&mut Self) -> String) -> String {
        if self.chance(percent) { text(self) } else { String::new() }
    }

    pub fn word(&mut self, words: &[&'static str]) -> &'static str {
        self.dice.one_of(words)
    }

    /// Returns a number with three digits after the point.
    pub fn number(&mut self, low: f64, high: f64) -> f64 {
        (self.dice.between(low, high) * 1000.0).round() / 1000.0
    }

    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        low + self.dice.below(high - low + 1)
    }

    pub fn vector(&mut self, low: f64, high: f64) -> String {
        let [x, y, z] = [0; 3].map(|_| self.number(low, high));
        format!("<{x}, {y}, {z}>")
    }

    pub fn axis(&mut self) -> &'static str {
        self.word(&["x", "y", "z"])
    }

    /// Returns a direction, often an axis.
    pub fn direction(&mut self) -> String {
        match self.chance(50) {
            true => self.axis().to_owned(),
            false => {
                let main = self.number(0.4, 1.0);
                let [a, b] = [0; 2].map(|_| self.number(-1.0, 1.0));
                match self.dice.below(3) {
                    0 => format!("<{main}, {a}, {b}>"),
                    1 => format!("<{a}, {main}, {b}>"),
                    _ => format!("<{a}, {b}, {main}>"),
                }
            }
        }
    }

    /// Returns a colour that lets no light through.
    pub fn solid_color(&mut self) -> String {
        match self.chance(15) {
            true => format!("rgb {}", self.number(0.0, 1.0)),
            false => format!("rgb {}", self.vector(0.0, 1.0)),
        }
    }

    /// Returns a colour that lets light through.
    pub fn clear_color(&mut self) -> String {
        let [r, g, b, part] = [0; 4].map(|_| self.number(0.0, 1.0));
        match self.dice.below(4) {
            0 => format!("rgbf <{r}, {g}, {b}, {part}>"),
            1 => format!("rgbt <{r}, {g}, {b}, {part}>"),
            2 => {
                let rest = self.number(0.0, 1.0 - part);
                format!("rgbft <{r}, {g}, {b}, {part}, {rest}>")
            }
            _ => "rgbt 1".to_owned(),
        }
    }

    pub fn color(&mut self, is_clear: bool) -> String {
        if is_clear && self.chance(50) { self.clear_color() } else { self.solid_color() }
    }

    /// Returns transforms; sizes are near `size`.
    pub fn transforms(&mut self, size: f64) -> String {
        let mut text = String::new();
        if self.chance(75) {
            let _ = match self.chance(70) {
                true => write!(text, " scale {}", self.number(0.6 * size, 1.5 * size)),
                false => write!(text, " scale {}", self.vector(0.5 * size, 1.7 * size)),
            };
        }
        if self.chance(40) {
            let _ = match self.chance(50) {
                true => write!(text, " rotate {}*{}", self.whole(1, 359), self.axis()),
                false => write!(text, " rotate {}", self.vector(-180.0, 180.0)),
            };
        }
        if self.chance(40) {
            let _ = write!(text, " translate {}", self.vector(-1.0, 1.0));
        }
        if self.chance(5) {
            let numbers: Vec<String> = (0..9)
                .map(|i| self.number(-0.3, 0.3) + f64::from(i % 4 == 0))
                .map(|n| format!("{n:.3}"))
                .collect();
            let _ = write!(text, " matrix <{}, 0, 0, 0>", numbers.join(", "));
        }
        text
    }

    /// Returns positions from 0 to 1, rising.
    fn positions(&mut self, count: usize) -> Vec<f64> {
        let mut positions: Vec<f64> = (0..count).map(|_| self.number(0.0, 1.0)).collect();
        positions.sort_by(f64::total_cmp);
        if self.chance(60) {
            positions[0] = 0.0;
            positions[count - 1] = 1.0;
        }
        if count > 2 && self.chance(20) {
            positions[1] = positions[2];
        }
        positions
    }

    /// Returns the entries of a map, whose contents are drawn by `entry`.
    pub fn entries(&mut self, most: usize, mut entry: impl FnMut(&mut Self) -> String) -> String {
        let count = self.whole(2, most);
        let positions = self.positions(count);
        let entries: Vec<String> =
            positions.into_iter().map(|at| format!("[{at} {}]", entry(self))).collect();
        entries.join(" ")
    }
}
