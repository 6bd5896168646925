//! The list of passes of a frame, and why: one pure function from facts to rows, so that the panel,
//! `octolume plan` and the engine can never disagree. Static scenes, and what nobody looks at, cost
//! nothing.

use serde::Serialize;

use crate::settings::{ColorBy, Filter, Settings, View};

/// What a scene holds, as far as a frame's plan depends on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct SceneFacts {
    /// Voxels of static and rigid objects inside the grid.
    pub rigid_voxels: u64,
    /// Voxels of skinned objects inside the grid.
    pub skinned_voxels: u64,
    pub triangles: u64,
}

impl SceneFacts {
    pub fn voxels(&self) -> u64 {
        self.rigid_voxels + self.skinned_voxels
    }
}

/// What differs from the last frame that ran. True also where there was none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// Scene, grid, span or voxelization mode: other caches.
    pub caches: bool,
    /// The set of objects inside the grid.
    pub residents: bool,
    pub rigid_poses: bool,
    pub skinned_poses: bool,
    /// Filter or dense level: another octree from the same world voxels.
    pub octree: bool,
    /// The octree of the other filter is not of these voxels.
    pub other_octree: bool,
    /// The exact posed voxels differ from those last compared.
    pub exact: bool,
    /// The exact posed voxels differ from those whose masks are made.
    pub exact_masks: bool,
    /// There are exact voxels of this pose to compare with.
    pub exact_known: bool,
    /// Camera, picture size or anything of the look; in the mesh view, the pose too.
    pub view: bool,
    /// The octree's leaves have no object numbers yet.
    pub object_numbers: bool,
}

/// A pass, in the order of the frame. One row of the plan; one or more kernels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Pass {
    UploadCaches,
    ObjectIo,
    TransformRigid,
    TransformSkinned,
    MarkLeaves,
    ReduceMasks,
    ScanBlocks,
    EmitNodes,
    SortVoxels,
    GatherNearest,
    GatherSplit,
    AverageNodes,
    NumberObjects,
    MarchVoxels,
    DrawMesh,
    /// The masks above the exact leaves, by which rays skip empty space.
    ReduceExact,
    MarchGhost,
    /// The octree of the filter that is not shown, for the accuracy panel.
    BuildOther,
    CompareExact,
}

impl Pass {
    /// Every pass, in frame order.
    pub const ALL: [Self; 19] = [
        Self::UploadCaches,
        Self::ObjectIo,
        Self::TransformRigid,
        Self::TransformSkinned,
        Self::MarkLeaves,
        Self::ReduceMasks,
        Self::ScanBlocks,
        Self::EmitNodes,
        Self::SortVoxels,
        Self::GatherNearest,
        Self::GatherSplit,
        Self::AverageNodes,
        Self::NumberObjects,
        Self::MarchVoxels,
        Self::DrawMesh,
        Self::ReduceExact,
        Self::MarchGhost,
        Self::BuildOther,
        Self::CompareExact,
    ];

