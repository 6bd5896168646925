//! What a plan is made for: one method of a request, and what the scene holds of it.

use serde::Serialize;

use crate::digest::Digest;
use crate::settings::{Settings, View};

/// What a scene holds, as far as a frame's plan depends on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct SceneFacts {
    /// Voxels of static and rigid objects inside the grid that are moved.
    pub rigid_voxels: u64,
    /// The same of skinned objects.
    pub skinned_voxels: u64,
    /// Voxels in the caches of objects inside the grid that are voxelized every frame.
    pub voxelized: u64,
    pub triangles: u64,
    /// Lights that are on and not black.
    pub lights: u32,
    /// Voxels inside the grid of objects that emit.
    pub emissive_voxels: u64,
    /// Some surface may be smooth enough for a specular cone.
    pub glossy: bool,
    /// Size of the picture.
    pub picture_px: [u32; 2],
}

impl SceneFacts {
    pub fn voxels(&self) -> u64 {
        self.rigid_voxels + self.skinned_voxels + self.voxelized
    }
}

/// What the shot and the method come to for a scene, by content.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Contents {
    pub caches: Digest,
    /// Which parts of objects are in the grid.
    pub residents: Digest,
    /// What moves static and rigid objects.
    pub rigid: Digest,
    pub skinned: Digest,
    /// Where every triangle is, and which are hidden.
    pub placed: Digest,
    /// The same of what is voxelized every frame alone.
    pub voxelized: Digest,
    /// The lights as kernels read them.
    pub lights: Digest,
    /// How their shadow maps are laid out.
    pub shadow_maps: Digest,
    /// The camera, whether it was set or not.
    pub camera: Digest,
    /// The exact voxels of this pose; `None` while they are not made.
    pub exact: Option<Digest>,
}

/// What a method is wanted for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WantedFor {
    /// Its picture, and with [`crate::settings::Look::accuracy`] its comparison.
    #[default]
    Picture,
    /// The comparison of its voxels with exact ones alone.
    Comparison,
}

/// One method of a request.
#[derive(Clone, Debug, Default)]
pub struct Asked {
    pub scene: SceneFacts,
    pub settings: Settings,
    pub contents: Contents,
    pub wanted_for: WantedFor,
}

impl Asked {
    pub fn new(scene: SceneFacts, settings: Settings) -> Self {
        Self { scene, settings, ..Self::default() }
    }

    /// A picture of this view is wanted.
    pub fn shows(&self, view: View) -> bool {
        self.settings.method.look.view == view && self.wanted_for == WantedFor::Picture
    }

    /// Voxels are compared with the exact ones of the pose.
    pub(super) fn compares(&self) -> bool {
        self.settings.method.look.accuracy || self.wanted_for == WantedFor::Comparison
    }
}
