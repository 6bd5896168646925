//! Reference of `march_light`: what a node of stored light shows; the march itself is `march_ref`'s.

use glam::DVec3;

use super::march_ref::Shown;

/// `stored`: light times opacity, and opacity, above zero. Not shaded: light is what it is.
pub fn shown(stored: [f64; 4], factor: f64) -> Shown {
    let [r, g, b, opacity] = stored;
    Shown { occupancy: opacity, color: DVec3::new(r, g, b) / opacity * factor, normal: DVec3::ZERO, shaded: false }
}
