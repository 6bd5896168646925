//! The materials of the courtyard. Colours are linear.

use gltf::json::{Index, Material};
use image::ImageResult;

use super::super::character::piece::Cloths;
use super::super::glb::{GlbWriter, Paint};
use super::super::textures;

pub struct Palette {
    pub masonry: Masonry,
    pub fittings: Fittings,
    pub banners: [Index<Material>; 3],
    pub cloths: Cloths,
}

/// What the building is made of.
pub struct Masonry {
    pub paving: Index<Material>,
    pub inlay: Index<Material>,
    pub gallery_floor: Index<Material>,
    pub stone: Index<Material>,
    pub dark_stone: Index<Material>,
    pub red_wall: Index<Material>,
    pub blue_wall: Index<Material>,
    pub cream_wall: Index<Material>,
    pub brick: Index<Material>,
    pub roof: Index<Material>,
    pub wood: Index<Material>,
}

/// What else stands and hangs in it.
pub struct Fittings {
    pub iron: Index<Material>,
    pub bronze: Index<Material>,
    pub silver: Index<Material>,
    pub water: Index<Material>,
    pub lamp: Index<Material>,
    pub clay: Index<Material>,
    pub leaves: Index<Material>,
}

impl Palette {
    pub fn new(glb: &mut GlbWriter) -> ImageResult<Self> {
        let fittings = fittings(glb);
        let cloths = cloths(glb, &fittings);
        Ok(Self { masonry: masonry(glb)?, fittings, banners: banners(glb)?, cloths })
    }
}

fn plain(base_color: [f32; 3], roughness: f32) -> Paint {
    Paint { base_color, roughness, ..Paint::default() }
}

fn metal(base_color: [f32; 3], roughness: f32) -> Paint {
    Paint { metallic: 1.0, ..plain(base_color, roughness) }
}

fn masonry(glb: &mut GlbWriter) -> ImageResult<Masonry> {
    let tiles = Some(glb.texture("stone tiles", &textures::stone_tiles()?));
    let tiles_roughness = Some(glb.texture("stone tiles, roughness", &textures::stone_tiles_roughness()?));
    let plaster = Some(glb.texture("plaster", &textures::plaster()?));
    let travertine = Some(glb.texture("travertine", &textures::travertine()?));
    let brick = Some(glb.texture("brick", &textures::brick()?));
    let roof = Some(glb.texture("roof tiles", &textures::roof_tiles()?));
    let wood = Some(glb.texture("wood", &textures::wood()?));
    let textured = |base_color_texture, base_color: [f32; 3], roughness: f32| Paint {
        base_color_texture,
        ..plain(base_color, roughness)
    };
    // Factors of 1 leave roughness and metalness to the texture.
    let paving =
        Paint { metallic: 1.0, metallic_roughness_texture: tiles_roughness, ..textured(tiles, [1.0, 1.0, 1.0], 1.0) };
    let roof = Paint { double_sided: true, ..textured(roof, [1.0, 0.94, 0.88], 0.85) };
    Ok(Masonry {
        paving: glb.material("paving", paving),
        inlay: glb.material("polished inlay", plain([0.030, 0.062, 0.055], 0.05)),
        gallery_floor: glb.material("gallery floor", textured(tiles, [0.95, 0.62, 0.46], 0.45)),
        stone: glb.material("travertine", textured(travertine, [0.76, 0.67, 0.54], 0.7)),
        dark_stone: glb.material("grey stone", textured(travertine, [0.33, 0.31, 0.29], 0.55)),
        red_wall: glb.material("red plaster", textured(plaster, [0.66, 0.085, 0.050], 0.92)),
        blue_wall: glb.material("blue plaster", textured(plaster, [0.060, 0.175, 0.56], 0.92)),
        cream_wall: glb.material("cream plaster", textured(plaster, [0.84, 0.74, 0.56], 0.92)),
        brick: glb.material("brick", textured(brick, [1.0, 1.0, 1.0], 0.9)),
        roof: glb.material("roof tiles", roof),
        wood: glb.material("wood", textured(wood, [0.85, 0.80, 0.75], 0.65)),
    })
}

fn fittings(glb: &mut GlbWriter) -> Fittings {
    let lamp = Paint { emissive: [1.0, 0.56, 0.20], emissive_strength: 14.0, ..plain([0.9, 0.75, 0.5], 0.5) };
    Fittings {
        iron: glb.material("iron", metal([0.10, 0.10, 0.11], 0.55)),
        bronze: glb.material("bronze", metal([0.86, 0.55, 0.24], 0.28)),
        silver: glb.material("silver", metal([0.90, 0.90, 0.88], 0.14)),
        water: glb.material("water", plain([0.03, 0.13, 0.15], 0.03)),
        lamp: glb.material("lamp glass", lamp),
        clay: glb.material("clay", plain([0.58, 0.23, 0.11], 0.8)),
        leaves: glb.material("leaves", plain([0.055, 0.17, 0.045], 0.75)),
    }
}

/// Crimson, teal and ochre cloth, each with its trim (sRGB).
fn banners(glb: &mut GlbWriter) -> ImageResult<[Index<Material>; 3]> {
    let cloths = [
        ("crimson banner", [0.70, 0.11, 0.13], [0.95, 0.76, 0.36]),
        ("teal banner", [0.05, 0.43, 0.45], [0.93, 0.90, 0.78]),
        ("ochre banner", [0.88, 0.60, 0.16], [0.50, 0.12, 0.14]),
    ];
    let [crimson, teal, ochre] = cloths.map(|(name, field, trim)| -> ImageResult<_> {
        let texture = glb.texture(name, &textures::woven_banner(field, trim)?);
        let paint = Paint { base_color_texture: Some(texture), roughness: 0.9, double_sided: true, ..Paint::default() };
        Ok(glb.material(name, paint))
    });
    Ok([crimson?, teal?, ochre?])
}

/// What the traveller wears.
fn cloths(glb: &mut GlbWriter, fittings: &Fittings) -> Cloths {
    let two_sided = |base_color: [f32; 3]| Paint { double_sided: true, ..plain(base_color, 0.9) };
    let hair = glb.material("hair", plain([0.09, 0.045, 0.022], 0.7));
    Cloths {
        skin: glb.material("skin", plain([0.62, 0.36, 0.24], 0.6)),
        hair,
        tunic: glb.material("tunic", two_sided([0.10, 0.30, 0.16])),
        trim: glb.material("scarf", plain([0.80, 0.42, 0.05], 0.9)),
        sleeves: glb.material("linen", plain([0.78, 0.72, 0.60], 0.9)),
        trousers: glb.material("trousers", plain([0.16, 0.12, 0.10], 0.9)),
        leather: glb.material("leather", plain([0.20, 0.085, 0.035], 0.5)),
        cape: glb.material("cape", two_sided([0.50, 0.045, 0.055])),
        dark: hair,
        metal: fittings.bronze,
    }
}
