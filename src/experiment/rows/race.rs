//! How right paths are in the time of cones.

use serde::Serialize;

use crate::accuracy::picture_error::PictureError;

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Race {
    /// Of 1, 2, 4 … samples a pixel, the last that fit in the time of cones, or the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(in crate::experiment) equal_time: Option<PathsError>,
    /// The first with which paths look as right as cones.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(in crate::experiment) as_right: Option<PathsError>,
}

/// A picture of a few paths beside the truth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PathsError {
    pub samples: u32,
    pub secs: f64,
    #[serde(flatten)]
    pub error: PictureError,
}

impl Race {
    pub fn text(&self) -> String {
        let told = |paths: &PathsError| {
            format!("{} samples a pixel, {:.2} s, {}", paths.samples, paths.secs, flip(&paths.error))
        };
        let equal_time = self.equal_time.as_ref().map_or("none".to_owned(), told);
        let as_right = self.as_right.as_ref().map_or("not with a quarter of the truth's samples".to_owned(), told);
        format!("paths in that time: {equal_time}; as right: {as_right}")
    }
}

/// "FLIP 0.1234", or SSIM where the program is built without it.
pub fn flip(error: &PictureError) -> String {
    error.flip.map_or_else(|| format!("SSIM {:.4}", error.ssim), |flip| format!("FLIP {flip:.4}"))
}
