//! glTF 2.0: the meshes of a scene's nodes, transformed to their places; the only file that uses `gltf`.
//!
//! Base colours and vertex colours are used; textures, morph targets, skins and animations are not. The crate
//! parses the document. References are resolved here, because the crate's own checks and iterators panic on
//! invalid indices.
//!
//! **Source:** Khronos Group, "glTF 2.0 Specification".

use gltf::json::accessor::{Accessor, ComponentType, Type};
use gltf::json::material::AlphaMode;
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;
use gltf::json::{Index, Material, Node, Root};

use super::build::{Builder, Corner};
use super::json::Step::{Entry, Key};
use super::json::Text;
use super::{Beside, Fault, Place, data_uri, glb};
use crate::math::{Matrix, Vector};

/// Extensions that a file may require without affecting the result.
const UNDERSTOOD: [&str; 3] =
    ["KHR_mesh_quantization", "KHR_texture_transform", "KHR_lights_punctual"];

pub(super) fn read(bytes: &[u8], builder: &mut Builder, beside: &mut Beside) -> Result<(), Fault> {
    let (text, held) = match bytes.strip_prefix(b"glTF") {
        None => (Text { bytes, start: None }, None),
        Some(_) => {
            let (bytes, held) = glb::parts(bytes)?;
            (Text { bytes, start: Some(glb::HEAD) }, held)
        }
    };
    let root: Root = gltf::json::deserialize::from_slice(text.bytes).map_err(|error| {
        let place = match text.start {
            None => Place::Line(error.line().max(1)),
            Some(_) => text.place(offset(text.bytes, error.line(), error.column())),
        };
        let told = error.to_string();
        let told = told.rsplit_once(" at line ").map_or(told.as_str(), |(told, _)| told);
        let is_json = if error.is_data() { "" } else { "it is no whole JSON: " };
        Fault::new(format!("{is_json}{told}")).at(place)
    })?;
    if !root.asset.version.starts_with("2.") {
        let version = &root.asset.version;
        let fault = Fault::new(format!("it is glTF {version}, and 2.0 is read"));
        return Err(text.fault_at(fault, &[Key("asset"), Key("version")]));
    }
    let asks = |name: &&String| {
        !UNDERSTOOD.contains(&name.as_str()) && !name.starts_with("KHR_materials_")
    };
    if let Some(number) = root.extensions_required.iter().position(|name| asks(&name)) {
        let name = &root.extensions_required[number];
        let fault = Fault::new(format!("it requires `{name}`, which is not read"));
        return Err(text.fault_at(fault, &[Key("extensionsRequired"), Entry(number)]));
    }
    let buffers = buffers(&root, held, beside, text)?;
    let mut document = Document { root: &root, text, buffers, builder };
    document.nodes()
}

/// Byte offset of a line and a column of a text, both counted from 1.
fn offset(text: &[u8], line: usize, column: usize) -> usize {
    let lines = text.split_inclusive(|byte| *byte == b'\n').take(line.saturating_sub(1));
    (lines.map(<[u8]>::len).sum::<usize>() + column.saturating_sub(1)).min(text.len())
}

fn buffers(
    root: &Root,
    mut held: Option<Vec<u8>>,
    beside: &mut Beside,
    text: Text,
) -> Result<Vec<Vec<u8>>, Fault> {
    let fault = |number, why: &str| {
        let fault = Fault::new(format!("buffer {number}{why}"));
        text.fault_at(fault, &[Key("buffers"), Entry(number)])
    };
    let buffers = root.buffers.iter().enumerate().map(|(number, buffer)| match &buffer.uri {
        None => held.take().ok_or_else(|| fault(number, " is nowhere")),
        Some(uri) => match data_uri::held(uri) {
            Some(held) => held.map_err(|why| fault(number, &format!(": {why}"))),
            None => {
                let name = data_uri::name(uri);
                beside(&name).map_err(|why| Fault::new(why).in_file(&name))
            }
        },
    });
    buffers.collect()
}

struct Document<'d, 'b> {
    root: &'d Root,
    text: Text<'d>,
    buffers: Vec<Vec<u8>>,
    builder: &'b mut Builder,
}

/// The transformation from a node's space to the file's.
#[derive(Clone, Copy)]
struct Map {
    matrix: Matrix,
    offset: Vector,
}

impl Map {
    const IDENTITY: Self = Self { matrix: Matrix::IDENTITY, offset: Vector::ZERO };

