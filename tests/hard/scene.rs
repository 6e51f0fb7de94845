//! Scenes as numbers: each is written as a text for lucarne, and read as it stands by the exact
//! tracer.
//!
//! **Invariant:** the text has every number in the shortest form that reads back to the same `f64`.

use std::fmt::Write;

pub type Triple = [f64; 3];

pub const BLACK: Triple = [0.0; 3];
pub const WHITE: Triple = [1.0; 3];

#[derive(Debug, Clone)]
pub struct Scene {
    pub camera: Camera,
    /// They move the camera; nothing here but the text knows of them.
    pub camera_steps: Vec<Step>,
    pub background: Triple,
    pub lights: Vec<Light>,
    pub objects: Vec<Object>,
    /// `max_trace_level`.
    pub depth: u32,
}

/// The default direction, right, up and sky where nothing else is said.
#[derive(Debug, Clone, Copy)]
pub enum Camera {
    LookAt { location: Triple, look_at: Triple, angle: f64 },
    Perspective { location: Triple, direction: Triple, right: Triple, up: Triple },
    Orthographic { location: Triple, direction: Triple, right: Triple, up: Triple },
}

/// A point light.
#[derive(Debug, Clone, Copy)]
pub struct Light {
    pub position: Triple,
    pub color: Triple,
}

#[derive(Debug, Clone)]
pub struct Object {
    pub solid: Solid,
    pub paint: Paint,
    pub ambient: f64,
    pub diffuse: f64,
    pub reflection: f64,
    /// How much of what lies behind is seen, tinted and not.
    pub filter: f64,
    pub transmit: f64,
    /// The index of refraction inside; outside it is 1.
    pub ior: f64,
    /// They move the paint, too.
    pub steps: Vec<Step>,
    /// How many times the text places it.
    pub copies: u32,
    /// Transforms that undo each other: nothing here but the text knows of them.
    pub detour: String,
}

#[derive(Debug, Clone)]
pub enum Solid {
    Sphere {
        centre: Triple,
        radius: f64,
    },
    Plane {
        normal: Triple,
        distance: f64,
    },
    Box {
        corners: [Triple; 2],
    },
    /// A cylinder where both radii are one.
    Cone {
        ends: [Triple; 2],
        radii: [f64; 2],
    },
    /// About the y axis.
    Torus {
        major: f64,
        minor: f64,
    },
    /// Of a whole the steps count, and what it is filled with; of its parts the rest.
    Whole {
        operation: Operation,
        parts: Vec<Object>,
    },
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operation {
    Merge,
    Intersection,
    /// The others are taken from the first.
    Difference,
}

#[derive(Debug, Clone)]
pub enum Paint {
    Plain(Triple),
    Checker { even: Triple, odd: Triple, steps: Vec<Step> },
}

#[derive(Debug, Clone, Copy)]
pub enum Step {
    Translate(Triple),
    Scale(Triple),
    Rotate(Triple),
    /// `rotate` about one axis, so many times.
    Spin {
        axis: usize,
        degrees: f64,
        times: u32,
    },
    /// What the axes and the origin become.
    Matrix([Triple; 4]),
}

pub fn sphere(centre: Triple, radius: f64) -> Object {
    Object::new(Solid::Sphere { centre, radius })
}

pub fn plane(normal: Triple, distance: f64) -> Object {
    Object::new(Solid::Plane { normal, distance })
}

pub fn cuboid(low: Triple, high: Triple) -> Object {
    Object::new(Solid::Box { corners: [low, high] })
}

pub fn cone(ends: [Triple; 2], radii: [f64; 2]) -> Object {
    Object::new(Solid::Cone { ends, radii })
}

pub fn torus(major: f64, minor: f64) -> Object {
    Object::new(Solid::Torus { major, minor })
}

pub fn whole(operation: Operation, parts: Vec<Object>) -> Object {
    Object::new(Solid::Whole { operation, parts })
}

impl Object {
    fn new(solid: Solid) -> Self {
        let (paint, steps) = (Paint::Plain(WHITE), Vec::new());
        Self {
            solid,
            paint,
            ambient: 0.1,
            diffuse: 0.7,
            reflection: 0.0,
            filter: 0.0,
            transmit: 0.0,
            ior: 1.0,
            steps,
            copies: 1,
            detour: String::new(),
        }
    }

    pub fn color(self, color: Triple) -> Self {
        Self { paint: Paint::Plain(color), ..self }
    }

    pub fn checker(self, steps: &[Step]) -> Self {
        let [even, odd] = [[0.9, 0.8, 0.7], [0.1, 0.2, 0.4]];
        Self { paint: Paint::Checker { even, odd, steps: steps.to_vec() }, ..self }
    }

    pub fn finish(self, ambient: f64, diffuse: f64, reflection: f64) -> Self {
        Self { ambient, diffuse, reflection, ..self }
    }

    pub fn moved(mut self, step: Step) -> Self {
        self.steps.push(step);
        self
    }
}

impl Scene {
    pub fn new(camera: Camera, lights: &[Light], objects: Vec<Object>) -> Self {
        Self {
            camera,
            camera_steps: Vec::new(),
            background: [0.2, 0.3, 0.5],
            lights: lights.to_vec(),
            objects,
            depth: 5,
        }
    }

