//! Queries about the World's solids: point containment, and which objects form one solid.

use std::any::Any;
use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::Arc;

use super::{Coat, Object, Texture, World};
use crate::math::Vector;
use crate::shape::local::Local;
use crate::shape::{Body, JuliaFractal, Placed, Shape, csg};
use crate::texture::region::Contains;

/// A World is the region inside of its solids.
impl Contains for World {
    fn contains(&self, point: Vector) -> bool {
        self.solids().any(|i| self.csg_contains(&self.objects[i as usize], point))
    }

    fn is_equal(&self, other: &dyn Any) -> bool {
        other.downcast_ref::<Self>() == Some(self)
    }

    fn as_any(&self) -> &dyn Any {
        self
    }
}

impl World {
    /// Returns whether a point lies inside an object: outside its shape, if the object is `inverse`.
    pub fn contains(&self, object: &Object, point: Vector) -> bool {
        let inside = match object.shape {
            Shape::Sphere(i) => self.spheres[i as usize].contains(point),
            Shape::Plane(i) => self.planes[i as usize].contains(point),
            Shape::Box(i) => self.boxes[i as usize].contains(point),
            Shape::Ellipsoid(i) => self.ellipsoids[i as usize].contains(point),
            Shape::Placed(i) => self.placed[i as usize].contains(point),
        };
        inside != object.inverse
    }

    /// Returns whether a point lies inside an object, or inside the CSG solid that it is part of.
    pub fn csg_contains(&self, object: &Object, point: Vector) -> bool {
        let Some(solid) = object.csg_solid else { return self.contains(object, point) };
        let solid = &self.csg_solids[solid as usize];
        let leaf = |object: &Object| self.contains(object, point) != object.inverse;
        csg::contains(&solid.nodes, self.objects[solid.leaves()].iter().map(leaf))
    }

    /// Returns the texture of the side of an object that a ray hits; `leaving` as in a hit.
    #[inline(always)]
    pub fn coat(&self, object: &Object, leaving: bool) -> Coat {
        let Object { texture, places, faces, .. } = *object;
        let outer = Coat { texture, places, faces };
        object.lining.map_or(outer, |lining| self.side(outer, lining, object, leaving))
    }

    #[cold]
    fn side(&self, outer: Coat, lining: u32, object: &Object, leaving: bool) -> Coat {
        let is_inner = leaving != object.inverse;
        if is_inner { self.linings[lining as usize] } else { outer }
    }

    /// Returns the textures of an object: the one of its outer side, or of both, first.
    pub fn textures_of(&self, object: &Object) -> impl Iterator<Item = &Texture> {
        let lining = object.lining.map(|lining| self.linings[lining as usize].texture);
        let all = [Some(object.texture), lining].into_iter().flatten();
        all.filter_map(|texture| self.textures.get(texture as usize))
    }

    /// Returns whether light passes through an object, on either side.
    pub fn is_clear(&self, object: &Object) -> bool {
        self.textures_of(object).any(Texture::is_clear)
    }

    /// Returns the keyword of an object's shape.
    pub fn word(&self, object: &Object) -> &'static str {
        match object.shape {
            Shape::Sphere(_) | Shape::Ellipsoid(_) => "sphere",
            Shape::Plane(_) => "plane",
            Shape::Box(_) => "box",
            Shape::Placed(i) => self.placed[i as usize].body.word(),
        }
    }

    /// Returns the indices of the objects outside CSG solids, and of the first part of each CSG solid.
    pub fn solids(&self) -> impl Iterator<Item = u32> {
        (0..self.objects.len() as u32).filter(|&i| {
            let solid = self.objects[i as usize].csg_solid;
            solid.is_none_or(|solid| self.csg_solids[solid as usize].first == i)
        })
    }

    /// Returns the objects that make up a solid of [`World::solids`].
    pub fn parts(&self, solid: u32) -> &[Object] {
        let at = solid as usize;
        match self.objects[at].csg_solid {
            Some(solid) => &self.objects[self.csg_solids[solid as usize].leaves()],
            None => &self.objects[at..=at],
        }
    }

    /// Returns whether any solid is intersected by iteration.
    pub fn has_iterated_roots(&self) -> bool {
        self.placed.iter().any(|placed| placed.body.is_iterated())
    }

    /// Returns the most iterations of any fractal; `None` if there is none.
    pub fn julia_iterations(&self) -> Option<u32> {
        let fractals = self.placed.iter().filter_map(fractal);
        fractals.map(|fractal| fractal.iterations).max()
    }

    /// Returns the same World with the iterations of each fractal limited to `most`.
    pub fn within_julia_iterations(&self, most: Option<u32>) -> Cow<'_, Self> {
        let most = match (most, self.julia_iterations()) {
            (Some(most), Some(own)) if own > most => most,
            _ => return Cow::Borrowed(self),
        };
        let mut world = self.clone();
        let mut made: HashMap<*const Body, Arc<Body>> = HashMap::new();
        for placed in &mut world.placed {
            let Some(full) = fractal(placed).filter(|full| full.iterations > most) else {
                continue;
            };
            let less = || JuliaFractal { iterations: most, ..full.clone() };
            let known = made.entry(Arc::as_ptr(&placed.body));
            let body = known.or_insert_with(|| Arc::new(Body::JuliaFractal(less()))).clone();
            placed.body = body;
        }
        Cow::Owned(world)
    }

    /// Returns whether both are parts of one CSG solid, or the same object.
    pub fn is_same_solid(&self, a: u32, b: u32) -> bool {
        let solid = |object: u32| self.objects[object as usize].csg_solid;
        a == b || solid(a).is_some() && solid(a) == solid(b)
    }
}

fn fractal(placed: &Placed) -> Option<&JuliaFractal> {
    match &*placed.body {
        Body::JuliaFractal(fractal) => Some(fractal),
        _ => None,
    }
}
