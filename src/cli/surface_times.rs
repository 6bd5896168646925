//! What the kernels behind lit surfaces take, run by run.

use std::collections::BTreeMap;

use octolume::settings::Settings;

use super::session::Session;
use octolume::spread::Spread;

/// Milliseconds by kernel: of a run, or medians.
pub type KernelMs = BTreeMap<String, f64>;

/// Draws the surfaces anew in every run; those of the runs behind `warmup`, in order.
pub fn measure(
    session: &mut Session,
    settings: &Settings,
    size_px: [u32; 2],
    (warmup, runs): (u32, u32),
) -> anyhow::Result<Vec<KernelMs>> {
    let mut measured = Vec::new();
    for run in 0..warmup + runs {
        session.engine.invalidate_surfaces();
        session.run(settings, size_px)?;
        let mut of_run = KernelMs::new();
        for timing in session.kernel_times() {
            *of_run.entry(timing.kernel).or_default() += timing.ms;
        }
        measured.extend((run >= warmup).then_some(of_run));
    }
    Ok(measured)
}

/// By kernel, over the runs in which it ran.
pub fn medians(runs: &[KernelMs]) -> KernelMs {
    let mut times_ms: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for (kernel, ms) in runs.iter().flatten() {
        times_ms.entry(kernel).or_default().push(*ms);
    }
    times_ms.into_iter().filter_map(|(kernel, ms)| Some((kernel.to_owned(), Spread::of(&ms)?.median_ms))).collect()
}

/// Of the kernels whose names begin in one of these ways, together.
pub fn sum(kernels_ms: &KernelMs, starts: &[&str]) -> f64 {
    let belongs = |kernel: &str| starts.iter().any(|start| kernel.starts_with(start));
    // The sum of no numbers would be −0.
    kernels_ms.iter().filter(|(kernel, _)| belongs(kernel)).fold(0.0, |sum, (_, ms)| sum + ms)
}
