//! Solids made at random of others whose faces coincide, exactly or to a rounding.
//!
//! **In:** seeds. **Out:** scenes of size 1 for the exact tracer; texts that spell their numbers in other
//! ways, take detours, and stand anywhere in any size, for lucarne. **Invariant:** parts take their edges
//! from those of others, so that most faces lie in one plane, round, or ball with some other's.

use std::fmt::Write;

use super::held::Truth;
use super::scene::{
    Camera, Light, Object, Operation, Scene, Solid, Step, Triple, WHITE, cone, cuboid, plane,
    sphere, ten, torus, whole,
};
use crate::dice::Dice;

/// Odd, so that some rays go along faces.
const SIZE: (u32, u32) = (25, 19);
const PLACES: [f64; 7] = [-1.0, -0.7, -0.3, 0.0, 0.3, 0.6, 1.0];
const RADII: [f64; 4] = [0.3, 0.6, 0.7, 1.0];
const PAINTS: [Triple; 6] = [
    [0.9, 0.2, 0.2],
    [0.2, 0.9, 0.2],
    [0.3, 0.3, 1.0],
    [0.9, 0.9, 0.2],
    [0.9, 0.3, 0.9],
    [0.2, 0.9, 0.9],
];

/// What is alike in a scene's parts.
#[derive(Clone, Copy, PartialEq)]
enum Stuff {
    /// It glows, and is seen as it is painted.
    Bright,
    /// Lit by a lamp, with shadows.
    Lit,
    /// Let through, straight or bent.
    Clear { ior: f64 },
}

/// Draws parts; what was drawn before lends them its edges.
struct Carver {
    dice: Dice,
    stuff: Stuff,
    /// Along each axis.
    edges: [Vec<f64>; 3],
    /// Whole solids that may come again.
    drawn: Vec<Solid>,
}

impl Carver {
    fn place(&mut self, axis: usize) -> f64 {
        let known = self.edges[axis].len();
        match known > 0 && self.dice.below(3) > 0 {
            true => self.edges[axis][self.dice.below(known)],
            false => self.dice.one_of(&PLACES),
        }
    }

    /// Two places, the lower first.
    fn range(&mut self, axis: usize) -> [f64; 2] {
        loop {
            let (a, b) = (self.place(axis), self.place(axis));
            if a != b {
                return [a.min(b), a.max(b)];
            }
        }
    }

    fn solid(&mut self) -> Solid {
        if !self.drawn.is_empty() && self.dice.below(6) == 0 {
            let again = self.dice.below(self.drawn.len());
            return self.drawn[again].clone();
        }
        let solid = match self.dice.below(10) {
            0..=3 => {
                let [x, y, z] = [0, 1, 2].map(|axis| self.range(axis));
                Solid::Box { corners: [[x[0], y[0], z[0]], [x[1], y[1], z[1]]] }
            }
            4..=7 => {
                let axis = self.dice.below(3);
                let mut centre = [0, 1, 2].map(|axis| self.place(axis));
                if self.dice.below(2) == 0 {
                    centre = [0.0; 3];
                }
                let [low, high] = self.range(axis);
                let (mut a, mut b) = (centre, centre);
                (a[axis], b[axis]) = (low, high);
                let base = self.dice.one_of(&RADII);
                let cap = match self.dice.below(3) {
                    0 => self.dice.one_of(&RADII),
                    1 if self.dice.below(2) == 0 => 0.0,
                    _ => base,
                };
                Solid::Cone { ends: [a, b], radii: [base, cap] }
            }
            8 if self.dice.below(3) == 0 => {
                let [major, minor] =
                    [&[0.7, 1.0], &[0.3, 0.6]].map(|radii| self.dice.one_of(radii));
                Solid::Torus { major, minor }
            }
            8 => {
                let centre = match self.dice.below(2) {
                    0 => [0.0; 3],
                    _ => [0, 1, 2].map(|axis| self.place(axis)),
                };
                Solid::Sphere { centre, radius: self.dice.one_of(&RADII) }
            }
            _ => {
                let mut normal = [0.0; 3];
                let axis = self.dice.below(3);
                let sign = self.dice.one_of(&[-1.0, 1.0]);
                normal[axis] = sign;
                Solid::Plane { normal, distance: sign * self.place(axis) }
            }
        };
        match &solid {
            Solid::Box { corners } | Solid::Cone { ends: corners, .. } => {
                for corner in corners {
                    (0..3).for_each(|axis| self.edges[axis].push(corner[axis]));
                }
            }
            Solid::Sphere { .. }
            | Solid::Plane { .. }
            | Solid::Torus { .. }
            | Solid::Whole { .. } => {}
        }
        self.drawn.push(solid.clone());
        solid
    }