    fn of(node: &Node) -> Self {
        let vector = |[x, y, z]: [f32; 3]| Vector::new(x.into(), y.into(), z.into());
        if let Some(m) = node.matrix {
            let column = |i: usize| vector([m[4 * i], m[4 * i + 1], m[4 * i + 2]]);
            let matrix = Matrix::from_cols(column(0), column(1), column(2));
            return Self { matrix, offset: column(3) };
        }
        let [x, y, z, w] = node.rotation.unwrap_or_default().0.map(f64::from);
        // Of any length but 0.
        let by = 2.0 / (x * x + y * y + z * z + w * w);
        let by = if by.is_finite() { by } else { 0.0 };
        let turned = [
            Vector::new(1.0 - by * (y * y + z * z), by * (x * y + z * w), by * (x * z - y * w)),
            Vector::new(by * (x * y - z * w), 1.0 - by * (x * x + z * z), by * (y * z + x * w)),
            Vector::new(by * (x * z + y * w), by * (y * z - x * w), 1.0 - by * (x * x + y * y)),
        ];
        let scale = node.scale.map_or(Vector::ONE, vector);
        let [a, b, c] = turned;
        let matrix = Matrix::from_cols(a * scale.x, b * scale.y, c * scale.z);
        Self { matrix, offset: node.translation.map_or(Vector::ZERO, vector) }
    }

    fn after(self, inner: Self) -> Self {
        let offset = self.matrix * inner.offset + self.offset;
        Self { matrix: self.matrix * inner.matrix, offset }
    }

    /// Returns the matrix for normals: the inverse transpose, times the determinant.
    fn of_normals(&self) -> Matrix {
        let Matrix { x_axis: a, y_axis: b, z_axis: c } = self.matrix;
        Matrix::from_cols(b.cross(c), c.cross(a), a.cross(b))
    }
}

impl Document<'_, '_> {
    /// Visits every node of the scene once.
    fn nodes(&mut self) -> Result<(), Fault> {
        let root = self.root;
        let nothing = |what: &str| Fault::new(format!("{what} is not there"));
        let text = self.text;
        let (scene, of_scene) = match root.scene {
            Some(scene) => {
                let fault = || text.fault_at(nothing("its scene"), &[Key("scene")]);
                (Some(root.get(scene).ok_or_else(fault)?), scene.value())
            }
            None => (root.scenes.first(), 0),
        };
        let in_node = |fault, number| text.fault_at(fault, &[Key("nodes"), Entry(number)]);
        let mut is_child = vec![false; root.nodes.len()];
        for (number, node) in root.nodes.iter().enumerate() {
            for child in node.children.iter().flatten() {
                let slot = is_child.get_mut(child.value());
                *slot.ok_or_else(|| in_node(nothing("the child of a node"), number))? = true;
            }
        }
        let mut waiting: Vec<(usize, Map)> = match scene {
            Some(scene) => scene.nodes.iter().map(|node| (node.value(), Map::IDENTITY)).collect(),
            None => (0..root.nodes.len())
                .filter(|i| !is_child[*i])
                .map(|i| (i, Map::IDENTITY))
                .collect(),
        };
        // In written order.
        waiting.reverse();
        let mut seen = vec![false; root.nodes.len()];
        while let Some((number, above)) = waiting.pop() {
            let node = root.nodes.get(number).ok_or_else(|| {
                let path = [Key("scenes"), Entry(of_scene)];
                text.fault_at(nothing("a node of its scene"), &path)
            })?;
            if std::mem::replace(&mut seen[number], true) {
                let fault = Fault::new(format!("node {number} has two parents"));
                return Err(in_node(fault, number));
            }
            let map = above.after(Map::of(node));
            if let Some(mesh) = node.mesh {
                let of_mesh = mesh.value();
                let mesh = root.get(mesh);
                let mesh = mesh.ok_or_else(|| in_node(nothing("the mesh of a node"), number))?;
                for (i, primitive) in mesh.primitives.iter().enumerate() {
                    self.primitive(primitive, &map).map_err(|fault| {
                        let reason = format!("node {number}: {}", fault.reason);
                        let path = [Key("meshes"), Entry(of_mesh), Key("primitives"), Entry(i)];
                        text.fault_at(Fault { reason, ..fault }, &path)
                    })?;
                }
            }
            let children = node.children.iter().flatten().rev();
            waiting.extend(children.map(|child| (child.value(), map)));
        }
        Ok(())
    }

