//! Scenes made by hand in Rust, for what is tested below the language.

use lucarne::color::{Color, Rgb};
use lucarne::math::Vector;
use lucarne::math::transform::Step;
use lucarne::scene::*;
use lucarne::source::{ExpansionId, FileId, Site, Span};

pub const SITE: Site =
    Site { span: Span { file: FileId(0), start: 0, end: 0 }, expansion: ExpansionId::MAIN };

/// A finish of the page.
pub fn seed(kd: f64, ks: f64, phong_exponent: f64) -> Finish {
    Finish::Seed { kd, ks, phong_exponent }
}

/// A scene in the making: the page's camera at distance 10 with a 90° angle and a 2 × 1 screen.
pub struct Sketch {
    pub scene: Scene,
    default_texture: TextureId,
}

impl Sketch {
    pub fn new() -> Self {
        let camera = [
            CameraItemKind::Location(Vector::Z * 10.0),
            CameraItemKind::Right(Vector::X * 2.0),
            CameraItemKind::Up(Vector::Y),
            CameraItemKind::Shift { x: 0.0, y: 0.5 },
            CameraItemKind::Angle(90.0),
            CameraItemKind::LookAt(Vector::ZERO),
        ];
        let mut sketch = Self {
            scene: Scene {
                cameras: vec![Camera {
                    is_in_order: false,
                    kind: CameraKind::Perspective,
                    meshes: None,
                    items: camera.map(|kind| CameraItem { kind, site: SITE }).to_vec(),
                    site: SITE,
                }],
                settings: Settings { ambient_light: Rgb::gray(0.2), ..Settings::default() },
                ..Scene::default()
            },
            default_texture: TextureId(0),
        };
        sketch.texture(Rgb::BLACK, Finish::Classic(ClassicFinish::default()));
        sketch
    }

    pub fn texture(&mut self, color: Rgb, finish: Finish) -> TextureId {
        let scene = &mut self.scene;
        let kind = PigmentKind::Color(Color::opaque(color));
        scene.pigments.push(Pigment {
            kind,
            steps: Vec::new(),
            site: SITE,
            clear: None,
            has_own_colors: false,
            quick_color: None,
        });
        scene.finishes.push(finish);
        let pigment = PigmentId(scene.pigments.len() as u32 - 1);
        let finish = FinishId(scene.finishes.len() as u32 - 1);
        scene.textures.push(Texture::plain(pigment, finish));
        TextureId(scene.textures.len() as u32 - 1)
    }

    /// An object that stands nowhere yet, with a texture (or none) and then a transform.
    pub fn object(
        &mut self,
        kind: ObjectKind,
        texture: Option<TextureId>,
        steps: &[Step],
    ) -> ObjectId {
        let mut modifiers: Vec<ModifierKind> =
            texture.map(ModifierKind::Texture).into_iter().collect();
        for step in steps {
            self.scene.transforms.push(vec![*step]);
            let last = self.scene.transforms.len() as u32 - 1;
            modifiers.push(ModifierKind::Transform(TransformId(last)));
        }
        let modifiers = modifiers.into_iter().map(|kind| Modifier { kind, site: SITE }).collect();
        self.scene.objects.push(Object { kind, modifiers, site: SITE, item: None });
        ObjectId(self.scene.objects.len() as u32 - 1)
    }

    pub fn place(&mut self, object: ObjectId) {
        self.scene.roots.push(Root { object, default_texture: self.default_texture });
    }

    pub fn light(&mut self, kind: LightKind, color: Rgb) {
        let light = LightSource::new(kind, color);
        let object = self.object(ObjectKind::LightSource(Box::new(light)), None, &[]);
        self.place(object);
    }
}
