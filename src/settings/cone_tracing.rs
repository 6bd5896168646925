//! How cones light the surfaces that the camera sees (section 4.5).

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use super::look::{Lookup, Sampling};

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ConeTracing {
    /// Diffuse cones bring the light of other surfaces and of the sky.
    pub diffuse: bool,
    /// A specular cone does, where a surface is glossy.
    pub specular: bool,
    /// Diffuse cones tell what is near. Without [`Self::diffuse`], that darkens the sky's light.
    pub ambient_occlusion: bool,
    /// Diffuse cones of a pixel.
    pub cones: u32,
    /// Side of the square of pixels that share a set of cones, each pixel tracing its own part of it: 1, 2 or 4.
    pub pattern_px: u32,
    /// Full apex angle of a diffuse cone.
    pub cone_degrees: f64,
    /// From a surface along its normal to the apex of a cone.
    pub start_voxels: f64,
    /// Length of a step in diameters of the cone.
    pub step_diameters: f64,
    /// How a cone's samples are taken from the octree, and found in it.
    pub sampling: Sampling,
    pub lookup: Lookup,
    /// What is farther away occludes nothing, scene units; `None`: an eighth of the grid.
    pub occlusion_distance: Option<f64>,
    /// Largest picture whose every pixel sends out cones; larger ones take them from neighbours. `None`: as
    /// large as the picture. The paper: 1280 x 720 under pictures of 1920 x 1080.
    pub indirect_px: Option<[u32; 2]>,
    /// Diffuse cones at half of that, along each side.
    pub half_resolution: bool,
    /// Rougher surfaces than this take what their diffuse cones see for their reflection.
    pub glossy_roughness: f64,
}

impl Default for ConeTracing {
    fn default() -> Self {
        Self {
            diffuse: true,
            specular: true,
            ambient_occlusion: false,
            cones: 4,
            pattern_px: 4,
            cone_degrees: 30.0,
            start_voxels: 1.5,
            step_diameters: 1.0,
            sampling: Sampling::default(),
            lookup: Lookup::default(),
            occlusion_distance: None,
            indirect_px: None,
            half_resolution: true,
            glossy_roughness: 0.6,
        }
    }
}

impl ConeTracing {
    pub const MAX_CONES: u32 = 64;
    pub const PATTERNS_PX: [u32; 3] = [1, 2, 4];
    /// Without a distance of its own, occlusion ends after this part of the grid.
    pub const OCCLUSION_GRID_PART: f64 = 1.0 / 8.0;
    /// Indirect light in the paper, under pictures of 1920 x 1080.
    pub const PAPER_INDIRECT_PX: [u32; 2] = [1280, 720];
    pub const CONE_DEGREES: RangeInclusive<f64> = 0.0..=120.0;
    pub const START_VOXELS: RangeInclusive<f64> = 0.0..=16.0;
    pub const STEP_DIAMETERS: RangeInclusive<f64> = 0.125..=2.0;
    pub const INDIRECT_PX: RangeInclusive<u32> = 16..=8192;

    /// What is farther away occludes nothing, in cells of a grid of `grid_cells`³ cells of `span` scene units.
    pub fn occlusion_cells(&self, grid_cells: u32, span: f64) -> f64 {
        let far = f64::from(grid_cells) * Self::OCCLUSION_GRID_PART;
        self.occlusion_distance.map_or(far, |distance| distance / span)
    }

    /// Size of the image whose pixels send out specular cones: as large as the picture, or scaled down to
    /// fit [`Self::indirect_px`].
    pub fn specular_size_px(&self, picture_px: [u32; 2]) -> [u32; 2] {
        let Some(most) = self.indirect_px else { return picture_px };
        let scale = (0..2).map(|axis| f64::from(most[axis]) / f64::from(picture_px[axis])).fold(1.0, f64::min);
        picture_px.map(|side| ((f64::from(side) * scale).round() as u32).max(1))
    }

    /// The same for diffuse cones.
    pub fn diffuse_size_px(&self, picture_px: [u32; 2]) -> [u32; 2] {
        let size_px = self.specular_size_px(picture_px);
        if self.half_resolution { size_px.map(|side| side.div_ceil(2)) } else { size_px }
    }

    /// Are all values in range? If not, the sentence names value and range.
    pub(super) fn check(&self) -> Result<(), String> {
        let within = |what: &str, value: f64, range: RangeInclusive<f64>| {
            let (least, most) = (*range.start(), *range.end());
            if range.contains(&value) { Ok(()) } else { Err(format!("{what} of {value} is not in {least} to {most}")) }
        };
        if !(1..=Self::MAX_CONES).contains(&self.cones) {
            return Err(format!("{} diffuse cones are not in 1 to {}", self.cones, Self::MAX_CONES));
        }
        if !Self::PATTERNS_PX.contains(&self.pattern_px) {
            return Err(format!("a pattern of {} pixels is not one of {:?}", self.pattern_px, Self::PATTERNS_PX));
        }
        if let Some(sides) = self.indirect_px.filter(|sides| !sides.iter().all(|side| Self::INDIRECT_PX.contains(side)))
        {
            return Err(format!("indirect light at {} x {} pixels: a side has 16 to 8192", sides[0], sides[1]));
        }
        if let Some(distance) = self.occlusion_distance.filter(|distance| !(distance.is_finite() && *distance > 0.0)) {
            return Err(format!("an occlusion distance of {distance} scene units is not a finite number above 0"));
        }
        within("an aperture in degrees", self.cone_degrees, Self::CONE_DEGREES)?;
        within("a start in voxels", self.start_voxels, Self::START_VOXELS)?;
        within("a step in diameters", self.step_diameters, Self::STEP_DIAMETERS)?;
        within("a glossy roughness", self.glossy_roughness, 0.0..=1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indirect_light_is_as_small_as_asked_for() {
        let paper = ConeTracing { indirect_px: Some(ConeTracing::PAPER_INDIRECT_PX), ..ConeTracing::default() };
        assert_eq!(paper.specular_size_px([1920, 1080]), [1280, 720]);
        assert_eq!(paper.diffuse_size_px([1920, 1080]), [640, 360]);
        assert_eq!(paper.specular_size_px([640, 360]), [640, 360]);
        assert_eq!(ConeTracing::default().diffuse_size_px([33, 1]), [17, 1]);
    }
}
