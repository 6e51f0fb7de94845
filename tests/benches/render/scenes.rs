//! The scenes of the table: each text is read by both programs.

use std::f64::consts::TAU;
use std::fmt::Write;

/// What is traced, and how many times as fast as POV-Ray it shall be.
pub struct Row {
    pub title: String,
    pub scene: String,
    pub goal: f64,
}

pub fn rows() -> Vec<Row> {
    let row = |title: &str, scene: String, goal: f64| Row { title: title.to_owned(), scene, goal };
    vec![
        row("3 spheres, box, plane, 2 lights, mirrors", few(), 5.0),
        row("10,000 spheres", spheres(10_000), 6.0),
        row("100,000 spheres", spheres(100_000), 6.0),
        row("1,000,000 spheres", spheres(1_000_000), 5.0),
        row("sphereflake of 66,430, mirrors, 3 lights", flake(), 5.0),
        row("mesh of 100,000 triangles", mesh(158), 8.0),
        row("mesh of 1,000,000 triangles", mesh(500), 7.0),
        row("500 differences", differences(), 4.0),
        row("200 nested unions of 8", unions(), 5.0),
        row("a box minus 100 spheres", drilled(100), 5.0),
        row("32 glass bodies, depth 10", glass(10), 3.0),
        row("20 spheres, 100 lights", lights(100), 6.0),
    ]
}

const DEFAULT: &str =
    "#default { pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0.1 diffuse 0.6 } }\n";
const LIGHT: &str = "light_source { <50, 80, 60>, rgb 0.7 }\n";
const SECOND_LIGHT: &str = "light_source { <-60, 50, 30>, rgb 0.5 }\n";

fn head(location: &str, look_at: &str, depth: u32) -> String {
    format!(
        "#version 3.7;
global_settings {{ assumed_gamma 1 max_trace_level {depth} }}
camera {{ location {location} right -x*16/9 up y direction -1.2*z look_at {look_at} }}
background {{ rgb <0.2, 0.3, 0.5> }}
"
    )
}

/// Numbers that are the same on every machine.
struct Random(u64);

