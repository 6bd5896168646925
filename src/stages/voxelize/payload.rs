//! Fragments to voxels: each cell's payload is an area-weighted mean in integers.
//!
//! In: fragments sorted by cell. Out: a voxel a cell, in the same order. A fragment weighs its
//! visible area (area times opacity) in units of 2^-20 cells², at least one. Sums are order-free,
//! and n equal fragments give the value of one. No sum overflows: the area of a triangle in a cell
//! is at most √2 < 2^0.6 cells², values have 16 bits and a cache at most 2^27 fragments:
//! 20.6 + 16 + 27 < 64.

use glam::{DVec3, IVec3};
use rayon::prelude::*;

use super::clip::Clipper;
use super::fragments::{Fragment, Fragments, Soup, same_tile, split_key};
use super::joints::{self, JointSums};
use super::surface::{Surface, SurfaceReader};
use super::triangle::Triangle;
use super::{VoxelizeInput, VoxelizePart};
use crate::data::albedo::pack_color;
use crate::data::packing::{pack_normal, pack_position, pack_rgba8};
use crate::data::voxel_cache::{CacheVoxel, TILE_CELLS, Tile, VoxelCache, VoxelJoints};
use crate::progress::{Cancelled, Progress};
use crate::scene::Material;

/// Most fragments of a cache, so that no sum overflows.
pub(super) const MAX_FRAGMENTS: u64 = 1 << 27;
/// One cell² as an integer weight.
const AREA_ONE: f64 = (1 << 20) as f64;
const VALUE_ONE: f64 = 65535.0;
/// A component of a unit normal; with its sign it has as many bits as a value.
const NORMAL_ONE: f64 = 32767.0;
const EMISSION_ONE: f64 = 65536.0;
const CHUNK_FRAGMENTS: usize = 8192;

/// Voxels of a run of cells; a cell without visible area has none.
#[derive(Default)]
struct Run {
    keys: Vec<u64>,
    voxels: Vec<CacheVoxel>,
    emission: Vec<[f32; 3]>,
    joints: Vec<VoxelJoints>,
}

/// Everything but the report. Advances `progress` by a unit a triangle of the soup.
pub(super) fn shade(
    input: &VoxelizeInput,
    soup: &Soup,
    fragments: &Fragments,
    progress: &Progress,
) -> Result<VoxelCache, Cancelled> {
    let default_material = Material::default();
    let shader = Shader { input, soup, corner: fragments.corner, materials: input.part_materials(&default_material) };
    let cuts = cell_cuts(&fragments.sorted);
    let (runs, units) = (cuts.len() - 1, input.triangle_count());
    let runs: Vec<Run> = (0..runs)
        .into_par_iter()
        .map(|i| {
            let run = shader.run(&fragments.sorted[cuts[i]..cuts[i + 1]]);
            let share = |done: usize| units * done as u64 / runs as u64;
            progress.advance(share(i + 1) - share(i)).map(|()| run)
        })
        .collect::<Result<_, _>>()?;
    Ok(join(runs, fragments.corner))
}

/// Where to cut the fragments into runs of about a chunk, never inside a cell.
fn cell_cuts(fragments: &[Fragment]) -> Vec<usize> {
    let mut cuts = vec![0];
    let mut at = CHUNK_FRAGMENTS;
    while at < fragments.len() {
        let key = fragments[at - 1].key;
        at += fragments[at..].partition_point(|fragment| fragment.key == key);
        if at < fragments.len() {
            cuts.push(at);
        }
        at += CHUNK_FRAGMENTS;
    }
    cuts.push(fragments.len());
    cuts
}

fn join(runs: Vec<Run>, corner: IVec3) -> VoxelCache {
    let mut cache = VoxelCache::default();
    let mut last_key = None;
    for run in runs {
        for &key in &run.keys {
            let index = match last_key {
                Some(last) if same_tile(last, key) => cache.tiles.len() - 1,
                _ => {
                    let start = cache.tiles.last().map_or(0, |tile| tile.voxels.end);
                    let origin = corner + split_key(key).0.as_ivec3() * TILE_CELLS;
                    cache.tiles.push(Tile { origin, voxels: start..start });
                    cache.tiles.len() - 1
                }
            };
            cache.tiles[index].voxels.end += 1;
            last_key = Some(key);
        }
        cache.voxels.extend(run.voxels);
        cache.emission.extend(run.emission);
        cache.joints.extend(run.joints);
    }
    cache
}

struct Shader<'a> {
    input: &'a VoxelizeInput<'a>,
    soup: &'a Soup<'a>,
    corner: IVec3,
    /// One a part.
    materials: Vec<&'a Material>,
}

/// A triangle while its fragments are shaded.
struct Current<'a> {
    number: u32,
    vertices: [u32; 3],
    clipper: Clipper,
    part: &'a VoxelizePart<'a>,
    surface: SurfaceReader<'a>,
}

