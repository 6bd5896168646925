//! What the GPU is given to compile: every file of `shaders/`, and the numbers and structs that stages share with them.

use std::f64::consts::{FRAC_1_PI, PI};

use super::{build, cones, fill, light, pixels, sample, surface, textures, transform, view, voxelize};
use crate::color::LUMINANCE;
use crate::data;
use crate::gpu::{self, Constant, Mirror, Shaders, constants};

pub static SHADERS: Shaders =
    Shaders { files: include!(concat!(env!("OUT_DIR"), "/shaders.rs")), constants: CONSTANTS };

const MATHEMATICS: &[Constant] = constants![
    float PI,
    float INVERSE_PI = FRAC_1_PI,
    float LUMINANCE_RED = LUMINANCE[0],
    float LUMINANCE_GREEN = LUMINANCE[1],
    float LUMINANCE_BLUE = LUMINANCE[2],
];

const CONSTANTS: &[&[Constant]] = &[
    MATHEMATICS,
    data::light::CONSTANTS,
    data::octree::CONSTANTS,
    data::albedo::CONSTANTS,
    data::fragments::CONSTANTS,
    data::packing::CONSTANTS,
    data::pages::CONSTANTS,
    data::voxel_cache::CONSTANTS,
    build::CONSTANTS,
    fill::number_objects::CONSTANTS,
    light::CONSTANTS,
    light::gather::CONSTANTS,
    light::shadow::CONSTANTS,
    sample::CONSTANTS,
    data::mesh::CONSTANTS,
    surface::CONSTANTS,
    surface::compose::CONSTANTS,
    surface::count_luminance::CONSTANTS,
    surface::expose::CONSTANTS,
    textures::halve::CONSTANTS,
    cones::CONSTANTS,
    cones::specular::CONSTANTS,
    pixels::CONSTANTS,
    view::show_surfaces::CONSTANTS,
    view::slice::CONSTANTS,
    voxelize::shade::CONSTANTS,
];

/// Structs in bindings, list by list.
pub const MIRRORS: &[&[Mirror]] = &[
    gpu::MIRRORS,
    data::fragments::MIRRORS,
    data::matrix::MIRRORS,
    data::mesh::MIRRORS,
    data::octree::MIRRORS,
    data::pages::MIRRORS,
    transform::MIRRORS,
    build::MIRRORS,
    light::illuminate::MIRRORS,
    light::gather::MIRRORS,
    light::inject::MIRRORS,
    light::shadow::MIRRORS,
    sample::sample_points::MIRRORS,
    surface::draw::MIRRORS,
    surface::compose::MIRRORS,
    surface::count_luminance::MIRRORS,
    surface::expose::MIRRORS,
    textures::halve::MIRRORS,
    cones::blur::MIRRORS,
    cones::diffuse::MIRRORS,
    cones::glossy_tiles::MIRRORS,
    cones::list_tiles::MIRRORS,
    cones::specular::MIRRORS,
    cones::upsample::MIRRORS,
    pixels::MIRRORS,
    view::palette::MIRRORS,
    view::march_light::MIRRORS,
    view::mesh::MIRRORS,
    view::show_shadow::MIRRORS,
    view::show_surfaces::MIRRORS,
    view::slice::MIRRORS,
    voxelize::shade::MIRRORS,
];
