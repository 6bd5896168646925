//! Measurements kept in `assets/measured`: what the program or a test said, and how it came about.
//!
//! ```text
//! { "command": "octolume …", "cores": 2, "report": { "octolume": version, "date", "adapter", "driver", … } }
//! ```

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::markdown::wrapped;
use crate::device::gpu;

/// The folder that tests write their tables into, where it is set.
const FOLDER: &str = "OCTOLUME_MEASURED";

#[derive(Serialize, Deserialize)]
struct Measured<R> {
    command: String,
    /// Of the CPU, all that run at once.
    cores: usize,
    report: R,
}

/// What a table of rows says.
#[derive(Serialize, Deserialize)]
pub struct Rows<R> {
    octolume: String,
    date: String,
    adapter: String,
    driver: String,
    pub rows: Vec<R>,
}

/// What all reports say of their making.
#[derive(Deserialize)]
struct Maker {
    octolume: String,
    date: String,
    adapter: String,
    driver: String,
}

/// The files of one table.
pub struct Files(Vec<(PathBuf, Measured<Value>)>);

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/measured")
}

/// Of all files.
pub fn names() -> Vec<String> {
    let entries = fs::read_dir(folder()).expect("assets/measured").map(|entry| entry.expect("an entry").file_name());
    entries.filter_map(|name| name.into_string().ok()).filter(|name| name.ends_with(".json")).collect()
}

impl Files {
    pub fn read(names: &[&str]) -> Self {
        let read = |name: &&str| {
            let path = folder().join(name);
            let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            let measured = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            (path, measured)
        };
        Self(names.iter().map(read).collect())
    }

    /// The report of every file.
    pub fn reports<R: DeserializeOwned>(&self) -> Vec<R> {
        let typed = |(path, measured): &(PathBuf, Measured<Value>)| {
            R::deserialize(&measured.report).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
        };
        self.0.iter().map(typed).collect()
    }

    /// The rows of all files.
    pub fn rows<R: DeserializeOwned>(&self) -> Vec<R> {
        self.reports::<Rows<R>>().into_iter().flat_map(|report| report.rows).collect()
    }

    /// Commands, program, machine and day; files that agree in all but the command together.
    pub fn provenance(&self) -> String {
        let mut made: Vec<(String, Vec<String>)> = Vec::new();
        for ((_, measured), maker) in self.0.iter().zip(self.reports::<Maker>()) {
            let Maker { octolume, date, adapter, driver } = maker;
            let day = date.split('T').next().unwrap_or_default();
            let cores = measured.cores;
            let by = format!("Octolume {octolume}, {cores} CPU cores, {adapter}, driver {driver}, {day}.");
            let command = format!("`{}`", measured.command);
            match made.iter_mut().find(|(known, _)| *known == by) {
                Some((_, commands)) if commands.contains(&command) => {}
                Some((_, commands)) => commands.push(command),
                None => made.push((by, vec![command])),
            }
        }
        let sentences = made.into_iter().map(|(by, commands)| format!("Made by {}; {by}", commands.join(", ")));
        wrapped(&sentences.collect::<Vec<_>>().join(" "))
    }
}

/// Writes what a test has measured as FILE, if a folder is named for it.
pub fn keep<R: Serialize>(file: &str, command: &str, rows: Vec<R>) {
    let Some(folder) = std::env::var_os(FOLDER) else { return };
    let info = &gpu().info;
    let report = Rows {
        octolume: env!("CARGO_PKG_VERSION").to_owned(),
        date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        adapter: info.name.clone(),
        driver: format!("{} {}", info.driver, info.driver_info),
        rows,
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let measured = Measured { command: command.to_owned(), cores, report };
    let path = Path::new(&folder).join(file);
    let text = serde_json::to_string_pretty(&measured).expect("numbers and texts");
    fs::write(&path, text + "\n").unwrap_or_else(|error| panic!("{}: {error}", path.display()));
}
