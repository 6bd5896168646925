//! A scene's triangles and base colour textures on the GPU: uploaded once, a little at a time, and
//! only what the shown objects use.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::{Vec2, Vec3, Vec4};

use super::texture::{MeshTexture, TextureUploader};
use super::{MeshVertex, VertexJoints};
use crate::data::packing::{pack_normal, pack_rgba8};
use crate::gpu::{Gpu, GpuBuffer, GpuError};
use crate::scene::{Material, Motion, Object, Primitive, Scene, TextureRef};
use crate::settings::Hidden;

/// Vertices of a batch, unless one primitive has more: 16 MiB, uploaded in one go.
const BATCH_VERTICES: usize = 1 << 19;

/// What draws of some primitives read.
#[derive(Debug)]
pub(super) struct Batch {
    pub vertices: GpuBuffer,
    pub indices: GpuBuffer,
    /// Where the primitives are skinned.
    pub joints: Option<GpuBuffer>,
}

/// A primitive in its batch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub batch: usize,
    pub first_vertex: u32,
    pub first_index: u32,
    pub index_count: u32,
}

/// A scene that is uploaded step by step, then drawn as a [`super::PosedMesh`].
#[derive(Debug)]
pub struct MeshScene {
    pub(super) scene: Arc<Scene>,
    /// With the number that colours them.
    pub(super) objects: Vec<(u32, Object)>,
    pub(super) batches: Vec<Batch>,
    /// By mesh and primitive; `None` where nothing is drawn.
    pub(super) places: Vec<Vec<Option<Place>>>,
    /// By texture; `None` where no base colour reads it.
    pub(super) textures: Vec<Option<MeshTexture>>,
    pub(super) white: Option<MeshTexture>,
    /// What `waiting` was listed for; `None` before the first upload.
    hidden: Option<Hidden>,
    waiting: Vec<Waiting>,
    uploader: Option<TextureUploader>,
}

/// What is still to be uploaded, last first.
#[derive(Debug)]
enum Waiting {
    White,
    Texture(usize),
    /// Mesh and primitive of each; all skinned or none.
    Batch {
        primitives: Vec<(usize, usize)>,
        skinned: bool,
    },
}

impl MeshScene {
    /// Nothing is uploaded yet.
    pub fn new(scene: Arc<Scene>, objects: Vec<(u32, Object)>) -> Self {
        Self {
            places: scene.meshes.iter().map(|mesh| vec![None; mesh.primitives.len()]).collect(),
            textures: scene.textures.iter().map(|_| None).collect(),
            scene,
            objects,
            batches: Vec::new(),
            white: None,
            hidden: None,
            waiting: Vec::new(),
            uploader: None,
        }
    }

    /// Uploads what objects that are not hidden need, for about `budget`; true once all of it is there.
    pub fn upload(&mut self, gpu: &Gpu, hidden: &Hidden, budget: Duration) -> Result<bool, GpuError> {
        if self.hidden.as_ref() != Some(hidden) {
            self.waiting = self.missing(hidden);
            self.hidden = Some(hidden.clone());
        }
        let start = Instant::now();
        while let Some(next) = self.waiting.pop() {
            self.upload_one(gpu, next)?;
            if start.elapsed() >= budget {
                break;
            }
        }
        Ok(self.waiting.is_empty())
    }

    /// What is shown and not uploaded. A mesh that skinned and rigid objects share counts as skinned.
    fn missing(&self, hidden: &Hidden) -> Vec<Waiting> {
        let is_skinned = |object: &Object| matches!(object.motion, Motion::Skinned { .. });
        let skinned_at_all: BTreeSet<usize> =
            self.objects.iter().filter(|(_, object)| is_skinned(object)).map(|(_, object)| object.mesh).collect();
        let shown = self.objects.iter().filter(|(number, _)| !hidden.contains(*number as usize));
        let meshes: BTreeSet<usize> = shown.map(|(_, object)| object.mesh).collect();
        let (skinned, rigid): (Vec<usize>, Vec<usize>) = meshes.iter().partition(|mesh| skinned_at_all.contains(*mesh));
        let mut waiting = Vec::new();
        if self.white.is_none() {
            waiting.push(Waiting::White);
        }
        let textures = base_color_textures(&self.scene, meshes.iter());
        waiting.extend(textures.into_iter().filter(|&t| self.textures[t].is_none()).map(Waiting::Texture));
        let is_missing = |&(mesh, primitive): &(usize, usize)| self.places[mesh][primitive].is_none();
        waiting.extend(batches(&self.scene, skinned, true, is_missing));
        waiting.extend(batches(&self.scene, rigid, false, is_missing));
        waiting
    }

