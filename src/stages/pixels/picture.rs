//! What a view draws into.

use image::RgbaImage;

use crate::gpu::{DEPTH_FORMAT, Gpu, GpuError, GpuTexture, Kernel, PassBuilder};

/// Gamma-encoded sRGB, as egui and PNG files take it.
pub const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Distance from the eye along the ray, cells; [`super::NO_DEPTH`] where there is nothing.
pub const DISTANCE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

/// Colour and distance of every pixel.
#[derive(Clone, Debug)]
pub struct Picture {
    pub color: GpuTexture,
    pub distance: GpuTexture,
}

impl Picture {
    /// The error names the size where a side is zero or beyond the device's limit.
    pub fn new(gpu: &Gpu, size_px: [u32; 2]) -> Result<Self, GpuError> {
        Ok(Self {
            color: texture(gpu, "picture", size_px, COLOR_FORMAT)?,
            distance: texture(gpu, "picture distance", size_px, DISTANCE_FORMAT)?,
        })
    }

    pub fn size_px(&self) -> [u32; 2] {
        self.color.size_px()
    }

    /// Pixels in tiles of 8 x 8 (shaders/shared/view.wgsl): a thread each.
    pub fn tiled_threads(&self) -> u64 {
        tiled_threads(self.size_px())
    }

    /// By the names in shaders/shared/store_pixel.wgsl.
    pub(in crate::stages) fn bind<'r>(&self, pass: PassBuilder<'r, Kernel>) -> PassBuilder<'r, Kernel> {
        pass.texture("picture", self.color.view()).texture("depth", self.distance.view())
    }

    /// Blocks until submitted work is done.
    pub fn read(&self, gpu: &Gpu) -> Result<RgbaImage, GpuError> {
        let [width, height] = self.size_px();
        // The texture's own size and format: its bytes always fill an image.
        Ok(RgbaImage::from_raw(width, height, gpu.read_texture(&self.color)?).unwrap_or_default())
    }

    /// Distances in cells, rows from the top. Blocks likewise.
    pub fn read_distances(&self, gpu: &Gpu) -> Result<Vec<f32>, GpuError> {
        gpu.read_texture(&self.distance).map(|bytes| bytemuck::pod_collect_to_vec(&bytes))
    }

    /// Distance in cells at one pixel; `None` outside the picture and where there is nothing. Blocks likewise.
    pub fn read_distance(&self, gpu: &Gpu, pixel: [u32; 2]) -> Result<Option<f32>, GpuError> {
        if pixel.into_iter().zip(self.size_px()).any(|(at, size)| at >= size) {
            return Ok(None);
        }
        let bytes = gpu.read_texels(&self.distance, pixel, [1, 1])?;
        let distance: Option<f32> = bytemuck::pod_collect_to_vec(&bytes).first().copied();
        Ok(distance.filter(|distance| *distance < super::NO_DEPTH))
    }
}

/// Side of the tiles in which threads walk an image (shaders/shared/view.wgsl).
pub const TILE_PX: u32 = 8;

/// Tiles that cover an image.
pub fn tile_count(size_px: [u32; 2]) -> u32 {
    size_px.map(|side| side.div_ceil(TILE_PX)).iter().product()
}

/// Threads that walk an image in tiles, a pixel each.
pub fn tiled_threads(size_px: [u32; 2]) -> u64 {
    u64::from(TILE_PX * TILE_PX) * u64::from(tile_count(size_px))
}

/// What triangles need beside it to hide one another.
pub fn depth_buffer(gpu: &Gpu, size_px: [u32; 2]) -> Result<GpuTexture, GpuError> {
    texture(gpu, "triangle depth", size_px, DEPTH_FORMAT)
}

fn texture(
    gpu: &Gpu,
    label: &str,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
) -> Result<GpuTexture, GpuError> {
    use wgpu::TextureUsages as Usage;
    let drawn = Usage::RENDER_ATTACHMENT;
    let usage = if format == DEPTH_FORMAT {
        drawn
    } else {
        drawn | Usage::STORAGE_BINDING | Usage::TEXTURE_BINDING | Usage::COPY_SRC
    };
    gpu.texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}
