//! A mesh in the World: once, at any size, anywhere.

use std::sync::Arc;

use super::build::texture_of;
use crate::color::{Color, Rgb};
use crate::math::elementary::sin_cos_degrees;
use crate::math::random::{Random, tries};
use crate::math::{UnitVector, Vector};
use crate::road::{Options, Road};
use crate::scene::Dialect;
use crate::shape::local::Local;
use crate::shape::{Body, Ray, Rounding};
use crate::source::{FileError, Files, Found};
use crate::world::{Pigment, Plain, Texture, World};

/// A triangle in three colours.
struct OneFile;

impl Files for OneFile {
    fn read(&self, name: &str, _: &str) -> Result<Found, FileError> {
        let bytes = b"v 0 0 0 1 0 0\nv 4 0 0 0 1 0\nv 0 4 0 0 0 1\nf 1 2 3\n".to_vec();
        match name {
            "a.obj" => Ok(Found { name: name.to_owned(), bytes }),
            _ => Err(FileError::NotFound { searched: Vec::new(), similar: Vec::new() }),
        }
    }
}

/// The World, and the codes of what was said.
fn world(text: &str) -> (World, Vec<&'static str>) {
    let text = format!("camera {{ location -9*z look_at 0 }} light_source {{ 9, rgb 1 }}\n{text}");
    let mut road = Road::new(&OneFile, Options::new(Dialect::Scene));
    let file = road.read("a.scene", text.into_bytes());
    let ast = road.parse(file);
    let scene = road.evaluate(ast);
    let (world, _) = road.lower(scene);
    let codes = road.diagnostics.iter().map(|one| one.code.name()).collect();
    (world, codes)
}

const PRIMARIES: [Rgb; 3] =
    [Rgb::new(1.0, 0.0, 0.0), Rgb::new(0.0, 1.0, 0.0), Rgb::new(0.0, 0.0, 1.0)];

const TETRAHEDRON: &str = "mesh2 {
    vertex_vectors { 4, <1, 1, 1>, <1, -1, -1>, <-1, 1, -1>, <-1, -1, 1> }
    face_indices { 4, <0, 1, 2>, <0, 2, 3>, <0, 3, 1>, <1, 3, 2> }
    inside_vector y
}";

#[test]
fn a_mesh_placed_ten_thousand_times_is_stored_once() {
    let scene = format!(
        "#declare M = {TETRAHEDRON}
        #for (I, 1, 5000) object {{ M translate I*x }} object {{ object {{ M scale I }} rotate I*y }} #end"
    );
    let (world, _) = world(&scene);
    assert_eq!(world.placed.len(), 10_000);
    let first = &world.placed[0].body;
    assert!(world.placed.iter().all(|placed| Arc::ptr_eq(&placed.body, first)));
    assert_eq!(Arc::strong_count(first), 10_000);
}

#[test]
fn a_mesh_from_a_file_named_ten_thousand_times_is_stored_once() {
    let scene = "#for (I, 1, 5000) mesh { file \"a.obj\" translate I*x } #end
        #declare M = mesh { file \"a.obj\" } #for (I, 1, 5000) object { M scale I } #end";
    let (world, codes) = world(scene);
    assert!(codes.is_empty(), "{codes:?}");
    assert_eq!((world.placed.len(), world.textures.len()), (10_000, 1));
    let first = &world.placed[0].body;
    assert!(world.placed.iter().all(|placed| Arc::ptr_eq(&placed.body, first)));
}

