//! Height field: in local space, everything below two triangles in each cell of a grid, or below the water,
//! over the unit square around the origin; y points up, and the solid extends down without limit. Only the
//! triangles are visible, where they are above the water; the water and the walls are not.
//!
//! **Invariant:** watertight, as with meshes; triangles are generated on demand.
//!
//! **Source:** for the traversal, J. Amanatides, A. Woo, "A fast voxel traversal algorithm for ray tracing",
//! Eurographics 1987; for which points are inside and visible, `inside` and `trace` of POV-Ray 3.7.

mod normal;
mod walk;

use std::cell::Cell;

use super::U;
use super::local::{Crossings, Facet, Height, Local, LocalRay, Met, Span, unite};
use super::mesh::Flat;
use super::mesh::pierce::{self, View};
use crate::math::Vector;
use smallvec::SmallVec;
use walk::{Cells, Track};

/// Cells along a side of a block, for which the minimum and maximum heights are stored.
const BLOCK: usize = 16;
/// Cells along a side of a smaller block within it.
const SMALL: usize = 4;

/// Two triangles in each cell of a grid, and everything below them.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightField {
    /// Heights along x, in rows along z; −0.5 to 0.5.
    pub(super) heights: Vec<f32>,
    /// Number of cells along x and z: one less than the number of heights.
    pub(super) cells: [usize; 2],
    /// Everything below this height is solid, and invisible.
    pub(super) water: f64,
    smooth: bool,
    /// Minimum and maximum height of each block, and of each small block.
    blocks: Vec<[f32; 2]>,
    small: Vec<[f32; 2]>,
    /// Minimum and maximum of all heights.
    range: [f64; 2],
}

impl HeightField {
    /// Maximum number of heights: a part is a triangle, of which there are twice as many.
    pub const MOST: u64 = 1 << 30;

    /// Builds a height field from rows of `width` heights within ±0.5; `None` if they do not form a cell, or
    /// if none is above the water.
    pub fn new(heights: Vec<f32>, width: usize, water: f64, smooth: bool) -> Option<Self> {
        let rows = heights.len().checked_div(width)?;
        let fine = width > 1 && rows > 1 && rows * width == heights.len();
        if !fine || heights.len() as u64 > Self::MOST {
            return None;
        }
        let cells = [width - 1, rows - 1];
        let (blocks, small) = (Vec::new(), Vec::new());
        let mut field = Self { heights, cells, water, smooth, blocks, small, range: [0.0; 2] };
        field.blocks = field.ranges(BLOCK);
        field.small = field.ranges(SMALL);
        let range = field.blocks.iter().fold([f32::INFINITY, f32::NEG_INFINITY], |all, block| {
            [all[0].min(block[0]), all[1].max(block[1])]
        });
        field.range = range.map(f64::from);
        (field.range[1] >= water).then_some(field)
    }

    /// Returns the range of heights of each block of `size` × `size` cells, row by row.
    fn ranges(&self, size: usize) -> Vec<[f32; 2]> {
        let [across, deep] = self.cells.map(|count| count.div_ceil(size));
        let range = |number: usize| {
            let from = [number % across * size, number / across * size];
            let to = [0, 1].map(|axis| (from[axis] + size).min(self.cells[axis]));
            self.range_of(Cells { from, to })
        };
        (0..across * deep).map(range).collect()
    }

    fn range_of(&self, Cells { from, to }: Cells) -> [f32; 2] {
        let mut range = [f32::INFINITY, f32::NEG_INFINITY];
        for row in from[1]..=to[1] {
            let begin = row * (self.cells[0] + 1);
            for height in &self.heights[begin + from[0]..=begin + to[0]] {
                range = [range[0].min(*height), range[1].max(*height)];
            }
        }
        range
    }

    /// Index of a block's range among those of all blocks of its size.
    fn number_of(&self, block: Cells, size: usize) -> usize {
        block.from[1] / size * self.cells[0].div_ceil(size) + block.from[0] / size
    }

    fn height_of(&self, [i, j]: [usize; 2]) -> f64 {
        f64::from(self.heights[j * (self.cells[0] + 1) + i])
    }

    /// Returns the range of heights of a cell.
    fn range_of_cell(&self, [i, j]: [usize; 2]) -> [f32; 2] {
        let across = self.cells[0] + 1;
        let first = &self.heights[j * across + i..][..across + 2];
        let [a, b, c, d] = [first[0], first[1], first[across], first[across + 1]];
        [a.min(b).min(c.min(d)), a.max(b).max(c.max(d))]
    }

