//! Specular cones: which tiles need them, what they see, and how wide they are.

use glam::{DVec3, Vec3};
use octolume::data::surface_image::SurfaceTexel;
use octolume::gpu::{Gpu, Job, Recorder};
use octolume::settings::{ConeTracing, Lookup};
use octolume::stages::cones::glossy_tiles::{self, GlossyParams, TileBuffers};
use octolume::stages::cones::glossy_tiles_ref::glossy_tiles;
use octolume::stages::cones::list_tiles_ref::list_tiles;
use octolume::stages::cones::specular::{self, SpecularParams, aperture_degrees};
use octolume::stages::cones::{ConesInput, image_bytes, specular_ref, tile_count};
use octolume::stages::light::gather::Cones;
use octolume::stages::sample::{SampledOctree, Sampler};
use proptest::prelude::RngExt;

use crate::cone_light::{DEPTH, SIZE_PX, SKY, random_octree, scattered, tolerance};
use crate::cone_rig::{NOTHING, Photo, dull, ray, source};
use crate::device::gpu;
use crate::random;
use crate::stage_checks::{Check, holds, same};
use crate::stage_rig::{buffer, read, run};
use crate::view_rig::{camera, grid};

/// The listed tiles of a photo for an image of that size.
fn listed(photo: &Photo, size_px: [u32; 2], most_roughness: f64) -> (TileBuffers, glossy_tiles::TileList, Vec<u32>) {
    let mut buffers = TileBuffers::default();
    let params = GlossyParams::new(size_px, most_roughness);
    let mut list = None;
    run(gpu(), |frame| list = glossy_tiles::record(gpu(), frame, &photo.surfaces(), &params, &mut buffers).ok());
    let list = list.expect("buffers fit");
    let (counts, at) = list.count_at();
    let count = gpu().read::<u32>(counts, at..at + 4).expect("readable")[0];
    let tiles = read(gpu(), &list.list, 1 + u64::from(count));
    (buffers, list, tiles)
}

/// The specular image of a photo.
pub fn reflected(
    gpu: &Gpu,
    octree: &SampledOctree,
    photo: &Photo,
    settings: &ConeTracing,
    sky: [f32; 3],
) -> Vec<[f32; 4]> {
    let size_px = photo.size_px();
    let image = buffer(gpu, "specular", image_bytes(size_px) / 4);
    let (_, list, tiles) = listed(photo, size_px, settings.glossy_roughness);
    let input = ConesInput { octree, surfaces: photo.surfaces() };
    let params = SpecularParams::new(settings, sky, size_px);
    let tiles = (&list, tiles[0]);
    run(gpu, |frame| specular::record(gpu, frame, &input, (&Sampler::default(), &params), tiles, &image));
    read(gpu, &image, image_bytes(size_px) / 16)
}

fn is_glossy(texel: Option<&SurfaceTexel>, most_roughness: f64) -> bool {
    texel.is_some_and(|texel| {
        texel.roughness <= most_roughness && (texel.metallic < 1.0 || texel.albedo.iter().any(|part| *part > 0.0))
    })
}

#[test]
fn tiles_are_listed_in_order_where_a_pixel_is_glossy() {
    let grid = grid(DEPTH);
    let camera = camera(&grid, DVec3::ONE, 1.4);
    for (size_px, small_px, share) in
        [([83, 45], [83, 45], 200), ([83, 45], [42, 23], 30), ([640, 300], [640, 300], 4000)]
    {
        let photo = Photo::new(gpu(), (&grid, &camera), size_px, |[x, y], _| {
            let i = (x * 7919 + y * 104_729) % share;
            let unlit = SurfaceTexel { albedo: [0.0; 3], metallic: 1.0, roughness: 0.0, ..dull(9.0, DVec3::Z) };
            match i {
                0 => SurfaceTexel { roughness: 0.3, ..dull(9.0, DVec3::Z) },
                1 => unlit,
                2 => SurfaceTexel { roughness: 0.0, ..NOTHING },
                _ => SurfaceTexel { roughness: 0.8, ..dull(9.0, DVec3::Z) },
            }
        });
        let pixels = (0..small_px[1]).flat_map(|y| (0..small_px[0]).map(move |x| [x, y]));
        let glossy: Vec<bool> =
            pixels.map(|pixel| is_glossy(photo.texel(source(&photo, pixel, small_px)), 0.6)).collect();
        let expected = list_tiles(&glossy_tiles(&glossy, small_px));
        assert!((1..tile_count(small_px)).contains(&expected[0]));
        assert_eq!(listed(&photo, small_px, 0.6).2, expected);
        assert_eq!(listed(&photo, small_px, 0.2).2, [0]);
    }
}

