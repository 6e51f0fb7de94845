//! CSG solids of the World, and the textures that their cut faces show.

use super::World;
use crate::math::Vector;
use crate::shape::csg::Node;
use crate::texture::Paint;

/// A CSG solid.
#[derive(Debug, Clone, PartialEq)]
pub struct CsgSolid {
    /// In postfix order.
    pub nodes: Vec<Node>,
    /// The index of its first leaf in `World::objects`; the leaves follow in the order of the nodes.
    pub first: u32,
    pub count: u32,
    /// For `cutaway_textures`, one entry for each leaf; empty if no leaf shows the textures of others.
    pub cutaway: Vec<Cutaway>,
}

/// The relation of a leaf to the faces that show the textures of other leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cutaway {
    /// It shows the mean of the textures of the leaves that contain the point.
    Cut,
    /// The index of its texture in those of the cut faces, which show it where it contains the point.
    Shown(u32),
    /// Its texture is shown nowhere else, because the leaf is subtracted.
    Own,
}

impl CsgSolid {
    /// Returns the indices of its leaves in `World::objects`.
    pub fn leaves(&self) -> std::ops::Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

impl World {
    /// Returns the textures that a cut face shows at a point of the solid, each with its share; `None` if the
    /// object is no such face. Nothing has a share where no leaf contains the point.
    ///
    /// **Source:** POV-Ray manual, section "Cutaway Textures"; POV-Ray 3.7's behaviour, measured.
    pub fn cutaway(&self, object: u32, point: Vector) -> Option<Paint> {
        let solid = self.objects[object as usize].csg_solid?;
        let solid = &self.csg_solids[solid as usize];
        let leaf = (object - solid.first) as usize;
        if solid.cutaway.get(leaf) != Some(&Cutaway::Cut) {
            return None;
        }
        let mut shown = Paint::new();
        let mut stack: Vec<Done> = Vec::new();
        let mut leaves = solid.leaves().zip(&solid.cutaway);
        for node in &solid.nodes {
            let parts = stack.split_off(stack.len().saturating_sub(parts(*node)));
            let is_inside = match *node {
                Node::Leaf { .. } => {
                    let Some((leaf, cutaway)) = leaves.next() else { continue };
                    let is_hit = leaf == object as usize;
                    let is_inside = is_hit || self.contains(&self.objects[leaf], point);
                    stack.push(Done { is_inside, is_hit, before: shown.len() });
                    if let (true, Cutaway::Shown(texture)) = (is_inside, cutaway) {
                        shown.push((*texture, 1.0));
                    }
                    continue;
                }
                Node::Union(_) | Node::Merge(_) => parts.iter().any(|part| part.is_inside),
                Node::Intersection(_) => parts.iter().all(|part| part.is_inside),
                Node::Clip { inverse } => match parts[..] {
                    [part, region] if inverse => part.is_inside || !region.is_inside,
                    _ => parts.iter().all(|part| part.is_inside),
                },
            };
            // Its surface is that of all around it.
            let is_hit = parts.iter().any(|part| part.is_hit);
            let before = parts.first().map_or(shown.len(), |part| part.before);
            let is_inside = is_inside || is_hit;
            // What does not contain the point shows none of its parts.
            if !is_inside {
                shown.truncate(before);
            }
            stack.push(Done { is_inside, is_hit, before });
        }
        let share = 1.0 / shown.len().max(1) as f64;
        shown.iter_mut().for_each(|(_, weight)| *weight = share);
        Some(shown)
    }
}

/// A leaf or an operation that is evaluated at a point of a cut face.
#[derive(Debug, Clone, Copy)]
struct Done {
    /// It contains the point.
    is_inside: bool,
    /// The point is on its own surface.
    is_hit: bool,
    /// The number of textures shown before it.
    before: usize,
}

/// Returns the number of nodes that one combines.
fn parts(node: Node) -> usize {
    match node {
        Node::Leaf { .. } => 0,
        Node::Union(count) | Node::Merge(count) | Node::Intersection(count) => count as usize,
        Node::Clip { .. } => 2,
    }
}