#[derive(Default)]
struct Sums {
    /// Area, visible or not.
    area: u64,
    /// Visible area; the weight of everything below.
    weight: u64,
    color: [u64; 3],
    metallic: u64,
    roughness: u64,
    normal: [i64; 3],
    emission: [u128; 3],
}

impl<'a> Shader<'a> {
    fn run(&self, fragments: &[Fragment]) -> Run {
        let mut run = Run::default();
        let mut current: Option<Current> = None;
        let mut joints = JointSums::default();
        let emits = self.input.emits();
        for cell_fragments in fragments.chunk_by(|a, b| a.key == b.key) {
            let key = cell_fragments[0].key;
            let (tile, place) = split_key(key);
            let cell = self.corner + (tile * TILE_CELLS as u32 + place).as_ivec3();
            let mut sums = Sums::default();
            joints.clear();
            for fragment in cell_fragments {
                // Neighbouring cells share triangles, so the one at hand is often the one wanted.
                if current.as_ref().is_none_or(|current| current.number != fragment.triangle) {
                    current = self.load(fragment.triangle);
                }
                if let Some(current) = &current {
                    self.add(current, cell, &mut sums, &mut joints);
                }
            }
            if sums.weight == 0 {
                continue;
            }
            run.keys.push(key);
            run.voxels.push(sums.voxel(place.to_array()));
            if emits {
                run.emission.push(sums.mean_emission());
            }
            if self.input.joints.is_some() {
                run.joints.push(joints.quantized());
            }
        }
        run
    }

    fn load(&self, number: u32) -> Option<Current<'a>> {
        let (index, local) = self.soup.locate(number);
        let part = &self.input.parts[index];
        let triangle = Triangle::new(&part.positions_cells, part.primitive.triangles[local])?;
        let surface = SurfaceReader::new(part.primitive, self.materials[index], self.input.textures);
        Some(Current { number, vertices: triangle.vertices, clipper: Clipper::new(&triangle), part, surface })
    }

    fn add(&self, current: &Current, cell: IVec3, sums: &mut Sums, joints: &mut JointSums) {
        let piece = current.clipper.piece(cell);
        let vertices = current.vertices;
        let surface = current.surface.read(vertices, piece.centroid, piece.area / current.clipper.area);
        let area = nearest(piece.area * AREA_ONE).max(1);
        let weight = nearest(area as f64 * surface.opacity);
        let corner = |vertex: u32| current.part.normals[vertex as usize];
        let [a, b, c] = vertices.map(corner);
        let normal = (a * piece.centroid.x + b * piece.centroid.y + c * piece.centroid.z).normalize_or_zero();
        sums.add(area, weight, &surface, normal);
        if let Some(weights) = self.input.joints {
            joints.add(current.part.primitive, vertices, joints::shares(piece.centroid, weights), weight);
        }
    }
}

/// Nearest integer to a value that is not negative, halves up; several times faster than `round`.
fn nearest(value: f64) -> u64 {
    (value + 0.5) as u64
}

/// Nearest integer, halves away from zero, so that opposed values stay opposed.
fn nearest_signed(value: f64) -> i64 {
    (value + 0.5f64.copysign(value)) as i64
}

impl Sums {
    fn add(&mut self, area: u64, weight: u64, surface: &Surface, normal: DVec3) {
        let value = |value: f64| weight * nearest(value * VALUE_ONE);
        self.area += area;
        self.weight += weight;
        self.metallic += value(surface.metallic);
        self.roughness += value(surface.roughness);
        for c in 0..3 {
            self.color[c] += value(surface.color[c]);
            self.normal[c] += weight as i64 * nearest_signed(normal[c] * NORMAL_ONE);
            self.emission[c] += u128::from(weight) * u128::from(nearest(surface.emission[c] * EMISSION_ONE));
        }
    }

    fn voxel(&self, place: [u32; 3]) -> CacheVoxel {
        let mean = |sum: u64| sum as f64 / self.weight as f64 / VALUE_ONE;
        let [r, g, b] = self.color.map(mean);
        let coverage = self.weight as f64 / self.area as f64;
        CacheVoxel {
            position: pack_position(place),
            normal: pack_normal(self.mean_normal()),
            albedo: pack_color([r, g, b, coverage]),
            surface: pack_rgba8([mean(self.metallic), mean(self.roughness), 0.0, 0.0]),
        }
    }

    /// Zero where opposed normals cancel: shorter than a step of the packing, the direction left
    /// over is noise.
    fn mean_normal(&self) -> DVec3 {
        let sum = DVec3::from_array(self.normal.map(|component| component as f64));
        let mean = sum / (self.weight as f64 * NORMAL_ONE);
        let cancelled = mean.length() * f64::from(crate::data::packing::NORMAL_MAX) < 1.0;
        if cancelled { DVec3::ZERO } else { mean }
    }

    fn mean_emission(&self) -> [f32; 3] {
        self.emission.map(|sum| (sum as f64 / self.weight as f64 / EMISSION_ONE) as f32)
    }
}
