//! `octolume info`: what is in a scene, and what its octree holds.

use std::path::PathBuf;

use bytesize::ByteSize;
use clap::Args;
use octolume::engine::LevelReport;
use octolume::prepare::Prepared;
use octolume::scene::Warning;
use octolume::scene::bounds::Aabb;
use octolume::settings::{Settings, View};
use serde::Serialize;

use super::light_facts::{self, LightFacts};
use super::options::{Common, Moment};
use super::output;
use super::session::{NO_PICTURE, Session};
use super::usage::Usage;
use super::voxelized::Voxelized;

/// Says what is in a scene, what was repaired or left out, and what its octree holds
#[derive(Debug, Args)]
pub struct Info {
    /// A .gltf or .glb file, or the name of a built-in scene
    scene: PathBuf,
    /// Prints JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    moment: Moment,
    #[command(flatten)]
    common: Common,
}

#[derive(Serialize)]
struct Facts {
    name: String,
    triangles: usize,
    objects: usize,
    materials: usize,
    textures: usize,
    skins: usize,
    /// Nodes that are joints of a skin, each once.
    joints: usize,
    clips: Vec<ClipFacts>,
    /// Name of the clip that is all of them at once, where none moves what another does.
    clip_of_all: Option<String>,
    /// After all edits; our own sun is the last before those that were added.
    lights: Vec<LightFacts>,
    /// The file's scenes, and which of them is shown.
    scenes: Vec<String>,
    shown_scene: Option<usize>,
    extensions: Vec<String>,
    /// What opening the file took.
    memory_bytes: u64,
    warnings: Vec<String>,
    /// Over all animation, scene units; none for a scene without a vertex.
    bounds: Option<Bounds>,
    grid: u32,
    span: f64,
    grid_corner: [f64; 3],
    /// In the caches, all objects together.
    voxels: u64,
    /// What is voxelized every frame where other objects are moved.
    voxelized: Vec<Voxelized>,
    levels: Vec<LevelReport>,
}

#[derive(Serialize)]
struct ClipFacts {
    name: String,
    seconds: f64,
}

#[derive(Serialize)]
struct Bounds {
    min: [f64; 3],
    max: [f64; 3],
}

impl Info {
    pub fn run(&self) -> anyhow::Result<()> {
        let mut settings = self.common.settings()?;
        self.moment.apply(&mut settings);
        settings.method.look.view = View::Voxels;
        settings.check().map_err(Usage)?;
        let mut session = Session::open(&self.scene, &self.common, &mut settings)?;
        session.run(&settings, NO_PICTURE)?;
        let levels = session.engine.octree_report().map(|report| report.levels.clone()).unwrap_or_default();
        let lights = light_facts::lights(&session.prepared, &settings)?;
        let voxelized = Voxelized::list(&session);
        let facts = Facts::new(&session.prepared, &settings, (lights, voxelized, levels));
        if self.json { output::json(&facts) } else { output::result(&facts.text()) }
    }
}

impl Facts {
    fn new(
        prepared: &Prepared,
        settings: &Settings,
        (lights, voxelized, levels): (Vec<LightFacts>, Vec<Voxelized>, Vec<LevelReport>),
    ) -> Self {
        let scene = &prepared.scene;
        let objects = scene.objects();
        Self {
            name: scene.name.clone(),
            triangles: objects.iter().map(|object| scene.meshes[object.mesh].triangle_count()).sum(),
            objects: objects.len(),
            materials: scene.materials.len(),
            textures: scene.textures.len(),
            skins: scene.skins.len(),
            joints: scene.joint_count(),
            clips: scene
                .own_clips()
                .iter()
                .map(|clip| ClipFacts { name: clip.name.clone(), seconds: clip.duration_secs })
                .collect(),
            clip_of_all: scene.clip_of_all.map(|clip| scene.clips[clip].name.clone()),
            lights,
            scenes: scene.scene_names.clone(),
            shown_scene: scene.shown_scene,
            extensions: scene.extensions.clone(),
            memory_bytes: scene.memory_bytes,
            warnings: prepared.warnings.iter().map(Warning::to_string).collect(),
            bounds: prepared.reach.map(Bounds::from),
            grid: settings.method.discretization.grid,
            span: prepared.grid.span,
            grid_corner: prepared.grid.corner().to_array(),
            voxels: prepared.voxel_count(),
            voxelized,
            levels,
        }
    }

    fn text(&self) -> String {
        let mut lines = vec![
            format!("{}: {}, {}", self.name, count(self.triangles, "triangle"), count(self.objects, "object")),
            format!("{}, {}", count(self.materials, "material"), count(self.textures, "texture")),
            format!("{}, {}", count(self.skins, "skin"), count(self.joints, "joint")),
            format!("opening took {}", ByteSize(self.memory_bytes).display().iec()),
            format!("grid of {} cells of {} units, {} voxels in the caches", self.grid, self.span, self.voxels),
        ];
        lines.extend(self.clips.iter().map(|clip| format!("clip \"{}\", {:.3} s", clip.name, clip.seconds)));
        lines.extend(self.clip_of_all.iter().map(|name| format!("clip \"{name}\", of all these")));
        lines.extend(self.voxelized.iter().map(Voxelized::text));
        lines.extend(self.lights.iter().map(LightFacts::text));
        if !self.extensions.is_empty() {
            lines.push(format!("extensions: {}", self.extensions.join(", ")));
        }
        let rows = self.levels.iter().map(|level| {
            let bytes = ByteSize(level.bytes).display().iec().to_string();
            let counts = [u64::from(level.level), level.nodes, level.occupied, level.dummies];
            counts.iter().map(u64::to_string).chain([bytes]).collect()
        });
        lines.push(String::new());
        lines.push(output::table(&["level", "nodes", "occupied", "dummies", "bytes"], rows));
        lines.join("\n")
    }
}

/// "1 skin", "2 skins".
fn count(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

impl From<Aabb> for Bounds {
    fn from(bounds: Aabb) -> Self {
        Self { min: bounds.min.to_array(), max: bounds.max.to_array() }
    }
}
