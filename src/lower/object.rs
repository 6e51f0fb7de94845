//! The walk down the objects: modifiers become maps, unions flatten, leaves are spent.
//!
//! **Invariant:** an explicit stack, in written order; a hundred thousand levels overflow nothing.
//! A transform moves what precedes it: the solid, and whichever texture it already has.

use super::shape::{LocalFace, Round};
use super::texture::Surface;
use super::transform::{Affine, NEAR_SINGULAR};
use super::{Fault, Lowering, NO_SIZE, shape};
use crate::diagnostic::Code;
use crate::scene::{InteriorId, ModifierKind, ObjectId, ObjectKind, Root, TextureId};
use crate::shape::Shape;
use crate::source::Site;
use crate::world::{NearSingular, Object};

/// What a child takes from above.
#[derive(Debug, Clone, Copy)]
struct Inherited {
    world_from_here: Affine,
    /// For whatever has no texture of its own. Its place is in the world.
    surface: Surface,
    /// For whatever has no interior of its own.
    interior: Option<InteriorId>,
    flags: Flags,
    /// The outermost object whose flags hide it from everything.
    hidden_by: Option<ObjectId>,
    /// The innermost of those above that could be taken out of the text.
    item: Option<Site>,
    /// One of the transforms is near-singular by itself.
    strained: bool,
}

impl Inherited {
    /// What a root takes from the scene, whose default is `surface`.
    fn root(surface: Surface) -> Self {
        Self {
            world_from_here: Affine::IDENTITY,
            surface,
            interior: None,
            flags: Flags::default(),
            hidden_by: None,
            item: None,
            strained: false,
        }
    }
}

/// An object's modifiers come to this.
#[derive(Default)]
struct Modified {
    /// From the space the object was written in to that of its parent; `None` where they are the same.
    map: Option<Affine>,
    /// Its place is in the parent's space.
    surface: Option<Surface>,
    interior: Option<InteriorId>,
    flags: Flags,
    /// The use whose flags, with those of what it uses, hide it from everything.
    hidden_by: Option<ObjectId>,
    strained: bool,
    calls: Calls,
}

/// What an object is that most are not.
#[derive(Debug, Clone, Copy, Default)]
struct Flags {
    no_shadow: bool,
    no_image: bool,
    no_reflection: bool,
    double_illuminate: bool,
    inverse: bool,
}

impl Flags {
    /// Those of an object inside another.
    fn under(self, above: Self) -> Self {
        Self {
            no_shadow: self.no_shadow || above.no_shadow,
            no_image: self.no_image || above.no_image,
            no_reflection: self.no_reflection || above.no_reflection,
            double_illuminate: self.double_illuminate || above.double_illuminate,
            inverse: self.inverse != above.inverse,
        }
    }

    /// No ray meets the object.
    fn hide(self) -> bool {
        self.no_shadow && self.no_image && self.no_reflection
    }
}

/// Which modifiers call for an effect, if there is a solid that they hold for: without all of them it has
/// none.
#[derive(Debug, Clone, Default)]
struct Calls {
    no_image: Vec<Site>,
    no_reflection: Vec<Site>,
    double_illuminate: Vec<Site>,
}

/// What was undone calls for nothing, even where it is done again: then only that does.
fn call(calls: &mut Vec<Site>, on: bool, site: Site) {
    match on {
        true => calls.push(site),
        false => calls.clear(),
    }
}

struct Frame<'s> {
    /// Of the union that is gone through, and how many solids there were before it.
    calls: Calls,
    before: usize,
    children: std::slice::Iter<'s, ObjectId>,
    inherited: Inherited,
}

