//! What is asked of paths beside the settings.

/// What settings leave open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    pub size_px: [u32; 2],
    pub seed: u64,
    pub pixel: PixelSampling,
    pub reflection: Reflection,
}

impl Options {
    /// Comparable with a surface image of that size.
    pub fn new(size_px: [u32; 2]) -> Self {
        Self { size_px, seed: 0, pixel: PixelSampling::default(), reflection: Reflection::default() }
    }
}

/// Where in a pixel rays go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PixelSampling {
    /// Through its centre, as the surface image has it.
    #[default]
    Centre,
    /// Anywhere: edges are smooth.
    Area,
}

/// What surfaces make of light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reflection {
    /// glTF's metallic-roughness BRDF.
    #[default]
    MetallicRoughness,
    /// The base colour of what arrives, every way alike, as leaves of the octree do.
    Lambert,
}
