//! `pavement`: tiles joined from triangles, squares or hexagons, which cover the x-z plane.

mod borders;
mod hexagon;
mod square;
mod triangle;

use super::parameter::parameters;
use super::{Measured, Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::elementary::{atan2, cos};
use crate::math::interval::Interval;
use borders::{Borders, pavements};
use std::f64::consts::PI;

parameters! {
    /// 1 on the borders of tiles, falling to 0 inside of them.
    ///
    /// **Source:** POV-Ray manual, section "Pavement Pattern"; the pavements are those of POV-Ray 3.7, and so
    /// is the shape of the bevel at corners (measured).
    pub struct Pavement {
        "number_of_sides" sides: f64 = 3.0, "the number of sides of a cell: 3, 4 or 6";
        "number_of_tiles" cells: f64 = 1.0, "the number of cells of a tile";
        "pattern" pattern: f64 = 1.0, "the number of the pavement among those with such tiles";
        "exterior" exterior: f64 = 0.0, "the look of sharp corners: 0 pointed, 1 cut, 2 round";
        "interior" interior: f64 = 0.0, "the look of concave corners: 0 pointed, 1 cut, 2 round";
        "form" form: f64 = 0.0, "the look of other corners: as these, or 3 like `interior`";
    }
}

/// How corners look: 0 pointed, 1 cut, 2 round.
#[derive(Debug, Clone, Copy)]
struct Looks {
    exterior: u8,
    interior: u8,
    form: u8,
}

impl Pavement {
    fn borders(&self) -> Option<&'static Borders> {
        let list = pavements(self.sides as usize, self.cells as usize);
        list.get((self.pattern as usize).wrapping_sub(1))
    }

    fn looks(&self) -> Looks {
        let [exterior, interior, form] =
            [self.exterior, self.interior, self.form].map(|look| look as u8);
        Looks { exterior, interior, form }
    }

    /// Returns whether all corners are pointed; then the value is continuous.
    fn is_pointed(&self) -> bool {
        [self.exterior, self.interior, self.form] == [0.0; 3]
    }
}

impl Pattern for Pavement {
    const HAS_SEAMS: bool = true;

    /// Like POV-Ray 3.7, takes a look that does not exist for 0; a pavement that does not exist, which is an
    /// error there, becomes one that does.
    fn canonical(self) -> Self {
        let sides = match self.sides.trunc() {
            4.0 => 4.0,
            6.0 => 6.0,
            _ => 3.0,
        };
        // In this order NaN becomes 1.
        let within = |number: f64, most: f64| number.max(1.0).min(most).trunc();
        let cells = within(self.cells, if sides == 6.0 { 5.0 } else { 6.0 });
        let count = pavements(sides as usize, cells as usize).len();
        let look = |look: f64, most: f64| {
            let look = look.trunc();
            if (0.0..=most).contains(&look) { look } else { 0.0 }
        };
        Self {
            sides,
            cells,
            pattern: within(self.pattern, count as f64),
            exterior: look(self.exterior, 2.0),
            interior: look(self.interior, 2.0),
            form: look(self.form, 3.0),
        }
    }

    fn value(&self, sample: &Sample) -> f64 {
        let Some(borders) = self.borders() else { return 0.0 };
        let limit = Vector::splat(FAR);
        let point = sample.point.clamp(-limit, limit);
        let error = if self.is_pointed() { Vector::ZERO } else { sample.error };
        let (at, error) = ([point.x, point.z], [error.x, error.z]);
        let value = match self.sides as u8 {
            3 => triangle::value(borders, self.looks(), at, error),
            4 => square::value(borders, self.looks(), at, error),
            _ => hexagon::value(borders, self.looks(), at),
        };
        value.clamp(0.0, 1.0)
    }

    fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
        self.is_pointed().then(|| self.measured(sample))
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        if !self.is_pointed() {
            return Self::RANGE;
        }
        let value = self.value(&Sample { point, error: Vector::ZERO, setting });
        let far = (point.x.abs() + point.z.abs() + 1.0) * (64.0 * f64::EPSILON);
        let reach = (reach.x + reach.z + far) / R;
        Interval { low: (value - reach).max(0.0), high: (value + reach).min(1.0) }
    }
}

/// Coordinates are clamped to this, beyond which they are too coarse for cells.
const FAR: f64 = 1e15;

/// √3.
const ROOT_3: f64 = 1.732_050_807_568_877_2;
/// The height of a triangle of side 1, half of that of a hexagon.
const H: f64 = ROOT_3 / 2.0;
/// The radius of the circle inside a triangle of side 1, and the width of the bevel in triangles and
/// hexagons.
const R: f64 = ROOT_3 / 6.0;

/// Returns the value near a concave corner of triangles or hexagons, which is greater than that of the
/// borders alone if the corner is not pointed. `turn` is the angle from a border.
fn concave(look: u8, distance: f64, turn: f64) -> f64 {
    match look {
        1 => 1.0 - H * distance * cos(turn - (turn / (PI / 3.0)).round() * (PI / 3.0)) / R,
        2 => 1.0 - H * distance / R,
        _ => 0.0,
    }
}

/// Returns the value near a corner of 120°, which is greater than that of the borders alone if the corner is
/// not pointed. The point is relative to the centre of the hexagon that has this corner, along the direction
/// to the corner and across.
fn obtuse(look: u8, [along, across]: [f64; 2]) -> f64 {
    match look {
        1 => 1.0 - (H - along / H) / R,
        2 if atan2(across.abs(), along) <= PI / 6.0 => {
            1.0 - (H - (along * along + across * across).sqrt()) / R
        }
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};
    use crate::pattern::measured::{assert_close, rows};

    #[test]
    fn values_are_those_of_pov_ray() {
        let rows = rows(include_str!("measured/pavement.txt"));
        assert!(rows.len() > 200);
        for [sides, cells, pattern, exterior, interior, form, x, z, measured] in rows {
            let kind = Pavement { sides, cells, pattern, exterior, interior, form };
            assert_eq!(kind, kind.canonical());
            let point = Vector::new(x, 3.0, z);
            let setting = Setting::default();
            let value = kind.value(&Sample { point, error: Vector::ZERO, setting: &setting });
            assert_close(value, measured, 1e-10, &(kind, point));
        }
    }

    #[test]
    fn bounds_hold_around_a_point() {
        let mut random = Random(3);
        let setting = Setting::default();
        for _ in 0..tries() {
            let [sides, cells, pattern] = [
                [3.0, 4.0, 6.0][random.below(3)],
                random.number(1.0, 7.0),
                random.number(1.0, 36.0),
            ];
            let kind = Pavement { sides, cells, pattern, ..Pavement::default() }.canonical();
            let point = random.point(20.0);
            let reach = random.size(-4.0, 0.0);
            let bounds = kind.bounds(point, Vector::splat(reach), &setting);
            let near = point + random.point(reach);
            let value = kind.value(&Sample { point: near, error: Vector::ZERO, setting: &setting });
            assert!(bounds.contains(value), "{kind:?} {point} {near}: {value} {bounds:?}");
        }
    }
}
