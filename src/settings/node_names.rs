//! Nodes to hide or to show alone and lights to change by name, as a command line gives them. In: names
//! and a scene. Out: its nodes in a [`Visibility`], edits in a [`Lighting`], and a sentence for each
//! name that several share.

use std::collections::BTreeSet;

use super::listed_names::listed;
use super::visibility::with_descendants;
use super::{LightChange, LightError, Lighting, Visibility, VisibilityError};
use crate::scene::Scene;

/// A name that several nodes share means all of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeNames {
    /// Hidden with everything below them.
    pub hide: Vec<String>,
    /// If there are any: shown alone, with everything below them.
    pub only: Vec<String>,
    pub lights: Vec<LightChange>,
}

impl NodeNames {
    /// Whether any name hides a node or shows it alone.
    pub fn choose_nodes(&self) -> bool {
        !(self.hide.is_empty() && self.only.is_empty())
    }

    /// Adds the nodes of all names to what is set. Returns a sentence for each name that is not the
    /// name of one node alone.
    pub fn apply(&self, scene: &Scene, visibility: &mut Visibility) -> Result<Vec<String>, VisibilityError> {
        let mut notes = Vec::new();
        for name in &self.hide {
            let nodes = named(scene, name)?;
            notes.extend(shared(scene, name, nodes.len(), "hidden"));
            visibility.hidden.extend(nodes);
        }
        for name in &self.only {
            let nodes = named(scene, name)?;
            let below = with_descendants(scene, &nodes);
            if !scene.nodes.iter().zip(below).any(|(node, below)| below && node.mesh.is_some()) {
                return Err(VisibilityError::NoMesh { scene: scene.name.clone(), name: name.clone() });
            }
            notes.extend(shared(scene, name, nodes.len(), "shown"));
            visibility.only.extend(nodes);
        }
        Ok(notes)
    }

    /// The same of the lights; where one name is wrong, no light is changed.
    pub fn change_lights(&self, scene: &Scene, lighting: &mut Lighting) -> Result<Vec<String>, LightError> {
        lighting.change(scene, &self.lights)
    }
}

fn shared(scene: &Scene, name: &str, nodes: usize, what: &str) -> Option<String> {
    (nodes > 1).then(|| format!("{}: {nodes} nodes are called \"{name}\"; all of them are {what}", scene.name))
}

fn named(scene: &Scene, name: &str) -> Result<BTreeSet<usize>, VisibilityError> {
    let nodes: BTreeSet<usize> = (0..scene.nodes.len()).filter(|&node| scene.nodes[node].name == name).collect();
    if !nodes.is_empty() {
        return Ok(nodes);
    }
    let meshes: BTreeSet<&str> =
        scene.nodes.iter().filter(|node| node.mesh.is_some()).map(|node| &*node.name).collect();
    let known = listed("nodes with a mesh are", "none of its nodes has a mesh", &meshes);
    Err(VisibilityError::UnknownName { scene: scene.name.clone(), name: name.to_owned(), known })
}

#[cfg(test)]
mod tests {
    use super::super::visibility::tests::scene;
    use super::*;

    fn names(hide: &[&str], only: &[&str]) -> NodeNames {
        let owned = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect();
        NodeNames { hide: owned(hide), only: owned(only), ..NodeNames::default() }
    }

    #[test]
    fn a_name_means_all_nodes_that_have_it() {
        let mut scene = scene();
        scene.nodes[4].name = "roof".to_owned();
        let mut visibility = Visibility { hidden: BTreeSet::from([3]), ..Visibility::default() };
        let notes = names(&["roof"], &["floor"]).apply(&scene, &mut visibility);
        assert_eq!(notes, Ok(vec!["village: 2 nodes are called \"roof\"; all of them are hidden".to_owned()]));
        assert_eq!(visibility, Visibility { hidden: BTreeSet::from([1, 3, 4]), only: BTreeSet::from([2]) });
    }

    #[test]
    fn names_that_mean_nothing_are_named() {
        let refused = |names: NodeNames| names.apply(&scene(), &mut Visibility::default()).expect_err("a refusal");
        let known = "nodes with a mesh are \"chair\", \"house\", \"roof\", \"tree\"";
        let error = refused(names(&["Roof"], &[])).to_string();
        assert_eq!(error, format!("village has no node called \"Roof\"; {known}"));
        let error = refused(names(&[], &["lamp"])).to_string();
        assert!(error.contains("nothing of \"lamp\""), "{error}");
    }
}
