//! What is drawn, and how it is coloured.

use egui::{Slider, Ui};

use super::{choice, control};
use crate::app::commands::Command;
use crate::scene::SceneCamera;
use crate::settings::{AlphaRule, ColorBy, Look, View};

/// `depth`: the octree's, so that the level slider ends at its leaves. `cameras`: those of the file.
pub fn ui(ui: &mut Ui, current: &Look, depth: u32, cameras: &[SceneCamera]) -> Vec<Command> {
    let mut look = *current;
    let mut commands = Vec::new();
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
    let voxels = look.view != View::Mesh;
    ui.add_enabled_ui(voxels, |ui| {
        level_ui(ui, &mut look, depth);
        let rules = [
            (AlphaRule::Paper, "Per voxel", "α once a visited voxel: the paper's rule."),
            (AlphaRule::Length, "By length", "1 − (1 − α)^(s/δ) for a path of length s."),
        ];
        choice(ui, "Alpha", "How much light a visited voxel stops.", &mut look.alpha, &rules);
    });
    color_ui(ui, &mut look);
    ui.horizontal(|ui| {
        ui.checkbox(&mut look.shaded, "Shaded")
            .on_hover_text("A headlight from the camera; off shows the bare colour.");
        ui.add_enabled_ui(voxels, |ui| {
            ui.checkbox(&mut look.voxel_edges, "Voxel edges").on_hover_text("Draws the edges of every voxel shown.")
        });
    });
    commands.extend(camera_ui(ui, current, cameras));
    if look != *current {
        commands.push(Command::Look(look));
    }
    commands
}

fn camera_ui(ui: &mut Ui, look: &Look, cameras: &[SceneCamera]) -> Option<Command> {
    let mut command = None;
    let shown = if look.camera.is_some() { "Free" } else { "All framed" };
    control(ui, "Camera", "Where the picture is taken from; drag in the view to move it.", |ui| {
        let combo = egui::ComboBox::from_id_salt("camera").width(110.0).selected_text(shown);
        let response = combo.show_ui(ui, |ui| {
            if ui.selectable_label(look.camera.is_none(), "Frame all").on_hover_text("Key F").clicked() {
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
    ];
    let shown = colors.iter().find(|color| color.0 == look.color).map_or("", |color| color.1);
    control(ui, "Colour", "What colours a voxel.", |ui| {
        let combo = egui::ComboBox::from_id_salt("color").width(110.0).selected_text(shown);
        combo
            .show_ui(ui, |ui| {
                for (color, name, tip) in colors {
                    ui.selectable_value(&mut look.color, color, name).on_hover_text(tip);
                }
            })
            .response
    });
}
