//! The chain of pages that world voxels live in (section 4.2).
//!
//! ```text
//! page 0                 page 1                 page 2 …      all the same size
//! ├─seg─┼─seg─┼─ … ─┤    ├─seg─┼─ … ─┤          one segment belongs to one part of an object
//! slot = page · PAGE_SLOTS + segment · SEGMENT_SLOTS + i
//! ```
//!
//! A part takes as many segments as its voxels need, anywhere in the chain; leaving frees them;
//! where none is free a page is appended. Nothing moves, nothing is lost.

use std::collections::{BTreeMap, BTreeSet};

use bytemuck::{Pod, Zeroable};

use crate::gpu::{Constant, GpuBuffer, Kernel, Mirror, PassBuilder, constants, mirror};

/// Slots of a segment: the unit that changes owners. What small objects leave of one is lost to others, so that a
/// hundred thousand of them still fit a binding of 128 MiB.
pub const SEGMENT_SLOTS: u32 = 64;
/// Segments of a page: 1 MiB of world voxels.
pub const PAGE_SEGMENTS: u32 = 1024;
pub const WORLD_VOXEL_BYTES: u64 = 16;
/// Threads between two entries of the hint table, by which a thread finds its work item.
pub const WORK_HINT_THREADS: u32 = 64;

/// Both words of the place of a slot without a voxel, as a cleared buffer has them: no voxel that reaches the grid lies
/// a whole cell before it along every axis.
pub const NO_VOXEL: u32 = 0;
/// An item whose voxels have an object each, in the words behind the hints from its `first_voxel` on.
pub const OBJECT_BY_VOXEL: u32 = u32::MAX;

pub const CONSTANTS: &[Constant] = constants![
    integer NO_VOXEL,
    integer OBJECT_BY_VOXEL,
    integer WORK_HINT_THREADS,
];

/// Which free segment is taken first. Results do not depend on it; tests show that.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SegmentOrder {
    #[default]
    LowestFirst,
    HighestFirst,
}

/// Who owns which segment.
#[derive(Clone, Debug, Default)]
pub struct Pages {
    pages: u32,
    free: BTreeSet<u32>,
    owned: BTreeMap<u32, Vec<u32>>,
    order: SegmentOrder,
}

impl Pages {
    pub fn new(order: SegmentOrder) -> Self {
        Self { order, ..Self::default() }
    }

    pub fn page_count(&self) -> u32 {
        self.pages
    }

    pub fn slot_count(&self) -> u32 {
        self.pages * PAGE_SEGMENTS * SEGMENT_SLOTS
    }

    pub fn bytes(&self) -> u64 {
        u64::from(self.slot_count()) * WORLD_VOXEL_BYTES
    }

    /// Segments of a part, in the order its voxels fill them; empty for one that is not in.
    pub fn segments(&self, part: u32) -> &[u32] {
        self.owned.get(&part).map_or(&[], Vec::as_slice)
    }

    pub fn parts(&self) -> impl Iterator<Item = u32> + '_ {
        self.owned.keys().copied()
    }

    /// Gives a part its segments. A part that is in already keeps what it has.
    pub fn enter(&mut self, part: u32, voxels: u32) {
        if self.owned.contains_key(&part) {
            return;
        }
        let needed = voxels.div_ceil(SEGMENT_SLOTS) as usize;
        while self.free.len() < needed {
            let first = self.pages * PAGE_SEGMENTS;
            self.free.extend(first..first + PAGE_SEGMENTS);
            self.pages += 1;
        }
        let segments = (0..needed).filter_map(|_| self.take_free()).collect();
        self.owned.insert(part, segments);
    }

    /// Takes a part's segments back.
    pub fn leave(&mut self, part: u32) {
        self.free.extend(self.owned.remove(&part).unwrap_or_default());
    }

    fn take_free(&mut self) -> Option<u32> {
        match self.order {
            SegmentOrder::LowestFirst => self.free.pop_first(),
            SegmentOrder::HighestFirst => self.free.pop_last(),
        }
    }

    /// Every segment has one owner or is free, none both.
    pub fn validate(&self) -> Result<(), String> {
        let mut seen = self.free.clone();
        for (part, segments) in &self.owned {
            for &segment in segments {
                if !seen.insert(segment) {
                    return Err(format!("segment {segment} of part {part} has another owner or is free"));
                }
            }
        }
        let all = self.pages * PAGE_SEGMENTS;
        if seen.len() as u32 == all {
            Ok(())
        } else {
            Err(format!("{} of {all} segments are lost", all - seen.len() as u32))
        }
    }
}

/// A run of slots that one part fills. Mirror of `WorkItem` in shaders/shared/work_list.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct WorkItem {
    pub first_thread: u32,
    pub first_slot: u32,
    /// Into the uploaded caches.
    pub first_voxel: u32,
    pub part: u32,
    /// Object number in the scene, or [`OBJECT_BY_VOXEL`].
    pub object: u32,
}

pub const MIRRORS: &[Mirror] =
    &[mirror!(WorkItem, "shared/work_list.wgsl", "WorkItem", first_thread, first_slot, first_voxel, part, object)];

/// World voxels on the GPU and the list that walks them, however they were made.
#[derive(Clone, Debug)]
pub struct ListedVoxels {
    pub work_items: GpuBuffer,
    pub work_hints: GpuBuffer,
    pub parts: GpuBuffer,
    pub world_voxels: GpuBuffer,
    /// One a voxel, or more: slots that hold [`NO_VOXEL`] are walked and left.
    pub threads: u32,
}

