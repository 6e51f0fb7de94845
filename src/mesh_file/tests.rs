//! Tiny files of each format, whole and broken.

use proptest::prelude::*;

use super::*;
use crate::color::srgb_decode;
use crate::math::Vector;

const MOST: u64 = 1 << 24;
/// What stands before the document of a binary glTF.
const GLB_HEAD: usize = 20;

fn read_alone(name: &str, bytes: &[u8]) -> Result<Model, Fault> {
    read(name, bytes, &mut |_| Err("which is not found".to_owned()), MOST)
}

#[track_caller]
fn model(name: &str, bytes: impl AsRef<[u8]>) -> Model {
    read_alone(name, bytes.as_ref()).unwrap_or_else(|fault| panic!("{fault:?}"))
}

/// Where it fails, and why.
#[track_caller]
fn fault(name: &str, bytes: impl AsRef<[u8]>) -> (Option<Place>, String) {
    match read_alone(name, bytes.as_ref()) {
        Err(Fault { place, reason, .. }) => (place, reason),
        Ok(model) => panic!("read: {model:?}"),
    }
}

/// The corners of each face, as a left-handed space sees them turn left.
fn corners(model: &Model) -> Vec<[[f64; 3]; 3]> {
    let Triangles { vertices, faces, .. } = &model.triangles;
    let place = |i: u32| vertices[i as usize].to_array();
    faces.iter().map(|face| face.vertices.map(place)).collect()
}

fn colors(model: &Model) -> Vec<[[f64; 3]; 3]> {
    let color = |i: u32| model.colors[i as usize].rgb.components();
    model.triangles.faces.iter().map(|face| face.paint.expect("painted").map(color)).collect()
}

const O: [f64; 3] = [0.0; 3];
const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const XY: [f64; 3] = [1.0, 1.0, 0.0];

const PLY_HEAD: &str = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    property uchar red\nproperty uchar green\nproperty uchar blue\n\
    element face 1\nproperty list uchar int vertex_indices\nend_header\n";

/// A square as binary PLY of either order.
fn binary_ply(big: bool) -> Vec<u8> {
    let order = if big { "binary_big_endian" } else { "binary_little_endian" };
    let mut bytes = format!("ply\nformat {order} 1.0\ncomment caf\u{e9}\n{PLY_HEAD}").into_bytes();
    let float = |number: f32| if big { number.to_be_bytes() } else { number.to_le_bytes() };
    let int = |number: i32| if big { number.to_be_bytes() } else { number.to_le_bytes() };
    for (vertex, red) in [(O, 255), (X, 0), (XY, 0), (Y, 255)] {
        vertex.iter().for_each(|number| bytes.extend(float(*number as f32)));
        bytes.extend([red, 0, 0]);
    }
    bytes.push(4);
    (0..4).for_each(|index| bytes.extend(int(index)));
    bytes
}

#[test]
fn a_ply_is_read_as_text_and_in_binary_of_either_order() {
    let text = format!(
        "ply\nformat ascii 1.0\n{PLY_HEAD}0 0 0 255 0 0\n1 0 0 0 0 0\n1 1 0 0 0 0\n0 1 0 255 0 0\n4 0 1 2 3\n"
    );
    let read = model("a.ply", &text);
    assert_eq!(corners(&read), [[O, XY, X], [O, Y, XY]]);
    assert_eq!(colors(&read), [[X, O, O], [X, X, O]]);
    for big in [false, true] {
        assert_eq!(model("a.PLY", binary_ply(big)), read, "{big}");
    }
}

