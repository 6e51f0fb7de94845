//! The space in which a node of a texture is evaluated: where its points come from, and how they are moved.

use crate::math::placement::Map;
use crate::math::{Matrix, Vector};
use crate::pattern::Warp;

/// A linear map from one space to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// Maps directions.
    pub directions: Matrix,
    /// Maps normals: the inverse transpose.
    pub normals: Matrix,
}

impl Turn {
    pub const NONE: Self = Self { directions: Matrix::IDENTITY, normals: Matrix::IDENTITY };

    /// Returns that of an affine map.
    pub fn of(map: &Map) -> Self {
        Self { directions: map.matrix, normals: map.normals }
    }

    /// Returns the map that applies `first`, and then this.
    pub fn after(self, first: Self) -> Self {
        Self {
            directions: self.directions * first.directions,
            normals: self.normals * first.normals,
        }
    }

    pub fn inverse(self) -> Self {
        Self { directions: self.normals.transpose(), normals: self.directions.transpose() }
    }
}

/// Indices into a list of textures or colours, each with its weight; the weights sum to 1.
pub type Paint = smallvec::SmallVec<[(u32, f64); 3]>;

/// The space of a node.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Space {
    pub start: Start,
    /// Applied to the point in this order: the last written first.
    pub steps: Vec<Step>,
}

impl Space {
    /// Returns the map to the space of the node, given that to where it starts, without its warps.
    pub fn turn(&self, start: Turn) -> Turn {
        self.steps.iter().fold(start, |turn, step| match step {
            Step::Map(map) => Turn::of(map).after(turn),
            Step::Warp(_) => turn,
        })
    }
}

/// Where the points of a node come from.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Start {
    /// From the node that contains it; from the world, if there is none.
    #[default]
    Outer,
    /// From one of the placements that each object has for the nodes of its texture.
    Slot(u32),
    /// From the surface's own coordinates: `<u, v, 0>`; directions, as `Outer`.
    Uv,
    /// Likewise, with the directions of a slot.
    UvTurned(u32),
}

/// One change of a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    Map(Map),
    Warp(Warp),
}

/// The point of a surface at which a texture is evaluated, as far as nodes ask for it.
pub trait Surroundings {
    /// Returns the point in the space of a slot.
    fn point(&self, slot: u32) -> Vector;

    /// Returns how far that point may be off along each axis. This is slow.
    fn error(&self, slot: u32) -> Vector;

    /// Returns whether all those errors are so small that they matter only near seams; see
    /// [`crate::pattern::NEAR`].
    fn is_sharp(&self) -> bool;

    /// Returns the map from the world to the space of a slot.
    fn turn(&self, slot: u32) -> Turn;

    /// Returns the surface's own coordinates.
    fn uv(&self) -> [f64; 2];

    /// Returns the point in the world.
    fn in_world(&self) -> Vector;

    /// Returns the normal by which the surface is lit, in the world, of length 1, toward the viewer; `None` where
    /// there is no surface.
    fn normal(&self) -> Option<Vector>;

    /// Returns the direction of the ray that sees the surface, in the world, of length 1.
    fn direction(&self) -> Vector;

    /// Returns how far they may be off where they are constant over a flat face.
    fn uv_error(&self) -> Vector;

    /// Returns the weights of the textures of a mesh's face, of a blob's components or of a cut face, by their
    /// places in [`super::Texture::Faces`] or [`super::Pigment::Faces`].
    fn paint(&self) -> Option<Paint>;
}

/// A point of no surface, known exactly.
#[derive(Debug, Clone, Copy)]
pub struct Nowhere {
    pub point: Vector,
    /// How far the point may be off along each axis.
    pub error: Vector,
    pub is_sharp: bool,
}

impl Nowhere {
    pub const fn exact(point: Vector) -> Self {
        Self { point, error: Vector::ZERO, is_sharp: false }
    }
}

impl Surroundings for Nowhere {
    fn point(&self, _slot: u32) -> Vector {
        self.point
    }

    fn error(&self, _slot: u32) -> Vector {
        self.error
    }

    fn is_sharp(&self) -> bool {
        self.is_sharp
    }

    fn turn(&self, _slot: u32) -> Turn {
        Turn::NONE
    }

    fn uv(&self) -> [f64; 2] {
        [self.point.x, self.point.y]
    }

    fn in_world(&self) -> Vector {
        self.point
    }

    fn normal(&self) -> Option<Vector> {
        None
    }

    fn direction(&self) -> Vector {
        -Vector::Y
    }

    fn uv_error(&self) -> Vector {
        self.error
    }

    fn paint(&self) -> Option<Paint> {
        None
    }
}

/// A point in the space of a node, with the way there, from which its error can be found.
#[derive(Clone, Copy)]
pub struct Place<'a> {
    pub point: Vector,
    space: &'a Space,
    outer: Option<&'a Place<'a>>,
    pub around: &'a dyn Surroundings,
}

impl<'a> Place<'a> {
    /// Returns the point in the space of a node, given that in the space of the node around it.
    #[inline]
    pub fn new(
        space: &'a Space,
        outer: Option<&'a Place<'a>>,
        around: &'a dyn Surroundings,
    ) -> Self {
        let mut point = Self::start(space, outer, around);
        for step in &space.steps {
            point = match step {
                Step::Map(map) => map.point(point),
                Step::Warp(warp) => warp.point(point),
            };
        }
        Self { point, space, outer, around }
    }

    fn start(space: &Space, outer: Option<&Place>, around: &dyn Surroundings) -> Vector {
        match (space.start, outer) {
            (Start::Outer, Some(outer)) => outer.point,
            (Start::Outer, None) => around.point(0),
            (Start::Slot(slot), _) => around.point(slot),
            (Start::Uv | Start::UvTurned(_), _) => {
                let [u, v] = around.uv();
                Vector::new(u, v, 0.0)
            }
        }
    }

    /// Returns how far the point may be off along each axis; 0 after a warp that makes that meaningless.
    #[cold]
    pub fn error(&self) -> Vector {
        let mut error = match (self.space.start, self.outer) {
            (Start::Outer, Some(outer)) => outer.error(),
            (Start::Outer, None) => self.around.error(0),
            (Start::Slot(slot), _) => self.around.error(slot),
            (Start::Uv | Start::UvTurned(_), _) => self.around.uv_error(),
        };
        let mut point = Self::start(self.space, self.outer, self.around);
        for step in &self.space.steps {
            match step {
                Step::Map(map) => {
                    error = map.point_error(point, error);
                    point = map.point(point);
                }
                Step::Warp(warp) => (point, error) = warp.moved(point, error),
            }
        }
        error
    }

    /// Returns another point of the same space, known exactly.
    pub fn moved_to(&self, point: Vector) -> Self {
        Self { point, ..*self }
    }

    /// Returns the map from the world to the space of the node, without its warps.
    pub fn turn(&self) -> Turn {
        let start = match (self.space.start, self.outer) {
            (Start::Outer | Start::Uv, Some(outer)) => outer.turn(),
            (Start::Outer | Start::Uv, None) => Turn::NONE,
            (Start::Slot(slot), _) => self.around.turn(slot),
            // Its place has all the transforms.
            (Start::UvTurned(slot), _) => return self.around.turn(slot),
        };
        self.space.turn(start)
    }

    /// Returns whether the error matters only near seams; see [`Surroundings::is_sharp`].
    pub fn is_sharp(&self) -> bool {
        self.around.is_sharp()
    }
}
