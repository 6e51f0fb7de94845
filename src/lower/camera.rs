//! Lowers the camera: turns its keywords into a point and three vectors.
//!
//! As in POV-Ray 3.7 (measured), the order of the keywords does not matter and the last of a kind counts:
//! `angle` sets the length of `direction` from that of `right` (except `angle 0`), then `look_at` turns the
//! three vectors, then the transforms move everything, in order. In scenes for version 3.1 and older each
//! keyword acts at once on the result of those before it.
//!
//! **Invariant:** forward, right and up span space, or there is a diagnostic.
//! **Source:** POV-Ray manual, section 3.4.2 "Camera"; formulas in `docs/world.md`.

use std::sync::Arc;

use super::focus::Lens;
use super::transform::{Affine, exact};
use super::{Fault, Lowering};
use crate::diagnostic::Code;
use crate::math::Vector;
use crate::math::double::{Double, DoubleVector, sin_cos_degrees};
use crate::scene::{self, CameraItem, CameraItemKind, CameraKind, Dialect, TransformId};
use crate::source::Site;
use crate::world::{self, Camera};

/// A keyword's value and its site; defaults have no site.
#[derive(Debug, Clone, Copy)]
struct Word {
    vector: DoubleVector,
    site: Option<Site>,
}

/// The camera's keywords, sorted by kind.
struct Words {
    location: DoubleVector,
    /// Whether `location` is written.
    placed: bool,
    direction: Word,
    right: Word,
    up: Word,
    sky: DoubleVector,
    look_at: Option<(DoubleVector, Site)>,
    angle: Option<(f64, Site)>,
    vertical_angle: Option<f64>,
    lens: Lens,
    shift: (f64, f64),
    transforms: Vec<(TransformId, Site)>,
    /// One of the three vectors was zero.
    is_flat: bool,
}

/// The length of the replacement for a zero vector, relative to its default length.
const NEARLY_ZERO: f64 = 1e-9;

/// Two directions closer than this, relative, are parallel: 2⁻⁸⁰, far below `f64`.
const PARALLEL: f64 = 1.0 / (1u128 << 80) as f64;

impl Lowering<'_, '_> {
    pub(super) fn camera(&mut self) {
        let scene = self.scene;
        let Some(camera) = scene.cameras.last() else {
            let (forward, right) = defaults(scene.dialect);
            self.world.camera = Camera { forward, right, ..Camera::default() };
            return;
        };
        self.origins.camera = Some(camera.site);
        let spent = self.spend_camera(camera);
        let camera = self.reporter.made_there(spent);
        self.is_blind = camera.is_none();
        if let Some(camera) = camera {
            self.world.camera = camera;
        }
    }

