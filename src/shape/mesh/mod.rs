//! Mesh: triangles that share corners, as a sheet or, if it is declared to have an inside, as a solid.
//!
//! **Invariant:** watertight: a line through a shared edge or corner intersects one of the triangles there,
//! and an even number of the triangles of a closed mesh.

pub(super) mod missed;
pub(super) mod pierce;
mod skin;
mod together;

use std::ops::Range;

use super::local::{self, Crossings, Facet, Height, Local, LocalRay, Met};
use super::{Bounds, U};
use crate::bvh::{Tree, packet};
use crate::math::ray::Ray;
use crate::math::wide::ROW;
use crate::math::{UnitVector, Vector, reciprocal_power_of_two};
use pierce::View;
pub use skin::Skin;
use smallvec::SmallVec;

/// A triangle. The surface faces a viewer who sees the corners turn left, where x points right, y up and z
/// away. **Source:** behaviour of POV-Ray 3.7, measured with `trace`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    pub corners: [u32; 3],
    /// The shading normals, one for each corner; `None` if it is flat.
    pub normals: Option<[u32; 3]>,
}

/// Maximum number of faces that are tested one by one, without the tree.
const FEW: usize = 2;

/// A mesh. A part number is twice the index of a face, plus one if the outside is on its other side: the
/// inside of a mesh is determined by counting, regardless of the winding.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    pub(super) corners: Vec<Vector>,
    /// Of length 1, or 0.
    pub(super) normals: Vec<Vector>,
    /// In the order of the tree.
    pub(super) faces: Vec<Face>,
    /// `None` where the faces are [`FEW`].
    tree: Option<Tree>,
    skin: Skin,
    /// For a solid, the direction of the inside test: a point is inside if the ray in this direction crosses
    /// an odd number of faces.
    pub(super) inside: Option<UnitVector>,
    reach: f64,
    /// The planes of its faces, if these are no more than [`FEW`].
    flats: Vec<Flat>,
}

impl Mesh {
    /// Builds a mesh from finite corners, at most 2 from the origin. Faces that degenerate to lines or
    /// points, or whose corners or normals are missing, are dropped; `None` if no face is left.
    pub fn new(
        corners: Vec<Vector>,
        normals: Vec<Vector>,
        faces: Vec<Face>,
        inside: Option<UnitVector>,
    ) -> Option<Self> {
        Self::with_skin(corners, normals, faces, inside, Skin::default())
    }

