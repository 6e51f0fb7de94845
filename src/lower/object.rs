//! The walk down the objects: unions flatten, operations become wholes, leaves are spent.
//!
//! **Invariant:** an explicit stack, in written order; a hundred thousand levels overflow nothing.

use std::sync::Arc;

use super::csg::{Making, Open};
use super::modifier::{Calls, Flags, Modified};
use super::shape::{LocalFace, Round};
use super::texture::Surface;
use super::transform::{Affine, NEAR_SINGULAR};
use super::{Fault, Lowering, NO_SIZE, body, shape};
use crate::diagnostic::Code;
use crate::math::Vector;
use crate::scene::{Dialect, InteriorId, ObjectId, ObjectKind, Operation, Root, Solid, TextureId};
use crate::shape::{Body, Shape};
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
    /// No ray meets the whole that this belongs to.
    unseen: bool,
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
            unseen: false,
        }
    }
}

/// Objects that are still to be gone through.
struct Frame<'s> {
    /// The operation that makes one solid of them.
    open: Option<Open>,
    /// The others are taken from the first.
    difference: bool,
    is_first: bool,
    /// Of the union that is gone through, and how many solids there were before it.
    calls: Calls,
    before: usize,
    children: Children<'s>,
    inherited: Inherited,
}

/// What a frame goes through.
enum Children<'s> {
    Listed(std::slice::Iter<'s, ObjectId>),
    /// What clips an object, and the map to the object's parent.
    Clips(std::vec::IntoIter<(ObjectId, Affine)>),
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
            self.visit(object, inherited, default_texture, &mut stack);
            while let Some(frame) = stack.last_mut() {
                let Some((id, inherited)) = frame.next() else {
                    if let Some(Frame { open, calls, before, .. }) = stack.pop() {
                        open.into_iter().for_each(|open| self.close(open));
                        self.note_calls(calls, before);
                    }
                    continue;
                };
                if !self.may_visit(id, &mut visits) {
                    return;
                }
                self.visit(id, &inherited, default_texture, &mut stack);
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

    /// Spends a leaf, or puts what an object holds on the stack.
    fn visit(
        &mut self,
        id: ObjectId,
        inherited: &Inherited,
        default_texture: TextureId,
        stack: &mut Vec<Frame<'s>>,
    ) {
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
        for &id in [target].iter().chain(uses.iter().rev()) {
            own = own.or(scene.objects[id.index()].item);
            if self.modify(&mut modified, id, default_texture).is_none() {
                return;
            }
        }
        let above = &inherited.world_from_here;
        if self.building.is_some() {
            self.drop_flags_of_part(&mut modified, object.site);
        }
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
            unseen: inherited.unseen,
        };
        let is_whole = !modified.clips.is_empty() || matches!(object.kind, ObjectKind::Csg { .. });
        let unseen = is_whole && self.building.is_none() && self.drop_unseen_whole(&here);
        let here = Inherited { unseen: here.unseen || unseen, ..here };
        let before = self.world.objects.len();
        let inverse = flags.inverse;
        let frame = |open, difference, children, inherited, calls| Frame {
            open,
            difference,
            is_first: true,
            calls,
            before,
            children,
            inherited,
        };
        if !modified.clips.is_empty() {
            let open = self.open(Making::Clip, inverse);
            let region = Inherited {
                // Of its surface nothing is seen.
                hidden_by: Some(id),
                flags: Flags { inverse: false, ..here.flags },
                unseen: here.unseen,
                ..*inherited
            };
            let clips = Children::Clips(modified.clips.into_iter());
            stack.push(frame(open, false, clips, region, Calls::default()));
        }
        match &object.kind {
            ObjectKind::Union(children) => {
                if children.is_empty() {
                    self.drop_part(object.site, "union", "it is empty");
                }
                let open = self.open(Making::Union, inverse);
                let children = Children::Listed(children.iter());
                stack.push(frame(open, false, children, here, modified.calls));
            }
            ObjectKind::Csg { operation, children } => {
                if children.is_empty() {
                    self.drop_part(object.site, operation.word().name(), "it is empty");
                }
                let open = self.open(Making::Operation(*operation), inverse);
                let difference = *operation == Operation::Difference;
                let children = Children::Listed(children.iter());
                stack.push(frame(open, difference, children, here, modified.calls));
            }
            ObjectKind::LightSource(light) => {
                let item = here.item.unwrap_or(object.site);
                self.light(light, &here.world_from_here, object.site, item);
            }
            ObjectKind::Solid(solid) => {
                let spent = self.solid(target, solid, &here, object.site);
                if matches!(&spent, Err(fault) if fault.code == Code::ZeroSize) {
                    self.drop_part(object.site, self.word(target), NO_SIZE);
                }
                self.reporter.made(spent, object.site);
                self.note_calls(modified.calls, before);
            }
            ObjectKind::Use(_) => {}
        }
    }

    fn solid(
        &mut self,
        id: ObjectId,
        solid: &Solid,
        here: &Inherited,
        site: Site,
    ) -> Result<(), Fault> {
        let map = &here.world_from_here;
        if !map.is_finite() {
            return Err(Fault::not_finite("this solid's place"));
        }
        if here.unseen {
            return Ok(());
        }
        // Told where it is written, and left out.
        if self.scene.dialect == Dialect::Pov && solid.is_sizeless() {
            self.nothing(here.flags.inverse);
            return Ok(());
        }
        match *solid {
            Solid::Sphere { centre, radius } => match shape::sphere(centre, radius, map)? {
                Round::Sphere(sphere) => {
                    let shape = Shape::Sphere(next(&mut self.world.spheres, sphere));
                    self.place(shape, here, here.flags.inverse, &[], site)
                }
                Round::Ellipsoid(ellipsoid) => {
                    let shape = Shape::Ellipsoid(next(&mut self.world.ellipsoids, ellipsoid));
                    self.place(shape, here, here.flags.inverse, &[], site)
                }
            },
            Solid::Plane { normal, distance } => {
                let (plane, face) = shape::plane(normal, distance, here.flags.inverse, map)?;
                let shape = Shape::Plane(next(&mut self.world.planes, plane));
                // An inverse plane is the plane with the opposite normal.
                self.place(shape, here, false, &[face], site)
            }
            Solid::Box { corners } => {
                let (solid, faces) = shape::box_(corners, map)?;
                if solid.half_widths.contains(&0.0) {
                    let flat = Fault::new(Code::DegenerateShape, "this box is flat");
                    self.reporter.fault(flat.label("one of its sides has no length"), site);
                }
                let shape = Shape::Box(next(&mut self.world.boxes, solid));
                self.place(shape, here, here.flags.inverse, &faces, site)
            }
            Solid::Cylinder { ends, radius, open } => {
                self.place_made(body::cylinder(ends, radius, open)?, here, site)
            }
            Solid::Triangles { ref triangles, .. } => {
                let known = match self.meshes.get(&id) {
                    Some(known) => known.clone(),
                    None => {
                        let made = body::mesh(triangles)?;
                        let made = made.map(|(body, frame)| (Arc::new(body), frame));
                        self.meshes.entry(id).or_insert(made).clone()
                    }
                };
                match known {
                    Some((body, frame)) => self.place_body(body, &frame, here, site),
                    None => Ok(()),
                }
            }
            Solid::Cone { ends, radii, open } => {
                self.place_made(body::cone(ends, radii, open)?, here, site)
            }
            Solid::Disc { centre, normal, radius, hole } => {
                self.place_made(body::disc(centre, normal, radius, hole)?, here, site)
            }
            // A tube about a point is a ball.
            Solid::Torus { major: 0.0, minor } => {
                let ball = Solid::Sphere { centre: Vector::ZERO, radius: minor };
                self.solid(id, &ball, here, site)
            }
            Solid::Torus { major, minor } => self.place_made(body::torus(major, minor), here, site),
            Solid::Polynomial { degree, ref terms, .. } => {
                self.place_made(body::polynomial(degree, terms)?, here, site)
            }
        }
    }

    /// A body that nothing else shares, and the map to it from its own space.
    fn place_made(
        &mut self,
        (body, frame): (Body, Affine),
        here: &Inherited,
        site: Site,
    ) -> Result<(), Fault> {
        self.place_body(Arc::new(body), &frame, here, site)
    }

    /// A body and the map to it from its own space.
    fn place_body(
        &mut self,
        body: Arc<Body>,
        frame: &Affine,
        here: &Inherited,
        site: Site,
    ) -> Result<(), Fault> {
        let placed = body::place(body, &here.world_from_here.after(frame))?;
        let shape = Shape::Placed(next(&mut self.world.placed, placed));
        self.place(shape, here, here.flags.inverse, &[], site)
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
            && self.building.is_none()
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
        let whole = self.leaf(inverse);
        let object = Object { material, texture_from_world, faces, interior, whole, ..object };
        self.world.objects.push(object);
        self.origins.objects.push(site);
        Ok(())
    }
}

