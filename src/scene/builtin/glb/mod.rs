//! Writes a `.glb` file (glTF 2.0, binary): meshes, materials, pictures, nodes, skin, clips.
//!
//! [`GlbWriter`] grows the JSON document (`gltf::json`) and the binary chunk side by side; what
//! it hands out are the document's own indices. Numbers are rounded to whole steps as they are
//! written (see [`exact`](super::exact)). Buffers and meshes are here, nodes, materials and clips
//! in the modules below.

mod clip;
mod material;
mod node;

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};
use gltf::binary::{Glb, Header};
use gltf::json::accessor::{Accessor, ComponentType, GenericComponentType, Type};
use gltf::json::mesh::{Mode, MorphTarget, Primitive, Semantic};
use gltf::json::validation::{Checked::Valid, USize64};
use gltf::json::{Index, Material, Mesh, Node, Root, Scene, Value, buffer};

use super::MakeError;
use super::exact::{ROTATION_STEPS, STEPS, rounded};
use super::shapes::Surface;
pub use clip::{ClipWriter, Track};
pub use material::Paint;

/// Up to four joints of a vertex; the weights are shares of 255 and sum to it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Influence {
    pub joints: [u8; 4],
    pub weights: [u8; 4],
}

/// One primitive of a mesh.
#[derive(Clone, Debug)]
pub struct GlbPart {
    pub surface: Surface,
    pub material: Index<Material>,
    /// One a vertex; empty without a skin.
    pub influences: Vec<Influence>,
    /// What each morph target displaces positions by, one a vertex.
    pub targets: Vec<Vec<DVec3>>,
}

impl GlbPart {
    pub fn new(surface: Surface, material: Index<Material>) -> Self {
        Self { surface, material, influences: Vec::new(), targets: Vec::new() }
    }

    /// What lies to the left (+X) and what lies to the right, by the middle of each triangle; either may be empty.
    /// Without morph targets.
    pub fn halves(&self) -> [Self; 2] {
        let surface = &self.surface;
        let is_left =
            |triangle: &[u32; 3]| triangle.iter().map(|&at| surface.positions[at as usize].x).sum::<f64>() >= 0.0;
        [true, false].map(|left| {
            let mut half = Self::new(Surface::default(), self.material);
            let mut known: BTreeMap<u32, u32> = BTreeMap::new();
            for triangle in surface.triangles.iter().filter(|triangle| is_left(triangle) == left) {
                let corners = triangle.map(|at| *known.entry(at).or_insert_with(|| half.take(self, at as usize)));
                half.surface.triangles.push(corners);
            }
            half
        })
    }

    /// Appends a vertex of another; its number.
    fn take(&mut self, other: &Self, at: usize) -> u32 {
        self.surface.positions.push(other.surface.positions[at]);
        self.surface.normals.push(other.surface.normals[at]);
        self.surface.uvs.push(other.surface.uvs[at]);
        self.influences.extend(other.influences.get(at));
        (self.surface.positions.len() - 1) as u32
    }
}

/// A file in the making.
#[derive(Default)]
pub struct GlbWriter {
    root: Root,
    bin: Vec<u8>,
    top_nodes: Vec<Index<Node>>,
}

impl GlbWriter {
    /// Appends bytes to the binary chunk, aligned to 4.
    fn view(&mut self, bytes: &[u8], target: Option<buffer::Target>) -> Index<buffer::View> {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let offset = self.bin.len();
        self.bin.extend_from_slice(bytes);
        self.root.push(buffer::View {
            buffer: Index::new(0),
            byte_length: USize64::from(bytes.len()),
            byte_offset: Some(USize64::from(offset)),
            byte_stride: None,
            name: None,
            target: target.map(Valid),
            extensions: None,
            extras: None,
        })
    }

