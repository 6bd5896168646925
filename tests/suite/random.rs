//! Random inputs from a seed: the same on every machine and in every run.

use octolume::stages::fill::gather_ref::Fragment;
use proptest::prelude::RngExt;
use proptest::test_runner::{RngAlgorithm, TestRng};

/// Units of q in a cell.
pub const ONE: i64 = 256;

pub fn rng(seed: u64) -> TestRng {
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    TestRng::from_seed(RngAlgorithm::ChaCha, &bytes)
}

/// A voxel anywhere that a grid of this depth can see, guard layer and far edge included.
pub fn voxel(rng: &mut TestRng, depth: u32) -> Fragment {
    let end = (1 << depth) * ONE;
    let q = [(); 3].map(|()| rng.random_range(1 - ONE..end));
    with_q(rng, q)
}

/// Random colour and normal at a place.
pub fn with_q(rng: &mut TestRng, q: [i64; 3]) -> Fragment {
    Fragment {
        q,
        normal: [(); 3].map(|()| rng.random_range(0..=1022)),
        albedo: [(); 3].map(|()| rng.random_range(0..=255)),
        coverage: coverage(q),
    }
}

/// By the place, so that it changes nothing of what is drawn after: most surfaces cover their voxels, some are hardly
/// there.
fn coverage([x, y, z]: [i64; 3]) -> u32 {
    if (x ^ y ^ z) & 3 == 0 { ((7 * x + 13 * y + 29 * z) & 255) as u32 } else { 255 }
}

/// Half of them in a few clusters of a few cells, half anywhere.
pub fn scene(seed: u64, count: usize, depth: u32) -> Vec<Fragment> {
    let mut rng = rng(seed);
    let end = (1 << depth) * ONE;
    let centres: Vec<[i64; 3]> = (0..5).map(|_| voxel(&mut rng, depth).q).collect();
    let clustered = |rng: &mut TestRng, index: usize| {
        let near = |axis: usize, rng: &mut TestRng| rng.random_range(-3 * ONE..3 * ONE) + centres[index % 5][axis];
        let q = [0, 1, 2].map(|axis| near(axis, rng).clamp(1 - ONE, end - 1));
        with_q(rng, q)
    };
    (0..count).map(|i| if i % 2 == 0 { voxel(&mut rng, depth) } else { clustered(&mut rng, i / 2) }).collect()
}
