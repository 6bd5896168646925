//! The program as a script sees it: exit codes, standard output, files.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::unreachable,
    clippy::unwrap_used,
    reason = "a test fails by panicking"
)]

mod cache;
mod corpus;
mod defects;
mod files;
mod hidden;
mod lights;
mod lit_surfaces;
mod misfits;
mod models;
mod node;
mod pictures;
#[path = "../suite/real_scenes.rs"]
mod real_scenes;
mod reference;
mod reports;
mod scenes;
mod shots;
mod walls;
mod wrong_usage;

use std::ffi::{OsStr, OsString};
use std::process::Output;

use assert_cmd::Command;
use octolume::disk_cache::FOLDER_VARIABLE;
use serde_json::Value;

/// The program, keeping no voxels from one run to the next: a test finds only what it made itself.
fn program() -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("octolume"));
    command.env(FOLDER_VARIABLE, "");
    command
}

/// Runs the program without standard input.
fn octolume<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Output {
    program().args(arguments).output().expect("the program starts")
}

/// A small grid, and the adapter that `OCTOLUME_TEST_ADAPTER` names, else the best.
fn small_grid() -> Vec<String> {
    let adapter = std::env::var("OCTOLUME_TEST_ADAPTER").ok();
    let adapter = adapter.into_iter().flat_map(|adapter| ["--adapter".to_owned(), adapter]);
    ["--grid", "64"].map(str::to_owned).into_iter().chain(adapter).collect()
}

/// On the test's adapter and a small grid.
fn on_small_grid<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Output {
    let arguments = arguments.into_iter().map(|text| text.as_ref().to_owned());
    octolume(arguments.chain(small_grid().into_iter().map(OsString::from)))
}

/// Runs what must succeed; standard output.
fn succeed<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> String {
    let output = on_small_grid(arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// Runs what must succeed and print JSON.
fn json<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Value {
    serde_json::from_str(&succeed(arguments)).expect("JSON")
}

/// Names of an object's fields, sorted.
fn fields(value: &Value) -> Vec<&str> {
    let object = value.as_object().expect("an object");
    let mut names: Vec<&str> = object.keys().map(String::as_str).collect();
    names.sort_unstable();
    names
}
