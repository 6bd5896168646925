//! What glTF forbids and reading would not notice. Such files are opened; each rule they break is
//! a warning, so that whoever made the file can mend it.

use serde_json::Value;

use super::few::Few;
use super::tree::{object_at, visit, visit_all};
use crate::scene::Warning;

/// Numbers and the values they may have.
struct Range {
    pattern: &'static str,
    allowed: fn(f64) -> bool,
    words: &'static str,
}

const fn range(pattern: &'static str, allowed: fn(f64) -> bool, words: &'static str) -> Range {
    Range { pattern, allowed, words }
}

const AT_LEAST_0: &str = "at least 0";
const ABOVE_0: &str = "above 0";
const FRACTION: &str = "0 to 1";

fn at_least_0(value: f64) -> bool {
    value >= 0.0
}

fn above_0(value: f64) -> bool {
    value > 0.0
}

fn fraction(value: f64) -> bool {
    (0.0..=1.0).contains(&value)
}

fn stride(value: f64) -> bool {
    (4.0..=252.0).contains(&value) && value % 4.0 == 0.0
}

const RANGES: [Range; 26] = [
    range("buffers/*/byteLength", above_0, ABOVE_0),
    range("bufferViews/*/byteLength", above_0, ABOVE_0),
    range("bufferViews/*/byteOffset", at_least_0, AT_LEAST_0),
    range("bufferViews/*/byteStride", stride, "a multiple of 4 from 4 to 252"),
    range("accessors/*/count", above_0, ABOVE_0),
    range("accessors/*/byteOffset", at_least_0, AT_LEAST_0),
    range("accessors/*/sparse/count", above_0, ABOVE_0),
    range("cameras/*/perspective/yfov", above_0, ABOVE_0),
    range("cameras/*/perspective/znear", above_0, ABOVE_0),
    range("cameras/*/perspective/aspectRatio", above_0, ABOVE_0),
    range("cameras/*/orthographic/xmag", |value| value != 0.0, "anything but 0"),
    range("cameras/*/orthographic/ymag", |value| value != 0.0, "anything but 0"),
    range("materials/*/alphaCutoff", at_least_0, AT_LEAST_0),
    range("materials/*/emissiveFactor/*", fraction, FRACTION),
    range("materials/*/pbrMetallicRoughness/baseColorFactor/*", fraction, FRACTION),
    range("materials/*/pbrMetallicRoughness/metallicFactor", fraction, FRACTION),
    range("materials/*/pbrMetallicRoughness/roughnessFactor", fraction, FRACTION),
    range("materials/*/extensions/KHR_materials_emissive_strength/emissiveStrength", at_least_0, AT_LEAST_0),
    range("materials/*/extensions/KHR_materials_anisotropy/anisotropyStrength", fraction, FRACTION),
    range("materials/*/extensions/KHR_materials_ior/ior", |value| value == 0.0 || value >= 1.0, "0 or at least 1"),
    range("materials/*/extensions/KHR_materials_volume/thicknessFactor", at_least_0, AT_LEAST_0),
    range("materials/*/extensions/KHR_materials_volume/attenuationDistance", above_0, ABOVE_0),
    range("materials/*/extensions/KHR_materials_volume/attenuationColor/*", fraction, FRACTION),
    range("extensions/KHR_lights_punctual/lights/*/intensity", at_least_0, AT_LEAST_0),
    range("extensions/KHR_lights_punctual/lights/*/range", above_0, ABOVE_0),
    range("extensions/KHR_lights_punctual/lights/*/color/*", at_least_0, AT_LEAST_0),
];

/// Members that an object must have, where reading goes on without them.
const REQUIRED: [(&str, &str); 1] = [("animations/*/channels/*", "target")];

/// Pairs of members of which the first makes no sense without the second.
const DEPENDENT: [(&str, &str, &str); 2] = [("nodes/*", "skin", "mesh"), ("nodes/*", "weights", "mesh")];

