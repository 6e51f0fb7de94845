//! Traverses the objects: flattens unions, opens CSG solids for the other operations, and emits leaves.
//!
//! **Invariant:** uses an explicit stack, in written order; a hundred thousand levels do not overflow it.

use std::sync::Arc;

pub(super) use super::inherited::Inherited;

use super::csg::{Making, Open};
use super::cutaway::CutFaces;
use super::modifier::{Calls, Flags, Modified};
use super::place::next;
use super::shape::{Round, no_size};
use super::surface::Parts;
use super::transform::Affine;
use super::{Fault, Lowering, NO_SIZE, blob, body, outline, points, shape, sweep};
use crate::diagnostic::Code;
use crate::math::Vector;
use crate::scene::{Dialect, ObjectId, ObjectKind, Operation, Root, Solid, TextureId};
use crate::shape::Shape;
use crate::source::Site;

/// Objects that remain to be visited.
struct Frame<'s> {
    /// The operation that combines them into one solid.
    open: Option<Open>,
    /// The others are subtracted from the first.
    difference: bool,
    is_first: bool,
    /// The effects that the enclosing union calls for, and the number of solids before it.
    calls: Calls,
    before: usize,
    children: Children<'s>,
    inherited: Inherited,
}

/// The source of a frame's objects.
enum Children<'s> {
    Listed(std::slice::Iter<'s, ObjectId>),
    /// The objects that clip another, each with the map to the parent of the clipped object.
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
            self.origins.roots.push(self.world.objects.len() as u32);
            if last.as_ref().is_none_or(|(texture, _)| *texture != default_texture) {
                let Some(surface) = self.set_surface(default_texture, Affine::IDENTITY) else {
                    continue;
                };
                let root = Inherited { world_from_here: self.place, ..Inherited::root(surface) };
                last = Some((default_texture, root));
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

    /// Counts one more object; reports when the limit is exceeded.
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

    /// Emits a leaf, or pushes an object's children onto the stack.
    fn visit(
        &mut self,
        id: ObjectId,
        inherited: &Inherited,
        default_texture: TextureId,
        stack: &mut Vec<Frame<'s>>,
    ) {
        let scene = self.scene;
        // A use continues where the object that it names ended: its texture replaces that object's.
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
        let filling = self.filling(id, &modified, inherited);
        let flags = Flags { hollow: filling.is_hollow(), ..flags };
        let cut = inherited.cut.within(&object.kind, &modified, flags.inverse);
        let by_both = flags.hide().then_some(id);
        let mut here = Inherited {
            world_from_here: match &modified.map {
                Some(map) => above.after(map),
                None => *above,
            },
            surface: match modified.surface.take() {
                Some(own) => own.within(above),
                None => modified.under(inherited.surface.clone()),
            },
            lining: match modified.lining.take() {
                Some(own) => Some(own.within(above)),
                None => inherited.lining.clone().map(|lining| modified.under(lining)),
            },
            interior: modified.interior.or(inherited.interior),
            flags,
            hidden_by: inherited.hidden_by.or(modified.hidden_by).or(by_both),
            item: own.or(inherited.item),
            strained: inherited.strained || modified.strained,
            unseen: inherited.unseen,
            cut,
            light_group: match modified.light_group {
                Some(global) => {
                    let item = own.unwrap_or(object.site);
                    Some(self.begin_light_group(inherited, global, item))
                }
                None => inherited.light_group,
            },
            filling: Some(filling),
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
                // Its surface is not visible.
                hidden_by: Some(id),
                flags: Flags { inverse: false, ..here.flags },
                unseen: here.unseen,
                cut: CutFaces::HIDDEN,
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
                if let Some(like) = self.light(light, &mut here, object.site, item) {
                    stack.push(frame(
                        None,
                        false,
                        Children::Listed(like.iter()),
                        here,
                        modified.calls,
                    ));
                }
            }
            ObjectKind::Solid(solid) => {
                self.spend(target, solid, &here, object.site);
                self.note_calls(&modified.calls, before);
            }
            ObjectKind::Use(_) => {}
        }
    }

    fn spend(&mut self, id: ObjectId, solid: &Solid, here: &Inherited, site: Site) {
        let before = self.world.objects.len();
        let spent = self.solid(id, solid, here, site);
        if spent.is_ok() && self.world.objects.len() > before {
            self.map_surface(solid, &here.world_from_here);
        }
        if matches!(&spent, Err(fault) if fault.code == Code::ZeroSize) {
            self.drop_part(site, self.word(id), NO_SIZE);
        }
        if self.reporter.made(spent, site).is_none() {
            self.leave_out(site);
        }
    }

    /// Handles an object that cannot be built: empty in a `.pov`, as in POV-Ray 3.7 (measured), and an error
    /// elsewhere.
    fn leave_out(&mut self, site: Site) {
        if self.scene.dialect == Dialect::Pov {
            // No point is inside it, nor inside what it is subtracted from.
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
        let turned = here.turned(solid);
        let here = turned.as_ref().unwrap_or(here);
        let map = &here.world_from_here;
        if !map.is_finite() {
            return Err(Fault::not_finite("this solid's place"));
        }
        if here.unseen {
            return Ok(());
        }
        // Reported where it is written, and left out; a blank text needs no report.
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
                // Triangles of one file may be used in many objects.
                let id = *self.meshes.entry(Arc::as_ptr(triangles)).or_insert(id);
                let here = &self.of_parts(here, Parts::Mesh(triangles.clone()))?;
                self.place_stored(id, || body::mesh(triangles), here, site)
            }
            Solid::Blob(ref written) => {
                let here = &self.of_parts(here, Parts::Blob(written.clone()))?;
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
            Solid::BicubicPatch { points: ref net, .. } => {
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
            // The larger sphere contains the other.
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
            // A torus with a major radius of 0 is a sphere.
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
    /// Returns the next object, and what it inherits.
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
        inherited.cut.is_subtracted |= self.difference && !is_first;
        Some((id, inherited))
    }
}