impl<'s> Lowering<'s, '_> {
    pub(super) fn objects(&mut self) {
        let mut visits = 0;
        let mut stack: Vec<Frame> = Vec::new();
        // Most roots have the same default.
        let mut last: Option<(TextureId, Inherited)> = None;
        for &Root { object, default_texture } in &self.scene.roots {
            if last.as_ref().is_none_or(|(texture, _)| *texture != default_texture) {
                let place = Affine::IDENTITY;
                let set = Surface::set(self.scene, &mut self.transforms, default_texture, place);
                let Some(surface) = self.reporter.made_there(set) else { continue };
                last = Some((default_texture, Inherited::root(surface)));
            }
            let Some((_, inherited)) = &last else { continue };
            if !self.may_visit(object, &mut visits) {
                return;
            }
            stack.extend(self.visit(object, inherited, default_texture));
            while let Some(frame) = stack.last_mut() {
                let Some(&id) = frame.children.next() else {
                    if let Some(Frame { calls, before, .. }) = stack.pop() {
                        self.note_calls(calls, before);
                    }
                    continue;
                };
                if !self.may_visit(id, &mut visits) {
                    return;
                }
                let inner = self.visit(id, &frame.inherited, default_texture);
                stack.extend(inner);
            }
        }
    }

    /// Counts one object more; says so where that is one too many.
    fn may_visit(&mut self, id: ObjectId, visits: &mut u64) -> bool {
        let limit = self.options.objects;
        *visits += 1;
        if *visits <= limit {
            return true;
        }
        let fault =
            Fault::new(Code::ObjectLimit, format!("the scene has more than {limit} objects"))
                .help("raise the limit with `--limit objects=N`");
        self.reporter.fault(fault.label("reached here"), self.scene.objects[id.index()].site);
        false
    }

    /// Spends a leaf, or returns how to go through a union.
    fn visit(
        &mut self,
        id: ObjectId,
        inherited: &Inherited,
        default_texture: TextureId,
    ) -> Option<Frame<'s>> {
        let scene = self.scene;
        // A use goes on where the object it names left off: its texture replaces that one's.
        let (mut uses, mut target) = (Vec::new(), id);
        while let ObjectKind::Use(next) = scene.objects[target.index()].kind {
            uses.push(target);
            target = next;
        }
        let object = &scene.objects[target.index()];
        let mut own = object.item;
        let mut modified = Modified::default();
        self.modify(&mut modified, target, default_texture)?;
        for &id in uses.iter().rev() {
            own = own.or(scene.objects[id.index()].item);
            self.modify(&mut modified, id, default_texture)?;
        }
        let above = &inherited.world_from_here;
        let flags = modified.flags.under(inherited.flags);
        let by_both = flags.hide().then_some(id);
        let here = Inherited {
            world_from_here: match &modified.map {
                Some(map) => above.after(map),
                None => *above,
            },
            surface: match (&modified.surface, &modified.map) {
                (Some(own), _) => own.within(above),
                (None, Some(map)) => inherited.surface.under(map),
                (None, None) => inherited.surface,
            },
            interior: modified.interior.or(inherited.interior),
            flags,
            hidden_by: inherited.hidden_by.or(modified.hidden_by).or(by_both),
            item: own.or(inherited.item),
            strained: inherited.strained || modified.strained,
        };
        match &object.kind {
            ObjectKind::Union(children) => {
                if children.is_empty() {
                    self.drop_part(object.site, "union", "it is empty");
                }
                return Some(Frame {
                    calls: modified.calls,
                    before: self.world.objects.len(),
                    children: children.iter(),
                    inherited: here,
                });
            }
            ObjectKind::LightSource(light) => {
                let item = here.item.unwrap_or(object.site);
                self.light(light, &here.world_from_here, object.site, item);
            }
            solid => {
                let before = self.world.objects.len();
                let spent = self.solid(solid, &here, object.site);
                if matches!(&spent, Err(fault) if fault.code == Code::ZeroSize) {
                    self.drop_part(object.site, self.word(target), NO_SIZE);
                }
                self.reporter.made(spent, object.site);
                self.note_calls(modified.calls, before);
            }
        }
        None
    }

    /// The modifiers of an object, or of a use of it, which come after its own. `None`, and a message, where
    /// a transform cannot be spent.
    fn modify(
        &mut self,
        modified: &mut Modified,
        id: ObjectId,
        default_texture: TextureId,
    ) -> Option<()> {
        let scene = self.scene;
        for modifier in &scene.objects[id.index()].modifiers {
            let map = modified.map.unwrap_or(Affine::IDENTITY);
            let (flags, calls) = (&mut modified.flags, &mut modified.calls);
            match modifier.kind {
                ModifierKind::Transform(id) => {
                    let step = self.transforms.get(id);
                    let step = self.reporter.made(step, modifier.site)?;
                    modified.strained |= self.transforms.near_singular(id).is_some();
                    modified.map = Some(step.after(&map));
                    modified.surface = modified.surface.map(|surface| surface.within(&step));
                }
                ModifierKind::Texture(id) => {
                    let set = Surface::set(scene, &mut self.transforms, id, map);
                    modified.surface = Some(self.reporter.made_there(set)?);
                }
                ModifierKind::Pigment(id) => {
                    let mut surface = self.textured(modified.surface, default_texture, map)?;
                    let painted = surface.repaint(scene, &mut self.transforms, id, map);
                    self.reporter.made_there(painted)?;
                    modified.surface = Some(surface);
                }
                ModifierKind::Finish(id) => {
                    let surface = self.textured(modified.surface, default_texture, map)?;
                    modified.surface = Some(surface.polished(id));
                }
                ModifierKind::Interior(id) => modified.interior = Some(id),
                ModifierKind::NoShadow => flags.no_shadow = true,
                ModifierKind::NoImage(on) => {
                    flags.no_image = on;
                    call(&mut calls.no_image, on, modifier.site);
                }
                ModifierKind::NoReflection(on) => {
                    flags.no_reflection = on;
                    call(&mut calls.no_reflection, on, modifier.site);
                }
                ModifierKind::DoubleIlluminate(on) => {
                    flags.double_illuminate = on;
                    call(&mut calls.double_illuminate, on, modifier.site);
                }
                ModifierKind::Inverse => flags.inverse = !flags.inverse,
            }
            let hiding = flags.hide();
            modified.hidden_by = modified.hidden_by.or(Some(id)).filter(|_| hiding);
        }
        Some(())
    }

    /// The object's own surface; the default texture where it has none yet.
    fn textured(
        &mut self,
        own: Option<Surface>,
        default: TextureId,
        map: Affine,
    ) -> Option<Surface> {
        own.or_else(|| {
            let set = Surface::set(self.scene, &mut self.transforms, default, map);
            self.reporter.made_there(set)
        })
    }

    fn solid(&mut self, kind: &ObjectKind, here: &Inherited, site: Site) -> Result<(), Fault> {
        let map = &here.world_from_here;
        if !map.is_finite() {
            return Err(Fault::not_finite("this solid's place"));
        }
        match *kind {
            ObjectKind::Sphere { centre, radius } => match shape::sphere(centre, radius, map)? {
                Round::Sphere(sphere) => {
                    let shape = Shape::Sphere(next(&mut self.world.spheres, sphere));
                    self.place(shape, here, here.flags.inverse, &[], site)
                }
                Round::Ellipsoid(ellipsoid) => {
                    let shape = Shape::Ellipsoid(next(&mut self.world.ellipsoids, ellipsoid));
                    self.place(shape, here, here.flags.inverse, &[], site)
                }
            },
            ObjectKind::Plane { normal, distance } => {
                let (plane, face) = shape::plane(normal, distance, here.flags.inverse, map)?;
                let shape = Shape::Plane(next(&mut self.world.planes, plane));
                // An inverse plane is the plane with the opposite normal.
                self.place(shape, here, false, &[face], site)
            }
            ObjectKind::Box { corners } => {
                let (solid, faces) = shape::box_(corners, map)?;
                if solid.half_widths.contains(&0.0) {
                    let flat = Fault::new(Code::DegenerateShape, "this box is flat");
                    self.reporter.fault(flat.label("one of its sides has no length"), site);
                }
                let shape = Shape::Box(next(&mut self.world.boxes, solid));
                self.place(shape, here, here.flags.inverse, &faces, site)
            }
            ObjectKind::Union(_) | ObjectKind::Use(_) | ObjectKind::LightSource(_) => Ok(()),
        }
    }

    fn place(
        &mut self,
        shape: Shape,
        here: &Inherited,
        inverse: bool,
        faces: &[LocalFace],
        site: Site,
    ) -> Result<(), Fault> {
        let Flags { no_shadow, no_image, no_reflection, double_illuminate, .. } = here.flags;
        let object = Object {
            casts_shadow: !no_shadow,
            in_image: !no_image,
            in_reflections: !no_reflection,
            double_illuminate,
            inverse,
            ..Object::plain(shape)
        };
        if let Some(by) = here.hidden_by
            && self.drop_unseen(&object, by)
        {
            return Ok(());
        }
        let surface = &here.surface;
        let material = match here.hidden_by {
            Some(_) => self.bare_material(),
            None => self.seen_material(surface, site),
        };
        let texture_from_world = self.texture_map(surface, material)?;
        let faces = match faces {
            [] => None,
            faces => self.faces(surface, material, faces)?,
        };
        self.note_near_singular(here, site);
        if object.casts_shadow {
            self.note_filter(material, surface.pigment);
        }
        let interior = self.interior(here.interior, surface.finish, site);
        self.world.objects.push(Object { material, texture_from_world, faces, interior, ..object });
        self.origins.objects.push(site);
        Ok(())
    }
}

