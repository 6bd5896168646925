//! Forward neighbour pointers (section 4.4), once a block or, as in the paper, once a node.

use super::{Made, Making, Parts, Read};
use crate::data::octree::Slot;
use crate::engine::EngineError;
use crate::gpu::Recorder;
use crate::plan::{Pass, layout_of};
use crate::stages::build::link::{self, Linked};

#[derive(Debug, Default)]
pub struct Links {
    pub neighbours: Slot,
}

impl Made for Links {
    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let octree = parts.octree(making)?;
        let linked = Linked {
            blocks: octree.masks.blocks.made("block masks")?,
            ranks: octree.masks.ranks.made("block ranks")?,
            block_keys: octree.topology.block_keys.made("block keys")?,
        };
        let layout = layout_of(making.part);
        let bytes = 4 * layout.words(&octree.sizes.params);
        let neighbours = self.neighbours.ensure(making.gpu, "neighbour pointers", bytes)?;
        making.begin(frame, Pass::LinkNodes);
        link::record(making.gpu, frame, octree.sizes, &linked, (layout, &neighbours));
        Ok(None)
    }
}
