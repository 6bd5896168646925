//! A key changes with everything that voxelization reads, and with nothing else.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::{Affine2, DVec3, Vec2, Vec4};
use octolume::disk_cache::{ContentKey, DiskCache};
use octolume::prepare::kept::{Kept, TextureHashes};
use octolume::progress::Progress;
use octolume::scene::{AlphaMode, Material, TextureRef, Wrap};
use octolume::settings::JointWeights;
use octolume::settings::VoxelizationMode::{self, Conservative, Thin};
use octolume::stages::voxelize::{ALGORITHM_VERSION, TexturePyramids, VoxelizeInput, voxelize};

use crate::voxelization::object::{Object, square, texture};

/// A surface with everything. Its textures hold numbers, no sRGB: the library of the platform takes
/// no part in its voxels.
fn rich() -> Object {
    let mut object = square(6.0);
    object.soup.positions[2].z = 2.5;
    object.primitive.tex_coords[1] = vec![Vec2::ZERO, Vec2::Y, Vec2::ONE, Vec2::X];
    object.primitive.colors = vec![Vec4::new(0.25, 0.5, 1.0, 0.75); 4];
    object.primitive.joints = vec![[3, 1, 0, 0], [1, 2, 0, 0], [2, 3, 0, 0], [0, 1, 0, 0]];
    object.primitive.weights = vec![[0.75, 0.25, 0.0, 0.0]; 4];
    object.textures = vec![
        texture(4, 4, |x, y| [0, 60 * x as u8, 50 * y as u8, 255]),
        texture(4, 4, |x, y| [0, 50 * y as u8, 60 * x as u8, 255]),
    ];
    object.material = Material {
        metallic_roughness_texture: Some(TextureRef::new(0, 0)),
        emissive: [2.0, 0.5, 0.0],
        alpha_mode: AlphaMode::Mask { cutoff: 0.5 },
        ..Material::default()
    };
    object.joints = Some(JointWeights::Interpolated);
    object
}

fn with_input<T>(object: &Object, mode: VoxelizationMode, look: impl FnOnce(&VoxelizeInput) -> T) -> T {
    look(&VoxelizeInput {
        parts: vec![object.part()],
        materials: std::slice::from_ref(&object.material),
        textures: &TexturePyramids::new(&object.textures),
        mode,
        joints: object.joints,
    })
}

fn key_of(object: &Object, mode: VoxelizationMode) -> ContentKey {
    with_input(object, mode, |input| ContentKey::of(input, &TextureHashes::new(&object.textures)))
}

fn changed(change: fn(&mut Object)) -> Object {
    let mut object = rich();
    change(&mut object);
    object
}

fn image_texel(object: &mut Object, texture: usize) -> &mut u8 {
    &mut Arc::make_mut(&mut object.textures[texture].image).get_pixel_mut(3, 2).0[1]
}

fn mirrored(slot: TextureRef) -> TextureRef {
    TextureRef { uv_from_tex_coord: Affine2::from_scale(Vec2::new(-1.0, 1.0)), ..slot }
}

#[test]
fn every_input_changes_the_key() {
    let changes: [fn(&mut Object); 32] = [
        |o| o.soup.positions[1].x += 1e-9,
        |o| o.soup.positions.push(DVec3::ZERO),
        |o| o.normals[3].y = 1e-9,
        |o| o.primitive.tex_coords[0][2].x = 0.75,
        |o| o.primitive.tex_coords[1][2].x = 0.75,
        |o| o.primitive.tex_coords.swap(0, 1),
        |o| o.primitive.tex_coords[0].clear(),
        |o| o.primitive.colors[1].w = 0.25,
        |o| o.primitive.colors.clear(),
        |o| o.primitive.joints[2][0] = 1,
        |o| o.primitive.weights[2][1] = 0.5,
        |o| o.primitive.triangles[1] = [1, 2, 3],
        |o| o.primitive.triangles.truncate(1),
        |o| o.primitive.material = None,
        |o| o.joints = None,
        |o| o.joints = Some(JointWeights::Flat),
        |o| o.material.base_color[2] = 0.5,
        |o| o.material.metallic = 0.5,
        |o| o.material.roughness = 0.5,
        |o| o.material.emissive[1] = 0.25,
        |o| o.material.alpha_mode = AlphaMode::Blend,
        |o| o.material.alpha_mode = AlphaMode::Opaque,
        |o| o.material.alpha_mode = AlphaMode::Mask { cutoff: 0.25 },
        |o| o.material.base_color_texture = Some(TextureRef::new(1, 0)),
        |o| o.material.emissive_texture = Some(TextureRef::new(1, 0)),
        |o| o.material.metallic_roughness_texture = None,
        |o| o.material.metallic_roughness_texture = Some(TextureRef::new(1, 0)),
        |o| o.material.metallic_roughness_texture = Some(TextureRef::new(0, 1)),
        |o| o.material.metallic_roughness_texture = Some(mirrored(TextureRef::new(0, 0))),
        |o| o.textures[0].wrap[1] = Wrap::ClampToEdge,
        |o| o.textures[0].nearest = true,
        |o| *image_texel(o, 0) += 1,
    ];
    let mut keys = BTreeSet::from([key_of(&rich(), Thin).to_string(), key_of(&rich(), Conservative).to_string()]);
    assert_eq!(keys.len(), 2);
    for (number, change) in changes.into_iter().enumerate() {
        assert!(keys.insert(key_of(&changed(change), Thin).to_string()), "change {number} changes no key");
    }
    assert!(keys.iter().all(|key| key.len() == 64 && key.bytes().all(|digit| digit.is_ascii_hexdigit())));
}

