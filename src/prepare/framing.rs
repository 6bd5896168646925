//! Where a part of the scene is: the box a camera frames.

use super::{MotionError, Prepared};
use crate::scene::Aabb;
use crate::settings::MotionSettings;

/// Nodes without any surface below them are framed with this share of the scene around them.
const SURROUNDINGS: f64 = 0.05;

impl Prepared {
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