#[test]
fn normals_and_colours_of_faces_in_a_ply_are_kept() {
    let text = "ply\nformat ascii 1.0\nelement vertex 3\n\
        property double x\nproperty double y\nproperty double z\n\
        property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n\
        element other 2\nproperty int a\nproperty list uchar float b\n\
        element face 2\nproperty list uchar uint vertex_index\n\
        property float red\nproperty float green\nproperty float blue\nproperty uchar alpha\nend_header\n\
        0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n0.1 1 0 0 0.5 1 0 1\n7 2 0.5 0.5\n8 0\n\
        3 0 1 2 0 0.5 1 51\n3 0 2 1 0 0.5 1 255\n";
    let read = model("a.ply", text);
    assert_eq!(read.triangles.normals[2], Vector::new(0.0, 0.5, 1.0));
    assert_eq!(read.triangles.faces[0].normals, Some([0, 2, 1]));
    assert_eq!(read.triangles.uvs[2], [0.0, 1.0]);
    assert_eq!(read.triangles.vertices[2].x, 0.1);
    assert_eq!(colors(&read)[0], [[0.0, srgb_decode(0.5), 1.0]; 3]);
    assert!((read.colors[0].transmit - 0.8).abs() < 1e-15);
    assert_eq!(read.colors[1].transmit, 0.0);
}

#[test]
fn a_broken_ply_is_told_at_its_line_or_byte() {
    let at = |text: &str| fault("a.ply", format!("ply\nformat ascii 1.0\n{text}"));
    let three = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    let faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let (place, reason) = at(&format!("{three}{faces}0 0 0\n1 0\n0 1 0\n3 0 1 2\n"));
    assert_eq!(place, Some(Place::Line(11)), "{reason}");
    let (place, _) = at("element vertex 3\nproperty floot x\nend_header\n");
    assert_eq!(place, Some(Place::Line(4)));
    let mut short = binary_ply(false);
    short.truncate(short.len() - 2);
    let (place, reason) = fault("a.ply", &short);
    assert_eq!(place, Some(Place::Byte(short.len())), "{reason}");
    // In binary, what a face says is told at its first byte.
    for big in [false, true] {
        let mut stray = binary_ply(big);
        let (face, end) = (stray.len() - 17, stray.len());
        stray[if big { end - 1 } else { end - 4 }] = 9;
        let told = (
            Some(Place::Byte(face)),
            "face 0: index 9 is of nothing: there are 4 vertices".to_owned(),
        );
        assert_eq!(fault("a.ply", &stray), told, "{big}");
        let mut wrong = binary_ply(big);
        let second = face - 3 * 15;
        wrong[second..second + 4].fill(255);
        let told = (Some(Place::Byte(second)), "vertex 1: a vertex is not finite".to_owned());
        assert_eq!(fault("a.ply", &wrong), told, "{big}");
    }
}

#[test]
fn each_fault_of_a_ply_has_its_line() {
    let head = "ply\nformat ascii 1.0\n";
    let three = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    let faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let places = "0 0 0\n1 0 0\n0 1 0\n";
    for (text, line, part) in [
        (String::new(), 1, "magic number"),
        ("plx\n".to_owned(), 1, "magic number"),
        ("ply\nformat ascii 1.0\n".to_owned(), 3, "missing 'end_header'"),
        ("ply\ncomment none\nend_header\n".to_owned(), 3, "No format line"),
        (format!("{head}element vertex 1\nproperty float x\nend_header\n0\n"), 3, "no x, y and z"),
        (format!("{head}{three}end_header\n{places}"), 7, "no `face` elements"),
        (
            format!("{head}comment many\nelement vertex 99999999999999\nend_header\n"),
            4,
            "it is too short for 99999999999999 `vertex` elements",
        ),
        (format!("{head}{three}{faces}0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n"), 11, ""),
        (
            format!("{head}{three}{faces}0 0 0\n1 0 1e99\n0 1 0\n3 0 1 2\n"),
            11,
            "vertex 1: a vertex",
        ),
        (format!("{head}{three}{faces}{places}3 0 1 3\n"), 13, "face 0: index 3 is of nothing"),
        (format!("{head}{three}{faces}{places}3 0 1 -1\n"), 13, "face 0: index -1 is of nothing"),
        (format!("{head}{three}{faces}{places}3 0 1\n"), 13, ""),
        (format!("{head}{three}{faces}{places}"), 13, "end of file"),
    ] {
        let (place, reason) = fault("a.ply", &text);
        assert_eq!(place, Some(Place::Line(line)), "{text}: {reason}");
        assert!(reason.contains(part), "{text}: {reason}");
    }
    let many = "ply\nformat binary_little_endian 1.0\nelement vertex 99999999999999\nend_header\n";
    assert_eq!(fault("a.ply", many).0, Some(Place::Line(3)));
}

