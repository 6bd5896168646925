//! The filter behind the cones: against its reference, on constants, at edges.

use glam::{DVec3, DVec4};
use octolume::data::surface_image::SurfaceTexel;
use octolume::stages::cones::blur::{self, Along, BlurParams};
use octolume::stages::cones::blur_ref::{FilterPoint, blur_line, plane_width};
use octolume::stages::cones::filter::{self, Traced};
use octolume::stages::cones::image_bytes;
use octolume::stages::cones::upsample::{self, Pixels};
use octolume::stages::cones::upsample_ref::{self, Around};

use crate::cone_rig::{NOTHING, Photo, dull, plane_distance, source};
use crate::device::gpu;
use crate::stage_rig::{buffer, read, run, upload};
use crate::view_rig::{camera, grid};

const SIZE_PX: [u32; 2] = [37, 22];
/// Values are below 1, and weights come from f32 places of up to 64 cells: 2^-24 of those in a plane's
/// distance, which a weight's slope of 1 and a weight sum of 0.1 make no more than this.
const TOLERANCE: f64 = 1e-4;

/// A floor with a wall behind, a ball-like bump of normals, a slab in front, and a window to the background.
fn room() -> Photo {
    let grid = grid(6);
    let camera = camera(&grid, DVec3::new(0.3, 0.6, 1.0), 1.2);
    Photo::new(gpu(), (&grid, &camera), SIZE_PX, |[x, y], ray| {
        if x > 30 && y < 6 {
            return NOTHING;
        }
        let floor = plane_distance(ray, DVec3::new(32.0, 20.0, 32.0), DVec3::Y);
        let wall = plane_distance(ray, DVec3::new(32.0, 32.0, 10.0), DVec3::Z);
        let slab = if (8..14).contains(&x) { plane_distance(ray, DVec3::splat(44.0), DVec3::Z) } else { None };
        let near = |hit: Option<f64>, face: DVec3| hit.map(|distance| dull(distance, face));
        let hits = [near(floor, DVec3::Y), near(wall, DVec3::Z), near(slab, DVec3::Z)];
        let first = hits.into_iter().flatten().min_by(|a, b| a.distance_cells.total_cmp(&b.distance_cells));
        let bump = DVec3::new((f64::from(x) * 0.4).sin() * 0.3, 0.0, (f64::from(y) * 0.5).cos() * 0.3);
        first.map_or(NOTHING, |texel| SurfaceTexel { normal: (texel.normal + bump).normalize(), ..texel })
    })
}

fn noise(size_px: [u32; 2]) -> Vec<[f32; 4]> {
    (0..size_px[0] * size_px[1]).map(|i| [7, 11, 13, 17].map(|k| (i * k * 97 % 101) as f32 / 101.0)).collect()
}

fn points(photo: &Photo, size_px: [u32; 2]) -> Vec<Option<FilterPoint>> {
    let pixels = (0..size_px[1]).flat_map(|y| (0..size_px[0]).map(move |x| [x, y]));
    pixels.map(|pixel| photo.filter_point(source(photo, pixel, size_px))).collect()
}

fn blurred(photo: &Photo, size_px: [u32; 2], pattern_px: u32, along: Along, image: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let image = upload(gpu(), "image", image);
    let out = buffer(gpu(), "blurred", image_bytes(size_px) / 4);
    let params = BlurParams::new(size_px, pattern_px, along);
    run(gpu(), |frame| blur::record(gpu(), frame, &photo.surfaces(), &params, (&image, &out)));
    read(gpu(), &out, image_bytes(size_px) / 16)
}

fn upsampled(photo: &Photo, size_px: [u32; 2], pixels: Pixels, image: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let image = upload(gpu(), "image", image);
    let out = buffer(gpu(), "large", image_bytes(SIZE_PX) / 4);
    run(gpu(), |frame| upsample::record(gpu(), frame, &photo.surfaces(), (size_px, pixels), (&image, &out)));
    read(gpu(), &out, image_bytes(SIZE_PX) / 16)
}

/// Traced image to filtered.
fn filtered(photo: &Photo, size_px: [u32; 2], pattern_px: u32, image: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let image = upload(gpu(), "image", image);
    let scratch = buffer(gpu(), "scratch", image_bytes(size_px) / 4);
    let out = buffer(gpu(), "filtered", image_bytes(SIZE_PX) / 4);
    let traced = Traced { image: &image, size_px, pattern_px, pixels: Pixels::All };
    run(gpu(), |frame| filter::record(gpu(), frame, &photo.surfaces(), &traced, (&scratch, &out)));
    read(gpu(), &out, image_bytes(SIZE_PX) / 16)
}

fn wide(pixel: &[f32; 4]) -> DVec4 {
    DVec4::from_array(pixel.map(f64::from))
}

