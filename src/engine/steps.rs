//! The steps of a frame: what a plan's rows become, in order.

use std::collections::VecDeque;

use super::surface_steps::SurfaceStep;
use crate::plan::{FramePlan, Pass};

/// Which of the two octrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    Shown,
    Other,
}

/// What a store of light holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stored {
    Radiance,
    Irradiance,
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
    LinkNodes,
    Emission,
    Shadows,
    /// Direct irradiance.
    Illuminate,
    /// What leaves the leaves, and its averages: of direct light alone, or with what was gathered.
    Inject {
        bounced: bool,
    },
    /// Cones towards the sky add to direct irradiance.
    GatherSky,
    /// Cones bring what leaves other leaves.
    GatherBounce,
    Irradiance,
    /// Brings the mean light of the scene back.
    LightRoot(Stored),
    Surface(SurfaceStep),
    ReduceExact,
    UploadMesh,
    Picture,
    Compare(Which),
    /// Brings holes and spill back.
    Counts(Which),
}

/// The steps of a plan, in order. `bounces`: how many the settings ask for.
pub fn of_plan(plan: &FramePlan, bounces: u32) -> VecDeque<Step> {
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
    if plan.runs(Pass::LinkNodes) {
        steps.push_back(Step::LinkNodes);
    }
    if plan.runs(Pass::GatherEmission) {
        steps.push_back(Step::Emission);
    }
    if plan.runs(Pass::DrawShadows) {
        steps.extend([Step::UploadMesh, Step::Shadows]);
    }
    steps.extend(light(plan, bounces));
    if plan.runs(Pass::DrawSurfaces) {
        steps.push_back(Step::UploadMesh);
    }
    steps.extend(SurfaceStep::of_plan(plan).map(Step::Surface));
    if plan.runs(Pass::ReduceExact) {
        steps.push_back(Step::ReduceExact);
    }
    if plan.runs(Pass::DrawMesh) {
        steps.push_back(Step::UploadMesh);
    }
    if PICTURES.into_iter().any(|pass| plan.runs(pass)) {
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

/// The passes that draw the picture, one of them a frame.
const PICTURES: [Pass; 7] = [
    Pass::ShowSurfaces,
    Pass::MarchVoxels,
    Pass::MarchLight,
    Pass::SliceOctree,
    Pass::ShowShadowMap,
    Pass::DrawMesh,
    Pass::MarchGhost,
];

/// From irradiance to averaged light. Sky and bounces sample what was injected before them, so that the
/// same number of bounces gives the same light whatever was there before.
fn light(plan: &FramePlan, bounces: u32) -> Vec<Step> {
    let mut steps = Vec::new();
    if plan.runs(Pass::InjectLight) {
        steps.extend([Step::Illuminate, Step::Inject { bounced: false }]);
        if plan.runs(Pass::GatherSky) {
            steps.extend([Step::GatherSky, Step::Inject { bounced: false }]);
        }
        if plan.runs(Pass::Bounces) {
            steps.extend((0..bounces).flat_map(|_| [Step::GatherBounce, Step::Inject { bounced: true }]));
        }
        steps.push(Step::LightRoot(Stored::Radiance));
    }
    if plan.runs(Pass::AverageIrradiance) {
        steps.extend([Step::Irradiance, Step::LightRoot(Stored::Irradiance)]);
    }
    steps
}
