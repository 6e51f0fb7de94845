//! Assembles what all readers produce: vertices, and polygons, which become triangles.
//!
//! **Invariant:** every index refers to an entry; every number is finite.

use std::collections::HashMap;

use super::{Fault, Model};
use crate::color::{Color, Rgb};
use crate::math::Vector;
use crate::scene::mesh::{Face, Triangles};

/// A corner of a polygon, by indices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Corner {
    pub vertex: u32,
    pub normal: Option<u32>,
    pub color: Option<u32>,
    pub uv: Option<u32>,
}

pub(super) struct Builder {
    triangles: Triangles,
    colors: Vec<Color>,
    known: HashMap<[u64; 5], u32>,
    lacks: Vec<String>,
    /// Size limit in bytes.
    most: u64,
}

impl Builder {
    pub fn new(most: u64) -> Self {
        let (triangles, colors) = (Triangles::default(), Vec::new());
        Self { triangles, colors, known: HashMap::new(), lacks: Vec::new(), most }
    }

    /// Returns the numbers of vertices, normals and texture coordinates.
    pub fn counts(&self) -> [usize; 3] {
        let Triangles { vertices, normals, uvs, .. } = &self.triangles;
        [vertices.len(), normals.len(), uvs.len()]
    }

    pub fn vertex(&mut self, [x, y, z]: [f64; 3]) -> Result<u32, Fault> {
        let vertex = Vector::new(x, y, z);
        if !vertex.is_finite() {
            return Err(Fault::new("a vertex is not finite"));
        }
        next(&mut self.triangles.vertices, vertex)
    }

    /// Adds a normal of any length; one that is not finite becomes zero.
    pub fn normal(&mut self, [x, y, z]: [f64; 3]) -> Result<u32, Fault> {
        let normal = Vector::new(x, y, z);
        next(&mut self.triangles.normals, if normal.is_finite() { normal } else { Vector::ZERO })
    }

    pub fn uv(&mut self, [u, v]: [f64; 2]) -> Result<u32, Fault> {
        let finite = |number: f64| if number.is_finite() { number } else { 0.0 };
        next(&mut self.triangles.uvs, [finite(u), finite(v)])
    }

    /// Adds a linear colour; `alpha` is the opacity, 0 to 1.
    pub fn color(&mut self, rgb: [f64; 3], alpha: f64) -> Result<u32, Fault> {
        let finite = |number: f64| if number.is_finite() { number.max(0.0) } else { 0.0 };
        let [red, green, blue] = rgb.map(finite);
        let transmit = 1.0 - if alpha.is_finite() { alpha.clamp(0.0, 1.0) } else { 1.0 };
        let color = Color { rgb: Rgb::new(red, green, blue), filter: 0.0, transmit };
        let key = [red, green, blue, 0.0, transmit].map(f64::to_bits);
        if let Some(&known) = self.known.get(&key) {
            return Ok(known);
        }
        let new = next(&mut self.colors, color)?;
        self.known.insert(key, new);
        Ok(new)
    }

    pub fn lacks(&mut self, sentence: String) {
        if !self.lacks.contains(&sentence) {
            self.lacks.push(sentence);
        }
    }

    /// Adds a planar polygon, as triangles; fewer than three corners add nothing. Seen from outside, in a
    /// right-handed space, its corners are counterclockwise.
    pub fn polygon(&mut self, corners: &[Corner]) {
        let first = self.first_of_fan(corners);
        let corner = |i: usize| corners[(first + i) % corners.len()];
        for i in 1..corners.len().saturating_sub(1) {
            self.triangle([corner(0), corner(i), corner(i + 1)]);
        }
    }

    /// Returns the corner at which a triangle fan of a polygon starts: the first one from which all triangles
    /// face the same side as the polygon, if there is one among the first 16.
    fn first_of_fan(&self, corners: &[Corner]) -> usize {
        if corners.len() <= 3 {
            return 0;
        }
        let place = |i: usize| self.triangles.vertices[corners[i % corners.len()].vertex as usize];
        let area = |a: Vector, i: usize| (place(i) - a).cross(place(i + 1) - a);
        let whole: Vector = (1..corners.len() - 1).map(|i| area(place(0), i)).sum();
        let covers = |first: &usize| {
            let mut others = first + 1..first + corners.len() - 1;
            others.all(|i| area(place(*first), i).dot(whole) >= 0.0)
        };
        (0..corners.len().min(16)).find(covers).unwrap_or(0)
    }

    pub fn triangle(&mut self, [a, b, c]: [Corner; 3]) {
        // A surface of the language faces an eye that sees its corners turn left in a left-handed space.
        let corners = [a, c, b];
        let all = |of: fn(&Corner) -> Option<u32>| {
            let [a, b, c] = corners.each_ref().map(of);
            Some([a?, b?, c?])
        };
        self.triangles.faces.push(Face {
            vertices: corners.map(|corner| corner.vertex),
            normals: all(|corner| corner.normal),
            paint: all(|corner| corner.color),
            uvs: all(|corner| corner.uv),
        });
    }

    /// Checks the total size, including `more` bytes.
    ///
    /// # Errors
    /// Fails if the size exceeds the limit.
    pub fn check_size(&self, more: u64) -> Result<(), Fault> {
        if self.triangles.bytes().saturating_add(more) <= self.most {
            return Ok(());
        }
        Err(Fault { is_too_large: true, ..Fault::new("it is too large") })
    }

    pub fn finish(mut self) -> Result<Model, Fault> {
        self.check_size(0)?;
        if !self.colors.is_empty() {
            self.paint_the_rest()?;
        }
        let Self { triangles, colors, lacks, .. } = self;
        Ok(Model { triangles, colors, lacks })
    }

    /// Makes all faces without a colour white, if others have colours.
    fn paint_the_rest(&mut self) -> Result<(), Fault> {
        if self.triangles.faces.iter().all(|face| face.paint.is_some()) {
            return Ok(());
        }
        let white = self.color([1.0; 3], 1.0)?;
        for face in &mut self.triangles.faces {
            face.paint.get_or_insert([white; 3]);
        }
        Ok(())
    }
}

/// Appends an entry; returns its index.
fn next<T>(list: &mut Vec<T>, entry: T) -> Result<u32, Fault> {
    let index =
        u32::try_from(list.len()).map_err(|_| Fault::new("it has more than 2³² entries"))?;
    list.push(entry);
    Ok(index)
}