/// Specular cones against the reference.
pub fn check_specular(gpu: &Gpu) -> Check {
    let (photo, octree) = (scattered(), random_octree(41, 1500));
    let settings = ConeTracing { glossy_roughness: 0.5, ..ConeTracing::default() };
    let found = reflected(gpu, &octree.sampled(Lookup::Ranks), &photo, &settings, SKY);
    let cones = Cones {
        start_cells: settings.start_voxels,
        step_diameters: settings.step_diameters,
        reach_cells: f64::INFINITY,
        ..Cones::default()
    };
    let lit = octree.lit(Sampler::default().opacity);
    let mut compared = 0;
    for (i, found) in found.iter().enumerate() {
        let pixel = [i as u32 % SIZE_PX[0], i as u32 / SIZE_PX[0]];
        let (Some(texel), Some(point)) = (photo.texel(pixel), photo.point(pixel)) else {
            same("a pixel without a cone", found, &[0.0; 4])?;
            continue;
        };
        if !is_glossy(Some(texel), 0.5) {
            same("a pixel without a cone", found, &[0.0; 4])?;
            continue;
        }
        let surface = (&point, ray(&photo.rays, pixel).direction, texel.roughness);
        let sky = Vec3::from_array(SKY).as_dvec3();
        let expected = specular_ref::specular(&lit, (&cones, Sampler::default().sampling), sky, surface);
        let off = (Vec3::from_slice(found).as_dvec3() - expected).abs().max_element();
        holds(off < tolerance() && found[3] == 1.0, || format!("{pixel:?}: {found:?}, not {expected}"))?;
        compared += 1;
    }
    holds(compared > 200, || format!("{compared} pixels"))
}

#[test]
fn specular_cones_match_the_reference() {
    assert_eq!(check_specular(gpu()), Ok(()));
}

#[test]
fn cones_end_at_the_listed_tiles_and_at_the_room_for_them() {
    let (photo, octree) = (scattered(), random_octree(41, 1500));
    let settings = ConeTracing { glossy_roughness: 0.5, ..ConeTracing::default() };
    let exact = reflected(gpu(), &octree.sampled(Lookup::Ranks), &photo, &settings, SKY);
    let (_, list, tiles) = listed(&photo, photo.size_px(), settings.glossy_roughness);
    let params = SpecularParams::new(&settings, SKY, photo.size_px());
    let sampled = octree.sampled(Lookup::Ranks);
    let input = ConesInput { octree: &sampled, surfaces: photo.surfaces() };
    let image = buffer(gpu(), "specular", image_bytes(photo.size_px()) / 4);
    let traced = |room: u32| {
        let mut frame = Recorder::default();
        let with = (&Sampler::default(), &params);
        specular::record(gpu(), &mut frame, &input, with, (&list, room), &image);
        let timings = Job::new(frame).run_to_end(gpu()).expect("runs");
        let pixels: Vec<[f32; 4]> = read(gpu(), &image, image_bytes(photo.size_px()) / 16);
        (pixels, timings[1].threads, timings[1].bytes_moved)
    };
    let count = tiles[0];
    let threads = u64::from(count) * 64;
    for room in [count, count + 1, 3 * count + 100] {
        assert!(traced(room) == (exact.clone(), threads, 48 * threads), "room for {room} of {count}");
    }
    let (few, threads, _) = traced(count - 1);
    assert_eq!(threads, u64::from(count - 1) * 64);
    let across = photo.size_px()[0].div_ceil(8);
    let last = tiles[count as usize];
    for (i, (few, exact)) in few.iter().zip(&exact).enumerate() {
        let [x, y] = [i as u32 % photo.size_px()[0], i as u32 / photo.size_px()[0]];
        let is_last = y / 8 * across + x / 8 == last;
        assert_eq!(*few, if is_last { [0.0; 4] } else { *exact });
    }
    assert!(traced(0).0.iter().all(|pixel| *pixel == [0.0; 4]));
}

#[test]
fn half_of_what_a_rough_mirror_reflects_lies_in_its_cone() {
    let mut rng = random::rng(12);
    println!("roughness | full apex, degrees | mean angle of GGX reflections from the mirror direction, degrees");
    for roughness in [0.1, 0.2, 0.3, 0.36] {
        let alpha: f64 = roughness * roughness;
        let half = aperture_degrees(roughness) / 2.0;
        // Seen straight on; normals are drawn by D(h)·(n·h): tan²θ = α²·u / (1 − u).
        let angles: Vec<f64> = (0..200_000)
            .map(|_| {
                let u: f64 = rng.random_range(0.0..1.0);
                2.0 * (alpha * (u / (1.0 - u)).sqrt()).atan().to_degrees()
            })
            .collect();
        let inside = angles.iter().filter(|angle| **angle < half).count() as f64 / angles.len() as f64;
        let mean = angles.iter().sum::<f64>() / angles.len() as f64;
        println!("{roughness:9} | {:18.1} | {mean:.1}", 2.0 * half);
        // Four standard errors of a share of 200 000.
        assert!((inside - 0.5).abs() < 4.0 * 0.5 / 200_000.0_f64.sqrt(), "{roughness}: {inside}");
    }
    assert_eq!(aperture_degrees(0.0), 1.0);
    assert_eq!(aperture_degrees(1.0), 30.0);
}
