//! Options that subcommands share, and the settings they make.

use std::path::PathBuf;

use bytesize::ByteSize;
use clap::Args;
use octolume::disk_cache::DiskCache;
use octolume::export;
use octolume::scene::OrbitCamera;
use octolume::scene::load::{OpenOptions, SceneChoice};
use octolume::settings::VoxelizationMode;
use octolume::settings::{
    Discretization, Discretizer, Filter, Fit, JointWeights, NodeNames, Settings, Stretching, VoxelAnchor,
    VoxelizerCells,
};

use super::cone_options::ConeOptions;
use super::lighting_options::LightingOptions;
use super::usage::Usage;
use super::values;
use super::values::{FitChoice, set};

#[derive(Debug, Args)]
#[command(next_help_heading = "Common options")]
pub struct Common {
    /// Start from these settings: a JSON file, or a picture that Octolume wrote
    #[arg(long, value_name = "FILE.json|SHOT.png")]
    pub settings: Option<PathBuf>,
    /// Cells along an axis of the grid: 64, 128, 256, 512 or 1024; otherwise 128
    #[arg(long, value_name = "N")]
    grid: Option<u32>,
    /// Edge of a cell in scene units; otherwise as large as what the grid encloses asks for
    #[arg(long, value_name = "LENGTH", value_parser = values::number, allow_hyphen_values = true)]
    span: Option<f64>,
    /// What the grid encloses: everything at all times (scene), what is shown over the clip that is played, or at the
    /// moment alone (pose), what --only names (selection), or a box in scene units; otherwise clip. Small things far
    /// from the rest count for scene and selection only
    #[arg(long, value_name = "scene|clip|pose|selection|X,Y,Z:X,Y,Z", allow_hyphen_values = true)]
    fit: Option<FitChoice>,
    /// How a moved voxel falls into cells; otherwise split
    #[arg(long, value_name = "nearest|split", value_parser = values::name::<Filter>)]
    filter: Option<Filter>,
    /// How a triangle becomes voxels; otherwise thin
    #[arg(long, value_name = "thin|conservative", value_parser = values::name::<VoxelizationMode>)]
    mode: Option<VoxelizationMode>,
    /// Which joint weights a voxel of a skin gets: interpolated between corners, or those of the nearest one; otherwise
    /// interpolated
    #[arg(long, value_name = "interpolated|flat", value_parser = values::name::<JointWeights>)]
    weights: Option<JointWeights>,
    /// Which point of a voxel is moved; otherwise its centre
    #[arg(long, value_name = "centre|corner", value_parser = values::name::<VoxelAnchor>)]
    anchor: Option<VoxelAnchor>,
    /// Where the voxels of a frame come from: moved, or made anew from the posed triangles; otherwise transform
    #[arg(long, value_name = "transform|voxelize", value_parser = values::name::<Discretizer>)]
    discretizer: Option<Discretizer>,
    /// What is done with objects that stretch by half a cell or more, whose moved voxels come apart: moved all the same,
    /// or voxelized every frame beside the others; otherwise voxelize
    #[arg(long, value_name = "move|voxelize", value_parser = values::name::<Stretching>)]
    stretching: Option<Stretching>,
    /// How the voxelizer of posed triangles finds a cell's fragments: by a hash, or in a grid; otherwise sparse
    #[arg(long, value_name = "sparse|dense", value_parser = values::name::<VoxelizerCells>)]
    cells: Option<VoxelizerCells>,
    /// The octree's levels down to this one are stored densely; otherwise 6, and 5 in a grid of 64
    #[arg(long, value_name = "LEVEL")]
    dense_level: Option<u32>,
    /// Clip by name or number from 0, "" for the rest pose; otherwise the first
    #[arg(long, value_name = "NAME")]
    clip: Option<String>,
    /// Turns the whole scene about its centre after voxelization: degrees about x, y, z
    #[arg(long, value_name = "X,Y,Z", value_parser = values::vector, allow_hyphen_values = true)]
    turn: Option<[f64; 3]>,
    /// Where the camera is; otherwise a camera of the file shows the scene, or one that frames what is there as the clip begins
    #[arg(long, value_name = "X,Y,Z", value_parser = values::vector, allow_hyphen_values = true, requires = "target")]
    eye: Option<[f64; 3]>,
    /// What the camera looks at
    #[arg(long, value_name = "X,Y,Z", value_parser = values::vector, allow_hyphen_values = true, requires = "eye")]
    target: Option<[f64; 3]>,
    /// The camera's vertical field of view
    #[arg(long, value_name = "DEGREES", value_parser = values::number, allow_hyphen_values = true, requires = "eye")]
    fov: Option<f64>,
    /// Turns the camera about its line of sight, to the left
    #[arg(long, value_name = "DEGREES", value_parser = values::number, allow_hyphen_values = true, requires = "eye")]
    roll: Option<f64>,
    /// An orthographic view of this height, scene units
    #[arg(long, value_name = "HEIGHT", value_parser = values::number, allow_hyphen_values = true, requires = "eye", conflicts_with = "fov")]
    orthographic: Option<f64>,
    /// Which of the file's cameras is looked through, by name or number from 0, as the clip moves it
    #[arg(long, value_name = "NAME|NUMBER", conflicts_with = "eye")]
    camera: Option<String>,
    /// Hides nodes with everything below them, by name; all of the name if several have it. Repeatable
    #[arg(long, value_name = "NAME")]
    hide: Vec<String>,
    /// Shows only these nodes with everything below them, by name; all of the name if several have it. Repeatable
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// The first GPU adapter whose name contains this
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// Neither reads voxels from the disk cache nor keeps any there
    #[arg(long)]
    no_cache: bool,
    #[command(flatten)]
    opening: Opening,
    #[command(flatten)]
    lighting: LightingOptions,
    #[command(flatten)]
    cones: ConeOptions,
}

