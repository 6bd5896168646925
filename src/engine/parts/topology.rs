//! The nodes of the octree, in the order of their keys: keys of the blocks, pointers to children, and how many leaves
//! each leaf block holds.

use super::masks::{Masks, sizes};
use super::{Made, Making, Parts, Read};
use crate::data::octree::TopologyBuffers;
use crate::engine::EngineError;
use crate::gpu::Recorder;
use crate::plan::{Part, Pass};
use crate::stages::build::emit::{self, Emitted};

#[derive(Debug, Default)]
pub struct Topology {
    pub buffers: TopologyBuffers,
}

impl Made for Topology {
    const PART: Part = Part::Topology;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let masks = parts.made::<Masks>(making.keys)?;
        let sizes = sizes(making, parts)?;
        let b = &masks.buffers;
        let found = (&b.blocks.made("block masks")?, &b.ranks.made("block ranks")?, &b.leaf_bits.made("leaf bits")?);
        let out = Emitted::new(making.gpu, sizes, &mut self.buffers)?;
        making.begin(frame, Pass::EmitNodes);
        emit::record_start(frame, sizes, &out);
        for level in sizes.params.dense_level..sizes.params.depth {
            emit::record(making.gpu, frame, sizes, found, &out, level);
        }
        Ok(None)
    }
}
