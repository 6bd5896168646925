//! The picture of a frame: which view draws it, from which camera.

use super::{Engine, EngineError, Wanted};
use crate::gpu::{Gpu, GpuError, Recorder};
use crate::scene::OrbitCamera;

/// Format of every picture: sRGB bytes, written as plain rgba8 by kernels.
pub const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// The texture that views draw into.
#[derive(Debug, Default)]
pub struct Picture {
    texture: Option<wgpu::Texture>,
}

impl Picture {
    pub fn texture(&self) -> Option<&wgpu::Texture> {
        self.texture.as_ref()
    }

    pub fn ensure(&mut self, gpu: &Gpu, size_px: [u32; 2]) -> wgpu::Texture {
        let size = wgpu::Extent3d { width: size_px[0], height: size_px[1], depth_or_array_layers: 1 };
        if let Some(texture) = &self.texture
            && texture.size() == size
        {
            return texture.clone();
        }
        use wgpu::TextureUsages as Usage;
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: PICTURE_FORMAT,
            usage: Usage::STORAGE_BINDING | Usage::TEXTURE_BINDING | Usage::RENDER_ATTACHMENT | Usage::COPY_SRC,
            view_formats: &[wgpu::TextureFormat::Rgba8UnormSrgb],
        });
        self.texture.insert(texture).clone()
    }
}

impl Engine {
    pub(super) fn record_picture(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let _texture = self.picture.ensure(&self.gpu, wanted.size_px);
        let _camera = self.camera(wanted);
        Ok(Recorder::default())
    }

    /// The camera that is set, or one that frames everything.
    fn camera(&self, wanted: &Wanted) -> OrbitCamera {
        let aspect = f64::from(wanted.size_px[0]) / f64::from(wanted.size_px[1]);
        let bounds = self.prepared.as_ref().and_then(|prepared| prepared.bounds);
        wanted.settings.look.camera.unwrap_or_else(|| OrbitCamera::framing(bounds, aspect))
    }

    /// The picture's texture; `None` before the first.
    pub fn image(&self) -> Option<&wgpu::Texture> {
        self.picture.texture()
    }

    /// The picture's pixels. Blocks until they are here.
    pub fn read_image(&self) -> Result<image::RgbaImage, EngineError> {
        let texture = self.image().ok_or_else(|| GpuError::Missing { label: "picture".to_owned() })?;
        Ok(self.gpu.read_texture(texture)?)
    }
}
