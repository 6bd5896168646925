//! How long things may take that a frame of the window waits for.

use std::time::Duration;

/// How often a progress bar is redrawn.
pub const PROGRESS_STEP: Duration = Duration::from_millis(100);

#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// GPU time of a frame of the window that nobody touches.
    pub budget: Duration,
    /// The same while input arrives: the next input waits for this, and for the frame after it.
    pub budget_under_input: Duration,
    /// An exact set that takes no longer than this is waited for.
    pub blink: Duration,
}

impl Default for Pace {
    fn default() -> Self {
        let [budget, budget_under_input, blink] = [30, 15, 250].map(Duration::from_millis);
        Self { budget, budget_under_input, blink }
    }
}
