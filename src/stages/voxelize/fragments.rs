//! Triangles to fragments: (cell, triangle) pairs, sorted so that a cell's fragments are neighbours.
//!
//! In: a soup of parts in cells. Out: fragments in the order of the cells' keys. A key is the
//! Morton code of the tile, 30 bits, over that of the cell in its tile, 30 bits, both counted from
//! the smallest covered cell; so sorted fragments are sorted by tile, then in Morton order.
//! Chunks of triangles run in parallel; nothing depends on how they are cut.

use glam::{DVec3, IVec3, UVec3};
use rayon::prelude::*;

use super::coverage::{CellBox, for_each_cell};
use super::triangle::Triangle;
use crate::data::grid::{morton_cell, morton_key};
use crate::data::voxel_cache::TILE_CELLS;
use crate::progress::{Cancelled, Progress};
use crate::settings::VoxelizationMode;

const TILE_BITS: u32 = TILE_CELLS.trailing_zeros();
/// Bits of a cell's Morton code inside its tile.
const MORTON_BITS: u32 = 3 * TILE_BITS;
/// Cells along an axis that a key can tell apart: 1024 tiles of 1024 cells.
pub(super) const MAX_EXTENT_CELLS: i64 = 1 << (2 * TILE_BITS);
const CHUNK_TRIANGLES: usize = 512;

/// Meshes of one object, in cells; triangles are numbered through all of them.
pub(super) struct Soup<'a> {
    pub parts: Vec<SoupPart<'a>>,
}

pub(super) struct SoupPart<'a> {
    pub positions: &'a [DVec3],
    pub triangles: &'a [[u32; 3]],
    /// Number of the first triangle.
    pub first: u32,
}

impl<'a> Soup<'a> {
    pub fn new(parts: impl Iterator<Item = (&'a [DVec3], &'a [[u32; 3]])>) -> Self {
        let mut first = 0;
        let parts = parts.map(|(positions, triangles)| {
            let part = SoupPart { positions, triangles, first };
            first += triangles.len() as u32;
            part
        });
        Self { parts: parts.collect() }
    }

