//! Meshes: a tetrahedron against exact arithmetic, and a ball of many faces hit at its edges and corners.

use super::placed::{assert_crossed_where_it_is, assert_left_where_it_is, placed, ray_at_placed};
use super::*;
use crate::math::wide::{Instructions, ROW, Rays};
use crate::shape::exact::Triple;
use crate::shape::local::{Crossings, Local, LocalRay, Met};
use crate::shape::mesh::Face;

fn flat(corners: [u32; 3]) -> Face {
    Face { corners, normals: None }
}

/// Its corners are four of a cube's. Each face is turned at random: the inside does not depend on it.
fn tetrahedron(random: &mut Random) -> Mesh {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let corners = corners.map(|corner| Vector::from_array(corner) * 0.5).to_vec();
    let faces = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]
        .map(|[a, b, c]| flat(if random.below(2) == 0 { [a, b, c] } else { [b, a, c] }));
    let inside = UnitVector::from_direction(Vector::new(0.1, 0.9, 0.3));
    Mesh::new(corners, Vec::new(), faces.to_vec(), inside).expect("a mesh")
}

/// How far outside of the farthest of the four planes.
fn beside_tetrahedron(_: &Body, [x, y, z]: Triple) -> Double {
    let planes = [-x - y - z, -x + y + z, x - y + z, x + y - z];
    let first = planes[0];
    let most = planes.into_iter().fold(first, |a, b| if (a - b).0 < 0.0 { b } else { a });
    (most - Double::of(0.5)) / Double::of(3.0).sqrt()
}

