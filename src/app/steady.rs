//! The exposure while a clip plays: that of the picture before, so that a moving character does not make everything
//! flicker. Whatever else changes is measured anew.

use crate::settings::{MotionSettings, Settings};

#[derive(Default)]
pub struct SteadyExposure {
    held: Option<Held>,
}

struct Held {
    /// For which it was measured, whatever the moment.
    settings: Settings,
    /// Results that were there when it was first asked for.
    results: u64,
    /// `None` until a picture of it is there.
    stops: Option<f64>,
}

impl SteadyExposure {
    /// Sets the exposure of an automatic one while the clip plays. `measured`: how many results there were, and the
    /// exposure of the last.
    pub fn hold(&mut self, settings: &mut Settings, is_playing: bool, (results, exposure): (u64, f64)) {
        let look = &settings.method.look;
        if !look.is_exposed() || look.exposure_stops.is_some() {
            self.held = None;
            return;
        }
        let mut still = settings.clone();
        still.shot.motion = MotionSettings { clip: still.shot.motion.clip, ..MotionSettings::default() };
        let held = match self.held.take().filter(|held| held.settings == still) {
            Some(held) if held.stops.is_none() || !is_playing => {
                let stops = (results > held.results && exposure > 0.0).then(|| exposure.log2());
                Held { stops, ..held }
            }
            Some(held) => held,
            None => Held { settings: still, results, stops: None },
        };
        if is_playing {
            settings.method.look.exposure_stops = held.stops;
        }
        self.held = Some(held);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::View;

    fn at(time_secs: f64) -> Settings {
        let mut settings = Settings::default();
        settings.method.look.view = View::Surfaces;
        settings.shot.motion.time_secs = time_secs;
        settings
    }

    /// What is asked for, in stops.
    fn asked(steady: &mut SteadyExposure, mut settings: Settings, playing: bool, measured: (u64, f64)) -> Option<f64> {
        steady.hold(&mut settings, playing, measured);
        settings.method.look.exposure_stops
    }

    #[test]
    fn a_playing_clip_keeps_the_exposure_of_the_picture_before() {
        let mut steady = SteadyExposure::default();
        assert_eq!(asked(&mut steady, at(0.0), false, (0, 1.0)), None);
        assert_eq!(asked(&mut steady, at(0.0), false, (1, 4.0)), None);
        assert_eq!(asked(&mut steady, at(0.1), true, (1, 4.0)), Some(2.0));
        assert_eq!(asked(&mut steady, at(0.2), true, (2, 8.0)), Some(2.0));
        // Stopped, it is measured again.
        assert_eq!(asked(&mut steady, at(0.2), false, (3, 8.0)), None);
        assert_eq!(asked(&mut steady, at(0.3), true, (4, 8.0)), Some(3.0));
    }

    #[test]
    fn what_changes_while_it_plays_is_measured_anew_once() {
        let mut steady = SteadyExposure::default();
        assert_eq!(asked(&mut steady, at(0.0), true, (5, 4.0)), None);
        assert_eq!(asked(&mut steady, at(0.1), true, (6, 4.0)), Some(2.0));
        let mut sky = at(0.2);
        sky.method.lighting.sky_nits = [3.0; 3];
        assert_eq!(asked(&mut steady, sky.clone(), true, (6, 4.0)), None);
        assert_eq!(asked(&mut steady, sky.clone(), true, (7, 0.5)), Some(-1.0));
        assert_eq!(asked(&mut steady, sky, true, (8, 0.25)), Some(-1.0));
        let mut set = at(0.4);
        set.method.look.exposure_stops = Some(7.0);
        assert_eq!(asked(&mut steady, set, true, (9, 128.0)), Some(7.0));
    }
}
