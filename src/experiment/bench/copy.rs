//! How fast memory is: nothing that reads and writes it can be faster than a copy.

use wgpu::BufferUsages;

use crate::experiment::board::Share;
use crate::experiment::cost::Samples;
use crate::experiment::lab::Lab;
use crate::experiment::{Cost, ExperimentError};
use crate::gpu::{Gpu, GpuBuffer, Job, Recorder};
use crate::spread::Spread;

const NAME: &str = "bench/copy";
/// What is copied: more than caches hold, within wgpu's default limits.
const BYTES: u64 = 128 << 20;
/// What a thread copies.
const BYTES_A_THREAD: u64 = 16;

/// Copies the first `bytes`, a multiple of 16.
pub fn record(gpu: &Gpu, frame: &mut Recorder, original: &GpuBuffer, duplicate: &GpuBuffer, bytes: u64) {
    frame
        .pass(&gpu.kernel("bench/copy.wgsl", &[]))
        .bind("original", original)
        .bind("duplicate", duplicate)
        .bytes_moved(2 * bytes)
        .dispatch(bytes / BYTES_A_THREAD);
}

pub(super) async fn measure(lab: &Lab, share: Share) -> Result<Cost, ExperimentError> {
    let gpu = lab.engine.gpu();
    let bytes = BYTES.min(gpu.limits.max_storage_buffer_binding_size);
    let original = gpu.buffer("bench original", bytes, BufferUsages::empty())?;
    let duplicate = gpu.buffer("bench duplicate", bytes, BufferUsages::empty())?;
    let mut samples = Samples { ms: Vec::new(), bytes: 2 * bytes };
    let runs = lab.warmup + lab.runs;
    for run in 0..runs {
        lab.say(share.part(run as usize, runs as usize), format!("copying memory: {} of {runs}", run + 1));
        let mut recorder = Recorder::default();
        record(gpu, &mut recorder, &original, &duplicate, bytes);
        let timings = lab.run_job(Job::new(recorder)).await?;
        if run >= lab.warmup {
            samples.ms.push(timings.iter().map(|timing| timing.ms).sum());
        }
    }
    let no_times = || ExperimentError::NoTimes(NAME.to_owned());
    let spread = Spread::of(&samples.ms).ok_or_else(no_times)?;
    samples.cost(NAME.to_owned(), samples.bytes as f64 / spread.median_ms).ok_or_else(no_times)
}
