//! Random scenes of the page, the same ones every time.

use lucarne::color::Rgb;
use lucarne::math::Vector;
use lucarne::math::transform::Step;
use lucarne::scene::{LightKind, ObjectKind, Scene, Solid};

use super::sketch::{Sketch, seed};
use crate::dice::Dice;

impl Dice {
    fn vector(&mut self, low: f64, high: f64) -> Vector {
        Vector::new(self.between(low, high), self.between(low, high), self.between(low, high))
    }

    fn color(&mut self) -> Rgb {
        Rgb::new(self.between(0.1, 1.0), self.between(0.1, 1.0), self.between(0.1, 1.0))
    }

    pub fn step(&mut self) -> Step {
        match self.below(3) {
            0 => Step::Translate(self.vector(-1.0, 1.0)),
            1 => {
                let size = self.between(0.7, 1.4);
                Step::Scale(Vector::ONE * if self.below(4) == 0 { -size } else { size })
            }
            _ if self.below(3) == 0 => {
                Step::Rotate(Vector::Y * 90.0 * self.below(8) as f64 - Vector::X * 180.0)
            }
            _ => Step::Rotate(self.vector(-180.0, 180.0)),
        }
    }

    fn steps(&mut self, most: usize) -> Vec<Step> {
        (0..self.below(most + 1)).map(|_| self.step()).collect()
    }

    pub fn solid(&mut self) -> ObjectKind {
        match self.below(5) {
            0 => ObjectKind::Solid(Solid::Plane {
                normal: self.vector(-1.0, 1.0),
                distance: -self.between(2.0, 5.0),
            }),
            1 | 2 => ObjectKind::Solid(Solid::Box {
                corners: [self.vector(-1.4, -0.3), self.vector(0.3, 1.4)],
            }),
            _ => ObjectKind::Solid(Solid::Sphere {
                centre: self.vector(-1.0, 1.0),
                radius: self.between(0.4, 1.3),
            }),
        }
    }

    /// A few solids, some in unions, around the middle of the screen, under a few lights.
    pub fn scene(&mut self) -> Scene {
        let mut sketch = Sketch::new();
        for _ in 0..4 + self.below(8) {
            let finish =
                seed(self.between(0.2, 1.0), self.between(0.0, 0.9), self.between(1.0, 60.0));
            let texture = sketch.texture(self.color(), finish);
            let kind = self.solid();
            let steps = self.steps(5);
            let mut object = sketch.object(kind, Some(texture), &steps);
            if self.below(3) == 0 {
                let (kind, steps) = (self.solid(), self.steps(2));
                let other = sketch.object(kind, None, &steps);
                let steps = self.steps(3);
                let kind = ObjectKind::Union(vec![object, other, object]);
                object = sketch.object(kind, Some(texture), &steps);
            }
            let away = self.vector(-3.0, 3.0) + Vector::Y * 3.0;
            object = sketch.object(ObjectKind::Use(object), None, &[Step::Translate(away)]);
            sketch.place(object);
        }
        for _ in 0..1 + self.below(3) {
            let kind = match self.below(2) {
                0 => LightKind::Direction { to_light: self.vector(-1.0, 1.0) + Vector::Z },
                _ => LightKind::Point { location: self.vector(-4.0, 4.0) + Vector::Z * 5.0 },
            };
            let color = self.color();
            sketch.light(kind, color);
        }
        sketch.scene
    }
}
