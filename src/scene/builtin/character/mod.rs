//! A walking person: skeleton, skinned parts and gait.
//!
//! [`skeleton`] holds the joints and poses them, [`body`] builds the parts and binds them with
//! smooth weights, [`gait`] plants the feet on the path and bends the legs after them.
//! [`guard`] wears armour over the same body, in finer pieces.
//! The bind pose stands at the origin with the arms spread, looks along +Z, left is +X.

pub mod body;
pub mod gait;
pub mod guard;
mod limbs;
pub mod piece;
pub mod skeleton;
mod weights;

use glam::DVec3;
use gltf::json::{Index, Mesh, Node, Skin};

use super::exact::at;
use super::glb::{ClipWriter, GlbPart, GlbWriter, Track};
use crate::scene::Trs;
use piece::{Cloths, Piece};
use skeleton::{JOINTS, Pose};

/// A person placed in a file: a skeleton with a skin, and what is bound to it.
pub struct Person {
    group: Index<Node>,
    skin: Index<Skin>,
    /// Numbers of the joints that it has, and their nodes.
    joints: Vec<(usize, Index<Node>)>,
}

/// Adds a traveller: skeleton, skin and meshes under a group node; the nodes rest in `pose`.
pub fn add_person(glb: &mut GlbWriter, name: &str, cloths: &Cloths, pose: &Pose) -> Person {
    let all: Vec<usize> = (0..JOINTS.len()).collect();
    let person = Person::new(glb, name, &all, pose);
    for (title, pieces) in body::meshes(cloths) {
        let parts: Vec<GlbPart> = pieces.into_iter().map(Piece::bound).collect();
        let mesh = glb.mesh(title, &parts);
        person.wear(glb, title, mesh);
    }
    person
}

impl Person {
    /// Adds a skeleton of some joints, parents before their children, and a skin of them in that order.
    pub fn new(glb: &mut GlbWriter, name: &str, numbers: &[usize], pose: &Pose) -> Self {
        let group = glb.node(None, name, at(0.0, 0.0, 0.0));
        let mut joints: Vec<(usize, Index<Node>)> = Vec::new();
        for &number in numbers {
            let node_of = |parent| joints.iter().find(|(known, _)| *known == parent).map(|(_, node)| *node);
            let parent = JOINTS[number].parent.and_then(node_of).unwrap_or(group);
            let place = Trs { translation: pose.offset(number), rotation: pose.rotations[number], scale: DVec3::ONE };
            joints.push((number, glb.node(Some(parent), JOINTS[number].name, place)));
        }
        let bind_points: Vec<DVec3> = numbers.iter().map(|&number| JOINTS[number].at()).collect();
        let nodes: Vec<Index<Node>> = joints.iter().map(|(_, node)| *node).collect();
        let skin = glb.skin(name, &nodes, &bind_points);
        Self { group, skin, joints }
    }

    /// Shows a mesh that is bound to its joints.
    pub fn wear(&self, glb: &mut GlbWriter, title: &str, mesh: Index<Mesh>) {
        let node = glb.show(Some(self.group), title, mesh, at(0.0, 0.0, 0.0));
        glb.bind_skin(node, self.skin);
    }

    /// Adds a track for every joint, and for the two joints that also move.
    pub fn animate(&self, clip: &mut ClipWriter, times_secs: &[f64], pose_at: impl Fn(f64) -> Pose) {
        let poses: Vec<Pose> = times_secs.iter().map(|&time| pose_at(time)).collect();
        for &(number, node) in &self.joints {
            let rotations = poses.iter().map(|pose| pose.rotations[number]).collect();
            clip.track(node, times_secs, Track::Rotation(rotations));
        }
        let moves = |number: usize| number == skeleton::ROOT || number == skeleton::PELVIS;
        for &(number, node) in self.joints.iter().filter(|(number, _)| moves(*number)) {
            let offsets = poses.iter().map(|pose| pose.offset(number)).collect();
            clip.track(node, times_secs, Track::Translation(offsets));
        }
    }
}
