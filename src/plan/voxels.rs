//! Rules of the passes that move voxels, build the octree and show it.

use super::light::store_skipped;
use super::surfaces::{ConesAsked, marches_shadows};
use super::{Changes, FramePlan, Pass, SceneFacts, Verdict, unless};
use crate::settings::{ColorBy, Filter, Settings, View};

/// The rows up to the averaged octree and its numbers; whether it is built again.
pub(super) fn build(plan: &mut FramePlan, scene: &SceneFacts, changed: &Changes, settings: &Settings) -> bool {
    let wanted = octree_wanted(scene, settings);
    let moved = changed.caches || changed.residents || changed.rigid_poses || changed.skinned_poses;
    let rebuilt = wanted.is_none() && (moved || changed.octree);
    plan.push(Pass::UploadCaches, unless(wanted, changed.caches, "new caches", "caches unchanged"));
    let entered = changed.caches || changed.residents;
    plan.push(Pass::ObjectIo, unless(wanted, entered, "objects entered or left the grid", "same objects in the grid"));
    plan.push(Pass::TransformRigid, transform_rigid(scene, changed, wanted));
    plan.push(Pass::TransformSkinned, transform_skinned(scene, changed, wanted));
    for pass in [Pass::MarkLeaves, Pass::ReduceMasks, Pass::ScanBlocks, Pass::EmitNodes, Pass::SortVoxels] {
        plan.push(pass, build_pass(wanted, moved, rebuilt));
    }
    plan.push(Pass::GatherNearest, gather(Filter::Nearest, settings, wanted, moved, rebuilt));
    plan.push(Pass::GatherSplit, gather(Filter::Split, settings, wanted, moved, rebuilt));
    plan.push(Pass::AverageNodes, build_pass(wanted, moved, rebuilt));
    plan.push(Pass::NumberObjects, number_objects(changed, settings, wanted, rebuilt));
    rebuilt
}

/// The rows behind the light.
pub(super) fn views(
    plan: &mut FramePlan,
    scene: &SceneFacts,
    changed: &Changes,
    settings: &Settings,
    (rebuilt, relit): (bool, bool),
) {
    let wanted = octree_wanted(scene, settings);
    let redraw = changed.view || rebuilt;
    let shows_light = settings.look.view == View::Voxels && settings.look.color.is_light();
    let unlit = store_skipped(scene, settings);
    let as_light = (shows_light && unlit.is_none()).then_some("light is shown");
    plan.push(Pass::MarchVoxels, view(View::Voxels, settings, wanted.or(as_light), redraw));
    let no_light = wanted.or((!shows_light).then_some("colour is not by light")).or(unlit);
    plan.push(Pass::MarchLight, unless(no_light, redraw || relit, "light or camera changed", "nothing changed"));
    plan.push(Pass::SliceOctree, view(View::Slice, settings, wanted, redraw || relit));
    plan.push(Pass::ShowShadowMap, show_shadow_map(plan, scene, changed, settings));
    plan.push(Pass::DrawMesh, draw_mesh(scene, changed, settings));
    plan.push(Pass::ReduceExact, reduce_exact(changed, settings, wanted));
    plan.push(Pass::MarchGhost, ghost(changed, settings, wanted, redraw));
    plan.push(Pass::BuildOther, build_other(changed, settings, wanted, rebuilt));
    plan.push(Pass::CompareExact, compare_exact(changed, settings, wanted, rebuilt));
}

fn show_shadow_map(plan: &FramePlan, scene: &SceneFacts, changed: &Changes, settings: &Settings) -> Verdict {
    let skip = (settings.look.view != View::ShadowMap)
        .then_some("another view is shown")
        .or((scene.lights == 0).then_some("no light in the scene"))
        .or((scene.triangles == 0).then_some("no triangles"));
    unless(skip, changed.view || plan.runs(Pass::DrawShadows), "shadow map or look changed", "nothing changed")
}

/// Why no octree is called for, if so.
pub(super) fn octree_wanted(scene: &SceneFacts, settings: &Settings) -> Option<&'static str> {
    if scene.voxels() == 0 {
        Some("no voxels in the grid")
    } else if settings.look.view == View::Mesh && !settings.look.accuracy {
        Some("the mesh view shows no voxels")
    } else if settings.look.view == View::ShadowMap && !settings.look.accuracy {
        Some("the shadow map shows no voxels")
    } else if settings.look.view == View::Surfaces && !settings.look.accuracy && !reads_octree(scene, settings) {
        Some("no cone and no shadow asks the octree")
    } else {
        None
    }
}

