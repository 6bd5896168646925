//! Arms and legs of a person in the bind pose, left and right.

use glam::DVec3;

use super::piece::{Cloths, Piece, closed, level_tube, pair};
use super::weights;
use crate::scene::builtin::shapes::Shape;
use crate::scene::builtin::shapes::round::{Ring, tube};
use crate::scene::builtin::shapes::solid::sphere;

/// A tube along the left arm from (x, half height, half depth) cross-sections, closed at its ends.
fn arm_tube(sections: &[[f64; 3]], segments: usize) -> Shape {
    let mut rings: Vec<Ring> = sections.iter().map(|&[x, high, deep]| Ring::across(x, high, deep)).collect();
    rings.insert(0, closed(rings[0]));
    rings.push(closed(rings[rings.len() - 1]));
    tube(&rings, segments).moved(0.0, 1.41, 0.0)
}

pub(super) fn arms(cloths: &Cloths) -> Vec<Piece> {
    let sleeve = arm_tube(
        &[
            [0.10, 0.050, 0.060],
            [0.14, 0.066, 0.070],
            [0.18, 0.072, 0.074],
            [0.22, 0.073, 0.073],
            [0.27, 0.068, 0.068],
            [0.33, 0.062, 0.062],
            [0.38, 0.058, 0.058],
            [0.42, 0.055, 0.056],
            [0.455, 0.053, 0.055],
            [0.49, 0.053, 0.054],
            [0.53, 0.054, 0.054],
            [0.58, 0.054, 0.053],
            [0.62, 0.053, 0.052],
        ],
        14,
    );
    let cuff =
        arm_tube(&[[0.60, 0.050, 0.050], [0.605, 0.057, 0.057], [0.685, 0.044, 0.046], [0.69, 0.036, 0.038]], 14);
    let palm = arm_tube(
        &[
            [0.67, 0.026, 0.030],
            [0.70, 0.024, 0.034],
            [0.74, 0.023, 0.043],
            [0.78, 0.020, 0.045],
            [0.82, 0.017, 0.040],
            [0.86, 0.014, 0.034],
            [0.885, 0.009, 0.022],
        ],
        12,
    );
    let thumb = sphere(10, 6).scaled(0.034, 0.014, 0.016).turned(DVec3::Y, -0.7).moved(0.765, 1.405, 0.052);
    let hand = Shape::joined([palm, thumb]);
    pair(sleeve, cloths.sleeves, weights::arm)
        .into_iter()
        .chain(pair(cuff, cloths.leather, weights::arm))
        .chain(pair(hand, cloths.skin, weights::arm))
        .collect()
}

pub(super) fn legs(cloths: &Cloths) -> Vec<Piece> {
    let leg = level_tube(
        &[
            [0.10, 0.036, 0.040, -0.004],
            [0.18, 0.040, 0.044, -0.006],
            [0.26, 0.052, 0.056, -0.012],
            [0.34, 0.058, 0.063, -0.014],
            [0.41, 0.056, 0.060, -0.008],
            [0.46, 0.056, 0.059, 0.0],
            [0.50, 0.058, 0.061, 0.004],
            [0.54, 0.061, 0.063, 0.004],
            [0.60, 0.067, 0.070, 0.003],
            [0.68, 0.075, 0.079, 0.002],
            [0.76, 0.082, 0.087, 0.0],
            [0.84, 0.080, 0.088, 0.0],
            [0.92, 0.060, 0.084, 0.0],
        ],
        14,
    )
    .moved(0.09, 0.0, 0.0);
    pair(leg, cloths.trousers, weights::leg).into_iter().chain(pair(boot(), cloths.leather, weights::boot)).collect()
}

/// The left boot: a shaft with a cuff, and a foot.
fn boot() -> Shape {
    let shaft = level_tube(
        &[
            [0.05, 0.046, 0.052, -0.004],
            [0.10, 0.047, 0.052, -0.006],
            [0.16, 0.049, 0.054, -0.008],
            [0.24, 0.059, 0.064, -0.012],
            [0.32, 0.066, 0.071, -0.014],
            [0.36, 0.070, 0.075, -0.014],
            [0.365, 0.078, 0.083, -0.014],
            [0.41, 0.080, 0.085, -0.012],
            [0.41, 0.058, 0.062, -0.012],
        ],
        14,
    );
    let foot: Vec<Ring> = [
        [-0.068, 0.006, 0.010, 0.030],
        [-0.062, 0.026, 0.028, 0.034],
        [-0.040, 0.040, 0.042, 0.042],
        [0.000, 0.044, 0.050, 0.050],
        [0.045, 0.043, 0.045, 0.045],
        [0.090, 0.046, 0.036, 0.036],
        [0.125, 0.049, 0.030, 0.030],
        [0.160, 0.046, 0.026, 0.026],
        [0.190, 0.034, 0.020, 0.022],
        [0.205, 0.014, 0.009, 0.018],
    ]
    .map(|[z, width, height, y]| Ring::along(z, width, height, y))
    .to_vec();
    let foot = tube(&[vec![closed(foot[0])], foot.clone(), vec![closed(foot[9])]].concat(), 16);
    Shape::joined([shaft, foot]).moved(0.09, 0.0, 0.0)
}
