//! The lit surfaces that the camera sees: surface image, direct light, cones, and the picture of them.

use super::{Engine, EngineError, Wanted, missing};
use crate::gpu::Recorder;
use crate::stages::view::Picture;
use crate::stages::view::camera::PixelRays;

impl Engine {
    pub(super) fn record_surfaces(
        &mut self,
        _frame: &mut Recorder,
        _wanted: &Wanted,
        _drawn: (&PixelRays, &Picture),
    ) -> Result<(), EngineError> {
        Err(missing("surface image").into())
    }
}
