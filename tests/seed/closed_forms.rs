//! The reading itself, held against what can be worked out by hand.

use lucarne::color::Rgb;
use lucarne::math::Vector;
use lucarne::math::transform::Step;
use lucarne::scene::{LightKind, ObjectKind, Solid};

use super::forms::{Faces, Form, Pair, Plane, Ray, Sphere, rotate};
use super::page::Page;
use super::sketch::{Sketch, seed};

fn v(x: f64, y: f64, z: f64) -> Vector {
    Vector::new(x, y, z)
}

fn ray(s: Vector, d: Vector) -> Ray {
    Ray { s, d: d / d.length() }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-14 * a.abs().max(b.abs()).max(1.0)
}

fn near_vector(a: Vector, b: Vector) -> bool {
    (0..3).all(|i| near(a[i], b[i]))
}

#[test]
fn a_sphere_is_hit_at_its_near_pole_and_only_from_outside() {
    let form = Form::sphere(v(1.0, 2.0, 3.0), 2.0);
    let hit = form.hit(ray(v(1.0, 2.0, 13.0), -Vector::Z)).expect("a hit");
    assert_eq!((hit.t, hit.point, hit.normal), (8.0, v(1.0, 2.0, 5.0), Vector::Z));
    assert!(form.hit(ray(v(1.0, 2.0, 3.5), -Vector::Z)).is_none(), "from inside");
    assert!(form.hit(ray(v(1.0, 2.0, 13.0), Vector::Z)).is_none(), "moving away");
    assert!(form.hit(ray(v(3.0, 2.0, 13.0), -Vector::Z)).is_none(), "touching is a miss");
    // Off the centre by 6/5 of a radius 2: |AB| = 8/5.
    let hit = form.hit(ray(v(2.2, 2.0, 13.0), -Vector::Z)).expect("a hit");
    assert!(near(hit.t, 10.0 - 1.6) && near_vector(hit.normal, v(0.6, 0.0, 0.8)));
}

#[test]
fn a_plane_is_hit_from_its_outer_side_only() {
    let form = Form::plane(v(0.0, 3.0, 0.0), 2.0);
    assert_eq!(form, Form::Plane(Plane { n: Vector::Y, d: 2.0 }));
    let hit = form.hit(ray(v(0.0, 6.0, 0.0), v(3.0, -4.0, 0.0))).expect("a hit");
    assert!(near(hit.t, 5.0) && near_vector(hit.point, v(3.0, 2.0, 0.0)));
    assert_eq!(hit.normal, Vector::Y);
    assert!(form.hit(ray(Vector::ZERO, Vector::Y)).is_none(), "from inside");
    assert!(form.hit(ray(v(0.0, 2.0, 0.0), -Vector::Y)).is_none(), "from the plane itself");
    assert!(form.hit(ray(v(0.0, 6.0, 0.0), Vector::X)).is_none(), "parallel");
    assert!(form.hit(ray(v(0.0, 6.0, 0.0), Vector::Y)).is_none(), "moving away");
}

#[test]
fn a_box_is_hit_on_each_of_its_six_faces_and_only_from_outside() {
    let form = Form::cuboid([v(3.0, -2.0, 5.0), v(1.0, 4.0, -7.0)]);
    let centre = v(2.0, 1.0, -1.0);
    let half = v(1.0, 3.0, 6.0);
    let axes = [Vector::X, Vector::Y, Vector::Z];
    for (i, axis) in axes.into_iter().enumerate() {
        for n in [axis, -axis] {
            let hit = form.hit(ray(centre + n * 10.0, -n)).expect("a hit");
            assert_eq!((hit.t, hit.normal), (10.0 - half[i], n));
            assert!(form.hit(ray(centre, n)).is_none(), "from inside");
            let next = axes[(i + 1) % 3];
            let beside = centre + n * 10.0 + next * (half.dot(next) + 1e-9);
            assert!(form.hit(ray(beside, -n)).is_none(), "beside the face");
        }
    }
}

