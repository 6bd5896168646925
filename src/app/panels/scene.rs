//! Opening scenes, and what the open one holds.

use std::path::{Path, PathBuf};

use egui::{ComboBox, Grid, RichText, Ui, WidgetInfo};

use super::path_field::path_field;
use super::{bytes, fact, grouped, nothing};
use crate::app::command::Command;
use crate::app::folders;
use crate::app::loader::file_name;
use crate::app::palette::Tone;
use crate::data::voxel_cache::CacheVoxel;
use crate::prepare::Prepared;
use crate::scene::{Motion, Warning, builtin};

/// `path`: what is typed, and whether its field asks for it.
pub fn ui(ui: &mut Ui, scene: Option<&Prepared>, path: (&mut String, bool), recent: &[PathBuf]) -> Vec<Command> {
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

fn open_ui(ui: &mut Ui, (path, asks): (&mut String, bool), recent: &[PathBuf]) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.horizontal(|ui| {
        if ui.button("Choose…").on_hover_text("Opens the desktop's file dialog (Ctrl+O).").clicked() {
            commands.push(Command::ChooseFile);
        }
        commands.extend(recent_ui(ui, recent));
    });
    ui.horizontal(|ui| {
        let name = ui.label(RichText::new("Path").color(Tone::Weak.of(ui)));
        let width = ui.available_width() - 56.0;
        let entered = path_field(ui, "scene path", path, width).labelled_by(name.id);
        let entered = entered.on_hover_text("Path of a .gltf or .glb file, or of a picture of one; Enter opens it.");
        if asks {
            entered.request_focus();
        }
        let enter = entered.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
        let open = ui.add_enabled(!path.trim().is_empty(), egui::Button::new("Open"));
        if open.on_hover_text("Opens the file at this path.").clicked() || enter && !path.trim().is_empty() {
            commands.push(Command::Open(folders::typed(path)));
        }
    });
    commands
}

fn recent_ui(ui: &mut Ui, recent: &[PathBuf]) -> Vec<Command> {
    let mut commands = Vec::new();
    let menu = ui.menu_button("Recent", |ui| {
        for path in recent {
            commands.extend(recent_row_ui(ui, path));
        }
        ui.separator();
        for name in builtin::NAMES {
            if ui.button(format!("Built-in {name}")).clicked() {
                commands.push(Command::Open(PathBuf::from(name)));
            }
        }
    });
    menu.response.on_hover_text("Scenes opened last, and the built-in ones.");
    commands
}

/// A scene that was open, and a way to take it off the list.
fn recent_row_ui(ui: &mut Ui, path: &Path) -> Option<Command> {
    let (name, whole) = (file_name(path), path.display().to_string());
    let row = ui.horizontal(|ui| {
        let forget = ui.small_button("×").on_hover_text("Takes it off the list.");
        forget.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, format!("Forget {name}")));
        let open = ui.button(&name).on_hover_text(whole);
        (open.clicked(), forget.clicked())
    });
    match row.inner {
        (true, _) => Some(Command::Open(path.to_owned())),
        (_, true) => Some(Command::Forget(path.to_owned())),
        _ => None,
    }
}

/// Which scene of the file is shown, where it holds several.
fn scenes_ui(ui: &mut Ui, prepared: &Prepared) -> Option<Command> {
    let names = &prepared.scene.scene_names;
    let shown = prepared.scene.shown_scene.filter(|_| names.len() > 1)?;
    let mut chosen = shown;
    ui.horizontal(|ui| {
        let name = ui.label(RichText::new("Shown").color(Tone::Weak.of(ui)));
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
    ui.label(RichText::new("Warnings").color(Tone::Weak.of(ui)));
    if warnings.is_empty() {
        ui.label("none");
    } else {
        let count = RichText::new(format!("{}, see the log", warnings.len())).color(Tone::Warning.of(ui));
        ui.label(count).on_hover_text(warnings.iter().map(Warning::to_string).collect::<Vec<_>>().join("\n"));
    }
    ui.end_row();
}
