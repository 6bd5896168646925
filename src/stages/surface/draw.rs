//! Draws the surface image: place, normals and material of what the camera sees.
//!
//! In: the posed mesh in the camera's axes, in cells ([`camera_from_world`]), with all its textures. Out:
//! [`SurfaceImage`]. Opaque surfaces hide one another; MASK cuts out by its cutoff, BLEND is there in a share
//! of the pixels. What is double-sided is drawn from behind too; normals are on the side of the eye.
//!
//! [`camera_from_world`]: crate::stages::pixels::projection::camera_from_world

use bytemuck::{Pod, Zeroable};

use crate::data::grid::Grid;
use crate::data::mesh::PosedMesh;
use crate::data::surface_image::{FORMAT, SurfaceImage};
use crate::gpu::{Gpu, GpuTexture, Mirror, RasterTarget, Recorder, mirror};
use crate::scene::OrbitCamera;
use crate::stages::pixels::NO_DEPTH;
use crate::stages::pixels::projection::{clip_from_camera, padded_axes};

/// Mirror of `SurfaceParams` in shaders/surface/draw.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct SurfaceParams {
    pub clip_from_camera: [[f32; 4]; 4],
    /// Columns, each padded to four.
    pub world_from_camera: [[f32; 4]; 3],
    pub emission: f32,
    pub pad: u32,
    pub pad_2: [u32; 2],
}

pub const MIRRORS: &[Mirror] = &[mirror!(
    SurfaceParams,
    "surface/draw.wgsl",
    "SurfaceParams",
    clip_from_camera,
    world_from_camera,
    emission,
    pad,
    pad_2
)];

/// From where surfaces are seen.
#[derive(Clone, Copy, Debug)]
pub struct Viewpoint<'a> {
    pub camera: &'a OrbitCamera,
    pub grid: &'a Grid,
    /// What is drawn is no farther from the eye, scene units.
    pub farthest: f64,
    /// Of an emissive factor of 1, nits.
    pub emission: f64,
}

/// `depth`: as large as the image, from [`crate::stages::pixels::picture::depth_buffer`].
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    posed: &PosedMesh<'_>,
    seen: Viewpoint<'_>,
    (image, depth): (&SurfaceImage, &GpuTexture),
) {
    frame.raster(attachments(image, depth));
    let surface = frame.uniform(&SurfaceParams {
        clip_from_camera: clip_from_camera(seen.camera, seen.grid, image.size_px(), seen.farthest)
            .as_mat4()
            .to_cols_array_2d(),
        world_from_camera: padded_axes(seen.camera),
        emission: seen.emission as f32,
        pad: 0,
        pad_2: [0; 2],
    });
    for draw in posed.draws() {
        let kernel = gpu.raster_kernel("surface/draw.wgsl", draw.entry(), &[FORMAT, FORMAT]);
        draw.bind_all(frame.triangles(&kernel)).shared("surface", &surface).draw(draw.vertices());
    }
}

fn attachments(image: &SurfaceImage, depth: &GpuTexture) -> RasterTarget {
    let nowhere = wgpu::Color { r: f64::from(NO_DEPTH.to_bits()), ..wgpu::Color::TRANSPARENT };
    RasterTarget {
        colors: vec![(image.near.view().clone(), nowhere), (image.stuff.view().clone(), wgpu::Color::TRANSPARENT)],
        depth: depth.view().clone(),
    }
}
