//! A path-traced picture: goes on from what is kept on disk, and is kept there.

use crate::accuracy::path_tracer::{Film, Options, TracedScene};
use crate::disk_cache::DiskCache;
use crate::experiment::TraceError;
use crate::prepare::Prepared;
use crate::progress::Progress;
use crate::settings::Settings;

pub struct Traced {
    pub film: Film,
    /// What is left out, and why it could not be kept, a sentence each.
    pub warnings: Vec<String>,
}

/// A picture with as many samples a pixel, which go on from what `disk` holds and are kept there.
pub fn traced(
    (prepared, disk): (&Prepared, Option<&DiskCache>),
    settings: &Settings,
    (options, samples): (Options, u32),
    progress: &Progress,
) -> Result<Traced, TraceError> {
    let scene = TracedScene::new(prepared, settings, options)?;
    let mut warnings = scene.warnings().to_vec();
    let kept = disk.map(|disk| (disk, scene.key()));
    let stored = kept.as_ref().and_then(|(disk, key)| disk.load_film(key, options.size_px, samples));
    let mut film = stored.unwrap_or_else(|| scene.new_film());
    scene.trace(&mut film, samples, progress)?;
    if let Some((disk, key)) = kept
        && let Err(error) = disk.store_film(&key, &film)
    {
        warnings.push(format!("the traced picture cannot be kept in {}: {error}", disk.folder().display()));
    }
    Ok(Traced { film, warnings })
}
