//! Reference of `skinned.wgsl`: weighted linear transformations (section 3.2) in f64.
//!
//! In: up to four joints of a voxel with integer weights that sum to 255, one `grid_from_cache` a
//! joint. Out: the blended map, which then moves centre and normal as a rigid one does.

use glam::{DAffine3, DMat3};

use crate::data::voxel_cache::VoxelJoints;

/// Σ w/255 · M. A joint of weight zero takes no part, whatever its matrix holds. `None` where all joints have a scale
/// of zero: nothing is left of the voxel.
pub fn blended(joints: &VoxelJoints, grid_from_cache: &[DAffine3]) -> Option<DAffine3> {
    let mut sum = DAffine3::ZERO;
    for (joint, weight) in joints.joints.into_iter().zip(joints.weights).filter(|(_, weight)| *weight > 0) {
        let (w, m) = (f64::from(weight) / 255.0, &grid_from_cache[usize::from(joint)]);
        sum.matrix3 += m.matrix3 * w;
        sum.translation += m.translation * w;
    }
    (sum.matrix3 != DMat3::ZERO).then_some(sum)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn equal_halves_of_two_translations_meet_in_the_middle() {
        let joints = VoxelJoints { joints: [0, 1, 2, 2], weights: [85, 170, 0, 0] };
        let (a, b) = (DAffine3::from_translation(DVec3::X * 3.0), DAffine3::from_translation(DVec3::Y * 3.0));
        let garbage = DAffine3::from_translation(DVec3::splat(f64::NAN));
        let moved = blended(&joints, &[a, b, garbage]).expect("something").transform_point3(DVec3::ZERO);
        assert!((moved - DVec3::new(1.0, 2.0, 0.0)).length() < 1e-15);
    }

    #[test]
    fn joints_of_scale_zero_leave_nothing_and_one_that_has_size_something() {
        let nothing = DAffine3::from_scale(DVec3::ZERO);
        let joints = |weights| VoxelJoints { joints: [0, 1, 0, 0], weights };
        assert_eq!(blended(&joints([255, 0, 0, 0]), &[nothing, DAffine3::IDENTITY]), None);
        assert!(blended(&joints([254, 1, 0, 0]), &[nothing, DAffine3::IDENTITY]).is_some());
    }
}
