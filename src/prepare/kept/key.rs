//! What an entry is found by: a hash of everything that voxelization reads, and of its version.
//!
//! Stretch, span and phase are in the positions, which are in cells already. Structs are taken apart
//! field by field without `..`, so that a new field does not compile before somebody has decided
//! whether voxelization reads it. Lists go in with their lengths, so that no two inputs run together.

use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

use blake3::{Hash, Hasher};
use bytemuck::NoUninit;
use image::RgbaImage;
use rayon::prelude::*;

use crate::disk_cache::ContentKey;
use crate::progress::{Cancelled, Progress};
use crate::scene::{AlphaMode, Material, Primitive, Texture, TextureRef, Wrap};
use crate::settings::{JointWeights, VoxelizationMode};
use crate::stages::voxelize::{ALGORITHM_VERSION, VoxelizeInput, VoxelizePart, textures_read};

impl ContentKey {
    /// `textures` are those that `input` samples.
    pub fn of(input: &VoxelizeInput, textures: &TextureHashes) -> Self {
        let default_material = Material::default();
        let part_materials = input.part_materials(&default_material);
        let VoxelizeInput { parts, materials: _, textures: _, mode, joints } = input;
        let mut writer = ContentWriter::new(textures);
        writer.number(u64::from(ALGORITHM_VERSION));
        writer.number(match mode {
            VoxelizationMode::Thin => 0,
            VoxelizationMode::Conservative => 1,
        });
        writer.number(match joints {
            None => 0,
            Some(JointWeights::Interpolated) => 1,
            Some(JointWeights::Flat) => 2,
        });
        writer.number(parts.len() as u64);
        for (part, material) in parts.iter().zip(part_materials) {
            writer.part(part, joints.is_some());
            writer.material(material);
        }
        writer.finish()
    }
}

/// Takes in, piece by piece, what a key is made from.
pub struct ContentWriter<'a> {
    hasher: Hasher,
    textures: &'a TextureHashes,
}

impl<'a> ContentWriter<'a> {
    pub fn new(textures: &'a TextureHashes) -> Self {
        Self { hasher: Hasher::new(), textures }
    }

    pub fn finish(self) -> ContentKey {
        ContentKey::new(self.hasher.finalize())
    }

    pub fn number(&mut self, number: u64) {
        self.hasher.update(&number.to_le_bytes());
    }

    pub fn list<T: NoUninit>(&mut self, values: &[T]) {
        self.number(values.len() as u64);
        self.hasher.update(bytemuck::cast_slice(values));
    }

    fn part(&mut self, part: &VoxelizePart, with_joints: bool) {
        let VoxelizePart { primitive, positions_cells, normals } = part;
        let Primitive {
            material: _,  // its content is written, not its number
            positions: _, // voxelization is given cells
            normals: _,   // and normals in their space
            tangents: _,
            tex_coords,
            colors,
            joints,
            weights,
            triangles,
            morph: _, // the resting shape is voxelized
        } = primitive;
        self.list(positions_cells);
        self.list(normals);
        tex_coords.iter().for_each(|set| self.list(set));
        self.list(colors);
        self.list(triangles);
        if with_joints {
            self.list(joints);
            self.list(weights);
        }
    }

    fn material(&mut self, material: &Material) {
        let Material {
            name: _,
            base_color,
            base_color_texture: _, // of the textures, those that are read are written below
            metallic,
            roughness,
            metallic_roughness_texture: _,
            normal_texture: _,
            normal_scale: _, // a voxel's normal is the geometry's
            emissive,
            emissive_texture: _,
            alpha_mode,
            double_sided: _,
            unlit: _, // a voxel holds what light would meet, whether it is lit is decided later
        } = material;
        self.list(base_color);
        self.list(&[*metallic, *roughness]);
        self.list(emissive);
        let (mode, cutoff) = match *alpha_mode {
            AlphaMode::Opaque => (0, 0.0),
            AlphaMode::Mask { cutoff } => (1, cutoff),
            AlphaMode::Blend => (2, 0.0),
        };
        self.number(mode);
        self.list(&[cutoff]);
        textures_read(material).into_iter().for_each(|slot| self.slot(slot));
    }

    /// With its texture's content.
    pub fn slot(&mut self, slot: Option<TextureRef>) {
        self.number(u64::from(slot.is_some()));
        let Some(TextureRef { texture, tex_coord, uv_from_tex_coord }) = slot else { return };
        self.number(tex_coord as u64);
        self.list(&uv_from_tex_coord.to_cols_array());
        let Some((texture, image)) = self.textures.get(texture) else { return };
        let Texture { name: _, image: _, wrap, nearest } = texture;
        self.hasher.update(image.as_bytes());
        for wrap in wrap {
            self.number(match wrap {
                Wrap::Repeat => 0,
                Wrap::MirroredRepeat => 1,
                Wrap::ClampToEdge => 2,
            });
        }
        self.number(u64::from(*nearest));
    }
}

/// The textures of a scene with their images' hashes, each made once, when first asked for: images
/// are most of a scene's bytes.
#[derive(Debug)]
pub struct TextureHashes {
    textures: Vec<Texture>,
    /// By texture, into `images`: textures may share one.
    image_of: Vec<usize>,
    images: Vec<(Arc<RgbaImage>, OnceLock<Hash>)>,
}

impl TextureHashes {
    /// Images are shared with `textures`, not copied.
    pub fn new(textures: &[Texture]) -> Self {
        let mut images = Vec::new();
        let mut known: HashMap<*const RgbaImage, usize> = HashMap::new();
        let image_of = textures.iter().map(|texture| {
            *known.entry(Arc::as_ptr(&texture.image)).or_insert_with(|| {
                images.push((Arc::clone(&texture.image), OnceLock::new()));
                images.len() - 1
            })
        });
        Self { image_of: image_of.collect(), textures: textures.to_vec(), images }
    }

    /// Hashes what the materials read, in parallel, so that keys need not do it one after the other.
    pub fn make<'a>(
        &self,
        materials: impl IntoIterator<Item = &'a Material>,
        progress: &Progress,
    ) -> Result<(), Cancelled> {
        let mut images: Vec<usize> = materials
            .into_iter()
            .flat_map(textures_read)
            .filter_map(|slot| self.image_of.get(slot?.texture).copied())
            .collect();
        images.sort_unstable();
        images.dedup();
        images.into_par_iter().try_for_each(|image| {
            self.hash(image);
            progress.advance(0)
        })
    }

    fn get(&self, texture: usize) -> Option<(&Texture, &Hash)> {
        Some((self.textures.get(texture)?, self.hash(*self.image_of.get(texture)?)))
    }

    fn hash(&self, image: usize) -> &Hash {
        let (image, hash) = &self.images[image];
        hash.get_or_init(|| {
            let mut hasher = Hasher::new();
            hasher.update(&image.width().to_le_bytes());
            hasher.update(&image.height().to_le_bytes());
            hasher.update(image.as_raw());
            hasher.finalize()
        })
    }
}
