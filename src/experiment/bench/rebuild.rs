//! Every kernel of a whole rebuild, and of a picture of it.

use crate::engine::PassTiming;
use crate::experiment::ExperimentError;
use crate::experiment::board::{Findings, Share};
use crate::experiment::cost::Samples;
use crate::experiment::frames::{Forget, Frames};
use crate::experiment::lab::{Lab, PICTURE_PX};
use crate::experiment::rows::KernelReport;
use crate::spread::Spread;

/// Folder of the kernels that draw; the others rebuild.
const VIEW_KERNELS: &str = "view/";

#[derive(Default)]
struct Rebuilds {
    /// In flow order.
    kernels: Vec<(String, Samples)>,
    all: Samples,
    wall_ms: Vec<f64>,
}

pub async fn measure(
    lab: &mut Lab,
    report: &Findings<KernelReport>,
    (share, bytes_per_ms): (Share, f64),
) -> Result<(), ExperimentError> {
    let mut rebuilds = Rebuilds::default();
    let settings = lab.settings.clone();
    let frames = Frames {
        what: "rebuilding",
        settings: &settings,
        size_px: PICTURE_PX,
        forget: Forget::Everything,
        warmup: lab.warmup,
        runs: lab.runs,
    };
    lab.measure(frames, share, |engine, wall_ms| rebuilds.add(engine.timings(), wall_ms)).await?;
    let nothing = || ExperimentError::NoTimes(lab.prepared.scene.name.clone());
    let mut report = report.borrow_mut();
    report.rebuild = Some(rebuilds.all.cost("rebuild".to_owned(), bytes_per_ms).ok_or_else(nothing)?);
    report.kernels =
        rebuilds.kernels.into_iter().filter_map(|(kernel, samples)| samples.cost(kernel, bytes_per_ms)).collect();
    report.frame_wall = Some(Spread::of(&rebuilds.wall_ms).ok_or_else(nothing)?);
    Ok(())
}

impl Rebuilds {
    /// Adds the dispatches of one rebuild up, by kernel and over all that do not draw.
    fn add(&mut self, timings: &[PassTiming], wall_ms: f64) {
        self.wall_ms.push(wall_ms);
        let timings = || timings.iter().map(|timing| &timing.kernel);
        let mut names: Vec<&str> = Vec::new();
        timings().map(|timing| timing.kernel.as_str()).for_each(|name| {
            if !names.contains(&name) {
                names.push(name);
            }
        });
        for name in names {
            let place = self.kernels.iter().position(|(kernel, _)| kernel == name).unwrap_or_else(|| {
                self.kernels.push((name.to_owned(), Samples::default()));
                self.kernels.len() - 1
            });
            self.kernels[place].1.add(timings().filter(|timing| timing.kernel == name));
        }
        self.all.add(timings().filter(|timing| !timing.kernel.starts_with(VIEW_KERNELS)));
    }
}
