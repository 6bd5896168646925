//! What is told of light: its passes, its samples a second, its memory.

use serde::Serialize;

use crate::experiment::cost::Cost;
use crate::experiment::table::Table;
use crate::settings::{Lookup, Sampling};
use crate::spread::Spread;

#[derive(Clone, Default, Serialize)]
pub struct LightReport {
    pub passes: Vec<Cost>,
    pub sampling: Vec<SamplingCost>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub memory: Option<MemoryReport>,
}

/// Bytes of the octree on screen and of its light, and how many a node has.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MemoryReport {
    /// Stored nodes, leaves and dummies included.
    pub nodes: u64,
    pub octree_bytes: u64,
    pub light_bytes: u64,
    pub block_pointer_bytes: u64,
    pub node_pointer_bytes: u64,
    pub bytes_per_node: f64,
    /// With pointers stored with every node, as in the paper.
    pub bytes_per_node_with_node_pointers: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SamplingCost {
    pub sampling: Sampling,
    pub lookup: Lookup,
    /// Near occupied leaves, or anywhere in the grid.
    pub near_leaves: bool,
    #[serde(flatten)]
    pub time: Spread,
    pub million_samples_per_s: f64,
    pub bytes: u64,
}

impl LightReport {
    pub(in crate::experiment) fn tables(&self) -> [Table; 2] {
        let passes = Table::new("light", &Cost::HEADS, self.passes.iter().map(Cost::cells));
        let sampling = self.sampling.iter().map(SamplingCost::cells);
        [passes, Table::new("sampling", &SamplingCost::HEADS, sampling)]
    }
}

impl SamplingCost {
    pub const HEADS: [&'static str; 5] = ["sampling", "nodes found by", "where", "median ms", "million samples/s"];

    pub fn cells(&self) -> Vec<String> {
        let lookup = match self.lookup {
            Lookup::Ranks => "ranks",
            Lookup::BlockPointers => "pointers a block",
            Lookup::NodePointers => "pointers a node",
        };
        vec![
            format!("{:?}", self.sampling).to_lowercase(),
            lookup.to_owned(),
            if self.near_leaves { "at leaves" } else { "anywhere" }.to_owned(),
            format!("{:.1}", self.time.median_ms),
            format!("{:.1}", self.million_samples_per_s),
        ]
    }
}
