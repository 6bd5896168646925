//! What light costs, a variant at a time: pointers, shadows, injection, averages, cones, and samples a
//! second by every way to find nodes.

use std::collections::BTreeMap;

use anyhow::Context;
use octolume::gpu::KernelTiming;
use octolume::settings::lighting::{Opacity, Shadows};
use octolume::settings::{ColorBy, Lookup, Settings, View};
use serde::Serialize;

use super::cost::{Cost, HEADS, Samples};
use super::sampling::{self, SamplingCost};
use crate::cli::output;
use crate::cli::session::{NO_PICTURE, Session};

/// Runs of cones, which take seconds each without a fast GPU.
const CONE_RUNS: u32 = 1;

#[derive(Serialize)]
pub struct LightReport {
    passes: Vec<Cost>,
    sampling: Vec<SamplingCost>,
    memory: MemoryReport,
}

/// Bytes of the octree on screen and of its light, and how many a node has.
#[derive(Serialize)]
struct MemoryReport {
    /// Stored nodes, leaves and dummies included.
    nodes: u64,
    octree_bytes: u64,
    light_bytes: u64,
    block_pointer_bytes: u64,
    node_pointer_bytes: u64,
    bytes_per_node: f64,
    /// With pointers stored with every node, as in the paper.
    bytes_per_node_with_node_pointers: f64,
}

/// A way to light the octree, and the kernels in which it differs.
struct Variant {
    name: &'static str,
    kernels: &'static [&'static str],
    runs: Option<u32>,
    set: fn(&mut Settings),
}

const VARIANTS: [Variant; 9] = [
    Variant {
        name: "pointers a block",
        kernels: &["build/link"],
        runs: None,
        set: |s| follow(s, Lookup::BlockPointers),
    },
    Variant { name: "pointers a node", kernels: &["build/link"], runs: None, set: |s| follow(s, Lookup::NodePointers) },
    Variant { name: "shadow maps", kernels: &["light/shadow", "light/illuminate"], runs: None, set: |_| {} },
    Variant {
        name: "marched shadows",
        kernels: &["light/illuminate"],
        runs: None,
        set: |s| s.lighting.shadows = Shadows::March,
    },
    Variant {
        name: "no shadows",
        kernels: &["light/illuminate"],
        runs: None,
        set: |s| s.lighting.shadows = Shadows::Off,
    },
    Variant { name: "isotropic", kernels: &["light/inject", "light/average_light"], runs: None, set: |_| {} },
    Variant {
        name: "directional",
        kernels: &["light/average_light"],
        runs: None,
        set: |s| s.lighting.opacity = Opacity::Directional,
    },
    Variant { name: "a bounce", kernels: &["light/gather"], runs: Some(CONE_RUNS), set: |s| s.lighting.bounces = 1 },
    Variant {
        name: "the sky",
        kernels: &["light/gather"],
        runs: Some(CONE_RUNS),
        set: |s| s.lighting.sky_nits = [1.0; 3],
    },
];

fn follow(settings: &mut Settings, lookup: Lookup) {
    settings.look.view = View::Slice;
    settings.look.slice.lookup = lookup;
}

/// `runs`: to warm up, and measured.
pub fn measure(
    session: &mut Session,
    settings: &Settings,
    runs: (u32, u32),
    bytes_per_ms: f64,
) -> anyhow::Result<LightReport> {
    let mut lit = settings.clone();
    lit.look.color = ColorBy::Radiance;
    let mut passes = Vec::new();
    for variant in &VARIANTS {
        let mut settings = lit.clone();
        (variant.set)(&mut settings);
        let runs = variant.runs.map_or(runs, |runs| (0, runs));
        match measure_variant(session, &settings, variant, runs) {
            Ok(samples) => passes.extend(
                samples
                    .into_iter()
                    .filter_map(|(kernel, samples)| samples.cost(format!("{kernel}, {}", variant.name), bytes_per_ms)),
            ),
            Err(error) => output::message(&format!("{} is not measured: {error:#}", variant.name)),
        }
    }
    session.run(&lit, NO_PICTURE)?;
    let sampling = sampling::measure(session, &lit)?;
    let memory = memory(session)?;
    Ok(LightReport { passes, sampling, memory })
}

fn measure_variant(
    session: &mut Session,
    settings: &Settings,
    variant: &Variant,
    (warmup, runs): (u32, u32),
) -> anyhow::Result<BTreeMap<&'static str, Samples>> {
    let mut samples: BTreeMap<&str, Samples> = BTreeMap::new();
    for run in 0..warmup + runs {
        session.engine.invalidate_light();
        session.run(settings, NO_PICTURE)?;
        let timings = session.kernel_times();
        for &kernel in variant.kernels.iter().filter(|_| run >= warmup) {
            let of_kernel = |timing: &&KernelTiming| timing.kernel == kernel;
            samples.entry(kernel).or_default().add(timings.iter().filter(of_kernel));
        }
    }
    Ok(samples)
}

fn memory(session: &Session) -> anyhow::Result<MemoryReport> {
    let report = session.engine.octree_report().context("there is no octree")?;
    let nodes = report.levels.iter().map(|level| level.nodes).sum::<u64>();
    let [block_pointer_bytes, node_pointer_bytes] = report.pointer_bytes;
    let bytes_per_node = |pointers: u64| (report.bytes + report.light_bytes + pointers) as f64 / nodes as f64;
    Ok(MemoryReport {
        nodes,
        octree_bytes: report.bytes,
        light_bytes: report.light_bytes,
        block_pointer_bytes,
        node_pointer_bytes,
        bytes_per_node: bytes_per_node(block_pointer_bytes),
        bytes_per_node_with_node_pointers: bytes_per_node(node_pointer_bytes),
    })
}

impl LightReport {
    pub fn text(&self) -> String {
        let passes = output::table(&HEADS, self.passes.iter().map(Cost::row));
        let sampling = output::table(&sampling::HEADS, self.sampling.iter().map(SamplingCost::row));
        let m = &self.memory;
        format!(
            "{passes}\n\n{sampling}\n\n{} nodes: {} bytes of octree, {} of light, {} of pointers a block ({} a node); \
             {:.1} bytes a node ({:.1} with pointers a node)",
            m.nodes,
            m.octree_bytes,
            m.light_bytes,
            m.block_pointer_bytes,
            m.node_pointer_bytes,
            m.bytes_per_node,
            m.bytes_per_node_with_node_pointers,
        )
    }
}
