//! A scene's triangles in one pose: matrices composed in f64 from mesh to the space that is drawn in,
//! rounded once, and a draw a primitive. Skinned vertices move in the vertex shader; that pipeline exists
//! only where a scene has skins.

use std::collections::HashMap;

use glam::DMat4;

use super::DrawParams;
use super::params::draw_params;
use super::scene::{Batch, MeshScene, Place};
use super::texture::MeshTexture;
use crate::data::matrix::Matrix3x4;
use crate::data::octree::Slot;
use crate::data::texels::Texels;
use crate::gpu::{Gpu, GpuBuffer, GpuError, PassBuilder, RasterKernel};
use crate::scene::{Motion, Pose, Primitive};
use crate::settings::Hidden;

/// What is uploaded of a scene, as a pose has it. Objects whose matrices are not finite are left out.
#[derive(Debug)]
pub struct PosedMesh<'a> {
    pub(super) mesh: &'a MeshScene,
    pub(super) matrices: GpuBuffer,
    /// By object; `None` where it is hidden, or its matrix not finite.
    first: Vec<Option<FirstMatrix>>,
}

/// One primitive of one object: where it lies, and what moves it.
pub(super) struct Shown<'a> {
    /// Of the object.
    pub number: u32,
    pub primitive: &'a Primitive,
    pub place: &'a Place,
    pub batch: &'a Batch,
    /// Where it is skinned.
    pub joints: Option<&'a GpuBuffer>,
    pub first_matrix: u32,
}

/// The same, and its material.
#[derive(Debug)]
pub struct PosedDraw<'a> {
    params: DrawParams,
    batch: &'a Batch,
    joints: Option<&'a GpuBuffer>,
    matrices: &'a GpuBuffer,
    place: &'a Place,
    base_color: &'a MeshTexture,
    metallic_roughness: &'a MeshTexture,
    normal: &'a MeshTexture,
    emissive: &'a MeshTexture,
}

impl<'a> PosedMesh<'a> {
    /// `space_from_world`: where it is drawn. `slot` is overwritten at once: record when the recording
    /// before has run.
    pub fn new(
        gpu: &Gpu,
        mesh: &'a MeshScene,
        slot: &mut Slot,
        (pose, hidden): (&Pose, &Hidden),
        space_from_world: &DMat4,
    ) -> Result<Self, GpuError> {
        let matrices = Matrices::new(mesh, pose, space_from_world, hidden);
        let buffer = slot.ensure(gpu, "mesh matrices", size_of_val(&*matrices.rows) as u64)?;
        gpu.write(&buffer, 0, bytemuck::cast_slice(&matrices.rows))?;
        Ok(Self { mesh, matrices: buffer, first: matrices.first })
    }

    pub fn draws(&self) -> impl Iterator<Item = PosedDraw<'_>> {
        self.shown().filter_map(|shown| self.draw(shown))
    }

    /// Every primitive that is uploaded, of every object that is not hidden.
    pub(super) fn shown(&self) -> impl Iterator<Item = Shown<'_>> {
        let mesh = self.mesh;
        let objects = mesh.objects.iter().zip(&self.first);
        let moved = objects.filter_map(|((number, object), first)| Some((*number, object, (*first)?)));
        moved.flat_map(move |(number, object, first)| {
            let primitives = mesh.scene.meshes[object.mesh].primitives.iter().zip(&mesh.places[object.mesh]);
            primitives.filter_map(move |(primitive, place)| {
                let place = place.as_ref()?;
                let batch = mesh.batches.get(place.batch)?;
                // A skinned object's primitive without joints follows its node, as in voxelization.
                let is_skinned = matches!(object.motion, Motion::Skinned { .. }) && !primitive.joints.is_empty();
                let joints = batch.joints.as_ref().filter(|_| is_skinned);
                let first_matrix = if joints.is_some() { first.joints } else { first.node };
                Some(Shown { number, primitive, place, batch, joints, first_matrix })
            })
        })
    }

    fn draw<'b>(&'b self, shown: Shown<'b>) -> Option<PosedDraw<'b>> {
        let mesh = self.mesh;
        let Shown { number, primitive, place, batch, joints, first_matrix } = shown;
        let material = mesh.scene.material_of(primitive);
        // Without an image white stands in: all it says is multiplied, and the normal map asks first.
        let white = mesh.white.as_ref()?;
        let texture = |slot, texels| mesh.texture(slot, texels).unwrap_or(white);
        Some(PosedDraw {
            params: draw_params(mesh, (primitive, place), material, (number, first_matrix)),
            batch,
            joints,
            matrices: &self.matrices,
            place,
            base_color: texture(material.base_color_texture, Texels::of_base_color(material)),
            metallic_roughness: texture(material.metallic_roughness_texture, Texels::Linear),
            normal: texture(material.normal_texture, Texels::Linear),
            emissive: texture(material.emissive_texture, Texels::Opaque),
        })
    }
}