    /// The part a triangle belongs to, and the triangle's index there.
    pub fn locate(&self, triangle: u32) -> (usize, usize) {
        let part = self.parts.partition_point(|part| part.first <= triangle) - 1;
        (part, (triangle - self.parts[part].first) as usize)
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Fragment {
    pub key: u64,
    pub triangle: u32,
}

#[derive(Debug, Default)]
pub(super) struct Fragments {
    /// The cell that keys count from.
    pub corner: IVec3,
    pub sorted: Vec<Fragment>,
    pub degenerate_triangles: u64,
}

/// Key of a cell `offset` from the corner, each coordinate below [`MAX_EXTENT_CELLS`].
pub(super) fn key_from_offset(offset: UVec3) -> u64 {
    let tile = offset >> TILE_BITS;
    let cell = offset & UVec3::splat(TILE_CELLS as u32 - 1);
    u64::from(morton_key(tile.to_array())) << MORTON_BITS | u64::from(morton_key(cell.to_array()))
}

fn offset_from_key(key: u64) -> UVec3 {
    let (tile, cell) = split_key(key);
    tile << TILE_BITS | cell
}

/// Tile and cell in the tile.
pub(super) fn split_key(key: u64) -> (UVec3, UVec3) {
    let tile = UVec3::from_array(morton_cell((key >> MORTON_BITS) as u32));
    let cell = UVec3::from_array(morton_cell(key as u32 & ((1 << MORTON_BITS) - 1)));
    (tile, cell)
}

pub(super) fn same_tile(a: u64, b: u64) -> bool {
    a >> MORTON_BITS == b >> MORTON_BITS
}

/// What a few neighbouring triangles cover.
pub(super) struct Chunk {
    /// Keys counted from the clip box's lower corner.
    fragments: Vec<Fragment>,
    smallest: UVec3,
    degenerate_triangles: u64,
}

/// Every triangle's cells in `clip`; advances `progress` by a unit a triangle.
pub(super) fn scan(
    soup: &Soup,
    mode: VoxelizationMode,
    clip: CellBox,
    progress: &Progress,
) -> Result<Vec<Chunk>, Cancelled> {
    let jobs: Vec<(usize, usize)> = (0..soup.parts.len())
        .flat_map(|part| (0..soup.parts[part].triangles.len()).step_by(CHUNK_TRIANGLES).map(move |start| (part, start)))
        .collect();
    jobs.into_par_iter().map(|(part, start)| scan_chunk(&soup.parts[part], start, mode, clip, progress)).collect()
}

impl Fragments {
    /// `from` is the corner the chunks' keys count from.
    pub fn sorted(chunks: Vec<Chunk>, from: IVec3) -> Self {
        let smallest = smallest_offset(&chunks);
        let degenerate_triangles = chunks.iter().map(|chunk| chunk.degenerate_triangles).sum();
        let mut sorted: Vec<Fragment> = Vec::with_capacity(chunks.iter().map(|chunk| chunk.fragments.len()).sum());
        chunks.into_iter().for_each(|chunk| sorted.extend(chunk.fragments));
        if smallest != UVec3::ZERO {
            sorted.par_iter_mut().for_each(|fragment| {
                fragment.key = key_from_offset(offset_from_key(fragment.key) - smallest);
            });
        }
        sorted.par_sort_unstable_by_key(|fragment| fragment.key);
        Self { corner: from + smallest.as_ivec3(), sorted, degenerate_triangles }
    }
}

/// The cells of chunks whose keys count from `from`, each once, in the order of their keys.
pub(super) fn sorted_cells(chunks: Vec<Chunk>, from: IVec3) -> Vec<IVec3> {
    let mut keys = Vec::with_capacity(chunks.iter().map(|chunk| chunk.fragments.len()).sum());
    for chunk in chunks {
        keys.extend(chunk.fragments.into_iter().map(|fragment| fragment.key));
    }
    keys.par_sort_unstable();
    keys.dedup();
    keys.into_par_iter().map(|key| from + offset_from_key(key).as_ivec3()).collect()
}

fn smallest_offset(chunks: &[Chunk]) -> UVec3 {
    let covering = chunks.iter().filter(|chunk| !chunk.fragments.is_empty());
    covering.map(|chunk| chunk.smallest).reduce(UVec3::min).unwrap_or_default()
}

fn scan_chunk(
    part: &SoupPart,
    start: usize,
    mode: VoxelizationMode,
    clip: CellBox,
    progress: &Progress,
) -> Result<Chunk, Cancelled> {
    let end = part.triangles.len().min(start + CHUNK_TRIANGLES);
    let mut chunk = Chunk { fragments: Vec::new(), smallest: UVec3::MAX, degenerate_triangles: 0 };
    for (i, &indices) in part.triangles[start..end].iter().enumerate() {
        let Some(triangle) = Triangle::new(part.positions, indices) else {
            chunk.degenerate_triangles += 1;
            continue;
        };
        let number = part.first + (start + i) as u32;
        for_each_cell(&triangle, mode, clip, |cell| {
            let offset = (cell - clip[0]).as_uvec3();
            chunk.smallest = chunk.smallest.min(offset);
            chunk.fragments.push(Fragment { key: key_from_offset(offset), triangle: number });
        });
    }
    progress.advance((end - start) as u64)?;
    Ok(chunk)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_sort_by_tile_and_come_back() {
        for offset in [UVec3::ZERO, UVec3::new(1023, 1024, 5), UVec3::new(1_048_575, 0, 77_777)] {
            let (tile, cell) = split_key(key_from_offset(offset));
            assert_eq!(tile * TILE_CELLS as u32 + cell, offset);
        }
        assert!(key_from_offset(UVec3::splat(1023)) < key_from_offset(UVec3::new(1024, 0, 0)));
    }

    #[test]
    fn triangles_are_found_behind_empty_parts() {
        let triangles = [[0, 1, 2]; 3];
        let soup = Soup::new([&triangles[..2], &[], &triangles[..]].into_iter().map(|part| (&[][..], part)));
        assert_eq!([0, 1, 2, 4].map(|triangle| soup.locate(triangle)), [(0, 0), (0, 1), (2, 0), (2, 2)]);
    }
}
