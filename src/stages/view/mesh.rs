//! Draws the posed triangles with the camera and light of the voxels: what the voxels stand for.
//!
//! Matrices are composed in f64 from mesh to camera, in cells, and rounded once. Skinned vertices
//! move in the vertex shader; that pipeline exists only where a scene has skins.

use std::collections::HashMap;

use bytemuck::{Pod, Zeroable};
use glam::{DMat3, DMat4, DVec3};

use super::camera::PixelRays;
use super::mesh_scene::{Batch, MeshScene, Place, material};
use super::picture::{COLOR_FORMAT, DISTANCE_FORMAT};
use super::{BACKGROUND, NO_DEPTH, Palette, Picture, ViewParams};
use crate::color::gamma_from_linear;
use crate::data::grid::Grid;
use crate::gpu::{Gpu, GpuBuffer, GpuError, GpuTexture, RasterTarget, Recorder, Uniform};
use crate::scene::{AlphaMode, Material, Motion, Object, OrbitCamera, Pose, Primitive};
use crate::settings::{Hidden, Look};
use crate::stages::transform::Matrix3x4;

pub const ALPHA_OPAQUE: u32 = 0;
pub const ALPHA_MASK: u32 = 1;
pub const ALPHA_BLEND: u32 = 2;

/// Mirror of `MeshParams` in shaders/view/mesh.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct MeshParams {
    pub clip_from_camera: [[f32; 4]; 4],
    /// Columns, each padded to four.
    pub world_from_camera: [[f32; 4]; 3],
}

/// Mirror of `DrawParams` in shaders/view/mesh.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct DrawParams {
    pub base_color: [f32; 4],
    pub first_index: u32,
    pub first_vertex: u32,
    pub first_matrix: u32,
    pub object: u32,
    pub alpha_mode: u32,
    pub cutoff: f32,
    pub unlit: u32,
    pub pad: u32,
}

/// What is drawn into.
#[derive(Clone, Copy, Debug)]
pub struct MeshTarget<'a> {
    pub picture: &'a Picture,
    /// As large, from [`super::picture::depth_buffer`].
    pub depth: &'a GpuTexture,
}

/// From where a mesh is seen.
#[derive(Clone, Copy, Debug)]
pub struct MeshView<'a> {
    pub camera: &'a OrbitCamera,
    pub grid: &'a Grid,
    pub look: &'a Look,
    /// By object number.
    pub hidden: &'a Hidden,
}

/// Draws what is uploaded of the scene as `pose` has it. Its matrices are overwritten at once: record
/// when the recording before has run. Objects whose matrices are not finite are left out.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    mesh: &mut MeshScene,
    pose: &Pose,
    seen: MeshView<'_>,
    target: MeshTarget<'_>,
) -> Result<(), GpuError> {
    frame.raster(attachments(target));
    let camera_from_world = DMat4::from_scale(DVec3::splat(1.0 / seen.grid.span)) * seen.camera.camera_from_world();
    let matrices = Matrices::new(mesh, pose, &camera_from_world, seen.hidden);
    let bytes = size_of_val(&*matrices.rows) as u64;
    let buffer = mesh.matrices.ensure(gpu, "mesh matrices", bytes)?;
    gpu.write(&buffer, 0, bytemuck::cast_slice(&matrices.rows))?;
    let size_px = target.picture.size_px();
    let depth = seen.grid.depth;
    let shared = Shared {
        view: frame.uniform(&ViewParams::new(&PixelRays::new(seen.camera, seen.grid, size_px), seen.look, depth)),
        mesh: frame.uniform(&mesh_params(seen, size_px)),
        palette: frame.uniform(&Palette::new(super::shown_color(seen.look, depth))),
        matrices: buffer,
    };
    for ((number, object), first_matrix) in mesh.objects.iter().zip(&matrices.first) {
        let Some(first_matrix) = *first_matrix else { continue };
        let primitives = mesh.scene.meshes[object.mesh].primitives.iter().zip(&mesh.places[object.mesh]);
        for (primitive, place) in primitives {
            let Some(place) = place else { continue };
            let draw = Draw { object, number: *number, primitive, place, first_matrix };
            draw_primitive(gpu, frame, mesh, &draw, &shared);
        }
    }
    Ok(())
}

/// Uniforms and matrices of all draws.
struct Shared {
    view: Uniform,
    mesh: Uniform,
    palette: Uniform,
    matrices: GpuBuffer,
}

struct Draw<'a> {
    object: &'a Object,
    number: u32,
    primitive: &'a Primitive,
    place: &'a Place,
    first_matrix: FirstMatrix,
}

