//! References between the lists of a document. One that leads nowhere is taken out where the rest
//! makes sense without it, and refuses the file where it does not.

use serde_json::Value;

use super::few::Few;
use super::tree::{self, Keep};
use crate::scene::Warning;
use crate::scene::load::error::Defect;

/// A reference: where it stands, inside of what it is (a key, or nothing), and the list it leads into.
struct Reference {
    pattern: &'static str,
    /// The member of the matched object that is the index; empty: the matched value itself.
    key: &'static str,
    list: &'static str,
    /// What is done without it; `None`: the file makes no sense then.
    repair: Option<&'static str>,
}

const fn needed(pattern: &'static str, list: &'static str) -> Reference {
    Reference { pattern, key: "", list, repair: None }
}

const fn spare(pattern: &'static str, list: &'static str, repair: &'static str) -> Reference {
    Reference { pattern, key: "", list, repair: Some(repair) }
}

const fn texture(pattern: &'static str) -> Reference {
    Reference { pattern, key: "index", list: "textures", repair: Some("the material goes without it") }
}

const REFERENCES: [Reference; 37] = [
    needed("bufferViews/*/buffer", "buffers"),
    needed("bufferViews/*/extensions/EXT_meshopt_compression/buffer", "buffers"),
    needed("bufferViews/*/extensions/KHR_meshopt_compression/buffer", "buffers"),
    needed("accessors/*/bufferView", "bufferViews"),
    needed("accessors/*/sparse/indices/bufferView", "bufferViews"),
    needed("accessors/*/sparse/values/bufferView", "bufferViews"),
    needed("meshes/*/primitives/*/attributes/*", "accessors"),
    needed("meshes/*/primitives/*/indices", "accessors"),
    needed("meshes/*/primitives/*/targets/*/*", "accessors"),
    needed("meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/bufferView", "bufferViews"),
    needed("nodes/*/extensions/EXT_mesh_gpu_instancing/attributes/*", "accessors"),
    needed("skins/*/joints/*", "nodes"),
    needed("skins/*/inverseBindMatrices", "accessors"),
    needed("animations/*/samplers/*/input", "accessors"),
    needed("animations/*/samplers/*/output", "accessors"),
    spare("scene", "scenes", "the first scene is shown"),
    spare("scenes/*/nodes/*", "nodes", "it is left out"),
    spare("nodes/*/children/*", "nodes", "it is left out"),
    spare("nodes/*/mesh", "meshes", "the node shows nothing"),
    spare("nodes/*/skin", "skins", "the node moves as a whole"),
    spare("nodes/*/camera", "cameras", "it is left out"),
    Reference {
        pattern: "nodes/*/extensions/KHR_lights_punctual",
        key: "light",
        list: "extensions/KHR_lights_punctual/lights",
        repair: Some("it is left out"),
    },
    spare("meshes/*/primitives/*/material", "materials", "the default material is shown"),
    spare("skins/*/skeleton", "nodes", "it is not needed"),
    Reference { pattern: "animations/*/channels/*/target", key: "node", list: "nodes", repair: Some("it is left out") },
    spare("images/*/bufferView", "bufferViews", "the image is left out"),
    spare("textures/*/sampler", "samplers", "it is filtered linearly and repeats"),
    spare("textures/*/source", "images", "materials go without it"),
    texture("materials/*/normalTexture"),
    texture("materials/*/occlusionTexture"),
    texture("materials/*/emissiveTexture"),
    texture("materials/*/pbrMetallicRoughness/baseColorTexture"),
    texture("materials/*/pbrMetallicRoughness/metallicRoughnessTexture"),
    texture("materials/*/extensions/*/diffuseTexture"),
    texture("materials/*/extensions/*/specularGlossinessTexture"),
    texture("materials/*/extensions/*/specularTexture"),
    texture("materials/*/extensions/*/specularColorTexture"),
];

/// Checks every reference. Channels without a node or sampler go with them.
pub fn repair(tree: &mut Value, warnings: &mut Vec<Warning>) -> Result<(), Defect> {
    for reference in &REFERENCES {
        let length = length_of(tree, reference.list);
        let mut lost: Vec<(Vec<String>, u64)> = Vec::new();
        tree::retain(tree, reference.pattern, &mut |path, value| {
            let index = if reference.key.is_empty() { Some(&*value) } else { value.get(reference.key) };
            match index.and_then(Value::as_u64) {
                Some(index) if index >= length => {
                    lost.push((path.to_vec(), index));
                    Keep::No
                }
                _ => Keep::Yes,
            }
        });
        let mut few = Few::default();
        for (path, index) in lost {
            let object = tree::object_at(tree, &path);
            let list = reference.list.rsplit('/').next().unwrap_or(reference.list);
            let cause = format!("leads to number {index} of {length} {list}");
            match reference.repair {
                Some(repair) => few.add(|| object.warning(format!("it {cause}; {repair}"))),
                None => return Err(Defect::new(object, cause)),
            }
        }
        few.append_to(warnings);
    }
    drop_channels(tree, warnings);
    Ok(())
}

fn length_of(tree: &Value, list: &str) -> u64 {
    tree.pointer(&format!("/{list}")).and_then(Value::as_array).map_or(0, |items| items.len() as u64)
}

/// A channel whose target was taken out, or that names a sampler that is not there, moves nothing.
fn drop_channels(tree: &mut Value, warnings: &mut Vec<Warning>) {
    let mut samplers = Vec::new();
    tree::visit(tree, "animations/*", &mut |_, animation| {
        samplers.push(animation.get("samplers").and_then(Value::as_array).map_or(0, |list| list.len() as u64));
    });
    let mut lost = Vec::new();
    tree::retain(tree, "animations/*/channels/*", &mut |path, channel| {
        let known = path[1].parse().ok().and_then(|animation: usize| samplers.get(animation)).copied().unwrap_or(0);
        let sampler = channel.get("sampler").and_then(Value::as_u64).filter(|&sampler| sampler >= known);
        if let Some(sampler) = sampler {
            lost.push((path.to_vec(), format!("leads to number {sampler} of {known} samplers")));
            return Keep::No;
        }
        // A target without a node is for extensions that are not read; one that is gone was named before.
        match channel.get("target") {
            Some(target) if target.is_object() && target.get("node").is_none() => {
                lost.push((path.to_vec(), "names no node".to_owned()));
                Keep::No
            }
            Some(_) => Keep::Yes,
            None => {
                if channel.is_object() {
                    Keep::No
                } else {
                    Keep::Yes
                }
            }
        }
    });
    let mut few = Few::default();
    for (path, cause) in lost {
        few.add(|| tree::object_at(tree, &path).warning(format!("it {cause}; it is left out")));
    }
    few.append_to(warnings);
}
