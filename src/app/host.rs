//! What the window takes from the computer that it runs on. By default nothing: it remembers nothing, has no file
//! dialog, and writes where it was started.

use std::path::PathBuf;
use std::pin::Pin;

use super::folders;

/// Where eframe keeps what egui remembers.
pub const EGUI_KEY: &str = "egui";

/// A file that a person chooses, or nothing.
pub type Choice = Pin<Box<dyn Future<Output = Option<PathBuf>> + Send>>;

#[derive(Clone, Debug)]
pub struct Host {
    /// The file in which the window finds itself as it was; `None`: it remembers nothing.
    pub remembered_in: Option<PathBuf>,
    /// Where screenshots go, until a person says otherwise.
    pub screenshots: PathBuf,
    /// The desktop's file dialog.
    pub choose_file: fn() -> Choice,
    /// Hears every error, as one sentence, beside the window.
    pub tell_error: fn(&str),
}

impl Default for Host {
    fn default() -> Self {
        Self {
            remembered_in: None,
            screenshots: PathBuf::from("."),
            choose_file: || Box::pin(std::future::ready(None)),
            tell_error: |_| {},
        }
    }
}

impl Host {
    /// The folders and the dialog of the person's desktop.
    pub fn desktop() -> Self {
        Self {
            remembered_in: eframe::storage_dir(folders::NAME).map(|folder| folder.join("window.ron")),
            screenshots: folders::screenshots(),
            choose_file: || {
                let dialog = rfd::AsyncFileDialog::new().set_title("Open a scene, or a picture of one");
                let chosen = dialog.add_filter("glTF, pictures", &["gltf", "glb", "png", "json"]).pick_file();
                Box::pin(async { chosen.await.map(|file| file.path().to_owned()) })
            },
            ..Self::default()
        }
    }
}
