//! `shared/ray_walk.wgsl` on the GPU: every step of a ray, and what a walk must hold to.

use glam::{IVec3, Vec3};
use octolume::gpu::{Job, Recorder};
use octolume::stages::pixels::crossings::crossings;

use crate::device::gpu;

pub const CELLS: u32 = 16;
pub const MAX_STEPS: usize = 3 * CELLS as usize + 1;

/// Walks every cell, one box of one cell at a time, and writes down cell, entry and exit.
pub const WALK: &str = "
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
pub struct Step {
    pub cell: [i32; 3],
    pub enter: f32,
    pub leave: f32,
    pad: [u32; 3],
}

/// Every step of each ray through `cells`³ cells, after at most `limit`; panics if one goes on.
pub fn walk(rays: &[(Vec3, Vec3)], cells: u32, limit: usize) -> Vec<Vec<Step>> {
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
pub fn check_order(steps: &[Step], cells: u32, ray: &(Vec3, Vec3)) -> Result<(), String> {
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

pub fn check_by(source: &str, rays: &[(Vec3, Vec3)]) -> Result<(), String> {
    for (steps, ray) in walk_by(source, rays, CELLS, MAX_STEPS)?.iter().zip(rays) {
        check_order(steps, CELLS, ray)?;
        check_cells(steps, CELLS, ray)?;
    }
    Ok(())
}
