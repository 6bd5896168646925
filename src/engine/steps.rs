//! The steps of a frame: what a plan's rows become, in order.

use std::collections::VecDeque;

use crate::plan::{FramePlan, Pass};

/// Which of the two octrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    Shown,
    Other,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    UploadCaches,
    Move,
    Masks(Which),
    /// Brings the sizes back before anything is stored.
    Sizes(Which),
    Nodes(Which),
    /// Brings the root back.
    Root(Which),
    NumberObjects,
    ReduceExact,
    UploadMesh,
    Picture,
    Compare(Which),
    /// Brings holes and spill back.
    Counts(Which),
}

/// The steps of a plan, in order.
pub fn of_plan(plan: &FramePlan) -> VecDeque<Step> {
    let build = |which| [Step::Masks(which), Step::Sizes(which), Step::Nodes(which), Step::Root(which)];
    let mut steps = VecDeque::new();
    if plan.runs(Pass::UploadCaches) {
        steps.push_back(Step::UploadCaches);
    }
    if plan.runs(Pass::ObjectIo) || plan.runs(Pass::TransformRigid) || plan.runs(Pass::TransformSkinned) {
        steps.push_back(Step::Move);
    }
    if plan.runs(Pass::MarkLeaves) {
        steps.extend(build(Which::Shown));
    }
    if plan.runs(Pass::NumberObjects) {
        steps.push_back(Step::NumberObjects);
    }
    if plan.runs(Pass::ReduceExact) {
        steps.push_back(Step::ReduceExact);
    }
    if plan.runs(Pass::DrawMesh) {
        steps.push_back(Step::UploadMesh);
    }
    if [Pass::MarchVoxels, Pass::DrawMesh, Pass::MarchGhost].into_iter().any(|pass| plan.runs(pass)) {
        steps.push_back(Step::Picture);
    }
    if plan.runs(Pass::BuildOther) {
        steps.extend(build(Which::Other));
    }
    if plan.runs(Pass::CompareExact) {
        for which in [Which::Shown, Which::Other] {
            steps.extend([Step::Compare(which), Step::Counts(which)]);
        }
    }
    steps
}
