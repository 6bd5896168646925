//! Samples the lit octree at given places, as cones and slices do.

use super::super::parts::cones::sampled;
use super::super::{Engine, EngineError};
use super::missing;
use crate::gpu::{GpuBuffer, Job, KernelTiming, Recorder};
use crate::plan::Part;
use crate::stages::sample::Sampler;
use crate::stages::sample::sample_points::{self, PointParams};

impl Engine {
    /// Radiance times α, and α, at points of (position in cells, level; width in cells where the sampler
    /// is quadrilinear), seen along `direction`; and what the kernel took. The octree must hold the light
    /// that the sampler reads and the pointers that it follows. Blocks until the samples are here.
    pub fn sample(
        &self,
        sampler: &Sampler,
        direction: [f32; 3],
        points: &[[f32; 4]],
    ) -> Result<(Vec<[f32; 4]>, Vec<KernelTiming>), EngineError> {
        let (job, buffer) = self.sampling(sampler, direction, points)?;
        let timings = job.run_to_end(&self.gpu)?;
        Ok((self.gpu.read(&buffer, 0..buffer.bytes())?, timings))
    }

    /// The same for who does not wait: the job that puts the samples into this buffer.
    pub fn sampling(
        &self,
        sampler: &Sampler,
        direction: [f32; 3],
        points: &[[f32; 4]],
    ) -> Result<(Job, GpuBuffer), EngineError> {
        let shown = self.shown.as_ref().ok_or_else(|| missing("light"))?;
        let making = self.making(shown, Part::Light).ok_or_else(|| missing("light"))?;
        let octree = sampled(&making, &self.parts, sampler.lookup)?;
        let buffer = self.gpu.upload("sample points", points)?;
        let params = PointParams::new(direction);
        let mut frame = Recorder::default();
        sample_points::record(&self.gpu, &mut frame, &octree, (sampler, &params), &buffer, points.len() as u64);
        Ok((Job::new(frame), buffer))
    }
}
