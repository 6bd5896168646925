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
    pub(in crate::experiment) method: Method,
    /// Of shadow map and irradiance.
    pub kernel_ms: f64,
    #[serde(flatten)]
    pub error: ShadowError,
}

/// How a leaf learns whether the light reaches it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(in crate::experiment) struct Method {
    pub shadows: Shadows,
    /// Texels along an edge of a shadow map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map_px: Option<u32>,
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