/// Members that exclude each other.
const EXCLUSIVE: [(&str, &str, &str); 5] = [
    ("nodes/*", "matrix", "translation"),
    ("nodes/*", "matrix", "rotation"),
    ("nodes/*", "matrix", "scale"),
    ("cameras/*", "perspective", "orthographic"),
    ("images/*", "uri", "bufferView"),
];

pub fn check(tree: &Value, warnings: &mut Vec<Warning>) {
    empties(tree, warnings);
    for Range { pattern, allowed, words } in &RANGES {
        let is_outside = |value: &Value| value.as_f64().is_some_and(|number| !allowed(number));
        warn(tree, pattern, is_outside, |value| format!("it is {value}, and must be {words}"), warnings);
    }
    for (pattern, member) in REQUIRED {
        let lacks = |object: &Value| object.is_object() && object.get(member).is_none();
        warn(tree, pattern, lacks, |_| format!("it has no {member}"), warnings);
    }
    for (pattern, member, needed) in DEPENDENT {
        let lacks = |object: &Value| object.get(member).is_some() && object.get(needed).is_none();
        warn(tree, pattern, lacks, |_| format!("its {member} means nothing without a {needed}"), warnings);
    }
    let mut unknown = Few::default();
    visit(tree, "meshes/*/primitives/*/attributes/*", &mut |path, _| {
        if path.last().is_some_and(|name| !is_attribute(name)) {
            unknown.add(|| object_at(tree, path).warning("glTF knows no such attribute; it is ignored"));
        }
    });
    unknown.append_to(warnings);
    for (pattern, member, other) in EXCLUSIVE {
        let has_both = |object: &Value| object.get(member).is_some() && object.get(other).is_some();
        warn(tree, pattern, has_both, |_| format!("it has both {member} and {other}"), warnings);
    }
}

/// Names an attribute may have: glTF's own, or one that starts with an underscore.
fn is_attribute(name: &str) -> bool {
    let numbered = |prefix: &str| name.strip_prefix(prefix).is_some_and(|set| set.parse::<u32>().is_ok());
    let sets = ["TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_"];
    ["POSITION", "NORMAL", "TANGENT"].contains(&name) || name.starts_with('_') || sets.into_iter().any(numbered)
}

fn warn(
    tree: &Value,
    pattern: &str,
    is_defect: impl Fn(&Value) -> bool,
    words: impl Fn(&Value) -> String,
    warnings: &mut Vec<Warning>,
) {
    let mut few = Few::default();
    visit(tree, pattern, &mut |path, value| {
        if is_defect(value) {
            few.add(|| object_at(tree, path).warning(words(value)));
        }
    });
    few.append_to(warnings);
}

/// No list of a document may be empty, and no primitive without attributes.
fn empties(tree: &Value, warnings: &mut Vec<Warning>) {
    let mut few = Few::default();
    visit_all(tree, &mut |path, value| {
        let is_empty = match value {
            Value::Array(items) => items.is_empty(),
            Value::Object(members) => members.is_empty() && path.last().is_some_and(|last| last == "attributes"),
            _ => false,
        };
        if is_empty {
            few.add(|| object_at(tree, path).warning("it is empty, which glTF does not allow"));
        }
    });
    few.append_to(warnings);
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn every_kind_of_rule_is_seen() {
        let tree = json!({
            "nodes": [{"children": [], "skin": 0, "matrix": [1], "scale": [1, 1, 1]}],
            "bufferViews": [{"byteStride": 6}],
            "animations": [{"channels": [{}]}],
            "extras": {"anything": []},
        });
        let mut warnings = Vec::new();
        check(&tree, &mut warnings);
        assert_eq!(
            warnings,
            [
                "node 0, children: it is empty, which glTF does not allow",
                "buffer view 0, byteStride: it is 6, and must be a multiple of 4 from 4 to 252",
                "animation 0, channels[0]: it has no target",
                "node 0: its skin means nothing without a mesh",
                "node 0: it has both matrix and scale",
            ]
        );
    }
}
