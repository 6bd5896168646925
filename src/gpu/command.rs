//! What a command is to the job that runs it: how much work, how it is cut, what it is called.

use std::sync::Mutex;

use super::cost::{Cost, KernelTiming};
use super::lock::lock;
use super::recorder::Command;

/// Clearing and copying, cautiously.
const NS_PER_BYTE: f64 = 0.25;

impl Command {
    /// Units of work, what one costs, and what their number in a cut is a multiple of.
    pub(super) fn shape(&self) -> (u64, f64, u64) {
        match self {
            Self::Pass(pass) => {
                let ns_per_thread = lock(&pass.kernel.cost).ns_per_thread();
                // A range that a kernel knows nothing of cannot be cut.
                let step = if pass.kernel.ranged { u64::from(pass.kernel.workgroup_size[0]) } else { u64::MAX };
                (u64::from(pass.threads), ns_per_thread, step)
            }
            Self::Raster { draws, .. } => {
                let vertices: u64 = draws.iter().map(|draw| u64::from(draw.vertices)).sum();
                let ns_per_vertex = draws.first().map_or(0.0, |draw| lock(&draw.kernel.cost).ns_per_thread());
                // Without draws there is still the clearing.
                (vertices.max(1), ns_per_vertex, 3)
            }
            Self::Clear { bytes, .. } | Self::Copy { bytes, .. } => (*bytes, NS_PER_BYTE, 4),
        }
    }

    pub(super) fn max_units(&self) -> u64 {
        self.cost().map_or(u64::MAX, |cost| lock(cost).max_threads())
    }

    /// Where its measured times go.
    pub(super) fn cost(&self) -> Option<&Mutex<Cost>> {
        match self {
            Self::Pass(pass) => Some(&pass.kernel.cost),
            Self::Raster { draws, .. } => draws.first().map(|draw| &draw.kernel.cost),
            Self::Clear { .. } | Self::Copy { .. } => None,
        }
    }

    /// What counters and timings call it.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Pass(pass) => pass.kernel.name.clone(),
            Self::Raster { draws, .. } => {
                draws.first().map_or("clear picture".to_owned(), |draw| draw.kernel.name.clone())
            }
            Self::Clear { buffer, .. } => format!("clear {}", buffer.label()),
            Self::Copy { from, .. } => format!("copy {}", from.label()),
        }
    }

    pub(super) fn timing(&self, group: u32) -> KernelTiming {
        let (bytes_moved, threads) = match self {
            Self::Pass(pass) => (pass.bytes_moved, u64::from(pass.threads)),
            Self::Raster { draws, .. } => (0, draws.iter().map(|draw| u64::from(draw.vertices)).sum()),
            Self::Clear { bytes, .. } => (*bytes, 0),
            Self::Copy { bytes, .. } => (2 * bytes, 0),
        };
        KernelTiming { group, kernel: self.name(), ms: 0.0, bytes_moved, threads }
    }
}
