//! The tests of the core: one module an area, one binary so that it links once.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::unreachable,
    clippy::unwrap_used,
    reason = "a test fails by panicking"
)]

/// Vectors and matrices, entry by entry.
macro_rules! assert_near {
    ($value:expr, $expected:expr, $tolerance:expr $(,)?) => {
        let (value, expected) = ($value, $expected);
        assert!(value.abs_diff_eq(expected, $tolerance), "{value} is not {expected}");
    };
}

mod accumulation;
mod animation;
mod averaging;
mod brdf;
mod builtin;
mod camera;
mod character_motion;
mod compare;
mod compose;
mod cone_filter;
mod cone_forms;
mod cone_gloss;
mod cone_light;
mod cone_mirror;
mod cone_motion;
mod cone_rig;
mod cones;
mod counted_surfaces;
mod device;
mod direct_light;
mod direction;
mod disk_cache;
mod disk_cache_folder;
mod disk_cache_key;
mod doc_tables;
mod discretizers;
mod document;
mod dummies;
mod emission;
mod experiments;
mod expose;
mod extensions;
mod furnace;
mod gpu;
mod gpu_errors;
mod gpu_memory;
mod gpu_reads;
mod hard_cases;
mod hidden;
mod illegal_files;
mod illuminate;
mod inspect;
mod leaks;
mod light_rig;
mod light_store;
mod light_views;
mod lights;
mod link;
mod lit_octree;
mod loading;
mod loading_refused;
mod lost_device;
mod many_objects;
mod mesh_rig;
mod mesh_view;
mod misfits;
mod morphs;
mod motion;
mod moving;
mod mutations;
mod normal_maps;
mod object_numbers;
mod octree;
mod octree_rules;
mod octree_sizes;
mod parts;
mod path_tracer;
mod path_tracer_brdf;
mod path_tracer_disk;
mod path_tracer_rig;
mod picture_error;
mod plain_octree;
mod plan;
mod plan_light;
mod plan_surfaces;
mod prepared;
mod random;
mod ray_rig;
mod rays;
mod real_scenes;
mod references;
mod repairs;
mod residency;
mod room;
mod sampling;
mod sampling_rig;
mod scan;
mod scenes;
mod shaders;
mod shadow_maps;
mod shadow_truth;
mod sides;
mod skin_rig;
mod skinning;
mod skins_hard;
mod slice;
mod stage_buffers;
mod stage_build;
mod stage_checks;
mod stage_rig;
mod stretching;
mod surface_image;
mod surface_rig;
mod surface_scenes;
mod surface_shadows;
mod textures;
mod tiles;
mod transform;
mod transform_scenes;
mod transform_skinned;
mod vanishing;
mod view;
mod view_rig;
mod voxelization;
mod voxelization_payload;
mod voxelization_surface;
mod voxelizer;
mod walks;
mod warnings;
