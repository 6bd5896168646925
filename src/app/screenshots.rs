//! Saves the view as a picture that carries its settings. The picture is taken when the engine has
//! finished it at full size, and written on a thread of its own.

use std::path::{Path, PathBuf};

use image::RgbaImage;

use super::background::{Background, Outcome};
use crate::export;
use crate::settings::Settings;

pub struct Screenshots {
    /// Where they go, as typed; the current folder at first.
    pub folder: String,
    wanted: bool,
    writing: Vec<Background<Result<PathBuf, String>>>,
}

impl Default for Screenshots {
    fn default() -> Self {
        Self { folder: ".".to_owned(), wanted: false, writing: Vec::new() }
    }
}

impl Screenshots {
    pub fn want(&mut self) {
        self.wanted = true;
    }

    /// A picture is waited for: it must be finished, and not coarse.
    pub fn is_wanted(&self) -> bool {
        self.wanted
    }

    pub fn save(&mut self, ctx: &egui::Context, picture: RgbaImage, settings: Settings, scene: &str) {
        self.wanted = false;
        let (folder, scene) = (PathBuf::from(self.folder.trim()), scene.to_owned());
        self.writing.push(Background::start(ctx, move |_| write(&folder, &scene, &picture, &settings)));
    }

    /// A picture is waited for or being written.
    pub fn is_busy(&self) -> bool {
        self.wanted || !self.writing.is_empty()
    }

    pub fn give_up(&mut self) {
        self.wanted = false;
    }

    /// Files written since the last call, or why they were not.
    pub fn poll(&mut self) -> Vec<Result<PathBuf, String>> {
        let mut done = Vec::new();
        self.writing.retain(|work| match work.poll() {
            Outcome::Running => true,
            Outcome::Done(result) => {
                done.push(result);
                false
            }
            Outcome::Died => {
                done.push(Err("the screenshot could not be written".to_owned()));
                false
            }
        });
        done
    }
}

/// Makes `octolume-<scene>-<n>.png` with the first number that no file has: an empty file, so that
/// no other picture takes the name meanwhile.
fn reserve_file(folder: &Path, scene: &str) -> Result<PathBuf, String> {
    let scene: String = scene.chars().map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '-' }).collect();
    let mut number = 1_u64;
    loop {
        let file = folder.join(format!("octolume-{scene}-{number}.png"));
        match std::fs::File::create_new(&file) {
            Ok(_) => return Ok(file),
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => number += 1,
            Err(error) => return Err(format!("{}: cannot be written: {error}", file.display())),
        }
    }
}

fn write(folder: &Path, scene: &str, picture: &RgbaImage, settings: &Settings) -> Result<PathBuf, String> {
    let file = reserve_file(folder, scene)?;
    export::write_png(&file, picture, settings).map_err(|error| {
        // The reserved file is empty; a failure to remove it changes nothing about the error to tell.
        let _ = std::fs::remove_file(&file);
        error.to_string()
    })?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_numbered_and_hold_no_odd_characters() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        for number in 1..=2 {
            let file = reserve_file(folder.path(), "Box With/Spaces");
            assert_eq!(file, Ok(folder.path().join(format!("octolume-Box-With-Spaces-{number}.png"))));
        }
    }

    #[test]
    fn a_folder_that_does_not_exist_is_named() {
        let missing = tempfile::tempdir().expect("a temporary folder").path().join("gone");
        let error = reserve_file(&missing, "Fox").expect_err("no folder");
        assert!(error.contains("gone") && error.contains("octolume-Fox-1.png"), "{error}");
    }
}
