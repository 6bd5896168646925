//! Which clip of the scene moves it, and how far it goes.

use super::{MotionError, Prepared};
use crate::scene::Scene;
use crate::settings::MotionSettings;

/// [`Prepared::clip_index`], before anything is prepared.
pub(super) fn clip_index(scene: &Scene, motion: &MotionSettings) -> Result<Option<usize>, MotionError> {
    let clips = &scene.clips;
    let Some(name) = &motion.clip else { return Ok(scene.first_clip()) };
    if name.is_empty() {
        return Ok(None);
    }
    let by_number = || name.parse().ok().filter(|number| *number < clips.len());
    let index = clips.iter().position(|clip| &clip.name == name).or_else(by_number);
    index.map(Some).ok_or_else(|| MotionError::UnknownClip {
        scene: scene.name.clone(),
        clip: name.clone(),
        known: match clips.len() {
            0 => "none".to_owned(),
            _ => clips.iter().map(|clip| format!("\"{}\"", clip.name)).collect::<Vec<_>>().join(", "),
        },
    })
}

impl Prepared {
    /// Clip by name, or else by number from 0: the first where none is named, the rest pose for an empty name.
    pub fn clip_index(&self, motion: &MotionSettings) -> Result<Option<usize>, MotionError> {
        clip_index(&self.scene, motion)
    }

    /// The time is one that the clip does not reach, a sentence. A clip holds its last pose after its end, which looks
    /// like a stopped animation.
    pub fn past_clip(&self, motion: &MotionSettings) -> Option<String> {
        let clip = self.clip_index(motion).ok()?.map(|clip| &self.scene.clips[clip]);
        match clip {
            Some(clip) if motion.time_secs > clip.duration_secs => {
                Some(format!("clip \"{}\" ends at {} s; its last pose is shown", clip.name, clip.duration_secs))
            }
            None if motion.time_secs > 0.0 => Some("no clip is played, so the time changes nothing".to_owned()),
            _ => None,
        }
    }
}
