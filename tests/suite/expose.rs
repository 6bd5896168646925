//! The exposure of a picture of surfaces, measured and used without the CPU.

use octolume::gpu::{GpuBuffer, Recorder};
use octolume::settings::{ColorBy, Look, SurfaceView, ToneCurve};
use octolume::stages::pixels::camera::PixelRays;
use octolume::stages::pixels::{Picture, ViewParams};
use octolume::stages::surface::count_luminance::{self, COUNT_BYTES, LUMINANCE_BINS};
use octolume::stages::surface::expose::{self, EXPOSURE_BYTES, PictureExposure};
use octolume::stages::surface::{count_luminance_ref, expose_ref};
use octolume::stages::view::Palette;
use octolume::stages::view::show_surfaces::{self, ShowSurfacesParams, ShownExposure};
use proptest::prelude::RngExt;
use wgpu::BufferUsages;

use crate::device::gpu;
use crate::random;
use crate::stage_rig::{buffer, read, run, upload};
use crate::view_rig::{SIZE_PX, Seen, camera, grid, seen};

/// A few last places of f32.
const TOLERANCE: f64 = 1e-6;

fn exposure_buffer() -> GpuBuffer {
    gpu().buffer("exposure", EXPOSURE_BYTES, BufferUsages::UNIFORM).expect("small")
}

fn count_buffer() -> GpuBuffer {
    buffer(gpu(), "counts", COUNT_BYTES / 4)
}

fn measured(counts: &GpuBuffer) -> PictureExposure {
    let exposure = exposure_buffer();
    gpu().write(&exposure, 0, &[0xff; EXPOSURE_BYTES as usize]).expect("fits");
    run(gpu(), |frame| expose::record(gpu(), frame, counts, &exposure));
    read(gpu(), &exposure, 1)[0]
}

fn assert_is(found: PictureExposure, bright: Option<f64>) {
    let near = |found: f32, expected: f64| (f64::from(found) - expected).abs() <= TOLERANCE * expected;
    assert!(near(found.bright, bright.unwrap_or(0.0)), "{found:?} of {bright:?}");
    assert!(near(found.factor, expose_ref::factor(bright)), "{found:?} of {bright:?}");
}

#[test]
fn counts_make_the_exposure_of_the_reference() {
    let mut rng = random::rng(5);
    for bins in [0, 1, 2, 60, LUMINANCE_BINS] {
        let mut counts = vec![0; LUMINANCE_BINS as usize];
        for _ in 0..bins {
            // Those of f32's largest numbers, and what is not finite, are no luminances.
            counts[rng.random_range(0..LUMINANCE_BINS as usize / 2 - 32)] += rng.random_range(1..100_000_u32);
        }
        let bright = expose_ref::bright(&counts);
        assert_eq!(bright.is_some(), bins > 0);
        assert_is(measured(&upload(gpu(), "counts", &counts)), bright);
    }
}

/// By bits, but for pixels whose luminance is a last place from the border of a bin.
#[test]
fn pixels_are_counted_as_the_reference_counts_them() {
    let mut rng = random::rng(6);
    let pixels: Vec<[f32; 4]> = (0..30_000)
        .map(|_| {
            let scale = f32::exp2(rng.random_range(-30.0..30.0));
            let is_lit = rng.random_range(0..4) > 0;
            let channel = |value: f32| if is_lit { value * scale } else { 0.0 };
            let [r, g, b] = [0; 3].map(|_| channel(rng.random_range(0.0..1.0)));
            [r, g, b, f32::from(u8::from(rng.random_range(0..9) > 0))]
        })
        .collect();
    let (shown, counts) = (upload(gpu(), "shown", &pixels), count_buffer());
    gpu().write(&counts, 0, &[0xff; COUNT_BYTES as usize]).expect("fits");
    run(gpu(), |frame| count_luminance::record(gpu(), frame, pixels.len() as u32, &shown, &counts));
    let found: Vec<u32> = read(gpu(), &counts, u64::from(LUMINANCE_BINS));
    let expected = count_luminance_ref::counts(&pixels);
    assert_eq!(found.iter().sum::<u32>(), expected.iter().sum::<u32>());
    let moved: u32 = found.iter().zip(&expected).map(|(a, b)| a.abs_diff(*b)).sum();
    // A bin has 2^19 values of f32: of 30 000 pixels less than one is expected that near to a border.
    assert!(moved <= 4, "{moved}");
}

/// Surfaces and their light, in one recording from the sums to the picture, or with an exposure that is set.
fn drawn(values: &[[f32; 4]], exposure: Option<f64>) -> Seen {
    let surfaces = octolume::data::surface_image::SurfaceImage::new(gpu(), SIZE_PX).expect("fits");
    let view = ViewParams::new(
        &PixelRays::new(&camera(&grid(4), glam::DVec3::ONE, 2.0), &grid(4), SIZE_PX),
        &Look::default(),
        4,
    );
    let (shown, counts) = (upload(gpu(), "shown", values), count_buffer());
    let measured = exposure_buffer();
    let picture = Picture::new(gpu(), SIZE_PX).expect("fits");
    let mut frame = Recorder::default();
    count_luminance::record(gpu(), &mut frame, values.len() as u32, &shown, &counts);
    expose::record(gpu(), &mut frame, &counts, &measured);
    let exposure = exposure.map_or(ShownExposure::Measured(&measured), ShownExposure::Set);
    let params = ShowSurfacesParams { least: 0.0, most: 1.0, sky: 0, pad: 0 };
    let with = (&view, &Palette::new(ColorBy::Occupancy), &params);
    let how = (SurfaceView::Final, ToneCurve::Reinhard, exposure);
    show_surfaces::record(gpu(), &mut frame, (&surfaces, &shown), how, with, &picture);
    seen(gpu(), frame, &picture)
}

#[test]
fn a_measured_exposure_shows_what_the_same_one_shows_set() {
    let mut rng = random::rng(8);
    let pixels = (SIZE_PX[0] * SIZE_PX[1]) as usize;
    let values: Vec<[f32; 4]> = (0..pixels)
        .map(|_| [rng.random_range(0.0..40.0), rng.random_range(0.0..9.0), rng.random_range(0.0..2.0), 1.0])
        .collect();
    let bright = expose_ref::bright(&count_luminance_ref::counts(&values));
    let (measured, set) = (drawn(&values, None), drawn(&values, Some(expose_ref::factor(bright))));
    let off = |(a, b): (&glam::DVec3, &glam::DVec3)| (*a - *b).abs().max_element();
    // What rounds to the other of two neighbouring bytes.
    assert!(measured.colors.iter().zip(&set.colors).map(off).all(|off| off < 1.01 / 255.0));
    let other = drawn(&values, Some(1.0));
    assert!(measured.colors.iter().zip(&other.colors).map(off).any(|off| off > 10.0 / 255.0), "exposures show");
}