    fn spend_camera(&mut self, camera: &scene::Camera) -> Result<Camera, (Fault, Site)> {
        let dialect = self.scene.dialect;
        let mut words = match camera.is_in_order {
            true => self.words_in_order(camera)?,
            false => Words::sort(camera, dialect),
        };
        let mut map = Affine::IDENTITY;
        for &(id, site) in &words.transforms {
            map = self.transforms.get(id).map_err(|fault| (fault, site))?.after(&map);
        }
        words.check(camera, dialect)?;
        if !camera.is_in_order {
            if camera.kind.is_flat() {
                words.widen()?;
            }
            if camera.kind == CameraKind::Orthographic && !words.is_sized() {
                words.fit_to_look_at(dialect);
            }
            words.turn(dialect, camera)?;
        }
        let location = map.point(words.location);
        let [forward, right, up] =
            [words.direction, words.right, words.up].map(|word| map.direction(word.vector));
        let volume = forward.dot(right.cross(up)).abs().round();
        let uncancelled = forward.largest() * right.largest() * up.largest();
        if volume <= PARALLEL * uncancelled {
            let message = "`direction`, `right` and `up` of this camera lie in one plane";
            let fault =
                Fault::new(Code::DegenerateCamera, message).label("no picture plane is left");
            match dialect {
                Dialect::Scene => return Err((fault, camera.site)),
                // POV-Ray 3.7 traces the remaining rays (measured).
                Dialect::Pov => self.reporter.fault(fault, camera.site),
            }
        }
        let shift = right * Double::from(words.shift.0) + up * Double::from(words.shift.1);
        let kind = words.projection(camera.kind);
        let (location, forward) = match kind {
            world::CameraKind::Orthographic => (location + shift, forward),
            _ => (location, forward + shift),
        };
        // A spherical camera turns about its vectors: away from `forward`, a left-handed one shows what a right-handed
        // one does, upside down (measured). In a `.scene`, `right` is on the right.
        let handed = up.cross(forward).dot(right).round();
        let is_turned =
            camera.kind == CameraKind::Spherical && dialect == Dialect::Scene && handed < 0.0;
        let (right, up) = if is_turned { (-right, -up) } else { (right, up) };
        if ![location, forward, right, up].iter().all(|v| v.is_finite()) {
            return Err((Fault::not_finite("this camera").refused(), camera.site));
        }
        let [location, forward, right, up] = [location, forward, right, up].map(|v| v.round());
        let (focus, normal) = match kind {
            world::CameraKind::Mesh => {
                self.no_lens(&words.lens);
                (None, None)
            }
            _ => {
                let direction = words.direction.vector.length().round();
                self.lens(&words.lens, words.location, direction)?
            }
        };
        let meshes = match camera.meshes.as_ref().filter(|_| kind == world::CameraKind::Mesh) {
            Some(meshes) => Some(Arc::new(self.mesh_camera(meshes, location, forward)?)),
            None => None,
        };
        Ok(Camera { kind, location, forward, right, up, focus, meshes, normal })
    }

    /// Applies the keywords as POV-Ray 3.7 reads a scene of version 3.1 or older (measured): each changes the
    /// result of those before it, so that a `direction` after `look_at` is not turned, nor a `location` after
    /// `translate` moved. `angle 0` makes `direction` infinitely long: its rays hit nothing.
    fn words_in_order(&mut self, camera: &scene::Camera) -> Result<Words, (Fault, Site)> {
        let dialect = self.scene.dialect;
        let is_perspective = camera.kind == CameraKind::Perspective;
        let mut words = Words::unwritten(dialect);
        for item in &camera.items {
            if let CameraItemKind::Transform(id) = item.kind {
                words.go_through(&self.transforms.get(id).map_err(|fault| (fault, item.site))?);
                continue;
            }
            words.take(item);
            match item.kind {
                CameraItemKind::Angle(0.0) => self.sees_nothing |= is_perspective,
                CameraItemKind::Angle(_) if camera.kind.is_flat() => words.widen()?,
                CameraItemKind::Direction(_) => self.sees_nothing = false,
                CameraItemKind::LookAt(_) => {
                    words.fill();
                    words.turn(dialect, camera)?;
                }
                CameraItemKind::Orthographic => {
                    words.fill();
                    words.fit_to_look_at(dialect);
                }
                _ => {}
            }
        }
        Ok(words)
    }
}

impl Words {
    fn sort(camera: &scene::Camera, dialect: Dialect) -> Self {
        let mut words = Self::unwritten(dialect);
        camera.items.iter().for_each(|item| words.take(item));
        words
    }

    fn unwritten(dialect: Dialect) -> Self {
        let default = |v: Vector| Word { vector: exact(v), site: None };
        let (direction, right) = defaults(dialect);
        Self {
            location: DoubleVector::ZERO,
            placed: false,
            direction: default(direction),
            right: default(right),
            up: default(Vector::Y),
            sky: exact(Vector::Y),
            look_at: None,
            angle: None,
            vertical_angle: None,
            lens: Lens::default(),
            shift: (0.0, 0.0),
            transforms: Vec::new(),
            is_flat: false,
        }
    }

