//! Shadows in the voxels against rays through the posed triangles, light by light: by shadow maps of
//! several sizes, by marching the octree, and with none.

use anyhow::{Context, bail};
use octolume::accuracy::alone;
use octolume::accuracy::posed_triangles::{PosedTriangles, SurfacePoint};
use octolume::accuracy::shadows::{LeafPlaces, POINTS, ShadowError, TrueShadows, spread};
use octolume::lights::{KnownLight, Shines, posed_lights};
use octolume::settings::Settings;
use octolume::settings::lighting::Shadows;
use serde::Serialize;

use super::{Case, Table};
use crate::cli::output;
use crate::cli::session::{NO_PICTURE, Session};
use octolume::spread::Spread;

/// One light of one pose by one method.
#[derive(Serialize)]
pub struct Row {
    scene: String,
    clip: Option<String>,
    time_secs: f64,
    turn_degrees: [f64; 3],
    grid: u32,
    span: f64,
    light: String,
    #[serde(flatten)]
    compared: Compared,
}

/// A light by one method.
#[derive(Serialize)]
struct Compared {
    #[serde(flatten)]
    method: Method,
    /// Of shadow map and irradiance.
    kernel_ms: f64,
    #[serde(flatten)]
    error: ShadowError,
}

/// The mean over several lights.
const ALL_LIGHTS: &str = "all";

/// How a leaf learns whether the light reaches it.
#[derive(Clone, Copy, Serialize)]
struct Method {
    shadows: Shadows,
    /// Texels along an edge of a shadow map.
    #[serde(skip_serializing_if = "Option::is_none")]
    map_px: Option<u32>,
}

const METHODS: [Method; 5] = [
    Method { shadows: Shadows::Map, map_px: Some(1024) },
    Method { shadows: Shadows::Map, map_px: Some(2048) },
    Method { shadows: Shadows::Map, map_px: Some(4096) },
    Method { shadows: Shadows::March, map_px: None },
    Method { shadows: Shadows::Off, map_px: None },
];

/// A pose whose lights are compared: what does not depend on the light.
struct Scene<'a> {
    triangles: PosedTriangles<'a>,
    points: Vec<SurfacePoint>,
    known: Vec<KnownLight>,
}

/// A row for every light that shines and every method, and for all lights together where there are several.
pub fn compare(session: &mut Session, settings: &Settings, case: &Case) -> anyhow::Result<Vec<Row>> {
    let prepared = session.prepared.clone();
    let hidden = prepared.hidden(&settings.visibility)?;
    let triangles = PosedTriangles::new(&prepared, &settings.motion, &hidden)?;
    output::warnings(&triangles.warnings);
    let scene = Scene { points: spread(&triangles, POINTS), triangles, known: prepared.known_lights(settings)? };
    let shining: Vec<&KnownLight> = scene.known.iter().filter(|light| light.shines == Shines::Yes).collect();
    if shining.is_empty() {
        bail!("{}: no light shines that could cast a shadow", prepared.scene.name);
    }
    let mut by_light = Vec::new();
    for light in shining {
        by_light.push((light.name.as_str(), compare_light(session, settings, (&scene, light), case.runs)?));
    }
    if by_light.len() > 1 {
        by_light.push((ALL_LIGHTS, together(&by_light)));
    }
    let clip = prepared.clip_index(&settings.motion)?.map(|clip| &prepared.scene.clips[clip].name);
    let row = |light: &str, compared: Compared| Row {
        scene: prepared.scene.name.clone(),
        clip: clip.cloned(),
        time_secs: settings.motion.time_secs,
        turn_degrees: settings.motion.turn_degrees,
        grid: settings.discretization.grid,
        span: prepared.grid.span,
        light: light.to_owned(),
        compared,
    };
    let rows = by_light.into_iter().flat_map(|(light, methods)| methods.into_iter().map(move |found| (light, found)));
    Ok(rows.map(|(light, found)| row(light, found)).collect())
}

