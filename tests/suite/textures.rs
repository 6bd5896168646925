//! Smaller levels of images: kernel against reference, means and shares that stay, and surfaces seen small.

use std::sync::Arc;

use glam::DVec3;
use image::{Rgba, RgbaImage};
use octolume::color::{gamma_from_linear, linear_from_gamma};
use octolume::data::texels::Texels;
use octolume::gpu::{Gpu, GpuTexture, Job, Recorder};
use octolume::scene::{AlphaMode, Material, Scene, Texture, TextureRef, Wrap};
use octolume::stages::pixels::NO_DEPTH;
use octolume::stages::textures::halve::{self, HalveParams};
use octolume::stages::textures::halve_ref;
use octolume::stages::voxelize::TexturePyramids;

use crate::device::gpu;
use crate::mesh_rig::{Seen, drawn, look, one_square};
use crate::stage_checks::Check;

const KINDS: [Texels; 5] =
    [Texels::Linear, Texels::Opaque, Texels::Covering, Texels::Cut { least: 100 }, Texels::Cut { least: 256 }];

fn texture(gpu: &Gpu, [width, height]: [u32; 2]) -> GpuTexture {
    use wgpu::TextureUsages as Usage;
    let descriptor = wgpu::TextureDescriptor {
        label: Some("level"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: Usage::TEXTURE_BINDING | Usage::STORAGE_BINDING | Usage::COPY_SRC | Usage::COPY_DST,
        view_formats: &[],
    };
    gpu.texture(&descriptor).expect("fits")
}

/// What the kernel makes of a level.
fn halved(gpu: &Gpu, image: &RgbaImage, texels: Texels, is_first: bool) -> Vec<[u8; 4]> {
    let size = [image.width(), image.height()];
    let half = size.map(|side| (side / 2).max(1));
    let (finer, next) = (texture(gpu, size), texture(gpu, half));
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * size[0]), rows_per_image: None };
    let extent = wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 };
    gpu.queue.write_texture(finer.raw().as_image_copy(), image.as_raw(), layout, extent);
    let mut recorder = Recorder::default();
    let params = HalveParams::new(half, texels, is_first);
    halve::record(gpu, &mut recorder, (finer.view(), next.view()), (size, params));
    Job::new(recorder).run_to_end(gpu).expect("runs");
    gpu.read_texture(&next).expect("readable").as_chunks().0.to_vec()
}

/// Bytes of every kind, in no order.
fn noise([width, height]: [u32; 2]) -> RgbaImage {
    RgbaImage::from_fn(width, height, |x, y| {
        let hash = blake3::hash(&[x.to_le_bytes(), y.to_le_bytes()].concat());
        let [r, g, b, a, ..] = *hash.as_bytes();
        // Some texels are not there at all.
        Rgba([r, g, b, if a < 64 { 0 } else { a }])
    })
}

/// The kernel agrees with the reference: rounding to a byte, and a hundredth of one for f32.
pub fn check_halving(gpu: &Gpu) -> Check {
    for size in [[1, 1], [2, 2], [7, 5], [1, 9], [32, 3], [65, 66]] {
        let image = noise(size);
        let bytes: Vec<[u8; 4]> = image.as_raw().as_chunks().0.to_vec();
        for (texels, is_first) in KINDS.into_iter().flat_map(|texels| [(texels, true), (texels, false)]) {
            let (_, expected) = halve_ref::halve(size.map(|side| side as usize), &bytes, texels, is_first);
            let found = halved(gpu, &image, texels, is_first);
            let off = |(found, expected): (&[u8; 4], &[f64; 4])| {
                (0..4).any(|c| (f64::from(found[c]) - 255.0 * expected[c]).abs() > 0.51)
            };
            if found.len() != expected.len() || found.iter().zip(&expected).any(off) {
                return Err(format!("{size:?} {texels:?} first {is_first}: {found:?} is not {expected:?}"));
            }
        }
    }
    Ok(())
}

#[test]
fn the_kernel_halves_as_the_reference() {
    assert_eq!(check_halving(gpu()), Ok(()));
}

/// Every second texel is white, the others are black.
fn checker() -> RgbaImage {
    RgbaImage::from_fn(64, 64, |x, y| if (x + y) % 2 == 0 { Rgba([255; 4]) } else { Rgba([0, 0, 0, 255]) })
}

/// Of each row of 20 texels, the first `of_20` are there.
fn fence(of_20: u32) -> RgbaImage {
    RgbaImage::from_fn(320, 320, |x, y| Rgba([255, 0, 0, if (x + 7 * y) % 20 < of_20 { 255 } else { 0 }]))
}