    fn take(&mut self, item: &CameraItem) {
        let word = |v: Vector| Word { vector: exact(v), site: Some(item.site) };
        match item.kind {
            CameraItemKind::Location(v) => (self.location, self.placed) = (exact(v), true),
            CameraItemKind::LookAt(v) => self.look_at = Some((exact(v), item.site)),
            CameraItemKind::Sky(v) => self.sky = exact(v),
            CameraItemKind::Up(v) => self.up = word(v),
            CameraItemKind::Right(v) => self.right = word(v),
            CameraItemKind::Direction(v) => self.direction = word(v),
            CameraItemKind::Angle(degrees) => {
                (self.angle, self.vertical_angle) = (Some((degrees, item.site)), None);
            }
            CameraItemKind::VerticalAngle(degrees) => self.vertical_angle = Some(degrees),
            CameraItemKind::Shift { x, y } => self.shift = (x, y),
            CameraItemKind::Transform(id) => self.transforms.push((id, item.site)),
            CameraItemKind::Orthographic => {}
            other => self.lens.take(other, item.site),
        }
    }

    /// Returns the kind of camera in the World, with the default angles that POV-Ray 3.7 has (measured).
    fn projection(&self, kind: CameraKind) -> world::CameraKind {
        let across = self.angle.map(|(degrees, _)| degrees / 360.0);
        let angle = across.unwrap_or(0.25);
        match kind {
            CameraKind::Perspective => world::CameraKind::Perspective,
            CameraKind::Orthographic => world::CameraKind::Orthographic,
            CameraKind::Fisheye => world::CameraKind::Fisheye { angle },
            CameraKind::UltraWideAngle => world::CameraKind::UltraWideAngle { angle },
            CameraKind::Omnimax => world::CameraKind::Omnimax,
            CameraKind::Panoramic => world::CameraKind::Panoramic,
            CameraKind::Cylinder(form) => world::CameraKind::Cylinder {
                upright: form.is_upright(),
                moving: form.is_moving(),
                angle,
            },
            CameraKind::Mesh => world::CameraKind::Mesh,
            CameraKind::Spherical => {
                let across = across.unwrap_or(1.0);
                let down = self.vertical_angle.map_or(0.5 * across, |degrees| degrees / 360.0);
                world::CameraKind::Spherical { across, down }
            }
        }
    }

    /// Moves the camera from its current state; where it looked before does not matter.
    fn go_through(&mut self, map: &Affine) {
        self.location = map.point(self.location);
        for word in [&mut self.direction, &mut self.right, &mut self.up] {
            word.vector = map.direction(word.vector);
        }
    }

    fn check(&mut self, camera: &scene::Camera, dialect: Dialect) -> Result<(), (Fault, Site)> {
        if dialect == Dialect::Pov {
            self.fill();
        }
        for (name, word) in [("direction", self.direction), ("right", self.right), ("up", self.up)]
        {
            if word.vector.is_zero() {
                let message = format!("this camera's `{name}` is the zero vector");
                let fault = degenerate(&message, "expected a vector other than zero");
                return Err((fault, word.site.unwrap_or(camera.site)));
            }
        }
        if let Some((degrees, site)) = self.angle
            && camera.kind.is_flat()
            && !(0.0..180.0).contains(&degrees)
        {
            let message = format!("a camera cannot see an angle of {degrees} degrees");
            return Err((degenerate(&message, "expected more than 0 and less than 180"), site));
        }
        Ok(())
    }

    /// Replaces zero and nearly zero vectors, so that the picture is that of POV-Ray 3.7 (measured).
    fn fill(&mut self) {
        let (direction, right) = defaults(Dialect::Pov);
        let words =
            [(&mut self.direction, direction), (&mut self.right, right), (&mut self.up, Vector::Y)];
        for (word, default) in words.into_iter().filter(|(word, _)| word.vector.is_zero()) {
            word.vector = exact(default * NEARLY_ZERO);
            self.is_flat = true;
        }
    }

    /// `angle`: |direction| = ½ |right| / tan(angle / 2).
    fn widen(&mut self) -> Result<(), (Fault, Site)> {
        let Some((degrees, site)) = self.angle.filter(|(degrees, _)| *degrees != 0.0) else {
            return Ok(());
        };
        let (sine, cosine) = sin_cos_degrees(0.5 * degrees);
        let length = self.right.vector.length() * Double::from(0.5) * cosine / sine;
        let unit = self
            .direction
            .vector
            .normalized()
            .ok_or_else(|| (Fault::not_finite("this camera").refused(), site))?;
        self.direction.vector = unit * length;
        Ok(())
    }

