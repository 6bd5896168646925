//! What a file holds, in our words: nodes, meshes, materials, skins, clips. No GPU in here.
//!
//! Lengths are scene units (metres in glTF), angles radians, times seconds. Nodes are stored
//! parents before children, so one forward pass poses them all.

pub mod animation;
pub mod bounds;
pub mod builtin;
pub mod camera;
mod file_camera;
mod framing;
pub mod geometry;
mod identity;
pub mod load;
pub mod material;
pub mod mesh;
mod morph;
pub mod motion;
pub mod polar;
pub mod pose;
pub mod skin;
mod strain;
mod stretch;
mod together;
pub mod warning;

use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::LazyLock;

use glam::{DMat4, DQuat, DVec3};
use serde::{Deserialize, Serialize};

pub use animation::{Channel, Clip, Interpolation, Property};
pub use bounds::Aabb;
pub use camera::OrbitCamera;
pub use file_camera::{Projection, SceneCamera};
pub use identity::SceneIdentity;
pub use material::{AlphaMode, Material, Texture, TextureRef, Wrap};
pub use mesh::{Mesh, Morph, MorphTarget, Primitive};
pub use motion::{Motion, MotionReport, Object, Unmovable};
pub use pose::Pose;
pub use skin::Skin;
pub use warning::{FilePart, Warning};

use crate::digest::Digest;

/// One opened file. Immutable once loaded; everything that changes lives in a [`Pose`].
#[derive(Clone, Debug, Default)]
pub struct Scene {
    pub name: String,
    /// `None` for a scene made in memory.
    pub source: Option<PathBuf>,
    /// Of the .gltf or .glb file alone, not of buffers and images beside it. `None` for a scene made in memory.
    pub digest: Option<Digest>,
    pub nodes: Vec<Node>,
    pub meshes: Vec<Mesh>,
    pub materials: Vec<Material>,
    pub textures: Vec<Texture>,
    pub skins: Vec<Skin>,
    /// Of the file; perhaps behind them all of them at once.
    pub clips: Vec<Clip>,
    /// Which of the clips is all others at once.
    pub clip_of_all: Option<usize>,
    pub cameras: Vec<SceneCamera>,
    pub lights: Vec<Light>,
    /// Names of the scenes the file holds, and which of them is shown; `None`: all nodes are.
    pub scene_names: Vec<String>,
    pub shown_scene: Option<usize>,
    /// What opening the file set aside.
    pub memory_bytes: u64,
    /// Names of the glTF extensions the file uses.
    pub extensions: Vec<String>,
    /// What was repaired, left out or approximated.
    pub warnings: Vec<Warning>,
}

impl Scene {
    /// glTF's default one where a primitive names none.
    pub fn material_of(&self, primitive: &Primitive) -> &Material {
        static DEFAULT: LazyLock<Material> = LazyLock::new(Material::default);
        primitive.material.and_then(|material| self.materials.get(material)).unwrap_or(&DEFAULT)
    }

    /// Nodes that are joints of a skin, each once.
    pub fn joint_count(&self) -> usize {
        self.skins.iter().flat_map(|skin| &skin.joints).collect::<HashSet<_>>().len()
    }
}

/// A place in the hierarchy. `parent` is always smaller than the node's own index.
#[derive(Clone, Debug)]
pub struct Node {
    pub name: String,
    pub parent: Option<usize>,
    pub local: LocalTransform,
    pub mesh: Option<usize>,
    pub skin: Option<usize>,
    pub camera: Option<usize>,
    pub light: Option<usize>,
    /// KHR_node_visibility: where it is not, neither is anything below it. A clip may change it.
    pub is_visible: bool,
}

/// glTF gives a node either a matrix (never animated) or translation, rotation, scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LocalTransform {
    Matrix(DMat4),
    Trs(Trs),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trs {
    pub translation: DVec3,
    pub rotation: DQuat,
    pub scale: DVec3,
}

impl Default for Trs {
    fn default() -> Self {
        Self { translation: DVec3::ZERO, rotation: DQuat::IDENTITY, scale: DVec3::ONE }
    }
}

impl Trs {
    pub fn matrix(&self) -> DMat4 {
        DMat4::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }
}

impl LocalTransform {
    pub fn matrix(&self) -> DMat4 {
        match self {
            Self::Matrix(matrix) => *matrix,
            Self::Trs(trs) => trs.matrix(),
        }
    }
}

/// KHR_lights_punctual in its units: lux for directional, candela for point and spot.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    pub name: String,
    pub kind: LightKind,
    pub color: [f32; 3],
    pub intensity: f32,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightKind {
    Directional,
    Point { range: Option<f32> },
    Spot { range: Option<f32>, inner_cone_radians: f32, outer_cone_radians: f32 },
}
