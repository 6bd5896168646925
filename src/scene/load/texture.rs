//! Textures: images and how they are addressed. Images are decoded in parallel; one that cannot be
//! decoded costs its textures, which is said in a warning, not the file.

use std::sync::Arc;

use glam::{Affine2, Vec2};
use gltf::json::{
    Image,
    extensions::texture::TextureTransform,
    texture::{Info, MagFilter, Sampler, WrappingMode},
    validation::Checked,
};
use image::RgbaImage;
use rayon::prelude::*;

use super::{error::Defect, file_object::FileObject, image as image_file, source::Source, uri::Target};
use crate::{
    progress::Progress,
    scene::{Texture, TextureRef, Warning, Wrap},
};

/// The textures that could be read, and for each of the file where it went.
pub(super) struct Textures {
    pub list: Vec<Texture>,
    places: Vec<Option<usize>>,
}

impl Textures {
    pub fn load(source: &Source, progress: &Progress, warnings: &mut Vec<Warning>) -> Result<Self, Defect> {
        let root = &source.root;
        let images = decode_images(source, progress)?;
        for (index, image) in images.iter().enumerate() {
            let object = FileObject::item("image", index, root.images[index].name.as_deref());
            if let Ok(Decoded { repair: Some(repair), .. }) = image {
                warnings.push(object.warning(format!("it {repair}")));
            }
            if let Err(cause) = image {
                let sentence = format!("{object} {cause}; materials go without it");
                warnings.push(Warning { part: object.part(), ..Warning::new(sentence) });
            }
        }
        let mut textures = Self { list: Vec::new(), places: Vec::new() };
        for (index, texture) in root.textures.iter().enumerate() {
            let object = FileObject::item("texture", index, texture.name.as_deref());
            // Without an image the source is out of range.
            let place = root.images.get(texture.source.value());
            if place.is_none() {
                warnings.push(object.warning("it has no image; materials go without it"));
            }
            let image = images.get(texture.source.value()).and_then(|image| Some(&image.as_ref().ok()?.image));
            textures.places.push(image.map(|_| textures.list.len()));
            textures.list.extend(image.zip(place).map(|(image, declared)| {
                let sampler = texture.sampler.and_then(|sampler| root.samplers.get(sampler.value()));
                let uri = declared.uri.as_deref().filter(|uri| !uri.starts_with("data:"));
                let name = texture.name.as_deref().or(declared.name.as_deref()).or(uri);
                Texture {
                    name: name.map_or_else(|| format!("texture {index}"), str::to_owned),
                    image: Arc::clone(image),
                    wrap: wraps(sampler, &object, warnings),
                    nearest: matches!(sampler.and_then(|s| s.mag_filter), Some(Checked::Valid(MagFilter::Nearest))),
                }
            }));
        }
        Ok(textures)
    }

    /// Adds a texture of our own making; returns where it is.
    pub fn add(&mut self, texture: Texture) -> usize {
        self.list.push(texture);
        self.list.len() - 1
    }

    /// How a material's slot reads its texture; `None` where it is empty or must do without.
    pub fn slot(&self, object: &FileObject, info: Option<&Info>, warnings: &mut Vec<Warning>) -> Option<TextureRef> {
        let info = info?;
        self.place(object, info.index.value(), info.tex_coord, transform(info), warnings)
    }

    /// [`Self::slot`] by its parts.
    pub fn place(
        &self,
        object: &FileObject,
        texture: usize,
        tex_coord: u32,
        transform: Option<&TextureTransform>,
        warnings: &mut Vec<Warning>,
    ) -> Option<TextureRef> {
        let texture = self.places.get(texture).copied().flatten()?;
        let tex_coord = overridden(tex_coord, transform);
        if tex_coord > 1 {
            warnings.push(
                object.warning(format!("a texture reads TEXCOORD_{tex_coord}, and 0 and 1 are read; it is left out")),
            );
            return None;
        }
        let uv_from_tex_coord = transform.map_or(Affine2::IDENTITY, affine);
        if !uv_from_tex_coord.is_finite() {
            warnings.push(object.warning("a texture's transform is not finite; the texture is left out"));
            return None;
        }
        Some(TextureRef { texture, tex_coord: tex_coord as usize, uv_from_tex_coord })
    }
}

fn transform(info: &Info) -> Option<&TextureTransform> {
    info.extensions.as_ref()?.texture_transform.as_ref()
}

/// A transform may name another set of coordinates.
pub(super) fn overridden(tex_coord: u32, transform: Option<&TextureTransform>) -> u32 {
    transform.and_then(|transform| transform.tex_coord).unwrap_or(tex_coord)
}

/// Which `TEXCOORD_n` a slot reads.
pub(super) fn tex_coord_set(info: &Info) -> u32 {
    overridden(info.tex_coord, transform(info))
}

/// KHR_texture_transform: scale, then a turn against the clock as seen with v downwards, then offset.
fn affine(transform: &TextureTransform) -> Affine2 {
    let [scale, offset] = [transform.scale.0, transform.offset.0].map(Vec2::from_array);
    Affine2::from_scale_angle_translation(scale, -transform.rotation.0, offset)
}

fn wraps(sampler: Option<&Sampler>, object: &FileObject, warnings: &mut Vec<Warning>) -> [Wrap; 2] {
    let Some(sampler) = sampler else { return [Wrap::Repeat; 2] };
    [sampler.wrap_s, sampler.wrap_t].map(|mode| match mode {
        Checked::Valid(WrappingMode::Repeat) => Wrap::Repeat,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::MirroredRepeat,
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::ClampToEdge,
        Checked::Invalid => {
            warnings.push(object.warning("its sampler has a wrap mode that glTF does not know; it repeats"));
            Wrap::Repeat
        }
    })
}

/// An image, and what was amiss with the way to it.
struct Decoded {
    image: Arc<RgbaImage>,
    repair: Option<String>,
}

/// By image of the file, whether a texture shows it or not.
fn decode_images(source: &Source, progress: &Progress) -> Result<Vec<Result<Decoded, String>>, Defect> {
    let images = &source.root.images;
    progress.add_total(images.len() as u64);
    let decoded: Vec<Result<Result<Decoded, String>, Defect>> = (images.par_iter())
        .map(|image| {
            let decoded = decode(source, image);
            progress.advance(1)?;
            Ok(decoded)
        })
        .collect();
    decoded.into_iter().collect()
}

fn decode(source: &Source, image: &Image) -> Result<Decoded, String> {
    let (image, repair) = match (&image.uri, image.buffer_view) {
        (Some(uri), _) => {
            let found = Target::of(uri, source.base_dir)?.read(source.budget)?;
            (image_file::decode(&found.bytes, source.budget)?, found.repair)
        }
        (None, Some(view)) => (image_file::decode(source.view_bytes(view)?, source.budget)?, None),
        (None, None) => return Err("has no data".to_owned()),
    };
    Ok(Decoded { image: Arc::new(image), repair })
}
