//! Forward neighbour pointers (section 4.4), once a block or, as in the paper, once a node.

use super::payload::octree;
use super::{Made, Making, Parts, Read};
use crate::data::octree::{PointerLayout, Slot};
use crate::engine::EngineError;
use crate::gpu::{GpuBuffer, Recorder};
use crate::plan::{Part, Pass};
use crate::settings::Lookup;
use crate::stages::build::link::{self, Linked};
use crate::stages::sample::pointer_layout;

#[derive(Debug, Default)]
pub struct BlockLinks {
    pub neighbours: Slot,
}

#[derive(Debug, Default)]
pub struct NodeLinks {
    pub neighbours: Slot,
}

fn record(
    neighbours: &mut Slot,
    layout: PointerLayout,
    (making, parts): (&Making<'_>, &Parts),
    frame: &mut Recorder,
) -> Result<Option<Read>, EngineError> {
    let octree = octree(making, parts)?;
    let linked = Linked {
        blocks: octree.masks.blocks.made("block masks")?,
        ranks: octree.masks.ranks.made("block ranks")?,
        block_keys: octree.topology.block_keys.made("block keys")?,
    };
    let bytes = 4 * layout.words(&octree.sizes.params);
    let neighbours = neighbours.ensure(making.gpu, "neighbour pointers", bytes)?;
    making.begin(frame, Pass::LinkNodes);
    link::record(making.gpu, frame, octree.sizes, &linked, (layout, &neighbours));
    Ok(None)
}

impl Made for BlockLinks {
    const PART: Part = Part::BlockLinks;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        record(&mut self.neighbours, PointerLayout::Blocks, (making, parts), frame)
    }
}

impl Made for NodeLinks {
    const PART: Part = Part::NodeLinks;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        record(&mut self.neighbours, PointerLayout::Nodes, (making, parts), frame)
    }
}

/// The neighbour pointers that a look-up follows, where it follows any and they are linked.
pub fn pointers(making: &Making<'_>, parts: &Parts, lookup: Lookup) -> Option<GpuBuffer> {
    let neighbours = match pointer_layout(lookup)? {
        PointerLayout::Blocks => &parts.get::<BlockLinks>(making.keys)?.neighbours,
        PointerLayout::Nodes => &parts.get::<NodeLinks>(making.keys)?.neighbours,
    };
    neighbours.get().cloned()
}
