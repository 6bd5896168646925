//! The tests of the core: one module an area, one binary so that it links once.

mod accumulation;
mod averaging;
mod builtin;
/// Vectors and matrices, entry by entry.
macro_rules! assert_near {
    ($value:expr, $expected:expr, $tolerance:expr $(,)?) => {
        let (value, expected) = ($value, $expected);
        assert!(value.abs_diff_eq(expected, $tolerance), "{value} is not {expected}");
    };
}

mod animation;
mod camera;
mod device;
mod document;
mod gpu;
mod loading;
mod mesh_view;
mod mutations;
mod motion;
mod octree;
mod parts;
mod random;
mod scenes;
mod shaders;
mod plain_octree;
mod prepared;
mod rays;
mod skinning;
mod stage_checks;
mod stage_rig;
mod transform;
mod view;
mod voxelization;
mod voxelization_payload;
mod voxelization_surface;