/// An octahedron whose faces were divided `times` times and blown up to a ball.
fn ball(times: u32, inside: bool) -> Mesh {
    let mut corners: Vec<Vector> =
        [Vector::X, Vector::Y, Vector::Z].iter().flat_map(|&axis| [axis, -axis]).collect();
    let mut faces = Vec::new();
    for x in [0, 1] {
        for (y, z) in [(2, 4), (3, 4), (2, 5), (3, 5)] {
            faces.push([x, y, z]);
        }
    }
    let mut known = std::collections::BTreeMap::new();
    for _ in 0..times {
        let mut finer = Vec::new();
        for [a, b, c] in faces {
            let mut between = |a: u32, b: u32| {
                *known.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    let middle = (corners[a as usize] + corners[b as usize]).normalize();
                    corners.push(middle);
                    corners.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (between(a, b), between(b, c), between(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        faces = finer;
    }
    let normals = corners.clone();
    let faces = faces.into_iter().map(|all| Face { corners: all, normals: Some(all) }).collect();
    let inside = inside.then_some(UnitVector::Y);
    Mesh::new(corners, normals, faces, inside).expect("a mesh")
}

fn line(through: Vector, toward: Vector) -> LocalRay<'static> {
    let direction = UnitVector::from_direction(toward).unwrap_or(UnitVector::Z).get();
    let nearest = through - direction * through.dot(direction);
    LocalRay { nearest, direction, blur: 4.0 * EPS, turn: EPS, tolerance: 0.0, in_world: None }
}

fn crossings(mesh: &Mesh, ray: &LocalRay) -> Crossings {
    let mut found = Crossings::new();
    mesh.crossings(ray, &mut found);
    found
}

#[test]
fn lines_side_by_side_meet_what_each_meets_alone() {
    let mut random = Random(82);
    let mesh = ball(4, false);
    let (mut met, mut together) = (0, 0);
    for _ in 0..tries_in(10) {
        let (toward, through) = (random.direction().get(), random.point(1.2));
        let spread = random.size(-6.0, 0.0);
        let lines: Vec<LocalRay> = (0..1 + random.below(16))
            .map(|_| line(through + random.point(spread), toward + random.point(spread)))
            .collect();
        let mut ends =
            || (random.number(-3.0, 0.5), [random.number(-1.0, 3.0), 9.0][random.below(2)]);
        let between: Vec<(f64, f64)> = lines.iter().map(|_| ends()).collect();
        let mut found = vec![Crossings::new(); lines.len()];
        mesh.first_crossings_together(&lines, &between, &mut |number, these| {
            found[number] = these.clone();
        });
        let accepts =
            |number: usize, met: &Met| met.t > between[number].0 && met.t < between[number].1;
        let crossed = mesh.crosses_together(&lines, &between, &accepts);
        for (number, (line, between)) in lines.iter().zip(&between).enumerate() {
            let mut alone = Crossings::new();
            mesh.first_crossings(line, *between, &mut alone);
            assert_eq!(found[number], alone, "{line:?} {between:?}");
            let is_crossed = mesh.crosses(line, *between, &|met| accepts(number, met));
            assert_eq!(crossed >> number & 1 == 1, is_crossed, "{line:?} {between:?}");
            met += usize::from(!alone.is_empty());
            together += usize::from(lines.len() > 3);
        }
    }
    assert!(met.min(together) > tries() / 20, "{met} {together}");
}

/// Most of the rays go close by an edge or a corner, where it is hardest to tell.
#[test]
fn rays_in_rows_meet_one_or_two_faces_as_each_alone() {
    let mut random = Random(86);
    let (mut met, mut missed) = (0, 0);
    for turn in 0..tries_in(20) {
        let size = random.size(-3.0, 0.0);
        let centre = random.point(0.5);
        let corners: Vec<Vector> = (0..4).map(|_| centre + random.point(size)).collect();
        let faces = [[0, 1, 2], [1, 3, 2]][..1 + random.below(2)].iter().copied().map(flat);
        let Some(mesh) = Mesh::new(corners.clone(), Vec::new(), faces.collect(), None) else {
            continue;
        };
        let placed = placed(&mut random, Body::Mesh(mesh));
        let rays: [Ray; ROW] = std::array::from_fn(|_| {
            let [a, b] = [0; 2].map(|_| corners[random.below(4)]);
            let edge = a + (b - a) * [0.0, 0.5, random.number(0.0, 1.0)][random.below(3)];
            let off = [0.0, random.size(-18.0, 0.0)][random.below(2)];
            let target = placed.placement.world_point(edge + random.point(off * size));
            let far = random.size(-1.0, 2.0);
            let origin = placed.placement.world_point(random.point(far));
            let direction = UnitVector::from_direction(target - origin).unwrap_or(UnitVector::X);
            Ray { origin, direction: direction.get() }
        });
        let row = Rays::new(rays.iter());
        let limits = [f64::INFINITY; ROW];
        let mut found: [Crossings; ROW] = Default::default();
        let instructions = Instructions::all()[turn % 2];
        placed.first_crossings_together(
            instructions,
            &row,
            row.mask,
            &limits,
            |number, _, these| {
                found[number] = Crossings::from_slice(these);
            },
        );
        let crossed =
            placed.crosses_together(instructions, &row, row.mask, &limits, |_, met| met.t > 0.0);
        for (number, ray) in rays.iter().enumerate() {
            let alone = placed.first_crossings(ray, f64::INFINITY);
            assert_eq!(found[number], alone, "{ray:?} {placed:?}");
            let is_crossed = placed.crosses(ray, f64::INFINITY, |met| met.t > 0.0);
            assert_eq!(crossed >> number & 1 == 1, is_crossed, "{ray:?} {placed:?}");
            met += usize::from(!alone.is_empty());
            missed += usize::from(alone.is_empty());
        }
    }
    assert!(met.min(missed) > tries() / 10, "{met} {missed}");
}

#[test]
fn a_tetrahedron_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(81);
    let mut crossed = 0;
    for _ in 0..tries() {
        let body = Body::Mesh(tetrahedron(&mut random));
        let placed = placed(&mut random, body);
        let ray = ray_at_placed(&mut random, &placed);
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, beside_tetrahedron);
        assert_left_where_it_is(&mut random, &placed, &ray, beside_tetrahedron);
    }
    assert!(crossed > tries() / 2, "{crossed}");
}

/// Of a sheet, what is not closed by counting: each face is there or not.
#[test]
fn a_line_through_corners_and_edges_of_a_closed_mesh_meets_an_even_number_of_faces() {
    let mut random = Random(82);
    let meshes = [ball(0, false), ball(2, false), ball(5, false)];
    let mut met = 0;
    for _ in 0..tries() {
        let mesh = &meshes[random.below(3)];
        let [a, b] = [0, 1].map(|_| mesh.corners[random.below(mesh.corners.len())]);
        let face = mesh.faces[random.below(mesh.faces.len())].corners;
        let [p, q, r] = face.map(|i| mesh.corners[i as usize]);
        let through = [a, (p + q) * 0.5, p + (r - p) * random.number(0.0, 1.0)][random.below(3)];
        let toward = match random.below(5) {
            0 => a - b,
            1 => [Vector::X, Vector::Y, -Vector::Z][random.below(3)],
            // Along the edge itself.
            2 => q - p,
            3 => through,
            _ => random.direction().get(),
        };
        let all = crossings(mesh, &line(through, toward));
        met += all.len();
        assert!(all.len().is_multiple_of(2), "{all:?} through {through} toward {toward}");
    }
    assert!(met > tries(), "{met}");
}

#[test]
fn a_ball_of_many_faces_is_met_where_the_ball_is() {
    let mut random = Random(83);
    let mesh = ball(5, true);
    assert_eq!(mesh.faces.len(), 8192);
    for _ in 0..tries() {
        let through = random.direction().get() * random.number(0.0, 0.95);
        let ray = line(through, random.direction().get());
        let [enter, leave] = crossings(&mesh, &ray)[..] else {
            panic!("of a convex solid two: {ray:?}")
        };
        assert!(!enter.leaving && leave.leaving && enter.t < leave.t, "{enter:?} {leave:?}");
        for Met { t, part, leaving, .. } in [enter, leave] {
            let point = ray.at(t);
            assert!((point.length() - 1.0).abs() < 2e-3, "{point}");
            let out = mesh.height(part, point).gradient;
            assert!((out.dot(ray.direction) > 0.0) == leaving, "{out} {leaving}");
            let smooth = mesh.shading_normal(part, point).expect("it is smooth").normalize();
            assert!((smooth - point.normalize()).length() < 2e-3, "{smooth} {point}");
        }
        assert!(mesh.contains(through) && !mesh.contains(through * (1.01 / through.length())));
    }
}

#[test]
fn no_face_is_passed_over_by_the_tree() {
    let mut random = Random(84);
    let mesh = ball(3, false);
    let alone = |face| Mesh::new(mesh.corners.clone(), mesh.normals.clone(), vec![face], None);
    let alone: Vec<Option<Mesh>> = mesh.faces.iter().cloned().map(alone).collect();
    for _ in 0..tries() / 4 {
        let ray = line(random.point(1.0), random.direction().get());
        let all = (0..mesh.faces.len() as u32).filter(|&number| {
            let alone = alone[number as usize].as_ref();
            alone.is_some_and(|alone| !crossings(alone, &ray).is_empty())
        });
        let mut found: Vec<u32> = crossings(&mesh, &ray).iter().map(|met| met.part / 2).collect();
        found.sort_unstable();
        assert_eq!(all.collect::<Vec<_>>(), found, "{ray:?}");
    }
}

#[test]
fn a_mesh_extends_as_far_as_its_farthest_corner() {
    let mut random = Random(85);
    let mesh = ball(4, false);
    for _ in 0..tries() {
        let along = random.direction().get() * random.size(-3.0, 3.0);
        let dots = || mesh.corners.iter().map(|corner| corner.dot(along));
        let (low, high) = mesh.extent(along);
        let slack = 8.0 * EPS * along.length();
        assert!((high - dots().fold(f64::NEG_INFINITY, f64::max)).abs() <= slack);
        assert!((low - dots().fold(f64::INFINITY, f64::min)).abs() <= slack);
    }
}

#[test]
fn a_solid_with_a_hole_ends_behind_its_last_face() {
    let mut mesh = ball(0, true);
    mesh.faces.retain(|face| face.corners != [0, 2, 4]);
    let whole = mesh.faces.clone();
    let mesh = Mesh::new(mesh.corners, mesh.normals, whole, mesh.inside).expect("seven faces");
    let all = crossings(&mesh, &line(Vector::ZERO, Vector::new(1.0, 1.0, 1.1)));
    let [first, last] = all[..] else { panic!("{all:?}") };
    assert!(!first.leaving && first.is_seen(), "{first:?}");
    assert!(last.leaving && !last.is_seen() && last.t == first.t, "{last:?}");
}

#[test]
fn needles_and_specks_are_met_within_their_bounds_or_left_out() {
    let mut random = Random(86);
    let mut met = 0;
    for _ in 0..tries() {
        let a = random.point(1.0);
        let long = random.direction().get() * random.size(-14.0, 0.0);
        let across = random.direction().get() * (long.length() * random.size(-12.0, 0.0));
        let corners = vec![a, a + long, a + long * 0.3 + across];
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let Some(mesh) = Mesh::new(corners, Vec::new(), vec![flat([0, 1, 2])], None) else {
            continue;
        };
        let ray = line(middle, random.direction().get());
        for Met { t, error, .. } in crossings(&mesh, &ray) {
            met += 1;
            let exact = middle.dot(ray.direction);
            assert!((t - exact).abs() <= error, "{t} {exact} {error:e} {mesh:?} {ray:?}");
            assert!(error.is_finite(), "{error}");
        }
    }
    assert!(met > tries() / 8, "{met}");
}

#[test]
fn a_smooth_normal_has_length_1_or_is_the_faces_own() {
    let mut random = Random(87);
    let mut smooth = 0;
    for _ in 0..tries() {
        let corners: Vec<Vector> = (0..3).map(|_| random.point(1.0)).collect();
        let one = random.direction().get();
        let normals = match random.below(4) {
            0 => vec![one, -one, Vector::ZERO],
            1 => vec![Vector::ZERO; 3],
            _ => vec![one, random.direction().get(), random.direction().get()],
        };
        let weights = [[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.2, 0.3, 0.5]][random.below(3)];
        let sum = |list: &[Vector]| (0..3).map(|i| list[i] * weights[i]).sum::<Vector>();
        let (point, meant) = (sum(&corners), sum(&normals));
        let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
        let face = Face { corners: [0, 1, 2], normals: Some([0, 1, 2]) };
        let Some(mesh) = Mesh::new(corners, normals, vec![face], None) else { continue };
        let normal = random.direction().get();
        let placed = placed(&mut random, Body::Mesh(mesh));
        let point = placed.placement.world_point(point);
        let surface = SurfacePoint { point, normal, error: 0.0, face: 0 };
        let Some(found) = placed.shading_normal(&surface) else { continue };
        smooth += 1;
        assert!((found.length() - 1.0).abs() <= 4.0 * EPS, "{found}");
        let meant = placed.placement.world_normal(meant).normalize();
        let clear = area > 0.05 && sum(&placed_normals(&placed)).length() > 0.1;
        assert!(!clear || (found - meant).length() < 1e-3, "{found} {meant} {placed:?}");
    }
    assert!(smooth > tries() / 2, "{smooth}");
}

fn placed_normals(placed: &Placed) -> Vec<Vector> {
    match &*placed.body {
        Body::Mesh(mesh) => mesh.normals.clone(),
        other => panic!("a mesh, and not a {}", other.word()),
    }
}
