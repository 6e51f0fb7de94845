//! Lowers a [`Scene`] to the canonical [`World`] that the renderer traces.
//!
//! **In:** a [`Scene`]. **Out:** the canonical [`World`] and the origins of its parts in the source.
//! **Invariant:** always yields a World; a part that cannot be built is reported and left out. Every number
//! of the World is computed in extended precision and rounded once. Specified in `docs/world.md`.

pub(crate) mod alone;
mod blob;
mod body;
mod camera;
mod cause;
mod coinciding;
mod csg;
mod cutaway;
mod doubled;
mod empty;
mod faces;
mod finish;
mod focus;
mod fog;
mod hollow;
mod inherited;
mod inside;
mod interior;
mod light;
mod light_group;
mod lining;
mod lint;
mod mesh_camera;
mod modifier;
mod normal;
mod object;
mod outline;
mod pigment;
mod place;
mod points;
mod quadric;
mod rainbow;
mod shape;
mod single;
mod surface;
mod sweep;
mod texture;
mod transform;
pub(crate) mod unlit;
mod unseen;
mod uv;
mod view;

pub(crate) use single::single;
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use crate::color::{Clearness, Color};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::scene::mesh::Triangles;
use crate::scene::{Dialect, ObjectId, Scene, TextureId, TransformId, Unused};
use crate::shape::Body;
use crate::source::{Expansions, Site, Span};
use crate::world::{Dropped, NearSingular, Origins, Pigment, Settings, Texture, World};

/// Options of [`lower`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LowerOptions {
    /// The most objects, counting each use of a shared one: nested unions can hold 2ⁿ objects in n lines.
    pub objects: u64,
    /// Width and height in pixels of the output picture, if known.
    pub picture: Option<(u32, u32)>,
    /// Search for coinciding faces even if no diagnostic would report them.
    pub coinciding: bool,
    /// No light is missing, although the scene was read with errors.
    pub lights_known: bool,
}

impl Default for LowerOptions {
    fn default() -> Self {
        Self { objects: 5_000_000, picture: None, coinciding: false, lights_known: false }
    }
}

/// Returns the canonical [`World`] of a scene, and where its parts are written.
///
/// ```
/// use lucarne::{lower::{LowerOptions, lower}, road::{Options, Road}, source::NoFiles};
///
/// let mut road = Road::new(&NoFiles, Options::default());
/// let file = road.read("a.scene", "sphere { y, 1 scale 2 rotate 90*x } sphere { 0, 1 scale <1, 2, 1> }");
/// let ast = road.parse(file);
/// let scene = road.evaluate(ast);
/// let (world, origins) = lower(scene, &LowerOptions::default(), &mut road.diagnostics);
/// assert_eq!((world.spheres[0].centre.z, world.spheres[0].radius), (2.0, 2.0));
/// assert_eq!((world.ellipsoids.len(), origins.objects.len()), (1, 2));
/// ```
pub fn lower(
    scene: Scene,
    options: &LowerOptions,
    diagnostics: &mut Diagnostics,
) -> (World, Origins) {
    lower_at(scene, transform::Affine::IDENTITY, options, diagnostics)
}

/// As [`lower`], with all objects moved by `place`.
fn lower_at(
    scene: Scene,
    place: transform::Affine,
    options: &LowerOptions,
    diagnostics: &mut Diagnostics,
) -> (World, Origins) {
    let is_sound = !diagnostics.has_errors();
    let mut lowering = Lowering {
        is_sound,
        is_blind: false,
        sees_nothing: false,
        place,
        world: World::default(),
        origins: Origins::default(),
        reporter: Reporter::new(&scene, diagnostics),
        textures: texture::Textures::default(),
        branches: pigment::Branches::default(),
        transforms: transform::Transforms::new(&scene.transforms),
        last_surface: None,
        dropped: HashMap::new(),
        fillings: Vec::new(),
        known_interiors: HashMap::new(),
        unpainted: Vec::new(),
        lamps: Vec::new(),
        black: None,
        light_groups: Vec::new(),
        emptied: BTreeMap::new(),
        idle: BTreeMap::new(),
        building: None,
        cuts_away: cutaway::any(&scene),
        shared: BTreeMap::new(),
        meshes: HashMap::new(),
        scene: &scene,
        options: *options,
    };
    lowering.settings();
    lowering.camera();
    lowering.sky();
    lowering.fogs();
    lowering.rainbows();
    lowering.objects();
    lowering.light_sets();
    if lowering.sees_nothing {
        lowering.world.objects.iter_mut().for_each(|object| object.in_image = false);
    }
    lowering.clearness();
    lowering.unused();
    lowering.near_singular();
    lowering.coinciding();
    lowering.doubled();
    lowering.lint();
    lowering.prune_interiors();
    let Lowering { world, mut origins, branches, .. } = lowering;
    origins.surfaces = branches.parts;
    origins.expansions = scene.expansions;
    (world, origins)
}

