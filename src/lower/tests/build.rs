//! Scenes for the tests, built by hand.

use crate::color::{Color, Rgb};
use crate::diagnostic::{Code, Diagnostics};
use crate::lower::LowerOptions;
use crate::math::Vector;
use crate::math::transform::Step;
use crate::pattern::{Checker, Kind};
use crate::scene::texture::Modifiers;
use crate::scene::{self, *};
use crate::source::{ExpansionId, FileId, Site, Span};
use crate::world::{self, Origins, Plain, World};

/// A Scene under construction: textures 0 and 1 are black by default and a checker.
pub struct Build(pub Scene);

pub const PLAIN: TextureId = TextureId(0);
pub const CHECKER: TextureId = TextureId(1);

pub fn site(n: usize) -> Site {
    Site { span: Span::new(FileId(0), n, n + 1), expansion: ExpansionId::MAIN }
}

pub fn v(x: f64, y: f64, z: f64) -> Vector {
    Vector::new(x, y, z)
}

impl Build {
    pub fn new() -> Self {
        let mut build = Self(Scene::default());
        build.0.finishes.push(Finish::Classic(ClassicFinish::default()));
        let white = build.pigment(PigmentKind::Color(Color::WHITE), vec![]);
        build.texture(white, vec![]);
        let checker = build.pigment(checker(), vec![]);
        build.texture(checker, vec![]);
        build.0.cameras.push(Camera {
            is_in_order: false,
            kind: CameraKind::Perspective,
            meshes: None,
            items: vec![],
            site: site(0),
        });
        build
    }

    pub fn transform(&mut self, steps: Vec<Step>) -> TransformId {
        self.0.transforms.push(steps);
        TransformId(self.0.transforms.len() as u32 - 1)
    }

    pub fn pigment(&mut self, kind: PigmentKind, steps: Vec<Step>) -> PigmentId {
        let own = (!steps.is_empty()).then(|| scene::Step::Transform(self.transform(steps)));
        let steps = own.into_iter().collect();
        self.0.pigments.push(Pigment {
            kind,
            steps,
            site: site(900),
            clear: None,
            has_own_colors: false,
            quick_color: None,
        });
        PigmentId(self.0.pigments.len() as u32 - 1)
    }

    pub fn texture(&mut self, pigment: PigmentId, steps: Vec<Step>) -> TextureId {
        let transforms = if steps.is_empty() { vec![] } else { vec![self.transform(steps)] };
        self.0.textures.push(Texture { transforms, ..Texture::plain(pigment, FinishId(0)) });
        TextureId(self.0.textures.len() as u32 - 1)
    }

    pub fn object(&mut self, kind: ObjectKind, modifiers: Vec<ModifierKind>) -> ObjectId {
        let n = self.0.objects.len();
        let modifiers =
            modifiers.into_iter().map(|kind| Modifier { kind, site: site(500 + n) }).collect();
        self.0.objects.push(Object { kind, modifiers, site: site(100 + n), item: None });
        ObjectId(n as u32)
    }

    /// An object under steps.
    pub fn moved(&mut self, kind: ObjectKind, steps: Vec<Step>) -> ObjectId {
        let id = self.transform(steps);
        self.object(kind, vec![ModifierKind::Transform(id)])
    }

    pub fn root(&mut self, object: ObjectId) {
        self.0.roots.push(Root { object, default_texture: PLAIN });
    }

    pub fn lower(self) -> (World, Origins, Diagnostics) {
        let mut diagnostics = Diagnostics::new(true);
        let (world, origins) =
            super::super::lower(self.0, &LowerOptions::default(), &mut diagnostics);
        (world, origins, diagnostics)
    }

    pub fn world(self) -> World {
        let (world, _, diagnostics) = self.lower();
        assert!(!diagnostics.has_errors(), "{diagnostics:?}");
        world
    }

    pub fn codes(self) -> Vec<Code> {
        self.lower().2.iter().map(|d| d.code).collect()
    }
}

/// One object under steps, alone in a World with a light.
pub fn spend(kind: ObjectKind, steps: Vec<Step>) -> World {
    let mut build = Build::new();
    let object = build.moved(kind, steps);
    build.root(object);
    build.world()
}

pub fn checker() -> PigmentKind {
    checker_of([Color::BLACK, Color::opaque(Rgb::gray(0.5))])
}

pub fn checker_of([even, odd]: [Color; 2]) -> PigmentKind {
    let source = Source::Kind(Kind::Checker(Checker {}));
    let pattern = Pattern { source, site: site(901), modifiers: Modifiers::default() };
    let colors = Colors::Map(ColorMap(vec![(0.0, even), (1.0, odd)]));
    PigmentKind::Patterned { pattern: Box::new(pattern), colors }
}

/// The plain texture of object `index`.
pub fn texture_of(world: &World, index: usize) -> &Plain {
    match &world.textures[world.objects[index].texture as usize] {
        world::Texture::Plain(plain) => plain,
        other => panic!("a plain texture: {other:?}"),
    }
}

pub fn translate(x: f64, y: f64, z: f64) -> Step {
    Step::Translate(v(x, y, z))
}

pub fn scale(x: f64, y: f64, z: f64) -> Step {
    Step::Scale(v(x, y, z))
}

pub fn rotate(x: f64, y: f64, z: f64) -> Step {
    Step::Rotate(v(x, y, z))
}

pub fn sphere(x: f64, y: f64, z: f64, radius: f64) -> ObjectKind {
    ObjectKind::Solid(Solid::Sphere { centre: v(x, y, z), radius })
}

pub fn plane(x: f64, y: f64, z: f64, distance: f64) -> ObjectKind {
    ObjectKind::Solid(Solid::Plane { normal: v(x, y, z), distance })
}

pub fn box_(a: Vector, b: Vector) -> ObjectKind {
    ObjectKind::Solid(Solid::Box { corners: [a, b] })
}
