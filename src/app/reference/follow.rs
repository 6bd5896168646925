//! What the reference does in a frame of the window: takes what its threads have done, reads what the engine
//! shows, and starts the next work.

use std::sync::Arc;

use super::measuring::{self, ConeParts, OfParts};
use super::pictures::{self, ConePicture, OfPicture};
use super::{Overlay, PARTS, Reference, Seen, Tracing};
use crate::app::background::{Background, Outcome};
use crate::engine::{Engine, EngineError};
use crate::settings::View;

/// What the window shows in a frame.
pub struct Shown<'a> {
    pub seen: Seen,
    pub engine: &'a Engine,
    /// Counts the engine's results.
    pub results: u64,
    /// The picture is finished, and as large as it is to be.
    pub is_finished: bool,
    /// Nobody is at work.
    pub is_quiet: bool,
}

impl Reference {
    /// Once a frame, after the picture. An error is told once, as one sentence.
    pub fn follow(&mut self, ctx: &egui::Context, shown: &Shown<'_>) -> Result<(), String> {
        let collected = self.collect(ctx);
        if std::mem::take(&mut self.is_ordered) {
            self.start(ctx, &shown.seen);
        }
        self.is_of_shown = self.seen.as_ref().is_some_and(|seen| seen.is(&shown.seen));
        let looks = &shown.seen.settings.look;
        let is_compared = self.is_of_shown && looks.view == View::Surfaces && PARTS.contains(&looks.surface);
        self.is_behind = is_compared && self.traced.is_some();
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
            ctx.request_repaint_after(crate::app::PROGRESS_STEP);
        }
        collected
    }

    fn collect(&mut self, ctx: &egui::Context) -> Result<(), String> {
        if self.pictures.collect() {
            self.overlay = self.pictures.get().map(|(_, pictures)| Overlay::new(ctx, pictures));
        }
        self.measured.collect();
        let Some(run) = &self.run else { return Ok(()) };
        let outcome = run.poll();
        if let Some(traced) = run.take_published() {
            self.traced = Some(traced);
        }
        match outcome {
            Outcome::Running => return Ok(()),
            Outcome::Done(Ok(kept)) => self.kept = Some(kept),
            Outcome::Done(Err(sentence)) => {
                self.run = None;
                return Err(sentence);
            }
            Outcome::Died => {
                self.run = None;
                return Err("the path tracer ended unexpectedly".to_owned());
            }
        }
        self.run = None;
        Ok(())
    }

    /// Traces what is seen; goes on where the same was stopped.
    fn start(&mut self, ctx: &egui::Context, seen: &Seen) {
        if !self.seen.as_ref().is_some_and(|traced| traced.is(seen)) {
            (self.kept, self.traced) = (None, None);
        }
        self.seen = Some(seen.clone());
        self.run = Some(Tracing::start(ctx, seen.clone(), self.kept.take(), self.samples));
    }

    /// Reads what is shown, where that is another result than last time.
    fn read_shown(&mut self, shown: &Shown<'_>) -> Result<(), EngineError> {
        if self.cones.as_ref().is_some_and(|(results, _)| *results == shown.results) {
            return Ok(());
        }
        let settings = &shown.seen.settings;
        if let Some(pixels) = shown.engine.read_surfaces()? {
            let picture = ConePicture {
                part: settings.look.surface,
                size_px: shown.seen.size_px,
                pixels,
                exposure: shown.engine.exposure(),
                curve: settings.look.tone_curve,
                has_sky: settings.lighting.sky_nits != [0.0; 3],
            };
            self.cones = Some((shown.results, Arc::new(picture)));
        }
        Ok(())
    }

    /// Reads one more of the parts, so that no frame is long; waits until nobody is at work.
    fn read_parts(&mut self, shown: &Shown<'_>) -> Result<(), EngineError> {
        if !shown.is_quiet {
            return Ok(());
        }
        let (results, parts) = self.parts.get_or_insert_default();
        if *results != shown.results {
            let look = &shown.seen.settings.look;
            let (size_px, exposure) = (shown.seen.size_px, shown.engine.exposure());
            let empty = ConeParts { size_px, exposure, curve: look.tone_curve, pixels: Vec::new() };
            (*results, *parts) = (shown.results, Arc::new(empty));
        }
        if let Some(part) = parts.missing()
            && let Some(parts) = Arc::get_mut(parts)
        {
            let pixels = shown.engine.read_surface_part(part)?;
            parts.pixels.push(pixels.map(|pixels| pixels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect()));
        }
        Ok(())
    }

    /// Starts what is to be drawn and measured; whether anything is left to do.
    fn work_on(&mut self, ctx: &egui::Context) -> bool {
        let (Some((results, cones)), Some(traced)) = (&self.cones, &self.traced) else { return true };
        let of = OfPicture { cones: Arc::clone(cones), traced: Arc::clone(traced) };
        if self.pictures.wants(&of) {
            let work_of = of.clone();
            let work = Background::start(ctx, move |_| pictures::draw(&work_of.cones, work_of.paths()));
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
