//! A built octree read as a person reads it, and the rules that hold whatever it holds: one key a
//! node, pointers in range, means of children, conserved volume, dummies where samples need them.

use std::collections::{BTreeMap, BTreeSet};

use octolume::data::grid::{morton_cell, morton_key};
use octolume::data::octree::{FULL_WEIGHT, mask_words};
use octolume::stages::averaging::average_ref::{self, Node};
use octolume::stages::build::{reduce_ref, scan_spread_ref};
use octolume::stages::fill::count_ref::Block;
use octolume::stages::fill::gather_ref::{self, Fragment, Leaf};

use crate::stage_build::Built;
use crate::stage_checks::{Check, Expected, ensure, same};

pub type Cell = [u32; 3];

/// The f32 sums of a node: 8 products and sums, one conversion and one quotient, below 32 roundings
/// of 2^-24 each, of values up to 1022.
const NODE_SLACK: f64 = 32.0 * 1022.0 / (1 << 24) as f64;

/// Cells whose bit is set in a level's words.
pub fn cells_of(words: &[u32], level: u32) -> BTreeSet<Cell> {
    let bits = words.iter().zip(0..).filter(|(word, _)| **word != 0);
    let keys =
        bits.flat_map(|(word, index)| (0..32).filter(move |bit| word >> bit & 1 == 1).map(move |b| 32 * index + b));
    keys.inspect(|key| assert!(*key < 1 << (3 * level), "a bit past the end of level {level}"))
        .map(morton_cell)
        .collect()
}

pub fn occupied_cells(built: &Built, level: u32) -> BTreeSet<Cell> {
    let first = built.params.levels[level as usize].occupied_word as usize;
    cells_of(&built.occupied[first..][..mask_words(level) as usize], level)
}

pub fn allocated_cells(built: &Built, level: u32) -> BTreeSet<Cell> {
    let first = built.params.levels[level as usize].blocks_word as usize;
    cells_of(&built.blocks[first..][..mask_words(level) as usize], level)
}

/// Ranks are the exclusive prefix sums of the set bits.
pub fn check_scan(built: &Built) -> Check {
    let bits: Vec<u32> = built.blocks.iter().map(|word| word.count_ones()).collect();
    let ranks: Vec<u64> = built.ranks.iter().copied().map(u64::from).collect();
    same("ranks", &ranks, &scan_spread_ref::prefixes(&bits))
}

/// Coordinates of the leaf blocks, in order.
pub fn leaf_blocks(built: &Built) -> Vec<Block> {
    let first = built.params.levels[built.params.depth as usize - 1].first_block as usize;
    built.block_keys[first..].iter().copied().map(morton_cell).collect()
}

/// Cell and payload slot of every occupied leaf: the block's first leaf + rank in the block.
pub fn leaf_slots(built: &Built) -> impl Iterator<Item = (Cell, usize)> + '_ {
    leaf_blocks(built).into_iter().zip(&built.block_starts).flat_map(|(block, [_, first])| {
        let first_key = 8 * morton_key(block);
        let occupied = |key: &u32| built.leaf_bits[(key / 32) as usize] >> (key % 32) & 1 == 1;
        (first_key..first_key + 8).filter(occupied).map(morton_cell).zip(*first as usize..)
    })
}

/// Every occupied leaf's payload.
pub fn leaves(built: &Built) -> Result<BTreeMap<Cell, Leaf>, String> {
    let mut found = BTreeMap::new();
    for (cell, slot) in leaf_slots(built) {
        let Some([occupancy, albedo, normal]) = built.leaves.get(slot).copied() else {
            return Err(format!("leaf slot {slot} of {} slots", built.leaves.len()));
        };
        let leaf = Leaf {
            occupancy,
            albedo: [0, 10, 20].map(|shift| albedo >> shift & 0x3ff),
            normal: [0, 10, 20].map(|shift| normal >> shift & 0x3ff),
        };
        same("unused bits of a leaf", &(albedo >> 30, normal >> 30), &(0, 0))?;
        found.insert(cell, leaf);
    }
    Ok(found)
}

pub fn node(words: [u32; 4]) -> Node {
    let tens = |word: u32| [0, 10, 20].map(|shift| f64::from(word >> shift & 0x3ff));
    let occupancy = u128::from(words[0]) | u128::from(words[1]) << 32;
    Node { occupancy, albedo: tens(words[2]), normal: tens(words[3]) }
}

/// Index of every inner node by walking child pointers from the root down.
pub fn walk(built: &Built) -> Result<BTreeMap<(u32, Cell), u32>, String> {
    let params = &built.params;
    let mut found = BTreeMap::new();
    for level in 0..=params.dense_level {
        let first = params.levels[level as usize].first_node;
        found.extend((0..1 << (3 * level)).map(|key| ((level, morton_cell(key)), first + key)));
    }
    for level in params.dense_level..params.depth - 1 {
        let parents: Vec<_> = found.range((level, [0; 3])..(level + 1, [0; 3])).map(|(k, v)| (k.1, *v)).collect();
        for (cell, index) in parents {
            let child = *built.first_child.get(index as usize).ok_or(format!("node {index} has no pointer word"))?;
            let children =
                (0..if child == 0 { 0 } else { 8 }).map(|i| (morton_cell(8 * morton_key(cell) + i), child + i));
            found.extend(children.map(|(cell, index)| ((level + 1, cell), index)));
        }
    }
    Ok(found)
}

