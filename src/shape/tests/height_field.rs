//! Height fields and text: heights over a grid, and boxes side by side, in exact arithmetic.

use super::placed::{assert_crossed_where_it_is, blur, local_at, placed, ray_at_placed};
use super::*;
use crate::shape::curve::{Outline, Piece};
use crate::shape::exact::Triple;
use crate::shape::local::{Crossings, Local, LocalRay, Met};

fn greater(a: Double, b: Double) -> Double {
    if (a - b).0 < 0.0 { b } else { a }
}

/// Hills, steps, or all of one height; as many cells as a power of two, so that the grid is exact.
fn any_field(random: &mut Random, water: f64) -> HeightField {
    let cells = [0; 2].map(|_| [1, 2, 8, 32, 64][random.below(5)]);
    let kind = random.below(3);
    let heights = (0..(cells[0] + 1) * (cells[1] + 1)).map(|_| match kind {
        0 => (random.below(256) as f32 - 128.0) / 256.0,
        1 => [-0.5, 0.0, 0.4375][random.below(3)],
        _ => 0.25,
    });
    let mut heights: Vec<f32> = heights.collect();
    // Not all of it lies under water.
    heights[0] = heights[0].max(water as f32);
    HeightField::new(heights, cells[0] + 1, water, false).expect("a landscape")
}

/// How far above the triangles and the water, or outside of the walls.
fn above(body: &Body, [x, y, z]: Triple) -> Double {
    let Body::HeightField(field) = body else { panic!("{body:?}") };
    let half = Double::of(0.5);
    let walls = greater(x.abs(), z.abs()) - half;
    let place = |axis: usize, at: Double| {
        let at = (at + half) * Double::of(field.cells[axis] as f64);
        let cell = at.0.floor().clamp(0.0, (field.cells[axis] - 1) as f64);
        (cell as usize, at - Double::of(cell))
    };
    let ((i, a), (j, b)) = (place(0, x), place(1, z));
    let height =
        |i: usize, j: usize| Double::of(f64::from(field.heights[j * (field.cells[0] + 1) + i]));
    let one = Double::of(1.0);
    let surface = if (a + b - one).0 <= 0.0 {
        let corner = height(i, j);
        corner + a * (height(i + 1, j) - corner) + b * (height(i, j + 1) - corner)
    } else {
        let corner = height(i + 1, j + 1);
        corner + (one - a) * (height(i, j + 1) - corner) + (one - b) * (height(i + 1, j) - corner)
    };
    let water = Double::of(field.water);
    greater(y - greater(surface, water), walls)
}

#[test]
fn a_landscape_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(101);
    let mut crossed = 0;
    for _ in 0..tries() {
        let water = [-0.5, 0.0, 0.125][random.below(3)];
        let field = any_field(&mut random, water);
        let placed = placed(&mut random, Body::HeightField(field));
        let ray = ray_at_placed(&mut random, &placed);
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, above);
    }
    assert!(crossed > tries() / 4, "{crossed}");
}

/// From above to below a line through an edge or a corner of the grid enters once more than it leaves.
#[test]
fn no_line_slips_through_between_cells() {
    let mut random = Random(102);
    for _ in 0..tries() {
        let field = any_field(&mut random, -0.5);
        let grid = |random: &mut Random, axis: usize| match random.below(2) {
            0 => random.below(field.cells[axis] + 1) as f64 / field.cells[axis] as f64 - 0.5,
            _ => random.number(-0.5, 0.5),
        };
        let target = Vector::new(grid(&mut random, 0) * 0.98, 0.0, grid(&mut random, 1) * 0.98);
        let direction = match random.below(3) {
            0 => -Vector::Y,
            _ => (random.direction().get() * 0.02 - Vector::Y).normalize(),
        };
        let s = target.dot(direction);
        let nearest = target - direction * s;
        let ray = LocalRay {
            nearest,
            direction,
            blur: 1e-15,
            turn: 1e-15,
            tolerance: 0.0,
            in_world: None,
        };
        let mut found = Crossings::new();
        field.crossings(&ray, &mut found);
        let surface: Vec<&Met> = found.iter().filter(|met| met.is_seen()).collect();
        assert_eq!(surface.len() % 2, 1, "{found:?} {field:?} {ray:?}");
        for (i, met) in found.iter().enumerate() {
            assert_eq!(met.leaving, i % 2 == 1, "{found:?} {field:?} {ray:?}");
        }
    }
}

