//! What a kernel took, beside what its memory traffic alone would take.

use serde::Serialize;

use crate::gpu::KernelTiming;
use crate::spread::Spread;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cost {
    pub kernel: String,
    #[serde(flatten)]
    pub time: Spread,
    /// What the algorithm has to read and write.
    pub bytes: u64,
    pub gb_per_s: f64,
    /// The same bytes at the copy kernel's bandwidth.
    pub floor_ms: f64,
    /// Median over floor; none where nothing need be moved.
    pub ratio: Option<f64>,
}

/// Times and bytes of one kernel, or of all together, a rebuild each.
#[derive(Default)]
pub(super) struct Samples {
    pub ms: Vec<f64>,
    pub bytes: u64,
}

impl Samples {
    pub fn add<'a>(&mut self, timings: impl Iterator<Item = &'a KernelTiming>) {
        let (mut ms, mut bytes) = (0.0, 0);
        for timing in timings {
            ms += timing.ms;
            bytes += timing.bytes_moved;
        }
        self.ms.push(ms);
        self.bytes = bytes;
    }

    pub fn cost(&self, kernel: String, bytes_per_ms: f64) -> Option<Cost> {
        let time = Spread::of(&self.ms)?;
        let floor_ms = self.bytes as f64 / bytes_per_ms;
        let gb_per_s = self.bytes as f64 / time.median_ms / 1e6;
        let ratio = (floor_ms > 0.0).then(|| time.median_ms / floor_ms);
        Some(Cost { kernel, time, bytes: self.bytes, gb_per_s, floor_ms, ratio })
    }
}

impl Cost {
    pub const HEADS: [&'static str; 8] = ["kernel", "median ms", "p5", "p95", "MB", "GB/s", "floor ms", "ratio"];

    pub fn cells(&self) -> Vec<String> {
        let Spread { median_ms, p5_ms, p95_ms } = self.time;
        vec![
            self.kernel.clone(),
            format!("{median_ms:.2}"),
            format!("{p5_ms:.2}"),
            format!("{p95_ms:.2}"),
            format!("{:.1}", self.bytes as f64 / 1e6),
            format!("{:.1}", self.gb_per_s),
            format!("{:.2}", self.floor_ms),
            self.ratio.map_or_else(String::new, |ratio| format!("{ratio:.1}")),
        ]
    }
}