fn draw_primitive(gpu: &Gpu, frame: &mut Recorder, mesh: &MeshScene, draw: &Draw<'_>, shared: &Shared) {
    let default = Material::default();
    let material = material(&mesh.scene, draw.primitive).unwrap_or(&default);
    let texture = material.base_color_texture.and_then(|slot| mesh.textures.get(slot.texture)?.as_ref());
    let (Some(texture), Some(batch)) = (texture.or(mesh.white.as_ref()), mesh.batches.get(draw.place.batch)) else {
        return;
    };
    let joints = joints_of(draw, batch);
    let entry = if joints.is_some() { "skinned" } else { "rigid" };
    let kernel = gpu.raster_kernel("view/mesh.wgsl", entry, &[COLOR_FORMAT, DISTANCE_FORMAT]);
    let pass = frame.triangles(&kernel);
    let pass = match joints {
        Some(joints) => pass.bind("vertex_joints", joints),
        None => pass,
    };
    pass.shared("view", &shared.view)
        .shared("mesh", &shared.mesh)
        .shared("palette", &shared.palette)
        .uniform("draw", &draw_params(draw, material, joints.is_some()))
        .bind("indices", &batch.indices)
        .bind("vertices", &batch.vertices)
        .bind("matrices", &shared.matrices)
        .texture("base_color", texture.texture.view())
        .sampler("base_color_sampler", &texture.sampler)
        .draw(draw.place.index_count);
}

/// A skinned object's primitive without joints follows its node, as in voxelization.
fn joints_of<'a>(draw: &Draw<'_>, batch: &'a Batch) -> Option<&'a GpuBuffer> {
    let is_skinned = matches!(draw.object.motion, Motion::Skinned { .. }) && !draw.primitive.joints.is_empty();
    batch.joints.as_ref().filter(|_| is_skinned)
}

fn draw_params(draw: &Draw<'_>, material: &Material, skinned: bool) -> DrawParams {
    let (alpha_mode, cutoff) = match material.alpha_mode {
        AlphaMode::Opaque => (ALPHA_OPAQUE, 0.0),
        AlphaMode::Mask { cutoff } => (ALPHA_MASK, cutoff),
        AlphaMode::Blend => (ALPHA_BLEND, 0.0),
    };
    DrawParams {
        base_color: material.base_color,
        first_index: draw.place.first_index,
        first_vertex: draw.place.first_vertex,
        first_matrix: if skinned { draw.first_matrix.joints } else { draw.first_matrix.node },
        object: draw.number,
        alpha_mode,
        cutoff,
        unlit: u32::from(material.unlit),
        pad: 0,
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
    fn new(mesh: &MeshScene, pose: &Pose, camera_from_world: &DMat4, hidden: &Hidden) -> Self {
        let mut matrices = Self { rows: Vec::new(), first: Vec::new() };
        let mut skins: HashMap<usize, u32> = HashMap::new();
        for (number, object) in &mesh.objects {
            if hidden.contains(*number as usize) {
                matrices.first.push(None);
                continue;
            }
            let node = matrices.rows.len() as u32;
            let camera_from_node = rows(&(*camera_from_world * pose.world_from_node[object.node]));
            matrices.rows.push(camera_from_node);
            let mut first = FirstMatrix { node, joints: node };
            if let Motion::Skinned { skin } = object.motion {
                first.joints = *skins.entry(skin).or_insert_with(|| {
                    let joints = mesh.scene.joint_matrices(skin, pose);
                    let start = matrices.rows.len() as u32;
                    matrices.rows.extend(joints.iter().map(|joint| rows(&(*camera_from_world * *joint))));
                    start
                });
            }
            // Which joints of a skin matter is known per vertex only; a rigid matrix always does.
            let is_rigid = !matches!(object.motion, Motion::Skinned { .. });
            let is_finite = camera_from_node.rows.as_flattened().iter().all(|entry| entry.is_finite());
            matrices.first.push((!is_rigid || is_finite).then_some(first));
        }
        matrices
    }
}

fn rows(matrix: &DMat4) -> Matrix3x4 {
    Matrix3x4 { rows: [0, 1, 2].map(|row| matrix.row(row).as_vec4().to_array()) }
}

fn mesh_params(seen: MeshView<'_>, size_px: [u32; 2]) -> MeshParams {
    let projection = seen.camera.projection(f64::from(size_px[0]) / f64::from(size_px[1]));
    let clip_from_camera = projection * DMat4::from_scale(DVec3::splat(seen.grid.span));
    let axes = DMat3::from_mat4(seen.camera.world_from_camera());
    MeshParams {
        clip_from_camera: clip_from_camera.as_mat4().to_cols_array_2d(),
        world_from_camera: [0, 1, 2].map(|column| axes.col(column).as_vec3().extend(0.0).to_array()),
    }
}

fn attachments(target: MeshTarget<'_>) -> RasterTarget {
    let [r, g, b] = BACKGROUND.map(|channel| gamma_from_linear(f64::from(channel)));
    let background = wgpu::Color { r, g, b, a: 1.0 };
    let nothing = wgpu::Color { r: f64::from(NO_DEPTH), g: 0.0, b: 0.0, a: 1.0 };
    RasterTarget {
        colors: vec![
            (target.picture.color.view().clone(), background),
            (target.picture.distance.view().clone(), nothing),
        ],
        depth: target.depth.view().clone(),
    }
}
