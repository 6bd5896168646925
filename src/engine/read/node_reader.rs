//! Single nodes of an octree that is on the GPU, by reading the words that say where they are and what
//! they hold (layout: data::octree). Every answer comes from what is stored; nothing is derived from
//! what should be. In: addresses and indices. Out: indices, addresses, payloads. Each read blocks.

use bytemuck::Pod;
use serde::Serialize;

use super::Built;
use crate::data::albedo::unpack_albedo;
use crate::data::grid::{morton_cell, morton_key};
use crate::data::octree::{FULL_WEIGHT, NO_BLOCK, OctreeParams, Slot, TopologyBuffers};
use crate::data::packing::unpack_normal;
use crate::gpu::{Gpu, GpuError};

/// A node by where it lies: a cell of a level, which has 2^level cells an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub struct NodeAddress {
    pub level: u32,
    pub cell: [u32; 3],
}

impl NodeAddress {
    /// Whether it lies in a grid of 2^`depth` cells an axis.
    pub fn is_in(&self, depth: u32) -> bool {
        self.level <= depth && self.cell.iter().all(|cell| *cell >> self.level == 0)
    }

    /// The node above; `None` above the root.
    pub fn parent(&self) -> Option<Self> {
        Some(Self { level: self.level.checked_sub(1)?, cell: self.cell.map(|cell| cell / 2) })
    }
}

impl std::fmt::Display for NodeAddress {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = self.cell;
        write!(formatter, "level {}, cell {x},{y},{z}", self.level)
    }
}

pub struct NodeReader<'a> {
    pub gpu: &'a Gpu,
    pub octree: &'a OctreeParams,
    pub built: Built<'a>,
    pub topology: &'a TopologyBuffers,
    /// Of blocks.
    pub neighbours: Slot,
}

/// What a node holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Payload {
    /// 0 to 1.
    pub occupancy: f64,
    /// Linear.
    pub albedo: [f64; 3],
    /// Mean: short where normals disagree.
    pub normal: [f64; 3],
}

