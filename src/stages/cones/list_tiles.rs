//! Lists marked tiles in order, behind their number.

use bytemuck::{Pod, Zeroable};

use crate::gpu::{Gpu, GpuBuffer, Mirror, Recorder, mirror};

/// Mirror of `ListParams` in shaders/cones/list_tiles.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ListParams {
    pub tiles: u32,
}

pub const MIRRORS: &[Mirror] = &[mirror!(ListParams, "cones/list_tiles.wgsl", "ListParams", tiles)];

/// `tiles` tiles, marked by bits, with the set bits before each word and of all. `list` has a word more than there
/// are tiles.
pub fn record(gpu: &Gpu, frame: &mut Recorder, tiles: u32, (bits, ranks): (&GpuBuffer, &GpuBuffer), list: &GpuBuffer) {
    frame
        .pass(&gpu.kernel("cones/list_tiles.wgsl", &[]))
        .uniform("params", &ListParams { tiles })
        .bind("tiles", bits)
        .bind("ranks", ranks)
        .bind("list", list)
        .bytes_moved(4 * u64::from(tiles))
        .dispatch(tiles.into());
}
