//! Materials and textures as the GPU voxelizes with them: every level of a texture that has no more texels along a side
//! than the grid has cells. A piece of a surface in a cell reads finer ones only where it is a corner of the cell.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use super::pyramid::{CodedLevels, TexturePyramids};
use super::shade::{SurfaceMaterial, SurfaceTexture};
use crate::data::texels::Texels;
use crate::scene::{Material, Scene, TextureRef};

/// What `voxelize/shade` reads.
#[derive(Clone, Debug, Default)]
pub struct SurfaceMaterials {
    /// The scene's, and the default one.
    pub materials: Vec<SurfaceMaterial>,
    pub texels: Vec<u32>,
}

impl SurfaceMaterials {
    /// `brightest`: the unit of emission, nits; 0: nothing emits. Textures are read of the materials that `is_used`.
    pub fn new(
        scene: &Scene,
        pyramids: &TexturePyramids,
        (cells, brightest): (u32, f32),
        is_used: impl Fn(usize) -> bool,
    ) -> Self {
        let default = Material::default();
        let materials: Vec<(usize, &Material)> = scene.materials.iter().chain([&default]).enumerate().collect();
        let slots = |(index, material): (usize, &Material)| {
            let base = material.base_color_texture.map(|slot| (slot, Texels::of_base_color(material)));
            let emissive = material.emissive_texture.map(|slot| (slot, Texels::Opaque));
            [base, emissive].map(|slot| slot.filter(|_| is_used(index)))
        };
        let read = materials.iter().flat_map(|material| slots(*material)).flatten();
        let read: BTreeSet<(usize, Texels)> = read.map(|(slot, texels)| (slot.texture, texels)).collect();
        let coded = |read: (usize, Texels)| Some((read, pyramids.coded(read.0, read.1, cells as usize)?));
        let coded: Vec<_> = read.into_par_iter().filter_map(coded).collect();
        let (mut texels, mut placed) = (Vec::new(), BTreeMap::new());
        for (read, levels) in coded {
            placed.insert(read, levels.place(&mut texels, read.1));
        }
        let texture = |slot: Option<(TextureRef, Texels)>| {
            let found = slot.and_then(|(slot, read)| Some((slot, placed.get(&(slot.texture, read))?)));
            found.map_or(SurfaceTexture::default(), |(slot, levels)| {
                let texture = &scene.textures[slot.texture];
                SurfaceTexture::new(slot, (texture.wrap, texture.nearest), levels)
            })
        };
        let materials =
            materials.iter().map(|material| SurfaceMaterial::new(material.1, brightest, slots(*material).map(texture)));
        // A binding holds at least a word.
        Self { materials: materials.collect(), texels: if texels.is_empty() { vec![0] } else { texels } }
    }
}

impl CodedLevels {
    /// Appends where each level begins and how large it is, then the texels.
    fn place(self, words: &mut Vec<u32>, texels: Texels) -> SurfaceTexture {
        let first_word = words.len();
        let mut next = first_word + 2 * self.levels.len();
        for (size, coded) in &self.levels {
            words.extend([next as u32, size[0] as u32 | (size[1] as u32) << 16]);
            next += coded.len();
        }
        let end_level = (self.first_level + self.levels.len()) as u32;
        self.levels.into_iter().for_each(|(_, coded)| words.extend(coded));
        SurfaceTexture {
            first_word: first_word as u32,
            size: self.size.map(|side| side as u32),
            first_level: self.first_level as u32,
            end_level,
            is_covering: u32::from(matches!(texels, Texels::Covering | Texels::Cut { .. })),
            ..SurfaceTexture::default()
        }
    }
}
