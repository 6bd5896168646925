//! Shadows in the voxels against rays through the posed triangles, light by light: by shadow maps of
//! several sizes, by marching the octree, and with none.

use std::sync::Arc;

use super::posed;
use crate::accuracy::alone;
use crate::accuracy::posed_triangles::PosedTriangles;
use crate::accuracy::shadows::{LeafPlaces, POINTS, ShadowError, TrueShadows, spread};
use crate::data::world_voxels::WorldVoxels;
use crate::engine::PassTiming;
use crate::experiment::board::{Findings, Share};
use crate::experiment::frames::{Forget, Frames};
use crate::experiment::lab::{Lab, NO_PICTURE};
use crate::experiment::rows::{Method, ShadowRow};
use crate::experiment::{Experiment, ExperimentError, Subject};
use crate::gpu::Gpu;
use crate::lights::{KnownLight, Shines, posed_lights};
use crate::plan::Pass;
use crate::prepare::Prepared;
use crate::progress::Progress;
use crate::settings::lighting::Shadows;
use crate::settings::{ColorBy, MotionSettings, Settings, View};
use crate::spread::Spread;

/// The mean over several lights.
const ALL_LIGHTS: &str = "all";

const METHODS: [Method; 5] = [
    Method { shadows: Shadows::Map, map_px: Some(1024) },
    Method { shadows: Shadows::Map, map_px: Some(2048) },
    Method { shadows: Shadows::Map, map_px: Some(4096) },
    Method { shadows: Shadows::March, map_px: None },
    Method { shadows: Shadows::Off, map_px: None },
];

/// A light that is compared.
struct Compared {
    name: String,
    /// The settings with this light alone, and no shadows.
    settings: Settings,
    truth: TrueShadows,
}

/// In every pose a row for every light that shines and every method, and for all lights together where there are
/// several.
pub fn shadows(gpu: &Arc<Gpu>, mut subject: Subject, poses: Vec<MotionSettings>) -> Experiment {
    subject.settings.method.look.view = View::Voxels;
    subject.settings.method.look.color = ColorBy::Radiance;
    // Nothing is drawn.
    subject.settings.shot.size_px = None;
    Experiment::begin(gpu, ("shadows", subject), Vec::<ShadowRow>::new(), async move |mut lab, rows| {
        for (number, pose) in poses.iter().enumerate() {
            let settings = posed(&lab, pose);
            compare(&mut lab, &settings, (Share::WHOLE.part(number, poses.len()), &rows)).await?;
        }
        Ok(())
    })
}

async fn compare(
    lab: &mut Lab,
    settings: &Settings,
    (share, rows): (Share, &Findings<Vec<ShadowRow>>),
) -> Result<(), ExperimentError> {
    let [casting, measuring] = share.split([1.0, 3.0]);
    let lights = lights(lab, settings, casting).await?;
    let first = rows.borrow().len();
    for (number, light) in lights.iter().enumerate() {
        let [opening, share] = measuring.part(number, lights.len()).split([1.0, 2.0 * METHODS.len() as f32]);
        lab.say(opening, format!("{}: light without shadows", light.name));
        lab.run(&light.settings, NO_PICTURE, opening).await?;
        let open = lab.engine.read_irradiance()?;
        for (index, method) in METHODS.into_iter().enumerate() {
            let row = compare_method(lab, (light, &open), (method, share.part(index, METHODS.len()))).await?;
            rows.borrow_mut().push(row);
        }
    }
    if lights.len() > 1 {
        let together = together(&rows.borrow()[first..]);
        rows.borrow_mut().extend(together);
    }
    Ok(())
}

/// Every light that shines, with what rays say of it in the leaves of this pose.
async fn lights(lab: &mut Lab, settings: &Settings, share: Share) -> Result<Vec<Compared>, ExperimentError> {
    let prepared = Arc::clone(&lab.prepared);
    let known = prepared.known_lights(settings)?;
    let alone = |light: &KnownLight| {
        let mut settings = settings.clone();
        settings.method.lighting = alone(&settings.method.lighting, &known, light.source);
        settings.method.lighting.shadows = Shadows::Off;
        (light.name.clone(), settings)
    };
    let shining = known.iter().filter(|light| light.shines == Shines::Yes).map(alone).collect::<Vec<_>>();
    let Some((_, settings)) = shining.first().cloned() else {
        return Err(ExperimentError::NoLight(prepared.scene.name.clone()));
    };
    // Leaves do not depend on the light.
    let [building, casting] = share.split([1.0, 2.0]);
    lab.say(building, "building voxels");
    lab.run(&settings, NO_PICTURE, building).await?;
    let voxels = lab.engine.read_voxels()?;
    if voxels.cells.is_empty() {
        return Err(ExperimentError::NoVoxels(prepared.scene.name.clone()));
    }
    let cast =
        lab.work((casting, "casting rays to lights"), move |progress| cast(&prepared, shining, (&voxels, progress)));
    let (lights, warnings) = cast.await??;
    lab.warn(&warnings);
    Ok(lights)
}