const OBJ: &str = "# a square\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.5 0.25\nvn 0 0 1\n\
    g first\nusemtl red\nf 1//1 2//1 3//1\ng second\nf -4/1 \\\n -2/1 -1/1\nusemtl none\nf 1 2 4\n";

#[test]
fn an_obj_is_read_with_its_materials() {
    let read = |library: &str| {
        let library = library.as_bytes().to_vec();
        let mut beside = |name: &str| match name {
            "a.mtl" => Ok(library.clone()),
            _ => Err("which is not found".to_owned()),
        };
        read("a.obj", OBJ.as_bytes(), &mut beside, MOST)
    };
    let model =
        read("newmtl red\nKd 1 0 0\nd 0.25\nmap_Kd a.png\nnewmtl other\nKd 0.5\n").expect("whole");
    assert_eq!(corners(&model), [[O, XY, X], [O, Y, XY], [O, Y, X]]);
    assert_eq!(model.triangles.faces[0].normals, Some([0, 0, 0]));
    assert_eq!(
        (model.triangles.faces[1].normals, model.triangles.faces[1].uvs),
        (None, Some([0; 3]))
    );
    // The material goes on in the second group; without one, a face is white.
    assert_eq!(colors(&model), [[X; 3], [X; 3], [[1.0; 3]; 3]]);
    assert_eq!(model.colors[0].transmit, 0.75);
    let [pictured, unknown] = &model.lacks[..] else { panic!("{:?}", model.lacks) };
    assert!(pictured.contains("map_Kd") && unknown.contains("no `none`"), "{:?}", model.lacks);
    let narrow = self::model("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\n");
    assert_eq!(narrow.triangles.faces.len(), 1);
    assert_eq!(narrow.lacks, ["the face on line 4 has fewer than three corners"]);
    let wrong = read("newmtl red\nKd 1\nKd 1 0\n").expect_err("two numbers");
    assert_eq!((wrong.file.as_deref(), wrong.place), (Some("a.mtl"), Some(Place::Line(3))));
    let alone = read_alone("a.obj", OBJ.as_bytes()).expect("without colours");
    assert!(alone.colors.is_empty() && alone.lacks[0].contains("`a.mtl`"), "{:?}", alone.lacks);
}

#[test]
fn an_obj_may_have_colours_at_its_vertices() {
    let read = model("a.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0.5\nf 1 2 3\n");
    assert_eq!(colors(&read), [[X, [0.0, 0.0, srgb_decode(0.5)], Y]]);
}

#[test]
fn a_broken_obj_is_told_at_its_line() {
    for (text, line, part) in [
        ("v 0 0 0\nv 1 0\n", 2, "three numbers"),
        ("v 0 0 0\nv 1 0 nan\n", 2, "not finite"),
        ("v 0 0 0\nf 1 2 1\n", 2, "index 2 is of nothing: there are 1 vertices"),
        ("v 0 0 0\n\nf 1 0 1\n", 3, "index 0 is of nothing"),
        ("v 0 0 0\nf 1 -2 1\n", 2, "index -2 is of nothing"),
        ("v 0 0 0\nf 1/9223372036854775807 1 1\n", 2, "is of nothing"),
        ("v 0 0 0\nf 1/-9223372036854775808 1 1\n", 2, "is of nothing"),
        ("v 0 0 0\nf 1 a 1\n", 2, "`a` is no index"),
        ("v 0 0 0\nf / 1 1\n", 2, "no vertex"),
        ("v 0 0 0\nvn 0 0\n", 2, "a normal has three numbers"),
        ("v 0 0 0\nvt a\n", 2, "a place in a texture has one number or more"),
        ("v 0 0 0\nf 1//1 1 1\n\nv 1 0 0\n", 2, "index 1 is of nothing: there are 0 normals"),
        ("f 1/2 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0\n", 1, "there are 1 places in a texture"),
    ] {
        let (place, reason) = fault("a.obj", text);
        assert_eq!(place, Some(Place::Line(line)), "{text}: {reason}");
        assert!(reason.contains(part), "{text}: {reason}");
    }
}

