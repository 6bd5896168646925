//! Pictures and materials of a file.

use gltf::json::extensions::material::{EmissiveStrength, EmissiveStrengthFactor};
use gltf::json::material::{EmissiveFactor, PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf::json::texture::{Info, MagFilter, MinFilter, Sampler};
use gltf::json::validation::Checked::Valid;
use gltf::json::{Image, Index, Material, Texture, image};

use super::GlbWriter;

/// A metallic-roughness material; colours are linear.
#[derive(Clone, Copy, Debug)]
pub struct Paint {
    pub base_color: [f32; 3],
    pub base_color_texture: Option<Index<Texture>>,
    pub metallic: f32,
    pub roughness: f32,
    /// Multiplies roughness (green) and metalness (blue).
    pub metallic_roughness_texture: Option<Index<Texture>>,
    pub emissive: [f32; 3],
    /// KHR_materials_emissive_strength; 1 leaves the extension out.
    pub emissive_strength: f32,
    pub double_sided: bool,
}

impl Default for Paint {
    fn default() -> Self {
        Self {
            base_color: [1.0; 3],
            base_color_texture: None,
            metallic: 0.0,
            roughness: 0.8,
            metallic_roughness_texture: None,
            emissive: [0.0; 3],
            emissive_strength: 1.0,
            double_sided: false,
        }
    }
}

impl GlbWriter {
    /// Embeds a PNG; it repeats and is filtered linearly.
    pub fn texture(&mut self, name: &str, png: &[u8]) -> Index<Texture> {
        let view = self.view(png, None);
        let source = self.root.push(Image {
            buffer_view: Some(view),
            mime_type: Some(image::MimeType("image/png".into())),
            name: Some(name.into()),
            uri: None,
            extensions: None,
            extras: None,
        });
        if self.root.samplers.is_empty() {
            self.root.push(Sampler {
                mag_filter: Some(Valid(MagFilter::Linear)),
                min_filter: Some(Valid(MinFilter::LinearMipmapLinear)),
                ..Sampler::default()
            });
        }
        let sampler = Some(Index::new(0));
        self.root.push(Texture { name: Some(name.into()), sampler, source, extensions: None, extras: None })
    }

    pub fn material(&mut self, name: &str, paint: Paint) -> Index<Material> {
        let [red, green, blue] = paint.base_color;
        let mut material = Material {
            name: Some(name.into()),
            double_sided: paint.double_sided,
            pbr_metallic_roughness: PbrMetallicRoughness {
                base_color_factor: PbrBaseColorFactor([red, green, blue, 1.0]),
                base_color_texture: paint.base_color_texture.map(first_uv_set),
                metallic_factor: StrengthFactor(paint.metallic),
                roughness_factor: StrengthFactor(paint.roughness),
                metallic_roughness_texture: paint.metallic_roughness_texture.map(first_uv_set),
                ..PbrMetallicRoughness::default()
            },
            emissive_factor: EmissiveFactor(paint.emissive),
            ..Material::default()
        };
        if paint.emissive_strength != 1.0 {
            let strength = EmissiveStrength { emissive_strength: EmissiveStrengthFactor(paint.emissive_strength) };
            material.extensions.get_or_insert_default().emissive_strength = Some(strength);
            self.use_extension("KHR_materials_emissive_strength");
        }
        self.root.push(material)
    }
}

fn first_uv_set(index: Index<Texture>) -> Info {
    Info { index, tex_coord: 0, extensions: None, extras: None }
}
