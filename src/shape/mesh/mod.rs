//! Mesh: triangles that share corners, as a sheet or, where it is said to have an inside, as a solid.
//!
//! **Invariant:** watertight: a line through a shared edge or corner meets one of the triangles there, and
//! of a closed mesh an even number of them.

pub(super) mod pierce;
mod skin;

use super::body::{Crossings, Height, Local, LocalRay, Met};
use super::tree::Tree;
use super::{Bounds, U};
use crate::math::{UnitVector, Vector, reciprocal_power_of_two};
use pierce::View;
pub use skin::Skin;

/// Three corners in a row: the surface faces an eye that sees them turn left, where x points right, y up
/// and z away. **Source:** POV-Ray 3.7's behaviour, asked by `trace`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    pub corners: [u32; 3],
    /// The normals by which it is lit, one for each corner; `None` where it is flat.
    pub normals: Option<[u32; 3]>,
}

/// A part is twice the number of a face, and one more where the outside is on its other side: the inside
/// of a mesh is told by counting, however its corners turn.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    pub(super) corners: Vec<Vector>,
    /// Of length 1, or 0.
    pub(super) normals: Vec<Vector>,
    /// In the order of the tree.
    pub(super) faces: Vec<Face>,
    tree: Tree,
    skin: Skin,
    /// It is a solid: a point is inside from which this way leads out through an odd number of faces.
    pub(super) inside: Option<UnitVector>,
    reach: f64,
}

impl Mesh {
    /// Of finite corners, 2 or less from the origin. Faces that are lines or points, or whose corners or
    /// normals are not there, are left out; `None` where no face is left.
    pub fn new(
        corners: Vec<Vector>,
        normals: Vec<Vector>,
        faces: Vec<Face>,
        inside: Option<UnitVector>,
    ) -> Option<Self> {
        Self::with_skin(corners, normals, faces, inside, Skin::default())
    }

    /// With what its faces are painted with, a list of entries for each or for none.
    pub fn with_skin(
        corners: Vec<Vector>,
        normals: Vec<Vector>,
        faces: Vec<Face>,
        inside: Option<UnitVector>,
        skin: Skin,
    ) -> Option<Self> {
        let holds = |list: &[Vector], all: [u32; 3]| all.iter().all(|&i| (i as usize) < list.len());
        let is_whole = |face: &Face| {
            holds(&corners, face.corners)
                && face.normals.is_none_or(|all| holds(&normals, all))
                && Flat::through(face.corners.map(|i| corners[i as usize])).is_some()
        };
        let whole: Vec<u32> =
            (0..faces.len() as u32).filter(|&i| is_whole(&faces[i as usize])).collect();
        if whole.is_empty() {
            return None;
        }
        let bounds = |face: &Face| {
            let [a, b, c] = face.corners.map(|i| corners[i as usize]);
            Bounds { low: a.min(b).min(c), high: a.max(b).max(c) }
        };
        let boxes: Vec<Bounds> = whole.iter().map(|&i| bounds(&faces[i as usize])).collect();
        let (tree, order) = Tree::build(&boxes);
        let order: Vec<u32> = order.into_iter().map(|i| whole[i as usize]).collect();
        let faces: Vec<Face> = order.iter().map(|&i| faces[i as usize]).collect();
        let skin = skin.in_order(&order);
        let used = faces.iter().flat_map(|face| face.corners);
        let reach = used.map(|i| corners[i as usize].length()).fold(0.0, f64::max);
        let reach = reach * (1.0 + 4.0 * U);
        Some(Self { corners, normals, faces, tree, skin, inside, reach })
    }

    /// Of the slenderest face: its longest side over its height there.
    pub fn slenderness(&self) -> f64 {
        let slenderness = |face: &Face| {
            let [a, b, c] = self.corners_of(face);
            let sides = [b - a, c - b, a - c];
            let longest = sides.map(Vector::length).into_iter().fold(0.0, f64::max);
            // Near 1, so that nothing underflows.
            let [e, f, _] = sides.map(|side| side / longest);
            1.0 / e.cross(f).length()
        };
        self.faces.iter().map(slenderness).fold(0.0, f64::max)
    }

    fn corners_of(&self, face: &Face) -> [Vector; 3] {
        face.corners.map(|i| self.corners[i as usize])
    }