/// What of a file is opened, and at what price.
#[derive(Debug, Args)]
struct Opening {
    /// Which of the file's scenes is shown, by name or number from 0; otherwise its default scene
    #[arg(long = "scene", id = "shown scene", value_name = "NAME|NUMBER")]
    scene: Option<String>,
    /// What opening a file may take, such as 512MiB; otherwise 4GiB
    #[arg(long, value_name = "SIZE")]
    memory_budget: Option<ByteSize>,
}

/// Which moment of the animation, where there is just one.
#[derive(Debug, Args)]
pub struct Moment {
    /// Seconds into the clip
    #[arg(long, value_name = "SECONDS", value_parser = values::number, allow_hyphen_values = true)]
    pub time: Option<f64>,
}

impl Common {
    /// The settings file's, or the default ones, with every option given put over them.
    pub fn settings(&self) -> anyhow::Result<Settings> {
        let mut settings = self.settings_file()?;
        self.discretize(&mut settings.method.discretization)?;
        if self.clip.is_some() {
            settings.shot.motion.clip.clone_from(&self.clip);
        }
        set(&mut settings.shot.motion.turn_degrees, self.turn);
        if let Some(FitChoice(to)) = self.fit {
            settings.shot.fit = Fit { to, ..Fit::default() };
        }
        if let (Some(eye), Some(target)) = (self.eye, self.target) {
            let fov_y_degrees = self.fov.unwrap_or(OrbitCamera::default().fov_y_degrees);
            let seen = OrbitCamera::new(eye.into(), target.into(), fov_y_degrees);
            let (roll_degrees, orthographic_height) = (self.roll.unwrap_or_default(), self.orthographic);
            settings.shot.camera = Some(OrbitCamera { roll_degrees, orthographic_height, ..seen });
        }
        if self.camera.is_some() {
            (settings.shot.camera, settings.shot.file_camera) = (None, self.camera.clone());
        }
        self.lighting.apply(&mut settings.method.lighting);
        self.cones.apply(&mut settings.method.cone_tracing);
        Ok(settings)
    }

    /// How a file is opened.
    pub fn open_options(&self) -> OpenOptions {
        let mut options =
            OpenOptions { scene: self.opening.scene.clone().map(SceneChoice::Named), ..OpenOptions::default() };
        set(&mut options.memory_budget_bytes, self.opening.memory_budget.map(|size| size.0));
        options
    }

    /// Where voxels are kept from one opening to the next, if they are.
    pub fn disk_cache(&self) -> Option<DiskCache> {
        if self.no_cache { None } else { DiskCache::standard() }
    }

    /// The nodes and lights that options name: which they are depends on the scene.
    pub fn node_names(&self) -> NodeNames {
        NodeNames { hide: self.hide.clone(), only: self.only.clone(), lights: self.lighting.changes() }
    }

    /// The settings that the file named by `--settings` holds.
    fn settings_file(&self) -> anyhow::Result<Settings> {
        Ok(self.settings.as_deref().map(export::read_settings).transpose()?.unwrap_or_default())
    }

    fn discretize(&self, discretization: &mut Discretization) -> Result<(), Usage> {
        set(&mut discretization.grid, self.grid);
        set(&mut discretization.filter, self.filter);
        set(&mut discretization.mode, self.mode);
        set(&mut discretization.weights, self.weights);
        set(&mut discretization.anchor, self.anchor);
        set(&mut discretization.discretizer, self.discretizer);
        set(&mut discretization.stretching, self.stretching);
        set(&mut discretization.cells, self.cells);
        discretization.dense_level = self.dense_level.or(discretization.dense_level);
        discretization.span = self.span.or(discretization.span);
        discretization.check().map_err(Usage)?;
        match self.dense_level {
            Some(level) if level > discretization.deepest_dense() => Err(Usage(format!(
                "dense level {level} is not in 0 to {}: at a grid of {} the leaves are level {}",
                discretization.deepest_dense(),
                discretization.grid,
                discretization.depth()
            ))),
            _ => Ok(()),
        }
    }
}

impl Moment {
    pub fn apply(&self, settings: &mut Settings) {
        set(&mut settings.shot.motion.time_secs, self.time);
    }
}
