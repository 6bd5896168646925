//! The tests of the core: one module an area, one binary so that it links once.

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
mod motion;
mod parts;
mod plain_octree;
mod rays;
mod scenes;
mod shaders;
mod skinning;
mod view;
mod octree;
mod random;
mod shaders;
mod stage_checks;
mod stage_rig;
mod voxelization;
mod voxelization_payload;
