//! Colours of what is measured or numbered; shader and legend take them from here.

use bytemuck::{Pod, Zeroable};
use colorous::{Color, Gradient};

use crate::color::linear_from_gamma;
use crate::gpu::{Mirror, mirror};
use crate::settings::ColorBy;

const ENTRIES: usize = 256;
/// Consecutive numbers get hues this share of a turn apart: the golden ratio, so that they differ.
const HUE_STEP: f64 = 0.618_033_988_749_895;

/// Mirror of `Palette` in shaders/shared/view.wgsl: linear, of a value 0 … 1 or a number mod 256.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Palette {
    pub colors: [[f32; 4]; ENTRIES],
}

impl Palette {
    pub fn new(color: ColorBy) -> Self {
        let linear = |entry: usize| {
            let [r, g, b] = legend_entry(color, entry).map(|byte| linear_from_gamma(f64::from(byte) / 255.0) as f32);
            [r, g, b, 1.0]
        };
        Self { colors: std::array::from_fn(linear) }
    }
}

/// sRGB bytes of a value from 0 to 1: occupancy, or level over depth.
pub fn legend_value(color: ColorBy, value: f64) -> [u8; 3] {
    legend_entry(color, (value.clamp(0.0, 1.0) * (ENTRIES - 1) as f64).round() as usize)
}

/// sRGB bytes of an object's number.
pub fn legend_object(object: u32) -> [u8; 3] {
    legend_entry(ColorBy::Object, object as usize)
}

fn legend_entry(color: ColorBy, entry: usize) -> [u8; 3] {
    let entry = entry % ENTRIES;
    let value = entry as f64 / (ENTRIES - 1) as f64;
    let rgb = |gradient: Gradient, value: f64| {
        let Color { r, g, b } = gradient.eval_continuous(value);
        [r, g, b]
    };
    match color {
        ColorBy::Object => rgb(colorous::SINEBOW, (entry as f64 * HUE_STEP).fract()),
        ColorBy::Level => rgb(colorous::PLASMA, value),
        ColorBy::Radiance | ColorBy::Irradiance => rgb(colorous::INFERNO, value),
        ColorBy::Albedo | ColorBy::Normal | ColorBy::Occupancy => rgb(colorous::VIRIDIS, value),
    }
}

/// Mirror of `GhostColors` in shaders/view/ghost.wgsl: linear colour, and alpha of a visited cell.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct GhostColors {
    /// In the moved and the exact set.
    pub both: [f32; 4],
    /// In the exact set alone: what transformation missed.
    pub holes: [f32; 4],
    /// In the moved set alone: what it added.
    pub spill: [f32; 4],
}

pub const MIRRORS: &[Mirror] = &[
    mirror!(Palette, "shared/view.wgsl", "Palette", colors),
    mirror!(GhostColors, "view/ghost.wgsl", "GhostColors", both, holes, spill),
];

/// Spill lies over holes like a haze: split voxels spill everywhere, and holes must show through.
pub const GHOST_COLORS: GhostColors =
    GhostColors { both: [0.4, 0.4, 0.4, 0.3], holes: [0.85, 0.03, 0.02, 0.95], spill: [0.03, 0.12, 0.9, 0.12] };

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::srgb_byte;

    #[test]
    fn legend_and_shader_share_every_colour() {
        for color in [ColorBy::Occupancy, ColorBy::Object, ColorBy::Level] {
            let palette = Palette::new(color);
            for (entry, painted) in palette.colors.iter().enumerate() {
                let bytes = legend_entry(color, entry);
                let shown = [0, 1, 2].map(|c| srgb_byte(painted[c]));
                assert_eq!(shown, bytes, "{color:?} {entry}");
            }
        }
    }

    #[test]
    fn neighbouring_objects_have_different_colours() {
        for object in 0..255 {
            assert_ne!(legend_object(object), legend_object(object + 1));
        }
    }
}
