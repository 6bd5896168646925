//! Whole scenes, prepared and folded as the program does it, moved on the GPU.

use std::sync::Arc;

use glam::{DMat3, DMat4, DQuat, DVec3};
use octolume::data::matrix::Matrix3x4;
use octolume::data::pages::SegmentOrder;
use octolume::prepare::{FrameMatrices, Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{Channel, Interpolation, LocalTransform, Node, Property, Scene, Trs};
use octolume::settings::{Discretization, Hidden, MotionSettings, VoxelAnchor};
use octolume::stages::fill::gather_ref::Fragment;

use crate::device::gpu;
use crate::random::ONE;
use crate::scenes::{channel, clip, cube_scene, node, rotation, skinned_scene};
use crate::stage_rig::{RigPart, World};

const STILL: MotionSettings = MotionSettings { clip: None, time_secs: 0.0, turn_degrees: [0.0; 3] };

fn prepared(scene: Scene, span: Option<f64>) -> Prepared {
    let discretization = Discretization { grid: 64, span, ..Discretization::default() };
    prepare(Arc::new(scene), &discretization, None, &Progress::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn folded(prepared: &Prepared, motion: &MotionSettings) -> FrameMatrices {
    let pose = prepared.pose(motion).unwrap_or_else(|error| panic!("{error}"));
    prepared.fold((motion, &pose), VoxelAnchor::Centre, &Hidden::default())
}

/// World voxels of the parts that are in the grid, by object.
fn moved(prepared: &Prepared, motion: &MotionSettings) -> Vec<(usize, Vec<Option<Fragment>>)> {
    let frame = folded(prepared, motion);
    let resident = (0..prepared.parts.len()).filter(|&part| frame.resident[part]);
    resident
        .map(|number| {
            let part = &prepared.parts[number];
            let cache = &prepared.caches[prepared.objects[part.object].cache];
            let range = part.tile.voxels.start as usize..part.tile.voxels.end as usize;
            let joints = if prepared.is_skinned(part) { cache.joints[range.clone()].to_vec() } else { Vec::new() };
            let rig = RigPart {
                object: part.object as u32,
                origin: frame.parts[number].origin,
                voxels: cache.voxels[range].to_vec(),
                joints,
                matrices: frame.matrices[frame.parts[number].first_matrix as usize..].to_vec(),
            };
            let world = World::moved(gpu(), &[rig], prepared.grid.depth, SegmentOrder::default());
            (part.object, world.fragments(gpu()))
        })
        .collect()
}

/// A cube that a clip moves, so that it has a lattice of its own, turned and in some place.
fn moving_cube(trs: Trs) -> Scene {
    let mut scene = cube_scene(trs);
    let from = trs.translation.to_array();
    let to = (trs.translation + DVec3::X * trs.scale.abs().max_element()).to_array();
    let slide =
        channel(Property::Translation, octolume::scene::Interpolation::Linear, &[0.0, 1.0], &[from, to].concat());
    scene.clips.push(clip(vec![slide]));
    scene
}

fn turned(translation: DVec3, scale: f64) -> Trs {
    let rotation = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -1.1, 0.7);
    Trs { translation, rotation, scale: DVec3::splat(scale) }
}

fn assert_same_within_a_unit(found: &Prepared, expected: &Prepared, motions: [&MotionSettings; 2]) {
    assert_eq!(found.caches[0].voxels, expected.caches[0].voxels);
    let (found, expected) = (moved(found, motions[0]), moved(expected, motions[1]));
    assert!(!expected.is_empty() && found.len() == expected.len());
    for ((_, found), (_, expected)) in found.iter().zip(&expected) {
        for (found, expected) in found.iter().zip(expected) {
            let (found, expected) = (found.expect("inside"), expected.expect("inside"));
            let units = (0..3).map(|axis| (found.q[axis] - expected.q[axis]).abs()).max();
            assert!(units <= Some(1), "{found:?} {expected:?}");
            assert_eq!((found.normal, found.albedo), (expected.normal, expected.albedo));
        }
    }
}

#[test]
fn a_scene_far_from_the_origin_is_prepared_as_at_home() {
    let motion = MotionSettings { time_secs: 0.37, ..STILL };
    let at_home = prepared(moving_cube(turned(DVec3::new(0.25, 0.5, 0.125), 1.0)), Some(0.06));
    for offset in [DVec3::splat(1_000_000.0), DVec3::new(-1_000_000.0, 65_536.0, 0.0)] {
        let far = prepared(moving_cube(turned(DVec3::new(0.25, 0.5, 0.125) + offset, 1.0)), Some(0.06));
        assert_same_within_a_unit(&far, &at_home, [&motion, &motion]);
    }
}

#[test]
fn a_scene_scaled_with_its_span_is_prepared_as_at_one() {
    let of_one = prepared(moving_cube(turned(DVec3::new(0.25, 0.5, 0.125), 1.0)), Some(0.06));
    let motion = MotionSettings { time_secs: 0.37, ..STILL };
    for exponent in [-20, 20] {
        let scale = 2.0_f64.powi(exponent);
        let scaled = prepared(moving_cube(turned(DVec3::new(0.25, 0.5, 0.125) * scale, scale)), Some(0.06 * scale));
        assert_eq!(moved(&scaled, &motion), moved(&of_one, &motion), "2^{exponent}");
    }
    for scale in [1e-6, 1e6] {
        let scaled = prepared(moving_cube(turned(DVec3::new(0.25, 0.5, 0.125) * scale, scale)), Some(0.06 * scale));
        assert_same_within_a_unit(&scaled, &of_one, [&motion, &motion]);
    }
}

fn linear(matrix: &Matrix3x4) -> DMat3 {
    let rows = matrix.rows.map(|row| DVec3::new(row[0].into(), row[1].into(), row[2].into()));
    DMat3::from_cols(rows[0], rows[1], rows[2]).transpose()
}

fn assert_turns_only(matrix: &Matrix3x4, what: &str) {
    let m = linear(matrix);
    assert!((m.transpose() * m).abs_diff_eq(DMat3::IDENTITY, 1e-6), "{what}: {m}");
}

#[test]
fn stretch_that_does_not_change_is_baked_and_what_moves_is_rigid() {
    let stretched = |scale: DVec3| moving_cube(Trs { scale, ..turned(DVec3::ONE, 1.0) });
    for scale in [DVec3::splat(100.0), DVec3::splat(0.01), DVec3::new(3.0, 0.5, 1.0), DVec3::new(-2.0, 1.0, 1.0)] {
        let prepared = prepared(stretched(scale), None);
        let frame = folded(&prepared, &MotionSettings { time_secs: 0.5, ..STILL });
        assert_eq!(frame.left_out, Vec::<usize>::new());
        assert_turns_only(&frame.matrices[0], &format!("{scale}"));
        assert!(prepared.warnings.is_empty(), "{:?}", prepared.warnings);
    }
    // Shear: a turned child of a non-uniformly scaled parent.
    let mut sheared = stretched(DVec3::new(4.0, 1.0, 0.5));
    let child = Node { mesh: sheared.nodes[0].mesh.take(), ..node(Some(0), turned(DVec3::ZERO, 1.0)) };
    sheared.nodes.push(child);
    let prepared = prepared(sheared, None);
    assert_turns_only(&folded(&prepared, &STILL).matrices[0], "shear");
}

#[test]
fn scale_inside_joints_is_baked_and_joints_only_turn() {
    for scale in [100.0, 0.01] {
        let poses = [turned(DVec3::ZERO, scale), turned(DVec3::new(0.1, 0.2, 0.0) * scale, scale)];
        let inverse_bind = [DMat4::IDENTITY, DMat4::from_translation(DVec3::new(-0.1, 0.0, 0.3))];
        let scene = skinned_scene([0, 1, 0, 0], [0.4, 0.6, 0.0, 0.0], &poses, &inverse_bind);
        let prepared = prepared(scene, None);
        for matrix in &folded(&prepared, &STILL).matrices {
            assert_turns_only(matrix, &format!("joint of scale {scale}"));
        }
    }
}

/// Two cubes; what is wrong with the second must not touch the first.
fn with_second(local: LocalTransform) -> Scene {
    let mut scene = moving_cube(turned(DVec3::new(0.25, 0.5, 0.125), 1.0));
    scene.nodes.push(Node { name: "second".to_owned(), mesh: Some(0), local, ..node(None, Trs::default()) });
    // What moves it is another clip than the one that is played.
    let turns = [DQuat::IDENTITY, DQuat::from_rotation_x(1.0)];
    scene.clips.push(clip(vec![Channel { node: 1, ..rotation(Interpolation::Linear, &turns) }]));
    scene
}

#[test]
fn singular_objects_are_hidden_and_objects_at_no_finite_place_left_out_and_the_rest_is_unharmed() {
    let alone = prepared(moving_cube(turned(DVec3::new(0.25, 0.5, 0.125), 1.0)), Some(0.06));
    let expected = moved(&alone, &STILL);
    let nan = DMat4::from_translation(DVec3::new(f64::NAN, 0.0, 0.0));
    let infinite = DMat4::from_translation(DVec3::new(0.0, f64::INFINITY, 0.0));
    let zero = DMat4::from_scale(DVec3::ZERO);
    for (local, is_hidden) in [(nan, false), (infinite, false), (zero, true)] {
        let both = prepared(with_second(LocalTransform::Matrix(local)), Some(0.06));
        // Hidden for ever: a warning of the scene. Not finite now: an object of the frame.
        let named = both.warnings.iter().any(|warning| warning.sentence.contains("\"second\""));
        let left_out = folded(&both, &STILL).left_out;
        assert_eq!((named, left_out), (is_hidden, if is_hidden { vec![] } else { vec![1] }), "{local}");
        assert_eq!(both.grid, alone.grid, "{local}");
        assert!(moved(&both, &STILL) == expected, "{local}");
    }
}

#[test]
fn an_object_that_flies_off_leaves_the_grid_and_the_rest_alone() {
    let alone = prepared(moving_cube(turned(DVec3::new(0.25, 0.5, 0.125), 1.0)), Some(0.06));
    let motion = MotionSettings { time_secs: 0.5, ..STILL };
    let expected = moved(&alone, &motion);
    for far in [1e9, 1e30, 1e45] {
        // Anchored at the first cube: the far one must not decide the grid, or nothing else would be in it.
        let mut both =
            prepared(with_second(LocalTransform::Trs(turned(DVec3::new(0.25, 0.5, 0.125), 1.0))), Some(0.06));
        let mut scene = (*both.scene).clone();
        scene.nodes[1].local = LocalTransform::Trs(turned(DVec3::new(far, 0.0, -far), 1.0));
        both.scene = Arc::new(scene);
        let found = moved(&both, &motion);
        assert!(found.iter().any(|(object, _)| *object == 0));
        for (object, fragments) in &found {
            assert!(if *object == 0 { *fragments == expected[0].1 } else { fragments.iter().all(Option::is_none) });
        }
    }
}

#[test]
fn a_static_object_at_rest_is_a_copy_of_its_cache() {
    let prepared = prepared(cube_scene(turned(DVec3::new(3.0, -2.0, 0.5), 1.0)), None);
    let part = &prepared.parts[0];
    let origin = part.tile.origin - prepared.grid.offset_cells;
    let found = &moved(&prepared, &STILL)[0].1;
    for (voxel, found) in prepared.caches[0].voxels.iter().zip(found) {
        let position = [0, 10, 20].map(|shift| i64::from(voxel.position >> shift & 0x3ff));
        let expected = Fragment {
            q: [0, 1, 2].map(|axis| (position[axis] + i64::from(origin[axis])) * ONE),
            normal: [0, 10, 20].map(|shift| voxel.normal >> shift & 0x3ff),
            albedo: [0, 8, 16].map(|shift| voxel.albedo >> shift & 0xff),
            coverage: voxel.albedo >> 24,
        };
        assert_eq!(*found, Some(expected));
    }
}

/// Cell numbers have 32 bits; a node far away must not wrap them.
#[test]
fn a_scene_too_wide_for_its_span_is_refused() {
    let mut scene = cube_scene(Trs::default());
    scene.name = "far".to_owned();
    let far = Trs { translation: DVec3::X * 1e30, ..Trs::default() };
    scene.nodes.push(Node { mesh: Some(0), ..node(None, far) });
    let discretization = Discretization { grid: 64, span: Some(1.0), ..Discretization::default() };
    let error = prepare(Arc::new(scene), &discretization, None, &Progress::default()).expect_err("refused");
    assert_eq!(
        error.to_string(),
        "far: at a span of 1 it is 1.000e30 cells wide, and 1073741824 is the limit; choose a larger span"
    );
}
