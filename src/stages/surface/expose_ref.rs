//! Reference of `expose.wgsl`: the luminance that a share of what is lit exceeds, and the exposure by it.

use super::count_luminance::LUMINANCE_BIN_SHIFT;
use super::expose::{BRIGHT_SHOWN_AS, LIT_TO_BRIGHTER};

/// From pixels a bin, those of a bin spread evenly over it; `None` where nothing shines.
pub fn bright(counts: &[u32]) -> Option<f64> {
    let begin = |bin: usize| f64::from(f32::from_bits((bin as u32) << LUMINANCE_BIN_SHIFT));
    let brighter = counts.iter().sum::<u32>() / LIT_TO_BRIGHTER;
    let mut above = 0;
    for (bin, &count) in counts.iter().enumerate().rev() {
        if above + count > brighter {
            let share = (f64::from(brighter - above) + 0.5) / f64::from(count);
            return Some(begin(bin + 1) + (begin(bin) - begin(bin + 1)) * share);
        }
        above += count;
    }
    None
}

/// What shows that luminance as it should be shown.
pub fn factor(bright: Option<f64>) -> f64 {
    bright.map_or(1.0, |bright| BRIGHT_SHOWN_AS / bright)
}

#[cfg(test)]
mod tests {
    use super::super::count_luminance_ref::counts;
    use super::*;

    fn of(luminances: impl IntoIterator<Item = f32>) -> Option<f64> {
        bright(&counts(&luminances.into_iter().map(|light| [light, light, light, 1.0]).collect::<Vec<_>>()))
    }

    /// A bin is a sixteenth of a stop's own width.
    #[test]
    fn what_a_twentieth_exceeds_is_bright() {
        let even = of((1..=1000).map(|step| step as f32 / 1000.0)).expect("shines");
        assert!((even - 0.95).abs() < 1.0 / 32.0, "{even}");
        let dark = of((0..1000).map(|step| if step < 900 { 1e-4 } else { 5.0 })).expect("shines");
        assert!((dark - 5.0).abs() < 5.0 / 16.0, "nine tenths in the dark do not decide: {dark}");
        let lamp = of((0..1000).map(|step| if step < 960 { 5.0 } else { 1e6 })).expect("shines");
        assert!((lamp - 5.0).abs() < 5.0 / 16.0, "a lamp does not decide: {lamp}");
        assert_eq!((of([]), of([0.0; 9]), factor(None)), (None, None, 1.0));
    }

    /// Less than a bin, whatever comes in or goes out at one end.
    #[test]
    fn a_few_pixels_more_change_little() {
        let before = of((0..10_000).map(|step| 1.0 + step as f32 / 10_000.0)).expect("shines");
        let after = of((0..10_100).map(|step| if step < 10_000 { 1.0 + step as f32 / 10_000.0 } else { 3.0 }));
        let stops = (after.expect("shines") / before).log2();
        assert!((0.0..0.01).contains(&stops), "{stops}");
    }
}
