//! `octolume [SCENE]`: the inspector's window.

use std::path::Path;

#[cfg(feature = "gui")]
use octolume::app::Start;

use super::options::{Common, Moment};

#[cfg(feature = "gui")]
pub fn run(scene: &Path, common: &Common, moment: &Moment) -> anyhow::Result<()> {
    let mut settings = common.settings()?;
    moment.apply(&mut settings);
    settings.check().map_err(super::usage::Usage)?;
    let (names, opening, disk) = (common.node_names(), common.open_options(), common.disk_cache());
    octolume::app::run(scene, Start { settings, names, opening, disk }, common.adapter.as_deref())
}

#[cfg(not(feature = "gui"))]
pub fn run(_scene: &Path, _common: &Common, _moment: &Moment) -> anyhow::Result<()> {
    Err(super::usage::Usage(
        "this build has no window; build it with the feature \"gui\", or use a subcommand".to_owned(),
    )
    .into())
}
