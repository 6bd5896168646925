//! Rays through the lattice: exactly the cells they cross, in order, whatever their direction.
//! `shared/ray_walk.wgsl` on the GPU against the reference's sorted crossings.

use glam::{DVec3, IVec3, Vec3};
use octolume::gpu::{Job, Recorder};
use octolume::stages::SHADERS;
use octolume::stages::pixels::crossings::crossings;
use proptest::prelude::*;

use crate::device::gpu;

const CELLS: u32 = 16;
const MAX_STEPS: usize = 3 * CELLS as usize + 1;

/// Walks every cell, one box of one cell at a time, and writes down cell, entry and exit.
const WALK: &str = "
    #import shared/threads.wgsl
    #import shared/ray_walk.wgsl
    struct Step { cell: vec3<i32>, enter: f32, leave: f32, pad0: u32, pad1: u32, pad2: u32 }
    @group(0) @binding(0) var<storage, read> rays: array<vec4<f32>>;
    @group(0) @binding(1) var<storage, read_write> steps: array<Step>;
    @group(0) @binding(2) var<storage, read_write> counts: array<u32>;
    @group(0) @binding(3) var<uniform> size: vec4<u32>;
    override WORKGROUP_SIZE: u32 = 64u;
    @compute @workgroup_size(WORKGROUP_SIZE)
    fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
        let thread = thread_index(id, groups);
        if thread >= threads.end { return; }
        let ray = ray_of(rays[2u * thread].xyz, rays[2u * thread + 1u].xyz);
        var walk = enter_lattice(ray, i32(size.x));
        var n = 0u;
        for (; n < size.y && walk.inside; n += 1u) {
            let exit = leave_box(ray, walk.cell, 1);
            steps[thread * size.y + n] = Step(walk.cell, walk.t, max(walk.t, exit.t), 0u, 0u, 0u);
            walk = walk_on(walk, ray, walk.cell, 1, exit, i32(size.x));
        }
        counts[thread] = n + select(0u, 1000000u, walk.inside);
    }
";

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
struct Step {
    cell: [i32; 3],
    enter: f32,
    leave: f32,
    pad: [u32; 3],
}

/// Every step of each ray through `cells`³ cells, after at most `limit`; panics if one goes on.
fn walk(rays: &[(Vec3, Vec3)], cells: u32, limit: usize) -> Vec<Vec<Step>> {
    walk_by(WALK, rays, cells, limit).unwrap_or_else(|error| panic!("{error}"))
}

/// The same by another kernel; an error if a ray goes on.
fn walk_by(source: &str, rays: &[(Vec3, Vec3)], cells: u32, limit: usize) -> Result<Vec<Vec<Step>>, String> {
    let gpu = gpu();
    let words: Vec<[f32; 4]> = rays.iter().flat_map(|(o, d)| [o.extend(0.0).into(), d.extend(0.0).into()]).collect();
    let buffer = gpu.upload("rays", &words).expect("fits");
    let bytes = (rays.len() * limit * size_of::<Step>()) as u64;
    let steps = gpu.buffer("steps", bytes, wgpu::BufferUsages::empty()).expect("fits");
    let counts = gpu.buffer("counts", 4 * rays.len() as u64, wgpu::BufferUsages::empty()).expect("fits");
    let mut recorder = Recorder::default();
    recorder
        .pass(&gpu.kernel_from_source("walk", source, &[]))
        .bind("rays", &buffer)
        .bind("steps", &steps)
        .bind("counts", &counts)
        .uniform("size", &[cells, limit as u32, 0, 0])
        .dispatch(rays.len() as u64);
    Job::new(recorder).run_to_end(gpu).expect("runs");
    let steps: Vec<Step> = gpu.read(&steps, 0..bytes).expect("readable");
    let counts: Vec<u32> = gpu.read(&counts, 0..4 * rays.len() as u64).expect("readable");
    let walked = steps.chunks(limit).zip(counts);
    walked
        .map(|(steps, count)| match steps.get(..count as usize) {
            Some(steps) => Ok(steps.to_vec()),
            None => Err(format!("goes on after {limit} steps")),
        })
        .collect()
}

/// t never decreases, cells are neighbours, none comes twice, none lies outside.
fn check_order(steps: &[Step], cells: u32, ray: &(Vec3, Vec3)) -> Result<(), String> {
    for pair in steps.windows(2) {
        if pair[1].enter < pair[0].enter || pair[0].leave != pair[1].enter {
            return Err(format!("{ray:?}: t jumps: {pair:?}"));
        }
        let way = IVec3::from(pair[1].cell) - IVec3::from(pair[0].cell);
        // Steps of one, along the ray only: no cell can come twice.
        let ahead = (0..3).all(|axis| way[axis] == 0 || (way[axis] > 0) == (ray.1[axis] > 0.0));
        if way.abs().element_sum() != 1 || !ahead {
            return Err(format!("{ray:?}: cells jump: {pair:?}"));
        }
    }
    let inside = |step: &Step| step.cell.iter().all(|&c| (0..cells as i32).contains(&c));
    if steps.iter().all(inside) { Ok(()) } else { Err(format!("{ray:?}: leaves the grid")) }
}

