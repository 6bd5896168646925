//! What every subcommand that looks at a scene does first: open, voxelize, take a GPU.

use std::path::Path;
use std::sync::Arc;

use octolume::disk_cache::DiskCache;
use octolume::engine::Engine;
use octolume::experiment::Subject;
use octolume::gpu::Gpu;
use octolume::prepare::{Prepared, Stores, prepare_with};
use octolume::progress::Progress;
use octolume::scene::load::{self, OpenOptions};
use octolume::scene::{Scene, builtin};
use octolume::settings::Settings;
use octolume::stages::SHADERS;

use super::options::Common;
use super::output::{self, Told};

/// Shown when no scene is named.
pub const DEFAULT_SCENE: &str = "courtyard";

/// Picture size where nothing is looked at.
pub const NO_PICTURE: [u32; 2] = [1, 1];

/// An engine that holds a scene's voxels.
pub struct Session {
    pub prepared: Arc<Prepared>,
    pub engine: Engine,
    disk: Option<DiskCache>,
    told: Told,
}

impl Session {
    /// Opens and voxelizes a scene for the settings, and takes the adapter the options name. Which scene it is, and
    /// what the options hide, is added to the settings.
    pub fn open(scene: &Path, common: &Common, settings: &mut Settings) -> anyhow::Result<Self> {
        Self::open_with(scene, common, common.disk_cache(), settings)
    }

    /// The same, looking for voxels in `disk` alone.
    pub fn open_with(
        scene: &Path,
        common: &Common,
        disk: Option<DiskCache>,
        settings: &mut Settings,
    ) -> anyhow::Result<Self> {
        let mut engine = take_gpu(common)?;
        let room = engine.room();
        let stores = Stores { reuse: None, disk: disk.as_ref(), room: Some(&room) };
        let prepared = prepare_only(scene, common, stores, settings)?;
        engine.set_prepared(Some(Arc::clone(&prepared)));
        Ok(Self { prepared, engine, disk, told: Told::default() })
    }

    /// Voxelizes for other settings, keeping what still holds.
    pub fn voxelize_again(&mut self, settings: &Settings) -> anyhow::Result<()> {
        let room = self.engine.room();
        let stores = Stores { reuse: Some(&self.prepared), disk: self.disk.as_ref(), room: Some(&room) };
        self.prepared = voxelize(Arc::clone(&self.prepared.scene), settings, stores)?;
        self.engine.set_prepared(Some(Arc::clone(&self.prepared)));
        Ok(())
    }

    /// Where voxels and traced pictures are kept, if they are.
    pub fn disk(&self) -> Option<&DiskCache> {
        self.disk.as_ref()
    }

    /// Builds and draws what the settings ask for.
    pub fn run(&mut self, settings: &Settings, image_size_px: [u32; 2]) -> anyhow::Result<()> {
        self.engine.request(settings, image_size_px)?;
        self.told.tell(&self.engine.left_out());
        Ok(self.engine.run_to_end()?)
    }

    /// Voxelizes the posed mesh exactly: the truth for ghost and accuracy.
    pub fn take_exact(&mut self, settings: &Settings) -> anyhow::Result<()> {
        let prepared = &self.prepared;
        let hidden = prepared.hidden(&settings.shot.visibility, &prepared.pose(&settings.shot.motion)?)?;
        let exact = output::with_progress("voxelizing the posed mesh", |progress| {
            prepared.exact(&settings.shot.motion, &hidden, progress)
        })?;
        output::warnings(&exact.warnings);
        self.engine.offer_exact(Arc::new(exact));
        Ok(())
    }

    /// The scene for an experiment, which has an engine of its own on the same GPU.
    pub fn subject(&self, settings: &Settings, runs: u32) -> Subject {
        Subject { prepared: Arc::clone(&self.prepared), settings: settings.clone(), runs }
    }
}

/// Opens and voxelizes a scene, and says what there is to know about it. Which it is, what the options hide, and
/// the lights they change, are added to the settings.
pub fn prepare_only(
    scene: &Path,
    common: &Common,
    stores: Stores,
    settings: &mut Settings,
) -> anyhow::Result<Arc<Prepared>> {
    let scene = open_scene(scene, &common.open_options())?;
    settings.shot.scene = Some(scene.identity());
    let names = common.node_names();
    output::warnings(&names.apply(&scene, &mut settings.shot.visibility)?);
    if names.choose_nodes() {
        settings.shot.fit.counted.clone_from(&settings.shot.visibility);
    }
    output::warnings(&names.change_lights(&scene, &mut settings.method.lighting)?);
    settings.shot.visibility.shown_nodes(&scene)?;
    let prepared = voxelize(Arc::new(scene), settings, stores)?;
    prepared.camera_index(&settings.shot)?;
    output::warnings(&prepared.warnings);
    if stores.disk.is_some() {
        output::message(&format!("{}, in {:.0} ms", prepared.origins, prepared.voxelize_ms));
    }
    Ok(prepared)
}

/// Opens a built-in scene by its name, or a file.
fn open_scene(scene: &Path, options: &OpenOptions) -> anyhow::Result<Scene> {
    let progress = Progress::default();
    let name = scene.to_str().unwrap_or_default();
    Ok(match builtin::bytes(name) {
        Some(bytes) => load::open_bytes(name, bytes, None, &progress)?,
        None => output::with_progress("opening", |progress| load::open_with(scene, options, progress))?,
    })
}

fn take_gpu(common: &Common) -> anyhow::Result<Engine> {
    let gpu = Gpu::headless(&SHADERS, common.adapter.as_deref())?;
    output::warnings(gpu.warnings());
    Ok(Engine::new(Arc::new(gpu)))
}

fn voxelize(scene: Arc<Scene>, settings: &Settings, stores: Stores) -> anyhow::Result<Arc<Prepared>> {
    let prepared = output::with_progress("voxelizing", |progress| prepare_with(scene, settings, stores, progress));
    Ok(Arc::new(prepared?))
}