impl NodeReader<'_> {
    fn read<T: Pod>(&self, slot: &Slot, label: &str, first: u64) -> Result<T, GpuError> {
        let bytes = size_of::<T>() as u64;
        let read: Vec<T> = self.gpu.read(&slot.made(label)?, bytes * first..bytes * (first + 1))?;
        read.first().copied().ok_or_else(|| GpuError::Missing { label: label.to_owned() })
    }

    fn word(&self, slot: &Slot, label: &str, word: u32) -> Result<u32, GpuError> {
        self.read(slot, label, word.into())
    }

    /// Rank of the block that holds the children of a node of `level`, over all levels.
    fn block_of(&self, level: u32, key: u32) -> Result<Option<u32>, GpuError> {
        let word = self.octree.levels[level as usize].blocks_word + (key >> 5);
        let mask = self.word(&self.built.masks.buffers.blocks, "block masks", word)?;
        if mask >> (key & 31) & 1 == 0 {
            return Ok(None);
        }
        let below = mask & ((1 << (key & 31)) - 1);
        Ok(Some(self.word(&self.built.masks.buffers.ranks, "block ranks", word)? + below.count_ones()))
    }

    /// `None` where no node is stored. The address is in the grid.
    pub fn index_of(&self, address: NodeAddress) -> Result<Option<u32>, GpuError> {
        let key = morton_key(address.cell);
        if address.level <= self.octree.dense_level {
            return Ok(Some(self.octree.levels[address.level as usize].first_node + key));
        }
        let block = self.block_of(address.level - 1, key >> 3)?;
        Ok(block.map(|block| self.octree.dense_node_count + 8 * block + (key & 7)))
    }

    /// The block that holds a sparse node, and which of its eight children it is.
    pub fn place(&self, level: u32, index: u32) -> Option<(u32, u32)> {
        let sparse = index.checked_sub(self.octree.dense_node_count).filter(|_| level > self.octree.dense_level)?;
        Some((sparse / 8, sparse % 8))
    }

    /// Where a node lies, as its block says.
    pub fn address_of(&self, level: u32, index: u32) -> Result<NodeAddress, GpuError> {
        let key = match self.place(level, index) {
            Some((block, child)) => 8 * self.word(&self.topology.block_keys, "block keys", block)? + child,
            None => index - self.octree.levels[level as usize].first_node,
        };
        Ok(NodeAddress { level, cell: morton_cell(key) })
    }

    /// Index of the node ahead along an axis: of sparse nodes as their block's pointer says. `None` where
    /// nothing is stored there, or the grid ends.
    pub fn ahead(&self, level: u32, index: u32, axis: u32) -> Result<Option<u32>, GpuError> {
        let first = self.octree.dense_node_count;
        let Some((block, child)) = self.place(level, index) else { return self.dense_ahead(level, index, axis) };
        if child >> axis & 1 == 0 {
            return Ok(Some(first + 8 * block + (child | 1 << axis)));
        }
        let ahead = self.word(&self.neighbours, "neighbour pointers", 3 * block + axis)?;
        Ok((ahead != NO_BLOCK).then(|| first + 8 * ahead + (child & !(1 << axis))))
    }

    /// Dense levels store every node in key order, and no pointers.
    fn dense_ahead(&self, level: u32, index: u32, axis: u32) -> Result<Option<u32>, GpuError> {
        let mut address = self.address_of(level, index)?;
        address.cell[axis as usize] += 1;
        if address.cell[axis as usize] >> level > 0 { Ok(None) } else { self.index_of(address) }
    }

    /// Whether anything is in it: what is stored without is a dummy.
    pub fn is_occupied(&self, address: NodeAddress) -> Result<bool, GpuError> {
        let key = morton_key(address.cell);
        let word = if address.level == self.octree.depth {
            self.word(&self.built.masks.buffers.leaf_bits, "leaf bits", key >> 5)?
        } else {
            let first = self.octree.levels[address.level as usize].occupied_word;
            self.word(&self.built.masks.buffers.occupied, "occupied masks", first + (key >> 5))?
        };
        Ok(word >> (key & 31) & 1 == 1)
    }

    /// Index of the first of eight children; `None` where there are none. Above the last dense level
    /// all are there, in key order, and no pointer is stored.
    pub fn first_child(&self, level: u32, index: u32) -> Result<Option<u32>, GpuError> {
        let levels = &self.octree.levels;
        if level == self.octree.depth {
            return Ok(None);
        }
        if level < self.octree.dense_level {
            let key = index - levels[level as usize].first_node;
            return Ok(Some(levels[level as usize + 1].first_node + 8 * key));
        }
        let child = self.word(&self.topology.first_child, "child pointers", index)?;
        Ok((child != 0).then_some(child))
    }

    /// Where the light of a node that is occupied lies among what is stored of light, and what else it holds.
    pub fn payload(&self, address: NodeAddress, index: u32) -> Result<(u32, Payload), GpuError> {
        let octree = self.octree;
        if address.level == octree.depth {
            let slot = self.leaf_slot(address, index)?;
            let [occupancy, albedo, normal]: [u32; 3] =
                self.read(&self.built.payload.buffers.leaves, "leaves", slot.into())?;
            let occupancy = f64::from(occupancy) / f64::from(FULL_WEIGHT);
            let normal = unpack_normal(normal).to_array();
            return Ok((octree.inner_node_count + slot, Payload { occupancy, albedo: unpack_albedo(albedo), normal }));
        }
        let [low, high, albedo, normal]: [u32; 4] =
            self.read(&self.built.payload.buffers.nodes, "nodes", index.into())?;
        let sum = f64::from(high) * 2_f64.powi(32) + f64::from(low);
        let full = f64::from(FULL_WEIGHT) * 8_f64.powi((octree.depth - address.level) as i32);
        let (albedo, normal) = (unpack_albedo(albedo), unpack_normal(normal).to_array());
        Ok((index, Payload { occupancy: sum / full, albedo, normal }))
    }

    /// Place of an occupied leaf among the occupied leaves.
    fn leaf_slot(&self, address: NodeAddress, index: u32) -> Result<u32, GpuError> {
        let key = morton_key(address.cell);
        let first_leaf_block = self.octree.levels[self.octree.depth as usize - 1].first_block;
        let block = (index - self.octree.dense_node_count) / 8 - first_leaf_block;
        let starts: [u32; 2] = self.read(&self.built.payload.buffers.block_starts, "block starts", block.into())?;
        let mask = self.word(&self.built.masks.buffers.leaf_bits, "leaf bits", key >> 5)? >> (key & 24);
        Ok(starts[1] + (mask & ((1 << (key & 7)) - 1)).count_ones())
    }
}
