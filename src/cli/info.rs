//! `octolume info`: what is in a scene, and what its octree holds.

use std::path::PathBuf;

use bytesize::ByteSize;
use clap::Args;
use octolume::engine::LevelReport;
use octolume::settings::{Settings, View};
use serde::Serialize;

use super::options::{Common, Moment};
use super::session::Session;
use super::{Usage, output};

/// Nothing is looked at.
const SIZE_PX: [u32; 2] = [1, 1];

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
    triangles: u64,
    objects: usize,
    meshes: usize,
    materials: usize,
    textures: usize,
    skins: usize,
    joints: usize,
    clips: Vec<ClipFacts>,
    extensions: Vec<String>,
    warnings: Vec<String>,
    /// Posed, scene units; `None` for a scene without a vertex.
    bounds: Option<Bounds>,
    grid: u32,
    span: f64,
    grid_corner: [f64; 3],
    /// World voxels inside the grid.
    voxels: u64,
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
