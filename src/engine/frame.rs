//! A frame on its way. It holds its request; what it records goes out in one job, as far as the sizes of what it reads
//! are known or likely. Counts and times come back with the last slice, without anybody waiting.

use std::sync::Arc;

use super::pool::Pinned;
use super::request::{Request, Shot};
use crate::data::mesh::Textures;
use crate::digest::Digest;
use crate::gpu::Job;
use crate::plan::{FramePlan, Key, Part};
use crate::settings::View;

pub struct Frame {
    pub request: Arc<Request>,
    /// As it was begun.
    pub plan: FramePlan,
    pub number: u64,
    /// What is left of it after a part had outgrown its room.
    pub left: FramePlan,
    pub pinned: Pinned,
    /// Parts of `left` that are recorded.
    pub recorded: usize,
    pub room: Room,
    pub running: Option<Running>,
}

/// What was done to find memory.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Room {
    AsItIs,
    KeptDropped,
    AllDropped,
}

/// Recorded parts on their way through the queue.
pub struct Running {
    pub job: Box<Job>,
    /// The first of them.
    pub first: usize,
    /// Whose bytes each read brings.
    pub reads: Vec<usize>,
}

impl Frame {
    pub fn new(request: Arc<Request>, plan: FramePlan, number: u64, on_screen: &[Key]) -> Self {
        let pinned = pinned(&plan, on_screen);
        Self { request, left: plan.clone(), plan, number, pinned, recorded: 0, room: Room::AsItIs, running: None }
    }

    pub fn is_done(&self) -> bool {
        self.running.is_none() && self.recorded == self.left.to_run().len()
    }

    /// The share that is done, `part` of what runs now included.
    pub fn fraction(&self, part: f32) -> f32 {
        let first = self.running.as_ref().map_or(self.recorded, |running| running.first);
        let done = first as f32 + part * (self.recorded - first) as f32;
        done / self.left.to_run().len().max(1) as f32
    }

    /// Triangles that must be on the GPU before anything is recorded.
    pub fn textures(&self) -> Option<Textures> {
        let runs = |part: Part| self.left.to_run().iter().any(|planned| planned.part == part);
        if runs(Part::SurfaceImage) {
            return Some(Textures::All);
        }
        let draws = runs(Part::Picture) && self.request.settings().method.look.view == View::Mesh;
        if draws || runs(Part::ShadowMaps) {
            return Some(Textures::BaseColor);
        }
        runs(Part::Columns).then_some(Textures::None)
    }
}

/// What a plan is made from, and the picture on screen: nothing of it may be overwritten.
pub fn pinned(plan: &FramePlan, on_screen: &[Key]) -> Pinned {
    let keys = plan.keys().iter().flat_map(|keys| keys.iter().map(|(_, key)| key.digest()));
    keys.chain(on_screen.iter().map(Key::digest)).collect()
}

/// Of what moment a part is: when that has passed, nobody asks for it again.
pub fn moment(part: Part, shot: &Shot) -> Digest {
    match part {
        Part::Caches | Part::Materials => Digest::default(),
        part if Part::SEEN.contains(&part) => shot.seen(),
        _ => shot.placed,
    }
}
