//! Shadow maps of every kind of light: what a square hides from a floor, against exact rays, and what lies
//! outside the map.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use glam::{DQuat, DVec3};
use octolume::data::mesh::{MeshScene, PosedMesh, Textures};
use octolume::data::octree::Slot;
use octolume::gpu::{Gpu, GpuBuffer};
use octolume::lights::PosedLight;
use octolume::scene::{Aabb, AlphaMode, LightKind, LocalTransform, Material, Node, Scene, Trs};
use octolume::settings::Filter;
use octolume::settings::Hidden;
use octolume::settings::lighting::Shadows;
use octolume::stages::light::illuminate::{self, LightParams};
use octolume::stages::light::illuminate_ref::{self, Source};
use octolume::stages::light::shadow::{ShadowMap, ShadowParams};
use octolume::stages::pixels::NO_DEPTH;
use octolume::stages::textures::halve::record_levels;

use crate::device::gpu;
use crate::light_rig::{LightRig, full, grid, light, point, sun};
use crate::mesh_rig::{node, one_square, scene, square};
use crate::stage_build::Shape;
use crate::stage_rig::{buffer, read, run};

const SIZE_PX: u32 = 512;
const HEIGHT: f64 = 10.0;
const MIDDLE: DVec3 = DVec3::new(16.0, HEIGHT, 16.0);
/// Half of the square's side, cells.
const HALF: f64 = 4.0;

/// A level square over the middle of a floor of 32 x 32 cells.
pub fn occluder(material: Material) -> Scene {
    let mut scene = one_square(material);
    let rotation = DQuat::from_rotation_x(-std::f64::consts::FRAC_PI_2);
    let placed = Trs { translation: MIDDLE, rotation, scale: DVec3::splat(HALF) };
    scene.nodes[0].local = LocalTransform::Trs(placed);
    scene
}

fn floor() -> LightRig {
    let cells: Vec<_> = (0..32 * 32).map(|i| full([i % 32, 0, i / 32], DVec3::Y, [255; 3])).collect();
    LightRig::new(gpu(), &cells, &Shape::new(5, 3, Filter::Nearest))
}

fn bounds() -> Option<Aabb> {
    Some(Aabb { min: DVec3::ZERO, max: DVec3::new(32.0, HEIGHT, 32.0) })
}

pub fn mapped(gpu: &Gpu, scene: &Scene, lit: &PosedLight) -> ShadowMap {
    let objects = (0..).zip(scene.objects()).collect();
    let mut mesh = MeshScene::new(Arc::new(scene.clone()), objects, record_levels);
    while !mesh.upload(gpu, (&Hidden::default(), Textures::BaseColor), Duration::ZERO).expect("fits") {}
    let of_pose = (&scene.pose(None, 0.0), &Hidden::default());
    let to_grid = grid(5).grid_from_world();
    let posed = PosedMesh::new(gpu, &mesh, &mut Slot::default(), of_pose, &to_grid).expect("fits");
    let map = ShadowMap::new(gpu, ShadowParams::new(lit, &grid(5), bounds(), SIZE_PX)).expect("fits");
    run(gpu, |frame| map.record(gpu, frame, &posed));
    map
}

/// Share of the light that reaches each leaf, by slot.
fn visibility(rig: &LightRig, lit: &PosedLight, map: &ShadowMap) -> Vec<f64> {
    let count = u64::from(rig.built.params.leaf_count);
    let irradiance = |shadows| -> Vec<[f32; 3]> {
        let sum: GpuBuffer = buffer(gpu(), "irradiance", 3 * count);
        let params = LightParams::new(lit, &grid(5), 1.5);
        run(gpu(), |frame| {
            frame.clear(&sum);
            illuminate::record(gpu(), frame, &rig.octree, &sum, &params, (shadows, map));
        });
        read(gpu(), &sum, count)
    };
    let share = |(lit, open): (&[f32; 3], &[f32; 3])| if open[0] > 0.0 { f64::from(lit[0] / open[0]) } else { 1.0 };
    irradiance(Shadows::Map).iter().zip(&irradiance(Shadows::Off)).map(share).collect()
}

/// How far inside the square's shadow a place is, cells at the square's height; negative outside.
fn depth_in_shadow(start: DVec3, source: Source) -> f64 {
    let (to_light, length) = match source {
        Source::Sun(direction) => (-direction, f64::INFINITY),
        Source::Point(position, _) | Source::Spot(position, ..) => {
            ((position - start).normalize(), (position - start).length())
        }
    };
    let t = (HEIGHT - start.y) / to_light.y;
    let at = start + to_light * t - MIDDLE;
    let inside = HALF - at.x.abs().max(at.z.abs());
    if t < length { inside } else { f64::NEG_INFINITY }
}

fn lights() -> Vec<(PosedLight, Source)> {
    let high = DVec3::new(12.0, 28.0, 18.0);
    let slanted = DVec3::new(0.4, -1.0, 0.3);
    let spot = |outer: f32| LightKind::Spot { range: None, inner_cone_radians: 0.0, outer_cone_radians: outer };
    let cosines = |outer: f64| [1.0, outer.cos()];
    let down = (MIDDLE - high).normalize();
    vec![
        (sun(slanted, 1.0), Source::Sun(slanted.normalize())),
        (sun(DVec3::NEG_Y, 1.0), Source::Sun(DVec3::NEG_Y)),
        (point(high, 1.0), Source::Point(high, None)),
        (light(spot(0.7), DVec3::ONE, high, down), Source::Spot(high, down, cosines(0.7), None)),
        (light(spot(1.4), DVec3::ONE, high, down), Source::Spot(high, down, cosines(1.4), None)),
    ]
}