impl Lowering<'_, '_> {
    /// The material of an object that something may see.
    fn seen_material(&mut self, surface: &Surface, site: Site) -> u32 {
        let material = self.material(surface.pigment, surface.finish, site);
        let unpainted = self.scene.pigments[surface.pigment.index()].written().is_none();
        // What mirrors is seen by what it mirrors.
        if unpainted && self.world.materials[material as usize].finish.reflection.is_none() {
            self.unpainted.entry(site.span).or_insert(site);
        }
        material
    }

    /// Notes modifiers that hold for solids made since there were `before`.
    fn note_calls(&mut self, calls: Calls, before: usize) {
        if self.world.objects.len() > before {
            self.origins.hidden.extend(calls.no_image);
            self.origins.hidden.extend(calls.no_reflection);
            self.origins.double_illuminate.extend(calls.double_illuminate);
        }
    }

    /// Notes an object whose transforms together nearly flatten space, while none alone does.
    fn note_near_singular(&mut self, here: &Inherited, site: Site) {
        let map = &here.world_from_here;
        if here.strained || map.uniform_scale().is_some() {
            return;
        }
        let condition = map.condition();
        if condition >= NEAR_SINGULAR {
            self.origins.near_singular.push(NearSingular { site, condition });
        }
    }
}

/// Appends and returns the new entry's index.
fn next<T>(list: &mut Vec<T>, item: T) -> u32 {
    list.push(item);
    list.len() as u32 - 1
}