impl ListedVoxels {
    /// By the names in shaders/shared/work_list.wgsl.
    pub fn bind<'r>(&self, pass: PassBuilder<'r, Kernel>) -> PassBuilder<'r, Kernel> {
        pass.bind("work_items", &self.work_items)
            .bind("work_hints", &self.work_hints)
            .bind("world_voxels", &self.world_voxels)
    }
}

/// A part that has something to move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorkPart {
    pub part: u32,
    pub object: u32,
    /// Into the uploaded caches.
    pub first_voxel: u32,
    pub voxels: u32,
}

/// What the GPU walks: one thread a voxel, without padding.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WorkList {
    /// Runs in thread order and a sentinel.
    pub items: Vec<WorkItem>,
    /// Item of thread 0, 64, 128 …
    pub hints: Vec<u32>,
    pub threads: u32,
}

impl WorkList {
    /// `parts` in thread order.
    pub fn new(pages: &Pages, parts: impl IntoIterator<Item = WorkPart>) -> Self {
        let mut list = Self::default();
        for part in parts {
            list.push_part(pages.segments(part.part), part);
        }
        list.close();
        list
    }

    /// The same and, behind it, an item of `voxels` that were made from posed triangles and lie from `first_slot` on.
    /// Returns the number of the first of them too, where their objects lie behind the hints: an even one.
    pub fn with_posed(&self, voxels: u32, first_slot: u32, part: u32) -> (Self, u32) {
        let first_thread = self.threads;
        let threads = first_thread + voxels;
        let first_voxel = threads.div_ceil(WORK_HINT_THREADS).next_multiple_of(2);
        let mut list = Self { items: self.items.clone(), hints: Vec::new(), threads };
        list.items.pop();
        list.items.push(WorkItem { first_thread, first_slot, first_voxel, part, object: OBJECT_BY_VOXEL });
        list.close();
        (list, first_voxel)
    }

    /// Nothing follows.
    fn close(&mut self) {
        self.items.push(WorkItem { first_thread: u32::MAX, ..WorkItem::zeroed() });
        let item_of = |thread| self.items.partition_point(|item| item.first_thread <= thread) as u32 - 1;
        self.hints =
            (0..self.threads.div_ceil(WORK_HINT_THREADS)).map(|hint| item_of(hint * WORK_HINT_THREADS)).collect();
    }

    fn push_part(&mut self, segments: &[u32], WorkPart { part, object, first_voxel, voxels }: WorkPart) {
        let mut done = 0;
        let mut previous = None;
        for &segment in segments {
            // Segments that follow one another make one run.
            if previous.is_none_or(|previous: u32| previous + 1 != segment) {
                let first_thread = self.threads + done;
                let first_slot = segment * SEGMENT_SLOTS;
                self.items.push(WorkItem { first_thread, first_slot, first_voxel: first_voxel + done, part, object });
            }
            previous = Some(segment);
            done += SEGMENT_SLOTS.min(voxels - done);
        }
        self.threads += done;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn freed_segments_are_reused_and_none_is_lost() {
        let mut pages = Pages::default();
        pages.enter(0, 1000);
        pages.enter(1, SEGMENT_SLOTS * PAGE_SEGMENTS);
        assert_eq!(pages.page_count(), 2);
        let freed = pages.segments(0).to_vec();
        pages.leave(0);
        pages.enter(2, 1000);
        assert_eq!(pages.segments(2), freed);
        assert_eq!(pages.page_count(), 2);
        pages.validate().unwrap();
    }

    #[test]
    fn work_list_has_one_thread_a_voxel() {
        let mut pages = Pages::default();
        pages.enter(0, 300);
        pages.enter(1, 10);
        pages.leave(0);
        pages.enter(2, 700);
        let work = |part, first_voxel, voxels| WorkPart { part, object: 7, first_voxel, voxels };
        let list = WorkList::new(&pages, [work(1, 300, 10), work(2, 310, 700)]);
        assert_eq!(list.threads, 710);
        // Part 2 takes the two freed segments and one behind part 1's.
        assert_eq!(list.items.len(), 4);
        assert_eq!(list.items[1], WorkItem { first_thread: 10, first_slot: 0, first_voxel: 310, part: 2, object: 7 });
        assert_eq!(list.items[2].first_thread, 10 + 300_u32.div_ceil(SEGMENT_SLOTS) * SEGMENT_SLOTS);
        assert_eq!(list.hints.len(), 12);
    }

    #[test]
    fn posed_voxels_follow_the_moved_ones_and_their_objects_follow_the_hints() {
        let mut pages = Pages::default();
        pages.enter(0, 70);
        let work = WorkPart { part: 0, object: 7, first_voxel: 300, voxels: 70 };
        let (list, first_voxel) = WorkList::new(&pages, [work]).with_posed(100, pages.slot_count(), 1);
        assert_eq!((list.threads, list.hints), (170, vec![0, 0, 1]));
        assert_eq!(first_voxel, 4);
        let object = OBJECT_BY_VOXEL;
        let first_slot = SEGMENT_SLOTS * PAGE_SEGMENTS;
        assert_eq!(list.items[1], WorkItem { first_thread: 70, first_slot, first_voxel, part: 1, object });
        assert_eq!((list.items.len(), list.items[2].first_thread), (3, u32::MAX));
    }
}