/// An index counts from the file's first entry: it may be of one that comes later. One that counts backward
/// may not.
#[test]
fn an_obj_may_name_what_comes_later() {
    let late = "f 1/1/1 2/2/1 3/1/1\nv 0 0 0 1 0 0\nv 1 0 0\nf -2 -1 3\nv 1 1 0\nvt 0 1\nvt 1 0\nvn 0 0 1\n";
    let read = model("a.obj", late);
    assert_eq!(corners(&read), [[O, XY, X], [O, XY, X]]);
    let first = read.triangles.faces.iter().find(|face| face.uvs.is_some()).expect("with places");
    assert_eq!((first.uvs, first.normals), (Some([0, 0, 1]), Some([0; 3])));
    // And it has the colours of its vertices.
    assert_eq!(colors(&read)[1], [[1.0; 3]; 3]);
    let early = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 1\nvt 1 0\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/1\n";
    let late = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1/1/1 2/2/1 3/1/1\nvt 0 1\nvt 1 0\nvn 0 0 1\n";
    assert_eq!(model("a.obj", late), model("a.obj", early));
}

#[test]
fn a_polygon_is_covered_by_triangles_that_face_as_it_does() {
    // A dart, whose third corner turns right: a fan from the first would leave it.
    let text = "v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf 2 3 4 1\nf 1 2 3 4\n";
    let read = model("a.obj", text);
    let area = |[a, b, c]: [[f64; 3]; 3]| {
        let [a, b, c] = [a, b, c].map(Vector::from_array);
        // Of a surface that faces +z in a right-handed space.
        -0.5 * (b - a).cross(c - a).z
    };
    let areas: Vec<f64> = corners(&read).into_iter().map(area).collect();
    assert_eq!(areas, [2.0; 4]);
}

const STL: &str = "solid a square\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n\
    endloop\nendfacet\nendsolid a square\n\nsolid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n\
    vertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";

fn binary_stl() -> Vec<u8> {
    let mut bytes = b"solid, and yet binary".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(2u32.to_le_bytes());
    for triangle in [[O, X, XY], [O, XY, Y]] {
        let numbers = [[0.0, 0.0, 1.0]].into_iter().chain(triangle).flatten();
        numbers.for_each(|number| bytes.extend((number as f32).to_le_bytes()));
        bytes.extend([0, 0]);
    }
    bytes
}

#[test]
fn an_stl_is_read_as_text_and_in_binary() {
    for bytes in [STL.as_bytes(), &STL.replace('\n', "\r\n").into_bytes(), &binary_stl()] {
        let read = model("a.stl", bytes);
        assert_eq!(corners(&read), [[O, XY, X], [O, Y, XY]]);
        assert_eq!(read.triangles.vertices.len(), 4);
    }
}

#[test]
fn a_broken_stl_is_told_at_its_line_or_byte() {
    let (place, reason) = fault("a.stl", STL.replace("vertex 0 1 0", "vertex 0 1"));
    assert_eq!(place, Some(Place::Line(16)), "{reason}");
    let (place, reason) = fault("a.stl", STL.replacen("endloop", "endlop", 1));
    assert_eq!(place, Some(Place::Line(7)), "{reason}");
    let mut short = binary_stl();
    short.truncate(150);
    short[..5].fill(b' ');
    assert_eq!(fault("a.stl", &short).0, Some(Place::Byte(150)));
    assert!(read_alone("a.stl", b"").is_err());
    assert!(read_alone("a.stl", b"solid").is_err());
}

/// A triangle, by a node that turns x to y, doubles, and moves by z.
fn gltf(uri: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[1]}}],
"nodes":[{{"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476]}},
{{"children":[0],"translation":[0,0,1],"scale":[2,2,2]}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"COLOR_0":2}},"indices":1,"material":0}}]}}],
"materials":[{{"pbrMetallicRoughness":{{"baseColorFactor":[0.5,1,1,0.5]}},"alphaMode":"BLEND"}}],
"buffers":[{{"byteLength":54{uri}}}],
"bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":6}},
{{"buffer":0,"byteOffset":42,"byteLength":12}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},
{{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}},
{{"bufferView":2,"componentType":5121,"normalized":true,"count":3,"type":"VEC4"}}]}}"#
    )
}

