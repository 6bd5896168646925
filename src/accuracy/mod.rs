//! What is true: rays through the posed triangles and a path tracer, and how far shadows and pictures are from them;
//! and which poses and lights are compared.

mod cut_outs;
pub mod path_tracer;
pub mod picture_error;
pub mod posed_triangles;
pub mod ray_tree;
pub mod shadows;
pub mod triangle;

use crate::lights::{KnownLight, LightSource};
use crate::prepare::{MotionError, Prepared};
use crate::settings::MotionSettings;
use crate::settings::lighting::{LightEdit, Lighting, SunShines};

/// Turns of a scene that plays no clip: not at all, a little, and by no simple fraction.
pub const STATIC_TURNS_DEGREES: [f64; 3] = [0.0, 10.0, 37.0];

/// Where in a clip is compared, as shares of its length.
const CLIP_SHARES: [f64; 3] = [0.25, 0.5, 0.75];

/// Three poses that show what a scene's motion does to its voxels: moments of the clip that is
/// played, or turns about the vertical axis where none is.
pub fn default_poses(prepared: &Prepared, motion: &MotionSettings) -> Result<Vec<MotionSettings>, MotionError> {
    let moving = prepared.clip_index(motion)?.map(|clip| prepared.scene.clips[clip].duration_secs);
    Ok(match moving.filter(|duration_secs| *duration_secs > 0.0) {
        Some(duration_secs) => at_times(motion, &CLIP_SHARES.map(|share| share * duration_secs)),
        None => turned(motion, &STATIC_TURNS_DEGREES),
    })
}

/// The same motion at other times.
pub fn at_times(motion: &MotionSettings, times_secs: &[f64]) -> Vec<MotionSettings> {
    times_secs.iter().map(|&time_secs| MotionSettings { time_secs, ..motion.clone() }).collect()
}

/// The same motion, further turned about the vertical axis.
pub fn turned(motion: &MotionSettings, turns_degrees: &[f64]) -> Vec<MotionSettings> {
    let turned = |degrees: &f64| {
        let [x, y, z] = motion.turn_degrees;
        MotionSettings { turn_degrees: [x, y + degrees, z], ..motion.clone() }
    };
    turns_degrees.iter().map(turned).collect()
}

/// Of nothing it is nothing.
pub fn percent(part: u64, whole: u64) -> f64 {
    if whole == 0 { 0.0 } else { 100.0 * part as f64 / whole as f64 }
}

/// Lighting with one light alone: no other light, no sky, no emission, no bounces. `known`: all there are.
pub fn alone(lighting: &Lighting, known: &[KnownLight], source: LightSource) -> Lighting {
    let mut lighting = Lighting { sky_nits: [0.0; 3], emission: 0.0, bounces: 0, ..lighting.clone() };
    lighting.sun.shines = SunShines::Never;
    for light in known {
        let on = light.source == source;
        match light.source {
            LightSource::Node(node) => drop(lighting.edits.insert(node, LightEdit { on, ..light.light })),
            LightSource::Sun if on => lighting.sun.shines = SunShines::Always,
            LightSource::Sun => {}
            LightSource::Added(index) => {
                lighting.added.get_mut(index).into_iter().for_each(|added| added.light.on = on)
            }
        }
    }
    lighting
}