    /// Returns whether the source sets the view size of an orthographic camera.
    fn is_sized(&self) -> bool {
        (self.right.site.is_some() || self.up.site.is_some()) && self.angle.is_none()
    }

    /// Sizes an orthographic camera that has `angle`, or neither `right` nor `up`: it sees at `look_at` what
    /// a perspective one would see there. `look_at` is then by default one default direction from the origin,
    /// wherever the camera is.
    fn fit_to_look_at(&mut self, dialect: Dialect) {
        let target = self.look_at.map_or_else(|| exact(defaults(dialect).0), |(v, _)| v);
        let factor = (target - self.location).length() / self.direction.vector.length();
        self.right.vector = self.right.vector * factor;
        self.up.vector = self.up.vector * factor;
    }

    /// Applies `look_at`: turns the three vectors, keeping their lengths and handedness, so that `sky` is
    /// upright in the picture. If the camera looks along `sky`, it keeps its `right`.
    fn turn(&mut self, dialect: Dialect, camera: &scene::Camera) -> Result<(), (Fault, Site)> {
        let Some((target, site)) = self.look_at else { return Ok(()) };
        let Some(forward) = (target - self.location).normalized() else {
            if !self.placed && camera.is_in_order {
                let message =
                    "this camera looks at <0, 0, 0>, where it stands before its `location`";
                let label = "in a scene for this version it belongs behind `location`";
                return Err((degenerate(message, label), site));
            }
            if !self.placed {
                let message =
                    "this camera has no `location`, and stands where it looks: at <0, 0, 0>";
                return Err((
                    degenerate(message, "expected `location <0, 1, -5>`, or the like"),
                    camera.site,
                ));
            }
            let fault = degenerate(
                "this camera stands at the same point that it looks at",
                "expected another point than `location`",
            );
            return Err((fault, site));
        };
        let [direction, right, up] = [self.direction, self.right, self.up].map(|word| word.vector);
        let handed = up.cross(direction).dot(right).round();
        // A camera may be flat before it turns, as with `up z`: POV-Ray mirrors it (measured).
        let mirrored = handed < 0.0 || (handed == 0.0 || self.is_flat) && dialect == Dialect::Pov;
        let mut across = self.sky.cross(forward);
        if across.largest() <= PARALLEL * self.sky.largest() {
            across = right - forward * right.dot(forward);
            if mirrored && dialect == Dialect::Scene {
                across = -across;
            }
            if across.largest() <= PARALLEL * right.largest() {
                if dialect == Dialect::Pov {
                    // `up` vanishes, and `right` stays (measured).
                    self.direction.vector = forward * direction.length();
                    self.up.vector =
                        forward.cross(exact(aside(forward))) * Double::from(NEARLY_ZERO);
                    return Ok(());
                }
                let fault = degenerate(
                    "this camera looks along both its `sky` and its `right`",
                    "nothing says which way is up in the picture",
                );
                return Err((fault.help("give it another `sky`, such as `sky z`"), site));
            }
        }
        let Some(across) = across.normalized() else {
            return Err((Fault::not_finite("this camera").refused(), site));
        };
        self.direction.vector = forward * direction.length();
        self.up.vector = forward.cross(across) * up.length();
        let across = if mirrored { -across } else { across };
        self.right.vector = across * right.length();
        Ok(())
    }
}

/// Returns the default `direction` and `right`.
fn defaults(dialect: Dialect) -> (Vector, Vector) {
    match dialect {
        Dialect::Scene => (-Vector::Z, Vector::X * (4.0 / 3.0)),
        // POV-Ray 3.7's `right` was measured: 1.33, not 4/3.
        Dialect::Pov => (Vector::Z, Vector::X * 1.33),
    }
}

fn degenerate(message: &str, label: &str) -> Fault {
    Fault::new(Code::DegenerateCamera, message).label(label).refused()
}

/// Returns the axis along which `direction` is smallest.
fn aside(direction: DoubleVector) -> Vector {
    let sizes = direction.round().abs();
    [Vector::X, Vector::Y, Vector::Z]
        .into_iter()
        .min_by(|a, b| sizes.dot(*a).total_cmp(&sizes.dot(*b)))
        .unwrap_or(Vector::X)
}
