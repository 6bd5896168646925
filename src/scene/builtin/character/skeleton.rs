//! The joints of a person, and poses of them.
//!
//! A joint's bind rotation is the identity, so its local translation is the difference of bind
//! points. Rotations of a pose are local. Left joints come before right ones, `SIDE` apart.

use glam::{DQuat, DVec3};

pub const ROOT: usize = 0;
pub const PELVIS: usize = 1;
pub const SPINE: usize = 2;
pub const CHEST: usize = 3;
pub const NECK: usize = 4;
pub const HEAD: usize = 5;
pub const CAPE: [usize; 3] = [6, 7, 8];
/// The left limbs; add [`SIDE`] for the right ones.
pub const CLAVICLE: usize = 9;
pub const UPPER_ARM: usize = 10;
pub const FOREARM: usize = 11;
pub const HAND: usize = 12;
pub const THIGH: usize = 13;
pub const SHIN: usize = 14;
pub const FOOT: usize = 15;
pub const TOE: usize = 16;
pub const SIDE: usize = 8;
pub const COUNT: usize = 25;

pub struct Joint {
    pub name: &'static str,
    pub parent: Option<usize>,
    point: [f64; 3],
}

impl Joint {
    /// The bind point, in metres from the ground between the feet.
    pub fn at(&self) -> DVec3 {
        DVec3::from_array(self.point)
    }
}

const fn joint(name: &'static str, parent: usize, point: [f64; 3]) -> Joint {
    Joint { name, parent: Some(parent), point }
}

pub static JOINTS: [Joint; COUNT] = [
    Joint { name: "root", parent: None, point: [0.0, 0.0, 0.0] },
    joint("pelvis", ROOT, [0.0, 0.95, 0.0]),
    joint("spine", PELVIS, [0.0, 1.07, 0.0]),
    joint("chest", SPINE, [0.0, 1.24, 0.0]),
    joint("neck", CHEST, [0.0, 1.47, 0.0]),
    joint("head", NECK, [0.0, 1.56, 0.01]),
    joint("cape top", CHEST, [0.0, 1.36, -0.13]),
    joint("cape middle", CAPE[0], [0.0, 1.12, -0.17]),
    joint("cape hem", CAPE[1], [0.0, 0.90, -0.20]),
    joint("clavicle.L", CHEST, [0.04, 1.41, 0.0]),
    joint("upper arm.L", CLAVICLE, [0.175, 1.41, 0.0]),
    joint("forearm.L", UPPER_ARM, [0.455, 1.41, 0.0]),
    joint("hand.L", FOREARM, [0.70, 1.41, 0.0]),
    joint("thigh.L", PELVIS, [0.09, 0.92, 0.0]),
    joint("shin.L", THIGH, [0.09, 0.50, 0.0]),
    joint("foot.L", SHIN, [0.09, 0.09, 0.0]),
    joint("toe.L", FOOT, [0.09, 0.03, 0.13]),
    joint("clavicle.R", CHEST, [-0.04, 1.41, 0.0]),
    joint("upper arm.R", CLAVICLE + SIDE, [-0.175, 1.41, 0.0]),
    joint("forearm.R", UPPER_ARM + SIDE, [-0.455, 1.41, 0.0]),
    joint("hand.R", FOREARM + SIDE, [-0.70, 1.41, 0.0]),
    joint("thigh.R", PELVIS, [-0.09, 0.92, 0.0]),
    joint("shin.R", THIGH + SIDE, [-0.09, 0.50, 0.0]),
    joint("foot.R", SHIN + SIDE, [-0.09, 0.09, 0.0]),
    joint("toe.R", FOOT + SIDE, [-0.09, 0.03, 0.13]),
];

/// Local rotations of all joints, and how far root and pelvis moved from their bind points.
#[derive(Clone, Debug)]
pub struct Pose {
    pub root: DVec3,
    pub pelvis_shift: DVec3,
    pub rotations: [DQuat; COUNT],
}

impl Default for Pose {
    fn default() -> Self {
        Self { root: DVec3::ZERO, pelvis_shift: DVec3::ZERO, rotations: [DQuat::IDENTITY; COUNT] }
    }
}

impl Pose {
    /// A joint's local translation.
    pub fn offset(&self, joint: usize) -> DVec3 {
        let bind = JOINTS[joint].parent.map_or(DVec3::ZERO, |parent| JOINTS[joint].at() - JOINTS[parent].at());
        match joint {
            ROOT => bind + self.root,
            PELVIS => bind + self.pelvis_shift,
            _ => bind,
        }
    }

    /// A joint's rotation and place in the world.
    pub fn world(&self, joint: usize) -> (DQuat, DVec3) {
        let (rotation, place) =
            JOINTS[joint].parent.map_or((DQuat::IDENTITY, DVec3::ZERO), |parent| self.world(parent));
        ((rotation * self.rotations[joint]).normalize(), place + rotation * self.offset(joint))
    }

    /// Sets a left joint's rotation, or the mirror image of it on the right.
    pub fn set_limb(&mut self, joint: usize, right: bool, rotation: DQuat) {
        let DQuat { x, y, z, w } = rotation;
        if right {
            self.rotations[joint + SIDE] = DQuat::from_xyzw(x, -y, -z, w);
        } else {
            self.rotations[joint] = rotation;
        }
    }
}
