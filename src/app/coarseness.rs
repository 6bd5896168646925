//! How coarse a moving picture is: fluid, and of one size as long as its cost allows.

/// A moving picture may cost the GPU this much.
const BUDGET_MS: f64 = 33.0;
/// A finer one is taken only where it is expected to cost no more than this, so that costs that come and go do not
/// make the picture sharp and coarse in turns.
const FINER_MS: f64 = 16.0;
/// What each edge may be divided by.
const STEPS: [u32; 3] = [1, 2, 4];

/// What each edge of the last moving picture was divided by.
pub struct Coarseness(u32);

impl Default for Coarseness {
    fn default() -> Self {
        Self(STEPS[0])
    }
}

impl Coarseness {
    /// Of the next moving picture, given what a pixel cost last.
    pub fn next(&mut self, ms_per_pixel: f64, full_px: [u32; 2]) -> u32 {
        let full_ms = ms_per_pixel * full_px.map(f64::from).iter().product::<f64>();
        let fits = |ms: f64| {
            STEPS.into_iter().find(|&step| full_ms / f64::from(step * step) <= ms).unwrap_or(STEPS[STEPS.len() - 1])
        };
        self.0 = self.0.clamp(fits(BUDGET_MS), fits(FINER_MS));
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FULL_PX: [u32; 2] = [1000, 1000];

    #[test]
    fn a_moving_picture_is_only_as_coarse_as_it_must_be() {
        let first = |ms_per_pixel| Coarseness::default().next(ms_per_pixel, FULL_PX);
        assert_eq!([0.0, 33e-6, 100e-6, 1e-3, f64::NAN].map(first), [1, 1, 2, 4, 4]);
    }

    #[test]
    fn costs_that_come_and_go_change_its_size_at_most_once() {
        for around_ms in [10.0, 20.0, 33.0, 50.0, 100.0, 132.0, 200.0, 500.0] {
            let mut coarseness = Coarseness::default();
            let costs = (0..100).map(|frame| around_ms * if frame % 3 == 0 { 1.3 } else { 0.8 } * 1e-6);
            let sizes: Vec<u32> = costs.map(|cost| coarseness.next(cost, FULL_PX)).collect();
            let changes = sizes.windows(2).filter(|pair| pair[0] != pair[1]).count();
            assert!(changes <= 1, "around {around_ms} ms: {sizes:?}");
        }
    }

    #[test]
    fn it_is_sharp_again_where_there_is_much_room() {
        let mut coarseness = Coarseness::default();
        assert_eq!([100e-6, 25e-6, 15e-6].map(|cost| coarseness.next(cost, FULL_PX)), [2, 2, 1]);
    }
}
