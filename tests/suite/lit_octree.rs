//! Built octrees with pointers and light made by the CPU, for tests of what samples them.

use std::collections::BTreeMap;

use glam::DVec3;
use octolume::data::octree::{FULL_WEIGHT, PointerLayout, Slot};
use octolume::gpu::{Gpu, GpuBuffer};
use octolume::settings::Lookup;
use octolume::settings::lighting::Opacity;
use octolume::stages::build::link::{self, Linked};
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::light::LitOctree;
use octolume::stages::sample::sample_points::{self, PointParams};
use octolume::stages::sample::sample_points_ref::{LitNode, LitNodes};
use octolume::stages::sample::{self, SampledOctree, Sampler};

use crate::octree_rules::{self as rules, Cell};
use crate::stage_build::{Built, OctreeBuffers, Shape};
use crate::stage_rig::{World, read, run, upload, world_voxel};

/// Radiance and opacity of a leaf.
pub type LeafLight = (DVec3, f64);

pub struct LitBuild {
    pub built: Built,
    pub buffers: OctreeBuffers,
    pub light: GpuBuffer,
    pub neighbours: Vec<[u32; 3]>,
    pub node_neighbours: Vec<[u32; 3]>,
    /// What `light` holds, as stored: rounded to f32.
    pub nodes: LitNodes,
}

impl LitBuild {
    /// Builds and links; `light` says what each occupied leaf is, by its cell and stored occupancy.
    pub fn new(gpu: &Gpu, voxels: &[Fragment], shape: &Shape, light: impl Fn(Cell, f64) -> LeafLight) -> Self {
        let words: Vec<_> = voxels.iter().map(world_voxel).collect();
        let mut buffers = OctreeBuffers::default();
        let built = World::given(gpu, &words).build_in(gpu, shape, &mut buffers);
        let neighbours = link(gpu, &mut buffers, PointerLayout::Blocks);
        let node_neighbours = link(gpu, &mut buffers, PointerLayout::Nodes);
        let (nodes, entries) = lit_nodes(&built, light);
        let light = upload(gpu, "light", &entries);
        Self { built, buffers, light, neighbours, node_neighbours, nodes }
    }

    /// Other light on the same leaves.
    pub fn relight(&mut self, gpu: &Gpu, light: impl Fn(Cell, f64) -> LeafLight) {
        let (nodes, entries) = lit_nodes(&self.built, light);
        (self.nodes, self.light) = (nodes, upload(gpu, "light", &entries));
    }

    /// What `light` holds, as samplers of that opacity see it.
    pub fn lit(&self, opacity: Opacity) -> LitNodes {
        if opacity == Opacity::Directional {
            return self.nodes.clone();
        }
        let bare = |(key, node): (&(u32, [i32; 3]), &LitNode)| (*key, LitNode { across: None, ..*node });
        LitNodes { depth: self.nodes.depth, nodes: self.nodes.nodes.iter().map(bare).collect() }
    }

    pub fn sampled(&self, lookup: Lookup) -> SampledOctree {
        let pointers = match sample::pointer_layout(lookup) {
            None => None,
            Some(PointerLayout::Blocks) => self.buffers.neighbours.get(),
            Some(PointerLayout::Nodes) => self.buffers.node_neighbours.get(),
        };
        SampledOctree::new(self.buffers.octree(), &self.light, lookup, pointers)
            .unwrap_or_else(|error| panic!("{error}"))
    }

