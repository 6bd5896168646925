//! Why an experiment cannot go on.

use crate::accuracy::picture_error::CompareError;
use crate::engine::EngineError;
use crate::gpu::GpuError;
use crate::prepare::{ExactError, LightsError, MotionError};
use crate::progress::Cancelled;
use crate::settings::VisibilityError;

/// Why there is no traced picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TraceError {
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error(transparent)]
    Lights(#[from] LightsError),
}

#[derive(Debug, thiserror::Error)]
pub enum ExperimentError {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error(transparent)]
    Gpu(#[from] GpuError),
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error(transparent)]
    Visibility(#[from] VisibilityError),
    #[error(transparent)]
    Lights(#[from] LightsError),
    #[error(transparent)]
    Exact(#[from] ExactError),
    #[error(transparent)]
    Trace(#[from] TraceError),
    #[error(transparent)]
    Compare(#[from] CompareError),
    #[error("{0} has no voxels to compare")]
    NoVoxels(String),
    #[error("{0}: no light shines that could cast a shadow")]
    NoLight(String),
    #[error("{0}: no kernel was timed")]
    NoTimes(String),
    #[error("{scene}: paths show no {part}")]
    NoPaths { scene: String, part: String },
    #[error("{what}: no thread for it: {cause}")]
    NoThread { what: String, cause: std::io::Error },
    #[error("{0} ended unexpectedly")]
    Died(String),
}

impl ExperimentError {
    /// Something does not fit the adapter, or what is left of it.
    pub fn is_of_room(&self) -> bool {
        let is_of_room =
            |error: &GpuError| matches!(error, GpuError::OutOfMemory { .. } | GpuError::BufferTooLarge { .. });
        matches!(self, Self::Engine(EngineError::Gpu(error)) if is_of_room(error))
    }
}
