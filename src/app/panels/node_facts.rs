//! What there is to know of one node: what it carries, how it moves, what hangs below it.

use egui::{Grid, RichText, Ui};

use super::light_editor::short_unit;
use super::tree_row::TreePanel;
use super::{fact, grouped};
use crate::app::outline;
use crate::app::palette::Tone;
use crate::prepare::PreparedObject;
use crate::scene::{Motion, Projection, Scene};

pub fn ui(ui: &mut Ui, panel: TreePanel<'_>, node: usize) {
    let scene = &panel.prepared.scene;
    ui.label(RichText::new(outline::name(scene, node)).color(Tone::Strong.of(ui)));
    Grid::new("node facts").num_columns(2).spacing([10.0, 2.0]).show(ui, |ui| {
        if let Some(mesh) = scene.nodes[node].mesh {
            mesh_ui(ui, scene, mesh);
        }
        match panel.outline.objects[node].map(|object| &panel.prepared.objects[object]) {
            Some(object) => object_ui(ui, panel, object),
            None if scene.nodes[node].mesh.is_some() => {
                fact(ui, "Voxels", "none", "Its matrix is singular at all times: there is nothing to voxelize.");
            }
            None => {}
        }
        carried_ui(ui, panel, node);
        below_ui(ui, panel, node);
    });
    for warning in panel.prepared.warnings.iter().filter(|warning| warning.nodes.binary_search(&node).is_ok()) {
        ui.label(RichText::new(&warning.sentence).color(Tone::Warning.of(ui)));
    }
}

fn mesh_ui(ui: &mut Ui, scene: &Scene, mesh: usize) {
    let mesh = &scene.meshes[mesh];
    let parts = mesh.primitives.len();
    let counts = format!("{} triangles in {parts} part{}", grouped(mesh.triangle_count() as u64), plural(parts));
    fact(ui, "Mesh", &mesh.name, "Its name in the file.");
    fact(ui, "Triangles", &counts, "A part is a primitive of the file: one material.");
    let mut materials: Vec<&str> = mesh
        .primitives
        .iter()
        .map(|primitive| primitive.material.map_or("default", |material| &scene.materials[material].name))
        .collect();
    materials.dedup();
    fact(ui, "Materials", &materials.join(", "), "In the order of its parts.");
}

fn object_ui(ui: &mut Ui, panel: TreePanel<'_>, object: &PreparedObject) {
    let cache = &panel.prepared.caches[object.cache];
    let users = panel.prepared.objects.iter().filter(|other| other.cache == object.cache).count();
    let voxels = match users {
        1 => grouped(cache.voxels.len() as u64),
        users => format!("{}, shared by {users} objects", grouped(cache.voxels.len() as u64)),
    };
    fact(ui, "Voxels", &voxels, "In its cache: objects of one mesh, stretch and span share theirs.");
    if cache.tiles.len() > 1 {
        fact(ui, "Tiles", &grouped(cache.tiles.len() as u64), "A tile is no longer than 1024 voxels.");
    }
    let motion = match object.object.motion {
        Motion::Static => "still".to_owned(),
        Motion::Rigid => "rigid, with its node".to_owned(),
        Motion::Skinned { skin } => {
            let skin = &panel.prepared.scene.skins[skin];
            format!("skinned by \"{}\", {} joint{}", skin.name, skin.joints.len(), plural(skin.joints.len()))
        }
    };
    fact(ui, "Moves", &motion, "What moves its voxels.");
    if let Some(why) = object.unmovable {
        fact(
            ui,
            "Voxelized",
            &why.to_string(),
            "Every frame, where stretching objects are not moved. Moved voxels come apart.",
        );
    }
    let stretch = object.object.stretch;
    if stretch != glam::DMat3::IDENTITY {
        let [x, y, z] = stretch.diagonal().to_array();
        let is_sheared = stretch != glam::DMat3::from_diagonal(stretch.diagonal());
        let sheared = if is_sheared { ", sheared" } else { "" };
        let text = format!("{x:.4} × {y:.4} × {z:.4}{sheared}");
        fact(ui, "Stretch", &text, "The mean over the clips, baked into the voxels: what is left to move is rigid.");
    }
}

/// What else the node is.
fn carried_ui(ui: &mut Ui, panel: TreePanel<'_>, node: usize) {
    let scene = &panel.prepared.scene;
    let skins: Vec<&str> =
        scene.skins.iter().filter(|skin| skin.joints.contains(&node)).map(|skin| &*skin.name).collect();
    if !skins.is_empty() {
        fact(ui, "Joint of", &skins.join(", "), "The skins whose vertices follow this node.");
    }
    if let Some(camera) = scene.nodes[node].camera {
        let kind = match scene.cameras[camera].projection {
            Projection::Perspective { fov_y_radians, .. } => format!("perspective, {:.1}°", fov_y_radians.to_degrees()),
            Projection::Orthographic { half_height, .. } => format!("orthographic, {:.3} high", 2.0 * half_height),
        };
        fact(ui, "Camera", &kind, "The View panel can take it.");
    }
    if let Some(light) = scene.nodes[node].light {
        let light = &scene.lights[light];
        let text = format!("{}, {} {}", light.kind.name(), light.intensity, short_unit(light.kind));
        fact(ui, "Light", &text, "As it is in the file; the Light panel can change it.");
    }
    let clips = scene.own_clips().iter().filter_map(|clip| {
        let properties: Vec<&str> = clip
            .channels
            .iter()
            .filter(|channel| channel.node == node)
            .map(|channel| channel.property.name())
            .collect();
        (!properties.is_empty()).then(|| format!("{}: {}", clip.name, properties.join(", ")))
    });
    let clips: Vec<String> = clips.collect();
    if !clips.is_empty() {
        fact(ui, "Animated", &clips.join("; "), "Clips that set this node's own transform.");
    }
}

fn below_ui(ui: &mut Ui, panel: TreePanel<'_>, node: usize) {
    let below = panel.outline.contents[node];
    if below.nodes > 1 {
        let text = format!("{} nodes, {} objects", grouped(below.nodes - 1), grouped(below.objects));
        fact(ui, "Below", &text, "Nodes below this one; objects are nodes with a mesh, this one included.");
        let text = format!("{} triangles, {} voxels", grouped(below.triangles), grouped(below.voxels));
        fact(ui, "Together", &text, "Of this node and all below it; instances count each.");
    }
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}