    fn accessor(
        &mut self,
        view: Index<buffer::View>,
        count: usize,
        component: ComponentType,
        type_: Type,
    ) -> Index<Accessor> {
        self.root.push(Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: USize64::from(count),
            component_type: Valid(GenericComponentType(component)),
            type_: Valid(type_),
            min: None,
            max: None,
            name: None,
            normalized: false,
            sparse: None,
            extensions: None,
            extras: None,
        })
    }

    /// Floats in rows of N, with the least and the greatest of each column where a reader needs them.
    fn floats<const N: usize>(
        &mut self,
        rows: &[[f32; N]],
        target: Option<buffer::Target>,
        bounds: bool,
    ) -> Index<Accessor> {
        let type_ = match N {
            1 => Type::Scalar,
            2 => Type::Vec2,
            3 => Type::Vec3,
            4 => Type::Vec4,
            _ => Type::Mat4,
        };
        let view = self.view(bytemuck::cast_slice(rows.as_flattened()), target);
        let index = self.accessor(view, rows.len(), ComponentType::F32, type_);
        if bounds {
            let column = |pick: fn(f32, f32) -> f32| {
                let all = |at: usize| rows.iter().map(|row| row[at]).reduce(pick).unwrap_or_default();
                Some(Value::from((0..N).map(all).collect::<Vec<f32>>()))
            };
            let accessor = &mut self.root.accessors[index.value()];
            (accessor.min, accessor.max) = (column(f32::min), column(f32::max));
        }
        index
    }

    pub fn mesh(&mut self, name: &str, parts: &[GlbPart]) -> Index<Mesh> {
        let primitives = parts.iter().map(|part| self.primitive(part)).collect();
        self.root.push(Mesh { name: Some(name.into()), primitives, weights: None, extensions: None, extras: None })
    }

    fn primitive(&mut self, part: &GlbPart) -> Primitive {
        let vertices = Some(buffer::Target::ArrayBuffer);
        let surface = &part.surface;
        let rows3 = |rows: &[DVec3]| -> Vec<[f32; 3]> { rows.iter().map(|row| float3(*row)).collect() };
        let uvs: Vec<[f32; 2]> =
            surface.uvs.iter().map(|uv| uv.to_array().map(|value| rounded(value, STEPS))).collect();
        let mut attributes = BTreeMap::from([
            (Valid(Semantic::Positions), self.floats(&rows3(&surface.positions), vertices, true)),
            (Valid(Semantic::Normals), self.floats(&rows3(&surface.normals), vertices, false)),
            (Valid(Semantic::TexCoords(0)), self.floats(&uvs, vertices, false)),
        ]);
        if !part.influences.is_empty() {
            let count = part.influences.len();
            let joints: Vec<u8> = part.influences.iter().flat_map(|influence| influence.joints).collect();
            let weights: Vec<u8> = part.influences.iter().flat_map(|influence| influence.weights).collect();
            let view = self.view(&joints, vertices);
            let joints = self.accessor(view, count, ComponentType::U8, Type::Vec4);
            let view = self.view(&weights, vertices);
            let weights = self.accessor(view, count, ComponentType::U8, Type::Vec4);
            self.root.accessors[weights.value()].normalized = true;
            attributes.extend([(Valid(Semantic::Joints(0)), joints), (Valid(Semantic::Weights(0)), weights)]);
        }
        let targets: Vec<MorphTarget> = part.targets.iter().map(|moved| self.target(&rows3(moved))).collect();
        Primitive {
            attributes,
            indices: Some(self.indices(&surface.triangles)),
            material: Some(part.material),
            mode: Valid(Mode::Triangles),
            targets: (!targets.is_empty()).then_some(targets),
            extensions: None,
            extras: None,
        }
    }

    fn target(&mut self, displacements: &[[f32; 3]]) -> MorphTarget {
        let positions = self.floats(displacements, Some(buffer::Target::ArrayBuffer), true);
        MorphTarget { positions: Some(positions), normals: None, tangents: None }
    }

    /// 16 bits where they suffice.
    fn indices(&mut self, triangles: &[[u32; 3]]) -> Index<Accessor> {
        let flat = triangles.as_flattened();
        let narrow: Result<Vec<u16>, _> = flat.iter().map(|&index| u16::try_from(index)).collect();
        let target = Some(buffer::Target::ElementArrayBuffer);
        match narrow {
            Ok(narrow) => {
                let view = self.view(bytemuck::cast_slice(&narrow), target);
                self.accessor(view, flat.len(), ComponentType::U16, Type::Scalar)
            }
            Err(_) => {
                let view = self.view(bytemuck::cast_slice(flat), target);
                self.accessor(view, flat.len(), ComponentType::U32, Type::Scalar)
            }
        }
    }

    fn use_extension(&mut self, name: &str) {
        if !self.root.extensions_used.iter().any(|used| used == name) {
            self.root.extensions_used.push(name.into());
        }
    }

    /// The file's bytes.
    pub fn finish(mut self, name: &str) -> Result<Vec<u8>, MakeError> {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        self.root.asset.generator = Some("Octolume".into());
        let byte_length = USize64::from(self.bin.len());
        self.root.push(buffer::Buffer { byte_length, name: None, uri: None, extensions: None, extras: None });
        let nodes = std::mem::take(&mut self.top_nodes);
        let scene = self.root.push(Scene { name: Some(name.into()), nodes, extensions: None, extras: None });
        self.root.scene = Some(scene);
        let json = self.root.to_vec()?;
        // The header's length is computed by `to_vec`.
        let header = Header { magic: *b"glTF", version: 2, length: 0 };
        let glb = Glb { header, json: json.into(), bin: Some(self.bin.into()) };
        Ok(glb.to_vec()?)
    }
}

pub(super) fn float3(value: DVec3) -> [f32; 3] {
    value.to_array().map(|component| rounded(component, STEPS))
}

pub(super) fn float4(rotation: DQuat) -> [f32; 4] {
    rotation.to_array().map(|component| rounded(component, ROTATION_STEPS))
}