#[test]
fn the_canonical_box_has_the_signed_distances_of_the_page() {
    let Form::Box(Faces([x, ..])) = Form::cuboid([v(1.0, 0.0, 0.0), v(3.0, 2.0, 2.0)]) else {
        panic!("a box");
    };
    // The origin is inside the plane of the face at x = 3 and outside that of the face at x = 1.
    let (c_f, c_o) = (v(3.0, 1.0, 1.0), v(1.0, 1.0, 1.0));
    assert_eq!(x, Pair { n: Vector::X, c_f, d_f: 3.0, c_o, d_o: -1.0, l: 1.0 });
}

#[test]
fn rotations_go_about_x_then_y_then_z_by_the_right_hand() {
    assert!(near_vector(rotate(v(90.0, 0.0, 0.0), Vector::Y), Vector::Z));
    assert!(near_vector(rotate(v(0.0, 90.0, 0.0), Vector::Z), Vector::X));
    assert!(near_vector(rotate(v(0.0, 0.0, 90.0), Vector::X), Vector::Y));
    // y → z by the first, z → x by the second, x → y by the third.
    assert!(near_vector(rotate(v(90.0, 90.0, 90.0), Vector::Y), Vector::Y));
    assert!(near_vector(rotate(v(90.0, 90.0, 0.0), Vector::Y), Vector::X));
}

#[test]
fn each_transformation_acts_on_each_canonical_form_as_the_page_says() {
    let translate = Step::Translate(v(1.0, 2.0, 3.0));
    let double = Step::Scale(v(2.0, 2.0, 2.0));
    let mirror = Step::Scale(v(-2.0, -2.0, -2.0));
    let sphere = Form::sphere(v(1.0, 0.0, 0.0), 3.0);
    let c = v(2.0, 2.0, 3.0);
    assert_eq!(sphere.after(&translate), Form::Sphere(Sphere { c, r: 3.0 }));
    let c = v(-2.0, 0.0, 0.0);
    assert_eq!(sphere.after(&mirror), Form::Sphere(Sphere { c, r: 6.0 }));
    let plane = Form::plane(Vector::Y, 5.0);
    assert_eq!(plane.after(&translate), Form::Plane(Plane { n: Vector::Y, d: 7.0 }));
    assert_eq!(plane.after(&double), Form::Plane(Plane { n: Vector::Y, d: 10.0 }));
    assert_eq!(plane.after(&mirror), Form::Plane(Plane { n: -Vector::Y, d: 10.0 }));
}

/// What makes a box canonical, whatever was done to it.
fn assert_consistent(Faces(pairs): Faces) {
    let centre = (pairs[0].c_f + pairs[0].c_o) / 2.0;
    for p in pairs {
        assert!(near(p.n.length(), 1.0));
        assert!(near(p.d_f, p.n.dot(p.c_f)) && near(p.d_o, -p.n.dot(p.c_o)));
        assert!(near(p.n.dot(p.c_f - p.c_o), 2.0 * p.l) && p.l > 0.0);
        assert!(near_vector((p.c_f + p.c_o) / 2.0, centre));
        assert!(p.n.dot(p.c_f - centre) > 0.0, "outward");
    }
}

#[test]
fn a_box_stays_canonical_under_a_long_chain_of_steps() {
    let mut form = Form::cuboid([v(1.0, -2.0, 0.5), v(2.0, 4.0, 3.0)]);
    for turn in 0..12 {
        let i = f64::from(turn);
        for step in [
            Step::Rotate(v(10.0 * i, 70.0 - i, 3.0)),
            Step::Scale(Vector::ONE * if turn % 3 == 0 { -1.25 } else { 0.9 }),
            Step::Translate(v(i, -1.0, 0.25)),
        ] {
            form = form.after(&step);
            let Form::Box(faces) = form else { panic!("a box") };
            assert_consistent(faces);
        }
    }
}

