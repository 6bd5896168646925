//! Which objects of a scene are shown: some hidden, or some alone.
//!
//! Both sets hold node indices, and a node stands for everything below it. In: a scene's nodes,
//! parents before children. Out: whether each is shown. What is not shown costs a frame nothing, and
//! is not voxelized again when it comes back.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use crate::scene::Scene;

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Visibility {
    /// Hidden with everything below them.
    pub hidden: BTreeSet<usize>,
    /// If there are any: only these and what is below them are shown, less what is hidden.
    pub only: BTreeSet<usize>,
}

/// By object of a prepared scene: is it hidden? None is by default.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Hidden(Vec<bool>);

impl Hidden {
    /// `object`: into [`crate::prepare::Prepared::objects`].
    pub fn contains(&self, object: usize) -> bool {
        self.0.get(object).copied().unwrap_or(false)
    }

    /// What is hidden, and more. `objects`: how many there are.
    pub fn and(&self, objects: usize, is_left_out: impl Fn(usize) -> bool) -> Self {
        (0..objects).map(|object| self.contains(object) || is_left_out(object)).collect()
    }
}

impl FromIterator<bool> for Hidden {
    fn from_iter<T: IntoIterator<Item = bool>>(by_object: T) -> Self {
        Self(by_object.into_iter().collect())
    }
}

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum VisibilityError {
    #[error("{scene}: node {node} cannot be hidden or shown: {known}")]
    UnknownNode { scene: String, node: usize, known: String },
    #[error("{scene} has no node called \"{name}\"; {known}")]
    UnknownName { scene: String, name: String, known: String },
    #[error("{scene}: nothing of \"{name}\" can be shown: neither it nor a node below it has a mesh")]
    NoMesh { scene: String, name: String },
}

impl Visibility {
    /// By node: is it shown? A node that the scene does not have is an error.
    pub fn shown_nodes(&self, scene: &Scene) -> Result<Vec<bool>, VisibilityError> {
        let nodes = scene.nodes.len();
        if let Some(&node) = self.hidden.iter().chain(&self.only).find(|node| **node >= nodes) {
            let known = match nodes {
                0 => "there are no nodes".to_owned(),
                nodes => format!("the nodes are 0 to {}", nodes - 1),
            };
            return Err(VisibilityError::UnknownNode { scene: scene.name.clone(), node, known });
        }
        let hidden = with_descendants(scene, &self.hidden);
        let only = with_descendants(scene, &self.only);
        Ok((0..nodes).map(|node| !hidden[node] && (self.only.is_empty() || only[node])).collect())
    }

    /// No node is hidden or shown alone.
    pub fn shows_all(&self) -> bool {
        self.hidden.is_empty() && self.only.is_empty()
    }

    pub fn hide(&mut self, node: usize) {
        self.hidden.insert(node);
    }

    /// A hidden node comes back, and with it what hides it: the nodes above it. What is hidden below
    /// it stays hidden. Beside nodes shown alone, it becomes one of them.
    pub fn show(&mut self, scene: &Scene, node: usize) {
        let ancestors = std::iter::successors(Some(node), |&node| scene.nodes.get(node)?.parent);
        let mut in_only = self.only.is_empty();
        for ancestor in ancestors {
            self.hidden.remove(&ancestor);
            in_only |= self.only.contains(&ancestor);
        }
        if !in_only {
            self.only.insert(node);
        }
    }

    /// Shows one node, with what is below it, alone.
    pub fn isolate(&mut self, scene: &Scene, node: usize) {
        self.only = BTreeSet::from([node]);
        self.show(scene, node);
    }
}

/// By node: is it one of these, or below one?
pub(super) fn with_descendants(scene: &Scene, nodes: &BTreeSet<usize>) -> Vec<bool> {
    let mut inside = Vec::with_capacity(scene.nodes.len());
    for (index, node) in scene.nodes.iter().enumerate() {
        inside.push(nodes.contains(&index) || node.parent.is_some_and(|parent| inside[parent]));
    }
    inside
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::scene::{LocalTransform, Node, Trs};

    /// house (0): roof (1), floor (2) with a chair (3); tree (4), lamp (5). Floor and lamp have no mesh.
    pub fn scene() -> Scene {
        let node = |name: &str, parent, mesh| Node {
            name: name.to_owned(),
            parent,
            local: LocalTransform::Trs(Trs::default()),
            mesh,
            skin: None,
            camera: None,
            light: None,
            is_visible: true,
        };
        let nodes = vec![
            node("house", None, Some(0)),
            node("roof", Some(0), Some(0)),
            node("floor", Some(0), None),
            node("chair", Some(2), Some(0)),
            node("tree", None, Some(0)),
            node("lamp", None, None),
        ];
        Scene { name: "village".to_owned(), nodes, ..Scene::default() }
    }

    fn shown(visibility: &Visibility) -> Vec<usize> {
        let shown = visibility.shown_nodes(&scene()).expect("known nodes");
        (0..shown.len()).filter(|&node| shown[node]).collect()
    }

    #[test]
    fn hiding_takes_what_is_below_and_showing_brings_back_what_is_above() {
        let mut visibility = Visibility::default();
        assert!(visibility.shows_all() && shown(&visibility) == [0, 1, 2, 3, 4, 5]);
        visibility.hide(3);
        visibility.hide(0);
        assert_eq!(shown(&visibility), [4, 5]);
        visibility.show(&scene(), 1);
        assert_eq!(shown(&visibility), [0, 1, 2, 4, 5], "the chair was hidden by itself");
    }

    #[test]
    fn isolating_shows_one_alone_even_below_a_mesh_or_a_hidden_node() {
        let mut visibility = Visibility::default();
        visibility.hide(0);
        visibility.isolate(&scene(), 2);
        assert_eq!(shown(&visibility), [2, 3]);
        visibility.hide(3);
        assert_eq!(shown(&visibility), [2]);
        visibility.show(&scene(), 4);
        assert_eq!(shown(&visibility), [2, 4], "beside what is shown alone");
        visibility.isolate(&scene(), 1);
        assert_eq!(shown(&visibility), [1]);
    }

    #[test]
    fn a_node_that_is_not_there_is_named() {
        let visibility = Visibility { only: BTreeSet::from([6]), ..Visibility::default() };
        let error = visibility.shown_nodes(&scene()).expect_err("unknown").to_string();
        assert_eq!(error, "village: node 6 cannot be hidden or shown: the nodes are 0 to 5");
    }
}
