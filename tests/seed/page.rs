//! The page itself, literally and slowly: a Scene's canonical forms, its camera, its light.
//!
//! **In:** the Scene noun. **Out:** linear colours, one ray a pixel. **Invariant:** reads nothing
//! of the road beyond the Scene; what is not of the page is refused by a panic that names it.

use lucarne::color::Rgb;
use lucarne::math::Vector;
use lucarne::math::elementary::{pow, tan};
use lucarne::math::transform::Step;
use lucarne::scene::{
    Camera, CameraItemKind, Finish, LightKind, Modifier, ModifierKind, ObjectId, ObjectKind,
    PigmentKind, Scene, Solid, TextureKind,
};

use super::forms::{Form, Hit, Ray, rotate};

/// The surface description every object carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    pub color: Rgb,
    pub kd: f64,
    pub ks: f64,
    /// n, the Phong exponent.
    pub n: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Object {
    pub form: Form,
    pub surface: Surface,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// The page's own: the same direction L everywhere.
    Direction(Vector),
    /// Ours.
    Point(Vector),
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    pub source: Source,
    pub intensity: Rgb,
}

/// The page's camera, and where it stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eye {
    pub location: Vector,
    /// Unit vectors: to the right, up, and back from what is looked at (the page's x, y and z).
    pub axes: [Vector; 3],
    /// l and h.
    pub size: [f64; 2],
    /// l / (2·tan(α/2)): from the camera to the screen.
    pub distance: f64,
    /// Where on the screen its optical axis passes, in widths and heights from the middle; the
    /// page's is (0, −½), the middle of the bottom edge.
    pub axis: [f64; 2],
}

/// Everything the page speaks of.
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    pub objects: Vec<Object>,
    pub lights: Vec<Light>,
    pub eye: Eye,
    pub ambient: Rgb,
    /// How many rays deep a colour is followed: the camera's, then its reflections.
    pub bound: u32,
}

impl Page {
    /// Reads a Scene as the page would.
    pub fn read(scene: &Scene) -> Self {
        assert!(
            scene.background.is_none() && scene.sky_sphere.is_none(),
            "the page's sky is black"
        );
        let mut page = Self {
            objects: Vec::new(),
            lights: Vec::new(),
            eye: Eye::read(scene, scene.cameras.last().expect("a camera")),
            ambient: scene.settings.ambient_light,
            bound: scene.settings.max_trace_level,
        };
        for root in &scene.roots {
            let default = Written::default().texture(scene, root.default_texture);
            page.place(scene, root.object, &[], default);
        }
        page
    }

    /// Adds an object and all in it: its own steps first, then those of what contains it.
    fn place(&mut self, scene: &Scene, id: ObjectId, outer: &[Step], inherited: Written) {
        // A use of an object is that object with more modifiers.
        let mut uses = vec![&scene.objects[id.index()]];
        while let ObjectKind::Use(of) = uses[uses.len() - 1].kind {
            uses.push(&scene.objects[of.index()]);
        }
        let modifiers = || uses.iter().rev().flat_map(|object| &object.modifiers);
        let mut steps: Vec<Step> = modifiers().flat_map(|m| steps_of(scene, m)).cloned().collect();
        steps.extend_from_slice(outer);
        let written = modifiers().fold(inherited, |written, m| written.after(scene, m));
        let form = match &uses[uses.len() - 1].kind {
            ObjectKind::Solid(Solid::Sphere { centre, radius }) => Form::sphere(*centre, *radius),
            ObjectKind::Solid(Solid::Plane { normal, distance }) => Form::plane(*normal, *distance),
            ObjectKind::Solid(Solid::Box { corners }) => Form::cuboid(*corners),
            ObjectKind::Solid(Solid::Cylinder { .. }) => unreachable!("not of the seed"),
            ObjectKind::Union(children) => {
                for child in children {
                    self.place(scene, *child, &steps, written);
                }
                return;
            }
            ObjectKind::LightSource(light) => {
                assert!(!light.shadowless, "a shadowless light is not of the page");
                assert_eq!(light.fade, None, "a light that fades is not of the page");
                let source = match light.kind {
                    LightKind::Direction { to_light } => Source::Direction(
                        steps.iter().fold(to_light / to_light.length(), turned_direction),
                    ),
                    LightKind::Point { location } => {
                        Source::Point(steps.iter().fold(location, moved_point))
                    }
                    LightKind::Parallel { .. }
                    | LightKind::Spotlight { .. }
                    | LightKind::Cylinder { .. } => panic!("a beam of light is not of the page"),
                };
                self.lights.push(Light { source, intensity: light.color });
                return;
            }
            ObjectKind::Use(_) => unreachable!("uses were followed"),
            #[allow(unreachable_patterns, reason = "later kinds of objects are not of the page")]
            other => panic!("not of the page: {other:?}"),
        };
        let form = steps.iter().fold(form, Form::after);
        self.objects.push(Object { form, surface: written.surface() });
    }

