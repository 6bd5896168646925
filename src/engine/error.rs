//! Why an engine cannot do what is asked.

use crate::gpu::GpuError;
use crate::prepare::MotionError;
use crate::settings::VisibilityError;
use crate::stages::fill::number_objects::OBJECT_MASK;

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EngineError {
    #[error(transparent)]
    Gpu(#[from] GpuError),
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error(transparent)]
    Visibility(#[from] VisibilityError),
    #[error("no scene is open")]
    NoScene,
    #[error("{scene} has {objects} objects, and colour by object can tell {OBJECT_MASK} apart; choose another colour")]
    TooManyObjects { scene: String, objects: usize },
}

impl EngineError {
    /// There may be room once something else is gone.
    pub fn is_out_of_memory(&self) -> bool {
        matches!(self, Self::Gpu(GpuError::OutOfMemory { .. }))
    }
}
