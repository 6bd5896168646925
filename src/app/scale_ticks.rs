//! The numbers below a colour scale. In: its ends. Out: round numbers and where they stand.

use super::numbers::short;

/// A number and the part of the scale where it stands, 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    pub part: f64,
    pub label: String,
}

/// Numbers at most, so that they do not run into each other.
const MOST: i32 = 6;

/// Ends that are no scale (equal, not finite, or not above 0 where it is logarithmic) have none.
pub fn ticks([low, high]: [f64; 2], is_logarithmic: bool) -> Vec<Tick> {
    if !(low.is_finite() && high.is_finite() && low < high) || is_logarithmic && low <= 0.0 {
        return Vec::new();
    }
    let values = if is_logarithmic { powers_of_ten(low, high) } else { multiples(low, high) };
    let part = |value: f64| match is_logarithmic {
        true => (value / low).ln() / (high / low).ln(),
        false => (value - low) / (high - low),
    };
    let tick = |value: f64| Tick { part: part(value).clamp(0.0, 1.0), label: short(value) };
    values.into_iter().map(tick).collect()
}

/// Every power of ten from low to high, or every second, and so on; the ends where there are not two.
fn powers_of_ten(low: f64, high: f64) -> Vec<f64> {
    let first = (low.log10() - 1e-9).ceil() as i32;
    let last = (high.log10() + 1e-9).floor() as i32;
    if last <= first {
        return vec![low, high];
    }
    let step = (last - first) / MOST + 1;
    (first..=last).filter(|power| (power - first) % step == 0).map(|power| 10_f64.powi(power)).collect()
}

/// Multiples of 1, 2 or 5 times a power of ten.
fn multiples(low: f64, high: f64) -> Vec<f64> {
    let rough = (high - low) / f64::from(MOST - 1);
    let decade = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|digit| digit * decade).into_iter().find(|step| *step >= rough);
    let step = step.unwrap_or(10.0 * decade);
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    (0..=(last - first) as i32).map(|count| (first + f64::from(count)) * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(range: [f64; 2], is_logarithmic: bool) -> Vec<String> {
        ticks(range, is_logarithmic).into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn logarithmic_scales_have_powers_of_ten() {
        assert_eq!(labels([0.01, 100.0], true), ["0.01", "0.1", "1", "10", "100"]);
        assert_eq!(labels([3e-9, 2e9], true), ["1e-8", "1e-5", "0.01", "10", "10000", "1e7"]);
        assert_eq!(labels([2.0, 8.0], true), ["2", "8"], "no two powers of ten: the ends");
        let parts: Vec<f64> = ticks([0.1, 1000.0], true).iter().map(|tick| tick.part).collect();
        assert!(parts.iter().zip([0.0, 0.25, 0.5, 0.75, 1.0]).all(|(part, at)| (part - at).abs() < 1e-9), "{parts:?}");
    }

    #[test]
    fn linear_scales_have_round_multiples() {
        assert_eq!(labels([0.0, 1.0], false), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
        assert_eq!(labels([0.0, 1234.0], false), ["0", "500", "1000"]);
        assert_eq!(labels([0.0, 3.2e7], false), ["0", "1e7", "2e7", "3e7"]);
    }

    #[test]
    fn what_is_no_scale_has_no_numbers() {
        for (range, is_logarithmic) in
            [([0.0, 1.0], true), ([1.0, 1.0], false), ([f64::NAN, 1.0], false), ([0.0, f64::INFINITY], false)]
        {
            assert!(ticks(range, is_logarithmic).is_empty(), "{range:?}");
        }
    }
}