    fn leaf(&mut self) -> Object {
        let object = match self.solid() {
            Solid::Sphere { centre, radius } => sphere(centre, radius),
            Solid::Plane { normal, distance } => plane(normal, distance),
            Solid::Box { corners: [a, b] } => cuboid(a, b),
            Solid::Cone { ends, radii } => cone(ends, radii),
            Solid::Torus { major, minor } => torus(major, minor),
            Solid::Whole { .. } => unreachable!("a leaf has no parts"),
        };
        let paint = self.dice.one_of(&PAINTS);
        let object = match self.stuff {
            Stuff::Bright => object.color(paint).finish(1.0, 0.0, 0.0),
            Stuff::Lit => object.color(paint).finish(0.2, 0.7, 0.0),
            Stuff::Clear { ior } => {
                // One stuff, or its parts would be told by its walls.
                let object = object.color([0.9, 0.7, 0.5]).finish(0.2, 0.0, 0.0);
                Object { filter: 0.7, transmit: 0.1, ior, ..object }
            }
        };
        let detour = self.detour();
        Object { detour, ..object }
    }

    /// What comes to nothing, but for rounding.
    fn detour(&mut self) -> String {
        let [x, y, z] = [0; 3].map(|_| self.dice.one_of(&[10.0, 33.3, 45.0, 77.0, 120.0]));
        let far = ten(self.dice.below(7) as i32);
        match self.dice.below(9) {
            0 => format!("rotate <{x}, {y}, {z}> rotate -{z}*z rotate -{y}*y rotate -{x}*x"),
            1 => format!("rotate <{x}, {y}, {z}> transform {{ rotate <{x}, {y}, {z}> inverse }}"),
            2 => "scale 3 scale 1/3".to_owned(),
            3 => "translate 0.1*x translate 0.2*x translate -0.3*x".to_owned(),
            4 => format!(
                "translate {far:e}*<1, 2, 3> rotate {x}*y rotate -{x}*y translate -{far:e}*<1, 2, 3>"
            ),
            5 => format!("scale <1, 0.7, 3> rotate {x}*z rotate -{x}*z scale <1, 1/0.7, 1/3>"),
            6 => "rotate 360*y rotate -720*x".to_owned(),
            _ => String::new(),
        }
    }

    fn object(&mut self, depth: usize) -> Object {
        if depth == 0 || self.dice.below(3) == 0 {
            return self.leaf();
        }
        let parts = 2 + self.dice.below(2);
        let operation = self.operation();
        whole(operation, (0..parts).map(|_| self.object(depth - 1)).collect())
    }

    fn operation(&mut self) -> Operation {
        use Operation::{Difference, Intersection, Merge};
        self.dice.one_of(&[Difference, Difference, Intersection, Merge, Merge])
    }
}

/// A scene, and whatever of its text is not told by it: none of which changes the picture.
fn drawn(seed: u64) -> (Scene, String) {
    let mut dice = Dice(seed);
    let ior = if dice.below(2) == 0 { 1.0 } else { 1.5 };
    let stuff = [Stuff::Bright, Stuff::Lit, Stuff::Lit, Stuff::Clear { ior }][dice.below(4)];
    let mut carver = Carver { dice, stuff, edges: Default::default(), drawn: Vec::new() };
    let (depth, parts) = (carver.dice.below(3), 2 + carver.dice.below(3));
    let operation = carver.operation();
    let parts = (0..parts).map(|_| carver.object(depth)).collect();
    // What has no end is of no size.
    let all = whole(
        Operation::Intersection,
        vec![whole(operation, parts), Object { detour: String::new(), ..painted(carver.stuff) }],
    );
    let ior = if let Stuff::Clear { ior } = stuff { ior } else { 1.0 };
    let mut objects = vec![Object { ior, ..all }];
    if matches!(stuff, Stuff::Clear { .. }) {
        let board = cuboid([-4.0, -4.0, -3.0], [4.0, 4.0, -2.5]);
        objects.push(board.checker(&[]).finish(0.8, 0.0, 0.0));
    }
    let dice = &mut carver.dice;
    let light = Light { position: [3.0, 4.0, 5.0], color: WHITE };
    let lights = if stuff == Stuff::Lit { vec![light] } else { Vec::new() };
    let scene = Scene::new(camera(dice), &lights, objects).deep(12);
    let is_rigid = stuff != Stuff::Bright && stuff != Stuff::Clear { ior: 1.0 };
    let text = respelt(&elsewhere(&scene, dice, is_rigid), dice);
    (scene, text)
}

/// What holds all that is drawn.
fn painted(stuff: Stuff) -> Object {
    let block = cuboid([-1.5; 3], [1.5; 3]).color([0.6; 3]);
    match stuff {
        Stuff::Bright => block.finish(1.0, 0.0, 0.0),
        Stuff::Lit => block.finish(0.2, 0.7, 0.0),
        Stuff::Clear { ior } => {
            let block = block.color([0.9, 0.7, 0.5]).finish(0.2, 0.0, 0.0);
            Object { filter: 0.7, transmit: 0.1, ior, ..block }
        }
    }
}

