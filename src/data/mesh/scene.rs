//! A scene's triangles and textures on the GPU: uploaded once, a little at a time, and only what the shown
//! objects use.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::MeshVertex;
use super::texture::{self, MeshTexture, RecordLevels};
use super::vertex::{mesh_vertices, vertex_joints};
use crate::data::texels::Texels;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Job, JobState, Recorder};
use crate::scene::{Motion, Object, Pose, Scene, TextureRef};
use crate::settings::Hidden;

/// Vertices of a batch, unless one primitive has more: 24 MiB, uploaded in one go.
const BATCH_VERTICES: usize = 1 << 19;

/// Of the work that makes smaller levels: a slice that is much shorter costs more than it does.
const LEAST_SLICE: Duration = Duration::from_millis(2);

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

/// Which textures are uploaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Textures {
    /// Triangles alone.
    None,
    /// What the mesh view and shadow maps read.
    BaseColor,
    /// What the surface image reads.
    All,
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
    /// By index into the scene's textures; those that are read in two ways are there twice.
    textures: BTreeMap<(usize, Texels), MeshTexture>,
    pub(super) white: Option<MeshTexture>,
    /// By mesh, the weights of morph targets that its vertices were uploaded with last, if any.
    morphed: BTreeMap<usize, Vec<f64>>,
    /// What `waiting` was listed for; `None` before the first upload.
    wanted: Option<(Hidden, Textures)>,
    waiting: Vec<Waiting>,
    record_levels: RecordLevels,
    /// Makes the smaller levels of textures, those recorded since, and those on their way.
    levels: Recorder,
    levels_job: Option<Job>,
}

/// What is still to be uploaded, last first.
#[derive(Debug)]
enum Waiting {
    White,
    Texture(usize, Texels),
    /// Mesh and primitive of each; all skinned or none.
    Batch {
        primitives: Vec<(usize, usize)>,
        skinned: bool,
    },
}

impl MeshScene {
    /// Nothing is uploaded yet.
    pub fn new(scene: Arc<Scene>, objects: Vec<(u32, Object)>, record_levels: RecordLevels) -> Self {
        Self {
            places: scene.meshes.iter().map(|mesh| vec![None; mesh.primitives.len()]).collect(),
            textures: BTreeMap::new(),
            scene,
            objects,
            batches: Vec::new(),
            white: None,
            morphed: BTreeMap::new(),
            wanted: None,
            waiting: Vec::new(),
            record_levels,
            levels: Recorder::default(),
            levels_job: None,
        }
    }

    /// Uploads what objects that are not hidden need, for about `budget`; true once all of it is there.
    pub fn upload(
        &mut self,
        gpu: &Gpu,
        (hidden, textures): (&Hidden, Textures),
        budget: Duration,
    ) -> Result<bool, GpuError> {
        let wanted = (hidden.clone(), textures);
        if self.wanted.as_ref() != Some(&wanted) {
            self.waiting = self.missing(hidden, textures);
            self.wanted = Some(wanted);
        }
        let start = Instant::now();
        while let Some(next) = self.waiting.pop() {
            if let Err(error) = self.upload_one(gpu, &next) {
                // It is still missing.
                self.waiting.push(next);
                return Err(error);
            }
            if start.elapsed() >= budget {
                break;
            }
        }
        Ok(self.waiting.is_empty() && self.make_levels(gpu, budget)?)
    }

    /// Displaces the vertices of morphing meshes as a pose has them. They are overwritten at once: when the recording
    /// before has run.
    pub fn morph(&mut self, gpu: &Gpu, pose: &Pose) -> Result<(), GpuError> {
        let meshes = self.scene.meshes.iter().zip(&self.places).enumerate();
        for (number, (mesh, places)) in meshes.filter(|(_, (mesh, _))| mesh.is_morphing()) {
            let weights = pose.weights(number);
            if self.morphed.get(&number).map(Vec::as_slice) == weights {
                continue;
            }
            for (primitive, place) in mesh.primitives.iter().zip(places) {
                let Some(place) = place else { continue };
                let vertices = mesh_vertices(primitive, weights);
                let offset = u64::from(place.first_vertex) * size_of::<MeshVertex>() as u64;
                gpu.write(&self.batches[place.batch].vertices, offset, bytemuck::cast_slice(&vertices))?;
            }
            // What is not uploaded yet is uploaded as it rests.
            match weights.filter(|_| places.iter().any(Option::is_some)) {
                Some(weights) => _ = self.morphed.insert(number, weights.to_vec()),
                None => _ = self.morphed.remove(&number),
            }
        }
        Ok(())
    }

