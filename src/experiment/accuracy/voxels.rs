//! Holes and spill of moved voxels, nearest and split, against the posed mesh voxelized exactly.
//!
//! *Holes* are cells of the exact posed voxelization that no moved voxel reached; *spill* is cells
//! that only moved voxels reached.

use std::sync::Arc;

use super::{picture_stem, posed};
use crate::engine::FilterReport;
use crate::experiment::board::Share;
use crate::experiment::frames::{Forget, Frames};
use crate::experiment::lab::{Lab, NO_PICTURE};
use crate::experiment::rows::VoxelRow;
use crate::experiment::table::name_of;
use crate::experiment::{Experiment, ExperimentError, NamedPicture, Subject};
use crate::gpu::Gpu;
use crate::settings::{Filter, MotionSettings, Settings, View};
use crate::spread::Spread;

/// Size of the ghost pictures.
const SIZE_PX: [u32; 2] = [960, 540];

/// Both filters in every pose; milliseconds are medians. With `draws`, a ghost of each as well.
pub fn voxels(gpu: &Arc<Gpu>, mut subject: Subject, poses: Vec<MotionSettings>, draws: bool) -> Experiment {
    subject.settings.method.look.view = View::Voxels;
    subject.settings.method.look.accuracy = true;
    subject.settings.shot.size_px = draws.then_some(SIZE_PX);
    Experiment::begin(gpu, ("voxels", subject), Vec::<VoxelRow>::new(), async move |mut lab, rows| {
        for (number, pose) in poses.iter().enumerate() {
            let share = Share::WHOLE.part(number, poses.len());
            let settings = posed(&lab, pose);
            let row = compare_filters(&mut lab, &settings, share).await?;
            rows.borrow_mut().push(row);
            if draws {
                draw_ghosts(&mut lab, &settings, number).await?;
            }
        }
        Ok(())
    })
}

async fn compare_filters(lab: &mut Lab, settings: &Settings, share: Share) -> Result<VoxelRow, ExperimentError> {
    let [voxelizing, building, measuring] = share.split([2.0, 1.0, lab.runs as f32]);
    lab.take_exact(settings, voxelizing).await?;
    lab.say(building, "building by both filters");
    lab.run(settings, NO_PICTURE, building).await?;
    let (mut nearest_ms, mut split_ms) = (Vec::new(), Vec::new());
    let frames = Frames {
        what: "building by both filters",
        settings,
        size_px: NO_PICTURE,
        forget: Forget::Everything,
        warmup: 0,
        runs: lab.runs,
    };
    lab.measure(frames, measuring, |engine, _| {
        let report = engine.accuracy();
        nearest_ms.extend(report.and_then(|report| Some(report.nearest?.kernel_ms)));
        split_ms.extend(report.and_then(|report| Some(report.split?.kernel_ms)));
    })
    .await?;
    let scene = &lab.prepared.scene;
    let nothing = || ExperimentError::NoVoxels(scene.name.clone());
    let report = lab.engine.accuracy().ok_or_else(nothing)?;
    let with_median = |filter: Option<FilterReport>, times_ms: &[f64]| {
        let kernel_ms = Spread::of(times_ms)?.median_ms;
        filter.map(|filter| FilterReport { kernel_ms, ..filter })
    };
    let clip = lab.prepared.clip_index(&settings.shot.motion)?;
    Ok(VoxelRow {
        scene: scene.name.clone(),
        clip: clip.map(|clip| scene.clips[clip].name.clone()),
        time_secs: settings.shot.motion.time_secs,
        turn_degrees: settings.shot.motion.turn_degrees,
        grid: settings.method.discretization.grid,
        span: lab.prepared.grid.span,
        exact: report.exact_cells.ok_or_else(nothing)?,
        nearest: with_median(report.nearest, &nearest_ms).ok_or_else(nothing)?,
        split: with_median(report.split, &split_ms).ok_or_else(nothing)?,
    })
}

/// `STEM-nearest` and `STEM-split`.
async fn draw_ghosts(lab: &mut Lab, settings: &Settings, number: usize) -> Result<(), ExperimentError> {
    let mut settings = settings.clone();
    settings.method.look.view = View::Ghost;
    settings.method.look.accuracy = false;
    let stem = picture_stem(lab, &settings, number);
    for filter in [Filter::Nearest, Filter::Split] {
        settings.method.discretization.filter = filter;
        lab.draw(&settings, SIZE_PX).await?;
        let picture = lab.engine.read_image()?;
        lab.show(NamedPicture { name: format!("{stem}-{}", name_of(&filter)), picture, settings: settings.clone() });
    }
    Ok(())
}