/// Every node one key, every key one node, pointers in range, downwards and so acyclic.
pub fn validate(built: &Built) -> Check {
    let params = &built.params;
    let nodes = walk(built)?;
    let indices: BTreeSet<u32> = nodes.values().copied().collect();
    same("nodes reached, each once", &indices.len(), &nodes.len())?;
    same("nodes reached of those stored", &indices.len(), &(params.inner_node_count as usize))?;
    same("highest node", &indices.last().copied(), &params.inner_node_count.checked_sub(1))?;
    let level_of: BTreeMap<u32, u32> = nodes.iter().map(|((level, _), index)| (*index, *level)).collect();
    let mut pointed = BTreeSet::new();
    for (index, &child) in built.first_child.iter().enumerate().filter(|(_, child)| **child != 0) {
        let parent_level = level_of[&(index as u32)];
        let block =
            child.checked_sub(params.dense_node_count).filter(|offset| offset % 8 == 0).map(|offset| offset / 8);
        let in_range = block.filter(|block| *block < params.block_count);
        let Some(block) = in_range else { return Err(format!("node {index} points to {child}")) };
        ensure(pointed.insert(block), || format!("block {block} has two parents"))?;
        let down = level_of.get(&child).copied().unwrap_or(params.depth);
        same("level of a child", &down, &(parent_level + 1))?;
    }
    same("blocks with a parent", &pointed.len(), &(params.block_count as usize))
}

/// Every inner node against the mean of its children, as they are stored.
pub fn check_nodes(built: &Built) -> Check {
    let (depth, index) = (built.params.depth, walk(built)?);
    let leaves = leaves(built)?;
    let leaf_node = |cell: &Cell| {
        let leaf = leaves.get(cell)?;
        let albedo = leaf.albedo.map(f64::from);
        Some(Node { occupancy: leaf.occupancy.into(), albedo, normal: leaf.normal.map(f64::from) })
    };
    for ((level, cell), node_index) in &index {
        let child = |i| morton_cell(8 * morton_key(*cell) + i);
        let below = |cell: Cell| match level + 1 == depth {
            true => leaf_node(&cell),
            false => index.get(&(level + 1, cell)).map(|index| node(built.nodes[*index as usize])),
        };
        let children: Vec<Node> = (0..8).filter_map(|i| below(child(i))).collect();
        let found = built.nodes[*node_index as usize];
        check_node(&node(found), &average_ref::average(&children))
            .map_err(|difference| format!("node {cell:?} of level {level}: {difference}"))?;
        ensure(found[0] | found[1] != 0 || found == [0; 4], || format!("an empty node holds {found:?}"))?;
    }
    Ok(())
}

fn check_node(found: &Node, expected: &Node) -> Check {
    same("occupancy", &found.occupancy, &expected.occupancy)?;
    let pairs = found.albedo.iter().zip(&expected.albedo).chain(found.normal.iter().zip(&expected.normal));
    let furthest = pairs.map(|(found, expected)| (found - expected).abs()).fold(0.0, f64::max);
    ensure(furthest <= 0.5 + NODE_SLACK, || format!("{furthest} units off: {found:?} instead of {expected:?}"))
}

/// Occupied volume is the same at every level; kept + clipped = total, and what clamping took is
/// what the leaves' raw sums exceed a full cell by; what surfaces leave uncovered is not kept.
pub fn check_conservation(built: &Built, expected: &Expected) -> Check {
    let leaves: u128 = leaves(built)?.values().map(|leaf| u128::from(leaf.occupancy)).sum();
    let mut levels = vec![0_u128; built.params.depth as usize];
    for ((level, _), index) in walk(built)? {
        levels[level as usize] += node(built.nodes[index as usize]).occupancy;
    }
    same("occupied volume of each level", &levels, &vec![leaves; levels.len()])?;
    let total = u128::from(FULL_WEIGHT) * expected.fragments.len() as u128;
    let sums = gather_ref::sums(expected.fragments.iter().flatten().copied(), built.params.depth, expected.filter());
    let excess: u128 = sums.values().map(|sum| sum.weight.saturating_sub(FULL_WEIGHT.into())).sum();
    let whole = expected.fragments.iter().flatten().map(|voxel| Fragment { coverage: 255, ..*voxel });
    let weight = |sums: &BTreeMap<_, gather_ref::LeafSum>| sums.values().map(|sum| sum.weight).sum::<u128>();
    let uncovered = weight(&gather_ref::sums(whole, built.params.depth, expected.filter())) - weight(&sums);
    same("kept + clipped + excess + uncovered", &(leaves + u128::from(built.clipped) + excess + uncovered), &total)
}

/// For every occupied node of every level the eight corners of an interpolation whose sample was
/// rounded down to it or to one of its backward neighbours exist at that level, grid's end aside.
pub fn check_interpolation_corners(built: &Built) -> Check {
    let depth = built.params.depth;
    let index = walk(built)?;
    let blocks: BTreeSet<Block> = leaf_blocks(built).into_iter().collect();
    let stored = |level: u32, cell: Cell| match level == depth {
        true => blocks.contains(&cell.map(|c| c / 2)),
        false => index.contains_key(&(level, cell)),
    };
    for level in 1..=depth {
        let occupied = if level == depth { cells_of(&built.leaf_bits, depth) } else { occupied_cells(built, level) };
        for cell in occupied {
            for base in reduce_ref::backward_dilate(&BTreeSet::from([cell])) {
                ensure(stored(level, base), || format!("level {level}: {cell:?} lacks its dummy {base:?}"))?;
            }
        }
    }
    Ok(())
}
