//! The picture in the middle: shows the engine's image, and turns the pointer's moves into those of the camera.

use egui::{Pos2, Rect, Response, Role, Sense, Ui, Vec2, WidgetInfo, pos2};

use super::command::Command;
use super::gestures::{self, Drag};
use super::theme;
use crate::gpu::GpuTexture;
use crate::scene::OrbitCamera;

/// A drag over the full height of the view turns by half a circle.
const TURN_PER_HEIGHT_RADIANS: f64 = std::f64::consts::PI;
/// Distance factor a point of scrolling, as e^(−points · this).
const ZOOM_PER_POINT: f64 = 0.004;
/// Largest edge of a picture, where the adapter allows as much.
const MAX_EDGE_PX: f32 = 4096.0;

/// The engine's texture as egui knows it.
#[derive(Default)]
pub struct Viewport {
    shown: Option<(wgpu::Texture, egui::TextureId)>,
}

impl Viewport {
    /// Takes all the room that is left. Returns the response of the picture's area.
    pub fn ui(&mut self, ui: &mut Ui, render: &egui_wgpu::RenderState, image: Option<&GpuTexture>) -> Response {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "View of the scene"));
        ui.painter().rect_filled(rect, 0.0, theme::BACKGROUND);
        if let Some(image) = image {
            let id = self.texture_id(render, image, size_px(ui, rect));
            let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
            ui.painter().image(id, rect, whole, egui::Color32::WHITE);
        }
        response
    }

    /// Registers a new texture in the place of the old one. At full size a texel is a pixel, so
    /// only coarse pictures are smoothed.
    fn texture_id(
        &mut self,
        render: &egui_wgpu::RenderState,
        image: &GpuTexture,
        full_px: [u32; 2],
    ) -> egui::TextureId {
        match &self.shown {
            Some((texture, id)) if texture == image.raw() => return *id,
            _ => {}
        }
        let coarse = image.size_px() != full_px;
        let filter = if coarse { wgpu::FilterMode::Linear } else { wgpu::FilterMode::Nearest };
        let mut renderer = render.renderer.write();
        let id = match self.shown {
            Some((_, id)) => {
                renderer.update_egui_texture_from_wgpu_texture(&render.device, image.view(), filter, id);
                id
            }
            None => renderer.register_native_texture(&render.device, image.view(), filter),
        };
        self.shown = Some((image.raw().clone(), id));
        id
    }
}

/// Pixels of a picture that fills `rect`; zero where there is no room.
pub fn size_px(ui: &Ui, rect: Rect) -> [u32; 2] {
    let size = rect.size() * ui.pixels_per_point();
    [size.x, size.y].map(|points| points.round().clamp(0.0, MAX_EDGE_PX) as u32)
}

/// What the pointer over the view asks for.
pub fn commands(ui: &Ui, response: &Response, camera: &OrbitCamera) -> Vec<Command> {
    let mut moved = *camera;
    drag(ui, response, &mut moved);
    if response.contains_pointer() {
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta.y, input.zoom_delta()));
        let factor = (-f64::from(scroll) * ZOOM_PER_POINT).exp() / f64::from(pinch);
        if factor != 1.0 {
            moved.zoom(factor);
        }
    }
    // Alt and a click pin a node.
    if response.double_clicked() && !ui.input(|input| input.modifiers.alt) {
        return vec![Command::FrameAll];
    }
    if moved == *camera { Vec::new() } else { vec![Command::Camera(moved)] }
}

fn drag(ui: &Ui, response: &Response, camera: &mut OrbitCamera) {
    let travel = response.drag_delta();
    if travel == Vec2::ZERO {
        return;
    }
    let [right, down] = [travel.x, travel.y].map(|points| f64::from(points / response.rect.height()));
    match gestures::drag(ui, response) {
        Some(Drag::Orbit) => camera.orbit(-right * TURN_PER_HEIGHT_RADIANS, down * TURN_PER_HEIGHT_RADIANS),
        Some(Drag::Pan) => camera.pan(-right, down),
        None => {}
    }
}
