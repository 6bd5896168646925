//! Voxel transformation: exact where motion is exact, within derived bounds elsewhere.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
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
use crate::stage_checks::{self as checks, Check, Expected, quotients};
use crate::stage_rig::{self as rig, RigPart, Shape, World};

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

/// Every quarter turn about the middle of the grid permutes a cache, if this part of a cell (½: the
/// centre) is what moves.
pub fn check_quarter_turns(anchor: f64) -> Check {
    let voxels = random_cache(&mut random::rng(3), 3000, 64);
    for turn in quarter_turns() {
        // As an angle, so that the matrix holds 6e-17 for some zeros.
        let angle = DAffine3::from_quat(DQuat::from_mat3(&turn));
        let middle = DVec3::splat(32.0);
        let about = DAffine3::from_translation(middle) * angle * DAffine3::from_translation(-middle);
        let expected = voxels.iter().map(|voxel| {
            let centre = DVec3::from_array(position(voxel).map(|c| c as f64 + 0.5));
            let cell = (turn * (centre - middle) + middle - 0.5).to_array().map(|c| c.round() as i64);
            let still = as_fragment(voxel, cell);
            let normal = turn * DVec3::from_array(still.normal.map(|n| f64::from(n) - 511.0));
            Some(Fragment { normal: normal.to_array().map(|n| (n.round() + 511.0) as u32), ..still })
        });
        for (found, expected) in moved_by(rig::matrix(&about, anchor), [0; 3], &voxels).iter().zip(expected) {
            checks::same(&format!("a voxel turned by {turn}"), found, &expected)?;
        }
    }
    Ok(())
}

#[test]
fn quarter_turns_permute_exactly() {
    assert_eq!(quarter_turns().len(), 24);
    check_quarter_turns(0.5).unwrap_or_else(|difference| panic!("{difference}"));
}

/// Largest error of f32 sums of these `terms` with so many roundings on the way, in units of q; the
/// last two roundings are those of the quantisation.
fn slack_units(terms: f64, roundings: f64, g: f64) -> f64 {
    (terms * roundings + 2.0 * (g.abs() + 1.0)) * 2.0_f64.powi(K - 24)
}