    /// Builds a mesh with the paint of its faces: lists with an entry for each face, or for none.
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
        let (tree, order) = if whole.len() <= FEW {
            (None, whole)
        } else {
            let boxes: Vec<Bounds> = whole.iter().map(|&i| bounds(&faces[i as usize])).collect();
            let (tree, order) = Tree::build(&boxes);
            (Some(tree), order.into_iter().map(|i| whole[i as usize]).collect())
        };
        let faces: Vec<Face> = order.iter().map(|&i| faces[i as usize]).collect();
        let skin = skin.in_order(&order);
        let used = faces.iter().flat_map(|face| face.corners);
        let reach = used.map(|i| corners[i as usize].length()).fold(0.0, f64::max);
        let reach = reach * (1.0 + 4.0 * U);
        let flat = |face: &Face| Flat::through(face.corners.map(|i| corners[i as usize]));
        let few = if faces.len() <= FEW { faces.as_slice() } else { &[] };
        let flats = few.iter().filter_map(flat).collect();
        Some(Self { corners, normals, faces, tree, skin, inside, reach, flats })
    }

    /// Returns the slenderness of the most slender face: its longest side over the height on that side.
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

    /// Returns the plane of the face of this number.
    #[inline]
    fn flat(&self, number: usize) -> Option<Flat> {
        match self.flats.get(number) {
            Some(flat) => Some(*flat),
            None => Flat::through(self.corners_of(self.faces.get(number)?)),
        }
    }

    /// Returns whether lines side by side are found sooner than one by one.
    fn goes_together(&self, lines: &[LocalRay]) -> bool {
        let are_many = lines.len() >= packet::LEAST as usize && self.tree.is_some();
        are_many && self.inside.is_none()
    }

    /// Calls `found` with faces that a line pierces, in no order: with all that may lie between `from` and the
    /// limit, which is `to` at first and then what `found` returns. Returns whether the line lies in the plane
    /// of a face, within rounding.
    fn pierced(
        &self,
        ray: &LocalRay,
        (from, to): (f64, f64),
        mut found: impl FnMut(Met) -> f64,
    ) -> bool {
        let view = View::along(ray, self.reach);
        // What the view rounds corners by, generously.
        let slack = 32.0 * U * (self.reach + ray.nearest.length()) + view.doubt;
        let from = from.max(-self.reach - slack);
        let mut look = |run: Range<usize>, mut limit: f64| {
            for number in run {
                let corners = self.corners_of(&self.faces[number]);
                if let Some(pierced) = view.pierces(corners) {
                    let part = 2 * number as u32;
                    let flat = self.flat(number);
                    limit = found(pierce::met(ray, corners, flat, pierced, part)) - from;
                }
            }
            limit
        };
        match &self.tree {
            None => {
                look(0..self.faces.len(), to - from);
            }
            Some(tree) => {
                let start = Ray { origin: ray.at(from), direction: ray.direction };
                tree.visit(&start, slack, to - from, &mut look);
            }
        }
        view.is_in_a_plane.get()
    }

    /// Adds all crossings of a line with faces, as they are wound, in order; returns whether the line lies in
    /// the plane of a face.
    fn all_pierced(&self, ray: &LocalRay, found: &mut Crossings) -> bool {
        let is_in_a_plane = self.pierced(ray, (f64::NEG_INFINITY, f64::INFINITY), |met| {
            found.push(met);
            f64::INFINITY
        });
        sort(found);
        is_in_a_plane
    }

    /// Returns the shading normal of a part at a point, of any length; `None` if it is the geometric normal.
    fn smooth_normal(&self, part: u32, point: Vector) -> Option<Vector> {
        let face = self.faces.get(part as usize / 2)?;
        let normals = face.normals?.map(|i| self.normals[i as usize]);
        let weights = self.weights(part as usize / 2, point)?;
        Some(normals[0] * weights[0] + normals[1] * weights[1] + normals[2] * weights[2])
    }
}

fn sort(found: &mut Crossings) {
    found.sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.part.cmp(&b.part)));
}

/// The plane of a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Flat {
    /// Of length about 1.
    pub normal: Vector,
    /// Angular error of the normal, from rounding.
    pub turn: f64,
}

impl Flat {
    /// Returns the plane; `None` if the corners are collinear.
    ///
    /// The edges are scaled to about 1 first, so nothing underflows. Their cross product is off by
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
    /// For a solid, entries and exits alternate, regardless of the winding of each face. If it is not closed
    /// where the line leaves it, it ends right behind the last face. A line in the plane of a face of a solid
    /// is displaced beside it, to the same side as all such lines.
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let is_in_a_plane = self.all_pierced(ray, found);
        if is_in_a_plane && self.inside.is_some() {
            found.clear();
            self.all_pierced(&pierce::beside(ray, self.reach), found);
        }
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

    /// Of a sheet, the crossings up to the first one ahead. A solid needs all of them, as they tell its inside.
    fn first_crossings(&self, ray: &LocalRay, between: (f64, f64), found: &mut Crossings) {
        if self.inside.is_some() {
            return self.crossings(ray, found);
        }
        let ahead = ray.ahead_of(between.0);
        let mut limit = between.1;
        self.pierced(ray, between, |met| {
            if met.t <= limit {
                found.push(met);
                if met.t - met.error > ahead {
                    limit = met.t;
                }
            }
            limit
        });
        found.retain(|met| met.t <= limit);
        sort(found);
    }

