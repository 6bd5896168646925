//! Pictures of light: the march in the octree's own light, and a shadow map, pixel by pixel against their
//! references.

use std::collections::HashMap;

use glam::{DVec3, IVec3};
use octolume::color::linear_from_gamma;
use octolume::gpu::{Gpu, Recorder};
use octolume::settings::lighting::Opacity;
use octolume::settings::{AlphaRule, ColorBy, Filter};
use octolume::stages::light::shadow::{ShadowMap, ShadowParams};
use octolume::stages::pixels::camera::PixelRays;
use octolume::stages::pixels::{BACKGROUND, Picture, ViewParams};
use octolume::stages::view::march_light::Exposure;
use octolume::stages::view::march_ref::{self, DrawnCell};
use octolume::stages::view::palette::legend_value;
use octolume::stages::view::{Palette, march_light, march_light_ref, show_shadow, show_shadow_ref};

use crate::device::gpu;
use crate::light_rig::{LightRig, full, point};
use crate::octree_rules as rules;
use crate::random;
use crate::stage_build::Shape;
use crate::stage_rig::upload;
use crate::view_rig::{SIZE_PX, assert_matches, camera, grid, look, pixels, seen};

const FACTOR: f64 = 0.25;

/// A small octree with its light, and what each occupied cell of a level shows.
fn lit(gpu: &Gpu) -> (LightRig, Vec<[f32; 4]>) {
    let rig = LightRig::new(gpu, &random::scene(11, 260, 4), &Shape::new(4, 2, Filter::Split));
    let some = |i: usize, scale: f32| [0, 1, 2].map(|channel| ((i * 7 + channel * 5) % 11) as f32 * scale);
    let direct: Vec<_> = (0..rig.slots.len()).map(|slot| some(slot, 0.9)).collect();
    let stored = rig.stored(gpu, &direct, &[], Opacity::Isotropic);
    (rig, stored)
}

fn shown_cells(rig: &LightRig, stored: &[[f32; 4]], factor: f64, level: u32) -> HashMap<IVec3, DrawnCell> {
    let inner = rig.built.params.inner_node_count as usize;
    let at = |cell: [u32; 3]| IVec3::from_array(cell.map(|c| c as i32));
    let shown = |entry: usize| march_light_ref::shown(stored[entry].map(f64::from), factor);
    if level == rig.built.params.depth {
        return rig.slots.iter().map(|(cell, slot)| (at(*cell), shown(inner + slot))).collect();
    }
    let nodes = rules::walk(&rig.built).expect("walks");
    let of_level = nodes.range((level, [0; 3])..(level + 1, [0; 3]));
    let occupied = of_level.filter(|(_, index)| stored[**index as usize][3] > 0.0);
    occupied.map(|((_, cell), index)| (at(*cell), shown(*index as usize))).collect()
}

#[test]
fn light_at_every_level_matches_the_reference() {
    let (rig, stored) = lit(gpu());
    let light = upload(gpu(), "light", &stored);
    let (grid, depth) = (grid(4), 4);
    let rays = PixelRays::new(&camera(&grid, DVec3::new(1.0, 0.5, 1.3), 1.4), &grid, SIZE_PX);
    for level in [0, 2, 3, 4] {
        let look = octolume::settings::Look { level: Some(level), ..look(ColorBy::Radiance, AlphaRule::Length) };
        let picture = Picture::new(gpu(), SIZE_PX).expect("fits");
        let mut recorder = Recorder::default();
        let view = ViewParams::new(&rays, &look, depth);
        march_light::record(gpu(), &mut recorder, &rig.octree, (&light, Exposure::Set(FACTOR)), &view, &picture);
        let rules = crate::view_rig::rules(&look, depth, level);
        let cells = shown_cells(&rig, &stored, FACTOR, level);
        assert_matches(&seen(gpu(), recorder, &picture), &rays, 1 << depth, |ray| {
            march_ref::pixel(ray, 1 << level, &rules, |cell| cells.get(&cell).copied())
        });
    }
}

