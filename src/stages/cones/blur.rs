//! Spreads what the pixels of a pattern have traced, along one axis, by a Gaussian.

use bytemuck::{Pod, Zeroable};

use super::{Surfaces, image_bytes, tiled_threads};
use crate::gpu::{Gpu, GpuBuffer, Mirror, Recorder, mirror};

/// Weights that [`BlurParams`] holds, from the middle outwards.
const WEIGHTS: usize = 8;

/// Mirror of `BlurParams` in shaders/cones/blur.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct BlurParams {
    pub size_px: [u32; 2],
    pub radius_px: u32,
    pub vertical: u32,
    pub weights: [[f32; 4]; WEIGHTS / 4],
}

pub const MIRRORS: &[Mirror] =
    &[mirror!(BlurParams, "cones/blur.wgsl", "BlurParams", size_px, radius_px, vertical, weights)];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    Rows,
    Columns,
}

impl BlurParams {
    /// For an image whose pixels share directions in squares of `pattern_px`.
    pub fn new(size_px: [u32; 2], pattern_px: u32, along: Along) -> Self {
        let mut weights = [[0.0; 4]; WEIGHTS / 4];
        for (i, weight) in pattern_weights(pattern_px).into_iter().enumerate() {
            weights[i / 4][i % 4] = weight as f32;
        }
        Self { size_px, radius_px: pattern_px, vertical: u32::from(along == Along::Columns), weights }
    }
}

/// Weights by distance, from 0 to `pattern_px`: a Gaussian of σ = half a pattern, in which every column of
/// the pattern has the same sum, so that each direction counts alike on a plane.
pub fn pattern_weights(pattern_px: u32) -> Vec<f64> {
    let pattern = i64::from(pattern_px);
    let gaussian = |i: i64| (-2.0 * (i as f64 / pattern as f64).powi(2)).exp();
    let of_column = |i: i64| (-pattern..=pattern).filter(|j| (i - j) % pattern == 0).map(gaussian).sum::<f64>();
    (0..=pattern).map(|i| gaussian(i) / of_column(i)).collect()
}

/// From `image` to `blurred`.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    surfaces: &Surfaces<'_>,
    params: &BlurParams,
    (image, blurred): (&GpuBuffer, &GpuBuffer),
) {
    let pass = frame.pass(&gpu.kernel("cones/blur.wgsl", &[]));
    surfaces
        .bind(pass)
        .uniform("params", params)
        .bind("image", image)
        .bind("blurred", blurred)
        .bytes_moved(4 * image_bytes(params.size_px))
        .dispatch(tiled_threads(params.size_px));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_column_of_a_pattern_weighs_the_same() {
        for pattern in [1, 2, 4] {
            let weights = pattern_weights(pattern);
            assert!(weights.len() <= WEIGHTS && weights.is_sorted_by(|a, b| a >= b), "{weights:?}");
            for column in 0..pattern as usize {
                let other = pattern as usize - column;
                let sum: f64 =
                    if column == 0 { weights[0] + 2.0 * weights[other] } else { weights[column] + weights[other] };
                assert!((sum - 1.0).abs() < 1e-12, "{pattern}: {sum}");
            }
        }
    }
}
