//! What is drawn, and how it is coloured.

use egui::{Slider, Ui};

use super::{choice, control, list, number, slice, slider, surfaces, switch};
use crate::app::command::Command;
use crate::scene::{OrbitCamera, SceneCamera};
use crate::settings::{AlphaRule, ColorBy, Look, View};

/// What there is to look at.
#[derive(Clone, Copy)]
pub struct ViewPanel<'a> {
    pub look: &'a Look,
    /// The octree's, so that the level slider ends at its leaves.
    pub depth: u32,
    pub camera: CameraChoice<'a>,
    /// What that sees now.
    pub seen: OrbitCamera,
    /// Those of the file.
    pub cameras: &'a [SceneCamera],
    /// Names of those that have a shadow map, in the shadow map view.
    pub lights: &'a [String],
    /// What light was multiplied by in the last picture.
    pub exposure: f64,
}

/// Where the picture is taken from.
#[derive(Clone, Copy, PartialEq)]
pub enum CameraChoice<'a> {
    Framed,
    /// Set by hand.
    Free,
    OfFile(&'a str),
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
    if look.is_exposed() {
        exposure_ui(ui, &mut look, panel.exposure);
    }
    commands.extend(camera_ui(ui, panel.camera, panel.cameras));
    commands.extend(lens_ui(ui, panel.seen));
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
    let tip = "Light is multiplied by 2 to this before it is shown. Auto: so that one lit pixel in twenty is nearly white, \
               or the mean of voxels grey; while a clip plays it stays. Without Auto it is locked as it is.";
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

fn camera_ui(ui: &mut Ui, chosen: CameraChoice, cameras: &[SceneCamera]) -> Option<Command> {
    let mut command = None;
    let shown = match chosen {
        CameraChoice::Framed => "All framed".to_owned(),
        CameraChoice::Free => "Free".to_owned(),
        CameraChoice::OfFile(name) => from(name),
    };
    let tip =
        "Where the picture is taken from; drag in the view to move it. One of the file goes where the clip moves it.";
    control(ui, "Camera", tip, |ui| {
        let combo = egui::ComboBox::from_id_salt("camera").width(110.0).truncate().selected_text(shown);
        let response = combo.show_ui(ui, |ui| {
            let is_framed = chosen == CameraChoice::Framed;
            if ui.selectable_label(is_framed, "Frame all").on_hover_text("Double click in the view").clicked() {
                command = Some(Command::FrameAll);
            }
            for (index, camera) in cameras.iter().enumerate() {
                let is_chosen = chosen == CameraChoice::OfFile(&camera.name);
                if ui.selectable_label(is_chosen, from(&camera.name)).clicked() {
                    command = Some(Command::SceneCamera(index));
                }
            }
        });
        response.response
    });
    command
}

/// Perspective or not, and the roll.
fn lens_ui(ui: &mut Ui, seen: OrbitCamera) -> Option<Command> {
    let mut camera = seen;
    let mut orthographic = seen.orthographic_height.is_some();
    let tip = "How places become pixels. Costs nothing; orthographic shows equal sizes at every distance.";
    control(ui, "Lens", tip, |ui| {
        let lenses = [(false, "Perspective", tip), (true, "Ortho", tip)];
        let row = ui.horizontal(|ui| {
            if switch(ui, &mut orthographic, &lenses) {
                camera.set_orthographic(orthographic);
            }
            let roll = number(&mut camera.roll_degrees, -180.0..=180.0).speed(0.5).max_decimals(1).suffix("°");
            ui.add(roll).on_hover_text("Roll: turns the camera about its line of sight, to the left.");
        });
        row.response
    });
    (camera != seen).then_some(Command::Camera(camera))
}

fn from(name: &str) -> String {
    format!("From \"{name}\"")
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
