//! Which objects are voxelized every frame where others are moved, and why.

use serde::Serialize;

use super::session::Session;

#[derive(Serialize)]
pub struct Voxelized {
    object: String,
    why: String,
}

impl Voxelized {
    /// Of the frame that was asked for last.
    pub fn list(session: &Session) -> Vec<Self> {
        let objects = session.engine.voxelized().into_iter().map(|object| &session.prepared.objects[object]);
        let named = objects.map(|object| Self {
            object: object.object.name.clone(),
            why: object.unmovable.map_or(String::new(), |why| why.to_string()),
        });
        named.collect()
    }

    pub fn text(&self) -> String {
        format!("voxelized every frame: \"{}\" {}", self.object, self.why)
    }
}
