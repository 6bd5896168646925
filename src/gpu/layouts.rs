//! Rust structs and the WGSL structs they mirror, for the test that compares them.
//!
//! A struct that a uniform or storage binding holds must be listed here; fields have the same
//! names on both sides, and padding is spelled out on both.

use std::mem::offset_of;

use super::Threads;
use crate::data::octree::{OctreeLevel, OctreeParams};
use crate::data::pages::WorkItem;
use crate::stages::build::LevelParams;
use crate::stages::build::scan::ScanParams;
use crate::stages::cones::blur::BlurParams;
use crate::stages::cones::diffuse::DiffuseParams;
use crate::stages::cones::glossy_tiles::GlossyParams;
use crate::stages::cones::list_tiles::ListParams;
use crate::stages::cones::specular::SpecularParams;
use crate::stages::cones::upsample::UpsampleParams;
use crate::stages::light::gather::{ConeParams, ConeShape};
use crate::stages::light::illuminate::LightParams;
use crate::stages::light::inject::InjectParams;
use crate::stages::light::shadow::{ShadowFrame, ShadowParams};
use crate::stages::mesh::{DrawParams, MeshVertex, TextureSlot, VertexJoints};
use crate::stages::sample::sample_points::PointParams;
use crate::stages::surface::compose::ComposeParams;
use crate::stages::surface::draw::SurfaceParams;
use crate::stages::surface::mean_luminance::PictureExposure;
use crate::stages::surface::sum_luminance::SumParams;
use crate::stages::transform::{Matrix3x4, Part, TransformParams};
use crate::stages::view::march_light::ExposureParams;
use crate::stages::view::mesh::MeshParams;
use crate::stages::view::show_shadow::ShowShadowParams;
use crate::stages::view::show_surfaces::ShowSurfacesParams;
use crate::stages::view::slice::SliceParams;
use crate::stages::view::{GhostColors, Palette, ViewParams};

/// Both sides of a layout, as Rust sees it.
#[derive(Clone, Copy, Debug)]
pub struct Mirror {
    pub rust_name: &'static str,
    /// The file of `shaders/` that defines the WGSL struct.
    pub file: &'static str,
    pub wgsl_name: &'static str,
    pub bytes: usize,
    /// Every field and its offset in bytes.
    pub fields: &'static [(&'static str, usize)],
}

macro_rules! mirror {
    ($rust:ty, $file:literal, $wgsl:literal, $($field:ident),+ $(,)?) => {
        Mirror {
            rust_name: stringify!($rust),
            file: $file,
            wgsl_name: $wgsl,
            bytes: size_of::<$rust>(),
            fields: &[$((stringify!($field), offset_of!($rust, $field))),+],
        }
    };
}

