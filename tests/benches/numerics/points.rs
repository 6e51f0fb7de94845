//! Bodies by their points: a star, a hill, a landscape and a letter.

use lucarne::math::Vector;
use lucarne::shape::curve::{Outline, Piece};
use lucarne::shape::{BicubicPatch, Body, HeightField, Polygon, Text};

use crate::bodies::{Form, NEAR, pierced};
use crate::naive::{V32, V64, double, single};
use crate::sturm;
use crate::subjects::Answer;
use crate::wide::{Wide, WideVector};

/// The least of what one meets; where two are too near to tell apart, or one is too near to tell, either.
fn first(answers: impl IntoIterator<Item = Answer>) -> Answer {
    let mut found: Vec<Wide> = Vec::new();
    for answer in answers {
        match answer {
            Answer::Either => return Answer::Either,
            Answer::Enters(t) => found.push(t),
            Answer::Misses => {}
        }
    }
    found.sort_by(|a, b| a.partial_cmp(b).expect("ordered"));
    match found.as_slice() {
        [first, second, ..] if (second - first).to_f64() < NEAR => Answer::Either,
        [first, ..] => Answer::Enters(first.clone()),
        [] => Answer::Misses,
    }
}

/// Each line of five crosses two others.
const STAR: [[f64; 2]; 5] = [[0.0, 1.0], [0.5, -0.75], [-1.0, 0.25], [1.0, 0.25], [-0.5, -0.75]];

pub struct Star;

impl Form for Star {
    fn body() -> Option<Body> {
        Polygon::new(&[STAR.to_vec()]).map(Body::Polygon)
    }
    fn single(f: V32, d: V32) -> Option<f32> {
        single::polygon(f, d, &STAR)
    }
    fn double(f: V64, d: V64) -> Option<f64> {
        double::polygon(f, d, &STAR)
    }
    fn exact(f: &WideVector, d: &WideVector) -> Answer {
        if (d.0[2].clone() / &d.length()).to_f64().abs() < 1e-3 {
            return Answer::Either;
        }
        let t = -&(&f.0[2] / &d.0[2]);
        let place = [0, 1].map(|axis| &f.0[axis] + &(&t * &d.0[axis]));
        let mut odd = false;
        for (from, to) in STAR.iter().zip(STAR.iter().cycle().skip(1)) {
            let [ax, ay, bx, by] = [from[0], from[1], to[0], to[1]].map(Wide::of);
            let turn =
                (&ax - &place[0]) * &(&by - &place[1]) - (&bx - &place[0]) * &(&ay - &place[1]);
            let [above, below] = [(&ay - &place[1]).to_f64(), (&by - &place[1]).to_f64()];
            // As near to the line through both: some that are not near the edge itself are left out, too.
            if turn.to_f64().abs() < NEAR {
                return Answer::Either;
            }
            odd ^= (above <= 0.0) != (below <= 0.0) && turn.is_positive() == (above <= 0.0);
        }
        if odd { Answer::Enters(t) } else { Answer::Misses }
    }
}

/// The heights of a [`Hill`]'s points.
const HEIGHTS: [f64; 16] = [
    -0.5, 0.0, 0.25, -0.25, 0.125, 0.75, 0.5, 0.0, -0.25, 0.5, 1.0, -0.375, 0.0, -0.5, 0.25, 0.125,
];

fn net() -> [[f64; 3]; 16] {
    let place = |i: usize| (i as f64 - 1.5) * 0.5;
    std::array::from_fn(|i| [place(i % 4), place(i / 4), HEIGHTS[i]])
}

/// A patch that is as high over the square from −0.75 to 0.75 as a polynomial says.
pub struct Hill;

