//! Saves the view as a picture that carries its settings, or its light as it is. The picture is taken when the engine has
//! finished it at full size, and written on a thread of its own.

use std::path::{Path, PathBuf};

use image::RgbaImage;

use super::background::{Background, Outcome};
use super::folders;
use crate::export;
use crate::settings::Settings;

/// What is saved of the view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Its colours, as PNG.
    Picture,
    /// The light of its surfaces, as OpenEXR.
    Light,
}

/// What goes into a file.
pub enum Content {
    Picture(RgbaImage, Box<Settings>),
    /// Four channels a pixel, rows from the top; how large it is.
    Light(Vec<[f32; 4]>, [u32; 2]),
    /// What was measured, as JSON.
    Report(String),
}

pub struct Screenshots {
    /// Where they go, as typed.
    pub folder: String,
    /// Where they go at first; it is made when the first one does.
    usual: PathBuf,
    wanted: Option<Format>,
    writing: Vec<Background<Result<PathBuf, String>>>,
}

impl Screenshots {
    pub fn new(usual: PathBuf) -> Self {
        Self { folder: usual.display().to_string(), usual, wanted: None, writing: Vec::new() }
    }

    pub fn want(&mut self, format: Format) {
        self.wanted = Some(format);
    }

    /// A picture is waited for: it must be finished, and not coarse.
    pub fn is_wanted(&self) -> bool {
        self.wanted.is_some()
    }

    pub fn wanted(&self) -> Option<Format> {
        self.wanted
    }

    pub fn save(&mut self, ctx: &egui::Context, content: Content, scene: &str) {
        self.wanted = None;
        let (typed, scene) = (folders::typed(&self.folder), scene.to_owned());
        let is_usual = typed == self.usual;
        let folder = std::path::absolute(&typed).unwrap_or(typed);
        self.writing.push(Background::start(ctx, move |_| {
            if is_usual {
                std::fs::create_dir_all(&folder)
                    .map_err(|error| format!("{}: cannot be made: {error}", folder.display()))?;
            }
            write(&folder, &scene, &content)
        }));
    }

    /// A picture is waited for or being written.
    pub fn is_busy(&self) -> bool {
        self.is_wanted() || !self.writing.is_empty()
    }

    pub fn give_up(&mut self) {
        self.wanted = None;
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

/// Makes `octolume-<scene>-<n>.<extension>` with the first number that no file has: an empty file, so that
/// no other picture takes the name meanwhile.
fn reserve_file(folder: &Path, scene: &str, extension: &str) -> Result<PathBuf, String> {
    let scene: String = scene.chars().map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '-' }).collect();
    let mut number = 1_u64;
    loop {
        let file = folder.join(format!("octolume-{scene}-{number}.{extension}"));
        match std::fs::File::create_new(&file) {
            Ok(_) => return Ok(file),
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => number += 1,
            Err(error) => return Err(format!("{}: cannot be written: {error}", file.display())),
        }
    }
}

fn write(folder: &Path, scene: &str, content: &Content) -> Result<PathBuf, String> {
    let extension = match content {
        Content::Picture(..) => "png",
        Content::Light(..) => "exr",
        Content::Report(..) => "json",
    };
    let file = reserve_file(folder, scene, extension)?;
    let written = match content {
        Content::Picture(picture, settings) => export::write_png(&file, picture, settings).map_err(|e| e.to_string()),
        Content::Light(light, size_px) => export::write_exr(&file, *size_px, light).map_err(|e| e.to_string()),
        Content::Report(json) => std::fs::write(&file, json).map_err(|error| format!("{}: {error}", file.display())),
    };
    written.inspect_err(|_| {
        // The reserved file is empty; a failure to remove it changes nothing about the error to tell.
        let _ = std::fs::remove_file(&file);
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
            let file = reserve_file(folder.path(), "Box With/Spaces", "png");
            assert_eq!(file, Ok(folder.path().join(format!("octolume-Box-With-Spaces-{number}.png"))));
        }
    }

    #[test]
    fn a_folder_that_does_not_exist_is_named() {
        let missing = tempfile::tempdir().expect("a temporary folder").path().join("gone");
        let error = reserve_file(&missing, "Fox", "png").expect_err("no folder");
        assert!(error.contains("gone") && error.contains("octolume-Fox-1.png"), "{error}");
    }
}
