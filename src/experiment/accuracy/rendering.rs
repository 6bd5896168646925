//! Light that cones bring against the path tracer, term by term: errors, times and pictures.
//!
//! Every term is compared at the pixels' centres. Without bounces in the octree, the truth is the path
//! tracer's first bounce; with any, all of them.

use std::sync::Arc;

use image::DynamicImage;

use super::race::{run, shown};
use super::traced::traced;
use super::{picture_stem, posed};
use crate::accuracy::path_tracer::{Film, Options, Term};
use crate::accuracy::picture_error::{self, Display, LightPixel, difference_map, difference_scale};
use crate::disk_cache::DiskCache;
use crate::experiment::board::{Findings, Share};
use crate::experiment::frames::{Forget, Frames, Times};
use crate::experiment::lab::Lab;
use crate::experiment::rows::RenderingRow;
use crate::experiment::surface_work::{self, SurfaceWork};
use crate::experiment::table::name_of;
use crate::experiment::{Experiment, ExperimentError, NamedPicture, Subject};
use crate::gpu::Gpu;
use crate::prepare::Prepared;
use crate::settings::{MotionSettings, Settings, SurfaceView, View};

/// A term, and the work that makes it.
type TermWorks = (SurfaceView, &'static [SurfaceWork]);

/// Work behind what diffuse cones bring.
const DIFFUSE: [SurfaceWork; 2] = [SurfaceWork::Diffuse, SurfaceWork::Filter];

/// What is shown, and the terms that are read from that frame.
const FRAMES: [(SurfaceView, &[TermWorks]); 2] = [
    (
        SurfaceView::Final,
        &[
            (SurfaceView::Direct, &[SurfaceWork::Direct]),
            (SurfaceView::Diffuse, &DIFFUSE),
            (SurfaceView::Specular, &[SurfaceWork::Specular]),
            (SurfaceView::Final, &SurfaceWork::ALL),
        ],
    ),
    // Beside light, cones need not tell what is near.
    (SurfaceView::Ao, &[(SurfaceView::Ao, &DIFFUSE)]),
];

/// The truth, and where it is kept.
#[derive(Clone)]
pub struct RenderingOptions {
    pub size_px: [u32; 2],
    /// Paths a pixel and lobe.
    pub samples: u32,
    pub seed: u64,
    pub disk: Option<DiskCache>,
    /// Three pictures a term: of cones, of paths, and of their difference.
    pub draws: bool,
}

impl Default for RenderingOptions {
    fn default() -> Self {
        Self { size_px: [320, 180], samples: 256, seed: 0, disk: None, draws: false }
    }
}

/// A row a term in every pose.
pub fn rendering(
    gpu: &Arc<Gpu>,
    mut subject: Subject,
    poses: Vec<MotionSettings>,
    options: RenderingOptions,
) -> Experiment {
    (subject.settings.method.look.view, subject.settings.method.look.surface) = (View::Surfaces, SurfaceView::Final);
    subject.settings.shot.size_px = Some(options.size_px);
    Experiment::begin(gpu, ("rendering", subject), Vec::<RenderingRow>::new(), async move |mut lab, rows| {
        for (number, pose) in poses.iter().enumerate() {
            let case = Case { share: Share::WHOLE.part(number, poses.len()), number, options: &options };
            let settings = posed(&lab, pose);
            compare(&mut lab, settings, case, &rows).await?;
        }
        Ok(())
    })
}

/// One pose.
struct Case<'a> {
    share: Share,
    number: usize,
    options: &'a RenderingOptions,
}

async fn compare(
    lab: &mut Lab,
    mut settings: Settings,
    case: Case<'_>,
    rows: &Findings<Vec<RenderingRow>>,
) -> Result<(), ExperimentError> {
    let [tracing, cones, occlusion, racing] = case.share.split([4.0, 2.0, 1.0, 2.0]);
    let truth = trace(lab, &settings, (tracing, case.options)).await?;
    for ((surface, terms), share) in FRAMES.into_iter().zip([cones, occlusion]) {
        let [measuring, judging] = share.split([3.0, 1.0]);
        settings.method.look.surface = surface;
        let read = measure(lab, &settings, (case.options.size_px, terms, measuring)).await?;
        let stem = case.options.draws.then(|| picture_stem(lab, &settings, case.number));
        let (prepared, of_frame, truth) = (Arc::clone(&lab.prepared), settings.clone(), Arc::clone(&truth));
        let judged = lab.work((judging, "comparing with paths"), move |_| {
            read.iter().map(|term| term.judge((&prepared, &of_frame), &truth, stem.as_deref())).collect()
        });
        let judged: Result<Vec<_>, ExperimentError> = judged.await?;
        for (row, pictures) in judged? {
            pictures.into_iter().for_each(|picture| lab.show(picture));
            rows.borrow_mut().push(row);
        }
    }
    settings.method.look.surface = SurfaceView::Final;
    race(lab, settings, (racing, case.options, truth), rows).await
}

