//! Pixels: where they are stored, the rays they look along, and how what those meet is coloured.

pub mod camera;
pub mod crossings;
pub mod picture;
pub mod projection;

use bytemuck::{Pod, Zeroable};

use crate::gpu::{Constant, Mirror, constants, mirror};
use crate::settings::{AlphaRule, ColorBy, Look};
use camera::PixelRays;

pub use picture::Picture;

pub const VIEW_SHADED: u32 = 1;
pub const VIEW_EDGES: u32 = 2;
pub const VIEW_LENGTH_RULE: u32 = 4;

pub const COLOR_ALBEDO: u32 = 0;
pub const COLOR_NORMAL: u32 = 1;
pub const COLOR_OCCUPANCY: u32 = 2;
pub const COLOR_OBJECT: u32 = 3;
pub const COLOR_LEVEL: u32 = 4;
pub const COLOR_DARK: u32 = 5;

/// A ray ends when less light than this comes through. No 8-bit value changes by one: at black,
/// where gamma encoding is steepest, 255 · 12.92 / 4096 < 1.
pub const LEAST_LIGHT: f64 = 1.0 / 4096.0;
/// What a headlight leaves of a surface seen edge-on.
pub const AMBIENT: f64 = 0.3;
/// Normals shorter than this were cancelled; the face that the ray enters through stands in.
pub const SHORT_NORMAL: f64 = 0.1;
/// Lines at voxel borders leave this much of the colour; they fade in between these widths of a
/// voxel in pixels.
pub const EDGE_SHADE: f64 = 0.45;
pub const EDGE_FROM_PX: f64 = 4.0;
pub const EDGE_FULL_PX: f64 = 10.0;
/// Mean light is shown as this without an exposure of one's own: mean voxels are mostly in shadow, so that what
/// is lit comes out bright.
pub const MEAN_SHOWN_AS: f64 = 0.18;

pub const CONSTANTS: &[Constant] = constants![
    integer COLOR_DARK,
    integer COLOR_LEVEL,
    integer COLOR_NORMAL,
    integer COLOR_OBJECT,
    integer COLOR_OCCUPANCY,
    integer VIEW_EDGES,
    integer VIEW_LENGTH_RULE,
    integer VIEW_SHADED,
    float AMBIENT,
    float EDGE_FROM_PX,
    float EDGE_FULL_PX,
    float EDGE_SHADE,
    float LEAST_LIGHT,
    float MEAN_SHOWN_AS,
    float SHORT_NORMAL,
];

/// Linear.
pub const BACKGROUND: [f32; 3] = [0.022, 0.025, 0.03];
/// Distance of a pixel where less than half of the light is stopped.
pub const NO_DEPTH: f32 = 3.0e38;

/// Mirror of `ViewParams` in shaders/shared/view.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ViewParams {
    pub origin: [f32; 3],
    pub width_px: u32,
    pub origin_x: [f32; 3],
    pub height_px: u32,
    pub origin_y: [f32; 3],
    pub start_cells: f32,
    pub direction: [f32; 3],
    pub level: u32,
    pub direction_x: [f32; 3],
    pub color_by: u32,
    pub direction_y: [f32; 3],
    pub flags: u32,
    pub background: [f32; 3],
    pub pad: u32,
}

pub const MIRRORS: &[Mirror] = &[mirror!(
    ViewParams,
    "shared/view.wgsl",
    "ViewParams",
    origin,
    width_px,
    origin_x,
    height_px,
    origin_y,
    start_cells,
    direction,
    level,
    direction_x,
    color_by,
    direction_y,
    flags,
    background,
    pad
)];

impl ViewParams {
    /// For a grid of 2^`depth` cells an axis.
    pub fn new(rays: &PixelRays, look: &Look, depth: u32) -> Self {
        let flag = |on: bool, bit: u32| if on { bit } else { 0 };
        let level = shown_level(look, depth);
        Self {
            origin: rays.origin.as_vec3().to_array(),
            width_px: rays.size_px[0],
            origin_x: rays.origin_x.as_vec3().to_array(),
            height_px: rays.size_px[1],
            origin_y: rays.origin_y.as_vec3().to_array(),
            start_cells: rays.start_cells as f32,
            direction: rays.direction.as_vec3().to_array(),
            level,
            direction_x: rays.direction_x.as_vec3().to_array(),
            color_by: color_number(shown_color(look, depth)),
            direction_y: rays.direction_y.as_vec3().to_array(),
            flags: flag(look.shaded, VIEW_SHADED)
                | flag(look.voxel_edges, VIEW_EDGES)
                | flag(look.alpha == AlphaRule::Length, VIEW_LENGTH_RULE),
            background: BACKGROUND,
            pad: 0,
        }
    }
}

/// The level a look shows; the leaves where it names none or one that is too deep.
pub fn shown_level(look: &Look, depth: u32) -> u32 {
    look.level.map_or(depth, |level| level.min(depth))
}

/// The colouring a look shows: only leaves know their object, above them albedo stands in.
pub fn shown_color(look: &Look, depth: u32) -> ColorBy {
    match look.color {
        ColorBy::Object if shown_level(look, depth) < depth => ColorBy::Albedo,
        color => color,
    }
}

fn color_number(color: ColorBy) -> u32 {
    match color {
        ColorBy::Albedo => COLOR_ALBEDO,
        // Light has a kernel of its own: this one draws voxels only where there is none.
        ColorBy::Radiance | ColorBy::Irradiance => COLOR_DARK,
        ColorBy::Normal => COLOR_NORMAL,
        ColorBy::Occupancy => COLOR_OCCUPANCY,
        ColorBy::Object => COLOR_OBJECT,
        ColorBy::Level => COLOR_LEVEL,
    }
}