    /// One ray through the middle of each pixel, row by row from the top left.
    pub fn picture(&self, width: u32, height: u32) -> Vec<Rgb> {
        let pixels = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
        pixels
            .map(|(column, row)| {
                let u = (f64::from(column) + 0.5) / f64::from(width);
                let v = (f64::from(row) + 0.5) / f64::from(height);
                self.color(self.eye.ray(u, v), None, 1)
            })
            .collect()
    }

    /// C_r. `from`: the object whose mirror sent the ray; `depth`: 1 for the camera's.
    pub fn color(&self, ray: Ray, from: Option<usize>, depth: u32) -> Rgb {
        let Some((o, hit)) = self.first_hit(ray, from) else {
            return Rgb::BLACK;
        };
        let Surface { color, kd, ks, n } = self.objects[o].surface;
        let mut sum = self.ambient * color * kd;
        for light in &self.lights {
            let Some(l) = self.visible(light, &hit, o) else { continue };
            let h = (l - ray.d) / (l - ray.d).length();
            let phong = pow(hit.normal.dot(h), n);
            sum += light.intensity * color * (kd * hit.normal.dot(l));
            sum += light.intensity * color * (ks * phong);
        }
        if ks > 0.0 && depth < self.bound {
            let mirrored = ray.d - hit.normal * (2.0 * ray.d.dot(hit.normal));
            let mirrored = Ray { s: hit.point, d: mirrored / mirrored.length() };
            sum += self.color(mirrored, Some(o), depth + 1) * ks;
        }
        sum.at_most_one()
    }

    /// The object hit first, of all but `but`.
    ///
    /// `but` is the surface the ray starts on. In exact arithmetic it can be left out: every object
    /// of the page is convex and seen from outside only, and a ray that leaves its surface with
    /// N·D > 0 never meets its outside again. In rounded arithmetic it must be, for the start may
    /// lie a hair inside or outside of it.
    fn first_hit(&self, ray: Ray, but: Option<usize>) -> Option<(usize, Hit)> {
        let mut first: Option<(usize, Hit)> = None;
        for (o, object) in self.objects.iter().enumerate() {
            if Some(o) == but {
                continue;
            }
            if let Some(hit) = object.form.hit(ray)
                && first.is_none_or(|(_, nearest)| hit.t < nearest.t)
            {
                first = Some((o, hit));
            }
        }
        first
    }

    /// L, the unit direction to the light, when the hit on object `o` sees it.
    fn visible(&self, light: &Light, hit: &Hit, o: usize) -> Option<Vector> {
        let (l, distance) = match light.source {
            Source::Direction(l) => (l, f64::INFINITY),
            Source::Point(at) => {
                let to_light = at - hit.point;
                (to_light / to_light.length(), to_light.length())
            }
        };
        if hit.normal.dot(l) < 0.0 {
            return None; // behind the surface
        }
        match self.first_hit(Ray { s: hit.point, d: l }, Some(o)) {
            Some((_, shadow)) if shadow.t < distance => None,
            _ => Some(l),
        }
    }
}

impl Eye {
    fn read(scene: &Scene, camera: &Camera) -> Self {
        let mut location = Vector::ZERO;
        let mut look_at = Vector::ZERO;
        let (mut right, mut up, mut angle) = (Vector::X * 4.0 / 3.0, Vector::Y, None);
        let mut shift = [0.0, 0.0];
        for item in &camera.items {
            match item.kind {
                CameraItemKind::Location(at) => location = at,
                CameraItemKind::LookAt(at) => look_at = at,
                CameraItemKind::Right(v) => right = v,
                CameraItemKind::Up(v) => up = v,
                CameraItemKind::Angle(degrees) => angle = Some(degrees),
                CameraItemKind::Shift { x, y } => shift = [x, y],
                // Only the defaults: the page's camera looks down −z with y up.
                CameraItemKind::Sky(v) => assert_eq!(v, Vector::Y, "the page's sky is y"),
                CameraItemKind::Direction(v) => assert_eq!(v, -Vector::Z, "it looks down −z"),
                CameraItemKind::Transform(id) => {
                    panic!("not of the page: {:?}", scene.transforms[id.index()])
                }
                other => panic!("not of the page: {other:?}"),
            }
        }
        let alpha = angle.expect("the page's camera has an angle") * std::f64::consts::PI / 180.0;
        let back = (location - look_at) / (location - look_at).length();
        let x = Vector::Y.cross(back) / Vector::Y.cross(back).length();
        Self {
            location,
            axes: [x, back.cross(x), back],
            size: [right.length(), up.length()],
            distance: right.length() / (2.0 * tan(alpha / 2.0)),
            axis: [-shift[0], -shift[1]],
        }
    }