/// The state of one lowering: its input, its output and its caches.
struct Lowering<'s, 'd> {
    scene: &'s Scene,
    options: LowerOptions,
    /// The scene was read without an error, so that nothing written is missing from it.
    is_sound: bool,
    /// The camera could not be built.
    is_blind: bool,
    /// The camera's rays hit no object.
    sees_nothing: bool,
    /// Moves all objects.
    place: transform::Affine,
    world: World,
    origins: Origins,
    reporter: Reporter<'s, 'd>,
    textures: texture::Textures,
    branches: pigment::Branches,
    transforms: transform::Transforms<'s>,
    /// The last texture that was set without a transform.
    last_surface: Option<(TextureId, surface::Surface)>,
    /// Parts left out so far, and the index of each in the origins: a source location is listed once, however
    /// often it is visited.
    dropped: HashMap<(&'static str, String, Span), usize>,
    /// Interior and finish of each object that has an interior, in order.
    fillings: Vec<interior::Filling>,
    /// The World's index of each interior, keyed by the bits of its numbers.
    known_interiors: HashMap<[u64; 8], u32>,
    /// Sites of solids that have no pigment and do not reflect.
    unpainted: Vec<Site>,
    /// The site of each light's keyword.
    lamps: Vec<Site>,
    /// The light groups visited so far.
    light_groups: Vec<light_group::LightGroup>,
    /// The colour of the first black light.
    black: Option<Site>,
    /// Pending `nothing-left` diagnostics, keyed by operation span; `None` where something is left of one of
    /// them.
    emptied: BTreeMap<(Span, bool), Option<(Diagnostic, Site)>>,
    /// Likewise, for each part of a difference that may take nothing away.
    idle: BTreeMap<Span, Option<(Diagnostic, Site)>>,
    /// The CSG solid under construction.
    building: Option<csg::Building>,
    /// An object has `cutaway_textures`.
    cuts_away: bool,
    /// The body of each mesh and blob, stored once however often it is used; `None` where it is empty.
    shared: BTreeMap<ObjectId, Option<(Arc<Body>, transform::Affine)>>,
    /// The first object of those that share the same triangles.
    meshes: HashMap<*const Triangles, ObjectId>,
}

impl Lowering<'_, '_> {
    /// Records that a part cannot change the picture, and is therefore not in the World.
    fn drop_part(&mut self, site: Site, what: &'static str, why: &str) {
        let next = self.origins.dropped.len();
        let place = *self.dropped.entry((what, why.to_owned(), site.span)).or_insert(next);
        if place == next {
            let (what, why) = (what.to_owned(), why.to_owned());
            self.origins.dropped.push(Dropped { site, what, why, calls: Vec::new() });
        }
        // A part inside a macro is listed once for each call.
        let call = self.scene.expansions.get(site.expansion).map(|expansion| expansion.call);
        let part = &mut self.origins.dropped[place];
        part.calls.extend(call.filter(|call| !part.calls.contains(call)));
    }

    /// Reports the transforms that nearly flatten space: the worst one at each source location.
    fn near_singular(&mut self) {
        let sites = self.scene.transform_sites.iter().enumerate();
        let found = sites.filter_map(|(i, &site)| {
            let condition = self.transforms.near_singular(TransformId(i as u32))?;
            Some(NearSingular { site, condition })
        });
        let all = &mut self.origins.near_singular;
        all.extend(found);
        all.sort_by(|a, b| a.site.span.cmp(&b.site.span).then(b.condition.total_cmp(&a.condition)));
        all.dedup_by_key(|near| near.site.span);
    }

    /// Reports what the scene declares or sets without using it.
    fn unused(&mut self) {
        let scene = self.scene;
        if let [ignored @ .., _] = scene.cameras.as_slice() {
            for camera in ignored {
                self.drop_part(camera.site, "camera", "the last one counts");
            }
        }
        for &(word, site) in &scene.sizeless {
            self.drop_part(site, word, NO_SIZE);
        }
        for Unused { directive, name, site, .. } in &scene.unused {
            let (what, why) = (format!("#{directive} {name}"), "nothing uses it".to_owned());
            self.origins.dropped.push(Dropped { site: *site, what, why, calls: Vec::new() });
        }
    }

