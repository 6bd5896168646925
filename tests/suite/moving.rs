//! Random caches and motions for tests of the transformation, and how far from its f64 reference a
//! moved voxel may be.

use glam::{DAffine3, DQuat, DVec3};
use octolume::data::matrix::Matrix3x4;
use octolume::data::packing::unpack_normal;
use octolume::data::pages::SegmentOrder;
use octolume::data::voxel_cache::{CacheVoxel, VoxelJoints};
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::transform::rigid_ref;
use proptest::prelude::*;
use proptest::test_runner::TestRng;

use crate::device::gpu;
use crate::random::ONE;
use crate::stage_checks::{self as checks, Check};
use crate::stage_rig::{self as rig, RigPart, World};

pub const DEPTH: u32 = 6;

pub const CELLS: f64 = 64.0;

/// Bits of a fraction: k.
pub const K: i32 = 8;

/// What transformation leaves of a rigid part under one map.
pub fn moved(grid_from_cache: &DAffine3, origin: [i32; 3], voxels: &[CacheVoxel]) -> Vec<Option<Fragment>> {
    moved_by(rig::matrix(grid_from_cache, 0.5), origin, voxels)
}

pub fn moved_by(matrix: Matrix3x4, origin: [i32; 3], voxels: &[CacheVoxel]) -> Vec<Option<Fragment>> {
    let part = RigPart { origin, voxels: voxels.to_vec(), matrices: vec![matrix], ..RigPart::default() };
    World::moved(gpu(), &[part], DEPTH, SegmentOrder::default()).fragments(gpu())
}

pub fn random_cache(rng: &mut TestRng, count: usize, cells: u32) -> Vec<CacheVoxel> {
    let voxel = |rng: &mut TestRng| {
        let cell = [(); 3].map(|()| rng.random_range(0..cells));
        let normal = DVec3::from_array([(); 3].map(|()| rng.random_range(-1.0..1.0)));
        rig::cache_voxel(cell, normal, [(); 3].map(|()| rng.random_range(0..=255)))
    };
    (0..count).map(|_| voxel(rng)).collect()
}

pub fn random_rotation(rng: &mut TestRng) -> DQuat {
    let q = [(); 4].map(|()| rng.random_range(-1.0..1.0_f64));
    DQuat::from_array(q).normalize()
}

/// Turns a cache of 48³ about its own middle and puts that anywhere near the grid.
pub fn random_rigid(rng: &mut TestRng) -> DAffine3 {
    let to = DVec3::from_array([(); 3].map(|()| rng.random_range(-10.0..CELLS + 10.0)));
    DAffine3::from_translation(to)
        * DAffine3::from_quat(random_rotation(rng))
        * DAffine3::from_translation(DVec3::splat(-24.0))
}

pub fn random_joints(rng: &mut TestRng, count: usize, joints: u16) -> Vec<VoxelJoints> {
    let record = |rng: &mut TestRng| {
        let cuts = {
            let mut cuts = [(); 3].map(|()| rng.random_range(0..=255_u8));
            cuts.sort_unstable();
            cuts
        };
        let weights = [cuts[0], cuts[1] - cuts[0], cuts[2] - cuts[1], 255 - cuts[2]];
        VoxelJoints { joints: [(); 4].map(|()| rng.random_range(0..joints)), weights }
    };
    (0..count).map(|_| record(rng)).collect()
}

/// Joints that bend about one place, as those of a limb do.
pub fn random_pose(rng: &mut TestRng, joints: usize) -> Vec<DAffine3> {
    let base = random_rigid(rng);
    let bent = |rng: &mut TestRng| {
        let bend = DQuat::from_scaled_axis(DVec3::from_array([(); 3].map(|()| rng.random_range(-0.7..0.7))));
        let middle = DVec3::splat(24.0);
        base * DAffine3::from_translation(middle) * DAffine3::from_quat(bend) * DAffine3::from_translation(-middle)
    };
    (0..joints).map(|_| bent(rng)).collect()
}

pub fn skinned_part(rng: &mut TestRng, count: usize, maps: &[DAffine3]) -> RigPart {
    RigPart {
        voxels: random_cache(rng, count, 48),
        joints: random_joints(rng, count, maps.len() as u16),
        matrices: maps.iter().map(|map| rig::matrix(map, 0.5)).collect(),
        ..RigPart::default()
    }
}

