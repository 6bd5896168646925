//! `octolume plan`: the passes of a frame, and why each runs or does not.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use octolume::plan::{Pass, Row};
use octolume::settings::{ColorBy, MethodSettings, Settings, ShotSettings};
use serde::Serialize;

use super::look_options::LookOptions;
use super::options::{Common, Moment};
use super::output;
use super::session::{NO_PICTURE, Session};
use super::usage::Usage;
use super::voxelized::Voxelized;

/// Lists the passes of a frame, and why each runs, is reused or skipped
#[derive(Debug, Args)]
pub struct Plan {
    /// A .gltf or .glb file, or the name of a built-in scene
    scene: PathBuf,
    /// Prints JSON: a list of method, pass, state, reason
    #[arg(long)]
    json: bool,
    /// Plans the second frame after this change; otherwise the first
    #[arg(long, value_name = "CHANGE")]
    after: Option<Change>,
    #[command(flatten)]
    look: LookOptions,
    #[command(flatten)]
    moment: Moment,
    #[command(flatten)]
    common: Common,
}

#[derive(Serialize)]
struct PlanRow<'a> {
    #[serde(flatten)]
    row: &'a Row,
    /// What the voxelizer makes voxels of where other objects are moved.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    objects: &'a [Voxelized],
}

/// What differs in the second frame.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Change {
    /// Nothing
    Still,
    /// The camera moves
    Camera,
    /// The animation goes on by 1/30 s
    Time,
    /// The whole scene turns by a degree
    Turn,
    /// The other filter
    Filter,
    /// Another dense level
    DenseLevel,
    /// Colour by another property
    Color,
    /// Our sun and all that emits are half as bright
    Light,
}

impl Plan {
    pub fn run(&self) -> anyhow::Result<()> {
        let mut settings = self.common.settings()?;
        self.moment.apply(&mut settings);
        self.look.apply(&mut settings.method.look);
        settings.check().map_err(Usage)?;
        let mut session = Session::open(&self.scene, &self.common, &mut settings)?;
        session.engine.request(&settings, NO_PICTURE)?;
        if let Some(change) = self.after {
            session.engine.run_to_end()?;
            change.apply(&mut settings);
            session.engine.request(&settings, NO_PICTURE)?;
        }
        output::warnings(session.engine.left_out());
        let plan = session.engine.plan();
        let voxelized = Voxelized::list(&session);
        if self.json {
            let of = |pass: Pass| if pass == Pass::VoxelizeTriangles { &*voxelized } else { &[] };
            let rows = plan.rows.iter().map(|row| PlanRow { row, objects: of(row.pass) });
            return output::json(&rows.collect::<Vec<_>>());
        }
        let rows = plan.rows.iter().map(|row| {
            vec![row.method.to_string(), output::name_of(&row.pass), output::name_of(&row.state), row.reason.to_owned()]
        });
        let table = output::table(&["method", "pass", "state", "reason"], rows);
        let lines = [table].into_iter().chain(voxelized.iter().map(Voxelized::text));
        output::result(&lines.collect::<Vec<_>>().join("\n"))
    }
}

impl Change {
    fn apply(self, settings: &mut Settings) {
        let ShotSettings { motion, camera, .. } = &mut settings.shot;
        let MethodSettings { discretization, lighting, look, .. } = &mut settings.method;
        match self {
            Self::Still => {}
            Self::Camera => camera.get_or_insert_default().orbit(0.1, 0.0),
            Self::Time => motion.time_secs += 1.0 / 30.0,
            Self::Turn => motion.turn_degrees[1] += 1.0,
            Self::Filter => discretization.filter = discretization.filter.other(),
            Self::DenseLevel => {
                let level = discretization.deepest_dense();
                discretization.dense_level = Some(if level == 0 { 1 } else { level - 1 });
            }
            Self::Light => {
                lighting.emission *= 0.5;
                lighting.sun.illuminance_lux *= 0.5;
            }
            Self::Color => {
                let object = look.color == ColorBy::Object;
                look.color = if object { ColorBy::Albedo } else { ColorBy::Object };
            }
        }
    }
}
