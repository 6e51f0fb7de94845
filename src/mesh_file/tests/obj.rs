//! OBJ: materials, colours at vertices, polygons, and what comes later.

use super::*;

pub(super) const OBJ: &str = "# a square\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.5 0.25\nvn 0 0 1\n\
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