impl Frame<'_> {
    /// The next object, and what it takes from above.
    fn next(&mut self) -> Option<(ObjectId, Inherited)> {
        let mut inherited = self.inherited;
        let id = match &mut self.children {
            Children::Listed(children) => *children.next()?,
            Children::Clips(clips) => {
                let (id, parent_from_region) = clips.next()?;
                inherited.world_from_here = inherited.world_from_here.after(&parent_from_region);
                id
            }
        };
        let is_first = std::mem::replace(&mut self.is_first, false);
        inherited.flags.inverse ^= self.difference && !is_first;
        Some((id, inherited))
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

    /// A part is seen and casts shadows as the whole does, whatever it says itself.
    ///
    /// **Source:** measured on POV-Ray 3.7, in `intersection`, `difference` and `merge`.
    fn drop_flags_of_part(&mut self, modified: &mut Modified, site: Site) {
        let Modified { flags, calls, hidden_by, .. } = modified;
        let words = [
            (&mut flags.no_shadow, "no_shadow"),
            (&mut flags.no_image, "no_image"),
            (&mut flags.no_reflection, "no_reflection"),
        ];
        for (flag, word) in words {
            if std::mem::take(flag) {
                self.drop_part(site, word, "it is a part: that of the whole counts");
            }
        }
        calls.no_image.clear();
        calls.no_reflection.clear();
        *hidden_by = None;
    }

    /// As of a single object; all of its parts are left out. Where light is bent it stays.
    fn drop_unseen_whole(&mut self, here: &Inherited) -> bool {
        let Some(by) = here.hidden_by.filter(|_| !self.bends_light()) else { return false };
        self.drop_hidden(by);
        true
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
