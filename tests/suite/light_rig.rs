//! Octrees made from world voxels and lit kernel by kernel, for tests of the light stages.

use std::collections::BTreeMap;

use glam::{DVec3, IVec3};
use octolume::data::grid::Grid;
use octolume::data::light::light_bytes;
use octolume::data::packing::unpack_normal;
use octolume::gpu::Gpu;
use octolume::lights::PosedLight;
use octolume::scene::LightKind;
use octolume::settings::lighting::{Opacity, Shadows};
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::light::illuminate::{self, LightParams};
use octolume::stages::light::inject::{self, Injected};
use octolume::stages::light::shadow::{ShadowMap, ShadowParams};
use octolume::stages::light::{LitOctree, average_light};

use crate::octree_rules::{self as rules, Cell};
use crate::random::ONE;
use crate::stage_build::{Built, OctreeBuffers, Shape};
use crate::stage_rig::{World, buffer, read, run, upload, world_voxel};

/// A built octree, what lighting reads of it, and where its leaves are stored.
pub struct LightRig {
    pub built: Built,
    pub octree: LitOctree,
    pub slots: BTreeMap<Cell, usize>,
}

/// Unit in which leaves hold what they emit; a power of two, so that values stay exact.
const EMISSION_NITS: f32 = 0.25;

/// Scene units are cells.
pub fn grid(depth: u32) -> Grid {
    Grid { anchor: DVec3::ZERO, offset_cells: IVec3::ZERO, span: 1.0, depth }
}

pub fn sun(direction: DVec3, lux: f64) -> PosedLight {
    light(LightKind::Directional, DVec3::splat(lux), DVec3::ZERO, direction)
}

pub fn point(position: DVec3, candela: f64) -> PosedLight {
    light(LightKind::Point { range: None }, DVec3::splat(candela), position, DVec3::NEG_Y)
}

pub fn light(kind: LightKind, strength: DVec3, position: DVec3, direction: DVec3) -> PosedLight {
    let direction = direction.normalize();
    PosedLight { name: "light".to_owned(), node: None, kind, strength, position, direction }
}

/// A voxel that fills its cell.
pub fn full(cell: [i64; 3], normal: DVec3, albedo: [u32; 3]) -> Fragment {
    let packed = octolume::data::packing::pack_normal(normal);
    let normal = [0, 10, 20].map(|shift| packed >> shift & 0x3ff);
    Fragment { q: cell.map(|c| c * ONE), normal, albedo, coverage: 255 }
}

impl LightRig {
    pub fn new(gpu: &Gpu, voxels: &[Fragment], shape: &Shape) -> Self {
        let words: Vec<_> = voxels.iter().map(world_voxel).collect();
        let mut buffers = OctreeBuffers::default();
        let built = World::given(gpu, &words).build_in(gpu, shape, &mut buffers);
        let octree = LitOctree::new(buffers.octree()).unwrap_or_else(|error| panic!("{error}"));
        let slots = rules::leaf_slots(&built).collect();
        Self { built, octree, slots }
    }

    /// Irradiance of every leaf, by slot. Under [`Shadows::Map`] nothing is drawn, so nothing hides.
    pub fn irradiance(&self, gpu: &Gpu, lights: &[PosedLight], shadows: Shadows, offset_cells: f64) -> Vec<[f32; 3]> {
        self.irradiance_in(gpu, &grid(self.built.params.depth), lights, shadows, offset_cells)
    }

    /// The same where the octree lies elsewhere in the scene.
    pub fn irradiance_in(
        &self,
        gpu: &Gpu,
        grid: &Grid,
        lights: &[PosedLight],
        shadows: Shadows,
        offset_cells: f64,
    ) -> Vec<[f32; 3]> {
        let map = ShadowMap::new(gpu, ShadowParams::default()).expect("small");
        let irradiance = buffer(gpu, "irradiance", 3 * u64::from(self.built.params.leaf_count));
        run(gpu, |frame| {
            frame.clear(&irradiance);
            for light in lights {
                let params = LightParams::new(light, grid, offset_cells);
                illuminate::record(gpu, frame, &self.octree, &irradiance, &params, (shadows, &map));
            }
        });
        read(gpu, &irradiance, self.built.params.leaf_count.into())
    }

    /// The whole store, from irradiance (lux) and emission (nits) of the leaves by slot.
    pub fn stored(&self, gpu: &Gpu, direct: &[[f32; 3]], emission: &[[f32; 3]], opacity: Opacity) -> Vec<[f32; 4]> {
        let bytes = light_bytes(&self.built.params, opacity.is_directional());
        let light = buffer(gpu, "light", bytes / 4);
        gpu.write(&light, 0, &vec![0xff; bytes as usize]).expect("fits");
        let direct = upload(gpu, "direct", direct);
        let units: Vec<_> = emission.iter().map(|nits| nits.map(|part| part / EMISSION_NITS)).collect();
        let emission = (!units.is_empty()).then(|| upload(gpu, "emission", &units));
        run(gpu, |frame| {
            let emission = emission.as_ref().map(|emission| (emission, EMISSION_NITS));
            let from = Injected { direct: &direct, gathered: None, emission };
            inject::record(gpu, frame, &self.octree, from, &light);
            average_light::record(gpu, frame, &self.octree, opacity, &light);
        });
        read(gpu, &light, bytes / 16)
    }

    /// Centre and mean normal of every leaf, by slot.
    pub fn leaves(&self) -> Vec<(DVec3, DVec3)> {
        let mut leaves = vec![(DVec3::ZERO, DVec3::ZERO); self.slots.len()];
        for (cell, &slot) in &self.slots {
            let centre = DVec3::from_array(cell.map(f64::from)) + 0.5;
            leaves[slot] = (centre, unpack_normal(self.built.leaves[slot][2]));
        }
        leaves
    }

    /// Occupied share of a leaf.
    pub fn occupancy(&self, cell: Cell) -> Option<f64> {
        let slot = *self.slots.get(&cell)?;
        Some(f64::from(self.built.leaves[slot][0]) / f64::from(octolume::data::octree::FULL_WEIGHT))
    }
}
