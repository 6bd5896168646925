//! All clips of a file at once, where none moves what another does.

use std::collections::HashSet;

use super::{Clip, Scene};

/// What the clip is called, unless the file has one of that name.
const NAME: &str = "all at once";

impl Scene {
    /// Adds the clip, where the file has several and no two move the same property of a node.
    pub fn add_clip_of_all(&mut self) {
        let mut moved = HashSet::new();
        let mut channels = self.clips.iter().flat_map(|clip| &clip.channels);
        let is_apart = channels.all(|channel| moved.insert((channel.node, channel.property)));
        let moving = self.clips.iter().filter(|clip| !clip.channels.is_empty()).count();
        if moving < 2 || !is_apart || self.clips.iter().any(|clip| clip.name == NAME) {
            return;
        }
        let duration_secs = self.clips.iter().map(|clip| clip.duration_secs).fold(0.0, f64::max);
        let channels = self.clips.iter().flat_map(|clip| clip.channels.clone()).collect();
        self.clip_of_all = Some(self.clips.len());
        self.clips.push(Clip { name: NAME.to_owned(), duration_secs, channels });
    }

    /// Those that the file has.
    pub fn own_clips(&self) -> &[Clip] {
        &self.clips[..self.clip_of_all.unwrap_or(self.clips.len())]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Channel, Interpolation, Property};

    fn clip(name: &str, duration_secs: f64, moved: &[(usize, Property)]) -> Clip {
        let channel = |&(node, property)| Channel {
            node,
            property,
            interpolation: Interpolation::Linear,
            times_secs: vec![0.0, duration_secs],
            values: vec![0.0; 2 * property.width()],
        };
        Clip { name: name.to_owned(), duration_secs, channels: moved.iter().map(channel).collect() }
    }

    fn with(clips: Vec<Clip>) -> Scene {
        let mut scene = Scene { clips, ..Scene::default() };
        scene.add_clip_of_all();
        scene
    }

    #[test]
    fn clips_that_move_different_things_play_at_once() {
        let [door, lamp] = [clip("door", 1.0, &[(0, Property::Rotation)]), clip("lamp", 3.0, &[(1, Property::Scale)])];
        let scene = with(vec![door.clone(), lamp.clone(), clip("nothing", 0.0, &[])]);
        let all = scene.clips.last().expect("is added");
        assert_eq!((all.name.as_str(), all.duration_secs, all.channels.len()), (NAME, 3.0, 2));
        assert_eq!((scene.own_clips().len(), scene.first_clip()), (3, Some(0)));
        for clips in [
            vec![door.clone(), clip("knock", 1.0, &[(0, Property::Rotation)])],
            vec![door.clone()],
            vec![door.clone(), clip("nothing", 0.0, &[])],
            vec![door, Clip { name: NAME.to_owned(), ..lamp }],
            Vec::new(),
        ] {
            let count = clips.len();
            let scene = with(clips);
            assert_eq!((scene.clips.len(), scene.own_clips().len(), scene.clip_of_all), (count, count, None));
        }
    }
}