    fn primitive(&mut self, primitive: &Primitive, map: &Map) -> Result<(), Fault> {
        let mode = match primitive.mode {
            Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) => {
                mode
            }
            _ => return Ok(()),
        };
        let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
        let Some(positions) = attribute(Semantic::Positions) else { return Ok(()) };
        let positions = self.numbers(positions, &[3])?.1;
        let count = positions.len() / 3;
        let list = |semantic, widths: &[usize]| match attribute(semantic) {
            None => Ok(None),
            Some(index) => {
                let (width, numbers) = self.numbers(index, widths)?;
                let fits = numbers.len() / width == count;
                fits.then_some(Some((width, numbers))).ok_or_else(|| {
                    Fault::new(
                        "its vertices have more or fewer normals, colours or places than they are",
                    )
                })
            }
        };
        let normals = list(Semantic::Normals, &[3])?;
        let colors = list(Semantic::Colors(0), &[3, 4])?;
        let uvs = list(Semantic::TexCoords(0), &[2])?;
        let indices = match primitive.indices {
            Some(index) => Some(self.numbers(index, &[1])?.1),
            None => None,
        };
        let base = self.base_color(primitive.material)?;
        let plain = match &colors {
            None => base.map(|(rgb, alpha, _)| self.builder.color(rgb, alpha)).transpose()?,
            Some(_) => None,
        };
        let of_normals = map.of_normals();
        let mut corners = Vec::with_capacity(count);
        for (i, place) in positions.as_chunks::<3>().0.iter().enumerate() {
            let place = map.matrix * Vector::from_array(*place) + map.offset;
            let vertex = self.builder.vertex(place.to_array())?;
            let normal = entry(&normals, i).map(|n| of_normals * Vector::new(n[0], n[1], n[2]));
            let normal = normal.map(|n| self.builder.normal(n.to_array())).transpose()?;
            let uv = entry(&uvs, i).map(|uv| self.builder.uv([uv[0], uv[1]])).transpose()?;
            let own = entry(&colors, i).map(|own| {
                let (rgb, alpha, blends) = base.unwrap_or(([1.0; 3], 1.0, false));
                let rgb = [0, 1, 2].map(|i| rgb[i] * own[i]);
                let own = own.get(3).filter(|_| blends).copied().unwrap_or(1.0);
                self.builder.color(rgb, alpha * own)
            });
            corners.push(Corner { vertex, normal, color: own.transpose()?.or(plain), uv });
        }
        let order: Vec<usize> = match indices {
            None => (0..count).collect(),
            Some(indices) => indices.into_iter().map(|index| index as usize).collect(),
        };
        if let Some(stray) = order.iter().find(|i| **i >= count) {
            return Err(Fault::new(format!(
                "index {stray} is of nothing: there are {count} vertices"
            )));
        }
        self.builder.check_size(64 * order.len() as u64)?;
        // A mirrored mesh keeps its outside.
        let is_mirrored = map.matrix.determinant() < 0.0;
        for_each_triangle(mode, &order, |[a, b, c]| {
            let [a, b, c] = [corners[a], corners[b], corners[c]];
            self.builder.triangle(if is_mirrored { [a, c, b] } else { [a, b, c] });
        });
        Ok(())
    }

    /// Returns the base colour of a material, its opacity, and whether the opacity blends.
    fn base_color(
        &mut self,
        material: Option<Index<Material>>,
    ) -> Result<Option<([f64; 3], f64, bool)>, Fault> {
        let Some(material) = material else { return Ok(None) };
        let Some(material) = self.root.get(material) else {
            return Err(Fault::new("its material is not there"));
        };
        let rough = &material.pbr_metallic_roughness;
        if rough.base_color_texture.is_some() {
            let pictures = "pictures on its surface are not read yet (`baseColorTexture`)";
            self.builder.lacks(pictures.to_owned());
        }
        let [red, green, blue, alpha] = rough.base_color_factor.0.map(f64::from);
        let alpha = match material.alpha_mode {
            Checked::Valid(AlphaMode::Blend) => alpha,
            Checked::Valid(AlphaMode::Mask) => {
                let least = material.alpha_cutoff.map_or(0.5, |cutoff| f64::from(cutoff.0));
                f64::from(u8::from(alpha >= least))
            }
            Checked::Valid(AlphaMode::Opaque) | Checked::Invalid => 1.0,
        };
        let blends = material.alpha_mode == Checked::Valid(AlphaMode::Blend);
        Ok(Some(([red, green, blue], alpha, blends)))
    }

    /// Returns all numbers of an accessor, whose width must be one of these, and its width.
    fn numbers(
        &self,
        index: Index<Accessor>,
        widths: &[usize],
    ) -> Result<(usize, Vec<f64>), Fault> {
        let fault = |what: &str| {
            let fault = Fault::new(format!("accessor {}: {what}", index.value()));
            self.text.fault_at(fault, &[Key("accessors"), Entry(index.value())])
        };
        let accessor = self.root.get(index).ok_or_else(|| fault("it is not there"))?;
        let Checked::Valid(component) = accessor.component_type else {
            return Err(fault("its numbers are of no known type"));
        };
        let width = match accessor.type_ {
            Checked::Valid(Type::Scalar) => 1,
            Checked::Valid(Type::Vec2) => 2,
            Checked::Valid(Type::Vec3) => 3,
            Checked::Valid(Type::Vec4) => 4,
            _ => 0,
        };
        if !widths.contains(&width) {
            return Err(fault("it holds vectors of another length than it is used for"));
        }
        if accessor.sparse.is_some() {
            return Err(fault("sparse accessors are not read"));
        }
        let run = accessor.buffer_view.and_then(|view| {
            let view = self.root.get(view)?;
            let bytes = self.buffers.get(view.buffer.value())?;
            let start = usize::try_from(view.byte_offset.unwrap_or_default().0).ok()?;
            let length = usize::try_from(view.byte_length.0).ok()?;
            let bytes = bytes.get(start..start.checked_add(length)?)?;
            Some((
                bytes.get(usize::try_from(accessor.byte_offset.unwrap_or_default().0).ok()?..)?,
                view,
            ))
        });
        let (bytes, view) = run.ok_or_else(|| fault("its bytes are not there"))?;
        let each = size(component.0);
        let stride = view.byte_stride.map_or(0, |stride| stride.0).max(each * width);
        let count = usize::try_from(accessor.count.0).unwrap_or(usize::MAX);
        // The last need not be filled up to the stride.
        let needed = count
            .checked_sub(1)
            .map_or(Some(0), |n| n.checked_mul(stride)?.checked_add(each * width));
        if needed.is_none_or(|needed| needed > bytes.len()) {
            return Err(fault(&format!("its {count} vectors are longer than its bytes")));
        }
        let mut numbers = Vec::with_capacity(count * width);
        for at in (0..count).map(|i| i * stride) {
            for at in (0..width).map(|i| at + i * each) {
                numbers.push(number(component.0, &bytes[at..at + each], accessor.normalized));
            }
        }
        Ok((width, numbers))
    }
}

