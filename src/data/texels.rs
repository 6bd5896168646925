//! How the bytes of an image are read, and what a level half as large as another holds of it.

use crate::scene::{AlphaMode, Material};

/// How a material's slot reads the bytes of its image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Texels {
    /// Numbers, such as metallic and roughness.
    Linear,
    /// sRGB colour; alpha says nothing.
    Opaque,
    /// sRGB colour weighted by alpha, so that what is invisible colours nothing.
    Covering,
    /// The same where a mask cuts: a texel is there with an alpha byte of `least` or more, and smaller levels hold
    /// in alpha which share of their texels is. 256: none.
    Cut { least: u16 },
}

impl Texels {
    /// One more than the largest [`Self::Cut`].
    pub const CUTS: usize = 257;

    /// Of a base colour texture.
    pub fn of_base_color(material: &Material) -> Self {
        match material.alpha_mode {
            AlphaMode::Opaque => Self::Opaque,
            AlphaMode::Blend => Self::Covering,
            AlphaMode::Mask { cutoff } => {
                let passes = |byte: &u16| material.base_color[3] * (f32::from(*byte) / 255.0) >= cutoff;
                Self::Cut { least: (0..256).find(passes).unwrap_or(256) }
            }
        }
    }

    /// Whether the bytes of red, green and blue are sRGB.
    pub fn are_colors(self) -> bool {
        self != Self::Linear
    }

    /// Share of a texel of the file's image that is there.
    pub fn presence(self, alpha: u8) -> f64 {
        match self {
            Self::Linear | Self::Opaque => 1.0,
            Self::Covering => f64::from(alpha) / 255.0,
            Self::Cut { least } => f64::from(u8::from(u16::from(alpha) >= least)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texel_passes_where_factor_times_alpha_reaches_the_cutoff() {
        let texels = |factor: f32, cutoff: f32| {
            let base_color = [1.0, 1.0, 1.0, factor];
            let alpha_mode = AlphaMode::Mask { cutoff };
            Texels::of_base_color(&Material { base_color, alpha_mode, ..Material::default() })
        };
        assert_eq!(texels(1.0, 0.5), Texels::Cut { least: 128 });
        assert_eq!(texels(1.0, 128.0 / 255.0), Texels::Cut { least: 128 });
        assert_eq!(texels(0.5, 0.5), Texels::Cut { least: 255 });
        assert_eq!(texels(0.4, 0.5), Texels::Cut { least: 256 });
        assert_eq!(texels(1.0, 0.0), Texels::Cut { least: 0 });
        assert_eq!(Texels::Cut { least: 128 }.presence(127), 0.0);
    }
}
