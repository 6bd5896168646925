//! Every kernel's output against its reference, on the same world voxels. Each check says what
//! differs; mutations run the same ones.

use std::collections::{BTreeMap, BTreeSet};

use octolume::data::octree::NO_BLOCK;
use octolume::settings::Filter;
use octolume::stages::build::emit_ref::{self, Emitted};
use octolume::stages::build::mark_ref::{self, Marked};
use octolume::stages::build::reduce_ref::{self, Pyramids};
use octolume::stages::build::scan_spread_ref;
use octolume::stages::fill::count_ref::{self, Block};
use octolume::stages::fill::gather_ref::{self, Fragment, Leaf};
use octolume::stages::fill::number_objects::OBJECT_MASK;
use octolume::stages::fill::{gather_heavy_ref, number_objects_ref, place_ref};

use crate::octree_rules::{self as rules, Cell};
use crate::stage_build::{Built, Shape};
use crate::stage_rig::fragment;

pub type Check = Result<(), String>;

pub fn holds(is_so: bool, else_wise: impl FnOnce() -> String) -> Check {
    if is_so { Ok(()) } else { Err(else_wise()) }
}

pub fn same<T: PartialEq + std::fmt::Debug>(what: &str, found: &T, expected: &T) -> Check {
    if found == expected {
        return Ok(());
    }
    let short = |text: String| text.chars().take(300).collect::<String>();
    Err(format!("{what}: {} instead of {}", short(format!("{found:?}")), short(format!("{expected:?}"))))
}

pub fn ensure(holds: bool, sentence: impl FnOnce() -> String) -> Check {
    if holds { Ok(()) } else { Err(sentence()) }
}

/// What the references make of the same world voxels.
pub struct Expected {
    pub fragments: Vec<Option<Fragment>>,
    pub marked: Marked,
    pub pyramids: Pyramids,
    pub emitted: Emitted,
    shape: Shape,
}

impl Expected {
    pub fn new(fragments: Vec<Option<Fragment>>, shape: &Shape) -> Self {
        let marked = mark_ref::mark(quotients(&fragments), shape.depth, shape.filter);
        let pyramids = reduce_ref::reduce(&marked.leaves, shape.depth, shape.dense_level);
        let emitted = emit_ref::emit(&pyramids, shape.dense_level);
        Self { fragments, marked, pyramids, emitted, shape: *shape }
    }

    /// Every kernel's output against its reference.
    pub fn check(&self, built: &Built) -> Check {
        self.check_mark(built)?;
        self.check_pyramids(built)?;
        rules::check_scan(built)?;
        self.check_emit(built)?;
        self.check_sort(built)?;
        self.check_leaves(built)?;
        rules::check_nodes(built)
    }

    pub fn check_mark(&self, built: &Built) -> Check {
        let depth = self.shape.depth;
        same("leaf bits", &rules::cells_of(&built.leaf_bits, depth), &self.marked.leaves)?;
        same("clipped weight", &u128::from(built.clipped), &self.marked.clipped)?;
        same("leaves", &built.occupied_counts[depth as usize], &(self.marked.leaves.len() as u64))
    }

    pub fn check_pyramids(&self, built: &Built) -> Check {
        let counts: Vec<u64> = self.pyramids.occupied.iter().map(|cells| cells.len() as u64).collect();
        same("occupied nodes of each level", &built.occupied_counts, &counts)?;
        for level in 0..self.shape.depth {
            let occupied = rules::occupied_cells(built, level);
            same(&format!("O({level})"), &occupied, &self.pyramids.occupied[level as usize])?;
            if level >= self.shape.dense_level {
                let allocated = rules::allocated_cells(built, level);
                same(&format!("A({level})"), &allocated, &self.pyramids.allocated[level as usize])?;
            }
        }
        Ok(())
    }

    pub fn check_emit(&self, built: &Built) -> Check {
        let dense = self.shape.dense_level;
        let firsts = (dense..self.shape.depth).map(|level| built.params.levels[level as usize].first_block);
        let firsts: Vec<u32> = firsts.chain([built.params.block_count]).collect();
        same("first blocks", &firsts, &self.emitted.first_blocks)?;
        same("block keys", &built.block_keys, &self.emitted.block_keys)?;
        same("child pointers", &built.first_child, &self.emitted.first_child)?;
        let leaf_counts: Vec<u32> = built.block_counts.iter().map(|counts| counts[1]).collect();
        same("leaves a block", &leaf_counts, &self.emitted.leaf_counts)
    }