impl Random {
    /// From `low` to `high`.
    fn number(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        low + (high - low) * (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// In a cube around the origin, as text.
    fn place(&mut self, size: f64) -> String {
        let [x, y, z] = [(); 3].map(|()| self.number(-size, size));
        format!("<{x:.6}, {y:.6}, {z:.6}>")
    }
}

macro_rules! add {
    ($scene:ident, $($text:tt)*) => { write!($scene, $($text)*).expect("written") };
}

pub fn few() -> String {
    let gloss = "phong 0.4 phong_size 40";
    let mut scene = head("<0, 1.2, 6>", "<0, 0.9, 0>", 5) + LIGHT + SECOND_LIGHT;
    let mut body = |shape: &str, color: &str, gloss: &str, reflection: f64| {
        add!(
            scene,
            "{shape} pigment {{ rgb {color} }} finish {{ ambient 0.1 diffuse 0.6 {gloss} \
             reflection {reflection} }} }}\n"
        );
    };
    body("plane { y, 0", "<0.8, 0.8, 0.7>", "", 0.1);
    body("sphere { <0, 1, 0>, 1", "<0.8, 0.2, 0.2>", gloss, 0.3);
    body("sphere { <-2, 0.6, 0.8>, 0.6", "<0.2, 0.7, 0.3>", "specular 0.4 roughness 0.02", 0.2);
    body("sphere { <1.6, 0.5, 1.6>, 0.5", "<0.2, 0.3, 0.8>", gloss, 0.2);
    let turned = "box { -0.5, 0.5 rotate 30*y translate <2.4, 0.5, -0.6>";
    body(turned, "<0.8, 0.7, 0.2>", gloss, 0.1);
    scene
}

/// The more, the smaller.
pub fn spheres(count: usize) -> String {
    let mut scene = head("<0, 0, 30>", "<0, 0, 0>", 5) + LIGHT + DEFAULT;
    let mut random = Random(7);
    let size = (100_000.0 / count as f64).cbrt();
    for _ in 0..count {
        let (centre, radius) = (random.place(10.0), size * random.number(0.03, 0.12));
        add!(scene, "sphere {{ {centre}, {radius:.6} }}\n");
    }
    scene
}

/// Nine spheres around each, a third as large, five times over.
///
/// **Source:** E. Haines, "A proposal for standard graphics environments", IEEE CG&A 7 (11), 1987.
fn flake() -> String {
    let mut scene = head("<0, 1.5, 4.5>", "<0, 0, 0>", 5) + LIGHT + SECOND_LIGHT;
    scene += "light_source { <10, 80, -60>, rgb 0.3 }\n";
    scene += "#default { pigment { rgb <0.8, 0.6, 0.4> }";
    scene += " finish { ambient 0.1 diffuse 0.6 reflection 0.2 } }\n";
    scene += "plane { y, -1.6 finish { reflection 0 } }\n";
    let mut waiting = vec![([0.0f64; 3], 0.8, [0.0f64, 1.0, 0.0], 5)];
    while let Some((centre, radius, axis, level)) = waiting.pop() {
        let [x, y, z] = centre;
        add!(scene, "sphere {{ <{x:.7}, {y:.7}, {z:.7}>, {radius:.7} }}\n");
        if level == 0 {
            continue;
        }
        let aside = if axis[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
        let u = unit(cross(aside, axis));
        let v = cross(axis, u);
        for number in 0..9 {
            let (turn, slope) = match number {
                0..6 => (f64::from(number) / 6.0, 90f64),
                _ => (f64::from(number) / 3.0 + 0.05, 35f64),
            };
            let ((sine, cosine), (across, up)) =
                ((turn * TAU).sin_cos(), slope.to_radians().sin_cos());
            let way = [0, 1, 2].map(|i| across * (cosine * u[i] + sine * v[i]) + up * axis[i]);
            let place = [0, 1, 2].map(|i| centre[i] + way[i] * radius * 4.0 / 3.0);
            waiting.push((place, radius / 3.0, way, level - 1));
        }
    }
    scene
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    v.map(|c| c / length)
}

/// A ball with bumps, of 4·`rings`·(`rings` − 1) triangles.
pub fn mesh(rings: usize) -> String {
    let mut scene = head("<0, 1.5, 3>", "<0, 0, 0>", 5) + LIGHT;
    scene += "plane { y, -1.1 pigment { rgb 0.8 } }\nmesh2 {\n";
    let around = 2 * rings;
    add!(scene, "vertex_vectors {{ {}", (rings + 1) * around);
    for ring in 0..=rings {
        for column in 0..around {
            let t = TAU / 2.0 * ring as f64 / rings as f64;
            let p = TAU * column as f64 / around as f64;
            let coarse = 0.05 * (9.0 * t).sin() * (11.0 * p).sin();
            let r = 1.0 + coarse + 0.02 * (40.0 * p).sin() * (37.0 * t).sin();
            let [x, y, z] = [r * t.sin() * p.cos(), r * t.cos(), r * t.sin() * p.sin()];
            add!(scene, ", <{x:.6}, {y:.6}, {z:.6}>");
        }
    }
    add!(scene, " }}\nface_indices {{ {}", 2 * around * (rings - 1));
    for ring in 0..rings {
        for column in 0..around {
            let (a, b) = (ring * around + column, ring * around + (column + 1) % around);
            let (c, d) = (a + around, b + around);
            if ring > 0 {
                add!(scene, ", <{a}, {b}, {c}>");
            }
            if ring + 1 < rings {
                add!(scene, ", <{b}, {d}, {c}>");
            }
        }
    }
    scene + " }\npigment { rgb <0.8, 0.5, 0.3> } }\n"
}

fn differences() -> String {
    let mut scene = head("<0, 0, 30>", "<0, 0, 0>", 5) + LIGHT + DEFAULT;
    let mut random = Random(8);
    for _ in 0..500 {
        let (turn, place) = (random.number(0.0, 360.0), random.place(9.0));
        add!(
            scene,
            "difference {{ sphere {{ 0, 0.8 }} box {{ <0, 0, -1>, 1 rotate {turn:.3}*x }} \
             cylinder {{ -y, y, 0.3 }} translate {place} }}\n"
        );
    }
    scene
}

fn unions() -> String {
    fn union(random: &mut Random, level: u32) -> String {
        if level == 0 {
            return format!("sphere {{ {}, 0.25 }}", random.place(1.0));
        }
        let [one, other] = [(); 2].map(|()| union(random, level - 1));
        let [a, b] = [(); 2].map(|()| random.number(0.0, 90.0));
        let place = random.place(0.3);
        format!("union {{ {one} {other} rotate <{a:.3}, {b:.3}, 0> translate {place} }}")
    }
    let mut scene = head("<0, 0, 30>", "<0, 0, 0>", 5) + LIGHT + DEFAULT;
    let mut random = Random(9);
    for _ in 0..200 {
        let (all, place) = (union(&mut random, 3), random.place(9.0));
        add!(scene, "union {{ {all} translate {place} }}\n");
    }
    scene
}

pub fn drilled(count: usize) -> String {
    let mut scene = head("<4, 5, 9>", "<0, 0, 0>", 5) + LIGHT + DEFAULT;
    scene += "difference { box { -3, 3 }\n";
    let mut random = Random(10);
    for _ in 0..count {
        let (place, radius) = (random.place(3.0), random.number(0.3, 0.7));
        add!(scene, "sphere {{ {place}, {radius:.3} }}\n");
    }
    scene + "}\n"
}

pub fn glass(depth: u32) -> String {
    let mut scene = head("<0, 3, 12>", "<0, 0, 0>", depth) + LIGHT + SECOND_LIGHT;
    scene += "plane { y, -3 pigment { checker rgb 1, rgb 0.3 } }\n";
    let mut random = Random(11);
    for number in 0..32 {
        let [a, b] = [(); 2].map(|()| random.number(0.0, 90.0));
        let shape = match number % 2 {
            0 => format!("box {{ -0.7, 0.7 rotate <{a:.3}, {b:.3}, 0> }}"),
            _ => "sphere { 0, 0.9 }".to_owned(),
        };
        let [x, y, z] = [5.0, 2.7, 5.0].map(|size| random.number(-size, size));
        add!(
            scene,
            "object {{ {shape} pigment {{ rgbf <0.9, 0.95, 1, 0.9> }} finish {{ ambient 0 \
             diffuse 0.1 reflection {{ 0.05, 0.6 fresnel }} specular 0.4 conserve_energy }} \
             interior {{ ior 1.5 }} translate <{x:.3}, {y:.3}, {z:.3}> }}\n"
        );
    }
    scene
}

pub fn lights(count: usize) -> String {
    let mut scene = head("<0, 2, 8>", "<0, 0.5, 0>", 5) + DEFAULT + "plane { y, 0 }\n";
    let mut random = Random(12);
    let each = 2.0 / count as f64;
    for _ in 0..count {
        let [x, z] = [(); 2].map(|()| random.number(-20.0, 20.0));
        let y = random.number(5.0, 20.0);
        add!(scene, "light_source {{ <{x:.3}, {y:.3}, {z:.3}>, rgb {each} }}\n");
    }
    for _ in 0..20 {
        let [x, z] = [(); 2].map(|()| random.number(-3.0, 3.0));
        let y = random.number(0.0, 2.0);
        add!(scene, "sphere {{ <{x:.3}, {y:.3}, {z:.3}>, 0.5 }}\n");
    }
    scene
}
