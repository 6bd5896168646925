//! The constants that Rust and WGSL share; a shader gets them by `#import constants`.

use crate::color::LUMINANCE;
use crate::data::light::EMISSION_MAX;
use crate::data::octree::{ALBEDO_NODE_SCALE, FRACTION_BITS, FULL_WEIGHT, MAX_FRAGMENTS, NO_BLOCK};
use crate::data::packing::NORMAL_MAX;
use crate::data::pages::WORK_HINT_THREADS;
use crate::data::voxel_cache::TILE_CELLS;
use crate::stages::build::scan::SCAN_CHUNK;
use crate::stages::build::{COUNTER_CLIPPED, COUNTER_OCCUPIED};
use crate::stages::cones::specular;
use crate::stages::fill::number_objects::OBJECT_MASK;
use crate::stages::light::gather;
use crate::stages::{cones, light, mesh, sample, surface, view};

/// Name in WGSL and value, taken from the Rust constant so that no number is written twice.
pub const CONSTANTS: &[(&str, u32)] = &[
    ("ALBEDO_NODE_SCALE", ALBEDO_NODE_SCALE),
    ("ALPHA_BLEND", mesh::ALPHA_BLEND),
    ("ALPHA_MASK", mesh::ALPHA_MASK),
    ("COLOR_DARK", view::COLOR_DARK),
    ("COLOR_LEVEL", view::COLOR_LEVEL),
    ("COLOR_NORMAL", view::COLOR_NORMAL),
    ("COLOR_OBJECT", view::COLOR_OBJECT),
    ("COLOR_OCCUPANCY", view::COLOR_OCCUPANCY),
    ("COUNTER_CLIPPED", COUNTER_CLIPPED),
    ("COUNTER_OCCUPIED", COUNTER_OCCUPIED),
    ("CURVE_ACES", view::show_surfaces::CURVE_ACES),
    ("CURVE_REINHARD", view::show_surfaces::CURVE_REINHARD),
    ("EMISSION_MAX", EMISSION_MAX),
    ("FILTER_QUADRILINEAR", sample::FILTER_QUADRILINEAR),
    ("FILTER_TRILINEAR", sample::FILTER_TRILINEAR),
    ("FRACTION_BITS", FRACTION_BITS),
    ("FRACTION_ONE", 1 << FRACTION_BITS),
    ("FULL_WEIGHT", FULL_WEIGHT),
    ("GOLDEN_TURN", gather::GOLDEN_TURN),
    ("LEFT_HANDED", mesh::LEFT_HANDED),
    ("LIGHT_DIRECTIONAL", light::LIGHT_DIRECTIONAL),
    ("LIGHT_SPOT", light::LIGHT_SPOT),
    ("MAX_FRAGMENTS", MAX_FRAGMENTS),
    ("NORMAL_MAX", NORMAL_MAX as u32),
    ("NO_BLOCK", NO_BLOCK),
    ("OBJECT_MASK", OBJECT_MASK),
    ("SCAN_CHUNK", SCAN_CHUNK),
    ("SHADOWS_MAP", light::SHADOWS_MAP),
    ("SHADOWS_OFF", light::SHADOWS_OFF),
    ("SHOWS_DEPTH", view::show_surfaces::SHOWS_DEPTH),
    ("SHOWS_LIGHT", view::show_surfaces::SHOWS_LIGHT),
    ("SHOWS_NORMAL", view::show_surfaces::SHOWS_NORMAL),
    ("SLICE_LOGARITHMIC", view::slice::SLICE_LOGARITHMIC),
    ("SLICE_OCCUPANCY", view::slice::SLICE_OCCUPANCY),
    ("SLICE_OF_MEAN", view::slice::SLICE_OF_MEAN),
    ("SUM_THREADS", surface::sum_luminance::SUM_THREADS),
    ("TERM_ALBEDO", surface::compose::TERM_ALBEDO),
    ("TERM_AO", surface::compose::TERM_AO),
    ("TERM_DEPTH", surface::compose::TERM_DEPTH),
    ("TERM_DIFFUSE", surface::compose::TERM_DIFFUSE),
    ("TERM_DIRECT", surface::compose::TERM_DIRECT),
    ("TERM_FINAL", surface::compose::TERM_FINAL),
    ("TERM_IRRADIANCE", surface::compose::TERM_IRRADIANCE),
    ("TERM_NORMAL", surface::compose::TERM_NORMAL),
    ("TERM_ROUGHNESS", surface::compose::TERM_ROUGHNESS),
    ("TERM_SPECULAR", surface::compose::TERM_SPECULAR),
    ("TILE_CELLS", TILE_CELLS as u32),
    ("VIEW_EDGES", view::VIEW_EDGES),
    ("VIEW_LENGTH_RULE", view::VIEW_LENGTH_RULE),
    ("VIEW_SHADED", view::VIEW_SHADED),
    ("WORK_HINT_THREADS", WORK_HINT_THREADS),
];

