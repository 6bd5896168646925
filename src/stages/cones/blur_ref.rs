//! Reference of `blur` and of the weights that it shares with `upsample`, in f64.

use glam::{DVec3, DVec4};

/// A pixel's surface as a filter sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterPoint {
    /// Cells.
    pub position: DVec3,
    /// Unit vectors: as shaded, and of the triangle.
    pub normal: DVec3,
    pub face: DVec3,
    /// From the eye, cells.
    pub distance: f64,
    /// Width of a pixel of the surfaces there, cells.
    pub pixel_cells: f64,
}

/// How much another surface has in common with this one: exp2(−(distance from its plane / width)²) times the
/// cosine between their normals to the fourth power.
pub fn alike(point: &FilterPoint, other: &FilterPoint, width_cells: f64) -> f64 {
    let away = (other.position - point.position).dot(point.face) / width_cells;
    (-away * away).exp2() * point.normal.dot(other.normal).max(0.0).powi(4)
}

/// Within which surfaces count as one: a voxel, or the `pixels` between two that are filtered.
pub fn plane_width(point: &FilterPoint, pixels: f64) -> f64 {
    (pixels * point.pixel_cells).max(1.0)
}

/// A Gaussian of σ = half a pattern, over the sum of those of all pixels within a pattern that trace the same part:
/// at most one to each side, or three where the pixel itself is one of them.
fn weight_at(away_px: u32, pattern_px: u32) -> f64 {
    let pattern = f64::from(pattern_px);
    let gaussian = |pixels: f64| (-(pixels / (0.5 * pattern)).powi(2) / 2.0).exp();
    let away = f64::from(away_px);
    let alike = match away_px.is_multiple_of(pattern_px) {
        true => gaussian(0.0) + 2.0 * gaussian(pattern),
        false => gaussian(away) + gaussian(pattern - away),
    };
    gaussian(away) / alike
}

/// Along one line of an image: its surfaces (`None`: background), its values, the pixels of the surfaces
/// between two of its own. Background stays as it is.
pub fn blur_line(points: &[Option<FilterPoint>], values: &[DVec4], pattern_px: u32, spacing_px: f64) -> Vec<DVec4> {
    let blurred = |(i, point): (usize, &Option<FilterPoint>)| {
        let Some(point) = point else { return values[i] };
        let width = plane_width(point, spacing_px);
        let (mut sum, mut weight) = (DVec4::ZERO, 0.0);
        let last = (i + pattern_px as usize).min(points.len() - 1);
        for j in i.saturating_sub(pattern_px as usize)..=last {
            let Some(other) = &points[j] else { continue };
            // A normal is stored with an error, but a pixel is itself.
            let w = weight_at(i.abs_diff(j) as u32, pattern_px) * if i == j { 1.0 } else { alike(point, other, width) };
            (sum, weight) = (sum + values[j] * w, weight + w);
        }
        sum / weight
    };
    points.iter().enumerate().map(blurred).collect()
}
