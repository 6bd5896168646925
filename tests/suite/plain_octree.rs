//! An octree written down on the CPU from its leaves, by the layout that `data::octree` draws and
//! without any stage, for tests of what reads octrees.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;
use octolume::data::albedo::ALBEDO_CODE_ONE;
use octolume::data::grid::morton_key;
use octolume::data::octree::{FULL_WEIGHT, OctreeParams, OctreeSizes, mask_words};
use octolume::data::packing::{NORMAL_MAX, unpack_normal};
use octolume::gpu::Gpu;
use octolume::stages::fill::ranked::RankedLeaves;
use octolume::stages::view::march::MarchedOctree;

/// An occupied leaf as stored.
#[derive(Clone, Copy, Debug)]
pub struct Leaf {
    pub occupancy: u32,
    /// A voxel's codes.
    pub color: [u8; 3],
    pub normal: u32,
    pub object: u16,
}

/// Leaves by Morton key.
pub struct PlainOctree {
    pub params: OctreeParams,
    pub leaves: BTreeMap<u32, Leaf>,
}

/// What a node of any level stands for, in f64.
#[derive(Clone, Copy, Debug)]
pub struct Mean {
    pub occupancy: f64,
    pub albedo: DVec3,
    pub normal: DVec3,
}

impl PlainOctree {
    pub fn new(depth: u32, dense_level: u32, leaves: impl IntoIterator<Item = ([u32; 3], Leaf)>) -> Self {
        let leaves: BTreeMap<u32, Leaf> = leaves.into_iter().map(|(cell, leaf)| (morton_key(cell), leaf)).collect();
        let plain = Self { params: OctreeParams::new(depth, dense_level), leaves };
        let mut first_blocks = vec![0];
        for level in dense_level..depth {
            first_blocks.push(first_blocks[first_blocks.len() - 1] + plain.occupied(level).len() as u32);
        }
        let params = plain.params.with_counts(&first_blocks, plain.leaves.len() as u32);
        Self { params, ..plain }
    }

    /// Keys of the occupied nodes of a level.
    pub fn occupied(&self, level: u32) -> BTreeSet<u32> {
        self.leaves.keys().map(|key| key >> (3 * (self.params.depth - level))).collect()
    }

    /// Averages of the leaves below a node; `None` for an empty one.
    pub fn mean(&self, level: u32, key: u32) -> Option<Mean> {
        let below = 3 * (self.params.depth - level);
        let leaves = self.leaves.range(key << below..(key + 1) << below);
        let mut sum = Mean { occupancy: 0.0, albedo: DVec3::ZERO, normal: DVec3::ZERO };
        for leaf in leaves.map(|(_, leaf)| leaf) {
            let weight = f64::from(leaf.occupancy);
            sum.occupancy += weight;
            sum.albedo += weight * DVec3::from_array(leaf.color.map(f64::from)).map(|code| (code / 255.0).powi(2));
            sum.normal += weight * unpack_normal(leaf.normal);
        }
        let full = f64::from(FULL_WEIGHT) * f64::from(1u32 << below);
        let mean = |v: DVec3| v / sum.occupancy;
        (sum.occupancy > 0.0).then(|| Mean {
            occupancy: sum.occupancy / full,
            albedo: mean(sum.albedo),
            normal: mean(sum.normal),
        })
    }

    pub fn upload(&self, gpu: &Gpu) -> MarchedOctree {
        let params = &self.params;
        let (mut occupied, mut blocks) = (vec![0; params.occupied_words() as usize], Vec::new());
        for level in 0..params.depth {
            let mask = mask(level, &self.occupied(level));
            let first = params.levels[level as usize].occupied_word as usize;
            occupied[first..first + mask.len()].copy_from_slice(&mask);
            if level >= params.dense_level {
                blocks.extend(mask);
            }
        }
        let upload = |label: &str, words: &[u32]| gpu.upload(label, words).expect("small");
        let objects: Vec<u32> = self.leaves.values().map(|leaf| 0xffff - u32::from(leaf.object)).collect();
        MarchedOctree {
            sizes: OctreeSizes::upload(gpu, params).expect("small"),
            ranked: RankedLeaves {
                leaf_bits: upload("leaf bits", &mask(params.depth, &self.occupied(params.depth))),
                ranks: upload("ranks", &exclusive_sums(&blocks)),
                blocks: upload("blocks", &blocks),
                block_starts: upload("block starts", &self.block_starts()),
            },
            occupied: upload("occupied", &occupied),
            leaves: upload("leaves", &self.leaf_words()),
            nodes: upload("nodes", bytemuck::cast_slice(&self.nodes())),
            leaf_objects: Some(upload("leaf objects", &objects)),
        }
    }

    fn leaf_words(&self) -> Vec<u32> {
        let words = |leaf: &Leaf| {
            let [r, g, b] = leaf.color.map(|code| 4 * u32::from(code));
            [leaf.occupancy, r | g << 10 | b << 20, leaf.normal]
        };
        self.leaves.values().flat_map(words).collect()
    }

    fn block_starts(&self) -> Vec<u32> {
        let mut starts = Vec::new();
        let mut leaves = 0;
        for block in self.occupied(self.params.depth - 1) {
            starts.extend([0, leaves]);
            leaves += self.leaves.range(8 * block..8 * block + 8).count() as u32;
        }
        starts.extend([0, leaves]);
        starts
    }

    /// Dense levels in Morton order, then the children of each block, block by block.
    fn nodes(&self) -> Vec<[u32; 4]> {
        let node = |level: u32, key: u32| self.mean(level, key).map_or([0; 4], |mean| self.packed(level, &mean));
        let dense = (0..=self.params.dense_level).flat_map(|level| (0..1 << (3 * level)).map(move |key| (level, key)));
        let parents = self.params.dense_level..self.params.depth - 1;
        let sparse = parents.flat_map(|level| {
            let blocks = self.occupied(level).into_iter();
            blocks.flat_map(move |block| (8 * block..8 * block + 8).map(move |key| (level + 1, key)))
        });
        dense.chain(sparse).map(|(level, key)| node(level, key)).collect()
    }

    fn packed(&self, level: u32, mean: &Mean) -> [u32; 4] {
        let below = 3 * (self.params.depth - level);
        let occupancy = (mean.occupancy * f64::from(FULL_WEIGHT) * f64::from(1u32 << below)).round() as u64;
        let pack = |v: DVec3| v.x.round() as u32 | (v.y.round() as u32) << 10 | (v.z.round() as u32) << 20;
        let normal_max = f64::from(NORMAL_MAX);
        [
            occupancy as u32,
            (occupancy >> 32) as u32,
            pack(mean.albedo.map(f64::sqrt) * f64::from(ALBEDO_CODE_ONE)),
            pack(mean.normal * normal_max + normal_max),
        ]
    }
}

fn mask(level: u32, keys: &BTreeSet<u32>) -> Vec<u32> {
    let mut words = vec![0; mask_words(level) as usize];
    for key in keys {
        words[(key >> 5) as usize] |= 1 << (key & 31);
    }
    words
}

fn exclusive_sums(masks: &[u32]) -> Vec<u32> {
    let mut sum = 0;
    let before = |word: &u32| {
        sum += word.count_ones();
        sum - word.count_ones()
    };
    masks.iter().map(before).collect()
}
