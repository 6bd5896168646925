//! A picture that the program saved, or its settings, opened like a scene: scene, moment, camera and everything that
//! was set come back.

use std::path::{Path, PathBuf};

use super::App;
use super::journal::Severity;
use super::loader::file_name;
use crate::export;
use crate::prepare::Preparation;
use crate::scene::{Scene, SceneIdentity, builtin};
use crate::settings::{Fit, Settings, Visibility};

/// Settings on their way: their scene is being opened, or is looked for.
pub struct Restored {
    /// What they come from, for messages.
    picture: String,
    settings: Settings,
}

/// Whether a file holds settings rather than a scene, by its name.
pub fn holds_settings(path: &Path) -> bool {
    let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
    extension.is_some_and(|extension| extension == "png" || extension == "json")
}

/// Where the scene of a picture is: where it was, or beside the picture.
fn scene_of(picture: &Path, identity: &SceneIdentity) -> Option<PathBuf> {
    if builtin::bytes(&identity.source).is_some() {
        return Some(PathBuf::from(&identity.source));
    }
    let was = PathBuf::from(&identity.source);
    let beside = picture.parent().zip(was.file_name()).map(|(folder, name)| folder.join(name));
    [Some(was), beside].into_iter().flatten().find(|path| path.is_file())
}

impl App {
    /// Reads settings and opens their scene; where that is gone, whatever scene is opened next gets them.
    pub(super) fn restore(&mut self, ctx: &egui::Context, path: &Path) {
        let settings = match export::read_settings(path) {
            Ok(settings) => settings,
            Err(error) => return self.journal.tell(Severity::Error, error.to_string()),
        };
        let picture = file_name(path);
        let Some(identity) = settings.shot.scene.clone() else {
            let sentence =
                format!("{picture} does not tell of which scene it is: the next scene opened gets its settings.");
            self.restored = Some(Restored { picture, settings });
            return self.journal.tell(Severity::Warning, sentence);
        };
        let is_open = self.prepared().is_some_and(|prepared| prepared.scene.identity() == identity);
        let restored = Restored { picture, settings };
        match scene_of(path, &identity) {
            _ if is_open => self.take_over(restored),
            Some(scene) => {
                let preparation = Preparation::from(&restored.settings);
                self.loader.open(ctx, &scene, None, preparation);
                self.desk.path = scene.display().to_string();
                self.restored = Some(restored);
            }
            None => {
                let sentence = format!(
                    "{} is a picture of {}, which is not there: the next scene opened gets its settings.",
                    restored.picture, identity.source
                );
                self.restored = Some(restored);
                self.journal.tell(Severity::Warning, sentence);
            }
        }
    }

    /// Settings that waited for their scene: it is open now.
    pub(super) fn finish_restoring(&mut self) {
        if let Some(restored) = self.restored.take() {
            self.take_over(restored);
        }
    }

    fn take_over(&mut self, Restored { picture, mut settings }: Restored) {
        let Some(scene) = self.prepared().map(|prepared| prepared.scene.clone()) else { return };
        let notes = fitted(&mut settings, &scene);
        self.settings = settings;
        self.playback.pause();
        self.journal.tell(Severity::Info, format!("Everything is as in {picture}."));
        notes.into_iter().for_each(|note| self.journal.tell(Severity::Warning, format!("{picture}: {note}")));
    }
}

/// Takes out what the scene has not, a sentence each.
fn fitted(settings: &mut Settings, scene: &Scene) -> Vec<String> {
    let mut notes = Vec::new();
    let now = scene.identity();
    if settings.shot.scene.as_ref().is_some_and(|then| then.digest != now.digest) {
        notes.push(format!("{} is not the file that it was made from.", now.source));
    }
    let known = |name: &String| name.is_empty() || scene.clips.iter().any(|clip| clip.name == *name);
    if let Some(lost) = settings.shot.motion.clip.take_if(|name| !known(name)) {
        notes.push(format!("there is no clip \"{lost}\"; the first is played."));
    }
    let visibility = &mut settings.shot.visibility;
    if let Err(error) = visibility.shown_nodes(scene) {
        *visibility = Visibility::default();
        notes.push(format!("all is shown, for {error}."));
    }
    if settings.shot.fit.counted.shown_nodes(scene).is_err() {
        settings.shot.fit = Fit::default();
    }
    let nodes = scene.nodes.len();
    let edits = settings.method.lighting.edits.len();
    settings.method.lighting.edits.retain(|node, _| *node < nodes && scene.nodes[*node].light.is_some());
    if settings.method.lighting.edits.len() < edits {
        notes.push("some of the lights that it changes are not there.".to_owned());
    }
    settings.shot.scene = Some(now);
    notes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_told_from_scenes_by_their_names() {
        for (name, expected) in
            [("shot.png", true), ("a/B.PNG", true), ("x.json", true), ("x.gltf", false), ("png", false)]
        {
            assert_eq!(holds_settings(Path::new(name)), expected, "{name}");
        }
    }

    #[test]
    fn what_a_scene_has_not_is_left_out_and_named() {
        let mut settings = Settings::default();
        settings.shot.motion.clip = Some("gone".to_owned());
        settings.shot.visibility.hide(3);
        settings.shot.scene = Some(SceneIdentity { source: "a.glb".to_owned(), digest: None });
        let scene = Scene { name: "b.glb".to_owned(), ..Scene::default() };
        let notes = fitted(&mut settings, &scene);
        assert_eq!(
            (notes.len(), settings.shot.motion.clip, settings.shot.visibility),
            (2, None, Visibility::default())
        );
        assert!(notes[0].contains("no clip \"gone\"") && notes[1].contains("node 3"), "{notes:?}");
    }

    #[test]
    fn a_scene_that_moved_with_its_picture_is_found() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("box.glb"), b"").expect("written");
        let identity = |source: &str| SceneIdentity { source: source.to_owned(), digest: None };
        let picture = folder.path().join("shot.png");
        assert_eq!(scene_of(&picture, &identity("gone/box.glb")), Some(folder.path().join("box.glb")));
        assert_eq!(scene_of(&picture, &identity("courtyard")), Some(PathBuf::from("courtyard")));
        assert_eq!(scene_of(&picture, &identity("gone/other.glb")), None);
    }
}
