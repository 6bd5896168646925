//! Shadow maps: how far the posed triangles are from a light, in cells along a layer's axis.
//!
//! A sun has one orthographic layer that covers what of the scene's bounds is in the grid, and reaches
//! back to what casts a shadow into it; a narrow spot one perspective layer; a point light, and a spot
//! wider than [`NARROW_SPOT_RADIANS`], the six faces of a cube. Composed in f64.

use bytemuck::{Pod, Zeroable};
use glam::{DMat4, DVec3, DVec4};

use crate::data::grid::Grid;
use crate::data::mesh::PosedMesh;
use crate::gpu::{
    Constant, DEPTH_FORMAT, Gpu, GpuError, GpuTexture, Mirror, RasterTarget, Recorder, constants, mirror,
};
use crate::lights::PosedLight;
use crate::scene::{Aabb, LightKind};
use crate::stages::pixels::NO_DEPTH;

pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;
/// Wider spots are mapped like point lights.
pub const NARROW_SPOT_RADIANS: f64 = std::f64::consts::FRAC_PI_3;
/// Nothing nearer to a light casts a shadow.
pub const NEAR_CELLS: f64 = 1.0 / 16.0;

pub const CONSTANTS: &[Constant] = constants![
    float LIGHT_NEAR_CELLS = NEAR_CELLS,
];

const FACES: usize = 6;

/// Mirror of `ShadowFrame` in shaders/shared/shadow_frame.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct ShadowFrame {
    pub clip_from_grid: [[f32; 4]; 4],
    pub distance: [f32; 4],
}

/// Mirror of `ShadowParams` in shaders/shared/shadow_map.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct ShadowParams {
    pub frames: [ShadowFrame; FACES],
    pub count: u32,
    pub size_px: u32,
    pub pad: [u32; 2],
}

pub const MIRRORS: &[Mirror] = &[
    mirror!(ShadowFrame, "shared/shadow_frame.wgsl", "ShadowFrame", clip_from_grid, distance),
    mirror!(ShadowParams, "shared/shadow_map.wgsl", "ShadowParams", frames, count, size_px, pad),
];

/// A layer a frame. Without frames it hides nothing.
#[derive(Clone, Debug)]
pub struct ShadowMap {
    pub params: ShadowParams,
    pub texture: GpuTexture,
    /// All layers.
    pub view: wgpu::TextureView,
    depth: GpuTexture,
}

impl ShadowParams {
    /// For a map of `size_px` texels; half as many on the faces of a cube. `bounds`: of all that may
    /// cast, world space; without them there is nothing to map.
    pub fn new(light: &PosedLight, grid: &Grid, bounds: Option<Aabb>, size_px: u32) -> Self {
        let Some(bounds) = bounds else { return Self::default() };
        let position = grid.grid_from_world().transform_point3(light.position);
        let (frames, size_px) = match light.kind {
            LightKind::Directional => (vec![sun_frame(light.direction, grid, bounds)], size_px),
            LightKind::Spot { outer_cone_radians, .. } if f64::from(outer_cone_radians) <= NARROW_SPOT_RADIANS => {
                // A little wider, so that the rim of the light is inside.
                let half_width = 1.01 * f64::from(outer_cone_radians).tan();
                (vec![perspective_frame(position, light.direction, half_width)], size_px)
            }
            LightKind::Spot { .. } | LightKind::Point { .. } => (cube_frames(position), (size_px / 2).max(1)),
        };
        let mut params = Self { count: frames.len() as u32, size_px, ..Self::default() };
        params.frames[..frames.len()].copy_from_slice(&frames);
        params
    }
}

impl ShadowParams {
    /// Distances along the map's axis that a grid of `cells`³ cells has, in cells: from the light on where it is in
    /// a place.
    pub fn range_cells(&self, cells: u32) -> [f64; 2] {
        let far = f64::from(cells);
        let corners = (0..8).map(|i| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { far } else { 0.0 }));
        let frames = &self.frames[..self.count as usize];
        let distances = corners.flat_map(|corner| {
            frames.iter().map(move |frame| {
                let [x, y, z, w] = frame.distance.map(f64::from);
                x * corner[0] + y * corner[1] + z * corner[2] + w
            })
        });
        let (least, most) = distances.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), d| (a.min(d), b.max(d)));
        let is_sun = frames.len() == 1 && frames[0].clip_from_grid[0][3] == 0.0;
        [if is_sun { least } else { 0.0 }, most]
    }
}

