//! The picture of what was composed: light by exposure and tone curve, depth by a scale, the rest as it is.

use bytemuck::{Pod, Zeroable};

use super::Palette;
use crate::data::surface_image::SurfaceImage;
use crate::gpu::{Constant, Gpu, GpuBuffer, Mirror, Recorder, constants, mirror};
use crate::settings::{SurfaceView, ToneCurve};
use crate::stages::pixels::{Picture, ViewParams};
use crate::stages::surface::expose::PictureExposure;

pub const SHOWS_VALUE: u32 = 0;
pub const SHOWS_LIGHT: u32 = 1;
pub const SHOWS_NORMAL: u32 = 2;
pub const SHOWS_DEPTH: u32 = 3;

pub const CURVE_LINEAR: u32 = 0;
pub const CURVE_REINHARD: u32 = 1;
pub const CURVE_ACES: u32 = 2;

/// x (A·x + B) / (x (C·x + D) + E) (Narkowicz 2015).
pub const ACES: [f64; 5] = [2.51, 0.03, 2.43, 0.59, 0.14];

pub const CONSTANTS: &[Constant] = constants![
    integer CURVE_ACES,
    integer CURVE_REINHARD,
    integer SHOWS_DEPTH,
    integer SHOWS_LIGHT,
    integer SHOWS_NORMAL,
    float ACES_A = ACES[0],
    float ACES_B = ACES[1],
    float ACES_C = ACES[2],
    float ACES_D = ACES[3],
    float ACES_E = ACES[4],
];

/// Mirror of `ShowSurfacesParams` in shaders/view/show_surfaces.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ShowSurfacesParams {
    /// Ends of the scale of depths, scene units.
    pub least: f32,
    pub most: f32,
    /// 1: where no surface is, the sky shines.
    pub sky: u32,
    pub pad: u32,
}

pub const MIRRORS: &[Mirror] =
    &[mirror!(ShowSurfacesParams, "view/show_surfaces.wgsl", "ShowSurfacesParams", least, most, sky, pad)];

/// What light is multiplied by.
#[derive(Clone, Copy, Debug)]
pub enum ShownExposure<'a> {
    Set(f64),
    /// As [`crate::stages::surface::expose`] left it.
    Measured(&'a GpuBuffer),
}

/// `shown`: what `surface::compose` wrote.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    (surfaces, shown): (&SurfaceImage, &GpuBuffer),
    (shown_as, curve, exposure): (SurfaceView, ToneCurve, ShownExposure<'_>),
    (view, palette, params): (&ViewParams, &Palette, &ShowSurfacesParams),
    picture: &Picture,
) {
    let constants = [("SHOWS", f64::from(shows(shown_as))), ("CURVE", f64::from(curve_number(curve)))];
    let pass = frame.pass(&gpu.kernel("view/show_surfaces.wgsl", &constants));
    let exposed = match (shows(shown_as), exposure) {
        (SHOWS_LIGHT, ShownExposure::Set(factor)) => pass.uniform("exposure", &PictureExposure::set(factor)),
        (SHOWS_LIGHT, ShownExposure::Measured(buffer)) => pass.bind("exposure", buffer),
        _ => pass.uniform("exposure", &PictureExposure::set(1.0)),
    };
    picture
        .bind(exposed)
        .uniform("view", view)
        .uniform("params", params)
        .uniform("palette", palette)
        .texture("surface_near", surfaces.near.view())
        .bind("shown", shown)
        .dispatch(picture.tiled_threads());
}

fn shows(shown_as: SurfaceView) -> u32 {
    match shown_as {
        SurfaceView::Normal => SHOWS_NORMAL,
        SurfaceView::Depth => SHOWS_DEPTH,
        light if light.is_light() => SHOWS_LIGHT,
        _ => SHOWS_VALUE,
    }
}

fn curve_number(curve: ToneCurve) -> u32 {
    match curve {
        ToneCurve::Linear => CURVE_LINEAR,
        ToneCurve::Reinhard => CURVE_REINHARD,
        ToneCurve::Aces => CURVE_ACES,
    }
}

/// What a curve makes of an exposed channel from 0; the result may exceed 1.
pub fn tone_mapped(curve: ToneCurve, x: f64) -> f64 {
    let [a, b, c, d, e] = ACES;
    match curve {
        ToneCurve::Linear => x,
        ToneCurve::Reinhard => x / (1.0 + x),
        ToneCurve::Aces => x * (a * x + b) / (x * (c * x + d) + e),
    }
}