#[test]
fn the_colours_of_a_file_give_way_to_a_pigment_and_keep_a_finish() {
    let (world, codes) = world(
        "mesh { file \"a.obj\" finish { phong 1 } }
        mesh { file \"a.obj\" pigment { rgb 1 } }
        union { mesh { file \"a.obj\" } pigment { rgb 0.5 } }
        #declare M = mesh { file \"a.obj\" } object { M pigment { rgb 0.25 } }",
    );
    assert!(codes.is_empty(), "{codes:?}");
    let textures: Vec<&Plain> =
        (0..world.objects.len()).map(|index| texture_of(&world, index)).collect();
    let is_colored = |texture: &&Plain| matches!(texture.pigment, Pigment::Faces(_));
    let colored: Vec<bool> = textures.iter().map(is_colored).collect();
    assert_eq!(colored, [true, false, true, false]);
    assert_eq!(textures[0].finish.lobes.len(), 1);
    let Pigment::Faces(colors) = &textures[0].pigment else { unreachable!("it is colored") };
    assert_eq!(colors.len(), 3);
}

#[test]
fn whatever_is_made_of_many_numbers_and_placed_ten_thousand_times_is_stored_once() {
    for shape in [
        "blob { sphere { 0, 1, 2 } cylinder { 0, x, 1, 3 rotate 30*z } }",
        "sphere_sweep { b_spline 4, 0, 1, x, 2, y, 1, z, 1 }",
        "height_field { function 9, 5 { x*y } }",
        "bicubic_patch { #for (I, 0, 15) <mod(I, 4), I, I*I/9>, #end }",
        "polygon { 4, 0, x, x + y, y }",
        "text { \"many\" 1, 0 }",
    ] {
        let scene = format!("#declare M = {shape} #for (I, 1, 10000) object {{ M scale I }} #end");
        let (world, _) = world(&scene);
        assert_eq!(world.placed.len(), 10_000);
        let first = &world.placed[0].body;
        assert!(world.placed.iter().all(|placed| Arc::ptr_eq(&placed.body, first)));
    }
}

#[test]
fn a_mesh2_and_a_mesh_of_the_same_triangles_are_one() {
    let triangles = "mesh {
        triangle { <1, 1, 1>, <1, -1, -1>, <-1, 1, -1> }
        triangle { <1, 1, 1>, <-1, 1, -1>, <-1, -1, 1> }
        triangle { <1, 1, 1>, <-1, -1, 1>, <1, -1, -1> }
        triangle { <1, -1, -1>, <-1, -1, 1>, <-1, 1, -1> }
        inside_vector y
    }";
    let ((one, _), (other, _)) = (world(TETRAHEDRON), world(triangles));
    assert_eq!(one.placed, other.placed);
}

#[test]
fn a_mesh_is_as_large_as_it_was_written_and_where() {
    for size in ["1e-30", "1e-6", "1", "1e12", "1e100"] {
        for place in ["0", "<1, 2, -3>", "1e3*x"] {
            let moved = format!("object {{ {TETRAHEDRON} translate {place} scale {size} }}");
            let (vertices, rest) = TETRAHEDRON.split_once("face_indices").expect("both");
            let vertices = vertices.replace('>', ">)");
            let vertices = vertices.replace('<', &format!("{size}*({place} + <"));
            let written = format!("{vertices}face_indices{rest}");
            let [moved, written] = [moved, written].map(|scene| world(&scene).0);
            let [a, b] = [&moved, &written]
                .map(|world| world.placed[0].bounds(Rounding::Outward).expect("bounded"));
            let size = size.parse::<f64>().expect("a number");
            let off = (a.low - b.low).abs().max((a.high - b.high).abs()).max_element();
            assert!(off <= 1e-12 * 1e3 * size, "{a:?} {b:?}");
            let reach = written.placed[0].body.reach();
            assert!((0.25..2.0).contains(&reach), "{reach}");
        }
    }
}

#[test]
fn what_is_inside_of_a_mesh_is_told_by_its_vector_and_of_a_sheet_nothing_is() {
    let (solid, _) = world(TETRAHEDRON);
    let (sheet, _) = world(&TETRAHEDRON.replace("inside_vector y", ""));
    let corner = Vector::new(0.9, 0.9, 0.9);
    assert!(solid.placed[0].contains(corner) && !solid.placed[0].contains(-corner));
    assert!(!sheet.placed[0].contains(corner) && sheet.placed[0].body.is_sheet());
}

#[test]
fn a_triangle_that_is_a_line_is_told_and_left_out_of_its_mesh() {
    let (world, codes) =
        world("mesh { triangle { 0, x, 2*x } triangle { 0, x, y } triangle { y, y, z } }");
    assert_eq!(world.placed[0].body.numbers(), " of 1");
    assert_eq!(codes.iter().filter(|code| **code == "degenerate-shape").count(), 1, "{codes:?}");
}

#[test]
fn what_does_not_fit_in_a_mesh2_is_told() {
    let told = |from: &str, to: &str, code: &str| {
        let (world, codes) = world(&TETRAHEDRON.replace(from, to));
        assert!(codes.contains(&code), "{to}: {codes:?}");
        assert_eq!(world.placed.len(), 0, "{to}");
    };
    told("<0, 3, 1>", "<0, 4, 1>", "out-of-range");
    told("<0, 3, 1>", "<0, -1, 1>", "out-of-range");
    told("{ 4, <0", "{ 5, <0", "missing-part");
    told("{ 4, <0", "{ 3, <0", "extra-part");
    told("inside_vector", "normal_vectors { 1, y } inside_vector", "wrong-arity");
    told("inside_vector", "normal_indices { 1, 0 } inside_vector", "missing-part");
    told("<0, 3, 1>", "<0, 3, 1, 2>", "wrong-arity");
    told("inside_vector", "uv_vectors { 3, 0, 0, 0 } inside_vector", "wrong-arity");
    told("inside_vector", "uv_indices { 1, 0 } inside_vector", "out-of-range");
    let uvs = "uv_vectors { 1, 0 } uv_indices { 1, 0 } inside_vector";
    told("inside_vector", uvs, "wrong-arity");
    let normals = "normal_vectors { 1, y } normal_indices { 5, 0, 0, 0, 0, 0 } inside_vector";
    told("inside_vector", normals, "wrong-arity");
}

/// The tetrahedron with textures, and with these numbers behind its four faces.
fn textured(textures: &str, numbers: [&str; 4]) -> String {
    let mut text = TETRAHEDRON.replace("face_indices", &format!("{textures} face_indices"));
    for (face, numbers) in ["<0, 1, 2>", "<0, 2, 3>", "<0, 3, 1>", "<1, 3, 2>"].iter().zip(numbers)
    {
        text = text.replace(face, &format!("{face} {numbers}"));
    }
    text
}

const THREE: &str = "texture_list { 3, texture { pigment { rgb x } } texture { pigment { rgb y } },
    texture { pigment { rgb z } } }";

#[test]
fn what_does_not_fit_in_the_textures_of_a_mesh2_is_told() {
    let told = |text: &str, code: &str| {
        let (world, codes) = world(text);
        assert!(codes.contains(&code), "{text}: {codes:?}");
        assert_eq!(world.objects.len(), 0, "{text}");
    };
    told(&textured(THREE, [", 3", "", "", ""]), "out-of-range");
    told(&textured(THREE, [", -1", "", "", ""]), "out-of-range");
    told(&textured(THREE, [", 0, 1", "", "", ""]), "wrong-arity");
    told(&textured(THREE, [", 0, 1, 2, 0", "", "", ""]), "wrong-arity");
    told(&textured(THREE, ["", "", "", ", 1, <0, 1, 2>"]), "extra-part");
    told(&textured(THREE, ["", "", "", ", 1, y*2"]), "extra-part");
    told(&textured(THREE, ["", "", "", ", 1 } uv_indices {"]), "missing-part");
    told(&textured(&THREE.replace("3,", "4,"), [""; 4]), "wrong-arity");
    told(&textured(&THREE.replace("3,", "2,"), [""; 4]), "wrong-arity");
}

#[test]
fn faces_may_have_any_textures_and_the_meshs_own_is_the_last() {
    for (from, to) in [("rgb x", "checker"), ("{ rgb x }", "{ rgb x } finish { phong 1 }")] {
        let text = textured(&THREE.replace(from, to), [", 0, 1, 2", ", 1", "", ", 2"]);
        let (world, codes) = world(&text.replace("inside_vector y", "pigment { rgb 1 }"));
        assert!(codes.is_empty(), "{codes:?}");
        let Texture::Faces(textures) = &world.textures[world.objects[0].texture as usize] else {
            panic!("{:?}", world.textures)
        };
        assert_eq!(textures.len(), 4);
    }
}

#[test]
fn textures_of_the_components_of_a_blob_count_by_the_sizes_of_their_fields() {
    let (world, codes) = world(
        "blob {
            threshold 0.5
            sphere { -x/2, 1, 1 pigment { rgb x } }
            sphere { x/2, 1, 1 }
            sphere { y/4, 1, -0.25 pigment { rgb z } }
            pigment { rgb y }
        }",
    );
    assert!(codes.is_empty(), "{codes:?}");
    let Pigment::Faces(colors) = pigment(&world) else { panic!("{:?}", pigment(&world)) };
    assert_eq!(colors.len(), 3);
    let ray = Ray { origin: Vector::Z * 5.0, direction: -Vector::Z };
    let placed = &world.placed[0];
    let met = placed.crossings(&ray)[0];
    let surface = placed.surface(&ray, met.t, met.leaving);
    let field = |centre: Vector, strength: f64| {
        let inner = 1.0 - (surface.point - centre).length_squared();
        (strength * inner * inner).abs()
    };
    let mut fields = [field(Vector::X / 2.0, 1.0); 3];
    fields[1] = field(Vector::Y / 4.0, 0.25);
    let sum: f64 = fields.iter().sum();
    for (index, weight) in placed.paint(&surface).expect("it is painted") {
        assert!((weight - fields[index as usize] / sum).abs() < 1e-12);
    }
}

