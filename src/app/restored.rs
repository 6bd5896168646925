//! What a picture has set, on its way to its scene; and how it fits that.

use std::path::{Path, PathBuf};

use crate::scene::{Scene, SceneIdentity, builtin};
use crate::settings::{Fit, Settings, Visibility};

/// Settings on their way: their scene is being opened, or is looked for.
pub struct Restored {
    /// What they come from, for messages.
    pub picture: String,
    pub settings: Settings,
}

/// Whether a file holds settings rather than a scene, by its name.
pub fn holds_settings(path: &Path) -> bool {
    let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
    extension.is_some_and(|extension| extension == "png" || extension == "json")
}

/// Where the scene of a picture is: where it was, or beside the picture.
pub fn scene_of(picture: &Path, identity: &SceneIdentity) -> Option<PathBuf> {
    if builtin::bytes(&identity.source).is_some() {
        return Some(PathBuf::from(&identity.source));
    }
    let was = PathBuf::from(&identity.source);
    let beside = picture.parent().zip(was.file_name()).map(|(folder, name)| folder.join(name));
    [Some(was), beside].into_iter().flatten().find(|path| path.is_file())
}

/// Takes out what the scene has not, a sentence each.
pub fn fitted(settings: &mut Settings, scene: &Scene) -> Vec<String> {
    let mut notes = Vec::new();
    let now = scene.identity();
    if settings.shot.scene.as_ref().is_some_and(|then| then.digest != now.digest) {
        notes.push(format!("{} is not the file that it was made from.", now.source));
    }
    let known = |name: &String| name.is_empty() || scene.clips.iter().any(|clip| clip.name == *name);
    if let Some(lost) = settings.shot.motion.clip.take_if(|name| !known(name)) {
        notes.push(format!("there is no clip \"{lost}\"; the first is played."));
    }
    let has = |name: &String| scene.cameras.iter().any(|camera| camera.name == *name);
    if let Some(lost) = settings.shot.file_camera.take_if(|name| !has(name)) {
        notes.push(format!("there is no camera \"{lost}\"; all is framed."));
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