/// What the path tracer says.
async fn trace(
    lab: &mut Lab,
    settings: &Settings,
    (share, options): (Share, &RenderingOptions),
) -> Result<Arc<Film>, ExperimentError> {
    let (prepared, settings, of_thread) = (Arc::clone(&lab.prepared), settings.clone(), options.clone());
    let traced = lab.work((share, "tracing paths"), move |progress| {
        let paths = (paths(&of_thread), of_thread.samples);
        traced((&prepared, of_thread.disk.as_ref()), &settings, paths, progress)
    });
    let traced = traced.await??;
    lab.warn(&traced.warnings);
    Ok(Arc::new(traced.film))
}

fn paths(options: &RenderingOptions) -> Options {
    Options { seed: options.seed, ..Options::new(options.size_px) }
}

/// What cones bring of a term, and what it took.
struct ReadTerm {
    part: SurfaceView,
    cones_ms: f64,
    cones: Vec<LightPixel>,
}

/// The terms that a frame has, after a run that is not measured.
async fn measure(
    lab: &mut Lab,
    settings: &Settings,
    (size_px, terms, share): ([u32; 2], &[TermWorks], Share),
) -> Result<Vec<ReadTerm>, ExperimentError> {
    let mut times = Times::default();
    let frames = Frames {
        what: "tracing cones",
        settings,
        size_px,
        forget: Forget::Surfaces,
        warmup: lab.warmup,
        runs: lab.runs,
    };
    lab.measure(frames, share, |engine, _| times.add(surface_work::kernels(engine.timings()))).await?;
    let medians = times.medians();
    let mut read = Vec::new();
    for &(part, works) in terms {
        let of_term = medians.iter().filter(|((work, _), _)| works.contains(work));
        // The sum of no numbers would be −0.
        let cones_ms = of_term.fold(0.0, |sum, (_, ms)| sum + ms);
        read.extend(lab.engine.read_surface_part(part)?.map(|cones| ReadTerm { part, cones_ms, cones }));
    }
    Ok(read)
}

/// Paths in the time of cones, beside the row of the final picture that was added last.
async fn race(
    lab: &mut Lab,
    settings: Settings,
    (share, options, truth): (Share, &RenderingOptions, Arc<Film>),
    rows: &Findings<Vec<RenderingRow>>,
) -> Result<(), ExperimentError> {
    let place = rows.borrow().iter().rposition(|row| row.term == SurfaceView::Final);
    let Some((place, cones)) = place.map(|place| (place, rows.borrow()[place].clone())) else { return Ok(()) };
    let (prepared, options) = (Arc::clone(&lab.prepared), paths(options));
    let race = lab.work((share, "tracing paths as long as cones took"), move |progress| {
        run((&prepared, &settings), (&truth, options), (cones.cones_ms / 1e3, cones.error), progress)
    });
    let race = race.await??;
    rows.borrow_mut()[place].race = Some(race);
    Ok(())
}

impl ReadTerm {
    /// Its row, and where a stem is given its pictures.
    fn judge(
        &self,
        (prepared, settings): (&Prepared, &Settings),
        film: &Film,
        stem: Option<&str>,
    ) -> Result<(RenderingRow, Vec<NamedPicture>), ExperimentError> {
        let truth = shown(film, self.part, (prepared, settings))?;
        let shown = Display::of_mean(&settings.method.look, self.part, &truth);
        let error = picture_error::compare(&self.cones, &truth, film.size_px(), &shown)?;
        let bounces = settings.method.lighting.bounces;
        let stated = Term::of(self.part, bounces).map(|term| film.standard_error(term)).unwrap_or_default();
        let row = RenderingRow {
            scene: prepared.scene.name.clone(),
            time_secs: settings.shot.motion.time_secs,
            turn_degrees: settings.shot.motion.turn_degrees,
            grid: settings.method.discretization.grid,
            span: prepared.grid.span,
            size_px: film.size_px(),
            bounces,
            term: self.part,
            error,
            cones_ms: self.cones_ms,
            paths_secs: film.secs(),
            samples: film.samples(),
            paths_error: stated.relative,
            paths_mean_error: stated.relative_of_mean,
            race: None,
        };
        Ok((row, stem.map_or(Vec::new(), |stem| self.pictures(settings, (&truth, shown, film.size_px()), stem))))
    }

    /// `STEM-diffuse-cones`, `-paths` and `-difference`.
    fn pictures(
        &self,
        settings: &Settings,
        (truth, shown, size_px): (&[LightPixel], Display, [u32; 2]),
        stem: &str,
    ) -> Vec<NamedPicture> {
        let mut settings = settings.clone();
        settings.method.look.surface = self.part;
        let drawn = |light: &[LightPixel]| DynamicImage::from(shown.picture(light, size_px)).into_rgba8();
        let difference = difference_map(&self.cones, truth, size_px, difference_scale(truth));
        let pictures = [("cones", drawn(&self.cones)), ("paths", drawn(truth)), ("difference", difference)];
        let named = |(kind, picture)| {
            let name = format!("{stem}-{}-{kind}", name_of(&self.part));
            NamedPicture { name, picture, settings: settings.clone() }
        };
        pictures.map(named).into()
    }
}
