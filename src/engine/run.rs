//! Frames one after the other: what is wanted is planned, made, and shown.

use std::sync::Arc;
use std::time::Duration;

use super::frame::{Frame, pinned};
use super::parts::picture::Drawn;
use super::request::Request;
use super::state::{FinishedFrame, OnScreen};
use super::{Engine, EngineError, EngineState};
use crate::plan::{FramePlan, Key, Keys, Part};

impl Engine {
    /// Submits one slice of about `budget` of GPU time if the last has finished; never blocks. A frame that is found
    /// finished is shown, and the next one begun, in the same call.
    pub fn advance(&mut self, budget: Duration) -> Result<EngineState, EngineError> {
        let outcome = self.advance_frames(budget);
        if outcome.is_err() {
            self.frame = None;
            self.parts.fail();
        }
        outcome
    }

    fn advance_frames(&mut self, budget: Duration) -> Result<EngineState, EngineError> {
        loop {
            if self.frame.is_none() && !self.begin_frame() {
                return Ok(EngineState::Idle);
            }
            if let Some(fraction) = self.run_slice(budget)? {
                return Ok(EngineState::Working { fraction });
            }
            if let Some(frame) = self.frame.take() {
                self.note_times(&frame.plan);
                self.show(frame.request, frame.plan, frame.number);
            }
        }
    }

    /// Whether there is anything to do for what is wanted.
    fn begin_frame(&mut self) -> bool {
        let Some(wanted) = self.wanted.clone() else { return false };
        self.make_plan();
        if self.plan.is_idle() {
            // What is wanted is there: nothing runs, and that is shown.
            if !self.shown.as_ref().is_some_and(|shown| Arc::ptr_eq(&shown.request, &wanted)) {
                self.show(wanted, self.plan.clone(), self.begun);
            }
            return false;
        }
        self.begun += 1;
        let frame = Frame::new(wanted, self.plan.clone(), self.begun, self.keys_on_screen());
        self.frame = Some(frame);
        true
    }

    fn show(&mut self, request: Arc<Request>, plan: FramePlan, number: u64) {
        if let Some(keys) = plan.keys().first()
            && let Some(key) = keys.get(Part::Picture)
            && let Some(picture) = self.parts.finished::<Drawn>(keys).and_then(|shown| shown.picture.clone())
        {
            let keys = [Some(key), keys.get(Part::ComposedLight)].into_iter().flatten().cloned().collect();
            self.on_screen = Some(OnScreen { request: Arc::clone(&request), keys, picture });
        }
        for (part, key) in plan.keys().iter().flat_map(Keys::iter) {
            self.parts.touch(part, key, number);
        }
        let pinned = pinned(&plan, self.keys_on_screen());
        while self.gpu.bytes_in_use() > self.kept_bytes && self.parts.drop_oldest(&pinned) {}
        let results = self.results(&request, plan.keys());
        self.shown = Some(FinishedFrame { request, keys: plan.keys().to_vec(), plan, number, results });
    }

    fn keys_on_screen(&self) -> &[Key] {
        self.on_screen.as_ref().map_or(&[], |on_screen| &on_screen.keys)
    }

    /// Runs until everything asked for is there.
    pub fn run_to_end(&mut self) -> Result<(), EngineError> {
        while self.advance(Duration::from_millis(200))? != EngineState::Idle {
            self.gpu.wait()?;
        }
        Ok(())
    }

    /// Forgets results so that the next frame makes them again, as [`bench`](crate) needs.
    pub fn invalidate(&mut self) {
        let uploaded = [Part::Caches, Part::Pages, Part::Materials];
        Part::ALL.into_iter().filter(|part| !uploaded.contains(part)).for_each(|part| self.parts.forget(part));
    }

    /// Forgets light, shadow maps and pointers alone, and what shows them.
    pub fn invalidate_light(&mut self) {
        self.invalidate_surfaces();
        let light =
            [Part::BlockLinks, Part::NodeLinks, Part::Emission, Part::ShadowMaps, Part::Light, Part::Irradiance];
        light.into_iter().for_each(|part| self.parts.forget(part));
    }

    /// Forgets the surface image and all that is made from it.
    pub fn invalidate_surfaces(&mut self) {
        Part::SEEN.into_iter().for_each(|part| self.parts.forget(part));
    }
}
