//! Textures: which of them wins, what moves them, what is shared. The numbers marked "measured" are
//! POV-Ray 3.7's.

use super::build::*;
use super::seed_rules::Numbers;
use crate::color::{Color, Rgb};
use crate::math::Vector;
use crate::math::transform::Step;
use crate::scene::*;
use crate::texture::Space;
use crate::texture::space::{Nowhere, Place, Start};
use crate::world::{self, World};

/// The space in which a patterned pigment is evaluated.
fn space(pigment: &world::Pigment) -> &Space {
    match pigment {
        world::Pigment::Ramp(blend) => &blend.space,
        other => panic!("a pattern: {other:?}"),
    }
}

fn is_patterned(world: &World, index: usize) -> bool {
    matches!(texture_of(world, index).pigment, world::Pigment::Ramp(_))
}

/// Where the pattern of object `index` finds the world's point `p`.
fn pattern_point(world: &World, index: usize, p: Vector) -> Vector {
    let space = space(&texture_of(world, index).pigment);
    assert_eq!(*space, Space { start: Start::Slot(0), steps: vec![] });
    match world.objects[index].places {
        Some(map) => world.texture_maps[map as usize].point(p),
        None => p,
    }
}

/// The pattern point under the world's origin for a ball with these modifiers.
fn under_origin(modifiers: impl Fn(&mut Build) -> Vec<ModifierKind>) -> Vector {
    let mut build = Build::new();
    let modifiers = modifiers(&mut build);
    let object = build.object(sphere(0.0, 0.0, 0.0, 9.0), modifiers);
    build.root(object);
    pattern_point(&build.world(), 0, Vector::ZERO)
}

fn moved(build: &mut Build, x: f64) -> ModifierKind {
    ModifierKind::Transform(build.transform(vec![translate(x, 0.0, 0.0)]))
}

fn checkered(build: &mut Build, steps: Vec<Step>) -> PigmentId {
    build.pigment(super::build::checker(), steps)
}

#[test]
fn a_transform_moves_the_texture_before_it_and_not_the_one_after() {
    let before = under_origin(|b| vec![moved(b, 8.0), ModifierKind::Texture(CHECKER)]);
    assert_eq!(before, Vector::ZERO);
    let after = under_origin(|b| vec![ModifierKind::Texture(CHECKER), moved(b, 1.0)]);
    assert_eq!(after, v(-1.0, 0.0, 0.0), "measured");
    let between =
        under_origin(|b| vec![moved(b, 1.0), ModifierKind::Texture(CHECKER), moved(b, 2.0)]);
    assert_eq!(between, v(-2.0, 0.0, 0.0));
}

#[test]
fn pigment_texture_and_object_move_a_pattern_in_that_order() {
    let point = under_origin(|b| {
        let pigment = checkered(b, vec![scale(2.0, 2.0, 2.0)]);
        let texture = b.texture(pigment, vec![translate(1.0, 0.0, 0.0)]);
        let turn = b.transform(vec![rotate(0.0, 0.0, 90.0)]);
        vec![ModifierKind::Texture(texture), ModifierKind::Transform(turn), moved(b, 3.0)]
    });
    // −3 along x, then turned back to (0, 3), then moved back to (−1, 3), then halved.
    assert_eq!(point, v(-0.5, 1.5, 0.0));
}

#[test]
fn a_new_pigment_has_all_of_its_placement_itself() {
    let point = under_origin(|b| {
        let pigment = checkered(b, vec![translate(1.0, 0.0, 0.0)]);
        vec![
            ModifierKind::Texture(PLAIN),
            moved(b, 1.0),
            ModifierKind::Pigment(pigment),
            moved(b, 0.5),
        ]
    });
    assert_eq!(point, v(-1.5, 0.0, 0.0));
}

#[test]
fn a_childs_own_texture_wins_and_else_the_parents_which_the_child_does_not_move() {
    let mut build = Build::new();
    let own = vec![ModifierKind::Texture(PLAIN)];
    let dressed = build.object(sphere(0.0, 0.0, 0.0, 1.0), own);
    let bare = build.moved(sphere(0.0, 0.0, 0.0, 1.0), vec![translate(1.0, 0.0, 0.0)]);
    let half = moved(&mut build, 0.5);
    let union = ObjectKind::Union(vec![dressed, bare]);
    let union = build.object(union, vec![ModifierKind::Texture(CHECKER), half]);
    build.root(union);
    let world = build.world();
    assert!(!is_patterned(&world, 0) && is_patterned(&world, 1));
    assert_eq!(pattern_point(&world, 1, Vector::ZERO), v(-0.5, 0.0, 0.0), "measured");
    assert_eq!(world.objects[0].places, None);
}

