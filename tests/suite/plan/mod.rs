//! The plan, rule by rule without a GPU; then what the engine really did, counted against it.

mod consistent;
mod counted;
mod methods;
mod rules;

use octolume::digest::Digest;
use octolume::plan::{Asked, FramePlan, Held, Pass, SceneFacts, State, plan};
use octolume::settings::Settings;

pub use counted::Counted;

pub const RIGID: SceneFacts = SceneFacts {
    rigid_voxels: 100,
    skinned_voxels: 0,
    voxelized: 0,
    triangles: 12,
    lights: 0,
    emissive_voxels: 0,
    glossy: false,
    picture_px: [64, 48],
};

/// The plan of a first frame.
pub fn first(scene: &SceneFacts, settings: &Settings) -> FramePlan {
    plan(&[Asked::new(*scene, settings.clone())], &Held::default())
}

/// The plan of the frame behind one of `before`.
pub fn after(before: &Asked, now: &Asked) -> FramePlan {
    let mut held = Held::default();
    held.hold_all(&plan(std::slice::from_ref(before), &held));
    plan(std::slice::from_ref(now), &held)
}

/// The plan of a frame whose contents differ as told from the frame before.
pub fn changed(scene: &SceneFacts, settings: &Settings, change: impl FnOnce(&mut Asked)) -> FramePlan {
    let before = Asked::new(*scene, settings.clone());
    let mut now = before.clone();
    change(&mut now);
    after(&before, &now)
}

/// Another content than the one that every scene has at first.
pub fn other() -> Digest {
    Digest::of(&1)
}

const BUILD: [Pass; 8] = [
    Pass::MarkLeaves,
    Pass::ReduceMasks,
    Pass::ScanBlocks,
    Pass::CountNodes,
    Pass::EmitNodes,
    Pass::SortVoxels,
    Pass::GatherSplit,
    Pass::AverageNodes,
];

pub fn running(plan: &FramePlan) -> Vec<Pass> {
    Pass::ALL.into_iter().filter(|&pass| plan.runs(pass)).collect()
}

pub fn reason(plan: &FramePlan, pass: Pass) -> (State, &'static str) {
    let row = plan.rows.iter().find(|row| row.pass == pass).expect("every pass has a row");
    (row.state, row.reason)
}

fn with(passes: &[Pass]) -> Vec<Pass> {
    Pass::ALL.into_iter().filter(|pass| passes.contains(pass)).collect()
}
