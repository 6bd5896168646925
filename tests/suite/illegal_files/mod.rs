//! Illegal files of our own, one for each error code of the official glTF validator that the shared
//! corpus shows: what must be said of it, and whether the rest is shown.

mod accessors;
mod animations;
mod containers;
mod meshes;
mod scenes;
mod structure;

use octolume::{
    progress::Progress,
    scene::{Scene, load},
};

use crate::document::Document;

/// What becomes of an illegal file.
#[derive(Debug)]
enum Outcome {
    /// Refused with a sentence that contains this.
    Refused(&'static str),
    /// Opened with a warning that contains this.
    Opened(&'static str),
    /// Opened without a word, for this reason.
    Harmless(&'static str),
}
use Outcome::{Harmless, Opened, Refused};

struct Case {
    /// Of the validator.
    code: &'static str,
    file: Vec<u8>,
    outcome: Outcome,
}

fn case(code: &'static str, file: Vec<u8>, outcome: Outcome) -> Case {
    Case { code, file, outcome }
}

/// A document with one thing changed, as a file.
fn with(mut document: Document, change: impl FnOnce(&mut Document)) -> Vec<u8> {
    change(&mut document);
    document.bytes()
}

/// A triangle with one thing changed.
fn triangle(change: impl FnOnce(&mut Document)) -> Vec<u8> {
    with(Document::with_triangle(), change)
}

/// A triangle bound to two joints, with one thing changed.
fn skinned(change: impl FnOnce(&mut Document)) -> Vec<u8> {
    with(two_joints(), change)
}

fn two_joints() -> Document {
    let mut document = Document::with_skin(2, &[([0, 1, 0, 0], [0.75, 0.25, 0.0, 0.0])]);
    let unit = glam::Mat4::IDENTITY.to_cols_array();
    let inverse_bind = document.floats("MAT4", &unit.repeat(2));
    document.json["skins"][0]["inverseBindMatrices"] = serde_json::json!(inverse_bind);
    document
}

fn all_cases() -> Vec<Case> {
    [containers::cases(), structure::cases(), accessors::cases(), meshes::cases(), scenes::cases(), animations::cases()]
        .into_iter()
        .flatten()
        .collect()
}

fn open(file: &[u8]) -> Result<Scene, load::LoadError> {
    load::open_bytes("illegal.gltf", file, None, &Progress::default())
}

/// What is wrong with how a case ended.
fn judge(case: &Case) -> Result<(), String> {
    match (&case.outcome, open(&case.file)) {
        (Refused(part), Err(error)) => {
            let sentence = error.to_string();
            let named = sentence.strip_prefix("illegal.gltf: ").is_some_and(|rest| rest.contains(part));
            if named { Ok(()) } else { Err(format!("not {part:?}: {sentence}")) }
        }
        (Opened(part), Ok(scene)) => match scene.warnings.iter().any(|warning| warning.sentence.contains(part)) {
            true => Ok(()),
            false => Err(format!("no warning has {part:?}: {:?}", scene.warnings)),
        },
        (Harmless(why), Ok(scene)) if scene.warnings.is_empty() && !why.is_empty() => Ok(()),
        (_, Ok(scene)) => Err(format!("opened, with {:?}", scene.warnings)),
        (_, Err(error)) => Err(format!("refused: {error}")),
    }
}

#[test]
fn every_class_is_refused_or_opened_with_its_name() {
    let cases = all_cases();
    let failed: Vec<String> = cases
        .iter()
        .filter_map(|case| judge(case).err().map(|why| format!("{}: {:?}: {why}", case.code, case.outcome)))
        .collect();
    assert!(failed.is_empty(), "{} of {}:\n{}", failed.len(), cases.len(), failed.join("\n"));
}

/// Without the defect there is nothing to say, or the cases would prove nothing.
#[test]
fn the_files_the_cases_start_from_are_legal() {
    let quiet = |document: Document| {
        for file in [document.bytes(), document.glb()] {
            let scene = open(&file).expect("opens");
            assert_eq!(scene.warnings, [""; 0]);
            assert_eq!(scene.meshes[0].triangle_count(), 1);
        }
    };
    quiet(Document::with_triangle());
    quiet(Document::with_triangle().with_clip());
    quiet(Document::with_triangle().with_texture(&scenes::png(), "image/png"));
    quiet(two_joints());
}

#[test]
fn every_code_of_the_corpus_has_a_case() {
    let Some(folder) = crate::real_scenes::real_scenes() else { return };
    let table = std::fs::read_to_string(folder.join("EXPECTED.tsv")).expect("EXPECTED.tsv");
    let ours: std::collections::BTreeSet<&str> = all_cases().iter().map(|case| case.code).collect();
    let codes = table.lines().skip(1).flat_map(|line| line.split('\t').nth(4).unwrap_or_default().split(", "));
    let missing: std::collections::BTreeSet<&str> = codes
        .filter_map(|code| code.split('(').next())
        .filter(|code| !code.is_empty() && !ours.contains(code))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}
