//! Built octrees with pointers and light made by the CPU, for tests of what samples them.

use std::collections::BTreeMap;

use glam::DVec3;
use octolume::data::octree::{OctreeBuffers, PointerLayout};
use octolume::gpu::Gpu;
use octolume::stages::build::link::{self, Linked};
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::sample::sample_points::{self, PointParams};
use octolume::stages::sample::sample_points_ref::{LitNode, LitNodes};
use octolume::stages::sample::{LookUp, SampledOctree, Sampler};

use crate::octree_rules::{self as rules, Cell};
use crate::stage_build::{Built, Shape};
use crate::stage_rig::{World, read, run, upload, world_voxel};

/// Radiance and opacity of a leaf.
pub type LeafLight = (DVec3, f64);

pub struct LitOctree {
    pub built: Built,
    pub buffers: OctreeBuffers,
    pub neighbours: Vec<[u32; 3]>,
    pub node_neighbours: Vec<[u32; 3]>,
    /// What `light` holds, as stored: rounded to f32.
    pub nodes: LitNodes,
}

impl LitOctree {
    /// Builds and links; `light` says what each occupied leaf is, by its cell and stored occupancy.
    pub fn new(gpu: &Gpu, voxels: &[Fragment], shape: &Shape, light: impl Fn(Cell, f64) -> LeafLight) -> Self {
        let words: Vec<_> = voxels.iter().map(world_voxel).collect();
        let mut buffers = OctreeBuffers::default();
        let built = World::given(gpu, &words).build_in(gpu, shape, &mut buffers);
        let mut octree =
            Self { built, buffers, neighbours: Vec::new(), node_neighbours: Vec::new(), nodes: LitNodes::default() };
        octree.neighbours = octree.link(gpu, PointerLayout::Blocks);
        octree.node_neighbours = octree.link(gpu, PointerLayout::Nodes);
        octree.light(gpu, light);
        octree
    }

    fn link(&mut self, gpu: &Gpu, layout: PointerLayout) -> Vec<[u32; 3]> {
        let b = &mut self.buffers;
        let made = |slot: &octolume::data::octree::Slot| slot.made("mask").expect("built");
        let linked = Linked { blocks: made(&b.blocks), ranks: made(&b.ranks), block_keys: made(&b.block_keys) };
        let slot = match layout {
            PointerLayout::Blocks => &mut b.neighbours,
            PointerLayout::Nodes => &mut b.node_neighbours,
        };
        let words = layout.words(&self.built.params);
        let buffer = slot.ensure(gpu, "neighbours", 4 * words).expect("fits");
        gpu.write(&buffer, 0, &vec![0x77; buffer.bytes() as usize]).expect("fits");
        run(gpu, |frame| link::record(gpu, frame, &self.built.params, &linked, (layout, &buffer)));
        read(gpu, &buffer, words / 3)
    }

    /// Fills `light`: premultiplied means up to the root, and opacity along the axes as a grid of
    /// 2 x 2 paths through each node's children.
    fn light(&mut self, gpu: &Gpu, light: impl Fn(Cell, f64) -> LeafLight) {
        let params = self.built.params;
        let (inner, leaves) = (params.inner_node_count as usize, params.leaf_count as usize);
        let mut entries = vec![[0.0_f32; 4]; 2 * inner + leaves];
        self.nodes.depth = params.depth;
        let occupancy: BTreeMap<Cell, f64> =
            rules::leaves(&self.built).expect("leaves").iter().map(|(c, l)| (*c, f64::from(l.occupancy))).collect();
        for (cell, slot) in rules::leaf_slots(&self.built) {
            let (radiance, opacity) = light(cell, occupancy[&cell] / f64::from(1_u32 << 24));
            let stored = rounded(radiance * opacity, opacity);
            entries[inner + slot] = stored;
            self.nodes.nodes.insert((params.depth, cell.map(|c| c as i32)), lit(stored, Some([opacity as f32; 3])));
        }
        let index = rules::walk(&self.built).expect("walks");
        for level in (0..params.depth).rev() {
            for ((_, cell), node) in index.range((level, [0; 3])..(level + 1, [0; 3])) {
                let node = *node as usize;
                let (mean, across) = self.averaged(level, *cell);
                entries[node] = rounded(mean.radiance, mean.opacity);
                let axes = across.as_vec3().to_array();
                entries[inner + leaves + node] = [axes[0], axes[1], axes[2], 0.0];
                self.nodes.nodes.insert((level, cell.map(|c| c as i32)), lit(entries[node], Some(axes)));
            }
        }
        let buffer = self.buffers.light.ensure(gpu, "light", 16 * entries.len() as u64).expect("fits");
        gpu.write(&buffer, 0, bytemuck::cast_slice(&entries)).expect("fits");
    }

    /// Mean of a node's children, and its opacity along the axes.
    fn averaged(&self, level: u32, cell: Cell) -> (LitNode, DVec3) {
        let child = |i: u32| {
            let at = [0, 1, 2].map(|axis| (2 * cell[axis] + (i >> axis & 1)) as i32);
            self.nodes.nodes.get(&(level + 1, at)).copied().unwrap_or_default()
        };
        let children: Vec<LitNode> = (0..8).map(child).collect();
        let radiance = children.iter().map(|c| c.radiance).sum::<DVec3>() / 8.0;
        let opacity = children.iter().map(|c| c.opacity).sum::<f64>() / 8.0;
        let across = |axis: usize| {
            let pairs = (0..8).filter(|i| i >> axis & 1 == 0).map(|i| (i, i | 1 << axis));
            let along = |i: usize| children[i].across.unwrap_or_default()[axis];
            let opacities = pairs.map(|(near, far)| 1.0 - (1.0 - along(near)) * (1.0 - along(far)));
            opacities.sum::<f64>() / 4.0
        };
        (LitNode { radiance, opacity, across: None }, DVec3::new(across(0), across(1), across(2)))
    }

    /// The same without opacity along the axes, as the isotropic samplers see it.
    pub fn isotropic(&self) -> LitNodes {
        let bare = |(key, node): (&(u32, [i32; 3]), &LitNode)| (*key, LitNode { across: None, ..*node });
        LitNodes { depth: self.nodes.depth, nodes: self.nodes.nodes.iter().map(bare).collect() }
    }

    pub fn sampled(&self, look_up: LookUp) -> SampledOctree {
        SampledOctree::new(&self.built.params, &self.buffers, look_up).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Samples points of (position, level or width).
    pub fn sample(&self, gpu: &Gpu, sampler: &Sampler, direction: DVec3, points: &[[f32; 4]]) -> Vec<[f32; 4]> {
        let buffer = upload(gpu, "points", points);
        let params = PointParams::new(direction.as_vec3().to_array());
        let octree = self.sampled(sampler.look_up);
        run(gpu, |frame| {
            sample_points::record(gpu, frame, &octree, (sampler, &params), &buffer, points.len() as u64);
        });
        read(gpu, &buffer, points.len() as u64)
    }
}

fn rounded(radiance: DVec3, opacity: f64) -> [f32; 4] {
    radiance.as_vec3().extend(opacity as f32).to_array()
}

fn lit(stored: [f32; 4], across: Option<[f32; 3]>) -> LitNode {
    let [r, g, b, opacity] = stored.map(f64::from);
    let across = across.map(|axes| DVec3::from_array(axes.map(f64::from)));
    LitNode { radiance: DVec3::new(r, g, b), opacity, across }
}
