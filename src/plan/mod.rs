//! The list of passes of a frame, and why: one pure function from facts to rows, so that the panel,
//! `octolume plan` and the engine can never disagree. Static scenes, and what nobody looks at, cost
//! nothing.

mod light;
mod pass;
mod surfaces;
mod voxels;

use serde::Serialize;

use crate::settings::Settings;

pub use light::only_opacity;
pub use pass::Pass;
pub use surfaces::ConesAsked;

/// What a scene holds, as far as a frame's plan depends on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct SceneFacts {
    /// Voxels of static and rigid objects inside the grid.
    pub rigid_voxels: u64,
    /// Voxels of skinned objects inside the grid.
    pub skinned_voxels: u64,
    pub triangles: u64,
    /// Lights that are on and not black.
    pub lights: u32,
    /// Voxels inside the grid of objects that emit.
    pub emissive_voxels: u64,
    /// Some surface may be smooth enough for a specular cone.
    pub glossy: bool,
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
    /// The octree has no neighbour pointers of the kind that is wanted.
    pub links: bool,
    /// The octree's leaves do not know yet what they emit.
    pub emission: bool,
    /// A light that has a shadow map moved, or what casts shadows did.
    pub shadow_maps: bool,
    /// Lights, sky or how light is computed.
    pub lighting: bool,
    /// The irradiance of inner nodes is not that of the leaves.
    pub irradiance: bool,
    /// The surface image is not of this camera, pose and picture size.
    pub surfaces: bool,
    /// Its direct light is not that of these lights.
    pub direct: bool,
    /// Diffuse cones, or specular ones, were not traced as is wanted.
    pub diffuse: bool,
    pub specular: bool,
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

    /// The voxels are drawn in the light that the octree holds.
    pub fn shows_light(&self) -> bool {
        self.rows.iter().any(|row| row.pass == Pass::MarchLight && row.state != State::Skip)
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
    let rebuilt = voxels::build(&mut plan, scene, changed, settings);
    let relit = light::light(&mut plan, scene, changed, settings, rebuilt);
    surfaces::surfaces(&mut plan, scene, changed, settings, (rebuilt, relit));
    voxels::views(&mut plan, scene, changed, settings, (rebuilt, relit));
    plan
}

fn unless(skip: Option<&'static str>, run: bool, because: &'static str, otherwise: &'static str) -> Verdict {
    match skip {
        Some(reason) => (State::Skip, reason),
        None if run => (State::Run, because),
        None => (State::Reuse, otherwise),
    }
}
