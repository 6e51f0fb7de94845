//! Lights, as the tracer reads them.

use crate::color::Rgb;
use crate::math::{UnitVector, Vector};

/// A light, and what attenuates it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    pub kind: LightKind,
    pub color: Rgb,
    pub casts_shadows: bool,
    /// `None`: its full colour everywhere.
    pub attenuation: Option<Attenuation>,
    /// `None`: one point, or one direction.
    pub area: Option<Area>,
    /// It shines through one of the World's `projections`, and nowhere else.
    pub through: Option<u32>,
}

impl Light {
    /// Returns whether it comes from one point, or one direction, to all that is in sight of it.
    #[inline(always)]
    pub fn is_plain(&self) -> bool {
        self.area.is_none() && self.through.is_none()
    }
}

/// Attenuation of a light: the product of all factors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attenuation {
    pub beam: Option<Beam>,
    pub fade: Option<Fade>,
    /// Fog dims it on its way.
    pub fog: bool,
}

/// A beam, in terms of s(a, b; v) = t²(3 − 2t), where t = (v − a)/(b − a) is clamped to 0 … 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Beam {
    /// c^tightness · s(edge, core; c), where c is the cosine of the angle between `axis` and the light ray; 0
    /// where c ≤ 0, and behind the plane of a parallel light. Only the nodes of an area differ in c for that.
    Cone { axis: UnitVector, edge: f64, core: f64, tightness: f64 },
    /// For a parallel light, in front of its plane: d^tightness · s(0, core; d), where d = 1 − r/radius and r
    /// is the distance from its axis; 0 where d ≤ 0.
    Cylinder { radius: f64, core: f64, tightness: f64 },
}

/// Multiplies by 2/(1 + (d/distance)^power) at the distance d from the light; for a parallel light, from its
/// plane, on both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fade {
    pub distance: f64,
    pub power: f64,
    /// Behind the plane of a parallel light, d is negative: with an odd power, the light grows up to −`distance`
    /// and is less than none beyond, and with a broken one there is none. `false` for even powers.
    pub signed: bool,
}

/// Where the light of a [`Light`] comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightKind {
    Point {
        position: Vector,
    },
    /// From infinitely far away.
    Directional {
        to_light: UnitVector,
    },
    /// Parallel rays from the plane through `position` across `to_light`.
    Parallel {
        position: Vector,
        to_light: UnitVector,
    },
}

/// A grid of lights around a light's position, from which its shadows are computed. The node (i, j) is at (u, v) =
/// (i/(m − 1) − ½, j/(n − 1) − ½), or 0 along a side of one node; `a·u + b·v` from the position, where a and b are the
/// `sides`.
///
/// The light that comes from all of them is the mean of the blocks of the grid; see `trace/area/grid.rs`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Area {
    pub sides: [Vector; 2],
    /// The numbers of nodes along the sides; at least 1.
    pub nodes: [u32; 2],
    /// How often the grid is divided wherever shadows may be; beyond that only where they are. 0 to 32, which
    /// is every node.
    pub least_divisions: u32,
    /// The nodes are moved at random, by up to half of a cell.
    pub jitter: bool,
    /// The square of (u, v) is mapped to a disc: each point keeps its direction, and becomes as far off as its
    /// larger coordinate.
    pub circular: bool,
    /// The grid faces each point; `sides` are of equal length then, and only that counts.
    pub orient: bool,
    /// Diffuse light and highlights are those of all nodes, too, and not of the position alone.
    pub illuminates: bool,
    /// For parallel light: what all nodes are aimed at.
    pub target: Option<Vector>,
}

impl Area {
    /// The number of divisions after which each block is a node.
    pub const ALL_NODES: u32 = 32;
}
