//! The broken, odd and unsupported files of the shared corpus, each in a process of its own: opened
//! with what is sound and a warning, or refused in a sentence; soon, and in little memory.
//!
//! `EXPECTED.tsv` beside the corpus says which files are `invalid`, `valid-but-odd` or `unsupported`
//! and which error codes the official validator gives them.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use assert_cmd::Command;
use rayon::prelude::*;
use serde_json::Value;

use crate::defects;
use crate::real_scenes::real_scenes;

/// What a file may take.
const TIME_LIMIT: Duration = Duration::from_secs(10);
const MEMORY_LIMIT_KIB: u64 = 1024 * 1024;

/// A line of `EXPECTED.tsv`.
struct Row {
    file: String,
    kind: String,
    codes: String,
}

/// How the program ended on a file.
struct Outcome {
    exit_code: Option<i32>,
    secs: f64,
    errors: String,
    /// Of the JSON on standard output, where the file opened.
    warnings: Vec<String>,
}

fn rows(folder: &Path) -> Vec<Row> {
    let table = fs::read_to_string(folder.join("EXPECTED.tsv")).expect("EXPECTED.tsv");
    let row = |line: &str| {
        let mut fields = line.split('\t').map(str::to_owned);
        let mut field = || fields.next().expect("a field");
        let (file, kind) = (field(), field());
        Row { file, kind, codes: fields.nth(2).expect("the codes") }
    };
    table.lines().skip(1).map(row).collect()
}

/// `octolume info FILE --json` under both limits. The memory limit counts what the process itself
/// allocates and not the address space, of which a software GPU's compiler reserves gigabytes.
fn inspect(file: &Path) -> Outcome {
    let start = Instant::now();
    let mut command = Command::new("sh");
    command.args(["-c", &format!("ulimit -d {MEMORY_LIMIT_KIB}; exec \"$@\""), "sh"]);
    command.arg(assert_cmd::cargo::cargo_bin!("octolume")).arg("info").arg(file).args([
        "--json",
        "--grid",
        "64",
        "--no-cache",
    ]);
    let output = command.timeout(TIME_LIMIT).output().expect("the program starts");
    let json: Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
    let warnings = json["warnings"].as_array().into_iter().flatten();
    Outcome {
        exit_code: output.status.code(),
        secs: start.elapsed().as_secs_f64(),
        errors: String::from_utf8_lossy(&output.stderr).trim_end().to_owned(),
        warnings: warnings.filter_map(|warning| warning.as_str().map(str::to_owned)).collect(),
    }
}

/// Why a row does not hold what is asked of it.
fn judge(row: &Row, file: &Path, outcome: &Outcome) -> Result<(), String> {
    let errors = &outcome.errors;
    match (row.kind.as_str(), outcome.exit_code) {
        (_, None) => return Err("ended by a signal: out of memory or out of time".to_owned()),
        (_, Some(0 | 1)) if errors.contains("panicked at") => return Err("panicked".to_owned()),
        ("valid-but-odd", Some(0)) => return Ok(()),
        ("invalid", Some(0)) => printed(&outcome.warnings, errors)?,
        ("invalid" | "unsupported", Some(1)) => {
            let start = format!("error: {}: ", file.display());
            let sentence = errors.lines().last().and_then(|sentence| sentence.strip_prefix(&start));
            sentence.filter(|cause| !cause.is_empty()).ok_or_else(|| format!("says {errors:?}"))?;
        }
        (kind, Some(code)) => return Err(format!("{kind}, and exits {code}: {errors}")),
    }
    match row.codes.is_empty() || defects::is_named(&row.file, &row.codes, errors) {
        true => Ok(()),
        false => Err(format!("none of its defects is named: {errors}")),
    }
}

/// Every warning of the JSON is a line of standard error, and there is one.
fn printed(warnings: &[String], errors: &str) -> Result<(), String> {
    if warnings.is_empty() {
        return Err("opened without a warning".to_owned());
    }
    match warnings.iter().find(|warning| !errors.lines().any(|line| line == format!("warning: {warning}"))) {
        Some(silent) => Err(format!("does not print {silent:?} as a line")),
        None => Ok(()),
    }
}

#[test]
fn no_broken_file_hurts() {
    let Some(folder) = real_scenes() else { return };
    let rows = rows(&folder);
    assert!(rows.len() > 200, "{} rows", rows.len());
    let judged: Vec<(String, Option<String>)> = rows
        .par_iter()
        .map(|row| {
            let file = folder.join(&row.file);
            let outcome = inspect(&file);
            let said = outcome.errors.replace(&format!("{}/", folder.display()), "").replace('\n', " / ");
            let code = outcome.exit_code.map_or("signal".to_owned(), |code| code.to_string());
            let line = format!("{} | {} | {code} | {:.2} s | {} | {said}", row.file, row.kind, outcome.secs, row.codes);
            (line, judge(row, &file, &outcome).err().map(|why| format!("{} [{}]: {why}", row.file, row.codes)))
        })
        .collect();
    println!("file | kind | exit | time | validator | standard error");
    judged.iter().for_each(|(line, _)| println!("{line}"));
    let failed: Vec<&str> = judged.iter().filter_map(|(_, why)| why.as_deref()).collect();
    assert!(failed.is_empty(), "{} of {} files:\n{}", failed.len(), rows.len(), failed.join("\n"));
}
