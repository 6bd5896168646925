//! A walking character seen through the whole engine: moved in 32 steps of 1/32 voxel, the light that cones
//! bring to what stands still around it changes smoothly under the split filter.

use std::sync::Arc;

use glam::DVec3;
use octolume::engine::Engine;
use octolume::prepare::prepare;
use octolume::progress::Progress;
use octolume::scene::{Channel, Clip, Interpolation, LocalTransform, OrbitCamera, Property, Scene, builtin, load};
use octolume::settings::{Filter, Settings, SurfaceView, View};

use crate::device::open;

const STEPS: u32 = 32;
const SIZE_PX: [u32; 2] = [64, 48];

/// The courtyard, whose traveller slides along x by `distance` in a second and moves in no other way.
fn sliding_traveller(distance: f64) -> (Scene, DVec3) {
    let bytes = builtin::bytes("courtyard").expect("built in");
    let mut scene = load::open_bytes("courtyard", bytes, None, &Progress::default()).expect("opens");
    let root = scene.nodes.iter().position(|node| node.name == "root").expect("a traveller");
    let LocalTransform::Trs(at) = scene.nodes[root].local else { panic!("the root has no matrix") };
    let from = at.translation;
    let to = from + DVec3::X * distance;
    let values = [from, to].into_iter().flat_map(|place| place.to_array()).collect();
    let channel = Channel {
        node: root,
        property: Property::Translation,
        interpolation: Interpolation::Linear,
        times_secs: vec![0.0, 1.0],
        values,
    };
    scene.clips = vec![Clip { name: "slide".to_owned(), duration_secs: 1.0, channels: vec![channel] }];
    (scene, from)
}

fn settings(traveller: DVec3, filter: Filter) -> Settings {
    let mut settings = Settings::default();
    settings.method.discretization.grid = 64;
    settings.method.discretization.filter = filter;
    settings.method.look.view = View::Surfaces;
    settings.method.look.surface = SurfaceView::Diffuse;
    settings.method.look.exposure_stops = Some(0.0);
    let target = traveller + DVec3::Y * 0.4;
    settings.shot.camera = Some(OrbitCamera::new(target + DVec3::new(1.2, 1.6, 1.4), target, 50.0));
    settings.method.cone_tracing.half_resolution = false;
    settings.method.cone_tracing.pattern_px = 1;
    settings.method.cone_tracing.cones = 16;
    settings.method.lighting.sky_nits = [1.0; 3];
    settings
}

/// Depths and light of every step.
fn series(filter: Filter) -> Vec<Vec<[f32; 2]>> {
    // The span does not depend on a clip of this length: the scene is far larger.
    let (scene, traveller) = sliding_traveller(0.0);
    let settings = settings(traveller, filter);
    let span =
        prepare(Arc::new(scene), &settings.method.discretization, None, &Progress::default()).expect("small").grid.span;
    let (scene, _) = sliding_traveller(span);
    let mut settings = settings;
    settings.method.discretization.span = Some(span);
    let prepared =
        prepare(Arc::new(scene), &settings.method.discretization, None, &Progress::default()).expect("small");
    let mut engine = Engine::new(Arc::new(open()));
    engine.set_prepared(Some(Arc::new(prepared)));
    let step = |step: u32| {
        settings.shot.motion.time_secs = f64::from(step) / f64::from(STEPS);
        engine.request(&settings, SIZE_PX).expect("a request");
        engine.run_to_end().expect("a frame");
        let light = engine.read_surfaces().expect("readable").expect("surfaces");
        let depth = engine.read_surface_part(SurfaceView::Depth).expect("readable").expect("surfaces");
        light.iter().zip(depth).map(|(light, depth)| [depth[0], light[1]]).collect()
    };
    (0..=STEPS).map(step).collect()
}

/// Of the light of pixels that show the same place in every step, over its mean.
fn largest_change(series: &[Vec<[f32; 2]>]) -> f32 {
    let stands_still = |pixel: usize| series.iter().all(|step| step[pixel][0] == series[0][pixel][0]);
    let still: Vec<usize> = (0..series[0].len()).filter(|&pixel| stands_still(pixel)).collect();
    assert!(still.len() > series[0].len() / 3, "{} pixels stand still", still.len());
    let mean = still.iter().map(|&pixel| series[0][pixel][1]).sum::<f32>() / still.len() as f32;
    let change = |pair: &[Vec<[f32; 2]>]| {
        let of_pixel = |&pixel: &usize| (pair[1][pixel][1] - pair[0][pixel][1]).abs();
        still.iter().map(of_pixel).fold(0.0, f32::max)
    };
    series.windows(2).map(change).fold(0.0, f32::max) / mean
}

#[test]
fn a_character_moved_by_fractions_of_a_voxel_flickers_at_most_a_quarter_as_much_when_split() {
    let [split, nearest] = [Filter::Split, Filter::Nearest].map(|filter| largest_change(&series(filter)));
    println!(
        "largest change in {STEPS} steps of 1/{STEPS} voxel over the mean: split {split:.4}, nearest {nearest:.4}"
    );
    assert!(split <= nearest / 4.0, "split {split}, nearest {nearest}");
}