    fn first_crossings_together(
        &self,
        lines: &[LocalRay],
        between: &[(f64, f64)],
        each: &mut dyn FnMut(usize, &mut Crossings),
    ) {
        if !self.goes_together(lines) {
            return local::first_crossings_one_by_one(self, lines, between, each);
        }
        let mut all: SmallVec<[(usize, Met); ROW]> = SmallVec::new();
        let mut limits: SmallVec<[f64; ROW]> = between.iter().map(|(_, to)| *to).collect();
        let search = |number: usize, met: Met| {
            let limit = &mut limits[number];
            if met.t <= *limit {
                all.push((number, met));
                if met.t - met.error > lines[number].ahead_of(between[number].0) {
                    *limit = met.t;
                }
            }
            *limit
        };
        if !self.pierced_together(lines, between, search) {
            return local::first_crossings_one_by_one(self, lines, between, each);
        }
        let mut found = Crossings::new();
        for (number, limit) in limits.into_iter().enumerate() {
            let own = all.iter().filter(|(line, met)| *line == number && met.t <= limit);
            found.clear();
            found.extend(own.map(|(_, met)| *met));
            if !found.is_empty() {
                sort(&mut found);
                each(number, &mut found);
            }
        }
    }

    fn crosses_together(
        &self,
        lines: &[LocalRay],
        between: &[(f64, f64)],
        accepts: &dyn Fn(usize, &Met) -> bool,
    ) -> u32 {
        let mut crossed = 0;
        let search = |number: usize, met: Met| {
            crossed |= u32::from(accepts(number, &met)) << number;
            if crossed >> number & 1 == 1 { f64::NEG_INFINITY } else { between[number].1 }
        };
        if !self.goes_together(lines) || !self.pierced_together(lines, between, search) {
            return local::crosses_one_by_one(self, lines, between, accepts);
        }
        crossed
    }

    fn crosses(&self, ray: &LocalRay, between: (f64, f64), accepts: &dyn Fn(&Met) -> bool) -> bool {
        if self.inside.is_some() {
            let mut found = Crossings::new();
            self.crossings(ray, &mut found);
            return found.iter().any(accepts);
        }
        let mut is_crossed = false;
        self.pierced(ray, between, |met| {
            is_crossed |= accepts(&met);
            if is_crossed { f64::NEG_INFINITY } else { between.1 }
        });
        is_crossed
    }

    fn part_at(&self, ray: &LocalRay, s: f64, leaving: bool) -> Option<u32> {
        if self.inside.is_some() {
            return None;
        }
        // Much more than rounding, and less than the distance to most other faces.
        let near = self.reach * 1e-9;
        let mut nearest: Option<Met> = None;
        let off = |met: &Met| (met.t - s).abs();
        self.pierced(ray, (s - near, s + near), |met| {
            if met.leaving == leaving && nearest.is_none_or(|nearest| off(&met) < off(&nearest)) {
                nearest = Some(met);
            }
            s + near
        });
        nearest.filter(|met| off(met) <= met.error).map(|met| met.part)
    }

    /// Measured from the plane of the face, relative to its corner.
    fn height(&self, part: u32, point: Vector) -> Height {
        let nothing = Height { value: 0.0, gradient: Vector::Z, error: 0.0 };
        self.facet(part).map_or(nothing, |facet| facet.height(point))
    }

    fn facet(&self, part: u32) -> Option<Facet> {
        let number = part as usize / 2;
        let [corner, _, _] = self.corners_of(self.faces.get(number)?);
        let Flat { normal, turn } = self.flat(number)?;
        let normal = if part % 2 == 1 { -normal } else { normal };
        Some(Facet { corner, normal, turn })
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        let heights = |run: Range<usize>| {
            let corners = self.faces[run].iter().flat_map(|face| self.corners_of(face));
            corners.map(move |corner| corner.dot(along))
        };
        let Some(tree) = &self.tree else {
            let nowhere = (f64::INFINITY, f64::NEG_INFINITY);
            return heights(0..self.faces.len())
                .fold(nowhere, |(low, high), height| (low.min(height), high.max(height)));
        };
        let highest = tree.greatest(along, |run| heights(run).fold(f64::NEG_INFINITY, f64::max));
        let lowest =
            tree.greatest(-along, |run| heights(run).map(|h| -h).fold(f64::NEG_INFINITY, f64::max));
        (-lowest, highest)
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
        self.pierced(&ray, (0.0, f64::INFINITY), |met| {
            ahead += u32::from(met.t > 0.0);
            f64::INFINITY
        });
        ahead % 2 == 1
    }

    fn is_sheet(&self) -> bool {
        self.inside.is_none()
    }

    fn shading_normal(&self, part: u32, point: Vector) -> Option<Vector> {
        self.smooth_normal(part, point)
    }
}