#[test]
fn a_blur_matches_the_reference_along_both_axes() {
    let photo = room();
    for (size_px, pattern_px) in [(SIZE_PX, 4), ([19, 11], 4), ([19, 11], 2)] {
        let (image, points) = (noise(size_px), points(&photo, size_px));
        let [width, height] = size_px.map(|side| side as usize);
        for (along, lines, line, step) in [(Along::Rows, height, width, 1), (Along::Columns, width, height, width)] {
            let found = blurred(&photo, size_px, pattern_px, along, &image);
            for number in 0..lines {
                let first = number * if step == 1 { width } else { 1 };
                let places: Vec<usize> = (0..line).map(|i| first + i * step).collect();
                let own: Vec<_> = places.iter().map(|place| points[*place]).collect();
                let values: Vec<_> = places.iter().map(|place| wide(&image[*place])).collect();
                let spacing = f64::from(SIZE_PX[0]) / f64::from(size_px[0]);
                for (place, expected) in places.iter().zip(blur_line(&own, &values, pattern_px, spacing)) {
                    assert_near!(wide(&found[*place]), expected, TOLERANCE);
                }
            }
        }
    }
}

#[test]
fn an_upsampled_image_matches_the_reference() {
    let photo = room();
    let all = points(&photo, SIZE_PX);
    for (size_px, pixels) in [([19, 11], Pixels::All), ([12, 7], Pixels::Marked), (SIZE_PX, Pixels::All)] {
        let mut image = noise(size_px);
        if pixels == Pixels::Marked {
            image.iter_mut().step_by(3).for_each(|pixel| *pixel = [0.0; 4]);
        }
        let small = points(&photo, size_px);
        let found = upsampled(&photo, size_px, pixels, &image);
        for (i, (point, found)) in all.iter().zip(&found).enumerate() {
            let Some(point) = point else {
                assert_eq!(*found, [0.0, 0.0, 0.0, 1.0]);
                continue;
            };
            let (x, y) = (i as u32 % SIZE_PX[0], i as u32 / SIZE_PX[0]);
            let (columns, share_x) = upsample_ref::around(x, size_px[0], SIZE_PX[0]);
            let (rows, share_y) = upsample_ref::around(y, size_px[1], SIZE_PX[1]);
            let around = [0, 1, 2, 3].map(|j| {
                let (right, below) = (j & 1, j >> 1);
                let place = (rows[below] * size_px[0] + columns[right]) as usize;
                let holds = pixels == Pixels::All || image[place][3] > 0.0;
                let part = |far: usize, share: f64| if far == 1 { share } else { 1.0 - share };
                let value = wide(&image[place]);
                Around {
                    part: part(right, share_x) * part(below, share_y),
                    point: small[place].filter(|_| holds),
                    value,
                }
            });
            let sources = columns.map(|column| f64::from(upsample_ref::source(column, size_px[0], SIZE_PX[0])));
            let width = plane_width(point, (sources[1] - sources[0]).max(1.0));
            let expected = upsample_ref::upsample(point, &around, width).unwrap_or_default();
            assert_near!(wide(found), expected, TOLERANCE);
        }
    }
}

#[test]
fn a_constant_image_stays_the_same_to_the_bit() {
    let photo = room();
    let value = [0.1, 3.3e4, 7.7e-3, 0.9];
    for (size_px, pattern_px) in [([19, 11], 4), ([19, 11], 1), ([12, 7], 2), (SIZE_PX, 4)] {
        let found = filtered(&photo, size_px, pattern_px, &vec![value; (size_px[0] * size_px[1]) as usize]);
        for (pixel, found) in points(&photo, SIZE_PX).iter().zip(found) {
            if pixel.is_some() {
                assert!(found == value || found == [0.0; 4], "{size_px:?}, {pattern_px}: {found:?}");
            }
        }
    }
}

#[test]
fn light_does_not_cross_an_edge() {
    // What the slab in front has traced stays on it, and what is behind, behind.
    let photo = room();
    let size_px = [19, 11];
    let is_slab = |point: &Option<FilterPoint>| point.is_some_and(|p| p.face.z > 0.9 && p.position.z > 40.0);
    let traced: Vec<_> =
        points(&photo, size_px).iter().map(|point| if is_slab(point) { [1.0; 4] } else { [0.0; 4] }).collect();
    let found = filtered(&photo, size_px, 4, &traced);
    let (mut on, mut off) = (0, 0);
    for (point, found) in points(&photo, SIZE_PX).iter().zip(found) {
        if point.is_some() {
            let expected = if is_slab(point) { 1.0 } else { 0.0 };
            // Where floor and slab meet, bumped normals lean towards each other: a cosine of 0.3, to the fourth power.
            assert!(found.iter().all(|channel| (channel - expected).abs() < 0.01), "{point:?}: {found:?}");
            *(if is_slab(point) { &mut on } else { &mut off }) += 1;
        }
    }
    assert!(on > 40 && off > 400, "{on} {off}");
}