/// Cells crossed for longer than f32 can blur are those of the definition.
fn check_cells(steps: &[Step], cells: u32, ray: &(Vec3, Vec3)) -> Result<(), String> {
    // Positions are sums and products of numbers up to |o| + t; a step's rounding moves its ends by
    // a few units in the last place of those.
    let reach = ray.0.length().max(1.0) + 2.0 * cells as f32;
    let blur = f64::from(reach) * 8.0 * f64::from(f32::EPSILON);
    let expected = crossings(ray.0.as_dvec3(), ray.1.as_dvec3(), cells);
    // Crossings about as long as the blur may be on either list; all others are on both.
    if expected.iter().any(|c| (blur..4.0 * blur).contains(&(c.to - c.from))) {
        return Ok(());
    }
    let sure = |from: f64, to: f64| to - from > 2.0 * blur;
    let wanted: Vec<_> = expected.iter().filter(|c| sure(c.from, c.to)).map(|c| c.cell).collect();
    let long = steps.iter().filter(|s| sure(s.enter.into(), s.leave.into()));
    let seen: Vec<_> = long.map(|s| IVec3::from(s.cell)).collect();
    if seen == wanted { Ok(()) } else { Err(format!("{ray:?}: crosses {seen:?}, not {wanted:?}")) }
}

fn check_by(source: &str, rays: &[(Vec3, Vec3)]) -> Result<(), String> {
    for (steps, ray) in walk_by(source, rays, CELLS, MAX_STEPS)?.iter().zip(rays) {
        check_order(steps, CELLS, ray)?;
        check_cells(steps, CELLS, ray)?;
    }
    Ok(())
}

fn check(rays: &[(Vec3, Vec3)]) {
    assert_eq!(check_by(WALK, rays), Ok(()));
}

fn axial_rays() -> Vec<(Vec3, Vec3)> {
    let components = [0.0, -0.0, 1e-20, -1e-20, 1.0, -1.0];
    let starts = [Vec3::new(3.3, 5.7, 8.2), Vec3::new(-2.5, 4.5, 7.5), Vec3::new(20.0, 3.25, 0.75), Vec3::splat(8.0)];
    let mut rays = Vec::new();
    for x in components {
        for y in components {
            for z in components {
                let direction = Vec3::new(x, y, z);
                if direction.abs().max_element() == 1.0 {
                    rays.extend(starts.map(|start| (start, direction.normalize())));
                }
            }
        }
    }
    rays
}

#[test]
fn directions_with_zeros_and_almost_zeros() {
    check(&axial_rays());
}

/// Defects on purpose: the assertions of these tests must see them.
#[test]
fn a_wrong_walk_is_caught() {
    let walk_file = SHADERS.files.iter().find(|(path, _)| *path == "shared/ray_walk.wgsl").expect("embedded").1;
    let slanted: Vec<_> = (0..40_u16)
        .map(|i| f32::from(i) * 0.37)
        .map(|a| (Vec3::new(-4.0, 3.0, 5.0), Vec3::new(1.0, a.sin(), a.cos() * 0.5).normalize()))
        .collect();
    let rays = [axial_rays(), slanted].concat();
    let by = |from: &str, to: &str| {
        assert!(walk_file.contains(from), "{from}");
        check_by(&WALK.replace("#import shared/ray_walk.wgsl", &walk_file.replace(from, to)), &rays)
    };
    assert_eq!(by("", ""), Ok(()));
    for (from, to) in [
        ("select(low - 1, low + size, ray.forward)", "select(low, low + size, ray.forward)"),
        ("select(low, low + size, ray.forward)", "select(low + size, low, ray.forward)"),
        ("let t = max(walk.t, exit.t);", "let t = walk.t;"),
        ("min(times.x, min(times.y, times.z))", "min(times.x, times.y)"),
        ("all(cell >= vec3<i32>(0))", "true"),
    ] {
        by(from, to).expect_err(to);
    }
}

