//! What a voxel shows: colours, coverage, metal, roughness and emission, averaged in linear light.

use glam::{DVec2, DVec3, IVec3, Vec2, Vec4};
use octolume::data::texels::Texels;
use octolume::scene::{AlphaMode, Material, Texture, TextureRef, Wrap};
use octolume::settings::VoxelizationMode::{Conservative, Thin};
use octolume::stages::voxelize::TexturePyramids;

use crate::voxelization::object::{FIRST, albedo, square, texture};

#[test]
fn linear_vertex_colours_are_sampled_at_the_middle_of_cells() {
    let mut object = square(8.0);
    let colour = |p: &DVec3| Vec4::new(p.x as f32 / 8.0, p.y as f32 / 8.0, 0.25, 1.0);
    object.primitive.colors = object.soup.positions.iter().map(colour).collect();
    let cache = object.cache(Conservative);
    assert_eq!(cache.voxels.len(), 64);
    for (cell, voxel) in cache.cells().zip(&cache.voxels) {
        let middle = (cell.as_dvec3() + 0.5) / 8.0;
        let [r, g, b, a] = albedo(voxel);
        // Half a step of the root in 8 bits, and what 16-bit sums round.
        let is_near = |found: f64, expected: f64| {
            (found.sqrt() - expected.sqrt()).abs() < 0.5 / 255.0 + 0.5 / 65535.0 / expected.sqrt()
        };
        assert!(is_near(r, middle.x) && is_near(g, middle.y) && is_near(b, 0.25) && a == 1.0, "{cell}");
    }
}

#[test]
fn textures_are_averaged_in_linear_light() {
    // Texels alternate between black and white, 16 × 16 of them in a cell: half the light.
    let mut object = square(4.0);
    object.material.base_color_texture = FIRST;
    object.textures = vec![texture(64, 64, |x, y| [if (x + y) % 2 == 0 { 255 } else { 0 }; 4])];
    for voxel in &object.cache(Thin).voxels {
        assert_eq!(voxel.albedo & 0xff, 180, "255·√0.5");
        assert_eq!(voxel.albedo >> 24, 255, "an opaque material has no alpha");
    }
    // sRGB 188 is half the light, 0.5029.
    object.textures = vec![texture(1, 1, |_, _| [188; 4])];
    assert_eq!(object.cache(Thin).voxels[0].albedo, 0xffb5_b5b5);
}

#[test]
fn second_texture_coordinates_and_wrapping_are_respected() {
    let mut object = square(4.0);
    object.material.base_color_texture = Some(TextureRef::new(0, 1));
    // Red left, green right; coordinates from 1 to 2: repeated, mirrored, clamped.
    let halves = texture(2, 1, |x, _| [if x == 0 { 255 } else { 0 }, 255 * x as u8, 0, 255]);
    object.primitive.tex_coords[1] = object.primitive.tex_coords[0].iter().map(|uv| *uv + Vec2::X).collect();
    for (wrap, left_red) in [(Wrap::Repeat, 1.0), (Wrap::MirroredRepeat, 0.0), (Wrap::ClampToEdge, 0.0)] {
        object.textures = vec![Texture { wrap: [wrap; 2], nearest: true, ..halves.clone() }];
        let cache = object.cache(Thin);
        let [leftmost, rightmost] = [0, 3].map(|x| {
            let (_, voxel) = cache.cells().zip(&cache.voxels).find(|(cell, _)| *cell == IVec3::new(x, 1, 0)).unwrap();
            albedo(voxel)[0]
        });
        assert_eq!(leftmost, left_red, "{wrap:?}");
        assert_eq!(rightmost, if wrap == Wrap::MirroredRepeat { 1.0 } else { 0.0 }, "{wrap:?}");
    }
}

#[test]
fn masked_surface_has_no_voxels_and_tints_none() {
    // Left half cut out, and green where nobody should see it.
    let mut object = square(8.0);
    object.material.base_color_texture = FIRST;
    object.material.alpha_mode = AlphaMode::Mask { cutoff: 0.5 };
    let cut = texture(64, 64, |x, _| if x < 32 { [0, 255, 0, 0] } else { [255, 0, 0, 255] });
    object.textures = vec![Texture { wrap: [Wrap::ClampToEdge; 2], ..cut }];
    let cache = object.cache(Thin);
    assert!(cache.voxels.iter().all(|voxel| voxel.albedo & 0xff_ffff == 0xff), "red where anything is");
    for (cell, voxel) in cache.cells().zip(&cache.voxels) {
        let coverage = f64::from(voxel.albedo >> 24) / 255.0;
        // The diagonal cuts its cells into pieces with a centre a sixth of a cell off; between the levels around
        // their size, that reaches a twelfth over the edge.
        let expected = if cell.x >= 4 { 1.0 } else { 0.0 };
        let reach = if cell.x == cell.y { 1.0 / 12.0 } else { 0.0 };
        assert!((coverage - expected).abs() <= reach, "{cell}: {coverage}");
    }
    assert_eq!(cache.cells().filter(|cell| cell.x >= 4).count(), 32);
}

#[test]
fn blended_surface_covers_by_its_mean_alpha() {
    let mut object = square(3.0);
    object.material.alpha_mode = AlphaMode::Blend;
    object.material.base_color = [1.0, 0.5, 0.0, 0.4];
    assert!(object.cache(Thin).voxels.iter().all(|voxel| voxel.albedo == 0x6600_b4ff));
    object.material.base_color[3] = 0.0;
    assert!(object.cache(Thin).voxels.is_empty(), "nothing is there to see");
}

#[test]
fn metal_roughness_and_emission_come_from_the_material() {
    let mut object = square(2.0);
    object.material = Material { metallic: 0.8, roughness: 0.5, emissive: [7.5, 0.0, 0.25], ..object.material };
    object.material.metallic_roughness_texture = FIRST;
    object.textures = vec![texture(4, 4, |_, _| [9, 102, 51, 9])];
    let cache = object.cache(Thin);
    // 0.8 × 51 and 0.5 × 102.
    assert!(cache.voxels.iter().all(|voxel| voxel.surface == 41 | 51 << 8));
    assert!(cache.emission.iter().all(|emission| *emission == [7.5, 0.0, 0.25]));
    object.material.emissive = [0.0; 3];
    assert!(object.cache(Thin).emission.is_empty());
}

#[test]
fn pyramids_keep_constants_and_means() {
    let flat = texture(13, 7, |_, _| [200, 100, 50, 25]);
    let ramp = texture(5, 3, |x, y| [(10 * x + y) as u8, 0, 255, 255]);
    let pyramids = TexturePyramids::new(&[flat, ramp]);
    for texels in [Texels::Linear, Texels::Opaque, Texels::Covering] {
        let finest = pyramids.sample(0, texels, DVec2::splat(0.4), 0.0);
        for uv_area in [1e-3, 0.02, 0.1, 0.4, 1.0, 50.0] {
            let coarse = pyramids.sample(0, texels, DVec2::new(0.9, -3.3), uv_area);
            // Three levels of 16 bits; unweighting divides by an alpha of a tenth.
            let tolerance = 10.0 * 3.0 / 65535.0;
            assert!((0..4).all(|c| (coarse[c] - finest[c]).abs() < tolerance), "{texels:?}: {coarse:?} {finest:?}");
        }
    }
    // Means over 5 × 3 texels: 20 from x and 1 from y.
    let mean = pyramids.sample(1, Texels::Linear, DVec2::ZERO, 1.0);
    assert!((mean[0] - 21.0 / 255.0).abs() < 3.0 / 65535.0 && mean[2] == 1.0);
}