    fn upload_one(&mut self, gpu: &Gpu, next: Waiting) -> Result<(), GpuError> {
        let uploader = self.uploader.get_or_insert_with(|| TextureUploader::new(gpu));
        match next {
            Waiting::White => self.white = Some(uploader.white(gpu)?),
            Waiting::Texture(index) => self.textures[index] = Some(uploader.upload(gpu, &self.scene.textures[index])?),
            Waiting::Batch { primitives, skinned } => self.upload_batch(gpu, &primitives, skinned)?,
        }
        Ok(())
    }

    fn upload_batch(&mut self, gpu: &Gpu, primitives: &[(usize, usize)], skinned: bool) -> Result<(), GpuError> {
        let (mut vertices, mut indices, mut joints) = (Vec::new(), Vec::<u32>::new(), Vec::new());
        for &(mesh, number) in primitives {
            let primitive = &self.scene.meshes[mesh].primitives[number];
            self.places[mesh][number] = Some(Place {
                batch: self.batches.len(),
                first_vertex: vertices.len() as u32,
                first_index: indices.len() as u32,
                index_count: 3 * primitive.triangles.len() as u32,
            });
            let slot = material(&self.scene, primitive).and_then(|m| m.base_color_texture);
            vertices.extend((0..primitive.positions.len()).map(|vertex| mesh_vertex(primitive, vertex, slot)));
            indices.extend(primitive.triangles.iter().flatten());
            if skinned {
                joints.extend((0..primitive.positions.len()).map(|vertex| vertex_joints(primitive, vertex)));
            }
        }
        self.batches.push(Batch {
            vertices: gpu.upload("mesh vertices", &vertices)?,
            indices: gpu.upload("mesh indices", &indices)?,
            joints: skinned.then(|| gpu.upload("mesh joints", &joints)).transpose()?,
        });
        Ok(())
    }
}

/// `None`: glTF's default material.
pub(super) fn material<'a>(scene: &'a Scene, primitive: &Primitive) -> Option<&'a Material> {
    primitive.material.and_then(|index| scene.materials.get(index))
}

fn base_color_textures<'a>(scene: &Scene, meshes: impl Iterator<Item = &'a usize>) -> BTreeSet<usize> {
    let primitives = meshes.flat_map(|&mesh| &scene.meshes[mesh].primitives);
    let slots = primitives.filter_map(|primitive| material(scene, primitive)?.base_color_texture);
    let has_texels =
        |index: &usize| scene.textures.get(*index).is_some_and(|t| t.image.width() > 0 && t.image.height() > 0);
    slots.map(|slot| slot.texture).filter(has_texels).collect()
}

fn batches(
    scene: &Scene,
    meshes: Vec<usize>,
    skinned: bool,
    is_missing: impl Fn(&(usize, usize)) -> bool,
) -> impl Iterator<Item = Waiting> {
    let mut batches: Vec<(usize, Vec<(usize, usize)>)> = Vec::new();
    for mesh in meshes {
        for (number, primitive) in scene.meshes[mesh].primitives.iter().enumerate() {
            let vertices = primitive.positions.len();
            // A primitive without joints in a skinned mesh follows its node; it is drawn rigidly.
            if primitive.triangles.is_empty() || !is_missing(&(mesh, number)) {
                continue;
            }
            match batches.last_mut() {
                Some((size, batch)) if *size + vertices <= BATCH_VERTICES => {
                    *size += vertices;
                    batch.push((mesh, number));
                }
                _ => batches.push((vertices, vec![(mesh, number)])),
            }
        }
    }
    batches.into_iter().map(move |(_, primitives)| Waiting::Batch { primitives, skinned })
}

fn mesh_vertex(primitive: &Primitive, vertex: usize, slot: Option<TextureRef>) -> MeshVertex {
    let tex_coord = |slot: TextureRef| Some(slot.uv(*primitive.tex_coords.get(slot.tex_coord)?.get(vertex)?));
    let color = primitive.colors.get(vertex).copied().unwrap_or(Vec4::ONE);
    MeshVertex {
        position: primitive.positions[vertex].to_array(),
        normal: pack_normal(primitive.normals.get(vertex).copied().unwrap_or(Vec3::ZERO).as_dvec3()),
        tex_coord: slot.and_then(tex_coord).unwrap_or(Vec2::ZERO).to_array(),
        color: pack_rgba8(color.to_array().map(f64::from)),
        pad: 0,
    }
}

/// All zero for a primitive that has no joints.
fn vertex_joints(primitive: &Primitive, vertex: usize) -> VertexJoints {
    let joints = primitive.joints.get(vertex).copied().unwrap_or_default().map(u32::from);
    VertexJoints {
        joints: [joints[0] | joints[1] << 16, joints[2] | joints[3] << 16],
        weights: primitive.weights.get(vertex).copied().unwrap_or_default(),
    }
}
