//! Lists marked tiles in order.

use crate::gpu::{Gpu, GpuBuffer, Recorder};

/// `tiles` tiles, marked by bits, with the set bits before each word.
pub fn record(gpu: &Gpu, frame: &mut Recorder, tiles: u32, (bits, ranks): (&GpuBuffer, &GpuBuffer), list: &GpuBuffer) {
    frame
        .pass(&gpu.kernel("cones/list_tiles.wgsl", &[]))
        .bind("tiles", bits)
        .bind("ranks", ranks)
        .bind("list", list)
        .bytes_moved(4 * u64::from(tiles))
        .dispatch(tiles.into());
}
