//! Random walks over all that can be set, on one engine: settings, clip, time, camera, hidden nodes, scenes, exact sets,
//! memory; requests arrive while frames are on their way. Whatever came before, the picture and the voxels at the end
//! are those of a fresh engine, bit for bit, and an error that was told was a true one.
//!
//! `OCTOLUME_WALKS=5000 cargo test --test suite walks` for more than the suite's own.

mod changes;
pub mod scenes;
mod walker;

use octolume::digest::Digest;
use octolume::plan::Asked;
use octolume::settings::Filter;

use walker::{Walk, walk};

/// Walks in the suite.
const WALKS: u64 = 100;
const STEPS: u32 = 30;

fn asked_for() -> u64 {
    std::env::var("OCTOLUME_WALKS").ok().and_then(|walks| walks.parse().ok()).unwrap_or(WALKS)
}

#[test]
fn whatever_came_before_the_end_is_that_of_a_fresh_engine() {
    let (walks, mut errors, mut frames) = (asked_for(), 0, 0);
    for seed in 0..walks {
        let walked = walk(&Walk { seed, steps: STEPS, compared_every: STEPS, told: None });
        let walked = walked.unwrap_or_else(|difference| panic!("walk {seed}: {difference}"));
        (errors, frames) = (errors + walked.errors, frames + walked.frames);
    }
    println!("{walks} walks of {STEPS} steps: {frames} frames, {errors} true errors");
    assert!(frames > 5 * walks && errors > 0, "a walk that makes no frames, or meets no error, shows nothing");
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
    assert!(is_caught(|asked| asked.settings.discretization.filter = Filter::Split), "masks forget the filter");
    assert!(is_caught(|asked| asked.settings.lighting.sky_nits = [0.5; 3]), "cones forget the sky");
}
