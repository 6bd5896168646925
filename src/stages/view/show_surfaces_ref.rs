//! Reference of `show_surfaces.wgsl`: the stored colour of a value.

use glam::DVec3;

use super::show_surfaces::tone_mapped;
use crate::color::gamma_from_linear;
use crate::settings::{SurfaceView, ToneCurve};

/// Gamma-encoded, 0 to 1; `None` where a scale's colours stand for the value.
pub fn color(shown_as: SurfaceView, value: DVec3, exposure: f64, curve: ToneCurve) -> Option<DVec3> {
    let encoded = |linear: DVec3| linear.to_array().map(gamma_from_linear).into();
    match shown_as {
        SurfaceView::Depth => None,
        SurfaceView::Normal => Some(value / 2.0 + 0.5),
        light if light.is_light() => {
            let exposed = (value * exposure).to_array();
            Some(encoded(exposed.map(|channel| tone_mapped(curve, channel)).into()))
        }
        _ => Some(encoded(value)),
    }
}
