//! Seeds about how things look: materials, pictures, cameras, lights.

use std::io::Cursor;

use image::{DynamicImage, ImageFormat, RgbaImage};
use serde_json::json;

use crate::document::Document;
use crate::seeds::require;

/// Cameras and lights.
pub fn sights() -> Document {
    let mut document = Document::with_triangle();
    document.json["cameras"] = json!([
        { "type": "perspective", "perspective": { "yfov": 1.0, "znear": 0.1 } },
        { "type": "orthographic", "orthographic": { "xmag": 1.0, "ymag": 1.0, "znear": 0.0, "zfar": 9.0 } },
    ]);
    document.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    document.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [
        { "type": "directional", "color": [1.0, 0.5, 0.25] },
        { "type": "point", "intensity": 3.0, "range": 2.0 },
        { "type": "spot", "spot": { "innerConeAngle": 0.25, "outerConeAngle": 0.5 } },
    ] } });
    for light in 0..3 {
        let extensions = json!({ "KHR_lights_punctual": { "light": light } });
        document.add("nodes", json!({ "extensions": extensions, "camera": light % 2 }));
    }
    document
}

fn picture(format: ImageFormat) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    let image = RgbaImage::from_fn(4, 4, |x, y| image::Rgba([60 * x as u8, 60 * y as u8, 9, 255]));
    let image = DynamicImage::ImageRgba8(image);
    match format {
        ImageFormat::Jpeg => image.to_rgb8().write_to(&mut file, format),
        _ => image.write_to(&mut file, format),
    }
    .expect("written to memory");
    file.into_inner()
}

pub fn textured(format: ImageFormat, mime_type: &str) -> Document {
    let mut document = Document::with_triangle().with_texture(&picture(format), mime_type);
    document.add("samplers", json!({ "magFilter": 9728, "wrapS": 33071, "wrapT": 33648 }));
    document.json["textures"][0]["sampler"] = json!(0);
    if format == ImageFormat::WebP {
        document.json["textures"] = json!([{ "extensions": { "EXT_texture_webp": { "source": 0 } } }]);
        require(&mut document, "EXT_texture_webp");
    }
    document
}

pub fn materials() -> Document {
    let mut document = Document::with_triangle().with_texture(&picture(ImageFormat::Png), "image/png");
    let uvs = document.floats("VEC2", &[0.0; 6]);
    let colors = document.floats("VEC4", &[1.0; 12]);
    document.primitive()["attributes"]["TEXCOORD_1"] = json!(uvs);
    document.primitive()["attributes"]["COLOR_0"] = json!(colors);
    let transform = json!({ "KHR_texture_transform": { "offset": [0.5, 0.0], "rotation": 1.0, "scale": [2.0, 2.0] } });
    let slot = json!({ "index": 0, "texCoord": 1, "extensions": transform });
    let first = &mut document.json["materials"][0];
    first["pbrMetallicRoughness"]["metallicRoughnessTexture"] = slot.clone();
    first["normalTexture"] = json!({ "index": 0, "scale": 0.5 });
    first["occlusionTexture"] = json!({ "index": 0, "strength": 0.5 });
    first["emissiveTexture"] = slot.clone();
    first["emissiveFactor"] = json!([1.0, 0.5, 0.0]);
    first["extensions"] = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 4.0 } });
    first["alphaMode"] = json!("MASK");
    first["alphaCutoff"] = json!(0.25);
    let spec_gloss =
        json!({ "diffuseFactor": [1.0, 1.0, 1.0, 0.5], "specularGlossinessTexture": slot, "glossinessFactor": 0.5 });
    document.add("materials", json!({
        "extensions": { "KHR_materials_pbrSpecularGlossiness": spec_gloss }, "alphaMode": "BLEND", "doubleSided": true,
    }));
    document.add("materials", json!({ "extensions": { "KHR_materials_unlit": {} } }));
    document.json["extensionsUsed"] = json!([
        "KHR_texture_transform",
        "KHR_materials_emissive_strength",
        "KHR_materials_pbrSpecularGlossiness",
        "KHR_materials_unlit"
    ]);
    document
}
