//! Standard output carries results alone; everything else goes to standard error.

use std::collections::HashSet;
use std::fmt;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use anyhow::Context;
use image::RgbaImage;
use indicatif::{ProgressBar, ProgressStyle};
use octolume::experiment::Table;
use octolume::export;
use octolume::progress::Progress;
use octolume::settings::Settings;
use serde::Serialize;

/// Writes a result. A reader that has read enough (`| head`) is no error.
pub fn result(text: &str) -> anyhow::Result<()> {
    match writeln!(io::stdout().lock(), "{text}") {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error).context("standard output"),
        _ => Ok(()),
    }
}

pub fn json(value: &impl Serialize) -> anyhow::Result<()> {
    result(&serde_json::to_string_pretty(value).context("JSON")?)
}

/// Says something to the person. Nobody listening is no error.
pub fn message(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

pub fn warnings(sentences: impl IntoIterator<Item = impl fmt::Display>) {
    sentences.into_iter().for_each(|sentence| message(&format!("warning: {sentence}")));
}

/// Warnings that were said, so that each is said once.
#[derive(Default)]
pub struct Told(HashSet<String>);

impl Told {
    pub fn tell<'a>(&mut self, sentences: impl IntoIterator<Item = &'a String>) {
        warnings(sentences.into_iter().filter(|sentence| self.0.insert((*sentence).clone())));
    }
}

/// A value's name in JSON.
pub fn name_of(value: &impl Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(serde_json::Value::String(name)) => name,
        other => other.map(|value| value.to_string()).unwrap_or_default(),
    }
}

/// A table that reads well on a terminal and is Markdown too. Columns of numbers align right.
pub fn table(heads: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let rows: Vec<Vec<String>> = rows.into_iter().collect();
    let columns: Vec<(usize, bool)> = heads
        .iter()
        .enumerate()
        .map(|(column, head)| {
            let cells = || rows.iter().filter_map(|row| row.get(column));
            let width = cells().map(|cell| cell.chars().count()).max().unwrap_or(0);
            let numbers = cells().all(|cell| cell.is_empty() || cell.starts_with(|c: char| c.is_ascii_digit()));
            (width.max(head.chars().count()), numbers && !rows.is_empty())
        })
        .collect();
    let line = |cells: &[String]| {
        let padded = cells.iter().zip(&columns).map(|(cell, &(width, right))| match right {
            true => format!(" {cell:>width$} "),
            false => format!(" {cell:<width$} "),
        });
        format!("|{}|", padded.collect::<Vec<_>>().join("|"))
    };
    let heads: Vec<String> = heads.iter().map(|head| (*head).to_owned()).collect();
    let rules = columns.iter().map(|&(width, right)| "-".repeat(width + 1) + if right { ":" } else { "-" });
    let rule = format!("|{}|", rules.collect::<Vec<_>>().join("|"));
    let lines = [line(&heads), rule].into_iter().chain(rows.iter().map(|row| line(row)));
    lines.collect::<Vec<_>>().join("\n")
}

/// Rows of an experiment, the same way.
pub fn rows(table: &Table) -> String {
    self::table(&table.heads, table.rows.iter().cloned())
}

/// A bar of 100 parts, where there is a terminal for it.
pub fn bar(what: &'static str) -> ProgressBar {
    if !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(100).with_message(what);
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {percent} %") {
        bar.set_style(style);
    }
    bar
}

/// Runs long work with a bar on the terminal, if there is one.
pub fn with_progress<T>(what: &'static str, work: impl FnOnce(&Progress) -> T) -> T {
    let progress = Arc::new(Progress::default());
    if !io::stderr().is_terminal() {
        return work(&progress);
    }
    let bar = bar(what);
    std::thread::scope(|scope| {
        let (finished, watched) = std::sync::mpsc::channel::<()>();
        let watcher = Arc::clone(&progress);
        let bar = &bar;
        scope.spawn(move || {
            while watched.recv_timeout(Duration::from_millis(50)) == Err(std::sync::mpsc::RecvTimeoutError::Timeout) {
                bar.set_position((watcher.fraction() * 100.0) as u64);
            }
            bar.finish_and_clear();
        });
        let result = work(&progress);
        drop(finished);
        result
    })
}

/// Whether a file stands for standard output.
pub fn is_standard(file: &Path) -> bool {
    file.as_os_str() == "-"
}

/// Writes a PNG with its settings, to standard output where the file is `-`.
pub fn picture(file: &Path, picture: &RgbaImage, settings: &Settings) -> anyhow::Result<()> {
    if !is_standard(file) {
        return Ok(export::write_png(file, picture, settings)?);
    }
    let bytes = export::png_bytes(file, picture, settings)?;
    match io::stdout().lock().write_all(&bytes) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error).context("standard output"),
        _ => Ok(()),
    }
}

pub fn is_exr(file: &Path) -> bool {
    file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("exr"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_markdown_with_numbers_to_the_right() {
        let rows = [vec!["fill".to_owned(), "1.5".to_owned()], vec!["averaging".to_owned(), "12.25".to_owned()]];
        let expected = "| kernel    |    ms |\n|-----------|------:|\n| fill      |   1.5 |\n| averaging | 12.25 |";
        assert_eq!(table(&["kernel", "ms"], rows), expected);
    }

    #[test]
    fn names_are_those_of_json() {
        assert_eq!(name_of(&octolume::plan::Pass::ObjectIo), "object-io");
    }
}
