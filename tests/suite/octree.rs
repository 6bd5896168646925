//! The octree: kernels against references, the structure's own rules, dummies.

use octolume::data::pages::SegmentOrder;
use octolume::settings::Filter;
use octolume::stages::fill::gather_ref::Fragment;

use crate::device::gpu;
use crate::stage_checks::{self, Expected};
use crate::stage_rig::{Shape, World, world_voxel};

#[test]
fn first_run() {
    let gpu = gpu();
    let f = |q: [i64; 3]| Fragment { q, normal: [600, 300, 500], albedo: [10, 200, 77] };
    let voxels = [f([5 * 256 + 3, 700, 900]), f([-100, 700, 900]), f([64 * 256 - 4, 10000, 33])];
    let words: Vec<_> = voxels.iter().map(world_voxel).collect();
    for filter in [Filter::Nearest, Filter::Split] {
        for dense in [0, 3, 5] {
            let shape = Shape::new(6, dense, filter);
            let world = World::given(gpu, &words);
            let built = world.build(gpu, &shape);
            let expected = Expected::new(world.fragments(gpu), &shape);
            expected.check(&built).unwrap();
            stage_checks::validate(&built).unwrap();
            stage_checks::check_conservation(&built, &expected).unwrap();
            stage_checks::check_interpolation_corners(&built).unwrap();
        }
    }
    let _ = SegmentOrder::default();
}
