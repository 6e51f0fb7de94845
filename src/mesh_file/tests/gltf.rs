//! glTF 2.0, its buffer beside, within or behind it.

use super::*;

/// What stands before the document of a binary glTF.
const GLB_HEAD: usize = 20;

/// A triangle, by a node that turns x to y, doubles, and moves by z.
pub(super) fn gltf(uri: &str) -> String {
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

pub(super) fn gltf_bytes() -> Vec<u8> {
    let mut bytes = Vec::new();
    [O, X, Y].into_iter().flatten().for_each(|n| bytes.extend((n as f32).to_le_bytes()));
    [0u16, 1, 2].into_iter().for_each(|index| bytes.extend(index.to_le_bytes()));
    bytes.extend([255; 12]);
    bytes
}

pub(super) fn glb(text: &str, held: &[u8]) -> Vec<u8> {
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
    for (bytes, at) in [
        (&b"glTF\x02\0\0\0\x03\0\0\0"[..], 8),
        (&b"glTF\x02\0\0\0\x40\0\0\0"[..], 12),
        (&b"glTF\x01\0\0\0\x40\0\0\0"[..], 4),
    ] {
        assert_eq!(fault("a.glb", bytes).0, Some(Place::Byte(at)));
    }
    let mut other = glb(&gltf(""), &gltf_bytes());
    let second = other.windows(4).rposition(|four| four == b"BIN\0").expect("it has one");
    other[second..second + 4].copy_from_slice(b"XYZW");
    let (place, reason) = fault("a.glb", other);
    assert_eq!((place, &*reason), (Some(Place::Byte(12)), "its second part is not `BIN`"));
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
