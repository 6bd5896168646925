//! Draws the posed triangles with the camera and light of the voxels: what the voxels stand for.
//!
//! In: the posed mesh in the camera's axes, in cells. Out: as the march.

use bytemuck::{Pod, Zeroable};

use super::Palette;
use crate::color::gamma_from_linear;
use crate::data::grid::Grid;
use crate::data::mesh::PosedMesh;
use crate::gpu::{Gpu, GpuTexture, Mirror, RasterTarget, Recorder, mirror};
use crate::scene::OrbitCamera;
use crate::settings::Look;
use crate::stages::pixels::camera::PixelRays;
use crate::stages::pixels::picture::{COLOR_FORMAT, DISTANCE_FORMAT};
use crate::stages::pixels::projection::{clip_from_camera, padded_axes};
use crate::stages::pixels::shown_color;
use crate::stages::pixels::{BACKGROUND, NO_DEPTH, Picture, ViewParams};

/// Mirror of `MeshParams` in shaders/view/mesh.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct MeshParams {
    pub clip_from_camera: [[f32; 4]; 4],
    /// Columns, each padded to four.
    pub world_from_camera: [[f32; 4]; 3],
}

pub const MIRRORS: &[Mirror] =
    &[mirror!(MeshParams, "view/mesh.wgsl", "MeshParams", clip_from_camera, world_from_camera)];

/// What is drawn into.
#[derive(Clone, Copy, Debug)]
pub struct MeshTarget<'a> {
    pub picture: &'a Picture,
    /// As large, from [`crate::stages::pixels::picture::depth_buffer`].
    pub depth: &'a GpuTexture,
}

/// From where a mesh is seen.
#[derive(Clone, Copy, Debug)]
pub struct MeshView<'a> {
    pub camera: &'a OrbitCamera,
    pub grid: &'a Grid,
    /// What is drawn is no farther from the eye, scene units.
    pub farthest: f64,
    pub look: &'a Look,
}

/// Draws what is uploaded of the scene as it is posed: from mesh to the camera's space in cells, as
/// [`camera_from_world`](crate::stages::pixels::projection::camera_from_world) composes it.
pub fn record(gpu: &Gpu, frame: &mut Recorder, posed: &PosedMesh<'_>, seen: MeshView<'_>, target: MeshTarget<'_>) {
    frame.raster(attachments(target));
    let size_px = target.picture.size_px();
    let depth = seen.grid.depth;
    let view = frame.uniform(&ViewParams::new(&PixelRays::new(seen.camera, seen.grid, size_px), seen.look, depth));
    let mesh = frame.uniform(&mesh_params(seen, size_px));
    let palette = frame.uniform(&Palette::new(shown_color(seen.look, depth)));
    for draw in posed.draws() {
        let kernel = gpu.raster_kernel("view/mesh.wgsl", draw.entry(), &[COLOR_FORMAT, DISTANCE_FORMAT]);
        draw.bind(frame.triangles(&kernel))
            .shared("view", &view)
            .shared("mesh", &mesh)
            .shared("palette", &palette)
            .draw(draw.vertices());
    }
}

fn mesh_params(seen: MeshView<'_>, size_px: [u32; 2]) -> MeshParams {
    MeshParams {
        clip_from_camera: clip_from_camera(seen.camera, seen.grid, size_px, seen.farthest).as_mat4().to_cols_array_2d(),
        world_from_camera: padded_axes(seen.camera),
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