/// The same for numbers that are no integers.
pub const FLOAT_CONSTANTS: &[(&str, f64)] = &[
    ("ACES_A", view::show_surfaces::ACES[0]),
    ("ACES_B", view::show_surfaces::ACES[1]),
    ("ACES_C", view::show_surfaces::ACES[2]),
    ("ACES_D", view::show_surfaces::ACES[3]),
    ("ACES_E", view::show_surfaces::ACES[4]),
    ("AMBIENT", view::AMBIENT),
    ("DIELECTRIC_REFLECTANCE", surface::DIELECTRIC_REFLECTANCE),
    ("EDGE_FROM_PX", view::EDGE_FROM_PX),
    ("EDGE_FULL_PX", view::EDGE_FULL_PX),
    ("EDGE_SHADE", view::EDGE_SHADE),
    ("HORIZON_CELLS", sample::HORIZON_CELLS),
    ("HORIZON_FADE", sample::HORIZON_FADE),
    ("HORIZON_SHARE", sample::HORIZON_SHARE),
    ("INVERSE_PI", std::f64::consts::FRAC_1_PI),
    ("LEAST_DISTANCE_CELLS", light::LEAST_DISTANCE_CELLS),
    ("LEAST_EYE_COSINE", surface::LEAST_EYE_COSINE),
    ("LEAST_LIGHT", view::LEAST_LIGHT),
    ("LEAST_ROUGHNESS", surface::LEAST_ROUGHNESS),
    ("LEAST_STEP", gather::LEAST_STEP),
    ("LEAST_THROUGH", sample::LEAST_THROUGH),
    ("LEAST_WEIGHT", cones::LEAST_WEIGHT),
    ("LIGHT_NEAR_CELLS", light::shadow::NEAR_CELLS),
    ("LUMINANCE_BLUE", LUMINANCE[2]),
    ("LUMINANCE_GREEN", LUMINANCE[1]),
    ("LUMINANCE_RED", LUMINANCE[0]),
    ("MEAN_SHOWN_AS", view::MEAN_SHOWN_AS),
    ("NARROWEST_TANGENT", specular::NARROWEST_TANGENT),
    ("PI", std::f64::consts::PI),
    ("SHADOW_HEIGHT_CELLS", surface::SHADOW_HEIGHT_CELLS),
    ("SHADOW_HEIGHT_TEXELS", surface::SHADOW_HEIGHT_TEXELS),
    ("SHORT_NORMAL", view::SHORT_NORMAL),
    ("SPREAD_COSINE", light::SPREAD_COSINE),
    ("TURN_ANGLE", gather::TURN_ANGLE),
    ("WIDEST_TANGENT", specular::WIDEST_TANGENT),
];

/// One `const NAME: u32 = …;` or `const NAME: f32 = …;` a line.
pub fn wgsl() -> String {
    let integers = CONSTANTS.iter().map(|(name, value)| format!("const {name}: u32 = {value}u;\n"));
    let floats = FLOAT_CONSTANTS.iter().map(|(name, value)| format!("const {name}: f32 = {:?}f;\n", *value as f32));
    integers.chain(floats).collect()
}
