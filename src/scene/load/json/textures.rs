//! KHR_texture_basisu and EXT_texture_webp: the image a texture has in an extension takes the
//! place of the plain one, which stays where the extension's leads nowhere.

use serde_json::Value;

use super::few::Few;
use super::tree::{self, Keep};
use crate::scene::Warning;

const EXTENSIONS: [&str; 2] = ["KHR_texture_basisu", "EXT_texture_webp"];

pub fn take_extension_sources(tree: &mut Value, warnings: &mut Vec<Warning>) {
    let images = tree.get("images").and_then(Value::as_array).map_or(0, |images| images.len() as u64);
    let mut lost = Vec::new();
    tree::retain(tree, "textures/*", &mut |path, texture| {
        for extension in EXTENSIONS {
            let source = texture.pointer(&format!("/extensions/{extension}/source")).and_then(Value::as_u64);
            match source {
                Some(source) if source < images => texture["source"] = source.into(),
                Some(source) => lost.push((path.to_vec(), extension, source)),
                None => {}
            }
        }
        Keep::Yes
    });
    let mut few = Few::default();
    for (path, extension, source) in lost {
        let object = tree::object_at(tree, &path);
        let cause = format!("it leads to number {source} of {images} images; it is left out");
        few.add(|| object.member(extension).warning(cause));
    }
    few.append_to(warnings);
}
