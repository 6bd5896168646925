//! Reference of `march_light`: what a node of stored light shows, and what exposes it; the march itself is
//! `march_ref`'s.

use glam::DVec3;

use super::march_ref::DrawnCell;
use crate::color::luminance;
use crate::stages::pixels::MEAN_SHOWN_AS;

/// `stored`: light times opacity, and opacity, above zero. Not shaded: light is what it is.
pub fn shown(stored: [f64; 4], factor: f64) -> DrawnCell {
    let [r, g, b, opacity] = stored;
    DrawnCell { occupancy: opacity, color: DVec3::new(r, g, b) / opacity * factor, normal: DVec3::ZERO, shaded: false }
}

/// Luminance of the mean light of what the root stands for; `None` where there is none.
pub fn mean(root: [f64; 4]) -> Option<f64> {
    let [r, g, b, opacity] = root;
    (opacity > 0.0).then(|| luminance([r, g, b]) / opacity).filter(|mean| *mean > 0.0)
}

/// Shows that mean as it should be shown.
pub fn factor_of_mean(root: [f64; 4]) -> f64 {
    mean(root).map_or(1.0, |mean| MEAN_SHOWN_AS / mean)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_of_one_grey_is_shown_as_the_mean_is() {
        for opacity in [1e-6, 0.5, 1.0] {
            let stored = [3.0 * opacity, 3.0 * opacity, 3.0 * opacity, opacity];
            let color = shown(stored, factor_of_mean(stored)).color;
            assert!((color - MEAN_SHOWN_AS).abs().max_element() < 1e-12);
        }
        assert_eq!((factor_of_mean([0.0; 4]), factor_of_mean([0.0, 0.0, 0.0, 1.0])), (1.0, 1.0));
    }
}
