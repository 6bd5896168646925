//! What is told of shadows in voxels: a row a light and method.

use serde::Serialize;

use crate::accuracy::shadows::ShadowError;
use crate::experiment::table::{Table, name_of, turn};
use crate::settings::lighting::Shadows;

/// One light of one pose by one method.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShadowRow {
    pub scene: String,
    pub clip: Option<String>,
    pub time_secs: f64,
    pub turn_degrees: [f64; 3],
    pub grid: u32,
    pub span: f64,
    pub light: String,
    #[serde(flatten)]
    pub(super) method: Method,
    /// Of shadow map and irradiance.
    pub kernel_ms: f64,
    #[serde(flatten)]
    pub error: ShadowError,
}

/// The mean over several lights.
const ALL_LIGHTS: &str = "all";

/// How a leaf learns whether the light reaches it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Method {
    pub shadows: Shadows,
    /// Texels along an edge of a shadow map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map_px: Option<u32>,
}

pub(super) const METHODS: [Method; 5] = [
    Method { shadows: Shadows::Map, map_px: Some(1024) },
    Method { shadows: Shadows::Map, map_px: Some(2048) },
    Method { shadows: Shadows::Map, map_px: Some(4096) },
    Method { shadows: Shadows::March, map_px: None },
    Method { shadows: Shadows::Off, map_px: None },
];

/// Of the rows of several lights, method by method: milliseconds of all, and their mean error.
pub(super) fn together(rows: &[ShadowRow]) -> Vec<ShadowRow> {
    let merged = |method: Method| {
        let of_method = || rows.iter().filter(move |row| row.method == method);
        let errors: Vec<ShadowError> = of_method().map(|row| row.error).collect();
        let kernel_ms = of_method().map(|row| row.kernel_ms).sum();
        let row = of_method().next()?.clone();
        Some(ShadowRow { light: ALL_LIGHTS.to_owned(), kernel_ms, error: ShadowError::of_all(&errors), ..row })
    };
    METHODS.into_iter().filter_map(merged).collect()
}

impl ShadowRow {
    const HEADS: [&'static str; 12] = [
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

    pub(in crate::experiment) fn table(rows: &[Self]) -> Table {
        Table::new("shadows", &Self::HEADS, rows.iter().map(Self::cells))
    }

    fn cells(&self) -> Vec<String> {
        let error = &self.error;
        let percent = |share: f64| format!("{share:.2}");
        vec![
            self.scene.clone(),
            format!("{:.3}", self.time_secs),
            turn(self.turn_degrees),
            self.grid.to_string(),
            self.light.clone(),
            self.method.name(),
            format!("{:.2}", self.kernel_ms),
            error.points.to_string(),
            percent(error.lit_percent),
            percent(error.mean_error_percent),
            percent(error.lost_percent),
            percent(error.leaked_percent),
        ]
    }
}

impl Method {
    pub fn name(self) -> String {
        let name = name_of(&self.shadows);
        self.map_px.map_or(name.clone(), |px| format!("{name} {px}"))
    }
}