fn camera(dice: &mut Dice) -> Camera {
    let z = dice.one_of(&[0.0, 0.3, 0.6]);
    match dice.below(4) {
        0 => Camera::Orthographic {
            location: [0.0, 0.0, 5.0],
            direction: [0.0, 0.0, -1.0],
            right: [4.0, 0.0, 0.0],
            up: [0.0, 3.0, 0.0],
        },
        1 => Camera::Orthographic {
            location: [3.0, 4.0, 5.0],
            direction: [-3.0, -4.0, -5.0],
            right: [4.0, -3.0, 0.0].map(|c| c * 0.8),
            up: [-1.0, -4.0 / 3.0, 5.0 / 3.0].map(|c| c * 1.4),
        },
        2 => Camera::Perspective {
            location: [z, z, 5.0],
            direction: [0.0, 0.0, -1.0],
            right: [0.9, 0.0, 0.0],
            up: [0.0, 0.7, 0.0],
        },
        _ => {
            let location =
                [dice.between(-3.0, 3.0), dice.between(1.0, 4.0), dice.between(3.0, 5.0)];
            Camera::LookAt { location, look_at: [0.0; 3], angle: 40.0 }
        }
    }
}

/// The scene in another size, turned, and in another place: the same picture.
fn elsewhere(scene: &Scene, dice: &mut Dice, is_rigid: bool) -> String {
    let turn = [0; 3].map(|_| dice.one_of(&[0.0, 0.0, 1e-5, 30.0, 45.0, 77.7, 90.0]));
    let size = ten(dice.below(25) as i32 - 12);
    let far = dice.one_of(&[0.0, 0.0, 1.0, 1e3, 1e6]) * size;
    let stretch = [1.0, 0.7, 3.0][dice.below(3)];
    let mut steps = vec![Step::Rotate(turn), Step::Scale([size; 3])];
    if !is_rigid {
        steps.insert(0, Step::Scale([1.0, stretch, 1.0]));
    }
    steps.push(Step::Translate([far, 0.3 * far, -far]));
    text_moved(scene, &steps)
}

/// The text of a scene that is moved as a whole, its camera with it.
pub fn text_moved(scene: &Scene, steps: &[Step]) -> String {
    let mut moved = scene.clone();
    moved.camera_steps = steps.to_vec();
    let text = moved.text();
    let steps = steps.iter().map(Step::text).collect::<Vec<_>>().join(" ");
    // All but the camera stands in one block.
    let (head, body) = text.split_once("camera {").expect("a camera");
    let (camera, body) = body.split_once('\n').expect("a line of its own");
    format!("{head}camera {{{camera}\nunion {{ {body} {steps} }}\n")
}

/// The same numbers, as far as their author knows.
fn respelt(text: &str, dice: &mut Dice) -> String {
    let mut out = String::new();
    let mut rest = text;
    const SPELLINGS: [(&str, &[&str]); 3] = [
        ("3e-1", &["3e-1", "(0.1+0.2)", "(3*0.1)", "(1-0.7)", "0.3"]),
        ("6e-1", &["6e-1", "(0.2+0.4)", "(6*0.1)", "(0.1+0.2+0.3)"]),
        ("7e-1", &["7e-1", "(0.1+0.6)", "(7*0.1)", "(1-0.3)", "(2.1/3)"]),
    ];
    while let Some(at) = rest.find("e-1") {
        // A whole number of one digit, and no longer exponent.
        let start =
            rest[..at].rfind(|c: char| !c.is_ascii_digit() && c != '.').map_or(0, |i| i + 1);
        let ends = !rest[at + 3..].starts_with(|c: char| c.is_ascii_digit());
        let known = SPELLINGS.iter().find(|(name, _)| *name == &rest[start..at + 3]);
        out += &rest[..start];
        match known {
            Some((_, ways)) if ends => out += dice.one_of(ways),
            _ => out += &rest[start..at + 3],
        }
        rest = &rest[at + 3..];
    }
    out + rest
}

#[test]
fn solids_of_parts_whose_faces_coincide_are_seen_as_they_are() {
    let (mut told, mut shown, mut unjudged) = (String::new(), 0, 0);
    let scenes = 40 * crate::dice::rays() as u64 / 10_000;
    let (first, last) = match std::env::var("LUCARNE_SEED") {
        Ok(seed) => seed.parse().map(|seed: u64| (seed, seed + 1)).expect("a number"),
        Err(_) => (0, scenes),
    };
    for seed in first..last {
        let (scene, text) = drawn(seed);
        let held = Truth::of(&scene, SIZE).held(&text);
        shown += u64::from(held.shown > SIZE.0 * SIZE.1 / 10);
        unjudged += held.unjudged;
        if !held.bad.is_empty() {
            let some: Vec<_> = held.bad.iter().take(3).collect();
            let _ = writeln!(told, "{seed}: {} bad, {some:?}\n{text}", held.bad.len());
        }
    }
    assert!(told.is_empty(), "{told}");
    assert!(2 * shown > last - first, "{shown} pictures show much");
    assert!(u64::from(unjudged) < 10 * (last - first), "{unjudged} pixels are not judged");
}
