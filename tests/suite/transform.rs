//! Voxel transformation: exact where motion is exact, within derived bounds elsewhere.

use glam::{DAffine3, DMat3, DQuat, DVec3};
use octolume::data::grid::Grid;
use octolume::data::pages::SegmentOrder;
use octolume::data::voxel_cache::{CacheVoxel, VoxelJoints};
use octolume::settings::Filter;
use octolume::stages::build::mark_ref::{fragments, inside, mark};
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::transform::{Matrix3x4, rigid_ref, skinned_ref};
use proptest::prelude::*;
use proptest::test_runner::TestRng;

use crate::device::gpu;
use crate::random::{self, ONE};
use crate::stage_checks::quotients;
use crate::stage_rig::{self as rig, RigPart, World};

const DEPTH: u32 = 6;
const CELLS: f64 = 64.0;
/// Bits of a fraction: k.
const K: i32 = 8;

/// What transformation leaves of a rigid part under one map.
fn moved(grid_from_cache: &DAffine3, origin: [i32; 3], voxels: &[CacheVoxel]) -> Vec<Option<Fragment>> {
    moved_by(rig::matrix(grid_from_cache, 0.5), origin, voxels)
}

fn moved_by(matrix: Matrix3x4, origin: [i32; 3], voxels: &[CacheVoxel]) -> Vec<Option<Fragment>> {
    let part = RigPart { origin, voxels: voxels.to_vec(), matrices: vec![matrix], ..RigPart::default() };
    World::moved(gpu(), &[part], DEPTH, SegmentOrder::default()).fragments(gpu())
}

fn random_cache(rng: &mut TestRng, count: usize, cells: u32) -> Vec<CacheVoxel> {
    let voxel = |rng: &mut TestRng| {
        let cell = [(); 3].map(|()| rng.random_range(0..cells));
        let normal = DVec3::from_array([(); 3].map(|()| rng.random_range(-1.0..1.0)));
        rig::cache_voxel(cell, normal, [(); 3].map(|()| rng.random_range(0..=255)))
    };
    (0..count).map(|_| voxel(rng)).collect()
}

fn random_rotation(rng: &mut TestRng) -> DQuat {
    let q = [(); 4].map(|()| rng.random_range(-1.0..1.0_f64));
    DQuat::from_array(q).normalize()
}

/// Turns a cache of 48³ about its own middle and puts that anywhere near the grid.
fn random_rigid(rng: &mut TestRng) -> DAffine3 {
    let to = DVec3::from_array([(); 3].map(|()| rng.random_range(-10.0..CELLS + 10.0)));
    DAffine3::from_translation(to)
        * DAffine3::from_quat(random_rotation(rng))
        * DAffine3::from_translation(DVec3::splat(-24.0))
}

/// The cache as a world voxel holds it, without motion.
fn as_fragment(voxel: &CacheVoxel, cell: [i64; 3]) -> Fragment {
    let tens = [0, 10, 20].map(|shift| voxel.normal >> shift & 0x3ff);
    Fragment { q: cell.map(|c| c * ONE), normal: tens, albedo: [0, 8, 16].map(|shift| voxel.albedo >> shift & 0xff) }
}

fn position(voxel: &CacheVoxel) -> [i64; 3] {
    [0, 10, 20].map(|shift| i64::from(voxel.position >> shift & 0x3ff))
}

#[test]
fn identity_on_the_lattice_copies_the_cache_bit_for_bit() {
    let voxels = random_cache(&mut random::rng(1), 20_000, 64);
    let expected: Vec<_> = voxels.iter().map(|voxel| Some(as_fragment(voxel, position(voxel)))).collect();
    let found = moved(&DAffine3::IDENTITY, [0; 3], &voxels);
    let differing = found.iter().zip(&expected).find(|(found, expected)| found != expected);
    assert_eq!(differing, None);
}

#[test]
fn whole_cells_shift_the_set_exactly() {
    let voxels = random_cache(&mut random::rng(2), 2000, 64);
    for shift in [[5, -3, 0], [-63, 63, 7], [64, 0, 0], [-1, -1, -1]] {
        let to = DAffine3::from_translation(DVec3::from_array(shift.map(f64::from)));
        for (map, origin) in [(to, [0; 3]), (DAffine3::IDENTITY, shift)] {
            let cells = voxels.iter().map(|voxel| {
                let p = position(voxel);
                let cell = [0, 1, 2].map(|axis| p[axis] + i64::from(shift[axis]));
                inside(cell, DEPTH).map(|_| as_fragment(voxel, cell))
            });
            assert!(moved(&map, origin, &voxels) == cells.collect::<Vec<_>>(), "{shift:?}");
        }
    }
}

/// The 24 rotations that map the lattice to itself.
fn quarter_turns() -> Vec<DMat3> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let signed: Vec<DVec3> = axes.into_iter().flat_map(|axis| [axis, -axis]).collect();
    let pairs = signed.iter().flat_map(|x| signed.iter().map(move |y| (*x, *y)));
    pairs.filter(|(x, y)| x.dot(*y) == 0.0).map(|(x, y)| DMat3::from_cols(x, y, x.cross(y))).collect()
}

#[test]
fn quarter_turns_permute_exactly() {
    let voxels = random_cache(&mut random::rng(3), 3000, 64);
    let turns = quarter_turns();
    assert_eq!(turns.len(), 24);
    for turn in turns {
        // About the middle of the grid; as an angle, so that the matrix holds 6e-17 for some zeros.
        let angle = DMat3::from_quat(DQuat::from_mat3(&turn));
        let middle = DVec3::splat(32.0);
        let about =
            DAffine3::from_translation(middle) * DAffine3::from_mat3(angle) * DAffine3::from_translation(-middle);
        let expected = voxels.iter().map(|voxel| {
            let centre = DVec3::from_array(position(voxel).map(|c| c as f64 + 0.5));
            let cell = (turn * (centre - middle) + middle - 0.5).to_array().map(|c| c.round() as i64);
            let still = as_fragment(voxel, cell);
            let normal = turn * DVec3::from_array(still.normal.map(|n| f64::from(n) - 511.0));
            Some(Fragment { normal: normal.to_array().map(|n| (n.round() + 511.0) as u32), ..still })
        });
        let found = moved(&about, [0; 3], &voxels);
        let differing = found.into_iter().zip(expected).find(|(found, expected)| found != expected);
        assert_eq!(differing, None, "{turn:?}");
    }
}
