//! One step of a walk: something that can be set is set to something else.

use glam::DVec3;
use octolume::scene::OrbitCamera;
use octolume::settings::lighting::{AddedLight, LightEdit, Opacity, Shadows, SunShines};
use octolume::settings::{
    AlphaRule, ColorBy, Discretizer, Filter, Lookup, Sampling, Settings, SliceAxis, SliceValue, Stretching, ToneCurve,
    View, VoxelAnchor, VoxelizerCells,
};
use proptest::prelude::RngExt;
use proptest::test_runner::TestRng;

use crate::compose::ALL as ALL_SURFACES;

type Change = fn(&mut Settings, &mut TestRng);

pub fn one_of<T: Copy>(rng: &mut TestRng, values: &[T]) -> T {
    values[rng.random_range(0..values.len())]
}

fn between(rng: &mut TestRng, least: f64, most: f64) -> f64 {
    least + (most - least) * f64::from(rng.random_range(0..=1000_u32)) / 1000.0
}

fn flip(rng: &mut TestRng) -> bool {
    rng.random_range(0..2) == 1
}

const VIEWS: [View; 6] = [View::Voxels, View::Mesh, View::Ghost, View::Slice, View::ShadowMap, View::Surfaces];
const COLORS: [ColorBy; 7] = [
    ColorBy::Albedo,
    ColorBy::Normal,
    ColorBy::Occupancy,
    ColorBy::Object,
    ColorBy::Level,
    ColorBy::Radiance,
    ColorBy::Irradiance,
];
const LOOKUPS: [Lookup; 3] = [Lookup::Ranks, Lookup::BlockPointers, Lookup::NodePointers];
const SAMPLINGS: [Sampling; 3] = [Sampling::Nearest, Sampling::Trilinear, Sampling::Quadrilinear];

