//! Paths against cones: how right a path-traced picture is in the time that cones take, and from how many
//! samples on it is as right as theirs.

use crate::accuracy::path_tracer::{Film, Options, TracedScene};
use crate::accuracy::picture_error::{self, Display, LightPixel, PictureError};
use crate::experiment::rows::{PathsError, Race};
use crate::experiment::table::name_of;
use crate::experiment::{ExperimentError, TraceError};
use crate::prepare::Prepared;
use crate::progress::Progress;
use crate::settings::{Settings, SurfaceView};

/// Another picture of the path tracer than the one that is the truth.
const OTHER_SEED: u64 = 0x0c70_1ae0;

/// Paths of the shown part of light, made with `options` but for the seed, against cones that took some
/// seconds and have an error.
pub fn run(
    (prepared, settings): (&Prepared, &Settings),
    (truth, options): (&Film, Options),
    (cones_secs, cones): (f64, PictureError),
    progress: &Progress,
) -> Result<Race, ExperimentError> {
    let options = Options { seed: options.seed ^ OTHER_SEED, ..options };
    let scene = TracedScene::new(prepared, settings, options).map_err(TraceError::from)?;
    let part = settings.method.look.surface;
    let light = |film: &Film| shown(film, part, (prepared, settings));
    let truth_light = light(truth)?;
    let shown = Display::of_mean(&settings.method.look, part, &truth_light);
    let mut film = scene.new_film();
    let mut race = Race { equal_time: None, as_right: None };
    // A truth that is hardly better than what is judged by it would say nothing.
    while film.samples() < truth.samples() / 4 {
        let samples = (2 * film.samples()).max(1);
        scene.trace(&mut film, samples, progress).map_err(TraceError::from)?;
        let error = picture_error::compare(&light(&film)?, &truth_light, film.size_px(), &shown)?;
        let found = PathsError { samples, secs: film.secs(), error };
        if race.equal_time.is_none() || found.secs <= cones_secs {
            race.equal_time = Some(found);
        }
        if race.as_right.is_none() && looks_off(&error) <= looks_off(&cones) {
            race.as_right = Some(found);
        }
        if race.as_right.is_some() && found.secs > cones_secs {
            break;
        }
    }
    Ok(race)
}

/// What paths make of a part of light.
pub fn shown(
    film: &Film,
    part: SurfaceView,
    (prepared, settings): (&Prepared, &Settings),
) -> Result<Vec<LightPixel>, ExperimentError> {
    let no_paths = || ExperimentError::NoPaths { scene: prepared.scene.name.clone(), part: name_of(&part) };
    film.shown(part, &settings.method.lighting).ok_or_else(no_paths)
}

/// FLIP, or what stands in for it.
fn looks_off(error: &PictureError) -> f64 {
    error.flip.unwrap_or(1.0 - error.ssim)
}