fn reads_octree(scene: &SceneFacts, settings: &Settings) -> bool {
    ConesAsked::new(scene, settings).any() || marches_shadows(scene, settings)
}

fn transform_rigid(scene: &SceneFacts, changed: &Changes, wanted: Option<&'static str>) -> Verdict {
    let skip = wanted.or((scene.rigid_voxels == 0).then_some("no rigid object in the grid"));
    if changed.caches || changed.residents {
        return unless(skip, true, "new voxels in the pages", "");
    }
    unless(skip, changed.rigid_poses, "rigid motion", "no rigid object moved")
}

fn transform_skinned(scene: &SceneFacts, changed: &Changes, wanted: Option<&'static str>) -> Verdict {
    let skip = wanted.or((scene.skinned_voxels == 0).then_some("no skin in the grid"));
    if changed.caches || changed.residents {
        return unless(skip, true, "new voxels in the pages", "");
    }
    unless(skip, changed.skinned_poses, "skinned motion", "pose unchanged")
}

fn build_pass(wanted: Option<&'static str>, moved: bool, rebuilt: bool) -> Verdict {
    unless(wanted, rebuilt, if moved { "voxels moved" } else { "filter or dense level changed" }, "voxels unchanged")
}

fn gather(filter: Filter, settings: &Settings, wanted: Option<&'static str>, moved: bool, rebuilt: bool) -> Verdict {
    let other = match filter {
        Filter::Nearest => "the filter is split",
        Filter::Split => "the filter is nearest",
    };
    build_pass(wanted.or((settings.discretization.filter != filter).then_some(other)), moved, rebuilt)
}

fn number_objects(changed: &Changes, settings: &Settings, wanted: Option<&'static str>, rebuilt: bool) -> Verdict {
    let looked_at = settings.look.view == View::Voxels && settings.look.color == ColorBy::Object;
    let skip = wanted.or((!looked_at).then_some("colour is not by object"));
    unless(skip, rebuilt || changed.object_numbers, "colour by object", "voxels unchanged")
}

fn build_other(changed: &Changes, settings: &Settings, wanted: Option<&'static str>, rebuilt: bool) -> Verdict {
    let skip = wanted.or((!settings.look.accuracy).then_some("accuracy is not looked at"));
    unless(skip, rebuilt || changed.other_octree, "the other filter, same pose", "voxels unchanged")
}

fn compare_exact(changed: &Changes, settings: &Settings, wanted: Option<&'static str>, rebuilt: bool) -> Verdict {
    let skip = wanted
        .or((!settings.look.accuracy).then_some("accuracy is not looked at"))
        .or((!changed.exact_known).then_some("the exact voxels of this pose are not made yet"));
    unless(skip, rebuilt || changed.exact, "voxels or exact set changed", "both sets unchanged")
}

/// Why no ghost is drawn, if so.
fn ghost_skipped(changed: &Changes, settings: &Settings, wanted: Option<&'static str>) -> Option<&'static str> {
    wanted
        .or((settings.look.view != View::Ghost).then_some("another view is shown"))
        .or((!changed.exact_known).then_some("the exact voxels of this pose are not made yet"))
}

fn reduce_exact(changed: &Changes, settings: &Settings, wanted: Option<&'static str>) -> Verdict {
    let skip = ghost_skipped(changed, settings, wanted);
    unless(skip, changed.exact_masks, "new exact voxels", "exact voxels unchanged")
}

fn ghost(changed: &Changes, settings: &Settings, wanted: Option<&'static str>, redraw: bool) -> Verdict {
    let skip = ghost_skipped(changed, settings, wanted);
    unless(skip, redraw || changed.exact_masks, "voxels, exact set or camera changed", "nothing changed")
}

fn view(which: View, settings: &Settings, wanted: Option<&'static str>, redraw: bool) -> Verdict {
    let skip = wanted.or((settings.look.view != which).then_some("another view is shown"));
    unless(skip, redraw, "voxels or camera changed", "nothing changed")
}

fn draw_mesh(scene: &SceneFacts, changed: &Changes, settings: &Settings) -> Verdict {
    let skip = (scene.triangles == 0)
        .then_some("no triangles")
        .or((settings.look.view != View::Mesh).then_some("another view is shown"));
    unless(skip, changed.view, "pose or camera changed", "nothing changed")
}