impl PosedDraw<'_> {
    /// The vertex entry point that moves it.
    pub fn entry(&self) -> &'static str {
        if self.joints.is_some() { "skinned" } else { "rigid" }
    }

    pub fn vertices(&self) -> u32 {
        self.place.index_count
    }

    /// All that shared/posed_mesh.wgsl declares, and the base colour.
    pub fn bind<'r>(&self, pass: PassBuilder<'r, RasterKernel>) -> PassBuilder<'r, RasterKernel> {
        let pass = match self.joints {
            Some(joints) => pass.bind("vertex_joints", joints),
            None => pass,
        };
        pass.uniform("draw", &self.params)
            .bind("indices", &self.batch.indices)
            .bind("vertices", &self.batch.vertices)
            .bind("matrices", self.matrices)
            .texture("base_color", &self.base_color.view)
            .sampler("base_color_sampler", &self.base_color.sampler)
    }

    /// The same and the other textures of the material.
    pub fn bind_all<'r>(&self, pass: PassBuilder<'r, RasterKernel>) -> PassBuilder<'r, RasterKernel> {
        self.bind(pass)
            .texture("metallic_roughness", &self.metallic_roughness.view)
            .sampler("metallic_roughness_sampler", &self.metallic_roughness.sampler)
            .texture("normal_map", &self.normal.view)
            .sampler("normal_sampler", &self.normal.sampler)
            .texture("emissive", &self.emissive.view)
            .sampler("emissive_sampler", &self.emissive.sampler)
    }
}

/// Where an object's matrices begin: its node's, and its skin's if it has one.
#[derive(Clone, Copy, Debug)]
struct FirstMatrix {
    node: u32,
    joints: u32,
}

struct Matrices {
    rows: Vec<Matrix3x4>,
    /// By object; `None` where it is hidden, or its matrix not finite.
    first: Vec<Option<FirstMatrix>>,
}

impl Matrices {
    fn new(mesh: &MeshScene, pose: &Pose, space_from_world: &DMat4, hidden: &Hidden) -> Self {
        let mut matrices = Self { rows: Vec::new(), first: Vec::new() };
        let mut skins: HashMap<usize, u32> = HashMap::new();
        for (number, object) in &mesh.objects {
            if hidden.contains(*number as usize) {
                matrices.first.push(None);
                continue;
            }
            let node = matrices.rows.len() as u32;
            let space_from_node = rows(&(*space_from_world * pose.world_from_node[object.node]));
            matrices.rows.push(space_from_node);
            let mut first = FirstMatrix { node, joints: node };
            if let Motion::Skinned { skin } = object.motion {
                first.joints = *skins.entry(skin).or_insert_with(|| {
                    let joints = mesh.scene.joint_matrices(skin, pose);
                    let start = matrices.rows.len() as u32;
                    matrices.rows.extend(joints.iter().map(|joint| rows(&(*space_from_world * *joint))));
                    start
                });
            }
            // Which joints of a skin matter is known per vertex only; a rigid matrix always does.
            let is_rigid = !matches!(object.motion, Motion::Skinned { .. });
            let is_finite = space_from_node.rows.as_flattened().iter().all(|entry| entry.is_finite());
            matrices.first.push((!is_rigid || is_finite).then_some(first));
        }
        matrices
    }
}

fn rows(matrix: &DMat4) -> Matrix3x4 {
    Matrix3x4 { rows: [0, 1, 2].map(|row| matrix.row(row).as_vec4().to_array()) }
}
