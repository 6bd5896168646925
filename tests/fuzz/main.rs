//! Fuzzes the loader: mutated bytes of GLB files, and mutated documents.
//!
//! Whatever the input, opening it ends soon with a scene or a sentence, without a panic and within
//! the memory that was allowed; an opened scene can be posed and voxelized. `cargo test` tries a
//! few thousand inputs; `OCTOLUME_FUZZ_SECONDS=1800 cargo test --test fuzz` tries for that long.
//! A finding is written to the target folder, and stays as a case of `amplifiers`.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::unreachable,
    clippy::unwrap_used,
    reason = "a test fails by panicking"
)]

mod amplifiers;
#[allow(dead_code, reason = "the other tests use the rest")]
#[path = "../suite/document.rs"]
mod document;
mod edit;
mod looks;
mod mutation;
mod odd;
mod oracle;
mod seeds;

use std::time::Duration;

use bolero::check;
use bolero::generator::{TypeGenerator, ValueGenerator, produce};
use peak_alloc::PeakAlloc;

use document::{BINARY_CHUNK, JSON_CHUNK, glb};
use edit::Edit;
use mutation::Mutation;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// Inputs a target tries where no time is given.
const ITERATIONS: usize = 2000;

/// Sets how long a target runs: both share the time that the environment gives.
macro_rules! limited {
    ($target:expr) => {
        match std::env::var("OCTOLUME_FUZZ_SECONDS").ok().and_then(|secs| secs.parse::<f64>().ok()) {
            Some(secs) => $target.with_test_time(Duration::from_secs_f64(secs)),
            None => $target.with_iterations(ITERATIONS),
        }
        .with_shrink_time(Duration::from_secs(20))
    };
}

/// So few changes that what comes after the first defect is reached too.
fn few<T: TypeGenerator + std::fmt::Debug>() -> impl ValueGenerator<Output = Vec<T>> {
    produce::<Vec<T>>().with().len(1_usize..=5)
}

#[test]
fn bytes() {
    let files: Vec<Vec<u8>> = seeds::all().iter().map(|document| document.glb()).collect();
    limited!(check!()).with_generator((produce(), few::<Edit>())).for_each(|(seed, edits): &(u8, Vec<Edit>)| {
        let mut file = files[usize::from(*seed) % files.len()].clone();
        edits.iter().for_each(|edit| edit.apply(&mut file));
        oracle::check(&oracle::turn(), &file);
    });
}

#[test]
fn documents() {
    let documents = seeds::all();
    limited!(check!()).with_generator((produce(), few::<Mutation>())).for_each(
        |(seed, mutations): &(u8, Vec<Mutation>)| {
            let (mut json, binary) = documents[usize::from(*seed) % documents.len()].parts();
            let mut binary = binary.to_vec();
            mutations.iter().for_each(|mutation| mutation.apply(&mut json, &mut binary));
            oracle::check(&oracle::turn(), &glb(&[(JSON_CHUNK, json.to_string().as_bytes()), (BINARY_CHUNK, &binary)]));
        },
    );
}

/// The seeds themselves open without a word, or mutations of them would stop at the first defect.
#[test]
fn seeds_are_sound() {
    for document in seeds::all() {
        let opened = octolume::scene::load::open_bytes("seed", &document.glb(), None, &Default::default());
        let scene = opened.unwrap_or_else(|error| panic!("{error}: {}", document.json));
        assert!(scene.meshes.iter().any(|mesh| mesh.triangle_count() > 0), "{}", document.json);
        assert_eq!(scene.warnings, [""; 0], "{}", document.json);
    }
}