    /// Returns x or z of a row of corners.
    fn along(&self, axis: usize, number: usize) -> f64 {
        number as f64 / self.cells[axis] as f64 - 0.5
    }

    /// Returns a corner of the grid.
    fn corner(&self, place: [usize; 2]) -> Vector {
        Vector::new(self.along(0, place[0]), self.height_of(place), self.along(1, place[1]))
    }

    /// Returns the corners of a triangle, which faces up: the first triangle of a cell contains its corner
    /// with the smallest x and z, the second one the opposite corner.
    fn places(&self, part: u32) -> [[usize; 2]; 3] {
        let [i, j] = self.cell(part);
        match part.is_multiple_of(2) {
            true => [[i, j], [i + 1, j], [i, j + 1]],
            false => [[i + 1, j + 1], [i, j + 1], [i + 1, j]],
        }
    }

    /// Returns the cell that a triangle is in.
    fn cell(&self, part: u32) -> [usize; 2] {
        let cell = part as usize / 2;
        [cell % self.cells[0], (cell / self.cells[0]).min(self.cells[1] - 1)]
    }

    fn triangle(&self, part: u32) -> [Vector; 3] {
        self.places(part).map(|place| self.corner(place))
    }

    /// Calls `found` with triangles that a line pierces, roughly in the order of the line: with all that may
    /// lie between `from` and the limit, which is `to` at first and then what `found` returns.
    fn pierced(&self, ray: &LocalRay, between: (f64, f64), mut found: impl FnMut(Met) -> f64) {
        // Of the box from which heights are told.
        let view = View::along(ray, 1.0);
        let Some(track) = Track::new(ray, view.doubt, between, self.cells, self.range) else {
            return;
        };
        let limit = Cell::new(f64::INFINITY);
        let mut found = |met| limit.set(found(met));
        let apart = |[low, high]: [f32; 2], heights: [f64; 2]| {
            f64::from(low) > heights[1] || f64::from(high) < heights[0]
        };
        let all = Cells { from: [0; 2], to: self.cells };
        track.blocks::<BLOCK>(all, &limit, |block, heights| {
            if apart(self.blocks[self.number_of(block, BLOCK)], heights) {
                return;
            }
            track.blocks::<SMALL>(block, &limit, |block, heights| {
                if apart(self.small[self.number_of(block, SMALL)], heights) {
                    return;
                }
                track.blocks::<1>(block, &limit, |cell, heights| {
                    if !apart(self.range_of_cell(cell.from), heights) {
                        self.pierced_in(cell.from, ray, &view, &mut found);
                    }
                });
            });
        });
    }

    /// Calls `found` with the triangles of a cell that a line pierces.
    fn pierced_in(
        &self,
        [i, j]: [usize; 2],
        ray: &LocalRay,
        view: &View,
        found: &mut impl FnMut(Met),
    ) {
        let number = (j * self.cells[0] + i) as u32;
        let (x, z) = ([i, i + 1].map(|i| self.along(0, i)), [j, j + 1].map(|j| self.along(1, j)));
        let corner = |a: usize, b: usize| Vector::new(x[a], self.height_of([i + a, j + b]), z[b]);
        let [first, last, right, up] = [corner(0, 0), corner(1, 1), corner(1, 0), corner(0, 1)];
        for (part, corners) in
            [(2 * number, [first, right, up]), (2 * number + 1, [last, up, right])]
        {
            if let Some(leaving) = view.pierces(corners) {
                found(pierce::met(ray, corners, Flat::through(corners), leaving, part));
            }
        }
    }

    /// Returns where a line is between the walls; the ends are ±∞ where it is parallel to them.
    fn between_walls(&self, ray: &LocalRay) -> Option<[Met; 2]> {
        let wall = |t: f64, error: f64, leaving| Met { t, error, leaving, part: Met::UNSEEN };
        let mut enter = wall(f64::NEG_INFINITY, 0.0, false);
        let mut leave = wall(f64::INFINITY, 0.0, true);
        for axis in [0, 2] {
            let (place, speed) = (ray.nearest[axis], ray.direction[axis]);
            let met = |end: f64, leaving| {
                let t = (end - place) / speed;
                let off = ray.blur_at(t) + 2.0 * U * (1.0 + place.abs());
                wall(t, off / speed.abs() + 2.0 * U * t.abs(), leaving)
            };
            let near = -0.5_f64.copysign(speed);
            let (first, last) = (met(near, false), met(-near, true));
            let certain = speed.abs() > ray.turn;
            if certain && first.error.is_finite() && last.error.is_finite() {
                enter = enter.later(first);
                leave = leave.earlier(last);
            } else if place.abs() > 0.5 + ray.blur_at(ray.nearest.length() + 2.0) {
                return None;
            }
        }
        // Where it may be along a wall, the triangles tell.
        (enter.t - enter.error <= leave.t + leave.error).then_some([enter, leave])
    }