/// Rays to one light after the other; and objects that are left out, a sentence each.
fn cast(
    prepared: &Prepared,
    shining: Vec<(String, Settings)>,
    (voxels, progress): (&WorldVoxels, &Progress),
) -> Result<(Vec<Compared>, Vec<String>), ExperimentError> {
    let Some((_, settings)) = shining.first() else { return Ok((Vec::new(), Vec::new())) };
    progress.add_total(1 + shining.len() as u64);
    let leaves = LeafPlaces::new(voxels, &prepared.grid);
    let pose = prepared.pose(&settings.shot.motion)?;
    let hidden = prepared.hidden(&settings.shot.visibility, &pose)?;
    let triangles = PosedTriangles::new(prepared, &settings.shot.motion, &hidden)?;
    let points = spread(&triangles, POINTS);
    let shown = prepared.shown_nodes(&settings.shot.visibility, &pose)?;
    let mut lights = Vec::new();
    for (name, settings) in shining {
        // Where nobody waits any more, what is missing is missed by nobody.
        if progress.advance(1).is_err() {
            break;
        }
        let posed = posed_lights(&prepared.scene, &pose, &settings.method.lighting, &shown, false);
        let light = posed.first().ok_or_else(|| ExperimentError::NoLight(prepared.scene.name.clone()))?;
        let truth = TrueShadows::new(&triangles, &points, light, &prepared.grid, &leaves);
        lights.push(Compared { name, settings, truth });
    }
    Ok((lights, triangles.warnings))
}

async fn compare_method(
    lab: &mut Lab,
    (light, open): (&Compared, &[[f32; 3]]),
    (method, share): (Method, Share),
) -> Result<ShadowRow, ExperimentError> {
    let mut settings = light.settings.clone();
    settings.method.lighting.shadows = method.shadows;
    settings.method.lighting.shadow_map_px = method.map_px.unwrap_or(settings.method.lighting.shadow_map_px);
    let kernel_ms = measure(lab, &settings, (&format!("{}: shadows {}", light.name, method.name()), share)).await?;
    let error = light.truth.compare(&lab.engine.read_irradiance()?, open);
    let prepared = &lab.prepared;
    let clip = prepared.clip_index(&settings.shot.motion)?.map(|clip| prepared.scene.clips[clip].name.clone());
    Ok(ShadowRow {
        scene: prepared.scene.name.clone(),
        clip,
        time_secs: settings.shot.motion.time_secs,
        turn_degrees: settings.shot.motion.turn_degrees,
        grid: settings.method.discretization.grid,
        span: prepared.grid.span,
        light: light.name.clone(),
        method,
        kernel_ms,
        error,
    })
}

/// Median of shadow map and irradiance, after a run that is not measured.
async fn measure(lab: &mut Lab, settings: &Settings, (what, share): (&str, Share)) -> Result<f64, ExperimentError> {
    let mut times_ms = Vec::new();
    let is_mapped = settings.method.lighting.shadows == Shadows::Map;
    let counts =
        |timing: &&PassTiming| timing.pass == Pass::Illuminate || is_mapped && timing.pass == Pass::DrawShadows;
    let frames =
        Frames { what, settings, size_px: NO_PICTURE, forget: Forget::Light, warmup: lab.warmup, runs: lab.runs };
    lab.measure(frames, share, |engine, _| {
        times_ms.push(engine.timings().iter().filter(counts).map(|timing| timing.kernel.ms).sum());
    })
    .await?;
    Ok(Spread::of(&times_ms).ok_or_else(|| ExperimentError::NoTimes(what.to_owned()))?.median_ms)
}

/// Of the rows of several lights, method by method: milliseconds of all, and their mean error.
fn together(rows: &[ShadowRow]) -> Vec<ShadowRow> {
    let merged = |method: Method| {
        let of_method = || rows.iter().filter(move |row| row.method == method);
        let errors: Vec<ShadowError> = of_method().map(|row| row.error).collect();
        let kernel_ms = of_method().map(|row| row.kernel_ms).sum();
        let row = of_method().next()?.clone();
        Some(ShadowRow { light: ALL_LIGHTS.to_owned(), kernel_ms, error: ShadowError::of_all(&errors), ..row })
    };
    METHODS.into_iter().filter_map(merged).collect()
}
