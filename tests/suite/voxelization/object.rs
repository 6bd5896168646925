//! One object under test, and what holds for every cache.

use std::sync::Arc;

use glam::{DVec3, IVec3, Vec2, Vec3};
use octolume::data::albedo::unpack_color;
use octolume::data::grid::morton_key;
use octolume::data::packing::unpack_position;
use octolume::data::voxel_cache::{CacheVoxel, TILE_CELLS, VoxelCache};
use octolume::progress::Progress;
use octolume::scene::{Material, Primitive, Texture, TextureRef, Wrap};
use octolume::settings::JointWeights;
use octolume::settings::VoxelizationMode::{self, Conservative, Thin};
use octolume::stages::voxelize::{TexturePyramids, VoxelizeError, VoxelizeInput, VoxelizePart, voxelize};

use super::soup::{Random, Soup};

pub const MODES: [VoxelizationMode; 2] = [Thin, Conservative];

/// One object under test; every vertex has a normal along z unless a test says otherwise.
#[derive(Clone, Default)]
pub struct Object {
    pub soup: Soup,
    pub normals: Vec<DVec3>,
    pub primitive: Primitive,
    pub material: Material,
    pub textures: Vec<Texture>,
    pub joints: Option<JointWeights>,
}

impl Object {
    pub fn new(soup: Soup) -> Self {
        let primitive = Primitive {
            material: Some(0),
            positions: soup.positions.iter().map(|p| p.as_vec3()).collect(),
            normals: vec![Vec3::Z; soup.positions.len()],
            triangles: soup.triangles.clone(),
            ..Primitive::default()
        };
        Self { normals: vec![DVec3::Z; soup.positions.len()], soup, primitive, ..Self::default() }
    }

    pub fn part(&self) -> VoxelizePart<'_> {
        VoxelizePart {
            primitive: &self.primitive,
            positions_cells: self.soup.positions.clone(),
            normals: self.normals.clone(),
        }
    }

    pub fn try_cache(&self, mode: VoxelizationMode, progress: &Progress) -> Result<VoxelCache, VoxelizeError> {
        let textures = TexturePyramids::new(&self.textures);
        voxelize(
            &VoxelizeInput {
                parts: vec![self.part()],
                materials: std::slice::from_ref(&self.material),
                textures: &textures,
                mode,
                joints: self.joints,
            },
            progress,
        )
    }

    pub fn cache(&self, mode: VoxelizationMode) -> VoxelCache {
        let cache = self.try_cache(mode, &Progress::default()).unwrap();
        validate(&cache);
        cache
    }

    /// The same surface, listed in another order.
    pub fn shuffled(&self, random: &mut Random) -> Self {
        fn pick<T: Clone>(items: &[T], from: &[usize]) -> Vec<T> {
            if items.is_empty() { Vec::new() } else { from.iter().map(|&old| items[old].clone()).collect() }
        }
        let (soup, from) = self.soup.shuffled(random);
        let old = &self.primitive;
        let primitive = Primitive {
            positions: pick(&old.positions, &from),
            normals: pick(&old.normals, &from),
            tex_coords: [0, 1].map(|set| pick(&old.tex_coords[set], &from)),
            colors: pick(&old.colors, &from),
            joints: pick(&old.joints, &from),
            weights: pick(&old.weights, &from),
            triangles: soup.triangles.clone(),
            ..old.clone()
        };
        Self { soup, normals: pick(&self.normals, &from), primitive, ..self.clone() }
    }
}

/// What holds for every cache.
pub fn validate(cache: &VoxelCache) {
    let mut next = 0;
    for tile in &cache.tiles {
        assert_eq!(tile.voxels.start, next);
        assert!(!tile.voxels.is_empty());
        next = tile.voxels.end;
        let voxels = &cache.voxels[tile.voxels.start as usize..next as usize];
        assert!(voxels.is_sorted_by(|a, b| key(a) < key(b)), "Morton order, each cell once");
        assert_eq!((tile.origin - cache.tiles[0].origin) % TILE_CELLS, IVec3::ZERO);
    }
    assert_eq!(next as usize, cache.voxels.len());
    assert!(cache.emission.is_empty() || cache.emission.len() == cache.voxels.len());
    assert!(cache.joints.is_empty() || cache.joints.len() == cache.voxels.len());
    for voxel in &cache.joints {
        assert_eq!(voxel.weights.map(u32::from).iter().sum::<u32>(), 255);
        assert!(voxel.weights.is_sorted_by(|a, b| a >= b));
    }
}

fn key(voxel: &CacheVoxel) -> u32 {
    morton_key(unpack_position(voxel.position))
}

pub fn albedo(voxel: &CacheVoxel) -> [f64; 4] {
    unpack_color(voxel.albedo)
}

/// A square of n × n cells in the layer z = 0, with a texture coordinate of one unit over it.
pub fn square(n: f64) -> Object {
    let mut object = Object::new(Soup::parallelogram(DVec3::ZERO, n * DVec3::X, n * DVec3::Y));
    object.primitive.tex_coords[0] = vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    object
}

pub fn texture(width: u32, height: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Texture {
    let image = image::RgbaImage::from_fn(width, height, |x, y| image::Rgba(texel(x, y)));
    Texture { name: "test".to_owned(), image: Arc::new(image), wrap: [Wrap::Repeat; 2], nearest: false }
}

pub const FIRST: Option<TextureRef> = Some(TextureRef::new(0, 0));
