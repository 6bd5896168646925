//! What a part is made with: the request, the method that calls for it, the keys of its inputs.

use crate::data::pages::SegmentOrder;
use crate::engine::EngineError;
use crate::engine::request::{Method, Request};
use crate::gpu::{Gpu, GpuError, Recorder};
use crate::plan::{Key, Keys, Part, Pass, calls_for};
use crate::settings::Look;
use crate::stages::pixels::ViewParams;
use crate::stages::pixels::camera::PixelRays;

#[derive(Clone, Copy)]
pub struct Making<'a> {
    pub gpu: &'a Gpu,
    pub request: &'a Request,
    pub method: &'a Method,
    pub keys: &'a Keys,
    pub part: Part,
    /// Its number among what the frame makes.
    pub number: usize,
    pub order: SegmentOrder,
    /// Of what is likely to be counted; 1 but in tests.
    pub estimated_share: f64,
}

/// Passes of a part are told apart by the low bits of their group.
const PASS_BITS: u32 = 8;

/// The number of the part that ran a group of commands, and which pass it was.
pub fn part_and_pass(group: u32) -> (usize, Option<Pass>) {
    let pass = Pass::ALL.get((group & ((1 << PASS_BITS) - 1)) as usize).copied();
    ((group >> PASS_BITS) as usize, pass)
}

impl Making<'_> {
    /// Commands recorded from here on belong to this pass.
    pub fn begin(&self, frame: &mut Recorder, pass: Pass) {
        frame.begin((self.number as u32) << PASS_BITS | pass as u32);
    }

    pub fn key(&self, part: Part) -> Result<&Key, EngineError> {
        Ok(self.keys.get(part).ok_or_else(|| GpuError::Missing { label: format!("{part:?}") })?)
    }

    /// Of the part itself. The plan has it: else the part would not be made.
    pub fn own_key(&self) -> Result<&Key, EngineError> {
        self.key(self.part)
    }

    /// The method calls for this pass of a part that is made.
    pub fn runs(&self, pass: Pass) -> bool {
        calls_for(pass, &self.method.asked)
    }

    /// Rays of the picture's pixels.
    pub fn view(&self) -> ViewParams {
        self.view_of(&self.method.settings().method.look)
    }

    pub fn view_of(&self, look: &Look) -> ViewParams {
        let (shot, grid) = (&self.request.shot, self.request.grid());
        ViewParams::new(&PixelRays::new(&shot.camera, grid, shot.size_px), look, grid.depth)
    }
}
