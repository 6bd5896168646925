//! What is shown of the lit surfaces, a value a pixel: radiance of a term, irradiance, or a property.
//!
//! In: the surface image, direct light, what cones bring. Out: four f32 a pixel, the last 1 where a surface
//! is: nits, lux, a unit vector, scene units, or a share of 1. Where none is, the sky's radiance in the views
//! that show what comes straight from it.

use bytemuck::{Pod, Zeroable};

use super::{RADIANCE_BYTES, Surfaces};
use crate::data::surface_image::SurfaceImage;
use crate::gpu::{Constant, Gpu, GpuBuffer, Mirror, Recorder, constants, mirror};
use crate::settings::SurfaceView;
use crate::stages::pixels::ViewParams;

pub const TERM_FINAL: u32 = 0;
pub const TERM_DIRECT: u32 = 1;
pub const TERM_DIFFUSE: u32 = 2;
pub const TERM_SPECULAR: u32 = 3;
pub const TERM_AO: u32 = 4;
pub const TERM_IRRADIANCE: u32 = 5;
pub const TERM_ALBEDO: u32 = 6;
pub const TERM_NORMAL: u32 = 7;
pub const TERM_DEPTH: u32 = 8;
pub const TERM_ROUGHNESS: u32 = 9;

pub const CONSTANTS: &[Constant] = constants![
    integer TERM_ALBEDO,
    integer TERM_AO,
    integer TERM_DEPTH,
    integer TERM_DIFFUSE,
    integer TERM_DIRECT,
    integer TERM_FINAL,
    integer TERM_IRRADIANCE,
    integer TERM_NORMAL,
    integer TERM_ROUGHNESS,
    integer TERM_SPECULAR,
];

/// Mirror of `ComposeParams` in shaders/surface/compose.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ComposeParams {
    /// Radiance from all directions, nits.
    pub sky: [f32; 3],
    pub glossy_roughness: f32,
    /// Edge of a cell, scene units.
    pub span: f32,
    pub pad: u32,
    pub pad_end: [u32; 2],
}

pub const MIRRORS: &[Mirror] =
    &[mirror!(ComposeParams, "surface/compose.wgsl", "ComposeParams", sky, glossy_roughness, span, pad, pad_end)];

/// What is put together. `None`: it was not traced.
#[derive(Clone, Copy, Debug)]
pub struct Terms<'a> {
    pub direct: Option<&'a GpuBuffer>,
    /// Mean radiance of the hemisphere and its open share.
    pub diffuse: Option<&'a GpuBuffer>,
    pub specular: Option<&'a GpuBuffer>,
    /// Stands in for what is not there; nothing of it is read.
    pub nothing: &'a GpuBuffer,
}

/// Writes `shown`, [`RADIANCE_BYTES`] a pixel. A term that is shown must be there.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    surfaces: &SurfaceImage,
    (view, params): (&ViewParams, &ComposeParams),
    (shown_as, terms): (SurfaceView, Terms<'_>),
    shown: &GpuBuffer,
) {
    let flag = |on: bool| f64::from(u8::from(on));
    let constants = [
        ("TERM", f64::from(term_number(shown_as))),
        ("DIFFUSE", flag(terms.diffuse.is_some())),
        ("SPECULAR", flag(terms.specular.is_some())),
    ];
    let pixels = u64::from(view.width_px) * u64::from(view.height_px);
    let pass = frame.pass(&gpu.kernel("surface/compose.wgsl", &constants));
    Surfaces { image: surfaces, view }
        .bind(pass)
        .uniform("params", params)
        .bind("direct", terms.direct.unwrap_or(terms.nothing))
        .bind("diffuse", terms.diffuse.unwrap_or(terms.nothing))
        .bind("specular", terms.specular.unwrap_or(terms.nothing))
        .bind("shown", shown)
        .bytes_moved(pixels * 4 * RADIANCE_BYTES)
        .dispatch(pixels);
}

pub fn term_number(shown_as: SurfaceView) -> u32 {
    match shown_as {
        SurfaceView::Final => TERM_FINAL,
        SurfaceView::Direct => TERM_DIRECT,
        SurfaceView::Diffuse => TERM_DIFFUSE,
        SurfaceView::Specular => TERM_SPECULAR,
        SurfaceView::Ao => TERM_AO,
        SurfaceView::Irradiance => TERM_IRRADIANCE,
        SurfaceView::Albedo => TERM_ALBEDO,
        SurfaceView::Normal => TERM_NORMAL,
        SurfaceView::Depth => TERM_DEPTH,
        SurfaceView::Roughness => TERM_ROUGHNESS,
    }
}
