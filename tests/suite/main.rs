//! The tests of the core: one module an area, one binary so that it links once.

/// Vectors and matrices, entry by entry.
macro_rules! assert_near {
    ($value:expr, $expected:expr, $tolerance:expr $(,)?) => {
        let (value, expected) = ($value, $expected);
        assert!(value.abs_diff_eq(expected, $tolerance), "{value} is not {expected}");
    };
}

mod animation;
mod builtin;
mod camera;
mod device;
mod document;
mod gpu;
mod loading;
mod mesh_view;
mod motion;
mod octree;
mod parts;
mod plain_octree;
mod random;
mod rays;
mod scenes;
mod shaders;
mod skinning;
mod stage_checks;
mod stage_rig;
mod view;
mod voxelization;
mod voxelization_payload;