    /// The counting sort: counts, starts, and who lies where; the order inside a block is free.
    pub fn check_sort(&self, built: &Built) -> Check {
        let (depth, filter) = (self.shape.depth, self.shape.filter);
        let counts = count_ref::count(quotients(&self.fragments), depth, filter);
        let blocks = rules::leaf_blocks(built);
        let expected: Vec<u32> = blocks.iter().map(|b| counts.get(b).copied().unwrap_or(0) as u32).collect();
        let found: Vec<u32> = built.block_counts.iter().map(|counts| counts[0]).collect();
        same("voxels a block", &found, &expected)?;
        for channel in 0..2 {
            let values: Vec<u32> = built.block_counts.iter().map(|counts| counts[channel]).collect();
            let starts: Vec<u64> = built.block_starts.iter().map(|starts| u64::from(starts[channel])).collect();
            same("block starts", &starts, &scan_spread_ref::prefixes(&values))?;
        }
        let known: BTreeSet<Block> = blocks.iter().copied().collect();
        let all = counts.keys().find(|block| !known.contains(*block));
        ensure(all.is_none(), || format!("block {all:?} is not allocated, its voxels are lost"))?;
        self.check_places(built, &blocks)?;
        let heavy: BTreeSet<Block> = built.heavy_blocks.iter().map(|&block| blocks[block as usize]).collect();
        same("heavy blocks listed once", &heavy.len(), &built.heavy_blocks.len())?;
        same("heavy blocks", &heavy, &gather_heavy_ref::heavy(&counts, &known, filter))
    }

    fn check_places(&self, built: &Built, blocks: &[Block]) -> Check {
        let of = |f: &Option<Fragment>| f.and_then(|f| count_ref::block_of(f.q, self.shape.depth, self.shape.filter));
        let voxel_blocks: Vec<Option<Block>> = self.fragments.iter().map(of).collect();
        let mut placed = vec![BTreeSet::new(); blocks.len()];
        for (voxel, [block, place]) in built.places.iter().enumerate() {
            if *block == NO_BLOCK {
                continue;
            }
            placed[*block as usize].insert(voxel);
            let sorted = (built.block_starts[*block as usize][0] + place) as usize;
            same("sorted voxel", &fragment(built.sorted_voxels[sorted]), &self.fragments[voxel])?;
        }
        let expected = place_ref::place(&voxel_blocks, blocks);
        same("voxels of each block", &placed, &expected)
    }

    /// Leaves by object; `objects` is that of every voxel.
    pub fn check_objects(&self, built: &Built, objects: &[u32]) -> Check {
        let seen = self.fragments.iter().zip(objects).filter_map(|(f, object)| Some(((*f)?.q, *object)));
        let expected = number_objects_ref::number(seen, self.shape.depth, self.shape.filter);
        let found: BTreeMap<Cell, u32> = rules::leaf_slots(built)
            .map(|(cell, slot)| (cell, OBJECT_MASK - (built.leaf_objects[slot] & OBJECT_MASK)))
            .collect();
        same("leaves by object", &found, &expected)
    }

    pub fn check_leaves(&self, built: &Built) -> Check {
        let sums = gather_ref::sums(self.fragments.iter().flatten().copied(), self.shape.depth, self.shape.filter);
        let expected: BTreeMap<Cell, Leaf> = sums.into_iter().map(|(cell, sum)| (cell, sum.resolve())).collect();
        let found = rules::leaves(built)?;
        for (cell, leaf) in &expected {
            same(&format!("leaf {cell:?}"), &found.get(cell), &Some(leaf))?;
        }
        same("leaves", &found.len(), &expected.len())
    }

    pub fn filter(&self) -> Filter {
        self.shape.filter
    }
}

pub fn quotients(fragments: &[Option<Fragment>]) -> impl Iterator<Item = Option<[i64; 3]>> + '_ {
    fragments.iter().map(|fragment| fragment.map(|fragment| fragment.q))
}
