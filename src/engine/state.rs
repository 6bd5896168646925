//! The engine: what is wanted, the frame on its way, what is shown, and the parts that the GPU holds.

use std::sync::Arc;

use super::EngineError;
use super::frame::Frame;
use super::parts::Parts;
use super::reports::Results;
use super::request::Request;
use super::times::TimesBook;
use crate::data::pages::SegmentOrder;
use crate::gpu::{BufferUse, Gpu};
use crate::plan::{self, Asked, FramePlan, Key, Keys};
use crate::prepare::{ExactVoxels, Prepared, Room};
use crate::settings::{MotionSettings, Settings};
use crate::stages::pixels::Picture;

/// What other methods made of the same moment is kept while all buffers together take no more than this.
pub const KEPT_BYTES: u64 = 2 << 30;
/// Exact voxels that are remembered, of as many poses.
const KNOWN_EXACTS: usize = 4;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EngineState {
    /// The part of the frame that is done, 0 to 1.
    Working { fraction: f32 },
    /// Everything asked for is there.
    Idle,
}

pub struct Engine {
    pub(super) gpu: Arc<Gpu>,
    pub(super) segment_order: SegmentOrder,
    pub(super) kept_bytes: u64,
    pub(super) prepared: Option<Arc<Prepared>>,
    /// The latest first.
    pub(super) exacts: Vec<Arc<ExactVoxels>>,
    pub(super) wanted: Option<Arc<Request>>,
    pub(super) plan: FramePlan,
    pub(super) frame: Option<Frame>,
    /// Frames that were begun.
    pub(super) begun: u64,
    pub(super) shown: Option<FinishedFrame>,
    pub(super) on_screen: Option<OnScreen>,
    pub(super) parts: Parts,
    pub(super) times: TimesBook,
    /// What plans are told instead of the truth.
    pub(super) told: Option<fn(&mut Asked)>,
    pub(super) estimated_share: f64,
}

/// The last frame that was finished.
pub(super) struct FinishedFrame {
    pub request: Arc<Request>,
    pub keys: Vec<Keys>,
    pub plan: FramePlan,
    pub number: u64,
    pub results: Results,
}

/// The last picture that was finished. Requests without one leave it where it is.
pub(super) struct OnScreen {
    pub request: Arc<Request>,
    /// Of the picture, and of the light that it shows.
    pub keys: Vec<Key>,
    pub picture: Picture,
}

impl Engine {
    pub fn new(gpu: Arc<Gpu>) -> Self {
        Self::with_segment_order(gpu, SegmentOrder::default())
    }

    /// Results do not depend on the order in which segments are taken; tests show that.
    pub fn with_segment_order(gpu: Arc<Gpu>, segment_order: SegmentOrder) -> Self {
        Self {
            gpu,
            segment_order,
            kept_bytes: KEPT_BYTES,
            prepared: None,
            exacts: Vec::new(),
            wanted: None,
            plan: FramePlan::default(),
            frame: None,
            begun: 0,
            shown: None,
            on_screen: None,
            parts: Parts::default(),
            times: TimesBook::default(),
            told: None,
            estimated_share: 1.0,
        }
    }

    /// Keeps what other methods made only while all buffers together take no more than this; [`KEPT_BYTES`] at first.
    pub fn keep_bytes(&mut self, bytes: u64) {
        self.kept_bytes = bytes;
    }

    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// What voxels must fit to be moved here.
    pub fn room(&self) -> Room {
        let buffer_bytes = self.gpu.limits.max_storage_buffer_binding_size;
        Room { adapter: self.gpu.info.name.clone(), buffer_bytes }
    }

    /// Another scene, or other caches of it; everything on the GPU is dropped.
    pub fn set_prepared(&mut self, prepared: Option<Arc<Prepared>>) {
        let gpu = Arc::clone(&self.gpu);
        let empty = Self::with_segment_order(gpu, self.segment_order);
        *self = Self { prepared, kept_bytes: self.kept_bytes, begun: self.begun, ..empty };
    }

    pub fn prepared(&self) -> Option<&Arc<Prepared>> {
        self.prepared.as_ref()
    }

    /// Exact voxels of some pose. Requests of that pose, and of no other, are compared with them.
    pub fn offer_exact(&mut self, exact: Arc<ExactVoxels>) {
        self.exacts.insert(0, exact);
        self.exacts.truncate(KNOWN_EXACTS);
    }

    /// What is wanted now. Cheap: a frame that is on its way holds its own request; this one begins with the next
    /// [`Self::advance`] after it.
    pub fn request(&mut self, settings: &Settings, size_px: [u32; 2]) -> Result<(), EngineError> {
        let prepared = self.prepared.as_ref().ok_or(EngineError::NoScene)?;
        let request = Request::new(prepared, (settings, size_px), &self.exacts)?;
        self.wanted = Some(Arc::new(request));
        if self.frame.is_none() {
            self.make_plan();
        }
        Ok(())
    }

    /// Tells plans something else than what is asked for: a key that forgets an input, by which tests of the engine
    /// are tested.
    pub fn mistell(&mut self, told: fn(&mut Asked)) {
        self.told = Some(told);
    }

    /// Makes room for only this share of what is likely to be counted, so that frames outgrow it: for tests that this
    /// changes no bit.
    pub fn underestimate(&mut self, share: f64) {
        self.estimated_share = share;
    }

    pub(super) fn make_plan(&mut self) {
        let Some(wanted) = self.wanted.clone() else { return };
        self.plan = self.plan_of(&wanted);
    }

    pub(super) fn plan_of(&self, request: &Request) -> FramePlan {
        let mut methods = request.asked();
        self.told.into_iter().for_each(|told| methods.iter_mut().for_each(told));
        plan::plan(&methods, &self.parts.held())
    }

    /// Of the frame that is on its way, else of the one that is wanted.
    pub fn plan(&self) -> &FramePlan {
        &self.plan
    }

    /// Nothing of the scene is in the picture that was requested: all of it is hidden, or outside the grid.
    pub fn shows_nothing(&self) -> bool {
        self.wanted.as_ref().is_some_and(|wanted| wanted.shows_nothing())
    }

    /// Objects that the requested pose cannot show, lights that are nowhere in it, and settings that do not fit the
    /// scene or the grid, a sentence each.
    pub fn left_out(&self) -> Vec<String> {
        self.wanted.as_ref().map_or(Vec::new(), |wanted| wanted.left_out())
    }

    /// Objects that are voxelized every frame where others are moved: their numbers.
    pub fn voxelized(&self) -> Vec<usize> {
        self.wanted.as_ref().map_or(Vec::new(), |wanted| wanted.voxelized().collect())
    }

    /// How many frames were finished or are on their way; grows with each that runs anything.
    pub fn frames_begun(&self) -> u64 {
        self.begun
    }

    /// Number and plan of the last frame that was finished.
    pub fn last_frame(&self) -> Option<(u64, &FramePlan)> {
        self.shown.as_ref().map(|shown| (shown.number, &shown.plan))
    }

    /// The moment that the picture on screen shows.
    pub fn moment_on_screen(&self) -> Option<&MotionSettings> {
        self.on_screen.as_ref().map(|on_screen| &on_screen.request.settings().shot.motion)
    }

    /// The settings that the picture on screen was made with.
    pub fn settings_on_screen(&self) -> Option<&Settings> {
        self.on_screen.as_ref().map(|on_screen| on_screen.request.settings())
    }

    pub fn memory(&self) -> Vec<BufferUse> {
        self.gpu.memory()
    }
}