/// The `i`th vector of an accessor's list.
fn entry(list: &Option<(usize, Vec<f64>)>, i: usize) -> Option<&[f64]> {
    let (width, numbers) = list.as_ref()?;
    numbers.get(i * width..(i + 1) * width)
}

fn size(component: ComponentType) -> usize {
    match component {
        ComponentType::I8 | ComponentType::U8 => 1,
        ComponentType::I16 | ComponentType::U16 => 2,
        ComponentType::U32 | ComponentType::F32 => 4,
    }
}

/// A number of [`size`] bytes; a normalized one is 1 at its maximum.
fn number(component: ComponentType, bytes: &[u8], normalized: bool) -> f64 {
    let four = || <[u8; 4]>::try_from(bytes).unwrap_or_default();
    let two = || <[u8; 2]>::try_from(bytes).unwrap_or_default();
    let one = bytes.first().copied().unwrap_or_default();
    let (number, most) = match component {
        ComponentType::I8 => (f64::from(one as i8), 127.0),
        ComponentType::U8 => (f64::from(one), 255.0),
        ComponentType::I16 => (f64::from(i16::from_le_bytes(two())), f64::from(i16::MAX)),
        ComponentType::U16 => (f64::from(u16::from_le_bytes(two())), f64::from(u16::MAX)),
        ComponentType::U32 => (f64::from(u32::from_le_bytes(four())), 1.0),
        ComponentType::F32 => (f64::from(f32::from_le_bytes(four())), 1.0),
    };
    if normalized { (number / most).max(-1.0) } else { number }
}

fn for_each_triangle(mode: Mode, order: &[usize], mut found: impl FnMut([usize; 3])) {
    match mode {
        Mode::TriangleStrip => {
            for (i, three) in order.windows(3).enumerate() {
                let [a, b, c] = [three[0], three[1], three[2]];
                found(if i % 2 == 0 { [a, b, c] } else { [b, a, c] });
            }
        }
        Mode::TriangleFan => {
            let [first, rest @ ..] = order else { return };
            rest.windows(2).for_each(|two| found([*first, two[0], two[1]]));
        }
        _ => order.as_chunks::<3>().0.iter().for_each(|three| found(*three)),
    }
}
