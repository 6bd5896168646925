//! Extensions: which are understood, which are shown without their effect, which are refused; and
//! whether a document declares those it uses and puts them where they belong.

use std::collections::BTreeMap;

use serde_json::Value;

use super::few::Few;
use super::tree;
use crate::scene::Warning;
use crate::scene::load::error::{Defect, counted};

/// What is done with an extension.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Support {
    Read,
    /// Accepted; what it adds is not shown, as the note says.
    Noted(&'static str),
}

/// Name, support, and the end of the paths of objects that may carry it.
struct Known {
    name: &'static str,
    support: Support,
    carriers: &'static [Carrier],
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Carrier {
    Document,
    Node,
    Material,
    Primitive,
    Texture,
    TextureSlot,
    Buffer,
    BufferView,
    Target,
}

const fn read(name: &'static str, carriers: &'static [Carrier]) -> Known {
    Known { name, support: Support::Read, carriers }
}

const fn noted(name: &'static str, note: &'static str) -> Known {
    Known { name, support: Support::Noted(note), carriers: &[Carrier::Material] }
}

const COMPRESSED: &[Carrier] = &[Carrier::Buffer, Carrier::BufferView];

const KNOWN: [Known; 25] = [
    read("EXT_mesh_gpu_instancing", &[Carrier::Node]),
    read("EXT_meshopt_compression", COMPRESSED),
    read("EXT_texture_webp", &[Carrier::Texture]),
    read("KHR_animation_pointer", &[Carrier::Target]),
    read("KHR_draco_mesh_compression", &[Carrier::Primitive]),
    read("KHR_lights_punctual", &[Carrier::Document, Carrier::Node]),
    read("KHR_materials_emissive_strength", &[Carrier::Material]),
    read("KHR_materials_pbrSpecularGlossiness", &[Carrier::Material]),
    read("KHR_materials_unlit", &[Carrier::Material]),
    read("KHR_mesh_quantization", &[]),
    read("KHR_meshopt_compression", COMPRESSED),
    read("KHR_node_visibility", &[Carrier::Node]),
    read("KHR_texture_basisu", &[Carrier::Texture]),
    read("KHR_texture_transform", &[Carrier::TextureSlot]),
    Known {
        name: "KHR_materials_variants",
        support: Support::Noted("the base look is shown"),
        carriers: &[Carrier::Document, Carrier::Primitive],
    },
    noted("KHR_materials_anisotropy", "shown as isotropic"),
    noted("KHR_materials_clearcoat", "shown without its coat"),
    noted("KHR_materials_dispersion", "shown as opaque"),
    noted("KHR_materials_ior", "shown with an index of refraction of 1.5"),
    noted("KHR_materials_iridescence", "shown without its film"),
    noted("KHR_materials_sheen", "shown without its sheen"),
    noted("KHR_materials_specular", "shown with its full reflection at normal incidence"),
    noted("KHR_materials_transmission", "shown as opaque"),
    noted("KHR_materials_volume", "shown as opaque"),
    noted("KHR_materials_diffuse_transmission", "shown as opaque"),
];

fn known(name: &str) -> Option<&'static Known> {
    KNOWN.iter().find(|known| known.name == name)
}

fn names<'a>(tree: &'a Value, key: &str) -> Vec<&'a str> {
    tree.get(key).and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str).collect()
}

/// A document that cannot be shown without an extension that is not understood is refused.
pub fn check_required(tree: &Value) -> Result<(), Defect> {
    let unknown: Vec<&str> =
        names(tree, "extensionsRequired").into_iter().filter(|name| known(name).is_none()).collect();
    match unknown.is_empty() {
        true => Ok(()),
        false => Err(Defect::new("extensionsRequired", format!("{} cannot be read", unknown.join(", ")))),
    }
}