#[test]
fn the_default_texture_is_the_roots_and_stays_in_the_world() {
    let mut build = Build::new();
    let bare = build.moved(sphere(0.0, 0.0, 0.0, 1.0), vec![translate(1.0, 0.0, 0.0)]);
    let union = build.moved(ObjectKind::Union(vec![bare]), vec![translate(0.5, 0.0, 0.0)]);
    build.0.roots.push(Root { object: union, default_texture: CHECKER });
    let world = build.world();
    assert_eq!(pattern_point(&world, 0, Vector::ZERO), Vector::ZERO, "measured");
    assert!(is_patterned(&world, 0));
}

#[test]
fn the_texture_of_a_use_replaces_the_objects_own_but_not_its_childrens() {
    let mut build = Build::new();
    let ball = build.object(sphere(0.0, 0.0, 0.0, 1.0), vec![ModifierKind::Texture(PLAIN)]);
    let repainted = build.object(ObjectKind::Use(ball), vec![ModifierKind::Texture(CHECKER)]);
    let union = build.object(ObjectKind::Union(vec![ball]), vec![]);
    let used = build.object(ObjectKind::Use(union), vec![ModifierKind::Texture(CHECKER)]);
    build.root(repainted);
    build.root(used);
    let world = build.world();
    assert!(is_patterned(&world, 0), "measured");
    assert!(!is_patterned(&world, 1), "measured");
}

#[test]
fn equal_textures_and_equal_maps_are_one() {
    let mut build = Build::new();
    for _ in 0..3 {
        let pigment = build.pigment(PigmentKind::Color(Color::opaque(Rgb::gray(0.25))), vec![]);
        let texture = build.texture(pigment, vec![]);
        let plain = build.object(sphere(0.0, 0.0, 0.0, 1.0), vec![ModifierKind::Texture(texture)]);
        build.root(plain);
        let pigment = checkered(&mut build, vec![translate(0.5, 0.0, 0.0)]);
        let texture = build.texture(pigment, vec![]);
        let ball = build.object(sphere(0.0, 0.0, 0.0, 1.0), vec![ModifierKind::Texture(texture)]);
        build.root(ball);
    }
    let (world, origins, _) = build.lower();
    assert_eq!((world.textures.len(), world.texture_maps.len()), (2, 1));
    assert_eq!(origins.textures.len(), 2);
}

#[test]
fn maps_that_differ_stay_apart() {
    let mut build = Build::new();
    for x in [1.0, 2.0] {
        let away = moved(&mut build, x);
        let modifiers = vec![ModifierKind::Texture(CHECKER), away];
        let ball = build.object(sphere(0.0, 0.0, 0.0, 1.0), modifiers);
        build.root(ball);
    }
    let world = build.world();
    assert_eq!(pattern_point(&world, 0, Vector::ZERO), v(-1.0, 0.0, 0.0));
    assert_eq!(pattern_point(&world, 1, Vector::ZERO), v(-2.0, 0.0, 0.0));
}

#[test]
fn ambient_is_lit_by_the_ambient_light_and_emission_is_not() {
    let mut build = Build::new();
    build.0.settings.ambient_light = Rgb::gray(0.5);
    let (ambient, emission) = (Rgb::gray(0.25), Rgb::gray(1.0));
    build.0.finishes[0] =
        Finish::Classic(ClassicFinish { ambient, emission, ..Default::default() });
    let object = build.object(sphere(0.0, 0.0, 0.0, 1.0), vec![]);
    build.root(object);
    assert_eq!(texture_of(&build.world(), 0).finish.emission, Rgb::gray(1.125));
}

#[test]
fn a_pattern_of_one_colour_is_that_colour() {
    let mut build = Build::new();
    let pigment = build.pigment(checker_of([Color::WHITE; 2]), vec![scale(3.0, 3.0, 3.0)]);
    let texture = build.texture(pigment, vec![]);
    let ball = build.object(plane(0.0, 1.0, 0.0, 1.0), vec![ModifierKind::Texture(texture)]);
    build.root(ball);
    let world = build.world();
    assert_eq!(texture_of(&world, 0).pigment, world::Pigment::Color(Color::WHITE));
    assert_eq!((world.objects[0].places, world.objects[0].faces), (None, None));
}

#[test]
fn a_checkered_plane_stays_on_its_lattice_wherever_it_is_turned_and_lifted() {
    let mut numbers = Numbers::new(11);
    for _ in 0..50 {
        let mut build = Build::new();
        let turn = numbers.vector(180.0);
        let lift = numbers.vector(1e7);
        let steps = vec![Step::Rotate(turn), Step::Translate(lift)];
        let away = ModifierKind::Transform(build.transform(steps));
        let ground = plane(0.0, 1.0, 0.0, 3.0);
        let plane = build.object(ground, vec![ModifierKind::Texture(CHECKER), away]);
        build.root(plane);
        let world = build.world();
        assert_eq!(world.faces.len(), 1);
        assert_eq!(world.faces[0].0, [None, Some(3.0), None]);
    }
}

