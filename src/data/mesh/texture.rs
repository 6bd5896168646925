//! Images as GPU textures, with all their mip levels.

use crate::data::texels::Texels;
use crate::gpu::{Gpu, GpuError, GpuTexture, Recorder};
use crate::scene::{Texture, Wrap};

/// Bytes as they are in the file: what makes levels reads and writes them so.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Samples along the longer side of a pixel's footprint; ignored where an adapter has no such filter.
const ANISOTROPY: u16 = 16;

/// Records what fills every level of a texture from the one before.
pub type RecordLevels = fn(&Gpu, &mut Recorder, &GpuTexture, Texels);

/// An image and how it is read.
#[derive(Clone, Debug)]
pub(super) struct MeshTexture {
    pub texture: GpuTexture,
    /// All levels; colours come out linear.
    pub view: wgpu::TextureView,
    pub sampler: wgpu::Sampler,
}

/// One white texel, for materials without an image.
pub(super) fn white(gpu: &Gpu) -> Result<MeshTexture, GpuError> {
    let texture = finest(gpu, "white", ([1, 1], &[255; 4]))?;
    Ok(MeshTexture { view: view(&texture, Texels::Linear), texture, sampler: sampler(gpu, [Wrap::Repeat; 2], true) })
}

/// The finest level; the others are there and empty. The error names the image where it is larger than the device
/// allows.
pub(super) fn upload(gpu: &Gpu, source: &Texture, texels: Texels) -> Result<MeshTexture, GpuError> {
    let label = format!("image {}", source.name);
    let image = ([source.image.width(), source.image.height()], source.image.as_raw().as_slice());
    let texture = finest(gpu, &label, image)?;
    Ok(MeshTexture { view: view(&texture, texels), texture, sampler: sampler(gpu, source.wrap, source.nearest) })
}

fn finest(gpu: &Gpu, label: &str, ([width, height], rgba8): ([u32; 2], &[u8])) -> Result<GpuTexture, GpuError> {
    use wgpu::TextureUsages as Usage;
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = gpu.texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size,
        mip_level_count: width.max(height).checked_ilog2().unwrap_or(0) + 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: Usage::TEXTURE_BINDING | Usage::COPY_DST | Usage::STORAGE_BINDING,
        view_formats: &[FORMAT.add_srgb_suffix()],
    })?;
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
    gpu.queue.write_texture(texture.raw().as_image_copy(), rgba8, layout, size);
    Ok(texture)
}

fn view(texture: &GpuTexture, texels: Texels) -> wgpu::TextureView {
    texture.raw().create_view(&wgpu::TextureViewDescriptor {
        format: Some(if texels.are_colors() { FORMAT.add_srgb_suffix() } else { FORMAT }),
        // Bytes of colours cannot be written as such.
        usage: Some(wgpu::TextureUsages::TEXTURE_BINDING),
        ..Default::default()
    })
}

fn sampler(gpu: &Gpu, wrap: [Wrap; 2], nearest: bool) -> wgpu::Sampler {
    let address = wrap.map(|wrap| match wrap {
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::MirroredRepeat => wgpu::AddressMode::MirrorRepeat,
        Wrap::ClampToEdge => wgpu::AddressMode::ClampToEdge,
    });
    let filter = if nearest { wgpu::FilterMode::Nearest } else { wgpu::FilterMode::Linear };
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("mesh texture"),
        address_mode_u: address[0],
        address_mode_v: address[1],
        mag_filter: filter,
        min_filter: filter,
        mipmap_filter: if nearest { wgpu::MipmapFilterMode::Nearest } else { wgpu::MipmapFilterMode::Linear },
        anisotropy_clamp: if nearest { 1 } else { ANISOTROPY },
        ..Default::default()
    })
}
