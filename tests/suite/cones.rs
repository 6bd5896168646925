//! Cones through the lit octree: against the f64 reference and closed forms.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use octolume::data::packing::unpack_normal;
use octolume::gpu::Gpu;
use octolume::settings::Filter;
use octolume::settings::lighting::Opacity;
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::light::gather::{self, ConeParams, Cones, Gathered};
use octolume::stages::light::gather_ref::{self, ConeLight, basis, cosine_directions};
use octolume::stages::pixels::LEAST_LIGHT;
use proptest::prelude::RngExt;

use crate::device::{gpu, open};
use crate::lit_octree::LitBuild;
use crate::octree_rules::{self as rules, Cell};
use crate::random::{self, ONE};
use crate::stage_build::Shape;
use crate::stage_checks::{Check, holds};
use crate::stage_rig::{read, run, upload};

const DEPTH: u32 = 5;
const ISOTROPIC: Opacity = Opacity::Isotropic;
const DIRECTIONAL: Opacity = Opacity::Directional;

/// Irradiance of every leaf by its cell.
pub fn gathered(gpu: &Gpu, octree: &LitBuild, what: Gathered, cones: &Cones, opacity: Opacity) -> Vec<(Cell, DVec3)> {
    let count = u64::from(octree.built.params.leaf_count);
    // What lies there before: bounces replace it, the sky adds to it.
    let irradiance = upload(gpu, "irradiance", &vec![[1.0_f32; 3]; count as usize]);
    let params = ConeParams::new(cones, [1.0, 2.0, 0.5]);
    run(gpu, |frame| {
        let light = (&octree.light, opacity);
        gather::record(gpu, frame, &octree.read_by_cones(), light, (what, &params), &irradiance);
    });
    let values: Vec<[f32; 3]> = read(gpu, &irradiance, count);
    let of = |(cell, slot): (Cell, usize)| (cell, Vec3::from_array(values[slot]).as_dvec3());
    rules::leaf_slots(&octree.built).map(of).collect()
}

fn cones(count: u32, aperture_degrees: f64) -> Cones {
    Cones { count, aperture_degrees, ..Cones::default() }
}

/// A voxel a cell of the block, with this normal.
fn solid(low: Cell, high: Cell, normal: [u32; 3]) -> impl Iterator<Item = Fragment> {
    let row = move |y: u32, z: u32| (low[0]..high[0]).map(move |x| [x, y, z]);
    let cells = (low[2]..high[2]).flat_map(move |z| (low[1]..high[1]).flat_map(move |y| row(y, z)));
    cells.map(move |cell| Fragment { q: cell.map(|c| i64::from(c) * ONE), normal, albedo: [128; 3], coverage: 255 })
}

/// 16³ voxels of opacity `alpha`.
fn full_grid(alpha: f64) -> LitBuild {
    let voxels: Vec<_> = solid([0; 3], [16; 3], [511, 511, 1022]).collect();
    LitBuild::new(gpu(), &voxels, &Shape::new(4, 2, Filter::Nearest), |_, _| (DVec3::ONE, alpha))
}

/// Sky or bounces of a random scene of so many voxels against the reference, by 7 cones.
pub fn check_random_scene(
    gpu: &Gpu,
    (seed, count): (u64, usize),
    (aperture, step_diameters, opacity): (f64, f64, Opacity),
    what: Gathered,
) -> Check {
    let light = |cell: Cell, a: f64| (DVec3::from_array(cell.map(|c| f64::from(c % 5) * 0.25)), a);
    let shape = Shape::new(DEPTH, 2, Filter::Split);
    let octree = LitBuild::new(crate::device::gpu(), &random::scene(seed, count, DEPTH), &shape, light);
    let cones = Cones { step_diameters, ..cones(7, aperture) };
    let lit = octree.lit(opacity);
    let normals = rules::leaf_slots(&octree.built).map(|(_, slot)| octree.built.leaves[slot][2]);
    let all = gathered(gpu, &octree, what, &cones, opacity);
    for ((cell, found), normal) in all.into_iter().zip(normals).step_by(31) {
        let center = DVec3::from_array(cell.map(f64::from)) + 0.5;
        let ConeLight { radiance, through } = gather_ref::gather(&lit, &cones, center, unpack_normal(normal));
        let expected = match what {
            Gathered::Sky => DVec3::ONE + DVec3::new(1.0, 2.0, 0.5) * through * PI,
            Gathered::Bounce => radiance * PI,
        };
        // Cones end early with LEAST_LIGHT to go. A place is off by the roundings of a sum of steps,
        // 2^-24 of 64 cells a step; α changes by at most 3 a cell and stands in a power of up to 64.
        let tolerance = PI * 2.0 * (LEAST_LIGHT + 3.0 * 64.0 * 64.0 * 64.0 * 2.0_f64.powi(-24));
        let off = (found - expected).abs().max_element();
        holds(off < tolerance, || format!("{cell:?} {cones:?} {what:?}: {found}, not {expected}"))?;
    }
    Ok(())
}

