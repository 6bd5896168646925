//! What is drawn, and how it is coloured.

use egui::{Slider, Ui};

use super::{choice, control, list, slice, slider, surfaces};
use crate::app::command::Command;
use crate::scene::SceneCamera;
use crate::settings::{AlphaRule, ColorBy, Look, View};

/// What there is to look at.
#[derive(Clone, Copy)]
pub struct ViewPanel<'a> {
    pub look: &'a Look,
    /// The octree's, so that the level slider ends at its leaves.
    pub depth: u32,
    /// The camera is set; otherwise it frames everything.
    pub is_camera_free: bool,
    /// Those of the file.
    pub cameras: &'a [SceneCamera],
    /// Names of those that have a shadow map, in the shadow map view.
    pub lights: &'a [String],
    /// What light was multiplied by in the last picture.
    pub exposure: f64,
}

pub fn ui(ui: &mut Ui, panel: ViewPanel<'_>) -> Vec<Command> {
    let mut look = *panel.look;
    let mut commands = Vec::new();
    view_ui(ui, &mut look);
    match look.view {
        View::Slice => slice::ui(ui, &mut look.slice),
        View::ShadowMap => shadow_map_ui(ui, &mut look, panel.lights),
        View::Voxels | View::Mesh | View::Ghost => surface_ui(ui, &mut look, panel.depth),
        View::Surfaces => surfaces::ui(ui, &mut look),
    }
    let is_exposed = match look.view {
        View::Voxels => look.color.is_light(),
        View::Surfaces => look.surface.is_light(),
        View::Mesh | View::Ghost | View::Slice | View::ShadowMap => false,
    };
    if is_exposed {
        exposure_ui(ui, &mut look, panel.exposure);
    }
    commands.extend(camera_ui(ui, panel.is_camera_free, panel.cameras));
    if look != *panel.look {
        commands.push(Command::Look(look));
    }
    commands
}

fn view_ui(ui: &mut Ui, look: &mut Look) {
    let views = [
        (View::Voxels, "Voxels", "The octree, ray-marched with occupancy as alpha."),
        (View::Mesh, "Mesh", "The posed triangles from the same camera; builds no octree."),
        (
            View::Ghost,
            "Ghost",
            "Exact voxels of the posed mesh over the moved ones: holes red, spill blue. Voxelizes every pose on the CPU.",
        ),
    ];
    choice(ui, "Show", "What the picture shows.", &mut look.view, &views);
    let views = [
        (View::Slice, "Slice", "A plane through the octree, sampled, in the colours of a scale."),
        (View::ShadowMap, "Shadow map", "What a light sees: distances from it, near ones bright."),
        (View::Surfaces, "Surfaces", "The posed triangles in direct light and in what cones bring, or a part of that."),
    ];
    choice(ui, "", "What the picture shows.", &mut look.view, &views);
}

/// Voxels or triangles.
fn surface_ui(ui: &mut Ui, look: &mut Look, depth: u32) {
    let voxels = look.view != View::Mesh;
    ui.add_enabled_ui(voxels, |ui| {
        level_ui(ui, look, depth);
        let rules = [
            (AlphaRule::Paper, "Per voxel", "α once a visited voxel: the paper's rule."),
            (AlphaRule::Length, "By length", "1 − (1 − α)^(s/δ) for a path of length s."),
        ];
        choice(ui, "Alpha", "How much light a visited voxel stops.", &mut look.alpha, &rules);
    });
    color_ui(ui, look);
    ui.horizontal(|ui| {
        ui.checkbox(&mut look.shaded, "Shaded")
            .on_hover_text("A headlight from the camera; off shows the bare colour.");
        ui.add_enabled_ui(voxels, |ui| {
            ui.checkbox(&mut look.voxel_edges, "Voxel edges").on_hover_text("Draws the edges of every voxel shown.")
        });
    });
}

/// `factor`: the one of the last picture, which is what "auto" has chosen.
fn exposure_ui(ui: &mut Ui, look: &mut Look, factor: f64) {
    let mut automatic = look.exposure_stops.is_none();
    let mut stops = look.exposure_stops.unwrap_or(factor.log2());
    let tip = "Light is multiplied by 2 to this before it is shown. Auto: what its mean asks for.";
    control(ui, "Exposure", tip, |ui| {
        // All of it in one row of the panel, however many digits there are.
        ui.spacing_mut().slider_width = 36.0;
        let slider = slider(&mut stops, Look::EXPOSURE_STOPS).max_decimals(1);
        let response = ui.add_enabled(!automatic, slider);
        ui.checkbox(&mut automatic, "Auto exposure").on_hover_text(tip);
        response
    });
    look.exposure_stops = (!automatic).then_some(stops);
}

fn shadow_map_ui(ui: &mut Ui, look: &mut Look, lights: &[String]) {
    control(ui, "Map of", "Whose shadow map is shown.", |ui| {
        let name = |light: usize| lights.get(light).map_or("none shines", String::as_str);
        let combo = egui::ComboBox::from_id_salt("light").width(150.0).selected_text(name(look.shadow_map));
        let list = combo.show_ui(ui, |ui| {
            for (number, name) in lights.iter().enumerate() {
                ui.selectable_value(&mut look.shadow_map, number, format!("{number}: {name}"));
            }
        });
        list.response
    });
}

fn camera_ui(ui: &mut Ui, is_free: bool, cameras: &[SceneCamera]) -> Option<Command> {
    let mut command = None;
    let shown = if is_free { "Free" } else { "All framed" };
    control(ui, "Camera", "Where the picture is taken from; drag in the view to move it.", |ui| {
        let combo = egui::ComboBox::from_id_salt("camera").width(110.0).selected_text(shown);
        let response = combo.show_ui(ui, |ui| {
            if ui.selectable_label(!is_free, "Frame all").on_hover_text("Key F").clicked() {
                command = Some(Command::FrameAll);
            }
            for (index, camera) in cameras.iter().enumerate() {
                if ui.selectable_label(false, format!("From \"{}\"", camera.name)).clicked() {
                    command = Some(Command::SceneCamera(index));
                }
            }
        });
        response.response
    });
    command
}

fn level_ui(ui: &mut Ui, look: &mut Look, depth: u32) {
    let mut level = look.level.unwrap_or(depth).min(depth);
    let name = move |level: f64, _| if level as u32 >= depth { "leaves".to_owned() } else { format!("{level}") };
    let slider = Slider::new(&mut level, 0..=depth).custom_formatter(name);
    let tip = "Octree level shown: 0 is the root. Costs nothing to change but the picture.";
    if control(ui, "Level", tip, |ui| ui.add(slider)).changed() {
        look.level = (level < depth).then_some(level);
    }
}

fn color_ui(ui: &mut Ui, look: &mut Look) {
    let colors = [
        (ColorBy::Albedo, "Albedo", "Base colour, averaged over a voxel."),
        (ColorBy::Normal, "Normal", "x, y, z as red, green, blue."),
        (ColorBy::Occupancy, "Occupancy", "How much of a voxel is filled, 0 to 1."),
        (ColorBy::Object, "Object", "The object with most voxels in the leaf. Runs a pass of its own."),
        (ColorBy::Level, "Octree level", "The level of the node drawn."),
        (ColorBy::Radiance, "Radiance", "The light that leaves a voxel, what it emits included."),
        (ColorBy::Irradiance, "Irradiance", "The light that arrives at a voxel."),
    ];
    list(ui, "Colour", "What colours a voxel.", &mut look.color, &colors);
}
