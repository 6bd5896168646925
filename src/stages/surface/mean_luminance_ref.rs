//! Reference of `mean_luminance.wgsl`: the mean of logarithms that were summed in parts, and the exposure by it.

use crate::stages::pixels::MEAN_SHOWN_AS;

/// The geometric mean from sums of log2 and counts; `None` where nothing shines.
pub fn mean_luminance(sums: &[[f32; 2]]) -> Option<f64> {
    let [sum, count] =
        sums.iter().fold([0.0, 0.0], |[sum, count], part| [sum + f64::from(part[0]), count + f64::from(part[1])]);
    (count > 0.0).then(|| (sum / count).exp2())
}

/// What shows that mean as it should be shown.
pub fn factor(mean: Option<f64>) -> f64 {
    mean.map_or(1.0, |mean| MEAN_SHOWN_AS / mean)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_much_of_half_as_of_eight_is_two() {
        let mean = mean_luminance(&[[-3.0, 3.0], [9.0, 3.0], [0.0, 0.0]]);
        assert_eq!((mean, factor(mean)), (Some(2.0), MEAN_SHOWN_AS / 2.0));
        assert_eq!((mean_luminance(&[[0.0; 2]; 4]), factor(None)), (None, 1.0));
    }
}
