//! Reference of `slice`: where a ray meets the plane, what a map of lit nodes holds there, and where that
//! lies on the scale.

use glam::DVec3;

use super::march_light_ref;
use crate::color::luminance;
use crate::settings::{Sampling, Slice, SliceAxis, SliceValue};
use crate::stages::pixels::camera::PixelRay;
use crate::stages::sample::sample_points_ref::{LitNodes, Sampled};

/// Distance along the ray and the place, cells; `None` beside the grid, behind, and for rays along the
/// plane.
pub fn meeting(slice: &Slice, ray: &PixelRay, cells: f64) -> Option<(f64, DVec3)> {
    let (axis, others) = match slice.axis {
        SliceAxis::X => (0, [1, 2]),
        SliceAxis::Y => (1, [0, 2]),
        SliceAxis::Z => (2, [0, 1]),
    };
    let height = slice.height * cells;
    let t = (height - ray.origin[axis]) / ray.direction[axis];
    let mut place = ray.origin + ray.direction * t;
    place[axis] = height;
    let meets = t.is_finite() && t >= 0.0 && others.iter().all(|&other| (0.0..cells).contains(&place[other]));
    meets.then_some((t, place))
}

/// Of all levels the one whose nodes are nearest to that width, by ratio; of two as near the coarser.
fn level(width_cells: f64, depth: u32) -> u32 {
    let ratio = |level: u32| (width_cells.log2() - f64::from(depth - level)).abs();
    (0..=depth).min_by(|a, b| ratio(*a).total_cmp(&ratio(*b))).unwrap_or(depth)
}

/// What is shown at a place; `None` where there is nothing to have a mean light.
pub fn value(slice: &Slice, lit: &LitNodes, place: DVec3) -> Option<f64> {
    let level = level(slice.width_cells, lit.depth);
    let Sampled { radiance, alpha } = match slice.sampling {
        Sampling::Nearest => lit.nearest(level, place, DVec3::X),
        Sampling::Trilinear => lit.trilinear(level, place, DVec3::X),
        Sampling::Quadrilinear => lit.quadrilinear(slice.width_cells, place, DVec3::X),
    };
    match slice.value {
        SliceValue::Occupancy => Some(alpha),
        SliceValue::Radiance | SliceValue::Irradiance if alpha == 0.0 => None,
        SliceValue::Radiance | SliceValue::Irradiance => Some(luminance(radiance.to_array()) / alpha),
    }
}

/// Ends of the scale of light that the root's mean makes.
pub fn range(slice: &Slice, root: [f64; 4]) -> [f64; 2] {
    let mean = march_light_ref::mean(root).unwrap_or(1.0);
    if slice.logarithmic { [mean / 256.0, 16.0 * mean] } else { [0.0, 8.0 * mean] }
}

/// 0 to 1.
pub fn share(slice: &Slice, value: f64, [least, most]: [f64; 2]) -> f64 {
    let share = match slice.logarithmic {
        true => (value.max(least) / least).log2() / (most / least).log2(),
        false => (value - least) / (most - least),
    };
    share.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_lies_in_the_middle_of_what_it_makes_of_a_scale() {
        let slice = Slice::default();
        let root = [2.0, 2.0, 2.0, 0.5];
        // Eight powers of two below, four above.
        assert!((share(&slice, 4.0, range(&slice, root)) - 8.0 / 12.0).abs() < 1e-12);
        let linear = Slice { logarithmic: false, ..slice };
        assert!((share(&linear, 4.0, range(&linear, root)) - 1.0 / 8.0).abs() < 1e-12);
        assert_eq!(range(&linear, [0.0; 4]), [0.0, 8.0]);
    }

    #[test]
    fn scales_end_at_their_range() {
        let (linear, log) = (Slice { logarithmic: false, ..Slice::default() }, Slice::default());
        let shares = |slice: &Slice| [0.0, 1.0, 4.0, 16.0, 99.0].map(|value| share(slice, value, [1.0, 16.0]));
        assert_eq!(shares(&linear), [0.0, 0.0, 0.2, 1.0, 1.0]);
        assert_eq!(shares(&log), [0.0, 0.0, 0.5, 1.0, 1.0]);
    }
}
