//! `octolume voxels`: the world's voxels as a file.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use octolume::data::grid::{Grid, morton_cell};
use octolume::data::world_voxels::WorldVoxels;
use octolume::export::{self, ExportError};
use octolume::prepare::{ExactVoxel, Stores};
use octolume::settings::{Settings, View};

use super::options::{Common, Moment};
use super::output;
use super::session::{NO_PICTURE, Session, prepare_only};
use super::usage::Usage;

/// Writes the cells of one moment with occupancy, albedo and normal, sorted by Morton key
#[derive(Debug, Args)]
pub struct Voxels {
    /// A .gltf or .glb file, or the name of a built-in scene
    scene: PathBuf,
    /// The file to write: .npz holds exact numbers, .ply suits viewers of point clouds
    #[arg(short, long, value_name = "OUT.npz|OUT.ply")]
    output: PathBuf,
    /// Voxels that were moved, or those of the posed mesh voxelized exactly
    #[arg(long, value_enum, default_value_t = Source::Moved)]
    source: Source,
    #[command(flatten)]
    moment: Moment,
    #[command(flatten)]
    common: Common,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Source {
    Moved,
    Exact,
}

type Write = fn(&Path, &WorldVoxels, &Grid) -> Result<(), ExportError>;

impl Voxels {
    pub fn run(&self) -> anyhow::Result<()> {
        let write = self.writer()?;
        let mut settings = self.common.settings()?;
        self.moment.apply(&mut settings);
        settings.method.look.view = View::Voxels;
        settings.check().map_err(Usage)?;
        let (voxels, grid) = match self.source {
            Source::Moved => {
                let mut session = Session::open(&self.scene, &self.common, &mut settings)?;
                session.run(&settings, NO_PICTURE)?;
                (session.engine.read_voxels()?, session.prepared.grid)
            }
            Source::Exact => self.exact(&mut settings)?,
        };
        write(&self.output, &voxels, &grid)?;
        Ok(())
    }

    fn exact(&self, settings: &mut Settings) -> anyhow::Result<(WorldVoxels, Grid)> {
        let disk = self.common.disk_cache();
        let stores = Stores { disk: disk.as_ref(), ..Stores::default() };
        let prepared = prepare_only(&self.scene, &self.common, stores, settings)?;
        let hidden = prepared.hidden(&settings.shot.visibility, &prepared.pose(&settings.shot.motion)?)?;
        let surface = output::with_progress("voxelizing the posed mesh", |progress| {
            prepared.exact_voxels(&settings.shot.motion, &hidden, progress)
        })?;
        output::warnings(prepared.past_clip(&settings.shot.motion));
        output::warnings(&surface.warnings);
        Ok((exact_cells(&surface.voxels), prepared.grid))
    }

    fn writer(&self) -> Result<Write, Usage> {
        match self.output.extension().and_then(|extension| extension.to_str()) {
            Some("npz") => Ok(export::write_npz),
            Some("ply") => Ok(export::write_ply),
            _ => Err(Usage(format!("{} ends in neither .npz nor .ply", self.output.display()))),
        }
    }
}

/// An exact cell is occupied as far as its surface covers it.
fn exact_cells(exact: &[ExactVoxel]) -> WorldVoxels {
    WorldVoxels {
        cells: exact.iter().map(|voxel| morton_cell(voxel.key).map(|c| c as i32)).collect(),
        occupancy: exact.iter().map(|voxel| voxel.coverage as f32).collect(),
        albedo: exact.iter().map(|voxel| voxel.albedo.map(|channel| channel as f32)).collect(),
        normal: exact.iter().map(|voxel| voxel.normal.as_vec3().to_array()).collect(),
    }
}
