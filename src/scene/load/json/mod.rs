//! From JSON text to a typed document in which every reference leads somewhere.
//!
//! ```text
//! text ─► tree ─► conformance (warnings) ─► repairs: references, pointers, images ─► typed Root
//! ```
//!
//! Repairs happen in the tree, so that everything after it may trust what it is given.

mod conformance;
mod extensions;
mod few;
mod pointers;
mod references;
mod textures;
mod tree;

pub(super) use few::Few;
use gltf::json::Root;
use serde_json::Value;

use super::{error::Defect, file_object::FileObject};
use crate::scene::Warning;

const NOT_AN_OBJECT: &str = "cannot be read: invalid type, expected an object";

/// Parses, repairs and types the document; what was repaired or is not as glTF has it is warned of.
pub(super) fn read(text: &[u8], warnings: &mut Vec<Warning>) -> Result<Root, Defect> {
    let mut tree: Value =
        serde_json::from_slice(text).map_err(|error| Defect::new("document", format!("is not JSON: {error}")))?;
    if !tree.is_object() {
        return Err(Defect::new("document", NOT_AN_OBJECT));
    }
    check_objects(&tree)?;
    check_version(&tree, warnings)?;
    extensions::check_required(&tree)?;
    conformance::check(&tree, warnings);
    extensions::check(&tree, warnings);
    textures::take_extension_sources(&mut tree, warnings);
    pointers::resolve(&mut tree, warnings);
    references::repair(&mut tree, warnings)?;
    drop_extras(&mut tree);
    give_scenes_nodes(&mut tree);
    serde_path_to_error::deserialize(&tree).map_err(|error| {
        let path = error.path().to_string();
        let object =
            if path == "." { FileObject::other("document") } else { tree::object_at(&tree, &tree::steps_of(&path)) };
        Defect::new(object, format!("cannot be read: {}", error.inner()))
    })
}

/// Where glTF has an object, nothing else will do: the typed document would take an empty list for one
/// with nothing in it.
fn check_objects(tree: &Value) -> Result<(), Defect> {
    const OBJECTS: [&str; 6] = [
        "*/*",
        "extensions/*/*/*",
        "meshes/*/primitives/*",
        "meshes/*/primitives/*/targets/*",
        "animations/*/channels/*",
        "animations/*/samplers/*",
    ];
    let mut other = None;
    for pattern in OBJECTS {
        tree::visit(tree, pattern, &mut |path, value| {
            if value.is_array() {
                other.get_or_insert_with(|| tree::object_at(tree, path));
            }
        });
    }
    other.map_or(Ok(()), |object| Err(Defect::new(object, NOT_AN_OBJECT)))
}

/// At most what the tree and the typed document of a text take: a member costs a node of a search
/// tree, an item a value, an object of three bytes becomes one with dozens of empty members.
pub(super) fn memory_bytes(text: &[u8]) -> u64 {
    const OBJECT_BYTES: u64 = 4096;
    const ITEM_BYTES: u64 = 64;
    let price = |byte: &u8| match byte {
        b'{' => OBJECT_BYTES,
        b',' | b'[' => ITEM_BYTES,
        _ => 1,
    };
    text.iter().map(price).sum()
}

fn check_version(tree: &Value, warnings: &mut Vec<Warning>) -> Result<(), Defect> {
    let asset = tree.get("asset").ok_or_else(|| Defect::new("document", "has no asset, and so no glTF version"))?;
    let of = |key: &str| asset.get(key).and_then(Value::as_str);
    let version = of("version").ok_or_else(|| Defect::new("asset", "has no version"))?;
    for version in [Some(version), of("minVersion")].into_iter().flatten() {
        let numbers = version.split_once('.').filter(|(_, minor)| minor.parse::<u32>().is_ok());
        match numbers {
            Some(("2", "0")) => {}
            Some(("2", _)) => {
                let sentence = format!("asset: it asks for glTF version \"{version}\", and is read as 2.0");
                warnings.push(Warning::new(sentence));
            }
            Some(_) => {
                let cause = format!("needs glTF version \"{version}\", and only 2.0 can be read");
                return Err(Defect::new("asset", cause));
            }
            None => return Err(Defect::new("asset", format!("has the version \"{version}\", which is none"))),
        }
    }
    Ok(())
}

/// Whatever a program left for itself; the typed document cannot take it everywhere.
fn drop_extras(value: &mut Value) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(drop_extras),
        Value::Object(members) => {
            members.remove("extras");
            members.values_mut().for_each(drop_extras);
        }
        _ => {}
    }
}

/// A scene may be empty; the typed document wants a list.
fn give_scenes_nodes(tree: &mut Value) {
    tree::retain(tree, "scenes/*", &mut |_, scene| {
        if let Some(members) = scene.as_object_mut() {
            members.entry("nodes").or_insert_with(|| Value::Array(Vec::new()));
        }
        tree::Keep::Yes
    });
}
