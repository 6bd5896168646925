//! The materials of the courtyard. Colours are linear.

use gltf::json::{Index, Material};

use super::super::glb::{GlbWriter, Paint};
use super::super::textures;

pub struct Palette {
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
    pub iron: Index<Material>,
    pub bronze: Index<Material>,
    pub silver: Index<Material>,
    pub water: Index<Material>,
    pub lamp: Index<Material>,
    pub clay: Index<Material>,
    pub leaves: Index<Material>,
    pub banners: [Index<Material>; 3],
    pub skin: Index<Material>,
    pub hair: Index<Material>,
    pub tunic: Index<Material>,
    pub linen: Index<Material>,
    pub scarf: Index<Material>,
    pub trousers: Index<Material>,
    pub leather: Index<Material>,
    pub cape: Index<Material>,
}

impl Palette {
    pub fn new(glb: &mut GlbWriter) -> Self {
        let tiles = glb.texture("stone tiles", &textures::stone_tiles());
        let tiles_roughness = glb.texture("stone tiles, roughness", &textures::stone_tiles_roughness());
        let plaster = Some(glb.texture("plaster", &textures::plaster()));
        let travertine = Some(glb.texture("travertine", &textures::travertine()));
        let brick = Some(glb.texture("brick", &textures::brick()));
        let roof = Some(glb.texture("roof tiles", &textures::roof_tiles()));
        let wood = Some(glb.texture("wood", &textures::wood()));
        let plain = |base_color: [f32; 3], roughness: f32| Paint { base_color, roughness, ..Paint::default() };
        let metal = |base_color: [f32; 3], roughness: f32| Paint { metallic: 1.0, ..plain(base_color, roughness) };
        let wall = |base_color: [f32; 3]| Paint { base_color_texture: plaster, ..plain(base_color, 0.92) };
        let cloth = |base_color: [f32; 3]| Paint { double_sided: true, ..plain(base_color, 0.9) };
        let paving = Paint {
            base_color_texture: Some(tiles),
            metallic: 1.0,
            roughness: 1.0,
            metallic_roughness_texture: Some(tiles_roughness),
            ..Paint::default()
        };
        let lamp = Paint { emissive: [1.0, 0.56, 0.20], emissive_strength: 14.0, ..plain([0.9, 0.75, 0.5], 0.5) };
        Self {
            paving: glb.material("paving", paving),
            inlay: glb.material("polished inlay", plain([0.030, 0.062, 0.055], 0.05)),
            gallery_floor: glb.material(
                "gallery floor",
                Paint { base_color_texture: Some(tiles), ..plain([0.95, 0.62, 0.46], 0.45) },
            ),
            stone: glb
                .material("travertine", Paint { base_color_texture: travertine, ..plain([0.76, 0.67, 0.54], 0.7) }),
            dark_stone: glb
                .material("grey stone", Paint { base_color_texture: travertine, ..plain([0.33, 0.31, 0.29], 0.55) }),
            red_wall: glb.material("red plaster", wall([0.66, 0.085, 0.050])),
            blue_wall: glb.material("blue plaster", wall([0.060, 0.175, 0.56])),
            cream_wall: glb.material("cream plaster", wall([0.84, 0.74, 0.56])),
            brick: glb.material("brick", Paint { base_color_texture: brick, ..plain([1.0, 1.0, 1.0], 0.9) }),
            roof: glb.material(
                "roof tiles",
                Paint { base_color_texture: roof, double_sided: true, ..plain([1.0, 0.94, 0.88], 0.85) },
            ),
            wood: glb.material("wood", Paint { base_color_texture: wood, ..plain([0.85, 0.80, 0.75], 0.65) }),
            iron: glb.material("iron", metal([0.10, 0.10, 0.11], 0.55)),
            bronze: glb.material("bronze", metal([0.86, 0.55, 0.24], 0.28)),
            silver: glb.material("silver", metal([0.90, 0.90, 0.88], 0.14)),
            water: glb.material("water", plain([0.03, 0.13, 0.15], 0.03)),
            lamp: glb.material("lamp glass", lamp),
            clay: glb.material("clay", plain([0.58, 0.23, 0.11], 0.8)),
            leaves: glb.material("leaves", plain([0.055, 0.17, 0.045], 0.75)),
            banners: banners(glb),
            skin: glb.material("skin", plain([0.62, 0.36, 0.24], 0.6)),
            hair: glb.material("hair", plain([0.09, 0.045, 0.022], 0.7)),
            tunic: glb.material("tunic", cloth([0.10, 0.30, 0.16])),
            linen: glb.material("linen", plain([0.78, 0.72, 0.60], 0.9)),
            scarf: glb.material("scarf", plain([0.80, 0.42, 0.05], 0.9)),
            trousers: glb.material("trousers", plain([0.16, 0.12, 0.10], 0.9)),
            leather: glb.material("leather", plain([0.20, 0.085, 0.035], 0.5)),
            cape: glb.material("cape", cloth([0.50, 0.045, 0.055])),
        }
    }
}

/// Crimson, teal and ochre cloth, each with its trim (sRGB).
fn banners(glb: &mut GlbWriter) -> [Index<Material>; 3] {
    let cloths = [
        ("crimson banner", [0.70, 0.11, 0.13], [0.95, 0.76, 0.36]),
        ("teal banner", [0.05, 0.43, 0.45], [0.93, 0.90, 0.78]),
        ("ochre banner", [0.88, 0.60, 0.16], [0.50, 0.12, 0.14]),
    ];
    cloths.map(|(name, field, trim)| {
        let texture = glb.texture(name, &textures::woven_banner(field, trim));
        let paint = Paint { base_color_texture: Some(texture), roughness: 0.9, double_sided: true, ..Paint::default() };
        glb.material(name, paint)
    })
}