/// What is seen of the first object: its pigment.
fn pigment(world: &World) -> &Pigment {
    &texture_of(world, 0).pigment
}

#[test]
fn the_textures_of_faces_are_the_colours_of_one_pigment_and_the_meshs_own_is_the_last() {
    let primaries = PRIMARIES.map(Color::opaque);
    let (bare, codes) = world(
        &textured(THREE, [", 0, 1, 2", ", 1.9", "", ", 2"])
            .replace("inside_vector y", "pigment { rgb 1 }"),
    );
    assert!(codes.is_empty(), "{codes:?}");
    let Pigment::Faces(colors) = pigment(&bare) else { panic!("{:?}", pigment(&bare)) };
    assert_eq!(colors[..3], primaries);
    assert_eq!(colors[3], Color::opaque(Rgb::gray(1.0)));
    let painted = bare.placed[0].body.numbers();
    assert!(painted.contains("painted"), "{painted}");
    // What is not seen is no part of it.
    let dressed = textured(THREE, [", 0, 1, 2", ", 1", ", 1", ", 2"]);
    let (dressed, codes) = world(&dressed.replace("inside_vector y", "pigment { checker }"));
    assert!(codes.is_empty(), "{codes:?}");
    let Pigment::Faces(colors) = pigment(&dressed) else { panic!("{:?}", pigment(&dressed)) };
    assert_eq!(colors[..3], primaries);
    let (one, _) =
        world(&textured(THREE, [", 1"; 4]).replace("rgb x", "rgb y").replace("rgb z", "rgb y"));
    assert_eq!(*pigment(&one), Pigment::Color(Color::opaque(PRIMARIES[1])));
}

