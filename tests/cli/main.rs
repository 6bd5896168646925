//! The program as a script sees it: exit codes, standard output, files.

mod files;
mod hidden;
mod pictures;
mod reports;
mod scenes;
mod wrong_usage;

use std::ffi::OsStr;
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

/// A small grid, and the adapter that `OCTOLUME_TEST_ADAPTER` names, else the best.
const GRID: [&str; 2] = ["--grid", "64"];

/// Runs the program without standard input.
fn octolume<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Output {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("octolume"));
    command.args(arguments);
    command.output().expect("the program starts")
}

/// On the test's adapter and a small grid.
fn on_small_grid<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Output {
    let mut all: Vec<std::ffi::OsString> = arguments.into_iter().map(|text| text.as_ref().to_owned()).collect();
    all.extend(GRID.map(Into::into));
    if let Ok(adapter) = std::env::var("OCTOLUME_TEST_ADAPTER") {
        all.extend(["--adapter".into(), adapter.into()]);
    }
    octolume(all)
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