#[test]
fn moving_the_ray_and_moving_the_object_give_the_same_hit() {
    let steps = [
        Step::Rotate(v(30.0, -50.0, 110.0)),
        Step::Translate(v(-3.0, 0.5, 2.0)),
        Step::Scale(Vector::ONE * -1.5),
    ];
    let point = |p: Vector| (rotate(v(30.0, -50.0, 110.0), p) + v(-3.0, 0.5, 2.0)) * -1.5;
    for form in [
        Form::sphere(v(0.2, 0.0, 0.1), 1.0),
        Form::plane(v(-1.0, 0.3, 1.0), 0.4),
        Form::cuboid([v(-1.0, -0.5, -0.7), v(0.5, 0.9, 0.8)]),
    ] {
        let (start, target) = (v(0.3, 0.4, 9.0), v(0.1, 0.2, 0.3));
        let before = form.hit(ray(start, target - start)).expect("a hit");
        let moved = steps.iter().fold(form, Form::after);
        let after = moved.hit(ray(point(start), point(target) - point(start))).expect("a hit");
        assert!(near(after.t, before.t * 1.5), "{form:?}");
        assert!(near_vector(after.point, point(before.point)), "{form:?}");
    }
}

#[test]
fn the_screen_stands_where_the_page_puts_it() {
    let eye = Page::read(&Sketch::new().scene).eye;
    // d = 10, l = 2, h = 1, α = 90°: the screen is at z = 10 − 2 / (2·tan 45°) = 9.
    assert!(near_vector(eye.screen(0.0, 1.0), v(-1.0, 0.0, 9.0)));
    assert!(near_vector(eye.screen(1.0, 0.0), v(1.0, 1.0, 9.0)));
    assert!(near_vector(eye.screen(0.5, 1.0), v(0.0, 0.0, 9.0)), "z passes the bottom's middle");
}

/// A white sphere at the origin, seen along −z, and a light.
fn ball(kd: f64, ks: f64, exponent: f64, to_light: Vector) -> Page {
    let mut sketch = Sketch::new();
    let texture = sketch.texture(Rgb::WHITE, seed(kd, ks, exponent));
    let kind = ObjectKind::Solid(Solid::Sphere { centre: Vector::ZERO, radius: 1.0 });
    let ball = sketch.object(kind, Some(texture), &[]);
    sketch.place(ball);
    sketch.light(LightKind::Direction { to_light }, Rgb::gray(0.5));
    Page::read(&sketch.scene)
}

fn at_the_pole(page: &Page) -> f64 {
    page.color(ray(Vector::Z * 10.0, -Vector::Z), None, 1).red
}

#[test]
fn the_colour_at_the_pole_of_a_sphere_is_the_formulas() {
    // Light 60° from the normal: N·L = ½, and H is 30° from both: N·H = √3/2.
    let to_light = v(0.0, 2.0 * 0.75f64.sqrt(), 1.0);
    assert!(near(at_the_pole(&ball(0.8, 0.0, 1.0, to_light)), 0.8 * 0.2 + 0.8 * 0.5 * 0.5));
    let phong = 0.75f64.powi(4); // (√3/2)⁸
    assert!(near(at_the_pole(&ball(0.0, 0.6, 8.0, to_light)), 0.6 * 0.5 * phong));
    // Behind the surface, a light gives nothing, not even a highlight.
    assert!(near(at_the_pole(&ball(0.8, 0.6, 1.0, v(0.0, 1.0, -1e-9))), 0.8 * 0.2));
}

#[test]
fn a_colour_counts_at_most_one() {
    assert_eq!(at_the_pole(&ball(5.0, 0.0, 1.0, Vector::Z)), 1.0);
}