impl Form for Hill {
    fn body() -> Option<Body> {
        Some(Body::BicubicPatch(BicubicPatch::new(net().map(Vector::from_array))))
    }
    fn single(f: V32, d: V32) -> Option<f32> {
        single::patch(f, d, &net())
    }
    fn double(f: V64, d: V64) -> Option<f64> {
        double::patch(f, d, &net())
    }
    fn exact(f: &WideVector, d: &WideVector) -> Answer {
        // About where the line is nearest, so that its powers are small.
        let middle = (-&f.dot(d)) / &d.square();
        let start = f.plus(&d.times(&middle));
        let (share, half) = (Wide::one() / &Wide::of(1.5), Wide::of(0.5));
        let place = |axis: usize| vec![&start.0[axis] * &share + &half, &d.0[axis] * &share];
        let (u, v) = (place(0), place(1));
        let mut height = vec![Wide::zero()];
        for (i, one) in weights(&u).iter().enumerate() {
            for (j, other) in weights(&v).iter().enumerate() {
                height = sum(&height, &product(one, other), &Wide::of(HEIGHTS[4 * j + i]));
            }
        }
        let over = sum(&[start.0[2].clone(), d.0[2].clone()], &height, &-&Wide::one());
        // What hills a little higher and lower, larger and smaller do not agree on is too near to tell.
        let meant = [(0.0, 0.0), (NEAR, NEAR), (NEAR, -NEAR), (-NEAR, NEAR), (-NEAR, -NEAR)].map(
            |(raised, wider)| {
                let mut over = over.clone();
                over[0] = &over[0] - &Wide::of(raised);
                let all =
                    within(&u, &v, wider).map_or(Vec::new(), |span| sturm::roots(&over, &span));
                (all.first().cloned(), all.len())
            },
        );
        let [(t, count), ..] = &meant;
        let close = |a: &Wide, b: &Wide| (a - b).to_f64().abs() < 1e-2;
        let alike = meant.iter().all(|(other, number)| {
            number == count && t.as_ref().zip(other.as_ref()).is_none_or(|(a, b)| close(a, b))
        });
        match t {
            _ if !alike => Answer::Either,
            Some(t) => Answer::Enters(t + &middle),
            None => Answer::Misses,
        }
    }
}

/// Where a line is over the square, made wider at each side by so much.
fn within(u: &[Wide], v: &[Wide], wider: f64) -> Option<(Wide, Wide)> {
    let ends = [u, v].map(|line| {
        let [a, b] = [-wider, 1.0 + wider].map(|end| (Wide::of(end) - &line[0]) / &line[1]);
        if (&a - &b).is_positive() { [b, a] } else { [a, b] }
    });
    let [[a, b], [c, d]] = ends;
    let low = if (&a - &c).is_positive() { a } else { c };
    let high = if (&b - &d).is_positive() { d } else { b };
    (&high - &low).is_positive().then_some((low, high))
}

fn product(a: &[Wide], b: &[Wide]) -> Vec<Wide> {
    let mut product = vec![Wide::zero(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] = &product[i + j] + &(x * y);
        }
    }
    product
}

/// a + factor·b.
fn sum(a: &[Wide], b: &[Wide], factor: &Wide) -> Vec<Wide> {
    let part = |all: &[Wide], i: usize| all.get(i).cloned().unwrap_or_else(Wide::zero);
    (0..a.len().max(b.len())).map(|i| part(a, i) + &(factor * &part(b, i))).collect()
}

/// What the four points along one way count at t.
fn weights(t: &[Wide]) -> [Vec<Wide>; 4] {
    let rest = sum(&[Wide::one()], t, &-&Wide::one());
    let three = [Wide::of(3.0)];
    let power = |a: &[Wide], b: &[Wide], c: &[Wide]| product(&product(a, b), c);
    [
        power(&rest, &rest, &rest),
        product(&three, &power(&rest, &rest, t)),
        product(&three, &power(&rest, t, t)),
        power(t, t, t),
    ]
}

/// How many cells a landscape has along each side.
const CELLS: usize = 4;

fn heights() -> Vec<f32> {
    (0..(CELLS + 1) * (CELLS + 1)).map(|i| ((i * 7) % 11) as f32 / 16.0 - 0.3125).collect()
}

fn triangles() -> Vec<[[f64; 3]; 3]> {
    let heights = heights();
    let corner = |i: usize, j: usize| {
        let place = |i: usize| i as f64 / CELLS as f64 - 0.5;
        [place(i), f64::from(heights[j * (CELLS + 1) + i]), place(j)]
    };
    let cell = |number: usize| {
        let (i, j) = (number % CELLS, number / CELLS);
        let (aside, behind) = (corner(i + 1, j), corner(i, j + 1));
        [[corner(i, j), aside, behind], [corner(i + 1, j + 1), behind, aside]]
    };
    (0..CELLS * CELLS).flat_map(cell).collect()
}

pub struct Landscape;

impl Form for Landscape {
    fn body() -> Option<Body> {
        HeightField::new(heights(), CELLS + 1, -1.0, false).map(Body::HeightField)
    }
    fn single(f: V32, d: V32) -> Option<f32> {
        single::triangles(f, d, &triangles())
    }
    fn double(f: V64, d: V64) -> Option<f64> {
        double::triangles(f, d, &triangles())
    }
    fn exact(f: &WideVector, d: &WideVector) -> Answer {
        first(triangles().iter().map(|corners| pierced(f, d, corners)))
    }
}

