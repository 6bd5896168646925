//! What samples add up to: a sum a pixel for every term, and how far the mean may be off.
//!
//! ```text
//! pixel  light 5 x RGB | open | coverage | squares of each term's luminance 8    25 x f64, row-major
//! ```

use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use serde::Serialize;

use crate::color::luminance;
use crate::settings::{Lighting, SurfaceView};

/// A part of the light that reaches the eye, linear RGB, nits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Term {
    /// What is emitted towards the eye, and what lights send by way of one surface.
    Direct,
    /// By the diffuse lobe of what is seen: the sky, and surfaces that emit or that lights and sky light.
    DiffuseFirst,
    /// The same, and surfaces that other surfaces light, without end.
    DiffuseAll,
    /// As [`Self::DiffuseFirst`] by the specular lobe.
    SpecularFirst,
    SpecularAll,
    /// Share of the hemisphere without anything near, cosine-weighted, in all channels; 0 where nothing is.
    Ao,
    /// Direct, and the first bounce of both lobes.
    FinalFirst,
    /// Direct, and all bounces of both lobes.
    FinalAll,
}

impl Term {
    pub const ALL: [Self; 8] = [
        Self::Direct,
        Self::DiffuseFirst,
        Self::DiffuseAll,
        Self::SpecularFirst,
        Self::SpecularAll,
        Self::Ao,
        Self::FinalFirst,
        Self::FinalAll,
    ];

    /// What a view of surfaces shows where light goes on `bounces` times in the octree: the first bounce with
    /// none, all of them with any. `None` for what is no light of surfaces.
    pub fn of(part: SurfaceView, bounces: u32) -> Option<Self> {
        let is_first = bounces == 0;
        let either = |first, all| Some(if is_first { first } else { all });
        match part {
            SurfaceView::Final => either(Self::FinalFirst, Self::FinalAll),
            SurfaceView::Direct => Some(Self::Direct),
            SurfaceView::Diffuse => either(Self::DiffuseFirst, Self::DiffuseAll),
            SurfaceView::Specular => either(Self::SpecularFirst, Self::SpecularAll),
            SurfaceView::Ao => Some(Self::Ao),
            SurfaceView::Irradiance
            | SurfaceView::Albedo
            | SurfaceView::Normal
            | SurfaceView::Depth
            | SurfaceView::Roughness => None,
        }
    }
}

const LIGHTS: usize = 5;

/// One path.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sample {
    light: [DVec3; LIGHTS],
    pub open: f64,
    /// 1 where a surface is seen.
    coverage: f64,
}

impl Sample {
    /// Of a pixel where a surface is seen.
    pub fn of_surface() -> Self {
        Self { coverage: 1.0, ..Self::default() }
    }

    /// `term`: one that is light and no sum of others.
    pub fn add(&mut self, term: Term, nits: DVec3) {
        self.light[term as usize] += nits;
    }