/// Two axes across a direction.
fn across(direction: DVec3) -> (DVec3, DVec3) {
    let right = direction.any_orthonormal_vector();
    (right, right.cross(direction))
}

fn sun_frame(direction: DVec3, grid: &Grid, bounds: Aabb) -> ShadowFrame {
    let cells = f64::from(grid.cells());
    let to_grid = grid.grid_from_world();
    let (low, high) = (to_grid.transform_point3(bounds.min), to_grid.transform_point3(bounds.max));
    let corners = |low: DVec3, high: DVec3| {
        (0..8).map(move |i| DVec3::select(glam::BVec3::new(i & 1 == 1, i & 2 == 2, i & 4 == 4), high, low))
    };
    let inside = || corners(low.clamp(DVec3::ZERO, DVec3::splat(cells)), high.clamp(DVec3::ZERO, DVec3::splat(cells)));
    let extent = |axis: DVec3| {
        let along = inside().map(|corner| corner.dot(axis));
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), d| (least.min(d), most.max(d)))
    };
    let (right, up) = across(direction);
    let row = |axis: DVec3, (least, most): (f64, f64)| {
        // A cell more on each side, so that the edge of the map is outside.
        let half = (most - least) / 2.0 + 1.0;
        (axis / half).extend(-(least + most) / 2.0 / half)
    };
    let nearest = corners(low, high).map(|corner| corner.dot(direction)).fold(f64::INFINITY, f64::min) - 1.0;
    let farthest = extent(direction).1 + 1.0;
    let depth = (-direction).extend(farthest) / (farthest - nearest);
    frame([row(right, extent(right)), row(up, extent(up)), depth, DVec4::W], direction.extend(0.0))
}

/// `half_width`: at distance 1.
fn perspective_frame(position: DVec3, direction: DVec3, half_width: f64) -> ShadowFrame {
    let (right, up) = across(direction);
    let row = |axis: DVec3| axis.extend(-axis.dot(position));
    let along = row(direction);
    frame([row(right) / half_width, row(up) / half_width, DVec4::W * NEAR_CELLS, along], along)
}

fn cube_frames(position: DVec3) -> Vec<ShadowFrame> {
    DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]).map(|axis| perspective_frame(position, axis, 1.0)).collect()
}

fn frame(rows: [DVec4; 4], distance: DVec4) -> ShadowFrame {
    let matrix = DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose();
    ShadowFrame { clip_from_grid: matrix.as_mat4().to_cols_array_2d(), distance: distance.as_vec4().to_array() }
}

impl ShadowMap {
    /// Empty until it is recorded. One texel where `params` have no frame.
    pub fn new(gpu: &Gpu, params: ShadowParams) -> Result<Self, GpuError> {
        use wgpu::TextureUsages as Usage;
        let texture = |label: &'static str, format, layers: u32, usage| {
            let side = params.size_px.max(1);
            gpu.texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: layers },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: Usage::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let distances = texture(
            "shadow map",
            FORMAT,
            params.count.max(1),
            Usage::TEXTURE_BINDING | Usage::COPY_SRC | Usage::COPY_DST,
        )?;
        let view = distances.raw().create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        let depth = texture("shadow map depth", DEPTH_FORMAT, 1, Usage::empty())?;
        Ok(Self { params, texture: distances, view, depth })
    }

    /// Draws every layer. `posed`: in cells of the grid.
    pub fn record(&self, gpu: &Gpu, frame: &mut Recorder, posed: &PosedMesh<'_>) {
        for (layer, seen) in self.params.frames[..self.params.count as usize].iter().enumerate() {
            let view = self.texture.raw().create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2),
                base_array_layer: layer as u32,
                array_layer_count: Some(1),
                ..Default::default()
            });
            let nothing = wgpu::Color { r: f64::from(NO_DEPTH), g: 0.0, b: 0.0, a: 1.0 };
            frame.raster(RasterTarget { colors: vec![(view, nothing)], depth: self.depth.view().clone() });
            let seen = frame.uniform(seen);
            for draw in posed.draws() {
                let kernel = gpu.raster_kernel("light/shadow.wgsl", draw.entry(), &[FORMAT]);
                draw.bind(frame.triangles(&kernel)).shared("frame", &seen).draw(draw.vertices());
            }
        }
    }
}
