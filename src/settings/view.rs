//! What is looked at: voxels, triangles, lit surfaces, or a part of what they are made from.

use serde::{Deserialize, Serialize};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum View {
    /// The octree, ray-marched with occupancy as alpha (Fig. 8).
    #[default]
    Voxels,
    /// The posed triangles.
    Mesh,
    /// Exact voxels of the posed mesh over the moved ones: holes red, spill blue.
    Ghost,
    /// A plane through the octree, sampled, in the colours of a scale.
    Slice,
    /// What a light sees: distances from it.
    ShadowMap,
    /// The posed triangles in direct light and in what cones bring (section 4.5), or a part of that.
    Surfaces,
}

/// What of the lit surfaces is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SurfaceView {
    /// All light that reaches the eye.
    #[default]
    Final,
    /// What lights send without a detour, and what surfaces emit.
    Direct,
    /// What diffuse cones bring, times albedo.
    Diffuse,
    /// What is reflected.
    Specular,
    /// Share of the hemisphere without anything near.
    Ao,
    /// What arrives by diffuse cones, lux.
    Irradiance,
    Albedo,
    Normal,
    Depth,
    Roughness,
}

impl SurfaceView {
    /// Shown with an exposure.
    pub fn is_light(self) -> bool {
        matches!(self, Self::Final | Self::Direct | Self::Diffuse | Self::Specular | Self::Irradiance)
    }
}