/// Method by method: milliseconds of all lights, and their mean error.
fn together(by_light: &[(&str, Vec<Compared>)]) -> Vec<Compared> {
    let of_method = |index: usize| by_light.iter().filter_map(move |(_, methods)| methods.get(index));
    let merged = |(index, method): (usize, Method)| {
        let errors: Vec<ShadowError> = of_method(index).map(|compared| compared.error).collect();
        let kernel_ms = of_method(index).map(|compared| compared.kernel_ms).sum();
        Compared { method, kernel_ms, error: ShadowError::of_all(&errors) }
    };
    METHODS.into_iter().enumerate().map(merged).collect()
}

fn compare_light(
    session: &mut Session,
    settings: &Settings,
    (scene, light): (&Scene, &KnownLight),
    runs: u32,
) -> anyhow::Result<Vec<Compared>> {
    let mut settings = settings.clone();
    settings.lighting = alone(&settings.lighting, &scene.known, light.source);
    settings.lighting.shadows = Shadows::Off;
    session.run(&settings, NO_PICTURE)?;
    let open = session.engine.read_irradiance()?;
    let truth = truth(session, &settings, scene)?;
    let mut compared = Vec::new();
    for method in METHODS {
        settings.lighting.shadows = method.shadows;
        settings.lighting.shadow_map_px = method.map_px.unwrap_or(settings.lighting.shadow_map_px);
        let kernel_ms = measure(session, &settings, runs)?;
        let error = truth.compare(&session.engine.read_irradiance()?, &open);
        compared.push(Compared { method, kernel_ms, error });
    }
    Ok(compared)
}

/// Of the one light that is left, in the leaves that are built.
fn truth(session: &Session, settings: &Settings, scene: &Scene) -> anyhow::Result<TrueShadows> {
    let prepared = &session.prepared;
    let leaves = LeafPlaces::new(&session.engine.read_voxels()?, &prepared.grid);
    let pose = prepared.pose(&settings.motion)?;
    let shown = settings.visibility.shown_nodes(&prepared.scene)?;
    let posed = posed_lights(&prepared.scene, &pose, &settings.lighting, &shown, false);
    let light = posed.first().context("the light that is compared does not shine")?;
    Ok(TrueShadows::new(&scene.triangles, &scene.points, light, &prepared.grid, &leaves))
}

/// Median of shadow map and irradiance, after a run that is not measured.
fn measure(session: &mut Session, settings: &Settings, runs: u32) -> anyhow::Result<f64> {
    let mut times_ms = Vec::new();
    let is_mapped = settings.lighting.shadows == Shadows::Map;
    let counts = |kernel: &str| kernel == "light/illuminate" || is_mapped && kernel == "light/shadow";
    for run in 0..=runs {
        session.engine.invalidate_light();
        session.run(settings, NO_PICTURE)?;
        let timings = session.kernel_times();
        let ms: f64 = timings.iter().filter(|timing| counts(&timing.kernel)).map(|timing| timing.ms).sum();
        times_ms.extend((run > 0).then_some(ms));
    }
    Ok(Spread::of(&times_ms).context("no run was measured")?.median_ms)
}

const HEADS: [&str; 12] = [
    "scene",
    "time s",
    "turn °",
    "grid",
    "light",
    "shadows",
    "kernel ms",
    "points",
    "lit %",
    "mean error %",
    "lost %",
    "leaked %",
];

pub fn table(rows: &[Row]) -> Table<'static> {
    Table { stem: "shadows", heads: &HEADS, rows: rows.iter().map(cells).collect() }
}

fn cells(row: &Row) -> Vec<String> {
    let Compared { method, kernel_ms, error } = &row.compared;
    let percent = |share: f64| format!("{share:.2}");
    vec![
        row.scene.clone(),
        format!("{:.3}", row.time_secs),
        super::turn(row.turn_degrees),
        row.grid.to_string(),
        row.light.clone(),
        method.name(),
        format!("{kernel_ms:.2}"),
        error.points.to_string(),
        percent(error.lit_percent),
        percent(error.mean_error_percent),
        percent(error.lost_percent),
        percent(error.leaked_percent),
    ]
}

impl Method {
    fn name(self) -> String {
        let name = output::name_of(&self.shadows);
        self.map_px.map_or(name.clone(), |px| format!("{name} {px}"))
    }
}
