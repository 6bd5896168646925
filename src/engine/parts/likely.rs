//! What was counted the last time, by method: what is likely the next time.

use std::collections::HashMap;

use crate::data::fragments::FragmentCounts;
use crate::data::octree::{OctreeParams, ROOM};
use crate::digest::Digest;

#[derive(Debug, Default)]
pub struct Likely {
    last_sizes: HashMap<Digest, OctreeParams>,
    last_glossy_tiles: HashMap<Digest, u32>,
    last_fragments: HashMap<Digest, (FragmentCounts, bool)>,
}

impl Likely {
    pub fn note_sizes(&mut self, method: Digest, counted: OctreeParams) {
        self.last_sizes.insert(method, counted);
    }

    pub fn note_glossy_tiles(&mut self, method: Digest, count: u32) {
        self.last_glossy_tiles.insert(method, count);
    }

    pub fn note_fragments(&mut self, method: Digest, counted: FragmentCounts, lacked_room: bool) {
        self.last_fragments.insert(method, (counted, lacked_room));
    }

    /// Room for an eighth and a few more fragments than the last time, but for no more than `most` that a buffer holds; a
    /// share of that, where estimates are forced to be too small. Where they were, as many as were counted.
    pub fn fragments(&self, method: Digest, share: f64, most: u32) -> Option<FragmentCounts> {
        let (last, lacked_room) = self.last_fragments.get(&method)?;
        if *lacked_room {
            return Some(*last);
        }
        let roomy = |count: u32| (f64::from(count.saturating_add(count / 8).saturating_add(ROOM)) * share) as u32;
        let [columns, fragments, voxels] = [last.columns, last.fragments, last.voxels].map(roomy);
        Some(FragmentCounts { columns, fragments: fragments.min(most.max(last.fragments)), voxels, ..*last })
    }

    /// Room for an octree of about the size of the last one of this method; a share of that, where estimates are
    /// forced to be too small.
    pub fn sizes(&self, method: Digest, share: f64) -> Option<OctreeParams> {
        let roomy = self.last_sizes.get(&method)?.with_room();
        Some(if share < 1.0 { roomy.with_each(|count| (f64::from(count) * share) as u32) } else { roomy })
    }

    pub fn glossy_tiles(&self, method: Digest, share: f64) -> Option<u32> {
        // None needs no kernel; a few more than last time otherwise.
        let roomy = |&count: &u32| if count == 0 { 0 } else { count + count / 8 + 8 };
        self.last_glossy_tiles.get(&method).map(roomy).map(|count| (f64::from(count) * share) as u32)
    }
}
