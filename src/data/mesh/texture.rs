//! Images as GPU textures, with mip levels that the GPU averages: colours in linear light.

use wgpu::util::{TextureBlitter, TextureBlitterBuilder};

use crate::gpu::{Gpu, GpuError, GpuTexture};
use crate::scene::{Texture, Wrap};

/// What the bytes of an image say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Encoding {
    /// Colours.
    Srgb,
    /// Normals, roughness, metalness.
    Linear,
}

impl Encoding {
    fn format(self) -> wgpu::TextureFormat {
        match self {
            Self::Srgb => wgpu::TextureFormat::Rgba8UnormSrgb,
            Self::Linear => wgpu::TextureFormat::Rgba8Unorm,
        }
    }
}

/// An image and how it is read.
#[derive(Clone, Debug)]
pub(super) struct MeshTexture {
    pub texture: GpuTexture,
    pub sampler: wgpu::Sampler,
}

/// Keeps the pipelines that halve images.
#[derive(Debug)]
pub(super) struct TextureUploader {
    srgb: TextureBlitter,
    linear: TextureBlitter,
}

impl TextureUploader {
    pub fn new(gpu: &Gpu) -> Self {
        let blitter = |encoding: Encoding| {
            let builder = TextureBlitterBuilder::new(&gpu.device, encoding.format());
            builder.sample_type(wgpu::FilterMode::Linear).build()
        };
        Self { srgb: blitter(Encoding::Srgb), linear: blitter(Encoding::Linear) }
    }

    /// One white texel, for materials without an image.
    pub fn white(&self, gpu: &Gpu) -> Result<MeshTexture, GpuError> {
        let texture = self.filled(gpu, "white", ([1, 1], &[255; 4]), Encoding::Linear)?;
        Ok(MeshTexture { texture, sampler: sampler(gpu, [Wrap::Repeat; 2], true) })
    }

    /// The error names the image where it is larger than the device allows.
    pub fn upload(&self, gpu: &Gpu, source: &Texture, encoding: Encoding) -> Result<MeshTexture, GpuError> {
        let label = format!("image {}", source.name);
        let image = ([source.image.width(), source.image.height()], source.image.as_raw().as_slice());
        let texture = self.filled(gpu, &label, image, encoding)?;
        Ok(MeshTexture { texture, sampler: sampler(gpu, source.wrap, source.nearest) })
    }

    fn filled(
        &self,
        gpu: &Gpu,
        label: &str,
        ([width, height], rgba8): ([u32; 2], &[u8]),
        encoding: Encoding,
    ) -> Result<GpuTexture, GpuError> {
        use wgpu::TextureUsages as Usage;
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let texture = gpu.texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size,
            mip_level_count: width.max(height).checked_ilog2().unwrap_or(0) + 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: encoding.format(),
            usage: Usage::TEXTURE_BINDING | Usage::COPY_DST | Usage::RENDER_ATTACHMENT,
            view_formats: &[],
        })?;
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
        gpu.queue.write_texture(texture.raw().as_image_copy(), rgba8, layout, size);
        self.halve(gpu, texture.raw(), encoding);
        Ok(texture)
    }

    /// Fills every level from the one before.
    fn halve(&self, gpu: &Gpu, texture: &wgpu::Texture, encoding: Encoding) {
        let blitter = match encoding {
            Encoding::Srgb => &self.srgb,
            Encoding::Linear => &self.linear,
        };
        let mut encoder =
            gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("mip levels") });
        let level = |base_mip_level: u32| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                base_mip_level,
                mip_level_count: Some(1),
                ..Default::default()
            })
        };
        for target in 1..texture.mip_level_count() {
            blitter.copy(&gpu.device, &mut encoder, &level(target - 1), &level(target));
        }
        gpu.queue.submit([encoder.finish()]);
    }
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
        ..Default::default()
    })
}
