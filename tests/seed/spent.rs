//! Spending one affine map on an object equals applying the page's rules step by step.

use lucarne::diagnostic::Diagnostics;
use lucarne::lower::{LowerOptions, lower};
use lucarne::math::Vector;
use lucarne::scene::Scene;
use lucarne::shape::Shape;
use lucarne::world::World;

use super::forms::{Faces, Form, Pair, Plane, Sphere};
use super::page::Page;
use crate::dice::Dice;

/// The canonical forms of a World, in the page's terms and in written order.
fn forms(world: &World) -> Vec<Form> {
    let objects = world.objects.iter();
    objects
        .map(|object| match object.shape {
            Shape::Sphere(i) => {
                let sphere = &world.spheres[i as usize];
                Form::Sphere(Sphere { c: sphere.centre, r: sphere.radius })
            }
            Shape::Plane(i) => {
                let plane = &world.planes[i as usize];
                Form::Plane(Plane { n: plane.normal.get(), d: plane.distance })
            }
            Shape::Box(i) => Form::Box(Faces([0, 1, 2].map(|axis| {
                let face = world.boxes[i as usize].face(axis);
                Pair {
                    n: face.normal.get(),
                    c_f: face.centre,
                    d_f: face.distance,
                    c_o: face.opposite_centre,
                    d_o: face.opposite_distance,
                    l: face.half_width,
                }
            }))),
            other => panic!("no form of the page: {other:?}"),
        })
        .collect()
}

fn apart(a: Vector, b: Vector) -> f64 {
    (a - b).length()
}

fn pairs(a: &Pair, b: &Pair) -> f64 {
    let size = b.c_f.length() + b.c_o.length() + b.l;
    let lengths = (a.d_f - b.d_f).abs() + (a.d_o - b.d_o).abs() + (a.l - b.l).abs();
    apart(a.n, b.n) + (apart(a.c_f, b.c_f) + apart(a.c_o, b.c_o) + lengths) / size
}

/// The largest difference between two forms, in units of their size and distance.
fn difference(a: Form, b: Form) -> f64 {
    match (a, b) {
        (Form::Sphere(a), Form::Sphere(b)) => {
            (apart(a.c, b.c) + (a.r - b.r).abs()) / (b.c.length() + b.r)
        }
        (Form::Plane(a), Form::Plane(b)) => apart(a.n, b.n) + (a.d - b.d).abs() / (1.0 + b.d.abs()),
        // Any three faces that share a vertex will do: each pair of one box is some pair of the
        // other, seen from the face or from its opposite.
        (Form::Box(Faces(a)), Form::Box(Faces(b))) => b
            .iter()
            .map(|b| {
                a.iter()
                    .map(|a| pairs(a, b).min(pairs(&a.opposite(), b)))
                    .fold(f64::INFINITY, f64::min)
            })
            .fold(0.0, f64::max),
        _ => f64::INFINITY,
    }
}

fn world(scene: Scene) -> World {
    let mut diagnostics = Diagnostics::new(false);
    let (world, _) = lower(scene, &LowerOptions::default(), &mut diagnostics);
    assert!(!diagnostics.has_errors(), "{diagnostics:?}");
    world
}

/// Every object of the World has the canonical form that the page's rules give it.
pub fn assert_spent_as_the_page_says(page: &Page, world: &World, what: &str) {
    let forms = forms(world);
    assert_eq!(forms.len(), page.objects.len(), "{what}");
    for (spent, object) in forms.into_iter().zip(&page.objects) {
        let apart = difference(spent, object.form);
        assert!(apart < 1e-12, "{what}: apart by {apart:e}\n{spent:?}\n{:?}", object.form);
    }
}

#[test]
fn one_affine_map_equals_the_pages_rules_in_sequence() {
    for number in 0..300 {
        let scene = Dice(number).scene();
        let page = Page::read(&scene);
        assert_spent_as_the_page_says(&page, &world(scene), &format!("dice {number}"));
    }
}

#[test]
fn a_form_that_is_off_by_a_millionth_is_told_apart() {
    let scene = Dice(7).scene();
    for o in 0..Page::read(&scene).objects.len() {
        let mut page = Page::read(&scene);
        let step = lucarne::math::transform::Step::Scale(Vector::ONE * (1.0 + 1e-6));
        page.objects[o].form = page.objects[o].form.after(&step);
        let forms = forms(&world(scene.clone()));
        assert!(difference(forms[o], page.objects[o].form) > 1e-8);
    }
}