#[test]
fn a_mesh_and_a_mesh2_have_textures_and_places_in_one_alike() {
    let listed = "mesh2 {
        vertex_vectors { 4, 0, x, y, z } uv_vectors { 4, 0, <1, 0>, <0, 1>, 1 }
        texture_list { 3, texture { pigment { rgb x } } texture { pigment { rgb y } },
            texture { pigment { rgb z } } }
        face_indices { 2, <0, 1, 2>, 0, 1, 2, <0, 2, 3>, 0 }
        pigment { rgb 1 }
    }";
    let alone =
        "#declare R = texture { pigment { rgb x } } #declare G = texture { pigment { rgb y } }
        #declare B = texture { pigment { rgb z } }
        mesh {
            triangle { 0, x, y uv_vectors 0, <1, 0>, <0, 1> texture_list { R, G B } }
            triangle { 0, y, z texture { R } uv_vectors 0, <0, 1>, 1 }
            pigment { rgb 1 }
        }";
    let ((listed, codes), (alone, others)) = (world(listed), world(alone));
    assert!(codes.is_empty() && others.is_empty(), "{codes:?} {others:?}");
    assert_eq!(pigment(&listed), pigment(&alone));
    let seen = |world: &World, from: Vector| {
        let ray = Ray { origin: from, direction: -(Vector::ONE / 3f64.sqrt()) };
        let placed = &world.placed[0];
        let surface = {
            let met = placed.crossings(&ray)[0];
            placed.surface(&ray, met.t, met.leaving)
        };
        let Body::Mesh(mesh) = &*placed.body else { panic!("it is a mesh") };
        let local = placed.placement.local_point(surface.point);
        (placed.paint(&surface), mesh.uv(surface.face, local))
    };
    for from in [Vector::new(3.2, 3.3, 3.0), Vector::new(3.0, 3.1, 3.3)] {
        assert_eq!(seen(&listed, from), seen(&alone, from));
        assert!(seen(&listed, from).0.is_some() && seen(&listed, from).1.is_some());
    }
}