/// Σ|m·p| + |t| of each row.
fn magnitudes(map: &DAffine3, i: [i32; 3]) -> DVec3 {
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
fn check_q(found: Option<[i64; 3]>, g: DVec3, terms: DVec3, roundings: f64) -> Check {
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
fn check_normal(found: [u32; 3], unit: DVec3) -> Check {
    let found = DVec3::from_array(found.map(|n| f64::from(n) - 511.0));
    let (rounding, cached) = (0.5, 3.0_f64.sqrt() / 2.0);
    let off = (found - unit * 511.0).abs().max_element();
    let length_off = (found.length() - 511.0 * unit.length()).abs();
    match off <= rounding + cached + 0.01 && length_off <= 2.0 * cached + 0.01 {
        true => Ok(()),
        false => Err(format!("normal {found} instead of {}", unit * 511.0)),
    }
}

fn unpacked(normal: u32) -> DVec3 {
    octolume::data::packing::unpack_normal(normal)
}

fn check_moved(part: &RigPart, map: &DAffine3, voxel: usize, found: &Option<Fragment>, roundings: f64) -> Check {
    let i = rig::lattice_cell(part, voxel);
    let cached = &part.voxels[voxel];
    let g = rigid_ref::centre(i, map);
    check_q(found.map(|f| f.q), g, magnitudes(map, i), roundings)?;
    let Some(found) = found else { return Ok(()) };
    checks::same("albedo", &found.albedo, &as_fragment(cached, [0; 3]).albedo)?;
    check_normal(found.normal, rigid_ref::move_normal(&map.matrix3, unpacked(cached.normal)))
}

#[test]
fn random_rigid_motion_agrees_with_the_reference() {
    let mut rng = random::rng(4);
    for _ in 0..6 {
        let map = random_rigid(&mut rng);
        let part = RigPart { voxels: random_cache(&mut rng, 4000, 48), ..RigPart::default() };
        let found = moved(&map, [0; 3], &part.voxels);
        for (voxel, found) in found.iter().enumerate() {
            // Four roundings of products and sums, one of the matrix.
            check_moved(&part, &map, voxel, found, 5.0).unwrap_or_else(|difference| panic!("{difference}"));
        }
    }
}

fn random_joints(rng: &mut TestRng, count: usize, joints: u16) -> Vec<VoxelJoints> {
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
fn random_pose(rng: &mut TestRng, joints: usize) -> Vec<DAffine3> {
    let base = random_rigid(rng);
    let bent = |rng: &mut TestRng| {
        let bend = DQuat::from_scaled_axis(DVec3::from_array([(); 3].map(|()| rng.random_range(-0.7..0.7))));
        let middle = DVec3::splat(24.0);
        base * DAffine3::from_translation(middle) * DAffine3::from_quat(bend) * DAffine3::from_translation(-middle)
    };
    (0..joints).map(|_| bent(rng)).collect()
}

fn skinned_part(rng: &mut TestRng, count: usize, maps: &[DAffine3]) -> RigPart {
    RigPart {
        voxels: random_cache(rng, count, 48),
        joints: random_joints(rng, count, maps.len() as u16),
        matrices: maps.iter().map(|map| rig::matrix(map, 0.5)).collect(),
        ..RigPart::default()
    }
}

#[test]
fn random_skinned_motion_agrees_with_the_reference_with_any_number_of_joints() {
    let mut rng = random::rng(5);
    for joints in [1, 22, 64, 300] {
        let maps = random_pose(&mut rng, joints);
        // A rigid part in front, so that joint records and voxels are numbered apart.
        let still = RigPart {
            voxels: random_cache(&mut rng, 300, 48),
            matrices: vec![rig::matrix(&DAffine3::IDENTITY, 0.5)],
            ..RigPart::default()
        };
        let part = skinned_part(&mut rng, 3000, &maps);
        let found = World::moved(gpu(), &[still, part.clone()], DEPTH, SegmentOrder::default()).fragments(gpu());
        for (voxel, found) in found[300..].iter().enumerate() {
            let blended = skinned_ref::blended(&part.joints[voxel], &maps);
            // Weight (4: a quotient is within 2.5 ulp), product, three sums of joints; then as rigid.
            check_moved(&part, &blended, voxel, found, 16.0).unwrap_or_else(|difference| panic!("{difference}"));
        }
    }
}

#[test]
fn one_joint_of_full_weight_moves_as_a_rigid_object_does() {
    let mut rng = random::rng(6);
    let (map, voxels) = (random_rigid(&mut rng), random_cache(&mut rng, 3000, 48));
    let rigid = moved(&map, [0; 3], &voxels);
    for slot in 0..4 {
        let (mut joints, mut weights) = ([9; 4], [0; 4]);
        (joints[slot], weights[slot]) = (1, 255);
        let part = RigPart {
            joints: vec![VoxelJoints { joints, weights }; voxels.len()],
            voxels: voxels.clone(),
            matrices: vec![Matrix3x4::default(), rig::matrix(&map, 0.5)],
            ..RigPart::default()
        };
        let skinned = World::moved(gpu(), &[part], DEPTH, SegmentOrder::default()).fragments(gpu());
        assert!(skinned == rigid, "weight {slot}");
    }
}

#[test]
fn a_joint_of_weight_zero_may_hold_garbage() {
    let mut rng = random::rng(7);
    let voxels = random_cache(&mut rng, 500, 48);
    let to = |x: f64| rig::matrix(&DAffine3::from_translation(DVec3::new(x, 3.0, 1.0)), 0.5);
    let garbage = Matrix3x4 { rows: [[f32::NAN; 4], [f32::INFINITY; 4], [1e38; 4]] };
    let part = RigPart {
        joints: vec![VoxelJoints { joints: [0, 1, 2, 2], weights: [85, 170, 0, 0] }; voxels.len()],
        voxels,
        matrices: vec![to(2.0), to(8.0), garbage],
        ..RigPart::default()
    };
    let found = World::moved(gpu(), std::slice::from_ref(&part), DEPTH, SegmentOrder::default()).fragments(gpu());
    for (voxel, found) in part.voxels.iter().zip(found) {
        // A third of 2 and two thirds of 8.
        let [x, y, z] = position(voxel);
        let found = found.expect("in the grid");
        assert!((found.q[0] - (x + 6) * ONE).abs() <= 1);
        assert_eq!(found.q[1..], [(y + 3) * ONE, (z + 1) * ONE]);
    }
}

#[test]
fn joints_that_cancel_leave_finite_voxels() {
    let turn = |degrees: f64| {
        let about = DAffine3::from_translation(DVec3::splat(24.0));
        about * DAffine3::from_rotation_z(degrees.to_radians()) * about.inverse()
    };
    let voxels = random_cache(&mut random::rng(8), 2000, 48);
    for (maps, weights) in [
        (vec![turn(0.0), turn(180.0), turn(0.0)], [127, 128, 0, 0]),
        (vec![turn(0.0), turn(120.0), turn(240.0)], [85, 85, 85, 0]),
        (vec![DAffine3::IDENTITY, DAffine3::from_scale(DVec3::splat(-1.0)), turn(0.0)], [127, 128, 0, 0]),
    ] {
        let part = RigPart {
            voxels: voxels.clone(),
            joints: vec![VoxelJoints { joints: [0, 1, 2, 0], weights }; voxels.len()],
            matrices: maps.iter().map(|map| rig::matrix(map, 0.5)).collect(),
            ..RigPart::default()
        };
        let found = World::moved(gpu(), &[part], DEPTH, SegmentOrder::default()).fragments(gpu());
        for (voxel, found) in voxels.iter().zip(found).filter_map(|(voxel, found)| Some((voxel, found?))) {
            let length = DVec3::from_array(found.normal.map(|n| f64::from(n) - 511.0)).length();
            let is_unit_or_zero = length == 0.0 || (length - 511.0).abs() <= 2.0;
            assert!(is_unit_or_zero && found.albedo == as_fragment(voxel, [0; 3]).albedo, "{found:?}");
        }
    }
}

#[test]
fn zero_normals_stay_zero_and_others_stay_unit_over_every_rotation() {
    let mut rng = random::rng(9);
    let mut voxels = random_cache(&mut rng, 400, 20);
    voxels.extend((0..400).map(|i| rig::cache_voxel([i % 20, i / 20, 3], DVec3::ZERO, [1, 2, 3])));
    for _ in 0..40 {
        let map = DAffine3::from_translation(DVec3::splat(32.0)) * DAffine3::from_quat(random_rotation(&mut rng));
        let found = moved(&map, [-10; 3], &voxels);
        for (voxel, found) in voxels.iter().zip(found) {
            let unit = rigid_ref::move_normal(&map.matrix3, unpacked(voxel.normal));
            let found = found.expect("in the grid").normal;
            check_normal(found, unit).unwrap_or_else(|difference| panic!("{difference}"));
            assert_eq!(unit == DVec3::ZERO, found == [511; 3]);
        }
    }
}

#[test]
fn centres_on_cell_faces_and_a_few_ulps_off_keep_the_derived_bound() {
    let one_voxel = [rig::cache_voxel([0; 3], DVec3::Z, [9; 3])];
    let mut rng = random::rng(10);
    for _ in 0..60 {
        // Faces of cells, of fractions, and what lies half-way between fractions.
        let face = f64::from(rng.random_range(0..64 * 512)) / 512.0;
        for ulps in [-2, -1, 0, 1, 2_i32] {
            let stepped = (0..ulps.abs()).fold(face as f32, |t, _| if ulps < 0 { t.next_down() } else { t.next_up() });
            let rows = [[1.0, 0.0, 0.0, stepped], [0.0, 1.0, 0.0, 7.5], [0.0, 0.0, 1.0, stepped]];
            let found = moved_by(Matrix3x4 { rows }, [0; 3], &one_voxel)[0].map(|f| f.q);
            let g = DVec3::new(f64::from(stepped), 7.5, f64::from(stepped));
            check_q(found, g, DVec3::ZERO, 0.0).unwrap_or_else(|difference| panic!("{difference}"));
        }
    }
}

#[test]
fn weight_inside_is_kept_and_weight_outside_is_counted_on_both_sides_of_every_face() {
    for axis in 0..3 {
        for (lower, is_near) in [(0, true), (63 * ONE, false)] {
            // Voxels that stick out by 1, 2 … 255 units, in rows of their own.
            let voxels: Vec<Fragment> = (1..256)
                .map(|out| {
                    let mut q = [2 * (out % 16) * ONE; 3];
                    q[(axis + 1) % 3] = 2 * (out / 16) * ONE;
                    q[axis] = if is_near { lower - out } else { lower + out };
                    Fragment { q, normal: [511; 3], albedo: [7; 3] }
                })
                .collect();
            let words: Vec<_> = voxels.iter().map(rig::world_voxel).collect();
            let built = World::given(gpu(), &words).build(gpu(), &Shape::new(DEPTH, 3, Filter::Split));
            assert_eq!(built.clipped, (1..256).map(|out| out << 16).sum::<u64>());
            let mut kept: Vec<u32> = built.leaves.iter().map(|leaf| leaf[0]).collect();
            kept.sort_unstable();
            assert_eq!(kept, (1..256).map(|kept| kept << 16).collect::<Vec<u32>>());
        }
    }
}

#[test]
fn far_objects_vanish_and_leave_the_rest_unharmed() {
    let mut rng = random::rng(12);
    let near = RigPart {
        voxels: random_cache(&mut rng, 700, 48),
        matrices: vec![rig::matrix(&random_rigid(&mut rng), 0.5)],
        ..RigPart::default()
    };
    let alone = World::moved(gpu(), std::slice::from_ref(&near), DEPTH, SegmentOrder::default()).fragments(gpu());
    for distance in [1e3, 1e9, 1e30, -1e30, 3e38] {
        let far = DAffine3::from_translation(DVec3::new(1.0, distance, 1.0)) * DAffine3::from_rotation_x(0.3);
        let far = RigPart { matrices: vec![rig::matrix(&far, 0.5)], ..near.clone() };
        let found = World::moved(gpu(), &[far, near.clone()], DEPTH, SegmentOrder::default()).fragments(gpu());
        assert!(found[..700].iter().all(Option::is_none));
        assert!(found[700..] == alone, "{distance}");
    }
}

/// `grid_from_cache` of an object at a place in a scene, both scaled and moved.
fn folded(scale: f64, offset: DVec3, rotation: DQuat) -> DAffine3 {
    let span = 0.03 * scale;
    let grid = Grid {
        anchor: DVec3::new(-0.7, 0.2, -1.1) * scale + offset,
        offset_cells: glam::IVec3::new(-5, -9, -2),
        span,
        depth: DEPTH,
    };
    let place = DVec3::new(0.013, 0.877, -0.523) * scale + offset;
    let world_from_object = DMat4::from_rotation_translation(rotation, place);
    let object_from_cache = DMat4::from_scale(DVec3::splat(span));
    DAffine3::from_mat4(grid.grid_from_world() * world_from_object * object_from_cache)
}

fn scene_q(scale: f64, offset: DVec3, rotation: DQuat) -> Vec<Option<[i64; 3]>> {
    let voxels = random_cache(&mut random::rng(13), 4000, 40);
    moved(&folded(scale, offset, rotation), [-20; 3], &voxels).iter().map(|f| f.map(|f| f.q)).collect()
}

fn assert_within_a_unit(found: &[Option<[i64; 3]>], expected: &[Option<[i64; 3]>]) {
    assert!(expected.iter().flatten().count() > 3000);
    for (found, expected) in found.iter().zip(expected) {
        let (Some(found), Some(expected)) = (found, expected) else {
            // Only what just touches the grid may be in on one side.
            let touching = found.or(*expected).is_none_or(|q| q.iter().any(|c| *c <= 2 - ONE || *c >= 64 * ONE - 2));
            assert!(touching, "{found:?} {expected:?}");
            continue;
        };
        assert!((0..3).all(|axis| (found[axis] - expected[axis]).abs() <= 1), "{found:?} {expected:?}");
    }
}

#[test]
fn a_scene_moved_by_a_million_units_has_the_same_voxels() {
    for (turn, seed) in [(DQuat::IDENTITY, 0), (random_rotation(&mut random::rng(14)), 1)] {
        let at_home = scene_q(1.0, DVec3::ZERO, turn);
        for offset in [DVec3::splat(1e6), DVec3::new(-1e6, 12_345.6, 3e5)] {
            assert_within_a_unit(&scene_q(1.0, offset, turn), &at_home);
        }
        assert!(at_home.iter().any(Option::is_some), "{seed}");
    }
}

#[test]
fn a_scene_scaled_with_its_span_has_the_same_voxels() {
    let turn = random_rotation(&mut random::rng(15));
    let of_one = scene_q(1.0, DVec3::ZERO, turn);
    for exponent in [-20, 20] {
        assert!(scene_q(2.0_f64.powi(exponent), DVec3::ZERO, turn) == of_one, "2^{exponent}");
    }
    for scale in [1e-6, 1e6] {
        assert_within_a_unit(&scene_q(scale, DVec3::ZERO, turn), &of_one);
    }
}

#[test]
fn a_mirrored_object_has_the_mirror_image_of_cells_and_normals() {
    let voxels = random_cache(&mut random::rng(16), 4000, 50);
    let mut rng = random::rng(17);
    for axis in 0..3 {
        // Generic offsets that f32 holds exactly: no voxel lies on a tie.
        let offset =
            DVec3::from_array([(); 3].map(|()| 7.0 + f64::from(rng.random_range(0..512)) / 512.0 + 1.0 / 2048.0));
        let straight = DAffine3::from_translation(offset);
        let mut flip = DVec3::ONE;
        flip[axis] = -1.0;
        let mirror = DAffine3::from_translation((DVec3::ONE - flip) * 32.0) * DAffine3::from_scale(flip);
        let (found, still) = (moved(&(mirror * straight), [0; 3], &voxels), moved(&straight, [0; 3], &voxels));
        for (found, still) in found.iter().zip(&still) {
            let (found, mut image) = (found.expect("inside"), still.expect("inside"));
            // The lower corner of the mirrored cube was its upper corner.
            image.q[axis] = 64 * ONE - ONE - image.q[axis];
            image.normal[axis] = 1022 - image.normal[axis];
            assert_eq!(found, image);
            let cells = |fragment: &Fragment, filter| fragments(fragment.q, filter);
            assert_eq!(cells(&found, Filter::Nearest), cells(&image, Filter::Nearest));
        }
    }
}

#[test]
fn a_mirrored_and_turned_surface_keeps_its_normals_outside() {
    let mut rng = random::rng(18);
    for _ in 0..5 {
        let reflection =
            DAffine3::from_scale(DVec3::new(1.0, 1.0, -1.0)) * DAffine3::from_quat(random_rotation(&mut rng));
        let map = DAffine3::from_translation(DVec3::splat(32.0)) * reflection;
        let part = RigPart { origin: [-10; 3], voxels: random_cache(&mut rng, 500, 20), ..RigPart::default() };
        let found = moved(&map, part.origin, &part.voxels);
        for (voxel, found) in found.iter().enumerate() {
            check_moved(&part, &map, voxel, found, 5.0).unwrap_or_else(|difference| panic!("{difference}"));
            // Inverse transpose by another route: for a reflection it is the map itself.
            let direct = map.matrix3 * unpacked(part.voxels[voxel].normal);
            check_normal(found.expect("inside").normal, direct.normalize()).unwrap_or_else(|d| panic!("{d}"));
        }
    }
}

/// Parts of different sizes, two of them skinned, that fill several segments each.
fn crowd(seed: u64) -> Vec<RigPart> {
    let mut rng = random::rng(seed);
    let counts = [700, 1, 256, 257, 900, 30];
    let part = |(index, count): (usize, usize)| {
        let maps = random_pose(&mut rng, if index % 3 == 2 { 5 } else { 1 });
        let mut part = skinned_part(&mut rng, count, &maps);
        if maps.len() == 1 {
            part.joints.clear();
        }
        RigPart { object: index as u32, ..part }
    };
    counts.into_iter().enumerate().map(part).collect()
}

#[test]
fn page_orders_and_workgroup_sizes_give_the_same_bits() {
    let parts = crowd(19);
    let shape = Shape::new(DEPTH, 3, Filter::Split);
    let first = World::moved(gpu(), &parts, DEPTH, SegmentOrder::LowestFirst);
    let (voxels, built) = (first.read(gpu()), first.build(gpu(), &shape));
    let highest = World::moved(gpu(), &parts, DEPTH, SegmentOrder::HighestFirst);
    assert!(highest.list.items.len() > first.list.items.len(), "the pages differ");
    assert!(highest.read(gpu()) == voxels);
    let other = highest.build(gpu(), &shape);
    assert!(other.leaves == built.leaves && other.nodes == built.nodes && other.leaf_objects == built.leaf_objects);
    let narrow = crate::device::open().with_workgroup_size(32);
    let other = World::moved(&narrow, &parts, DEPTH, SegmentOrder::LowestFirst);
    assert!(other.read(&narrow) == voxels);
}

#[test]
fn a_moved_scene_agrees_with_the_references_to_the_last_leaf() {
    let parts = crowd(20);
    let order = |part: &&RigPart| !part.joints.is_empty();
    let (skinned, rigid): (Vec<_>, Vec<_>) = parts.iter().partition(order);
    let objects: Vec<u32> =
        rigid.into_iter().chain(skinned).flat_map(|part| vec![part.object; part.voxels.len()]).collect();
    let world = World::moved(gpu(), &parts, DEPTH, SegmentOrder::default());
    for filter in [Filter::Nearest, Filter::Split] {
        let shape = Shape::new(DEPTH, 3, filter);
        let built = world.build(gpu(), &shape);
        let expected = Expected::new(world.fragments(gpu()), &shape);
        let all = expected
            .check(&built)
            .and_then(|()| checks::validate(&built))
            .and_then(|()| checks::check_conservation(&built, &expected))
            .and_then(|()| expected.check_objects(&built, &objects));
        all.unwrap_or_else(|difference| panic!("{filter:?}: {difference}"));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn the_eight_weights_of_any_place_sum_to_exactly_one_voxel(q in [-300_i64..20_000, -300..20_000, -300..20_000]) {
        for filter in [Filter::Nearest, Filter::Split] {
            let total: u64 = fragments(q, filter).iter().map(|(_, weight)| weight).sum();
            prop_assert_eq!(total, 1 << (3 * K));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10, max_shrink_iters: 8, ..ProptestConfig::default() })]

    /// Rigid voxels seven cells apart never share a leaf, so nothing is clamped: what the leaves hold and
    /// what was clipped is all there is.
    #[test]
    fn kept_and_clipped_are_all_there_is_after_any_motion(seed in any::<u64>(), skinned in any::<bool>()) {
        let mut rng = random::rng(seed);
        let maps = random_pose(&mut rng, 4);
        let mut part = skinned_part(&mut rng, 343, &maps);
        for (i, voxel) in (0..).zip(&mut part.voxels) {
            let cell = [i % 7, i / 7 % 7, i / 49].map(|c| 7 * c);
            voxel.position = octolume::data::packing::pack_position(cell);
        }
        if !skinned {
            part.joints.clear();
        }
        let world = World::moved(gpu(), &[part], DEPTH, SegmentOrder::default());
        let built = world.build(gpu(), &Shape::new(DEPTH, 3, Filter::Split));
        let kept: u64 = built.leaves.iter().map(|leaf| u64::from(leaf[0])).sum();
        let marked = mark(quotients(&world.fragments(gpu())), DEPTH, Filter::Split);
        prop_assert_eq!(u128::from(built.clipped), marked.clipped);
        prop_assert_eq!(marked.kept + marked.clipped, 343 << 24);
        if !skinned {
            prop_assert_eq!(kept + built.clipped, 343 << 24);
        }
    }
}