#[test]
fn random_scenes_match_the_reference() {
    for scene in [(1, 60), (2, 2000)] {
        for by in [(0.0, 1.0, ISOTROPIC), (30.0, 0.5, DIRECTIONAL), (60.0, 1.0, ISOTROPIC), (179.0, 0.25, DIRECTIONAL)]
        {
            for what in [Gathered::Sky, Gathered::Bounce] {
                assert_eq!(check_random_scene(gpu(), scene, by, what), Ok(()));
            }
        }
    }
}

#[test]
fn a_homogeneous_medium_lets_through_what_the_closed_form_says() {
    for alpha in [0.02, 0.3] {
        let octree = full_grid(alpha);
        for aperture in [0.0, 2.0, 30.0, 90.0] {
            for step_diameters in [0.25, 0.7, 1.0, 2.0] {
                // From the middle, a cone this long stays half a node away from the border, at every level it reads.
                let cones = Cones { step_diameters, reach_cells: 3.4, start_cells: 0.0, ..cones(6, aperture) };
                for opacity in [ISOTROPIC, DIRECTIONAL] {
                    for (what, arrives) in [(Gathered::Sky, 1.0), (Gathered::Bounce, 0.0)] {
                        let all = gathered(gpu(), &octree, what, &cones, opacity);
                        let middle = all.iter().find(|(cell, _)| *cell == [8; 3]).expect("a full grid");
                        let through = (1.0 - alpha).powf(3.4);
                        let expected = PI * if arrives == 1.0 { through } else { 1.0 - through } + arrives;
                        // About 15 steps of a few roundings; α of directional nodes up to 8 wide, see sampling.rs.
                        let across = 3.0 * 2.0_f64.powi(-24) * (1.0 - alpha).powf(1.0 - 8.0) / 8.0 * 3.4;
                        let tolerance =
                            PI * (15.0 * 8.0 * 2.0_f64.powi(-24) + if opacity == DIRECTIONAL { across } else { 0.0 });
                        assert!(
                            (middle.1.x - expected).abs() < tolerance,
                            "α {alpha}, {cones:?}, {what:?}: {middle:?}, not {expected}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn the_aperture_is_the_full_apex_angle() {
    // At distance 10 a cone of 90 degrees is 20 wide.
    assert!((cones(1, 90.0).widening() * 10.0 - 20.0).abs() < 1e-12);
    assert!(cones(1, 0.0).widening() == 0.0);
    // The widest reads the root, which is as full as the grid.
    let octree = full_grid(0.25);
    let widest = Cones { start_cells: 0.0, reach_cells: 1.0, ..cones(3, 180.0) };
    let params = ConeParams::new(&widest, [0.0; 3]);
    assert!(params.shape.widening.is_finite() && params.shape.widening > 1e9);
    assert!(gathered(gpu(), &octree, Gathered::Sky, &widest, ISOTROPIC).iter().all(|(_, e)| e.is_finite()));
}

#[test]
fn an_empty_hemisphere_sees_the_whole_sky_and_a_closed_one_nothing() {
    // A slab with its face up, at the top of which nothing hides the sky from narrow cones.
    let slab: Vec<_> = solid([0, 0, 0], [32, 32, 6], [511, 511, 1022]).collect();
    let octree = LitBuild::new(gpu(), &slab, &Shape::new(DEPTH, 3, Filter::Nearest), |_, a| (DVec3::ZERO, a));
    for (cell, irradiance) in gathered(gpu(), &octree, Gathered::Sky, &cones(16, 0.0), ISOTROPIC) {
        // Beside the border a cone leaves before its first step is over.
        if cell.iter().take(2).any(|c| !(2..30).contains(c)) {
            continue;
        }
        let expected = match cell[2] {
            5 => PI,
            // Its apex lies on the slab's face, where half is stopped.
            4 => continue,
            _ => 0.0,
        };
        let tolerance = PI * (LEAST_LIGHT + 1e-6);
        assert!((irradiance.x - 1.0 - expected).abs() < tolerance, "{cell:?}: {irradiance}");
    }
}

/// Cloth, whose normals cancel, under an open sky.
pub fn check_cloth(gpu: &Gpu) -> Check {
    // One layer: half of what it sees is the sky above, half below.
    let cloth: Vec<_> = solid([0, 0, 16], [32, 32, 17], [511; 3]).collect();
    let octree =
        LitBuild::new(crate::device::gpu(), &cloth, &Shape::new(DEPTH, 3, Filter::Nearest), |_, a| (DVec3::ZERO, a));
    for (cell, irradiance) in gathered(gpu, &octree, Gathered::Sky, &cones(16, 0.0), ISOTROPIC) {
        holds((irradiance.x - 1.0 - PI).abs() < 1e-5, || format!("{cell:?}: {irradiance}"))?;
    }
    Ok(())
}

#[test]
fn leaves_without_a_normal_look_both_ways() {
    assert_eq!(check_cloth(gpu()), Ok(()));
}

#[test]
fn every_workgroup_size_gathers_the_same_bits() {
    let voxels = random::scene(5, 900, DEPTH);
    let all = [32, 64, 128].map(|size| {
        let gpu = open().with_workgroup_size(size);
        let octree = LitBuild::new(&gpu, &voxels, &Shape::new(DEPTH, 2, Filter::Split), |_, a| (DVec3::ONE, a));
        let count = u64::from(octree.built.params.leaf_count);
        let irradiance = upload(&gpu, "irradiance", &vec![[0.0_f32; 3]; count as usize]);
        let params = ConeParams::new(&cones(8, 30.0), [1.0; 3]);
        run(&gpu, |frame| {
            let what = (Gathered::Bounce, &params);
            gather::record(&gpu, frame, &octree.read_by_cones(), (&octree.light, ISOTROPIC), what, &irradiance);
        });
        read::<u32>(&gpu, &irradiance, 3 * count)
    });
    assert!(all.windows(2).all(|pair| pair[0] == pair[1]));
}

/// Writes directions and bases as the shaders make them.
const CONE_SET: &str = "
    #import shared/threads.wgsl
    #import shared/cone_set.wgsl
    @group(0) @binding(0) var<storage, read_write> vectors: array<vec4<f32>>;
    override WORKGROUP_SIZE: u32 = 64u;
    @compute @workgroup_size(WORKGROUP_SIZE)
    fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
        let thread = thread_index(id, groups);
        if thread >= threads.end { return; }
        let n = vectors[4u * thread];
        let basis = basis_of(n.xyz);
        vectors[4u * thread] = vec4<f32>(cosine_direction(thread % u32(n.w), u32(n.w)), 0.0);
        vectors[4u * thread + 1u] = vec4<f32>(basis[0], 0.0);
        vectors[4u * thread + 2u] = vec4<f32>(basis[1], 0.0);
        vectors[4u * thread + 3u] = vec4<f32>(basis[2], 0.0);
    }
";

#[test]
fn directions_and_bases_are_those_of_the_reference() {
    let mut rng = random::rng(7);
    let axis = |i: i32| Vec3::new((i % 3 - 1) as f32, (i / 3 % 3 - 1) as f32, (i / 9 - 1) as f32);
    let mut normals: Vec<Vec3> = (0..27).filter(|i| *i != 13).map(axis).collect();
    normals.extend((0..200).map(|_| Vec3::from_array([(); 3].map(|()| rng.random_range(-1.0..1.0)))));
    // Where a naive basis breaks.
    normals.extend([Vec3::new(1e-20, 0.0, -1.0), Vec3::new(0.0, -0.0, -1.0), Vec3::new(1e-4, -1e-4, -1.0)]);
    let count = 11;
    let words: Vec<[f32; 4]> = normals
        .iter()
        .flat_map(|n| [n.normalize().extend(count as f32).to_array(), [0.0; 4], [0.0; 4], [0.0; 4]])
        .collect();
    let vectors = upload(gpu(), "vectors", &words);
    let kernel = gpu().kernel_from_source("cone set", CONE_SET, &[]);
    run(gpu(), |frame| frame.pass(&kernel).bind("vectors", &vectors).dispatch(normals.len() as u64));
    let found: Vec<[f32; 4]> = read(gpu(), &vectors, words.len() as u64);
    let vector = |words: &[f32; 4]| Vec3::from_slice(words).as_dvec3();
    for (i, (n, found)) in normals.iter().zip(found.chunks(4)).enumerate() {
        let direction = cosine_directions(count)[i % count as usize];
        // Angles up to 11 turns of 2^-24, and the sine's own error of 2^-11 (WGSL) where it is worst; software and
        // hardware stay below 2^-20.
        assert!(vector(&found[0]).distance(direction) < 1e-5, "direction {i}");
        let expected = basis(n.normalize().as_dvec3());
        for (axis, column) in found[1..].iter().enumerate() {
            // 1 / (1 + |z|) is at most 1, so nothing is magnified.
            assert!(vector(column).distance(expected.col(axis)) < 16.0 * f64::from(f32::EPSILON), "axis {axis} of {n}");
        }
    }
}
