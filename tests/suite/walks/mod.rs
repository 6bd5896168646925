//! Random walks over all that can be set, on one engine: settings, clip, time, camera, hidden nodes, scenes, exact sets,
//! memory; requests arrive while frames are on their way. Whatever came before, the picture and the voxels at the end
//! are those of a fresh engine, bit for bit, and an error that was told was a true one.
//!
//! `OCTOLUME_WALKS=5000 cargo test --test suite walks` for more than the suite's own; `OCTOLUME_WALKS=862..863` for some.

mod changes;
mod difference;
pub mod scenes;
mod walker;

use std::ops::Range;

use octolume::digest::Digest;
use octolume::plan::Asked;
use octolume::settings::Filter;

use walker::{Walk, walk};

/// Walks in the suite.
const WALKS: u64 = 100;
const STEPS: u32 = 30;

/// "5000" or "862..863".
fn asked_for() -> Range<u64> {
    let Ok(walks) = std::env::var("OCTOLUME_WALKS") else { return 0..WALKS };
    let (first, end) = walks.split_once("..").unwrap_or(("0", &walks));
    let number = |text: &str| text.parse().unwrap_or_else(|_| panic!("OCTOLUME_WALKS is {walks}, not N or A..B"));
    number(first)..number(end)
}

#[test]
fn whatever_came_before_the_end_is_that_of_a_fresh_engine() {
    let (walks, mut errors, mut frames) = (asked_for(), 0, 0);
    for seed in walks.clone() {
        let walked = walk(&Walk { seed, steps: STEPS, compared_every: STEPS, told: None });
        let walked = walked.unwrap_or_else(|difference| panic!("walk {seed}: {difference}"));
        (errors, frames) = (errors + walked.errors, frames + walked.frames);
    }
    let count = walks.end - walks.start;
    println!("{count} walks of {STEPS} steps: {frames} frames, {errors} true errors");
    assert!(
        frames > 5 * count && (errors > 0 || count < WALKS),
        "a walk that makes no frames, or meets no error, shows nothing"
    );
}

/// A plan that is not told of an input must be caught, or the walks show nothing.
fn is_caught(told: fn(&mut Asked)) -> bool {
    let walks = |seed| Walk { seed, steps: STEPS, compared_every: 3, told: Some(told) };
    (0..WALKS).any(|seed| walk(&walks(seed)).is_err())
}

#[test]
fn a_part_whose_key_forgets_an_input_is_caught() {
    assert!(is_caught(|asked| asked.contents.rigid = Digest::default()), "rigid voxels forget their matrices");
    assert!(is_caught(|asked| asked.contents.lights = Digest::default()), "light forgets the lights");
    assert!(is_caught(|asked| asked.contents.camera = Digest::default()), "the surface image forgets the camera");
    assert!(is_caught(|asked| asked.settings.method.discretization.filter = Filter::Split), "masks forget the filter");
    assert!(is_caught(|asked| asked.settings.method.lighting.sky_nits = [0.5; 3]), "cones forget the sky");
}
