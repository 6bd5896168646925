//! GPU textures that say how large they are, and how to read them back.

use std::sync::Arc;

use super::memory::Reserved;
use super::{GpuError, OpenDevice};

/// A shared handle to a 2-D texture and its full view.
#[derive(Clone, Debug)]
pub struct GpuTexture(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    raw: wgpu::Texture,
    view: wgpu::TextureView,
    _reserved: Reserved,
}

impl GpuTexture {
    pub fn raw(&self) -> &wgpu::Texture {
        &self.0.raw
    }

    pub fn view(&self) -> &wgpu::TextureView {
        &self.0.view
    }

    /// Width and height.
    pub fn size_px(&self) -> [u32; 2] {
        [self.0.raw.width(), self.0.raw.height()]
    }
}

impl OpenDevice {
    /// A texture, listed in [`OpenDevice::memory`] while it lives.
    pub fn texture(&self, descriptor: &wgpu::TextureDescriptor<'_>) -> Result<GpuTexture, GpuError> {
        let label = descriptor.label.unwrap_or_default();
        let (size, limit) = (descriptor.size, self.limits.max_texture_dimension_2d);
        if size.width == 0 || size.height == 0 || size.width > limit || size.height > limit {
            let cause = format!("{} x {} pixels; a texture has 1 to {limit} a side", size.width, size.height);
            return Err(self.refused(&format!("texture \"{label}\""), &cause));
        }
        let bytes = (0..descriptor.mip_level_count).map(|level| level_bytes(descriptor, level)).sum();
        let reserved = self.reserve(label, bytes)?;
        let raw = self.allocated(label, bytes, || self.device.create_texture(descriptor))?;
        let view = raw.create_view(&wgpu::TextureViewDescriptor::default());
        Ok(GpuTexture(Arc::new(Inner { raw, view, _reserved: reserved })))
    }

    /// All bytes of the finest level, rows from the top without padding. Blocks until submitted work
    /// is done.
    pub fn read_texture(&self, texture: &GpuTexture) -> Result<Vec<u8>, GpuError> {
        self.read_texels(texture, [0, 0], texture.size_px())
    }

    /// The same of a part: `origin_px` is its upper left corner.
    pub fn read_texels(
        &self,
        texture: &GpuTexture,
        origin_px: [u32; 2],
        [width, height]: [u32; 2],
    ) -> Result<Vec<u8>, GpuError> {
        let texture = texture.raw();
        let texel_bytes = texture.format().block_copy_size(None).unwrap_or(4);
        let row_bytes = width * texel_bytes;
        let pitch = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let bytes = u64::from(pitch) * u64::from(height);
        let buffer = self.uncounted_buffer("texture read-back", bytes, wgpu::BufferUsages::empty())?;
        self.checked("texture read-back", || {
            let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(pitch), rows_per_image: None };
            let into = wgpu::TexelCopyBufferInfo { buffer: buffer.raw(), layout };
            let origin = wgpu::Origin3d { x: origin_px[0], y: origin_px[1], z: 0 };
            let part = wgpu::TexelCopyTextureInfo { origin, ..texture.as_image_copy() };
            let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
            encoder.copy_texture_to_buffer(part, into, size);
            self.queue.submit([encoder.finish()]);
        })?;
        let padded: Vec<u8> = self.read(&buffer, 0..buffer.bytes())?;
        let rows = padded.chunks(pitch as usize).take(height as usize);
        Ok(rows.flat_map(|row| &row[..row_bytes as usize]).copied().collect())
    }
}

fn level_bytes(descriptor: &wgpu::TextureDescriptor<'_>, level: u32) -> u64 {
    let side = |texels: u32| u64::from((texels >> level).max(1));
    let texel_bytes = u64::from(descriptor.format.block_copy_size(None).unwrap_or(4));
    let layers = u64::from(descriptor.size.depth_or_array_layers);
    side(descriptor.size.width) * side(descriptor.size.height) * layers * texel_bytes
}
