//! The exact voxels of the pose beside the moved ones: uploaded, masked for rays, and compared.

use super::masks::Masks;
use super::{Made, Making, Parts, Read};
use crate::data::octree::{OctreeParams, OctreeSizes, Slot};
use crate::engine::EngineError;
use crate::gpu::{Gpu, GpuError, Recorder};
use crate::plan::{Part, Pass};
use crate::stages::build::COUNTERS;
use crate::stages::build::reduce;
use crate::stages::compare::compare_sets;

#[derive(Debug, Default)]
pub struct ExactBits {
    /// A bit a leaf cell, as the octree's.
    pub bits: Slot,
}

/// The masks above the exact leaves. Blocks and counters are by-products nobody reads.
#[derive(Debug, Default)]
pub struct ExactMasks {
    pub occupied: Slot,
    blocks: Slot,
    counters: Slot,
    params: Slot,
}

#[derive(Debug, Default)]
pub struct Comparison {
    counts: Slot,
    /// Holes, spill and cells in both.
    pub found: Option<[u64; 3]>,
}

impl Made for ExactBits {
    const PART: Part = Part::ExactBits;

    fn record(&mut self, making: &Making<'_>, _: &Parts, _: &mut Recorder) -> Result<Option<Read>, EngineError> {
        let missing = || GpuError::Missing { label: "exact bits".to_owned() };
        let exact = making.request.shot.exact.as_ref().ok_or_else(missing)?;
        let bits = self.bits.ensure(making.gpu, "exact bits", size_of_val(exact.bits.as_slice()) as u64)?;
        making.gpu.write(&bits, 0, bytemuck::cast_slice(&exact.bits))?;
        Ok(None)
    }
}

impl Made for ExactMasks {
    const PART: Part = Part::ExactMasks;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let (gpu, depth) = (making.gpu, making.request.grid().depth);
        let octree = OctreeParams::new(depth, depth - 1);
        let sizes = OctreeSizes::write(gpu, &mut self.params, &octree)?;
        let masks = reduce::Masks {
            leaf_bits: parts.made::<ExactBits>(making.keys)?.bits.made("exact bits")?,
            occupied: self.occupied.ensure(gpu, "exact occupied masks", 4 * u64::from(octree.occupied_words()))?,
            blocks: self.blocks.ensure(gpu, "exact block masks", 4 * u64::from(octree.blocks_words()))?,
            counters: self.counters.ensure(gpu, "exact counters", 8 * u64::from(COUNTERS))?,
        };
        making.begin(frame, Pass::ReduceExact);
        for level in (0..depth).rev() {
            reduce::record(gpu, frame, &sizes, &masks, level);
        }
        Ok(None)
    }
}

impl Made for Comparison {
    const PART: Part = Part::Comparison;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let bytes = 4 * compare_sets::COUNT_WORDS;
        let counts = self.counts.ensure(making.gpu, "comparison counts", bytes)?;
        let masks = parts.made::<Masks>(making.keys)?;
        let exact = parts.made::<ExactBits>(making.keys)?.bits.made("exact bits")?;
        self.found = None;
        making.begin(frame, Pass::CompareExact);
        compare_sets::record(making.gpu, frame, &masks.buffers.leaf_bits.made("leaf bits")?, &exact, &counts);
        Ok(Some((counts, 0..bytes)))
    }

    fn received(&mut self, _: &Gpu, bytes: &[u8]) -> Result<(), GpuError> {
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(bytes);
        self.found = Some([0, 1, 2].map(|i| u64::from(words[i])));
        Ok(())
    }
}
