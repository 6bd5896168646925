//! Begins the sum of direct light: what the surfaces themselves emit, and where there are any.

use super::Lit;
use crate::gpu::{Gpu, Recorder};

/// Overwrites all of `lit.direct`.
pub fn record(gpu: &Gpu, frame: &mut Recorder, lit: &Lit<'_>) {
    let pass = frame.pass(&gpu.kernel("surface/emission.wgsl", &[]));
    lit.bind(pass).bytes_moved(lit.bytes(1)).dispatch(lit.tiled_threads());
}
