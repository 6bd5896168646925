//! Reference of `sum_luminance.wgsl`: the geometric mean of luminances, over pixels that show a surface and
//! are not black.

use crate::color::luminance;

/// `None` where nothing shines.
pub fn mean_luminance(shown: &[[f32; 4]]) -> Option<f64> {
    let of_pixel = |[r, g, b, _]: [f32; 4]| luminance([r, g, b].map(f64::from));
    let lit = shown.iter().filter(|pixel| pixel[3] > 0.0).map(|pixel| of_pixel(*pixel)).filter(|light| *light > 0.0);
    let (sum, count) = lit.fold((0.0, 0.0), |(sum, count), light| (sum + light.ln(), count + 1.0));
    (count > 0.0).then(|| f64::exp(sum / count))
}
