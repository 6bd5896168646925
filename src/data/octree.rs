//! The partly dense sparse voxel octree (section 4.3): index arithmetic; `octree_buffers` holds it.
//!
//! ```text
//! level 0 … dense     nodes stored densely, in Morton order
//! dense+1 … depth     nodes in blocks of 8 children; block r's are nodes dense_nodes + 8r … + 7
//!
//! leaf_bits   1 bit a leaf cell, Morton order: a byte is the child mask of a node one level up
//! occupied    1 bit a node, levels 0 … depth−1        O(l): something is below
//! blocks      1 bit a node, levels dense … depth−1    A(l): its children are allocated
//! ranks       blocks' exclusive prefix sum, a number a word, the total at the end
//! block_keys  Morton key of the node above each block, all levels in order
//! first_child 1 word an inner node: index of its first child, 0 = none
//! nodes       4 words an inner node, see shaders/shared/node.wgsl
//! block_counts  2 words a leaf block: its sorted voxels (in the topology's 0, the payload counts), its leaves
//! block_starts  2 words a leaf block: its first sorted voxel, its first leaf; totals at the end
//! leaves      3 words an *occupied* leaf: occupancy (2^24 = full), albedo and normal 10|10|10
//! neighbours  3 words a block: rank of the block ahead along x, y, z; NO_BLOCK = none (section 4.4)
//! node_neighbours  3 words a sparse node, leaves too: index of the node ahead, as in the paper
//! ```
//!
//! Order is key order: the same in every run. Leaves (level `depth`) have no node payload, though
//! indices count them on; the blocks of level depth−1 are called leaf blocks.

use bytemuck::{Pod, Zeroable};

use crate::gpu::{Constant, Mirror, constants, mirror};

pub use super::octree_buffers::{MaskBuffers, OctreeRef, OctreeSizes, PayloadBuffers, TopologyBuffers};
pub use super::slot::Slot;

/// Weight of a voxel that lies wholly in one cell: 2^(3k), k = 8 fraction bits an axis.
pub const FULL_WEIGHT: u32 = 1 << (3 * FRACTION_BITS);
/// k: fraction bits a transformed voxel keeps per axis.
pub const FRACTION_BITS: u32 = 8;
/// Cells along an axis that keys and packed positions can hold.
pub const MAX_DEPTH: u32 = 10;
/// "Not allocated", wherever a block or node index may be absent.
pub const NO_BLOCK: u32 = u32::MAX;
/// Voxels that one thread may sum without a carry: 1024 · 256 · 16256 < 2^32, by three bytes of the weight for albedo,
/// and 1024 · 4096 · 1022 by two halves of it for normals.
pub const MAX_FRAGMENTS: u32 = 1024;

pub const CONSTANTS: &[Constant] = constants![
    integer FRACTION_BITS,
    integer FRACTION_ONE = 1 << FRACTION_BITS,
    integer FULL_WEIGHT,
    integer MAX_FRAGMENTS,
    integer NO_BLOCK,
];

/// What a prediction adds to each count, beside a share.
pub const ROOM: u32 = 64;

const LEVEL_SLOTS: usize = 12;

/// Mirror of `OctreeLevel` in shaders/shared/octree.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct OctreeLevel {
    pub occupied_word: u32,
    pub blocks_word: u32,
    pub first_block: u32,
    pub first_node: u32,
}

/// Mirror of `OctreeParams` in shaders/shared/octree.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct OctreeParams {
    pub depth: u32,
    pub dense_level: u32,
    pub block_count: u32,
    pub leaf_block_count: u32,
    pub inner_node_count: u32,
    pub leaf_count: u32,
    pub dense_node_count: u32,
    pub pad: u32,
    pub levels: [OctreeLevel; LEVEL_SLOTS],
}

pub const MIRRORS: &[Mirror] = &[
    mirror!(OctreeLevel, "shared/octree.wgsl", "OctreeLevel", occupied_word, blocks_word, first_block, first_node),
    mirror!(
        OctreeParams,
        "shared/octree.wgsl",
        "OctreeParams",
        depth,
        dense_level,
        block_count,
        leaf_block_count,
        inner_node_count,
        leaf_count,
        dense_node_count,
        pad,
        levels
    ),
];

/// Words of one bit a node at a level.
pub fn mask_words(level: u32) -> u32 {
    (1u32 << (3 * level)).div_ceil(32)
}