    pub fn deep(self, depth: u32) -> Self {
        Self { depth, ..self }
    }

    pub fn text(&self) -> String {
        let mut text = format!(
            "global_settings {{ max_trace_level {} adc_bailout 0 }}\nbackground {{ rgb {} }}\n",
            self.depth,
            triple(self.background)
        );
        text += &self.camera.text(&written(&self.camera_steps));
        for Light { position, color } in &self.lights {
            let _ =
                writeln!(text, "light_source {{ {}, rgb {} }}", triple(*position), triple(*color));
        }
        for object in &self.objects {
            let copies = object.copies;
            let object = object.text(false);
            match copies {
                1 => text += &object,
                n => {
                    let _ = writeln!(text, "#for (I, 1, {n}) {object} #end");
                }
            }
        }
        text
    }
}

impl Camera {
    fn text(&self, steps: &str) -> String {
        let frame = |kind, location, direction, right, up| {
            let [location, direction, right, up] = [location, direction, right, up].map(triple);
            format!(
                "camera {{ {kind} location {location} direction {direction} right {right} up {up} {steps} }}\n"
            )
        };
        match *self {
            Self::LookAt { location, look_at, angle } => format!(
                "camera {{ location {} look_at {} angle {angle:e} {steps} }}\n",
                triple(location),
                triple(look_at)
            ),
            Self::Perspective { location, direction, right, up } => {
                frame("perspective", location, direction, right, up)
            }
            Self::Orthographic { location, direction, right, up } => {
                frame("orthographic", location, direction, right, up)
            }
        }
    }
}

impl Object {
    fn text(&self, is_part: bool) -> String {
        let solid = match &self.solid {
            Solid::Sphere { centre, radius } => {
                format!("sphere {{ {}, {radius:e}", triple(*centre))
            }
            Solid::Plane { normal, distance } => {
                format!("plane {{ {}, {distance:e}", triple(*normal))
            }
            Solid::Box { corners: [a, b] } => format!("box {{ {}, {}", triple(*a), triple(*b)),
            Solid::Cone { ends: [a, b], radii: [one, other] } if one == other => {
                format!("cylinder {{ {}, {}, {one:e}", triple(*a), triple(*b))
            }
            Solid::Cone { ends: [a, b], radii: [base, cap] } => {
                format!("cone {{ {}, {base:e}, {}, {cap:e}", triple(*a), triple(*b))
            }
            Solid::Torus { major, minor } => format!("torus {{ {major:e}, {minor:e}"),
            Solid::Whole { operation, parts } => {
                let parts: String = parts.iter().map(|part| part.text(true)).collect();
                format!("{} {{ {parts}", operation.word())
            }
        };
        let steps = written(&self.steps);
        let detour = &self.detour;
        let interior = match self.ior {
            ior if ior == 1.0 || is_part => String::new(),
            ior => format!("interior {{ ior {ior:e} }}"),
        };
        let surface = self.surface();
        format!("{solid} {detour} {surface} {interior} {steps} }}\n")
    }

    fn surface(&self) -> String {
        let paint = match &self.paint {
            _ if matches!(self.solid, Solid::Whole { .. }) => return String::new(),
            Paint::Plain(color) if self.filter == 0.0 && self.transmit == 0.0 => {
                format!("rgb {}", triple(*color))
            }
            Paint::Plain([r, g, b]) => {
                format!("rgbft <{r:e}, {g:e}, {b:e}, {:e}, {:e}>", self.filter, self.transmit)
            }
            Paint::Checker { even, odd, steps } => {
                format!("checker rgb {} rgb {} {}", triple(*even), triple(*odd), written(steps))
            }
        };
        let Self { ambient, diffuse, reflection, .. } = self;
        let finish =
            format!("ambient {ambient:e} diffuse {diffuse:e} reflection {{ rgb {reflection:e} }}");
        format!("pigment {{ {paint} }} finish {{ {finish} }}")
    }
}

impl Operation {
    fn word(self) -> &'static str {
        match self {
            Self::Merge => "merge",
            Self::Intersection => "intersection",
            Self::Difference => "difference",
        }
    }
}

fn written(steps: &[Step]) -> String {
    steps.iter().map(Step::text).collect::<Vec<_>>().join(" ")
}

impl Step {
    pub fn text(&self) -> String {
        match *self {
            Self::Translate(v) => format!("translate {}", triple(v)),
            Self::Scale(v) => format!("scale {}", triple(v)),
            Self::Rotate(v) => format!("rotate {}", triple(v)),
            Self::Spin { axis, degrees, times } => {
                format!("#for (J, 1, {times}) rotate {degrees:e}*{} #end", ["x", "y", "z"][axis])
            }
            Self::Matrix(rows) => {
                let numbers: Vec<String> =
                    rows.iter().flatten().map(|n| format!("{n:e}")).collect();
                format!("matrix <{}>", numbers.join(", "))
            }
        }
    }
}

fn triple([x, y, z]: Triple) -> String {
    format!("<{x:e}, {y:e}, {z:e}>")
}

/// The number that is written `1e<exponent>`.
pub fn ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().expect("a number")
}
