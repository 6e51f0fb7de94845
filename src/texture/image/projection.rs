//! Where a point is in a picture: the map types.
//!
//! **Source:** POV-Ray 3.7 manual, section "The map_type Option"; measured to 1e-6 on POV-Ray 3.7, which
//! rejects the types 3, 4 and 6 on.

use std::f64::consts::{PI, TAU};

use crate::math::Vector;
use crate::math::elementary::{atan2, hypot};

/// `map_type`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MapType {
    /// 0: from 0, 0 to 1, 1 in the plane of x and y.
    #[default]
    Planar,
    /// 1: around a sphere, from pole to pole.
    Spherical,
    /// 2: around the y axis, from 0 to 1 in height.
    Cylindrical,
    /// 5: around a torus of major radius 1, whose axis is y.
    Toroidal,
}

/// A position in a picture, from the lower left corner to the upper right one: 0 to 1 once, and repeated
/// outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    pub u: f64,
    pub v: f64,
    /// By how much they may be off.
    pub u_error: f64,
    pub v_error: f64,
    /// Whether `v` = 1 is the end of the picture, rather than the start of the next one.
    pub ends_at_top: bool,
}

impl Place {
    pub fn new(u: f64, v: f64) -> Self {
        Self { u, v, u_error: 0.0, v_error: 0.0, ends_at_top: false }
    }

    /// Returns the place in the picture that is shown once; `None` if its error cannot move it there.
    pub fn inside(self) -> Option<Self> {
        let is_inside = |place: f64, error: f64| -error <= place && place <= 1.0 + error;
        (is_inside(self.u, self.u_error) && is_inside(self.v, self.v_error)).then(|| Self {
            u: self.u.clamp(0.0, 1.0),
            v: self.v.clamp(0.0, 1.0),
            ..self
        })
    }
}

impl MapType {
    pub const ALL: [Self; 4] = [Self::Planar, Self::Spherical, Self::Cylindrical, Self::Toroidal];

    /// Returns the map type of a number.
    pub fn of_number(number: u32) -> Option<Self> {
        match number {
            0 => Some(Self::Planar),
            1 => Some(Self::Spherical),
            2 => Some(Self::Cylindrical),
            5 => Some(Self::Toroidal),
            _ => None,
        }
    }

    /// Returns the place of a point that may be off by `error`; `None` at the centre of the sphere and on the
    /// axis of the cylinder and the torus. Only planar maps use the error.
    pub fn place(self, point: Vector, error: Vector) -> Option<Place> {
        let Vector { x, y, z } = point;
        let radius = hypot(x, z);
        let around = || {
            let turn = atan2(z, x) / TAU;
            if turn < 0.0 { turn + 1.0 } else { turn }
        };
        let is_on_axis = x == 0.0 && z == 0.0;
        match self {
            Self::Planar => {
                let (u_error, v_error) = (error.x.abs(), error.y.abs());
                Some(Place { u_error, v_error, ..Place::new(x, y) })
            }
            Self::Spherical if is_on_axis && y == 0.0 => None,
            Self::Cylindrical | Self::Toroidal if is_on_axis => None,
            Self::Spherical => {
                let v = atan2(y, radius) / PI + 0.5;
                Some(Place { ends_at_top: true, ..Place::new(around(), v) })
            }
            Self::Cylindrical => Some(Place::new(around(), y)),
            Self::Toroidal => {
                let v = atan2(y, radius - 1.0) / TAU + 0.5;
                Some(Place::new(around(), v))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(map_type: MapType, x: f64, y: f64, z: f64) -> Option<(f64, f64)> {
        map_type.place(Vector::new(x, y, z), Vector::ZERO).map(|place| (place.u, place.v))
    }

    #[test]
    fn a_picture_goes_around_from_the_positive_x_axis_towards_positive_z() {
        for map_type in [MapType::Spherical, MapType::Cylindrical, MapType::Toroidal] {
            for (x, z, u) in
                [(2.0, 0.0, 0.0), (0.0, 2.0, 0.25), (-2.0, 0.0, 0.5), (0.0, -2.0, 0.75)]
            {
                assert_eq!(place(map_type, x, 0.0, z).map(|(u, _)| u), Some(u), "{map_type:?}");
            }
        }
    }

    #[test]
    fn a_picture_goes_up_from_pole_to_pole_and_from_the_inner_rim_of_a_torus() {
        use MapType::{Cylindrical, Spherical, Toroidal};
        for (map_type, point, v) in [
            (Spherical, (0.0, -3.0, 0.0), 0.0),
            (Spherical, (3.0, 0.0, 0.0), 0.5),
            (Spherical, (0.0, 3.0, 0.0), 1.0),
            (Cylindrical, (3.0, 0.75, 0.0), 0.75),
            (Toroidal, (1.0, -0.5, 0.0), 0.25),
            (Toroidal, (2.0, 0.0, 0.0), 0.5),
            (Toroidal, (1.0, 0.5, 0.0), 0.75),
        ] {
            let found = place(map_type, point.0, point.1, point.2).map(|(_, v)| v);
            assert_eq!(found, Some(v), "{map_type:?} {point:?}");
        }
    }

    #[test]
    fn there_is_no_place_where_every_direction_is_the_same() {
        assert_eq!(place(MapType::Spherical, 0.0, 0.0, 0.0), None);
        for y in [-1.0, 0.0, 0.3] {
            assert_eq!(place(MapType::Cylindrical, 0.0, y, 0.0), None);
            assert_eq!(place(MapType::Toroidal, 0.0, y, 0.0), None);
        }
    }
}
