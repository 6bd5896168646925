//! Materials, textures and their images. Images are decoded in parallel; one that cannot be
//! decoded costs its textures, which is said in a warning, not the file.

use std::{io::Cursor, path::Path, sync::Arc};

use gltf::{
    json,
    material::AlphaMode as FileAlphaMode,
    texture::{MagFilter, WrappingMode},
};
use image::{ImageReader, RgbaImage};
use rayon::prelude::*;

use super::{
    error::{Defect, label},
    source::{Source, read_uri},
};
use crate::{
    progress::Progress,
    scene::{AlphaMode, Material, Texture, TextureRef, Wrap},
};

/// The textures that could be read, and for each of the file where it went.
pub(super) struct Textures {
    pub list: Vec<Texture>,
    places: Vec<Option<usize>>,
}

impl Textures {
    pub fn load(
        source: &Source,
        base_dir: Option<&Path>,
        progress: &Progress,
        warnings: &mut Vec<String>,
    ) -> Result<Self, Defect> {
        let root = source.document.as_json();
        let images = decode_images(source, base_dir, progress)?;
        let mut textures = Self { list: Vec::new(), places: Vec::new() };
        for (index, image) in images.iter().enumerate() {
            if let Some(Err(cause)) = image {
                let object = label("image", index, root.images[index].name.as_deref());
                warnings.push(format!("{object} {cause}; materials go without it"));
            }
        }
        for texture in source.document.textures() {
            let image = texture.source().and_then(|image| images.get(image.index())?.as_ref()?.as_ref().ok());
            textures.places.push(image.map(|_| textures.list.len()));
            textures.list.extend(image.map(|image| Texture {
                name: texture_name(root, &texture),
                image: image.clone(),
                wrap: [wrap(texture.sampler().wrap_s()), wrap(texture.sampler().wrap_t())],
                nearest: texture.sampler().mag_filter() == Some(MagFilter::Nearest),
            }));
        }
        Ok(textures)
    }

    /// `None` where the slot is empty or must do without its texture.
    fn slot(&self, object: &str, slot: Option<(usize, u32)>, warnings: &mut Vec<String>) -> Option<TextureRef> {
        let (texture, tex_coord) = slot?;
        if tex_coord > 1 {
            warnings
                .push(format!("{object}: a texture reads TEXCOORD_{tex_coord}, and 0 and 1 are read; it is left out"));
            return None;
        }
        let texture = self.places.get(texture).copied().flatten()?;
        Some(TextureRef { texture, tex_coord: tex_coord as usize })
    }
}

fn texture_name(root: &json::Root, texture: &gltf::Texture) -> String {
    let image = texture.source().map(|image| &root.images[image.index()]);
    let uri = image.and_then(|image| image.uri.as_deref()).filter(|uri| !uri.starts_with("data:"));
    let name = texture.name().or(image.and_then(|image| image.name.as_deref())).or(uri);
    name.map_or_else(|| format!("texture {}", texture.index()), str::to_owned)
}

type Decoded = Option<Result<Arc<RgbaImage>, String>>;

/// By image of the file; `None` for those no texture shows.
fn decode_images(source: &Source, base_dir: Option<&Path>, progress: &Progress) -> Result<Vec<Decoded>, Defect> {
    let root = source.document.as_json();
    let mut used = vec![false; root.images.len()];
    for texture in &root.textures {
        if let Some(used) = used.get_mut(texture.source.value()) {
            *used = true;
        }
    }
    progress.add_total(used.iter().filter(|&&used| used).count() as u64);
    let decoded: Vec<Result<Decoded, Defect>> = (root.images.par_iter().zip(used))
        .map(|(image, used)| {
            let decoded = used.then(|| decode(source, image, base_dir).map(Arc::new));
            progress.advance(u64::from(used))?;
            Ok(decoded)
        })
        .collect();
    decoded.into_iter().collect()
}

fn decode(source: &Source, image: &json::Image, base_dir: Option<&Path>) -> Result<RgbaImage, String> {
    let file_bytes;
    let bytes = match (&image.uri, image.buffer_view) {
        (Some(uri), _) => {
            file_bytes = read_uri(uri, base_dir)?;
            &file_bytes
        }
        (None, Some(view)) => source.view_bytes(view)?,
        (None, None) => return Err("has no data".to_owned()),
    };
    // The content decides: declared types are wrong in files that everything else opens.
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|error| error.to_string())?;
    let image = reader.decode().map_err(|error| format!("cannot be decoded: {error}"))?;
    Ok(image.into_rgba8())
}

fn wrap(mode: WrappingMode) -> Wrap {
    match mode {
        WrappingMode::Repeat => Wrap::Repeat,
        WrappingMode::MirroredRepeat => Wrap::MirroredRepeat,
        WrappingMode::ClampToEdge => Wrap::ClampToEdge,
    }
}

pub(super) fn load(source: &Source, textures: &Textures, warnings: &mut Vec<String>) -> Result<Vec<Material>, Defect> {
    let materials = source.document.materials().enumerate();
    materials.map(|(index, material)| load_material(index, &material, textures, warnings)).collect()
}

fn load_material(
    index: usize,
    material: &gltf::Material,
    textures: &Textures,
    warnings: &mut Vec<String>,
) -> Result<Material, Defect> {
    let object = label("material", index, material.name());
    let info = |info: Option<gltf::texture::Info>| info.map(|info| (info.texture().index(), info.tex_coord()));
    let mut slot = |slot| textures.slot(&object, slot, warnings);
    let pbr = material.pbr_metallic_roughness();
    let normal = material.normal_texture();
    let emissive_slot = info(material.emissive_texture());
    let emissive_texture = slot(emissive_slot);
    // An emission whose mask is lost would light up the whole surface.
    let emission_lost = emissive_slot.is_some() && emissive_texture.is_none();
    let strength = if emission_lost { 0.0 } else { material.emissive_strength().unwrap_or(1.0) };
    let loaded = Material {
        name: material.name().map_or_else(|| format!("material {index}"), str::to_owned),
        base_color: pbr.base_color_factor(),
        base_color_texture: slot(info(pbr.base_color_texture())),
        metallic: pbr.metallic_factor(),
        roughness: pbr.roughness_factor(),
        metallic_roughness_texture: slot(info(pbr.metallic_roughness_texture())),
        normal_scale: normal.as_ref().map_or(1.0, |normal| normal.scale()),
        normal_texture: slot(normal.map(|normal| (normal.texture().index(), normal.tex_coord()))),
        emissive: material.emissive_factor().map(|channel| channel * strength),
        emissive_texture,
        alpha_mode: match material.alpha_mode() {
            FileAlphaMode::Opaque => AlphaMode::Opaque,
            FileAlphaMode::Mask => AlphaMode::Mask { cutoff: material.alpha_cutoff().unwrap_or(0.5) },
            FileAlphaMode::Blend => AlphaMode::Blend,
        },
        double_sided: material.double_sided(),
    };
    let factors = [loaded.metallic, loaded.roughness, loaded.normal_scale];
    let mut numbers = factors.iter().chain(&loaded.base_color).chain(&loaded.emissive);
    if numbers.all(|number| number.is_finite()) {
        Ok(loaded)
    } else {
        Err(Defect::new(object, "has a factor that is not finite"))
    }
}
