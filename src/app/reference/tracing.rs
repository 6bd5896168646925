//! Path tracing of one picture on threads of its own, one core left to the window. In: what is seen. Out: the
//! parts of the picture so far, published now and then, and at the end a film that can go on.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::seen::Seen;
use crate::accuracy::path_tracer::{Film, Options, PixelSampling, Reflection, Term, TracedScene};
use crate::accuracy::picture_error::LightPixel;
use crate::app::background::{Background, Outcome};
use crate::disk_cache::DiskCache;
use crate::progress::Progress;
use crate::settings::{Lighting, SurfaceView};

/// Parts of the picture that paths tell apart, too.
pub const PARTS: [SurfaceView; 5] =
    [SurfaceView::Final, SurfaceView::Direct, SurfaceView::Diffuse, SurfaceView::Specular, SurfaceView::Ao];

/// Between pictures that are published, beside those of 1, 2, 4 … samples.
const PUBLISH_STEP: Duration = Duration::from_secs(4);

/// What a run must have taken before it tells how long it will.
const LEAST_TIME: Duration = Duration::from_secs(1);

/// What paths have said so far.
pub struct Traced {
    pub samples: u32,
    pub secs: f64,
    pub parts: Vec<TracedPart>,
}

pub struct TracedPart {
    pub part: SurfaceView,
    /// Rows from the top.
    pub image: Vec<LightPixel>,
    /// Standard error of a pixel: root mean square over the picture, in parts of its mean luminance. One sample
    /// alone tells nothing of it.
    pub relative_error: Option<f64>,
}

impl Traced {
    fn new(film: &Film, lighting: &Lighting) -> Self {
        let part = |part| {
            let term = Term::of(part, lighting.bounces)?;
            let relative_error = (film.samples() > 1).then(|| film.standard_error(term).relative);
            Some(TracedPart { part, image: film.shown(part, lighting)?, relative_error })
        };
        let parts = PARTS.into_iter().filter_map(part).collect();
        Self { samples: film.samples(), secs: film.secs(), parts }
    }

    pub fn part(&self, part: SurfaceView) -> Option<&TracedPart> {
        self.parts.iter().find(|traced| traced.part == part)
    }
}

/// What a run goes on from, and where to.
pub struct Run {
    pub seen: Seen,
    /// Of the same picture.
    pub film: Option<Film>,
    /// A pixel, at the end.
    pub samples: u32,
    /// Where traced pictures are kept.
    pub disk: Option<DiskCache>,
}

/// What a run ends with.
pub struct Ended {
    pub film: Film,
    /// Why it could not be kept on disk.
    pub warning: Option<String>,
}

type Published = Arc<Mutex<Option<Arc<Traced>>>>;

/// A run on its threads.
pub struct Tracing {
    work: Background<Result<Ended, String>>,
    published: Published,
    started: Instant,
}

impl Tracing {
    pub fn start(ctx: &egui::Context, run: Run) -> Self {
        let published = Published::default();
        let (slot, waker) = (Arc::clone(&published), ctx.clone());
        let publish = move |traced| {
            *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::new(traced));
            waker.request_repaint();
        };
        let work = Background::start(ctx, move |progress| trace(run, progress, &publish));
        Self { work, published, started: Instant::now() }
    }

    /// What was published since the last call.
    pub fn take_published(&self) -> Option<Arc<Traced>> {
        self.published.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    pub fn poll(&self) -> Outcome<Result<Ended, String>> {
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

    /// By what it took so far; `None` while that is too little to tell.
    pub fn secs_left(&self) -> Option<f64> {
        secs_left(self.started.elapsed(), f64::from(self.fraction()))
    }
}

fn secs_left(took: Duration, done: f64) -> Option<f64> {
    (took >= LEAST_TIME && done > 0.0).then(|| took.as_secs_f64() * (1.0 - done) / done)
}

fn trace(run: Run, progress: &Progress, publish: &(impl Fn(Traced) + Sync)) -> Result<Ended, String> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads((cores - 1).max(1)).build();
    let pool = pool.map_err(|error| format!("no threads for the path tracer: {error}"))?;
    pool.install(|| {
        let Run { seen, film, samples, disk } = run;
        let (pixel, reflection) = (PixelSampling::Centre, Reflection::MetallicRoughness);
        let options = Options { size_px: seen.size_px, seed: 0, pixel, reflection };
        let scene = TracedScene::new(&seen.prepared, &seen.settings, options).map_err(|error| error.to_string())?;
        let kept = disk.map(|disk| (disk, scene.key()));
        let stored = || kept.as_ref().and_then(|(disk, key)| disk.load_film(key, seen.size_px, samples));
        let mut film = film.or_else(stored).unwrap_or_else(|| scene.new_film());
        let is_whole = step(&scene, &mut film, samples, progress, |film| {
            publish(Traced::new(film, &seen.settings.method.lighting));
        });
        let warning = kept.filter(|_| is_whole).and_then(|(disk, key)| {
            let error = disk.store_film(&key, &film).err()?;
            Some(format!("the traced picture cannot be kept in {}: {error}", disk.folder().display()))
        });
        Ok(Ended { film, warning })
    })
}

/// Sample by sample until there are as many as asked for; not, where it was stopped before.
fn step(scene: &TracedScene<'_>, film: &mut Film, samples: u32, progress: &Progress, publish: impl Fn(&Film)) -> bool {
    let missing = samples.saturating_sub(film.samples());
    progress.add_total(u64::from(missing) * u64::from(film.size_px()[1]));
    let mut last = Instant::now();
    let mut is_whole = true;
    while is_whole && film.samples() < samples {
        is_whole = scene.step(film, progress).is_ok();
        let is_due = film.samples().is_power_of_two() || last.elapsed() >= PUBLISH_STEP;
        if is_whole && is_due {
            publish(film);
            last = Instant::now();
        }
    }
    if film.samples() > 0 {
        publish(film);
    }
    is_whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_follows_from_what_is_done() {
        assert_eq!(secs_left(Duration::from_secs(10), 0.25), Some(30.0));
        assert_eq!(secs_left(Duration::from_secs(10), 1.0), Some(0.0));
        assert_eq!(secs_left(Duration::from_secs(10), 0.0), None, "nothing is done");
        assert_eq!(secs_left(Duration::from_millis(10), 0.5), None, "too early to tell");
    }
}
