//! Samples a second, by sampling and by the way to the nodes.

use octolume::settings::{Lookup, Sampling, Settings, View};
use octolume::stages::sample::Sampler;
use serde::Serialize;

use super::cost::Samples;
use crate::cli::session::{NO_PICTURE, Session};
use octolume::spread::Spread;

/// Points that are sampled at once.
const POINTS: usize = 1 << 20;
/// Widths of quadrilinear samples go up to this many cells, evenly by their logarithm.
const WIDEST_LOG2: f64 = 5.0;
/// Runs of a variant, after one to warm up.
const RUNS: u32 = 5;
pub const HEADS: [&str; 5] = ["sampling", "nodes found by", "where", "median ms", "million samples/s"];

#[derive(Serialize)]
pub struct SamplingCost {
    sampling: Sampling,
    lookup: Lookup,
    /// Near occupied leaves, or anywhere in the grid.
    near_leaves: bool,
    #[serde(flatten)]
    time: Spread,
    million_samples_per_s: f64,
    bytes: u64,
}

/// In the light of these settings; variants whose pointers do not fit are left out.
pub fn measure(session: &mut Session, settings: &Settings) -> anyhow::Result<Vec<SamplingCost>> {
    let mut costs = Vec::new();
    let cells = session.engine.read_voxels()?.cells;
    for near_leaves in [true, false] {
        let places = places(&cells, settings.discretization.grid, near_leaves);
        for sampling in [Sampling::Nearest, Sampling::Trilinear, Sampling::Quadrilinear] {
            let points = points(&places, sampling, settings.discretization.depth());
            for lookup in [Lookup::Ranks, Lookup::BlockPointers, Lookup::NodePointers] {
                let sampler = Sampler { sampling, lookup, opacity: settings.lighting.opacity };
                let mut samples = Samples::default();
                // A slice that follows the pointers has them linked.
                let mut following = settings.clone();
                following.look.view = View::Slice;
                following.look.slice.lookup = lookup;
                if session.run(&following, NO_PICTURE).is_err() {
                    continue;
                }
                for run in 0..=RUNS {
                    let Ok((_, timings)) = session.engine.sample(&sampler, [0.0, 1.0, 0.0], &points) else { break };
                    if run > 0 {
                        samples.add(timings.iter());
                    }
                }
                // Without pointers, which may not have fitted, there is nothing to measure.
                let Some(time) = Spread::of(&samples.ms) else { continue };
                let million_samples_per_s = points.len() as f64 / time.median_ms / 1e3;
                let bytes = samples.bytes;
                costs.push(SamplingCost { sampling, lookup, near_leaves, time, million_samples_per_s, bytes });
            }
        }
    }
    Ok(costs)
}

/// Places that follow no order in memory: multiples of irrational steps.
fn places(cells: &[[i32; 3]], grid: u32, near_leaves: bool) -> Vec<[f64; 3]> {
    const STEPS: [f64; 4] =
        [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3, 0.450_305_837_593_146];
    let place = |i: usize| {
        let [x, y, z, which] = STEPS.map(|step| (i as f64 * step).fract());
        match cells.get((which * cells.len() as f64) as usize) {
            Some(cell) if near_leaves => [f64::from(cell[0]) + x, f64::from(cell[1]) + y, f64::from(cell[2]) + z],
            _ => [x, y, z].map(|share| share * f64::from(grid)),
        }
    };
    (0..POINTS).map(place).collect()
}

fn points(places: &[[f64; 3]], sampling: Sampling, depth: u32) -> Vec<[f32; 4]> {
    let at = |i: usize| match sampling {
        Sampling::Quadrilinear => (i as f64 / places.len() as f64 * WIDEST_LOG2).exp2(),
        Sampling::Nearest | Sampling::Trilinear => f64::from(depth),
    };
    places.iter().enumerate().map(|(i, [x, y, z])| [*x as f32, *y as f32, *z as f32, at(i) as f32]).collect()
}

impl SamplingCost {
    pub fn row(&self) -> Vec<String> {
        let lookup = match self.lookup {
            Lookup::Ranks => "ranks",
            Lookup::BlockPointers => "pointers a block",
            Lookup::NodePointers => "pointers a node",
        };
        vec![
            format!("{:?}", self.sampling).to_lowercase(),
            lookup.to_owned(),
            if self.near_leaves { "at leaves" } else { "anywhere" }.to_owned(),
            format!("{:.1}", self.time.median_ms),
            format!("{:.1}", self.million_samples_per_s),
        ]
    }
}
