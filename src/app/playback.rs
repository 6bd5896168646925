//! The clock of the timeline. The shown time is always computed from where playing started, never
//! summed up frame by frame: playing to t and scrubbing to t ask for the same number.

/// One press of a step button.
pub const STEP_SECS: f64 = 1.0 / 30.0;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Playback {
    pub looped: bool,
    /// Seconds of the clip a second of the clock; negative plays backwards.
    pub speed: f64,
    started: Option<Start>,
}

/// Playing started when the clock showed `clock_secs`, at `time_secs` of the clip.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Start {
    clock_secs: f64,
    time_secs: f64,
}

impl Default for Playback {
    fn default() -> Self {
        Self { looped: true, speed: 1.0, started: None }
    }
}

impl Playback {
    pub fn is_playing(&self) -> bool {
        self.started.is_some()
    }

    /// Starts, or starts anew from another time; at the end of a clip that does not loop it begins again.
    pub fn play(&mut self, clock_secs: f64, time_secs: f64, duration_secs: f64) {
        let over = !self.looped && time_secs >= duration_secs && self.speed > 0.0;
        self.started = Some(Start { clock_secs, time_secs: if over { 0.0 } else { time_secs } });
    }

    pub fn pause(&mut self) {
        self.started = None;
    }

    /// The time to show at this moment; stops at the end of a clip that does not loop. `None` while paused.
    pub fn advance(&mut self, clock_secs: f64, duration_secs: f64) -> Option<f64> {
        let start = self.started?;
        let time = start.time_secs + (clock_secs - start.clock_secs) * self.speed;
        if self.looped && duration_secs > 0.0 {
            return Some(time.rem_euclid(duration_secs));
        }
        let shown = time.clamp(0.0, duration_secs);
        if shown != time {
            self.started = None;
        }
        Some(shown)
    }
}

/// The next multiple of a step, in either direction; wraps only where the clip loops.
pub fn stepped(time_secs: f64, steps: i32, duration_secs: f64, looped: bool) -> f64 {
    let grid = time_secs / STEP_SECS;
    // On a step already, up to rounding: go to its neighbour. Between two: the nearer bound counts as the first step.
    let from = if (grid - grid.round()).abs() < 1e-6 {
        grid.round()
    } else if steps > 0 {
        grid.floor()
    } else {
        grid.ceil()
    };
    let time = (from + f64::from(steps)) * STEP_SECS;
    match (looped && duration_secs > 0.0, time < 0.0, time > duration_secs) {
        (true, true, _) => (duration_secs / STEP_SECS).floor() * STEP_SECS,
        (true, _, true) => 0.0,
        _ => time.clamp(0.0, duration_secs),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_looped_clip_wraps_and_a_single_one_stops_at_its_end() {
        let mut playback = Playback::default();
        playback.play(10.0, 0.5, 2.0);
        assert_eq!(playback.advance(11.0, 2.0), Some(1.5));
        assert_eq!(playback.advance(12.0, 2.0), Some(0.5));
        playback.looped = false;
        assert_eq!(playback.advance(99.0, 2.0), Some(2.0));
        assert!(!playback.is_playing());
    }

    #[test]
    fn a_million_frames_do_not_drift() {
        let mut playback = Playback::default();
        playback.play(0.0, 0.0, 1e9);
        let last = (1..=1_000_000).filter_map(|frame| playback.advance(f64::from(frame) / 60.0, 1e9)).last();
        assert_eq!(last, Some(1e6 / 60.0));
    }

    #[test]
    fn steps_land_on_thirtieths_and_wrap_only_in_a_loop() {
        assert_eq!(stepped(0.05, 1, 1.0, false), 2.0 * STEP_SECS);
        assert_eq!(stepped(0.05, -1, 1.0, false), STEP_SECS);
        assert_eq!(stepped(2.0 * STEP_SECS, -1, 1.0, false), STEP_SECS);
        assert_eq!(stepped(0.0, -1, 1.0, false), 0.0);
        assert_eq!(stepped(0.0, -1, 1.0, true), 1.0);
        assert_eq!(stepped(1.0, 1, 1.0, true), 0.0);
        assert_eq!(stepped(0.0, 1, 0.0, true), 0.0);
    }
}
