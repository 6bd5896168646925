//! What light costs, a variant at a time: pointers, shadows, injection, averages, cones, and samples a
//! second by every way to find nodes.

use std::cell::RefMut;
use std::collections::BTreeMap;

use super::sampling;
use crate::experiment::ExperimentError;
use crate::experiment::board::{Findings, Share};
use crate::experiment::cost::Samples;
use crate::experiment::frames::{Forget, Frames};
use crate::experiment::lab::{Lab, NO_PICTURE};
use crate::experiment::rows::{KernelReport, MemoryReport};
use crate::settings::lighting::{Opacity, Shadows};
use crate::settings::{ColorBy, Lookup, Settings, View};

/// Runs of cones, which take seconds each without a fast GPU.
const CONE_RUNS: u32 = 1;

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
        set: |s| s.method.lighting.shadows = Shadows::March,
    },
    Variant {
        name: "no shadows",
        kernels: &["light/illuminate"],
        runs: None,
        set: |s| s.method.lighting.shadows = Shadows::Off,
    },
    Variant { name: "isotropic", kernels: &["light/inject", "light/average_light"], runs: None, set: |_| {} },
    Variant {
        name: "directional",
        kernels: &["light/average_light"],
        runs: None,
        set: |s| s.method.lighting.opacity = Opacity::Directional,
    },
    Variant {
        name: "a bounce",
        kernels: &["light/gather"],
        runs: Some(CONE_RUNS),
        set: |s| s.method.lighting.bounces = 1,
    },
    Variant {
        name: "the sky",
        kernels: &["light/gather"],
        runs: Some(CONE_RUNS),
        set: |s| s.method.lighting.sky_nits = [1.0; 3],
    },
];

fn follow(settings: &mut Settings, lookup: Lookup) {
    settings.method.look.view = View::Slice;
    settings.method.look.slice.lookup = lookup;
}

pub async fn measure(
    lab: &mut Lab,
    report: &Findings<KernelReport>,
    (share, bytes_per_ms): (Share, f64),
) -> Result<(), ExperimentError> {
    let light = || RefMut::map(report.borrow_mut(), |report| report.light.get_or_insert_default());
    let mut lit = lab.settings.clone();
    lit.method.look.color = ColorBy::Radiance;
    let [lighting, relighting, sampling] = share.split([20.0, 1.0, 10.0]);
    for (index, variant) in VARIANTS.iter().enumerate() {
        let mut settings = lit.clone();
        (variant.set)(&mut settings);
        match measure_variant(lab, &settings, (variant, lighting.part(index, VARIANTS.len()))).await {
            Ok(samples) => {
                let costs = samples
                    .into_iter()
                    .filter_map(|(kernel, samples)| samples.cost(format!("{kernel}, {}", variant.name), bytes_per_ms));
                light().passes.extend(costs);
            }
            Err(error) => lab.miss(variant.name, &error),
        }
    }
    lab.say(relighting, "lighting as set");
    lab.run(&lit, NO_PICTURE, relighting).await?;
    sampling::measure(lab, &lit, sampling, |cost| light().sampling.push(cost)).await?;
    light().memory = Some(memory(lab)?);
    Ok(())
}

async fn measure_variant(
    lab: &mut Lab,
    settings: &Settings,
    (variant, share): (&Variant, Share),
) -> Result<BTreeMap<&'static str, Samples>, ExperimentError> {
    let mut samples: BTreeMap<&str, Samples> = BTreeMap::new();
    let (warmup, runs) = variant.runs.map_or((lab.warmup, lab.runs), |runs| (0, runs));
    let frames = Frames { what: variant.name, settings, size_px: NO_PICTURE, forget: Forget::Light, warmup, runs };
    lab.measure(frames, share, |engine, _| {
        for &kernel in variant.kernels {
            let timings = engine.timings().iter().map(|timing| &timing.kernel);
            samples.entry(kernel).or_default().add(timings.filter(|timing| timing.kernel == kernel));
        }
    })
    .await?;
    Ok(samples)
}

fn memory(lab: &Lab) -> Result<MemoryReport, ExperimentError> {
    let no_octree = || ExperimentError::NoVoxels(lab.prepared.scene.name.clone());
    let report = lab.engine.octree_report().ok_or_else(no_octree)?;
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
