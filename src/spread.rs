//! Median and percentiles of repeated measurements.

use serde::Serialize;

/// Of times in milliseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    pub median_ms: f64,
    pub p5_ms: f64,
    pub p95_ms: f64,
}

impl Spread {
    /// `None` for no times.
    pub fn of(times_ms: &[f64]) -> Option<Self> {
        let mut sorted = times_ms.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |share| quantile(&sorted, share);
        Some(Self { median_ms: at(0.5)?, p5_ms: at(0.05)?, p95_ms: at(0.95)? })
    }
}

/// Linear between the two nearest ranks.
fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let place = share * (sorted.len().checked_sub(1)?) as f64;
    let (below, above) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
    Some(below + (above - below) * place.fract())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_lie_between_ranks() {
        let spread = Spread::of(&[4.0, 1.0, 3.0, 2.0, 5.0]).unwrap();
        assert_eq!(spread.median_ms, 3.0);
        assert!((spread.p5_ms - 1.2).abs() < 1e-12 && (spread.p95_ms - 4.8).abs() < 1e-12);
        assert_eq!(Spread::of(&[7.0]), Some(Spread { median_ms: 7.0, p5_ms: 7.0, p95_ms: 7.0 }));
        assert_eq!(Spread::of(&[]), None);
    }
}
