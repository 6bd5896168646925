//! Slices through the octree, pixel by pixel against the f64 reference.

use glam::DVec3;
use octolume::color::gamma_from_linear;
use octolume::gpu::Recorder;
use octolume::scene::OrbitCamera;
use octolume::settings::lighting::Opacity;
use octolume::settings::{AlphaRule, ColorBy, Filter, Lookup, Sampling, Slice, SliceAxis, SliceValue};
use octolume::stages::pixels::camera::{PixelRay, PixelRays};
use octolume::stages::pixels::{BACKGROUND, NO_DEPTH, Picture, ViewParams};
use octolume::stages::sample::sample_points_ref::LitNodes;
use octolume::stages::view::palette::legend_value;
use octolume::stages::view::slice_ref::{self, meeting, share, value};
use octolume::stages::view::{Palette, slice};

use crate::device::gpu;
use crate::lit_octree::LitBuild;
use crate::octree_rules::Cell;
use crate::random;
use crate::stage_build::Shape;
use crate::view_rig::{SIZE_PX, Seen, blurred, camera, grid, look, pixels, seen};

const DEPTH: u32 = 5;
const COLOR: ColorBy = ColorBy::Occupancy;

fn octree() -> LitBuild {
    let light = |cell: Cell, a: f64| (DVec3::from_array(cell.map(|c| 0.1 + f64::from(c % 7))), a);
    LitBuild::new(gpu(), &random::scene(3, 6000, DEPTH), &Shape::new(DEPTH, 2, Filter::Split), light)
}

fn drawn(octree: &LitBuild, slice: &Slice, range: Option<[f64; 2]>, rays: &PixelRays) -> Seen {
    let view = ViewParams::new(rays, &look(COLOR, AlphaRule::Paper), DEPTH);
    let picture = Picture::new(gpu(), SIZE_PX).expect("fits");
    let mut frame = Recorder::default();
    let sampled = octree.sampled(slice.lookup);
    slice::record(gpu(), &mut frame, &sampled, (slice, range), (&view, &Palette::new(COLOR)), &picture);
    seen(gpu(), frame, &picture)
}

/// Place on the scale and distance from the eye.
fn reference(lit: &LitNodes, slice: &Slice, range: [f64; 2], ray: &PixelRay) -> Option<(f64, f64)> {
    let (t, place) = meeting(slice, ray, f64::from(1_u32 << DEPTH))?;
    Some((share(slice, value(slice, lit, place)?, range), ray.start_cells + t))
}

/// The colours of a stretch of the scale; a value half-way between two may round to either.
fn colors(from: f64, to: f64) -> Vec<DVec3> {
    let entry = |share: f64, by: f64| (share * 255.0 + by).round().clamp(0.0, 255.0) as u32;
    let rgb =
        |entry| DVec3::from_array(legend_value(COLOR, f64::from(entry) / 255.0).map(|byte| f64::from(byte) / 255.0));
    (entry(from, -0.02)..=entry(to, 0.02)).map(rgb).collect()
}

/// Every pixel is the reference's; those on which rays that f32 cannot tell apart disagree are few.
fn assert_slice_matches(octree: &LitBuild, slice: &Slice, given: Option<[f64; 2]>, camera: &OrbitCamera) {
    let rays = PixelRays::new(camera, &grid(DEPTH), SIZE_PX);
    let picture = drawn(octree, slice, given, &rays);
    let lit = octree.lit(Opacity::Isotropic);
    let range = given.unwrap_or_else(|| slice_ref::range(slice, root(octree)));
    let background = DVec3::from_array(BACKGROUND.map(|c| gamma_from_linear(c.into())));
    let (mut blurry, mut shown) = (0, 0);
    for (index, point) in pixels() {
        let around = blurred(&rays.ray(point), 32.0);
        let all: Vec<_> = around.iter().map(|ray| reference(&lit, slice, range, ray)).collect();
        let shares = all.iter().filter_map(|found| Some(found.as_ref()?.0));
        let (from, to) = shares.fold((1.0, 0.0), |(from, to), share| (share.min(from), share.max(to)));
        if all.iter().any(|found| found.is_some() != all[0].is_some()) || to - from > 1.0 / 255.0 {
            blurry += 1;
            continue;
        }
        let near = |a: DVec3, b: DVec3| (a - b).abs().max_element() <= 0.51 / 255.0;
        let (color, distance) = (picture.colors[index], picture.distances[index]);
        match all[0] {
            None => assert!(near(color, background) && distance == NO_DEPTH, "{slice:?} {point:?}: {color}"),
            Some((share, depth)) => {
                shown += 1;
                let is_expected = colors(from, to).iter().any(|expected| near(color, *expected));
                assert!(is_expected, "{slice:?} {point:?}: {color} at {share}");
                assert!((f64::from(distance) - depth).abs() < 1e-4 * depth.max(1.0), "{slice:?} {point:?}: {distance}");
            }
        }
    }
    assert!(blurry * 10 < SIZE_PX[0] * SIZE_PX[1], "{slice:?}: {blurry} pixels say nothing");
    assert!(shown > 50, "{slice:?}: {shown} pixels show the plane");
}

