//! What runs, what is reused and what is skipped, and the reason each row gives.

use octolume::plan::{Asked, Held, Part, Pass, SceneFacts, State, plan};
use octolume::settings::{ColorBy, Filter, Settings, SliceValue, View};

use super::{BUILD, RIGID, changed, first, other, reason, running, with};

const SKINNED: SceneFacts = SceneFacts { rigid_voxels: 0, skinned_voxels: 100, ..RIGID };

/// Reports, the exposure and the node under the cursor are read from parts that the picture itself no longer needs.
#[test]
fn what_is_told_of_a_frame_is_made_again_where_it_was_dropped() {
    let mut slice = Settings::default();
    (slice.method.look.view, slice.method.look.slice.value) = (View::Slice, SliceValue::Radiance);
    let mut surfaces = Settings::default();
    surfaces.method.look.view = View::Surfaces;
    let voxels = [Part::Masks, Part::Topology, Part::Payload];
    let lit = [Part::ComposedLight, Part::Exposure, Part::GlossyTiles];
    let scene = SceneFacts { lights: 1, glossy: true, ..RIGID };
    for (settings, told) in [(&slice, [&voxels[..], &[Part::Light]].concat()), (&surfaces, [voxels, lit].concat())] {
        let asked = [Asked::new(scene, settings.clone())];
        let all = plan(&asked, &Held::default());
        for part in told {
            let mut held = Held::default();
            let kept = all.to_run().iter().filter(|planned| planned.part != part);
            kept.for_each(|planned| held.hold(planned.part, planned.key.clone()));
            let made: Vec<Part> = plan(&asked, &held).to_run().iter().map(|planned| planned.part).collect();
            assert_eq!(made, [part], "{:?}", settings.method.look.view);
        }
    }
}

#[test]
fn every_pass_has_one_row_with_a_reason() {
    let plan = first(&RIGID, &Settings::default());
    assert_eq!(plan.rows.iter().map(|row| row.pass).collect::<Vec<_>>(), Pass::ALL);
    assert!(plan.rows.iter().all(|row| !row.reason.is_empty()));
}

#[test]
fn passes_and_parts_are_numbered_as_they_are_listed_and_every_part_has_a_pass() {
    assert!(Pass::ALL.into_iter().enumerate().all(|(number, pass)| pass as usize == number));
    assert!(Part::ALL.into_iter().enumerate().all(|(number, part)| part as usize == number));
    let made = |part: &Part| Pass::ALL.into_iter().any(|pass| pass.parts().contains(part));
    assert!(Part::ALL.iter().all(made));
}

#[test]
fn the_first_frame_runs_what_the_scene_has() {
    let rigid = first(&RIGID, &Settings::default());
    let expected =
        [&[Pass::UploadCaches, Pass::ObjectIo, Pass::TransformRigid, Pass::MarchVoxels], &BUILD[..]].concat();
    assert_eq!(running(&rigid), with(&expected));
    assert_eq!(reason(&rigid, Pass::TransformSkinned), (State::Skip, "no skin in the grid"));
    assert_eq!(reason(&rigid, Pass::MarkLeaves), (State::Run, "made for the first time"));
    let skinned = first(&SKINNED, &Settings::default());
    assert!(skinned.runs(Pass::TransformSkinned) && !skinned.runs(Pass::TransformRigid));
}

#[test]
fn nothing_changed_runs_nothing() {
    for facts in [RIGID, SKINNED, SceneFacts::default()] {
        assert!(changed(&facts, &Settings::default(), |_| {}).is_idle());
    }
}

#[test]
fn a_moved_camera_runs_the_view_alone() {
    let plan = changed(&RIGID, &Settings::default(), |asked| asked.contents.camera = other());
    assert_eq!(running(&plan), [Pass::MarchVoxels]);
    assert_eq!(reason(&plan, Pass::MarchVoxels), (State::Run, "the camera moved"));
    assert_eq!(reason(&plan, Pass::TransformRigid), (State::Reuse, "no rigid object moved"));
}

#[test]
fn a_pose_rebuilds_without_new_caches_and_every_row_names_what_differs() {
    let plan = changed(&SKINNED, &Settings::default(), |asked| asked.contents.skinned = other());
    let expected = [&[Pass::TransformSkinned, Pass::MarchVoxels], &BUILD[..]].concat();
    assert_eq!(running(&plan), with(&expected));
    for pass in expected {
        assert_eq!(reason(&plan, pass), (State::Run, "skinned motion"), "{pass:?}");
    }
}

#[test]
fn another_filter_moves_nothing() {
    let nearest = |asked: &mut Asked| asked.settings.method.discretization.filter = Filter::Nearest;
    let plan = changed(&RIGID, &Settings::default(), nearest);
    assert_eq!(reason(&plan, Pass::TransformRigid).0, State::Reuse);
    assert_eq!(reason(&plan, Pass::GatherSplit), (State::Skip, "the filter is nearest"));
    assert_eq!(reason(&plan, Pass::MarkLeaves), (State::Run, "another filter"));
    assert!(plan.runs(Pass::GatherNearest));
}

#[test]
fn an_empty_grid_runs_nothing() {
    let plan = first(&SceneFacts::default(), &Settings::default());
    assert!(plan.is_idle());
    assert_eq!(reason(&plan, Pass::MarkLeaves), (State::Skip, "no voxels in the grid"));
}

#[test]
fn the_mesh_view_builds_no_octree() {
    let mut settings = Settings::default();
    settings.method.look.view = View::Mesh;
    assert_eq!(running(&first(&RIGID, &settings)), [Pass::DrawMesh]);
    settings.method.look.accuracy = true;
    assert!(first(&RIGID, &settings).runs(Pass::GatherSplit));
}

#[test]
fn objects_are_numbered_only_when_looked_at() {
    let settings = Settings::default();
    assert_eq!(reason(&first(&RIGID, &settings), Pass::NumberObjects).0, State::Skip);
    let plan = changed(&RIGID, &settings, |asked| asked.settings.method.look.color = ColorBy::Object);
    assert_eq!(running(&plan), [Pass::NumberObjects, Pass::MarchVoxels]);
}

/// Stretching objects are voxelized and all others moved; what does not change of the two is kept.
#[test]
fn what_stretches_is_voxelized_beside_what_moves() {
    let settings = Settings::default();
    let mixed = SceneFacts { voxelized: 50, ..RIGID };
    let plan = first(&mixed, &settings);
    for pass in [Pass::TransformRigid, Pass::VoxelizeTriangles, Pass::JoinVoxels, Pass::MarkLeaves] {
        assert!(plan.runs(pass), "{pass:?}");
    }
    let moved = changed(&mixed, &settings, |asked| asked.contents.rigid = other());
    assert!(moved.runs(Pass::TransformRigid) && moved.runs(Pass::JoinVoxels) && !moved.runs(Pass::VoxelizeTriangles));
    let stretched = changed(&mixed, &settings, |asked| asked.contents.voxelized = other());
    assert!(stretched.runs(Pass::VoxelizeTriangles) && !stretched.runs(Pass::TransformRigid));
    let alone = first(&SceneFacts { rigid_voxels: 0, ..mixed }, &settings);
    assert!(alone.runs(Pass::VoxelizeTriangles) && !alone.runs(Pass::JoinVoxels) && !alone.runs(Pass::ObjectIo));
    assert!(!first(&RIGID, &settings).runs(Pass::JoinVoxels));
}
