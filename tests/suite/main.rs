//! The tests of the core: one module an area, one binary so that it links once.

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
mod builtin;
mod camera;
mod cones;
mod device;
mod disk_cache;
mod disk_cache_folder;
mod disk_cache_key;
mod document;
mod dummies;
mod emission;
mod extensions;
mod furnace;
mod gpu;
mod gpu_errors;
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
mod lost_device;
mod mesh_rig;
mod mesh_view;
mod motion;
mod moving;
mod mutations;
mod object_numbers;
mod octree;
mod octree_rules;
mod parts;
mod plain_octree;
mod plan;
mod plan_light;
mod prepared;
mod random;
mod rays;
mod residency;
mod sampling;
mod scan;
mod scenes;
mod shaders;
mod shadow_maps;
mod shadow_truth;
mod skin_rig;
mod skinning;
mod skins_hard;
mod slice;
mod stage_build;
mod stage_checks;
mod stage_rig;
mod tiles;
mod transform;
mod transform_scenes;
mod transform_skinned;
mod view;
mod view_rig;
mod voxelization;
mod voxelization_payload;
mod voxelization_surface;
