//! The BRDF of surfaces: what it sends back of all that arrives, and the fit of that in the shaders.

use std::f64::consts::PI;

use glam::DVec3;
use octolume::stages::surface::brdf_ref::{ALBEDO_FIT_ERROR, specular_albedo};

use crate::device::gpu;
use crate::stage_rig::{buffer, read, run, upload};

/// The specular lobe sends back no more than arrives, and a white surface, over all ways to look at it, 4.5 %
/// more at most: glTF adds a diffuse part that knows nothing of how little light its lobe lets through at
/// grazing angles.
#[test]
fn a_white_furnace_gains_nothing_but_where_gltf_does() {
    let middles = |count: u32| (0..count).map(move |i| (f64::from(i) + 0.5) / f64::from(count));
    let diffuse: Vec<f64> = middles(16).map(white_diffuse).collect();
    for roughness in middles(8) {
        let mut mean = 0.0;
        for (cosine, diffuse) in middles(16).zip(&diffuse) {
            let (scale, bias) = specular_albedo(roughness, cosine, 96);
            assert!(scale + bias < 1.0 + 1e-3, "{roughness} {cosine}: {}", scale + bias);
            mean += 2.0 * cosine / 16.0 * (diffuse + 0.04 * scale + bias);
        }
        assert!(mean < 1.045, "{roughness}: {mean}");
    }
}

/// Share of a uniform sky that a white dielectric's diffuse part reflects to an eye at this cosine.
fn white_diffuse(cosine: f64) -> f64 {
    let to_eye = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
    hemisphere(|to_light| {
        let half_way = (to_light + to_eye).normalize();
        let fresnel = 0.04 + 0.96 * (1.0 - to_eye.dot(half_way)).powi(5);
        (1.0 - fresnel) / PI * to_light.z
    })
}

/// ∫ over all directions above the plane, by the middles of 64² patches of equal area.
fn hemisphere(of: impl Fn(DVec3) -> f64) -> f64 {
    const SIDE: u32 = 64;
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE);
    let patches = (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (at(i), at(j))));
    let sum: f64 = patches
        .map(|(z, turn)| {
            let level = (1.0 - z * z).sqrt();
            of(DVec3::new(level * (2.0 * PI * turn).cos(), level * (2.0 * PI * turn).sin(), z))
        })
        .sum();
    sum * 2.0 * PI / f64::from(SIDE * SIDE)
}

const FIT: &str = "
    #import shared/threads.wgsl
    #import shared/brdf.wgsl
    @group(0) @binding(0) var<uniform> view: ViewParams;
    @group(0) @binding(1) var surface_near: texture_2d<u32>;
    @group(0) @binding(2) var surface_stuff: texture_2d<u32>;
    // f0, roughness, cosine.
    @group(0) @binding(3) var<storage, read> asked: array<vec4<f32>>;
    @group(0) @binding(4) var<storage, read_write> found: array<f32>;
    override WORKGROUP_SIZE: u32 = 64u;
    @compute @workgroup_size(WORKGROUP_SIZE)
    fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
        let i = thread_index(id, groups);
        if i < threads.end {
            found[i] = specular_albedo(vec3<f32>(asked[i].x), asked[i].y, asked[i].z).x;
        }
    }
";

#[test]
fn the_fit_of_the_specular_albedo_is_as_near_as_it_says() {
    let shares = |count: u32| (0..=count).map(move |i| f64::from(i) / f64::from(count));
    let cosines = || [0.005, 0.01, 0.02, 0.03].into_iter().chain(shares(24).skip(1));
    let rows = shares(24).flat_map(|roughness| cosines().map(move |cosine| (roughness, cosine)));
    let asked: Vec<(f64, f64, f64)> = rows.flat_map(|(r, c)| [0.0, 0.04, 0.5, 1.0].map(|f0| (f0, r, c))).collect();
    let words: Vec<[f32; 4]> = asked.iter().map(|&(f0, r, c)| [f0 as f32, r as f32, c as f32, 0.0]).collect();
    let kernel = gpu().kernel_from_source("fit", FIT, &[]);
    let (asked_on_gpu, found) = (upload(gpu(), "asked", &words), buffer(gpu(), "found", words.len() as u64));
    run(gpu(), |frame| {
        frame.pass(&kernel).bind("asked", &asked_on_gpu).bind("found", &found).dispatch(words.len() as u64);
    });
    let found: Vec<f32> = read(gpu(), &found, words.len() as u64);
    let (mut sum, mut most) = (0.0, [0.0_f64; 4]);
    for (i, (&(f0, roughness, cosine), found)) in asked.iter().zip(found).enumerate() {
        let (scale, bias) = specular_albedo(roughness, cosine, 64);
        let expected = if f0 == 0.0 { 0.0 } else { f0 * scale + bias };
        let error = (f64::from(found) - expected).abs();
        most[i % 4] = most[i % 4].max(error);
        sum += error / asked.len() as f64;
    }
    assert!(sum < 0.006 && most[0] == 0.0 && most[1] < 0.06, "mean {sum}, most {most:?}");
    assert!(most[2].max(most[3]) < ALBEDO_FIT_ERROR, "most {most:?}");
}
