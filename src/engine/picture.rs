//! The picture of a frame: which view draws it, from which camera.

use super::{Engine, EngineError, Wanted};
use crate::gpu::{Gpu, GpuError, GpuTexture, Recorder};
use crate::scene::OrbitCamera;

/// Format of every picture: sRGB bytes, written as plain rgba8 by kernels.
pub const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// The texture that views draw into, made anew when its size changes.
#[derive(Debug, Default)]
pub struct Picture(Option<GpuTexture>);

impl Picture {
    pub fn ensure(&mut self, gpu: &Gpu, size_px: [u32; 2]) -> Result<GpuTexture, GpuError> {
        if let Some(texture) = &self.0
            && texture.size_px() == size_px
        {
            return Ok(texture.clone());
        }
        use wgpu::TextureUsages as Usage;
        let texture = gpu.texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size: wgpu::Extent3d { width: size_px[0], height: size_px[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: PICTURE_FORMAT,
            usage: Usage::STORAGE_BINDING | Usage::TEXTURE_BINDING | Usage::RENDER_ATTACHMENT | Usage::COPY_SRC,
            view_formats: &[wgpu::TextureFormat::Rgba8UnormSrgb],
        })?;
        Ok(self.0.insert(texture).clone())
    }
}

impl Engine {
    pub(super) fn record_picture(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let _texture = self.picture.ensure(&self.gpu, wanted.size_px)?;
        let _camera = self.camera(wanted);
        Ok(Recorder::default())
    }

    /// The camera that is set, or one that frames everything.
    fn camera(&self, wanted: &Wanted) -> OrbitCamera {
        let aspect = f64::from(wanted.size_px[0]) / f64::from(wanted.size_px[1]);
        let bounds = self.prepared.as_ref().and_then(|prepared| prepared.bounds);
        wanted.settings.look.camera.unwrap_or_else(|| {
            let mut camera = OrbitCamera::default();
            camera.frame(bounds, aspect);
            camera
        })
    }

    /// The picture; `None` before the first.
    pub fn image(&self) -> Option<&GpuTexture> {
        self.picture.0.as_ref()
    }

    /// The picture's pixels, sRGB. Blocks until they are here.
    pub fn read_image(&self) -> Result<image::RgbaImage, EngineError> {
        let missing = || GpuError::Missing { label: "picture".to_owned() };
        let texture = self.image().ok_or_else(missing)?;
        let [width, height] = texture.size_px();
        let pixels = self.gpu.read_texture(texture)?;
        Ok(image::RgbaImage::from_raw(width, height, pixels).ok_or_else(missing)?)
    }
}
