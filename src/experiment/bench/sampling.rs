//! Samples a second, by sampling and by the way to the nodes.

use std::sync::Arc;

use crate::experiment::ExperimentError;
use crate::experiment::board::Share;
use crate::experiment::cost::Samples;
use crate::experiment::lab::{Lab, NO_PICTURE, pause};
use crate::experiment::rows::SamplingCost;
use crate::settings::{Lookup, Sampling, Settings, View};
use crate::spread::Spread;
use crate::stages::sample::Sampler;

/// Points that are sampled at once.
const POINTS: usize = 1 << 20;
/// Widths of quadrilinear samples go up to this many cells, evenly by their logarithm.
const WIDEST_LOG2: f64 = 5.0;
/// Runs of a variant, after one to warm up.
const RUNS: u32 = 5;
const SAMPLINGS: [Sampling; 3] = [Sampling::Nearest, Sampling::Trilinear, Sampling::Quadrilinear];
const LOOKUPS: [Lookup; 3] = [Lookup::Ranks, Lookup::BlockPointers, Lookup::NodePointers];

/// In the light of these settings; variants whose pointers do not fit are left out.
pub async fn measure(
    lab: &mut Lab,
    settings: &Settings,
    share: Share,
    mut found: impl FnMut(SamplingCost),
) -> Result<(), ExperimentError> {
    let cells = Arc::new(lab.engine.read_voxels()?.cells);
    for (half, near_leaves) in [true, false].into_iter().enumerate() {
        let share = share.part(half, 2);
        let (grid, depth) = (settings.method.discretization.grid, settings.method.discretization.depth());
        let of_places = Arc::clone(&cells);
        let places = lab.work((share, "choosing samples"), move |_| places(&of_places, grid, near_leaves)).await?;
        let places = Arc::new(places);
        for (third, sampling) in SAMPLINGS.into_iter().enumerate() {
            let share = share.part(third, SAMPLINGS.len());
            let of_points = Arc::clone(&places);
            let points = lab.work((share, "choosing samples"), move |_| points(&of_points, sampling, depth)).await?;
            for (way, lookup) in LOOKUPS.into_iter().enumerate() {
                let sampler = Sampler { sampling, lookup, opacity: settings.method.lighting.opacity };
                let share = share.part(way, LOOKUPS.len());
                let Some(samples) = measure_way(lab, settings, (&sampler, &points, share)).await else { continue };
                // Without pointers, which may not have fitted, there is nothing to measure.
                let Some(time) = Spread::of(&samples.ms) else { continue };
                let million_samples_per_s = points.len() as f64 / time.median_ms / 1e3;
                let bytes = samples.bytes;
                found(SamplingCost { sampling, lookup, near_leaves, time, million_samples_per_s, bytes });
            }
        }
    }
    Ok(())
}

/// `None` where its pointers cannot be made.
async fn measure_way(
    lab: &mut Lab,
    settings: &Settings,
    (sampler, points, share): (&Sampler, &[[f32; 4]], Share),
) -> Option<Samples> {
    // A slice that follows the pointers has them linked.
    let mut following = settings.clone();
    following.method.look.view = View::Slice;
    following.method.look.slice.lookup = sampler.lookup;
    let [linking, sampling] = share.split([1.0, 3.0]);
    lab.run(&following, NO_PICTURE, linking).await.ok()?;
    let mut samples = Samples::default();
    for run in 0..=RUNS {
        lab.say(sampling.part(run as usize, RUNS as usize + 1), format!("{:?} samples", sampler.sampling));
        let Ok((job, _)) = lab.engine.sampling(sampler, [0.0, 1.0, 0.0], points) else { break };
        let Ok(timings) = lab.run_job(job).await else { break };
        if run > 0 {
            samples.add(timings.iter());
        }
        pause().await;
    }
    Some(samples)
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