    /// Returns the parts of a line below the triangles. Entries and exits alternate; where the line is inside
    /// at an end of its range between the walls, it enters or leaves there.
    fn under_ground(&self, ray: &LocalRay, [enter, leave]: [Met; 2]) -> SmallVec<[Span; 4]> {
        let mut own = Crossings::new();
        self.pierced(ray, (f64::NEG_INFINITY, f64::INFINITY), |met| {
            own.push(met);
            f64::INFINITY
        });
        own.sort_unstable_by(by_place);
        let (Some(&first), Some(&last)) = (own.first(), own.last()) else {
            // It passes above all of it, or below. Of a line along the walls, a place beside the end that
            // there is.
            let place = match (enter.t.is_finite(), leave.t.is_finite()) {
                (true, true) => 0.5 * (enter.t + leave.t),
                (true, false) => enter.t + 1.0,
                (false, true) => leave.t - 1.0,
                (false, false) => 0.0,
            };
            let point = ray.at(place);
            let inside = self.ground(point).is_some_and(|ground| point.y < ground);
            let is_told = enter.t + enter.error < leave.t - leave.error;
            return (inside && is_told).then_some((enter, leave)).into_iter().collect();
        };
        // Within the walls, however rounding has it.
        let starts_inside = first.leaving;
        for (number, met) in own.iter_mut().enumerate() {
            met.leaving = (number % 2 == 0) == starts_inside;
        }
        let wall = |met: Met, leaving| Met { leaving, part: Met::UNSEEN, ..met };
        if starts_inside {
            let enter = enter.earlier(wall(first, false));
            own.insert(0, Met { part: Met::UNSEEN, ..enter });
        }
        if own.len() % 2 == 1 {
            let leave = leave.later(wall(last, true));
            own.push(Met { part: Met::UNSEEN, ..leave });
        }
        own.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
    }

    /// Returns the part of a line below the water, all of which is invisible.
    fn under_water(&self, ray: &LocalRay, [enter, leave]: [Met; 2]) -> Option<Span> {
        let (place, speed) = (ray.nearest.y, ray.direction.y);
        let t = (self.water - place) / speed;
        let off = ray.blur_at(t) + 2.0 * U * (1.0 + place.abs());
        let error = off / speed.abs() + 2.0 * U * t.abs();
        let (enter, leave) = if speed.abs() > ray.turn && error.is_finite() {
            let met = Met { t, error, leaving: speed > 0.0, part: Met::UNSEEN };
            if met.leaving { (enter, leave.earlier(met)) } else { (enter.later(met), leave) }
        } else if place < self.water {
            (enter, leave)
        } else {
            return None;
        };
        (enter.t + enter.error < leave.t - leave.error).then_some((enter, leave))
    }

    /// Returns whether a crossing certainly lies below the water.
    fn is_under_water(&self, ray: &LocalRay, met: &Met) -> bool {
        let off = ray.blur_at(met.t) + met.error * ray.direction.y.abs() + 2.0 * U;
        ray.at(met.t).y + off < self.water
    }

    /// Returns the height of the triangles at a point; `None` outside of the square.
    fn ground(&self, point: Vector) -> Option<f64> {
        if !(point.x.abs() < 0.5 && point.z.abs() < 0.5) {
            return None;
        }
        let place = |axis: usize, at: f64| {
            let at = (at + 0.5) * self.cells[axis] as f64;
            let cell = (at as usize).min(self.cells[axis] - 1);
            (cell, at - cell as f64)
        };
        let ((i, x), (j, z)) = (place(0, point.x), place(1, point.z));
        let height = |i, j| self.height_of([i, j]);
        Some(if x + z <= 1.0 {
            let corner = height(i, j);
            corner + x * (height(i + 1, j) - corner) + z * (height(i, j + 1) - corner)
        } else {
            let corner = height(i + 1, j + 1);
            corner
                + (1.0 - x) * (height(i, j + 1) - corner)
                + (1.0 - z) * (height(i + 1, j) - corner)
        })
    }
}