    /// Every face that a line pierces, in no order; whether it lies in the plane of one, as far as is told.
    fn pierced(&self, ray: &LocalRay, mut found: impl FnMut(Met)) -> bool {
        let view = View::along(ray, self.reach);
        // What the view rounds corners by, generously.
        let slack = 32.0 * U * (self.reach + ray.nearest.length()) + view.doubt;
        self.tree.along(ray, slack, |run| {
            for number in run {
                let corners = self.corners_of(&self.faces[number]);
                if let Some(pierced) = view.pierces(corners) {
                    let part = 2 * number as u32;
                    found(pierce::met(ray, corners, pierced, part));
                }
            }
        });
        view.is_in_a_plane.get()
    }

    /// The normal by which a part is lit at a point, of any length; `None` where that is its own.
    fn smooth_normal(&self, part: u32, point: Vector) -> Option<Vector> {
        let face = self.faces.get(part as usize / 2)?;
        let normals = face.normals?.map(|i| self.normals[i as usize]);
        let weights = self.weights(part as usize / 2, point)?;
        Some(normals[0] * weights[0] + normals[1] * weights[1] + normals[2] * weights[2])
    }
}

/// The plane of a triangle.
pub(super) struct Flat {
    /// Of length about 1.
    pub normal: Vector,
    /// How far rounding may have turned the normal.
    pub turn: f64,
}

impl Flat {
    /// `None` where the corners lie in a line.
    ///
    /// The edges are brought near 1 first, so nothing underflows. Their cross product is off by
    /// 8u·|e|·|f|.
    pub fn through([a, b, c]: [Vector; 3]) -> Option<Self> {
        let unit = |edge: Vector| edge * reciprocal_power_of_two(edge.abs().max_element());
        let (e, f) = (unit(b - a), unit(c - a));
        let normal = f.cross(e);
        let size = normal.length();
        let turn = 8.0 * U * e.length() * f.length() / size;
        (turn < 0.5).then_some(Self { normal: normal / size, turn })
    }
}

impl Local for Mesh {
    /// A solid's are entered and left in turn, whichever way each face turns. One that is not closed where
    /// the line leaves it ends right behind the last face. A line in the plane of a face goes beside it, as all lines
    /// to one side of it do.
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let is_in_a_plane = self.pierced(ray, |met| found.push(met));
        if is_in_a_plane && self.inside.is_some() {
            found.clear();
            self.pierced(&pierce::beside(ray, self.reach), |met| found.push(met));
        }
        found.sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.part.cmp(&b.part)));
        if self.inside.is_none() {
            return;
        }
        for (number, met) in found.iter_mut().enumerate() {
            let leaving = number % 2 == 1;
            if met.leaving != leaving {
                *met = Met { leaving, part: met.part + 1, ..*met };
            }
        }
        if found.len() % 2 == 1
            && let Some(last) = found.last().copied()
        {
            found.push(Met { leaving: true, part: Met::UNSEEN, ..last });
        }
    }

    /// Over the plane of the face, measured from its corner.
    fn height(&self, part: u32, point: Vector) -> Height {
        let corners = self.faces.get(part as usize / 2).map(|face| self.corners_of(face));
        let Some((corners, flat)) = corners.and_then(|all| Some((all, Flat::through(all)?))) else {
            return Height { value: 0.0, gradient: Vector::Z, error: 0.0 };
        };
        let normal = if part % 2 == 1 { -flat.normal } else { flat.normal };
        let off = point - corners[0];
        let error = (flat.turn + 4.0 * U) * off.length() + U * point.length();
        Height { value: normal.dot(off), gradient: normal, error }
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        let greatest = |along: Vector| {
            self.tree.greatest(along, |run| {
                let corners = self.faces[run].iter().flat_map(|face| self.corners_of(face));
                corners.map(|corner| corner.dot(along)).fold(f64::NEG_INFINITY, f64::max)
            })
        };
        (-greatest(-along), greatest(along))
    }

    fn price(&self) -> u64 {
        8 + 5 * u64::from(self.faces.len().max(1).ilog2())
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn numbers(&self) -> String {
        let inside = if self.inside.is_some() { " solid" } else { "" };
        let painted = if self.skin.paint.is_empty() { "" } else { " painted" };
        let placed = if self.skin.places.is_empty() { "" } else { " with uv" };
        format!(" of {}{inside}{painted}{placed}", self.faces.len())
    }

    fn contains(&self, point: Vector) -> bool {
        let Some(way) = self.inside else { return false };
        if point.length() > self.reach {
            return false;
        }
        let ray = LocalRay::exact(point, way.get());
        let mut ahead = 0u32;
        self.pierced(&ray, |met| ahead += u32::from(met.t > 0.0));
        ahead % 2 == 1
    }

    fn is_sheet(&self) -> bool {
        self.inside.is_none()
    }

    fn shading_normal(&self, part: u32, point: Vector) -> Option<Vector> {
        self.smooth_normal(part, point)
    }
}
