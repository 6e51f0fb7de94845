//! Tiny files of each format, whole and broken.

mod gltf;
mod obj;
mod ply;
mod stl;

use gltf::{glb, gltf, gltf_bytes};
use obj::OBJ;
use ply::{PLY_HEAD, binary_ply};
use proptest::prelude::*;
use stl::{STL, binary_stl};

use super::*;
use crate::color::srgb_decode;
use crate::math::Vector;

const MOST: u64 = 1 << 24;

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
        let name = format!("a.{}", ENDINGS[which]);
        let _ = read(&name, &bytes, &mut |_| Ok(bytes.clone()), MOST);
    }
}