/// An o: a round line, and a square hole.
fn pieces() -> [[[f64; 2]; 3]; 8] {
    let turned = |turns: usize, [x, y]: [f64; 2]| [[x, y], [-y, x], [-x, -y], [y, -x]][turns % 4];
    std::array::from_fn(|i| match i < 4 {
        true => [[0.75, 0.0], [0.75, 0.75], [0.0, 0.75]].map(|point| turned(i, point)),
        false => [[0.25, 0.25], [0.0, 0.25], [-0.25, 0.25]].map(|point| turned(i, point)),
    })
}

pub struct Letter;

impl Form for Letter {
    fn body() -> Option<Body> {
        let mut outline = Outline::default();
        let all = pieces();
        let parts = all.chunks_exact(4);
        parts.for_each(|run| outline.add(run.iter().filter_map(|points| Piece::bezier(points))));
        Text::new(vec![outline], false).map(Body::Text)
    }
    fn single(f: V32, d: V32) -> Option<f32> {
        single::letter(f, d, &pieces())
    }
    fn double(f: V64, d: V64) -> Option<f64> {
        double::letter(f, d, &pieces())
    }
    fn exact(f: &WideVector, d: &WideVector) -> Answer {
        let speed2 = &d.0[0] * &d.0[0] + &d.0[1] * &d.0[1];
        if (speed2.clone() / &d.square()).to_f64() < NEAR {
            return Answer::Either;
        }
        let mut found = Vec::new();
        let all = pieces();
        for points in &all {
            let (x, y) = (powers(points, 0), powers(points, 1));
            let side = std::array::from_fn(|i| {
                let (x, y) = match i {
                    0 => (&x[0] - &f.0[0], &y[0] - &f.0[1]),
                    _ => (x[i].clone(), y[i].clone()),
                };
                x * &d.0[1] - y * &d.0[0]
            });
            let Some(roots) = roots(side) else { return Answer::Either };
            for t in roots {
                let along = (at(&x, &t) - &f.0[0]) * &d.0[0] + (at(&y, &t) - &f.0[1]) * &d.0[1];
                let s = along / &speed2;
                let beyond = (&f.0[2] + &(&s * &d.0[2])).abs() - Wide::one();
                found.push(match beyond.to_f64() {
                    beyond if beyond.abs() < NEAR => Answer::Either,
                    beyond if beyond < 0.0 => Answer::Enters(s),
                    _ => Answer::Misses,
                });
            }
        }
        for end in [-1.0, 1.0] {
            let s = (Wide::of(end) - &f.0[2]) / &d.0[2];
            let [px, py] = [0, 1].map(|axis| &f.0[axis] + &(&s * &d.0[axis]));
            let mut odd = false;
            for points in &all {
                let (x, mut y) = (powers(points, 0), powers(points, 1));
                y[0] = &y[0] - &py;
                let Some(roots) = roots(y) else { return Answer::Either };
                for t in roots {
                    let ahead = at(&x, &t) - &px;
                    if ahead.to_f64().abs() < NEAR {
                        return Answer::Either;
                    }
                    odd ^= ahead.is_positive();
                }
            }
            found.push(if odd { Answer::Enters(s) } else { Answer::Misses });
        }
        first(found)
    }
}

/// A curve's coordinate, by the powers of t.
fn powers(points: &[[f64; 2]; 3], axis: usize) -> [Wide; 3] {
    let [a, b, c] = points.map(|point| Wide::of(point[axis]));
    let two = Wide::of(2.0);
    [a.clone(), &two * &(&b - &a), &a - &(&two * &b) + &c]
}

fn at([c, b, a]: &[Wide; 3], t: &Wide) -> Wide {
    (a * t + b) * t + c
}

/// Those from 0 to 1; `None` where one is too near to an end, or to another, to tell.
fn roots([c, b, a]: [Wide; 3]) -> Option<Vec<Wide>> {
    let all = if a.is_zero() {
        if b.is_zero() {
            return if c.to_f64().abs() < NEAR { None } else { Some(Vec::new()) };
        }
        vec![-&(&c / &b)]
    } else {
        let half = &b * &Wide::of(0.5);
        let discriminant = &half * &half - &a * &c;
        if (discriminant.clone() / &(&a * &a)).to_f64().abs() < NEAR * NEAR {
            return None;
        }
        if discriminant.is_negative() {
            return Some(Vec::new());
        }
        let root = discriminant.sqrt();
        vec![(-&(&half + &root)) / &a, (&root - &half) / &a]
    };
    let is_near = |t: &Wide| [0.0, 1.0].iter().any(|end| (t.to_f64() - end).abs() < NEAR);
    if all.iter().any(is_near) {
        return None;
    }
    Some(all.into_iter().filter(|t| (0.0..1.0).contains(&t.to_f64())).collect())
}
