//! Reference of `emission.wgsl`: the sum before any light.

use crate::data::surface_image::SurfaceTexel;
use crate::stages::pixels::NO_DEPTH;

/// Nits, and 1 where a surface is.
pub fn emission(texel: &SurfaceTexel) -> [f64; 4] {
    if texel.distance_cells >= NO_DEPTH {
        return [0.0; 4];
    }
    let [r, g, b] = texel.emission_nits.map(f64::from);
    [r, g, b, 1.0]
}
