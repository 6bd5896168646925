//! The traveller who walks round the fountain.

use super::super::character::add_person;
use super::super::character::gait::{Circle, wave};
use super::super::glb::{ClipWriter, GlbWriter};
use super::palette::Palette;
use super::walk::WALK_SECS;

/// One lap of `walk`; at its start the traveller comes towards the camera.
const PATH: Circle = Circle { radius_m: 2.2, lap_secs: WALK_SECS, strides: 11.0, start_radians: -1.95 };
const KEYS_A_STRIDE: u32 = 16;
const WAVE_SECS: f64 = 4.0;
/// Towards the camera from where `walk` starts.
const WAVE_HEADING_RADIANS: f64 = 0.79;

/// Adds the traveller and its part of `walk`; returns the clip `wave`.
pub fn add(glb: &mut GlbWriter, palette: &Palette, walk: &mut ClipWriter) -> ClipWriter {
    let person = add_person(glb, "traveller", &palette.cloths, &PATH.pose(0.0));
    let keys = PATH.strides as u32 * KEYS_A_STRIDE;
    person.animate(walk, &times(WALK_SECS, keys), |time| PATH.pose(time));

    let mut waving = ClipWriter::new("wave");
    let place = PATH.pose(0.0).root;
    person.animate(&mut waving, &times(WAVE_SECS, 80), |time| wave(place, WAVE_HEADING_RADIANS, time, WAVE_SECS));
    waving
}

/// Evenly spaced key times, both ends included.
fn times(length_secs: f64, steps: u32) -> Vec<f64> {
    (0..=steps).map(|step| length_secs * f64::from(step) / f64::from(steps)).collect()
}