#[test]
fn what_voxelization_does_not_read_changes_no_key() {
    let changes: [fn(&mut Object); 10] = [
        |o| o.material.name = "another".to_owned(),
        |o| o.material.double_sided = true,
        |o| o.material.unlit = true,
        |o| o.material.normal_scale = 0.5,
        |o| o.material.normal_texture = Some(TextureRef::new(1, 0)),
        |o| o.primitive.tangents = vec![Vec4::X; 4],
        |o| o.textures[0].name = "another".to_owned(),
        |o| *image_texel(o, 1) += 1,
        |o| o.textures.swap(0, 1),
        |o| o.textures.truncate(1),
    ];
    for (number, change) in changes.into_iter().enumerate() {
        let mut object = changed(change);
        if number == 8 {
            object.material.metallic_roughness_texture = Some(TextureRef::new(1, 0));
        }
        assert_eq!(key_of(&object, Thin), key_of(&rich(), Thin), "change {number}");
    }
}

#[test]
fn what_a_key_finds_is_what_was_stored_bit_for_bit() {
    let folder = tempfile::TempDir::new().expect("a temporary folder");
    let disk = DiskCache::at(folder.path());
    for mode in [Thin, Conservative] {
        let (object, key) = (rich(), key_of(&rich(), mode));
        let cache = object.cache(mode);
        assert!(!cache.emission.is_empty() && !cache.joints.is_empty());
        with_input(&object, mode, |input| {
            assert_eq!(disk.load(&key, input), Kept::Missing);
            disk.store(&key, &cache).expect("stored");
            assert_eq!(disk.load(&key, input), Kept::Found(cache.clone()));
        });
        // The same content in other objects is the same entry; other content finds nothing.
        with_input(&changed(|o| o.soup.positions[0].y += 1.0), mode, |input| {
            assert_eq!(disk.load(&ContentKey::of(input, &TextureHashes::new(&object.textures)), input), Kept::Missing);
        });
    }
    // Nothing covers nothing, which is worth keeping too.
    let nothing = changed(|o| o.primitive.triangles.clear());
    with_input(&nothing, Thin, |input| {
        let cache = voxelize(input, &Progress::default()).expect("voxelizes");
        disk.store(&key_of(&nothing, Thin), &cache).expect("stored");
        assert_eq!(disk.load(&key_of(&nothing, Thin), input), Kept::Found(cache));
    });
}

/// Entries are found by content and version. Whoever changes what voxelization makes of this
/// surface raises `ALGORITHM_VERSION`, or people keep seeing old voxels; then this line is renewed.
#[test]
fn other_voxels_need_another_algorithm_version() {
    let cache = rich().cache(Thin);
    let mut hasher = blake3::Hasher::new();
    hasher.update(bytemuck::cast_slice(&cache.voxels));
    hasher.update(bytemuck::cast_slice(&cache.emission));
    hasher.update(bytemuck::cast_slice(&cache.joints));
    let found = (ALGORITHM_VERSION, hasher.finalize().to_hex().to_string());
    assert_eq!(found, (3, "2d28dcc55f14c1fc66924e297c101d155c1ba751dba890121e442a0b24996f6d".to_owned()));
}
