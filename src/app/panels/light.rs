//! What lights the scene: a list of all lights, the controls of the one that is selected, and below
//! them what is no light of its own: sky and emission, shadows, bounces.

use egui::{Button, Role, ScrollArea, Ui, WidgetInfo};

use super::light_editor::{Editor, short_unit};
use super::{light_method, nothing};
use crate::app::command::Command;
use crate::app::numbers::short;
use crate::app::palette::Tone;
use crate::lights::{KnownLight, LightSource, Shines, brightest_at};
use crate::scene::{LightKind, OrbitCamera, Scene};
use crate::settings::lighting::{AddedLight, LightEdit, Lighting, SunShines};

const ROW_HEIGHT: f32 = 18.0;
/// Of the list, before it scrolls.
const MAX_ROWS: usize = 6;

/// What there is to show and to change.
#[derive(Clone, Copy)]
pub struct LightPanel<'a> {
    pub lighting: &'a Lighting,
    pub scene: &'a Scene,
    /// Every light, as it is posed now.
    pub known: &'a [KnownLight],
    /// New lights stand where it does and shine where it looks.
    pub camera: OrbitCamera,
}

/// `selected`: which light's controls are shown.
pub fn ui(ui: &mut Ui, panel: LightPanel<'_>, selected: &mut Option<LightSource>) -> Vec<Command> {
    let mut lighting = panel.lighting.clone();
    list_ui(ui, panel, &mut lighting, selected);
    add_ui(ui, panel, &mut lighting, selected);
    let found = panel.known.iter().find(|known| Some(known.source) == *selected);
    match found {
        Some(known) => Editor { known, scene: panel.scene }.ui(ui, &mut lighting),
        None => nothing(ui, "Select a light to change it."),
    }
    ui.separator();
    light_method::ui(ui, &mut lighting);
    if lighting == *panel.lighting { Vec::new() } else { vec![Command::Light(lighting)] }
}

fn list_ui(ui: &mut Ui, panel: LightPanel<'_>, lighting: &mut Lighting, selected: &mut Option<LightSource>) {
    let spacing = ui.spacing().item_spacing.y;
    let rows = panel.known.len().min(MAX_ROWS) as f32;
    let list =
        ScrollArea::vertical().id_salt("lights").max_height(rows * (ROW_HEIGHT + spacing)).auto_shrink([false, true]);
    list.show_rows(ui, ROW_HEIGHT, panel.known.len(), |ui, rows| {
        for known in &panel.known[rows] {
            row_ui(ui, panel, known, lighting, selected);
        }
    });
}

/// A switch, a name, and how bright it is or why it is not.
fn row_ui(
    ui: &mut Ui,
    panel: LightPanel<'_>,
    known: &KnownLight,
    lighting: &mut Lighting,
    selected: &mut Option<LightSource>,
) {
    let name = shown_name(known);
    ui.horizontal(|ui| {
        ui.set_height(ROW_HEIGHT);
        let mut on = known.light.on;
        let switch = ui.checkbox(&mut on, "").on_hover_text("Whether this light is on.");
        switch.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, on, format!("Switch {name}")));
        if switch.changed() {
            switch_on(lighting, known, on);
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let (text, color) = match cause(known.shines) {
                None => (format!("{} {}", short(known.light.intensity), short_unit(known.light.kind)), Tone::Weak),
                Some(cause) => {
                    (cause.to_owned(), if known.shines == Shines::Nowhere { Tone::Warning } else { Tone::Weak })
                }
            };
            ui.label(egui::RichText::new(text).color(color.of(ui)).small());
            let is_selected = *selected == Some(known.source);
            let row = Button::selectable(is_selected, name.as_str()).truncate();
            let size = egui::vec2(ui.available_width(), ROW_HEIGHT);
            let row =
                ui.allocate_ui_with_layout(size, egui::Layout::left_to_right(egui::Align::Center), |ui| ui.add(row));
            if row.inner.on_hover_text(tip(panel.scene, known)).clicked() {
                *selected = Some(known.source);
            }
        });
    });
}

/// As rows and tips call it.
fn shown_name(known: &KnownLight) -> String {
    match known.source {
        LightSource::Sun => "Own sun".to_owned(),
        LightSource::Node(_) | LightSource::Added(_) => known.name.clone(),
    }
}

fn tip(scene: &Scene, known: &KnownLight) -> String {
    let kind = known.light.kind.name();
    match known.source {
        LightSource::Node(node) => format!("A {kind} light of the scene, carried by \"{}\".", scene.nodes[node].name),
        LightSource::Sun => "A sun beside the lights of the scene.".to_owned(),
        LightSource::Added(_) => format!("A {kind} light that is not in the file."),
    }
}

fn cause(shines: Shines) -> Option<&'static str> {
    match shines {
        Shines::Yes => None,
        Shines::Off => Some("off"),
        Shines::Black => Some("black"),
        Shines::Hidden => Some("hidden"),
        Shines::Nowhere => Some("nowhere"),
    }
}