fn gltf_bytes() -> Vec<u8> {
    let mut bytes = Vec::new();
    [O, X, Y].into_iter().flatten().for_each(|n| bytes.extend((n as f32).to_le_bytes()));
    [0u16, 1, 2].into_iter().for_each(|index| bytes.extend(index.to_le_bytes()));
    bytes.extend([255; 12]);
    bytes
}

fn glb(text: &str, held: &[u8]) -> Vec<u8> {
    let pad = |bytes: &[u8], with: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let (text, held) = (pad(text.as_bytes(), b' '), pad(held, 0));
    let mut bytes = b"glTF".to_vec();
    for number in [2, 28 + text.len() + held.len(), text.len()] {
        bytes.extend((number as u32).to_le_bytes());
    }
    bytes.extend(b"JSON");
    bytes.extend(text);
    bytes.extend((held.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(held);
    bytes
}

#[test]
fn a_gltf_is_read_with_its_buffer_beside_within_or_behind_it() {
    let beside = gltf(r#","uri":"a%20b.bin""#);
    let mut files = |name: &str| (name == "a b.bin").then(gltf_bytes).ok_or_else(String::new);
    let model = read("a.gltf", beside.as_bytes(), &mut files, MOST).expect("whole");
    let places: Vec<Vector> = model.triangles.vertices.clone();
    let turned = [[0.0, 0.0, 1.0], [0.0, 2.0, 1.0], [-2.0, 0.0, 1.0]].map(Vector::from_array);
    for (place, meant) in places.iter().zip(turned) {
        assert!((*place - meant).length() < 1e-6, "{place} {meant}");
    }
    assert_eq!(model.triangles.faces[0].vertices, [0, 2, 1]);
    assert_eq!(model.colors.len(), 1);
    assert_eq!(model.colors[0].rgb.components(), [0.5, 1.0, 1.0]);
    assert_eq!(model.colors[0].transmit, 0.5);
    let behind = glb(&gltf(""), &gltf_bytes());
    assert_eq!(read_alone("a.glb", &behind).as_ref(), Ok(&model));
    let encoded = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA////////////////";
    let within = gltf(&format!(r#","uri":"{encoded}""#));
    assert_eq!(read_alone("a.gltf", within.as_bytes()).as_ref(), Ok(&model));
}

#[test]
fn a_broken_gltf_is_told_and_where_it_can_be() {
    let (place, reason) = fault("a.gltf", "{\"asset\":{\"version\":\"2.0\"},\n\"nodes\":7}");
    assert_eq!(place, Some(Place::Line(2)), "{reason}");
    let (place, reason) = fault("a.glb", glb("{\"nodes\":7}", &[]));
    assert_eq!(place, Some(Place::Byte(29)), "{reason}");
    let held = gltf_bytes();
    let beside = |_: &str| -> Result<Vec<u8>, String> { Ok(gltf_bytes()) };
    // What is wrong, why, and where it is told.
    for (was, is, part, at) in [
        (r#""indices":1"#, r#""indices":9"#, "accessor 9: it is not there", "{\"attributes\""),
        (
            r#""byteLength":36"#,
            r#""byteLength":99"#,
            "accessor 0: its bytes are not there",
            "{\"bufferView\":0",
        ),
        (
            r#""count":3,"type":"VEC3""#,
            r#""count":9,"type":"VEC3""#,
            "longer than its bytes",
            "{\"bufferView\":0",
        ),
        (r#""type":"SCALAR""#, r#""type":"VEC2""#, "another length", "{\"bufferView\":1"),
        (r#"5121,"normalized""#, r#"5,"normalized""#, "of no known type", "{\"bufferView\":2"),
        (
            r#""count":3,"type":"VEC4""#,
            r#""count":2,"type":"VEC4""#,
            "more or fewer normals",
            "{\"attributes\"",
        ),
        (r#""material":0"#, r#""material":3"#, "its material is not there", "{\"attributes\""),
        (r#""mesh":0"#, r#""mesh":4"#, "the mesh of a node is not there", "{\"mesh\":4"),
        (r#""children":[0]"#, r#""children":[1]"#, "node 1 has two parents", "{\"children\""),
        (
            r#""children":[0]"#,
            r#""children":[7]"#,
            "the child of a node is not there",
            "{\"children\"",
        ),
        (r#""nodes":[1]"#, r#""nodes":[5]"#, "a node of its scene is not there", "{\"nodes\":[5]"),
        (r#""scene":0"#, r#""scene":2"#, "its scene is not there", "2,\"scenes\""),
        (r#""version":"2.0""#, r#""version":"1.0""#, "it is glTF 1.0", "\"1.0\""),
        (
            r#""scene":0"#,
            r#""scene":0,"extensionsRequired":["KHR_mesh_quantization","X_y"]"#,
            "`X_y`",
            "\"X_y\"",
        ),
    ] {
        let text = gltf("").replacen(was, is, 1);
        let byte = text.find(at).unwrap_or_else(|| panic!("{at} in {text}"));
        let (place, reason) = fault("a.glb", glb(&text, &held));
        assert!(reason.contains(part), "{is}: {reason}");
        assert_eq!(place, Some(Place::Byte(GLB_HEAD + byte)), "{is}: {reason}");
        let text = gltf(r#","uri":"a.bin""#).replacen(was, is, 1);
        let line = line_at(text.as_bytes(), text.find(at).expect("as before"));
        let told = read("a.gltf", text.as_bytes(), &mut { beside }, MOST).expect_err("broken");
        assert_eq!(told.place, Some(Place::Line(line)), "{is}: {}", told.reason);
    }
    let nowhere = (Some(Place::Line(6)), "buffer 0 is nowhere".to_owned());
    assert_eq!(fault("a.gltf", gltf("")), nowhere);
    let (place, reason) = fault("a.gltf", gltf(r#","uri":"data:;base64,!""#));
    assert_eq!(place, Some(Place::Line(6)), "{reason}");
    for (bytes, at) in
        [(&b"glTF\x02\0\0\0\x03\0\0\0"[..], 8), (&b"glTF\x02\0\0\0\x40\0\0\0"[..], 12)]
    {
        assert_eq!(fault("a.glb", bytes).0, Some(Place::Byte(at)));
    }
    let stray =
        gltf_bytes().into_iter().enumerate().map(|(i, byte)| if i == 36 { 7 } else { byte });
    let (place, reason) = fault("a.glb", glb(&gltf(""), &stray.collect::<Vec<u8>>()));
    assert!(reason.contains("index 7 is of nothing"), "{reason}");
    let primitive = gltf("").find("{\"attributes\"").map(|at| Place::Byte(GLB_HEAD + at));
    assert_eq!(place, primitive, "{reason}");
}

#[test]
fn a_file_of_many_uses_is_no_larger_than_it_may_be() {
    let nodes: Vec<String> = (0..2_000).map(|_| r#"{"mesh":0}"#.to_owned()).collect();
    let indices = "0,1,2,".repeat(500);
    let text = gltf("").replacen(r#""scene":0,"scenes":[{"nodes":[1]}],"#, "", 1);
    let start = text.find(r#""nodes":["#).expect("nodes");
    let end = text.find(r#""meshes""#).expect("meshes");
    let text = format!("{}\"nodes\":[{}],{}", &text[..start], nodes.join(","), &text[end..]);
    let read =
        |most| read("a.glb", &glb(&text, &gltf_bytes()), &mut |_| Err(indices.clone()), most);
    assert_eq!(read(MOST).expect("small").triangles.faces.len(), 2_000);
    assert!(read(100_000).expect_err("too large").is_too_large);
}

#[test]
fn the_end_of_its_name_tells_a_files_format() {
    assert!(fault("bunny.fbx", "").1.contains("`.ply`"));
    assert!(fault("bunny", "").1.contains("`.glb`"));
}

fn seeds() -> Vec<(&'static str, Vec<u8>)> {
    let mut ply = b"ply\nformat ascii 1.0\n".to_vec();
    ply.extend(PLY_HEAD.as_bytes());
    ply.extend(b"0 0 0 255 0 0\n1 0 0 0 0 0\n1 1 0 0 0 0\n0 1 0 255 0 0\n4 0 1 2 3\n");
    vec![
        ("a.ply", ply),
        ("a.ply", binary_ply(false)),
        ("a.ply", binary_ply(true)),
        ("a.obj", OBJ.as_bytes().to_vec()),
        ("a.stl", STL.as_bytes().to_vec()),
        ("a.stl", binary_stl()),
        ("a.gltf", gltf(r#","uri":"data:;base64,AAAA""#).into_bytes()),
        ("a.glb", glb(&gltf(""), &gltf_bytes())),
    ]
}

/// What may be done to some bytes at a place.
#[derive(Debug, Clone)]
enum Change {
    Put(u8),
    Flip(u8),
    Insert(Vec<u8>),
    Cut(usize),
    Repeat(usize),
}

fn change() -> impl Strategy<Value = Change> {
    let telling = prop::sample::select(vec![
        "0",
        "-1",
        "9",
        "99999999999",
        "nan",
        "1e999",
        " ",
        "\n",
        "/",
        "\\\n",
        "\"",
        "[",
        "}",
        "%",
        "\u{2003}",
        "f 1 2 3\n",
        "Kd 1\n",
        "usemtl \n",
        "solid\n",
        "endsolid\n",
        "element face 9\n",
        "property list int int a\n",
    ]);
    prop_oneof![
        any::<u8>().prop_map(Change::Put),
        (0u8..8).prop_map(|bit| Change::Flip(1 << bit)),
        telling.prop_map(|text| Change::Insert(text.as_bytes().to_vec())),
        prop::collection::vec(any::<u8>(), 1..5).prop_map(Change::Insert),
        (1usize..40).prop_map(Change::Cut),
        (1usize..40).prop_map(Change::Repeat),
    ]
}

fn changed(mut bytes: Vec<u8>, changes: &[(usize, Change)]) -> Vec<u8> {
    for (at, change) in changes {
        let at = at % (bytes.len() + 1);
        let end = |count: usize| (at + count).min(bytes.len());
        match change {
            Change::Put(byte) => bytes.get_mut(at).into_iter().for_each(|slot| *slot = *byte),
            Change::Flip(bit) => bytes.get_mut(at).into_iter().for_each(|slot| *slot ^= bit),
            Change::Insert(more) => drop(bytes.splice(at..at, more.iter().copied())),
            Change::Cut(count) => drop(bytes.drain(at..end(*count))),
            Change::Repeat(count) => {
                let again = bytes[at..end(*count)].to_vec();
                drop(bytes.splice(at..at, again));
            }
        }
    }
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn no_bytes_panic_and_what_is_read_is_whole(
        seed in 0..8usize,
        changes in prop::collection::vec((any::<usize>(), change()), 1..6),
    ) {
        let (name, bytes) = seeds().swap_remove(seed);
        let bytes = changed(bytes, &changes);
        let mut beside = |_: &str| Ok(bytes.clone());
        if let Ok(Model { triangles, colors, .. }) = read(name, &bytes, &mut beside, MOST) {
            let Triangles { vertices, normals, uvs, faces, .. } = triangles;
            prop_assert!(vertices.iter().chain(&normals).all(|place| place.is_finite()));
            for face in faces {
                let lists = [Some(face.vertices), face.normals, face.uvs, face.paint];
                let lengths = [vertices.len(), normals.len(), uvs.len(), colors.len()];
                for (all, length) in lists.into_iter().zip(lengths) {
                    prop_assert!(all.into_iter().flatten().all(|i| (i as usize) < length));
                }
            }
        }
    }

    #[test]
    fn no_bytes_at_all_panic(
        which in 0..5usize,
        bytes in prop::collection::vec(any::<u8>(), 0..200),
    ) {
        let name = format!("a.{}", Format::ALL[which].0);
        let _ = read(&name, &bytes, &mut |_| Ok(bytes.clone()), MOST);
    }
}
