//! Exclusive prefix sums of any length: sum chunks, scan the sums, spread them again. Serial inside
//! a chunk of 64, which two CPU cores prefer to barriers.

use super::{SCAN_CHUNK, scan_spread, scan_sum};
use crate::data::octree::Slot;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};

/// What is summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scanned {
    /// The set bits of each word.
    Bits,
    /// The words themselves.
    Words,
    /// The words themselves, as two interleaved sequences.
    Pairs,
}

impl Scanned {
    pub fn channels(self) -> u32 {
        match self {
            Self::Bits | Self::Words => 1,
            Self::Pairs => 2,
        }
    }

    pub fn constants(self, first: bool) -> [(&'static str, f64); 2] {
        // Above the first level, bits have become sums.
        let bits = first && self == Self::Bits;
        [("POPCOUNT", f64::from(u8::from(bits))), ("CHANNELS", f64::from(self.channels()))]
    }
}

/// `prefixes` gets `count + 1` entries a channel, the totals last. `sums` holds the chunk sums of
/// every level of the recursion.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    (scanned, count): (Scanned, u32),
    values: &GpuBuffer,
    prefixes: &GpuBuffer,
    sums: &mut Vec<Slot>,
) -> Result<(), GpuError> {
    let mut levels = vec![(values.clone(), prefixes.clone(), count)];
    let mut entries = count;
    while entries > SCAN_CHUNK {
        entries = entries.div_ceil(SCAN_CHUNK);
        let index = 2 * (levels.len() - 1);
        sums.resize_with(sums.len().max(index + 2), Slot::default);
        let bytes = 4 * u64::from(scanned.channels()) * u64::from(entries + 1);
        let chunk_sums = sums[index].ensure(gpu, "scan chunk sums", bytes)?;
        let chunk_prefixes = sums[index + 1].ensure(gpu, "scan chunk prefixes", bytes)?;
        levels.push((chunk_sums, chunk_prefixes, entries));
    }
    for (level, pair) in levels.windows(2).enumerate() {
        let (from, _, count) = &pair[0];
        scan_sum::record(gpu, frame, scanned.constants(level == 0), *count, from, &pair[1].0);
    }
    for level in (0..levels.len()).rev() {
        let (from, to, count) = &levels[level];
        // The topmost level is one chunk, which starts at zero and reads no chunk prefixes.
        let above = levels.get(level + 1).map_or(from, |(_, prefixes, _)| prefixes);
        scan_spread::record(gpu, frame, scanned.constants(level == 0), *count, (from, above, to));
    }
    Ok(())
}