#[test]
fn a_parents_checker_meets_a_moved_child_where_the_child_is() {
    let mut build = Build::new();
    let ground = plane(0.0, 1.0, 0.0, 1.0);
    let child = build.moved(ground, vec![rotate(0.0, 20.0, 90.0), translate(2.5, 7.0, 7.0)]);
    let steps = vec![rotate(11.0, 22.0, 33.0), translate(1e7, -1e7, 3e6)];
    let away = ModifierKind::Transform(build.transform(steps));
    let union = ObjectKind::Union(vec![child]);
    let union = build.object(union, vec![ModifierKind::Texture(CHECKER), away]);
    build.root(union);
    assert_eq!(build.world().faces[0].0, [Some(1.5), None, None]);
}

#[test]
fn a_face_knows_its_coordinate_also_when_the_pigment_itself_is_turned_with_it() {
    let mut build = Build::new();
    let pigment = checkered(&mut build, vec![rotate(0.0, 0.0, 30.0), translate(0.0, 5.0, 0.0)]);
    let texture = build.texture(pigment, vec![]);
    let (s, c) = crate::math::elementary::sin_cos_degrees(30.0);
    let mut tilted = |steps: Vec<Step>, normal: Vector| {
        let moved = ModifierKind::Transform(build.transform(steps));
        let kind = ObjectKind::Solid(Solid::Plane { normal, distance: 0.0 });
        let object = build.object(kind, vec![moved, ModifierKind::Texture(texture)]);
        build.root(object);
    };
    tilted(vec![rotate(0.0, 0.0, 30.0), translate(0.0, 5.0, 0.0)], Vector::Y);
    tilted(vec![], v(-s, c, 0.0));
    let world = build.world();
    assert_eq!(world.faces[0].0, [None, Some(0.0), None]);
    // Rounded sines are not parallel to exact ones.
    assert_eq!(world.faces[1].0, [None; 3]);
}

#[test]
fn a_boxs_faces_come_in_the_order_of_its_canonical_normals() {
    let mut build = Build::new();
    let turn = ModifierKind::Transform(build.transform(vec![rotate(0.0, 0.0, 90.0)]));
    let solid = box_(v(1.0, 2.0, 3.0), v(4.0, 6.0, 8.0));
    let object = build.object(solid, vec![ModifierKind::Texture(CHECKER), turn]);
    build.root(object);
    let world = build.world();
    let only = |axis: usize, value: f64| {
        let mut coordinates = [None; 3];
        coordinates[axis] = Some(value);
        coordinates
    };
    let faces: Vec<_> = world.faces.iter().map(|face| face.0).collect();
    // The world's +x face is the local −y face.
    let expected =
        [only(1, 2.0), only(1, 6.0), only(0, 4.0), only(0, 1.0), only(2, 8.0), only(2, 3.0)];
    assert_eq!(faces, expected);
    // And that is what the tracer would compute on each face.
    let solid = world.boxes[0];
    for (i, face) in faces.iter().enumerate() {
        let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
        let on_face = solid.centre + solid.normals[i / 2].get() * (solid.half_widths[i / 2] * sign);
        let point = pattern_point(&world, 0, on_face);
        for axis in 0..3 {
            assert!(face[axis].is_none_or(|value| (value - point[axis]).abs() < 1e-14));
        }
    }
}

#[test]
fn faces_agree_with_the_map_on_every_face_of_any_parallelepiped() {
    let mut numbers = Numbers::new(5);
    for _ in 0..200 {
        let mut build = Build::new();
        let steps = vec![
            Step::Rotate(numbers.vector(180.0)),
            Step::Scale(numbers.vector(2.0) + v(0.1, 0.1, 0.1)),
        ];
        let steps = [steps.clone(), vec![Step::Translate(numbers.vector(3.0))], steps].concat();
        let moved = ModifierKind::Transform(build.transform(steps));
        let solid = box_(numbers.vector(1.0), numbers.vector(1.0) + v(3.0, 3.0, 3.0));
        let object = build.object(solid, vec![ModifierKind::Texture(CHECKER), moved]);
        build.root(object);
        let world = build.world();
        let solid = world.boxes[0];
        for (i, face) in world.faces.iter().enumerate() {
            let n = solid.normals.map(|n| n.get());
            // The point of the face's plane that lies on the two other middle planes.
            let (a, b) = (n[(i / 2 + 1) % 3], n[(i / 2 + 2) % 3]);
            let along = a.cross(b);
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            let reach = sign * solid.half_widths[i / 2] / along.dot(n[i / 2]);
            let point = pattern_point(&world, 0, solid.centre + along * reach);
            let constant: Vec<_> = (0..3).filter_map(|axis| Some((axis, face.0[axis]?))).collect();
            assert_eq!(constant.len(), 1);
            let (axis, value) = constant[0];
            assert!((value - point[axis]).abs() < 1e-9 * (1.0 + along.length() * reach.abs()));
        }
    }
}

