//! PLY, as text and in binary of either order.

use super::*;

pub(super) const PLY_HEAD: &str = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    property uchar red\nproperty uchar green\nproperty uchar blue\n\
    element face 1\nproperty list uchar int vertex_indices\nend_header\n";

/// A square as binary PLY of either order.
pub(super) fn binary_ply(big: bool) -> Vec<u8> {
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
    // In a text, a count may be of any type.
    let weighed = text
        .replace("end_header", "property list float float weights\nend_header")
        .replace("4 0 1 2 3\n", "4 0 1 2 3 2 0.5 0.5\n");
    assert_eq!(corners(&model("a.ply", weighed)), corners(&read));
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
        (String::new(), 1, "the file ends before `end_header`"),
        ("plx\n".to_owned(), 1, "expected `ply`, found `plx`"),
        ("ply\nformat ascii 1.0\n".to_owned(), 3, "the file ends before `end_header`"),
        ("ply\ncomment none\nend_header\n".to_owned(), 3, "no `format`"),
        (format!("{head}element vertex 1\nproperty float x\nend_header\n0\n"), 3, "no x, y and z"),
        (format!("{head}{three}end_header\n{places}"), 7, "no `face` elements"),
        (
            format!("{head}comment many\nelement vertex 99999999999999\nend_header\n"),
            4,
            "it is too short for 99999999999999 `vertex` elements",
        ),
        (format!("{head}{three}{faces}0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n"), 11, "vertex 1: "),
        (
            format!("{head}{three}{faces}0 0 0\n1 0 1e99\n0 1 0\n3 0 1 2\n"),
            11,
            "vertex 1: a vertex",
        ),
        (format!("{head}{three}{faces}{places}3 0 1 3\n"), 13, "face 0: index 3 is of nothing"),
        (format!("{head}{three}{faces}{places}3 0 1 -1\n"), 13, "face 0: index -1 is of nothing"),
        (
            format!("{head}{three}{faces}{places}3 0 1\n"),
            13,
            "face 0: expected numbers, how many vertex_indices, and these; found `3 0 1`",
        ),
        (
            format!("{head}{three}{faces}0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n"),
            11,
            "vertex 1: expected numbers, x, y, z; found `1 0 x`",
        ),
        (
            format!("{head}{three}{faces}0 0 0\n\n1 0 0\n0 1 0\n3 0 1 2\n"),
            11,
            "found an empty line",
        ),
        ("ply\nformat asci 1.0\n".to_owned(), 2, "expected `format ascii 1.0`"),
        (
            format!("{head}element vertex three\n"),
            3,
            "expected `element` with a name and how many there are, found `element vertex three`",
        ),
        (
            format!("{head}element vertex 3\nproperty flot x\n"),
            4,
            "expected `property` with a type and a name",
        ),
        (format!("{head}property float x\n"), 3, "this `property` is of no `element`"),
        (
            format!("{head}vertex 3\n"),
            3,
            "expected `element`, `property`, `comment` or `end_header`, found `vertex 3`",
        ),
        (format!("{head}format binary_big_endian 1.0\n"), 3, "a second `format`"),
        (
            format!(
                "{head}{three}element face 1\nproperty list uchar float vertex_indices\nend_header\n{places}3 0 1 2\n"
            ),
            7,
            "`vertex_indices` of its `face` is no list of whole numbers",
        ),
        (format!("{head}{three}{faces}{places}"), 13, "the file ends before face 0"),
    ] {
        let (place, reason) = fault("a.ply", &text);
        assert_eq!(place, Some(Place::Line(line)), "{text}: {reason}");
        assert!(reason.contains(part), "{text}: {reason}");
    }
    let many = "ply\nformat binary_little_endian 1.0\nelement vertex 99999999999999\nend_header\n";
    assert_eq!(fault("a.ply", many).0, Some(Place::Line(3)));
}
