//! What the reference does in a frame of the window: takes what its threads have done, reads what the engine
//! shows, and starts the next work.

use std::sync::Arc;

use super::measuring::{self, ConeParts, OfParts};
use super::pictures::{self, ConePicture, OfPicture};
use super::tracing::Run;
use super::{Cause, Overlay, PARTS, Reference, Seen, Stopped, Tracing};
use crate::accuracy::picture_error::Display;
use crate::app::background::{Background, Outcome};
use crate::app::pace::PROGRESS_STEP;
use crate::disk_cache::DiskCache;
use crate::engine::{Engine, EngineError};
use crate::settings::{ToneCurve, View};

/// What the window shows in a frame.
pub struct ShownSurfaces<'a> {
    pub seen: Seen,
    /// Where traced pictures are kept.
    pub disk: Option<&'a DiskCache>,
    pub engine: &'a Engine,
    /// Counts the engine's results.
    pub results: u64,
    /// The picture is finished, and as large as it is to be.
    pub is_finished: bool,
    /// Nobody is at work.
    pub is_quiet: bool,
    /// Nothing plays: the picture stays what it is.
    pub is_still: bool,
}

impl Reference {
    /// Once a frame, after the picture. An error is told once, as one sentence.
    pub fn follow(&mut self, ctx: &egui::Context, shown: &ShownSurfaces<'_>) -> Result<(), String> {
        let collected = self.collect(ctx);
        if std::mem::take(&mut self.is_ordered) {
            self.start(ctx, shown);
        }
        self.is_of_shown = self.seen.as_ref().is_some_and(|seen| seen.is(&shown.seen));
        self.keep_to(ctx, shown);
        let looks = &shown.seen.settings.method.look;
        self.is_compared = self.is_of_shown && looks.view == View::Surfaces && PARTS.contains(&looks.surface);
        self.is_behind = self.is_compared && self.traced.is_some();
        if !self.is_behind || !shown.is_finished || !self.is_looked_at() {
            return collected;
        }
        let compared = self.read_shown(shown).and_then(|()| self.read_parts(shown));
        if let Err(error) = compared {
            // Not tried again before it is looked at again.
            (self.is_open, self.comparison) = (false, super::Comparison::Cones);
            return Err(error.to_string());
        }
        self.is_behind = self.work_on(ctx);
        if self.is_behind {
            ctx.request_repaint_after(PROGRESS_STEP);
        }
        collected
    }

    fn collect(&mut self, ctx: &egui::Context) -> Result<(), String> {
        if self.pictures.collect() {
            self.overlay = self.pictures.get().map(|(_, pictures)| Overlay::new(ctx, pictures));
        }
        let is_measured = self.measured.collect();
        if let Some((_, Err(error))) = self.measured.get().filter(|_| is_measured) {
            return Err(error.to_string());
        }
        let Some(run) = &self.run else { return Ok(()) };
        let outcome = run.poll();
        if let Some(traced) = run.take_published() {
            self.traced = Some(traced);
        }
        if matches!(outcome, Outcome::Running) {
            return Ok(());
        }
        self.run = None;
        let stopping = self.stopping.take();
        match outcome {
            Outcome::Running => Ok(()),
            Outcome::Done(Ok(ended)) => {
                let (samples, of) = (ended.film.samples(), self.asked);
                self.stopped = stopping.filter(|_| samples < of).map(|cause| Stopped { cause, samples, of });
                self.kept = Some(ended.film);
                ended.warning.map_or(Ok(()), Err)
            }
            Outcome::Done(Err(sentence)) => Err(sentence),
            Outcome::Died => Err("the path tracer ended unexpectedly".to_owned()),
        }
    }

