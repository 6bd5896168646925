//! Path tracing of one picture on threads of its own, one core left to the window. In: what is seen. Out: the
//! parts of the picture so far, published now and then, and at the end a film that can go on.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::seen::Seen;
use crate::accuracy::path_tracer::{Film, Options, PixelSampling, Reflection, Scene, Term};
use crate::app::background::{Background, Outcome};
use crate::color::luminance;
use crate::progress::Progress;
use crate::settings::{Lighting, SurfaceView};

/// Parts of the picture that paths tell apart, too.
pub const PARTS: [SurfaceView; 5] =
    [SurfaceView::Final, SurfaceView::Direct, SurfaceView::Diffuse, SurfaceView::Specular, SurfaceView::Ao];

/// Between pictures that are published, beside those of 1, 2, 4 … samples.
const PUBLISH_STEP: Duration = Duration::from_secs(4);

/// What paths have said so far.
#[derive(Debug)]
pub struct Traced {
    pub samples: u32,
    pub secs: f64,
    pub parts: Vec<TracedPart>,
}

#[derive(Debug)]
pub struct TracedPart {
    pub part: SurfaceView,
    /// Means, linear RGB, rows from the top.
    pub image: Vec<[f32; 3]>,
    /// Standard error of a pixel: root mean square over the picture, in parts of its mean luminance.
    pub relative_error: f64,
}

impl TracedPart {
    fn new(film: &Film, lighting: &Lighting, part: SurfaceView) -> Self {
        let mut image = vec![[0.0; 3]; film.size_px()[0] as usize * film.size_px()[1] as usize];
        let mut variance = 0.0;
        for term in terms(part, lighting.bounces) {
            add(&mut image, film.image(*term));
            // Each lobe has paths of its own.
            variance += film.standard_error(*term).rms.powi(2);
        }
        if matches!(part, SurfaceView::Final | SurfaceView::Direct) {
            let sky = lighting.sky_nits.map(|channel| channel as f32);
            let background = film.coverage().into_iter().map(|share| sky.map(|channel| (1.0 - share) * channel));
            add(&mut image, background);
        }
        let sum: f64 = image.iter().map(|pixel| luminance(pixel.map(f64::from))).sum();
        let relative_error = if sum > 0.0 { variance.sqrt() * image.len() as f64 / sum } else { 0.0 };
        Self { part, image, relative_error }
    }
}

fn add(image: &mut [[f32; 3]], more: impl IntoIterator<Item = [f32; 3]>) {
    for (pixel, more) in image.iter_mut().zip(more) {
        pixel.iter_mut().zip(more).for_each(|(channel, more)| *channel += more);
    }
}

/// What adds up to a part, as far as voxels of so many bounces hold light.
fn terms(part: SurfaceView, bounces: u32) -> &'static [Term] {
    match (part, bounces) {
        (SurfaceView::Final, 0) => &[Term::Direct, Term::DiffuseFirst, Term::SpecularFirst],
        (SurfaceView::Final, _) => &[Term::Final],
        (SurfaceView::Direct, _) => &[Term::Direct],
        (SurfaceView::Diffuse, 0) => &[Term::DiffuseFirst],
        (SurfaceView::Diffuse, _) => &[Term::DiffuseAll],
        (SurfaceView::Specular, 0) => &[Term::SpecularFirst],
        (SurfaceView::Specular, _) => &[Term::SpecularAll],
        (SurfaceView::Ao, _) => &[Term::Ao],
        _ => &[],
    }
}

impl Traced {
    fn new(film: &Film, lighting: &Lighting, secs: f64) -> Self {
        let parts = PARTS.into_iter().map(|part| TracedPart::new(film, lighting, part)).collect();
        Self { samples: film.samples(), secs, parts }
    }

    pub fn part(&self, part: SurfaceView) -> Option<&TracedPart> {
        self.parts.iter().find(|traced| traced.part == part)
    }
}

/// A film in the making, and the time it took.
pub struct Kept {
    film: Film,
    secs: f64,
}

type Published = Arc<Mutex<Option<Arc<Traced>>>>;

/// One run of the path tracer.
pub struct Tracing {
    work: Background<Result<Kept, String>>,
    published: Published,
}

impl Tracing {
    /// Up to `samples` a pixel, going on from what was kept of the same picture.
    pub fn start(ctx: &egui::Context, seen: Seen, kept: Option<Kept>, samples: u32) -> Self {
        let published = Published::default();
        let (slot, waker) = (Arc::clone(&published), ctx.clone());
        let publish = move |traced| {
            *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::new(traced));
            waker.request_repaint();
        };
        let work = Background::start(ctx, move |progress| trace(&seen, kept, samples, progress, &publish));
        Self { work, published }
    }

    /// What was published since the last call.
    pub fn take_published(&self) -> Option<Arc<Traced>> {
        self.published.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    pub fn poll(&self) -> Outcome<Result<Kept, String>> {
        self.work.poll()
    }

    /// It ends soon, and what it has is kept.
    pub fn stop(&self) {
        self.work.cancel();
    }

    /// Of this run, between 0 and 1.
    pub fn fraction(&self) -> f32 {
        self.work.fraction()
    }
}

fn trace(
    seen: &Seen,
    kept: Option<Kept>,
    samples: u32,
    progress: &Progress,
    publish: &(impl Fn(Traced) + Sync),
) -> Result<Kept, String> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads((cores - 1).max(1)).build();
    let pool = pool.map_err(|error| format!("no threads for the path tracer: {error}"))?;
    pool.install(|| {
        let started = Instant::now();
        let options = Options {
            size_px: seen.size_px,
            seed: 0,
            pixel: PixelSampling::default(),
            reflection: Reflection::default(),
        };
        let scene = Scene::new(&seen.prepared, &seen.settings, options).map_err(|error| error.to_string())?;
        let mut kept = kept.unwrap_or_else(|| Kept { film: scene.new_film(), secs: 0.0 });
        let before_secs = kept.secs;
        step(&scene, &mut kept.film, samples, progress, |film| {
            publish(Traced::new(film, &seen.settings.lighting, before_secs + started.elapsed().as_secs_f64()));
        });
        kept.secs = before_secs + started.elapsed().as_secs_f64();
        Ok(kept)
    })
}

/// Sample by sample until there are as many as asked for, or nobody waits any more.
fn step(scene: &Scene<'_>, film: &mut Film, samples: u32, progress: &Progress, publish: impl Fn(&Film)) {
    let missing = samples.saturating_sub(film.samples());
    progress.add_total(u64::from(missing) * u64::from(film.size_px()[1]));
    let mut last = Instant::now();
    while film.samples() < samples {
        if scene.step(film, progress).is_err() {
            break;
        }
        if film.samples().is_power_of_two() || last.elapsed() >= PUBLISH_STEP {
            publish(film);
            last = Instant::now();
        }
    }
    if film.samples() > 0 {
        publish(film);
    }
}