/// The cache as a world voxel holds it, without motion.
pub fn as_fragment(voxel: &CacheVoxel, cell: [i64; 3]) -> Fragment {
    let tens = [0, 10, 20].map(|shift| voxel.normal >> shift & 0x3ff);
    let albedo = [0, 8, 16].map(|shift| voxel.albedo >> shift & 0xff);
    Fragment { q: cell.map(|c| c * ONE), normal: tens, albedo, coverage: voxel.albedo >> 24 }
}

pub fn position(voxel: &CacheVoxel) -> [i64; 3] {
    [0, 10, 20].map(|shift| i64::from(voxel.position >> shift & 0x3ff))
}

pub fn unpacked(normal: u32) -> DVec3 {
    unpack_normal(normal)
}

/// Largest error of f32 sums of these `terms` with so many roundings on the way, in units of q; the
/// last two roundings are those of the quantisation.
pub fn slack_units(terms: f64, roundings: f64, g: f64) -> f64 {
    (terms * roundings + 2.0 * (g.abs() + 1.0)) * 2.0_f64.powi(K - 24)
}

/// Σ|m·p| + |t| of each row.
pub fn magnitudes(map: &DAffine3, i: [i32; 3]) -> DVec3 {
    let columns = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis].map(DVec3::abs);
    let p = i.map(|c| f64::from(c).abs());
    columns[0] * p[0]
        + columns[1] * p[1]
        + columns[2] * p[2]
        + map.translation.abs()
        + columns[0]
        + columns[1]
        + columns[2]
}

/// |q − 256(g − ½)| is half a unit and what f32 loses; a voxel is left out only where it ends.
pub fn check_q(found: Option<[i64; 3]>, g: DVec3, terms: DVec3, roundings: f64) -> Check {
    let exact = (g - 0.5) * ONE as f64;
    let slack = DVec3::from_array([0, 1, 2].map(|axis| 0.5 + slack_units(terms[axis], roundings, g[axis])));
    let Some(q) = found else {
        let inside = exact.cmpgt(slack - ONE as f64).all() && exact.cmplt(CELLS * ONE as f64 - slack).all();
        return if inside { Err(format!("a voxel at {g} is left out")) } else { Ok(()) };
    };
    let off = (DVec3::from_array(q.map(|c| c as f64)) - exact).abs();
    let reference = rigid_ref::quantise(g).ok_or("the reference has no q")?;
    let units = (0..3).map(|axis| (q[axis] - reference[axis]).abs()).max();
    match off.cmple(slack).all() && units <= Some(1) && rigid_ref::overlaps_grid(q, CELLS as i64) {
        true => Ok(()),
        false => Err(format!("q {q:?} of {g}, which is {exact} units: off by {off}, allowed {slack}")),
    }
}

/// A moved normal is within its own rounding and that of the cache of the exact direction.
pub fn check_normal(found: [u32; 3], unit: DVec3) -> Check {
    let found = DVec3::from_array(found.map(|n| f64::from(n) - 511.0));
    let (rounding, cached) = (0.5, 3.0_f64.sqrt() / 2.0);
    let off = (found - unit * 511.0).abs().max_element();
    let length_off = (found.length() - 511.0 * unit.length()).abs();
    match off <= rounding + cached + 0.01 && length_off <= 2.0 * cached + 0.01 {
        true => Ok(()),
        false => Err(format!("normal {found} instead of {}", unit * 511.0)),
    }
}

pub fn check_moved(part: &RigPart, map: &DAffine3, voxel: usize, found: &Option<Fragment>, roundings: f64) -> Check {
    let i = rig::lattice_cell(part, voxel);
    let cached = &part.voxels[voxel];
    let g = rigid_ref::centre(i, map);
    check_q(found.map(|f| f.q), g, magnitudes(map, i), roundings)?;
    let Some(found) = found else { return Ok(()) };
    checks::same("albedo", &found.albedo, &as_fragment(cached, [0; 3]).albedo)?;
    check_normal(found.normal, rigid_ref::move_normal(&map.matrix3, unpacked(cached.normal)))
}