    fn settings(&mut self) {
        let settings = &self.scene.settings;
        self.world.settings = Settings {
            max_trace_level: settings.max_trace_level.max(1),
            adc_bailout: settings.adc_bailout,
            assumed_gamma: settings.assumed_gamma,
            clearness: Clearness::Current,
            untinted_layers: false,
        };
        self.origins.max_trace_level = settings.max_trace_level_site;
        self.world.backdrop.only_mirrored = settings.clearness == Clearness::Old;
        if let Some(background) = &self.scene.background {
            let Color { rgb, transmit, .. } = background.color;
            self.world.backdrop.color = Color { rgb: rgb.bounded(), ..background.color };
            let rgb = match settings.clearness {
                Clearness::Current => rgb * (1.0 - transmit),
                Clearness::Old => rgb,
            };
            let rgb = rgb.bounded();
            let rgb = rgb.is_finite().then_some(rgb).ok_or(Fault::not_finite("the background"));
            self.world.background = self.reporter.made(rgb, background.site).unwrap_or_default();
        }
    }

    /// Keeps the scene's rules for clear colours only if they change the picture: if a colour has a
    /// `filter`, or one part of the sky is seen through another.
    fn clearness(&mut self) {
        let world = &self.world;
        let filters = |color: Color| color.filter != 0.0;
        let is_tinted =
            |texture: &Texture| texture.has_layers() && texture.colors().into_iter().any(filters);
        let untinted = self.scene.settings.untinted_layers;
        let untinted = untinted && world.textures.iter().any(is_tinted);
        let is_filtering = |texture: &Texture| {
            let mut any = false;
            texture.for_each_color(&mut |color| any |= filters(color));
            any
        };
        let sky = world.sky.iter().flat_map(|sky| sky.pigments.iter().skip(1));
        if world.textures.iter().any(is_filtering) || sky.into_iter().any(Pigment::is_clear) {
            self.world.settings.clearness = self.scene.settings.clearness;
        }
        self.world.settings.untinted_layers = untinted;
    }
}

/// The reason for dropping a part that is too small.
const NO_SIZE: &str = "it has no size";

/// The reason why a part of the Scene cannot be built, without its location, which the caller adds.
#[derive(Debug, Clone, PartialEq)]
struct Fault {
    code: Code,
    message: String,
    label: String,
    help: Option<&'static str>,
    /// POV-Ray 3.7 refuses to render it too.
    is_refused: bool,
}

impl Fault {
    fn new(code: Code, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), label: String::new(), help: None, is_refused: false }
    }

    fn label(self, label: impl Into<String>) -> Self {
        Self { label: label.into(), ..self }
    }

    fn help(self, help: &'static str) -> Self {
        Self { help: Some(help), ..self }
    }

    fn refused(self) -> Self {
        Self { is_refused: true, ..self }
    }

    /// Returns whether POV-Ray 3.7 renders the scene without this part.
    fn is_rendered(&self) -> bool {
        let is_left_out = matches!(
            self.code,
            Code::NotSupportedYet
                | Code::NotANumber
                | Code::OutOfRange
                | Code::ZeroSize
                | Code::ZeroVector
                | Code::DegenerateCamera
        );
        is_left_out && !self.is_refused
    }

    /// Returns the fault of a vector `what` that became zero, and so has no direction.
    fn no_direction(what: &str) -> Self {
        Self::new(Code::ZeroVector, format!("{what} is the zero vector"))
            .label("too short to point anywhere")
    }

    /// Returns the fault of a number of `what` that is infinite or NaN.
    fn not_finite(what: &str) -> Self {
        Self::new(Code::NotANumber, format!("a number of {what} is not finite"))
            .label("too large for a number, or not a number at all")
    }
}

/// The diagnostics, with what is needed to trace a location through macro expansions.
struct Reporter<'s, 'd> {
    diagnostics: &'d mut Diagnostics,
    expansions: &'s Expansions,
    dialect: Dialect,
}

impl<'s, 'd> Reporter<'s, 'd> {
    fn new(scene: &'s Scene, diagnostics: &'d mut Diagnostics) -> Self {
        Self { diagnostics, expansions: &scene.expansions, dialect: scene.dialect }
    }

    /// Reports a fault at `site`: in a `.pov` a warning if POV-Ray 3.7 leaves the part out and renders the
    /// rest.
    fn fault(&mut self, fault: Fault, site: Site) {
        let is_warning = self.dialect == Dialect::Pov && fault.is_rendered();
        let mut diagnostic = Diagnostic::new(fault.code, fault.message)
            .at(site.span, fault.label)
            .traced(site, self.expansions);
        if let Some(help) = fault.help {
            diagnostic = diagnostic.help(help);
        }
        self.diagnostics.push(if is_warning { diagnostic.as_warning() } else { diagnostic });
    }

    /// Returns the value, or reports the fault and returns `None`.
    fn made<T>(&mut self, result: Result<T, Fault>, site: Site) -> Option<T> {
        result.map_err(|fault| self.fault(fault, site)).ok()
    }

    /// As [`Self::made`], for faults that carry their own location.
    fn made_there<T>(&mut self, result: Result<T, (Fault, Site)>) -> Option<T> {
        result.map_err(|(fault, site)| self.fault(fault, site)).ok()
    }
}

#[cfg(test)]
mod tests;