/// Lists what is used without its effect, and warns of what is undeclared or out of place.
pub fn check(tree: &Value, warnings: &mut Vec<Warning>) {
    let used = names(tree, "extensionsUsed");
    for required in names(tree, "extensionsRequired").iter().filter(|name| !used.contains(name)) {
        warnings.push(Warning::new(format!("extensionsRequired: {required} is missing from extensionsUsed")));
    }
    let ignored: Vec<&str> = used.iter().copied().filter(|name| known(name).is_none()).collect();
    if !ignored.is_empty() {
        warnings.push(Warning::new(format!("extensions that are not read: {}", ignored.join(", "))));
    }
    let mut carried: BTreeMap<&str, usize> = BTreeMap::new();
    let mut misplaced = Few::default();
    tree::visit_all(tree, &mut |path, value| {
        for name in value.get("extensions").and_then(Value::as_object).into_iter().flat_map(|all| all.keys()) {
            *carried.entry(name).or_default() += 1;
            if known(name).is_some_and(|known| !known.carriers.iter().any(|&carrier| is(carrier, path))) {
                misplaced.add(|| {
                    tree::object_at(tree, path).warning(format!("{name} does not belong there and is ignored"))
                });
            }
        }
    });
    misplaced.append_to(warnings);
    for (name, &count) in &carried {
        if !used.contains(name) {
            let carriers = counted(count, "object has", "objects have");
            warnings.push(Warning::new(format!("extensionsUsed: {name} is missing, and {carriers} it")));
        }
        if let Some(Known { support: Support::Noted(note), .. }) = known(name) {
            warnings.push(Warning::new(format!("{name}: {}, {note}", counted(count, "object", "objects"))));
        }
    }
}

/// Is what stands at `path` a carrier of that kind?
fn is(carrier: Carrier, path: &[String]) -> bool {
    let steps: Vec<&str> = path.iter().map(String::as_str).collect();
    match carrier {
        Carrier::Document => steps.is_empty(),
        Carrier::Node => matches!(steps[..], ["nodes", _]),
        Carrier::Material => matches!(steps[..], ["materials", _]),
        Carrier::Primitive => matches!(steps[..], ["meshes", _, "primitives", _]),
        Carrier::Texture => matches!(steps[..], ["textures", _]),
        Carrier::TextureSlot => {
            steps.first() == Some(&"materials") && steps.last().is_some_and(|last| last.ends_with("Texture"))
        }
        Carrier::Buffer => matches!(steps[..], ["buffers", _]),
        Carrier::BufferView => matches!(steps[..], ["bufferViews", _]),
        Carrier::Target => matches!(steps[..], ["animations", _, "channels", _, "target"]),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn warnings_of(tree: &Value) -> Vec<Warning> {
        let mut warnings = Vec::new();
        check(tree, &mut warnings);
        warnings
    }

    #[test]
    fn what_is_required_and_unknown_is_refused_by_name() {
        let tree = json!({"extensionsRequired": ["KHR_texture_transform", "ACME_rockets"]});
        let Err(Defect::Invalid { cause, .. }) = check_required(&tree) else { panic!("refused") };
        assert_eq!(cause, "ACME_rockets cannot be read");
    }

    #[test]
    fn extensions_out_of_place_or_undeclared_are_named() {
        let tree = json!({
            "extensionsUsed": ["KHR_materials_unlit", "KHR_materials_volume"],
            "nodes": [{"extensions": {"KHR_materials_unlit": {}}, "extras": {"extensions": {"X": 1}}}],
            "materials": [{"extensions": {"KHR_materials_volume": {}, "KHR_materials_ior": {}}}],
        });
        let warnings = warnings_of(&tree).iter().map(Warning::to_string).collect::<Vec<_>>().join("\n");
        for part in [
            "node 0: KHR_materials_unlit does not belong",
            "extensionsUsed: KHR_materials_ior is missing",
            "KHR_materials_volume: 1 object, shown as opaque",
        ] {
            assert!(warnings.contains(part), "{part} in {warnings}");
        }
        assert!(!warnings.contains('X'), "{warnings}");
    }
}
