//! What is on the GPU, brought back: of the last frame that was finished, and of no other.

mod inspect;
mod irradiance;
mod node_reader;
mod picture;
mod report;
mod results;
mod sample;
mod surfaces;
mod voxels;

pub use inspect::{NodeFacts, StoredNode};
pub use node_reader::NodeAddress;

use super::Engine;
use super::parts::Making;
use super::parts::masks::{MaskCounts, Masks};
use super::parts::payload::Payload;
use super::state::FinishedFrame;
use crate::gpu::GpuError;
use crate::plan::{Keys, Part};

/// An octree that is built, with what was counted of it.
#[derive(Clone, Copy)]
pub(super) struct Built<'a> {
    pub masks: &'a Masks,
    pub counts: &'a MaskCounts,
    pub payload: &'a Payload,
}

impl Engine {
    /// The octree that a method asked for, if it is there.
    fn built(&self, keys: &Keys) -> Option<Built<'_>> {
        let masks = self.parts.finished::<Masks>(keys)?;
        let payload = self.parts.finished::<Payload>(keys)?;
        Some(Built { masks, counts: masks.counts.as_ref()?, payload })
    }

    /// The octree that is shown.
    fn shown_octree(&self) -> Option<Built<'_>> {
        self.built(self.shown.as_ref()?.keys.first()?)
    }

    /// For kernels that run beside the frame that is shown.
    fn making<'a>(&'a self, shown: &'a FinishedFrame, part: Part) -> Option<Making<'a>> {
        let (request, keys) = (&*shown.request, shown.keys.first()?);
        Some(Making {
            gpu: &self.gpu,
            request,
            method: request.shown(),
            keys,
            part,
            number: 0,
            order: self.segment_order,
            estimated_share: self.estimated_share,
        })
    }
}

fn missing(label: &str) -> GpuError {
    GpuError::Missing { label: label.to_owned() }
}
