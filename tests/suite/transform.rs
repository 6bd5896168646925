//! Voxel transformation: exact where motion is exact, within derived bounds of the reference elsewhere.

use glam::{DAffine3, DMat3, DQuat, DVec3};
use octolume::data::matrix::Matrix3x4;
use octolume::settings::Filter;
use octolume::stages::build::mark_ref::{fragments, inside};
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::transform::rigid_ref;
use proptest::prelude::*;

use crate::moving::{
    DEPTH, K, as_fragment, check_moved, check_normal, check_q, moved, moved_by, position, random_cache, random_rigid,
    random_rotation, unpacked,
};
use crate::random::{self, ONE};
use crate::stage_checks::{self as checks, Check};
use crate::stage_rig::{self as rig, RigPart};

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
