//! Chains of boxes, one a joint, that bend about z in a clip of a second; written as glTF files and
//! worked out by hand.

use glam::{DAffine3, DQuat, DVec3, Vec3};
use serde_json::{Value, json};

use crate::document::{Document, U16};

/// How far the last joint turns against the first.
const BEND_RADIANS: f32 = 2.0;

/// A box reaches this far from the axis, and leaves this much of its joint's length free at both ends.
const HALF_WIDTH: f32 = 0.35;
const GAP: f32 = 0.1;

/// Where a chain stands: mirrored chains have a negative scale.
#[derive(Clone, Copy)]
pub struct Root {
    pub translation: DVec3,
    pub scale: DVec3,
}

impl Root {
    pub fn at(translation: DVec3) -> Self {
        Self { translation, scale: DVec3::ONE }
    }
}

pub struct ChainRig {
    pub joints: usize,
    /// The mesh is stored this much smaller, and the inverse bind matrices scale it up again.
    pub bind_scale: f32,
    /// The joint of a box is named by JOINTS_1; JOINTS_0 has no weight.
    pub in_second_set: bool,
    /// All chains show the same mesh.
    pub roots: Vec<Root>,
}

impl ChainRig {
    pub fn new(joints: usize) -> Self {
        Self { joints, bind_scale: 1.0, in_second_set: false, roots: vec![Root::at(DVec3::ZERO)] }
    }

    /// Corners of the box of a joint where it was bound.
    fn corners(joint: usize) -> [Vec3; 8] {
        let [low, high] = [joint as f32 + GAP, (joint + 1) as f32 - GAP];
        std::array::from_fn(|corner| {
            let side = |axis: usize| if corner >> axis & 1 == 0 { -HALF_WIDTH } else { HALF_WIDTH };
            Vec3::new(side(0), if corner & 2 == 0 { low } else { high }, side(2))
        })
    }

    fn turn(&self) -> DQuat {
        let half = BEND_RADIANS / self.joints as f32 / 2.0;
        DQuat::from_xyzw(0.0, 0.0, half.sin().into(), half.cos().into()).normalize()
    }

    /// `world_from_bind` of every joint of a chain, at the end of the clip or at its start.
    fn joints_by_hand(&self, root: &Root, is_bent: bool) -> Vec<DAffine3> {
        let turn = if is_bent { self.turn() } else { DQuat::IDENTITY };
        let mut world = DAffine3::from_scale_rotation_translation(root.scale, DQuat::IDENTITY, root.translation);
        (0..self.joints)
            .map(|joint| {
                let step = DVec3::Y * if joint == 0 { 0.0 } else { 1.0 };
                world *= DAffine3::from_rotation_translation(turn, step);
                world * DAffine3::from_translation(-DVec3::Y * joint as f64)
            })
            .collect()
    }

    /// Corners of every box of a chain in the world, and the middle of each box.
    pub fn boxes_by_hand(&self, root: &Root, is_bent: bool) -> Vec<([DVec3; 8], DVec3)> {
        let joints = self.joints_by_hand(root, is_bent);
        let boxes = joints.iter().enumerate().map(|(joint, world_from_bind)| {
            let corners = Self::corners(joint).map(|corner| world_from_bind.transform_point3(corner.as_dvec3()));
            (corners, corners.iter().sum::<DVec3>() / 8.0)
        });
        boxes.collect()
    }

    pub fn document(&self) -> Document {
        let mut document = Document::new();
        let mesh = self.mesh(&mut document);
        let skin = self.skins(&mut document, mesh);
        self.clip(&mut document, &skin);
        document
    }

    fn mesh(&self, document: &mut Document) -> usize {
        const FACES: [[u16; 4]; 6] =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let corners: Vec<f32> =
            (0..self.joints).flat_map(Self::corners).flat_map(|corner| (corner / self.bind_scale).to_array()).collect();
        let indices: Vec<u16> = (0..self.joints as u16)
            .flat_map(|joint| FACES.iter().flat_map(move |&[a, b, c, d]| [a, b, c, a, c, d].map(|i| 8 * joint + i)))
            .collect();
        let count = 8 * self.joints;
        let joints = |joint: usize| [joint as u16, 0, 0, 0].repeat(8).into_iter().flat_map(u16::to_le_bytes);
        let joints: Vec<u8> = (0..self.joints).flat_map(joints).collect();
        let mut attributes = json!({ "POSITION": document.floats("VEC3", &corners) });
        let sets: &[f32] = if self.in_second_set { &[0.0, 1.0] } else { &[1.0] };
        for (set, &weight) in sets.iter().enumerate() {
            let weights: Vec<f32> = [weight, 0.0, 0.0, 0.0].repeat(count);
            let set_joints = if weight > 0.0 { joints.clone() } else { vec![0; joints.len()] };
            attributes[format!("JOINTS_{set}")] = json!(document.accessor(U16, "VEC4", count, &set_joints));
            attributes[format!("WEIGHTS_{set}")] = json!(document.floats("VEC4", &weights));
        }
        let indices = document.indices(&indices);
        document.mesh("chain", json!({ "attributes": attributes, "indices": indices }))
    }

    /// A skeleton, a skin and a node a root; the joint nodes of all.
    fn skins(&self, document: &mut Document, mesh: usize) -> Vec<usize> {
        let inverse_bind = |joint: usize| {
            let down = Vec3::Y * -(joint as f32);
            glam::Mat4::from_scale_rotation_translation(Vec3::splat(self.bind_scale), glam::Quat::IDENTITY, down)
                .to_cols_array()
        };
        let inverse_bind: Vec<f32> = (0..self.joints).flat_map(inverse_bind).collect();
        let inverse_bind = document.floats("MAT4", &inverse_bind);
        let mut all = Vec::new();
        for (number, root) in self.roots.iter().enumerate() {
            let first = document.json["nodes"].as_array().map_or(0, Vec::len);
            let joints: Vec<usize> = (first..first + self.joints).collect();
            for &joint in &joints {
                let step = if joint == first { 0.0 } else { 1.0 };
                let mut node = json!({ "translation": [0.0, step, 0.0] });
                if joint + 1 < first + self.joints {
                    node["children"] = json!([joint + 1]);
                }
                document.add("nodes", node);
            }
            let [translation, scale] = [root.translation, root.scale].map(|vector| vector.to_array());
            document.add("nodes", json!({ "children": [first], "translation": translation, "scale": scale }));
            let skin = document.add("skins", json!({ "joints": joints, "inverseBindMatrices": inverse_bind }));
            document.add("nodes", json!({ "name": format!("chain {number}"), "mesh": mesh, "skin": skin }));
            all.extend(joints);
        }
        all
    }

    fn clip(&self, document: &mut Document, joints: &[usize]) {
        let turn = self.turn().as_quat().to_array();
        let input = document.floats("SCALAR", &[0.0, 1.0]);
        let output = document.floats("VEC4", &[[0.0, 0.0, 0.0, 1.0], turn].concat());
        let channels: Vec<Value> = joints
            .iter()
            .map(|joint| json!({ "sampler": 0, "target": { "node": joint, "path": "rotation" } }))
            .collect();
        let samplers = json!([{ "input": input, "output": output }]);
        document.add("animations", json!({ "name": "bend", "samplers": samplers, "channels": channels }));
    }
}