#[test]
fn the_skys_patterns_keep_their_own_places() {
    let mut build = Build::new();
    let pigment = checkered(&mut build, vec![scale(2.0, 2.0, 2.0)]);
    let turn = build.transform(vec![translate(-1.0, 0.0, 0.0)]);
    build.0.sky_sphere = Some(SkySphere {
        pigments: vec![pigment],
        transforms: vec![turn],
        emission: Rgb::WHITE,
        site: site(7),
        items: vec![],
    });
    let (world, origins, _) = build.lower();
    let sky = world.sky.expect("a sky");
    let origin = Nowhere::exact(Vector::ZERO);
    let place = Place::new(space(&sky.pigments[0]), None, &origin);
    assert_eq!(place.point, v(0.5, 0.0, 0.0));
    assert_eq!(origins.sky.map(|sky| sky.site), Some(site(7)));
}

#[test]
fn the_seeds_finish_is_its_formula() {
    let mut build = Build::new();
    build.0.settings.ambient_light = Rgb::new(1.0, 0.5, 0.0);
    build.0.finishes[0] = Finish::Seed { kd: 0.5, ks: 0.25, phong_exponent: 20.0 };
    let object = build.object(sphere(0.0, 0.0, 0.0, 1.0), vec![]);
    build.root(object);
    let finish = texture_of(&build.world(), 0).finish.clone();
    assert_eq!(finish.emission, Rgb::new(0.5, 0.25, 0.0));
    assert_eq!((finish.diffuse, finish.brilliance, finish.seed), (0.5, 1.0, true));
    let kind = world::LobeKind::Blinn;
    assert_eq!(finish.lobes, [world::Lobe { kind, weight: 0.25, exponent: 20.0, metallic: 1.0 }]);
    assert_eq!(finish.reflection.map(|r| (r.minimum, r.metallic)), Some((Rgb::gray(0.25), 0.0)));
}

#[test]
fn what_a_finish_gives_no_weight_is_absent() {
    let lowered = |finish: ClassicFinish| {
        let mut build = Build::new();
        build.0.finishes[0] = Finish::Classic(finish);
        let object = build.object(sphere(0.0, 0.0, 0.0, 1.0), vec![]);
        build.root(object);
        texture_of(&build.world(), 0).finish.clone()
    };
    let black = Reflection {
        fresnel: false,
        maximum: Rgb::BLACK,
        minimum: Rgb::BLACK,
        falloff: 1.0,
        exponent: 1.0,
        metallic: 0.0,
    };
    let dull =
        lowered(ClassicFinish { reflection: Some(Box::new(black.clone())), ..Default::default() });
    assert!(dull.lobes.is_empty() && dull.reflection.is_none());
    assert_eq!(dull.emission, Rgb::gray(0.1));
    let bright = lowered(ClassicFinish {
        phong: 0.5,
        specular: 0.25,
        roughness: 0.125,
        metallic: 0.75,
        reflection: Some(Box::new(Reflection { maximum: Rgb::WHITE, ..black })),
        ..Default::default()
    });
    let lobes: Vec<_> = bright.lobes.iter().map(|l| (l.weight, l.exponent, l.metallic)).collect();
    assert_eq!(lobes, [(0.5, 40.0, 0.75), (0.25, 8.0, 0.75)]);
    assert!(bright.reflection.is_some());
}

#[test]
fn no_shadow_reaches_every_child() {
    let mut build = Build::new();
    let ball = build.object(sphere(0.0, 0.0, 0.0, 1.0), vec![]);
    let still = build.object(sphere(0.0, 0.0, 0.0, 1.0), vec![ModifierKind::NoShadow]);
    let union = build.object(ObjectKind::Union(vec![ball]), vec![ModifierKind::NoShadow]);
    let both = build.object(ObjectKind::Union(vec![union, still, ball]), vec![]);
    build.root(both);
    let shadows: Vec<_> = build.world().objects.iter().map(|o| o.casts_shadow).collect();
    assert_eq!(shadows, [false, false, true]);
}
