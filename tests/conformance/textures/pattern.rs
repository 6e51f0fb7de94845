//! Draws patterns with their parameters, and what a block says about a pattern: waves, turbulence, warps.

use std::fmt::Write as _;

use super::surface::pigment;
use crate::conformance::drawn::draw::{Draw, GRID, PICTURES};

/// What a pattern is for.
#[derive(Clone, Copy, PartialEq)]
pub enum Of {
    Pigment,
    Normal,
    Texture,
}

/// A pattern.
pub struct Pattern {
    /// Its word and what must follow it directly.
    pub head: String,
    /// Its parameters, written after its map.
    pub parameters: String,
    /// The number of items, if it takes a list.
    pub list: Option<usize>,
}

const PLAIN: [&str; 20] = [
    "boxed",
    "bozo",
    "spotted",
    "bumps",
    "cells",
    "cylindrical",
    "dents",
    "granite",
    "leopard",
    "marble",
    "onion",
    "planar",
    "radial",
    "ripples",
    "spherical",
    "waves",
    "wood",
    "wrinkles",
    "aoi",
    "crackle",
];
const LISTS: [(&str, usize); 6] =
    [("brick", 2), ("checker", 2), ("cubic", 6), ("hexagon", 3), ("square", 4), ("triangular", 6)];
/// The numbers of pavements, by the number of cells in a tile.
const PAVEMENTS: [(usize, &[usize]); 3] =
    [(3, &[1, 1, 1, 3, 4, 12]), (4, &[1, 1, 2, 5, 12, 35]), (6, &[1, 1, 3, 7, 22])];
const FUNCTIONS: [&str; 6] = [
    "sin(4*x)*0.5 + 0.5",
    "abs(x*y) + z*0.3",
    "mod(abs(x) + abs(y*2) + abs(z), 1)",
    "sqrt(x*x + y*y + z*z)",
    "x*x - y*z",
    "max(sin(5*x), cos(3*y)*z)*0.5 + 0.4",
];

impl Draw {
    pub fn pattern(&mut self, of: Of) -> Pattern {
        let plain =
            |head: &str| Pattern { head: head.to_owned(), parameters: String::new(), list: None };
        if self.chance(22) {
            let (word, count) = self.dice.one_of(&LISTS);
            let parameters = match word {
                "brick" => self.brick(),
                _ => String::new(),
            };
            return Pattern { head: word.to_owned(), parameters, list: Some(count) };
        }
        if of == Of::Normal && self.chance(6) {
            let size = self.number(0.1, 1.0);
            return plain(&format!("facets {} {size}", self.word(&["coords", "size"])));
        }
        if self.chance(35) {
            return self.with_parameters(of);
        }
        let word = self.word(&PLAIN);
        let is_view = word == "aoi" && (of == Of::Normal || self.in_blend);
        plain(if is_view { "bumps" } else { word })
    }

    fn brick(&mut self) -> String {
        let size = self.maybe(60, |draw| format!(" brick_size {}", draw.vector(0.5, 3.0)));
        let mortar = self.maybe(60, |draw| format!(" mortar {}", draw.number(0.02, 0.4)));
        size + &mortar
    }