#[test]
fn half_white_is_half_the_light_and_half_there_is_half_covered() {
    let white = (255.0 * gamma_from_linear(0.5)).round() as u8;
    for texel in halved(gpu(), &checker(), Texels::Opaque, true) {
        assert_eq!(texel, [white, white, white, 255]);
    }
    for texel in halved(gpu(), &checker(), Texels::Linear, true) {
        assert_eq!(texel, [128, 128, 128, 255]);
    }
    // Of four texels with alphas 0, 99, 100 and 255, two pass; the colour is theirs.
    let texels = [[10, 10, 10, 0], [20, 20, 20, 99], [30, 30, 30, 100], [255, 255, 255, 255]];
    let image = RgbaImage::from_raw(2, 2, texels.concat()).expect("four texels");
    let mean = (linear_from_gamma(30.0 / 255.0) + linear_from_gamma(1.0)) / 2.0;
    let color = (255.0 * gamma_from_linear(mean)).round() as u8;
    assert_eq!(halved(gpu(), &image, Texels::Cut { least: 100 }, true), [[color, color, color, 128]]);
}

fn square_of(image: RgbaImage, alpha_mode: AlphaMode, repeat: f32) -> Scene {
    let texture = Texture { name: "image".to_owned(), image: Arc::new(image), wrap: [Wrap::Repeat; 2], nearest: false };
    let base_color_texture = Some(TextureRef::new(0, 0));
    let mut scene = one_square(Material { base_color_texture, alpha_mode, ..Material::default() });
    scene.textures = vec![texture];
    scene.meshes[0].primitives[0].tex_coords[0].iter_mut().for_each(|at| *at *= repeat);
    scene
}

/// Linear means over the pixels of the square, and how many they are.
fn mean_seen(scene: &Scene) -> DVec3 {
    let whole = drawn(gpu(), one_square(Material::default()), &look());
    let seen = drawn(gpu(), scene.clone(), &look());
    let at: Vec<usize> = (0..whole.colors.len()).filter(|at| whole.distances[*at] < NO_DEPTH).collect();
    at.iter().map(|&at| DVec3::from_array(seen.colors[at].to_array().map(linear_from_gamma))).sum::<DVec3>()
        / at.len() as f64
}

#[test]
fn a_texture_seen_small_keeps_its_mean() {
    for repeat in [1.0, 2.0, 5.0, 20.0, 100.0] {
        let mean = mean_seen(&square_of(checker(), AlphaMode::Opaque, repeat));
        // 188 of 255 is 0.5029 of the light; near, pixels fall on texels unevenly.
        assert!((mean - DVec3::splat(0.5)).abs().max_element() < 0.005, "{repeat} times: {mean}");
    }
}

#[test]
fn a_mask_seen_small_keeps_its_coverage() {
    for (of_20, repeat) in [5, 8, 12].into_iter().flat_map(|of_20| [1.0, 2.0, 5.0, 100.0].map(|r| (of_20, r))) {
        let seen = drawn(gpu(), square_of(fence(of_20), AlphaMode::Mask { cutoff: 0.5 }, repeat), &look());
        let whole = drawn(gpu(), one_square(Material::default()), &look());
        let covered = |seen: &Seen| seen.distances.iter().filter(|distance| **distance < NO_DEPTH).count() as f64;
        let share = covered(&seen) / covered(&whole);
        // Thresholds go in steps of a 64th, and the square is not a whole number of their pattern.
        assert!((share - f64::from(of_20) / 20.0).abs() < 0.03, "{of_20} of 20, {repeat} times: {share}");
    }
}

#[test]
fn voxels_of_a_mask_are_covered_by_its_share() {
    let image = fence(5);
    let texture = Texture { name: "fence".to_owned(), image: Arc::new(image), wrap: [Wrap::Repeat; 2], nearest: false };
    let pyramids = TexturePyramids::new(&[texture]);
    let is_there = |alpha: f64| alpha >= 0.5;
    let sample = |uv_area| pyramids.sample_cut(0, 128, (glam::DVec2::new(0.37, 0.81), uv_area), is_there);
    for uv_area in [0.01, 0.1, 1.0] {
        let [r, g, b, share] = sample(uv_area);
        assert!((share - 0.25).abs() < 0.02, "{uv_area}: {share}");
        assert!((r - 1.0).abs() < 1e-3 && g == 0.0 && b == 0.0, "what is not there colours nothing");
    }
    // A texel is larger than the piece: there, or not.
    assert!([0.0, 1.0].contains(&sample(0.0)[3]));
}