pub const MIRRORS: &[Mirror] = &[
    mirror!(Threads, "shared/threads.wgsl", "Threads", first, end),
    mirror!(WorkItem, "shared/work_list.wgsl", "WorkItem", first_thread, first_slot, first_voxel, part, object),
    mirror!(TransformParams, "shared/move_voxel.wgsl", "TransformParams", grid_cells, first_thread),
    mirror!(Matrix3x4, "shared/move_voxel.wgsl", "Matrix3x4", rows),
    mirror!(Part, "shared/part.wgsl", "Part", origin, first_matrix, joints_skew, object, emission_skew, pad),
    mirror!(OctreeLevel, "shared/octree.wgsl", "OctreeLevel", occupied_word, blocks_word, first_block, first_node),
    mirror!(
        OctreeParams,
        "shared/octree.wgsl",
        "OctreeParams",
        depth,
        dense_level,
        block_count,
        leaf_block_count,
        inner_node_count,
        leaf_count,
        dense_node_count,
        pad,
        levels,
    ),
    mirror!(LevelParams, "build/reduce.wgsl", "ReduceParams", level),
    mirror!(LevelParams, "build/emit.wgsl", "EmitParams", level),
    mirror!(LevelParams, "averaging/average.wgsl", "AverageParams", level),
    mirror!(LevelParams, "light/average_light.wgsl", "AverageLightParams", level),
    mirror!(ShowShadowParams, "view/show_shadow.wgsl", "ShowShadowParams", least, most, layers, map_px),
    mirror!(InjectParams, "light/inject.wgsl", "InjectParams", emission_nits),
    mirror!(ExposureParams, "view/march_light.wgsl", "ExposureParams", factor, automatic),
    mirror!(ShadowFrame, "shared/shadow_frame.wgsl", "ShadowFrame", clip_from_grid, distance),
    mirror!(ShadowParams, "shared/shadow_map.wgsl", "ShadowParams", frames, count, size_px, pad),
    mirror!(
        LightParams,
        "shared/light.wgsl",
        "LightParams",
        position,
        kind,
        direction,
        range_cells,
        strength,
        offset_cells,
        angle_scale,
        angle_offset,
        pad,
    ),
    mirror!(ScanParams, "build/scan_sum.wgsl", "ScanParams", count),
    mirror!(ScanParams, "build/scan_spread.wgsl", "ScanParams", count),
    mirror!(ConeShape, "shared/cone.wgsl", "ConeShape", widening, start_cells, step_diameters, reach_cells,),
    mirror!(ConeParams, "light/gather.wgsl", "ConeParams", sky, count, shape),
    mirror!(
        DiffuseParams,
        "cones/diffuse.wgsl",
        "DiffuseParams",
        sky,
        count,
        shape,
        size_px,
        pattern_px,
        occlusion_cells,
    ),
    mirror!(BlurParams, "cones/blur.wgsl", "BlurParams", size_px, radius_px, vertical, weights),
    mirror!(UpsampleParams, "cones/upsample.wgsl", "UpsampleParams", size_px, pad),
    mirror!(GlossyParams, "cones/glossy_tiles.wgsl", "GlossyParams", size_px, tiles, most_roughness),
    mirror!(SpecularParams, "cones/specular.wgsl", "SpecularParams", sky, most_roughness, shape, size_px, pad),
    mirror!(SliceParams, "view/slice.wgsl", "SliceParams", axis, height_cells, at, flags, least, most, pad,),
    mirror!(ComposeParams, "surface/compose.wgsl", "ComposeParams", sky, glossy_roughness, span, pad, pad_end),
    mirror!(SumParams, "surface/sum_luminance.wgsl", "SumParams", pixels),
    mirror!(ShowSurfacesParams, "view/show_surfaces.wgsl", "ShowSurfacesParams", least, most, sky, pad),
    mirror!(PictureExposure, "shared/picture_exposure.wgsl", "PictureExposure", factor, mean, pad),
    mirror!(ListParams, "cones/list_tiles.wgsl", "ListParams", tiles),
    mirror!(PointParams, "sample/sample_points.wgsl", "PointParams", direction, pad),
    mirror!(
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
        pad,
    ),
    mirror!(Palette, "shared/view.wgsl", "Palette", colors),
    mirror!(GhostColors, "view/ghost.wgsl", "GhostColors", both, holes, spill),
    mirror!(MeshParams, "view/mesh.wgsl", "MeshParams", clip_from_camera, world_from_camera),
    mirror!(MeshVertex, "shared/posed_mesh.wgsl", "MeshVertex", position, color, normal, tangent, tex_coords),
    mirror!(
        SurfaceParams,
        "surface/draw.wgsl",
        "SurfaceParams",
        clip_from_camera,
        world_from_camera,
        emission,
        pad,
        pad_2,
    ),
    mirror!(TextureSlot, "shared/posed_mesh.wgsl", "TextureSlot", u, tex_coord, v, is_filled),
    mirror!(VertexJoints, "shared/posed_mesh.wgsl", "VertexJoints", joints, weights),
    mirror!(Matrix3x4, "shared/posed_mesh.wgsl", "MeshMatrix", rows),
    mirror!(
        DrawParams,
        "shared/posed_mesh.wgsl",
        "DrawParams",
        base_color,
        first_index,
        first_vertex,
        first_matrix,
        object,
        alpha_mode,
        cutoff,
        unlit,
        has_tangents,
        emissive,
        normal_scale,
        roughness,
        metallic,
        pad,
        base_color_slot,
        metallic_roughness_slot,
        normal_slot,
        emissive_slot,
    ),
];
