//! What a warning is about: the nodes, meshes and skins that its sentence names, in the words of
//! the loader (`mesh 3 "wheel": …`, `object "car" is hidden …`). Read once a warning, so that a tree
//! of ten thousand nodes can be marked.

use std::collections::HashSet;

use crate::scene::Node;

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Mentions {
    /// Names of nodes, and of objects, which are called like their nodes.
    nodes: HashSet<String>,
    meshes: HashSet<usize>,
    skins: HashSet<usize>,
}

impl Mentions {
    pub fn of(sentence: &str) -> Self {
        let mut mentions = Self::default();
        for kind in ["object", "node", "mesh", "skin"] {
            for (at, _) in sentence.match_indices(kind) {
                let rest = &sentence[at + kind.len()..];
                if sentence[..at].ends_with(char::is_alphanumeric) || !rest.starts_with(' ') {
                    continue;
                }
                mentions.add(kind, rest.trim_start());
            }
        }
        mentions
    }

    /// `label`: a number, a quoted name, or both, and what follows.
    fn add(&mut self, kind: &str, label: &str) {
        let (digits, after) = label.split_at(label.find(|c: char| !c.is_ascii_digit()).unwrap_or(label.len()));
        let number = digits.parse::<usize>().ok().filter(|_| !after.starts_with(char::is_alphanumeric));
        let quoted = after.trim_start().strip_prefix('"').and_then(|name| Some(name.split_once('"')?.0));
        match (kind, number, quoted) {
            ("mesh", Some(mesh), _) => self.meshes.extend([mesh]),
            ("skin", Some(skin), _) => self.skins.extend([skin]),
            ("node" | "object", _, Some(name)) => self.nodes.extend([name.to_owned()]),
            // What a file leaves without a name is called like this.
            ("node", Some(node), None) => self.nodes.extend([format!("node {node}")]),
            _ => {}
        }
    }

    /// Takes over what another sentence is about.
    pub fn extend(&mut self, other: &Self) {
        self.nodes.extend(other.nodes.iter().cloned());
        self.meshes.extend(&other.meshes);
        self.skins.extend(&other.skins);
    }

    /// Whether the node, its object, or the mesh or skin that it carries is named.
    pub fn are_about(&self, node: &Node) -> bool {
        self.nodes.contains(&node.name)
            || node.mesh.is_some_and(|mesh| self.meshes.contains(&mesh))
            || node.skin.is_some_and(|skin| self.skins.contains(&skin))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{LocalTransform, Trs};

    fn node(name: &str, mesh: Option<usize>, skin: Option<usize>) -> Node {
        let local = LocalTransform::Trs(Trs::default());
        Node { name: name.to_owned(), parent: None, local, mesh, skin, camera: None, light: None }
    }

    #[test]
    fn sentences_are_about_what_they_name() {
        let nodes = [node("wheel", Some(1), None), node("wheel 2", Some(12), Some(1)), node("axle", None, None)];
        let about = |sentence: &str| -> Vec<usize> {
            (0..3).filter(|&index| Mentions::of(sentence).are_about(&nodes[index])).collect()
        };
        assert_eq!(about("object \"wheel\" stretches by up to 1.0 cells"), [0]);
        assert_eq!(about("node 7 \"axle\": its rotation is no unit quaternion"), [2]);
        assert_eq!(about("mesh 1 \"rim\": morph targets are not applied"), [0]);
        assert_eq!(about("mesh 12: no normals; skin 1 has too many joints"), [1]);
        assert_eq!(about("1 node with a mesh left out; submesh 1, mesh 1a, node 2"), Vec::<usize>::new());
        assert_eq!(about("material 1 \"wheel\": not read"), Vec::<usize>::new());
        assert!(Mentions::of("node 5: no mesh").are_about(&node("node 5", None, None)));
    }
}
