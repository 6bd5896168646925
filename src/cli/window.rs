//! `octolume [SCENE]`: the inspector's window.

use std::path::Path;

#[cfg(feature = "gui")]
use octolume::app::{Host, Start};

use super::options::{Common, Moment};
#[cfg(feature = "gui")]
use super::output;

#[cfg(feature = "gui")]
pub fn run(scene: &Path, fresh: bool, common: &Common, moment: &Moment) -> anyhow::Result<()> {
    let mut settings = common.settings()?;
    moment.apply(&mut settings);
    settings.check().map_err(super::usage::Usage)?;
    let (names, opening, disk) = (common.node_names(), common.open_options(), common.disk_cache());
    let mut host = Host { tell_error: |error| output::message(&format!("error: {error}")), ..Host::desktop() };
    if fresh {
        host.remembered_in = None;
    }
    octolume::app::run(scene, Start { settings, names, opening, disk, host }, common.adapter.as_deref())
}

#[cfg(not(feature = "gui"))]
pub fn run(_scene: &Path, _fresh: bool, _common: &Common, _moment: &Moment) -> anyhow::Result<()> {
    Err(super::usage::Usage(
        "this build has no window; build it with the feature \"gui\", or use a subcommand".to_owned(),
    )
    .into())
}