fn by_place(a: &Met, b: &Met) -> std::cmp::Ordering {
    a.t.total_cmp(&b.t).then(a.part.cmp(&b.part))
}

impl Local for HeightField {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let Some(walls) = self.between_walls(ray) else { return };
        let mut spans = self.under_ground(ray, walls);
        if self.water > self.range[0] {
            // Of the ground that is under the water nothing is seen, also where the line enters both at once.
            for met in spans.iter_mut().flat_map(|(enter, leave)| [enter, leave]) {
                if self.is_under_water(ray, met) {
                    met.part = Met::UNSEEN;
                }
            }
            spans.extend(self.under_water(ray, walls));
        }
        let mut all = Crossings::new();
        unite(&mut spans, &mut all);
        // What has no end is not crossed there.
        found.extend(all.into_iter().filter(|met| met.t.is_finite()));
    }

    /// Only those that are visible.
    fn first_crossings(&self, ray: &LocalRay, between: (f64, f64), found: &mut Crossings) {
        let ahead = ray.ahead_of(between.0);
        let mut limit = between.1;
        self.pierced(ray, between, |met| {
            if met.t <= limit && !self.is_under_water(ray, &met) {
                found.push(met);
                if met.t - met.error > ahead {
                    limit = met.t;
                }
            }
            limit
        });
        found.retain(|met| met.t <= limit);
        found.sort_unstable_by(by_place);
    }

    /// Measured from the plane of the triangle, relative to its corner.
    fn height(&self, part: u32, point: Vector) -> Height {
        let nothing = Height { value: 0.0, gradient: Vector::Y, error: 0.0 };
        self.facet(part).map_or(nothing, |facet| facet.height(point))
    }

    fn facet(&self, part: u32) -> Option<Facet> {
        let corners = self.triangle(part);
        let Flat { normal, turn } = Flat::through(corners)?;
        Some(Facet { corner: corners[0], normal, turn })
    }

    /// Extent of the visible part, with a margin for the rounding of a point on it.
    fn extent(&self, along: Vector) -> (f64, f64) {
        let slack = 64.0 * U * along.length();
        let (low, high) = self.nearest_extent(along);
        (low - slack, high + slack)
    }

    fn nearest_extent(&self, along: Vector) -> (f64, f64) {
        let across = self.cells[0].div_ceil(BLOCK);
        let mut extent = (f64::INFINITY, f64::NEG_INFINITY);
        for (number, [low, high]) in self.blocks.iter().enumerate() {
            let high = f64::from(*high);
            if high < self.water {
                continue;
            }
            let low = f64::from(*low).max(self.water);
            let place = |axis: usize, number: usize| {
                let cell = (number * BLOCK).min(self.cells[axis]);
                cell as f64 / self.cells[axis] as f64 - 0.5
            };
            let (i, j) = (number % across, number / across);
            let ranges =
                [[place(0, i), place(0, i + 1)], [low, high], [place(1, j), place(1, j + 1)]];
            let (mut least, mut most) = (0.0, 0.0);
            for (axis, [low, high]) in ranges.into_iter().enumerate() {
                let (a, b) = (low * along[axis], high * along[axis]);
                least += a.min(b);
                most += a.max(b);
            }
            extent = (extent.0.min(least), extent.1.max(most));
        }
        extent
    }

    /// Not measured: assumed from similar shapes.
    fn price(&self) -> u64 {
        8 + 5 * u64::from((2 * self.cells[0] * self.cells[1]).max(1).ilog2())
    }

    fn reach(&self) -> f64 {
        f64::INFINITY
    }

    fn numbers(&self) -> String {
        let [width, depth] = self.cells.map(|count| count + 1);
        let smooth = if self.smooth { " smooth" } else { "" };
        format!(" of {width}×{depth}{smooth}")
    }

    fn contains(&self, point: Vector) -> bool {
        self.ground(point).is_some_and(|ground| point.y < ground.max(self.water))
    }

    fn shading_normal(&self, part: u32, point: Vector) -> Option<Vector> {
        self.smooth.then(|| self.smooth_normal(part, point))
    }
}
