//! The specular cone of glossy surfaces.
//!
//! Its full apex angle a holds half of what a rough mirror reflects: half of the normals of a GGX distribution
//! lie within atan α of the mean, α = roughness², and a reflection turns by twice as much, so a = 4·atan α,
//! kept between 1° and 30° (section 5.2):
//!
//! ```text
//! roughness   0.05   0.1    0.15   0.2    0.25    0.3     0.36    above
//! a           1°     2.3°   5.2°   9.2°   14.3°   20.6°   29.5°   30°
//! ```

use bytemuck::{Pod, Zeroable};

use super::glossy_tiles::TileList;
use super::{ConesInput, TILE_PX, image_bytes};
use crate::gpu::{Constant, Counted, Gpu, GpuBuffer, Mirror, Recorder, constants, mirror};
use crate::settings::ConeTracing;
use crate::stages::light::gather::{ConeShape, Cones};
use crate::stages::sample::Sampler;
use crate::stages::surface::RADIANCE_BYTES;

/// Full apex angles (section 5.2).
pub const NARROWEST_DEGREES: f64 = 1.0;
pub const WIDEST_DEGREES: f64 = 30.0;
/// Tangents of half of them.
pub const NARROWEST_TANGENT: f64 = 0.008_726_867_790_758_79;
pub const WIDEST_TANGENT: f64 = 0.267_949_192_431_122_7;

pub const CONSTANTS: &[Constant] = constants![
    float NARROWEST_TANGENT,
    float WIDEST_TANGENT,
];

/// Mirror of `SpecularParams` in shaders/cones/specular.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SpecularParams {
    pub sky: [f32; 3],
    pub most_roughness: f32,
    pub shape: ConeShape,
    pub size_px: [u32; 2],
    pub pad: [u32; 2],
}

pub const MIRRORS: &[Mirror] =
    &[mirror!(SpecularParams, "cones/specular.wgsl", "SpecularParams", sky, most_roughness, shape, size_px, pad)];

impl SpecularParams {
    /// `sky`: radiance from all directions, nits.
    pub fn new(settings: &ConeTracing, sky: [f32; 3], size_px: [u32; 2]) -> Self {
        let cones = Cones {
            start_cells: settings.start_voxels,
            step_diameters: settings.step_diameters,
            reach_cells: f64::INFINITY,
            ..Cones::default()
        };
        let most_roughness = settings.glossy_roughness as f32;
        Self { sky, most_roughness, shape: ConeShape::new(&cones), size_px, pad: [0; 2] }
    }
}

/// Full apex angle of the cone of a surface, degrees.
pub fn aperture_degrees(roughness: f64) -> f64 {
    (4.0 * (roughness * roughness).atan()).to_degrees().clamp(NARROWEST_DEGREES, WIDEST_DEGREES)
}

/// Writes the pixels of listed tiles, the first `room_tiles` at most, into `specular`, a vec4 a pixel of `params.size_px`, after clearing it.
/// Nodes are found by rank, whatever the sampler's look-up; the values are the same.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    input: &ConesInput<'_>,
    (sampler, params): (&Sampler, &SpecularParams),
    (tiles, room_tiles): (&TileList, u32),
    specular: &GpuBuffer,
) {
    frame.clear_part(specular, image_bytes(params.size_px));
    let octree = input.octree;
    let threads_of = |tiles: u32| u64::from(tiles) * u64::from(TILE_PX * TILE_PX);
    let [filter, directional] = sampler.value_constants();
    let constants = [filter, directional, ("HORIZON", 1.0)];
    let pass = frame.pass(&gpu.kernel("cones/specular.wgsl", &constants));
    input
        .surfaces
        .bind(octree.bind_ranked(pass))
        .uniform("params", params)
        .bind("list", &tiles.list)
        .bind("specular", specular)
        .counted(&tiles.list, move |listed: &u32| {
            let threads = threads_of(room_tiles.min(*listed));
            Counted { threads, bytes: 3 * RADIANCE_BYTES * threads }
        })
        .dispatch(threads_of(room_tiles));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tangents_are_those_of_half_the_angles() {
        for (tangent, degrees) in [(NARROWEST_TANGENT, NARROWEST_DEGREES), (WIDEST_TANGENT, WIDEST_DEGREES)] {
            assert!((tangent - (degrees / 2.0).to_radians().tan()).abs() < 1e-15);
        }
    }
}
