//! Writes each occupied leaf's light: albedo/π · irradiance + emission (section 4.3).

use bytemuck::{Pod, Zeroable};

use super::LitOctree;
use crate::data::light::{IRRADIANCE_BYTES, LIGHT_BYTES};
use crate::data::octree::OctreeParams;
use crate::gpu::{Counted, Gpu, GpuBuffer, Mirror, Recorder, mirror};

/// Mirror of `InjectParams` in shaders/light/inject.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct InjectParams {
    pub emission_nits: f32,
}

pub const MIRRORS: &[Mirror] = &[mirror!(InjectParams, "light/inject.wgsl", "InjectParams", emission_nits)];

/// What a leaf's light is made of.
#[derive(Clone, Copy, Debug)]
pub struct Injected<'a> {
    /// Irradiance of lights and sky, three floats an occupied leaf.
    pub direct: &'a GpuBuffer,
    /// That of bounces.
    pub gathered: Option<&'a GpuBuffer>,
    /// What leaves emit, and its unit in nits.
    pub emission: Option<(&'a GpuBuffer, f32)>,
}

/// Into the leaves of `light`.
pub fn record(gpu: &Gpu, frame: &mut Recorder, octree: &LitOctree, from: Injected<'_>, light: &GpuBuffer) {
    record_as(gpu, frame, octree, (from, false), light);
}

/// The irradiance itself instead, for the view of it.
pub fn record_irradiance(gpu: &Gpu, frame: &mut Recorder, octree: &LitOctree, from: Injected<'_>, light: &GpuBuffer) {
    record_as(gpu, frame, octree, (Injected { emission: None, ..from }, true), light);
}

fn record_as(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &LitOctree,
    (from, irradiance): (Injected<'_>, bool),
    light: &GpuBuffer,
) {
    let flag = |on: bool| f64::from(u8::from(on));
    let constants = [
        ("GATHERED", flag(from.gathered.is_some())),
        ("EMISSION", flag(from.emission.is_some())),
        ("IRRADIANCE", flag(irradiance)),
    ];
    let terms = 1 + u64::from(from.gathered.is_some()) + u64::from(from.emission.is_some());
    frame
        .pass(&gpu.kernel("light/inject.wgsl", &constants))
        .bind("octree", &octree.sizes.buffer)
        .uniform("params", &InjectParams { emission_nits: from.emission.map_or(0.0, |(_, nits)| nits) })
        .bind("leaves", &octree.leaves)
        .bind("direct", from.direct)
        // What is switched off is bound, and not read.
        .bind("gathered", from.gathered.unwrap_or(from.direct))
        .bind("leaf_emission", from.emission.map_or(from.direct, |(emission, _)| emission))
        .bind("light", light)
        .counted(&octree.sizes.buffer, move |octree: &OctreeParams| {
            let threads = u64::from(octree.leaf_count);
            Counted { threads, bytes: threads * (8 + terms * IRRADIANCE_BYTES + LIGHT_BYTES) }
        })
        .dispatch(octree.sizes.params.leaf_count.into());
}
