//! What of the lit surfaces is shown, and how their light becomes colours of a screen.

use egui::Ui;

use super::{choice, list};
use crate::settings::{Look, SurfaceView, ToneCurve};

pub fn ui(ui: &mut Ui, look: &mut Look) {
    let parts = [
        (SurfaceView::Final, "Final", "All light that reaches the eye, nits."),
        (SurfaceView::Direct, "Direct", "What lights send without a detour, and what surfaces emit, nits."),
        (SurfaceView::Diffuse, "Diffuse", "What diffuse cones bring, times albedo, nits."),
        (SurfaceView::Specular, "Specular", "What is reflected, nits."),
        (SurfaceView::Ao, "Occlusion", "Share of the hemisphere without anything near, 0 to 1."),
        (SurfaceView::Irradiance, "Irradiance", "What arrives by diffuse cones, lux."),
        (SurfaceView::Albedo, "Albedo", "Base colour."),
        (SurfaceView::Normal, "Normal", "x, y, z as red, green, blue; of normal maps too."),
        (SurfaceView::Depth, "Depth", "Distance from the eye in the colours of a scale, near ones bright."),
        (SurfaceView::Roughness, "Roughness", "0, a mirror, to 1."),
    ];
    list(ui, "Part", "What of the lit surfaces is shown.", &mut look.surface, &parts);
    if look.surface.is_light() {
        let curves = [
            (ToneCurve::Linear, "Linear", "Exposed light as it is, cut at 1."),
            (ToneCurve::Reinhard, "Reinhard", "x / (1 + x): nothing is cut, all is darker."),
            (ToneCurve::Aces, "Film", "The ACES film curve, as fitted by Narkowicz."),
        ];
        choice(ui, "Curve", "How exposed light becomes the 0 to 1 of a screen.", &mut look.tone_curve, &curves);
    }
}
