//! The steps behind the view of lit surfaces.

use super::cones::TracedBy;
use super::light::LitBy;
use super::run::Work;
use super::surfaces::SeenBy;
use super::{Engine, EngineError, Wanted};
use crate::gpu::KernelTiming;
use crate::plan::{FramePlan, Pass};
use crate::stages::surface::mean_luminance_ref;
use crate::stages::surface::sum_luminance::SUM_BYTES;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceStep {
    /// What the camera sees.
    Image,
    /// Direct light on it.
    Direct,
    Diffuse,
    FilterDiffuse,
    GlossyTiles,
    /// Brings back how many tiles are glossy.
    GlossyCount,
    Specular,
    FilterSpecular,
    /// What is shown of the surfaces.
    Compose,
    Luminance,
    /// Brings back how bright that is.
    MeanLuminance,
}

/// Kernel times of the view's parts, each kept until it runs again.
#[derive(Clone, Debug, Default)]
pub(super) struct SurfaceTimings {
    image: Vec<KernelTiming>,
    direct: Vec<KernelTiming>,
    diffuse: Vec<KernelTiming>,
    specular: Vec<KernelTiming>,
    composed: Vec<KernelTiming>,
}

impl SurfaceTimings {
    pub fn all(&self) -> impl Iterator<Item = &KernelTiming> {
        [&self.image, &self.direct, &self.diffuse, &self.specular, &self.composed].into_iter().flatten()
    }
}

impl SurfaceStep {
    /// From the surface image to what is shown of it.
    pub fn of_plan(plan: &FramePlan) -> impl Iterator<Item = Self> {
        const STEPS: [(&[Pass], &[SurfaceStep]); 9] = [
            (&[Pass::DrawSurfaces], &[SurfaceStep::Image]),
            (&[Pass::EmitSurfaces], &[SurfaceStep::Direct]),
            (&[Pass::TraceDiffuse], &[SurfaceStep::Diffuse]),
            (&[Pass::BlurDiffuse, Pass::UpsampleDiffuse], &[SurfaceStep::FilterDiffuse]),
            (&[Pass::ListGlossyTiles], &[SurfaceStep::GlossyTiles, SurfaceStep::GlossyCount]),
            (&[Pass::TraceSpecular], &[SurfaceStep::Specular]),
            (&[Pass::UpsampleSpecular], &[SurfaceStep::FilterSpecular]),
            (&[Pass::ComposeSurfaces], &[SurfaceStep::Compose]),
            (&[Pass::MeasureExposure], &[SurfaceStep::Luminance, SurfaceStep::MeanLuminance]),
        ];
        let runs = |passes: &[Pass]| passes.iter().any(|pass| plan.runs(*pass));
        STEPS.into_iter().filter(move |(passes, _)| runs(passes)).flat_map(|(_, steps)| steps.iter().copied())
    }
}

impl Engine {
    pub(super) fn start_surface_step(&mut self, step: SurfaceStep, wanted: &Wanted) -> Result<Work, EngineError> {
        let recorded = match step {
            SurfaceStep::Image => self.record_surface_image(wanted),
            SurfaceStep::Direct => self.record_direct(wanted),
            SurfaceStep::Diffuse => self.record_diffuse(wanted),
            SurfaceStep::FilterDiffuse => self.record_diffuse_filter(wanted),
            SurfaceStep::GlossyTiles => self.record_glossy_tiles(wanted),
            SurfaceStep::GlossyCount => return self.read_glossy_count(),
            SurfaceStep::Specular => self.record_specular(wanted),
            SurfaceStep::FilterSpecular => self.record_specular_filter(wanted),
            SurfaceStep::Compose => self.record_composed(wanted),
            SurfaceStep::Luminance => self.record_luminance(wanted),
            SurfaceStep::MeanLuminance => {
                return self.read(&self.surfaces.sums.made("sums of luminance")?, SUM_BYTES);
            }
        };
        Ok(Work::job(recorded?))
    }

    /// Bytes a step asked for have come.
    pub(super) fn surface_step_received(&mut self, step: SurfaceStep, bytes: &[u8]) {
        match step {
            SurfaceStep::GlossyCount => self.surfaces.glossy_count = bytemuck::pod_read_unaligned(bytes),
            SurfaceStep::MeanLuminance => {
                self.surfaces.mean_luminance = mean_luminance_ref::mean_luminance(&bytemuck::pod_collect_to_vec(bytes));
            }
            _ => {}
        }
    }

    /// Notes what now holds.
    pub(super) fn surface_step_finished(&mut self, step: SurfaceStep, wanted: &Wanted, took: Vec<KernelTiming>) {
        let timings = &mut self.timings.surfaces;
        match step {
            SurfaceStep::Image => {
                self.done.surfaces = Some(SeenBy::new(wanted));
                timings.image = took;
            }
            SurfaceStep::Direct => {
                self.done.direct = Some(LitBy::new(wanted));
                timings.direct = took;
            }
            SurfaceStep::Diffuse => {
                self.done.diffuse = Some(TracedBy::diffuse(wanted));
                timings.diffuse = took;
            }
            SurfaceStep::FilterDiffuse => timings.diffuse.extend(took),
            SurfaceStep::GlossyTiles => timings.specular = took,
            SurfaceStep::Specular => {
                self.done.specular = Some(TracedBy::specular(wanted));
                timings.specular.extend(took);
            }
            SurfaceStep::FilterSpecular => timings.specular.extend(took),
            SurfaceStep::Compose => timings.composed = took,
            SurfaceStep::Luminance => timings.composed.extend(took),
            SurfaceStep::GlossyCount | SurfaceStep::MeanLuminance => {}
        }
    }
}
