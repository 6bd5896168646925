//! The traveller who walks round the fountain.

use super::super::character::add_person;
use super::super::character::gait::{Circle, wave};
use super::super::glb::{ClipWriter, GlbWriter};
use super::palette::Palette;
use super::walk::WALK_SECS;

/// One lap of `walk`; at its start the traveller comes towards the camera.
const PATH: Circle = Circle { radius_m: 2.2, lap_secs: WALK_SECS, strides: 11.0, start_radians: -1.95 };
const WAVE_SECS: f64 = 4.0;
/// Towards the camera from where `walk` starts.
const WAVE_HEADING_RADIANS: f64 = 0.79;

/// Adds the traveller and its part of `walk`; returns the clip `wave`.
pub fn add(glb: &mut GlbWriter, palette: &Palette, walk: &mut ClipWriter) -> ClipWriter {
    let person = add_person(glb, "traveller", &palette.cloths, &PATH.pose(0.0));
    person.animate(walk, &PATH.key_times(), |time| PATH.pose(time));

    let mut waving = ClipWriter::new("wave");
    let place = PATH.pose(0.0).root;
    let times: Vec<f64> = (0..=80).map(|key| WAVE_SECS * f64::from(key) / 80.0).collect();
    person.animate(&mut waving, &times, |time| wave(place, WAVE_HEADING_RADIANS, time, WAVE_SECS));
    waving
}