#[test]
fn rays_along_edges_and_through_corners() {
    let mut rays = Vec::new();
    for start in [
        Vec3::ZERO,
        Vec3::new(4.0, 4.0, 4.0),
        Vec3::new(4.0, 4.0, -3.0),
        Vec3::new(-5.0, -5.0, -5.0),
        Vec3::splat(16.0),
        Vec3::splat(21.0),
    ] {
        for x in [-1.0, 0.0, 1.0] {
            for y in [-1.0, 0.0, 1.0] {
                for z in [-1.0, 0.0, 1.0] {
                    if (x, y, z) != (0.0, 0.0, 0.0) {
                        rays.push((start, Vec3::new(x, y, z).normalize()));
                    }
                }
            }
        }
    }
    for (steps, ray) in walk(&rays, CELLS, MAX_STEPS).iter().zip(&rays) {
        assert_eq!(check_order(steps, CELLS, ray), Ok(()));
    }
    // Through corners exactly: the cells of the diagonal have all of the length.
    let diagonal = &walk(&[(Vec3::ZERO, Vec3::ONE.normalize())], CELLS, MAX_STEPS)[0];
    let long: Vec<_> = diagonal.iter().filter(|s| s.leave - s.enter > 1e-4).map(|s| s.cell).collect();
    assert_eq!(long, (0..16).map(|i| [i, i, i]).collect::<Vec<_>>());
}

#[test]
fn every_start_enters_rightly() {
    let along_x = Vec3::X;
    let first = |start: Vec3, direction: Vec3| {
        let steps = &walk(&[(start, direction)], CELLS, MAX_STEPS)[0];
        steps.iter().find(|step| step.leave > step.enter).map(|step| (step.cell, step.enter))
    };
    assert_eq!(first(Vec3::new(5.5, 2.5, 2.5), along_x), Some(([5, 2, 2], 0.0)), "inside");
    assert_eq!(first(Vec3::new(5.0, 2.5, 2.5), along_x), Some(([5, 2, 2], 0.0)), "on a face, ahead");
    assert_eq!(first(Vec3::new(5.0, 2.5, 2.5), -along_x), Some(([4, 2, 2], 0.0)), "on a face, back");
    assert_eq!(first(Vec3::new(0.0, 2.5, 2.5), along_x), Some(([0, 2, 2], 0.0)), "on the grid's face, in");
    assert_eq!(first(Vec3::new(0.0, 2.5, 2.5), -along_x), None, "on the grid's face, out");
    assert_eq!(first(Vec3::new(16.0, 2.5, 2.5), -along_x), Some(([15, 2, 2], 0.0)), "on the far face, in");
    assert_eq!(first(Vec3::new(-4.0, 2.5, 2.5), along_x), Some(([0, 2, 2], 4.0)), "outside, towards");
    assert_eq!(first(Vec3::new(-4.0, 2.5, 2.5), -along_x), None, "outside, away");
    assert_eq!(first(Vec3::new(-4.0, 16.0, 2.5), along_x), None, "along the grid's upper face: cells are half-open");
    assert_eq!(first(Vec3::new(-4.0, 0.0, 2.5), along_x), Some(([0, 0, 2], 4.0)), "along the grid's lower face");
    assert_eq!(first(Vec3::new(-1.0, -1.0, 5.0), Vec3::new(1.0, -1.0, 0.0).normalize()), None, "past it");
}

#[test]
fn a_zero_direction_is_a_miss() {
    for start in [Vec3::splat(3.5), Vec3::ZERO, Vec3::splat(-3.0)] {
        for direction in [Vec3::ZERO, -Vec3::ZERO, Vec3::splat(1e-35)] {
            assert!(walk(&[(start, direction)], CELLS, MAX_STEPS)[0].is_empty());
        }
    }
}

#[test]
fn far_starts_and_large_grids_end_within_3n_steps() {
    let cells = 1024;
    let mut rays = Vec::new();
    for distance in [10.0_f32, 1e4, 1e6] {
        for direction in [Vec3::new(1.0, 0.7, 0.3), Vec3::new(-0.9, 1.0, 0.001), Vec3::new(0.577, -0.578, 0.5765)] {
            let direction = direction.normalize();
            rays.push((Vec3::splat(512.0) - direction * distance, direction));
        }
    }
    for (steps, ray) in walk(&rays, cells, 3 * cells as usize).iter().zip(&rays) {
        assert_eq!(check_order(steps, cells, ray), Ok(()));
        assert!(!steps.is_empty());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]
    #[test]
    fn random_rays_cross_what_the_definition_says(
        rays in prop::collection::vec((prop::array::uniform3(-10.0_f32..26.0), prop::array::uniform3(-1.0_f32..1.0)), 256),
    ) {
        let rays: Vec<_> = rays
            .into_iter()
            .map(|(start, direction)| (Vec3::from(start), Vec3::from(direction).normalize_or(Vec3::X)))
            .collect();
        check(&rays);
    }
}

#[test]
fn the_reference_crosses_a_length_that_adds_up() {
    let origin = DVec3::new(-3.0, 2.2, 5.1);
    let direction = DVec3::new(0.9, 0.2, 0.3).normalize();
    let crossed = crossings(origin, direction, CELLS);
    let length: f64 = crossed.iter().map(|c| c.to - c.from).sum();
    let through = (crossed[crossed.len() - 1].to - crossed[0].from).abs();
    assert!((length - through).abs() < 1e-12);
    assert_eq!(crossed[0].entered, -DVec3::X);
}
