//! Opens scenes and voxelizes them while the window goes on showing the scene before. One job at a
//! time: a new one cancels the old one.

use std::path::Path;
use std::sync::Arc;

use super::background::{Background, Outcome};
use super::outline::Outline;
use crate::disk_cache::DiskCache;
use crate::prepare::{Preparation, PrepareError, Prepared, Room, Stores, prepare_with};
use crate::progress::Progress;
use crate::scene::load::{self, LoadError, OpenOptions, SceneChoice};
use crate::scene::{Scene, builtin};

/// A scene ready to be shown, and what it was made for.
#[derive(Clone)]
pub struct Ready {
    pub prepared: Arc<Prepared>,
    pub outline: Arc<Outline>,
    pub preparation: Preparation,
    /// Another scene than before, not another grid for the same one.
    pub is_new: bool,
}

pub struct Loader {
    options: OpenOptions,
    disk: Option<DiskCache>,
    room: Room,
    job: Option<Job>,
}

struct Job {
    /// For the person: what is going on.
    title: String,
    preparation: Preparation,
    opens: bool,
    work: Background<Result<Ready, Failure>>,
}

enum Failure {
    Cancelled,
    /// One sentence.
    Cause(String),
}

impl Loader {
    /// How files are opened, where voxels are kept, and what they must fit.
    pub fn new(options: OpenOptions, disk: Option<DiskCache>, room: Room) -> Self {
        Self { options, disk, room, job: None }
    }

    /// Where what takes long is kept.
    pub fn disk(&self) -> Option<&DiskCache> {
        self.disk.as_ref()
    }

    /// What [`Self::new`] was given by a person.
    pub fn choices(&self) -> (OpenOptions, Option<DiskCache>) {
        (self.options.clone(), self.disk.clone())
    }

    /// Opens a file, or a built-in scene by its name; of several scenes in a file the default one,
    /// or the one that is chosen.
    pub fn open(&mut self, ctx: &egui::Context, source: &Path, shown: Option<SceneChoice>, preparation: Preparation) {
        let source = source.to_owned();
        let title = format!("Opening {}", file_name(&source));
        let options = OpenOptions { scene: shown, ..self.options.clone() };
        let (disk, room, wanted) = (self.disk.clone(), self.room.clone(), preparation.clone());
        let work = Background::start(ctx, move |progress| {
            let scene = Arc::new(open_scene(&source, &options, progress)?);
            voxelize(scene, wanted, Stores { reuse: None, disk: disk.as_ref(), room: Some(&room) }, progress)
        });
        self.job = Some(Job { title, preparation, opens: true, work });
    }

    /// Voxelizes an open scene for another grid, span, mode, clip or fit. What is under way for another moment of the
    /// same is finished first: while a clip plays, nothing begun anew every frame would ever be shown.
    pub fn discretize(&mut self, ctx: &egui::Context, open: &Arc<Prepared>, preparation: Preparation) {
        if self.job.as_ref().is_some_and(|job| job.preparation.same_but_for_its_moment(&preparation)) {
            return;
        }
        let open = Arc::clone(open);
        let title = format!("Voxelizing at {0}³", preparation.discretization.grid);
        let (disk, room, wanted) = (self.disk.clone(), self.room.clone(), preparation.clone());
        let work = Background::start(ctx, move |progress| {
            let stores = Stores { reuse: Some(&open), disk: disk.as_ref(), room: Some(&room) };
            voxelize(Arc::clone(&open.scene), wanted, stores, progress)
        });
        self.job = Some(Job { title, preparation, opens: false, work });
    }

    pub fn cancel(&mut self) {
        self.job = None;
    }

    /// What is going on, and how far it is.
    pub fn progress(&self) -> Option<(&str, f32)> {
        self.job.as_ref().map(|job| (job.title.as_str(), job.work.fraction()))
    }

    /// A scene is being opened, which will replace the one that is open.
    pub fn is_opening(&self) -> bool {
        self.job.as_ref().is_some_and(|job| job.opens)
    }

    /// The result, once; an error is one sentence.
    pub fn poll(&mut self) -> Option<Result<Ready, String>> {
        let outcome = match self.job.as_ref()?.work.poll() {
            Outcome::Running => return None,
            outcome => outcome,
        };
        let title = self.job.take()?.title;
        match outcome {
            Outcome::Done(Ok(ready)) => Some(Ok(ready)),
            Outcome::Done(Err(Failure::Cause(cause))) => Some(Err(cause)),
            Outcome::Died => Some(Err(format!("{title}: the work ended unexpectedly"))),
            Outcome::Done(Err(Failure::Cancelled)) | Outcome::Running => None,
        }
    }
}

/// The file's name, or all of a path that has none.
pub fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

fn open_scene(source: &Path, options: &OpenOptions, progress: &Progress) -> Result<Scene, Failure> {
    let opened = match source.to_str().and_then(builtin::bytes) {
        Some(bytes) => load::open_bytes(&file_name(source), bytes, None, progress),
        None => load::open_with(source, options, progress),
    };
    opened.map_err(|error| match error {
        LoadError::Cancelled { .. } => Failure::Cancelled,
        error => Failure::Cause(error.to_string()),
    })
}

fn voxelize(
    scene: Arc<Scene>,
    preparation: Preparation,
    stores: Stores<'_>,
    progress: &Progress,
) -> Result<Ready, Failure> {
    match prepare_with(scene, preparation.clone(), stores, progress) {
        Ok(prepared) => {
            let outline = Arc::new(Outline::new(&prepared));
            Ok(Ready { prepared: Arc::new(prepared), outline, preparation, is_new: stores.reuse.is_none() })
        }
        Err(PrepareError::Cancelled(_)) => Err(Failure::Cancelled),
        Err(error) => Err(Failure::Cause(error.to_string())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prepare::prepare;
    use crate::settings::FitTo;

    #[test]
    fn a_grid_of_one_moment_is_finished_while_others_are_asked_for() {
        let moment = |time_secs: f64| {
            let mut preparation = Preparation::default();
            (preparation.fit.to, preparation.motion.time_secs) = (FitTo::Pose, time_secs);
            preparation
        };
        let prepared = prepare(Arc::new(Scene::default()), moment(0.0), None, &Progress::default());
        let prepared = Arc::new(prepared.expect("nothing to voxelize"));
        let mut loader =
            Loader::new(OpenOptions::default(), None, Room { adapter: "test".to_owned(), buffer_bytes: u64::MAX });
        let mut begun = |preparation: &Preparation| {
            loader.discretize(&egui::Context::default(), &prepared, preparation.clone());
            loader.job.as_ref().map(|job| job.preparation.clone())
        };
        let first = moment(1.0);
        assert_eq!(begun(&first).as_ref(), Some(&first));
        assert_eq!(begun(&moment(2.0)).as_ref(), Some(&first), "a clip plays");
        let mut coarser = moment(3.0);
        coarser.discretization.grid = 64;
        assert_eq!(begun(&coarser).as_ref(), Some(&coarser), "another grid does not wait");
    }
}
