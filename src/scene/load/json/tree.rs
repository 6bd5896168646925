//! Ways through a JSON tree: by patterns such as `nodes/*/children/*`, and names for what is found.

use serde_json::Value;

use crate::scene::load::file_object::{FileObject, kind_of, label};

/// Whether a value stays in the tree.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Keep {
    Yes,
    No,
}

/// Calls `act` with the path and value of everything that `pattern` matches; `*` is any key or
/// index. What it does not keep is taken out.
pub fn retain(tree: &mut Value, pattern: &str, act: &mut dyn FnMut(&[String], &mut Value) -> Keep) {
    let steps: Vec<&str> = pattern.split('/').collect();
    walk(tree, &steps, &mut Vec::new(), act);
}

/// [`retain`] for looking only.
pub fn visit<'a>(tree: &'a Value, pattern: &str, act: &mut dyn FnMut(&[String], &'a Value)) {
    let steps: Vec<&str> = pattern.split('/').collect();
    look(tree, &steps, &mut Vec::new(), act);
}

fn walk(value: &mut Value, steps: &[&str], path: &mut Vec<String>, act: &mut dyn FnMut(&[String], &mut Value) -> Keep) {
    let [step, rest @ ..] = steps else { return };
    let mut enter = |key: String, child: &mut Value| {
        path.push(key);
        let keep = match rest {
            [] => act(path, child),
            _ => {
                walk(child, rest, path, act);
                Keep::Yes
            }
        };
        path.pop();
        keep == Keep::Yes
    };
    match value {
        Value::Array(items) if *step == "*" => {
            let mut index = 0;
            items.retain_mut(|item| {
                index += 1;
                enter((index - 1).to_string(), item)
            });
        }
        Value::Object(members) if *step == "*" => members.retain(|key, item| enter(key.clone(), item)),
        Value::Object(members) => {
            let is_kept = members.get_mut(*step).is_none_or(|item| enter((*step).to_owned(), item));
            if !is_kept {
                members.remove(*step);
            }
        }
        _ => {}
    }
}

fn look<'a>(value: &'a Value, steps: &[&str], path: &mut Vec<String>, act: &mut dyn FnMut(&[String], &'a Value)) {
    let [step, rest @ ..] = steps else { return act(path, value) };
    let mut enter = |key: String, child: &'a Value| {
        path.push(key);
        look(child, rest, path, act);
        path.pop();
    };
    match value {
        Value::Array(items) if *step == "*" => {
            items.iter().enumerate().for_each(|(index, item)| enter(index.to_string(), item));
        }
        Value::Object(members) if *step == "*" => {
            members.iter().for_each(|(key, item)| enter(key.clone(), item));
        }
        Value::Object(members) => {
            if let Some(item) = members.get(*step) {
                enter((*step).to_owned(), item);
            }
        }
        _ => {}
    }
}

/// Calls `act` with the path of everything in the tree, and with it, from the root on. What a program
/// keeps in `extras` for itself is none of ours.
pub fn visit_all<'a>(tree: &'a Value, act: &mut dyn FnMut(&[String], &'a Value)) {
    descend(tree, &mut Vec::new(), act);
}

fn descend<'a>(value: &'a Value, path: &mut Vec<String>, act: &mut dyn FnMut(&[String], &'a Value)) {
    act(path, value);
    let mut enter = |key: String, child: &'a Value| {
        path.push(key);
        descend(child, path, act);
        path.pop();
    };
    match value {
        Value::Array(items) => items.iter().enumerate().for_each(|(index, item)| enter(index.to_string(), item)),
        Value::Object(members) => {
            members.iter().filter(|(key, _)| *key != "extras").for_each(|(key, item)| enter(key.clone(), item));
        }
        _ => {}
    }
}

/// `nodes[3].children[0]` as steps.
pub fn steps_of(path: &str) -> Vec<String> {
    path.split(['.', '[', ']']).filter(|step| !step.is_empty()).map(str::to_owned).collect()
}

/// A path as messages name it: `node 3 "wheel", children[0]`.
pub fn object_at(tree: &Value, path: &[String]) -> FileObject {
    let (head, rest) = match path {
        [extensions, extension, list, index, rest @ ..] if extensions == "extensions" => {
            (named(tree.pointer(&format!("/extensions/{extension}/{list}/{index}")), list, index), rest)
        }
        [list, index, rest @ ..] => (named(tree.pointer(&format!("/{list}/{index}")), list, index), rest),
        rest => (None, rest),
    };
    let mut tail = String::new();
    let rest = if head.is_some() { rest } else { path };
    for step in rest {
        match step.parse::<usize>() {
            Ok(index) => tail.push_str(&format!("[{index}]")),
            Err(_) if tail.is_empty() => tail.push_str(step),
            Err(_) => tail.push_str(&format!(".{step}")),
        }
    }
    match (head, tail.is_empty()) {
        (Some(head), true) => head,
        (Some(head), false) => head.member(tail),
        (None, true) => FileObject::other("document"),
        (None, false) => FileObject::other(tail),
    }
}

/// `None` where `index` is none: what is named then is a member, not an item of a list.
fn named(item: Option<&Value>, list: &str, index: &str) -> Option<FileObject> {
    let index = index.parse().ok()?;
    let name = item.and_then(|item| item.get("name")?.as_str());
    Some(match kind_of(list) {
        Some(kind) => FileObject::item(kind, index, name),
        None => FileObject::other(label(list.strip_suffix('s').unwrap_or(list), index, name)),
    })
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn patterns_find_members_and_items() {
        let mut tree = json!({"nodes": [{"children": [1, 9]}, {"mesh": 0}], "meshes": [{"name": "wheel"}]});
        let mut seen = Vec::new();
        visit(&tree, "nodes/*/children/*", &mut |path, value| seen.push((path.join("/"), value.clone())));
        assert_eq!(seen, [("nodes/0/children/0".to_owned(), json!(1)), ("nodes/0/children/1".to_owned(), json!(9))]);
        retain(&mut tree, "nodes/*/children/*", &mut |_, child| if child == 9 { Keep::No } else { Keep::Yes });
        assert_eq!(tree["nodes"][0], json!({"children": [1]}));
        retain(&mut tree, "nodes/*/mesh", &mut |_, _| Keep::No);
        assert_eq!(tree["nodes"][1], json!({}));
    }

    #[test]
    fn paths_are_named_after_their_objects() {
        let tree = json!({"meshes": [{"name": "wheel"}], "extensions": {"KHR_lights_punctual": {"lights": [{}]}}});
        let name = |path: &str| object_at(&tree, &steps_of(path)).to_string();
        assert_eq!(name("meshes[0].primitives[2].material"), "mesh 0 \"wheel\", primitives[2].material");
        assert_eq!(name("bufferViews[4]"), "buffer view 4");
        assert_eq!(name("asset.version"), "asset.version");
        assert_eq!(name("extensions.KHR_lights_punctual.lights[0].type"), "light 0, type");
        assert_eq!(name(""), "document");
    }
}
