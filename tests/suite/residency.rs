//! Which parts of a posed scene are in the grid, and which cannot be moved at all.

use std::sync::Arc;

use glam::{DMat4, DQuat, DVec3};
use octolume::engine::Engine;
use octolume::prepare::{FrameMatrices, Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{Channel, Interpolation, LocalTransform, Node, Scene, Trs};
use octolume::settings::{Discretization, Hidden, MethodSettings, MotionSettings, Settings, VoxelAnchor};

use crate::device;
use crate::scenes::{at, clip, cube_scene, node, rotation, skinned_scene};

const SPAN: f64 = 0.06;

fn settings() -> Settings {
    let discretization = Discretization { grid: 64, span: Some(SPAN), ..Discretization::default() };
    Settings { method: MethodSettings { discretization, ..MethodSettings::default() }, ..Settings::default() }
}

fn prepared(scene: Scene) -> Prepared {
    prepare(Arc::new(scene), &settings().method.discretization, None, &Progress::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

fn folded(prepared: &Prepared) -> FrameMatrices {
    let motion = MotionSettings::default();
    let pose = prepared.pose(&motion).unwrap_or_else(|error| panic!("{error}"));
    prepared.fold((&motion, &pose), VoxelAnchor::Centre, &Hidden::default())
}

/// Two joints carry the cube far off to either side; half of each leaves it where it is.
#[test]
fn a_voxel_between_opposite_joints_is_in_the_grid_though_no_joint_alone_brings_it_there() {
    let weights = [0.5, 0.5, 0.0, 0.0];
    // Not farther: weights are 128 and 127 of 255, so what is left moves by 1/255 of this.
    let far = 150.0 * SPAN;
    let opposite = [at(-far, 0.0, 0.0), at(far, 0.0, 0.0)];
    let blended = prepared(skinned_scene([0, 1, 0, 0], weights, &opposite, &[DMat4::IDENTITY; 2]));
    assert!(folded(&blended).resident.iter().all(|resident| *resident));
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(Arc::new(blended)));
    engine.request(&settings(), [8, 8]).expect("a request");
    engine.run_to_end().expect("a frame");
    let report = engine.octree_report().expect("an octree");
    assert!(report.voxels > 0 && report.clipped_weight == 0, "{report:?}");

    let aside = [at(far, 0.0, 0.0), at(far, far, 0.0)];
    let mut outside = prepared(skinned_scene([0, 1, 0, 0], weights, &[Trs::default(); 2], &[DMat4::IDENTITY; 2]));
    let mut scene = (*outside.scene).clone();
    (1..).zip(aside).for_each(|(joint, trs): (usize, Trs)| scene.nodes[joint].local = LocalTransform::Trs(trs));
    outside.scene = Arc::new(scene);
    assert!(folded(&outside).resident.iter().all(|resident| !*resident), "both joints carry it off");
}

/// Cells that an f64 can count but an f32 cannot: 3.5e38 is infinite there.
#[test]
fn a_place_too_far_for_an_f32_is_left_out_and_named_and_the_rest_is_unharmed() {
    let mut scene = cube_scene(Trs::default());
    scene.nodes.push(Node { name: "comet".to_owned(), mesh: Some(0), ..node(None, Trs::default()) });
    let turns = [DQuat::IDENTITY, DQuat::from_rotation_x(1.0)];
    scene.clips.push(clip(vec![Channel { node: 1, ..rotation(Interpolation::Linear, &turns) }]));
    let at_home = prepared(scene.clone());
    for (cells, is_left_out) in [(3.5e38, true), (1e300, true), (3.0e38, false)] {
        scene.nodes[1].local = LocalTransform::Trs(Trs { translation: DVec3::Y * cells * SPAN, ..Trs::default() });
        // Prepared at home: the far one must not decide the grid, or nothing else would be in it.
        let mut far = prepared(at_home.scene.as_ref().clone());
        far.scene = Arc::new(scene.clone());
        let frame = folded(&far);
        assert_eq!(frame.left_out, if is_left_out { vec![1] } else { vec![] }, "{cells}");
        assert_eq!(frame.resident, [true, false], "{cells}");
        assert!(frame.matrices.iter().all(|matrix| matrix.rows.as_flattened().iter().all(|entry| entry.is_finite())));
        assert_eq!(frame.matrices[0], folded(&at_home).matrices[0], "{cells}");

        let mut engine = Engine::new(Arc::new(device::open()));
        engine.set_prepared(Some(Arc::new(far)));
        engine.request(&settings(), [8, 8]).expect("a request");
        let sentence = "object \"comet\" is left out: in this pose its matrix is not finite";
        assert_eq!(engine.left_out(), if is_left_out { vec![sentence] } else { vec![] }, "{cells}");
    }
}
