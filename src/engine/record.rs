//! Recording and running a frame: its parts go into one job, slice by slice within a budget.

use std::sync::Arc;
use std::time::Duration;

use super::frame::{Frame, Room, Running, moment};
use super::parts::kinds::{self, has_outgrown, is_incomplete, is_ready};
use super::parts::{Making, Parts, part_and_pass};
use super::pool::Turn;
use super::times::PassTiming;
use super::{Engine, EngineError};
use crate::data::mesh::MeshScene;
use crate::gpu::{GpuError, Job, JobState, Recorder};
use crate::plan::{FramePlan, Key, Keys, Part};
use crate::stages::textures::halve::record_levels;

impl Engine {
    /// One slice of the frame on its way; `None` when all of it is done. Where memory is short, the frame begins again
    /// with more room before it gives up.
    pub(super) fn run_slice(&mut self, budget: Duration) -> Result<Option<f32>, EngineError> {
        loop {
            match self.run_on(budget) {
                Err(error) if error.is_out_of_memory() && self.make_room() => {}
                outcome => return outcome,
            }
        }
    }

    fn run_on(&mut self, budget: Duration) -> Result<Option<f32>, EngineError> {
        loop {
            let Some(frame) = &mut self.frame else { return Ok(None) };
            if let Some(running) = &mut frame.running {
                match running.job.advance(&self.gpu, budget)? {
                    JobState::Running { submitted } => return Ok(Some(frame.fraction(submitted))),
                    JobState::Done => self.job_is_done()?,
                }
            } else if frame.is_done() {
                return Ok(None);
            } else if self.upload_mesh(budget)? {
                self.record()?;
            } else {
                return Ok(self.frame.as_ref().map(|frame| frame.fraction(0.0)));
            }
        }
    }

    /// What is kept for later goes first, where that was not enough everything; whether there was anything to try.
    fn make_room(&mut self) -> bool {
        let Some(mut frame) = self.frame.take() else { return false };
        frame.running = None;
        self.parts.fail();
        frame.room = match frame.room {
            Room::AsItIs => {
                while self.parts.drop_oldest(&frame.pinned) {}
                Room::KeptDropped
            }
            Room::KeptDropped => {
                self.parts = Parts::default();
                Room::AllDropped
            }
            Room::AllDropped => return false,
        };
        self.begin_again(&mut frame);
        self.frame = Some(frame);
        true
    }

    /// Uploads what the frame draws of the triangles, for about `budget`; says whether all is there.
    fn upload_mesh(&mut self, budget: Duration) -> Result<bool, EngineError> {
        let Some(frame) = &self.frame else { return Ok(true) };
        let Some(textures) = frame.textures() else { return Ok(true) };
        let prepared = &frame.request.prepared;
        let objects = || prepared.objects.iter().zip(0..).map(|(object, number)| (number, object.object.clone()));
        let new = || MeshScene::new(Arc::clone(&prepared.scene), objects().collect(), record_levels);
        let mesh = self.parts.mesh.get_or_insert_with(new);
        let is_there = mesh.upload(&self.gpu, (&frame.request.shot.hidden, textures), budget)?;
        if is_there {
            mesh.morph(&self.gpu, &frame.request.shot.pose)?;
        }
        Ok(is_there)
    }

    /// Records what can be: all that is left where sizes are known.
    fn record(&mut self) -> Result<(), EngineError> {
        let Some(mut frame) = self.frame.take() else { return Ok(()) };
        let recorded = self.record_parts(&mut frame);
        self.frame = Some(frame);
        recorded
    }

    /// Plans what is left of a frame, from what is there now.
    fn begin_again(&self, frame: &mut Frame) {
        frame.left = self.plan_of(&frame.request);
        frame.recorded = 0;
    }

    fn record_parts(&mut self, frame: &mut Frame) -> Result<(), EngineError> {
        let (first, mut recorder, mut reads) = (frame.recorded, Recorder::default(), Vec::new());
        while let Some(planned) =
            frame.left.to_run().get(frame.recorded).filter(|planned| is_ready(&self.parts, planned))
        {
            let making = Making {
                gpu: &self.gpu,
                request: &frame.request,
                method: &frame.request.methods[planned.method],
                keys: &frame.left.keys()[planned.method],
                part: planned.part,
                number: frame.recorded,
                order: self.segment_order,
                estimated_share: self.estimated_share,
            };
            let moment = moment(planned.part, &frame.request.shot);
            let has_room = self.gpu.bytes_in_use() < self.kept_bytes;
            let turn = Turn { frame: frame.number, moment, has_room };
            if let Some((buffer, range)) =
                kinds::record(&mut self.parts, &making, &mut recorder, (&turn, &frame.pinned))?
            {
                recorder.read(&buffer, range);
                reads.push(frame.recorded);
            }
            frame.recorded += 1;
        }
        if frame.recorded == first {
            return Err(GpuError::Missing { label: "octree sizes".to_owned() }.into());
        }
        frame.running = Some(Running { job: Box::new(Job::new(recorder)), first, reads });
        Ok(())
    }

    /// Takes down what came back. Where something had outgrown its room, what is behind it is made again, with room.
    fn job_is_done(&mut self) -> Result<(), EngineError> {
        let Some(mut frame) = self.frame.take() else { return Ok(()) };
        let Some(mut running) = frame.running.take() else { return Ok(()) };
        let to_run = frame.left.to_run();
        for (&number, bytes) in running.reads.iter().zip(running.job.take_reads()) {
            kinds::received(&mut self.parts, &to_run[number], &self.gpu, &bytes)?;
        }
        let mut timings: Vec<Vec<PassTiming>> = vec![Vec::new(); to_run.len()];
        for kernel in running.job.take_timings() {
            let (number, pass) = part_and_pass(kernel.group);
            let timing = pass.map(|pass| PassTiming { pass, frame: frame.number, kernel });
            timings.get_mut(number).into_iter().for_each(|of_part| of_part.extend(timing.clone()));
        }
        let made = running.first..frame.recorded;
        let outgrown: Vec<Key> =
            to_run[made.clone()].iter().filter(|p| has_outgrown(&self.parts, p)).map(|p| p.key.clone()).collect();
        for number in made {
            let planned = &to_run[number];
            if !planned.key.is_made_from(&outgrown) && !is_incomplete(&self.parts, planned) {
                self.parts.finish(planned, std::mem::take(&mut timings[number]));
            }
        }
        if !outgrown.is_empty() {
            self.parts.fail();
            self.begin_again(&mut frame);
        }
        self.frame = Some(frame);
        Ok(())
    }

    /// Notes what builds of octrees took.
    pub(super) fn note_times(&mut self, plan: &FramePlan) {
        for planned in plan.to_run().iter().filter(|planned| planned.part == Part::Payload) {
            let ms = self.build_ms(&plan.keys()[planned.method]);
            self.times.note(planned.key.method(), ms);
        }
    }

    /// What moving and building took for a method.
    pub(super) fn build_ms(&self, keys: &Keys) -> f64 {
        let build = Part::DISCRETIZED.into_iter().chain(Part::BUILT);
        let parts = build.filter_map(|part| Some(self.parts.timings(part, keys.get(part)?)));
        parts.flatten().map(|timing| timing.kernel.ms).sum()
    }
}