impl OctreeParams {
    /// What is known before anything is built. `dense_level` is at most `depth − 1`.
    pub fn new(depth: u32, dense_level: u32) -> Self {
        debug_assert!(dense_level < depth && depth <= MAX_DEPTH);
        let mut params = Self { depth, dense_level, ..Self::default() };
        let mut occupied_word = 0;
        let mut blocks_word = 0;
        for level in 0..depth {
            let slot = &mut params.levels[level as usize];
            slot.occupied_word = occupied_word;
            occupied_word += mask_words(level);
            if level <= dense_level {
                slot.first_node = params.dense_node_count;
                params.dense_node_count += 1 << (3 * level);
            }
            if level >= dense_level {
                slot.blocks_word = blocks_word;
                blocks_word += mask_words(level);
            }
        }
        params
    }

    pub fn occupied_words(&self) -> u32 {
        (0..self.depth).map(mask_words).sum()
    }

    pub fn blocks_words(&self) -> u32 {
        (self.dense_level..self.depth).map(mask_words).sum()
    }

    /// Fills in the sizes, once the scan has found them: `first_blocks` of levels dense … depth−1,
    /// then the total.
    pub fn with_counts(mut self, first_blocks: &[u32], leaf_count: u32) -> Self {
        debug_assert_eq!(first_blocks.len() as u32, self.depth - self.dense_level + 1);
        self.block_count = first_blocks[first_blocks.len() - 1];
        let first_leaf_block = first_blocks[first_blocks.len() - 2];
        self.leaf_block_count = self.block_count - first_leaf_block;
        self.inner_node_count = self.dense_node_count + 8 * first_leaf_block;
        self.leaf_count = leaf_count;
        for (level, &first) in (self.dense_level..self.depth).zip(first_blocks) {
            self.levels[level as usize].first_block = first;
            if level > self.dense_level {
                // The children of the level above begin where its blocks begin.
                let above = self.levels[level as usize - 1].first_block;
                self.levels[level as usize].first_node = self.dense_node_count + 8 * above;
            }
        }
        self
    }

    /// A prediction from exact sizes: room for an eighth and [`ROOM`] more blocks of each level, and leaves.
    pub fn with_room(&self) -> Self {
        self.with_each(|count| count.saturating_add(count / 8).saturating_add(ROOM))
    }

    /// With other numbers of each level's blocks, and of leaves; a level has no more blocks than it has nodes.
    pub fn with_each(&self, other: impl Fn(u32) -> u32) -> Self {
        let mut firsts = vec![0];
        for level in self.dense_level..self.depth {
            let blocks = other(self.block_count_of(level)).min(1 << (3 * level));
            firsts.push(firsts[firsts.len() - 1] + blocks);
        }
        self.with_counts(&firsts, other(self.leaf_count).min(1 << (3 * self.depth)))
    }

    /// Whether an octree of these sizes has place in one of those.
    pub fn fits(&self, room: &Self) -> bool {
        let mut levels = self.dense_level..self.depth;
        (self.depth, self.dense_level) == (room.depth, room.dense_level)
            && levels.all(|level| self.block_count_of(level) <= room.block_count_of(level))
            && self.leaf_count <= room.leaf_count
    }

    /// Nodes stored at a level, dummies included; level `depth` is the leaves.
    pub fn node_count(&self, level: u32) -> u32 {
        if level <= self.dense_level { 1 << (3 * level) } else { 8 * self.block_count_of(level - 1) }
    }

    /// Blocks whose parent is at `level`, for levels dense … depth−1.
    pub fn block_count_of(&self, level: u32) -> u32 {
        let first = self.levels[level as usize].first_block;
        if level + 1 == self.depth {
            self.block_count - first
        } else {
            self.levels[level as usize + 1].first_block - first
        }
    }
}

/// Who holds the forward neighbour pointers of section 4.4.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PointerLayout {
    /// One an axis for the eight nodes of a block; theirs follow.
    Blocks,
    /// One an axis and node, as in the paper.
    Nodes,
}

impl PointerLayout {
    /// Size of the pointers of all sparse levels.
    pub fn words(self, octree: &OctreeParams) -> u64 {
        let a_block = match self {
            Self::Blocks => 3,
            Self::Nodes => 24,
        };
        a_block * u64::from(octree.block_count)
    }
}
