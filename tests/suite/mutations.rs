//! Defects on purpose: the assertions of the real tests must see them.

use octolume::settings::Filter;

use crate::device::gpu;
use crate::octree_rules as rules;
use crate::random;
use crate::stage_build::Shape;
use crate::stage_checks::Expected;
use crate::stage_rig::{World, world_voxel};
use crate::transform::check_quarter_turns;

#[test]
fn moving_the_corner_instead_of_the_centre_is_caught() {
    assert_eq!(check_quarter_turns(0.5), Ok(()));
    let caught = check_quarter_turns(0.0).expect_err("a turned corner lands elsewhere");
    assert!(caught.starts_with("a voxel turned by"), "{caught}");
}

#[test]
fn dropped_dummies_are_caught() {
    let voxels = random::scene(1, 200, 6);
    let words: Vec<_> = voxels.iter().map(world_voxel).collect();
    let world = World::given(gpu(), &words);
    let shape = Shape::new(6, 3, Filter::Split);
    let expected = Expected::new(voxels.into_iter().map(Some).collect(), &shape);
    let [sound, mutated] = [true, false].map(|dummies| world.build(gpu(), &Shape { dummies, ..shape }));
    assert_eq!(rules::check_interpolation_corners(&sound), Ok(()));
    assert_eq!(expected.check_pyramids(&sound), Ok(()));
    let lacking = rules::check_interpolation_corners(&mutated).expect_err("corners are missing");
    assert!(lacking.contains("lacks its dummy"), "{lacking}");
    expected.check_pyramids(&mutated).expect_err("the masks differ");
    // Only the dummies are gone: the octree without them is a sound one.
    assert_eq!(rules::validate(&mutated), Ok(()));
    assert_eq!(expected.check_leaves(&mutated), Ok(()));
}
