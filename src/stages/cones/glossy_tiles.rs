//! Which tiles of a picture need specular cones.

use bytemuck::{Pod, Zeroable};

use super::{Surfaces, image_bytes, list_tiles, tile_count};
use crate::data::octree::Slot;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Mirror, Recorder, mirror};
use crate::stages::build::scan::{self, Scanned};

/// Mirror of `GlossyParams` in shaders/cones/glossy_tiles.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct GlossyParams {
    pub size_px: [u32; 2],
    pub tiles: u32,
    pub most_roughness: f32,
}

pub const MIRRORS: &[Mirror] =
    &[mirror!(GlossyParams, "cones/glossy_tiles.wgsl", "GlossyParams", size_px, tiles, most_roughness)];

impl GlossyParams {
    pub fn new(size_px: [u32; 2], most_roughness: f64) -> Self {
        Self { size_px, tiles: tile_count(size_px), most_roughness: most_roughness as f32 }
    }
}

/// The tiles that need specular cones, in order.
#[derive(Debug, Default)]
pub struct TileBuffers {
    bits: Slot,
    ranks: Slot,
    list: Slot,
    sums: Vec<Slot>,
}

/// Where a list of tiles lies.
#[derive(Clone, Debug)]
pub struct TileList {
    /// How many there are, then their numbers, a word each.
    pub list: GpuBuffer,
}

impl TileList {
    /// Buffer and byte at which the count of listed tiles lies, one word, once the recording has run.
    pub fn count_at(&self) -> (&GpuBuffer, u64) {
        (&self.list, 0)
    }
}

/// Lists the tiles with a surface that reflects and is no rougher than `params.most_roughness`.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    surfaces: &Surfaces<'_>,
    params: &GlossyParams,
    buffers: &mut TileBuffers,
) -> Result<TileList, GpuError> {
    let words = params.tiles.div_ceil(u32::BITS);
    let bits = buffers.bits.ensure(gpu, "glossy tiles", 4 * u64::from(words))?;
    let ranks = buffers.ranks.ensure(gpu, "glossy tile ranks", 4 * u64::from(words + 1))?;
    let list = buffers.list.ensure(gpu, "glossy tile list", 4 * u64::from(params.tiles + 1))?;
    frame.clear_part(&bits, 4 * u64::from(words));
    let pass = frame.pass(&gpu.kernel("cones/glossy_tiles.wgsl", &[]));
    surfaces
        .bind(pass)
        .uniform("params", params)
        .bind("tiles", &bits)
        .bytes_moved(2 * image_bytes(params.size_px))
        .dispatch(params.tiles.into());
    scan::record(gpu, frame, (Scanned::Bits, words), &bits, &ranks, &mut buffers.sums)?;
    list_tiles::record(gpu, frame, params.tiles, (&bits, &ranks), &list);
    Ok(TileList { list })
}
