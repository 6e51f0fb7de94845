//! STL, as text and in binary.

use super::*;

pub(super) const STL: &str = "solid a square\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n\
    endloop\nendfacet\nendsolid a square\n\nsolid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n\
    vertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";

pub(super) fn binary_stl() -> Vec<u8> {
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
    assert_eq!(reason, "expected `vertex` with three finite numbers, found `vertex 0 1`");
    let (place, reason) = fault("a.stl", STL.replacen("endloop", "endlop", 1));
    assert_eq!(place, Some(Place::Line(7)), "{reason}");
    assert_eq!(reason, "expected `endloop`, found `endlop`");
    for (was, is, expected) in [
        ("outer loop", "loop", "expected `outer loop`, found `loop`"),
        (
            "facet normal",
            "facet",
            "expected `facet normal` with three finite numbers, or `endsolid`",
        ),
        ("vertex 1 1 0\n", "", "expected `vertex` with three finite numbers, found `endloop`"),
        ("vertex 1 0 0", "vertex 1 0 nan", "found `vertex 1 0 nan`"),
        ("endfacet", "", "expected `endfacet`, found `endsolid a square`"),
    ] {
        let (_, reason) = fault("a.stl", STL.replacen(was, is, 1));
        assert!(reason.contains(expected), "{is}: {reason}");
    }
    let (place, reason) =
        fault("a.stl", STL.replacen("endsolid a square", "", 1).replace("\n\n", "\n"));
    assert!(reason.starts_with("expected `facet normal`"), "{place:?}: {reason}");
    let (_, reason) = fault("a.stl", STL.trim_end().trim_end_matches("endsolid"));
    assert_eq!(reason, "the file ends before `endsolid`");
    let mut short = binary_stl();
    short.truncate(150);
    assert_eq!(fault("a.stl", &short).0, Some(Place::Byte(150)));
    short[..5].fill(b' ');
    assert_eq!(fault("a.stl", &short).0, Some(Place::Byte(150)));
    assert!(read_alone("a.stl", b"").is_err());
    assert!(read_alone("a.stl", b"solid").is_err());
}
