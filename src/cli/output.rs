//! Standard output carries results alone; everything else goes to standard error.

use std::io::{self, ErrorKind, IsTerminal, Write};
use std::sync::Arc;
use std::time::Duration;

use anyhow::Context;
use indicatif::{ProgressBar, ProgressStyle};
use octolume::progress::Progress;
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

pub fn warnings<'a>(sentences: impl IntoIterator<Item = &'a String>) {
    sentences.into_iter().for_each(|sentence| message(&format!("warning: {sentence}")));
}

/// Runs long work with a bar on the terminal, if there is one.
pub fn with_progress<T>(what: &'static str, work: impl FnOnce(&Progress) -> T) -> T {
    let progress = Arc::new(Progress::default());
    if !io::stderr().is_terminal() {
        return work(&progress);
    }
    let bar = ProgressBar::new(100).with_message(what);
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {percent} %") {
        bar.set_style(style);
    }
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
