//! What lights the scene, and how that light is computed. In the units of KHR_lights_punctual: lux for
//! directional lights, candela for point and spot lights; radiance of the sky in nits.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

pub use super::light_edit::{AddedLight, LightEdit, LightPart};
use super::light_edit::{check_direction, check_intensity};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Lighting {
    /// A sun of our own.
    pub sun: Sun,
    /// Lights of the scene that are not as in the file, by the node that carries them.
    pub edits: BTreeMap<usize, LightEdit>,
    /// Lights beside those of the scene.
    pub added: Vec<AddedLight>,
    /// Radiance that comes from every direction, linear RGB, nits.
    pub sky_nits: [f64; 3],
    /// Multiplies what emissive surfaces emit; 0: they emit nothing.
    pub emission: f64,
    pub shadows: Shadows,
    /// Texels along an edge of a shadow map; half as many on the faces around a point light.
    pub shadow_map_px: u32,
    /// How far above its surface a leaf looks for what hides the light, in voxels; `None`: what errs least,
    /// see [`Self::offset_voxels`].
    pub shadow_offset_voxels: Option<f64>,
    pub opacity: Opacity,
    /// How often light goes on from leaf to leaf after it has met the first.
    pub bounces: u32,
    /// Cones a leaf sends out for sky and bounces.
    pub cones: u32,
    /// Full apex angle of those cones.
    pub cone_degrees: f64,
}

impl Default for Lighting {
    fn default() -> Self {
        Self {
            sun: Sun::default(),
            edits: BTreeMap::new(),
            added: Vec::new(),
            sky_nits: [0.0; 3],
            emission: 1.0,
            shadows: Shadows::default(),
            shadow_map_px: 2048,
            shadow_offset_voxels: None,
            opacity: Opacity::default(),
            bounces: 0,
            cones: 8,
            cone_degrees: 60.0,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sun {
    pub shines: SunShines,
    /// The way its light goes, in the scene's axes; any length but 0.
    pub direction: [f64; 3],
    /// Linear RGB.
    pub color: [f64; 3],
    pub illuminance_lux: f64,
}

impl Default for Sun {
    fn default() -> Self {
        let color = [1.0, 0.96, 0.9];
        Self {
            shines: SunShines::default(),
            direction: [-0.35, -1.0, -0.25],
            color,
            illuminance_lux: LightEdit::DIRECTIONAL_LUX,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SunShines {
    /// Where the scene has no lights, and nothing in it emits.
    #[default]
    Unlit,
    Always,
    Never,
}

/// How a leaf learns whether a light reaches it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shadows {
    /// A shadow map of the posed triangles.
    #[default]
    Map,
    /// A march through the octree towards the light; needs no triangles.
    March,
    /// Every light reaches everything.
    Off,
}

/// What an inner node stops.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Opacity {
    /// The share of its volume that is occupied, whatever the direction, as in the paper.
    #[default]
    Isotropic,
    /// Along each axis by itself, so that a thin wall stays a wall.
    Directional,
}

impl Opacity {
    pub fn is_directional(self) -> bool {
        self == Self::Directional
    }
}

impl Lighting {
    pub const SHADOW_MAPS_PX: [u32; 5] = [512, 1024, 2048, 4096, 8192];
    pub const MAX_BOUNCES: u32 = 64;
    pub const MAX_CONES: u32 = 256;
    pub const MAX_ADDED: usize = 64;
    pub const SHADOW_OFFSETS_VOXELS: RangeInclusive<f64> = 0.0..=16.0;
    pub const CONE_DEGREES: RangeInclusive<f64> = 0.0..=120.0;

    /// Light comes from where nothing is in the way.
    pub fn has_sky(&self) -> bool {
        self.sky_nits.iter().any(|channel| *channel > 0.0)
    }

    /// What an added light is called that nobody has named.
    pub fn free_name(&self) -> String {
        let name = |number: usize| format!("light {number}");
        let is_free = |name: &String| self.added.iter().all(|added| added.name != *name);
        (1..).map(name).find(is_free).unwrap_or_default()
    }

    /// How far above its surface a leaf looks for what hides the light. Measured against rays through the
    /// posed triangles: less puts leaves into their own shadow, more lets light under what stands on them.
    pub fn offset_voxels(&self) -> f64 {
        self.shadow_offset_voxels.unwrap_or(match self.shadows {
            Shadows::Map | Shadows::Off => 0.5,
            // A march has to leave the leaf itself.
            Shadows::March => 1.0,
        })
    }

    /// Are all values in range? If not, the sentence names value and range.
    pub(super) fn check(&self) -> Result<(), String> {
        check_direction("the sun", self.sun.direction)?;
        check_intensity("the sun", self.sun.color, self.sun.illuminance_lux)?;
        check_intensity("the sky", self.sky_nits, 1.0)?;
        check_intensity("emission", [1.0; 3], self.emission)?;
        for (node, edit) in &self.edits {
            edit.check(&format!("the light of node {node}"))?;
        }
        if self.added.len() > Self::MAX_ADDED {
            return Err(format!("{} lights are added, and {} is the limit", self.added.len(), Self::MAX_ADDED));
        }
        for added in &self.added {
            added.check()?;
        }
        self.check_method()
    }

    fn check_method(&self) -> Result<(), String> {
        if !Self::SHADOW_MAPS_PX.contains(&self.shadow_map_px) {
            let sizes = Self::SHADOW_MAPS_PX;
            return Err(format!("a shadow map of {} texels is not one of {sizes:?}", self.shadow_map_px));
        }
        if let Some(offset) = self.shadow_offset_voxels.filter(|offset| !Self::SHADOW_OFFSETS_VOXELS.contains(offset)) {
            return Err(format!("a shadow offset of {offset} voxels is not in 0 to 16"));
        }
        if self.bounces > Self::MAX_BOUNCES {
            return Err(format!("{} bounces are not in 0 to {}", self.bounces, Self::MAX_BOUNCES));
        }
        if !(1..=Self::MAX_CONES).contains(&self.cones) {
            return Err(format!("{} cones are not in 1 to {}", self.cones, Self::MAX_CONES));
        }
        if !Self::CONE_DEGREES.contains(&self.cone_degrees) {
            return Err(format!("an aperture of {} degrees is not in 0 to 120", self.cone_degrees));
        }
        Ok(())
    }
}