    /// The point of the screen at the fraction `u` from its left and `v` from its top.
    pub fn screen(&self, u: f64, v: f64) -> Vector {
        let x = self.size[0] * (u - 0.5 - self.axis[0]);
        let y = self.size[1] * (0.5 - v - self.axis[1]);
        self.location + self.axes[0] * x + self.axes[1] * y - self.axes[2] * self.distance
    }

    fn ray(&self, u: f64, v: f64) -> Ray {
        let d = self.screen(u, v) - self.location;
        Ray { s: self.location, d: d / d.length() }
    }
}

/// A surface as the Scene has it: what was written last, for an object or for what contains it.
#[derive(Debug, Clone, Copy, Default)]
struct Written {
    pigment: Option<Rgb>,
    finish: Option<(f64, f64, f64)>,
}

impl Written {
    fn after(self, scene: &Scene, modifier: &Modifier) -> Self {
        match modifier.kind {
            ModifierKind::Texture(id) => self.texture(scene, id),
            ModifierKind::Pigment(id) => Self { pigment: pigment(scene, id.index()), ..self },
            ModifierKind::Finish(id) => Self { finish: finish(scene, id.index()), ..self },
            ModifierKind::Transform(_) => self,
            ModifierKind::NoShadow | ModifierKind::Inverse => {
                panic!("not of the page: {:?}", modifier.kind)
            }
            #[allow(unreachable_patterns, reason = "later modifiers are not of the page")]
            other => panic!("not of the page: {other:?}"),
        }
    }

    fn texture(self, scene: &Scene, id: lucarne::scene::TextureId) -> Self {
        let kind = &scene.textures[id.index()].kind;
        let TextureKind::Plain { pigment: paint, normal: None, finish: polish } = kind else {
            panic!("not of the page: {kind:?}");
        };
        Self { pigment: pigment(scene, paint.index()), finish: finish(scene, polish.index()) }
    }

    fn surface(self) -> Surface {
        let color = self.pigment.expect("the page's surfaces have one colour");
        let (kd, ks, n) = self.finish.expect("the page's surfaces have kd, ks and phong_exponent");
        Surface { color, kd, ks, n }
    }
}

fn pigment(scene: &Scene, index: usize) -> Option<Rgb> {
    match scene.pigments[index].kind {
        PigmentKind::Color(color) => Some(color.rgb),
        PigmentKind::Patterned { .. } | PigmentKind::Faces(_) => None,
    }
}

fn finish(scene: &Scene, index: usize) -> Option<(f64, f64, f64)> {
    match scene.finishes[index] {
        Finish::Seed { kd, ks, phong_exponent } => Some((kd, ks, phong_exponent)),
        Finish::Classic(_) => None,
    }
}

fn steps_of<'a>(scene: &'a Scene, modifier: &Modifier) -> &'a [Step] {
    match modifier.kind {
        ModifierKind::Transform(id) => &scene.transforms[id.index()],
        _ => &[],
    }
}

fn moved_point(p: Vector, step: &Step) -> Vector {
    match *step {
        Step::Translate(v) => p + v,
        Step::Scale(k) => p * k,
        Step::Rotate(degrees) => rotate(degrees, p),
        Step::Matrix(_) | Step::Transform(_) | Step::InverseOf(_) => {
            panic!("not a step of the page: {step:?}")
        }
    }
}

/// A direction is turned by rotations only; a negative homothety turns it around.
fn turned_direction(d: Vector, step: &Step) -> Vector {
    match *step {
        Step::Translate(_) => d,
        Step::Scale(k) => d * k.x.signum(),
        Step::Rotate(degrees) => rotate(degrees, d),
        Step::Matrix(_) | Step::Transform(_) | Step::InverseOf(_) => {
            panic!("not a step of the page: {step:?}")
        }
    }
}
