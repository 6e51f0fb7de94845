//! The walk down the objects: unions flatten, operations become wholes, leaves are spent.
//!
//! **Invariant:** an explicit stack, in written order; a hundred thousand levels overflow nothing.

use std::sync::Arc;

use super::csg::{Making, Open};
use super::modifier::{Calls, Flags, Modified};
use super::place::next;
use super::shape::{Round, no_size};
use super::texture::Surface;
use super::transform::Affine;
use super::{Fault, Lowering, NO_SIZE, blob, body, outline, points, shape, sweep};
use crate::diagnostic::Code;
use crate::math::Vector;
use crate::scene::{Dialect, InteriorId, ObjectId, ObjectKind, Operation, Root, Solid, TextureId};
use crate::shape::Shape;
use crate::source::Site;

/// What a child takes from above.
#[derive(Debug, Clone)]
pub(super) struct Inherited {
    pub world_from_here: Affine,
    /// For whatever has no texture of its own. Its place is in the world.
    pub surface: Surface,
    /// For whatever has no interior of its own.
    pub interior: Option<InteriorId>,
    pub flags: Flags,
    /// The outermost object whose flags hide it from everything.
    pub hidden_by: Option<ObjectId>,
    /// The innermost of those above that could be taken out of the text.
    pub item: Option<Site>,
    /// One of the transforms is near-singular by itself.
    pub strained: bool,
    /// No ray meets the whole that this belongs to.
    pub unseen: bool,
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
        let count = self.scene.roots.len();
        self.world.objects.reserve(count);
        self.origins.objects.reserve(count);
        for &Root { object, default_texture } in &self.scene.roots {
            if last.as_ref().is_none_or(|(texture, _)| *texture != default_texture) {
                let Some(surface) = self.set_surface(default_texture, Affine::IDENTITY) else {
                    continue;
                };
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
                        self.note_calls(&calls, before);
                    }
                    continue;
                };
                if !self.may_visit(id, &mut visits) {
                    return self.leave_unfinished();
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
        if let ObjectKind::Solid(solid) = &object.kind
            && object.modifiers.is_empty()
            && uses.is_empty()
        {
            return self.spend(target, solid, inherited, object.site);
        }
        let mut own = object.item;
        let mut modified = Modified::default();
        for &id in [target].iter().chain(uses.iter().rev()) {
            own = own.or(scene.objects[id.index()].item);
            if self.modify(&mut modified, id, default_texture).is_none() {
                return self.leave_out(object.site);
            }
        }
        let above = &inherited.world_from_here;
        if self.building.is_some() {
            self.drop_flags_of_part(&mut modified, object.site);
        }
        let flags = modified.flags.under(inherited.flags);
        let by_both = flags.hide().then_some(id);
        let mut here = Inherited {
            world_from_here: match &modified.map {
                Some(map) => above.after(map),
                None => *above,
            },
            surface: match (modified.surface.take(), &modified.map) {
                (Some(own), _) => own.within(above),
                (None, Some(map)) => inherited.surface.clone().under(map),
                (None, None) => inherited.surface.clone(),
            },
            interior: modified.interior.or(inherited.interior),
            flags,
            hidden_by: inherited.hidden_by.or(modified.hidden_by).or(by_both),
            item: own.or(inherited.item),
            strained: inherited.strained || modified.strained,
            unseen: inherited.unseen,
        };
        let is_whole = !modified.clips.is_empty() || matches!(object.kind, ObjectKind::Csg { .. });
        here.unseen |= is_whole && self.building.is_none() && self.drop_unseen_whole(&here);
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
            let open = self.open(Making::Clip, inverse, object.site);
            let region = Inherited {
                // Of its surface nothing is seen.
                hidden_by: Some(id),
                flags: Flags { inverse: false, ..here.flags },
                unseen: here.unseen,
                ..inherited.clone()
            };
            let clips = Children::Clips(modified.clips.into_iter());
            stack.push(frame(open, false, clips, region, Calls::default()));
        }
        match &object.kind {
            ObjectKind::Union(children) => {
                if children.is_empty() {
                    self.drop_part(object.site, "union", "it is empty");
                }
                let open = self.open(Making::Union, inverse, object.site);
                let children = Children::Listed(children.iter());
                stack.push(frame(open, false, children, here, modified.calls));
            }
            ObjectKind::Csg { operation, children } => {
                if children.is_empty() {
                    self.drop_part(object.site, operation.word().name(), "it is empty");
                }
                let open = self.open(Making::Operation(*operation), inverse, object.site);
                let difference = *operation == Operation::Difference;
                let children = Children::Listed(children.iter());
                stack.push(frame(open, difference, children, here, modified.calls));
            }
            ObjectKind::LightSource(light) => {
                let item = here.item.unwrap_or(object.site);
                self.light(light, &here.world_from_here, object.site, item);
            }
            ObjectKind::Solid(solid) => {
                self.spend(target, solid, &here, object.site);
                self.note_calls(&modified.calls, before);
            }
            ObjectKind::Use(_) => {}
        }
    }

    fn spend(&mut self, id: ObjectId, solid: &Solid, here: &Inherited, site: Site) {
        let spent = self.solid(id, solid, here, site);
        if matches!(&spent, Err(fault) if fault.code == Code::ZeroSize) {
            self.drop_part(site, self.word(id), NO_SIZE);
        }
        if self.reporter.made(spent, site).is_none() {
            self.leave_out(site);
        }
    }

    /// What cannot be built is nothing in a `.pov`, as in POV-Ray 3.7 (measured); elsewhere it is a mistake.
    fn leave_out(&mut self, site: Site) {
        if self.scene.dialect == Dialect::Pov {
            // No place is in it, nor in what it is taken from.
            self.nothing(false, site);
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
        // Told where it is written, and left out; a blank need not be told.
        let may_be_nothing =
            self.scene.dialect == Dialect::Pov || matches!(solid, Solid::Text { .. });
        if may_be_nothing && solid.is_sizeless() {
            self.nothing(here.flags.inverse, site);
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
                // Those of a file may be named in many places.
                let id = *self.meshes.entry(Arc::as_ptr(triangles)).or_insert(id);
                let here = &here.of_faces(self.scene, triangles);
                self.place_stored(id, || body::mesh(triangles), here, site)
            }
            Solid::Blob(ref written) => {
                let made =
                    self.shared(id, |lowering| blob::blob(written, &mut lowering.transforms))?;
                match made {
                    Some((body, frame)) => self.place_body(body, &frame, here, site),
                    None => self.place_nowhere(
                        here,
                        site,
                        ("blob", "nowhere is it as strong as its threshold"),
                    ),
                }
            }
            Solid::Text { ref text } => self.place_stored(id, || points::text(text), here, site),
            Solid::BicubicPatch { points: ref net } => {
                self.place_stored(id, || points::bicubic_patch(net).map(Some), here, site)
            }
            Solid::HeightField { ref field } => {
                self.place_stored(id, || Ok(points::height_field(field)), here, site)
            }
            Solid::Polygon { ref polygon } => {
                self.place_stored(id, || points::polygon(polygon), here, site)
            }
            Solid::Cone { ends, radii, open } => {
                self.place_made(body::cone(ends, radii, open)?, here, site)
            }
            Solid::Disc { centre, normal, radius, hole } => {
                self.place_made(body::disc(centre, normal, radius, hole)?, here, site)
            }
            // The greater ball holds the other.
            Solid::Ovus { bottom, top } if top == 0.0 || top * 0.5 >= bottom => {
                let centre = if top == 0.0 { Vector::ZERO } else { Vector::Y * bottom };
                let ball = Solid::Sphere { centre, radius: bottom.max(top) };
                self.solid(id, &ball, here, site)
            }
            Solid::Ovus { bottom, top } => self.place_made(body::ovus(bottom, top), here, site),
            Solid::SphereSweep(ref written) => {
                match self.shared(id, |_| sweep::sphere_sweep(written))? {
                    Some((body, frame)) => self.place_body(body, &frame, here, site),
                    None => Err(no_size("this sphere_sweep has no thickness")),
                }
            }
            Solid::JuliaFractal(ref fractal) => {
                let nowhere = ("julia_fractal", "its slice is beyond all of it");
                let make = || Ok(body::julia_fractal(fractal));
                self.place_if_somewhere(id, make, here, site, nowhere)
            }
            Solid::Superellipsoid { exponents } => {
                self.place_made(body::superellipsoid(exponents), here, site)
            }
            Solid::Isosurface { ref function, ref container, threshold, accuracy, open } => {
                let make = || body::isosurface(function, **container, threshold, accuracy, open);
                let nowhere = ("isosurface", "nowhere is it below its threshold");
                self.place_if_somewhere(id, make, here, site, nowhere)
            }
            Solid::Parametric { ref functions, corners, ref container } => {
                let make = || body::parametric(functions, corners, **container);
                let nowhere = ("parametric", "all of it is outside of its container");
                self.place_if_somewhere(id, make, here, site, nowhere)
            }
            // A tube about a point is a ball.
            Solid::Torus { major: 0.0, minor } => {
                let ball = Solid::Sphere { centre: Vector::ZERO, radius: minor };
                self.solid(id, &ball, here, site)
            }
            Solid::Torus { major, minor } => self.place_made(body::torus(major, minor), here, site),
            Solid::Lathe { spline, ref points } => {
                self.place_stored(id, || outline::lathe(spline, points), here, site)
            }
            Solid::Prism { spline, conic, heights, ref points, open } => {
                let make = || outline::prism(spline, conic, heights, points, open);
                self.place_stored(id, make, here, site)
            }
            Solid::Sor { ref points, open } => {
                self.place_stored(id, || outline::sor(points, open), here, site)
            }
            Solid::Polynomial { degree, ref terms, form } => {
                let make = || body::polynomial(degree, terms);
                let nowhere = (form.name(), "nowhere is its polynomial below 0");
                self.place_if_somewhere(id, make, here, site, nowhere)
            }
        }
    }
}

impl Frame<'_> {
    /// The next object, and what it takes from above.
    fn next(&mut self) -> Option<(ObjectId, Inherited)> {
        let mut inherited = self.inherited.clone();
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