    /// Advances what makes the smaller levels; true when all are there. Without them no texture is.
    fn make_levels(&mut self, gpu: &Gpu, budget: Duration) -> Result<bool, GpuError> {
        if self.levels_job.is_none() && !self.levels.is_empty() {
            self.levels_job = Some(Job::new(std::mem::take(&mut self.levels)));
        }
        let Some(job) = &mut self.levels_job else { return Ok(true) };
        match job.advance(gpu, budget.max(LEAST_SLICE)) {
            Ok(JobState::Running { .. }) => Ok(false),
            Ok(JobState::Done) => {
                self.levels_job = None;
                Ok(self.levels.is_empty())
            }
            Err(error) => {
                self.levels_job = None;
                self.textures.clear();
                self.wanted = None;
                Err(error)
            }
        }
    }

    /// What is shown and not uploaded. A mesh that skinned and rigid objects share counts as skinned.
    fn missing(&self, hidden: &Hidden, textures: Textures) -> Vec<Waiting> {
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
        let textures = read_textures(&self.scene, meshes.iter(), textures);
        let missing = textures.into_iter().filter(|texture| !self.textures.contains_key(texture));
        waiting.extend(missing.map(|(index, texels)| Waiting::Texture(index, texels)));
        let is_missing = |&(mesh, primitive): &(usize, usize)| self.places[mesh][primitive].is_none();
        waiting.extend(batches(&self.scene, skinned, true, is_missing));
        waiting.extend(batches(&self.scene, rigid, false, is_missing));
        waiting
    }

    /// `None` where the slot is empty, its image has no texels, or it is not uploaded.
    pub(super) fn texture(&self, slot: Option<TextureRef>, texels: Texels) -> Option<&MeshTexture> {
        self.textures.get(&(slot?.texture, texels))
    }

    fn upload_one(&mut self, gpu: &Gpu, next: &Waiting) -> Result<(), GpuError> {
        match *next {
            Waiting::White => self.white = Some(texture::white(gpu)?),
            Waiting::Texture(index, texels) => {
                let uploaded = texture::upload(gpu, &self.scene.textures[index], texels)?;
                (self.record_levels)(gpu, &mut self.levels, &uploaded.texture, texels);
                self.textures.insert((index, texels), uploaded);
            }
            Waiting::Batch { ref primitives, skinned } => self.upload_batch(gpu, primitives, skinned)?,
        }
        Ok(())
    }

    fn upload_batch(&mut self, gpu: &Gpu, primitives: &[(usize, usize)], skinned: bool) -> Result<(), GpuError> {
        let (mut vertices, mut indices, mut joints) = (Vec::new(), Vec::<u32>::new(), Vec::new());
        let mut placed = Vec::new();
        for &(mesh, number) in primitives {
            let primitive = &self.scene.meshes[mesh].primitives[number];
            let place = Place {
                batch: self.batches.len(),
                first_vertex: vertices.len() as u32,
                first_index: indices.len() as u32,
                index_count: 3 * primitive.triangles.len() as u32,
            };
            placed.push((mesh, number, place));
            vertices.extend(mesh_vertices(primitive, None));
            indices.extend(primitive.triangles.iter().flatten());
            if skinned {
                joints.extend((0..primitive.positions.len()).map(|vertex| vertex_joints(primitive, vertex)));
            }
        }
        let batch = Batch {
            vertices: gpu.upload("mesh vertices", &vertices)?,
            indices: gpu.upload("mesh indices", &indices)?,
            joints: skinned.then(|| gpu.upload("mesh joints", &joints)).transpose()?,
        };
        // Only what is there has a place.
        self.batches.push(batch);
        placed.into_iter().for_each(|(mesh, number, place)| self.places[mesh][number] = Some(place));
        Ok(())
    }
}

fn read_textures<'a>(
    scene: &Scene,
    meshes: impl Iterator<Item = &'a usize>,
    textures: Textures,
) -> BTreeSet<(usize, Texels)> {
    let primitives = meshes.flat_map(|&mesh| &scene.meshes[mesh].primitives);
    let slots = primitives.map(|primitive| scene.material_of(primitive)).flat_map(|material| {
        let all = [
            (material.base_color_texture, Texels::of_base_color(material)),
            (material.emissive_texture, Texels::Opaque),
            (material.metallic_roughness_texture, Texels::Linear),
            (material.normal_texture, Texels::Linear),
        ];
        let count = match textures {
            Textures::None => 0,
            Textures::BaseColor => 1,
            Textures::All => all.len(),
        };
        all.into_iter().take(count).filter_map(|(slot, texels)| Some((slot?.texture, texels)))
    });
    let has_texels =
        |index: usize| scene.textures.get(index).is_some_and(|t| t.image.width() > 0 && t.image.height() > 0);
    slots.filter(|(index, _)| has_texels(*index)).collect()
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