    pub fn read_by_cones(&self) -> LitOctree {
        LitOctree::new(self.buffers.octree()).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Samples points of (position, level or width).
    pub fn sample(&self, gpu: &Gpu, sampler: &Sampler, direction: DVec3, points: &[[f32; 4]]) -> Vec<[f32; 4]> {
        let buffer = upload(gpu, "points", points);
        let params = PointParams::new(direction.as_vec3().to_array());
        let octree = self.sampled(sampler.lookup);
        run(gpu, |frame| {
            sample_points::record(gpu, frame, &octree, (sampler, &params), &buffer, points.len() as u64);
        });
        read(gpu, &buffer, points.len() as u64)
    }
}

fn link(gpu: &Gpu, buffers: &mut OctreeBuffers, layout: PointerLayout) -> Vec<[u32; 3]> {
    let made = |slot: &Slot| slot.made("mask").expect("built");
    let (masks, sizes) = (&buffers.masks, buffers.octree().sizes.clone());
    let (blocks, ranks, block_keys) = (made(&masks.blocks), made(&masks.ranks), made(&buffers.topology.block_keys));
    let slot = match layout {
        PointerLayout::Blocks => &mut buffers.neighbours,
        PointerLayout::Nodes => &mut buffers.node_neighbours,
    };
    let words = layout.words(&sizes.params);
    let buffer = slot.ensure(gpu, "neighbours", 4 * words).expect("fits");
    gpu.write(&buffer, 0, &vec![0x77; buffer.bytes() as usize]).expect("fits");
    let linked = Linked { blocks, ranks, block_keys };
    run(gpu, |frame| link::record(gpu, frame, &sizes, &linked, (layout, &buffer)));
    read(gpu, &buffer, words / 3)
}

/// Premultiplied means up to the root, and opacity along the axes by the four paths through a node's
/// children; the second is `light` with all of it.
pub fn lit_nodes(built: &Built, light: impl Fn(Cell, f64) -> LeafLight) -> (LitNodes, Vec<[f32; 4]>) {
    let params = built.params;
    let (inner, leaves) = (params.inner_node_count as usize, params.leaf_count as usize);
    let mut entries = vec![[0.0_f32; 4]; 2 * inner + leaves];
    let mut lit = LitNodes { depth: params.depth, nodes: BTreeMap::new() };
    let stored = rules::leaves(built).expect("leaves");
    for (cell, slot) in rules::leaf_slots(built) {
        let (radiance, opacity) = light(cell, f64::from(stored[&cell].occupancy) / f64::from(FULL_WEIGHT));
        let entry = rounded(radiance * opacity, opacity);
        entries[inner + slot] = entry;
        lit.nodes.insert((params.depth, cell.map(|c| c as i32)), node(entry, [entry[3]; 3]));
    }
    let index = rules::walk(built).expect("walks");
    for level in (0..params.depth).rev() {
        for ((_, cell), number) in index.range((level, [0; 3])..(level + 1, [0; 3])) {
            let number = *number as usize;
            let (radiance, opacity, across) = averaged(&lit, level, *cell);
            let axes = across.as_vec3().to_array();
            entries[number] = rounded(radiance, opacity);
            entries[inner + leaves + number] = [axes[0], axes[1], axes[2], 0.0];
            lit.nodes.insert((level, cell.map(|c| c as i32)), node(entries[number], axes));
        }
    }
    (lit, entries)
}

/// Mean of a node's children, and its opacity along the axes.
fn averaged(lit: &LitNodes, level: u32, cell: Cell) -> (DVec3, f64, DVec3) {
    let child = |i: u32| {
        let at = [0, 1, 2].map(|axis| (2 * cell[axis] + (i >> axis & 1)) as i32);
        lit.nodes.get(&(level + 1, at)).copied().unwrap_or_default()
    };
    let children: Vec<LitNode> = (0..8).map(child).collect();
    let radiance = children.iter().map(|c| c.radiance).sum::<DVec3>() / 8.0;
    let opacity = children.iter().map(|c| c.opacity).sum::<f64>() / 8.0;
    let across = |axis: usize| {
        let along = |i: usize| children[i].across.unwrap_or_default()[axis];
        let near = (0..8).filter(|i| i >> axis & 1 == 0);
        near.map(|i| 1.0 - (1.0 - along(i)) * (1.0 - along(i | 1 << axis))).sum::<f64>() / 4.0
    };
    (radiance, opacity, DVec3::new(across(0), across(1), across(2)))
}

fn rounded(radiance: DVec3, opacity: f64) -> [f32; 4] {
    radiance.as_vec3().extend(opacity as f32).to_array()
}

fn node([r, g, b, opacity]: [f32; 4], axes: [f32; 3]) -> LitNode {
    let wide = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    LitNode { radiance: wide([r, g, b]), opacity: opacity.into(), across: Some(wide(axes)) }
}
