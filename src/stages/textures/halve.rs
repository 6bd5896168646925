//! Mip levels: each from the one before.

use bytemuck::{Pod, Zeroable};

use crate::data::texels::Texels;
use crate::gpu::{Constant, Gpu, GpuTexture, Mirror, Recorder, constants, mirror};

/// In place of the least alpha byte of a mask.
pub const CUTS_NOTHING: u32 = u32::MAX;

pub const CONSTANTS: &[Constant] = constants![
    integer CUTS_NOTHING,
];

/// Mirror of `HalveParams` in shaders/textures/halve.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct HalveParams {
    pub size: [u32; 2],
    pub are_colors: u32,
    pub is_covering: u32,
    pub least_alpha: u32,
    pub pad: u32,
}

pub const MIRRORS: &[Mirror] =
    &[mirror!(HalveParams, "textures/halve.wgsl", "HalveParams", size, are_colors, is_covering, least_alpha, pad)];

impl HalveParams {
    /// For a level of `size` texels, made from the file's image (`is_first`) or from a level of it.
    pub fn new(size: [u32; 2], texels: Texels, is_first: bool) -> Self {
        let least_alpha = match texels {
            // Behind the first level alpha is a share.
            Texels::Cut { least } if is_first => least.into(),
            _ => CUTS_NOTHING,
        };
        let is_covering = matches!(texels, Texels::Covering | Texels::Cut { .. });
        let [are_colors, is_covering] = [texels.are_colors(), is_covering].map(u32::from);
        Self { size, are_colors, is_covering, least_alpha, pad: 0 }
    }
}

/// Fills every level of a texture of bytes (`Rgba8Unorm`) from the one before.
pub fn record_levels(gpu: &Gpu, frame: &mut Recorder, texture: &GpuTexture, texels: Texels) {
    let [width, height] = texture.size_px();
    let size_of = |level: u32| [width, height].map(|side| (side >> level).max(1));
    for level in 1..texture.raw().mip_level_count() {
        let (finer, size) = (size_of(level - 1), size_of(level));
        record(
            gpu,
            frame,
            (&level_view(texture, level - 1), &level_view(texture, level)),
            (finer, HalveParams::new(size, texels, level == 1)),
        );
    }
}

/// From the view of one level to that of the next; `finer` is the size of the former.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    (from, to): (&wgpu::TextureView, &wgpu::TextureView),
    (finer, params): ([u32; 2], HalveParams),
) {
    let texels = |size: [u32; 2]| u64::from(size[0]) * u64::from(size[1]);
    frame
        .pass(&gpu.kernel("textures/halve.wgsl", &[]))
        .uniform("params", &params)
        .texture("finer", from)
        .texture("halved", to)
        .bytes_moved(4 * (texels(finer) + texels(params.size)))
        .dispatch(texels(params.size));
}

fn level_view(texture: &GpuTexture, level: u32) -> wgpu::TextureView {
    texture.raw().create_view(&wgpu::TextureViewDescriptor {
        format: Some(wgpu::TextureFormat::Rgba8Unorm),
        base_mip_level: level,
        mip_level_count: Some(1),
        ..Default::default()
    })
}
