//! What a picture of lit surfaces costs is told in these pieces of work, everywhere.

use crate::engine::PassTiming;
use crate::plan::Pass;

/// In the order of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SurfaceWork {
    /// The surface image.
    Surfaces,
    /// What surfaces emit, and lights send to them.
    Direct,
    /// Diffuse cones.
    Diffuse,
    /// Diffuse cones shared among pixels, and brought to those of the picture.
    Filter,
    /// Specular cones, and where they are called for.
    Specular,
    /// All of it together, and its exposure.
    Compose,
}

impl SurfaceWork {
    pub const ALL: [Self; 6] =
        [Self::Surfaces, Self::Direct, Self::Diffuse, Self::Filter, Self::Specular, Self::Compose];
    /// What cones trace.
    pub const CONES: [Self; 3] = [Self::Diffuse, Self::Filter, Self::Specular];

    /// `None` for passes behind other views, and for those that build voxels and their light.
    pub fn of(pass: Pass) -> Option<Self> {
        match pass {
            Pass::DrawSurfaces => Some(Self::Surfaces),
            Pass::EmitSurfaces | Pass::LightSurfaces | Pass::LightByMarching => Some(Self::Direct),
            Pass::TraceDiffuse => Some(Self::Diffuse),
            Pass::BlurDiffuse | Pass::UpsampleDiffuse => Some(Self::Filter),
            Pass::ListGlossyTiles | Pass::TraceSpecular | Pass::UpsampleSpecular => Some(Self::Specular),
            Pass::ComposeSurfaces | Pass::MeasureExposure => Some(Self::Compose),
            _ => None,
        }
    }

    /// Whether nothing but surfaces dispatches a kernel.
    pub fn owns(kernel: &str) -> bool {
        let mut passes = Pass::ALL.into_iter().filter(|pass| pass.kernels().contains(&kernel)).peekable();
        passes.peek().is_some() && passes.all(|pass| Self::of(pass).is_some())
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Surfaces => "surfaces",
            Self::Direct => "direct",
            Self::Diffuse => "diffuse",
            Self::Filter => "filter",
            Self::Specular => "specular",
            Self::Compose => "compose",
        }
    }
}

/// Milliseconds of a frame's kernels, with the work they do; what surfaces do not call for is left out.
pub(super) fn kernels(timings: &[PassTiming]) -> impl Iterator<Item = ((SurfaceWork, String), f64)> {
    timings.iter().filter_map(|timing| {
        let work = SurfaceWork::of(timing.pass)?;
        Some(((work, timing.kernel.kernel.clone()), timing.kernel.ms))
    })
}

impl SurfaceWork {
    /// What these works took together.
    pub fn sum_ms(works: &[Self], timings: &[PassTiming]) -> f64 {
        let is_of = |timing: &&PassTiming| Self::of(timing.pass).is_some_and(|work| works.contains(&work));
        timings.iter().filter(is_of).map(|timing| timing.kernel.ms).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_of_surfaces_and_cones_are_theirs_alone() {
        for kernel in Pass::ALL.into_iter().flat_map(|pass| pass.kernels()) {
            let is_theirs = kernel.starts_with("surface/") || kernel.starts_with("cones/");
            assert_eq!(SurfaceWork::owns(kernel), is_theirs, "{kernel}");
        }
        assert!(!SurfaceWork::owns("no/such"));
    }
}