#[test]
fn without_an_exposure_the_mean_light_is_shown_as_it_should_be() {
    let (rig, mut stored) = lit(gpu());
    let (grid, depth) = (grid(4), 4);
    let rays = PixelRays::new(&camera(&grid, DVec3::new(1.0, 0.5, 1.3), 1.4), &grid, SIZE_PX);
    let look = look(ColorBy::Radiance, AlphaRule::Length);
    for dark in [false, true] {
        if dark {
            stored.iter_mut().for_each(|[r, g, b, _]| [*r, *g, *b] = [0.0; 3]);
        }
        let light = upload(gpu(), "light", &stored);
        let picture = Picture::new(gpu(), SIZE_PX).expect("fits");
        let mut recorder = Recorder::default();
        let view = ViewParams::new(&rays, &look, depth);
        march_light::record(gpu(), &mut recorder, &rig.octree, (&light, Exposure::OfMean), &view, &picture);
        let rules = crate::view_rig::rules(&look, depth, depth);
        let factor = march_light_ref::factor_of_mean(stored[0].map(f64::from));
        assert_eq!(factor == 1.0, dark);
        let cells = shown_cells(&rig, &stored, factor, depth);
        assert_matches(&seen(gpu(), recorder, &picture), &rays, 1 << depth, |ray| {
            march_ref::pixel(ray, 1 << depth, &rules, |cell| cells.get(&cell).copied())
        });
    }
}

#[test]
fn a_shadow_map_is_shown_texel_by_texel() {
    let params = ShadowParams::new(
        &point(DVec3::splat(8.0), 1.0),
        &crate::light_rig::grid(4),
        Some(octolume::scene::Aabb { min: DVec3::ZERO, max: DVec3::splat(16.0) }),
        16,
    );
    assert_eq!((params.count, params.size_px), (6, 8));
    let map = ShadowMap::new(gpu(), params).expect("fits");
    let distances = |layer: u32, x: u32, y: u32| (layer * 64 + y * 8 + x) as f32;
    let texels: Vec<f32> = (0..6 * 64).map(|i| distances(i / 64, i % 8, i / 8 % 8)).collect();
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(32), rows_per_image: Some(8) };
    let size = wgpu::Extent3d { width: 8, height: 8, depth_or_array_layers: 6 };
    gpu().queue.write_texture(map.texture.raw().as_image_copy(), bytemuck::cast_slice(&texels), layout, size);
    let picture = Picture::new(gpu(), SIZE_PX).expect("fits");
    let rays = PixelRays::new(&camera(&grid(4), DVec3::ONE, 1.4), &grid(4), SIZE_PX);
    let view = ViewParams::new(&rays, &look(ColorBy::Albedo, AlphaRule::Paper), 4);
    let mut recorder = Recorder::default();
    let range = [10.0, 300.0];
    show_shadow::record(gpu(), &mut recorder, &map, range, (&view, &Palette::new(ColorBy::Occupancy)), &picture);
    let seen = seen(gpu(), recorder, &picture);
    let mut shown = 0;
    for (index, [x, y]) in pixels() {
        let texel = show_shadow_ref::texel([x as u32, y as u32], SIZE_PX, 6, 8);
        let expected = texel.map_or(BACKGROUND.map(f64::from), |(layer, [x, y])| {
            shown += 1;
            let share = show_shadow_ref::share(f64::from(distances(layer, x, y)), range);
            legend_value(ColorBy::Occupancy, share).map(|byte| linear_from_gamma(f64::from(byte) / 255.0))
        });
        let expected = DVec3::from_array(expected.map(octolume::color::gamma_from_linear));
        assert!((seen.colors[index] - expected).abs().max_element() < 2.5 / 255.0, "pixel {x} {y}");
    }
    assert!(shown > 1000, "{shown}");
}

#[test]
fn a_lit_voxel_is_shown_as_bright_as_it_is() {
    let rig = LightRig::new(gpu(), &[full([4, 4, 4], DVec3::Y, [255; 3])], &Shape::new(3, 2, Filter::Nearest));
    let stored = rig.stored(gpu(), &[[0.0; 3]], &[[2.0, 1.0, 0.0]], Opacity::Isotropic);
    for level in 0..=3 {
        let shown = shown_cells(&rig, &stored, FACTOR, level);
        let color = shown.values().next().expect("one cell").color;
        assert!((color - DVec3::new(2.0, 1.0, 0.0) * FACTOR).abs().max_element() < 1e-6, "level {level}: {color}");
    }
}