#[test]
fn every_value_and_sampling_matches_the_reference() {
    let octree = octree();
    let camera = camera(&grid(DEPTH), DVec3::new(0.7, 1.0, 0.9), 1.3);
    for sampling in [Sampling::Nearest, Sampling::Trilinear, Sampling::Quadrilinear] {
        for (value, logarithmic, range) in [
            (SliceValue::Radiance, true, [0.05, 8.0]),
            (SliceValue::Irradiance, false, [0.0, 7.0]),
            (SliceValue::Occupancy, false, [0.0, 1.0]),
            (SliceValue::Occupancy, true, [1.0 / 4096.0, 1.0]),
        ] {
            for width_cells in [1.0, 2.7] {
                let slice = Slice { sampling, value, logarithmic, width_cells, height: 0.43, ..Slice::default() };
                assert_slice_matches(&octree, &slice, Some(range), &camera);
            }
        }
    }
}

/// The stored root.
fn root(octree: &LitBuild) -> [f64; 4] {
    let stored: Vec<[f32; 4]> = gpu().read(&octree.light, 0..16).expect("readable");
    stored[0].map(f64::from)
}

#[test]
fn without_a_range_the_mean_light_makes_one() {
    let mut octree = octree();
    let camera = camera(&grid(DEPTH), DVec3::new(0.7, 1.0, 0.9), 1.3);
    for light in [3.0, 0.0] {
        octree.relight(gpu(), |cell, a| (DVec3::from_array(cell.map(|c| light * (0.1 + f64::from(c % 7)))), a));
        for logarithmic in [true, false] {
            let slice = Slice { logarithmic, height: 0.43, ..Slice::default() };
            assert_slice_matches(&octree, &slice, None, &camera);
        }
    }
    let occupancy = Slice { value: SliceValue::Occupancy, logarithmic: false, ..Slice::default() };
    let rays = PixelRays::new(&camera, &grid(DEPTH), SIZE_PX);
    let pictures = [None, Some([0.0, 1.0])].map(|range| drawn(&octree, &occupancy, range, &rays).colors);
    assert!(pictures[0] == pictures[1], "shares need no mean");
}

#[test]
fn every_axis_and_height_matches_the_reference() {
    let octree = octree();
    let camera = camera(&grid(DEPTH), DVec3::new(-0.8, 1.1, 1.0), 1.4);
    for axis in [SliceAxis::X, SliceAxis::Y, SliceAxis::Z] {
        // At the grid's faces half of each sample is outside.
        for height in [0.0, 0.5, 1.0] {
            let slice = Slice { axis, height, value: SliceValue::Occupancy, width_cells: 4.0, ..Slice::default() };
            assert_slice_matches(&octree, &slice, Some([1e-3, 1.0]), &camera);
        }
    }
}

#[test]
fn every_look_up_draws_the_same_picture() {
    let octree = octree();
    let rays = PixelRays::new(&camera(&grid(DEPTH), DVec3::new(0.3, 1.0, 0.2), 1.1), &grid(DEPTH), SIZE_PX);
    let pictures = [Lookup::Ranks, Lookup::BlockPointers, Lookup::NodePointers].map(|lookup| {
        let seen = drawn(&octree, &Slice { lookup, width_cells: 1.6, ..Slice::default() }, Some([0.01, 10.0]), &rays);
        (seen.colors, seen.distances)
    });
    assert!(pictures.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn a_plane_seen_edge_on_or_from_behind_is_background() {
    let octree = octree();
    let inside = OrbitCamera::new(
        grid(DEPTH).corner() + DVec3::new(3.0, 6.0, 5.0),
        grid(DEPTH).corner() + DVec3::new(3.0, 7.0, 5.0),
        50.0,
    );
    let rays = PixelRays::new(&inside, &grid(DEPTH), SIZE_PX);
    let behind = Slice { height: 0.25, value: SliceValue::Occupancy, ..Slice::default() };
    assert!(drawn(&octree, &behind, Some([0.0, 1.0]), &rays).distances.iter().all(|distance| *distance == NO_DEPTH));
    let level = camera(&grid(DEPTH), DVec3::X, 1.5);
    let rays = PixelRays::new(&level, &grid(DEPTH), SIZE_PX);
    let seen = drawn(&octree, &Slice { height: 0.5, ..behind }, Some([0.0, 1.0]), &rays);
    let middle = SIZE_PX[1] / 2 * SIZE_PX[0];
    let row = &seen.distances[middle as usize..][..SIZE_PX[0] as usize];
    assert!(row.iter().all(|distance| *distance == NO_DEPTH), "the rays of the middle row lie in the plane");
}