    fn of(&self, term: Term) -> DVec3 {
        let sum = |parts: [Term; 3]| parts.into_iter().map(|part| self.light[part as usize]).sum();
        match term {
            Term::Ao => DVec3::splat(self.open),
            Term::FinalFirst => sum([Term::Direct, Term::DiffuseFirst, Term::SpecularFirst]),
            Term::FinalAll => sum([Term::Direct, Term::DiffuseAll, Term::SpecularAll]),
            _ => self.light[term as usize],
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct PixelSums {
    light: [[f64; 3]; LIGHTS],
    open: f64,
    coverage: f64,
    squares: [f64; Term::ALL.len()],
}

impl PixelSums {
    pub fn add(&mut self, sample: &Sample) {
        for (sum, light) in self.light.iter_mut().zip(sample.light) {
            *sum = (DVec3::from_array(*sum) + light).to_array();
        }
        self.open += sample.open;
        self.coverage += sample.coverage;
        for (sum, term) in self.squares.iter_mut().zip(Term::ALL) {
            *sum += luminance(sample.of(term).to_array()).powi(2);
        }
    }

    fn sum(&self, term: Term) -> DVec3 {
        let sums = Sample { light: self.light.map(DVec3::from_array), open: self.open, coverage: self.coverage };
        sums.of(term)
    }

    /// Variance of the mean of `samples` luminances, were they independent.
    fn variance(&self, term: Term, samples: f64) -> f64 {
        let mean = luminance(self.sum(term).to_array()) / samples;
        ((self.squares[term as usize] / samples - mean * mean) / (samples - 1.0).max(1.0)).max(0.0)
    }
}

/// Sums of a picture in the making.
#[derive(Clone, Debug)]
pub struct Film {
    size_px: [u32; 2],
    /// That its samples took.
    pub(super) secs: f64,
    /// By row: how many samples each of its pixels has.
    pub(super) samples: Vec<u32>,
    /// Row by row from the top.
    pub(super) pixels: Vec<PixelSums>,
}

/// Alike in every bit of the picture, however long it took.
impl PartialEq for Film {
    fn eq(&self, other: &Self) -> bool {
        (self.size_px, &self.samples, &self.pixels) == (other.size_px, &other.samples, &other.pixels)
    }
}

/// How far means are off, in the unit of the term.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct StandardError {
    /// Root mean square over the pixels, of luminance.
    pub rms: f64,
    /// The same over the picture's mean luminance; 0 where that is 0.
    pub relative: f64,
    /// Of the picture's mean luminance.
    pub of_mean: f64,
    /// The same over that mean.
    pub relative_of_mean: f64,
}

impl Film {
    pub fn new(size_px: [u32; 2]) -> Self {
        let [width, height] = size_px.map(|side| side as usize);
        let pixels = vec![PixelSums::default(); width * height];
        Self { size_px, secs: 0.0, samples: vec![0; height], pixels }
    }

    /// A picture that was kept; `None` where these are no sums of that many samples.
    pub fn from_pixels(size_px: [u32; 2], samples: u32, secs: f64, pixels: Vec<PixelSums>) -> Option<Self> {
        let [width, height] = size_px.map(|side| side as usize);
        let most = f64::from(samples);
        let is_sum = |sums: &PixelSums| {
            let values: &[f64] = bytemuck::cast_slice(std::slice::from_ref(sums));
            values.iter().all(|value| value.is_finite() && *value >= 0.0) && sums.open.max(sums.coverage) <= most
        };
        let fits = pixels.len() == width * height && pixels.iter().all(is_sum) && secs >= 0.0;
        fits.then(|| Self { size_px, secs, samples: vec![samples; height], pixels })
    }

    /// Rows from the top.
    pub fn pixels(&self) -> &[PixelSums] {
        &self.pixels
    }

    /// That its samples took, on as many threads as there were.
    pub fn secs(&self) -> f64 {
        self.secs
    }

    pub fn size_px(&self) -> [u32; 2] {
        self.size_px
    }

    /// Samples that every pixel has.
    pub fn samples(&self) -> u32 {
        self.samples.iter().min().copied().unwrap_or(0)
    }

    /// Means, linear RGB, rows from the top; black before the first sample.
    pub fn image(&self, term: Term) -> Vec<[f32; 3]> {
        let mean = |(sums, samples): (&PixelSums, f64)| (sums.sum(term) / samples.max(1.0)).as_vec3().to_array();
        self.counted().map(mean).collect()
    }

    /// What the view of surfaces shows under `lighting`, as the engine reads it: linear RGB and the share
    /// where a surface is; beside surfaces the sky, where that view shows it. `None`: see [`Term::of`].
    pub fn shown(&self, part: SurfaceView, lighting: &Lighting) -> Option<Vec<[f32; 4]>> {
        let term = Term::of(part, lighting.bounces)?;
        let shows_sky = matches!(part, SurfaceView::Final | SurfaceView::Direct);
        let sky_nits = DVec3::from_array(if shows_sky { lighting.sky_nits } else { [0.0; 3] });
        let pixel = |(sums, samples): (&PixelSums, f64)| {
            let coverage = sums.coverage / samples.max(1.0);
            let light = sums.sum(term) / samples.max(1.0) + sky_nits * (1.0 - coverage);
            light.extend(coverage).as_vec4().to_array()
        };
        Some(self.counted().map(pixel).collect())
    }

    /// Share of each pixel where a surface is seen.
    pub fn coverage(&self) -> Vec<f32> {
        self.counted().map(|(sums, samples)| (sums.coverage / samples.max(1.0)) as f32).collect()
    }

    /// Of the whole picture, were samples independent: evenly spread ones err less.
    pub fn standard_error(&self, term: Term) -> StandardError {
        let count = self.pixels.len().max(1) as f64;
        let variance: f64 = self.counted().map(|(sums, samples)| sums.variance(term, samples.max(1.0))).sum();
        let of_pixel = |(sums, samples): (&PixelSums, f64)| luminance(sums.sum(term).to_array()) / samples.max(1.0);
        let mean = self.counted().map(of_pixel).sum::<f64>() / count;
        let rms = (variance / count).sqrt();
        let of_mean = variance.sqrt() / count;
        let relative = |error: f64| if mean > 0.0 { error / mean } else { 0.0 };
        StandardError { rms, relative: relative(rms), of_mean, relative_of_mean: relative(of_mean) }
    }

    fn counted(&self) -> impl Iterator<Item = (&PixelSums, f64)> {
        let width = self.size_px[0] as usize;
        self.pixels.iter().enumerate().map(move |(index, sums)| (sums, f64::from(self.samples[index / width])))
    }
}