#[test]
fn what_lies_under_the_water_is_not_seen_and_solid_all_the_same() {
    let heights = vec![-0.5, -0.5, 0.25, 0.25];
    let field = HeightField::new(heights, 2, 0.0, false).expect("a landscape");
    let down = |z: f64| {
        let nearest = Vector::new(0.1, 0.0, z);
        let ray = LocalRay {
            nearest,
            direction: -Vector::Y,
            blur: 0.0,
            turn: 0.0,
            tolerance: 0.0,
            in_world: None,
        };
        let mut found = Crossings::new();
        field.crossings(&ray, &mut found);
        found
    };
    assert!(!down(-0.25)[0].is_seen());
    assert!(down(0.4)[0].is_seen());
    assert!(field.contains(Vector::new(0.0, -2.0, 0.0)));
    // Over the ground, and under water.
    assert!(field.contains(Vector::new(0.0, -0.1, -0.4)) && down(-0.25).len() == 1);
    let (low, high) = field.extent(Vector::Y);
    assert!((low - 0.0).abs() < 1e-9 && (high - 0.25).abs() < 1e-9, "{low} {high}");
    assert!(HeightField::new(vec![-0.5; 4], 2, 0.0, false).is_none());
}

#[test]
fn a_smooth_landscape_is_lit_by_the_slopes_at_its_corners() {
    let heights = (0..25).map(|i| ((i % 5) as f32 - 2.0) / 8.0).collect();
    let field = HeightField::new(heights, 5, -0.5, true).expect("a landscape");
    let normal = field.shading_normal(9, Vector::new(-0.4, 0.0, -0.2)).expect("a normal");
    let slope = Vector::new(-0.5, 1.0, 0.0).normalize();
    assert!((normal.normalize() - slope).length() < 1e-12, "{normal}");
}

const BOXES: [[f64; 4]; 4] = [
    [-0.75, -0.25, -0.5, 0.25],
    // One that overlaps the first, one that touches it.
    [-0.5, -0.125, -0.25, 0.125],
    [-0.25, -0.25, 0.0, 0.25],
    [0.25, -0.5, 0.5, 0.5],
];

/// Letters that are boxes.
fn boxes(is_flat: bool) -> Text {
    let outline = |[left, low, right, high]: [f64; 4]| {
        let corners = [[left, low], [right, low], [right, high], [left, high]];
        let mut outline = Outline::default();
        outline.add((0..4).map(|i| Piece::line(corners[i], corners[(i + 1) % 4])));
        outline
    };
    Text::new(BOXES.map(outline).to_vec(), is_flat).expect("a text")
}

fn outside_of_boxes(_: &Body, [x, y, z]: Triple) -> Double {
    let half = Double::of(0.5);
    let outside = |[left, low, right, high]: [f64; 4]| {
        let beside = |at: Double, low: f64, high: f64| {
            let (low, high) = (Double::of(low), Double::of(high));
            (at - (low + high) * half).abs() - (high - low) * half
        };
        greater(greater(beside(x, left, right), beside(y, low, high)), z.abs() - Double::of(1.0))
    };
    let all = BOXES.map(outside);
    all.into_iter().fold(all[0], |a, b| if (a - b).0 < 0.0 { a } else { b })
}

#[test]
fn letters_are_crossed_where_exact_arithmetic_crosses_them_and_are_one_where_they_overlap() {
    let mut random = Random(103);
    let mut crossed = 0;
    for _ in 0..tries() {
        let placed = placed(&mut random, Body::Text(boxes(false)));
        let ray = ray_at_placed(&mut random, &placed);
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, outside_of_boxes);
    }
    assert!(crossed > tries() / 2, "{crossed}");
}

#[test]
fn flat_letters_are_met_where_exact_arithmetic_is_inside_of_them() {
    let mut random = Random(104);
    let (mut met, mut missed) = (0, 0);
    for _ in 0..tries() {
        let placed = placed(&mut random, Body::Text(boxes(true)));
        let ray = ray_at_placed(&mut random, &placed);
        met += assert_crossed_where_it_is(&mut random, &placed, &ray, |_, [_, _, z]| z);
        let start = placed.placement.local_point(ray.origin);
        let step = placed.placement.local_direction(ray.direction);
        let t = -start.z / step.z;
        let off = 64.0 * blur(&placed, &ray) * step.length() / step.z.abs();
        if !(t.is_finite() && off.is_finite()) {
            continue;
        }
        let [x, y, _] = local_at(&placed, &ray, t, 0.0);
        let outside = outside_of_boxes(&placed.body, [x, y, Double::of(0.0)]).0;
        if outside.abs() > off {
            let found = placed.crossings(&ray);
            assert_eq!(found.len(), usize::from(outside < 0.0), "{found:?} {placed:?} {ray:?}");
            missed += usize::from(outside > 0.0);
        }
    }
    assert!(met > tries() / 20 && missed > tries() / 8, "{met} {missed}");
}

#[test]
fn of_the_ground_under_the_water_nothing_is_seen() {
    // It rises from x = −0.5 on; the line comes in level with its foot.
    let field = HeightField::new(vec![-0.5, 0.5, -0.5, 0.5], 2, 0.0, false).expect("a landscape");
    for height in [-0.5, -0.4375, -1e-9] {
        for way in [Vector::X, Vector::new(1.0, 0.0, 0.25).normalize()] {
            let ray = LocalRay::exact(Vector::Y * height, way);
            let mut found = Crossings::new();
            field.crossings(&ray, &mut found);
            assert!(!found.iter().any(Met::is_seen), "{height} {found:?}");
        }
    }
}
