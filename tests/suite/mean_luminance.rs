//! The exposure of a picture of surfaces, measured and used without the CPU.

use octolume::gpu::{GpuBuffer, Recorder};
use octolume::settings::{ColorBy, Look, SurfaceView, ToneCurve};
use octolume::stages::pixels::camera::PixelRays;
use octolume::stages::pixels::{MEAN_SHOWN_AS, Picture, ViewParams};
use octolume::stages::surface::mean_luminance::{self, EXPOSURE_BYTES, PictureExposure};
use octolume::stages::surface::sum_luminance::{self, SUM_BYTES, SUM_THREADS};
use octolume::stages::surface::{mean_luminance_ref, sum_luminance_ref};
use octolume::stages::view::Palette;
use octolume::stages::view::show_surfaces::{self, ShowSurfacesParams, ShownExposure};
use proptest::prelude::RngExt;
use wgpu::BufferUsages;

use crate::device::gpu;
use crate::random;
use crate::stage_rig::{buffer, read, run, upload};
use crate::view_rig::{SIZE_PX, Seen, camera, grid, seen};

/// A few last places of an f32 sum of logarithms up to 10, as a share of the mean.
const TOLERANCE: f64 = 1e-5;

fn exposure_buffer() -> GpuBuffer {
    gpu().buffer("exposure", EXPOSURE_BYTES, BufferUsages::UNIFORM).expect("small")
}

fn measured(sums: &GpuBuffer) -> (GpuBuffer, PictureExposure) {
    let exposure = exposure_buffer();
    gpu().write(&exposure, 0, &[0xff; EXPOSURE_BYTES as usize]).expect("fits");
    run(gpu(), |frame| mean_luminance::record(gpu(), frame, sums, &exposure));
    let found = read(gpu(), &exposure, 1)[0];
    (exposure, found)
}

fn assert_is(found: PictureExposure, mean: Option<f64>) {
    let near = |found: f32, expected: f64| (f64::from(found) - expected).abs() <= TOLERANCE * expected;
    assert!(near(found.mean, mean.unwrap_or(0.0)), "{found:?} of {mean:?}");
    assert!(near(found.factor, mean_luminance_ref::factor(mean)), "{found:?} of {mean:?}");
}

#[test]
fn sums_make_the_exposure_of_the_reference() {
    let mut rng = random::rng(5);
    for lit_percent in [0, 1, 50, 100] {
        let sums: Vec<[f32; 2]> = (0..SUM_THREADS)
            .map(|_| {
                let count = if rng.random_range(0..100) < lit_percent { rng.random_range(1..2000) as f32 } else { 0.0 };
                [count * rng.random_range(-9.0..9.0), count]
            })
            .collect();
        let (_, found) = measured(&upload(gpu(), "sums", &sums));
        let mean = mean_luminance_ref::mean_luminance(&sums);
        assert_eq!(mean.is_some(), lit_percent > 0);
        assert_is(found, mean);
    }
}

#[test]
fn one_grey_is_shown_as_the_mean_is() {
    let shown = upload(gpu(), "shown", &[[6.0_f32, 6.0, 6.0, 1.0]; 3000]);
    let sums = buffer(gpu(), "sums", SUM_BYTES / 4);
    run(gpu(), |frame| sum_luminance::record(gpu(), frame, 3000, &shown, &sums));
    let (_, found) = measured(&sums);
    assert_is(found, Some(6.0));
    assert!((f64::from(found.factor) * 6.0 - MEAN_SHOWN_AS).abs() < TOLERANCE);
}

/// Surfaces and their light, in one recording from the sums to the picture, or with an exposure that is set.
fn drawn(values: &[[f32; 4]], exposure: Option<f64>) -> Seen {
    let surfaces = octolume::data::surface_image::SurfaceImage::new(gpu(), SIZE_PX).expect("fits");
    let view = ViewParams::new(
        &PixelRays::new(&camera(&grid(4), glam::DVec3::ONE, 2.0), &grid(4), SIZE_PX),
        &Look::default(),
        4,
    );
    let (shown, sums) = (upload(gpu(), "shown", values), buffer(gpu(), "sums", SUM_BYTES / 4));
    let measured = exposure_buffer();
    let picture = Picture::new(gpu(), SIZE_PX).expect("fits");
    let mut frame = Recorder::default();
    sum_luminance::record(gpu(), &mut frame, values.len() as u32, &shown, &sums);
    mean_luminance::record(gpu(), &mut frame, &sums, &measured);
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
    let mean = sum_luminance_ref::mean_luminance(&values);
    let (measured, set) = (drawn(&values, None), drawn(&values, Some(mean_luminance_ref::factor(mean))));
    let off = |(a, b): (&glam::DVec3, &glam::DVec3)| (*a - *b).abs().max_element();
    // What rounds to the other of two neighbouring bytes.
    assert!(measured.colors.iter().zip(&set.colors).map(off).all(|off| off < 1.01 / 255.0));
    let other = drawn(&values, Some(1.0));
    assert!(measured.colors.iter().zip(&other.colors).map(off).any(|off| off > 10.0 / 255.0), "exposures show");
}