fn switch_on(lighting: &mut Lighting, known: &KnownLight, on: bool) {
    match known.source {
        LightSource::Sun => lighting.sun.shines = if on { SunShines::Always } else { SunShines::Never },
        LightSource::Node(node) => lighting.edits.entry(node).or_insert(known.light).on = on,
        LightSource::Added(index) => {
            if let Some(added) = lighting.added.get_mut(index) {
                added.light.on = on;
            }
        }
    }
}

/// Adds, removes, and takes edits back.
fn add_ui(ui: &mut Ui, panel: LightPanel<'_>, lighting: &mut Lighting, selected: &mut Option<LightSource>) {
    ui.horizontal(|ui| {
        let is_full = lighting.added.len() >= Lighting::MAX_ADDED;
        ui.add_enabled_ui(!is_full, |ui| {
            let menu = ui.menu_button("Add light", |ui| {
                for (kind, name) in [
                    (LightKind::Directional, "Directional light"),
                    (LightKind::POINT, "Point light"),
                    (LightKind::SPOT, "Spot light"),
                ] {
                    if ui.button(name).clicked() {
                        let number = lighting.added.len();
                        lighting.added.push(at_camera(kind, lighting.free_name(), panel));
                        *selected = Some(LightSource::Added(number));
                    }
                }
            });
            menu.response.on_hover_text(
                "A light where the camera is, which shines where it looks: as bright there as the brightest that is there now.",
            );
        });
        match *selected {
            Some(LightSource::Added(index)) => remove_ui(ui, lighting, index, selected),
            Some(LightSource::Node(node)) => {
                let reset = ui.add_enabled(lighting.edits.contains_key(&node), Button::new("Reset light"));
                if reset.on_hover_text("As it is in the file.").clicked() {
                    lighting.edits.remove(&node);
                }
            }
            Some(LightSource::Sun) | None => {}
        }
    });
}

fn remove_ui(ui: &mut Ui, lighting: &mut Lighting, index: usize, selected: &mut Option<LightSource>) {
    // Undo may have taken it away.
    let is_there = index < lighting.added.len();
    if ui.add_enabled(is_there, Button::new("Remove light")).clicked() {
        lighting.added.remove(index);
        *selected = None;
    }
}

/// It brings to what is looked at as much as the brightest light that shines there, or as our sun would.
fn at_camera(kind: LightKind, name: String, panel: LightPanel<'_>) -> AddedLight {
    let camera = panel.camera;
    let direction = (camera.target - camera.eye).normalize_or(glam::DVec3::NEG_Y).to_array();
    let mut added = AddedLight { position: camera.eye.to_array(), direction, ..AddedLight::new(name, kind) };
    let lux = brightest_at(panel.known, camera.target).unwrap_or(LightEdit::DIRECTIONAL_LUX);
    added.light.intensity = match kind {
        LightKind::Directional => lux,
        LightKind::Point { .. } | LightKind::Spot { .. } => lux * camera.distance().powi(2),
    };
    added
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lights::known_lights;

    #[test]
    fn a_new_light_stands_at_the_camera_and_shines_where_it_looks() {
        let camera =
            OrbitCamera { eye: glam::DVec3::new(1.0, 5.0, 1.0), target: glam::DVec3::ONE, ..OrbitCamera::default() };
        let (lighting, scene) = (Lighting::default(), Scene::default());
        let lux = LightEdit::DIRECTIONAL_LUX;
        let sun = known_lights(&scene, &scene.pose(None, 0.0), &lighting, &[], false);
        for known in [&sun[..], &[]] {
            let panel = LightPanel { lighting: &lighting, scene: &scene, known, camera };
            let light = at_camera(LightKind::SPOT, "light 1".to_owned(), panel);
            assert_eq!((light.position, light.direction), ([1.0, 5.0, 1.0], [0.0, -1.0, 0.0]));
            // As bright as the sun, 4 away; the sun is tinted.
            assert!(light.light.on && (light.light.intensity / (16.0 * lux) - 1.0).abs() < 0.1, "{light:?}");
            let light = at_camera(LightKind::Directional, "light 2".to_owned(), panel);
            assert!((light.light.intensity / lux - 1.0).abs() < 0.1, "{light:?}");
        }
        let dim = AddedLight { position: [1.0, 2.0, 1.0], ..AddedLight::new("lamp".to_owned(), LightKind::POINT) };
        let mut lighting = Lighting { added: vec![dim], ..Lighting::default() };
        (lighting.sun.shines, lighting.added[0].light.intensity) = (SunShines::Never, 3.0);
        let known = known_lights(&scene, &scene.pose(None, 0.0), &lighting, &[], false);
        // Three candela, one away.
        let panel = LightPanel { lighting: &lighting, scene: &scene, known: &known, camera };
        assert_eq!(at_camera(LightKind::POINT, "light 3".to_owned(), panel).light.intensity, 48.0);
    }
}