#[test]
fn faces_without_normals_are_the_last_and_flat() {
    let normals = "normal_vectors { 1, y } normal_indices { 1, 0 } pigment { rgb 1 }";
    let (world, codes) = world(&TETRAHEDRON.replace("inside_vector y", normals));
    assert!(codes.is_empty(), "{codes:?}");
    assert_eq!(world.placed.len(), 1);
}

#[test]
fn numbers_are_read_alike_whether_they_stand_alone_or_are_reckoned() {
    let reckoned =
        TETRAHEDRON.replace("<-1, 1, -1>", "<0-1, 2-1, -1>").replace("<0, 2, 3>", "<0, 1+1, 3>");
    assert_eq!(world(TETRAHEDRON).0.placed, world(&reckoned).0.placed);
}

#[test]
fn a_sheet_of_squares_has_no_holes_however_far_off_it_stands() {
    let mut random = Random(91);
    for offset in ["0", "<148376, 1234, -223423>", "1e7*<1, -1, 1>"] {
        for size in [1.0, 1e-3] {
            let scene = format!(
                "#declare S = {size}; #macro P(I, J) S*<I, J, 0> + {offset} #end
                mesh {{ #for (I, -8, 7) #for (J, -8, 7)
                    triangle {{ P(I, J), P(I + 1, J), P(I, J + 1) }}
                    triangle {{ P(I + 1, J), P(I + 1, J + 1), P(I, J + 1) }}
                #end #end }}"
            );
            assert_has_no_hole(&scene, size * 20.0, tries() / 4, || {
                let mut at = || match random.below(3) {
                    0 => random.below(13) as f64 - 6.0,
                    1 => random.below(25) as f64 * 0.5 - 6.0,
                    _ => random.number(-6.0, 6.0),
                };
                Vector::new(at(), at(), 0.0) * size
            });
        }
    }
}

#[test]
fn a_fan_of_800_slivers_has_no_holes_however_small_it_is() {
    let mut random = Random(92);
    let sizes = [("0", &[1.0, 1e-3, 1e-5, 1e-7][..]), ("<148376, 1234, -223423>", &[1.0, 1e-3])];
    for (offset, sizes) in sizes.into_iter().chain([("1e7*<1, -1, 1>", &[1.0, 1e-3][..])]) {
        for &size in sizes {
            let scene = format!(
                "#macro P(I) {size}*vrotate(x, I*0.45*z) + {offset} #end
                mesh {{ #for (I, 0, 799) triangle {{ {offset}, P(I), P(I + 1) }} #end }}"
            );
            assert_has_no_hole(&scene, size * 2.0, tries() / 8, || {
                // On a spoke, or anywhere; near the rim, near the hub, or in it.
                let turn = [random.below(800) as f64, random.number(0.0, 800.0)][random.below(2)];
                let far = [0.0, random.size(-9.0, 0.0), random.number(0.0, 1.0)][random.below(3)];
                let (sine, cosine) = sin_cos_degrees(turn * 0.45);
                Vector::new(cosine, sine, 0.0) * (far * 0.999 * size)
            });
        }
    }
}

/// Lines from `distance` away to targets of a level sheet, as seen from its middle, meet it once.
fn assert_has_no_hole(
    scene: &str,
    distance: f64,
    lines: usize,
    mut target: impl FnMut() -> Vector,
) {
    let mut random = Random(93);
    let (world, _) = world(scene);
    let placed = &world.placed[0];
    let middle = placed.placement.centre;
    for _ in 0..lines {
        let target = middle + target();
        let origin = middle + random.direction().get() * distance;
        let Some(direction) = UnitVector::from_direction(target - origin) else { continue };
        // Along the sheet it may pass by.
        if direction.get().z.abs() < 0.1 {
            continue;
        }
        let ray = Ray { origin, direction: direction.get() };
        let all = placed.crossings(&ray);
        assert_eq!(all.len(), 1, "{all:?} {ray:?} toward {target} in {scene}");
    }
}