    fn with_parameters(&mut self, of: Of) -> Pattern {
        let (head, parameters) = match self.dice.below(18) {
            0 => (
                "agate".to_owned(),
                self.maybe(60, |d| format!(" agate_turb {}", d.number(0.0, 1.5))),
            ),
            1 | 2 => ("crackle".to_owned(), self.crackle()),
            3 => {
                let interpolate = self.dice.one_of(&[0, 1, 2]);
                (format!("density_file df3 \"{GRID}\""), format!(" interpolate {interpolate}"))
            }
            // Both refuse it in a texture.
            4 if of != Of::Texture => {
                (format!("function {{ {} }}", self.word(&FUNCTIONS)), String::new())
            }
            4..=6 => (format!("gradient {}", self.direction()), String::new()),
            7 => (format!("image_pattern {{ {} }}", self.picture(true)), String::new()),
            8 => {
                let c = self.complex();
                (format!("julia {c}, {}", self.whole(5, 40)), self.fractal(true))
            }
            9 => (format!("mandel {}", self.whole(5, 40)), self.fractal(true)),
            10 => {
                let kind = self.whole(1, 2);
                match self.chance(50) {
                    true => {
                        (format!("magnet {kind} mandel {}", self.whole(5, 40)), self.fractal(false))
                    }
                    false => {
                        let c = self.complex();
                        (
                            format!("magnet {kind} julia {c}, {}", self.whole(5, 40)),
                            self.fractal(false),
                        )
                    }
                }
            }
            11 => ("pavement".to_owned(), self.pavement()),
            12 => {
                let inner = pigment(self, false);
                (format!("pigment_pattern {{ {inner} }}"), String::new())
            }
            13 => {
                let controls = self.maybe(60, |d| {
                    format!(" control0 {} control1 {}", d.number(0.0, 1.0), d.number(0.0, 1.0))
                });
                ("quilted".to_owned(), controls)
            }
            14 if !self.in_blend => (self.slope(), String::new()),
            15 => (format!("spiral1 {}", self.whole(1, 6)), String::new()),
            16 => (format!("spiral2 {}", self.whole(1, 6)), String::new()),
            // With 1, a negative amount behind it would make a number below 1.
            _ => (format!("tiling {}", self.whole(2, 24)), String::new()),
        };
        Pattern { head, parameters, list: None }
    }

    fn crackle(&mut self) -> String {
        let mut text = String::new();
        if self.chance(50) {
            let _ = write!(text, " form {}", self.vector(-1.0, 1.0));
        }
        if self.chance(40) {
            let _ = write!(text, " metric {}", self.dice.one_of(&[1.0, 1.5, 2.0, 3.0, 4.0]));
        }
        if self.chance(30) {
            let _ = write!(text, " offset {}", self.number(0.0, 1.0));
        }
        text + if self.chance(30) { " solid" } else { "" }
    }

    fn complex(&mut self) -> String {
        format!("<{}, {}>", self.number(-0.9, 0.5), self.number(-0.8, 0.8))
    }

    fn fractal(&mut self, has_exponent: bool) -> String {
        let mut text = String::new();
        if has_exponent && self.chance(30) {
            let _ = write!(text, " exponent {}", self.whole(2, 5));
        }
        if self.chance(40) {
            let _ = write!(text, " exterior {}, {}", self.whole(0, 6), self.number(0.1, 1.5));
        }
        if self.chance(40) {
            let _ = write!(text, " interior {}, {}", self.whole(0, 6), self.number(0.1, 1.5));
        }
        text
    }

    fn pavement(&mut self) -> String {
        let (sides, counts) = self.dice.one_of(&PAVEMENTS);
        let cells = self.whole(1, counts.len());
        let pattern = self.whole(1, counts[cells - 1]);
        let mut text =
            format!(" number_of_sides {sides} number_of_tiles {cells} pattern {pattern}");
        if self.chance(60) {
            let [exterior, interior] = [0; 2].map(|_| self.whole(0, 2));
            let _ =
                write!(text, " exterior {exterior} interior {interior} form {}", self.whole(0, 2));
        }
        text
    }

    fn slope(&mut self) -> String {
        let direction = self.direction();
        match self.chance(50) {
            true => format!("slope {direction}"),
            false => {
                let [low, high] = [self.number(0.0, 0.4), self.number(0.5, 1.0)];
                let altitude = self.maybe(50, |d| {
                    format!(
                        " altitude {}, {}, {}",
                        d.axis(),
                        d.number(-1.0, 0.0),
                        d.number(0.5, 1.5)
                    )
                });
                format!("slope {{ {direction}, {low}, {high}{altitude} }}")
            }
        }
    }

    /// Returns the inside of a `material_map`, without its textures.
    pub fn whole_picture(&mut self) -> String {
        let name = self.word(&PICTURES);
        let kind = self.maybe(40, |d| format!(" map_type {}", d.dice.one_of(&[0, 1, 2, 5])));
        let once = if self.has_once && self.chance(50) { " once" } else { "" };
        format!("png \"{name}\"{kind}{once}")
    }

