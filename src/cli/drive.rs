//! Drives an experiment to its end: a bar on the terminal, its remarks to standard error, its pictures into a folder.

use std::path::Path;
use std::time::Duration;

use octolume::experiment::{Experiment, Remark, Report, State};
use octolume::export;

use super::output;

/// Below the two seconds after which drivers give a GPU up; nobody looks at a picture meanwhile.
const SLICE: Duration = Duration::from_millis(200);

/// `folder`: where pictures go, as .png.
pub fn drive(mut experiment: Experiment, folder: Option<&Path>) -> anyhow::Result<Report> {
    let bar = output::bar("");
    loop {
        let advanced = experiment.advance(SLICE);
        for remark in experiment.take_remarks() {
            bar.suspend(|| match remark {
                Remark::Warning(sentence) => output::warnings([&sentence]),
                Remark::Missing(sentence) => output::message(&sentence),
            });
        }
        for picture in experiment.take_pictures() {
            let Some(folder) = folder else { continue };
            export::write_png(&folder.join(picture.name + ".png"), &picture.picture, &picture.settings)?;
        }
        if advanced? != State::Working {
            bar.finish_and_clear();
            return Ok(experiment.report());
        }
        bar.set_message(experiment.doing());
        bar.set_position((experiment.fraction() * 100.0) as u64);
        experiment.wait()?;
    }
}
