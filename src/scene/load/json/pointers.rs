//! KHR_animation_pointer for what is animated here: a pointer to a node's transform becomes an
//! ordinary target; one to its visibility, for which the typed document has no target, moves with its
//! channel into an extension of the animation; a channel that points at anything else is left out and named.

use serde_json::{Value, json};

use super::few::Few;
use super::tree::{self, Keep};
use crate::scene::Warning;
use crate::scene::load::nodes::VISIBILITY;

const EXTENSION: &str = "KHR_animation_pointer";
const VISIBLE: &str = "visible";
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
    tree::retain(tree, "animations/*", &mut |_, animation| {
        set_apart(animation);
        Keep::Yes
    });
    let mut few = Few::default();
    for (path, cause) in lost {
        few.add(|| tree::object_at(tree, &path).warning(format!("it {cause}; that is left out")));
    }
    few.append_to(warnings);
}

/// Channels of visibility, out of the list of the others.
fn set_apart(animation: &mut Value) {
    let Some(channels) = animation.get_mut("channels").and_then(Value::as_array_mut) else { return };
    let is_visibility = |channel: &Value| channel.pointer("/target/path").is_some_and(|path| path == VISIBLE);
    let (apart, rest): (Vec<Value>, Vec<Value>) = std::mem::take(channels).into_iter().partition(is_visibility);
    *channels = rest;
    if !apart.is_empty() {
        animation["extensions"][VISIBILITY] = json!({ "channels": apart });
    }
}

/// `/nodes/3/rotation` → (3, "rotation").
fn node_property(pointer: &str) -> Option<(u64, &str)> {
    let (node, property) = pointer.strip_prefix("/nodes/")?.split_once('/')?;
    let node = node.parse().ok()?;
    let extension = property.strip_prefix("extensions/").and_then(|path| path.split_once('/'));
    if extension == Some((VISIBILITY, VISIBLE)) {
        return Some((node, VISIBLE));
    }
    Some((node, property)).filter(|(_, property)| ANIMATED.contains(property))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transforms_become_targets_and_the_rest_is_named() {
        let target =
            |pointer: &str| json!({"target": {"path": "pointer", "extensions": {EXTENSION: {"pointer": pointer}}}});
        let mut tree = json!({"animations": [{"channels": [
            target("/nodes/2/rotation"), target("/nodes/4/extensions/KHR_node_visibility/visible"), target("/materials/0/alphaCutoff"), {"target": {"path": "pointer"}}
        ]}]});
        let mut warnings = Vec::new();
        resolve(&mut tree, &mut warnings);
        assert_eq!(tree["animations"][0]["channels"][0]["target"], json!({"node": 2, "path": "rotation"}));
        assert_eq!(tree["animations"][0]["channels"][1], json!({}));
        let apart = &tree["animations"][0]["extensions"][VISIBILITY]["channels"];
        assert_eq!(*apart, json!([{ "target": { "node": 4, "path": "visible" } }]));
        assert_eq!(warnings.len(), 2);
        assert!(
            warnings[0]
                .sentence
                .starts_with("animation 0, channels[2].target: it animates \"/materials/0/alphaCutoff\"")
        );
    }
}
