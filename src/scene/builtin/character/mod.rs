//! A walking person: skeleton, skinned parts and gait.
//!
//! [`skeleton`] holds the joints and poses them, [`body`] builds the parts and binds them with
//! smooth weights, [`gait`] plants the feet on the path and bends the legs after them.
//! The bind pose stands at the origin with the arms spread, looks along +Z, left is +X.

pub mod body;
pub mod gait;
mod limbs;
pub mod piece;
pub mod skeleton;
mod weights;

use glam::DVec3;
use gltf::json::{Index, Node};

use super::exact::at;
use super::glb::{ClipWriter, GlbPart, GlbWriter, Track};
use crate::scene::Trs;
use piece::{Cloths, Piece};
use skeleton::{JOINTS, Pose};

/// A person placed in a file.
pub struct Person {
    joints: Vec<Index<Node>>,
}

/// Adds skeleton, skin and meshes under a group node; the nodes rest in `pose`.
pub fn add_person(glb: &mut GlbWriter, name: &str, cloths: &Cloths, pose: &Pose) -> Person {
    let group = glb.node(None, name, at(0.0, 0.0, 0.0));
    let mut joints: Vec<Index<Node>> = Vec::new();
    for (index, joint) in JOINTS.iter().enumerate() {
        let parent = joint.parent.map_or(group, |parent| joints[parent]);
        let place = Trs { translation: pose.offset(index), rotation: pose.rotations[index], scale: DVec3::ONE };
        joints.push(glb.node(Some(parent), joint.name, place));
    }
    let bind_points: Vec<DVec3> = JOINTS.iter().map(|joint| joint.at()).collect();
    let skin = glb.skin(name, &joints, &bind_points);
    for (title, pieces) in body::meshes(cloths) {
        let parts: Vec<GlbPart> = pieces.into_iter().map(Piece::bound).collect();
        let mesh = glb.mesh(title, &parts);
        let node = glb.show(Some(group), title, mesh, at(0.0, 0.0, 0.0));
        glb.bind_skin(node, skin);
    }
    Person { joints }
}

impl Person {
    /// Adds a track for every joint, and for the two joints that also move.
    pub fn animate(&self, clip: &mut ClipWriter, times_secs: &[f64], pose_at: impl Fn(f64) -> Pose) {
        let poses: Vec<Pose> = times_secs.iter().map(|&time| pose_at(time)).collect();
        for (index, &joint) in self.joints.iter().enumerate() {
            let rotations = poses.iter().map(|pose| pose.rotations[index]).collect();
            clip.track(joint, times_secs, Track::Rotation(rotations));
        }
        for moving in [skeleton::ROOT, skeleton::PELVIS] {
            let offsets = poses.iter().map(|pose| pose.offset(moving)).collect();
            clip.track(self.joints[moving], times_secs, Track::Translation(offsets));
        }
    }
}
