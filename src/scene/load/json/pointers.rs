//! KHR_animation_pointer for what is animated here: a pointer to a node's transform becomes an
//! ordinary target; a channel that points at anything else is left out and named.

use serde_json::{Value, json};

use super::few::Few;
use super::tree::{self, Keep};
use crate::scene::Warning;

const EXTENSION: &str = "KHR_animation_pointer";
const ANIMATED: [&str; 4] = ["translation", "rotation", "scale", "weights"];

pub fn resolve(tree: &mut Value, warnings: &mut Vec<Warning>) {
    let mut lost = Vec::new();
    tree::retain(tree, "animations/*/channels/*/target", &mut |path, target| {
        let pointer = target.pointer(&format!("/extensions/{EXTENSION}/pointer")).and_then(Value::as_str);
        let path_is_pointer = target.get("path").and_then(Value::as_str) == Some("pointer");
        match (path_is_pointer, pointer) {
            (false, None) => {}
            (false, Some(_)) => lost.push((path.to_vec(), format!("has {EXTENSION}, but its path is not \"pointer\""))),
            (true, None) => {
                lost.push((path.to_vec(), "animates a pointer, and has none".to_owned()));
                return Keep::No;
            }
            (true, Some(pointer)) => match node_property(pointer) {
                Some((node, property)) => *target = json!({ "node": node, "path": property }),
                None => {
                    lost.push((path.to_vec(), format!("animates {pointer:?}, which does not move")));
                    return Keep::No;
                }
            },
        }
        Keep::Yes
    });
    let mut few = Few::default();
    for (path, cause) in lost {
        few.add(|| tree::object_at(tree, &path).warning(format!("it {cause}; that is left out")));
    }
    few.append_to(warnings);
}

/// `/nodes/3/rotation` → (3, "rotation").
fn node_property(pointer: &str) -> Option<(u64, &str)> {
    let (node, property) = pointer.strip_prefix("/nodes/")?.split_once('/')?;
    Some((node.parse().ok()?, property)).filter(|(_, property)| ANIMATED.contains(property))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transforms_become_targets_and_the_rest_is_named() {
        let target =
            |pointer: &str| json!({"target": {"path": "pointer", "extensions": {EXTENSION: {"pointer": pointer}}}});
        let mut tree = json!({"animations": [{"channels": [
            target("/nodes/2/rotation"), target("/materials/0/alphaCutoff"), {"target": {"path": "pointer"}}
        ]}]});
        let mut warnings = Vec::new();
        resolve(&mut tree, &mut warnings);
        assert_eq!(tree["animations"][0]["channels"][0]["target"], json!({"node": 2, "path": "rotation"}));
        assert_eq!(tree["animations"][0]["channels"][1], json!({}));
        assert_eq!(warnings.len(), 2);
        assert!(
            warnings[0]
                .sentence
                .starts_with("animation 0, channels[1].target: it animates \"/materials/0/alphaCutoff\"")
        );
    }
}