/// Two planes that face each other across the origin, both grey mirrors that emit light.
fn corridor(ks: f64, bound: u32) -> f64 {
    let mut sketch = Sketch::new();
    sketch.scene.settings.max_trace_level = bound;
    let texture = sketch.texture(Rgb::WHITE, seed(0.5, ks, 1.0));
    for normal in [Vector::Z, -Vector::Z] {
        // Each looks at the other: its outer side is toward the origin.
        let kind = ObjectKind::Solid(Solid::Plane { normal, distance: -1.0 });
        let wall = sketch.object(kind, Some(texture), &[]);
        sketch.place(wall);
    }
    Page::read(&sketch.scene).color(ray(Vector::ZERO, v(0.0, 0.3, -1.0)), None, 1).red
}

#[test]
fn five_means_the_cameras_ray_and_four_reflections() {
    let emission = 0.5 * 0.2;
    let sum = |n: i32| emission * (0..n).map(|i| 0.5f64.powi(i)).sum::<f64>();
    assert!(near(corridor(0.5, 5), sum(5)));
    assert!(near(corridor(0.5, 1), sum(1)));
    assert!(near(corridor(0.5, 2), sum(2)));
}

#[test]
fn the_clamp_is_inside_the_recursion_too() {
    // The mirrored colour grows beyond 1 within the reflections, and counts as 1 at each.
    let c5 = 0.1;
    let c4 = 0.1 + 20.0 * c5;
    assert!(c4 > 1.0);
    assert_eq!(corridor(20.0, 5), 1.0);
    // With ks = 3: 0.1, 0.4, 1 (not 1.3), and so on: without the clamp the third is 1.3.
    assert!(near(corridor(3.0, 3), 1.0));
    assert!(near(corridor(3.0, 2), 0.1 + 3.0 * 0.1));
}

#[test]
fn an_object_shadows_another_and_a_light_before_it_does_not() {
    let lit = |light: LightKind| {
        let mut sketch = Sketch::new();
        let texture = sketch.texture(Rgb::WHITE, seed(1.0, 0.0, 1.0));
        let floor = ObjectKind::Solid(Solid::Plane { normal: Vector::Y, distance: 0.0 });
        let ball = ObjectKind::Solid(Solid::Sphere { centre: v(0.0, 5.0, 0.0), radius: 1.0 });
        for kind in [floor, ball] {
            let object = sketch.object(kind, Some(texture), &[]);
            sketch.place(object);
        }
        sketch.light(light, Rgb::gray(0.5));
        let page = Page::read(&sketch.scene);
        page.color(ray(v(3.0, 3.0, 0.0), v(-1.0, -1.0, 0.0)), None, 1).red
    };
    assert!(near(lit(LightKind::Direction { to_light: Vector::Y }), 0.2), "in the ball's shadow");
    assert!(near(lit(LightKind::Direction { to_light: v(0.0, 3.0, 4.0) }), 0.2 + 0.5 * 0.6));
    assert!(near(lit(LightKind::Point { location: v(0.0, 9.0, 0.0) }), 0.2), "behind the ball");
    assert!(near(lit(LightKind::Point { location: v(0.0, 3.0, 0.0) }), 0.7), "before the ball");
    assert!(near(lit(LightKind::Point { location: v(0.0, 5.0, 0.0) }), 0.2), "inside the ball");
}

#[test]
fn a_unions_transform_follows_its_childrens() {
    let mut sketch = Sketch::new();
    let texture = sketch.texture(Rgb::WHITE, seed(1.0, 0.0, 1.0));
    let kind = ObjectKind::Solid(Solid::Sphere { centre: Vector::X, radius: 1.0 });
    let child = sketch.object(kind, None, &[Step::Translate(Vector::Y)]);
    let union = sketch.object(
        ObjectKind::Union(vec![child, child]),
        Some(texture),
        &[Step::Scale(Vector::ONE * 2.0)],
    );
    let used = sketch.object(ObjectKind::Use(union), None, &[Step::Translate(Vector::Z)]);
    sketch.place(used);
    let page = Page::read(&sketch.scene);
    let c = v(2.0, 2.0, 1.0);
    assert_eq!(page.objects[0].form, Form::Sphere(Sphere { c, r: 2.0 }));
    assert_eq!((page.objects.len(), page.objects[0]), (2, page.objects[1]));
}