    /// A run whose picture is gone stops: nothing could be compared with it. Where a person wants that, the picture
    /// that is shown now is traced instead, once it rests.
    fn keep_to(&mut self, ctx: &egui::Context, shown: &ShownSurfaces<'_>) {
        self.is_restart_due = false;
        if self.is_of_shown {
            return;
        }
        self.stop(Cause::PictureGone);
        self.is_restart_due = self.restarts && self.is_wanted && shown.is_finished && shown.is_still;
        if self.is_restart_due && shown.is_quiet {
            self.start(ctx, shown);
            (self.is_restart_due, self.is_of_shown) = (false, true);
        }
    }

    /// Asks a run that goes on to end soon.
    pub(super) fn stop(&mut self, cause: Cause) {
        if let Some(run) = &self.run {
            run.stop();
            self.stopping.get_or_insert(cause);
        }
    }

    /// Traces what is seen; goes on where the same was stopped.
    fn start(&mut self, ctx: &egui::Context, shown: &ShownSurfaces<'_>) {
        if !self.seen.as_ref().is_some_and(|traced| traced.is(&shown.seen)) {
            (self.kept, self.traced) = (None, None);
        }
        self.seen = Some(shown.seen.clone());
        (self.asked, self.stopping, self.stopped) = (self.samples, None, None);
        let disk = shown.disk.cloned();
        let run = Run { seen: shown.seen.clone(), film: self.kept.take(), samples: self.samples, disk };
        self.run = Some(Tracing::start(ctx, run));
    }

    /// Reads what is shown, where that is another result than last time.
    fn read_shown(&mut self, shown: &ShownSurfaces<'_>) -> Result<(), EngineError> {
        if self.cones.as_ref().is_some_and(|(results, _)| *results == shown.results) {
            return Ok(());
        }
        let settings = &shown.seen.settings;
        if let Some(pixels) = shown.engine.read_surfaces()? {
            let (part, curve) = (settings.method.look.surface, settings.method.look.tone_curve);
            let picture = ConePicture {
                part,
                size_px: shown.seen.size_px,
                pixels,
                shown: match part.is_light() {
                    true => Display { exposure: shown.engine.exposure(), curve },
                    false => Display { exposure: 1.0, curve: ToneCurve::Linear },
                },
                shows_sky: part.is_light() && settings.method.lighting.has_sky(),
            };
            self.cones = Some((shown.results, Arc::new(picture)));
        }
        Ok(())
    }

    /// Reads one more of the parts, so that no frame is long; waits until nobody is at work.
    fn read_parts(&mut self, shown: &ShownSurfaces<'_>) -> Result<(), EngineError> {
        if !shown.is_quiet {
            return Ok(());
        }
        let (results, parts) = self.parts.get_or_insert_default();
        if *results != shown.results {
            let (size_px, look) = (shown.seen.size_px, shown.seen.settings.method.look);
            (*results, *parts) = (shown.results, Arc::new(ConeParts { size_px, look, pixels: Vec::new() }));
        }
        if let Some(part) = parts.missing()
            && let Some(parts) = Arc::get_mut(parts)
        {
            parts.pixels.push(shown.engine.read_surface_part(part)?);
        }
        Ok(())
    }

    /// Starts what is to be drawn and measured; whether anything is left to do.
    fn work_on(&mut self, ctx: &egui::Context) -> bool {
        let (Some((results, cones)), Some(traced)) = (&self.cones, &self.traced) else { return true };
        let of = OfPicture { cones: Arc::clone(cones), traced: Arc::clone(traced) };
        if self.pictures.wants(&of) {
            let work_of = of.clone();
            let work = Background::start(ctx, move |_| pictures::draw(&work_of));
            self.pictures.start(of, work);
        }
        let read = self.parts.as_ref().filter(|(of, parts)| of == results && parts.missing().is_none());
        let Some((_, parts)) = read else { return true };
        let of = OfParts { cones: Arc::clone(parts), traced: Arc::clone(traced) };
        if self.measured.wants(&of) {
            let work_of = of.clone();
            let work = Background::start(ctx, move |_| measuring::measure(&work_of.cones, &work_of.traced));
            self.measured.start(of, work);
        }
        self.pictures.is_running() || self.measured.is_running()
    }
}
