//! `octolume voxels`: the world's voxels as a file.

use std::path::PathBuf;

use anyhow::bail;
use clap::{Args, ValueEnum};
use octolume::export;
use octolume::settings::View;

use super::Usage;
use super::options::{Common, Moment};
use super::session::Session;

/// Nothing is looked at.
const SIZE_PX: [u32; 2] = [1, 1];

/// Writes the cells of one moment with occupancy, albedo and normal, sorted by Morton key
#[derive(Debug, Args)]
pub struct Voxels {
    /// A .gltf or .glb file, or the name of a built-in scene
    scene: PathBuf,
    /// The file to write: .npz for exact numbers, .ply for viewers of points
    #[arg(short, long, value_name = "OUT.ply|OUT.npz", value_parser = format_of)]
    output: Output,
    /// Voxels that were moved, or those of the posed mesh voxelized exactly
    #[arg(long, value_enum, default_value_t = Source::Moved)]
    source: Source,
    #[command(flatten)]
    moment: Moment,
    #[command(flatten)]
    common: Common,
}