/// What everybody does most comes more than once.
const CHANGES: [Change; 51] = [
    |s, r| s.method.look.view = one_of(r, &VIEWS),
    |s, r| s.method.look.view = one_of(r, &VIEWS),
    |s, r| s.method.look.color = one_of(r, &COLORS),
    |s, r| s.method.look.color = one_of(r, &COLORS),
    |s, r| s.method.look.surface = one_of(r, &ALL_SURFACES),
    |s, _| s.method.look.view = View::Surfaces,
    |s, _| (s.method.look.view, s.method.look.color) = (View::Voxels, ColorBy::Radiance),
    |s, r| s.method.look.level = one_of(r, &[None, Some(2), Some(5)]),
    |s, r| s.method.look.alpha = one_of(r, &[AlphaRule::Paper, AlphaRule::Length]),
    |s, _| s.method.look.voxel_edges ^= true,
    |s, _| s.method.look.shaded ^= true,
    |s, _| s.method.look.accuracy ^= true,
    |s, _| s.method.look.accuracy ^= true,
    |s, _| s.method.look.pointers ^= true,
    |s, r| s.method.look.exposure_stops = one_of(r, &[None, Some(-2.0), Some(1.5)]),
    |s, r| s.method.look.tone_curve = one_of(r, &[ToneCurve::Linear, ToneCurve::Reinhard, ToneCurve::Aces]),
    |s, r| s.method.look.shadow_map = r.random_range(0..3),
    |s, r| s.method.look.slice.axis = one_of(r, &[SliceAxis::X, SliceAxis::Y, SliceAxis::Z]),
    |s, r| s.method.look.slice.height = between(r, 0.3, 0.7),
    |s, r| {
        s.method.look.slice.value = one_of(r, &[SliceValue::Radiance, SliceValue::Irradiance, SliceValue::Occupancy])
    },
    |s, r| s.method.look.slice.lookup = one_of(r, &LOOKUPS),
    |s, r| s.method.look.slice.sampling = one_of(r, &SAMPLINGS),
    |s, r| (s.method.look.slice.logarithmic, s.method.look.slice.width_cells) = (flip(r), one_of(r, &[1.0, 3.0])),
    |s, r| s.shot.camera = flip(r).then(|| camera(r)),
    |s, r| s.shot.camera = Some(camera(r)),
    |s, r| s.method.discretization.filter = one_of(r, &[Filter::Nearest, Filter::Split]),
    |s, r| s.method.discretization.filter = one_of(r, &[Filter::Nearest, Filter::Split]),
    |s, r| s.method.discretization.dense_level = one_of(r, &[None, Some(2), Some(4), Some(6)]),
    |s, r| s.method.discretization.anchor = one_of(r, &[VoxelAnchor::Centre, VoxelAnchor::Corner]),
    |s, r| s.method.discretization.discretizer = one_of(r, &[Discretizer::Transform, Discretizer::Voxelize]),
    |s, r| s.method.discretization.stretching = one_of(r, &[Stretching::Move, Stretching::Voxelize]),
    |s, r| s.method.discretization.cells = one_of(r, &[VoxelizerCells::Sparse, VoxelizerCells::Dense]),
    |s, r| s.shot.motion.time_secs = between(r, 0.0, 1.2),
    |s, r| s.shot.motion.time_secs = between(r, 0.0, 1.2),
    |s, r| s.shot.motion.clip = one_of(r, &[None, Some("clip"), Some("")]).map(str::to_owned),
    |s, r| s.shot.motion.turn_degrees[1] = one_of(r, &[0.0, 10.0, 37.0]),
    |s, r| toggle_hidden(s, r),
    |s, r| s.method.lighting.sun.shines = one_of(r, &[SunShines::Unlit, SunShines::Always, SunShines::Never]),
    |s, r| s.method.lighting.sky_nits = [one_of(r, &[0.0, 0.5, 2.0]); 3],
    |s, r| s.method.lighting.emission = one_of(r, &[0.0, 1.0, 3.0]),
    |s, r| s.method.lighting.shadows = one_of(r, &[Shadows::Map, Shadows::March, Shadows::Off]),
    |s, r| s.method.lighting.shadow_map_px = one_of(r, &[512, 1024]),
    |s, r| s.method.lighting.opacity = one_of(r, &[Opacity::Isotropic, Opacity::Directional]),
    |s, r| (s.method.lighting.bounces, s.method.lighting.cones) = (r.random_range(0..3), one_of(r, &[1, 2])),
    |s, r| edit_light(s, r),
    |s, r| edit_light(s, r),
    |s, r| edit_light(s, r),
    |s, r| {
        let cones = &mut s.method.cone_tracing;
        (cones.diffuse, cones.specular, cones.ambient_occlusion) = (flip(r), flip(r), flip(r));
    },
    |s, r| {
        (s.method.cone_tracing.lookup, s.method.cone_tracing.sampling) = (one_of(r, &LOOKUPS), one_of(r, &SAMPLINGS))
    },
    |s, r| (s.method.cone_tracing.half_resolution, s.method.cone_tracing.pattern_px) = (flip(r), one_of(r, &[1, 2, 4])),
    |s, r| {
        let cones = &mut s.method.cone_tracing;
        cones.indirect_px = one_of(r, &[None, Some([32, 24])]);
        (cones.glossy_roughness, cones.cones) = (one_of(r, &[0.05, 0.6, 1.0]), one_of(r, &[1, 3]));
    },
];

pub fn change(settings: &mut Settings, rng: &mut TestRng) {
    for _ in 0..rng.random_range(1..=3) {
        one_of(rng, &CHANGES)(settings, rng);
    }
}

fn camera(rng: &mut TestRng) -> OrbitCamera {
    let eye = DVec3::new(between(rng, -8.0, 8.0), between(rng, 2.0, 9.0), between(rng, 5.0, 12.0));
    OrbitCamera::new(eye, DVec3::new(0.0, 1.0, 0.0), one_of(rng, &[30.0, 60.0]))
}

/// Nodes 0 is in every scene, 2 and 3 in the busy one: elsewhere they are refused, as a walk expects.
fn toggle_hidden(settings: &mut Settings, rng: &mut TestRng) {
    let node = one_of(rng, &[0, 0, 2, 3]);
    if !settings.shot.visibility.hidden.remove(&node) {
        settings.shot.visibility.hide(node);
    }
}

fn edit_light(settings: &mut Settings, rng: &mut TestRng) {
    let kind = octolume::scene::LightKind::Directional;
    let light = LightEdit { on: flip(rng), kind, color: [1.0, 0.5, 0.2], intensity: between(rng, 0.5, 4.0) };
    match rng.random_range(0..3) {
        0 => settings.method.lighting.edits.clear(),
        1 => drop(settings.method.lighting.edits.insert(6, light)),
        _ if settings.method.lighting.added.is_empty() => {
            let (name, position, direction) = ("ours".to_owned(), [1.0, 3.0, 1.0], [0.2, -1.0, 0.3]);
            settings.method.lighting.added.push(AddedLight { name, light, position, direction });
        }
        _ => settings.method.lighting.added.clear(),
    }
}