    /// The kernels a run of it dispatches; none for work of the CPU.
    pub fn kernels(self) -> &'static [&'static str] {
        match self {
            Self::UploadCaches | Self::ObjectIo => &[],
            Self::TransformRigid => &["transform/rigid"],
            Self::TransformSkinned => &["transform/skinned"],
            Self::MarkLeaves => &["build/mark"],
            Self::ReduceMasks | Self::ReduceExact => &["build/reduce"],
            Self::ScanBlocks => &["build/scan_sum", "build/scan_spread"],
            Self::EmitNodes => &["build/emit"],
            Self::SortVoxels => &["fill/count", "build/scan_sum", "build/scan_spread", "fill/place"],
            Self::GatherNearest | Self::GatherSplit => &["fill/gather", "fill/gather_heavy"],
            Self::AverageNodes => &["averaging/average"],
            Self::NumberObjects => &["fill/number_objects"],
            Self::BuildOther => &[
                "build/mark",
                "build/reduce",
                "build/scan_sum",
                "build/scan_spread",
                "build/emit",
                "fill/count",
                "fill/place",
                "fill/gather",
                "fill/gather_heavy",
                "averaging/average",
            ],
            Self::CompareExact => &["compare/compare_sets"],
            Self::MarchVoxels => &["view/march"],
            Self::DrawMesh => &["view/mesh"],
            Self::MarchGhost => &["view/ghost"],
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum State {
    Run,
    /// The last result still holds.
    Reuse,
    /// Nothing in the scene, or nobody looking, calls for it.
    Skip,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Row {
    pub pass: Pass,
    pub state: State,
    pub reason: &'static str,
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct FramePlan {
    pub rows: Vec<Row>,
}

impl FramePlan {
    pub fn runs(&self, pass: Pass) -> bool {
        self.rows.iter().any(|row| row.pass == pass && row.state == State::Run)
    }

    /// No row runs: no dispatch, no repaint.
    pub fn is_idle(&self) -> bool {
        self.rows.iter().all(|row| row.state != State::Run)
    }

    fn push(&mut self, pass: Pass, (state, reason): (State, &'static str)) {
        self.rows.push(Row { pass, state, reason });
    }
}

type Verdict = (State, &'static str);

/// Decides a frame. Pure: the same arguments give the same rows.
pub fn plan(scene: &SceneFacts, changed: &Changes, settings: &Settings) -> FramePlan {
    let mut plan = FramePlan::default();
    let wanted = octree_wanted(scene, settings);
    let moved = changed.caches || changed.residents || changed.rigid_poses || changed.skinned_poses;
    let rebuilt = wanted.is_none() && (moved || changed.octree);
    plan.push(Pass::UploadCaches, unless(wanted, changed.caches, "new caches", "caches unchanged"));
    let entered = changed.caches || changed.residents;
    plan.push(Pass::ObjectIo, unless(wanted, entered, "objects entered or left the grid", "same objects in the grid"));
    plan.push(Pass::TransformRigid, transform_rigid(scene, changed, wanted));
    plan.push(Pass::TransformSkinned, transform_skinned(scene, changed, wanted));
    for pass in [Pass::MarkLeaves, Pass::ReduceMasks, Pass::ScanBlocks, Pass::EmitNodes, Pass::SortVoxels] {
        plan.push(pass, build(wanted, moved, rebuilt));
    }
    plan.push(Pass::GatherNearest, gather(Filter::Nearest, settings, wanted, moved, rebuilt));
    plan.push(Pass::GatherSplit, gather(Filter::Split, settings, wanted, moved, rebuilt));
    plan.push(Pass::AverageNodes, build(wanted, moved, rebuilt));
    plan.push(Pass::NumberObjects, number_objects(changed, settings, wanted, rebuilt));
    let redraw = changed.view || rebuilt;
    plan.push(Pass::MarchVoxels, view(View::Voxels, settings, wanted, redraw));
    plan.push(Pass::DrawMesh, draw_mesh(scene, changed, settings));
    plan.push(Pass::ReduceExact, reduce_exact(changed, settings, wanted));
    plan.push(Pass::MarchGhost, ghost(changed, settings, wanted, redraw));
    plan.push(Pass::BuildOther, build_other(changed, settings, wanted, rebuilt));
    plan.push(Pass::CompareExact, compare_exact(changed, settings, wanted, rebuilt));
    plan
}

/// Why no octree is called for, if so.
fn octree_wanted(scene: &SceneFacts, settings: &Settings) -> Option<&'static str> {
    if scene.voxels() == 0 {
        Some("no voxels in the grid")
    } else if settings.look.view == View::Mesh && !settings.look.accuracy {
        Some("the mesh view shows no voxels")
    } else {
        None
    }
}

fn unless(skip: Option<&'static str>, run: bool, because: &'static str, otherwise: &'static str) -> Verdict {
    match skip {
        Some(reason) => (State::Skip, reason),
        None if run => (State::Run, because),
        None => (State::Reuse, otherwise),
    }
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

fn build(wanted: Option<&'static str>, moved: bool, rebuilt: bool) -> Verdict {
    unless(wanted, rebuilt, if moved { "voxels moved" } else { "filter or dense level changed" }, "voxels unchanged")
}

fn gather(filter: Filter, settings: &Settings, wanted: Option<&'static str>, moved: bool, rebuilt: bool) -> Verdict {
    let other = match filter {
        Filter::Nearest => "the filter is split",
        Filter::Split => "the filter is nearest",
    };
    build(wanted.or((settings.discretization.filter != filter).then_some(other)), moved, rebuilt)
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