#[test]
fn a_square_hides_what_exact_rays_say() {
    let rig = floor();
    for (lit, source) in lights() {
        let map = mapped(gpu(), &occluder(Material::default()), &lit);
        let mut hidden = 0;
        for (found, (centre, _)) in visibility(&rig, &lit, &map).into_iter().zip(rig.leaves()) {
            let inside = depth_in_shadow(centre + DVec3::Y * 1.5, source);
            // Within two texels of the border the map may blend.
            let texel = 2.0 * 64.0 / f64::from(SIZE_PX / 2);
            if inside.abs() > texel || !inside.is_finite() {
                assert_eq!(found, if inside > 0.0 { 0.0 } else { 1.0 }, "{:?} at {centre}, {inside} inside", lit.kind);
                hidden += usize::from(inside > 0.0);
            }
        }
        assert!(hidden > 20, "{:?}: {hidden}", lit.kind);
    }
}

#[test]
fn what_is_beyond_the_light_or_outside_the_map_is_lit() {
    let rig = floor();
    // Below the square: nothing lies between light and floor.
    let below = point(DVec3::new(16.0, HEIGHT - 1.0, 16.0), 1.0);
    let map = mapped(gpu(), &occluder(Material::default()), &below);
    assert!(visibility(&rig, &below, &map).iter().all(|share| *share == 1.0));
    // A map of another light, which looks away: no layer sees the floor.
    let spot = LightKind::Spot { range: None, inner_cone_radians: 0.0, outer_cone_radians: 0.5 };
    let away = light(spot, DVec3::ONE, DVec3::new(16.0, 1.0, 16.0), DVec3::Y);
    let lit = sun(DVec3::NEG_Y, 1.0);
    let map = mapped(gpu(), &occluder(Material::default()), &away);
    assert!(visibility(&rig, &lit, &map).iter().all(|share| *share == 1.0));
    let nothing = ShadowParams::new(&lit, &grid(5), None, SIZE_PX);
    assert_eq!(nothing.count, 0, "without bounds there is nothing to map");
}

#[test]
fn masks_cast_by_their_cutoff_and_blends_by_their_share() {
    let rig = floor();
    let lit = sun(DVec3::NEG_Y, 1.0);
    let material =
        |alpha_mode, alpha| Material { alpha_mode, base_color: [1.0, 1.0, 1.0, alpha], ..Material::default() };
    let mean = |material| {
        let map = mapped(gpu(), &occluder(material), &lit);
        let shares: Vec<f64> = visibility(&rig, &lit, &map)
            .into_iter()
            .zip(rig.leaves())
            .filter(|(_, (centre, _))| depth_in_shadow(*centre, Source::Sun(DVec3::NEG_Y)) > 1.0)
            .map(|(share, _)| share)
            .collect();
        shares.iter().sum::<f64>() / shares.len() as f64
    };
    assert_eq!(mean(material(AlphaMode::Mask { cutoff: 0.5 }, 0.4)), 1.0);
    assert_eq!(mean(material(AlphaMode::Mask { cutoff: 0.5 }, 0.6)), 0.0);
    let blended = mean(material(AlphaMode::Blend, 0.25));
    assert!((blended - 0.75).abs() < 0.1, "{blended}");
}

#[test]
fn hidden_objects_cast_nothing_and_broken_matrices_are_left_out() {
    let mut broken = occluder(Material::default());
    broken.nodes.push(Node { mesh: Some(0), ..node("broken", DVec3::NAN) });
    let lit = sun(DVec3::NEG_Y, 1.0);
    let with = read_map(&mapped(gpu(), &broken, &lit));
    let without = read_map(&mapped(gpu(), &occluder(Material::default()), &lit));
    assert_eq!(with, without);
    let empty = scene(vec![square()], vec![node("nothing", DVec3::ZERO)]);
    assert_eq!(read_map(&mapped(gpu(), &empty, &lit)).keys().copied().collect::<Vec<_>>(), [NO_DEPTH.to_bits()]);
}

/// How often each distance occurs.
pub fn read_map(map: &ShadowMap) -> BTreeMap<u32, usize> {
    let bytes = gpu().read_texture(&map.texture).expect("readable");
    let mut counts = BTreeMap::new();
    for texel in bytemuck::pod_collect_to_vec::<u8, u32>(&bytes) {
        *counts.entry(texel).or_default() += 1;
    }
    counts
}

#[test]
fn distances_are_cells_along_the_axis() {
    let lit = sun(DVec3::NEG_Y, 1.0);
    let map = read_map(&mapped(gpu(), &occluder(Material::default()), &lit));
    let distances: Vec<f32> = map.keys().map(|bits| f32::from_bits(*bits)).filter(|d| *d < NO_DEPTH).collect();
    // Along −y the square at height 10 lies at −10.
    assert!(distances.iter().all(|d| (d + HEIGHT as f32).abs() < 1e-4), "{distances:?}");
    let (towards, distance) = illuminate_ref::towards(Source::Sun(DVec3::NEG_Y), DVec3::ZERO);
    assert_eq!((towards, distance), (DVec3::Y, f64::INFINITY));
}
