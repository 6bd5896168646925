//! Opening scenes, and what the open one holds.

use std::path::PathBuf;

use egui::{ComboBox, Grid, RichText, TextEdit, Ui};

use super::{bytes, fact, grouped, nothing};
use crate::app::command::Command;
use crate::app::loader::file_name;
use crate::app::theme;
use crate::data::voxel_cache::CacheVoxel;
use crate::prepare::Prepared;
use crate::scene::{Motion, Warning, builtin};

pub fn ui(ui: &mut Ui, scene: Option<&Prepared>, path: &mut String, recent: &[PathBuf]) -> Vec<Command> {
    let mut commands = open_ui(ui, path, recent);
    match scene {
        Some(prepared) => {
            commands.extend(scenes_ui(ui, prepared));
            facts_ui(ui, prepared);
        }
        None => nothing(ui, "No scene is open. Drop a .gltf or .glb file here."),
    }
    commands.dedup();
    commands
}

fn open_ui(ui: &mut Ui, path: &mut String, recent: &[PathBuf]) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.horizontal(|ui| {
        if ui.button("Choose…").on_hover_text("Opens the desktop's file dialog (Ctrl+O).").clicked() {
            commands.push(Command::ChooseFile);
        }
        commands.extend(recent_ui(ui, recent));
    });
    ui.horizontal(|ui| {
        let name = ui.label(RichText::new("Path").color(theme::WEAK));
        let width = ui.available_width() - 56.0;
        let field = TextEdit::singleline(path).hint_text("a .gltf or .glb file").desired_width(width);
        let entered = ui.add(field).labelled_by(name.id).on_hover_text("Path of a scene; Enter opens it.");
        let enter = entered.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
        let open = ui.add_enabled(!path.trim().is_empty(), egui::Button::new("Open"));
        if open.on_hover_text("Opens the file at this path.").clicked() || enter && !path.trim().is_empty() {
            commands.push(Command::Open(PathBuf::from(path.trim())));
        }
    });
    commands
}

fn recent_ui(ui: &mut Ui, recent: &[PathBuf]) -> Vec<Command> {
    let mut commands = Vec::new();
    let menu = ui.menu_button("Recent", |ui| {
        for path in recent {
            if ui.button(file_name(path)).on_hover_text(path.display().to_string()).clicked() {
                commands.push(Command::Open(path.clone()));
            }
        }
        ui.separator();
        for name in builtin::NAMES {
            if ui.button(format!("Built-in {name}")).clicked() {
                commands.push(Command::Open(PathBuf::from(name)));
            }
        }
    });
    menu.response.on_hover_text("Scenes opened since the start, and the built-in ones.");
    commands
}

/// Which scene of the file is shown, where it holds several.
fn scenes_ui(ui: &mut Ui, prepared: &Prepared) -> Option<Command> {
    let names = &prepared.scene.scene_names;
    let shown = prepared.scene.shown_scene.filter(|_| names.len() > 1)?;
    let mut chosen = shown;
    ui.horizontal(|ui| {
        let name = ui.label(RichText::new("Shown").color(theme::WEAK));
        let combo = ComboBox::from_id_salt("scene of the file").selected_text(&names[shown]);
        let combo = combo.show_ui(ui, |ui| {
            for (number, name) in names.iter().enumerate() {
                ui.selectable_value(&mut chosen, number, name);
            }
        });
        combo.response.labelled_by(name.id).on_hover_text("The file holds several scenes; this one is shown.");
    });
    (chosen != shown).then_some(Command::ShowScene(chosen))
}

fn facts_ui(ui: &mut Ui, prepared: &Prepared) {
    let scene = &prepared.scene;
    let count = |wanted: fn(&Motion) -> bool| {
        prepared.objects.iter().filter(|object| wanted(&object.object.motion)).count() as u64
    };
    let triangles: usize =
        prepared.objects.iter().map(|object| scene.meshes[object.object.mesh].triangle_count()).sum();
    let cached: u64 = prepared.caches.iter().map(|cache| cache.voxels.len() as u64).sum();
    let cache_bytes = cached * size_of::<CacheVoxel>() as u64;
    let size = prepared.bounds.map_or("nothing to see".to_owned(), |bounds| {
        let size = bounds.size();
        format!("{:.3} × {:.3} × {:.3}", size.x, size.y, size.z)
    });
    Grid::new("scene facts").num_columns(2).spacing([10.0, 2.0]).show(ui, |ui| {
        let objects = format!(
            "{} ({} static, {} rigid, {} skinned)",
            grouped(prepared.objects.len() as u64),
            count(|motion| *motion == Motion::Static),
            count(|motion| *motion == Motion::Rigid),
            count(|motion| matches!(motion, Motion::Skinned { .. })),
        );
        fact(ui, "Objects", &objects, "Nodes with a mesh, by how they move.");
        fact(ui, "Triangles", &grouped(triangles as u64), "Of all objects; instances count each.");
        let counts = [(scene.skins.len(), "skin"), (scene.joint_count(), "joint"), (scene.own_clips().len(), "clip")];
        let motion =
            counts.map(|(count, name)| format!("{count} {name}{}", if count == 1 { "" } else { "s" })).join(", ");
        fact(ui, "Motion", &motion, "Skeletons that move meshes, and animations of the file.");
        fact(ui, "Size", &size, "Posed bounds over all animation, in scene units.");
        let caches = format!("{}, {}, {:.0} ms", grouped(cached), bytes(cache_bytes), prepared.voxelize_ms);
        let tip = "Voxels of all caches (objects of one mesh and stretch share theirs), their memory, \
                   and the time on the CPU of the last voxelization: once per grid, span and mode.";
        fact(ui, "Caches", &caches, tip);
        warnings_ui(ui, &prepared.warnings);
    });
}

fn warnings_ui(ui: &mut Ui, warnings: &[Warning]) {
    ui.label(RichText::new("Warnings").color(theme::WEAK));
    if warnings.is_empty() {
        ui.label("none");
    } else {
        let count = RichText::new(format!("{}, see the log", warnings.len())).color(theme::WARNING);
        ui.label(count).on_hover_text(warnings.iter().map(Warning::to_string).collect::<Vec<_>>().join("\n"));
    }
    ui.end_row();
}