    /// Returns the inside of an `image_map` or the like.
    pub fn picture(&mut self, is_pattern: bool) -> String {
        let mut text = self.whole_picture();
        if self.chance(40) {
            let _ = write!(text, " interpolate {}", self.dice.one_of(&[2, 4]));
        }
        if is_pattern && self.chance(30) {
            text += self.word(&[" use_color", " use_alpha"]);
        }
        text
    }

    /// Returns what may follow the map of a pattern. Sizes are near `size`.
    pub fn modifiers(&mut self, size: f64) -> String {
        let mut parts = Vec::new();
        if self.chance(30) {
            parts.push(self.turbulence());
        }
        if self.chance(20) {
            parts.push(format!("frequency {}", self.number(-2.0, 4.0)));
        }
        if self.chance(15) {
            parts.push(format!("phase {}", self.number(-1.0, 1.0)));
        }
        if self.chance(30) {
            parts.push(match self.dice.below(7) {
                0 => format!("poly_wave {}", self.number(0.3, 3.0)),
                1 => "ramp_wave".to_owned(),
                2 | 3 => "triangle_wave".to_owned(),
                4 => "sine_wave".to_owned(),
                5 => "scallop_wave".to_owned(),
                _ => "cubic_wave".to_owned(),
            });
        }
        if !self.is_default && self.chance(10) {
            parts.push(format!("noise_generator {}", self.whole(1, 3)));
        }
        if self.chance(80) {
            parts.push(self.transforms(size));
        }
        if self.chance(15) {
            parts.push(self.warp());
            if self.chance(40) {
                parts.push(self.transforms(1.0));
            }
        }
        if self.chance(4) {
            parts.push(self.warp());
        }
        // The wave and turbulence may come anywhere.
        if parts.len() > 1 && self.chance(30) {
            let first = parts.remove(0);
            parts.push(first);
        }
        parts.iter().map(|part| format!(" {}", part.trim())).collect()
    }

    fn turbulence(&mut self) -> String {
        let amount = match self.chance(70) {
            true => format!("{}", self.number(0.05, 1.0)),
            false => self.vector(0.0, 0.8),
        };
        let octaves = self.maybe(30, |d| format!(" octaves {}", d.whole(1, 8)));
        let lambda = self.maybe(20, |d| format!(" lambda {}", d.number(1.5, 3.0)));
        let omega = self.maybe(20, |d| format!(" omega {}", d.number(0.2, 0.8)));
        format!("turbulence {amount}{octaves}{lambda}{omega}")
    }

    fn warp(&mut self) -> String {
        let inside = match self.dice.below(8) {
            0 => {
                let axis = self.axis();
                let mut text = format!("repeat {}*{axis}", self.number(0.5, 1.5));
                if self.chance(40) {
                    let _ = write!(text, " offset {}", self.vector(-0.5, 0.5));
                }
                if self.chance(40) {
                    let _ = write!(
                        text,
                        " flip {}",
                        self.word(&["x", "y", "z", "<1, 1, 0>", "<1, 0, 1>"])
                    );
                }
                text
            }
            1 => {
                let centre = self.vector(-0.7, 0.7);
                let mut text = format!("black_hole {centre}, {}", self.number(0.3, 1.2));
                if self.chance(60) {
                    let _ = write!(text, " strength {}", self.number(0.2, 1.5));
                }
                if self.chance(50) {
                    let _ = write!(text, " falloff {}", self.number(0.5, 3.0));
                }
                if self.chance(20) {
                    let _ = write!(text, " repeat {}", self.vector(0.8, 2.0));
                }
                text + if self.chance(30) { " inverse" } else { "" }
            }
            2 => self.turbulence(),
            3 => format!("planar {}, {}", self.direction(), self.number(-0.5, 0.5)),
            4 => "cubic".to_owned(),
            kind => {
                let word = ["cylindrical", "spherical", "toroidal"][kind - 5];
                let mut text = word.to_owned();
                if self.chance(50) {
                    let _ = write!(text, " orientation {}", self.axis());
                }
                if self.chance(40) {
                    let _ = write!(text, " dist_exp {}", self.dice.one_of(&[0.0, 0.5, 1.0, 2.0]));
                }
                if word == "toroidal" && self.chance(60) {
                    let _ = write!(text, " major_radius {}", self.number(0.4, 1.2));
                }
                text
            }
        };
        format!("warp {{ {inside} }}")
    }
}
