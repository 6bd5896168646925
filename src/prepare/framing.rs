//! Where a part of the scene is: the box a camera frames; and the camera of a picture.

use super::{MotionError, Prepared};
use crate::scene::bounds::union;
use crate::scene::{Aabb, Object, OrbitCamera, Pose};
use crate::settings::{Hidden, MotionSettings, Settings, ShotSettings};

/// The settings look through a camera that the file has not.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{scene} has no camera called \"{camera}\"; its cameras are {known}")]
pub struct UnknownCamera {
    pub scene: String,
    pub camera: String,
    pub known: String,
}

/// Nodes without any surface below them are framed with this share of the scene around them.
const SURROUNDINGS: f64 = 0.05;

impl Prepared {
    /// Which of the file's cameras is looked through, by name or else by number from 0: the first where none is named.
    pub fn camera_index(&self, shot: &ShotSettings) -> Result<Option<usize>, UnknownCamera> {
        let cameras = &self.scene.cameras;
        let Some(name) = &shot.file_camera else { return Ok((!cameras.is_empty()).then_some(0)) };
        let by_number = || name.parse().ok().filter(|number| *number < cameras.len());
        let index = cameras.iter().position(|camera| camera.name == *name).or_else(by_number);
        index.map(Some).ok_or_else(|| UnknownCamera {
            scene: self.scene.name.clone(),
            camera: name.clone(),
            known: match cameras.len() {
                0 => "none".to_owned(),
                _ => cameras.iter().map(|camera| format!("\"{}\"", camera.name)).collect::<Vec<_>>().join(", "),
            },
        })
    }

    /// The camera that is set, else the file's, else one that frames what is there when the clip begins.
    pub fn camera(&self, settings: &Settings, pose: &Pose, size_px: [u32; 2]) -> OrbitCamera {
        let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
        let of_file = || self.scene.camera_at(self.camera_index(&settings.shot).ok()??, pose, aspect);
        settings.shot.camera.or_else(of_file).unwrap_or_else(|| OrbitCamera::framing(self.at_first, aspect))
    }

    /// The box around all that a moment shows; `None` where that is nothing.
    pub fn bounds_shown(&self, shot: &ShotSettings) -> Option<Aabb> {
        let pose = self.pose(&shot.motion).ok()?;
        let hidden = self.hidden(&shot.visibility, &pose).ok()?;
        self.bounds_at(&pose, &hidden)
    }

    /// The same of a pose.
    pub fn bounds_at(&self, pose: &Pose, hidden: &Hidden) -> Option<Aabb> {
        let shown = (0..).zip(&self.objects).filter(|(number, _)| !hidden.contains(*number));
        let objects: Vec<Object> = shown.map(|(_, object)| object.object.clone()).collect();
        self.scene.boxes_at(&objects, pose).into_iter().fold(None, union)
    }

    /// The box around all that a node and those below it show in a pose, hidden or not; around the
    /// places of these nodes where none has a mesh. `None` where nothing of it is at a finite place.
    pub fn bounds_below(&self, node: usize, motion: &MotionSettings) -> Result<Option<Aabb>, MotionError> {
        let pose = self.pose(motion)?;
        let mut below = vec![false; self.scene.nodes.len()];
        for (index, candidate) in self.scene.nodes.iter().enumerate() {
            below[index] = index == node || candidate.parent.is_some_and(|parent| below[parent]);
        }
        let objects = self.objects.iter().map(|object| &object.object).filter(|object| below[object.node]);
        let vertices = objects.flat_map(|object| {
            let primitives = 0..self.scene.meshes[object.mesh].primitives.len();
            primitives.flat_map(|primitive| self.scene.posed_positions(object, primitive, &pose))
        });
        if let Some(surface) = Aabb::from_points(vertices.filter(|vertex| vertex.is_finite())) {
            return Ok(Some(surface));
        }
        let places = (0..below.len()).filter(|&index| below[index]).map(|index| pose.world_from_node[index].w_axis);
        let places = Aabb::from_points(places.map(|place| place.truncate()).filter(|place| place.is_finite()));
        let margin = self.bounds.map_or(glam::DVec3::ZERO, |bounds| bounds.size() * SURROUNDINGS);
        Ok(places.map(|places| Aabb { min: places.min - margin, max: places.max + margin }))
    }
}
